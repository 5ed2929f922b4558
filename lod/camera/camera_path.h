// Camera paths: a TOML file describes how an eye moves over ground of any size and shape, and views() gives a
// view per frame. docs/paths.md describes the file, with an example that a test parses.
//
// Everything is interpolated linearly between keyframes, headings as numbers (0 to 360 is a full turn). All
// keyframes of a path use the same way to look. The same path over the same ground gives the same views.
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "terrain/heightfield.h"
#include "terrain/view.h"

namespace terrabench {

struct Keyframe {
  glm::dvec2 at{0};  // x, z
  double height = 0;
  double speed = 0;
  double heading = 0, pitch = 0;  // degrees
  glm::dvec2 look_at{0};
};

struct CameraPath {
  enum class Kind { kWalk, kFly, kTurn };
  enum class Look { kAhead, kHeading, kPlace };

  std::string name;
  Kind kind = Kind::kWalk;
  Look look = Look::kAhead;
  bool by_extent = false;  // lengths are shares of the ground's sides; see views()
  bool shrinks = false;    // otherwise, if in metres: shortened on ground that the keyframes would leave
  glm::dvec2 origin{0};
  double field_of_view = 60;  // degrees
  glm::ivec2 screen{800, 600};
  double frames_per_second = 25;
  std::optional<double> near;       // metres; otherwise chosen
  std::optional<glm::vec3> up;      // otherwise upright(), or a steep heading
  std::vector<Keyframe> keyframes;  // at least two; neighbours differ in place, or heading for a turn
};

// Throws bad_input, with `origin` and the line, for anything but a path as above.
CameraPath parse_camera_path(std::string_view text, std::string name, const std::string& origin);
CameraPath read_camera_path(const std::filesystem::path&);
// The file from which parse_camera_path() reads the same path: every number in full.
std::string to_toml(const CameraPath&);

// The paths in paths/, compiled in.
std::span<const CameraPath> camera_paths();
// A compiled-in path, or the file if the name ends in ".toml".
CameraPath open_camera_path(const std::string& name);
const CameraPath& camera_path(std::string_view name);  // throws unknown_name

// The least height of an eye above the ground, metres: 1.8 m, and less on ground of less than 18 m.
double least_eye_height(const Heightfield&);
// The ground's height under an eye, metres; beyond the ground, at the nearest point of its border. O(1)
double ground_under(const Heightfield&, const glm::dvec2& at);

// One view per frame, from the first keyframe on. The unit "extent" is the ground's longer side if all
// keyframes then stand on the ground, as on ground that is about square. Otherwise each side is the unit
// along itself, and the shorter one that of heights. A path has the same frames on ground of any shape,
// because speed is in units. An eye beyond the ground takes the ground's height at the nearest point of its
// border. Throws usage_error for ground that fails check_ground(), for more than a million frames, and for an
// `up` along the line of sight.
std::vector<View> views(const CameraPath&, const Heightfield& ground);

}  // namespace terrabench
