#include "results/store/record_json.h"

#include <gmock/gmock.h>

#include <limits>

#include "terrain/error.h"
#include "tests/results/fake_results.h"
#include "tests/terrain/errors.h"

namespace terrabench {
namespace {

using testing::HasSubstr;

Record sample() {
  Record record = fake_record(fake_provenance(), "hybrid.table2", "n=64");
  add(record, "generation_time", "s", {0.25, 0.35, 1.0 / 3});
  return record;
}

void expect_bad_input(const std::string& line, const std::string& what) {
  const Failure failure = failure_of([&] { parse_line(line, "there:3"); });
  EXPECT_EQ(failure.code, ExitCode::kBadInput) << line.substr(0, 100);
  EXPECT_THAT(failure.what, testing::AllOf(HasSubstr("there:3"), HasSubstr(what)));
}

TEST(RecordLine, RefusesInvalidLines) {
  const std::string good = to_line(sample());
  const auto changed = [&](std::string_view from, std::string_view to) {
    std::string line = good;
    const std::size_t at = line.find(from);
    EXPECT_NE(at, line.npos) << from;
    return line.replace(at, from.size(), to);
  };
  expect_bad_input("", "not valid JSON");
  expect_bad_input("null", "not an object");
  expect_bad_input("{}", "'kind' is missing");
  expect_bad_input(good.substr(0, good.size() / 2), "not valid JSON");
  expect_bad_input(changed("\"record\"", "\"recrod\""), "'kind' is neither");
  expect_bad_input(changed("0.25", "NaN"), "not valid JSON");
  expect_bad_input(changed("0.25", "1e999"), "too large");
  expect_bad_input(changed("0.25", "\"0.25\""), "is not a number");
  expect_bad_input(changed("[0.25,0.35,0.3333333333333333]", "[]"), "has no samples");
  expect_bad_input(changed("\"hybrid.table2\"", "7"), "'experiment' is not text");
  expect_bad_input(changed("hybrid.table2", "hybrid\\u001b[31m"), "control characters");
  for (const char* bad :
       {"\\u0007", "\\n", "\\u007f", "\\u0085", "\\u009b31m", "\xc2\x9b", "\\ufffe", "\\uffff"}) {
    expect_bad_input(changed("hybrid.table2", std::string("hybrid") + bad), "'experiment' holds control");
    expect_bad_input(changed("\"unit\":\"s", std::string("\"unit\":\"s") + bad), "'unit' holds control");
    expect_bad_input(changed("\"terrain\":\"", std::string("\"terrain\":\"") + bad),
                     "'terrain' holds control");
    expect_bad_input(changed("\"parameters\":{", std::string("\"parameters\":{\"a") + bad + "\":1,"),
                     "name holds control");
    expect_bad_input(changed("\"kind\"", std::string("\"a") + bad + "\":1,\"kind\""), "name holds control");
  }
  for (const char* number : {"9223372036854775808", "18446744073709551615"}) {
    expect_bad_input(changed("\"parameters\":{", std::string("\"parameters\":{\"a\":") + number + ","),
                     "'a' is larger than 2⁶³ − 1");
  }
  expect_bad_input(changed("0.25", "9007199254740993"), "more than 53 bits");
  expect_bad_input(changed("0.25", "-9007199254740993"), "more than 53 bits");
  expect_bad_input(changed("\"figures\":[]", "\"figures\":{}"), "'figures' is not a list");
  for (const char* path : {"../secret.png", "/etc/passwd", "figures/../../x.png"}) {
    const std::string figure =
        std::string(R"("figures":[{"id":"a","file":")") + path + R"(","caption":"","checksum":""}])";
    expect_bad_input(changed("\"figures\":[]", figure), "outside the results folder");
  }
  expect_bad_input(std::string(2'000'000, '['), "nested too deeply");
}

TEST(RecordLine, KeepsTheLargestIntegers) {
  Record record = sample();
  for (const std::int64_t value :
       {std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max()}) {
    record.parameters = {{"a", value}};
    const std::string line = to_line(record);
    EXPECT_EQ(to_line(std::get<Record>(parse_line(line, "there:3").content)), line);
  }
}

TEST(RecordLine, KeepsWhetherAMetricVariesAndWhetherItIsASeries) {
  Record record = sample();
  record.metrics.push_back({"ratio", "", {2}, true});
  record.metrics.push_back({"update", "s", {2, 3}, false, true});
  const std::string line = to_line(record);
  const auto read = std::get<Record>(parse_line(line, "there:3").content);
  EXPECT_FALSE(read.metrics[0].varies);
  EXPECT_TRUE(read.metrics[1].varies);
  EXPECT_EQ(to_line(read), line);
  EXPECT_FALSE(read.metrics[1].series);
  EXPECT_TRUE(read.metrics[2].series);
  EXPECT_EQ(to_line(sample()).find("varies"), std::string::npos);
  EXPECT_EQ(to_line(sample()).find("series"), std::string::npos);
}

// Older records say how many samples the first of two measurements gave.
TEST(RecordLine, ReadsASecondMeasurementOfOlderRecords) {
  std::string line = to_line(sample());
  line.insert(line.find("\"name\":"), "\"first_look\":2,");
  const Line parsed = parse_line(line, "there:3");
  EXPECT_EQ(parsed.warning, "");
  EXPECT_EQ(std::get<Record>(parsed.content).metrics[0].samples.size(), 3U);
}

TEST(RecordLine, KeepsOverrides) {
  const auto overrides = [](const std::string& line) {
    return std::get<Record>(parse_line(line, "there:3").content).overrides;
  };
  Record record = sample();
  EXPECT_TRUE(overrides(to_line(record)).empty());
  record.overrides = {"n=3", "w=4"};
  EXPECT_EQ(overrides(to_line(record)), record.overrides);
}

TEST(RecordLine, UnknownFieldIsIgnoredWithAWarningAndCountsAsAltered) {
  std::string line = to_line(sample());
  line.insert(1, "\"comment\":\"hello\",");
  const Line parsed = parse_line(line, "x");
  EXPECT_EQ(parsed.warning, "unknown field 'comment' is ignored");
  EXPECT_TRUE(parsed.altered);
}

TEST(RecordLine, AcceptsBytesThatAreNotUtf8) {
  Provenance run = fake_provenance();
  run.command = "terrabench run \xff\xfe";
  const Line line = parse_line(to_line(run), "x");
  EXPECT_FALSE(line.altered);
  EXPECT_EQ(std::get<Provenance>(line.content).id, digest(run));
}

// Stores that were written before there were timing warnings have no such field and keep their digest.
TEST(RunLine, TimingWarningsAreOptional) {
  Provenance run = fake_provenance();
  EXPECT_EQ(to_line(run).find("timing_warnings"), std::string::npos);
  EXPECT_TRUE(std::get<Provenance>(parse_line(to_line(run), "x").content).timing_warnings.empty());
  run.timing_warnings = {"the machine is busy", "debug build"};
  run.id = digest(run);
  const Line line = parse_line(to_line(run), "x");
  EXPECT_FALSE(line.altered);
  EXPECT_EQ(line.warning, "");
  EXPECT_EQ(std::get<Provenance>(line.content).timing_warnings, run.timing_warnings);
  EXPECT_EQ(std::get<Provenance>(line.content).id, run.id);
}

TEST(RecordLine, KeepsWhatBecameOfACaseAndWhatIsNotDefined) {
  Record failed = fake_record(fake_provenance(), "hybrid.table2", "n=64");
  failed.outcome = CaseOutcome::kFailed;
  failed.reason = "it broke";
  const std::string line = to_line(failed);
  const auto read = std::get<Record>(parse_line(line, "there:3").content);
  EXPECT_EQ(read.outcome, CaseOutcome::kFailed);
  EXPECT_EQ(read.why_absent("generation_time")->word, "failed");
  EXPECT_EQ(read.why_absent("generation_time")->reason, "it broke");
  EXPECT_EQ(to_line(read), line);
  const auto changed = [](std::string text, std::string_view from, std::string_view to) {
    return text.replace(text.find(from), from.size(), to);
  };
  expect_bad_input(changed(line, "\"failed\"", "\"measured\""),
                   "'outcome' is neither 'failed' nor 'skipped'");
  expect_bad_input(changed(line, "it broke", ""), "'reason' is empty");
  expect_bad_input(changed(line, "\"metrics\":[]", R"("metrics":[{"name":"m","samples":[1],"unit":""}])"),
                   "a case that was not measured has results");
  Record flat = sample();
  flat.undefined = {{"relative_error", "the ground is flat"}};
  const auto undefined = std::get<Record>(parse_line(to_line(flat), "there:3").content);
  EXPECT_EQ(undefined.why_absent("relative_error")->word, "not defined");
  EXPECT_FALSE(undefined.why_absent("another"));
  EXPECT_EQ(to_line(sample()).find("undefined"), std::string::npos);
  flat.undefined = {{"generation_time", "it has a value, too"}};
  expect_bad_input(to_line(flat), "generation_time");
}

// No claim names another profile: its records would be judged by none.
TEST(RecordLine, RefusesUnknownProfiles) {
  Record record = sample();
  record.profile = "nightly";
  expect_bad_input(to_line(record), "'profile' is neither 'quick' nor 'paper'");
}

}  // namespace
}  // namespace terrabench
