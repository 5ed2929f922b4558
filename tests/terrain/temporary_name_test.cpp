#include "terrain/temporary_name.h"

#include <gmock/gmock.h>

#include "terrain/files.h"
#include "tests/terrain/dead_process.h"
#include "tests/terrain/temporary_folder.h"

namespace terrabench {
namespace {

using testing::UnorderedElementsAre;

TEST(TemporaryName, RemovesOnlyWhatADeadProcessLeftOfTheSameTarget) {
  const TemporaryFolder folder;
  const std::string dead = std::to_string(dead_process()), runs = std::to_string(getppid());
  for (const std::string& name :
       std::vector<std::string>{"a." + dead + ".tmp", "a." + runs + ".tmp", "a.b." + dead + ".tmp",
                                "b." + dead + ".tmp", "a." + dead, "a.x" + dead + ".tmp", "a..tmp",
                                "a.-1.tmp", "a.0.tmp", "a.99999999999999999999.tmp", "a.tmp", "a"}) {
    folder.write(name, "content");
  }
  EXPECT_EQ(temporary_name(folder / "a"), folder / "a." + std::to_string(getpid()) + ".tmp");
  EXPECT_THAT(folder.names(),
              UnorderedElementsAre("a." + runs + ".tmp", "a.b." + dead + ".tmp", "b." + dead + ".tmp",
                                   "a." + dead, "a.x" + dead + ".tmp", "a..tmp", "a.-1.tmp", "a.0.tmp",
                                   "a.99999999999999999999.tmp", "a.tmp", "a"));
}

TEST(TemporaryName, RemovesFoldersWhole) {
  const TemporaryFolder folder;
  const std::string left = folder / "a." + std::to_string(dead_process()) + ".tmp";
  std::filesystem::create_directories(left + "/in/it");
  temporary_name(folder / "a");
  EXPECT_THAT(folder.names(), testing::IsEmpty());
}

TEST(TemporaryName, NeedsNoFolder) {
  const TemporaryFolder folder;
  temporary_name(folder / "not/there");
  EXPECT_THAT(temporary_name("name").string(), testing::StartsWith("name."));
}

TEST(TemporaryName, WritingAFileRemovesWhatAKilledWriterLeft) {
  const TemporaryFolder folder;
  folder.write("a.png." + std::to_string(dead_process()) + ".tmp", "half");
  write_file(folder / "a.png", std::string_view("whole"));
  EXPECT_THAT(folder.names(), UnorderedElementsAre("a.png"));
}

}  // namespace
}  // namespace terrabench
