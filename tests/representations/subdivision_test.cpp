// Refinement and placement: limits, rules, creases, threads and wrong input.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <cstring>
#include <glm/glm.hpp>

#include "representations/procedural_mesh/mesh_checks.h"
#include "representations/procedural_mesh/subdivision/hashed_random.h"
#include "representations/procedural_mesh/subdivision/limit.h"
#include "representations/procedural_mesh/subdivision/refinement.h"
#include "tests/representations/face_shapes.h"
#include "tests/terrain/errors.h"

namespace terrabench {
namespace {

using namespace subdivision;
using testing::HasSubstr;
using DoublePoints = std::vector<glm::dvec3>;

DoublePoints refined(const Refinement& refinement, int from, int to, DoublePoints points) {
  for (int l = from; l < to; ++l) {
    DoublePoints next(refinement.topology(l + 1).vertices);
    place_standard<glm::dvec3>(refinement.topology(l), refinement.stencils(l), points, next);
    points = std::move(next);
  }
  return points;
}

DoublePoints limits_of(const Topology& t, const DoublePoints& points) {
  DoublePoints out(points.size());
  limit_points<glm::dvec3>(t, points, out);
  return out;
}

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
      DoublePoints points = positions_of(shape.mesh);
      const DoublePoints limit = limits_of(refinement.topology(0), points);
      double before = 0;
      for (int l = 1; l <= 5; ++l) {
        points = refined(refinement, l - 1, l, points);
        const DoublePoints finer = limits_of(refinement.topology(l), points);
        EXPECT_LT(mean_distance(limit, finer, limit.size()), 1e-13) << shape.name << " " << l;
        const double now = mean_distance(limit, points, limit.size());
        if (l == 5 && before > 1e-9) {
          EXPECT_LT(now, 0.5 * before) << shape.name;
        }
        before = now;
      }
    }
  }
}

// Where the surface is regular the distance to the limit falls to a quarter per level ("converge").
TEST(Limit, DistanceFallsToAQuarterPerLevel) {
  for (const FaceMesh& mesh : {torus(5, 4), grid(3), cube(), star(5)}) {
    const Refinement refinement(mesh, 6);
    DoublePoints points = positions_of(mesh);
    double before = 0;
    for (int l = 1; l <= 6; ++l) {
      points = refined(refinement, l - 1, l, points);
      const double now = mean_distance(points, limits_of(refinement.topology(l), points), points.size());
      if (l >= 4) {
        EXPECT_NEAR(now / before, 0.25, 0.02) << l;
      }
      before = now;
    }
  }
}

TEST(Limit, OfTheRegularMeshIsTheBicubicSpline) {
  const FaceMesh mesh = torus(6, 5);
  const Refinement refinement(mesh, 0);
  const DoublePoints p = positions_of(mesh), limit = limits_of(refinement.topology(0), p);
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

PlacementRule displaced(Axis axis, Signal amount, bool by_scale = true) {
  Displacement d;
  d.axis = axis;
  d.by_scale = by_scale;
  d.amount = std::move(amount);
  PlacementRule rule;
  rule.base = Base::kLinear;
  rule.displacements = {d};
  return rule;
}

FaceMesh flat_grid(std::uint32_t n) {
  FaceMesh mesh = grid(n);
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
    mesh.positions[v] = {static_cast<float>(v % (n + 1)), 0, static_cast<float>(v / (n + 1))};
    mesh.texture.push_back({mesh.positions[v].x / 2, mesh.positions[v].z});
  }
  return mesh;
}

// Unit squares refined once have diagonals of √2/2.
TEST(Placement, MovesAlongTheNormalByTheScaleFactor) {
  const FaceMesh mesh = flat_grid(4);
  const PlacementRule rule = displaced(Axis::kNormal, {.amplitude = 0.5F});
  const FaceMesh out = subdivide(mesh, {&rule, 1});
  for (const glm::vec3& p : out.positions) EXPECT_NEAR(p.y, 0.5 * std::sqrt(0.5), 1e-6);
}

