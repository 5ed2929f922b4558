// The graph's modules against their formulas, and the compiler's promises: columns, points and all
// instruction sets agree bit for bit, sharing and skipping included.
#include <gtest/gtest.h>
#include <hwy/targets.h>
#include <tbb/parallel_for.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <random>
#include <string_view>
#include <vector>

#include "terrain/memory.h"
#include "terrain/sources/noise/program.h"

namespace terrabench::noise {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

float at(const Graph& g, Node node, float x, float y, float z) {
  float out = 0;
  Program(g, node).points({&x, 1}, {&y, 1}, {&z, 1}, {&out, 1});
  return out;
}

std::vector<float> column(const Program& program, const ColumnSamples& where, std::size_t count) {
  std::vector<float> out(count);
  program.column(where, out);
  return out;
}

// Bits, so that -0 and NaN count.
std::vector<std::uint32_t> bits(const std::vector<float>& values) {
  std::vector<std::uint32_t> out;
  for (const float v : values) out.push_back(std::bit_cast<std::uint32_t>(v));
  return out;
}

// x as a value.
Node coordinate(Graph& g, int axis) {
  glm::vec3 to(0);
  to[axis] = 1;
  return g.gradient(glm::vec3(0), to);
}

TEST(NoiseGraph, ModulesFollowTheirFormulas) {
  Graph g;
  const Node x = coordinate(g, 0), y = coordinate(g, 1), z = coordinate(g, 2);
  EXPECT_EQ(at(g, g.constant(2.5F), 1, 2, 3), 2.5F);
  EXPECT_EQ(at(g, x, 7, 0, 0), 7.0F);
  EXPECT_EQ(at(g, g.gradient({0, 10, 0}, {0, 0, 0}), 5, 10, 5), 0.0F);
  EXPECT_EQ(at(g, g.gradient({0, 10, 0}, {0, 0, 0}), 5, 0, 5), 1.0F);
  EXPECT_FLOAT_EQ(at(g, g.gradient({1, 1, 1}, {3, 3, 3}), 2, 2, 2), 0.5F);
  EXPECT_EQ(at(g, g.add(x, g.multiply(y, z)), 1, 2, 3), 7.0F);
  EXPECT_EQ(at(g, g.clamp(x, -1, 2), 5, 0, 0), 2.0F);
  EXPECT_EQ(at(g, g.clamp(x, -1, 2), -5, 0, 0), -1.0F);
  EXPECT_EQ(at(g, g.scale_offset(x, 3, 1), 2, 0, 0), 7.0F);
  EXPECT_EQ(at(g, g.select(y, z, x, 0.5F), 0.4F, 1, 2), 1.0F);
  EXPECT_EQ(at(g, g.select(y, z, x, 0.5F), 0.5F, 1, 2), 2.0F);
  EXPECT_EQ(at(g, g.bias(x, 0.3F), 0, 0, 0), 0.0F);
  EXPECT_EQ(at(g, g.bias(x, 0.3F), 1, 0, 0), 1.0F);
  EXPECT_FLOAT_EQ(at(g, g.bias(x, 0.3F), 0.5F, 0, 0), 0.3F);
  EXPECT_EQ(at(g, g.translate_domain(x, y), 3, 4, 0), 7.0F);
  EXPECT_EQ(at(g, g.translate_domain(g.add(x, z), {}, {}, y), 3, 4, 10), 17.0F);
  EXPECT_EQ(at(g, g.scale_domain(g.add(x, y), 2, 0, 1), 3, 4, 0), 6.0F);
  EXPECT_EQ(at(g, g.cache(x), 3, 0, 0), 3.0F);
}

// Operands that are not needed do not matter, NaN included.
TEST(NoiseGraph, UnneededOperandsDoNotMatter) {
  Graph g;
  const Node x = coordinate(g, 0), nan = g.constant(kNan);
  EXPECT_EQ(at(g, g.multiply(x, nan), 0, 0, 0), 0.0F);
  EXPECT_TRUE(std::isnan(at(g, g.multiply(x, nan), 1, 0, 0)));
  EXPECT_EQ(at(g, g.select(x, nan, x, 5.0F), 3, 0, 0), 3.0F);
  EXPECT_EQ(at(g, g.select(g.constant(1), g.constant(2), nan, 0.5F), 0, 0, 0), 1.0F);
}

TEST(NoiseGraph, DescriptionTellsGraphsApart) {
  Graph a, b, c;
  a.fbm({.seed = 1});
  b.fbm({.seed = 1});
  c.fbm({.seed = 1, .gain = std::nextafter(0.5F, 1.0F)});
  EXPECT_EQ(a.describe(), b.describe());
  EXPECT_NE(a.describe(), c.describe());
}

TEST(NoiseProgram, EqualExpressionsAreEvaluatedOnce) {
  Graph g;
  const auto hills = [&] { return g.fbm({.seed = 3, .frequency = 0.1F}); };
  const Code twice = compile(g, g.add(hills(), hills()), Mode::kColumn),
             once = compile(g, hills(), Mode::kColumn);
  EXPECT_EQ(twice.batch.size(), once.batch.size() + 1);
}

TEST(NoiseProgram, WhatIsConstantAlongAColumnRunsOncePerColumn) {
  Graph g;
  const Node flat = g.scale_domain(g.fbm({.seed = 3}), 1, 0, 1);
  const Program program(g, flat);
  EXPECT_TRUE(compile(g, flat, Mode::kColumn).batch.empty());
  const std::vector<float> values = column(program, {1.5F, 2.5F, -100.0F, 3.0F}, 200);
  for (const float v : values) EXPECT_EQ(v, values[0]);
  EXPECT_EQ(values[0], at(g, flat, 1.5F, 77.0F, 2.5F));
}

TEST(NoiseProgram, EveryModuleCanRunForEverySample) {
  Graph g;
  const Node flat = g.scale_domain(g.fbm({.seed = 3}), 1, 0, 1);
  const Node root = g.select(g.fbm({.seed = 4}), g.ridged_multifractal({.seed = 5}), flat, 0.0F);
  const Program lazy(g, root), every(g, root, Evaluation::kEverySample);
  EXPECT_GT(compile(g, root, Mode::kColumn).once.size(), compile(g, root, Mode::kEverySample).once.size());
  const ColumnSamples at{1.5F, 2.5F, -100.0F, 0.37F};
  EXPECT_EQ(column(every, at, 300), column(lazy, at, 300));
}

// A random graph over all modules: deep, shared, with lazies nested in lazies.
Node random_graph(Graph& g, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto real = [&](float low, float high) {
    return low + (high - low) * static_cast<float>(random() >> 40) * 0x1p-24F;
  };
  std::vector<Node> nodes = {coordinate(g, 0), coordinate(g, 1), coordinate(g, 2), g.constant(0),
                             g.constant(1)};
  const auto any = [&] { return nodes[random() % nodes.size()]; };
  const auto recent = [&] {
    return nodes[nodes.size() - 1 - random() % std::min<std::size_t>(nodes.size(), 6)];
  };
  const auto fractal = [&] {
    return Fractal{
        .seed = random() % 4, .frequency = real(0.02F, 0.4F), .octaves = 1 + static_cast<int>(random() % 4)};
  };
  for (int i = 0; i < 24; ++i) {
    switch (random() % 11) {
      case 0:
        nodes.push_back(g.fbm(fractal()));
        break;
      case 1:
        nodes.push_back(g.ridged_multifractal(fractal()));
        break;
      case 2:
        nodes.push_back(g.billow(fractal()));
        break;
      case 3:
        nodes.push_back(g.clamp(recent(), real(-2, 0), real(0, 2)));
        break;
      case 4:
        nodes.push_back(g.select(any(), recent(), recent(), real(-1, 1)));
        break;
      case 5:
        nodes.push_back(g.scale_offset(recent(), real(-2, 2), real(-1, 1)));
        break;
      case 6:
        nodes.push_back(g.bias(recent(), real(0.1F, 0.9F)));
        break;
      case 7:
        nodes.push_back(g.add(recent(), any()));
        break;
      case 8:
        nodes.push_back(g.multiply(g.select(nodes[3], nodes[4], recent(), real(-0.5F, 0.5F)), recent()));
        break;
      case 9:
        nodes.push_back(g.translate_domain(recent(), random() % 2 ? any() : Node{},
                                           random() % 2 ? any() : Node{}, random() % 2 ? any() : Node{}));
        break;
      default:
        nodes.push_back(g.scale_domain(recent(), real(-2, 2), random() % 2 ? 0 : real(0.1F, 2), 1));
        break;
    }
  }
  return nodes.back();
}

// Points mode shares no lattice planes, hoists nothing and has no bounds, and a single point skips all that
// it can: three ways to the same bits.
TEST(NoiseProgram, ColumnsPointsAndSinglePointsAgreeBitForBit) {
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    Graph g;
    const Program program(g, random_graph(g, seed));
    const ColumnSamples where{3.7F, -11.2F, -40.0F,
                              seed % 3 == 0 ? -0.37F : 0.25F * static_cast<float>(1 + seed % 7)};
    const std::size_t count = 1 + seed * 7 % 400;
    const std::vector<float> x(count, where.x), z(count, where.z);
    std::vector<float> y(count), together(count), apart(count);
    for (std::size_t i = 0; i < count; ++i) y[i] = where.y0 + static_cast<float>(i) * where.dy;
    program.points(x, y, z, together);
    for (std::size_t i = 0; i < count; ++i)
      program.points({&x[i], 1}, {&y[i], 1}, {&z[i], 1}, {&apart[i], 1});
    ASSERT_EQ(bits(column(program, where, count)), bits(together)) << "seed " << seed << '\n' << g.describe();
    ASSERT_EQ(bits(apart), bits(together)) << "seed " << seed << '\n' << g.describe();
  }
}

