// Grounds of the user's own on the command line: what their reader says reaches the terminal and the records,
// and every command takes them in every form.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "results/store/store.h"
#include "terrain/files.h"
#include "terrain/hydrology/steepest.h"
#include "terrain/source.h"
#include "terrain/sources/dem/dem.h"
#include "tests/experiments/command_line.h"
#include "tests/terrain/raster_file.h"

namespace terrabench {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

class Grounds : public CommandLine {
 protected:
  Grounds() {
    for (const bool whole : {false, true}) {
      std::string text = "ncols 12\nnrows 10\nxllcorner 500000\nyllcorner 5000000\ncellsize 30\n";
      for (int j = 0; j < 10; ++j) {
        for (int i = 0; i < 12; ++i) {
          text += !whole && i == 5 && j == 5 ? "-9999 " : fmt::format("{} ", 100 + 7 * i + 3 * j);
        }
        text += "\n";
      }
      write_file(folder_ / (whole ? "whole.asc" : "grid.asc"), std::string_view(text));
    }
  }
};

TEST_F(Grounds, NotesOfADemReachTheTerminalAndTheRecord) {
  const std::string void_note = "1 of 120 samples are -9999", guess = "names no reference system";
  for (const char* const command :
       {"info grid.asc", "render grid.asc --size 40x30 --out a.png", "represent grid.asc --as heightmap",
        "run overview.relief --terrain grid.asc --set width=32 --set height=32 --out out"}) {
    const Outcome outcome = call(std::string("$T ") + command);
    EXPECT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_THAT(outcome.text, HasSubstr(void_note)) << command;
    EXPECT_THAT(outcome.text, HasSubstr(guess)) << command;
  }
  const Store store = Store::open(folder_ / "out");
  ASSERT_FALSE(store.records().empty());
  for (const Record& record : store.records()) {
    EXPECT_THAT(record.terrain_notes, Contains(HasSubstr(void_note)));
    EXPECT_THAT(record.terrain_notes, Contains(HasSubstr(guess)));
  }
}

TEST_F(Grounds, EveryCommandTakesOptionsOfADem) {
  const std::string name = "dem:grid.asc,nodata=none,unit=ft";
  for (const std::string& command :
       {"info " + name, "render " + name + " --size 40x30 --out a.png",
        "represent " + name + " --as heightmap --save a.tif",
        "run overview.relief --terrain " + name + " --set width=32 --set height=32 --out out"}) {
    const Outcome outcome = call("$T " + command);
    EXPECT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_THAT(outcome.text, HasSubstr("heights in 'ft' were converted")) << command;
    EXPECT_THAT(outcome.text, Not(HasSubstr("samples are -9999"))) << command;
  }
  EXPECT_FLOAT_EQ(read_dem(folder_ / "a.tif").heights.at(5, 5), -9999 * 0.3048F);
  EXPECT_EQ(Store::open(folder_ / "out").records()[0].terrain, name);
  EXPECT_EQ(call("$T run overview.relief --terrain dem:grid.asc,band=2 --out other").code, 2);
  EXPECT_EQ(call("$T run overview.relief --terrain dem:none.asc,band=1 --out other").code, 3);
}

TEST_F(Grounds, AGroundThatCannotBeReadIsRefusedBeforeAnythingIsMeasured) {
  write_file(folder_ / "words.asc",
             std::string_view("ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2\n3 four\n"));
  const Outcome outcome = call("$T run overview.relief --terrain grid.asc words.asc --out out");
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.text, HasSubstr("'four'"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/figures"));
}

TEST_F(Grounds, ARasterTooLargeToReadIsDescribed) {
  RasterFile file = metres();
  file.width = file.depth = 30000;
  file.type = GDT_Int16;
  file.options = {"SPARSE_OK=YES", "TILED=YES"};
  file.value = nullptr;
  file.write(folder_ / "big.tif");
  const Outcome outcome = call("$T info big.tif");
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_THAT(outcome.text, HasSubstr("(GTiff, Int16)"));
  EXPECT_THAT(outcome.text, HasSubstr("samples     30000 × 30000, cells 30 m × 30 m"));
  EXPECT_THAT(outcome.text, HasSubstr("heights were not read"));
}

TEST_F(Grounds, EventFilesAreTakenEverywhere) {
  write_file(folder_ / "events.toml",
             std::string_view("terrain = \"whole.asc\"\nsize = 12\n[[event]]\nkind = \"radial-erosion\"\n"
                              "centre = [150, 150, 150]\nradii = [60, 60, 60]\n"));
  for (const char* const command :
       {"info events.toml", "represent events.toml --as layered_stack --set resolution=16 --save a.tb",
        "render events.toml --samples 17 --size 40x30 --out a.png",
        "run overview.relief --terrain events.toml --set width=32 --set height=32 --out out"}) {
    const Outcome outcome = call(std::string("$T ") + command);
    EXPECT_EQ(outcome.code, 0) << command << outcome.text;
    EXPECT_THAT(outcome.text, HasSubstr("names no reference system")) << command;
  }
  EXPECT_EQ(call("$T represent events.toml --as heightmap --crop 0 0 4 4").code, 2);
}

TEST_F(Grounds, TheEventFileOfTheDocumentationIsOne) {
  const std::string page = read_file(std::filesystem::path(TERRABENCH_SOURCE_DIR) / "docs/grounds.md");
  const std::string fence = "```toml\n";
  const std::size_t begin = page.find(fence) + fence.size();
  write_file(folder_ / "events.toml", std::string_view(page).substr(begin, page.find("```", begin) - begin));
  const Outcome outcome = call("$T represent events.toml --as ght --save a.tb");
  EXPECT_EQ(outcome.code, 0) << outcome.text;
}

TEST_F(Grounds, SizesThatNoMemoryHoldsAreRefusedAtOnce) {
  for (const char* const command : {"represent topobathy --as heightmap --resample 65536 65536",
                                    "represent grid.asc --as heightmap --resample 65536 65536",
                                    "represent topobathy --as heightmap --set resolution=65535",
                                    "represent caves --as layered_stack --set resolution=65535",
                                    "represent caves --as implicit --set resolution=65535"}) {
    const Outcome outcome = call(std::string("timeout 60 $T ") + command);
    EXPECT_TRUE(outcome.code == 2 || outcome.code == 3 || outcome.code == 4) << command << outcome.code;
    EXPECT_THAT(outcome.text, testing::AnyOf(HasSubstr("more than"), HasSubstr("memory"))) << command;
  }
}

TEST_F(Grounds, FlowIsRoutedAsAsked) {
  write_geotiff(folder_ / "hill.tif", crop(*open_terrain("jacksboro").heights, 0, 0, 60, 50));
  ASSERT_EQ(call("$T represent hill.tif --as heightmap --write-flow a.tif").code, 0);
  ASSERT_EQ(call("$T represent hill.tif --as heightmap --write-flow b.tif --flow steepest").code, 0);
  const std::vector<float> lowest = read_dem(folder_ / "a.tif").heights.heights,
                           steepest = read_dem(folder_ / "b.tif").heights.heights;
  const FlowNetwork expected = route_steepest(read_dem(folder_ / "hill.tif").heights);
  ASSERT_EQ(steepest.size(), expected.accumulation.size());
  for (std::size_t i = 0; i < steepest.size(); ++i) {
    EXPECT_EQ(steepest[i], static_cast<float>(expected.accumulation[i])) << i;
  }
  EXPECT_NE(steepest, lowest);
  EXPECT_EQ(call("$T represent hill.tif --as heightmap --write-flow b.tif --flow d8").code, 2);
}

TEST_F(Grounds, AModelThatIsTooLongIsCalledAModel) {
  write_file(folder_ / "long.toml", "[base]\nshape = \"cube\"\n# " + std::string(2 << 20, 'x') + "\n");
  const Outcome outcome = call("$T represent long.toml --as procedural_mesh");
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.text, HasSubstr("1048576"));
  EXPECT_THAT(outcome.text, Not(HasSubstr("'terrain' is missing")));
}

}  // namespace
}  // namespace terrabench
