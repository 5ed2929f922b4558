// advise, from the option to the page, on the smallest ground on which all methods can be measured.
#include <gmock/gmock.h>

#include "terrain/files.h"
#include "tests/experiments/command_line.h"

namespace terrabench {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class Advise : public CommandLine {
 protected:
  Advise() { call("$T represent jacksboro --as heightmap --crop 100 100 65 49 --save my.tif"); }

  // Interrupted after a few seconds.
  Outcome begin(const std::string& arguments) const {
    return call("timeout --preserve-status -s INT 6 $T advise " + arguments);
  }
};

TEST_F(Advise, PrintsATableWithReasonsAndWritesAPage) {
  const Outcome first = call("$T advise my.tif --for archiving --side 17");
  EXPECT_EQ(first.code, 0) << first.text;
  EXPECT_THAT(first.text, HasSubstr("my.tif, its middle 17 × 17: 17 × 17 samples, cells of 74"));
  EXPECT_THAT(first.text,
              AllOf(HasSubstr("this takes about "), HasSubstr("\nQuestion "), HasSubstr("\nWhy:\n"),
                    HasSubstr("\n  Smallest file at equal error: "), Not(HasSubstr("triangles"))));
  EXPECT_THAT(first.text, HasSubstr("\nsee advice-my/report/index.html\n"));
  const std::string page = read_file(folder_ / "advice-my/report/index.html");
  EXPECT_THAT(page, AllOf(HasSubstr("Which method for my.tif, its middle 17 × 17</h1>"),
                          HasSubstr("the middle 17×17 of its 65×49 samples"), HasSubstr("Smallest file"),
                          HasSubstr("../figures/cross.error-maps.my-")));
  const Outcome again = call("$T advise my.tif --for archiving --side 17");
  EXPECT_EQ(again.code, 0);
  EXPECT_THAT(again.text, AllOf(HasSubstr("were already in the results folder"), Not(HasSubstr("[1/"))));
}

TEST_F(Advise, MeasuresAnewWhatHasChanged) {
  EXPECT_EQ(call("$T advise my.tif --for archiving --side 17 --out a").code, 0);
  call("$T represent jacksboro --as heightmap --crop 120 100 65 49 --save my.tif");
  const Outcome changed = call("$T advise my.tif --for archiving --side 17 --out a");
  EXPECT_EQ(changed.code, 0) << changed.text;
  EXPECT_THAT(changed.text, AllOf(HasSubstr("[1/"), Not(HasSubstr("were already in the results folder"))));
}

TEST_F(Advise, TakesAPartThatHasHeights) {
  call(
      "printf 'ncols 60\nnrows 20\nxllcorner 0\nyllcorner 0\ncellsize 10\nNODATA_value -1\n' >coast.asc; "
      "awk 'BEGIN {for (j = 0; j < 20; ++j) {for (i = 0; i < 60; ++i) printf \"%d \", "
      "i < 40 ? -1 : i * j % 17 + 5; print \"\"}}' >>coast.asc");
  EXPECT_THAT(begin("coast.asc --for archiving --side 9").text,
              HasSubstr("note: dem:coast.asc,crop=9x9+51+5: 9 × 9 samples"));
}

TEST_F(Advise, SaysWhatItCannotDo) {
  const auto fails = [&](const std::string& arguments, int code, const std::string& why) {
    const Outcome outcome = call("$T advise " + arguments);
    EXPECT_EQ(outcome.code, code) << arguments;
    EXPECT_THAT(outcome.text, HasSubstr(why)) << arguments;
  };
  fails("", 2, "terrain is required");
  fails("my.tif --for flyin", 2, "flying");
  fails("nothing.tif", 3, "no such file");
  fails("jacksboro", 2, "is a reference ground");
  fails("'dem:my.tif,crop=99x9'", 2, "does not lie inside its 65×49");
  fails("my.tif --reference nowhere --side 17 --for archiving", 3, "nowhere");
}

// --help names them; the claims files define them.
TEST_F(Advise, NamesItsPurposes) {
  EXPECT_THAT(call("$T advise --help").text, HasSubstr("{flying,walking,editing,archiving}"));
}

}  // namespace
}  // namespace terrabench
