#include "experiments/meshgrow/subdivision_peer.h"

#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>

#include <algorithm>
#include <numeric>

namespace terrabench::meshgrow {
namespace {

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;
using subdivision::Boundary;
using subdivision::Topology;

struct Point {
  glm::dvec3 at{0};
  void Clear() { at = glm::dvec3(0); }
  void AddWithWeight(const Point& p, double w) { at += p.at * w; }
};

// The partners of one level, from which those of the next follow.
struct Partners {
  std::vector<std::uint32_t> vertices, faces;
};

// A partner that does not exist, and is counted as a mismatch.
constexpr std::uint32_t kNoPartner = 0xFFFFFFFFU;

std::uint32_t known(int index) { return index < 0 ? kNoPartner : static_cast<std::uint32_t>(index); }

Partners children(const Far::TopologyLevel& level, const Topology& t, const Partners& now) {
  Partners next{std::vector<std::uint32_t>(child_vertices(t), kNoPartner),
                std::vector<std::uint32_t>(t.corners.size(), kNoPartner)};
  for (std::uint32_t v = 0; v < t.vertices; ++v) {
    next.vertices[v] = known(level.GetVertexChildVertex(static_cast<int>(now.vertices[v])));
  }
  for (std::uint32_t f = 0, c = 0; f < t.faces(); ++f) {
    const auto theirs = static_cast<int>(now.faces[f]);
    next.vertices[t.vertices + f] = known(level.GetFaceChildVertex(theirs));
    const auto quads = level.GetFaceChildFaces(theirs);
    const auto corners = level.GetFaceVertices(theirs);
    const auto n = static_cast<std::uint32_t>(quads.size());
    for (std::uint32_t i = 0; i < n; ++i, ++c) {
      const auto a = static_cast<int>(now.vertices[t.corners[c]]);
      const auto b = static_cast<int>(now.vertices[t.corners[i + 1 < n ? c + 1 : c + 1 - n]]);
      const int corner = corners.FindIndex(a), edge = level.FindEdge(a, b);
      if (corner >= 0) next.faces[c] = known(quads[corner]);
      if (edge >= 0)
        next.vertices[t.vertices + t.faces() + t.corner_edge[c]] = known(level.GetEdgeChildVertex(edge));
    }
  }
  return next;
}

bool all_known(const std::vector<std::uint32_t>& partners, int count) {
  return partners.size() == static_cast<std::size_t>(count) &&
         std::none_of(partners.begin(), partners.end(),
                      [&](std::uint32_t p) { return p >= static_cast<std::uint32_t>(count); });
}

// Partners that are used twice, and faces whose corners are not those of their partner, in the same order.
std::size_t mismatches(const Far::TopologyLevel& level, const Topology& t, const Partners& partners) {
  std::size_t count = 0;
  std::vector<bool> met(partners.vertices.size());
  for (const std::uint32_t p : partners.vertices) {
    count += met[p] ? 1U : 0U;
    met[p] = true;
  }
  for (std::uint32_t f = 0; f < t.faces(); ++f) {
    const auto theirs = level.GetFaceVertices(static_cast<int>(partners.faces[f]));
    const auto n = static_cast<std::uint32_t>(theirs.size());
    const auto mine = [&](std::uint32_t i) { return partners.vertices[t.corners[4 * f + i]]; };
    const int turn = n == 4 ? theirs.FindIndex(static_cast<int>(mine(0))) : -1;
    for (std::uint32_t i = 0; i < 4; ++i) {
      const bool same =
          turn >= 0 && known(theirs[static_cast<int>((static_cast<std::uint32_t>(turn) + i) % 4)]) == mine(i);
      count += same ? 0 : 1;
    }
  }
  return count;
}

}  // namespace

std::unique_ptr<Far::TopologyRefiner> opensubdiv_refiner(const FaceMesh& mesh, int levels, Boundary boundary,
                                                         bool complete) {
  std::vector<int> sizes, corners(mesh.corners.begin(), mesh.corners.end()), pairs, points;
  std::vector<float> weights, point_weights;
  for (std::size_t f = 0; f < mesh.faces(); ++f) sizes.push_back(static_cast<int>(mesh.face(f).size()));
  for (const Crease& c : mesh.creases) {
    pairs.insert(pairs.end(), {static_cast<int>(c.a), static_cast<int>(c.b)});
    weights.push_back(static_cast<float>(c.sharpness));
  }
  for (const SharpVertex& p : mesh.sharp_vertices) {
    points.push_back(static_cast<int>(p.vertex));
    point_weights.push_back(static_cast<float>(p.sharpness));
  }
  Far::TopologyDescriptor d;
  d.numVertices = static_cast<int>(mesh.positions.size());
  d.numFaces = static_cast<int>(sizes.size());
  d.numVertsPerFace = sizes.data();
  d.vertIndicesPerFace = corners.data();
  d.numCreases = static_cast<int>(weights.size());
  d.creaseVertexIndexPairs = pairs.data();
  d.creaseWeights = weights.data();
  d.numCorners = static_cast<int>(points.size());
  d.cornerVertexIndices = points.data();
  d.cornerWeights = point_weights.data();
  Sdc::Options options;
  options.SetVtxBoundaryInterpolation(boundary == Boundary::kEdge
                                          ? Sdc::Options::VTX_BOUNDARY_EDGE_ONLY
                                          : Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER);
  using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
  std::unique_ptr<Far::TopologyRefiner> refiner(
      Factory::Create(d, Factory::Options(Sdc::SCHEME_CATMARK, options)));
  Far::TopologyRefiner::UniformOptions uniform(levels);
  uniform.fullTopologyInLastLevel = complete;
  refiner->RefineUniform(uniform);
  return refiner;
}

std::vector<PeerLevel> opensubdiv_levels(const FaceMesh& base, const subdivision::Refinement& refinement,
                                         Boundary boundary) {
  const auto refiner = opensubdiv_refiner(base, refinement.levels(), boundary, true);
  const Far::PrimvarRefinerReal<double> primvar(*refiner);
  std::vector<Point> points(base.positions.size());
  for (std::size_t v = 0; v < points.size(); ++v) points[v].at = base.positions[v];
  Partners partners{std::vector<std::uint32_t>(base.positions.size()),
                    std::vector<std::uint32_t>(base.faces())};
  std::iota(partners.vertices.begin(), partners.vertices.end(), 0U);
  std::iota(partners.faces.begin(), partners.faces.end(), 0U);
  std::vector<PeerLevel> levels(1);
  for (const Point& point : points) levels[0].points.push_back(point.at);
  levels[0].ours = partners.vertices;
  for (int l = 1; l <= refinement.levels(); ++l) {
    const Topology& t = refinement.topology(l);
    partners = children(refiner->GetLevel(l - 1), refinement.topology(l - 1), partners);
    const Far::TopologyLevel& level = refiner->GetLevel(l);
    std::vector<Point> finer(static_cast<std::size_t>(level.GetNumVertices()));
    primvar.Interpolate(l, points, finer);
    points = std::move(finer);
    PeerLevel& peer = levels.emplace_back();
    if (!all_known(partners.vertices, level.GetNumVertices()) ||
        !all_known(partners.faces, level.GetNumFaces())) {
      peer.mismatches = 1;
      return levels;
    }
    for (const Point& point : points) peer.points.push_back(point.at);
    peer.ours = partners.vertices;
    peer.mismatches = mismatches(level, t, partners);
    if (t.edges.size() != static_cast<std::size_t>(level.GetNumEdges())) ++peer.mismatches;
  }
  return levels;
}

}  // namespace terrabench::meshgrow
