// The figures of "drill": that they show what they say, read back from the pictures themselves. For each, a
// figure with other content must be found out.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "experiments/drill/analysis.h"
#include "experiments/drill/figures.h"
#include "experiments/drill/ground.h"
#include "experiments/figures/maps.h"
#include "representations/drill/cross_sections.h"
#include "representations/drill/profile_fit.h"
#include "representations/drill/regenerate.h"
#include "terrain/hydrology/channels.h"
#include "tests/experiments/sheet_reader.h"
#include "tests/experiments/value.h"

namespace terrabench::drill {
namespace {

// A ground of hills, and its mirror image: the same heights in other places.
struct Grounds {
  Heightfield one = crop(noise_hills(110, 3), 0, 0, 110, 90), other = one;
  FlowNetwork network, other_network;
  Grounds() {
    for (int j = 0; j < one.depth; ++j) {
      for (int i = 0; i < one.width; ++i) other.at(i, j) = one.at(one.width - 1 - i, j);
    }
    network = route_flow(one);
    other_network = route_flow(other);
  }
  Study study() const { return {one, network, kVariants[0], "hills", ""}; }
  Study mirrored() const { return {other, other_network, kVariants[0], "hills", ""}; }
};

const Grounds& grounds() {
  static const Grounds both;
  return both;
}

SheetReader read(figures::Sheet sheet) { return SheetReader(sheet); }

// The place of a colour in the palette of elevations, whatever the light: shading only scales colours.
double elevation_of(const Rgb& colour) {
  constexpr std::size_t kSteps = 100;
  static const auto directions = [] {
    std::array<std::array<double, 3>, kSteps + 1> all{};
    for (std::size_t step = 0; step <= kSteps; ++step) {
      const Rgb at = figures::elevation_colour(static_cast<double>(step) / kSteps);
      const double length = std::hypot(at[0], at[1], at[2]);
      all[step] = {at[0] / length, at[1] / length, at[2] / length};
    }
    return all;
  }();
  const auto cosine = [&](const auto& d) { return d[0] * colour[0] + d[1] * colour[1] + d[2] * colour[2]; };
  const auto best = std::max_element(directions.begin(), directions.end(),
                                     [&](const auto& a, const auto& b) { return cosine(a) < cosine(b); });
  return static_cast<double>(best - directions.begin()) / kSteps;
}

Rgb sample(const SheetReader& shown, const SheetReader::Picture& picture, const Heightfield& field, int i,
           int j) {
  return shown.pixel(picture, (i + 0.5) / field.width, (j + 0.5) / field.depth);
}

// The share of samples whose colour does not tell their height within a tenth of `range`; channels aside.
double wrong_heights(const SheetReader& shown, const SheetReader::Picture& picture, const Heightfield& field,
                     const HeightRange& range) {
  int wrong = 0, read = 0;
  for (int j = 0; j < field.depth; ++j) {
    for (int i = 0; i < field.width; ++i) {
      const Rgb colour = sample(shown, picture, field, i, j);
      if (colour == figures::kChannel) continue;
      const double t = std::clamp((field.at(i, j) - range.lowest) / (range.highest - range.lowest), 0.F, 1.F);
      wrong += std::abs(elevation_of(colour) - t) > 0.1;
      ++read;
    }
  }
  return static_cast<double>(wrong) / read;
}

std::string words_over(const SheetReader& shown, const SheetReader::Picture& picture) {
  for (const SheetReader::Words& words : shown.words) {
    if (words.x == picture.x && words.y < picture.y && words.y > picture.y - 20) return words.text;
  }
  return "";
}

TEST(DrillFigures, NetworksOfOtherMethodsAreToldFromChannels) {
  const ChannelsSheet drawn = channels_sheet(grounds().study());
  const DrawnChannels seen = read_channels(drawn.maps, grounds().one);
  for (std::size_t map = 0; map < kDrawnTaus.size(); ++map) {
    EXPECT_EQ(seen.pixels[map], channel_pixels(grounds().network, kDrawnTaus[map]).size());
  }
  EXPECT_EQ(seen.outside_denser + seen.inland, 0U);
  EXPECT_GT(seen.low_share, 1.2 * seen.low_share_of_ground);
  // Cells that are deeper than wide: a panel has more rows of pixels than samples.
  Heightfield oblong = grounds().one;
  oblong.cell_z *= 1.07F;
  const Study study{oblong, grounds().network, kVariants[0], "hills", ""};
  EXPECT_EQ(read_channels(channels_sheet(study).maps, oblong).pixels, seen.pixels);
  // Those of another ground are networks, but do not lie in this ground's valleys.
  EXPECT_LT(read_channels(drawn.maps, grounds().other).low_share, 1.2 * seen.low_share_of_ground);
  // Thresholds in another order.
  std::vector<Image> reversed(drawn.maps.rbegin(), drawn.maps.rend());
  EXPECT_GT(read_channels(reversed, grounds().one).outside_denser, 100U);
  // As many pixels, but no network.
  Image moved = drawn.maps[0];
  for (int y = 0; y < moved.height; ++y) {
    for (int x = 0; x < moved.width; ++x) {
      moved.set(x, y, drawn.maps[0].pixel(x * 37 % moved.width, y * 29 % moved.height));
    }
  }
  EXPECT_GT(read_channels({moved}, grounds().one).inland, 100U);
}

Outcome outcome_at(const Study& study, const Setting& setting) {
  const Drills drills = extract_drills(study.ground, study.network, options_for(setting, study.variant));
  return compare(study.ground, study.network, drills, regenerate(drills), setting, study.variant);
}

// Figure 3 for two outcomes of a ground: what is wrong with it.
std::vector<std::string> faults_of_best(const figures::Sheet& sheet, const Study& study, const Outcome& rmse,
                                        const Outcome& ahd) {
  std::vector<std::string> faults;
  const SheetReader shown = read(sheet);
  if (shown.rows() != std::vector{2, 1}) return {"not two panels and a key"};
  for (std::size_t panel = 0; panel < 2; ++panel) {
    const Setting& setting = (panel == 0 ? rmse : ahd).setting;
    const Heightfield regenerated =
        regenerate(extract_drills(study.ground, study.network, options_for(setting, study.variant)));
    std::size_t plateau = 0;
    const float highest = height_range(study.ground).highest;
    for (const float h : regenerated.heights) plateau += h >= highest;
    if (words_over(shown, shown.pictures[panel]) !=
        fmt::format("({}) least {}: τ = {}, w = {}, k = {}; {:.1f} % untouched", panel == 0 ? "a" : "b",
                    panel == 0 ? "RMSE" : "AHD", setting.tau, setting.w, setting.k,
                    100.0 * static_cast<double>(plateau) / static_cast<double>(regenerated.heights.size()))) {
      faults.push_back("title");
    }
    if (wrong_heights(shown, shown.pictures[panel], regenerated, height_range(study.ground)) > 0.01) {
      faults.push_back("heights");
    }
  }
  return faults;
}

TEST(DrillFigures, TerrainsOfLeastError) {
  for (const Variant& variant : kFits) {
    Study study{grounds().one, grounds().network, variant, "hills", ""};
    const Outcome rmse = outcome_at(study, {25, 10, 10}), ahd = outcome_at(study, {100, 5, 5});
    EXPECT_GT(ahd.untouched, 0.01);
    const BestSheet best = best_sheet(study, rmse, ahd);
    EXPECT_EQ(faults_of_best(best.sheet, study, rmse, ahd), std::vector<std::string>{});
    EXPECT_EQ(read(best.sheet).fault_of_panels(declared_panels("drill.F3")), "");
    EXPECT_EQ(best.drawn[0].rmse, rmse.rmse);
    EXPECT_EQ(best.drawn[1].ahd, ahd.ahd);
    EXPECT_EQ(read(best_sheet(study, rmse, rmse).sheet).fault_of_panels(2), "panels 1 and 2 show the same");
    if (!variant.is_first()) continue;
    EXPECT_GE(faults_of_best(best_sheet(study, ahd, rmse).sheet, study, rmse, ahd).size(), 3U);
    EXPECT_GE(faults_of_best(best_sheet(grounds().mirrored(), rmse, ahd).sheet, study, rmse, ahd).size(), 2U);
  }
}

// At distances 0 to w from a pixel: the union of its cross-sections, and the printed fit to it.
struct Curves {
  std::vector<double> united, fitted;
};
Curves curves_at(const Heightfield& field, std::uint32_t pixel, int w) {
  std::vector<float> joined(static_cast<std::size_t>(w));
  CrossSections(field, w).join(pixel, joined);
  const FittedProfile fit = fit_profile(joined, field.heights[pixel], DrillFit::kPrinted);
  Curves curves{{field.heights[pixel]}, {field.heights[pixel]}};
  for (const float height : joined) {
    const auto r = static_cast<double>(curves.united.size());
    curves.united.push_back(height);
    curves.fitted.push_back(field.heights[pixel] + r * (fit.slope + r * fit.curvature));
  }
  return curves;
}

TEST(DrillFigures, OnlyAUnionOfSectionsAndLeastSquaresGiveTheRecordedNumbers) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "figures");
  Record record;
  Recorder recorder(record, folder.path());
  draw_cross_sections(grounds().study(), recorder);
  const auto value = [&](std::string_view metric) { return terrabench::value(record, metric); };
  EXPECT_EQ(value("drawn_sections_above_union"), 0);
  EXPECT_EQ(value("drawn_union_on_sections"), 20);
  EXPECT_EQ(value("drawn_union_off_ground"), 0);
  EXPECT_LT(value("drawn_rms_printed"), value("drawn_rms_vertex"));
  EXPECT_LE(value("drawn_rms_printed"), value("drawn_rms_monotone"));
  EXPECT_LT(value("drawn_rms_vertex"), value("drawn_rms_level"));
  // Worked out once more.
  const auto [united, fitted] = curves_at(grounds().one, example_pixel(grounds().study()), 20);
  double squares = 0;
  for (std::size_t r = 1; r <= 20; ++r) squares += std::pow(fitted[r] - united[r], 2);
  EXPECT_NEAR(value("drawn_rms_printed"), std::sqrt(squares / 20), 1e-3);
}

