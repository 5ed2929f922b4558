#include "results/plot/figure_layout.h"

#include <gmock/gmock.h>

#include "results/claims/judge.h"
#include "results/store/record_json.h"
#include "terrain/error.h"
#include "tests/results/fake_results.h"

namespace terrabench {
namespace {

using testing::HasSubstr;

void fill(Image& image, const FigurePanel& p, int seed) {
  for (int y = p.y; y < p.y + p.height; ++y) {
    for (int x = p.x; x < p.x + p.width; ++x) {
      const auto v = static_cast<std::uint8_t>((x - p.x) * 7 + (y - p.y) * seed);
      image.set(x, y, {v, v, v});
    }
  }
}

// A figure of two panels with words, its record and its claim.
class FigureLayoutTest : public FolderTest {
 protected:
  FigureLayoutTest() {
    std::filesystem::create_directories(folder_ / "figures");
    draw();
  }
  std::filesystem::path png() const { return folder_ / "figures/f.png"; }
  void draw() {
    image_ = Image(60, 30, {255, 255, 255});
    for (std::size_t i = 0; i < layout_.panels.size(); ++i) {
      fill(image_, layout_.panels[i], 5 * static_cast<int>(i) + 3);
    }
  }
  // The verdict on the figure as it was drawn, with these conditions.
  Judgement judged(const std::string& conditions) {
    write_picture(png(), image_);
    layout_ = with_repeats(layout_, image_);
    const RecordedFigure figure{"p.F1", "figures/f.png", "", checksum(read_file(png())), layout_};
    std::filesystem::remove(file());
    {
      Store store(folder_);
      const Provenance run = fake_provenance();
      store.begin_run(run);
      Record record = fake_record(run, "e", "c");
      add(record, "error", "m", {0.01234});
      add(record, "grey", "", {0.5});
      record.figures = {figure};
      store.append(record);
    }
    papers_ = {paper_with_claim("F", "{figure = \"p.F1\"" + conditions + "}")};
    return judge(Store::open(folder_), papers_).judgements.at(0);  // read back from the file
  }
  std::string fault(const std::string& conditions) {
    const Judgement judgement = judged(conditions);
    return judgement.verdict == Verdict::kDiffers ? judgement.measured : "holds: " + judgement.measured;
  }

  FigureLayout layout_{{{2, 2, 20, 20}, {30, 2, 20, 20}}, {"a: RMSE 0.0123 m", "b: 1,024 drills, −3 °C"}};
  Image image_;
  std::vector<Paper> papers_;
};

TEST_F(FigureLayoutTest, IsKeptInTheRecord) {
  const Judgement judgement = judged(", panels = 2, prints = [\"e/c/error\"]");
  EXPECT_EQ(judgement.verdict, Verdict::kReproduced) << judgement.measured;
  EXPECT_THAT(judgement.measured, HasSubstr("panels: 2, metrics printed: 1"));
  EXPECT_EQ(Store::open(folder_).records().at(0).figures.at(0).layout, layout_);
}

TEST_F(FigureLayoutTest, AWrongGridOfPanelsFails) {
  EXPECT_THAT(fault(", panels = 3"), HasSubstr("has 2 panels, not 3"));
  layout_.panels[1].x = 45;
  EXPECT_THAT(fault(", panels = 2"), HasSubstr("panel 2 lies outside the picture"));
}

TEST_F(FigureLayoutTest, AnEmptyOrRepeatedPanelFails) {
  for (int y = 0; y < 30; ++y) {
    for (int x = 28; x < 60; ++x) image_.set(x, y, {9, 9, 9});
  }
  EXPECT_THAT(fault(", panels = 2"), HasSubstr("panel 2 is blank"));
  EXPECT_THAT(fault(""), HasSubstr("holds: ")) << "where no layout is declared";
  draw();
  fill(image_, layout_.panels[1], 3);  // the seed of the first
  EXPECT_THAT(fault(", panels = 2"), HasSubstr("panels 1 and 2 show the same"));
  const std::string named = R"(, panels = ["a", "b"])";
  EXPECT_THAT(fault(named), HasSubstr("panels 1 and 2 show the same"));
  EXPECT_THAT(fault(named + R"(, alike = ["b", "a"])"), HasSubstr("holds: "));
  for (const char* const wrong :
       {R"(panels = ["a", "b"], alike = ["b"])", R"(panels = ["a", "b"], alike = ["a", "a"])",
        R"(alike = ["a", "b"])", R"(panels = ["a", "b"], alike = ["a", "c"])",
        R"(panels = 2, alike = ["a", "b"])", R"(panels = ["a", "b"], alike = [1, 2])"}) {
    EXPECT_THROW(judged(std::string(", ") + wrong), Error) << wrong;
  }
}

TEST_F(FigureLayoutTest, AChartThatPrintsAnotherNumberFails) {
  layout_.words[0] = "a: RMSE 0.0124 m";
  EXPECT_THAT(fault(", prints = [\"e/c/error\"]"), HasSubstr("does not print error of e c"));
  EXPECT_THAT(fault(", prints = [\"e/c/absent\"]"), HasSubstr("does not print absent of e c"));
}

TEST_F(FigureLayoutTest, AMapOfOtherHeightsFails) {
  layout_.panels = {{0, 0, 60, 30}};
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 60; ++x) image_.set(x, y, x % 2 == 0 ? Rgb{0, 0, 0} : Rgb{255, 255, 255});
  }
  EXPECT_THAT(fault(", brightness = \"e/c/grey\""), HasSubstr("holds: "));
  for (int y = 0; y < 30; ++y) image_.set(0, y, {255, 255, 255});  // 1 of 60 columns
  EXPECT_THAT(fault(", brightness = \"e/c/grey\""), HasSubstr("its brightness is 0.517"));
}

TEST_F(FigureLayoutTest, NumbersAreComparedToTheDigitsPrinted) {
  for (const double value : {0.0123, 0.01234, 0.01226, 1024.0, 1024.4, -3.0}) {
    EXPECT_TRUE(says(layout_, value)) << value;
  }
  layout_.words.emplace_back("0 1 0.00");
  for (const double value : {0.0, 1.0, -0.004}) EXPECT_TRUE(says(layout_, value)) << value;
  for (const double value : {0.0124, 0.0122, 1025.0, 24.0, 3.0, 0.27, 0.9, 1.2})
    EXPECT_FALSE(says(layout_, value)) << value;
}

}  // namespace
}  // namespace terrabench
