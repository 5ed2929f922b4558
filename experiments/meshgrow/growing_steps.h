// A model's expansion one growing step or subdivision at a time, and the fork of a trunk.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "representations/procedural_mesh/model.h"

namespace terrabench::meshgrow {

// The vertices of a face.
std::span<const std::uint32_t> corners_of(const FaceMesh&, std::uint32_t face);

// The mesh before and after one step, and how many subdivisions came before the second. For the base mesh
// both are the base.
using AtStep =
    std::function<void(const growing::GrownMesh& before, const growing::GrownMesh& after, int subdivisions)>;

// Gives the same mesh as expand(), which reports a growing step of the schedule only when all growth is done.
growing::GrownMesh expand_in_steps(const growing::Model&, const AtStep&);

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