TEST(Placement, MovesInTheTangentPlaneAlongTheTextureCoordinates) {
  FaceMesh mesh = flat_grid(4);
  PlacementRule along_u = displaced(Axis::kTangent, {.amplitude = 0.25F}, false);
  PlacementRule across = displaced(Axis::kBitangent, {.amplitude = 0.25F}, false);
  along_u.texture = across.texture = Base::kLinear;  // a smooth one bends u at the rim
  const PlacementRule still = displaced(Axis::kNormal, {.amplitude = 0});
  const FaceMesh base = subdivide(mesh, {&still, 1});
  const FaceMesh u = subdivide(mesh, {&along_u, 1}), v = subdivide(mesh, {&across, 1});
  for (std::size_t i = 0; i < base.positions.size(); ++i) {
    EXPECT_LT(glm::distance(u.positions[i], base.positions[i] + glm::vec3(0.25F, 0, 0)), 1e-6F);
    // normal × tangent = y × x = -z
    EXPECT_LT(glm::distance(v.positions[i], base.positions[i] + glm::vec3(0, 0, -0.25F)), 1e-6F);
  }
  for (glm::vec2& uv : mesh.texture) uv = {uv.y, uv.x};  // u now grows with z
  const FaceMesh turned = subdivide(mesh, {&along_u, 1});
  EXPECT_LT(glm::distance(turned.positions[7], base.positions[7] + glm::vec3(0, 0, 0.25F)), 1e-6F);
}

TEST(Placement, AFixedDirectionGivesAHeightField) {
  PlacementRule rule = displaced(Axis::kFixed, {.kind = Signal::Kind::kUniform, .seed = 3});
  rule.displacements[0].where = Where::kNewVertices;
  const std::vector<PlacementRule> rules(3, rule);
  const FaceMesh out = subdivide(flat_grid(2), rules);
  PlacementRule still;
  still.base = Base::kLinear;
  const FaceMesh flat = subdivide(flat_grid(2), std::vector<PlacementRule>(3, still));
  double moved = 0;
  for (std::size_t i = 0; i < out.positions.size(); ++i) {
    EXPECT_NEAR(out.positions[i].x, flat.positions[i].x, 1e-6);
    EXPECT_NEAR(out.positions[i].z, flat.positions[i].z, 1e-6);
    if (i < 9) {
      EXPECT_EQ(out.positions[i].y, 0);
    }  // new vertices only
    moved += std::abs(out.positions[i].y);
  }
  EXPECT_GT(moved / static_cast<double>(out.positions.size()), 0.05);
}

TEST(Placement, TheBoundHoldsForTheSumOfAllDisplacements) {
  PlacementRule rule = displaced(Axis::kNormal, {.kind = Signal::Kind::kNormal, .amplitude = 4});
  rule.displacements.push_back(rule.displacements[0]);
  rule.displacements[1].axis = Axis::kTangent;
  rule.displacements[1].amount.seed = 5;
  rule.bound = 0.5F;
  PlacementRule still;
  still.base = Base::kLinear;
  const FaceMesh base = subdivide(flat_grid(4), {&still, 1}), out = subdivide(flat_grid(4), {&rule, 1});
  const double scale = std::sqrt(0.5);
  std::size_t at_bound = 0;
  for (std::size_t i = 0; i < out.positions.size(); ++i) {
    const double length = glm::distance(out.positions[i], base.positions[i]);
    EXPECT_LE(length, 0.5 * scale * (1 + 1e-5));
    at_bound += length > 0.499 * scale;
  }
  EXPECT_GT(at_bound, out.positions.size() / 2);
}

