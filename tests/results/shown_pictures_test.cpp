#include "results/report/shown_pictures.h"

#include <gmock/gmock.h>

namespace terrabench {
namespace {

FigureLayout two_panels() {
  return {{{10, 20, 300, 200}, {320, 20, 301, 199}},
          {"elevation, m", "(a) before: 3 of 4", "0", "(b) after"}};
}

TEST(ComparablePanels, HaveTheirNamesAndOneSize) {
  const std::vector<NamedPanel> panels = comparable_panels(two_panels());
  ASSERT_EQ(panels.size(), 2U);
  EXPECT_EQ(panels[0].name, "(a) before: 3 of 4");
  EXPECT_EQ(panels[1].name, "(b) after");
  EXPECT_EQ(panels[1].x, 320);
  EXPECT_EQ(panels[1].width, 300) << "that of the first, so that they cover each other";
}

TEST(ComparablePanels, AreNoneIfOneHasNoNameOrAnotherSize) {
  FigureLayout unnamed = two_panels();
  unnamed.words.pop_back();
  EXPECT_THAT(comparable_panels(unnamed), testing::IsEmpty());
  FigureLayout wider = two_panels();
  wider.panels[1].width = 400;
  EXPECT_THAT(comparable_panels(wider), testing::IsEmpty());
  FigureLayout alone = two_panels();
  alone.panels.pop_back();
  EXPECT_THAT(comparable_panels(alone), testing::IsEmpty());
}

}  // namespace
}  // namespace terrabench
