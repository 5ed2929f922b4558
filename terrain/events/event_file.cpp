#include "terrain/events/event_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "terrain/error.h"
#include "terrain/events/evaluate.h"
#include "terrain/sources/fractal/diamond_square.h"
#include "terrain/spelling.h"
#include "terrain/toml.h"

namespace terrabench::events {
namespace {

constexpr std::size_t kMostEvents = 20000;
constexpr int kMostSamples = 8193;  // per side

std::string place(const std::string& origin, std::size_t line) { return fmt::format("{}:{}", origin, line); }

[[noreturn]] void fail(const toml::node& node, const std::string& origin, std::string_view what,
                       std::string_view advice) {
  throw bad_input(what, place(origin, node.source().begin.line), advice);
}

// Reads the keys of one table by type; a key that was not read is an error.
class Entry {
 public:
  Entry(const toml::table& table, const std::string& origin) : table_(table), origin_(origin) {}

  const toml::node* find(std::string_view key) {
    known_.insert(key);
    return table_.get(key);
  }
  const toml::node& get(std::string_view key) {
    const toml::node* const node = find(key);
    if (node == nullptr) fail(table_, origin_, missing_key(key, table_), "add it");
    return *node;
  }
  std::string text(std::string_view key) {
    const toml::node& node = get(key);
    if (!node.is_string()) fail(node, origin_, fmt::format("'{}' must be text", key), "put it in quotes");
    return node.ref<std::string>();
  }
  std::int64_t integer_or(std::string_view key, std::int64_t fallback, std::int64_t lowest,
                          std::int64_t highest) {
    const toml::node* const node = find(key);
    if (node == nullptr) return fallback;
    if (!node->is_integer() || node->ref<std::int64_t>() < lowest || node->ref<std::int64_t>() > highest) {
      fail(*node, origin_, fmt::format("'{}' must be an integer from {} to {}", key, lowest, highest),
           "correct the value");
    }
    return node->ref<std::int64_t>();
  }
  void read(std::string_view key, double& value) { value = number_of(get(key), key); }
  void read(std::string_view key, std::uint64_t& value) {
    value = static_cast<std::uint64_t>(integer_or(key, 0, 0, INT64_MAX));
  }
  void read(std::string_view key, glm::dvec2& point) { point = pair_of(get(key), key); }
  void read(std::string_view key, glm::dvec3& point) {
    const toml::array& array = list_of(get(key), key, 3);
    point = {number_of(array[0], key), number_of(array[1], key), number_of(array[2], key)};
  }
  void read(std::string_view key, std::vector<glm::dvec2>& points) {
    for (const toml::node& node : list_of(get(key), key, 0)) points.push_back(pair_of(node, key));
  }
  void refuse_unknown() const {
    for (const auto& [key, value] : table_) {
      if (known_.contains(key.str())) continue;
      fail(value, origin_,
           unknown_key(key.str(), std::vector<std::string_view>(known_.begin(), known_.end())),
           fmt::format("known: {}", fmt::join(known_, ", ")));
    }
  }

 private:
  double number_of(const toml::node& node, std::string_view key) const {
    const std::optional<double> value = node.is_number() ? node.value<double>() : std::nullopt;
    if (!value) fail(node, origin_, fmt::format("expected a number in '{}'", key), "write a number here");
    return *value;
  }
  // Of any size when `size` is 0.
  const toml::array& list_of(const toml::node& node, std::string_view key, std::size_t size) const {
    const toml::array* const array = node.as_array();
    if (array == nullptr || (size > 0 && array->size() != size)) {
      fail(node, origin_,
           fmt::format("expected a list of {} in '{}'", size > 0 ? fmt::format("{} numbers", size) : "points",
                       key),
           "write numbers in square brackets");
    }
    return *array;
  }
  glm::dvec2 pair_of(const toml::node& node, std::string_view key) const {
    const toml::array& array = list_of(node, key, 2);
    return {number_of(array[0], key), number_of(array[1], key)};
  }

