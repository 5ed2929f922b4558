#include "experiments/mrbsp/methods.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <span>

#include "experiments/samples.h"
#include "experiments/stopwatch.h"
#include "renderers/frame_renderer.h"

namespace terrabench::mrbsp {

namespace {

MrbspOptions as_printed(const Heightfield& ground) {
  return {.depth = depth_over(ground), .holes = HoleRule::kPrinted};
}

}  // namespace

visibility::ChangeTable sets_over(const Heightfield& ground, const visibility::Options& how,
                                  Progress& progress) {
  MrbspOptions options = as_printed(ground);
  options.visibility = true;
  options.visible = how;
  return Mrbsp(ground, options, progress).visibility();
}

visibility::ChangeTable fitted_sets(const Heightfield& ground, visibility::Options how,
                                    const std::vector<View>& views, Progress& progress) {
  constexpr double kPaperShare = 2755.0 / 7238;
  visibility::ChangeTable best;
  double least = 1;
  for (const int cells : kCells) {
    how.cells = cells;
    visibility::ChangeTable sets = sets_over(ground, how, progress);
    Methods methods(ground, sets, progress);
    const double share =
        mean_triangles(methods.lods[kVis], views) / mean_triangles(methods.lods[kBrute], views);
    if (std::abs(share - kPaperShare) >= least) continue;
    least = std::abs(share - kPaperShare);
    best = std::move(sets);
  }
  return best;
}

Methods::Methods(const Heightfield& ground, const visibility::ChangeTable& sets, Progress& progress) {
  const MrbspOptions options = as_printed(ground);
  lods.reserve(kMethods);
  for (std::size_t m = 0; m < kMethods; ++m) {
    if (m == kVis || m == kBoth) {
      lods.emplace_back(ground, options, sets, progress);
    } else {
      lods.emplace_back(ground, options, progress);
    }
    lods.back().tune(kFinest);
  }
}

void Methods::tune(double size) {
  lods[kLod].tune(size);
  lods[kBoth].tune(size);
}

double fitted_size(Methods& methods, const std::vector<View>& views) {
  constexpr double kPaperShare = 3008.0 / 7238;
  const double wanted = kPaperShare * mean_triangles(methods.lods[kBrute], views);
  double low = 1.0 / 64, high = kFinest;
  for (int step = 0; step < 24; ++step) {
    const double middle = std::sqrt(low * high);
    methods.tune(middle);
    (mean_triangles(methods.lods[kLod], views) < wanted ? low : high) = middle;
  }
  return high;
}

std::vector<View> some_of(const std::vector<View>& views, std::size_t count) {
  count = std::min(count, views.size());
  std::vector<View> some;
  some.reserve(count);
  for (std::size_t k = 0; k < count; ++k) some.push_back(views[k * views.size() / count]);
  return some;
}

std::vector<FrameTimes> time_frames(std::vector<Mrbsp>& lods, const Heightfield& ground,
                                    const std::vector<View>& views, const RunOptions& options,
                                    Progress& progress) {
  constexpr std::size_t kRounds = kSamples;
  const auto context = open_context(options.renderer, views[0].width, views[0].height);
  std::vector<std::unique_ptr<FrameRenderer>> renderers(lods.size());
  const HeightRange range = height_range(ground);
  const FrameStyle style{.lowest = range.lowest, .highest = range.highest};
  std::vector<FrameTimes> times(lods.size());
  std::vector<std::vector<double>> seconds(lods.size());  // of each method's frames, round by round
  std::vector<double> choosing(lods.size());
  // Seconds of the choice and of the whole frame.
  const auto draw = [&](std::size_t m, const View& view) {
    const Stopwatch watch;
    const Frame& frame = lods[m].update(view);
    const double choice = watch.seconds();
    renderers[m]->draw(frame, view, style);
    renderers[m]->finish();
    return std::pair(choice, watch.seconds());
  };
  progress.begin("drawing frames", kRounds * views.size());
  for (std::size_t round = 0; round < kRounds; ++round) {
    for (auto& renderer : renderers) renderer.reset();
    for (std::size_t k = 0; k < lods.size(); ++k) {
      const std::size_t m = (round + k) % lods.size();
      renderers[m] = std::make_unique<FrameRenderer>(*context);
      draw(m, views[0]);  // uploads heights and compiles shaders
    }
    for (const View& view : views) {
      for (std::size_t turn = 0; turn < lods.size(); ++turn) {
        const std::size_t m = round % 2 == 0 ? turn : lods.size() - 1 - turn;
        const auto [choice, frame] = draw(m, view);
        choosing[m] += choice;
        seconds[m].push_back(frame);
      }
      progress.advance();
    }
  }
  progress.end();
  for (std::size_t m = 0; m < lods.size(); ++m) {
    const std::vector<double>& all = seconds[m];
    for (std::size_t round = 0; round < kRounds; ++round)
      times[m].rounds.push_back(median(std::span(all).subspan(round * views.size(), views.size())));
    times[m].choosing_share = choosing[m] / std::accumulate(all.begin(), all.end(), 0.0);
    for (std::size_t v = 0; v < views.size(); ++v) {
      double least = all[v];
      for (std::size_t k = v; k < all.size(); k += views.size()) least = std::min(least, all[k]);
      times[m].least += least;
    }
  }
  return times;
}

}  // namespace terrabench::mrbsp
