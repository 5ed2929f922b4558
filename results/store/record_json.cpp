#include "results/store/record_json.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "results/store/format.h"
#include "terrain/error.h"
#include "terrain/files.h"

namespace terrabench {
namespace {

using Json = nlohmann::json;

// A line is an object of arrays of objects of arrays; anything deeper is no line of ours, and could exhaust
// the stack.
constexpr int kDeepest = 6;

// Every integer below is a double, and is written back as it was read.
constexpr double kExactIntegers = 9007199254740992;  // 2⁵³

struct Damaged {
  std::string what;
};

void require(bool good, std::string_view what) {
  if (!good) throw Damaged{std::string(what)};
}

// nlohmann::json keeps keys sorted and prints doubles with the fewest digits that read back the same, so the
// text of equal content is equal.
std::string canonical(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

std::string sealed(Json json) {
  json["digest"] = checksum(canonical(json));
  return canonical(json);
}

void check_finite(double number, const std::string& name) {
  if (!std::isfinite(number)) {
    throw bad_input(fmt::format("{} cannot be recorded", number), name,
                    "a measurement must be a finite number: the experiment is at fault");
  }
}

Json to_json(const Value& value, const std::string& name) {
  if (const auto* number = std::get_if<double>(&value)) check_finite(*number, name);
  return std::visit([](const auto& v) { return Json(v); }, value);
}

constexpr std::pair<const char*, std::string Provenance::*> kRunTexts[] = {
    {"time", &Provenance::time},
    {"command", &Provenance::command},
    {"git_revision", &Provenance::git_revision},
    {"compiler", &Provenance::compiler},
    {"flags", &Provenance::flags},
    {"build_type", &Provenance::build_type},
    {"cpu", &Provenance::cpu},
    {"os", &Provenance::os},
    {"gl_renderer", &Provenance::gl_renderer},
    {"simd", &Provenance::simd}};

Json to_json(const Provenance& p) {
  Json libraries = Json::object();
  for (const auto& [name, version] : p.libraries) libraries[name] = version;
  Json json = {{"kind", "run"},
               {"git_dirty", p.git_dirty},
               {"threads", p.threads},
               {"memory", p.memory},
               {"libraries", libraries}};
  for (const auto& [name, member] : kRunTexts) json[name] = p.*member;
  if (!p.timing_warnings.empty()) json["timing_warnings"] = p.timing_warnings;
  return json;
}

// One object of a line: typed access, and what was never asked for is what we do not know.
class Fields {
 public:
  Fields(const Json& json, std::string_view what) : json_(json) {
    require(json.is_object(), fmt::format("{} is not an object", what));
  }

  const Json& get(const char* name) {
    known_.insert(name);
    const auto it = json_.find(name);
    require(it != json_.end(), fmt::format("'{}' is missing", name));
    return *it;
  }
  std::string text(const char* name) {
    const Json& value = get(name);
    require(value.is_string(), fmt::format("'{}' is not text", name));
    return value.get<std::string>();
  }
  // Names become keys and table cells.
  std::string name(const char* field) {
    std::string value = text(field);
    const std::string fault = name_fault(value);
    require(fault.empty(), fmt::format("'{}' {}", field, fault));
    return value;
  }
  // One of these words, given by its place among them.
  std::size_t choice(const char* field, std::initializer_list<std::string_view> allowed) {
    const std::string value = text(field);
    const auto at = std::ranges::find(allowed, value);
    require(at != allowed.end(), fmt::format("'{}' is neither '{}'", field, fmt::join(allowed, "' nor '")));
    return static_cast<std::size_t>(at - allowed.begin());
  }
  std::uint64_t natural(const char* name) {
    const Json& value = get(name);
    require(value.is_number_unsigned(), fmt::format("'{}' is not a natural number", name));
    return value.get<std::uint64_t>();
  }
  double positive(const char* name) {
    const double value = get(name).is_number() ? get(name).get<double>() : 0;
    require(value > 0 && std::isfinite(value), fmt::format("'{}' is not a positive number", name));
    return value;
  }
  bool flag(const char* name) {
    const Json& value = get(name);
    require(value.is_boolean(), fmt::format("'{}' is neither true nor false", name));
    return value.get<bool>();
  }
  bool has(const char* name) const { return json_.contains(name); }
  const Json& array(const char* name) {
    const Json& value = get(name);
    require(value.is_array(), fmt::format("'{}' is not a list", name));
    return value;
  }
  std::vector<std::string> texts(const char* name) {
    std::vector<std::string> all;
    for (const Json& value : array(name)) {
      require(value.is_string(), fmt::format("'{}' holds what is not text", name));
      all.push_back(value.get<std::string>());
    }
    return all;
  }
  const Json& object(const char* name) {
    const Json& value = get(name);
    require(value.is_object(), fmt::format("'{}' is not an object", name));
    return value;
  }
  void note_unknown(std::string& warning) const {
    for (const auto& [key, value] : json_.items()) {
      if (!known_.contains(key) && warning.empty())
        warning = fmt::format("unknown field '{}' is ignored", key);
    }
  }

 private:
  const Json& json_;
  std::set<std::string, std::less<>> known_;
};

// Every text of a line may reach a terminal, which obeys control characters. `name`: of the field.
void require_printable(const Json& json, const std::string& name) {
  if (json.is_string()) {
    const auto& text = json.get_ref<const std::string&>();
    require(printable(text) == text, fmt::format("'{}' holds control characters", name));
  } else if (json.is_array()) {
    for (const Json& value : json) require_printable(value, name);
  } else if (json.is_object()) {
    for (const auto& [key, value] : json.items()) {
      require(printable(key) == key, "a field's name holds control characters");
      require_printable(value, key);
    }
  }
}

Value value_from(const Json& json, const std::string& name) {
  if (json.is_boolean()) return json.get<bool>();
  require(!json.is_number_unsigned() ||
              json.get<std::uint64_t>() <= std::uint64_t{std::numeric_limits<std::int64_t>::max()},
          fmt::format("parameter '{}' is larger than 2⁶³ − 1", name));
  if (json.is_number_integer()) return json.get<std::int64_t>();
  if (json.is_number_float()) return json.get<double>();
  require(json.is_string(), fmt::format("parameter '{}' is neither number, text, true nor false", name));
  return json.get<std::string>();
}

Metric metric_from(const Json& json, std::string& warning) {
  Fields fields(json, "a metric");
  Metric metric{fields.name("name"), fields.text("unit"), {}};
  const Json& samples = fields.array("samples");
  require(!samples.empty(), fmt::format("metric '{}' has no samples", metric.name));
  for (const Json& sample : samples) {
    require(sample.is_number(), fmt::format("a sample of '{}' is not a number", metric.name));
    metric.samples.push_back(sample.get<double>());
    require(!sample.is_number_integer() || std::abs(metric.samples.back()) < kExactIntegers,
            fmt::format("a sample of '{}' is an integer of more than 53 bits", metric.name));
  }
  if (fields.has("varies")) metric.varies = fields.flag("varies");
  if (fields.has("series")) metric.series = fields.flag("series");
  // Of older records: how many of the samples the first of two measurements gave.
  if (fields.has("first_look")) fields.natural("first_look");
  fields.note_unknown(warning);
  return metric;
}

std::vector<int> numbers_of(Fields& fields, const char* name, std::size_t per_entry) {
  std::vector<int> numbers;
  for (const Json& number : fields.array(name)) {
    require(number.is_number_unsigned() && number.get<std::uint64_t>() < 1'000'000,
            fmt::format("'{}' holds what is no natural number", name));
    numbers.push_back(number.get<int>());
  }
  require(numbers.size() % per_entry == 0 && numbers.size() <= 4000, fmt::format("'{}' is damaged", name));
  return numbers;
}

// Panels as one flat list: x, y, width and height of each.
FigureLayout layout_from(Fields& fields) {
  FigureLayout layout;
  const std::vector<int> numbers = numbers_of(fields, "panels", 4);
  for (std::size_t i = 0; i < numbers.size(); i += 4)
    layout.panels.push_back({numbers[i], numbers[i + 1], numbers[i + 2], numbers[i + 3]});
  layout.words = fields.texts("words");
  if (fields.has("repeats")) layout.repeats = numbers_of(fields, "repeats", 2);
  return layout;
}

RecordedFigure figure_from(const Json& json, std::string& warning) {
  Fields fields(json, "a figure");
  RecordedFigure figure{fields.name("id"), fields.name("file"), fields.text("caption"),
                        fields.text("checksum")};
  if (fields.has("panels")) figure.layout = layout_from(fields);  // older records may have none
  const std::filesystem::path path(figure.file);
  require(path.is_relative() && std::find(path.begin(), path.end(), "..") == path.end(),
          fmt::format("figure '{}' lies outside the results folder", figure.id));
  fields.note_unknown(warning);
  return figure;
}

// Records without the field are older than it.
void check_schema(Fields& fields, const std::string& where) {
  if (!fields.has("schema")) return;
  const std::uint64_t schema = fields.natural("schema");
  require(schema > 1, "'schema' is no version");
  if (schema <= kSchema) return;
  throw NewerSchema(
      ExitCode::kBadInput,
      fmt::format("written by a later terrabench: schema {}, and this one reads up to {}", schema, kSchema),
      where, "use the version that wrote it, or a later one");
}

// Why the case, or some of its metrics, have no value.
void read_absences(Fields& fields, Record& record) {
  if (fields.has("outcome")) {
    record.outcome =
        fields.choice("outcome", {"failed", "skipped"}) == 0 ? CaseOutcome::kFailed : CaseOutcome::kSkipped;
    record.reason = fields.text("reason");
    require(!record.reason.empty(), "'reason' is empty");
    require(record.metrics.empty() && record.figures.empty(), "a case that was not measured has results");
  }
  if (!fields.has("undefined")) return;
  for (const auto& [name, reason] : fields.object("undefined").items()) {
    require(name_fault(name).empty() && reason.is_string() && record.find(name) == nullptr,
            fmt::format("the reason why '{}' is not defined is damaged", name));
    record.undefined.emplace_back(name, reason.get<std::string>());
  }
}

Record record_from(Fields& fields, std::string& warning) {
  Record record;
  record.experiment = fields.name("experiment");
  record.case_name = fields.name("case");
  fields.choice("profile", {"quick", "paper"});  // what a claim may name: another would be judged by none
  record.profile = fields.text("profile");
  record.run = fields.name("run");
  record.seed = fields.natural("seed");
  record.terrain = fields.text("terrain");
  record.terrain_checksum = fields.text("terrain_checksum");
  if (fields.has("terrain_notes")) record.terrain_notes = fields.texts("terrain_notes");
  for (const auto& [name, value] : fields.object("parameters").items()) {
    record.parameters.emplace_back(name, value_from(value, name));
  }
  if (fields.has("overrides")) record.overrides = fields.texts("overrides");
  if (fields.has("seconds")) record.seconds = fields.positive("seconds");
  for (const Json& metric : fields.array("metrics")) record.metrics.push_back(metric_from(metric, warning));
  for (const Json& figure : fields.array("figures")) record.figures.push_back(figure_from(figure, warning));
  read_absences(fields, record);
  return record;
}

Provenance provenance_from(Fields& fields) {
  Provenance p;
  for (const auto& [name, member] : kRunTexts) p.*member = fields.text(name);
  p.git_dirty = fields.flag("git_dirty");
  const std::uint64_t threads = fields.natural("threads");
  require(threads < 1'000'000, "'threads' is too large");
  p.threads = static_cast<int>(threads);
  p.memory = fields.natural("memory");
  for (const auto& [name, version] : fields.object("libraries").items()) {
    require(version.is_string(), fmt::format("the version of '{}' is not text", name));
    p.libraries.emplace_back(name, version.get<std::string>());
  }
  if (fields.has("timing_warnings")) p.timing_warnings = fields.texts("timing_warnings");
  return p;
}

Line line_from(std::string_view text, const std::string& where) {
  Json json = Json::parse(text, [](int depth, Json::parse_event_t, Json&) {
    require(depth <= kDeepest, "is nested too deeply");
    return true;
  });
  require_printable(json, "line");
  Fields fields(json, "the line");
  Line line;
  check_schema(fields, where);
  const std::string kind = fields.text("kind"), digest = fields.name("digest");
  if (kind == "record") {
    line.content = record_from(fields, line.warning);
  } else {
    require(kind == "run", "'kind' is neither 'run' nor 'record'");
    line.content = provenance_from(fields);
  }
  fields.note_unknown(line.warning);
  json.erase("digest");
  line.altered = checksum(canonical(json)) != digest;
  if (auto* run = std::get_if<Provenance>(&line.content)) run->id = digest;
  return line;
}

}  // namespace

std::string name_fault(std::string_view text) {
  constexpr std::size_t kLongest = 200;
  if (text.empty()) return "is empty";
  if (text.size() > kLongest)
    return fmt::format("has {} bytes, at most {} are allowed", text.size(), kLongest);
  return printable(text) == text ? "" : "holds control characters";
}

std::string to_line(const Record& record) {
  const std::string where = record.experiment + "/" + record.case_name + "/";
  Json parameters = Json::object(), metrics = Json::array(), figures = Json::array();
  for (const auto& [name, value] : record.parameters) parameters[name] = to_json(value, where + name);
  for (const Metric& metric : record.metrics) {
    for (const double sample : metric.samples) check_finite(sample, where + metric.name);
    metrics.push_back({{"name", metric.name}, {"unit", metric.unit}, {"samples", metric.samples}});
    if (metric.varies) metrics.back()["varies"] = true;
    if (metric.series) metrics.back()["series"] = true;
  }
  for (const RecordedFigure& figure : record.figures) {
    Json& entry = figures.emplace_back(Json{{"id", figure.id},
                                            {"file", figure.file},
                                            {"caption", figure.caption},
                                            {"checksum", figure.checksum}});
    entry["panels"] = Json::array();
    for (const FigurePanel& p : figure.layout.panels)
      for (const int number : {p.x, p.y, p.width, p.height}) entry["panels"].push_back(number);
    entry["words"] = figure.layout.words;
    if (!figure.layout.repeats.empty()) entry["repeats"] = figure.layout.repeats;
  }
  Json line({{"kind", "record"},
             {"schema", kSchema},
             {"experiment", record.experiment},
             {"case", record.case_name},
             {"profile", record.profile},
             {"run", record.run},
             {"seed", record.seed},
             {"terrain", record.terrain},
             {"terrain_checksum", record.terrain_checksum},
             {"parameters", parameters},
             {"metrics", metrics},
             {"figures", figures}});
  if (!record.terrain_notes.empty()) line["terrain_notes"] = record.terrain_notes;
  if (!record.overrides.empty()) line["overrides"] = record.overrides;
  if (record.seconds > 0) line["seconds"] = std::max(1.0, std::round(1000 * record.seconds)) / 1000;
  if (record.outcome != CaseOutcome::kMeasured)
    line.update({{"outcome", name(record.outcome)}, {"reason", record.reason}});
  for (const auto& [metric, reason] : record.undefined) line["undefined"][metric] = reason;
  return sealed(std::move(line));
}

std::string to_line(const Provenance& provenance) { return sealed(to_json(provenance)); }
std::string digest(const Provenance& provenance) { return checksum(canonical(to_json(provenance))); }
bool is_complete_json(std::string_view text) { return Json::accept(text); }

Line parse_line(std::string_view text, const std::string& where) {
  std::string what;
  try {
    return line_from(text, where);
  } catch (const Damaged& damaged) {
    what = damaged.what;
  } catch (const Json::exception& error) {
    // The library's own text quotes the line; its kind is enough here.
    what = error.id == 406 ? "holds a number that is too large" : "is not valid JSON";
  }
  throw bad_input(what, where, "remove the line, or measure again into a new folder");
}

}  // namespace terrabench
