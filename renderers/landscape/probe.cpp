#include "renderers/landscape/probe.h"

#include <array>
#include <cassert>

#include "renderers/gl.h"
#include "renderers/landscape/pass_target.h"

namespace terrabench {
namespace {

constexpr std::string_view fragment_of(Probe probe) {
  return probe == Probe::kSkyShare      ? "probe_sky.frag"
         : probe == Probe::kReflectance ? "probe_fresnel.frag"
                                        : "probe_slope.frag";
}

}  // namespace

std::vector<float> evaluate(GlContext& context, Probe probe, std::span<const glm::vec4> inputs) {
  std::vector<float> values(inputs.size());
  if (inputs.empty()) return values;
  assert(inputs.size() <= 16384);
  context.make_current();
  const Program program = link_program("fullscreen.vert", fragment_of(probe));
  const Buffer buffer = make_buffer(inputs);
  const PassTarget target(static_cast<int>(inputs.size()), 1, GL_R32F, false);
  const VertexArray nothing;
  target.bind();
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 4, buffer.id());
  glUseProgram(program.id());
  glBindVertexArray(nothing.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glReadPixels(0, 0, target.width(), 1, GL_RED, GL_FLOAT, values.data());
  glBindVertexArray(0);
  glUseProgram(0);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  check_gl("evaluating a shader's function");
  return values;
}

}  // namespace terrabench
