#include "terrain/events/event_file.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "terrain/error.h"
#include "terrain/events/evaluate.h"
#include "terrain/sources/fractal/diamond_square.h"
#include "terrain/toml_table.h"

namespace terrabench::events {
namespace {

constexpr std::size_t kMostEvents = 20000;
constexpr int kMostSamples = 8193;  // per side

std::string place(const std::string& origin, std::size_t line) { return fmt::format("{}:{}", origin, line); }

Kind kind_of(TomlReader& entry) {
  std::vector<std::string_view> names;
  for (int k = 0; k < kKinds; ++k) names.push_back(name(static_cast<Kind>(k)));
  return static_cast<Kind>(entry.word("kind", names));
}

void read(TomlReader& entry, std::string_view key, double& value) { value = entry.number(key); }
void read(TomlReader& entry, std::string_view key, std::uint64_t& value) {
  value = static_cast<std::uint64_t>(entry.integer_or(key, 0, 0, INT64_MAX));
}
template <class Vector>
void read(TomlReader& entry, std::string_view key, Vector& point) {
  point = entry.vector<Vector>(key);
}
void read(TomlReader& entry, std::string_view key, std::vector<glm::dvec2>& points, const std::string& file) {
  for (const toml::node& node : entry.list(key)) {
    const toml::array& pair = list_of(node, file, key, 2);
    points.emplace_back(number_of(pair[0], file, key), number_of(pair[1], file, key));
  }
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
  TomlReader entry(node, origin, "event");
  Event event = default_event(kind_of(entry));
  const auto read_field = [&](std::string_view key, auto& field, bool optional = false) {
    if (optional && !entry.has(key)) return;
    if constexpr (requires { field.push_back({}); }) {
      read(entry, key, field, origin);
    } else {
      read(entry, key, field);
    }
  };
  std::visit([&](auto& e) { each_field(e, read_field); }, event);
  entry.done();
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
  TomlReader entry(file, origin, "file");
  Script script;
  script.terrain = entry.text("terrain");
  script.seed = static_cast<std::uint64_t>(entry.integer_or("seed", 0, 0, INT64_MAX));
  script.size = static_cast<int>(entry.integer_or("size", 0, 2, kMostSamples));
  if (const toml::node* const events = entry.find("event"); events != nullptr) {
    const toml::array& list = list_of(*events, origin, "event", 0);
    if (list.size() > kMostEvents) {
      fail_at(list, origin, fmt::format("there must be at most {} events, got {}", kMostEvents, list.size()),
              "remove some");
    }
    for (const toml::node& node : list) {
      script.events.push_back(event_from(node, origin));
      script.lines.push_back(static_cast<int>(node.source().begin.line));
    }
  }
  entry.done();
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
