// The lines of measurements.jsonl are what docs/results.md and docs/measurements.schema.json say. A field
// that is written and not documented fails here.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "results/store/record_json.h"
#include "terrain/error.h"
#include "tests/results/fake_results.h"

namespace terrabench {
namespace {

using Json = nlohmann::json;
using testing::HasSubstr;

const std::filesystem::path kSource = TERRABENCH_SOURCE_DIR;

const Json& schema() {
  static const Json kSchemaFile = Json::parse(read_file(kSource / "docs/measurements.schema.json"));
  return kSchemaFile;
}

bool has_type(const Json& value, const std::string& type) {
  return type == "object"    ? value.is_object()
         : type == "array"   ? value.is_array()
         : type == "string"  ? value.is_string()
         : type == "boolean" ? value.is_boolean()
         : type == "integer" ? value.is_number_integer()
                             : type == "number" && value.is_number();
}

// Why the value does not follow the rule; empty if it does. Knows the words of JSON Schema that our file
// uses, and refuses others.
class Validator {
 public:
  std::string fault(const Json& value, const Json& rule, const std::string& where) const {
    for (const auto& [word, argument] : rule.items()) {
      const std::string found = check(word, argument, value, rule, where);
      if (!found.empty()) return found;
    }
    return "";
  }

 private:
  std::string check(const std::string& word, const Json& argument, const Json& value, const Json& rule,
                    const std::string& where) const {
    if (word == "description") return "";
    const auto unless = [&](bool good) {
      return good ? "" : fmt::format("{}: {} is not of {} {}", where, value.dump(), word, argument.dump());
    };
    if (word == "$ref")
      return fault(value, schema().at(Json::json_pointer(argument.get<std::string>().substr(1))), where);
    if (word == "type") {
      const Json types = argument.is_array() ? argument : Json::array({argument});
      return unless(std::ranges::any_of(types, [&](const Json& type) { return has_type(value, type); }));
    }
    if (word == "const") return unless(value == argument);
    if (word == "enum") return unless(std::ranges::count(argument, value) > 0);
    if (word == "minimum") return unless(value.get<double>() >= argument.get<double>());
    if (word == "maximum") return unless(value.get<double>() <= argument.get<double>());
    if (word == "minLength") return unless(value.get<std::string>().size() >= argument.get<std::size_t>());
    if (word == "maxLength") return unless(value.get<std::string>().size() <= argument.get<std::size_t>());
    if (word == "pattern") {
      return unless(std::regex_search(value.get<std::string>(), std::regex(argument.get<std::string>())));
    }
    if (word == "minItems") return unless(value.size() >= argument.get<std::size_t>());
    if (word == "required") {
      return unless(std::ranges::all_of(argument, [&](const Json& key) { return value.contains(key); }));
    }
    return members(word, argument, value, rule, where);
  }

