# Shaders become part of the program: terrabench_shaders(TARGET FILE…) writes a table of (file name, text) that
# shader_file() in renderers/gl.h reads, so nothing has to be found at run time.
function(terrabench_shaders target)
  set(table "")
  foreach(file IN LISTS ARGN)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${file})
    file(READ ${file} text)
    get_filename_component(name ${file} NAME)
    string(APPEND table "    {\"${name}\", R\"glsl(${text})glsl\"},\n")
  endforeach()
  file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/shaders.cpp @ONLY CONTENT [[
#include "renderers/gl.h"

namespace terrabench {
namespace {

constexpr ShaderFile kShaders[] = {
@table@};

}  // namespace

std::span<const ShaderFile> shader_files() { return kShaders; }

}  // namespace terrabench
]])
  target_sources(${target} PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/shaders.cpp)
endfunction()
