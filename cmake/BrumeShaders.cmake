# Compiles GLSL at build time and embeds the SPIR-V, so that the library opens no shader file.

find_program(GLSLANG_VALIDATOR glslangValidator REQUIRED)
find_program(SPIRV_OPT spirv-opt REQUIRED)

# brume_shaders(brume_oit oit/linked_list/resolve.comp ...): paths below shaders/. Each file
# becomes the header <spv/oit/linked_list/resolve.comp.hpp>, which defines
# brume::spv::oit_linked_list_resolve_comp (constexpr uint32_t[]). Those named again behind FLOAT64
# are compiled a second time, with BRUME_FLOAT64 defined, as ..._comp_float64.
function(brume_shaders target)
  cmake_parse_arguments(ARG "" "" "FLOAT64" ${ARGN})
  set(headers)
  list(TRANSFORM ARG_FLOAT64 APPEND "|float64" OUTPUT_VARIABLE float64)
  foreach(variant IN LISTS ARG_UNPARSED_ARGUMENTS float64)
    string(REGEX REPLACE "[|].*" "" shader ${variant})
    string(REGEX REPLACE "[|]" "." name ${variant})
    set(defines)
    if(variant MATCHES "float64$")
      set(defines -DBRUME_FLOAT64)
    endif()
    set(source ${PROJECT_SOURCE_DIR}/shaders/${shader})
    set(spirv ${CMAKE_BINARY_DIR}/spirv/${name}.spv)
    set(header ${CMAKE_BINARY_DIR}/generated/spv/${name}.hpp)
    string(REGEX REPLACE "[/.]" "_" symbol ${name})
    cmake_path(GET spirv PARENT_PATH spirv_folder)
    file(MAKE_DIRECTORY ${spirv_folder})
    add_custom_command(
      OUTPUT ${header}
      COMMAND ${GLSLANG_VALIDATOR} -V --quiet --target-env vulkan1.3 -I${PROJECT_SOURCE_DIR}/shaders ${defines}
              --depfile ${spirv}.d -o ${spirv}.raw ${source}
      COMMAND ${SPIRV_OPT} -O ${spirv}.raw -o ${spirv}
      COMMAND ${CMAKE_COMMAND} -DINPUT=${spirv} -DOUTPUT=${header} -DSYMBOL=${symbol}
              -P ${PROJECT_SOURCE_DIR}/cmake/EmbedSpirv.cmake
      # glslang names its own output in the dep-file; CMake wants the rule's.
      COMMAND sed -i "s#^[^:]*:#${header}:#" ${spirv}.d
      MAIN_DEPENDENCY ${source}
      DEPENDS ${PROJECT_SOURCE_DIR}/cmake/EmbedSpirv.cmake
      DEPFILE ${spirv}.d
      COMMENT "Compiling shader ${name}"
      VERBATIM)
    list(APPEND headers ${header})
    set_property(GLOBAL APPEND PROPERTY BRUME_SHADERS "${shader}|${defines}|${name}|${symbol}")
  endforeach()
  target_sources(${target} PRIVATE ${headers})
  target_include_directories(${target} PRIVATE ${CMAKE_BINARY_DIR}/generated)
endfunction()

# brume_shader_table(brume_view_core): a source file of `target` with every shader of the folders of shaders/ so
# far, by the file that it is compiled from: brume::view::listShaders().
function(brume_shader_table target)
  get_property(shaders GLOBAL PROPERTY BRUME_SHADERS)
  set(includes)
  set(rows)
  foreach(entry IN LISTS shaders)
    string(REGEX MATCH "^([^|]*)[|]([^|]*)[|]([^|]*)[|]([^|]*)$" unused "${entry}")
    string(APPEND includes "#include <spv/${CMAKE_MATCH_3}.hpp>\n")
    string(APPEND rows "        {\"${CMAKE_MATCH_1}\", \"${CMAKE_MATCH_2}\", spv::${CMAKE_MATCH_4}},\n")
  endforeach()
  file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/generated/shader_table.cpp CONTENT "// Generated from the list of shaders; do not edit.
#include <view/shader_reload.hpp>
@includes@
namespace brume::view {
const std::vector<ShaderSource>& listShaders() {
    static const std::vector<ShaderSource> shaders = {
@rows@    };
    return shaders;
}
}  // namespace brume::view
" @ONLY)
  target_sources(${target} PRIVATE ${CMAKE_BINARY_DIR}/generated/shader_table.cpp)
  target_include_directories(${target} PRIVATE ${CMAKE_BINARY_DIR}/generated)
endfunction()
