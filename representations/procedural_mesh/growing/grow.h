// Growing steps of a mesh-based PL-system (Tobler, Maierhofer and Wilkie, §4 and §5; rules.h says what a rule
// is). In one step, every face whose symbol has a rule is replaced at once. A vertex shared by the expansions
// of several faces gets the average of the texture coordinates that they give it (§5, figure 9).
//
// Every growing face keeps its frame, from local to world coordinates, so that tropism and gravity can act,
// and a path: a hash of the faces from which it came. Random numbers are hashed from seed, path and step;
// results do not depend on the order of faces or on threads.
#pragma once

#include "representations/procedural_mesh/face_mesh.h"
#include "representations/procedural_mesh/growing/frame.h"
#include "representations/procedural_mesh/growing/rules.h"

namespace terrabench::growing {

struct FaceState {
  FaceShape shape;
  std::uint64_t path = 0;
  std::uint32_t first_parameter = 0;  // in GrownMesh::parameters
};

struct GrownMesh {
  FaceMesh mesh;                  // with symbols and texture coordinates
  std::vector<FaceState> states;  // of the faces whose symbols grow, in the order of the faces
  std::vector<double> parameters;
  std::uint32_t steps = 0;  // growing steps so far
};

struct Limits {
  std::size_t faces = 10'000'000;  // of any mesh on the way
  std::uint32_t steps = 10'000;    // growing steps in total

  // Most corners, vertices, creases, and parameters of growing faces; the faces that a step replaces, and as
  // many again before they are dropped, come on top. All indices fit 32 bits for 100 million faces.
  std::size_t elements() const { return 8 * faces + 65536; }
  // Most faces that one call of grow() makes, those that it replaces again included: bounds its time.
  std::size_t made() const { return 100 * faces + 1'000'000; }
};

// A mesh whose faces have not grown yet and have areas. `mesh.symbols` is per face; arguments[f] are those of
// its symbol.
GrownMesh plant(const RuleSystem&, FaceMesh mesh, const std::vector<std::vector<double>>& arguments);

struct GrowOptions {
  std::uint32_t steps = 1;  // at most; growing ends where no face has a rule that applies
  bool to_the_end = false;  // until nothing grows; then more than Limits::steps is an error
  std::vector<bool> only;   // per symbol, whether it may grow; empty: all
  Limits limits;
};

// Returns the number of faces that were replaced. Throws bad_input, with the rule's place, where a parameter
// is not a finite number, a new face would be degenerate, a template does not fit its face, or a limit is
// exceeded; the mesh is then unusable. O(new faces + old faces). In parallel.
std::size_t grow(const RuleSystem&, GrownMesh&, const GrowOptions&);

}  // namespace terrabench::growing
