#include "terrain/temporary_name.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <set>

#include "terrain/files.h"
#include "tests/terrain/dead_process.h"
#include "tests/terrain/temporary_folder.h"
#include "tests/terrain/temporary_of.h"

namespace terrabench {
namespace {

using testing::UnorderedElementsAre;

TEST(TemporaryName, RemovesOnlyWhatADeadProcessOfThisMachineLeftOfTheSameTarget) {
  const TemporaryFolder folder;
  const std::string dead = std::to_string(dead_process()), runs = std::to_string(getppid());
  const std::vector<std::string> kept = {temporary_of("a", runs),
                                         temporary_of("a.b", dead),
                                         temporary_of("b", dead),
                                         temporary_of("a", "x" + dead),
                                         temporary_of("a", ""),
                                         temporary_of("a", "-1"),
                                         temporary_of("a", "0"),
                                         temporary_of("a", "99999999999999999999"),
                                         "a.another-host." + dead + ".tmp",
                                         "a." + dead + ".tmp",
                                         "a." + dead,
                                         "a.tmp",
                                         "a"};
  for (const std::string& name : kept) folder.write(name, "content");
  folder.write(temporary_of("a", dead), "content");
  EXPECT_EQ(temporary_name(folder / "a"), folder / temporary_of("a", std::to_string(getpid())));
  EXPECT_THAT(folder.names(), testing::UnorderedElementsAreArray(kept));
}

TEST(TemporaryName, MachinesHaveShortNamesOfTheirOwn) {
  EXPECT_EQ(machine_in_names("node17"), "node17");
  const std::vector<std::string> hosts = {"",
                                          "node.a",
                                          "node.b",
                                          "node_a",
                                          "a/b",
                                          "a\nb",
                                          "compute-node-of-a-large-machine-0001",
                                          "compute-node-of-a-large-machine-0002"};
  std::set<std::string> names;
  for (const std::string& host : hosts) {
    const std::string name = machine_in_names(host);
    names.insert(name);
    EXPECT_THAT(name, testing::MatchesRegex("[-_0-9a-zA-Z]{1,16}")) << host;
  }
  EXPECT_EQ(names.size(), hosts.size());
}

TEST(TemporaryName, RemovesFoldersWhole) {
  const TemporaryFolder folder;
  const std::string left = folder / temporary_of("a", std::to_string(dead_process()));
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
  folder.write(temporary_of("a.png", std::to_string(dead_process())), "half");
  write_file(folder / "a.png", std::string_view("whole"));
  EXPECT_THAT(folder.names(), UnorderedElementsAre("a.png"));
}

}  // namespace
}  // namespace terrabench
