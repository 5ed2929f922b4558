// Camera paths: one TOML file says how an eye moves over any ground; views() gives its frames. A test reads
// the example below, so it is one to start from, as are those in lod/camera/paths.
//
// clang-format off
//   kind = "fly"              # walk: 1.8 m above the ground; fly: at a height; turn: on the spot
//   unit = "m"                # of positions, heights and speeds: "m", or "extent", the ground's longer side
//   origin = [0.5, 0.5]       # where [0, 0] lies, in shares of the ground's sides; [0, 0] when left out
//   field_of_view = 60        # degrees, vertical
//   screen = [800, 600]       # pixels
//   frames_per_second = 25
//   speed = 20                # units a second; of a turn, degrees a second
//   near = 0.5                # metres, may be left out; the far plane lies behind the whole ground
//
//   [[keyframe]]
//   at = [0, 0]               # x (east) and z (south) from the origin; of a turn, in the first alone
//   height = 100              # of a flight: above the ground here; never under 1.8 m in between
//   heading = 90              # degrees clockwise from north; or look_at = [10, 5], a place on the ground;
//   pitch = -10               # degrees upwards, may be left out.  With neither, the eye looks ahead.
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
// Between keyframes all goes linearly, headings as numbers (0 to 360 is once around); keyframes look all in
// the same manner. The same path over the same ground gives the same views.
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
  std::vector<Keyframe> keyframes;  // two at least, no two neighbours at the same place or heading
};

// Throws bad_input, naming origin and line, for anything but a path as above.
CameraPath parse_camera_path(std::string_view text, std::string name, const std::string& origin);
CameraPath read_camera_path(const std::filesystem::path&);

// Those in paths/, compiled in. camera_path() throws unknown_name.
std::span<const CameraPath> camera_paths();
// One of these, or the file when the name ends in ".toml".
CameraPath open_camera_path(const std::string& name);
const CameraPath& camera_path(std::string_view name);

// One view a frame, the first keyframe's first. Eyes that leave the ground keep the height of its nearest
// border. Throws usage_error for ground that check_ground() refuses, or more than a million frames.
std::vector<View> views(const CameraPath&, const Heightfield& ground);

}  // namespace terrabench
