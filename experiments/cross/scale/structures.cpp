// Structures of cross.scale: each cost against the size of height maps, or of the lattice of a solid. The
// theory is that of the registry (GrowthTheory).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

#include "experiments/cross/files/temporary_folder.h"
#include "experiments/cross/scale/run.h"
#include "experiments/cross/workloads.h"
#include "experiments/ground.h"
#include "representations/edit_tools.h"
#include "representations/line_grid.h"
#include "representations/ray_cast.h"
#include "representations/representation.h"

namespace terrabench::cross {
namespace {

// What sizes are planned by where a method states no theory: a flat array of columns, or of voxels.
GrowthTheory assumed(bool solid) {
  return solid ? GrowthTheory{.build = 1.5, .bytes = 1.5, .mesh = 1.5} : GrowthTheory{};
}

constexpr int kNear = 32;         // columns along a side of the window of near queries, which caches hold
constexpr int kEditRadius = 8;    // columns
constexpr int kEdits = 16;        // half of them make one sample, half the other
constexpr float kHighest = 1600;  // metres, of the hills

// Hills from 0 to kHighest metres exactly, so that no size has more levels than another: two corners are the
// lowest and the highest sample.
TerrainSource hills_of_one_range(int side, std::uint64_t seed) {
  TerrainSource source;
  source.name = "noise-hills";
  source.heights = noise_hills(side, seed);
  for (float& h : source.heights->heights) h = std::clamp(h, 0.0F, kHighest);
  source.heights->heights.front() = 0;
  source.heights->heights.back() = kHighest;
  return source;
}

// Rays from a plane above the highest point, 45° down.
double seconds_per_ray(const RayCaster& caster, const Bounds& bounds, Places places, Numbers& numbers) {
  const float above = bounds.high.y + 0.01F * bounds.size().y, slope = std::numbers::sqrt2_v<float> / 2;
  std::vector<float> x(kBatch), z(kBatch), distances(kBatch);
  std::vector<Ray> rays(kBatch);
  const auto next = [&] {
    places.columns(x, z);
    for (int i = 0; i < kBatch; ++i) {
      const float azimuth = numbers.between(0, 2 * std::numbers::pi_v<float>);
      rays[i].origin = {x[i], above, z[i]};
      rays[i].direction = {slope * std::cos(azimuth), -slope, slope * std::sin(azimuth)};
    }
  };
  return seconds_per_item(next, [&] { caster.closest(rays, distances); });
}

bool takes_edits(const RepresentationType& type) { return type.traits.editable || type.traits.events; }

// Of the column; nothing where it is empty.
std::optional<float> highest_solid(const Representation& structure, const float& x, const float& z) {
  SpanSink sink;
  structure.spans({{&x, 1}, {&z, 1}}, sink);
  const auto column = sink.column(0);
  return column.empty() ? std::nullopt : std::optional(column.back().top);
}

// Reads the square of columns around (x, z) that a hole there can change.
void read_columns(const Representation& structure, float x, float z, float cell) {
  std::vector<float> xs, zs;
  for (int i = -kEditRadius; i <= kEditRadius; ++i) {
    for (int k = -kEditRadius; k <= kEditRadius; ++k) {
      xs.push_back(x + cell * static_cast<float>(k));
      zs.push_back(z + cell * static_cast<float>(i));
    }
  }
  SpanSink sink;
  structure.spans({xs, zs}, sink);
}

// Whether all the holes of a size fit into half of a ground that is as high as it is wide. On less the later
// ones would find the ground dug away.
bool holes_fit(int side) {
  const double hole = 2 * std::numbers::pi / 3 * std::pow(kEditRadius, 3);
  return kSamples * kEdits * hole <= 0.5 * std::pow(side, 3);
}

// The holes that make one sample: those in columns just read, or the others.
struct Holes {
  double spent = 0;  // processor seconds
  int dug = 0, lower = 0;

