// §3.1.2 of "hybrid": the field's values where the paper states them, that it is linear in the material, and
// two extractors of its zero set.
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <numeric>
#include <random>

#include "experiments/experiment.h"
#include "experiments/samples.h"
#include "experiments/stopwatch.h"
#include "renderers/raytrace/ray_index.h"
#include "representations/implicit/implicit_surface.h"
#include "terrain/memory.h"
#include "terrain/sources/noise/cave_terrain.h"

namespace terrabench::hybrid {
namespace {

constexpr std::array<std::string_view, 2> kMeasures{"values", "surface"};

const std::array kSpecs{
    choice("measure", kMeasures, "the field's values, or the surface"),
    choice("kernel", kKernelNames, "support of the convolution"),
    choice("extractor", kExtractorNames, "of the surface"),
    ParameterSpec{"n", std::int64_t{128}, "cells", "cells along each side of the cube", 64, 1024},
    ParameterSpec{"radius", 2.0, "columns", "of the kernel", 0.5, 16},
    ParameterSpec{"positions", std::int64_t{20000}, "", "random positions on the terrain", 100, 10000000},
};

std::vector<Case> cases(const RunOptions& options) {
  const std::int64_t n = options.profile == Profile::kPaper ? 256 : 64;
  std::vector<Case> cases;
  for (const std::string_view kernel : kKernelNames) {
    for (const double radius : {1.0, 2.0, 4.0}) {
      cases.push_back({fmt::format("values-{}-{}", kernel, radius),
                       {kSpecs, {{"kernel", std::string(kernel)}, {"n", n}, {"radius", radius}}}});
    }
  }
  for (const std::string_view extractor : kExtractorNames) {
    for (const std::string_view kernel : kKernelNames) {
      cases.push_back({fmt::format("{}-{}", extractor, kernel),
                       {kSpecs,
                        {{"measure", std::string("surface")},
                         {"kernel", std::string(kernel)},
                         {"extractor", std::string(extractor)},
                         {"n", n}}}});
    }
  }
  return cases;
}

// The least and the greatest value of the field over the positions of one kind.
struct Values {
  std::size_t positions = 0;
  double least = 2, most = -2;
  void add(double value) {
    ++positions;
    least = std::min(least, value);
    most = std::max(most, value);
  }
  void record(Recorder& recorder, std::string_view kind) const {
    recorder.add(fmt::format("{}_least", kind), "", least);
    recorder.add(fmt::format("{}_most", kind), "", most);
  }
};

// A ground, asked voxel by voxel, whatever structure holds it.
class Voxels {
 public:
  explicit Voxels(const LayeredStack& stack) : stack_(stack), grid_(stack.grid()) {}
  // Above is air; below and beyond the sides the outermost voxels continue.
  bool solid(int i, int level, int j) const {
    if (level >= grid_.levels) return false;
    const ColumnRuns runs =
        stack_.column(std::clamp(i, 0, grid_.width - 1), std::clamp(j, 0, grid_.depth - 1));
    for (std::size_t r = 0; r < runs.count; ++r) {
      if (std::max(level, 0) < runs.tops[r]) return runs.materials[r] != Material::kAir;
    }
    return false;
  }
  // Whether all voxels that a cube of this half side overlaps are solid (+1) or air (-1); 0 for both kinds.
  // `at` in voxels from the low corner.
  int uniform(glm::dvec3 at, double half_side) const {
    const glm::ivec3 low(glm::floor(at - half_side)), high(glm::ceil(at + half_side));
    bool any = false, all = true;
    for (int j = low.z; j < high.z; ++j) {
      for (int level = low.y; level < high.y; ++level) {
        for (int i = low.x; i < high.x; ++i) {
          (solid(i, level, j) ? any : all) = solid(i, level, j);
          if (any && !all) return 0;
        }
      }
    }
    return all ? 1 : -1;
  }

