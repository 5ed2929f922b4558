// Concurrent binary trees on the GPU beside the same on the processor, both with one pass per frame: what
// choosing costs along a path, in how many splits the two trees differ, and how many frames each takes after
// a jump of the camera until nothing changes.
//
// A pass on the processor also writes the indices of its triangles, which drawing needs; the GPU draws from
// the tree. The clock of its passes is that of drawing (renderers/frame_timer.h): on Mesa's llvmpipe, where
// the processor runs the shaders, the wall clock.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "experiments/cross/lod/tuned_cases.h"
#include "experiments/stopwatch.h"
#include "lod/camera/camera_path.h"
#include "lod/cbt/cbt.h"
#include "renderers/cbt/gpu_cbt.h"
#include "renderers/frame_timer.h"

namespace terrabench::cross {
namespace {

constexpr std::size_t kJumps = 8, kMostFrames = 64;

const std::array kSpecs{
    ParameterSpec{"error", 2.0, "px", "bound of the screen-space error, the knob of cbt", 0.05, 200},
    ParameterSpec{"path", std::string("fly"), "", "camera path: cross, fly, low, turn, walk, or a TOML file"},
    ParameterSpec{"size", std::int64_t{257}, "samples", "side of the generated grounds, 2^n + 1", 3, 8193},
};

class Trees {
 public:
  Trees(const Heightfield& ground, double pixels, GlContext& context, Progress& progress)
      : processor_(ground, {.passes = 1}, progress),
        gpu_(context, processor_.split_ground()),
        clock_(frame_clock(context)) {
    processor_.tune(pixels);
  }

  // Seconds of a pass.
  struct Times {
    double processor, gpu;
  };
  Times pass(const View& view) {
    Times times{};
    times.processor = seconds([&] { changes_ = processor_.update(view).stats.changes; });
    const SplitRule rule = processor_.split_rule(view);
    times.gpu = time_frames(clock_, 0, 1, [&](int) { gpu_.update(rule); }).front();
    return times;
  }
  // Passes that change a tree, each at most kMostFrames.
  struct Passes {
    std::size_t processor = 0, gpu = 0;
  };
  Passes rest(const View& view) {
    Passes passes;
    std::vector<std::uint64_t> before = gpu_.tree();
    for (std::size_t frame = 1; frame <= kMostFrames; ++frame) {
      pass(view);
      std::vector<std::uint64_t> after = gpu_.tree();
      const bool changed = after != before;
      if (changed) passes.gpu = frame;
      if (changes_ > 0) passes.processor = frame;
      differing_ += splits_differing(after);
      if (!changed && changes_ == 0) break;
      before = std::move(after);
    }
    return passes;
  }
  void compare() { differing_ += splits_differing(gpu_.tree()); }
  // Triangles that one tree has split and the other has not, over all passes of rest() and all compare().
  std::size_t differing() const { return differing_; }

  std::size_t leaves() const { return processor_.tree().leaves(); }
  int depth() const { return processor_.tree().depth(); }
  std::size_t processor_bytes() const { return processor_.tree().words().size_bytes(); }
  std::size_t gpu_bytes() const { return gpu_.tree_bytes(); }

 private:
  // Bits of the finest level, the last quarter.
  std::size_t splits_differing(const std::vector<std::uint64_t>& of_gpu) const {
    const std::span<const std::uint64_t> of_processor = processor_.tree().words();
    std::size_t differing = 0;
    for (std::size_t k = 3 * of_gpu.size() / 4; k < of_gpu.size(); ++k) {
      differing += static_cast<std::size_t>(std::popcount(of_processor[k] ^ of_gpu[k]));
    }
    return differing;
  }

  Cbt processor_;
  GpuCbt gpu_;
  FrameClock clock_;
  std::size_t changes_ = 0, differing_ = 0;  // changes_: of the processor's last pass
};

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const TerrainSource source = recorder.terrain(open_ground(at.terrain, at.integer("size"), options.seed));
  const std::vector<View> path = views(open_camera_path(at.parameters.text("path")), *source.heights);
  const auto context = open_context(options.renderer, 1, 1);
  Trees trees(*source.heights, at.parameters.number("error"), *context, progress);
  trees.rest(path.front());
  progress.begin("choosing on processor and GPU", path.size() + kJumps);
  for (const View& view : path) {
    const Trees::Times times = trees.pass(view);
    recorder.add_frame("processor_choose", "s", times.processor);
    recorder.add_frame("gpu_choose", "s", times.gpu);
    recorder.add_frame("leaves", "", static_cast<double>(trees.leaves()));
    trees.compare();
    progress.advance();
  }
  Trees::Passes most;
  for (std::size_t k = 0; k < kJumps; ++k) {
    const std::size_t from = k * path.size() / kJumps;
    trees.rest(path[from]);
    const Trees::Passes passes = trees.rest(path[(from + path.size() / 2) % path.size()]);
    most = {std::max(most.processor, passes.processor), std::max(most.gpu, passes.gpu)};
    progress.advance();
  }
  progress.end();
  recorder.add("splits_differing", "", static_cast<double>(trees.differing()));
  recorder.add("processor_frames_to_rest", "", static_cast<double>(most.processor));
  recorder.add("gpu_frames_to_rest", "", static_cast<double>(most.gpu));
  recorder.add("processor_tree", "B", static_cast<double>(trees.processor_bytes()));
  recorder.add("gpu_tree", "B", static_cast<double>(trees.gpu_bytes()));
  recorder.add("paper_tree", "B", std::ldexp(1.0, trees.depth() - 1));
}

std::vector<Case> cases(const RunOptions& options) {
  std::vector<Case> cases;
  for (const std::string& terrain : compared_grounds(options)) {
    const std::int64_t size = options.profile == Profile::kPaper ? 1025 : 257;
    cases.push_back({terrain, {kSpecs, {{"path", path_over(terrain)}, {"size", size}}}, terrain});
  }
  return cases;
}

}  // namespace

extern const Experiment kLodGpu{"cross.lod-gpu",   "Triangles chosen on the GPU", kSpecs, cases, measure,
                                Experiment::kTimed};

}  // namespace terrabench::cross
