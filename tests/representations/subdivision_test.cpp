// Refinement, placement and limits: rules, creases, threads and wrong input.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <cstring>
#include <glm/glm.hpp>

#include "representations/procedural_mesh/mesh_checks.h"
#include "representations/procedural_mesh/subdivision/limit.h"
#include "representations/procedural_mesh/subdivision/subdivide.h"
#include "tests/representations/face_shapes.h"
#include "tests/terrain/errors.h"

namespace terrabench {
namespace {

using namespace subdivision;
using testing::HasSubstr;
using DoublePoints = std::vector<glm::dvec3>;

DoublePoints positions_of(const FaceMesh& mesh) { return {mesh.positions.begin(), mesh.positions.end()}; }

// The mean distance of the first `count` vertices.
double mean_distance(const DoublePoints& a, const DoublePoints& b, std::size_t count) {
  double sum = 0;
  for (std::size_t v = 0; v < count; ++v) sum += glm::distance(a[v], b[v]);
  return sum / static_cast<double>(count);
}

// A limit point belongs to the surface, so refining first must not change it: to rounding, for every kind of
// vertex. And the vertices of finer meshes must approach it.
TEST(Limit, IsTheSameFromEveryLevelAndIsApproached) {
  for (const Shape& shape : shapes()) {
    for (const Boundary boundary : {Boundary::kEdge, Boundary::kEdgeAndCorner}) {
      const Refinement refinement(shape.mesh, 5, {boundary});
      const std::vector<DoublePoints> points = standard_points(refinement, positions_of(shape.mesh));
      const DoublePoints limit = limit_points(refinement.topology(0), points[0]);
      for (int l = 1; l <= 5; ++l) {
        const DoublePoints finer = limit_points(refinement.topology(l), points[static_cast<std::size_t>(l)]);
        EXPECT_LT(mean_distance(limit, finer, limit.size()), 1e-13) << shape.name << " " << l;
      }
      const double before = mean_distance(limit, points[4], limit.size());
      if (before > 1e-9) {
        EXPECT_LT(mean_distance(limit, points[5], limit.size()), 0.5 * before) << shape.name;
      }
    }
  }
}

TEST(Limit, OfTheRegularMeshIsTheBicubicSpline) {
  const FaceMesh mesh = torus(6, 5);
  const DoublePoints p = positions_of(mesh), limit = limit_points(make_topology(mesh), p);
  const auto at = [&](std::size_t i, std::size_t j) { return p[(i % 6) * 5 + j % 5]; };
  for (std::size_t i = 6; i < 12; ++i) {
    for (std::size_t j = 5; j < 10; ++j) {
      const glm::dvec3 edges = at(i + 1, j) + at(i - 1, j) + at(i, j + 1) + at(i, j - 1);
      const glm::dvec3 diagonals = at(i + 1, j + 1) + at(i + 1, j - 1) + at(i - 1, j + 1) + at(i - 1, j - 1);
      const glm::dvec3 spline = (at(i, j) * 16.0 + edges * 4.0 + diagonals) / 36.0;
      EXPECT_LT(glm::distance(spline, limit[(i - 6) * 5 + j - 5]), 1e-14);
    }
  }
}

TEST(LimitAt, PlacesInAChildAndInItsParentAreTheSame) {
  for (const glm::dvec2 place : {glm::dvec2(0.2, 0.3), {0.7, 0.1}, {0.6, 0.9}, {0.4, 0.8}}) {
    glm::dvec2 at = place;
    const int child = child_at(at);
    EXPECT_LT(glm::distance(place_in_parent(child, at), place), 1e-15) << child;
  }
}

// On shapes with extraordinary vertices, boundaries and creases of every kind. The places are corners of
// faces two refinements later, where the evaluation begins.
TEST(LimitAt, AgreesWithTheMasksOfFinerVertices) {
  for (const Shape& shape : shapes()) {
    const Refinement refinement(shape.mesh, 3);  // after one refinement all faces are quadrilaterals
    const std::vector<DoublePoints> points = standard_points(refinement, positions_of(shape.mesh));
    const Topology &mesh = refinement.topology(1), &finest = refinement.topology(3);
    const DoublePoints limits = limit_points(finest, points[3]);
    for (std::uint32_t face = 0; face < mesh.faces(); ++face) {
      const std::uint32_t child = face % 4, grandchild = face / 4 % 4;
      const glm::dvec2 place = place_in_parent(static_cast<int>(child),
                                               place_in_parent(static_cast<int>(grandchild), glm::dvec2(0)));
      const glm::dvec3 expected = limits[finest.corners[4 * (16 * face + 4 * child + grandchild)]];
      EXPECT_LT(glm::distance(limit_at(mesh, points[1], face, place), expected), 1e-12)
          << shape.name << ", face " << face;
    }
  }
}

// A plane stays flat, and its places stay where they are: the spline reproduces linear functions.
TEST(LimitAt, ReproducesAPlane) {
  const FaceMesh plane = growing::plane({5, 5}, 5, 5).mesh;
  const glm::dvec3 limit = limit_at(make_topology(plane), positions_of(plane), 12, {0.3, 0.9});
  EXPECT_LT(glm::distance(limit, glm::dvec3(0.4, 0, -0.2)), 1e-14);
}

// By the definitions, face by face: Newell's normal, and diagonals by the number of corners.
void expect_definitions(const FaceMesh& mesh, const std::string& name) {
  std::vector<glm::dvec3> normals(mesh.positions.size());
  std::vector<double> diagonals(mesh.positions.size()), faces(mesh.positions.size());
  for (std::size_t f = 0; f < mesh.faces(); ++f) {
    const auto face = mesh.face(f);
    const auto at = [&](std::size_t k) { return glm::dvec3(mesh.positions[face[k % face.size()]]); };
    glm::dvec3 newell(0);
    double diagonal = 0;
    for (std::size_t i = 0; i < face.size(); ++i) {
      newell += glm::cross(at(i), at(i + 1));
      diagonal += glm::distance(at(i), at(i + face.size() / 2)) / static_cast<double>(face.size());
    }
    for (const std::uint32_t v : face) {
      normals[v] += glm::normalize(newell);
      diagonals[v] += diagonal;
      ++faces[v];
    }
  }
  const LocalSurface surface = local_surface(make_topology(mesh), mesh.positions, {}, true);
  for (std::size_t v = 0; v < normals.size(); ++v) {
    EXPECT_LT(glm::distance(glm::normalize(normals[v]), glm::dvec3(surface.normals[v])), 1e-5) << name;
    EXPECT_NEAR(diagonals[v] / faces[v], surface.scales[v], 1e-5) << name;
    EXPECT_NEAR(glm::length(surface.tangents[v]), 1, 1e-5);
    EXPECT_NEAR(glm::dot(surface.tangents[v], surface.normals[v]), 0, 1e-5);
  }
}

TEST(LocalSurface, FollowsItsDefinitionsOnPolygonsAndRefinedMeshes) {
  for (const Shape& shape : shapes()) {
    expect_definitions(shape.mesh, shape.name);
    expect_definitions(subdivide(shape.mesh, std::vector<PlacementRule>(2)), shape.name + ", refined");
  }
}

TEST(LocalSurface, HasFrameAndScaleWhereNoFaceGivesThem) {
  FaceMesh mesh = grid(1);
  mesh.positions.assign(5, {1, 1, 1});  // one place, and a vertex of no face
  const std::vector<glm::vec2> texture(5);
  const LocalSurface surface = local_surface(make_topology(mesh), mesh.positions, texture, true);
  for (std::size_t v = 0; v < 5; ++v) {
    EXPECT_EQ(surface.normals[v], glm::vec3(0, 1, 0));
    EXPECT_EQ(surface.scales[v], 0);
    EXPECT_EQ(surface.tangents[v], glm::vec3(1, 0, 0));
  }
}

Signal constant(float value) {
  return [value](const VertexBatch&, std::span<float> out) { std::fill(out.begin(), out.end(), value); };
}

PlacementRule displaced(Axis axis, Signal amount, bool by_scale = true) {
  PlacementRule rule{.base = Base::kLinear};
  rule.displacements = {{.axis = axis, .by_scale = by_scale, .amount = std::move(amount)}};
  return rule;
}

FaceMesh once(const FaceMesh& mesh, const PlacementRule& rule) { return subdivide(mesh, {&rule, 1}); }

// Unit squares with texture coordinates; refined once, they have diagonals of √2/2.
FaceMesh flat_grid(std::uint32_t n) { return growing::plane(glm::dvec2(n), n, n).mesh; }
const PlacementRule kStill{.base = Base::kLinear};

TEST(Placement, MovesInTheTangentPlaneAlongTheTextureCoordinates) {
  FaceMesh mesh = flat_grid(4);
  PlacementRule along_u = displaced(Axis::kTangent, constant(0.25F), false);
  PlacementRule across = displaced(Axis::kBitangent, constant(0.25F), false);
  along_u.texture = across.texture = Base::kLinear;  // a smooth one bends u at the rim
  const FaceMesh base = once(mesh, kStill), u = once(mesh, along_u), v = once(mesh, across);
  for (std::size_t i = 0; i < base.positions.size(); ++i) {
    EXPECT_LT(glm::distance(u.positions[i], base.positions[i] + glm::vec3(0.25F, 0, 0)), 1e-6F);
    // normal × tangent = y × x = -z
    EXPECT_LT(glm::distance(v.positions[i], base.positions[i] + glm::vec3(0, 0, -0.25F)), 1e-6F);
  }
  for (glm::vec2& uv : mesh.texture) uv = {uv.y, uv.x};  // u now grows with z
  const FaceMesh turned = once(mesh, along_u);
  EXPECT_LT(glm::distance(turned.positions[7], base.positions[7] + glm::vec3(0, 0, 0.25F)), 1e-6F);
}

TEST(Placement, AFixedDirectionGivesAHeightField) {
  PlacementRule rule = displaced(Axis::kFixed, uniform_signal(1, 3));
  rule.displacements[0].where = Where::kNewVertices;
  const FaceMesh out = subdivide(flat_grid(2), std::vector(3, rule)),
                 flat = subdivide(flat_grid(2), std::vector(3, kStill));
  double moved = 0;
  for (std::size_t i = 0; i < out.positions.size(); ++i) {
    EXPECT_NEAR(out.positions[i].x, flat.positions[i].x, 1e-6);
    EXPECT_NEAR(out.positions[i].z, flat.positions[i].z, 1e-6);
    if (i < 9) {
      EXPECT_EQ(out.positions[i].y, 0) << "not a new vertex";
    }
    moved += std::abs(out.positions[i].y);
  }
  EXPECT_GT(moved / static_cast<double>(out.positions.size()), 0.05);
}

TEST(Placement, TheBoundHoldsForTheSumOfAllDisplacements) {
  PlacementRule rule = displaced(Axis::kNormal, uniform_signal(4, 0));
  rule.displacements.push_back({.axis = Axis::kTangent, .amount = uniform_signal(4, 5)});
  rule.bound = 0.5F;
  const FaceMesh base = once(flat_grid(4), kStill), out = once(flat_grid(4), rule);
  const double scale = std::sqrt(0.5);
  std::size_t at_bound = 0;
  for (std::size_t i = 0; i < out.positions.size(); ++i) {
    const double length = glm::distance(out.positions[i], base.positions[i]);
    EXPECT_LE(length, 0.5 * scale * (1 + 1e-5));
    at_bound += length > 0.499 * scale;
  }
  EXPECT_GT(at_bound, out.positions.size() / 2);
}

TEST(Placement, MovesAlongTheNormalByWhatAFunctionSaysOfTheVertex) {
  const Signal own = [](const VertexBatch& batch, std::span<float> values) {
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = batch.positions[i].x + batch.scales[i];
  };
  for (const bool by_scale : {false, true}) {
    for (const glm::vec3& p : once(flat_grid(4), displaced(Axis::kNormal, own, by_scale)).positions)
      EXPECT_NEAR(p.y, (p.x + std::sqrt(0.5)) * (by_scale ? std::sqrt(0.5) : 1), 1e-5);
  }
}

TEST(Placement, RandomNumbersFillTheirRangeAndDependOnSeedLevelAndVertex) {
  const auto numbers = [](std::uint64_t seed, std::uint32_t level) {
    std::vector<float> values(100000);
    VertexBatch batch;
    batch.level = level;
    uniform_signal(2, seed)(batch, values);
    return values;
  };
  const std::vector<float> values = numbers(1, 2);
  double sum = 0, square = 0;
  for (const float value : values) {
    sum += value;
    square += value * value;
    EXPECT_TRUE(value >= -2 && value < 2);
  }
  EXPECT_NEAR(sum / 1e5, 0, 0.02);
  EXPECT_NEAR(square / 1e5, 4.0 / 3, 0.02);
  EXPECT_NE(values, numbers(2, 2));
  EXPECT_NE(values, numbers(1, 3));
}

TEST(Subdivide, IsTheSameForEveryNumberOfThreads) {
  PlacementRule rule = fractal_rule(0.3F, 0);
  rule.displacements.push_back({.axis = Axis::kTangent, .amount = uniform_signal(1, 1)});
  const auto run = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return subdivide(with_creases(flat_grid(4), {{6, 7, 3}, {7, 8, 2}}), std::vector(6, rule));
  };
  const FaceMesh one = run(1), four = run(4);
  EXPECT_EQ(one.corners, four.corners);
  ASSERT_EQ(one.positions.size(), four.positions.size());
  EXPECT_EQ(0, std::memcmp(one.positions.data(), four.positions.data(), one.positions.size() * 12));
  EXPECT_EQ(one.texture, four.texture);
}

TEST(Subdivide, OneStepAtATimeIsTheSameAsAllAtOnce) {
  const std::vector<PlacementRule> rules(3, displaced(Axis::kNormal, constant(0.1F)));
  for (const Shape& shape : shapes()) {
    if (shape.name == "bow tie") continue;  // its pinched vertex is found again at every step
    const FaceMesh at_once = subdivide(shape.mesh, rules);
    FaceMesh stepwise = shape.mesh;
    for (std::uint32_t l = 0; l < 3; ++l) stepwise = subdivide(stepwise, {rules.data(), 1}, {}, l);
    ASSERT_EQ(at_once.corners.size(), stepwise.corners.size());
    for (std::size_t c = 0; c < at_once.corners.size(); ++c) {  // edges are numbered in another order
      const glm::vec3 p = at_once.positions[at_once.corners[c]], q = stepwise.positions[stepwise.corners[c]];
      ASSERT_LT(glm::distance(p, q), 1e-5F) << shape.name;
    }
    EXPECT_EQ(at_once.creases.size(), stepwise.creases.size()) << shape.name;
  }
}

TEST(Subdivide, KeepsSymbolsTextureAndWellFormedness) {
  for (Shape& shape : shapes()) {
    for (std::uint32_t f = 0; f < shape.mesh.faces(); ++f) shape.mesh.symbols.push_back(f + 1);
    const FaceMesh out = subdivide(shape.mesh, std::vector<PlacementRule>(3));
    std::size_t child = 0;
    for (std::uint32_t f = 0; f < shape.mesh.faces(); ++f) {
      for (std::size_t i = 0; i < 16 * shape.mesh.face(f).size(); ++i) ASSERT_EQ(out.symbols[child++], f + 1);
    }
    EXPECT_EQ(child, out.faces());
    const MeshReport report = check_mesh(out);
    EXPECT_EQ(report.faults(), shape.name == "bow tie" ? 1 : 0)
        << shape.name << ": " << testing::PrintToString(report.first);
    EXPECT_EQ(report.boundary_edges, 8 * check_mesh(shape.mesh).boundary_edges) << shape.name;
  }
}

TEST(Subdivide, InterpolatesTextureAsTheRuleSays) {
  FaceMesh mesh = flat_grid(2);
  mesh.texture[4] = {5, 5};
  EXPECT_EQ(once(mesh, {.texture = Base::kLinear}).texture[4], glm::vec2(5, 5));
  EXPECT_NEAR(once(mesh, {}).texture[4].x, 9.0 / 16 * (5 - 0.5) + 0.5, 1e-6);
}

TEST(Subdivide, RefusesWhatItCannotRefine) {
  const auto what = [](const FaceMesh& mesh) { return failure_of([&] { once(mesh, {}); }).what; };
  const auto changed = [&](const auto& change) {
    FaceMesh mesh = cube();
    change(mesh);
    return what(mesh);
  };
  EXPECT_THAT(changed([](FaceMesh& m) { m.corners[5] = 99; }), HasSubstr("vertex 99 of 8"));
  EXPECT_THAT(changed([](FaceMesh& m) { m.corners[5] = m.corners[4]; }), HasSubstr("vertex 4 twice"));
  EXPECT_THAT(changed([](FaceMesh& m) { std::swap(m.corners[0], m.corners[2]); }),
              HasSubstr("in the same direction"));
  EXPECT_THAT(changed([](FaceMesh& m) { m.first_corner[3] = 2; }), HasSubstr("corners"));
  EXPECT_THAT(changed([](FaceMesh& m) { m.first_corner.back() = 7; }), HasSubstr("first_corner"));
  EXPECT_THAT(changed([](FaceMesh& m) { m.texture.resize(3); }), HasSubstr("3 texture coordinates"));
  EXPECT_THAT(changed([](FaceMesh& m) { m.creases = {{0, 6, 1}}; }), HasSubstr("not an edge"));
  EXPECT_THAT(changed([](FaceMesh& m) { m.creases = {{0, 1, -1}}; }), HasSubstr("sharpness -1"));
  EXPECT_THAT(changed([](FaceMesh& m) { m.sharp_vertices = {{8, 1}}; }), HasSubstr("vertex 8"));
  EXPECT_THAT(what(mesh_of(std::vector<glm::vec3>(5), {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}})),
              HasSubstr("has 3 faces"));
  EXPECT_THAT(what(mesh_of(std::vector<glm::vec3>(2), {{0, 1}})), HasSubstr("2 corners"));
  EXPECT_THAT(failure_of([] {
                once(cube(), displaced(Axis::kNormal, constant(std::numeric_limits<float>::infinity())));
              }).what,
              HasSubstr("to infinity"));
  EXPECT_TRUE(once({}, {}).positions.empty());
}

TEST(Subdivide, RefusesTooManyFacesBeforeItAllocates) {
  const Failure failure = failure_of([&] { subdivide(cube(), std::vector<PlacementRule>(16)); });
  EXPECT_THAT(failure.what, HasSubstr("more than 67108864 faces"));
  EXPECT_EQ(failure.code, ExitCode::kBadInput);
  EXPECT_THAT(failure_of([&] { Refinement(cube(), 1000, {.most_faces = ~std::uint64_t{0}}); }).what,
              HasSubstr("faces"));
}

}  // namespace
}  // namespace terrabench
