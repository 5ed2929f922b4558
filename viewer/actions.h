// What keys and buttons do, in one table: the keys, the panel's help and scripts read it.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <string_view>

#include "viewer/session.h"

namespace terrabench::viewer {

enum class Action : std::uint8_t {
  kFly,
  kWalk,
  kOrbit,
  kPlan,
  kHome,
  kNextMethod,
  kSecond,
  kFiner,
  kCoarser,
  kEqualise,
  kWires,
  kColours,
  kLandscape,
  kFreeze,
  kRecord,
  kPlay,
  kDig,
  kFill,
  kUndo,
  kPicture,
  kPanels,
  kQuit,
};

struct Binding {
  int key;  // GLFW's number
  std::string_view name;
  Action action;
  std::string_view what;
};
std::span<const Binding> bindings();

// What actions need beside the session.
struct Controls {
  bool panels = true, quit = false;
  glm::dvec2 mouse{0};      // pixels
  glm::ivec2 window{1, 1};  // pixels
  double pixels = 2;        // for kEqualise
  double brush = 0;         // radius for kDig and kFill, metres; 0: a fiftieth of the ground's longer side
  CameraPath path;          // for kPlay: the last that was recorded or opened
};

// Does nothing before there is ground, except for kPanels and kQuit.
void perform(Action, Session&, Controls&);

// A print across a page (174 mm) at 300 dots per inch, in the window's shape.
glm::ivec2 print_size(glm::ivec2 window);
// Writes the session's picture, and says where and which command draws the same.
void write_picture_of(Session&, const std::string& file, glm::ivec2 size, float scale);

}  // namespace terrabench::viewer