  std::string members(const std::string& word, const Json& argument, const Json& value, const Json& rule,
                      const std::string& where) const {
    if (word == "items") {
      for (const Json& item : value) {
        if (const std::string found = fault(item, argument, where + "[]"); !found.empty()) return found;
      }
    } else if (word == "properties") {
      for (const auto& [key, rule_of_key] : argument.items()) {
        if (!value.contains(key)) continue;
        const std::string found = fault(value.at(key), rule_of_key, where + "." + key);
        if (!found.empty()) return found;
      }
    } else if (word == "additionalProperties") {
      for (const auto& [key, member] : value.items()) {
        if (rule.contains("properties") && rule.at("properties").contains(key)) continue;
        if (argument == false) return fmt::format("{}: field '{}' is not documented", where, key);
        if (const std::string found = fault(member, argument, where + "." + key); !found.empty())
          return found;
      }
    } else {
      return fmt::format("{}: the test does not know '{}'", where, word);
    }
    return "";
  }
};

std::string fault(const std::string& line) {
  const Json json = Json::parse(line);
  const std::string kind = json.at("kind");
  return Validator().fault(json, schema().at("$defs").at(kind), kind);
}

// With every optional field.
Record full_record() {
  Record record = fake_record(fake_provenance(), "hybrid.table2", "n=64 (n=3)");
  record.overrides = {"n=3"};
  record.terrain = "caves";
  record.terrain_checksum = checksum("caves");
  record.terrain_notes = {"3 of 24 samples hold no height"};
  record.parameters = {{"n", std::int64_t{3}}, {"x", 0.5}, {"on", true}, {"kind", std::string("a")}};
  add(record, "time", "s", {0.25, 1e-300});
  record.figures = {
      {"hybrid.F3", "figures/a.png", "A caption.", checksum("a"), FigureLayout{{{1, 2, 3, 4}}, {"a word"}}}};
  record.metrics[0].varies = true;
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

TEST(Schema, WhatIsWrittenIsDocumented) {
  EXPECT_EQ(fault(to_line(full_record())), "");
  EXPECT_EQ(fault(to_line(full_run())), "");
  Record least = full_record();
  least.overrides.clear();
  least.terrain_notes.clear();
  least.terrain = least.terrain_checksum = "";
  least.parameters.clear();
  least.metrics[0].varies = false;
  least.figures[0].layout.reset();
  EXPECT_EQ(fault(to_line(least)), "");
  EXPECT_EQ(fault(to_line(failed_record())), "");
  Provenance run = full_run();
  run.timing_warnings.clear();
  run.libraries.clear();
  EXPECT_EQ(fault(to_line(run)), "");
}

// Each documented field is one that can be written.
TEST(Schema, WhatIsDocumentedIsWritten) {
  Json record = Json::parse(to_line(full_record()));
  const Json run = Json::parse(to_line(full_run())), failed = Json::parse(to_line(failed_record()));
  for (const char* field : {"outcome", "reason"}) record[field] = failed.at(field);
  const std::map<std::string, Json> written{
      {"record", record}, {"run", run}, {"metric", record["metrics"][0]}, {"figure", record["figures"][0]}};
  for (const auto& [object, example] : written) {
    for (const auto& [field, rule] : schema().at("$defs").at(object).at("properties").items()) {
      if (field == "first_look") continue;  // of older records
      EXPECT_TRUE(example.contains(field)) << object << " " << field;
    }
  }
  EXPECT_EQ(record["schema"], kSchema);
  EXPECT_EQ(schema()["$defs"]["record"]["properties"]["schema"]["maximum"], kSchema);
}

TEST(Schema, RefusesWhatIsNotDocumented) {
  const auto changed = [](const char* pointer, const Json& value) {
    Json line = Json::parse(to_line(full_record()));
    line[Json::json_pointer(pointer)] = value;
    return fault(line.dump());
  };
  EXPECT_THAT(changed("/comment", "hello"), HasSubstr("'comment' is not documented"));
  EXPECT_THAT(changed("/metrics/0/mean", 1), HasSubstr("'mean' is not documented"));
  EXPECT_THAT(changed("/metrics/0/samples", Json::array()), HasSubstr("minItems"));
  EXPECT_THAT(changed("/metrics/0/samples/0", "1"), HasSubstr("type"));
  EXPECT_THAT(changed("/seed", -1), HasSubstr("minimum"));
  EXPECT_THAT(changed("/run", "F00"), HasSubstr("pattern"));
  EXPECT_THAT(changed("/parameters/n", nullptr), HasSubstr("type"));
}

TEST(Schema, TheResultsThatAreKeptFollowIt) {
  std::istringstream lines(read_file(kSource / "results/reference/measurements.jsonl"));
  int records = 0;
  for (std::string line; std::getline(lines, line);) {
    ASSERT_EQ(fault(line), "") << line.substr(0, 200);
    ++records;
  }
  EXPECT_GT(records, 1000);
}

// The page's tables, by heading: field, type.
std::map<std::string, std::map<std::string, std::string>> documented() {
  std::istringstream page(read_file(kSource / "docs/results.md"));
  std::map<std::string, std::map<std::string, std::string>> tables;
  std::string heading;
  const std::regex title("^## A (run|record|metric|figure)$"),
      row(R"(^\| `(\w+)` \| (\w+) \| ([^|]+) \| .+ \|$)");
  for (std::string line; std::getline(page, line);) {
    std::smatch match;
    if (line.starts_with("##")) heading = std::regex_match(line, match, title) ? match[1].str() : "";
    if (heading.empty() || !std::regex_match(line, match, row)) continue;
    tables[heading][match[1]] = match[2].str() + (match[3] == "yes" ? "" : ", optional");
  }
  return tables;
}

TEST(Schema, ThePageListsTheSameFields) {
  std::map<std::string, std::map<std::string, std::string>> expected;
  for (const auto& [object, rule] : schema().at("$defs").items()) {
    for (const auto& [field, rule_of_field] : rule.at("properties").items()) {
      const bool required = std::ranges::count(rule.at("required"), Json(field)) > 0;
      expected[object][field] = rule_of_field.at("type").get<std::string>() + (required ? "" : ", optional");
    }
  }
  EXPECT_EQ(documented(), expected);
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
