#include "results/report/ground_name.h"

#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "results/report/report_tables.h"

namespace terrabench {
namespace {

using testing::ElementsAre;
using testing::MatchesRegex;

TEST(GroundId, KeepsWhatItCanOfTheFilesName) {
  EXPECT_THAT(ground_id("/home/me/alps-2.tif"), MatchesRegex("alps-2-[0-9a-f]{8}"));
  EXPECT_THAT(ground_id("dem:/home/me/alps.tif,crop=257x257"), MatchesRegex("alps-[0-9a-f]{8}"));
  EXPECT_THAT(ground_id("drawing:coast.png"), MatchesRegex("drawing_coast-[0-9a-f]{8}"));
  EXPECT_THAT(ground_id("x/Großer <b>&\"' $1.tif"), MatchesRegex("Gro_er_b_1-[0-9a-f]{8}"));
}

TEST(GroundId, IsSafeForAnyName) {
  for (const char* const ground :
       {"/", ".", "..", "../..", "a/.tif", "\xff\n\x01.tif", "x\\y:z*?.tif", "~", "-"}) {
    const std::string id = ground_id(ground);
    EXPECT_EQ(file_name(id), id) << ground;
    EXPECT_THAT(id, MatchesRegex("[A-Za-z0-9_-]+-[0-9a-f]{8}")) << ground;
  }
  EXPECT_EQ(ground_id("/x/" + std::string(250, 'a') + ".tif").size(), 49U);
}

TEST(GroundId, TellsApartWhatLooksAlike) {
  EXPECT_NE(ground_id("/x/alps.tif"), ground_id("/y/alps.tif"));
  EXPECT_NE(ground_id("/x/ä.tif"), ground_id("/x/ö.tif"));
  EXPECT_NE(ground_id("alps.tif"), ground_id("alps.hgt"));
}

std::vector<std::string> labels(const std::vector<std::string>& grounds) { return ground_labels(grounds); }

TEST(GroundLabels, AreFileNamesWithTheFoldersThatTellThemApart) {
  EXPECT_THAT(labels({"/home/me/alps.tif"}), ElementsAre("alps.tif"));
  EXPECT_THAT(labels({"/x/alps.tif", "/y/alps.tif", "/y/andes.tif"}),
              ElementsAre("x/alps.tif", "y/alps.tif", "andes.tif"));
  EXPECT_THAT(labels({"/a/z/alps.tif", "/b/z/alps.tif"}), ElementsAre("a/z/alps.tif", "b/z/alps.tif"));
  EXPECT_THAT(labels({"alps.tif", "/alps.tif", "old-alps.tif"}),
              ElementsAre("alps.tif", "/alps.tif", "old-alps.tif"));
  EXPECT_THAT(labels({"x/alps.tif", "alps.tif"}), ElementsAre("x/alps.tif", "alps.tif"));
  EXPECT_THAT(labels({"/x/coverage/", "/y/coverage/"}), ElementsAre("x/coverage/", "y/coverage/"));
  EXPECT_THAT(labels({"hills"}), ElementsAre("hills"));
}

TEST(GroundLabels, SayWhatPartOfADemWasRead) {
  EXPECT_THAT(
      labels({"dem:alps.tif,crop=257x129", "dem:/x/alps.tif,unit=ft,crop=9x5+100+0"}),
      ElementsAre("alps.tif, its middle 257 × 129", "alps.tif,unit=ft, 9 × 5 from column 100, row 0"));
}

TEST(GroundLabels, ReplacePathsAlone) {
  EXPECT_EQ(with_label("on /x/a.tif, /x/a.tif's", "/x/a.tif", "x/a.tif"), "on x/a.tif, x/a.tif's");
  EXPECT_EQ(with_label("on hills", "hills", "the hills"), "on hills");
  EXPECT_EQ(with_label("", "/x/a.tif", "a.tif"), "");
  EXPECT_EQ(with_label("on dem:a.tif,unit=ft", "dem:a.tif,unit=ft", "a.tif,unit=ft"), "on a.tif,unit=ft");
}

}  // namespace
}  // namespace terrabench
