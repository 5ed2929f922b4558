// The figures of "drill": that they show what they say, read back from the pictures themselves. For each, a
// figure with other content must be found out.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "experiments/drill/analysis.h"
#include "experiments/figures/maps.h"
#include "representations/drill/regenerate.h"
#include "terrain/hydrology/channels.h"
#include "tests/experiments/drill_figure_grounds.h"

namespace terrabench::drill {
namespace {

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

// Figure 1 of `study`, judged against a ground and its channels: what is wrong with it.
std::vector<std::string> faults_of_channels(const SheetReader& shown, const Study& study) {
  std::vector<std::string> faults;
  if (shown.rows() != std::vector{2, 2, 1}) return {"not two rows of two panels and a key"};
  const std::uint32_t taus[] = {25, 50, 100, 200};
  for (std::size_t panel = 0; panel < 4; ++panel) {
    const SheetReader::Picture& picture = shown.pictures[panel];
    std::size_t channels = 0, misplaced = 0;
    for (int j = 0; j < study.ground.depth; ++j) {
      for (int i = 0; i < study.ground.width; ++i) {
        const auto at = static_cast<std::size_t>(j * study.ground.width + i);
        const bool channel = study.network.accumulation[at] >= taus[panel];
        channels += channel;
        misplaced += channel != (sample(shown, picture, study.ground, i, j) == figures::kChannel);
      }
    }
    if (misplaced > 0) faults.push_back(fmt::format("τ = {}: {} pixels misplaced", taus[panel], misplaced));
    std::string title = words_over(shown, picture);
    std::erase(title, ',');
    if (title.find(fmt::format("τ = {}: {} channel pixels", taus[panel], channels)) == std::string::npos) {
      faults.push_back("title: " + title);
    }
    if (wrong_heights(shown, picture, study.ground, height_range(study.ground)) > 0.01) {
      faults.push_back("heights");
    }
  }
  return faults;
}

TEST(DrillFigures, ChannelsOverTheRelief) {
  const SheetReader shown = read(channels_sheet(grounds().study()).sheet);
  EXPECT_EQ(faults_of_channels(shown, grounds().study()), std::vector<std::string>{});
  EXPECT_EQ(shown.fault_of_panels(declared_panels("drill.F1")), "");
  // Another ground; and the right ground with the channels of the other.
  EXPECT_GE(faults_of_channels(read(channels_sheet(grounds().mirrored()).sheet), grounds().study()).size(),
            8U);
  const Study mixed{grounds().one, grounds().other_network, kVariants[0], "hills", ""};
  EXPECT_GE(faults_of_channels(read(channels_sheet(mixed).sheet), grounds().study()).size(), 4U);
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

// Figure 3 and the differences for two outcomes of a ground: what is wrong with them.
std::vector<std::string> faults_of_best(const BestSheets& sheets, const Study& study, const Outcome& rmse,
                                        const Outcome& ahd) {
  std::vector<std::string> faults;
  const SheetReader terrains = read(sheets.terrains), differences = read(sheets.differences);
  if (terrains.rows() != std::vector{2, 1} || differences.rows() != std::vector{2, 1}) {
    return {"not two panels and a key"};
  }
  for (std::size_t panel = 0; panel < 2; ++panel) {
    const Outcome& outcome = panel == 0 ? rmse : ahd;
    const Heightfield regenerated =
        regenerate(extract_drills(study.ground, study.network, options_for(outcome.setting, study.variant)));
    std::size_t plateau = 0, wrong_sign = 0;
    const float highest = height_range(study.ground).highest;
    for (const float h : regenerated.heights) plateau += h >= highest;
    const double untouched =
        100.0 * static_cast<double>(plateau) / static_cast<double>(regenerated.heights.size());
    const std::string title =
        fmt::format("({}) least {}: τ = {}, w = {}, k = {}; ", panel == 0 ? "a" : "b",
                    panel == 0 ? "RMSE" : "AHD", outcome.setting.tau, outcome.setting.w, outcome.setting.k);
    if (words_over(terrains, terrains.pictures[panel]) !=
        fmt::format("{}{:.1f} % untouched", title, untouched)) {
      faults.push_back("title of the terrain");
    }
    if (words_over(differences, differences.pictures[panel]) !=
        fmt::format("{}RMSE {:.1f} m", title, outcome.rmse_metres)) {
      faults.push_back("title of the difference");
    }
    if (wrong_heights(terrains, terrains.pictures[panel], regenerated, height_range(study.ground)) > 0.01) {
      faults.push_back("heights");
    }
    for (int j = 0; j < study.ground.depth; ++j) {
      for (int i = 0; i < study.ground.width; ++i) {
        const double difference = regenerated.at(i, j) - study.ground.at(i, j);
        if (std::abs(difference) < rmse.rmse_metres) continue;
        const Rgb colour = sample(differences, differences.pictures[panel], study.ground, i, j);
        wrong_sign += (difference > 0) != (colour[0] > colour[2]);
      }
    }
    if (wrong_sign > 0) faults.push_back("signs of the difference");
  }
  return faults;
}

TEST(DrillFigures, TerrainsOfLeastErrorAndTheirDifference) {
  for (const Variant& variant : kFits) {
    Study study{grounds().one, grounds().network, variant, "hills", ""};
    const Outcome rmse = outcome_at(study, {25, 10, 10}), ahd = outcome_at(study, {100, 5, 5});
    EXPECT_GT(ahd.untouched, 0.01);
    const BestSheets best = best_sheets(study, rmse, ahd);
    EXPECT_EQ(faults_of_best(best, study, rmse, ahd), std::vector<std::string>{});
    EXPECT_EQ(read(best.terrains).fault_of_panels(declared_panels("drill.F3")), "");
    EXPECT_EQ(best.drawn[0].rmse, rmse.rmse);
    EXPECT_EQ(best.drawn[1].ahd, ahd.ahd);
    EXPECT_EQ(read(best_sheets(study, rmse, rmse).terrains).fault_of_panels(2),
              "panels 1 and 2 show the same");
    if (!variant.is_first()) continue;
    EXPECT_GE(faults_of_best(best_sheets(study, ahd, rmse), study, rmse, ahd).size(), 6U);
    EXPECT_GE(faults_of_best(best_sheets(grounds().mirrored(), rmse, ahd), study, rmse, ahd).size(), 4U);
  }
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