// Errors that no other set has, so that numbers tell their places.
std::vector<Outcome> numbered_outcomes() {
  std::vector<Outcome> outcomes;
  double number = 1;
  for (const Setting& setting : all_settings()) {
    Outcome& outcome = outcomes.emplace_back();
    outcome.setting = setting;
    outcome.rmse = 0.0101 * number;
    outcome.ahd[0] = 0.0001001 * (100 - number);
    ++number;
  }
  return outcomes;
}

// Figure 4 of these outcomes: the cells whose number is wrong, in both columns; -1 when cells are missing.
int wrong_cells(const figures::Sheet& sheet, std::vector<Outcome> outcomes) {
  // In the order of reading: a matrix per w, a row per τ, a column per k.
  std::stable_sort(outcomes.begin(), outcomes.end(), [](const Outcome& a, const Outcome& b) {
    return std::tie(a.setting.w, a.setting.tau, a.setting.k) <
           std::tie(b.setting.w, b.setting.tau, b.setting.k);
  });
  const SheetReader shown(sheet);
  const double middle = shown.image.width / 4.0, bottom = shown.image.height / 2.0 - 56;
  int wrong = 0;
  for (const bool left : {true, false}) {
    std::vector<SheetReader::Words> cells;
    for (const SheetReader::Words& words : shown.words) {
      char* end = nullptr;
      std::strtod(words.text.c_str(), &end);
      if (*end == 0 && (words.x < middle) == left && words.y < bottom) cells.push_back(words);
    }
    if (cells.size() != outcomes.size()) return -1;
    std::sort(cells.begin(), cells.end(),
              [](const auto& a, const auto& b) { return std::tie(a.y, a.x) < std::tie(b.y, b.x); });
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const Outcome& o = outcomes[c];
      wrong +=
          cells[c].text != (left ? fmt::format("{:.4f}", o.rmse) : fmt::format("{:.3f}", 1000 * o.ahd[0]));
    }
    // The least is blue, the largest red.
    const auto colour_of = [&](const SheetReader::Words& cell) {
      return shown.image.pixel(static_cast<int>(2 * cell.x) - 60, static_cast<int>(2 * cell.y) - 30);
    };
    const auto by_value = [](const auto& a, const auto& b) { return std::stod(a.text) < std::stod(b.text); };
    const Rgb least = colour_of(*std::min_element(cells.begin(), cells.end(), by_value)),
              most = colour_of(*std::max_element(cells.begin(), cells.end(), by_value));
    wrong += !(least[2] > least[0] + 80) + !(most[0] > most[2] + 80);
  }
  return wrong;
}

