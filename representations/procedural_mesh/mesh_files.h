// Polygon meshes as PLY (binary) and OBJ files, by OpenMesh: positions, faces of any number of corners, and
// texture coordinates per vertex. Symbols and creases are not kept.
#pragma once

#include <filesystem>

#include "representations/procedural_mesh/face_mesh.h"

namespace terrabench {

// The format by the name's extension: .ply or .obj, in any case; another one throws usage_error. Written to a
// temporary name and renamed. Throws environment_error when the file cannot be written. Floats are written so
// that reading gives the same ones. O(corners).
void write_mesh(const std::filesystem::path&, const FaceMesh&);

// For files that write_mesh() wrote: throws bad_input where OpenMesh finds a fault or a corner has no vertex,
// but what OpenMesh makes of a damaged file is its own affair. O(corners).
FaceMesh read_mesh(const std::filesystem::path&);

}  // namespace terrabench
