#include <fmt/format.h>

#include "representations/column_grid.h"
#include "representations/drill/drill_terrain.h"
#include "representations/ght/ght.h"
#include "representations/heightmap/heightmap.h"
#include "representations/implicit/implicit_surface.h"
#include "representations/layered_stack/layered_stack.h"
#include "representations/procedural_mesh/procedural_mesh.h"
#include "representations/representation.h"
#include "representations/tin/tin.h"
#include "representations/voxel/dense_grid.h"
#include "representations/voxel/voxel.h"
#include "terrain/error.h"

namespace terrabench {
namespace {

constexpr GrowthTheory kPerColumn{};
// A solid with n columns has n^1.5 voxels and n^0.5 levels per column; a ray crosses n^0.5 columns. Building
// samples every voxel. A query reads the runs of a stack's column alone, but voxels level by level.
constexpr double kVoxels = 1.5, kLevels = 0.5;
constexpr GrowthTheory kStacks{.build = kVoxels, .ray = kLevels};
constexpr GrowthTheory kLevelByLevel{.build = kVoxels, .query = kLevels, .mesh = kVoxels, .ray = kLevels};
constexpr GrowthTheory kAllVoxels{
    .build = kVoxels, .bytes = kVoxels, .query = kLevels, .mesh = kVoxels, .ray = kLevels};

// What a search for the best files varies.
constexpr FileKnob kStep{"step", 0x1p-11, 0x1p-4, FileKnob::kRelief, 0.5};
constexpr FileKnob kStepOfSolids{"step", 0x1p-11, 0x1p-4, FileKnob::kRelief, 0.5, true};
constexpr FileKnob kStepKnob[] = {kStep}, kHeightKnobs[] = {kStepOfSolids};
constexpr FileKnob kImplicitKnobs[] = {kStep, {"kernel"}, {"radius", 0.75, 4, FileKnob::kColumn}};
constexpr FileKnob kDrillKnobs[] = {{"tau", 0x1p-15, 0x1p-8, FileKnob::kSamples},
                                    {"w", 3, 24},
                                    {"k", 4, 40},
                                    {"fit"},
                                    {"monotone_profiles"},
                                    {"adaptive_k"},
                                    {"interpolate_untouched"},
                                    {"quantum", 0x1p-12, 0x1p-4, FileKnob::kRelief, 0.5},
                                    kStepOfSolids};
constexpr FileKnob kTinKnobs[] = {{"max_error", 0x1p-12, 0x1p-3, FileKnob::kRelief}, kStepOfSolids};

std::vector<RepresentationType>& table() {
  static std::vector<RepresentationType> types = {
      {"heightmap",
       "heightmap",
       "one height per grid point, bilinear",
       "hybrid §2.1",
       {.lossless = true, .editable = true, .rays = true},
       column_parameters(),
       Heightmap::build,
       Heightmap::load,
       Heightmap::decode,
       kPerColumn,
       {},
       kHeightKnobs},
      {"layered_stack",
       "layered stack",
       "a stack of material runs per column, in flat tiles",
       "hybrid §3.1.1",
       {.overhangs = true, .materials = true, .editable = true, .erodes = true, .rays = true},
       column_parameters(),
       LayeredStack::build,
       LayeredStack::load,
       LayeredStack::decode,
       kPerColumn,
       kStacks,
       kStepKnob},
      {"voxel",
       "OpenVDB voxels",
       "sparse voxels: one OpenVDB mask tree per material",
       "peer of hybrid Table 1",
       {.overhangs = true, .materials = true, .editable = true, .rays = true},
       column_parameters(),
       Voxel::build,
       Voxel::load,
       Voxel::decode,
       kPerColumn,
       kLevelByLevel,
       kStepKnob},
      {"dense_voxel",
       "dense voxels",
       "one byte per voxel",
       "hybrid Table 1",
       {.overhangs = true, .materials = true, .editable = true, .rays = true},
       column_parameters(),
       DenseGrid::build,
       DenseGrid::load,
       DenseGrid::decode,
       kPerColumn,
       kAllVoxels,
       kStepKnob},
      {"implicit",
       "implicit surface",
       "stacks smoothed by a kernel, as the zero set of a field",
       "hybrid §3.1.2",
       {.overhangs = true, .editable = true, .erodes = true, .rays = true},
       ImplicitSurface::parameters(),
       ImplicitSurface::build,
       ImplicitSurface::load,
       ImplicitSurface::decode,
       kPerColumn,
       kLevelByLevel,
       kImplicitKnobs},
      {"drill",
       "drills",
       "channels drilled into a plateau",
       "drill §2",
       {.rays = true},
       DrillTerrain::parameters(),
       DrillTerrain::build,
       DrillTerrain::load,
       DrillTerrain::decode,
       kPerColumn,
       {},
       kDrillKnobs},
      {"ght",
       "grounded heightmap tree",
       "a tree of heightmaps, each on its own plane",
       "ght §3",
       {.overhangs = true, .lossless = true, .events = true, .rays = true},
       Ght::parameters(),
       Ght::build,
       Ght::load,
       Ght::decode,
       kPerColumn,
       {},
       kHeightKnobs},
      {"tin",
       "TIN",
       "a triangulated irregular network by greedy insertion",
       "Garland & Heckbert 1995; ght §2.2",
       {.editable = true},
       Tin::parameters(),
       Tin::build,
       Tin::load,
       Tin::decode,
       {},
       {},
       kTinKnobs},
      {"procedural_mesh",
       "subdivision surface",
       "a subdivision surface displaced by heights, or a model that grows by rules",
       "meshgrow §3–5",
       {.overhangs = true, .lossless = true},
       ProceduralMesh::parameters(),
       ProceduralMesh::build,
       ProceduralMesh::load,
       ProceduralMesh::decode,
       kPerColumn,
       {},
       kHeightKnobs},
  };
  return types;
}

}  // namespace

std::span<const RepresentationType> representations() { return table(); }

void add_representation(const RepresentationType& type) {
  for (const RepresentationType& known : representations()) {
    if (known.name == type.name)
      throw usage_error("this name is taken", type.name, "choose another name for the representation");
  }
  const Parameters parameters(type.parameters);
  for (const FileKnob& knob : type.file_knobs) {
    if (!parameters.has(knob.parameter)) {
      throw usage_error(
          fmt::format("a file knob names the parameter '{}', which the type lacks", knob.parameter),
          type.name, "name one of its parameters");
    }
  }
  table().push_back(type);
}

const RepresentationType& representation(std::string_view name) {
  std::vector<std::string_view> known;
  for (const RepresentationType& type : representations()) {
    if (type.name == name) return type;
    known.push_back(type.name);
  }
  throw unknown_name("representation", name, known);
}

}  // namespace terrabench
