// The figures of "mrbsp": the numbers that claims read from them, and table 1 read back from its sheet.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "experiments/mrbsp/figures.h"
#include "experiments/mrbsp/ground.h"
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

TEST(MrbspFigures, Figure2DarkensTheCellsThatChange) {
  const std::vector<ProfileStep> steps = steps_of(table1_profile(), Mode::kFacing);
  const ProfileSheet drawn = profile_sheet(table1_profile(), steps);
  EXPECT_EQ(drawn.fine_segments, 16);
  EXPECT_EQ(drawn.coarse_segments, 4);
  EXPECT_EQ(drawn.cells, 8);
  EXPECT_EQ(drawn.dark_cells, 6);
  EXPECT_EQ(SheetReader(drawn.sheet).fault_of_panels(declared_panels("mrbsp.F2")), "");
  EXPECT_EQ(profile_sheet(table1_profile(), std::vector<ProfileStep>(steps.size())).dark_cells, 0);
}

TEST(MrbspFigures, Figure1ShowsAHoleAndTheStepThatClosesIt) {
  Progress progress;
  const TerrainSource source = open_ground("real-257", 1);
  const LodSheet drawn = lod_sheet(*source.heights, {}, progress);
  EXPECT_EQ(SheetReader(drawn.sheet).fault_of_panels(declared_panels("mrbsp.F1")), "");
  EXPECT_GT(drawn.without.hole_pixels, 10000U);
  EXPECT_LE(drawn.without.hole_pixels, drawn.without.bare_pixels)
      << "the meter counts holes behind hills too";
  EXPECT_GT(drawn.without.hole_pixels, drawn.without.bare_pixels * 8 / 10);
  EXPECT_LT(drawn.without.triangles, drawn.with.triangles);
  EXPECT_EQ(drawn.threshold_beside, drawn.threshold_at_right_angle + 1);
  EXPECT_EQ(drawn.with.hole_pixels + drawn.with.bare_pixels, 0U);
}

}  // namespace
}  // namespace terrabench::mrbsp