TEST(DrillFigures, MatricesHoldTheErrorsOfTheirSets) {
  const std::vector<Outcome> outcomes = numbered_outcomes();
  EXPECT_EQ(wrong_cells(error_matrices_sheet(outcomes), outcomes), 0);
  const int matrices = declared_panels("drill.F4");
  EXPECT_EQ(read(error_matrices_sheet(outcomes)).fault_of_panels(matrices), "");
  std::vector<Outcome> repeated = outcomes;  // the second width has the errors of the first
  for (Outcome& o : repeated) {
    if (o.setting.w != kWidths[1]) continue;
    const Setting first{o.setting.tau, kWidths[0], o.setting.k};
    o.rmse = std::ranges::find(outcomes, first, &Outcome::setting)->rmse;
  }
  EXPECT_EQ(read(error_matrices_sheet(repeated)).fault_of_panels(matrices), "panels 1 and 2 show the same");
  std::vector<Outcome> swapped = outcomes;
  std::swap(swapped[3].rmse, swapped[40].rmse);
  EXPECT_EQ(wrong_cells(error_matrices_sheet(swapped), outcomes), 2);
  std::swap(swapped[0].ahd, swapped[1].ahd);
  EXPECT_GE(wrong_cells(error_matrices_sheet(swapped), outcomes), 4);
}

}  // namespace
}  // namespace terrabench::drill
