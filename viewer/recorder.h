// Records the eye's way as a camera path (lod/camera/camera_path.h) that `run --set path=` and
// `render --path` take. A flight has a keyframe every half second, and one where it begins and ends; the
// path's eye is at the recorded place at each keyframe, and between them moves and turns evenly.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "lod/camera/camera_path.h"
#include "viewer/camera.h"

namespace terrabench::viewer {

class Recorder {
 public:
  static constexpr double kInterval = 0.5;  // seconds between keyframes

  bool recording() const { return recording_; }
  // Of a window of this size, pixels.
  void begin(glm::ivec2 window);
  // To be called every frame while it records; the time in seconds ascends. O(1)
  void add(const Camera&, const Heightfield&, double seconds);
  // Ends the recording. The path walks if the eye did all the time, otherwise flies; it turns on the spot if
  // the eye never left its place. Time that the eye stood still is left out of the others, since a path
  // always moves. Nothing if neither place nor heading changed.
  std::optional<CameraPath> end();

 private:
  struct Stop {
    Keyframe key;
    double arrived, left;  // seconds
  };
  void stand(const Stop&);

  bool recording_ = false, walking_ = true;
  glm::ivec2 window_{0};
  double field_of_view_ = 60;
  std::vector<Stop> stops_;
  std::optional<Stop> latest_;  // after the last stop
  std::vector<Stop> turns_;     // while the eye is at the first stop's place
};

}  // namespace terrabench::viewer