TEST(Placement, TextureAndNoiseAndFunctionsDriveDisplacements) {
  const FaceMesh mesh = flat_grid(4);
  const PlacementRule wave =
      displaced(Axis::kNormal, {.kind = Signal::Kind::kTextureWave, .frequency = {1, 0.5F, 0}}, false);
  const FaceMesh out = subdivide(mesh, {&wave, 1});
  for (std::size_t i = 0; i < out.positions.size(); ++i) {
    const glm::dvec2 uv(out.texture[i]);
    EXPECT_NEAR(out.positions[i].y, std::cos(2 * M_PI * (uv.x + 0.5 * uv.y)), 1e-5);
  }
  Signal own{.kind = Signal::Kind::kFunction};
  own.function = [](const VertexBatch& batch, std::span<float> values) {
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = batch.positions[i].x + batch.scales[i];
  };
  const PlacementRule function = displaced(Axis::kNormal, own, false);
  const FaceMesh by_function = subdivide(mesh, {&function, 1});
  for (const glm::vec3& p : by_function.positions) EXPECT_NEAR(p.y, p.x + std::sqrt(0.5), 1e-5);
  for (const Signal::Kind kind : {Signal::Kind::kNoise, Signal::Kind::kTextureNoise}) {
    const PlacementRule noise =
        displaced(Axis::kNormal, {.kind = kind, .frequency = {0.7F, 1.3F, 0.7F}}, false);
    const FaceMesh rough = subdivide(mesh, {&noise, 1});
    float low = 1, high = -1;
    for (const glm::vec3& p : rough.positions) low = std::min(low, p.y), high = std::max(high, p.y);
    EXPECT_GT(high - low, 0.3F);
    EXPECT_LE(std::max(high, -low), 1.0F);
  }
}

TEST(Placement, RandomNumbersHaveTheirMoments) {
  double sum = 0, square = 0, uniform = 0;
  constexpr int kCount = 100000;
  for (std::uint32_t v = 0; v < kCount; ++v) {
    const double x = normal_of(vertex_hash(1, 2, v)), u = uniform_of(vertex_hash(1, 2, v));
    sum += x;
    square += x * x;
    uniform += u * u;
    EXPECT_TRUE(u >= -1 && u < 1);
  }
  EXPECT_NEAR(sum / kCount, 0, 0.02);
  EXPECT_NEAR(square / kCount, 1, 0.02);
  EXPECT_NEAR(uniform / kCount, 1.0 / 3, 0.01);
  EXPECT_NE(vertex_hash(1, 2, 3), vertex_hash(1, 3, 2));
  EXPECT_NE(vertex_hash(1, 2, 3), vertex_hash(2, 2, 3));
}

TEST(Subdivide, IsTheSameForEveryNumberOfThreads) {
  PlacementRule rule = displaced(Axis::kNormal, {.kind = Signal::Kind::kUniform, .amplitude = 0.3F});
  rule.displacements.push_back(rule.displacements[0]);
  rule.displacements[1].axis = Axis::kTangent;
  rule.displacements[1].amount.kind = Signal::Kind::kNoise;
  rule.base = Base::kStandard;
  const std::vector<PlacementRule> rules(6, rule);
  const auto run = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return subdivide(with_creases(flat_grid(4), {{6, 7, 3}, {7, 8, 2}}), rules);
  };
  const FaceMesh one = run(1), four = run(4);
  EXPECT_EQ(one.corners, four.corners);
  ASSERT_EQ(one.positions.size(), four.positions.size());
  EXPECT_EQ(0, std::memcmp(one.positions.data(), four.positions.data(), one.positions.size() * 12));
  EXPECT_EQ(one.texture, four.texture);
}

TEST(Subdivide, OneStepAtATimeIsTheSameAsAllAtOnce) {
  for (const Shape& shape : shapes()) {
    if (shape.name == "bow tie") continue;  // its pinched vertex is found again at every step
    const PlacementRule rule = displaced(Axis::kNormal, {.amplitude = 0.1F});
    const std::vector<PlacementRule> rules(3, rule);
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
    const std::vector<PlacementRule> rules(3);
    const FaceMesh out = subdivide(shape.mesh, rules);
    std::size_t child = 0;
    for (std::uint32_t f = 0; f < shape.mesh.faces(); ++f) {
      const std::size_t children = 16 * (shape.mesh.first_corner[f + 1] - shape.mesh.first_corner[f]);
      for (std::size_t i = 0; i < children; ++i) ASSERT_EQ(out.symbols[child++], f + 1);
    }
    EXPECT_EQ(child, out.faces());
    const MeshReport report = check_mesh(out);
    const std::size_t fans = shape.name == "bow tie" ? 1 : 0;
    EXPECT_EQ(report.faults(), fans) << shape.name << ": " << testing::PrintToString(report.first);
    const MeshReport base = check_mesh(shape.mesh);
    EXPECT_EQ(report.boundary_edges, 8 * base.boundary_edges) << shape.name;
  }
}