  const toml::table& table_;
  const std::string& origin_;
  std::set<std::string_view> known_;
};

Kind kind_of(Entry& entry, const toml::table& table, const std::string& origin) {
  const std::string text = entry.text("kind");
  std::vector<std::string_view> names;
  for (int k = 0; k < kKinds; ++k) {
    if (name(static_cast<Kind>(k)) == text) return static_cast<Kind>(k);
    names.push_back(name(static_cast<Kind>(k)));
  }
  fail(*table.get("kind"), origin, fmt::format("unknown kind of event '{}'", text),
       fmt::format("known: {}", fmt::join(names, ", ")));
}

constexpr bool kOptional = true;

// Calls visit(key, field) or visit(key, field, kOptional) for the fields of an event, in the order of a file.
template <class E, class Visit>
void each_field(E& e, const Visit& visit) {
  if constexpr (requires { e.centre; }) visit("centre", e.centre), visit("radii", e.radii);
  if constexpr (requires { e.from; }) visit("from", e.from), visit("to", e.to);
  if constexpr (requires { e.slope; }) visit("depth", e.depth), visit("slope", e.slope, kOptional);
  if constexpr (requires { e.extent; }) visit("extent", e.extent);
  if constexpr (requires { e.dip; }) visit("throw", e.rise), visit("dip", e.dip, kOptional);
  if constexpr (requires { e.slip; }) visit("slip", e.slip);
  if constexpr (requires { e.section; }) {
    visit("section", e.section);
    visit("scale_from", e.scale_from, kOptional);
    visit("scale_to", e.scale_to, kOptional);
    visit("roughness", e.roughness, kOptional);
    visit("seed", e.seed, kOptional);
  }
}

// An event of a kind, with the default values of its fields.
Event default_event(Kind kind) {
  const Event events[kKinds] = {LinearErosion{},           RadialErosion{}, DipFault{},
                                DipFault{.inverse = true}, LateralFault{},  Carving{},
                                Carving{.cave = true}};
  return events[static_cast<std::size_t>(kind)];
}

Event event_from(const toml::node& node, const std::string& origin) {
  if (!node.is_table()) fail(node, origin, "an event must be a table", "begin each with [[event]]");
  const toml::table& table = *node.as_table();
  Entry entry(table, origin);
  Event event = default_event(kind_of(entry, table, origin));
  const auto read = [&](std::string_view key, auto& field, bool optional = false) {
    if (!optional || entry.find(key) != nullptr) entry.read(key, field);
  };
  std::visit([&](auto& e) { each_field(e, read); }, event);
  entry.refuse_unknown();
  return event;
}

template <class Number>
std::string text_of(Number value) {
  return fmt::format("{}", value);
}
std::string text_of(glm::dvec2 p) { return fmt::format("[{}, {}]", p.x, p.y); }
std::string text_of(const glm::dvec3& p) { return fmt::format("[{}, {}, {}]", p.x, p.y, p.z); }
std::string text_of(const std::vector<glm::dvec2>& points) {
  std::vector<std::string> texts;
  for (const glm::dvec2 p : points) texts.push_back(text_of(p));
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

// The heights before the events.
Heightfield ground_of(const Script& script, const std::string& origin, TerrainSource& source) {
  if (script.terrain.ends_with(kExtension)) {
    throw bad_input(fmt::format("the ground '{}' is itself a file of events", script.terrain), origin,
                    "name a ground without events and give all events here");
  }
  if (script.terrain == "diamond-square" && script.size > 0) {  // the same mountains at another spacing
    fractal::DiamondSquareOptions options{.seed = script.seed, .side = script.size};
    options.cell *=
        static_cast<float>(fractal::DiamondSquareOptions{}.side - 1) / static_cast<float>(script.size - 1);
    return fractal::diamond_square(options);
  }
  source = open_terrain(script.terrain, script.seed);
  if (!source.heights) {
    throw bad_input(fmt::format("the ground '{}' is a solid", script.terrain), origin, "name a heightfield");
  }
  Heightfield heights = *std::exchange(source.heights, std::nullopt);
  if (script.size > 0) heights = resample(heights, script.size, script.size);
  return heights;
}

}  // namespace

Script parse_script(std::string_view text, const std::string& origin) {
  if (text.size() > kMostBytes) {
    throw bad_input(fmt::format("the file must have at most {} bytes, got {}", kMostBytes, text.size()),
                    origin, "split it, or remove events");
  }
  const toml::table file = parse_toml(text, origin, "correct the file");
  Entry entry(file, origin);
  Script script;
  script.terrain = entry.text("terrain");
  script.seed = static_cast<std::uint64_t>(entry.integer_or("seed", 0, 0, INT64_MAX));
  script.size = static_cast<int>(entry.integer_or("size", 0, 2, kMostSamples));
  if (const toml::node* const events = entry.find("event"); events != nullptr) {
    if (!events->is_array())
      fail(*events, origin, "'event' must be a list of tables", "begin each event with [[event]]");
    const toml::array& list = *events->as_array();
    if (list.size() > kMostEvents) {
      fail(list, origin, fmt::format("there must be at most {} events, got {}", kMostEvents, list.size()),
           "remove some");
    }
    for (const toml::node& node : list) {
      script.events.push_back(event_from(node, origin));
      script.lines.push_back(static_cast<int>(node.source().begin.line));
    }
  }
  entry.refuse_unknown();
  return script;
}

std::string to_text(std::span<const Event> events) {
  std::string text;
  for (const Event& event : events) {
    text += fmt::format("[[event]]\nkind = \"{}\"\n", name(kind(event)));
    const auto write = [&](std::string_view key, const auto& field, bool = false) {
      text += fmt::format("{} = {}\n", key, text_of(field));
    };
    std::visit([&](const auto& e) { each_field(e, write); }, event);
  }
  return text;
}

std::string to_text(const Script& script) {
  std::string quoted;
  for (const char c : script.terrain) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7F || c == '"' || c == '\\') {
      quoted += fmt::format("\\u{:04X}", byte);
    } else {
      quoted += c;
    }
  }
  std::string text = fmt::format("terrain = \"{}\"\nseed = {}\n", quoted, script.seed);
  if (script.size > 0) text += fmt::format("size = {}\n", script.size);
  return text + to_text(script.events);
}

TerrainSource open_script(std::string_view text, const std::string& origin) {
  Script script = parse_script(text, origin);
  TerrainSource source;
  Heightfield ground = ground_of(script, origin, source);
  source.name = origin;
  source.checksum = checksum(ground);
  if (script.events.empty()) {
    source.heights = std::move(ground);
    return source;
  }
  const auto sculpture =
      std::make_shared<const Sculpture>(Sculpture{std::move(ground), std::move(script.events)});
  try {
    source.solid = evaluate(sculpture);
  } catch (const EventError& error) {
    throw Error(error.code(), error.what(), place(origin, script.lines[error.number() - 1]), error.advice());
  }
  source.checksum = source.solid->checksum;
  source.events = sculpture;
  return source;
}

}  // namespace terrabench::events
