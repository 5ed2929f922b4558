// Vertex placement ("meshgrow" §3): the second half of a subdivision step. A rule is a value; each level of a
// schedule has its own. The standard rule alone gives Catmull–Clark; displacements added to it along the
// local normal and in proportion to the local scale factor give fractal surfaces, along one direction height
// fields, and in the local frame (figures 3 and 4) everything else.
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <vector>

#include "representations/procedural_mesh/subdivision/topology.h"

namespace terrabench::subdivision {

// What a placement rule may know about the surface at a vertex ("meshgrow" §3, "vertex placement"): the local
// normal vector, "the average normal of all faces meeting in the vertex", the local scale factor, "the
// average diagonal length of all faces meeting at the vertex", and two tangents, which make a local frame
// (figure 3).
//
// Readings of the paper: the average is that of unit normals. The diagonal length of a quadrilateral is the
// mean of its two; of a triangle, which has none, the mean edge length; of a polygon of n corners, the mean
// distance between corners that are n/2 steps apart. The first tangent points as u of the texture coordinates
// grows, projected onto the tangent plane; where that gives no direction, as an axis of the world.
//
// One entry per vertex. Normals and tangents have unit length and tangents are at right angles to normals;
// the normal is +y and the scale 0 where no face gives them. The second tangent is cross(normal, tangent).
struct LocalSurface {
  Array<glm::vec3> normals;
  Array<float> scales;        // metres
  Array<glm::vec3> tangents;  // empty unless asked for
};

// `texture` may be empty. The topology needs `uses`. O(corners) on all threads.
LocalSurface local_surface(const Topology&, std::span<const glm::vec3> positions,
                           std::span<const glm::vec2> texture, bool with_tangents);

// Consecutive vertices of the mesh M(n+1), placed but not yet displaced. `texture` may be empty; the others
// have one length.
struct VertexBatch {
  std::uint32_t level = 0;  // n + 1
  std::uint32_t first = 0;  // the index of the first vertex
  std::span<const glm::vec3> positions;
  std::span<const glm::vec2> texture;
  std::span<const glm::vec3> normals;
  std::span<const float> scales;
};

// A number per vertex of a batch. Called by several threads at once.
using Signal = std::function<void(const VertexBatch&, std::span<float> values)>;

// Random numbers in [-amplitude, amplitude), each a function of (seed, level, vertex) alone.
Signal uniform_signal(float amplitude, std::uint64_t seed);

enum class Axis : std::uint8_t { kNormal, kTangent, kBitangent, kFixed };
enum class Where : std::uint8_t { kEveryVertex, kNewVertices };  // new: of faces and edges

struct Displacement {
  Axis axis = Axis::kNormal;
  glm::vec3 direction{0, 1, 0};  // of kFixed; need not have unit length
  bool by_scale = true;          // times the local scale factor; otherwise in metres
  Where where = Where::kEveryVertex;
  Signal amount{};  // must be set
};

enum class Base : std::uint8_t { kStandard, kLinear };  // linear: vertices stay, means on edges and faces

struct PlacementRule {
  Base base = Base::kStandard;
  Base texture = Base::kStandard;             // of the texture coordinates
  std::vector<Displacement> displacements{};  // they add up
  // The longest sum of displacements, in local scale factors, at least 0: longer ones are shortened to it.
  float bound = std::numeric_limits<float>::infinity();
};

// Standard placement and random displacements along the normals, up to `amplitude` scale factors (figure 2).
PlacementRule fractal_rule(float amplitude, std::uint64_t seed);

// Whether displace() has anything to do.
inline bool displaces(const PlacementRule& rule) { return !rule.displacements.empty(); }

// Adds the rule's displacements to the positions of M(level). All of them see the positions as given. The
// topology, that of M(level), needs `uses`; `old_vertices` is the number of vertices of M(level - 1).
// Throws bad_input when a displaced position is not finite. O(corners) on all threads.
void displace(const PlacementRule&, const Topology&, std::uint32_t level, std::uint32_t old_vertices,
              std::span<const glm::vec2> texture, std::span<glm::vec3> positions);

}  // namespace terrabench::subdivision
