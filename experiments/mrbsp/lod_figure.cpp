// Figure 1: what level of detail draws without the extra step of section 3 and with it, seen by its observer,
// with thresholds at the vertices. Pixels that show a hole are painted.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <unordered_map>

#include "experiments/experiment.h"
#include "experiments/figures/projection.h"
#include "experiments/mrbsp/figures.h"
#include "experiments/mrbsp/ground.h"
#include "lod/meters/bare_pixels.h"
#include "lod/mrbsp/lod_rule.h"
#include "lod/mrbsp/mrbsp.h"
#include "renderers/frame_renderer.h"
#include "renderers/scene.h"
#include "results/store/format.h"

namespace terrabench::mrbsp {
namespace {

using figures::Sheet;
using figures::SheetPoint;

constexpr int kWidth = 960, kHeight = 540;  // of a panel, units of the sheet
constexpr double kTitle = 30, kLabelSize = 12;
constexpr Rgb kPaper{255, 255, 255}, kInk{20, 20, 20}, kMark{0, 51, 153},
    kHole{255, 0, 170};  // of pixels that look through a hole

// Upright triangles that close the gaps of a frame, each twice, for both sides: a pixel that shows one looks
// through a hole. A gap lies where the middle of a triangle's edge is a corner of the triangles beyond it.
class Walls {
 public:
  explicit Walls(const Frame& frame) : width_(frame.grid.width), used_(frame.grid.heights.size()) {
    for (const std::uint32_t v : frame.indices) used_[v] = true;
    for (std::uint32_t k = 0; k < frame.indices.size(); k += 3) {
      for (std::uint32_t c = 0; c < 3; ++c)
        close(frame.indices[k + c], frame.indices[k + (c + 1) % 3], k / 3);
    }
  }
  const std::vector<std::uint32_t>& indices() const { return indices_; }
  std::uint32_t owner(std::size_t wall) const { return owners_[wall]; }  // the triangle with the edge

 private:
  void close(std::uint32_t a, std::uint32_t b, std::uint32_t owner) {
    const std::uint32_t x = a % width_ + b % width_, z = a / width_ + b / width_;
    if (x % 2 != 0 || z % 2 != 0) return;
    const std::uint32_t middle = z / 2 * width_ + x / 2;
    if (!used_[middle]) return;
    indices_.insert(indices_.end(), {a, middle, b, b, middle, a});
    owners_.insert(owners_.end(), 2, owner);
    close(a, middle, owner);
    close(middle, b, owner);
  }

  std::uint32_t width_;
  std::vector<bool> used_;
  std::vector<std::uint32_t> indices_, owners_;
};

// One panel: the frame of one rule.
class LodPicture {
 public:
  LodPicture(const Heightfield& ground, Mrbsp& lod, const View& view, const RunOptions& options)
      : ground_(ground),
        lod_(lod),
        view_(view),
        frame_(lod.update(view)),
        walls_(frame_),
        context_(open_context(options.renderer, view.width, view.height)) {
    std::vector<std::uint32_t> indices(frame_.indices.begin(), frame_.indices.end());
    indices.insert(indices.end(), walls_.indices().begin(), walls_.indices().end());
    const Batch batch{.first_index = 0, .index_count = static_cast<std::uint32_t>(indices.size())};
    Frame closed = frame_;
    closed.indices = indices;
    closed.batches = std::span(&batch, 1);
    numbers_ = FrameRenderer(*context_).triangle_numbers(closed, view_);
  }

  std::size_t hole_pixels() const {
    return std::ranges::count_if(numbers_, [&](auto n) { return is_hole(n); });
  }
  LodPanel numbers() const {
    return {hole_pixels(), find_bare_pixels(frame_, ground_, view_).bare, triangles()};
  }
  int threshold(std::uint32_t vertex) const { return lod_.threshold(view_.eye, position(vertex)); }

  // The triangle that needs the extra step and shows most pixels of its hole: apex, left, right.
  std::optional<std::array<std::uint32_t, 3>> culprit() const {
    std::unordered_map<std::uint32_t, std::size_t> pixels;
    for (const std::uint32_t n : numbers_) {
      if (is_hole(n)) ++pixels[walls_.owner(n - 1 - triangles())];
    }
    std::size_t most = 0;
    std::optional<std::array<std::uint32_t, 3>> best;
    for (std::uint32_t t = 0; t < triangles(); ++t) {
      const std::uint32_t* const v = frame_.indices.data() + std::size_t{3} * t;
      const auto found = pixels.find(t);
      if (found == pixels.end() || found->second <= most) continue;
      if (!may_open(threshold(v[0]), threshold(v[1]), threshold(v[2]), lod_.tree().depth())) continue;
      if (!std::ranges::all_of(v, v + 3, [&](auto at) { return project(position(at)).has_value(); }))
        continue;
      most = found->second;
      best = {v[0], v[1], v[2]};
    }
    return best;
  }

