// Checks the text of mesh files before OpenMesh's readers see it: those trust counts and indices, so that a
// damaged file could make them allocate without bound or stop the program.
#pragma once

#include <string>
#include <string_view>

namespace terrabench {

struct ScannedMesh {
  std::size_t vertices = 0, faces = 0, corners = 0;
  bool has_texture = false;
  std::string text;  // of an OBJ file: its vertices, texture coordinates and faces alone
};

// Throw bad_input with `origin` and the line or element. Positions are finite, faces have 3 corners or more,
// OBJ indices are in range (PLY indices are not looked at), and nothing is missing at the end. O(bytes).
ScannedMesh scan_ply(std::string_view bytes, const std::string& origin);
ScannedMesh scan_obj(std::string_view bytes, const std::string& origin);

}  // namespace terrabench
