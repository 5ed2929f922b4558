// The figures of "mrbsp": that they show what they say, read back from the pictures themselves. Each reading
// is also given a figure with wrong content, which it must refuse.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <set>

#include "experiments/mrbsp/figures.h"
#include "experiments/mrbsp/ground.h"
#include "terrain/sources/drawing/drawing.h"
#include "tests/experiments/sheet_reader.h"

namespace terrabench::mrbsp {
namespace {

using visibility::Mode;

std::vector<ProfileStep> steps_of(std::span<const float> profile, Mode mode) {
  Progress progress;
  const Heightfield strip = extrude(profile);
  return profile_steps(strip, find_changes(strip, mode, progress), progress);
}

// The texts on a line of the sheet, from left to right.
std::vector<std::string> line_at(const SheetReader& shown, double y) {
  std::vector<SheetReader::Words> on_line;
  for (const SheetReader::Words& w : shown.words) {
    if (std::abs(w.y - y) < 0.5) on_line.push_back(w);
  }
  std::ranges::sort(on_line, {}, &SheetReader::Words::x);
  std::vector<std::string> texts;
  for (const SheetReader::Words& w : on_line) texts.push_back(w.text);
  return texts;
}
// Of the highest place with this text; -1 for none.
double height_of(const SheetReader& shown, std::string_view text) {
  double highest = -1;
  for (const SheetReader::Words& w : shown.words) {
    if (w.text == text && (highest < 0 || w.y < highest)) highest = w.y;
  }
  return highest;
}

// Table 1: how many of the three printed steps the sheet does not show as printed, in both columns.
int table_faults(const SheetReader& shown) {
  static constexpr std::array<std::array<const char*, 3>, 3> kPrinted{
      {{"a-b", "11", "1100, 1101, 1110, 1111"},
       {"d-e", "00, 01, 10, 11", "0000, 0001, 0010, 0011, "},
       {"g-h", "00", "0000, 0001, 0010, 0011"}}};
  int faults = 0;
  for (const auto& [step, coarse, fine] : kPrinted) {
    const std::vector<std::string> row = line_at(shown, height_of(shown, step));
    faults += row.size() != 5 || row[0] != step || row[1] != coarse || row[2] != coarse ||
              !row[3].starts_with(fine) || !row[4].starts_with(fine);
  }
  // No further step.
  for (const SheetReader::Words& w : shown.words) {
    faults += w.text.size() == 3 && w.text[1] == '-' && w.text != "a-b" && w.text != "d-e" && w.text != "g-h";
  }
  return faults;
}

TEST(MrbspFigures, Table1HasThePrintedRowsBesideTheComputed) {
  const SheetReader shown(table_sheet(table1(), steps_of(table1_profile(), Mode::kFacing)));
  EXPECT_EQ(table_faults(shown), 0);
  EXPECT_EQ(shown.fault_of_panels(declared_panels("mrbsp.T1")), "");
  EXPECT_GT(table_faults(SheetReader(table_sheet(table1(), steps_of(table1_profile(), Mode::kSampled)))), 0);
  std::vector<float> low(table1_profile().begin(), table1_profile().end());
  low.front() = low.back() = 8.5F;
  EXPECT_GT(table_faults(SheetReader(table_sheet(table1(), steps_of(low, Mode::kFacing)))), 0);
}

bool is_dark(const Rgb& c) { return c[0] < 150; }

// Figure 2: labels, cells and profile that are not as table 1 and the profile say.
int profile_faults(const SheetReader& shown, std::span<const float> profile) {
  int faults = 0;
  const auto labels = [](int digits) {
    std::vector<std::string> all;
    for (int k = 0; k < 1 << digits; ++k) {
      std::string text;
      for (int d = digits - 1; d >= 0; --d) text += (k >> d & 1) != 0 ? '1' : '0';
      all.push_back(text);
    }
    return all;
  };
  for (const int digits : {kFineDigits, kCoarseDigits}) {
    std::vector<std::string> row =
        line_at(shown, height_of(shown, digits == kFineDigits ? "fine" : "coarse"));
    if (!row.empty()) row.erase(row.begin());  // the row's name
    faults += row != labels(digits);
  }
  // The changes under the borders of cells, at the right place.
  const double changes = height_of(shown, "changes");
  faults += line_at(shown, changes) != std::vector<std::string>{"changes", "11", "00, 01, 10, 11", "00"};
  // Cells next to a change are dark.
  std::vector<SheetReader::Words> cells;
  for (const SheetReader::Words& w : shown.words) {
    if (w.text.size() == 1 && w.text[0] >= 'a' && w.text[0] <= 'h') cells.push_back(w);
  }
  if (cells.size() != 8) return faults + 1;
  const double side = cells[1].x - cells[0].x;
  for (const SheetReader::Words& cell : cells) {
    const SheetReader::Picture box{cell.x - side / 2, cell.y - 20, side, 30};
    faults += is_dark(shown.pixel(box, 0.1, 0.5)) != (cell.text != "c" && cell.text != "f");
  }
  // A fine tick stands at the height of each point: heights are read from the axis.
  const double zero = height_of(shown, "0") - 4, ten = height_of(shown, "10") - 4;
  const double left = cells[0].x - side / 2;
  for (std::size_t k = 0; k < profile.size(); ++k) {
    const double x = left + 8 * side * static_cast<double>(k) / static_cast<double>(profile.size() - 1);
    const SheetReader::Picture at{x - 1, zero + (ten - zero) * profile[k] / 10 - 1, 2, 2};
    bool inked = false;
    for (const double across : {0.25, 0.5, 0.75}) inked |= shown.pixel(at, across, 0.5)[0] < 100;
    faults += !inked;
  }
  return faults;
}

TEST(MrbspFigures, Figure2ShowsTheProfileItsNumbersAndTheCellsThatChange) {
  const std::vector<ProfileStep> steps = steps_of(table1_profile(), Mode::kFacing);
  const ProfileSheet drawn = profile_sheet(table1_profile(), steps);
  EXPECT_EQ(drawn.fine_segments, 16);
  EXPECT_EQ(drawn.coarse_segments, 4);
  EXPECT_EQ(drawn.cells, 8);
  EXPECT_EQ(drawn.dark_cells, 6);
  const SheetReader shown(drawn.sheet);
  EXPECT_EQ(profile_faults(shown, table1_profile()), 0);
  EXPECT_EQ(shown.fault_of_panels(declared_panels("mrbsp.F2")), "");
  std::vector<float> other(table1_profile().begin(), table1_profile().end());
  other[6] += 2;
  EXPECT_GT(profile_faults(SheetReader(profile_sheet(other, steps).sheet), table1_profile()), 0);
  const std::vector<ProfileStep> none(steps.size());
  const ProfileSheet unchanging = profile_sheet(table1_profile(), none);
  EXPECT_EQ(unchanging.dark_cells, 0);
  EXPECT_GT(profile_faults(SheetReader(unchanging.sheet), table1_profile()), 0);
}

struct LodReading {
  int labels = 0, wrong = 0;       // numbers, and those that no vertex at their place has as its threshold
  std::set<std::string> distinct;  // numbers
  int marked = 0;                  // T lies in a triangle that needs the extra step
  std::size_t painted = 0;         // pixels in the colour of holes
};

// A panel of figure 1 against the formula of section 3, worked out here for the vertices of the frame.
LodReading read_lod(const SheetReader& shown, const SheetReader::Picture& panel, const Heightfield& ground,
                    const Frame& frame, const View& view, double short_side) {
  const glm::mat4 clip = world_to_clip(view);
  const auto world = [&](std::uint32_t v) {
    return glm::vec3(static_cast<float>(v % ground.width) * ground.cell_x, ground.heights[v],
                     static_cast<float>(v / ground.width) * ground.cell_z);
  };
  const auto place = [&](std::uint32_t v) {
    const glm::vec4 c = clip * glm::vec4(world(v), 1);
    if (c.w <= 0) return glm::dvec2(-1e9);
    return glm::dvec2(panel.x + panel.width * (0.5 + 0.5 * c.x / c.w),
                      panel.y + panel.height * (0.5 - 0.5 * c.y / c.w));
  };
  const auto threshold = [&](std::uint32_t v) {
    const double d = glm::distance(glm::dvec3(world(v)), glm::dvec3(view.eye));
    return std::clamp(static_cast<int>(std::ceil(16 - std::log2(d / short_side))), 1, 16);
  };
  const std::set<std::uint32_t> vertices(frame.indices.begin(), frame.indices.end());
  LodReading reading;
  for (const SheetReader::Words& w : shown.words) {
    if (w.y < panel.y || w.y > panel.y + panel.height) continue;
    if (w.text == "T") {
      for (std::size_t k = 0; k < frame.indices.size(); k += 3) {
        const std::uint32_t apex = frame.indices[k], left = frame.indices[k + 1],
                            right = frame.indices[k + 2];
        const auto width = static_cast<std::uint32_t>(ground.width);
        const std::uint32_t foot =
            (left / width + right / width) / 2 * width + (left % width + right % width) / 2;
        if (glm::distance((place(apex) + place(left) + place(foot)) / 3.0, {w.x, w.y - 6}) > 0.05) continue;
        reading.marked += threshold(apex) < std::min(threshold(left), threshold(right));
      }
      continue;
    }
    ++reading.labels;
    reading.distinct.insert(w.text);
    reading.wrong += std::ranges::none_of(vertices, [&](std::uint32_t v) {
      return glm::distance(place(v), {w.x, w.y - 4.5}) < 0.03 && std::to_string(threshold(v)) == w.text;
    });
  }
  constexpr int kPixels = figures::Sheet::kPixels;
  for (int y = 0; y < kPixels * panel.height; ++y) {
    for (int x = 0; x < kPixels * panel.width; ++x) {
      const Rgb seen =
          shown.image.pixel(static_cast<int>(kPixels * panel.x) + x, static_cast<int>(kPixels * panel.y) + y);
      reading.painted += std::abs(seen[0] - kHole[0]) + seen[1] + std::abs(seen[2] - kHole[2]) < 60;
    }
  }
  return reading;
}

TEST(MrbspFigures, Figure1ShowsAHoleAndTheStepThatClosesIt) {
  Progress progress;
  const TerrainSource source = open_ground("real-257", 1);
  const Heightfield& ground = *source.heights;
  Mrbsp open(ground, {.depth = kDepth, .holes = HoleRule::kNone}, progress);
  Mrbsp closed(ground, {.depth = kDepth, .holes = HoleRule::kPrinted}, progress);
  const View view = lod_view(ground, open);
  for (const double size : {1.0, 2.0}) {
    const LodSheet sheet = lod_sheet(ground, size, {}, progress);
    const SheetReader shown(sheet.sheet);
    EXPECT_EQ(shown.fault_of_panels(declared_panels("mrbsp.F1")), "");
    ASSERT_EQ(shown.pictures.size(), 2U);
    const LodReading without =
        read_lod(shown, shown.pictures[0], ground, open.update(view), view, open.short_side());
    if (size == 2) {  // planted: thresholds for another S
      EXPECT_GT(without.wrong, 10);
      continue;
    }
    EXPECT_GT(without.labels, 25);
    EXPECT_EQ(without.wrong, 0);
    EXPECT_GE(without.distinct.size(), 3U);
    EXPECT_EQ(without.marked, 1);
    EXPECT_GT(sheet.without.hole_pixels, 10000U);
    // Wires and labels lie over some of the painted pixels.
    EXPECT_GT(without.painted, sheet.without.hole_pixels * 8 / 10);
    EXPECT_LE(without.painted, sheet.without.hole_pixels);
    EXPECT_LE(sheet.without.hole_pixels,
              sheet.without.bare_pixels);  // the meter counts holes behind hills too
    EXPECT_GT(sheet.without.hole_pixels, sheet.without.bare_pixels * 8 / 10);
    const LodReading with =
        read_lod(shown, shown.pictures[1], ground, closed.update(view), view, closed.short_side());
    EXPECT_EQ(with.wrong, 0);
    EXPECT_EQ(with.painted, 0U);
    EXPECT_LT(sheet.without.triangles, sheet.with.triangles);
    EXPECT_EQ(sheet.threshold_beside, sheet.threshold_at_right_angle + 1);
    EXPECT_EQ(sheet.with.hole_pixels + sheet.with.bare_pixels, 0U);
  }
}

// Faults of a plot of apparent sizes: a triangle at depth M - log2(D/S) has legs that grow with the root of
// D, so their apparent length falls with the root; for areas it stays. Each label gives its points' slope.
int threshold_faults(const Plot& plot) {
  int faults = plot.series.size() != 2;
  for (std::size_t k = 0; k < plot.series.size(); ++k) {
    const std::vector<PlotPoint>& points = plot.series[k].points;
    if (points.size() < 8) return faults + 1;
    double sx = 0, sy = 0, sxx = 0, sxy = 0;  // least squares of the logarithms
    for (const PlotPoint& p : points) {
      const double x = std::log(p.x), y = std::log(p.y);
      sx += x, sy += y, sxx += x * x, sxy += x * y;
    }
    const auto n = static_cast<double>(points.size());
    const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
    faults += std::abs(slope - (k == 0 ? -0.5 : 0.0)) > 0.05;
    const std::string printed = fmt::format("slope {}{:.2f}", slope < -0.005 ? "−" : "", std::abs(slope));
    faults += !plot.series[k].label.ends_with(printed);
    faults += plot.series[k].label.starts_with("M − 2") != (k == 1);
  }
  return faults;
}

TEST(MrbspFigures, ThresholdsAreLabelledWithTheirSlopes) {
  Progress progress;
  Plot plot = threshold_plot(level_ground(1025), progress);
  EXPECT_EQ(threshold_faults(plot), 0);
  Plot exchanged = plot;
  std::swap(exchanged.series[0].points, exchanged.series[1].points);
  EXPECT_GT(threshold_faults(exchanged), 0);
  for (PlotPoint& p : plot.series[0].points) p.y = plot.series[1].points[0].y;
  EXPECT_GT(threshold_faults(plot), 0);
}

// The largest difference between the left panel and the drawing, in greys.
int drawing_fault(const SheetReader& shown, const Image& drawing) {
  int worst = 0;
  for (int j = 0; j < drawing.height; j += 3) {
    for (int i = 0; i < drawing.width; i += 3) {
      const Rgb seen =
          shown.pixel(shown.pictures.at(0), (i + 0.5) / drawing.width, (j + 0.5) / drawing.height);
      worst = std::max(worst, std::abs(seen[1] - drawing.pixel(i, j)[1]));
    }
  }
  return worst;
}

TEST(MrbspFigures, TheLandscapeStandsBesideItsDrawing) {
  constexpr int kGreys = 12;  // the file's palette may move a grey by some levels
  const Image drawing = example_drawing(129, 1);
  const Heightfield land = land_from_drawing(drawing, {.peak = 1600});
  const SheetReader shown(landscape_sheet(drawing, land, {}));
  ASSERT_EQ(shown.rows(), (std::vector<int>{2, 1}));  // the last is the colour key
  EXPECT_LE(drawing_fault(shown, drawing), kGreys);
  EXPECT_GT(drawing_fault(shown, example_drawing(129, 2)), kGreys);
  const float highest = height_range(land).highest;
  const std::string top = fmt::format("{:.0f}", highest), middle = fmt::format("{:.0f}", highest / 2),
                    across = fmt::format("land, {:.1f} km across, with the sea", land.extent_x() / 1000);
  for (const std::string& words : {std::string("0"), middle, top, across}) {
    EXPECT_GE(height_of(shown, words), 0) << words;
  }
  // The block shows relief: flat land of the same drawing looks different in the right panel alone.
  Heightfield flat = land;
  std::fill(flat.heights.begin(), flat.heights.end(), 1.0F);
  const SheetReader planted(landscape_sheet(drawing, flat, {}));
  const SheetReader::Picture& right = shown.pictures.at(1);
  int differing = 0;
  for (int j = 0; j < 50; ++j) {
    for (int i = 0; i < 50; ++i) {
      const Rgb a = shown.pixel(right, (i + 0.5) / 50, (j + 0.5) / 50),
                b = planted.pixel(right, (i + 0.5) / 50, (j + 0.5) / 50);
      differing += std::abs(a[1] - b[1]) > kGreys;
    }
  }
  EXPECT_GT(differing, 250);
  EXPECT_LT(height_of(planted, top), 0);
}

}  // namespace
}  // namespace terrabench::mrbsp
