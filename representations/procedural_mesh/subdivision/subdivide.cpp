#include "representations/procedural_mesh/subdivision/subdivide.h"

#include <fmt/format.h>

#include <algorithm>

#include "representations/procedural_mesh/subdivision/corner_walk.h"
#include "terrain/error.h"

namespace terrabench::subdivision {
namespace {

void check_size(std::uint64_t corners, int levels, std::uint64_t most) {
  if (levels < 0) throw usage_error(fmt::format("{} refinements", levels), "refinement", "ask for 0 or more");
  most = std::min(most, std::uint64_t{1} << 28);
  std::uint64_t faces = corners;  // of level 1
  for (int level = 2; level <= levels && faces <= most; ++level) faces *= 4;
  if (levels > 0 && faces > most) {
    throw bad_input(
        fmt::format("{} refinements of {} corners give more than {} faces", levels, corners, most),
        "refinement", "ask for fewer refinements, or allow more faces");
  }
}

// Frees what only the next refinement needed.
void keep_corners(Topology& t) {
  release(t.corner_edge);
  release(t.edges);
  release(t.sharpness);
  release(t.first_use);
  release(t.uses);
}

void carry_sharpness(const Topology& t, FaceMesh& mesh) {
  with_corners(t, [&](const auto& walk) {
    for (std::size_t e = 0; e < t.edges.size(); ++e) {
      const std::uint32_t c = t.edges[e].half[0];
      if (t.sharpness[e] == 0 || t.edges[e].half[1] == kNone) continue;
      mesh.creases.push_back({t.corners[c], t.corners[walk.next(c)], t.sharpness[e]});
    }
  });
  mesh.sharp_vertices = t.sharp_points;
}

// The mesh of the last level; `symbols` are those of level 0. Frees the refinement's tables before it
// allocates.
FaceMesh make_mesh(Refinement&& refinement, LevelPoints points, std::span<const std::uint32_t> symbols) {
  FaceMesh mesh;
  const int levels = refinement.levels();
  if (!symbols.empty()) {
    // The faces of the last level lie in the order of the base's corners, 4^(levels - 1) per corner.
    const int shift = 2 * (levels - 1);
    mesh.symbols.resize(refinement.topology(levels).faces());
    with_corners(refinement.topology(0), [&](const auto& walk) {
      for (std::uint32_t f = 0; f < mesh.symbols.size(); ++f) {
        mesh.symbols[f] = symbols[levels == 0 ? f : walk.face(f >> shift)];
      }
    });
  }
  Topology t = std::move(refinement).release_last();
  if (!t.sharpness.empty()) carry_sharpness(t, mesh);
  const std::size_t faces = t.faces();
  mesh.positions = std::move(points.positions);
  mesh.texture = std::move(points.texture);
  mesh.corners = std::move(t.corners);
  mesh.first_corner = std::move(t.first_corner);
  t = {};
  if (mesh.first_corner.empty()) {
    mesh.first_corner.resize(faces + 1);
    for (std::size_t f = 0; f <= faces; ++f) mesh.first_corner[f] = static_cast<std::uint32_t>(f * 4);
  }
  return mesh;
}

}  // namespace

Refinement::Refinement(const FaceMesh& base, int levels, const RefinementOptions& options) {
  check_size(base.corners.size(), levels, options.most_faces);
  topologies_.reserve(static_cast<std::size_t>(levels) + 1);
  stencils_.reserve(static_cast<std::size_t>(levels));
  topologies_.push_back(make_topology(base, options.boundary));
  const bool everything = options.keep == Keep::kEverything;
  for (int level = 0; level < levels; ++level) {
    Topology& parent = topologies_.back();
    stencils_.push_back(make_stencils(parent));
    const bool leaf = level + 1 == levels;
    Topology child = refine(parent, leaf && !everything ? Detail::kCorners : Detail::kAll);
    if (!everything) keep_corners(parent);
    topologies_.push_back(std::move(child));
  }
}

LevelPoints next_points(const Refinement& refinement, int level, const LevelPoints& points,
                        const PlacementRule& rule, std::uint32_t seed_level) {
  const Topology& parent = refinement.topology(level);
  const Topology& child = refinement.topology(level + 1);
  const Stencils& stencils = refinement.stencils(level);
  LevelPoints out;
  const auto place = [&]<class T>(Base base, const std::vector<T>& from, std::vector<T>& to) {
    to.resize(child.vertices);
    if (base == Base::kStandard) {
      place_standard<T>(parent, stencils, from, to);
    } else {
      place_linear<T>(parent, stencils, from, to);
    }
  };
  place(rule.base, points.positions, out.positions);
  if (!points.texture.empty()) place(rule.texture, points.texture, out.texture);
  displace(rule, child, seed_level, parent.vertices, out.texture, out.positions);
  return out;
}

Topology Refinement::release_last() && {
  Topology last = std::move(topologies_.back());
  release(topologies_);
  release(stencils_);
  return last;
}

std::vector<std::vector<glm::dvec3>> standard_points(const Refinement& refinement,
                                                     std::vector<glm::dvec3> base) {
  std::vector<std::vector<glm::dvec3>> points{std::move(base)};
  for (int level = 0; level < refinement.levels(); ++level) {
    std::vector<glm::dvec3> finer(refinement.topology(level + 1).vertices);
    place_standard<glm::dvec3>(refinement.topology(level), refinement.stencils(level), points.back(), finer);
    points.push_back(std::move(finer));
  }
  return points;
}

FaceMesh subdivide(const FaceMesh& base, std::span<const PlacementRule> rules,
                   const RefinementOptions& options, std::uint32_t level) {
  if (!base.texture.empty() && base.texture.size() != base.positions.size()) {
    throw bad_input(
        fmt::format("{} texture coordinates for {} vertices", base.texture.size(), base.positions.size()),
        "base mesh", "give one per vertex or none");
  }
  if (!base.symbols.empty() && base.symbols.size() != base.faces()) {
    throw bad_input(fmt::format("{} symbols for {} faces", base.symbols.size(), base.faces()), "base mesh",
                    "give one per face or none");
  }
  RefinementOptions own = options;
  const bool sharp = !base.creases.empty() || !base.sharp_vertices.empty();
  own.keep = sharp || std::ranges::any_of(rules, displaces) ? Keep::kEverything : Keep::kStencils;
  Refinement refinement(base, static_cast<int>(rules.size()), own);
  LevelPoints points{base.positions, base.texture};
  for (int i = 0; i < refinement.levels(); ++i) {
    const auto step = static_cast<std::uint32_t>(i);
    points = next_points(refinement, i, points, rules[step], level + step + 1);
  }
  return make_mesh(std::move(refinement), std::move(points), base.symbols);
}

}  // namespace terrabench::subdivision
