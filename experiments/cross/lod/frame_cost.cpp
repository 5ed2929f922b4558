#include "experiments/cross/lod/frame_cost.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "experiments/stopwatch.h"

namespace terrabench::cross {
namespace {

constexpr std::size_t kLead = 3;

}  // namespace

MethodFrames::MethodFrames(const Flight& flight, std::unique_ptr<Lod> lod, GlContext& context)
    : flight_(flight),
      lod_(std::move(lod)),
      clock_(frame_clock(context)),
      renderer_(context),
      style_{.lowest = flight.lowest, .highest = flight.highest} {
  renderer_.upload(lod_->update(flight.views.front()));
  renderer_.finish();
}

void MethodFrames::lead_up_to(std::size_t frame) {
  for (std::size_t i = frame - std::min(frame, kLead); i < frame; ++i) {
    renderer_.upload(lod_->update(flight_.views[i]));
  }
  renderer_.finish();
}

FrameCost MethodFrames::fly(const std::vector<std::size_t>& frames) {
  FrameCost cost;
  double triangles = 0, bytes = 0;
  for (const std::size_t at : frames) {
    const View& view = flight_.views[at];
    lead_up_to(at);
    cost.whole += seconds([&] {
      renderer_.draw(lod_->update(view), view, style_);
      renderer_.finish();
    });
    lead_up_to(at);
    const auto before = static_cast<double>(renderer_.bytes_uploaded());
    const Frame* frame = nullptr;
    cost.choose += seconds([&] { frame = &lod_->update(view); });
    cost.send += seconds([&] {
      renderer_.upload(*frame);
      renderer_.finish();
    });
    cost.draw += time_frames(clock_, 0, 1, [&](int) { renderer_.draw_uploaded(view, style_); }).front();
    triangles += static_cast<double>(frame->stats.triangles);
    bytes += static_cast<double>(renderer_.bytes_uploaded()) - before;
  }
  const auto count = static_cast<double>(frames.size());
  triangles_ = triangles / count;
  bytes_sent_ = bytes / count;
  return {cost.choose / count, cost.send / count, cost.draw / count, cost.whole / count};
}

Crossing crossing(const std::vector<double>& samples, const std::vector<double>& ratios) {
  std::size_t below = ratios.size();  // the first size from which on all ratios are below 1
  while (below > 0 && ratios[below - 1] < 1) --below;
  if (below == 0) return {.everywhere = true};
  if (below == ratios.size()) return {.nowhere = true};
  const double above = std::log(ratios[below - 1]), under = std::log(ratios[below]);
  const double low = std::log(samples[below - 1]), high = std::log(samples[below]);
  return {.from = std::exp(low + (high - low) * above / (above - under))};
}

}  // namespace terrabench::cross