TEST(NoiseProgram, AllInstructionSetsAgreeBitForBit) {
  const std::vector<std::int64_t> targets = hwy::SupportedAndGeneratedTargets();
  EXPECT_GT(targets.size(), 1U);
  std::vector<std::string_view> names;
  std::vector<std::vector<std::uint32_t>> results;
  for (const std::int64_t target : targets) {
    hwy::SetSupportedTargetsForTest(target);
    names.push_back(simd_name());
    std::vector<std::uint32_t> all;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
      Graph g;
      const Program program(g, random_graph(g, seed));
      for (const float dy : {0.25F, 3.1F, -0.5F}) {
        const auto values = bits(column(program, {-2.1F, 5.3F, -60.0F, dy}, 200 + seed));
        all.insert(all.end(), values.begin(), values.end());
      }
    }
    results.push_back(all);
  }
  hwy::SetSupportedTargetsForTest(0);
  for (std::size_t i = 1; i < results.size(); ++i) {
    EXPECT_NE(names[i], names[0]);
    EXPECT_EQ(results[i], results[0]) << names[i] << " and " << names[0];
  }
}

TEST(NoiseProgram, ThreadsAgreeAndSharePrograms) {
  Graph g;
  const Program program(g, random_graph(g, 17));
  constexpr std::size_t kColumns = 500, kCount = 100;
  const auto run = [&](std::size_t i, std::vector<float>& out) {
    program.column({static_cast<float>(i), 2.0F, -20.0F, 0.4F}, std::span(out).subspan(i * kCount, kCount));
  };
  std::vector<float> serial(kColumns * kCount), parallel(kColumns * kCount);
  for (std::size_t i = 0; i < kColumns; ++i) run(i, serial);
  tbb::parallel_for(std::size_t{0}, kColumns, [&](std::size_t i) { run(i, parallel); });
  EXPECT_EQ(bits(serial), bits(parallel));
}

