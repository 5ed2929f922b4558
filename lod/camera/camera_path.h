// Camera paths: a TOML file describes how an eye moves over any ground, and views() gives a view per frame.
// Start from the example below, which a test parses, or from a file in lod/camera/paths.
//
// clang-format off
//   kind = "fly"              # walk: 1.8 m above the ground; fly: at a height; turn: on the spot
//   unit = "m"                # of positions, heights and speeds: "m" or "extent" (the ground's longer side)
//   origin = [0.5, 0.5]       # place of [0, 0], in shares of the ground's sides; [0, 0] by default
//   field_of_view = 60        # degrees, vertical
//   screen = [800, 600]       # pixels
//   frames_per_second = 25
//   speed = 20                # units per second; for a turn, degrees per second
//   near = 0.5                # metres, optional; the far plane always lies beyond the whole ground
//
//   [[keyframe]]
//   at = [0, 0]               # x (east) and z (south) from the origin; for a turn, in the first keyframe only
//   height = 100              # for a flight: above the ground here; in between at least 1.8 m
//   heading = 90              # degrees clockwise from north; or look_at = [10, 5], a place on the ground;
//   pitch = -10               # degrees upwards, optional.  Without either, the eye looks along the path.
//
//   [[keyframe]]
//   at = [300, 0]
//   height = 50
//   heading = 120
//   speed = 40                # from here on, instead of the path's
//
//   [[keyframe]]
//   at = [500, 200]
//   height = 80
//   heading = 180
// clang-format on
//
// Everything is interpolated linearly between keyframes, headings as numbers (0 to 360 is a full turn). All
// keyframes of a path use the same way to look. The same path over the same ground gives the same views.
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
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
  bool by_extent = false;  // lengths are shares of the ground's longer side
  glm::dvec2 origin{0};
  double field_of_view = 60;  // degrees
  glm::ivec2 screen{800, 600};
  double frames_per_second = 25;
  double near = 0.5;                // metres
  std::vector<Keyframe> keyframes;  // at least two; neighbours differ in place, or heading for a turn
};

// Throws bad_input, with `origin` and the line, for anything but a path as above.
CameraPath parse_camera_path(std::string_view text, std::string name, const std::string& origin);
CameraPath read_camera_path(const std::filesystem::path&);

// The paths in paths/, compiled in.
std::span<const CameraPath> camera_paths();
// A compiled-in path, or the file if the name ends in ".toml".
CameraPath open_camera_path(const std::string& name);
const CameraPath& camera_path(std::string_view name);  // throws unknown_name

// One view per frame, from the first keyframe on. An eye beyond the ground takes the ground's height at the
// nearest point of its border. Throws usage_error for ground that fails check_ground(), or for more than a
// million frames.
std::vector<View> views(const CameraPath&, const Heightfield& ground);

}  // namespace terrabench
