#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "lod/camera/camera_path.h"
#include "terrain/embedded.h"
#include "terrain/error.h"
#include "terrain/files.h"
#include "terrain/spelling.h"
#include "terrain/toml.h"

namespace terrabench {

std::span<const EmbeddedFile> embedded_camera_paths();

namespace {

constexpr std::uint64_t kLargestFile = std::uint64_t{1} << 20;
constexpr double kLongest = 1e7;  // units: a quarter of the way around the Earth

[[noreturn]] void fail(const toml::node& node, const std::string& origin, std::string_view what) {
  throw bad_input(what, fmt::format("{}:{}", origin, node.source().begin.line), "correct the camera path");
}

// Of both tables, to suggest the one that was meant.
constexpr std::string_view kKeys[] = {"kind",   "unit",  "shrink",   "origin",  "field_of_view",
                                      "screen", "speed", "keyframe", "near",    "frames_per_second",
                                      "up",     "at",    "height",   "heading", "pitch",
                                      "look_at"};

// One table of the file; refuse_unknown() reports keys that were never read.
class Entry {
 public:
  Entry(const toml::node& node, const std::string& origin) : node_(node), origin_(origin) {
    if (!node.is_table()) refuse("expected a table");
  }

  [[noreturn]] void refuse(std::string_view what) const { fail(node_, origin_, what); }
  bool has(std::string_view key) const { return node_.as_table()->contains(key); }

  double number(std::string_view key, double lowest, double highest) {
    return number_of(get(key), key, lowest, highest);
  }
  double number_or(std::string_view key, double lowest, double highest, double fallback) {
    return has(key) ? number(key, lowest, highest) : fallback;
  }
  glm::dvec2 pair(std::string_view key, double lowest, double highest) {
    return numbers<glm::dvec2>(key, "a pair of numbers", lowest, highest);
  }
  glm::dvec3 triple(std::string_view key, double lowest, double highest) {
    return numbers<glm::dvec3>(key, "three numbers", lowest, highest);
  }
  bool flag_or(std::string_view key, bool fallback) {
    if (!has(key)) return fallback;
    const toml::node& node = get(key);
    if (!node.is_boolean()) fail(node, origin_, fmt::format("'{}' must be true or false", key));
    return *node.value<bool>();
  }
  // The value's index in `words`.
  std::size_t word(std::string_view key, std::span<const std::string_view> words) {
    const toml::node& node = get(key);
    if (!node.is_string()) fail(node, origin_, fmt::format("'{}' must be text", key));
    const std::string_view text = *node.value<std::string_view>();
    for (std::size_t w = 0; w < words.size(); ++w) {
      if (text == words[w]) return w;
    }
    fail(node, origin_, invalid_value(key, text, words));
  }
  const toml::array& list(std::string_view key) {
    const toml::node& node = get(key);
    if (!node.is_array()) fail(node, origin_, fmt::format("'{}' must be a list", key));
    return *node.as_array();
  }
  void refuse_unknown() const {
    for (const auto& [key, value] : *node_.as_table()) {
      if (read_.contains(key.str())) continue;
      const bool known = std::find(std::begin(kKeys), std::end(kKeys), key.str()) != std::end(kKeys);
      fail(value, origin_,
           known ? fmt::format("'{}' has no meaning here", key.str()) : unknown_key(key.str(), kKeys));
    }
  }

 private:
  const toml::node& get(std::string_view key) {
    read_.insert(std::string(key));
    const toml::node* const node = node_.as_table()->get(key);
    if (node == nullptr) refuse(missing_key(key, *node_.as_table()));
    return *node;
  }
  template <class Vector>
  Vector numbers(std::string_view key, std::string_view what, double lowest, double highest) {
    const toml::node& node = get(key);
    const toml::array* const array = node.as_array();
    Vector all;
    if (array == nullptr || array->size() != static_cast<std::size_t>(all.length()))
      fail(node, origin_, fmt::format("'{}' must be {}", key, what));
    for (int k = 0; k < all.length(); ++k) {
      all[k] = number_of(*array->get(static_cast<std::size_t>(k)), key, lowest, highest);
    }
    return all;
  }
  double number_of(const toml::node& node, std::string_view key, double lowest, double highest) const {
    const std::optional<double> value = node.is_number() ? node.value<double>() : std::nullopt;
    if (!value || !(*value >= lowest && *value <= highest)) {
      fail(node, origin_, fmt::format("'{}' must be a number from {} to {}", key, lowest, highest));
    }
    return *value;
  }

