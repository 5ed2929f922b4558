#include <gtest/gtest.h>
#include <unistd.h>

#include <array>

#include "experiments/figures/sheet.h"
#include "results/figure_layout.h"
#include "terrain/image.h"

namespace terrabench::figures {
namespace {

TEST(SheetLayout, HasThePicturesAndTheWordsButNoColourKeys) {
  const std::filesystem::path file = std::filesystem::temp_directory_path() /
                                     ("terrabench.sheet-layout." + std::to_string(getpid()) + ".png");
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
  sheet.write(file);
  const auto layout = read_layout(file);
  const Image image = read_png(file);
  std::filesystem::remove(file);
  ASSERT_TRUE(layout);
  EXPECT_EQ(layout->panels, (std::vector<FigurePanel>{{20, 10, 40, 40}, {80, 10, 40, 40}}));
  EXPECT_EQ(layout->words, (std::vector<std::string>{"a & b < 3", "0 m"}));
  EXPECT_EQ(layout_fault(*layout, image), "");
  EXPECT_EQ(image.pixel(50, 40), (Rgb{200, 0, 0})) << "the panel is where the layout says";
  EXPECT_EQ(image.pixel(110, 40), (Rgb{0, 0, 200}));
}

}  // namespace
}  // namespace terrabench::figures
