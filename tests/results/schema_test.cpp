// The lines of measurements.jsonl are what docs/results.md says. A field that is written and not documented
// fails here.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "results/store/record_json.h"
#include "terrain/error.h"
#include "tests/results/fake_results.h"

namespace terrabench {
namespace {

using Json = nlohmann::json;
using testing::HasSubstr;

const std::filesystem::path kSource = TERRABENCH_SOURCE_DIR;

// With every optional field.
Record full_record() {
  Record record = fake_record(fake_provenance(), "hybrid.table2", "n=64 (n=3)");
  record.overrides = {"n=3"};
  record.seconds = 1.5;
  record.terrain = "caves";
  record.terrain_checksum = checksum("caves");
  record.terrain_notes = {"3 of 24 samples hold no height"};
  record.parameters = {{"n", std::int64_t{3}}, {"x", 0.5}, {"on", true}, {"kind", std::string("a")}};
  add(record, "time", "s", {0.25, 1e-300});
  record.figures = {{"hybrid.F3", "figures/a.png", "A caption.", checksum("a"),
                     FigureLayout{{{1, 2, 3, 4}, {5, 2, 3, 4}}, {"a word"}, {1, 2}}}};
  record.metrics[0].varies = record.metrics[0].series = true;
  record.undefined = {{"ratio", "the ground is flat"}};
  return record;
}

// With the fields of one that has no metrics.
Record failed_record() {
  Record record = full_record();
  record.metrics.clear();
  record.figures.clear();
  record.outcome = CaseOutcome::kFailed;
  record.reason = "out of memory";
  return record;
}

Provenance full_run() {
  Provenance run = fake_provenance();
  run.libraries = {{"GDAL", "3.6.2"}};
  run.timing_warnings = {"the machine is busy"};
  return run;
}

// A line's objects, by the heading of docs/results.md that describes them.
std::map<std::string, std::vector<Json>> objects_of(const std::string& line) {
  const Json json = Json::parse(line);
  std::map<std::string, std::vector<Json>> objects{{json.at("kind"), {json}}};
  for (const auto& [key, object] : {std::pair{"metrics", "metric"}, std::pair{"figures", "figure"}}) {
    if (!json.contains(key)) continue;
    for (const Json& member : json.at(key)) objects[object].push_back(member);
  }
  return objects;
}

struct Field {
  std::string type;
  bool always = false;
  bool operator==(const Field&) const = default;
};
using Fields = std::map<std::string, std::map<std::string, Field>>;  // by heading, then by name

std::string type_of(const Json& value) {
  return value.is_number_integer() ? "integer" : value.is_number() ? "number" : value.type_name();
}

// The page's tables.
Fields documented() {
  std::istringstream page(read_file(kSource / "docs/results.md"));
  Fields tables;
  std::string heading;
  const std::regex title("^## A (run|record|metric|figure)$"),
      row(R"(^\| `(\w+)` \| (\w+) \| ([^|]+) \| .+ \|$)");
  for (std::string line; std::getline(page, line);) {
    std::smatch match;
    if (line.starts_with("##")) heading = std::regex_match(line, match, title) ? match[1].str() : "";
    if (heading.empty() || !std::regex_match(line, match, row)) continue;
    tables[heading][match[1]] = {match[2], match[3] == "yes"};
  }
  return tables;
}

TEST(Schema, ThePageListsTheFieldsThatAreWritten) {
  Record least = full_record();
  least.overrides.clear();
  least.seconds = 0;
  least.terrain_notes.clear();
  least.undefined.clear();
  least.metrics[0].varies = least.metrics[0].series = false;
  least.figures[0].layout.repeats.clear();
  Provenance run = full_run();
  run.timing_warnings.clear();
  Fields written;
  for (const std::string& line : {to_line(full_record()), to_line(failed_record()), to_line(full_run())}) {
    for (const auto& [object, all] : objects_of(line)) {
      for (const auto& [name, value] : all.at(0).items()) written[object][name] = {type_of(value), false};
    }
  }
  for (const std::string& line : {to_line(least), to_line(run)}) {
    for (const auto& [object, all] : objects_of(line)) {
      for (const auto& [name, value] : all.at(0).items()) written[object][name].always = true;
    }
  }
  written["metric"]["first_look"] = {"integer", false};  // in older records only
  EXPECT_EQ(documented(), written);
}

TEST(Schema, TheResultsThatAreKeptFollowThePage) {
  const Fields page = documented();
  std::istringstream lines(read_file(kSource / "results/reference/measurements.jsonl"));
  int records = 0;
  for (std::string line; std::getline(lines, line); ++records) {
    for (const auto& [object, all] : objects_of(line)) {
      for (const Json& member : all) {
        for (const auto& [name, value] : member.items()) {
          ASSERT_TRUE(page.at(object).contains(name)) << object << " " << name;
          ASSERT_EQ(type_of(value), page.at(object).at(name).type) << object << " " << name;
        }
        for (const auto& [name, field] : page.at(object)) {
          ASSERT_TRUE(!field.always || member.contains(name)) << object << " " << name;
        }
      }
    }
  }
  EXPECT_GT(records, 1000);
}

TEST(Schema, ALaterVersionIsRefusedAndAnEarlierOneRead) {
  const std::string line = to_line(full_record());
  Json json = Json::parse(line);
  json["schema"] = kSchema + 1;
  json["new_field"] = "means something";
  try {
    parse_line(json.dump(), "a.jsonl:7");
    ADD_FAILURE() << "accepted";
  } catch (const NewerSchema& error) {
    EXPECT_EQ(error.code(), ExitCode::kBadInput);
    EXPECT_THAT(error.what(), HasSubstr("a.jsonl:7"));
    EXPECT_THAT(error.what(),
                HasSubstr("written by a later terrabench: schema 3, and this one reads up to 2"));
  }
  for (const Json& wrong : {Json(1), Json(0), Json(-1), Json("2"), Json(2.5)}) {
    json["schema"] = wrong;
    EXPECT_THROW(parse_line(json.dump(), "there"), Error) << wrong;
  }
  json = Json::parse(line);
  json.erase("schema");
  json.erase("digest");
  json["digest"] = checksum(json.dump());
  const Line earlier = parse_line(json.dump(), "there");
  EXPECT_FALSE(earlier.altered);
  EXPECT_EQ(earlier.warning, "");
  EXPECT_EQ(to_line(std::get<Record>(earlier.content)), line);  // copied, it gets the present version
}

class SchemaFolder : public FolderTest {};

TEST_F(SchemaFolder, AFolderOfALaterVersionIsNotReadInPart) {
  Store store(folder_);
  const Provenance run = fake_provenance();
  store.begin_run(run);
  store.append(fake_record(run, "hybrid.table1", "n=64"));
  edit(file(), fmt::format("\"schema\":{}", kSchema), fmt::format("\"schema\":{}", kSchema + 1));
  EXPECT_THROW(Store{folder_}, NewerSchema);
  EXPECT_THROW(Store::open(folder_), NewerSchema);
}

}  // namespace
}  // namespace terrabench