 private:
  const LayeredStack& stack_;
  const ColumnGrid& grid_;
};

// A source of the voxels within `radius` of a corner, those for which solid(offset) is true.
template <class IsSolid>
TerrainSource voxels_around(int radius, const IsSolid& solid) {
  TerrainSource source;
  source.name = "voxels around a corner";
  source.solid =
      Solid{{glm::vec3(0), glm::vec3(static_cast<float>(2 * radius))},
            "",
            [=](const ColumnSamples& at, std::span<Material> out) {
              for (std::size_t k = 0; k < out.size(); ++k) {
                const glm::ivec3 v(static_cast<int>(at.x), static_cast<int>(k), static_cast<int>(at.z));
                out[k] = solid(v) ? Material::kBedrock : Material::kAir;
              }
            }};
  return source;
}

// The voxels around a corner of the terrain's, but on one side of the corner turned into their opposite on
// the other side: solid where the mirrored voxel is air. Any support that is symmetric about the corner is
// exactly half full.
TerrainSource half_full(const Voxels& voxels, glm::ivec3 corner, int radius) {
  return voxels_around(radius, [=](glm::ivec3 v) {
    const bool mirrored = v.x >= radius;
    if (mirrored) v = 2 * radius - 1 - v;
    const glm::ivec3 at = corner - radius + v;
    return voxels.solid(at.x, at.y, at.z) != mirrored;
  });
}

// A number for a voxel, which no pattern of the kernel or the terrain repeats.
std::uint32_t scrambled(glm::ivec3 v) {
  std::uint32_t h = static_cast<std::uint32_t>(v.x) * 73856093U ^
                    static_cast<std::uint32_t>(v.y) * 19349663U ^ static_cast<std::uint32_t>(v.z) * 83492791U;
  h = (h ^ (h >> 15)) * 0x2c1b3c6dU;
  h = (h ^ (h >> 12)) * 0x297a2d39U;
  return h ^ (h >> 15);
}

// Of the solid voxels around a corner those whose number is even (part 0) or odd (1), or all (2).
TerrainSource part_of_solid(const Voxels& voxels, glm::ivec3 corner, int radius, int part) {
  return voxels_around(radius, [=](glm::ivec3 v) {
    const glm::ivec3 at = corner - radius + v;
    return voxels.solid(at.x, at.y, at.z) && (part == 2 || static_cast<int>(scrambled(v) & 1U) == part);
  });
}

// All lengths in metres.
std::unique_ptr<ImplicitSurface> build(const TerrainSource& source, const Case& at, std::int64_t resolution,
                                       double radius, double cell, Progress& progress) {
  const Parameters parameters(ImplicitSurface::parameters(),
                              {{"resolution", resolution},
                               {"kernel", at.parameters.text("kernel")},
                               {"radius", radius},
                               {"cell", cell},
                               {"extractor", at.parameters.text("extractor")}});
  return ImplicitSurface::build_surface(source, parameters, progress);
}

void measure_values(const Case& at, const ImplicitSurface& surface, std::uint64_t seed, Recorder& recorder,
                    Progress& progress) {
  const ColumnGrid& grid = surface.stack().grid();
  const Voxels voxels(surface.stack());
  const double radius = at.parameters.number("radius");  // in columns, which are cubes here
  std::mt19937 random(static_cast<std::mt19937::result_type>(seed));
  std::uniform_real_distribution<double> unit(0, 1);
  Values full, empty, partial, half;
  for (int k = 0; k < at.integer("positions"); ++k) {
    const glm::dvec3 p = glm::dvec3(unit(random), unit(random), unit(random)) *
                         glm::dvec3(grid.width, grid.levels, grid.depth);
    const double value = surface.field().at(surface.bounds().low + glm::vec3(p * grid.cell_x));
    // The field rounds positions by up to 1/16 of a column: leave out supports that end as close to a voxel,
    // and those of which only the cube around them, or what lies outside the cube inside them, is mixed.
    const int kind = voxels.uniform(p, radius + 0.125);
    const double inside = surface.field().kernel() == Kernel::kCube ? radius : radius / std::sqrt(3.0);
    if (kind != 0) {
      (kind > 0 ? full : empty).add(value);
    } else if (voxels.uniform(p, inside - 0.125) == 0) {
      partial.add(value);
    }
  }
  const int reach = static_cast<int>(std::ceil(radius)) + 1;
  double divided = 0, off_sum = 0;
  for (int k = 0; k < 100; ++k) {
    const glm::ivec3 corner(static_cast<int>(unit(random) * grid.width),
                            static_cast<int>(unit(random) * grid.levels),
                            static_cast<int>(unit(random) * grid.depth));
    const auto around = build(half_full(voxels, corner, reach), at, 2 * reach, radius, 0, progress);
    half.add(around->field().at(glm::vec3(static_cast<float>(reach))));
    // Linear: what two parts of the material add to the field of air, they add together.
    std::array<double, 3> field{};
    for (int part = 0; part < 3; ++part) {
      const auto built =
          build(part_of_solid(voxels, corner, reach, part), at, 2 * reach, radius, 0, progress);
      field[static_cast<std::size_t>(part)] = built->field().at(glm::vec3(static_cast<float>(reach)));
    }
    if (field[0] == -1 || field[1] == -1) continue;  // one of the parts is empty
    ++divided;
    off_sum = std::max(off_sum, std::abs((field[0] + 1) + (field[1] + 1) - (field[2] + 1)));
  }
  recorder.add("divided_supports", "", divided);
  recorder.add("off_the_parts_sum", "", off_sum);
  recorder.add("full_positions", "", static_cast<double>(full.positions));
  recorder.add("empty_positions", "", static_cast<double>(empty.positions));
  full.record(recorder, "full");
  empty.record(recorder, "empty");
  partial.record(recorder, "partial");
  half.record(recorder, "half");
}

// The surface over the chunks from begin to end, without walls; the chunks do not share vertices.
TriangleMesh open_surface(const ImplicitSurface& surface, glm::ivec2 begin, glm::ivec2 end) {
  TriangleMesh all;
  begin = glm::max(begin, glm::ivec2(0));
  end = glm::min(end, surface.chunks());
  for (int j = begin.y; j < end.y; ++j) {
    for (int i = begin.x; i < end.x; ++i) {
      const TriangleMesh chunk = surface.chunk({i, j}, 0);
      const auto first = static_cast<std::uint32_t>(all.positions.size());
      all.positions.insert(all.positions.end(), chunk.positions.begin(), chunk.positions.end());
      for (const std::uint32_t index : chunk.indices) all.indices.push_back(first + index);
    }
  }
  return all;
}

// How far a surface lies from another: the one-sided Hausdorff distance, from the vertices and the triangles'
// centroids of `from` to the nearest point of a triangle of `to`. Metres, over the points, not by area.
struct SurfaceDistance {
  double largest = 0, common = 0, mean = 0;  // `common`: 99 % of the points are nearer
};

SurfaceDistance distance_to(const TriangleMesh& from, const TriangleMesh& to) {
  const RayIndex index(to);
  const std::size_t vertices = from.positions.size();
  std::vector<float> distances(vertices + from.triangles());
  tbb::parallel_for(std::size_t{0}, distances.size(), [&](std::size_t k) {
    const auto corner = [&](std::size_t c) { return from.positions[from.indices[3 * (k - vertices) + c]]; };
    distances[k] =
        index.distance(k < vertices ? from.positions[k] : (corner(0) + corner(1) + corner(2)) / 3.0F, to);
  });
  SurfaceDistance found;
  found.largest = *std::ranges::max_element(distances);
  found.mean =
      std::accumulate(distances.begin(), distances.end(), 0.0) / static_cast<double>(distances.size());
  const auto rank = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() * 99 / 100);
  std::nth_element(distances.begin(), rank, distances.end());
  found.common = *rank;
  return found;
}

void measure_surface(const Case& at, const TerrainSource& source, const ImplicitSurface& surface,
                     Recorder& recorder, Progress& progress) {
  constexpr int kFiner = 4;
  for (int k = 0; k < kSamples; ++k) {
    HeapCounter::reset_peak();
    const std::int64_t before = HeapCounter::live();
    TriangleMesh mesh;
    recorder.add("time", "s", seconds([&] { mesh = surface.mesh({}); }));
    if (k > 0) continue;
    const double bytes = static_cast<double>(mesh.positions.size() * 2 * sizeof(glm::vec3) +
                                             mesh.indices.size() * sizeof(std::uint32_t));
    recorder.add_varying("peak_memory", "", static_cast<double>(HeapCounter::peak() - before) / bytes);
    const EdgeReport edges = check_edges(mesh);
    recorder.add("triangles", "", static_cast<double>(mesh.triangles()));
    recorder.add("open_edges", "", static_cast<double>(edges.open));
    recorder.add("non_manifold_edges", "", static_cast<double>(edges.non_manifold));
  }
  // Marching cubes at a quarter of the cell stands for the zero set, over the middle of the terrain: two
  // chunks along each side. The nearest point may lie one chunk outside.
  const float cell = surface.lattice().cell;
  Case exact = at;
  exact.parameters.set("extractor", std::string("marching_cubes"));
  const auto fine = build(source, exact, at.parameters.integer("n"), surface.field().radius(),
                          static_cast<double>(cell) / kFiner, progress);
  const glm::ivec2 begin = surface.chunks() / 2 - 1, end = begin + 2;
  const SurfaceDistance from_mesh = distance_to(open_surface(surface, begin, end),
                                                open_surface(*fine, kFiner * begin - 1, kFiner * end + 1)),
                        to_mesh = distance_to(open_surface(*fine, kFiner * begin, kFiner * end),
                                              open_surface(surface, begin - 1, end + 1));
  recorder.add("hausdorff", "cells", std::max(from_mesh.largest, to_mesh.largest) / cell);
  recorder.add("common_distance", "cells", std::max(from_mesh.common, to_mesh.common) / cell);
  recorder.add("mean_distance", "cells", std::max(from_mesh.mean, to_mesh.mean) / cell);
}

bool times(const Case& at) { return at.parameters.text("measure") == "surface"; }

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const TerrainSource source = recorder.terrain(noise::cave_source({.seed = options.seed}));
  const std::int64_t n = at.parameters.integer("n");
  const double column = static_cast<double>(source.bounds().size().x) / static_cast<double>(n);
  const auto surface = build(source, at, n, at.parameters.number("radius") * column, 0, progress);
  if (times(at)) {
    measure_surface(at, source, *surface, recorder, progress);
  } else {
    measure_values(at, *surface, options.seed, recorder, progress);
  }
}

}  // namespace

extern const Experiment kImplicit{"hybrid.implicit",
                                  "§3.1.2: the implicit surface's field and polygons",
                                  kSpecs,
                                  cases,
                                  measure,
                                  Experiment::kTimed,
                                  times};

}  // namespace terrabench::hybrid
