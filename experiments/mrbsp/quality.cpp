// §3, §4: whether level of detail and visibility keep the picture, compared with brute force along the walk
// of table 2; and how well one level for all of the ground keeps it, with at least as many triangles.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "experiments/experiment.h"
#include "experiments/mrbsp/methods.h"
#include "renderers/frame_renderer.h"
#include "terrain/metrics/image_error.h"

namespace terrabench::mrbsp {
namespace {

const std::array kSpecs{
    ParameterSpec{"size", 1.0, "short sides", "as in mrbsp.walk; 0 fits it", 0, kFinest},
    ParameterSpec{"views", std::int64_t{40}, "views", "evenly spaced over the walk of table 2", 1, 240},
};
constexpr int kViews = 240;
constexpr double kEqualPictures = 100;  // dB, in place of infinity

// The difference from brute force over all pictures of a method.
struct Difference {
  double squares = 0;  // sum of mean squared errors, as a share of white's square
  double ssim = 0, least_ssim = 1;
  std::size_t pictures = 0;

  void add(const Image& brute, const Image& image) {
    const double similarity = terrabench::ssim(brute, image);
    squares += std::pow(10, -psnr(brute, image) / 10);
    ssim += similarity;
    least_ssim = std::min(least_ssim, similarity);
    ++pictures;
  }
  double pooled_psnr() const {
    return std::min(-10 * std::log10(squares / static_cast<double>(pictures)), kEqualPictures);
  }
};

std::vector<Case> cases(const RunOptions& options) {
  const bool paper = options.profile == Profile::kPaper;
  std::vector<Case> cases;
  for (const std::string& ground : grounds(options, paper)) {
    for (const auto& [name, size] : {std::pair{"printed", 1.0}, {"fitted", 0.0}}) {
      cases.push_back({fmt::format("{}/{}", ground, name),
                       {kSpecs, {{"size", size}, {"views", std::int64_t{20}}}},
                       ground});
    }
  }
  return cases;
}

// The ground at the lowest depth that draws at least `triangles` per view.
Mrbsp uniform(const Heightfield& ground, double triangles, const std::vector<View>& views,
              Progress& progress) {
  for (int depth = 1;; ++depth) {
    Mrbsp lod(ground, {.depth = depth}, progress);
    lod.tune(kFinest);
    if (mean_triangles(lod, views) >= triangles) return lod;
  }
}

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const TerrainSource source = recorder.terrain(open_ground(at.terrain, options.seed));
  const Heightfield& ground = *source.heights;
  const std::vector<View> all = walk(ground, kViews);
  Methods methods(ground, sets_over(ground, {.mode = visibility::Mode::kSampled}, progress), progress);
  const double asked = at.parameters.number("size");
  methods.tune(asked > 0 ? asked : fitted_size(methods, all));
  std::vector<Mrbsp>& lods = methods.lods;
  lods.push_back(uniform(ground, mean_triangles(lods[kLod], all), all, progress));
  const auto context = open_context(options.renderer, all[0].width, all[0].height);
  std::vector<std::unique_ptr<FrameRenderer>> renderers;
  for (std::size_t m = 0; m < lods.size(); ++m)
    renderers.push_back(std::make_unique<FrameRenderer>(*context));
  const HeightRange range = height_range(ground);
  const FrameStyle style{.lowest = range.lowest, .highest = range.highest};
  const std::vector<View> views = some_of(all, static_cast<std::size_t>(at.parameters.integer("views")));
  std::vector<Difference> differences(lods.size());
  progress.begin("comparing pictures", views.size());
  for (View view : views) {
    view.near = kWalkersNear;
    Image brute;
    for (std::size_t m = 0; m < lods.size(); ++m) {
      renderers[m]->draw(lods[m].update(view), view, style);
      const Image image = renderers[m]->image();
      if (m == kBrute) brute = image;
      differences[m].add(brute, image);
    }
    progress.advance();
  }
  progress.end();
  const double drawn_by_brute = mean_triangles(lods[kBrute], all);
  for (std::size_t m = kLod; m < lods.size(); ++m) {
    const Difference& difference = differences[m];
    const auto add = [&](std::string_view metric, std::string_view unit, double value) {
      recorder.add(fmt::format("{}_{}", metric, m < kMethods ? kMethodNames[m] : "uniform"), unit, value);
    };
    add("psnr", "dB", difference.pooled_psnr());
    add("mean_ssim", "", difference.ssim / static_cast<double>(difference.pictures));
    if (m < kMethods) add("least_ssim", "", difference.least_ssim);
    add("share", "", mean_triangles(lods[m], all) / drawn_by_brute);
  }
  recorder.add("pictures", "", views.size());
}

}  // namespace

extern const Experiment kQuality{"mrbsp.quality", "§3, §4: pictures compared with those of brute force",
                                 kSpecs, cases, measure};

}  // namespace terrabench::mrbsp
