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

std::span<const RepresentationType> representations() {
  static const RepresentationType kTypes[] = {
      {"heightmap",
       "heightmap",
       "one height per grid point, bilinear",
       "hybrid §2.1",
       {.lossless = true},
       column_parameters(),
       Heightmap::build,
       Heightmap::load},
      {"layered_stack",
       "layered stack",
       "a stack of material runs per column, in flat tiles",
       "hybrid §3.1.1",
       {.overhangs = true, .materials = true, .editable = true},
       column_parameters(),
       LayeredStack::build,
       LayeredStack::load},
      {"voxel",
       "OpenVDB voxels",
       "sparse voxels: one OpenVDB mask tree per material",
       "peer of hybrid Table 1",
       {.overhangs = true, .materials = true, .editable = true},
       column_parameters(),
       Voxel::build,
       Voxel::load},
      {"dense_voxel",
       "dense voxels",
       "one byte per voxel",
       "hybrid Table 1",
       {.overhangs = true, .materials = true, .editable = true},
       column_parameters(),
       DenseGrid::build,
       DenseGrid::load},
      {"implicit",
       "implicit surface",
       "stacks smoothed by a kernel, as the zero set of a field",
       "hybrid §3.1.2",
       {.overhangs = true, .editable = true},
       ImplicitSurface::parameters(),
       ImplicitSurface::build,
       ImplicitSurface::load},
      {"drill",
       "drills",
       "channels drilled into a plateau",
       "drill §2",
       {},
       DrillTerrain::parameters(),
       DrillTerrain::build,
       DrillTerrain::load},
      {"ght",
       "grounded heightmap tree",
       "a tree of heightmaps, each on its own plane",
       "ght §3",
       {.overhangs = true, .lossless = true, .events = true},
       Ght::parameters(),
       Ght::build,
       Ght::load},
      {"tin",
       "TIN",
       "triangles between the samples that greedy insertion picks",
       "Garland & Heckbert 1995",
       {},
       Tin::parameters(),
       Tin::build,
       Tin::load},
      {"procedural_mesh",
       "subdivision surface",
       "a subdivision surface displaced by heights, or a model that grows by rules",
       "meshgrow §3–5",
       {.overhangs = true, .lossless = true},
       ProceduralMesh::parameters(),
       ProceduralMesh::build,
       ProceduralMesh::load},
  };
  return kTypes;
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
