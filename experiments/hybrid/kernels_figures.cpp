// Figures 1 and 2 of "hybrid": the sphere and the cube kernel, on an arch of blocks.
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>

#include "experiments/figures/figure.h"
#include "experiments/figures/maps.h"
#include "experiments/figures/views.h"
#include "experiments/hybrid/pixels.h"
#include "representations/implicit/implicit_surface.h"

namespace terrabench::hybrid {
namespace {

using namespace figures;

constexpr int kWidth = 48, kHeight = 30, kDepth = 20;  // metres; blocks are 1 m
constexpr double kRadius = 3;                          // metres
constexpr Rgb kInk{20, 20, 24}, kSupport{0, 90, 170};

// Level ground 8 m high, with an arch over it.
TerrainSource arch() {
  TerrainSource source;
  source.name = "arch";
  source.solid =
      Solid{{{0, 0, 0}, {kWidth, kHeight, kDepth}}, "", [](const ColumnSamples& at, std::span<Material> out) {
              for (std::size_t k = 0; k < out.size(); ++k) {
                const float y = at.y0 + static_cast<float>(k) * at.dy;
                const float around = std::hypot(at.x - 26, y - 8);
                const bool bow = around > 9 && around < 15.5F && std::abs(at.z - 10) < 4;
                out[k] = y < 8 || bow ? Material::kBedrock : Material::kAir;
              }
            }};
  return source;
}

std::unique_ptr<ImplicitSurface> smoothed(Kernel kernel) {
  Progress progress;
  const Parameters parameters(ImplicitSurface::parameters(),
                              {{"resolution", std::int64_t{kWidth}},
                               {"kernel", std::string(kKernelNames[static_cast<std::size_t>(kernel)])},
                               {"radius", kRadius},
                               {"cell", 0.5}});
  return ImplicitSurface::build_surface(arch(), parameters, progress);
}

// A point whose support is full, half full or empty, and one between; where its words stand in the section.
struct Marked {
  const char* name;
  glm::vec3 at;
  double words_x, words_y;
};
constexpr std::array<Marked, 4> kMarked{{{"A", {5, 4, 10}, 11.6, 4},
                                         {"B", {5, 8, 10}, 5, 12.2},
                                         {"C", {26, 13, 10}, 26, 9},
                                         {"D", {26, 22, 10}, 26, 26.2}}};

std::string value_text(float value) {
  if (value == 0) return "0";
  if (std::abs(value) == 1) return value > 0 ? "+1" : "−1";
  return fmt::format("{}{:.2f}", value > 0 ? "+" : "−", std::abs(value));
}

// The border of the support around p: the cube's edges, or three great circles.
void add_support(Scene& scene, Kernel kernel, glm::vec3 p) {
  const auto r = static_cast<float>(kRadius);
  if (kernel == Kernel::kSphere) {
    for (int axis = 0; axis < 3; ++axis) {
      SceneLine circle{{}, kSupport, 2.5F};
      for (int k = 0; k <= 72; ++k) {
        const float turn = static_cast<float>(k) / 72 * 2 * std::numbers::pi_v<float>;
        glm::vec3 offset(0);
        offset[(axis + 1) % 3] = r * std::cos(turn);
        offset[(axis + 2) % 3] = r * std::sin(turn);
        circle.points.push_back(p + offset);
      }
      scene.lines.push_back(circle);
    }
    return;
  }
  for (int corner = 0; corner < 8; ++corner) {
    for (int axis = 0; axis < 3; ++axis) {
      if ((corner >> axis & 1) != 0) continue;
      const auto place = [&](int c) {
        return p + r * glm::vec3((c & 1) * 2 - 1, (c >> 1 & 1) * 2 - 1, (c >> 2) * 2 - 1);
      };
      scene.lines.push_back({{place(corner), place(corner | 1 << axis)}, kSupport, 2.5F});
    }
  }
}

Look look() {
  Look from;
  from.from = {0.35F, 0.35F, 1.0F};
  from.width = 760;
  from.height = 560;
  return from;
}

// The field in the plane z = 10 m.
Image section(const ImplicitSurface& surface, int pixels_per_metre) {
  Image image(kWidth * pixels_per_metre, kHeight * pixels_per_metre, {255, 255, 255});
  std::vector<float> values(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  std::vector<float> y(static_cast<std::size_t>(image.height));
  for (int k = 0; k < image.height; ++k) {
    y[static_cast<std::size_t>(k)] = (static_cast<float>(k) + 0.5F) / static_cast<float>(pixels_per_metre);
  }
  tbb::parallel_for(0, image.width, [&](int i) {
    surface.field().line((i + 0.5) / pixels_per_metre, kDepth / 2.0, y,
                         std::span(values).subspan(static_cast<std::size_t>(i) * y.size(), y.size()));
  });
  for (int i = 0; i < image.width; ++i) {
    for (int k = 0; k < image.height; ++k) {
      const float value = values[static_cast<std::size_t>(i) * y.size() + static_cast<std::size_t>(k)];
      image.set(i, image.height - 1 - k, difference_colour((value + 1) / 2));
    }
  }
  return image;
}

// The share of the section's pixels in the colours of 1 and -1.
double full_or_empty(const Image& section) {
  const Rgb full = difference_colour(1), empty = difference_colour(0);
  return mean_over(section, {},
                   [&](const Rgb& pixel) { return pixel == full || pixel == empty ? 1.0 : 0.0; });
}

// The outlines of the solid blocks and of the surface's section, as strokes on the sheet.
void draw_outlines(Sheet& sheet, const ImplicitSurface& surface, const auto& place) {
  const auto solid = [&](int i, int k) {
    const float x = static_cast<float>(i) + 0.5F, y = static_cast<float>(k) + 0.5F, z = kDepth / 2.0F - 0.5F;
    Material material = Material::kAir;
    surface.stack().materials({std::span(&x, 1), std::span(&y, 1), std::span(&z, 1)},
                              std::span(&material, 1));
    return material != Material::kAir;
  };
  constexpr Rgb kBlock{110, 110, 116};
  for (int k = 0; k < kHeight; ++k) {
    for (int i = 0; i < kWidth; ++i) {
      if (i + 1 < kWidth && solid(i, k) != solid(i + 1, k)) {
        sheet.stroke(place(i + 1, k), place(i + 1, k + 1), kBlock, 1);
      }
      if (k + 1 < kHeight && solid(i, k) != solid(i, k + 1)) {
        sheet.stroke(place(i, k + 1), place(i + 1, k + 1), kBlock, 1);
      }
    }
  }
  // Where the surface's triangles cross the plane.
  const TriangleMesh mesh = surface.mesh({});
  const float z = kDepth / 2.0F + 0.01F;
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
    std::vector<glm::vec3> ends;
    for (std::size_t e = 0; e < 3; ++e) {
      const glm::vec3 a = mesh.positions[mesh.indices[t + e]],
                      b = mesh.positions[mesh.indices[t + (e + 1) % 3]];
      if ((a.z < z) != (b.z < z)) ends.push_back(a + (z - a.z) / (b.z - a.z) * (b - a));
    }
    const auto wall = [](glm::vec3 p) { return p.x == 0 || p.x == kWidth || p.y == 0; };
    if (ends.size() == 2 && !(wall(ends[0]) && wall(ends[1]))) {
      sheet.stroke(place(ends[0].x, ends[0].y), place(ends[1].x, ends[1].y), kInk, 2);
    }
  }
}

void draw_marks(Sheet& sheet, Kernel kernel, const ImplicitSurface& surface, const auto& place) {
  for (const Marked& mark : kMarked) {
    const double x = mark.at.x, y = mark.at.y;
    std::vector<SheetPoint> outline;
    if (kernel == Kernel::kCube) {
      for (const auto& [dx, dy] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, -1}}) {
        outline.push_back(place(x + dx * kRadius, y + dy * kRadius));
      }
    } else {
      for (int k = 0; k <= 72; ++k) {
        const double turn = k / 36.0 * std::numbers::pi;
        outline.push_back(place(x + kRadius * std::cos(turn), y + kRadius * std::sin(turn)));
      }
    }
    sheet.line(outline, {.colour = {255, 255, 255}, .thickness = 3, .opacity = 0.85});
    sheet.line(outline, {.colour = kInk, .thickness = 1.6, .dashes = "5 3"});
    sheet.dot(place(x, y), 4.6, {255, 255, 255});
    sheet.dot(place(x, y), 3.2, kInk);
    const SheetPoint words = place(mark.words_x, mark.words_y);
    constexpr double kHalfWidth = 43;
    sheet.box(words.x - kHalfWidth, words.y - 9, 2 * kHalfWidth, 18, {255, 255, 255});
    sheet.text(words.x, words.y + 5,
               fmt::format("{}: f = {}", mark.name, value_text(surface.field().at(mark.at))), 13, "middle");
  }
}

