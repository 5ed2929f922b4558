// Figure 2 of "drill": its cross-sections, their union and their fit, read back from the sheet. The test must
// reject a figure of another place.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <set>
#include <sstream>

#include "experiments/drill/cutting_planes.h"
#include "representations/drill/cross_sections.h"
#include "representations/drill/profile_fit.h"
#include "tests/experiments/drill_figure_grounds.h"
#include "tests/experiments/value.h"
#include "tests/terrain/temporary_folder.h"

namespace terrabench::drill {
namespace {

// A polyline of a sheet.
struct Drawn {
  double thickness = 0, opacity = 1;
  std::string colour, dashes;
  std::vector<figures::SheetPoint> points;
};

std::vector<Drawn> lines_of(const figures::Sheet& sheet) {
  std::vector<Drawn> lines;
  std::istringstream svg(sheet.svg());
  for (std::string text; std::getline(svg, text);) {
    if (!text.starts_with("<polyline")) continue;
    const auto value = [&](const std::string& key) {
      const std::size_t at = text.find(" " + key + "=\"");
      if (at == std::string::npos) return std::string();
      const std::size_t begin = at + key.size() + 3;
      return text.substr(begin, text.find('"', begin) - begin);
    };
    Drawn line{std::stod(value("stroke-width")),
               std::stod(value("stroke-opacity")),
               value("stroke"),
               value("stroke-dasharray"),
               {}};
    std::istringstream points(value("points"));
    for (std::string point; points >> point;) {
      line.points.push_back({std::stod(point), std::stod(point.substr(point.find(',') + 1))});
    }
    lines.push_back(std::move(line));
  }
  return lines;
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

// Figure 2 at a pixel of a ground: what is wrong with it.
std::vector<std::string> faults_of_sections(const figures::Sheet& sheet, const Heightfield& ground,
                                            std::uint32_t pixel) {
  constexpr int kW = 20;
  std::vector<std::string> faults;
  const std::vector<Drawn> lines = lines_of(sheet);
  const auto of = [&](const auto& test) {
    std::vector<Drawn> found;
    std::copy_if(lines.begin(), lines.end(), std::back_inserter(found), test);
    return found;
  };
  const auto sections = of([](const Drawn& l) { return l.opacity == 0.85; });
  const auto joint = of([](const Drawn& l) { return l.thickness == 4 && l.points.size() > 2; });
  const auto printed = of([](const Drawn& l) { return l.dashes == "2,4" && l.points.size() > 2; });
  if (sections.size() != 120) faults.push_back("not 120 cross-sections");
  if (joint.size() != 1 || printed.size() != 1) return {"no union or no fit"};
  std::set<std::string> colours;
  for (const Drawn& section : sections) colours.insert(section.colour);
  if (colours.size() < 100) faults.push_back("cross-sections share colours");
  // The scale of the elevations, from two labels of the axis, each 4 units below its line.
  std::map<double, double> labels;  // y to elevation
  for (const SheetReader::Words& words : SheetReader(sheet, false).words) {
    char* end = nullptr;
    const double value = std::strtod(words.text.c_str(), &end);
    if (*end == 0 && words.x < 520 && words.x > 500) labels[words.y - 4] = value;
  }
  if (labels.size() < 2) return {"no labels"};
  const auto [top, high] = *labels.begin();
  const auto [bottom, low] = *labels.rbegin();
  const auto level = [&, top = top, high = high, bottom = bottom, low = low](double y) {
    return high + (y - top) / (bottom - top) * (low - high);
  };
  const double within = (high - low) / 5000;  // points are given to a hundredth of a unit
  const auto [highest, fitted] = curves_at(ground, pixel, kW);
  for (std::size_t r = 0; r < joint[0].points.size(); ++r) {
    if (std::abs(level(joint[0].points[r].y) - highest[r]) > within) return {"union"};
  }
  if (joint[0].points.size() != highest.size()) faults.push_back("length of the union");
  for (std::size_t r = 0; r + 1 < printed[0].points.size(); ++r) {
    if (std::abs(level(printed[0].points[r].y) - fitted[r]) > within) return {"fit as printed"};
  }
  return faults;
}

TEST(DrillFigures, CrossSectionsTheirUnionAndFit) {
  const Study study = grounds().study();
  const std::uint32_t pixel = example_pixel(study);
  ASSERT_GT(pixel, 0U);
  const figures::Sheet sheet = cross_sections_sheet(study, pixel);
  EXPECT_EQ(faults_of_sections(sheet, study.ground, pixel), std::vector<std::string>{});
  EXPECT_EQ(SheetReader(sheet, false).pictures.size(), 1U);  // the planes
  EXPECT_EQ(read(sheet).fault_of_panels(declared_panels("drill.F2")), "");
  // The sections of the next pixel, and of the same pixel on another ground.
  EXPECT_NE(faults_of_sections(cross_sections_sheet(study, pixel + 1), study.ground, pixel),
            std::vector<std::string>{});
  EXPECT_NE(faults_of_sections(cross_sections_sheet(grounds().mirrored(), pixel), study.ground, pixel),
            std::vector<std::string>{});
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

// How much redder than green a pixel is.
int redness(const Image& image, const glm::dvec2& at) {
  const Rgb colour = image.pixel(static_cast<int>(at.x), static_cast<int>(at.y));
  return colour[0] - colour[1];
}

TEST(DrillFigures, PlanesCutTheGroundAlongTheCrossSections) {
  constexpr int kWidth = 420, kHeight = 400, kW = 20;
  const Study study = grounds().study();
  const CuttingPlanes planes(study.ground, example_pixel(study), kW);
  const Image image = planes.draw(kWidth, kHeight);
  // Where ground faces the eye, the lines in which planes cut it are redder than the ground between them,
  // which shows through a plane or two at most.
  int seen = 0, redder = 0;
  for (int m = 0; m < CuttingPlanes::kPlanes; ++m) {
    const double step = 2 * std::numbers::pi / CuttingPlanes::kPlanes;
    for (const double r : {8.0, 12.0, 16.0}) {
      const auto at = [&](double turn) {
        return planes.on_image(r * std::cos(turn), r * std::sin(turn), kWidth, kHeight);
      };
      ++seen;
      redder += redness(image, at(m * step)) > redness(image, at((m + 0.5) * step));
    }
  }
  EXPECT_GE(redder, seen * 3 / 4);
  // Beyond the planes' ends there is plain ground, and beside the block paper.
  EXPECT_LT(redness(image, planes.on_image(0, kW + 3, kWidth, kHeight)), 60);
  EXPECT_EQ(image.pixel(2, 2), (Rgb{255, 255, 255}));
  // Another ground is another picture.
  const Image other = CuttingPlanes(grounds().other, example_pixel(study), kW).draw(kWidth, kHeight);
  EXPECT_NE(image.rgb, other.rgb);
}

}  // namespace
}  // namespace terrabench::drill
