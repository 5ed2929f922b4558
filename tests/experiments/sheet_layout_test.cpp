#include <gmock/gmock.h>

#include <array>

#include "experiments/figures/sheet.h"
#include "results/plot/figure_layout.h"
#include "terrain/image.h"
#include "tests/terrain/temporary_folder.h"

namespace terrabench::figures {
namespace {

TEST(SheetLayout, HasThePicturesAndTheWordsButNoColourKeys) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / "sheet.png";
  Sheet sheet(100, 60);
  Image red(4, 4, {200, 0, 0}), blue(4, 4, {0, 0, 200});
  red.set(0, 0, {255, 255, 255});
  blue.set(0, 0, {255, 255, 255});
  sheet.picture(10, 5, 20, 20, red);
  sheet.picture(40, 5, 20, 20, blue);
  sheet.text(10, 40, "a & b < 3", 10);
  sheet.colour_bar(
      10, 45, 50,
      [](double t) {
        return Rgb{static_cast<std::uint8_t>(255 * t), 0, 0};
      },
      std::array{Sheet::Tick{0, "0 m"}});
  sheet.write({file});
  const FigureLayout& layout = sheet.layout();
  const Image image = read_picture(file);
  EXPECT_EQ(layout.panels, (std::vector<FigurePanel>{{20, 10, 40, 40}, {80, 10, 40, 40}}));
  EXPECT_EQ(layout.words, (std::vector<std::string>{"a & b < 3", "0 m"}));
  EXPECT_EQ(layout_fault(layout, image), "");
  EXPECT_EQ(image.pixel(50, 40), (Rgb{200, 0, 0})) << "the panel is where the layout says";
  EXPECT_EQ(image.pixel(110, 40), (Rgb{0, 0, 200}));
}

TEST(SheetLayout, DrawnPartsArePanelsToo) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / "drawn.webp";
  const auto fault = [&](SheetPoint to) {
    Sheet sheet(100, 60);
    for (const double x : {10.0, 60.0}) sheet.panel(x, 10, 30, 30);
    sheet.stroke({15, 15}, {35, 35}, {0, 0, 0}, 2);
    sheet.stroke({65, 15}, to, {0, 0, 0}, 2);
    FigureLayout layout;
    sheet.write({file, [&](const FigureLayout& of) { layout = of; }});
    return layout_fault(layout, read_picture(file));
  };
  EXPECT_EQ(fault({85, 25}), "");
  EXPECT_EQ(fault({65, 5}), "") << "part of the line lies above the panel";
  EXPECT_EQ(fault({85, 35}), "panels 1 and 2 show the same");
  EXPECT_EQ(fault({65, 15}), "panel 2 is blank");
}

TEST(SheetLayout, ChartsSayTheNumbersOfTheirLegend) {
  const std::string kSpace = "\u00A0";  // before the words of a legend
  const TemporaryFolder folder;
  Plot plot;
  plot.title = "t";
  plot.x.label = "a & b";
  plot.y.label = "y";
  plot.y.unit = "m";
  plot.series.push_back({"slope −0.52", {{1, 3, 3, 3}, {2, 5, 5, 5}}, false});
  plot.series.push_back({"slope 0.25", {{1, 4, 4, 4}, {2, 4, 4, 4}}, false});
  FigureLayout layout;
  write_chart({folder / "chart.png", [&](const FigureLayout& of) { layout = of; }}, plot, 600);
  const Image image = read_picture(folder / "chart.png");
  EXPECT_EQ(layout.panels, (std::vector<FigurePanel>{{0, 0, image.width, image.height}}));
  EXPECT_EQ(layout_fault(layout, image), "");
  const std::vector<std::string> shown = {"a &amp; b", "y [m]", kSpace + "slope −0.52",
                                          kSpace + "slope 0.25"};
  EXPECT_THAT(layout.words, ::testing::IsSupersetOf(shown));
  EXPECT_TRUE(says(layout, -0.5156));
  EXPECT_TRUE(says(layout, 0.2512));
  EXPECT_FALSE(says(layout, -0.53)) << "a chart that prints another slope";
  EXPECT_FALSE(says(layout, 0.27));
}

}  // namespace
}  // namespace terrabench::figures
