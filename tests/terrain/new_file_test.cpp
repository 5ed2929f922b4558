// A new file appears whole or not at all.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "terrain/files.h"
#include "tests/terrain/errors.h"
#include "tests/terrain/temporary_folder.h"

namespace terrabench {
namespace {

TEST(NewFile, AppearsWhenItIsKept) {
  const TemporaryFolder folder;
  folder.write("a", "old");
  {
    NewFile file(folder / "a");
    file.append("new ");
    file.append("content");
    EXPECT_EQ(read_file(folder / "a"), "old");
    file.keep();
  }
  EXPECT_EQ(read_file(folder / "a"), "new content");
  EXPECT_EQ(folder.names().size(), 1U);
}

TEST(NewFile, LeavesTheOldOneUnlessItIsKept) {
  const TemporaryFolder folder;
  folder.write("a", "old");
  {
    NewFile file(folder / "a");
    file.append("half");
  }
  EXPECT_EQ(read_file(folder / "a"), "old");
  EXPECT_EQ(folder.names().size(), 1U);
}

TEST(NewFile, KeepsWhatALibraryPutThere) {
  const TemporaryFolder folder;
  NewFile file(folder / "new/a");
  std::filesystem::remove(file.temporary());  // as some libraries do before they write
  std::ofstream(file.temporary()) << "by name";
  file.keep();
  EXPECT_EQ(read_file(folder / "new/a"), "by name");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder / "new"), {}), 1);
}

TEST(NewFile, ALinkStaysALink) {
  const TemporaryFolder folder;
  folder.write("target", "old");
  std::filesystem::create_symlink(folder / "target", folder / "link");
  NewFile file(folder / "link");
  file.append("new");
  file.keep();
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
  EXPECT_EQ(read_file(folder / "target"), "new");
}

TEST(NewFile, RefusesWhatIsNoFile) {
  const TemporaryFolder folder;
  EXPECT_EQ(failure_of([&] { NewFile file(folder.path()); }).code, ExitCode::kEnvironment);
  EXPECT_EQ(failure_of([] { NewFile file("/dev/null"); }).code, ExitCode::kEnvironment);
  EXPECT_EQ(failure_of([] { NewFile file("/proc/terrabench/a"); }).code, ExitCode::kEnvironment);
}

}  // namespace
}  // namespace terrabench