  // `split`: the triangle is drawn as its two halves.
  void draw(Sheet& sheet, double top, const std::optional<std::array<std::uint32_t, 3>>& marked, bool split) {
    top_ = top;
    sheet.picture(0, top, kWidth, kHeight, picture());
    if (marked) mark(sheet, *marked, split);
    label_vertices(sheet);
  }

 private:
  std::size_t triangles() const { return frame_.stats.triangles; }
  bool is_hole(std::uint32_t number) const { return number > triangles(); }
  glm::vec3 position(std::uint32_t vertex) const {
    return vertex_position(frame_, frame_.batches[0], vertex);
  }

  Image picture() const {
    const HeightRange range = height_range(ground_);
    TriangleMesh mesh;
    mesh.indices.assign(frame_.indices.begin(), frame_.indices.end());
    for (std::uint32_t v = 0; v < frame_.grid.heights.size(); ++v) mesh.positions.push_back(position(v));
    Scene scene;
    scene.lowest = range.lowest;
    scene.highest = range.highest;
    scene.meshes = {{.mesh = &mesh, .wire_width = 2}};
    Image image = render_scene(*context_, scene, view_);
    for (std::size_t k = 0; k < numbers_.size(); ++k) {
      if (is_hole(numbers_[k]))
        std::ranges::copy(kHole, image.rgb.begin() + static_cast<std::ptrdiff_t>(3 * k));
    }
    return image;
  }
  std::optional<SheetPoint> project(const glm::vec3& at) const {
    const auto [p, depth] = figures::project(view_, at);
    if (!(depth > view_.near)) return std::nullopt;
    if (p.x < 14 || p.y < 14 || p.x > kWidth - 14 || p.y > kHeight - 14) return std::nullopt;
    return p;
  }
  SheetPoint on_sheet(const SheetPoint& p) const { return {p.x, p.y + top_}; }
  // Whether a pixel next to the vertex shows one of its triangles.
  bool is_shown(std::uint32_t vertex, const SheetPoint& at) const {
    const int x = static_cast<int>(at.x * Sheet::kPixels), y = static_cast<int>(at.y * Sheet::kPixels);
    for (int dy = -3; dy <= 3; ++dy) {
      for (int dx = -3; dx <= 3; ++dx) {
        const std::uint32_t number = numbers_[static_cast<std::size_t>(y + dy) * view_.width + x + dx];
        if (number == 0 || is_hole(number)) continue;
        const std::uint32_t* const t = frame_.indices.data() + std::size_t{3} * (number - 1);
        if (std::find(t, t + 3, vertex) != t + 3) return true;
      }
    }
    return false;
  }
  bool place(const SheetPoint& at, double half_width) {
    for (const auto& [other, half] : taken_) {
      if (std::abs(other.x - at.x) < half + half_width + 12 && std::abs(other.y - at.y) < kLabelSize + 14) {
        return false;
      }
    }
    taken_.emplace_back(at, half_width);
    return true;
  }

  void mark(Sheet& sheet, const std::array<std::uint32_t, 3>& triangle, bool split) {
    const auto [apex, left, right] = triangle;
    const auto at = [&](std::uint32_t vertex) {
      return on_sheet(project(position(vertex)).value_or(SheetPoint{}));
    };
    const auto width = static_cast<std::uint32_t>(frame_.grid.width);
    const std::uint32_t foot =
        (left / width + right / width) / 2 * width + (left % width + right % width) / 2;
    sheet.line(std::array{at(left), at(apex), at(right)}, {.colour = kMark, .thickness = 2.5});
    if (split)
      sheet.line(std::array{at(apex), at(foot)}, {.colour = kMark, .thickness = 2.5, .dashes = "7,5"});
    const SheetPoint words{(at(apex).x + at(left).x + at(foot).x) / 3,
                           (at(apex).y + at(left).y + at(foot).y) / 3};
    place({words.x, words.y - top_}, 10);
    sheet.text(words.x, words.y + 6, "T", 20, "middle", kMark);
  }

