// Meshes subdivided several times ("meshgrow" §3): topologies and stencils of all levels, built once, and
// positions, computed as often as wanted, by the same or by other rules.
#pragma once

#include "representations/procedural_mesh/subdivision/catmull_clark.h"
#include "representations/procedural_mesh/subdivision/placement.h"

namespace terrabench::subdivision {

// What a refinement keeps: the least for standard and linear placement, or all, which displacements, limit
// points and further refinement of the last level need.
enum class Keep : std::uint8_t { kStencils, kEverything };

struct RefinementOptions {
  Boundary boundary = Boundary::kEdge;
  Keep keep = Keep::kEverything;
  std::uint64_t most_faces = std::uint64_t{1} << 26;  // of the last level; at most 2^28
};

class Refinement {
 public:
  // Throws what make_topology() throws; usage_error for fewer than 0 levels; bad_input, before it allocates,
  // when the last level would have more than `most_faces` faces. O(faces of the last level).
  Refinement(const FaceMesh& base, int levels, const RefinementOptions& = {});

  int levels() const { return static_cast<int>(stencils_.size()); }
  const Topology& topology(int level) const { return topologies_[static_cast<std::size_t>(level)]; }
  // From `level`, below levels(), to the next.
  const Stencils& stencils(int level) const { return stencils_[static_cast<std::size_t>(level)]; }

  // Gives the last level away and frees everything else.
  Topology release_last() &&;

 private:
  std::vector<Topology> topologies_;
  std::vector<Stencils> stencils_;
};

// Positions and texture coordinates of one level.
struct LevelPoints {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec2> texture;  // or empty
};

// The points of level + 1 from those of `level`, by one rule. `seed_level` is the level that random numbers
// see (level + 1 unless the refinement is one of several in a schedule). Displacements need
// Keep::kEverything. Throws what displace() throws.
LevelPoints next_points(const Refinement&, int level, const LevelPoints&, const PlacementRule&,
                        std::uint32_t seed_level);

// The points of all levels, from those of the base on, by the standard rule alone. In double precision.
std::vector<std::vector<glm::dvec3>> standard_points(const Refinement&, std::vector<glm::dvec3> base);

// One refinement per rule. The result carries the creases that are still sharp; each face has its parent's
// symbol. With `level` as the number of refinements that came before, a schedule that alternates refinement
// and growing draws new random numbers at every step. Keeps what the rules need, whatever options.keep says.
// Throws as above, and bad_input for texture coordinates or symbols of the wrong number.
FaceMesh subdivide(const FaceMesh&, std::span<const PlacementRule>, const RefinementOptions& = {},
                   std::uint32_t level = 0);

}  // namespace terrabench::subdivision