  // Per hole. Nothing unless more than half of the times the ground is lower afterwards (where the floor lies
  // open there is nothing to dig): then it was not digging that took the time.
  std::optional<double> seconds() const {
    return 2 * lower > dug ? std::optional(spent / dug) : std::nullopt;
  }
};

// Digs half a sphere of kEditRadius columns out of the ground, kEdits times. A tree of heightmaps takes a
// radial erosion with the same radii, which also removes the ground above the sphere. Before every second
// hole all columns that it can change are read, so that caches hold them; before the others the caches are
// emptied, and then the middle column is read. Returns the other holes, then these.
std::pair<Holes, Holes> dig_holes(Representation& structure, float cell, Places places,
                                  const ColdCaches& caches) {
  std::vector<float> x(kEdits), z(kEdits);
  places.columns(x, z);
  const bool digs = structure.edited_lines().has_value();
  const float radius = cell * kEditRadius;
  std::pair<Holes, Holes> all;
  for (int i = 0; i < kEdits; ++i) {
    const bool cached = i % 2 == 1;
    if (!cached) caches.evict();
    const std::optional<float> top = highest_solid(structure, x[i], z[i]);
    if (!top) continue;
    if (cached) read_columns(structure, x[i], z[i], cell);
    Holes& holes = cached ? all.second : all.first;
    const glm::vec3 centre{x[i], *top, z[i]};
    holes.spent += processor_seconds([&] {
      if (digs) {
        fill_sphere(structure, {centre, radius}, Material::kAir);
      } else {
        structure.apply(events::RadialErosion{glm::dvec3(centre), glm::dvec3(radius)});
      }
    });
    ++holes.dug;
    holes.lower += highest_solid(structure, x[i], z[i]).value_or(-HUGE_VALF) < *top;
  }
  return all;
}

// What one structure costs at all sizes.
class Structure {
 public:
  Structure(const Run& run, bool solid, const RepresentationType& type)
      : run_(run),
        solid_(solid),
        type_(type),
        theory_(solid ? type.growth_in_solids : type.growth),
        planned_(theory_.value_or(assumed(solid))),
        building_(run.plan("build", 0.5, {planned_.build, planned_.bytes})),
        filing_(run.plan("file", 0.2, {planned_.bytes, planned_.bytes})),
        meshing_(run.plan("mesh", 0.3, {planned_.mesh, std::max(planned_.bytes, 1.0)})),
        build_("build", "s", theory_of(&GrowthTheory::build)),
        bytes_("bytes", "B", theory_of(&GrowthTheory::bytes)),
        file_("file", "B", theory_of(&GrowthTheory::bytes)),
        load_("load", "s", theory_of(&GrowthTheory::bytes)),
        query_("query", "s", theory_of(&GrowthTheory::query)),
        near_("query_near", "s", theory_of(&GrowthTheory::query)),
        ray_("ray", "s", theory_of(&GrowthTheory::ray)),
        ray_near_("ray_near", "s", theory_of(&GrowthTheory::ray)),
        mesh_("mesh", "s", theory_of(&GrowthTheory::mesh)),
        edit_("edit", "s", theory_of(&GrowthTheory::edit)),
        edit_cached_("edit_cached", "s", theory_of(&GrowthTheory::edit)),
        numbers_(run.seed()) {}

  void measure() {
    run_.at_each_side(fmt::format("{} over {}", type_.name, solid_ ? "a solid" : "heights"), solid_,
                      [this](int side) { measure(side); });
    for (const SizePlan* const plan : {&building_, &filing_, &meshing_}) plan->record(run_.recorder());
    for (const Cost* const cost : {&build_, &bytes_, &file_, &load_, &query_, &near_, &ray_, &ray_near_,
                                   &mesh_, &edit_, &edit_cached_}) {
      cost->record(run_.recorder());
    }
  }

 private:
  std::optional<double> theory_of(double GrowthTheory::*cost) const {
    return theory_ ? std::optional((*theory_).*cost) : std::nullopt;
  }

