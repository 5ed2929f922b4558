// Figures 1 to 10 of "ght": the generators of base terrain, step by step.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "experiments/figures/ground.h"
#include "experiments/figures/views.h"
#include "experiments/ght/figures.h"
#include "experiments/ght/stage_numbers.h"
#include "results/store/format.h"
#include "terrain/sources/fractal/diamond_square.h"
#include "terrain/sources/fractal/faults.h"
#include "terrain/sources/fractal/hills.h"
#include "terrain/sources/fractal/midpoint.h"

namespace terrabench::ght {
namespace {

using namespace figures;

constexpr Rgb kInk{20, 20, 24}, kSet{150, 150, 155}, kUnset{215, 215, 218}, kAccent{0, 90, 170},
    kSecond{190, 70, 20};
constexpr double kMargin = 28, kLabel = 26;
constexpr double kMark = 10;  // how far marks of points reach beyond the array

// Points of an array of `side` × `side` on the sheet.
struct ArrayPlace {
  double x, y, size;  // of the corner point, and of the whole array
  int side;
  SheetPoint at(double i, double j) const { return {x + size * i / (side - 1), y + size * j / (side - 1)}; }
  void make_panel(Sheet& sheet) const {
    sheet.panel(x - kMark, y - kMark, size + 2 * kMark, size + 2 * kMark);
  }
};

// Thin lines between the points.
void draw_grid(Sheet& sheet, const ArrayPlace& array) {
  constexpr Rgb kGrid{205, 205, 205};
  for (int k = 0; k < array.side; ++k) {
    sheet.stroke(array.at(k, 0), array.at(k, array.side - 1), kGrid, 1);
    sheet.stroke(array.at(0, k), array.at(array.side - 1, k), kGrid, 1);
  }
}

void label(Sheet& sheet, double x, double y, std::string_view words) {
  sheet.text(x, y, words, 15, "middle");
}

std::string height_text(float metres) {
  return fmt::format("{}{:.1f} m", metres < 0 ? "−" : "", std::abs(metres));
}

bool is_set(const Heightfield& field, int i, int j) { return !Heightfield::is_no_data(field.at(i, j)); }

// Lines from a point that a step has set to the points whose mean it took: the diagonal neighbours in a
// diamond step, the straight ones in a square step. Neighbours outside the array get no line. Returns their
// number.
int draw_origins(Sheet& sheet, const ArrayPlace& array, int i, int j, int half, bool diamond_step) {
  static constexpr std::array<std::pair<int, int>, 4> kDiagonal{{{-1, -1}, {1, -1}, {-1, 1}, {1, 1}}};
  static constexpr std::array<std::pair<int, int>, 4> kStraight{{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
  int lines = 0;
  for (const auto& [dx, dz] : diamond_step ? kDiagonal : kStraight) {
    const int x = i + dx * half, z = j + dz * half;
    if (x < 0 || z < 0 || x >= array.side || z >= array.side) continue;
    sheet.stroke(array.at(x, z), array.at(i, j), kAccent, 1.4);
    ++lines;
  }
  return lines;
}

// The array after `steps` steps: points set by the last one black, earlier ones grey, the rest small.
void draw_steps(Drawing& drawing, Sheet& sheet, const ArrayPlace& array,
                const fractal::DiamondSquareOptions& options, int steps) {
  const Heightfield now = fractal::diamond_square_after(options, steps);
  const Heightfield before = fractal::diamond_square_after(options, std::max(0, steps - 1));
  const int half = (options.side - 1) >> ((steps + 1) / 2);
  draw_grid(sheet, array);
  int lines = 0, black = 0;
  for (int j = 0; j < options.side; ++j) {
    for (int i = 0; i < options.side; ++i) {
      const bool fresh = steps > 0 && is_set(now, i, j) && !is_set(before, i, j);
      if (fresh) lines += draw_origins(sheet, array, i, j, half, steps % 2 == 1);
    }
  }
  for (int j = 0; j < options.side; ++j) {
    for (int i = 0; i < options.side; ++i) {
      const bool set = is_set(now, i, j), earlier = steps > 0 && is_set(before, i, j);
      sheet.dot(array.at(i, j), !set ? 2.5 : earlier ? 6 : 8, !set ? kUnset : earlier ? kSet : kInk);
      black += set && !earlier;
    }
  }
  drawing.record(fmt::format("black_{}", steps), black);
  drawing.record(fmt::format("lines_{}", steps), lines);
}

Sheet draw_midpoints(Drawing& drawing) {
  constexpr std::array kLevels{0, 1, 2, 3, 4, 9};
  constexpr double kWidth = 300, kHeight = 150;
  Sheet sheet(3 * kWidth + 4 * kMargin, 2 * (kHeight + kLabel) + 3 * kMargin);
  float most = 0;  // the last panel has the highest and the lowest point of all
  for (const float h : fractal::midpoint_displacement({.seed = drawing.seed(), .levels = kLevels.back()})) {
    most = std::max(most, std::abs(h));
  }
  std::vector<float> earlier;  // of the panel before
  for (std::size_t panel = 0; panel < kLevels.size(); ++panel) {
    const int levels = kLevels[panel];
    const double x0 = kMargin + static_cast<double>(panel % 3) * (kWidth + kMargin);
    const double y0 = kMargin + static_cast<double>(panel / 3) * (kHeight + kLabel + kMargin);
    const std::vector<float> heights =
        fractal::midpoint_displacement({.seed = drawing.seed(), .levels = levels});
    drawing.record(fmt::format("points_{}", levels), static_cast<double>(heights.size()));
    if (levels > 0) drawing.record(fmt::format("moved_{}", levels), moved_points(earlier, heights));
    earlier = heights;
    const auto place = [&](std::size_t i) {
      return SheetPoint{x0 + kWidth * static_cast<double>(i) / static_cast<double>(heights.size() - 1),
                        y0 + kHeight / 2 * (1 - heights[i] / most)};
    };
    std::vector<SheetPoint> points;
    for (std::size_t i = 0; i < heights.size(); ++i) points.push_back(place(i));
    sheet.panel(x0, y0, kWidth, kHeight);
    sheet.stroke({x0, y0 + kHeight / 2}, {x0 + kWidth, y0 + kHeight / 2}, kUnset, 1);
    sheet.line(points, {.colour = kInk, .thickness = levels < 6 ? 2 : 1.2, .dashes = {}});
    if (levels < 6) {
      for (std::size_t i = 0; i < points.size(); ++i) {
        const bool fresh = levels > 0 && i % 2 == 1;
        sheet.dot(points[i], fresh ? 4.5 : 3, fresh ? kAccent : kInk);
      }
    }
    label(sheet, x0 + kWidth / 2, y0 + kHeight + 26,
          levels == 0 ? "start" : fmt::format("{} step{}", levels, levels == 1 ? "" : "s"));
  }
  for (const int level : {7, 8, 9}) {
    drawing.record(fmt::format("displacement_{}", level), mean_displacement(earlier, level));
  }
  return sheet;
}

Sheet draw_neighbourhoods(Drawing& drawing) {
  constexpr double kSize = 220, kStep = kSize + 2.5 * kMargin;
  Sheet sheet(3 * kStep + kMargin, kSize + kLabel + 3 * kMargin);
  const auto array = [&](int panel) {
    return ArrayPlace{1.5 * kMargin + panel * kStep, 1.5 * kMargin, kSize, 5};
  };
  const auto outline = [&](const ArrayPlace& at, const Cells& corners, bool closed) {
    for (std::size_t k = 0; k + (closed ? 0 : 1) < corners.size(); ++k) {
      const auto& [i, j] = corners[k];
      const auto& [x, z] = corners[(k + 1) % corners.size()];
      sheet.stroke(at.at(i, j), at.at(x, z), kAccent, 2);
    }
    for (const auto& [i, j] : corners) sheet.dot(at.at(i, j), 7, kInk);
  };
  for (int panel = 0; panel < 3; ++panel) {
    draw_grid(sheet, array(panel));
    array(panel).make_panel(sheet);
  }
  const Cells square{{1, 1}, {3, 1}, {3, 3}, {1, 3}}, diamond{{2, 1}, {3, 2}, {2, 3}, {1, 2}};
  outline(array(0), square, true);
  sheet.ring(array(0).at(2, 2), 7, kInk, 2);
  outline(array(1), diamond, true);
  sheet.ring(array(1).at(2, 2), 7, kInk, 2);
  // The fourth corner of the diamond around (0, 2) stands one column inside the opposite border.
  const Cells west{{0, 1}, {1, 2}, {0, 3}}, east{{4, 1}, {3, 2}, {4, 3}};
  outline(array(2), west, false);
  outline(array(2), east, false);
  sheet.ring(array(2).at(0, 2), 7, kInk, 2);
  sheet.ring(array(2).at(4, 2), 7, kInk, 2);
  Cells both = west;
  both.insert(both.end(), east.begin(), east.end());
  drawing.record("square_corners", neighbours_among(square, {2, 2}, true));
  drawing.record("diamond_corners", neighbours_among(diamond, {2, 2}, false));
  drawing.record("circular_corners", neighbours_among(both, {0, 2}, false));
  int panel = 0;
  for (const char* const words : {"square", "diamond", "circular diamond"}) {
    label(sheet, array(panel).at(2, 0).x, array(panel).at(0, 4).y + kMargin + 12, words);
    ++panel;
  }
  return sheet;
}

Sheet draw_diamond_square_steps(Drawing& drawing) {
  constexpr double kSize = 200, kStepX = kSize + 2.5 * kMargin, kStepY = kSize + kLabel + 2 * kMargin;
  constexpr std::array kWords{"a) corners", "b) diamond step", "c) square step", "d) diamond step",
                              "e) square step"};
  Sheet sheet(3 * kStepX + kMargin, 2 * kStepY + kMargin);
  for (int steps = 0; steps <= 4; ++steps) {
    // Three above, two below them, centred.
    const double x = 1.5 * kMargin + (steps < 3 ? steps : steps - 2.5) * kStepX;
    const ArrayPlace array{x, kMargin + (steps < 3 ? 0 : kStepY), kSize, 5};
    draw_steps(drawing, sheet, array, {.seed = drawing.seed(), .side = 5}, steps);
    array.make_panel(sheet);
    label(sheet, x + kSize / 2, array.at(0, 4).y + kMargin + 8, kWords[static_cast<std::size_t>(steps)]);
  }
  return sheet;
}

Sheet draw_straddling_diamond(Drawing& drawing) {
  constexpr double kSize = 300;
  const fractal::DiamondSquareOptions options{.seed = drawing.seed(), .side = 5};
  const Heightfield field = fractal::diamond_square(options),
                    before = fractal::diamond_square_after(options, 3);
  drawing.record("height_west", field.at(0, 1));
  drawing.record("height_east", field.at(4, 1));
  const double mean =
      (static_cast<double>(before.at(0, 0)) + before.at(0, 2) + before.at(1, 1) + before.at(3, 1)) / 4;
  drawing.record("displacement", std::abs(field.at(0, 1) - mean));
  Sheet sheet(kSize + 10 * kMargin, kSize + 3 * kMargin);
  const ArrayPlace array{5 * kMargin, 1.5 * kMargin, kSize, 5};
  draw_grid(sheet, array);
  array.make_panel(sheet);
  for (const auto& [border, inside] : {std::pair{0, 1}, {4, 3}}) {
    sheet.stroke(array.at(border, 0), array.at(inside, 1), kAccent, 2);
    sheet.stroke(array.at(inside, 1), array.at(border, 2), kAccent, 2);
  }
  for (int j = 0; j < 5; ++j) {
    for (int i = 0; i < 5; ++i) {
      const bool set = is_set(before, i, j);
      sheet.dot(array.at(i, j), set ? 8 : 2.5, set ? kInk : kUnset);
    }
  }
  for (const int border : {0, 4}) {
    const SheetPoint at = array.at(border, 1);
    sheet.ring(at, 8, kInk, 2.5);
    const bool west = border == 0;
    sheet.text(at.x + (west ? -16 : 16), at.y + 5, height_text(field.at(border, 1)), 15,
               west ? "end" : "start");
  }
  return sheet;
}

Sheet draw_first_fault(Drawing& drawing) {
  constexpr int kSide = 13;
  constexpr double kSize = 330;
  const fractal::FaultOptions options{
      .seed = drawing.seed(), .width = kSide, .depth = kSide, .faults = 1, .step = 1};
  const fractal::FaultLine line = fractal::fault_lines(options)[0];
  const Heightfield field = fractal::fault_terrain(options);
  Sheet sheet(kSize + 4 * kMargin, kSize + kLabel + 4 * kMargin);
  const ArrayPlace array{2 * kMargin, 2 * kMargin, kSize, kSide};
  array.make_panel(sheet);
  int stars = 0, crosses = 0, wrong = 0;
  for (int j = 0; j < kSide; ++j) {
    for (int i = 0; i < kSide; ++i) {
      const bool rose = field.at(i, j) > 0;
      ++(rose ? stars : crosses);
      wrong += rose != (line.a * i + line.b * j > line.c);
      if (rose) {
        sheet.star(array.at(i, j), 6, kAccent);
      } else {
        sheet.cross(array.at(i, j), 5, kSecond);
      }
    }
  }
  drawing.record("stars", stars);
  drawing.record("crosses", crosses);
  drawing.record("wrong_side", wrong);
  drawing.record("heights", different(field.heights));
  // The line from border to border, half a cell around the array.
  constexpr double kLow = -0.5, kHigh = kSide - 0.5;
  std::vector<SheetPoint> ends;
  const auto a = static_cast<double>(line.a), b = static_cast<double>(line.b),
             c = static_cast<double>(line.c);
  for (const double edge : {kLow, kHigh}) {
    if (const double j = (c - a * edge) / b; b != 0 && j >= kLow && j <= kHigh)
      ends.push_back(array.at(edge, j));
    if (const double i = (c - b * edge) / a; a != 0 && i > kLow && i < kHigh)
      ends.push_back(array.at(i, edge));
  }
  if (ends.size() >= 2) sheet.stroke(ends[0], ends[1], kInk, 2.5);
  label(sheet, array.at((kSide - 1) / 2.0, 0).x, array.at(0, kSide - 1).y + 2 * kMargin,
        "× height decreased,  ✱ height increased");
  return sheet;
}

Sheet draw_fault_maps(Drawing& drawing) {
  constexpr int kSide = 257;
  std::vector<Panel> panels;
  for (const int faults : {1, 4, 16, 64, 256, 1024}) {
    const Heightfield field =
        fractal::fault_terrain({.seed = drawing.seed(), .width = kSide, .depth = kSide, .faults = faults});
    panels.push_back({heightmap_image(field),
                      fmt::format("{} iteration{}", format_number(faults), faults == 1 ? "" : "s"), 1});
    const std::vector<std::uint8_t>& greys = panels.back().image.rgb;
    drawing.record(fmt::format("greys_{}", faults), different(greys));
  }
  // Framed, as white is a height too.
  return panel_sheet(in_rows_of(3, std::move(panels)),
                     {.margin = kMargin, .words = kLabel, .baseline = 20, .text_size = 15, .frame = kSet});
}

Sheet draw_heightmap_and_wireframe(Drawing& drawing) {
  const Heightfield field = fractal::diamond_square(
      {.seed = drawing.seed(), .side = 129, .cell = 30, .amplitude = 800, .hurst = 0.9F});
  const Look look{.width = 1120, .height = 774};
  const Image map = heightmap_image(field);
  const TriangleMesh wires = ground_mesh(every_other(field));
  drawing.record("greys", different(map.rgb));
  drawing.record("correlation", correlation(map, wires, field.cell_x));
  return panel_sheet({{{map, "heightmap, 129 × 129", 3},
                       {wire_view(drawing.gl(), wires, look, 1.2F), "wireframe, every other sample"}}},
                     kSpaceStyle);
}

Sheet draw_diamond_square_terrains(Drawing& drawing) {
  std::vector<Panel> panels;
  Heightfield earlier = Heightfield::zeros(1, 1);
  for (int n = 1; n <= 6; ++n) {
    const int side = (1 << n) + 1;
    const Heightfield field = fractal::diamond_square({.seed = drawing.seed(),
                                                       .side = side,
                                                       .cell = 3840.0F / static_cast<float>(side - 1),
                                                       .amplitude = 900,
                                                       .hurst = 0.9F});
    const Look look{.width = 660, .height = 460};
    const TriangleMesh mesh = ground_mesh(field);
    drawing.record(fmt::format("points_{}", n), static_cast<double>(mesh.positions.size()));
    if (n > 1)
      drawing.record(fmt::format("moved_{}", n), moved_points(earlier.heights, every_other(field).heights));
    earlier = field;
    panels.push_back({wire_view(drawing.gl(), mesh, look, n < 5 ? 2 : 1.2F),
                      fmt::format("{} iteration{}: {} × {}", n, n == 1 ? "" : "s", side, side)});
  }
  return panel_sheet(in_rows_of(3, std::move(panels)), kSpaceStyle);
}

Sheet draw_hills_one_and_many(Drawing& drawing) {
  fractal::HillOptions options{
      .seed = drawing.seed(), .width = 65, .depth = 65, .cell = 1, .hills = 60, .scale = 0.05F};
  options.least_radius = 5;
  options.most_radius = 17;
  const auto view = [&](const Heightfield& field) {
    return wire_view(drawing.gl(), ground_mesh(field), {.width = 1000, .height = 660}, 1.4F);
  };
  const Heightfield one = fractal::raise_hills(options, {{32, 32, 19}}),
                    many = fractal::hill_terrain(options);
  double tallest = 0;
  for (const fractal::Hill& hill : fractal::draw_hills(options))
    tallest = std::max<double>(tallest, options.scale * hill.radius * hill.radius);
  drawing.record("peak", height_range(one).highest);
  drawing.record("foot", raised_within(one, 32, 32));
  drawing.record("tallest_of_many", tallest);
  drawing.record("highest_of_many", height_range(many).highest);
  return panel_sheet({{{view(one), "one hill"}, {view(many), "60 hills"}}}, kSpaceStyle);
}

constexpr std::array<figures::Figure, 10> kFigures{{
    {1, "F1", "a terrain as heightmap (black low, white high) and as wireframe seen from the south-east",
     draw_heightmap_and_wireframe},
    {2, "F2", "a triangulated irregular network of real mountains, in plan (north up) and in space",
     draw_network},
    {3, "F3",
     "midpoint displacement of a line; the points that each step adds are blue, and its range is half of the "
     "one before",
     draw_midpoints},
    {4, "F4",
     "the four points of a square, of a diamond, and of a diamond that straddles the border; rings are the "
     "points that take their mean",
     draw_neighbourhoods},
    {5, "F5",
     "diamond-square on an array of 5 × 5; points that the step sets are black, earlier ones grey, and lines "
     "lead to the points whose mean they take",
     draw_diamond_square_steps},
    {6, "F6",
     "the diamond that straddles the border of the array gives its value to a point on either side (rings, "
     "with the height that each received)",
     draw_straddling_diamond},
    {7, "F7", "one terrain after 1 to 6 iterations of diamond-square", draw_diamond_square_terrains},
    {8, "F8",
     "the first fault divides the height field; points on its one side rise (stars), those on the other sink "
     "(crosses)",
     draw_first_fault},
    {9, "F9",
     "the height map as the number of faults grows; black is each map's lowest point, white its highest",
     draw_fault_maps},
    {10, "F10", "an isolated hill, and the terrain after 60 of them; heights are (r² − d²) / 20",
     draw_hills_one_and_many},
}};

}  // namespace

extern const Experiment kStages =
    figures::figure_experiment<kFigures>("ght.stages", "Figures 1 and 3-10: the generators, step by step");

}  // namespace terrabench::ght
