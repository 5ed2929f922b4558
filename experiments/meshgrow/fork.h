// The fork of a trunk, and the sections of trunk and branches.
#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "representations/procedural_mesh/model.h"

namespace terrabench::meshgrow {

// Where several faces with this symbol that share vertices grow in the same step for the first time.
struct Fork {
  struct Shared {
    std::uint32_t vertex = 0;
    std::array<double, 2> alone{};  // u that each face's expansion gives the vertex, the smaller first
    double u = 0;                   // after both grew
  };
  growing::GrownMesh before, after;
  std::vector<std::uint32_t> faces;  // of `before`
  std::vector<Shared> shared;        // by increasing u
  // Corners of the faces that are not shared, and how many of them have another u afterwards.
  int others = 0, others_changed = 0;
};

// A section that a growing face added, from the middle of the face to that of the section's cap.
struct StemSection {
  std::string_view symbol;  // of the face: one of those asked for
  double length = 0;        // metres
  double v = 0, end_v = 0;  // means over the corners, after the step
};
std::vector<StemSection> sections_along(const growing::Model&, std::span<const std::string_view> symbols);

// Throws bad_input if nothing forks.
Fork find_fork(const growing::Model&, std::string_view symbol);

}  // namespace terrabench::meshgrow