Sheet draw_kernel(Drawing& drawing, Kernel kernel) {
  const std::unique_ptr<ImplicitSurface> surface = smoothed(kernel);
  constexpr double kGap = 16, kTitle = 26, kView = 380, kViewHeight = 280, kScale = 14;
  constexpr double kSectionWidth = kWidth * kScale, kSectionHeight = kHeight * kScale;
  Sheet sheet(kView + kSectionWidth + 3 * kGap, 2 * (kViewHeight + kTitle) + 2 * kGap);
  const auto view = [&](double y, std::string_view words, const Image& image) {
    sheet.text(kGap, y - 8, words, 14);
    sheet.picture(kGap, y, kView, kViewHeight, image);
  };
  Scene before, after;
  const TriangleMesh stacks = surface->stack().mesh({}), mesh = surface->mesh({});
  SceneMesh& item = before.meshes.emplace_back(rock(stacks));
  item.wire_width = 0.8F;
  item.wire_opacity = 0.5F;
  item.wires = quad_wires(stacks);
  add_support(before, kernel, {26, 22, 14});
  after.meshes.push_back(rock(mesh));
  const View from = look().at(bounds_of(stacks));
  view(kTitle, "a) Stacks of 1 m blocks, and the support of a point",
       render_scene(drawing.gl(), before, from));
  view(2 * kTitle + kViewHeight + kGap / 2, "b) The surface f = 0", render_scene(drawing.gl(), after, from));

  const double x0 = kView + 2 * kGap, y0 = kTitle;
  sheet.text(x0, y0 - 8, "c) Section through the middle: the field f, and f = 0 (black line)", 14);
  const Image field = section(*surface, 14);
  drawing.record("full_or_empty", full_or_empty(field));
  for (const Marked& mark : kMarked)
    drawing.record(fmt::format("field_{}", mark.name), surface->field().at(mark.at));
  sheet.picture(x0, y0, kSectionWidth, kSectionHeight, field);
  const auto place = [&](double x, double y) {
    return SheetPoint{x0 + x * kScale, y0 + (kHeight - y) * kScale};
  };
  draw_outlines(sheet, *surface, place);
  draw_marks(sheet, kernel, *surface, place);
  const double key = y0 + kSectionHeight + 26;
  add_colour_key(sheet, x0, key, "field f", 60, 240, difference_colour, {"−1: air", "0", "+1: solid"});
  sheet.stroke({x0, key + 62}, {x0 + 10 * kScale, key + 62}, kInk, 2);
  sheet.text(x0 + 10 * kScale + 8, key + 67,
             fmt::format("10 m; dashed: supports of radius σ = {} m", kRadius), 13);
  sheet.text(x0, key + 97, "A: full support. B: half full, since ground and air", 13);
  sheet.text(x0, key + 115, "meet in a plane through it. C: empty. D: in the arch.", 13);
  return sheet;
}

constexpr auto kFigures = std::to_array<Figure>({
    {1, "F1", "the sphere kernel on an arch; the field is +1 in full support, 0 in half-full and −1 in empty",
     [](Drawing& drawing) { return draw_kernel(drawing, Kernel::kSphere); }},
    {2, "F2",
     "the cube kernel on the same arch; it contains the sphere, so that fewer points have full or empty "
     "support",
     [](Drawing& drawing) { return draw_kernel(drawing, Kernel::kCube); }},
});

}  // namespace

extern const Experiment kKernels =
    figures::figure_experiment<kFigures>("hybrid.kernels", "Figures 1 and 2: the kernels");

}  // namespace terrabench::hybrid
