# Shaders are part of the program: every file of shaders/ becomes a string in a generated source, so
# that the program runs from anywhere.
function(stereonav_embed_shaders target)
  file(GLOB files CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/shaders/*.vert ${CMAKE_SOURCE_DIR}/shaders/*.frag)
  set(entries "")
  foreach(file ${files})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
    get_filename_component(name ${file} NAME)
    file(READ ${file} text)
    string(APPEND entries "    {\"${name}\", R\"glsl(${text})glsl\"},\n")
  endforeach()
  set(generated ${CMAKE_BINARY_DIR}/generated/embedded_shaders.cpp)
  file(CONFIGURE OUTPUT ${generated} @ONLY CONTENT [[
// Generated from shaders/ by cmake/shaders.cmake.
#include "engine/display/shader_program.h"

namespace stereonav {

std::span<const ShaderSource> shaderSources() {
    static constexpr ShaderSource kSources[] = {
@entries@    };
    return kSources;
}

}  // namespace stereonav
]])
  target_sources(${target} PRIVATE ${generated})
endfunction()
