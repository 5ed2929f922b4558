#include "results/store/merge.h"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <random>

#include "results/store/record_json.h"
#include "terrain/error.h"
#include "tests/results/fake_results.h"

namespace terrabench {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class MergeTest : public FolderTest {
 protected:
  // Cases `first` to `last`, each with a count, a time and a picture.
  void write_shard(const std::string& name, int first, int last, const Provenance& run = fake_provenance(),
                   double bytes = 100) {
    Store store(folder_ / name);
    store.begin_run(run);
    for (int i = first; i <= last; ++i) {
      Record record = fake_record(run, "e", fmt(i));
      add(record, "bytes", "B", {bytes + i});
      add(record, "seconds", "s", {0.5, 0.25 * i});
      const std::string picture = "figures/" + fmt(i) + ".png", pixels = "picture of " + fmt(i);
      write_file(folder_ / name / picture, pixels);
      record.figures.push_back({fmt(i), picture, "A picture", checksum(pixels)});
      store.append(record);
    }
  }
  static std::string fmt(int i) { return "n=" + std::to_string(i); }
  Merged merge_into(const std::string& out, const std::vector<std::string>& names) {
    std::vector<std::filesystem::path> folders;
    for (const std::string& name : names) folders.push_back(folder_ / name);
    return merge(folder_ / out, folders);
  }
  std::string error_of(const std::vector<std::string>& names) {
    try {
      merge_into("out", names);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }
  std::vector<std::string> cases(const std::string& name) {
    std::vector<std::string> out;
    const Store store = Store::open(folder_ / name);
    EXPECT_TRUE(store.faults().empty() && store.warnings().empty());
    for (const Record& record : store.records()) {
      out.push_back(record.case_name);
      for (const RecordedFigure& figure : record.figures) EXPECT_TRUE(store.intact(figure)) << figure.file;
    }
    return out;
  }
  bool nothing_written() const { return !std::filesystem::exists(folder_ / "out"); }
};

Provenance run_of(const std::string& revision, const std::string& cpu) {
  Provenance run = fake_provenance();
  run.git_revision = revision;
  run.cpu = cpu;
  run.id = digest(run);
  return run;
}

TEST_F(MergeTest, JoinsShardsWithTheirPictures) {
  write_shard("a", 1, 3);
  write_shard("b", 4, 5);
  const Merged merged = merge_into("out", {"a", "b"});
  EXPECT_EQ(merged.copied, 5U);
  EXPECT_EQ(merged.machines, 1U);
  EXPECT_TRUE(merged.passed());
  EXPECT_THAT(cases("out"), ElementsAre("n=1", "n=2", "n=3", "n=4", "n=5"));
  const Store out = Store::open(folder_ / "out");
  EXPECT_EQ(out.find("e", "n=4", "quick")->find("seconds")->samples, (std::vector{0.5, 1.0}));
}

TEST_F(MergeTest, DoneAgainChangesNothing) {
  write_shard("a", 1, 3);
  merge_into("out", {"a"});
  const std::string before = read_file(folder_ / "out/measurements.jsonl");
  const Merged again = merge_into("out", {"a"});
  EXPECT_EQ(again.copied, 0U);
  EXPECT_EQ(again.present, 3U);
  EXPECT_EQ(again.repeated, 0U);
  EXPECT_EQ(read_file(folder_ / "out/measurements.jsonl"), before);
}

TEST_F(MergeTest, TakesAShardWithoutCases) {
  write_shard("a", 1, 2);
  write_shard("empty", 1, 0);
  EXPECT_EQ(merge_into("out", {"empty", "a"}).copied, 2U);
}

TEST_F(MergeTest, RefusesMixedRevisionsAndSaysWhich) {
  write_shard("a", 1, 2);
  write_shard("b", 3, 4, run_of("0123abc", fake_provenance().cpu));
  const std::string error = error_of({"a", "b"});
  EXPECT_THAT(error, HasSubstr("0123abc"));
  EXPECT_THAT(error, HasSubstr(fake_provenance().git_revision));
  EXPECT_THAT(error, HasSubstr("b/measurements.jsonl:2"));
  EXPECT_TRUE(nothing_written());
}

TEST_F(MergeTest, RefusesAlteredLinesAndChangedPictures) {
  write_shard("a", 1, 2);
  edit(folder_ / "a/measurements.jsonl", "102", "103");
  EXPECT_THAT(error_of({"a"}), HasSubstr("a/measurements.jsonl:3: altered"));
  write_shard("b", 1, 2);
  write_file(folder_ / "b/figures/n=2.png", std::string_view("another picture"));
  EXPECT_THAT(error_of({"b"}), HasSubstr("figures/n=2.png"));
  std::filesystem::remove(folder_ / "b/figures/n=2.png");
  EXPECT_THAT(error_of({"b"}), HasSubstr("b/measurements.jsonl:3"));
  EXPECT_TRUE(nothing_written());
}

TEST_F(MergeTest, ComparesExactFiguresOfACaseMeasuredTwice) {
  const Provenance other = run_of(fake_provenance().git_revision, "another CPU");
  write_shard("a", 1, 2);
  write_shard("same", 2, 3, other);
  write_shard("differs", 2, 2, other, 200);
  const Merged same = merge_into("out", {"a", "same"});
  EXPECT_TRUE(same.passed());
  EXPECT_EQ(same.repeated, 1U);
  EXPECT_EQ(same.machines, 2U);
  EXPECT_THAT(merge_text(same), HasSubstr("2 machines"));
  const Merged differs = merge_into("out2", {"a", "differs"});
  EXPECT_FALSE(differs.passed());
  ASSERT_EQ(differs.contradictions.size(), 1U) << "times may differ";
  EXPECT_THAT(differs.contradictions[0], HasSubstr("e n=2 bytes: 102 B in"));
  EXPECT_THAT(differs.contradictions[0], HasSubstr("on A processor <of & for> tests, 2 threads"));
  EXPECT_THAT(differs.contradictions[0], HasSubstr("on another CPU, 2 threads"));
  EXPECT_EQ(Store::open(folder_ / "out2").find("e", "n=2", "quick")->find("bytes")->samples[0], 102);
  write_shard("one byte more", 2, 2, other, 101);
  EXPECT_FALSE(merge_into("out3", {"a", "one byte more"}).passed());
}

TEST_F(MergeTest, RefusesWhatIsNoResultsFolder) {
  EXPECT_THAT(error_of({"nowhere"}), HasSubstr("holds no measurements"));
  write_shard("out", 1, 1);
  EXPECT_THAT(error_of({"out"}), HasSubstr("also an input"));
}

// Whenever a merge is killed, the folder holds its old records or all of the new ones, and the same command
// completes it.
TEST_F(MergeTest, KilledLeavesTheOldRecordsOrAllOfTheNew) {
  write_shard("old", 1, 3);
  write_shard("a", 4, 8);
  write_shard("b", 9, 12);
  const auto lines = [&](const std::string& name) {
    return read_file(folder_ / name / "measurements.jsonl");
  };
  std::filesystem::copy(folder_ / "old", folder_ / "whole", std::filesystem::copy_options::recursive);
  merge_into("whole", {"a", "b"});
  const std::string before = lines("old"), after = lines("whole");
  std::mt19937 random(1);
  int killed = 0;
  for (int i = 0; i < 24; ++i) {
    if (i % 4 == 0) {
      std::filesystem::remove_all(folder_ / "out");
      std::filesystem::copy(folder_ / "old", folder_ / "out", std::filesystem::copy_options::recursive);
    }
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      merge_into("out", {"a", "b"});
      _exit(0);
    }
    usleep(random() % 6000);
    kill(child, SIGKILL);
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    killed += WIFSIGNALED(status) ? 1 : 0;
    const std::string now = lines("out");
    EXPECT_TRUE(now == before || now == after) << now;
    EXPECT_EQ(cases("out").size(), now == before ? 3U : 12U);
    if (i % 4 == 3) {
      merge_into("out", {"a", "b"});
      EXPECT_EQ(lines("out"), after);
      EXPECT_EQ(cases("out").size(), 12U);
    }
  }
  EXPECT_GT(killed, 0);
}

// Also of cases that only one folder holds.
TEST_F(MergeTest, RefusesAnotherSeedAndAChangedFile) {
  const auto write = [&](const std::string& name, int i, std::uint64_t seed, const std::string& terrain,
                         const std::string& content) {
    Store store(folder_ / name);
    store.begin_run(fake_provenance());
    Record record = fake_record(fake_provenance(), "e", fmt(i));
    record.seed = seed;
    record.terrain = terrain;
    record.terrain_checksum = checksum(content);
    store.append(record);
  };
  write("a", 1, 1, "my.tif", "ground");
  write("seed", 2, 2, "my.tif", "ground");
  write("seed of a case", 1, 7, "my.tif", "ground");
  write("changed", 3, 1, "my.tif", "another ground");
  write("generated", 4, 1, "fractal", "65");
  write("larger", 5, 1, "fractal", "129");
  EXPECT_THAT(error_of({"a", "seed"}), testing::AllOf(HasSubstr("seed 2"), HasSubstr("seed 1")));
  EXPECT_THAT(error_of({"a", "seed of a case"}), HasSubstr("with seed 7"));
  EXPECT_THAT(error_of({"a", "changed"}), testing::AllOf(HasSubstr("my.tif"), HasSubstr("changed/meas")));
  EXPECT_TRUE(nothing_written());
  EXPECT_EQ(merge_into("out", {"a", "generated", "larger"}).copied, 3U)
      << "a name may stand for several sizes";
}

TEST_F(MergeTest, ACaseThatFailedGivesWayToOneThatDidNot) {
  write_shard("good", 1, 1);
  Store store(folder_ / "bad");
  store.begin_run(fake_provenance());
  Record failed = fake_record(fake_provenance(), "e", fmt(1));
  failed.terrain_checksum = "";
  failed.outcome = CaseOutcome::kFailed;
  failed.reason = "out of memory";
  store.append(failed);
  for (const auto& order : {std::vector<std::string>{"bad", "good"}, {"good", "bad"}}) {
    std::filesystem::remove_all(folder_ / "out");
    EXPECT_TRUE(merge_into("out", order).passed());
    EXPECT_THAT(cases("out"), ElementsAre("n=1"));
    EXPECT_NE(Store::open(folder_ / "out").find("e", "n=1", "quick")->find("bytes"), nullptr);
  }
  std::filesystem::copy(folder_ / "bad", folder_ / "grown");
  merge_into("grown", {"good"});
  EXPECT_NE(Store::open(folder_ / "grown").find("e", "n=1", "quick")->find("bytes"), nullptr);
}

}  // namespace
}  // namespace terrabench
