// Programs whose shaders share code: a shader is the text of several files of renderers/shaders, one after
// another, after "#version 450 core". A compiler's message names a line as PART:LINE, where parts are counted
// from 0 in the order that the error's file name lists, such as "scene.glsl + sky.frag".
#pragma once

#include <initializer_list>
#include <string_view>

#include "renderers/gl.h"

namespace terrabench {

using ShaderParts = std::initializer_list<std::string_view>;  // file names; all must exist

// Throws as link_program() does. No part but the first may begin with "#version"; the line is added if the
// first does not. `geometry` may be empty.
Program link_parts(ShaderParts vertex, ShaderParts fragment, ShaderParts geometry = {});

}  // namespace terrabench
