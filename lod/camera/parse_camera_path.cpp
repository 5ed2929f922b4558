#include "lod/camera/camera_path.h"
#include "terrain/embedded.h"
#include "terrain/error.h"
#include "terrain/files.h"
#include "terrain/toml_table.h"

namespace terrabench {

std::span<const EmbeddedFile> embedded_camera_paths();

namespace {

constexpr std::uint64_t kLargestFile = std::uint64_t{1} << 20;
constexpr double kLongest = 1e7;  // units: a quarter of the way around the Earth

CameraPath::Look look_of(TomlReader& entry) {
  if (entry.has("look_at")) return CameraPath::Look::kPlace;
  return entry.has("heading") ? CameraPath::Look::kHeading : CameraPath::Look::kAhead;
}

constexpr double kSlowest = 1e-6;

Keyframe keyframe_from(TomlReader& entry, const CameraPath& path, double speed) {
  Keyframe key;
  const bool turns = path.kind == CameraPath::Kind::kTurn;
  if (!turns || path.keyframes.empty()) key.at = entry.vector<glm::dvec2>("at", -kLongest, kLongest);
  if (path.kind == CameraPath::Kind::kFly) key.height = entry.number("height", 0, kLongest);
  key.speed = entry.number_or("speed", speed, kSlowest, kLongest);
  if (path.look == CameraPath::Look::kPlace)
    key.look_at = entry.vector<glm::dvec2>("look_at", -kLongest, kLongest);
  if (path.look == CameraPath::Look::kHeading) {
    key.heading = entry.number("heading", -1e5, 1e5);
    key.pitch = entry.number_or("pitch", 0, -90, 90);
  }
  entry.done();
  if (key.speed == 0) entry.fail("'speed' is missing, in the keyframe and in the path");
  if (path.keyframes.empty()) return key;
  const Keyframe& last = path.keyframes.back();
  if (turns ? last.heading == key.heading : last.at == key.at)
    entry.fail("the keyframe must differ from the previous one");
  return key;
}

void read_keyframes(TomlReader& file, CameraPath& path, double speed, const std::string& origin) {
  const toml::array& list = file.list("keyframe");
  if (list.size() < 2) file.fail("a path needs at least two keyframes");
  for (const toml::node& node : list) {
    TomlReader entry(node, origin, "keyframe");
    const CameraPath::Look look = look_of(entry);
    if (path.keyframes.empty()) path.look = look;
    if (look != path.look) entry.fail("all keyframes must have 'heading', or all 'look_at', or neither");
    if (path.kind == CameraPath::Kind::kTurn && look != CameraPath::Look::kHeading) {
      if (!entry.has("heading")) entry.number("heading", -1e5, 1e5);  // says that it is missing
      entry.fail("a turn has no 'look_at'");
    }
    path.keyframes.push_back(keyframe_from(entry, path, speed));
  }
}

}  // namespace

CameraPath parse_camera_path(std::string_view text, std::string name, const std::string& origin) {
  const toml::table table = parse_toml(text, origin, "correct the camera path");
  TomlReader file(table, origin, "path");
  constexpr std::string_view kKinds[] = {"walk", "fly", "turn"}, kUnits[] = {"m", "extent"};
  CameraPath path;
  path.name = std::move(name);
  path.kind = static_cast<CameraPath::Kind>(file.word("kind", kKinds));
  path.by_extent = file.has("unit") && file.word("unit", kUnits) == 1;
  if (file.has("origin")) path.origin = file.vector<glm::dvec2>("origin", 0, 1);
  path.field_of_view = file.number("field_of_view", 0.1, 170);
  const glm::dvec2 screen = file.vector<glm::dvec2>("screen", 1, 16384);
  path.screen = glm::ivec2(screen);
  if (glm::dvec2(path.screen) != screen) file.fail("'screen' must be in whole pixels");
  path.frames_per_second = file.number("frames_per_second", 0.01, 1000);
  if (file.has("near")) path.near = file.number("near", 1e-6, 1e6);
  if (file.has("up")) path.up = file.vector<glm::dvec3>("up", -1, 1);
  if (!path.by_extent) path.shrinks = file.flag_or("shrink", false);
  const double speed = file.number_or("speed", 0, kSlowest, kLongest);
  read_keyframes(file, path, speed, origin);
  file.done();
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
