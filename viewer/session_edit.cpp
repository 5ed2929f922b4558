// The session's edits: what they change, and what taking them in costs each method.
#include <fmt/format.h>

#include <algorithm>

#include "viewer/session.h"

namespace terrabench::viewer {

bool Session::may_edit() {
  if (!ready()) return false;
  const bool overhangs =
      std::ranges::any_of(sides_, [](const auto& side) { return side->ground()->surface != nullptr; });
  if (working()) {
    message = "editing waits until the work is done";
  } else if (overhangs) {
    message = "heights cannot hold overhangs: show another method, or see `terrabench represent --dig`";
  }
  return !working() && !overhangs;
}

void Session::edit(const Stroke& stroke) {
  if (!may_edit()) return;
  for (const auto& side : sides_) side->before_edit();
  const auto rect = edits_.apply(sides_.front()->ground()->heights, stroke);
  if (rect) {
    changed(*rect, stroke.digs ? "dug" : "filled");
  } else {
    message = "nothing changed: the sphere meets no ground under open sky";
  }
}

void Session::undo() {
  if (!may_edit() || !edits_.can_undo()) return;
  for (const auto& side : sides_) side->before_edit();
  changed(edits_.undo(sides_.front()->ground()->heights), "undone");
}

// Passes an edit on, and measures the updates that take it in.
void Session::changed(const SampleRect& rect, const std::string& what) {
  Ground& ground = *sides_.front()->ground();
  for (int j = rect.low.y; j <= rect.high.y; ++j) {
    for (int i = rect.low.x; i <= rect.high.x; ++i) {
      ground.bounds.low.y = std::min(ground.bounds.low.y, ground.heights.at(i, j));
      ground.bounds.high.y = std::max(ground.bounds.high.y, ground.heights.at(i, j));
    }
  }
  const glm::ivec2 samples = rect.high - rect.low + 1;
  std::vector<std::string> costs;
  for (const auto& side : sides_) {
    const FrameSample cost = side->take_edit(rect, frozen_.value_or(view(size_)));
    costs.push_back(fmt::format("{} {:.2g} ms to choose, {:.2g} ms to send {} B", side->method().label,
                                cost.choose, cost.send, cost.bytes_sent));
  }
  message = fmt::format("{} within {} × {} samples: {}", what, samples.x, samples.y, fmt::join(costs, "; "));
  camera.keep_on(ground.heights, ground.bounds);
}

}  // namespace terrabench::viewer
