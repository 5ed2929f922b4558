#include "experiments/mrbsp/methods.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

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

double RoundTimes::of(std::size_t method) const {
  return std::accumulate(frames[method].begin(), frames[method].end(), 0.0);
}

double RoundTimes::choosing_of(std::size_t method) const {
  return std::accumulate(choices[method].begin(), choices[method].end(), 0.0);
}

std::vector<RoundTimes> time_rounds(std::vector<Mrbsp>& lods, const Heightfield& ground,
                                    const std::vector<View>& views, int rounds, const RunOptions& options,
                                    Progress& progress) {
  const auto context = open_context(options.renderer, views[0].width, views[0].height);
  std::vector<std::unique_ptr<FrameRenderer>> renderers(lods.size());
  const HeightRange range = height_range(ground);
  const FrameStyle style{.lowest = range.lowest, .highest = range.highest};
  const auto draw = [&](std::size_t m, const View& view) {
    const Frame* frame = nullptr;
    const double choice = seconds([&] { frame = &lods[m].update(view); });
    const double drawing = seconds([&] {
      renderers[m]->draw(*frame, view, style);
      renderers[m]->finish();
    });
    return std::pair(choice, choice + drawing);
  };
  // The first frame uploads heights and compiles shaders.
  const auto renew = [&](std::size_t first) {
    for (auto& renderer : renderers) renderer.reset();
    for (std::size_t k = 0; k < lods.size(); ++k) {
      const std::size_t m = (first + k) % lods.size();
      renderers[m] = std::make_unique<FrameRenderer>(*context);
      draw(m, views[0]);
    }
  };
  std::vector<RoundTimes> all;
  progress.begin("drawing frames", static_cast<std::uint64_t>(rounds) * views.size());
  for (int round = 0; round < rounds; ++round) {
    RoundTimes& times = all.emplace_back();
    times.frames.resize(lods.size());
    times.choices.resize(lods.size());
    renew(round);
    for (const View& view : views) {
      for (std::size_t turn = 0; turn < lods.size(); ++turn) {
        const std::size_t m = round % 2 == 0 ? turn : lods.size() - 1 - turn;
        const auto [choice, frame] = draw(m, view);
        times.choices[m].push_back(choice);
        times.frames[m].push_back(frame);
      }
      progress.advance();
    }
  }
  progress.end();
  return all;
}

std::vector<double> least_times(const std::vector<RoundTimes>& rounds) {
  std::vector<double> sums;
  for (std::size_t m = 0; !rounds.empty() && m < rounds[0].frames.size(); ++m) {
    double sum = 0;
    for (std::size_t v = 0; v < rounds[0].frames[m].size(); ++v) {
      double least = rounds[0].frames[m][v];
      for (const RoundTimes& round : rounds) least = std::min(least, round.frames[m][v]);
      sum += least;
    }
    sums.push_back(sum);
  }
  return sums;
}

}  // namespace terrabench::mrbsp
