// The standard rule against OpenSubdiv: topology by construction, positions in double precision.
#include <gtest/gtest.h>
#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>

#include <algorithm>
#include <glm/glm.hpp>

#include "representations/procedural_mesh/subdivision/limit.h"
#include "representations/procedural_mesh/subdivision/refinement.h"
#include "tests/representations/face_shapes.h"

namespace terrabench {
namespace {

using namespace subdivision;
namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

constexpr int kLevels = 4;

struct Point {
  glm::dvec3 at{0};
  void Clear() { at = glm::dvec3(0); }
  void AddWithWeight(const Point& p, double w) { at += p.at * w; }
};

struct Peer {
  std::unique_ptr<Far::TopologyRefiner> refiner;
  std::vector<std::vector<Point>> points;           // per level
  std::vector<std::vector<std::uint32_t>> to_peer;  // per level: their vertex for each of ours
};

std::unique_ptr<Far::TopologyRefiner> refiner_of(const FaceMesh& mesh, Boundary boundary) {
  std::vector<int> sizes, corners(mesh.corners.begin(), mesh.corners.end()), pairs, points;
  std::vector<float> weights, point_weights;
  for (std::size_t f = 0; f < mesh.faces(); ++f) {
    sizes.push_back(static_cast<int>(mesh.first_corner[f + 1] - mesh.first_corner[f]));
  }
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
  Far::TopologyRefiner::UniformOptions uniform(kLevels);
  uniform.fullTopologyInLastLevel = true;
  refiner->RefineUniform(uniform);
  return refiner;
}

// Follows both constructions level by level, so that no search by position is needed.
Peer peer_of(const FaceMesh& mesh, const Refinement& ours, Boundary boundary) {
  Peer peer{refiner_of(mesh, boundary), {}, {}};
  peer.points.emplace_back(mesh.positions.size());
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) peer.points[0][v].at = mesh.positions[v];
  std::vector<std::uint32_t> vertices(mesh.positions.size()), faces(mesh.faces());
  for (std::uint32_t v = 0; v < vertices.size(); ++v) vertices[v] = v;
  for (std::uint32_t f = 0; f < faces.size(); ++f) faces[f] = f;
  peer.to_peer.push_back(vertices);
  const Far::PrimvarRefinerReal<double> primvar(*peer.refiner);
  for (int l = 0; l < kLevels; ++l) {
    const Far::TopologyLevel& level = peer.refiner->GetLevel(l);
    const Topology& t = ours.topology(l);
    peer.points.emplace_back(static_cast<std::size_t>(peer.refiner->GetLevel(l + 1).GetNumVertices()));
    primvar.Interpolate(l + 1, peer.points[static_cast<std::size_t>(l)], peer.points.back());
    std::vector<std::uint32_t> next(child_vertices(t)), children(t.corners.size());
    const auto child = [](int index) { return static_cast<std::uint32_t>(index); };
    for (std::uint32_t v = 0; v < t.vertices; ++v) {
      next[v] = child(level.GetVertexChildVertex(static_cast<int>(vertices[v])));
    }
    for (std::uint32_t f = 0, c = 0; f < t.faces(); ++f) {
      const auto theirs = static_cast<int>(faces[f]);
      next[t.vertices + f] = child(level.GetFaceChildVertex(theirs));
      const auto quads = level.GetFaceChildFaces(theirs);
      const auto their_corners = level.GetFaceVertices(theirs);
      for (int i = 0; i < quads.size(); ++i, ++c) {
        const std::uint32_t a = t.corners[c];
        children[c] = child(quads[their_corners.FindIndex(static_cast<int>(vertices[a]))]);
        const std::uint32_t b = t.corners[i + 1 < quads.size() ? c + 1 : c + 1 - child(quads.size())];
        const int edge = level.FindEdge(static_cast<int>(vertices[a]), static_cast<int>(vertices[b]));
        next[t.vertices + t.faces() + t.corner_edge[c]] = child(level.GetEdgeChildVertex(edge));
      }
    }
    vertices = next;
    faces = children;
    peer.to_peer.push_back(next);
  }
  return peer;
}

double size_of(const FaceMesh& mesh) {
  glm::vec3 low = mesh.positions[0], high = low;
  for (const glm::vec3& p : mesh.positions) low = glm::min(low, p), high = glm::max(high, p);
  return glm::distance(low, high);
}

class OpenSubdivTest : public testing::TestWithParam<Boundary> {};

TEST_P(OpenSubdivTest, PlacesEveryVertexWhereWeDo) {
  for (const Shape& shape : shapes()) {
    const Refinement ours(shape.mesh, kLevels, {GetParam()});
    const Peer peer = peer_of(shape.mesh, ours, GetParam());
    LevelPoints points{shape.mesh.positions, {}};
    for (int l = 1; l <= kLevels; ++l) {
      points = next_points(ours, l - 1, points, {}, 1);
      const auto& theirs = peer.points[static_cast<std::size_t>(l)];
      const auto& map = peer.to_peer[static_cast<std::size_t>(l)];
      ASSERT_EQ(points.positions.size(), theirs.size()) << shape.name;
      std::vector<bool> met(theirs.size());
      double worst = 0;
      for (std::size_t v = 0; v < theirs.size(); ++v) {
        met[map[v]] = true;
        worst = std::max(worst, glm::distance(glm::dvec3(points.positions[v]), theirs[map[v]].at));
      }
      EXPECT_LT(worst, 1e-6 * size_of(shape.mesh)) << shape.name << ", level " << l;
      EXPECT_EQ(std::count(met.begin(), met.end(), true), static_cast<std::ptrdiff_t>(theirs.size()));
    }
  }
}

TEST_P(OpenSubdivTest, HasTheSameQuadrilaterals) {
  for (const Shape& shape : shapes()) {
    const Refinement ours(shape.mesh, kLevels, {GetParam()});
    const Peer peer = peer_of(shape.mesh, ours, GetParam());
    for (int l = 1; l <= kLevels; ++l) {
      const Topology& t = ours.topology(l);
      const Far::TopologyLevel& level = peer.refiner->GetLevel(l);
      std::vector<std::vector<std::uint32_t>> mine, theirs;
      const auto turned = [](std::vector<std::uint32_t> face) {
        std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
        return face;
      };
      for (std::uint32_t f = 0; f < t.faces(); ++f) {
        std::vector<std::uint32_t> face;
        for (std::uint32_t i = 0; i < 4; ++i) {
          face.push_back(peer.to_peer[static_cast<std::size_t>(l)][t.corners[f * 4 + i]]);
        }
        mine.push_back(turned(face));
        const auto vertices = level.GetFaceVertices(static_cast<int>(f));
        theirs.push_back(turned({vertices.begin(), vertices.end()}));
      }
      std::sort(mine.begin(), mine.end());
      std::sort(theirs.begin(), theirs.end());
      EXPECT_EQ(mine, theirs) << shape.name << ", level " << l;
      EXPECT_EQ(t.edges.size(), static_cast<std::size_t>(level.GetNumEdges()));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Boundaries, OpenSubdivTest,
                         testing::Values(Boundary::kEdge, Boundary::kEdgeAndCorner), [](const auto& info) {
                           return info.param == Boundary::kEdge ? "Edge" : "EdgeAndCorner";
                         });

}  // namespace
}  // namespace terrabench