TEST(NoiseProgram, SlicesAreMadeOfColumns) {
  Graph g;
  const Program program(g, random_graph(g, 5));
  const Slice slice{.x0 = 1, .y0 = -3, .dx = 0.5F, .dy = 0.25F, .z = 9, .width = 7, .height = 30};
  std::vector<float> image(7 * 30);
  program.slice(slice, image);
  const std::vector<float> third = column(program, {2.0F, 9.0F, -3.0F, 0.25F}, 30);
  for (std::size_t j = 0; j < 30; ++j) EXPECT_EQ(bits({image[j * 7 + 2]}), bits({third[j]}));
}

TEST(NoiseProgram, AllocatesNothingAfterTheFirstCall) {
  Graph g;
  const Program program(g, random_graph(g, 3));
  std::vector<float> out(300);
  program.column({0, 0, 0, 1}, out);
  HeapCounter::reset_peak();
  const HeapScope heap;
  const std::int64_t peak = HeapCounter::peak();
  for (int i = 0; i < 50; ++i) program.column({static_cast<float>(i), 0, 0, 1}, out);
  EXPECT_EQ(heap.held(), 0);
  EXPECT_EQ(HeapCounter::peak(), peak);
}

TEST(NoiseProgram, EmptyRequestsDoNothing) {
  Graph g;
  const Program program(g, g.fbm({}));
  program.column({0, 0, 0, 1}, {});
  program.points({}, {}, {}, {});
  program.slice({.width = 0, .height = 0}, {});
}

}  // namespace
}  // namespace terrabench::noise