  void label_vertices(Sheet& sheet) {
    std::vector<std::pair<double, std::uint32_t>> vertices;  // the nearest first
    std::unordered_map<std::uint32_t, bool> known;
    for (const std::uint32_t v : frame_.indices) {
      if (!known.emplace(v, true).second) continue;
      vertices.emplace_back(glm::distance(position(v), view_.eye), v);
    }
    std::sort(vertices.begin(), vertices.end());
    for (const auto& [distance, vertex] : vertices) {
      const auto at = project(position(vertex));
      if (!at || !is_shown(vertex, *at)) continue;
      const std::string words = std::to_string(threshold(vertex));
      const double half = 4.0 * static_cast<double>(words.size()) + 2;
      if (!place(*at, half)) continue;
      const SheetPoint p = on_sheet(*at);
      sheet.box(p.x - half, p.y - 8, 2 * half, 16, kPaper);
      sheet.text(p.x, p.y + 4.5, words, kLabelSize, "middle", kInk);
    }
  }

  const Heightfield& ground_;
  Mrbsp& lod_;
  View view_;
  const Frame& frame_;
  Walls walls_;
  std::unique_ptr<GlContext> context_;
  std::vector<std::uint32_t> numbers_;  // of triangles, then of walls
  std::vector<std::pair<SheetPoint, double>> taken_;
  double top_ = 0;
};

std::vector<Case> cases(const RunOptions&) { return {Case{"real-257", Parameters(), "real-257"}}; }

void draw(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const TerrainSource source = recorder.terrain(open_ground(at.terrain, options.seed));
  const LodSheet drawn = lod_sheet(*source.heights, options, progress);
  for (const auto& [panel, numbers] : {std::pair{"without", drawn.without}, {"with", drawn.with}}) {
    recorder.add(fmt::format("hole_pixels_{}", panel), "px", numbers.hole_pixels);
    recorder.add(fmt::format("bare_pixels_{}", panel), "px", numbers.bare_pixels);
    recorder.add(fmt::format("triangles_{}", panel), "", numbers.triangles);
  }
  recorder.add("threshold_at_right_angle", "", drawn.threshold_at_right_angle);
  recorder.add("threshold_beside", "", drawn.threshold_beside);
  drawn.sheet.write(recorder.figure(
      "mrbsp.F1",
      "Figure 1 of the paper, on real mountains: triangles of level of detail, with thresholds at vertices, "
      "(a) without and (b) with the extra step. Pixels that look through a hole are magenta. "
      "The triangle marked T needs the extra step, since the threshold at its right angle alone is lower; "
      "in (b) it is drawn as two halves (dashed)."));
}

View lod_view(const Heightfield& ground, const Mrbsp& lod) {
  View view;
  view.width = kWidth * Sheet::kPixels;
  view.height = kHeight * Sheet::kPixels;
  view.vertical_fov = 0.6F;
  // Found by a search over random places and directions: a hole that is large and near.
  const float x = 0.356F * ground.extent_x(), z = 0.296F * ground.extent_z();
  view.eye = {x, ground.sample(x, z) + 2.3F * lod.short_side(), z};
  view.target = view.eye + glm::vec3(-0.29F, -0.275F, 0.96F);
  view.far = 2 * (ground.extent_x() + ground.extent_z());
  return view;
}

}  // namespace

LodSheet lod_sheet(const Heightfield& ground, const RunOptions& options, Progress& progress) {
  const int depth = depth_over(ground);
  Mrbsp without(ground, {.depth = depth, .holes = HoleRule::kNone}, progress);
  Mrbsp with(ground, {.depth = depth, .holes = HoleRule::kPrinted}, progress);
  without.tune(1);
  with.tune(1);
  const View view = lod_view(ground, with);
  LodPicture open(ground, without, view, options), closed(ground, with, view, options);
  LodSheet drawn{Sheet(kWidth, 2 * (kTitle + kHeight)), open.numbers(), closed.numbers()};
  const auto marked = open.culprit();
  if (marked) {
    const auto [apex, left, right] = *marked;
    drawn.threshold_at_right_angle = open.threshold(apex);
    drawn.threshold_beside = std::min(open.threshold(left), open.threshold(right));
  }
  const auto title = [&](double top, std::string_view words, std::size_t pixels) {
    drawn.sheet.text(8, top + 21, fmt::format("{}: {} pixels show holes", words, format_count(pixels)), 15);
  };
  title(0, "(a) Without the extra step", drawn.without.hole_pixels);
  open.draw(drawn.sheet, kTitle, marked, false);
  title(kTitle + kHeight, "(b) With the extra step", drawn.with.hole_pixels);
  closed.draw(drawn.sheet, 2 * kTitle + kHeight, marked, true);
  return drawn;
}

extern const Experiment kLodFigure{
    "mrbsp.lod-figure", "Figure 1: a hole between levels, and the step that closes it", {}, cases, draw};

}  // namespace terrabench::mrbsp
