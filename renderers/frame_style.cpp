#include "renderers/frame_style.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <limits>

namespace terrabench {

void set_matrix(const Program& program, const glm::mat4& world_to_clip) {
  glProgramUniformMatrix4fv(program.id(), uniform(program, "world_to_clip"), 1, GL_FALSE,
                            glm::value_ptr(world_to_clip));
}

void set_style(const Program& program, const View& view, const FrameStyle& style) {
  const GLuint id = program.id();
  const auto set3 = [&](const char* name, const glm::vec3& value) {
    glProgramUniform3fv(id, uniform(program, name), 1, glm::value_ptr(value));
  };
  set3("sun", glm::normalize(style.sun));
  set3("eye", view.eye);
  set3("fill_color", glm::vec3(1));
  glProgramUniform2f(
      id, uniform(program, "height_range"), style.lowest,
      std::max(style.highest, std::nextafter(style.lowest, std::numeric_limits<float>::max())));
  glProgramUniform1i(id, uniform(program, "ramp"), 0);
  glProgramUniform1f(id, uniform(program, "exaggeration"), style.shading_exaggeration);
  glProgramUniform1i(id, uniform(program, "facets"), 1);
  glProgramUniform1i(id, uniform(program, "flat_fill"), 0);
  glProgramUniform1f(id, uniform(program, "wire_width"), style.wire_width);
  glProgramUniform4f(id, uniform(program, "wire_ink"), 0.05F, 0.05F, 0.06F, style.wire_opacity);
  glProgramUniform2f(id, uniform(program, "pixels"), static_cast<float>(view.width),
                     static_cast<float>(view.height));
  glProgramUniform1i(id, uniform(program, "all_edges"), 1);
  glProgramUniform1i(id, uniform(program, "drawn"), 1);
}

}  // namespace terrabench
