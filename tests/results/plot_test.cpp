#include "results/plot/plot.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "results/plot/rasterise.h"
#include "terrain/error.h"
#include "terrain/image.h"
#include "tests/results/fake_results.h"
#include "tests/terrain/errors.h"

namespace terrabench {
namespace {

using testing::HasSubstr;
using testing::Not;

Plot growth() {
  return {
      "Growth",
      {"samples along each side, n", "", true},
      {"generation time", "s", true},
      {{"paper", {{128, 33, 33, 33}, {256, 256, 256, 256}, {512, 2019, 2019, 2019}}, true},
       {"this <program>", {{256, 1.3, 1.2, 1.9}, {64, 0.02, 0.018, 0.03}, {128, 0.15, 0.15, 0.15}}, false}}};
}

TEST(PlotTest, ShowsLabelsUnitsTicksAndEveryPoint) {
  const std::string svg = plot_svg(growth());
  for (const char* label : {"samples along each side, n", "generation time [s]", ">64<", ">512<", ">0.01<",
                            ">1,000<", "paper<", "this &lt;program&gt;"}) {
    EXPECT_THAT(svg, HasSubstr(label));
  }
  EXPECT_EQ(count(svg, "<circle"), 4U) << "three points and the legend";
  EXPECT_THAT(svg, HasSubstr("stroke-dasharray"));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
}

TEST(PlotTest, EveryPointHasItsValuesUnderThePointer) {
  const std::string svg = plot_svg(growth());
  for (const char* const hint :
       {"this &lt;program&gt; · samples along each side, n: 64 · generation time: 0.02 s [0.018, "
        "0.03]</title>",
        "this &lt;program&gt; · samples along each side, n: 256 · generation time: 1.3 s [1.2, 1.9]</title>",
        "paper · samples along each side, n: 512 · generation time: 2,019 s</title>"}) {
    EXPECT_EQ(count(svg, hint), 1U) << hint;
  }
  EXPECT_EQ(count(svg, "<title>"), 7U) << "six points and the plot";
  // The left end of the line is its first point, whatever the order of the measurements.
  EXPECT_LT(svg.find("n: 64"), svg.find("n: 128 · generation time: 0.15 s"));
}

TEST(PlotTest, WhatOneClipCutsSharesAGroup) {
  Plot few = growth();
  few.series = {{"a", {{1, 1, 0.9, 1.1}, {1000, 1000, 900, 1100}}, false}};
  Plot many = few;
  for (int n = 2; n < 100; ++n) many.series[0].points.push_back({1.0 * n, 1.0 * n, 0.9 * n, 1.1 * n});
  const std::string two = plot_svg(few), hundred = plot_svg(many);
  EXPECT_EQ(count(hundred, "<circle"), 101U) << "and the legend";
  EXPECT_GT(count(hundred, "<g clip-path"), 0U);
  EXPECT_LE(count(hundred, "<g clip-path"), count(two, "<g clip-path"));
  EXPECT_EQ(count(hundred, "<g "), count(hundred, "</g>"));
}

TEST(PlotTest, LabelsOfANarrowPlotKeepClearOfEachOther) {
  Plot plot = growth();
  plot.series = {{"a", {}, false}};
  for (const double n : {16641, 66049, 263169, 1050625, 4198401, 16785409})
    plot.series[0].points.push_back({n, 1, 1, 1});
  const std::string wide = plot_svg(plot), narrow = plot_svg(plot, column_size(plot));
  for (const char* const label : {">16,641<", ">66,049<", ">1,050,625<", ">16,785,409<"}) {
    EXPECT_THAT(wide, HasSubstr(label));
  }
  EXPECT_THAT(narrow, HasSubstr(">16,641<"));
  EXPECT_THAT(narrow, Not(HasSubstr(">66,049<")));
  EXPECT_THAT(narrow, HasSubstr("width=\"440\""));
}

TEST(PlotTest, SamePlotSameBytes) { EXPECT_EQ(plot_svg(growth()), plot_svg(growth())); }

TEST(PlotTest, LeavesOutWhatALogarithmicAxisCannotShow) {
  Plot plot = growth();
  plot.series[1].points.push_back({0, 1, 1, 1});
  plot.series[1].points.push_back({512, -3, -3, -3});
  plot.series[1].points.push_back({512, std::numeric_limits<double>::infinity(), 0, 0});
  EXPECT_EQ(plot_svg(plot), plot_svg(growth()));
  plot.series = {{"nothing", {{-1, 1, 1, 1}}, false}};
  EXPECT_THROW(plot_svg(plot), Error);
}

TEST(PlotTest, MoreSeriesThanColoursStayDistinct) {
  Plot plot = growth();
  const PlotSeries measured = plot.series[1];
  plot.series.assign(8, measured);
  const std::string all = plot_svg(plot);
  EXPECT_THAT(all, Not(HasSubstr("stroke-dasharray")));
  EXPECT_EQ(count(all, "#0072b2"), count(plot_svg({plot.title, plot.x, plot.y, {measured}}), "#0072b2"));
  plot.series.assign(9, measured);
  const std::string more = plot_svg(plot);
  EXPECT_THAT(more, HasSubstr("stroke-dasharray")) << "the ninth has the first one's colour";
  EXPECT_EQ(count(more, "<circle"), count(all, "<circle")) << "and another marker";
}

TEST(PlotTest, OnePointAndHugeRangesStillHaveAnAxis) {
  Plot plot = growth();
  plot.series = {{"one", {{5, 7, 7, 7}}, false}};
  EXPECT_THAT(plot_svg(plot), Not(HasSubstr("nan")));
  plot.x.log = plot.y.log = false;
  EXPECT_THAT(plot_svg(plot), HasSubstr(">5<"));
  plot.series = {{"zero", {{0, 0, 0, 0}}, false}};
  EXPECT_THAT(plot_svg(plot), Not(HasSubstr("nan")));
  plot.x.log = plot.y.log = true;
  plot.series = {{"huge", {{1e-300, 1e-300, 0, 1}, {1e300, 1e300, 1, 1e301}}, false}};
  EXPECT_LT(plot_svg(plot).size(), 50'000U);
}

TEST(PlotTest, StacksThePartsOfBars) {
  const std::vector<PlotSeries> parts = {{"choosing", {{0.003, 1, 0, 0.003}, {0.02, 2, 0, 0.02}}},
                                         {"drawing", {{14, 1, 0.003, 14}, {1230, 2, 0.02, 1230}}}};
  Plot plot{"Frames", {"time", "ms", true}, {}, parts, {"257² samples", "ROAM", "brute force"}};
  const std::string both = plot_svg(plot);
  for (const char* label :
       {"time [ms]", ">ROAM<", ">brute force<", ">257² samples<", "choosing", "drawing", "14<", "1,230<"}) {
    EXPECT_THAT(both, HasSubstr(label));
  }
  EXPECT_THAT(both, Not(HasSubstr("nan")));
  EXPECT_THAT(both, HasSubstr("<title>brute force · choosing · time: 0.02 ms</title>"));
  EXPECT_THAT(both, HasSubstr("<title>ROAM · drawing · time: 14 ms</title>"))
      << "the part's length, not its end";
  EXPECT_EQ(plot_svg(plot), both);
  EXPECT_GT(screen_size(plot).height, screen_size({"", {}, {}, parts, {"one"}}).height);
  // Two bars and the legend's key, per part.
  EXPECT_EQ(count(both, "fill=\"#0072b2\""), 3U);
  EXPECT_EQ(count(both, "fill=\"#e69f00\""), 3U);
  plot.series[1].points.pop_back();
  EXPECT_EQ(count(plot_svg(plot), "fill=\"#e69f00\""), 2U);
}

TEST(PlotTest, PowerLaw) {
  std::vector<PlotPoint> points;
  for (const double x : {64.0, 128.0, 256.0}) points.push_back({x, 3 * std::pow(x, 2.5), 0, 0});
  EXPECT_NEAR(*power_law(points), 2.5, 1e-9);
  points.resize(1);
  EXPECT_FALSE(power_law(points));
  points.push_back(points[0]);
  EXPECT_FALSE(power_law(points));
  EXPECT_FALSE(power_law(std::vector<PlotPoint>{{-1, 2, 2, 2}, {0, 3, 3, 3}}));
}

using RasteriseTest = FolderTest;

TEST_F(RasteriseTest, MakesAPicture) {
  const Image image = write_svg(plot_svg(growth()), folder_ / "plot.webp", 880);
  EXPECT_EQ(image.rgb, read_picture(folder_ / "plot.webp").rgb) << "a drawing loses nothing";
  EXPECT_EQ(image.width, 880);
  EXPECT_EQ(image.height, screen_size(growth()).height);
  EXPECT_EQ(image.pixel(0, 0), (Rgb{255, 255, 255}));
}

TEST_F(RasteriseTest, MissingProgramAndBadInputAreEnvironmentErrors) {
  EXPECT_THROW(write_svg("<svg", folder_ / "bad.png", 100), Error);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "bad.png"));
  const std::string path = std::getenv("PATH");
  setenv("PATH", folder_.c_str(), 1);
  const Failure failure = failure_of([&] { write_svg("<svg", folder_ / "bad.png", 100); });
  EXPECT_EQ(failure.code, ExitCode::kEnvironment);
  EXPECT_THAT(failure.advice, HasSubstr("librsvg2-bin"));
  setenv("PATH", path.c_str(), 1);
}

// A terminal's Ctrl-C reaches the program that converts, too: no fault of the disk.
TEST_F(RasteriseTest, AnInterruptedProgramIsAnInterruption) {
  const std::filesystem::path program = folder_ / "rsvg-convert";
  write_file(program, std::string_view("#!/bin/sh\nkill -INT $$\n"));
  std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  const std::string path = std::getenv("PATH");
  setenv("PATH", (folder_.string() + ":" + path).c_str(), 1);
  EXPECT_EQ(failure_of([&] { write_svg(plot_svg(growth()), folder_ / "plot.png", 100); }).code,
            ExitCode::kInterrupted);
  setenv("PATH", path.c_str(), 1);
}

}  // namespace
}  // namespace terrabench