  void measure(int side) {
    const double columns = squared(side);
    std::unique_ptr<Representation> built;
    const bool exists = run_.measured(building_, columns, [&] {
      built = build(side);
      ask(*built, side);
    });
    if (!exists) return;
    run_.measured(filing_, columns, [&] { write_and_read(*built, columns); });
    run_.measured(meshing_, columns, [&] {
      TriangleMesh drawn;
      run_.add_samples(
          mesh_, columns, [&] { drawn = {}; }, [&] { drawn = built->mesh({}); });
    });
    if (takes_edits(type_)) dig(*built, side);
  }

  // Away from the borders, which events must not reach.
  void dig(Representation& built, int side) {
    if (!holes_fit(side)) return;
    const double share = 1 - 2.0 * (kEditRadius + 2) / side;
    const float cell = built.bounds().size().x / static_cast<float>(solid_ ? side : side - 1);
    for (int k = 0; k < kSamples; ++k) {
      const auto [anywhere, cached] = dig_holes(built, cell, places(built, share), run_.caches());
      if (const auto taken = anywhere.seconds()) edit_.add(squared(side), *taken);
      if (const auto taken = cached.seconds()) edit_cached_.add(squared(side), *taken);
    }
  }

  std::unique_ptr<Representation> build(int side) {
    const double columns = squared(side);
    const TerrainSource source =
        solid_ ? open_terrain("caves", run_.seed()) : hills_of_one_range(side, run_.seed());
    Parameters parameters(type_.parameters);
    if (solid_) parameters.set("resolution", std::int64_t{side});
    std::unique_ptr<Representation> built;
    Progress silent;  // a structure's own phases would end the case's
    run_.add_samples(
        build_, columns, [&] { built.reset(); }, [&] { built = type_.build(source, parameters, silent); });
    bytes_.add(columns, static_cast<double>(built->memory().total()));
    return built;
  }

  void ask(const Representation& built, int side) {
    const double columns = squared(side), near = std::min(1.0, static_cast<double>(kNear) / side);
    for (int k = 0; k < kSamples; ++k) {
      query_.add(columns, seconds_per_column(built, places(built, 1)));
      near_.add(columns, seconds_per_column(built, places(built, near)));
    }
    const std::unique_ptr<RayCaster> caster = built.ray_caster();
    if (!caster) return;
    for (int k = 0; k < kSamples; ++k) {
      ray_.add(columns, seconds_per_ray(*caster, built.bounds(), places(built, 1), numbers_));
      ray_near_.add(columns, seconds_per_ray(*caster, built.bounds(), places(built, near), numbers_));
    }
  }

  void write_and_read(const Representation& built, double columns) {
    const std::filesystem::path path = folder_.path() / "saved";
    file_.add(columns, static_cast<double>(save_representation(path, type_, built)));
    std::unique_ptr<Representation> loaded;
    run_.add_samples(
        load_, columns, [&] { loaded.reset(); }, [&] { loaded = load_representation(path).representation; });
  }

  Places places(const Representation& built, double share) { return {built.bounds(), share, numbers_}; }

  const Run& run_;
  bool solid_;
  const RepresentationType& type_;
  std::optional<GrowthTheory> theory_;
  GrowthTheory planned_;
  SizePlan building_, filing_, meshing_;
  Cost build_, bytes_, file_, load_, query_, near_, ray_, ray_near_, mesh_, edit_, edit_cached_;
  TemporaryFolder folder_;
  Numbers numbers_;
};

}  // namespace

void measure_structure(const Run& run, bool solid, std::string_view name) {
  const std::vector<std::string_view> known = scaled_structures(solid);
  if (std::ranges::count(known, name) == 0)
    throw unknown_name(solid ? "structure for solids" : "structure", name, known);
  Structure(run, solid, representation(name)).measure();
}

std::vector<std::string_view> scaled_structures(bool solid) {
  std::vector<std::string_view> names;
  for (const RepresentationType& type : representations()) {
    if (!solid || (type.traits.overhangs && !type.traits.lossless)) names.push_back(type.name);
  }
  return names;
}

}  // namespace terrabench::cross
