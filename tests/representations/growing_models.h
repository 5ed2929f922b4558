// Small models for the tests of mesh growing.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "representations/procedural_mesh/mesh_checks.h"
#include "representations/procedural_mesh/model.h"
#include "terrain/error.h"

namespace terrabench::growing {

// Expands a text and returns what it throws; empty: nothing.
inline std::string error_of(const std::string& text) {
  try {
    expand(parse_model(text, "m"));
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

inline GrownMesh grown(const std::string& text) { return expand(parse_model(text, "m")); }

inline std::string faults(const FaceMesh& mesh, bool closed = true) {
  const MeshReport report = check_mesh(mesh, {.boundary_meant = !closed});
  return report.faults() == 0 ? "" : report.first.at(0);
}

inline const std::string kCubeBase = "[base]\nshape = \"cube\"\ntop = \"a\"\n";
inline const std::string kSymbols = "[symbols]\na = []\nb = [\"p\"]\n";

}  // namespace terrabench::growing
