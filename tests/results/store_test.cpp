#include "results/store/store.h"

#include <gmock/gmock.h>

#include <limits>
#include <thread>

#include "results/store/record_json.h"
#include "terrain/error.h"
#include "tests/results/fake_results.h"
#include "tests/terrain/small_files.h"

namespace terrabench {
namespace {

using testing::HasSubstr;

using StoreTest = FolderTest;

Record timed(const Provenance& run, const std::string& name, double seconds) {
  Record record = fake_record(run, "hybrid.table2", name);
  add(record, "generation_time", "s", {seconds, 0.1 + seconds, 1.0 / 3});
  return record;
}

// A run and two cases.
void write_two(const std::filesystem::path& folder) {
  Store store(folder);
  const Provenance run = fake_provenance();
  store.begin_run(run);
  store.append(timed(run, "n=64", 0.25));
  store.append(timed(run, "n=128", 2.5));
}

TEST_F(StoreTest, GivesBackWhatWasAppended) {
  write_two(folder_);
  const Store store = Store::open(folder_);
  EXPECT_TRUE(store.warnings().empty());
  ASSERT_EQ(store.records().size(), 2U);
  const Record* const record = store.find("hybrid.table2", "n=128", "quick");
  ASSERT_NE(record, nullptr);
  EXPECT_EQ(record->find("generation_time")->samples, (std::vector{2.5, 2.6, 1.0 / 3}));
  EXPECT_EQ(record->find("generation_time")->unit, "s");
  EXPECT_EQ(record->find("other"), nullptr);
  EXPECT_EQ(record->seed, 1U);
  EXPECT_EQ(record->parameters.size(), 4U);
  EXPECT_FALSE(store.altered(*record));
  const Provenance* const run = store.run(record->run);
  ASSERT_NE(run, nullptr);
  EXPECT_EQ(run->cpu, fake_provenance().cpu);
  EXPECT_EQ(run->libraries, fake_provenance().libraries);
  EXPECT_EQ(store.profile(), "quick");
}

TEST_F(StoreTest, NewestRecordOfACaseWins) {
  write_two(folder_);
  Store(folder_).append(timed(fake_provenance(), "n=64", 99));
  const Store store = Store::open(folder_);
  EXPECT_EQ(store.records().size(), 2U);
  EXPECT_EQ(store.find("hybrid.table2", "n=64", "quick")->find("generation_time")->samples[0], 99);
  EXPECT_THAT(content(), HasSubstr("0.25")) << "nothing is ever taken out of the file";
}

TEST_F(StoreTest, KnowsTheLineOfARecord) {
  write_two(folder_);
  Store store(folder_);
  const auto where = [](const Store& s, const char* name) {
    return s.where(*s.find("hybrid.table2", name, "quick"));
  };
  EXPECT_EQ(where(store, "n=64"), file().string() + ":2");
  EXPECT_EQ(where(store, "n=128"), file().string() + ":3");
  store.append(timed(fake_provenance(), "n=64", 0.5));
  EXPECT_EQ(where(store, "n=64"), file().string() + ":4");
  EXPECT_EQ(where(Store(folder_), "n=64"), file().string() + ":4");
}

TEST_F(StoreTest, FindsAFigureAlteredByHand) {
  write_two(folder_);
  edit(file(), "2.5,2.6", "1.5,2.6");
  const Store store = Store::open(folder_);
  ASSERT_EQ(store.faults().size(), 1U);
  EXPECT_THAT(store.faults()[0], HasSubstr("measurements.jsonl:3: altered"));
  EXPECT_TRUE(store.altered(*store.find("hybrid.table2", "n=128", "quick")));
  EXPECT_FALSE(store.altered(*store.find("hybrid.table2", "n=64", "quick")));
}

// Wherever a kill cuts the file, what came before is used and the next append restores whole lines.
TEST_F(StoreTest, SurvivesACutAtEveryByte) {
  write_two(folder_);
  const std::string whole = content();
  const std::size_t last = whole.rfind('\n', whole.size() - 2) + 1;
  const Record again = timed(fake_provenance(), "n=128", 4);
  for (std::size_t size = last; size < whole.size();
       size += size < last + 5 || size + 5 > whole.size() ? 1 : 41) {
    write_file(file(), whole.substr(0, size));
    Store store(folder_);
    const bool complete = size + 1 == whole.size();  // only the newline is gone
    const bool cut = size > last && !complete;
    EXPECT_EQ(store.records().size(), complete ? 2U : 1U) << size;
    EXPECT_EQ(store.warnings().size(), cut ? 1U : 0U) << size;
    EXPECT_TRUE(store.faults().empty());
    store.append(again);
    const Store healed(folder_);
    EXPECT_TRUE(healed.warnings().empty()) << size;
    EXPECT_EQ(healed.find("hybrid.table2", "n=128", "quick")->find("generation_time")->samples[0], 4) << size;
  }
}

TEST_F(StoreTest, AppendsAllInOneStepAfterACutLine) {
  write_two(folder_);
  const std::string whole = content();
  const Provenance run = fake_provenance();
  const std::vector records{timed(run, "n=256", 4), timed(run, "n=512", 5)};
  for (const std::size_t missing : {0U, 1U, 30U}) {
    write_file(file(), whole.substr(0, whole.size() - missing));
    Store store(folder_);
    store.append_all({}, records);
    EXPECT_EQ(store.records().size(), missing == 30 ? 3U : 4U);
    EXPECT_NE(store.find("hybrid.table2", "n=512", "quick"), nullptr);
    EXPECT_TRUE(Store(folder_).warnings().empty()) << missing;
  }
  std::filesystem::remove_all(folder_);
  Store(folder_).append_all(std::vector{run}, records);
  EXPECT_EQ(Store::open(folder_).records().size(), 2U);
}

// A process that waited for the lock of a file that was replaced meanwhile must not append to the old one.
TEST_F(StoreTest, LosesNothingWhenOneReplacesWhileOthersAppend) {
  const Provenance run = fake_provenance();
  Store(folder_).begin_run(run);
  constexpr int kLines = 40;
  const auto append = [&](const std::string& who, bool all) {
    Store store(folder_);
    for (int i = 0; i < kLines; ++i) {
      const Record record = timed(run, who + std::to_string(i), i);
      all ? store.append_all({}, std::vector{record}) : store.append(record);
    }
  };
  std::thread a(append, "a", false), b(append, "b", false);
  append("c", true);
  a.join();
  b.join();
  const Store store = Store::open(folder_);
  EXPECT_EQ(store.records().size(), 3U * kLines);
  EXPECT_TRUE(store.warnings().empty());
}

// A kill cannot leave a whole line with another digest: somebody altered it and took the newline along.
TEST_F(StoreTest, AlteredLastLineIsAFaultEvenWithoutItsNewline) {
  write_two(folder_);
  edit(file(), "2.5,2.6", "1.5,2.6");
  std::string text = content();
  text.pop_back();
  write_file(file(), text);
  Store store(folder_);
  ASSERT_EQ(store.faults().size(), 1U);
  EXPECT_THAT(store.faults()[0], HasSubstr("measurements.jsonl:3: altered"));
  store.append(timed(fake_provenance(), "n=256", 20));
  EXPECT_EQ(Store(folder_).faults(), store.faults()) << "nothing is taken out of the file";
  EXPECT_EQ(Store(folder_).records().size(), 3U);
}

TEST_F(StoreTest, DamageInTheMiddleIsReportedAndTheRestUsed) {
  write_two(folder_);
  edit(file(), "\"seed\":1", "\"seed\":\"one\"");
  const Store store = Store::open(folder_);
  EXPECT_EQ(store.records().size(), 1U);
  ASSERT_EQ(store.faults().size(), 1U);
  EXPECT_THAT(store.faults()[0], HasSubstr("measurements.jsonl:2: 'seed' is not a natural number"));
}

TEST_F(StoreTest, RecordWithoutItsRunIsAFault) {
  write_two(folder_);
  const std::string text = content();
  write_file(file(), text.substr(text.find('\n') + 1));
  const Store store(folder_);
  EXPECT_EQ(store.faults().size(), 2U);
  EXPECT_THAT(store.faults()[0], HasSubstr("names a run that is not in the file"));
}

TEST_F(StoreTest, NothingMeasuredIsAnEmptyStoreButCannotBeOpenedForReading) {
  EXPECT_TRUE(Store(folder_).records().empty());
  EXPECT_TRUE(Store(folder_ / "not there").records().empty());
  EXPECT_THROW(Store::open(folder_), Error);
  EXPECT_THROW(Store::open(folder_ / "not there"), Error);
  write_file(file(), std::string_view(""));
  EXPECT_TRUE(Store(folder_).records().empty());
  EXPECT_THROW(Store::open(folder_), Error);
}

TEST_F(StoreTest, GarbageIsBadInput) {
  using namespace std::string_literals;
  const std::string noise = "\x89PNG\r\n\x1a\n\0\xff\xfe\n\n{}\n[1]\n"s;
  write_file(file(), std::string_view(noise));
  EXPECT_EQ(failure_of([&] { Store{folder_}; }).code, ExitCode::kBadInput);
  std::filesystem::remove(file());
  std::filesystem::create_directory(file());
  EXPECT_THROW(Store{folder_}, Error);
}

TEST_F(StoreTest, RefusesNumbersThatAreNotFinite) {
  Store store(folder_);
  const Provenance run = fake_provenance();
  store.begin_run(run);
  const std::string before = content();
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(store.append(timed(run, "n=64", bad)), Error);
  }
  EXPECT_EQ(content(), before);
}

TEST_F(StoreTest, FullDiskLeavesNoHalfLine) {
  write_two(folder_);
  const std::string before = content();
  const auto append = [&] { Store(folder_).append(timed(fake_provenance(), "n=256", 20)); };
  EXPECT_EQ(failure_with_small_files(before.size() + 20, append).code, ExitCode::kEnvironment);
  EXPECT_EQ(content(), before);
}

TEST_F(StoreTest, FolderThatCannotBeMadeIsAnEnvironmentError) {
  write_file(folder_ / "plain", std::string_view("x"));
  Store store(folder_ / "plain" / "inside");
  EXPECT_EQ(failure_of([&] { store.begin_run(fake_provenance()); }).code, ExitCode::kEnvironment);
}

TEST_F(StoreTest, ResumeKnowsACaseByAllThatDefinesIt) {
  write_fake_results(folder_, "quick");
  const Store store(folder_);
  const Record record = *store.find("hybrid.noise-stages", "F3", "quick");
  const Provenance run = fake_provenance();
  EXPECT_NE(store.find(record, run), nullptr);
  Record other = record;
  other.seed = 2;
  EXPECT_EQ(store.find(other, run), nullptr);
  other = record;
  std::ranges::reverse(other.parameters);
  EXPECT_NE(store.find(other, run), nullptr);
  other.parameters[0].second = std::int64_t{3};
  EXPECT_EQ(store.find(other, run), nullptr);
  other = record;
  other.terrain_checksum = "another";
  EXPECT_EQ(store.find(other, run), nullptr);
  other.terrain_checksum = "";
  EXPECT_NE(store.find(other, run), nullptr);
  other = record;
  other.profile = "paper";
  EXPECT_EQ(store.find(other, run), nullptr);
  const std::filesystem::path picture = folder_ / record.figures[0].file;
  const std::string bytes = read_file(picture);
  write_file(picture, bytes + "x");
  EXPECT_EQ(store.find(record, run), nullptr) << "its picture is another";
  write_file(picture, bytes);
  EXPECT_NE(store.find(record, run), nullptr);
  std::filesystem::remove(picture);
  EXPECT_EQ(store.find(record, run), nullptr) << "its picture is gone";
}

TEST_F(StoreTest, ResumeMeasuresAgainWhatAnotherBuildOrMachineMeasured) {
  write_two(folder_);
  const Store store(folder_);
  const Record record = *store.find("hybrid.table2", "n=64", "quick");
  const Provenance same = fake_provenance();
  const auto found_after = [&](auto change) {
    Provenance now = same;
    change(now);
    return store.find(record, now) != nullptr;
  };
  EXPECT_TRUE(
      found_after([](Provenance& p) { p.time = "later", p.command = "run --resume", p.id = "other"; }));
  EXPECT_FALSE(found_after([](Provenance& p) { p.git_revision = "fedcba"; }));
  EXPECT_FALSE(found_after([](Provenance& p) { p.git_dirty = true; })) << "clean figures stay clean";
  EXPECT_FALSE(found_after([](Provenance& p) { p.compiler = "Clang 15"; }));
  EXPECT_FALSE(found_after([](Provenance& p) { p.flags = "-O2"; }));
  EXPECT_FALSE(found_after([](Provenance& p) { p.cpu = "another"; }));
  EXPECT_FALSE(found_after([](Provenance& p) { p.threads = 1; }));
  EXPECT_FALSE(found_after([](Provenance& p) { p.simd = "SSE4"; }));
}

TEST_F(StoreTest, InterruptedRunOfADirtyBuildGoesOn) {
  Provenance dirty = fake_provenance();
  dirty.git_dirty = true;
  dirty.id = digest(dirty);
  Store store(folder_);
  store.begin_run(dirty);
  const Record record = timed(dirty, "n=64", 0.25);
  store.append(record);
  dirty.time = "later";
  EXPECT_NE(store.find(record, dirty), nullptr);
}

// The figure of a claim is the newest that was drawn with the experiment's own parameters, by whichever case.
TEST_F(StoreTest, FigureIsTheNewestWithoutOverriddenParameters) {
  Store store(folder_);
  const Provenance run = fake_provenance();
  store.begin_run(run);
  const auto draw = [&](const std::string& name, const std::string& profile, const std::string& caption) {
    Record record = fake_record(run, "e", name, profile);
    if (caption == "overridden") record.overrides = {"n=3"};
    record.figures = {{"p.F1", "figures/p.F1.png", caption, "0123"}};
    store.append(record);
  };
  EXPECT_EQ(store.find_figure("p.F1", "quick").second, nullptr);
  draw("a", "quick", "first");
  draw("b", "quick", "second");
  draw("c", "paper", "of another profile");
  draw("b (n=3)", "quick", "overridden");
  EXPECT_EQ(store.find_figure("p.F1", "quick").second->caption, "second");
  draw("a", "quick", "third");
  EXPECT_EQ(store.find_figure("p.F1", "quick").second->caption, "third");
  EXPECT_EQ(store.find_figure("p.F1", "quick").first->case_name, "a");
  EXPECT_EQ(Store(folder_).find_figure("p.F1", "quick").second->caption, "third");
  EXPECT_EQ(store.find_figure("p.F2", "quick").first, nullptr);
}

TEST_F(StoreTest, FindsProvenanceAlteredByHand) {
  write_two(folder_);
  edit(file(), "\"git_dirty\":false", "\"git_dirty\":true");
  EXPECT_FALSE(Store::open(folder_).faults().empty());
}

TEST_F(StoreTest, LastLineThatIsNoRecordIsAFault) {
  write_two(folder_);
  write_file(file(), content() + "{\"kind\":\"record\"}");
  ASSERT_EQ(Store(folder_).faults().size(), 1U);
}

}  // namespace
}  // namespace terrabench
