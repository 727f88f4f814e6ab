# One helper per kind of target, so that every folder's CMakeLists is a list of its files.

option(BRUME_ASSERTS "Check internal assertions" ON)

# Flags that every target of the project is built with. -ffp-contract=off: the CPU twins must
# give the same bits as the shaders, which never fuse a multiply with an add.
add_library(brume_flags INTERFACE)
target_compile_options(brume_flags INTERFACE -Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion
                                             -Wno-missing-field-initializers
                                             -ffp-contract=off)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # GCC 12 sees overlapping copies in joined strings that are not there (GCC bug 105651).
  target_compile_options(brume_flags INTERFACE -Wno-restrict)
endif()
if(BRUME_WERROR)
  target_compile_options(brume_flags INTERFACE -Werror)
endif()
if(BRUME_ASSERTS)
  target_compile_definitions(brume_flags INTERFACE BRUME_ASSERTS=1)
endif()
if(BRUME_SANITIZE)
  target_compile_options(brume_flags INTERFACE -fsanitize=${BRUME_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(brume_flags INTERFACE -fsanitize=${BRUME_SANITIZE})
endif()

# What nearly every source includes, parsed once: it takes a third off a clean build. Sources include
# what they use all the same. (Two, because libraries are position-independent and tests are not.)
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/precompiled.cpp CONTENT "")
function(brume_precompile target)
  add_library(${target} OBJECT ${CMAKE_BINARY_DIR}/precompiled.cpp)
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/src)
  target_link_libraries(${target} PRIVATE brume_flags)
  target_precompile_headers(${target} PRIVATE <algorithm> <cmath> <cstdint> <filesystem> <functional> <map>
    <memory> <span> <string> <vector> ${PROJECT_SOURCE_DIR}/src/core/math.hpp ${ARGN})
endfunction()
brume_precompile(brume_precompiled)
set_target_properties(brume_precompiled PROPERTIES POSITION_INDEPENDENT_CODE ON)
if(BRUME_BUILD_TESTS)
  brume_precompile(brume_test_precompiled <gtest/gtest.h>)
  target_link_libraries(brume_test_precompiled PRIVATE GTest::gtest)
  target_compile_options(brume_test_precompiled PRIVATE -O1)
endif()

# brume_library(brume_scene SOURCES a.cpp b.cpp DEPENDS brume_core PRIVATE_DEPENDS TinyGLTF::tinygltf)
# Headers are found from src/ (<scene/scene.hpp>); headers shared with GLSL from the root
# (<shaders/common/phase.h>).
function(brume_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS;PRIVATE_DEPENDS" ${ARGN})
  add_library(${name} STATIC ${ARG_SOURCES})
  target_include_directories(${name} PUBLIC ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR})
  target_link_libraries(${name} PUBLIC ${ARG_DEPENDS} PRIVATE brume_flags ${ARG_PRIVATE_DEPENDS})
  set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_precompile_headers(${name} REUSE_FROM brume_precompiled)
endfunction()

# brume_test(scene SOURCES loader_test.cpp DEPENDS brume_scene [LABELS cpu]): one executable per
# area of tests/, each test of it known to CTest by its own name.
function(brume_test area)
  cmake_parse_arguments(ARG "" "TIMEOUT" "SOURCES;DEPENDS;LABELS" ${ARGN})
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 600)
  endif()
  if(NOT ARG_LABELS)
    set(ARG_LABELS cpu)  # an empty list would make CTest take the next word for a label
  endif()
  add_executable(brume_${area}_tests ${ARG_SOURCES})
  target_link_libraries(brume_${area}_tests PRIVATE brume_flags ${ARG_DEPENDS} GTest::gtest_main)
  target_include_directories(brume_${area}_tests PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_compile_options(brume_${area}_tests PRIVATE -O1)  # builds faster; what is tested is a library
  target_precompile_headers(brume_${area}_tests REUSE_FROM brume_test_precompiled)
  target_compile_definitions(brume_${area}_tests PRIVATE
    BRUME_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
    BRUME_SHARED_DATA_DIR="${PROJECT_SOURCE_DIR}/../shared/data")
  gtest_discover_tests(brume_${area}_tests TEST_PREFIX "${area}." DISCOVERY_MODE PRE_TEST
    PROPERTIES LABELS "${ARG_LABELS}" TIMEOUT ${ARG_TIMEOUT})
endfunction()
