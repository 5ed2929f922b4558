// A height field as a subdivision surface ("meshgrow" §3): a coarse plane whose vertices move "into the same
// global direction", by as much as a texture of heights says. Each level of subdivision puts new vertices
// halfway between the old ones and lifts them to the texture's height there; the last level has one vertex
// per texel, at the texel's height to the bit.
#pragma once

#include <vector>

#include "representations/procedural_mesh/face_mesh.h"
#include "terrain/progress.h"

namespace terrabench {

// Heights at the crossings of lines, row-major, rows along x; NaN for none. Lines in metres, never
// descending.
struct HeightTexture {
  std::vector<float> x, z;
  std::vector<float> heights;
};

// Of the subdivisions asked for, those that the texture has texels for: 2^n is at most its shorter side's
// cells.
int usable_levels(const HeightTexture&, int levels);

// The plane after all but the last `leave_out` of these subdivisions: quadrilaterals that look up, without
// those that touch a texel without height. The last cells along x and z are narrower where the texels are no
// multiple of 2^levels. Texture coordinates run from 0 to 1. A texture of one row or column has no area: no
// faces. Throws bad_input for heights so far apart that they cannot be interpolated. O(texels) on all
// threads, at most four times as many while subdividing.
FaceMesh displaced_plane(const HeightTexture&, int levels, int leave_out);

}  // namespace terrabench
