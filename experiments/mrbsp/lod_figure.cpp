// Figure 1: the triangles that level of detail draws, seen by its observer, with thresholds at the vertices
// and one triangle that the one-vertex rule splits.

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <unordered_map>

#include "experiments/experiment.h"
#include "experiments/mrbsp/figures.h"
#include "experiments/mrbsp/ground.h"
#include "renderers/frame_renderer.h"
#include "renderers/scene.h"

namespace terrabench::mrbsp {
namespace {

using figures::Sheet;
using figures::SheetPoint;

constexpr int kWidth = 960, kHeight = 540;  // units of the sheet
constexpr int kLabelSize = 12;
constexpr Rgb kPaper{255, 255, 255}, kInk{20, 20, 20}, kMark{204, 51, 17};

class LodFigure {
 public:
  LodFigure(const Heightfield& ground, Mrbsp& lod, const View& view)
      : lod_(lod), view_(view), clip_(world_to_clip(view)), frame_(lod.update(view)), ground_(ground) {}

  Sheet draw(const RunOptions& options) {
    const auto context = open_context(options.renderer, view_.width, view_.height);
    numbers_ = FrameRenderer(*context).triangle_numbers(frame_, view_);
    const HeightRange range = height_range(ground_);
    const TriangleMesh mesh = drawn_mesh();
    Scene scene;
    scene.lowest = range.lowest;
    scene.highest = range.highest;
    scene.meshes = {{.mesh = &mesh, .wire_width = 2}};
    const Image image = render_scene(*context, scene, view_);
    Sheet sheet(kWidth, kHeight);
    sheet.picture(0, 0, kWidth, kHeight, with_few_colours(image));
    mark_split(sheet);
    label_vertices(sheet);
    return sheet;
  }

 private:
  TriangleMesh drawn_mesh() const {
    TriangleMesh mesh;
    mesh.indices.assign(frame_.indices.begin(), frame_.indices.end());
    for (std::uint32_t v = 0; v < frame_.grid.heights.size(); ++v) mesh.positions.push_back(position(v));
    return mesh;
  }
  glm::vec3 position(std::uint32_t vertex) const {
    return vertex_position(frame_, frame_.batches[0], vertex);
  }
  int threshold(std::uint32_t vertex) const { return lod_.threshold(view_.eye, position(vertex)); }
  std::optional<SheetPoint> project(const glm::vec3& at) const {
    const glm::vec4 clip = clip_ * glm::vec4(at, 1);
    if (!(clip.w > view_.near)) return std::nullopt;
    const SheetPoint p{kWidth * (0.5 + 0.5 * clip.x / clip.w), kHeight * (0.5 - 0.5 * clip.y / clip.w)};
    if (p.x < 14 || p.y < 14 || p.x > kWidth - 14 || p.y > kHeight - 14) return std::nullopt;
    return p;
  }
  // Whether a pixel next to the vertex shows one of its triangles.
  bool is_shown(std::uint32_t vertex, const SheetPoint& at) const {
    const int x = static_cast<int>(at.x * Sheet::kPixels), y = static_cast<int>(at.y * Sheet::kPixels);
    for (int dy = -3; dy <= 3; ++dy) {
      for (int dx = -3; dx <= 3; ++dx) {
        const std::uint32_t number = numbers_[static_cast<std::size_t>(y + dy) * view_.width + x + dx];
        if (number == 0) continue;
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

  // Marks the largest triangle in the picture that the rule has split: its halves are consecutive in the
  // frame.
  void mark_split(Sheet& sheet) {
    std::array<SheetPoint, 4> best{};
    double largest = 0;
    for (std::size_t k = 0; k + 5 < frame_.indices.size(); k += 3) {
      const std::uint32_t* const a = frame_.indices.data() + k;
      const std::uint32_t* const b = a + 3;
      if (a[0] != b[0] || a[1] != b[2]) continue;
      const std::uint32_t foot = a[0], apex = a[1], left = a[2], right = b[1];
      if (threshold(apex) >= std::min(threshold(left), threshold(right))) continue;
      const std::array vertices{apex, left, right, foot};
      std::array<SheetPoint, 4> corners{};
      bool shown = true;
      for (std::size_t c = 0; c < 4 && shown; ++c) {
        const auto at = project(position(vertices[c]));
        shown = at && is_shown(vertices[c], *at);
        if (shown) corners[c] = *at;
      }
      const double area = std::abs((corners[1].x - corners[0].x) * (corners[2].y - corners[0].y) -
                                   (corners[2].x - corners[0].x) * (corners[1].y - corners[0].y));
      if (!shown || area <= largest) continue;
      largest = area;
      best = corners;
    }
    if (largest == 0) return;
    sheet.line(std::array{best[0], best[1], best[2], best[0]}, {.colour = kMark, .thickness = 2.5});
    sheet.line(std::array{best[0], best[3]}, {.colour = kMark, .thickness = 2.5, .dashes = "7,5"});
    const SheetPoint middle{(best[0].x + best[1].x + best[3].x) / 3, (best[0].y + best[1].y + best[3].y) / 3};
    place(middle, 10);
    sheet.text(middle.x, middle.y + 6, "T", 20, "middle", kMark);
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
      sheet.box(at->x - half, at->y - 8, 2 * half, 16, kPaper);
      sheet.text(at->x, at->y + 4.5, words, kLabelSize, "middle", kInk);
    }
  }

  Mrbsp& lod_;
  View view_;
  glm::mat4 clip_;
  const Frame& frame_;
  const Heightfield& ground_;
  std::vector<std::uint32_t> numbers_;
  std::vector<std::pair<SheetPoint, double>> taken_;
};

std::vector<Case> cases(const RunOptions&) { return {Case{"real-257", Parameters(), "real-257"}}; }

void draw(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const TerrainSource source = recorder.terrain(open_ground(at.terrain, options.seed));
  const Heightfield& ground = *source.heights;
  Mrbsp lod(ground, {.depth = depth_over(ground), .conforming = false}, progress);
  const View view = lod_view(ground, lod);
  recorder.add("triangles", "", lod.update(view).stats.triangles);
  lod_sheet(ground, lod, view, options)
      .write(recorder.figure("mrbsp.F1", "png",
                             "Figure 1 of the paper, on real mountains: the triangles of level of detail, "
                             "with the threshold at each vertex that has room for it; T is a triangle that "
                             "the one-vertex rule splits (dashed) because the vertex at its right angle "
                             "alone has a lower threshold"));
}

}  // namespace

View lod_view(const Heightfield& ground, const Mrbsp& lod) {
  View view;
  view.width = kWidth * Sheet::kPixels;
  view.height = kHeight * Sheet::kPixels;
  view.vertical_fov = 0.6F;
  const float x = 0.35F * ground.extent_x(), z = 0.62F * ground.extent_z();
  view.eye = {x, ground.sample(x, z) + 5 * lod.short_side(), z};
  view.target = view.eye + glm::vec3(0.75F, -0.32F, -0.66F);
  view.far = 2 * (ground.extent_x() + ground.extent_z());
  return view;
}

Sheet lod_sheet(const Heightfield& ground, Mrbsp& lod, const View& view, const RunOptions& options) {
  return LodFigure(ground, lod, view).draw(options);
}

extern const Experiment kLodFigure{
    "mrbsp.lod-figure", "Figure 1: thresholds at the vertices", {}, cases, draw};

}  // namespace terrabench::mrbsp
