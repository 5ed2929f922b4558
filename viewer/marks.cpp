// What is drawn over the picture to explain it.
#include <imgui.h>

#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "viewer/panels.h"

namespace terrabench::viewer {
namespace {

constexpr ImU32 kInk = IM_COL32(20, 20, 24, 255), kFrustum = IM_COL32(200, 20, 60, 255);

// The part of a segment before the eye, in pixels.
void line(const glm::mat4& to_clip, const glm::vec2& window, const glm::vec3& from, const glm::vec3& to) {
  glm::vec4 a = to_clip * glm::vec4(from, 1), b = to_clip * glm::vec4(to, 1);
  constexpr float kNearest = 1e-3F;  // of w
  if (a.w < kNearest && b.w < kNearest) return;
  if (a.w < kNearest) a = glm::mix(a, b, (kNearest - a.w) / (b.w - a.w));
  if (b.w < kNearest) b = glm::mix(b, a, (kNearest - b.w) / (a.w - b.w));
  const auto pixel = [&](const glm::vec4& clip) {
    return ImVec2((0.5F + 0.5F * clip.x / clip.w) * window.x, (0.5F - 0.5F * clip.y / clip.w) * window.y);
  };
  ImGui::GetBackgroundDrawList()->AddLine(pixel(a), pixel(b), kFrustum, 1.5F);
}

// The four edges of a view, as far as the ground reaches, and their ends.
void frustum(const View& of, const View& seen, const Bounds& ground) {
  const glm::vec3 forward = glm::normalize(of.target - of.eye);
  const glm::vec3 right = glm::normalize(glm::cross(forward, of.up)), above = glm::cross(right, forward);
  const float tall = std::tan(0.5F * of.vertical_fov);
  const float wide = tall * static_cast<float>(of.width) / static_cast<float>(of.height);
  const float reach = glm::length(ground.size());
  const glm::mat4 to_clip = world_to_clip(seen);
  const glm::vec2 window(seen.width, seen.height);
  std::array<glm::vec3, 4> ends;
  for (int k = 0; k < 4; ++k) {
    const float x = k == 0 || k == 3 ? -wide : wide, y = k < 2 ? -tall : tall;
    ends[static_cast<std::size_t>(k)] = of.eye + reach * (forward + x * right + y * above);
  }
  for (std::size_t k = 0; k < 4; ++k) {
    line(to_clip, window, of.eye, ends[k]);
    line(to_clip, window, ends[k], ends[(k + 1) % 4]);
  }
}

}  // namespace

void show_marks(Session& session, const Controls& controls) {
  const auto width = static_cast<float>(controls.window.x), height = static_cast<float>(controls.window.y);
  if (session.frozen()) frustum(*session.frozen(), session.view(controls.window), session.ground().bounds);
  if (session.sides() < 2) return;
  const float x = session.look.split * width;
  ImDrawList* const over = ImGui::GetBackgroundDrawList();
  over->AddLine({x, 0}, {x, height}, kInk, 2);
  const auto label = [&](int k, float at) {
    const std::string& words = session.side(k).method().label;
    const ImVec2 size = ImGui::CalcTextSize(words.c_str());
    const float left = k == 0 ? at - size.x - 8 : at + 8;
    over->AddRectFilled({left - 4, height - 62}, {left + size.x + 4, height - 44},
                        IM_COL32(255, 255, 255, 200));
    over->AddText({left, height - 60}, kInk, words.c_str());
  };
  label(0, x);
  label(1, x);
}

}  // namespace terrabench::viewer