TEST(Subdivide, InterpolatesTextureAsTheRuleSays) {
  FaceMesh mesh = flat_grid(2);
  const PlacementRule smooth{};
  PlacementRule linear;
  linear.texture = Base::kLinear;
  mesh.texture[4] = {5, 5};
  EXPECT_EQ(subdivide(mesh, {&linear, 1}).texture[4], glm::vec2(5, 5));
  const FaceMesh out = subdivide(mesh, {&smooth, 1});
  EXPECT_NEAR(out.texture[4].x, 9.0 / 16 * (5 - 0.5) + 0.5, 1e-6);
}

TEST(Subdivide, RefusesWhatItCannotRefine) {
  const std::vector<PlacementRule> rules(1);
  const auto what = [&](FaceMesh mesh) { return failure_of([&] { subdivide(mesh, rules); }).what; };
  FaceMesh mesh = cube();
  mesh.corners[5] = 99;
  EXPECT_THAT(what(mesh), HasSubstr("vertex 99 of 8"));
  mesh = cube();
  mesh.corners[5] = mesh.corners[4];
  EXPECT_THAT(what(mesh), HasSubstr("vertex 4 twice"));
  mesh = cube();
  std::swap(mesh.corners[0], mesh.corners[2]);
  EXPECT_THAT(what(mesh), HasSubstr("in the same direction"));
  EXPECT_THAT(what(mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}},
                           {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}})),
              HasSubstr("has 3 faces"));
  EXPECT_THAT(what(mesh_of({{0, 0, 0}, {1, 0, 0}}, {{0, 1}})), HasSubstr("2 corners"));
  mesh = cube();
  mesh.first_corner[3] = 2;
  EXPECT_THAT(what(mesh), HasSubstr("corners"));
  mesh = cube();
  mesh.first_corner.back() = 7;
  EXPECT_THAT(what(mesh), HasSubstr("first_corner"));
  EXPECT_THAT(what(with_creases(cube(), {{0, 6, 1}})), HasSubstr("not an edge"));
  EXPECT_THAT(what(with_creases(cube(), {{0, 1, -1}})), HasSubstr("sharpness -1"));
  EXPECT_THAT(what(with_creases(cube(), {}, {{8, 1}})), HasSubstr("vertex 8"));
  mesh = cube();
  mesh.texture.resize(3);
  EXPECT_THAT(what(mesh), HasSubstr("3 texture coordinates"));
  EXPECT_TRUE(subdivide(FaceMesh{}, rules).positions.empty());
}

TEST(Subdivide, RefusesTooManyFacesBeforeItAllocates) {
  const std::vector<PlacementRule> rules(16);
  const Failure failure = failure_of([&] { subdivide(cube(), rules); });
  EXPECT_THAT(failure.what, HasSubstr("more than 67108864 faces"));
  EXPECT_EQ(failure.code, ExitCode::kBadInput);
  EXPECT_THAT(failure_of([&] { Refinement(cube(), 1000, {.most_faces = ~std::uint64_t{0}}); }).what,
              HasSubstr("faces"));
}

TEST(Subdivide, RefusesRulesThatCannotBe) {
  const auto what = [&](const PlacementRule& rule) {
    return failure_of([&] { subdivide(cube(), {&rule, 1}); }).what;
  };
  EXPECT_THAT(what(displaced(Axis::kNormal, {.amplitude = NAN})), HasSubstr("not finite"));
  EXPECT_THAT(what(displaced(Axis::kNormal, {.kind = Signal::Kind::kNoise, .octaves = 0})),
              HasSubstr("octaves"));
  EXPECT_THAT(what(displaced(Axis::kNormal, {.kind = Signal::Kind::kTextureWave})), HasSubstr("no texture"));
  EXPECT_THAT(what(displaced(Axis::kNormal, {.kind = Signal::Kind::kFunction})),
              HasSubstr("without function"));
  EXPECT_THAT(what(displaced(Axis::kNormal, {.amplitude = 3e38F, .offset = 3e38F})),
              HasSubstr("to infinity"));
  PlacementRule rule;
  rule.bound = -1;
  EXPECT_THAT(what(rule), HasSubstr("bound"));
}

}  // namespace
}  // namespace terrabench
