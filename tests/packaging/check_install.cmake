# Installs to a prefix and builds a consumer with find_package and with pkg-config.
# -DBUILD=build folder -DWORK=scratch folder -DCONSUMER=source folder -DCXX=compiler -DCC=compiler
cmake_policy(VERSION 3.25)
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE out ERROR_VARIABLE out)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGN}: ${result}\n${out}")
  endif()
  set(out "${out}" PARENT_SCOPE)
endfunction()
function(expect_answer executable)
  run(${CMAKE_COMMAND} -E env LD_LIBRARY_PATH=${libdir} ${executable})
  if(NOT out MATCHES "brume answers")
    message(FATAL_ERROR "${executable} says: ${out}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
set(prefix ${WORK}/prefix)
foreach(component runtime dev vdb)
  run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix} --component ${component})
endforeach()
file(GLOB_RECURSE pc ${prefix}/*/brume.pc)
cmake_path(GET pc PARENT_PATH pcdir)
cmake_path(GET pcdir PARENT_PATH libdir)

# Nothing of the source tree or of this machine may be in what is installed.
file(GLOB_RECURSE texts ${prefix}/*.cmake ${prefix}/*.pc ${prefix}/*.h ${prefix}/*.hpp)
foreach(text IN LISTS texts)
  file(READ ${text} content)
  if(content MATCHES "${CMAKE_CURRENT_LIST_DIR}" OR content MATCHES "brume_render|OpenImageIO")
    message(FATAL_ERROR "${text} names what is not installed")
  endif()
endforeach()

run(${CMAKE_COMMAND} -S ${CONSUMER} -B ${WORK}/cmake -DCMAKE_PREFIX_PATH=${prefix}
    -DCMAKE_CXX_COMPILER=${CXX} -DCMAKE_C_COMPILER=${CC})
run(${CMAKE_COMMAND} --build ${WORK}/cmake)
expect_answer(${WORK}/cmake/consumer)

# The demo, outside of the source tree: a renderer that exists, and the tutorial's lines.
if(DEMO)
  file(COPY ${DEMO}/ DESTINATION ${WORK}/demo)
  file(WRITE ${WORK}/demo/CMakeLists.txt "cmake_minimum_required(VERSION 3.22)
project(demo LANGUAGES CXX)
set(CMAKE_CXX_STANDARD 20)
find_package(brume 0.1 REQUIRED)
find_package(Vulkan REQUIRED)
find_package(ZLIB REQUIRED)
add_executable(demo main.cpp renderer.cpp png.cpp)
target_include_directories(demo PRIVATE ${BUILD}/generated)  # the cube's own shaders
target_compile_definitions(demo PRIVATE HOST_MINIMAL_SCENE=\"${WORK}/demo/scene.json\")
target_link_libraries(demo PRIVATE brume::brume Vulkan::Vulkan ZLIB::ZLIB)
")
  run(${CMAKE_COMMAND} -S ${WORK}/demo -B ${WORK}/demo/build -DCMAKE_PREFIX_PATH=${prefix}
      -DCMAKE_CXX_COMPILER=${CXX})
  run(${CMAKE_COMMAND} --build ${WORK}/demo/build)
  run(${CMAKE_COMMAND} -E env LD_LIBRARY_PATH=${libdir} ${WORK}/demo/build/demo --validate --frames 3
      --size 64x48 --start 1 -o ${WORK}/demo.png)
  if(NOT EXISTS ${WORK}/demo.png)
    message(FATAL_ERROR "the demo has made no picture")
  endif()
endif()

# Shaders of hosts find the includes.
file(WRITE ${WORK}/shader.comp "#version 460
#extension GL_GOOGLE_include_directive : require
#include \"host/brume_shadow.glsl\"
layout(push_constant) uniform Push { uint64_t shadow; };
layout(binding = 0) buffer Result { vec4 result; };
void main() { result = vec4(brumeTransmittance(shadow, vec3(1)), 1.0); }
")
file(WRITE ${WORK}/shader.frag "#version 460
#extension GL_GOOGLE_include_directive : require
#include \"host/brume_store.glsl\"
void main() { brumeStore(vec3(0), vec3(0.5), 2.0); }
")
foreach(stage comp frag)
  run(${GLSLANG} -V --quiet --target-env vulkan1.3 -I${prefix}/include/brume/glsl
      ${WORK}/shader.${stage} -o ${WORK}/${stage}.spv)
endforeach()

# A version that cannot fit is refused.
file(WRITE ${WORK}/wrong/CMakeLists.txt
  "cmake_minimum_required(VERSION 3.22)\nproject(wrong NONE)\nfind_package(brume 0.2 REQUIRED)\n")
execute_process(COMMAND ${CMAKE_COMMAND} -S ${WORK}/wrong -B ${WORK}/wrong/build
  -DCMAKE_PREFIX_PATH=${prefix} RESULT_VARIABLE result OUTPUT_QUIET ERROR_QUIET)
if(result EQUAL 0)
  message(FATAL_ERROR "find_package(brume 0.2) accepts 0.1")
endif()

set(ENV{PKG_CONFIG_PATH} ${pcdir})
set(static)
if(EXISTS ${libdir}/libbrume.a)
  set(static --static)
endif()
run(pkg-config --cflags --libs ${static} brume)
separate_arguments(flags UNIX_COMMAND "${out}")
run(${CC} -c ${CONSUMER}/plain.c -o ${WORK}/plain.o -I${prefix}/include)
run(${CXX} -std=c++17 ${CONSUMER}/main.cpp ${WORK}/plain.o -o ${WORK}/by_pkg_config ${flags} -lbrume_vdb)
expect_answer(${WORK}/by_pkg_config)

# libbrume.so itself wants neither volumes nor images nor windows.
file(GLOB library ${libdir}/libbrume.so.*.*.*)
if(library)
  run(readelf -d ${library})
endif()
if(library AND out MATCHES "openvdb|OpenImageIO|glfw|libvulkan")
  message(FATAL_ERROR "libbrume.so needs ${CMAKE_MATCH_0}")
endif()
message(STATUS "installed, found and used both ways")
