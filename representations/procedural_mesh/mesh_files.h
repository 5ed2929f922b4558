// Polygon meshes as PLY (ASCII and binary) and OBJ files, by OpenMesh: positions, faces of any number of
// corners, and texture coordinates per vertex. Symbols and creases are not kept.
#pragma once

#include <cstdint>
#include <filesystem>

#include "representations/procedural_mesh/face_mesh.h"

namespace terrabench {

enum class PlyForm : std::uint8_t { kBinary, kAscii };

// The format by the name's extension: .ply or .obj, in any case; another one throws usage_error. Written to a
// temporary name and renamed. Throws bad_input for a mesh whose arrays do not fit each other,
// environment_error when the file cannot be written. Floats are written so that reading gives the same ones.
// O(corners).
void write_mesh(const std::filesystem::path&, const FaceMesh&, PlyForm = PlyForm::kBinary);

// Throws bad_input, with the place, for anything that is not such a file: an unknown header, a file that ends
// early, an index out of range, a number that is not finite, a face of fewer than 3 corners or with a vertex
// twice, a vertex of an OBJ file with several texture coordinates. Files over `limit` bytes are refused;
// memory is in proportion to the file's bytes. Faces may share edges in any way: see check_mesh(). O(bytes).
FaceMesh read_mesh(const std::filesystem::path&, std::uint64_t limit = std::uint64_t{1} << 32);

}  // namespace terrabench
