// One rule applied to one face: where its template's vertices lie and which symbols its faces carry.
#pragma once

#include "representations/procedural_mesh/growing/grow.h"

namespace terrabench::growing {

// Of a mesh, or of what a rule adds to it.
struct Sizes {
  std::size_t vertices = 0, faces = 0, corners = 0, creases = 0;
};
Sizes added_by(const Template&, std::uint32_t corners_of_its_face);

// Why a face could not be replaced. `place`: of the expression or the rule at fault.
struct Failure {
  enum Kind : std::uint8_t { kNone, kNotFinite, kCorners, kDegenerate, kNegative } kind = kNone;
  Place place;
};

// Values of a rule's expressions for one face. Allocates nothing.
class FaceValues {
 public:
  FaceValues(const RuleSystem&, const GrownMesh&, std::uint32_t face, const FaceState&);

  // 0 after a failure, of which the first is kept.
  double operator()(const Expression&);
  double optional(const Expression& e, double otherwise) { return e.given() ? (*this)(e) : otherwise; }
  void set(std::size_t slot, double value) { slots_[slot] = value; }
  // Another series of random numbers, for each face that the rule makes.
  void salt(std::uint64_t number);
  const Failure& failure() const { return failure_; }
  void fail(Failure::Kind kind, Place place) {
    if (failure_.kind == Failure::kNone) failure_ = {kind, place};
  }

 private:
  double slots_[kMostSlots];
  Values values_;
  std::uint64_t key_;
  Failure failure_;
};

// What is known of the new faces of a group besides what the mesh holds.
struct NewFaces {
  std::size_t first = 0, stride = 0;  // the number of the first face; arguments per face
  std::vector<double> arguments;
  std::vector<FaceShape> shapes;
  double* arguments_of(std::size_t face) { return arguments.data() + (face - first) * stride; }
};

inline constexpr std::uint32_t kNoVertex = 0xFFFFFFFFU;
// Texture coordinates for a corner of the replaced face, to be averaged; kNoVertex: none.
struct CornerTexture {
  std::uint32_t vertex = kNoVertex;
  glm::dvec2 at{0};
};

struct Replacement {
  const RuleSystem& system;
  GrownMesh& grown;
  std::uint32_t face;
  const FaceState& state;
  const Rule& rule;
  Sizes to;              // where the new elements go; all arrays have room
  std::size_t end_face;  // to.faces plus the number of faces; first_corner[to.faces] is written already
  NewFaces& made;
  CornerTexture* base_texture;  // room for one per corner
};

// Writes vertices, faces, symbols, arguments and shapes to their places. The result's kind is kNone if all is
// well. Replacements that write to different places may run at the same time.
Failure apply_rule(const Replacement&);

}  // namespace terrabench::growing