  const toml::node& node_;
  const std::string& origin_;
  std::set<std::string, std::less<>> read_;
};

CameraPath::Look look_of(const Entry& entry) {
  if (entry.has("look_at")) return CameraPath::Look::kPlace;
  return entry.has("heading") ? CameraPath::Look::kHeading : CameraPath::Look::kAhead;
}

constexpr double kSlowest = 1e-6;

Keyframe keyframe_from(Entry& entry, const CameraPath& path, double speed) {
  Keyframe key;
  const bool turns = path.kind == CameraPath::Kind::kTurn;
  if (!turns || path.keyframes.empty()) key.at = entry.pair("at", -kLongest, kLongest);
  if (path.kind == CameraPath::Kind::kFly) key.height = entry.number("height", 0, kLongest);
  key.speed = entry.number_or("speed", kSlowest, kLongest, speed);
  if (path.look == CameraPath::Look::kPlace) key.look_at = entry.pair("look_at", -kLongest, kLongest);
  if (path.look == CameraPath::Look::kHeading) {
    key.heading = entry.number("heading", -1e5, 1e5);
    key.pitch = entry.number_or("pitch", -90, 90, 0);
  }
  entry.refuse_unknown();
  if (key.speed == 0) entry.refuse("'speed' is missing, in the keyframe and in the path");
  if (path.keyframes.empty()) return key;
  const Keyframe& last = path.keyframes.back();
  if (turns ? last.heading == key.heading : last.at == key.at)
    entry.refuse("the keyframe must differ from the previous one");
  return key;
}

void read_keyframes(Entry& file, CameraPath& path, double speed, const std::string& origin) {
  const toml::array& list = file.list("keyframe");
  if (list.size() < 2) file.refuse("a path needs at least two keyframes");
  for (const toml::node& node : list) {
    Entry entry(node, origin);
    const CameraPath::Look look = look_of(entry);
    if (path.keyframes.empty()) path.look = look;
    if (look != path.look) entry.refuse("all keyframes must have 'heading', or all 'look_at', or neither");
    if (path.kind == CameraPath::Kind::kTurn && look != CameraPath::Look::kHeading) {
      if (!entry.has("heading")) entry.number("heading", -1e5, 1e5);  // says that it is missing
      entry.refuse("a turn has no 'look_at'");
    }
    path.keyframes.push_back(keyframe_from(entry, path, speed));
  }
}

}  // namespace

CameraPath parse_camera_path(std::string_view text, std::string name, const std::string& origin) {
  const toml::table table = parse_toml(text, origin, "correct the camera path");
  Entry file(table, origin);
  constexpr std::string_view kKinds[] = {"walk", "fly", "turn"}, kUnits[] = {"m", "extent"};
  CameraPath path;
  path.name = std::move(name);
  path.kind = static_cast<CameraPath::Kind>(file.word("kind", kKinds));
  path.by_extent = file.has("unit") && file.word("unit", kUnits) == 1;
  if (file.has("origin")) path.origin = file.pair("origin", 0, 1);
  path.field_of_view = file.number("field_of_view", 0.1, 170);
  const glm::dvec2 screen = file.pair("screen", 1, 16384);
  path.screen = glm::ivec2(screen);
  if (glm::dvec2(path.screen) != screen) file.refuse("'screen' must be in whole pixels");
  path.frames_per_second = file.number("frames_per_second", 0.01, 1000);
  if (file.has("near")) path.near = file.number("near", 1e-6, 1e6);
  if (file.has("up")) path.up = file.triple("up", -1, 1);
  if (!path.by_extent) path.shrinks = file.flag_or("shrink", false);
  const double speed = file.number_or("speed", kSlowest, kLongest, 0);
  read_keyframes(file, path, speed, origin);
  file.refuse_unknown();
  return path;
}

CameraPath read_camera_path(const std::filesystem::path& file) {
  return parse_camera_path(read_file(file, kLargestFile), file.stem().string(), file.string());
}

std::span<const CameraPath> camera_paths() {
  static const std::vector<CameraPath> kPaths = [] {
    std::vector<CameraPath> paths;
    for (const EmbeddedFile& file : embedded_camera_paths()) {
      const std::string origin(file.name);
      paths.push_back(parse_camera_path(file.text, std::filesystem::path(origin).stem().string(), origin));
    }
    return paths;
  }();
  return kPaths;
}

const CameraPath& camera_path(std::string_view name) {
  std::vector<std::string_view> known;
  for (const CameraPath& path : camera_paths()) {
    if (path.name == name) return path;
    known.push_back(path.name);
  }
  throw unknown_name("camera path", name, known);
}

CameraPath open_camera_path(const std::string& name) {
  return name.ends_with(".toml") ? read_camera_path(name) : camera_path(name);
}

}  // namespace terrabench
