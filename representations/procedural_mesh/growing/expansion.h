// One rule applied to one face: where its template's vertices lie and which symbols its faces carry.
#pragma once

#include "representations/procedural_mesh/growing/grow.h"

namespace terrabench::growing {

// How much a rule adds to a face with n corners.
struct Counts {
  std::size_t vertices = 0, faces = 0, corners = 0, creases = 0;
};
Counts counts_of(const Template&, std::uint32_t n);

// Why a face could not be expanded. `place`: of the expression or the rule at fault.
struct Failure {
  enum Kind : std::uint8_t { kNone, kNotFinite, kCorners, kDegenerate, kNegative } kind = kNone;
  Place place;
};

// Values of a rule's expressions for one face. Allocates nothing.
class FaceValues {
 public:
  FaceValues(const RuleSystem&, const GrownMesh&, std::uint32_t face, const FaceState&);

  // 0 after a failure, which is kept.
  double operator()(const Expression&);
  double optional(const Expression&, double otherwise);
  void set(std::uint32_t slot, double value) { slots_[slot] = value; }
  void salt(std::uint64_t number) { values_.random = combine_key(number); }
  const Failure& failure() const { return failure_; }
  void fail(Failure::Kind kind, Place place) {
    if (failure_.kind == Failure::kNone) failure_ = {kind, place};
  }

 private:
  std::uint64_t combine_key(std::uint64_t number) const;
  double slots_[kMostSlots];
  Values values_;
  std::uint64_t key_;
  Failure failure_;
};

// Where the new elements go; all arrays have room.
struct Slots {
  std::uint32_t vertex = 0, face = 0, corner = 0, crease = 0;
};

// New faces of a group of expansions: from `first_face` on, `stride` arguments per face.
struct NewArguments {
  std::uint32_t first_face = 0, stride = 0;
  std::vector<double> values;
};

// Texture coordinates for the base's corners, to be averaged.
struct CornerTexture {
  std::uint32_t vertex;
  glm::dvec2 at;
};

struct Expansion {
  const RuleSystem& system;
  GrownMesh& grown;
  std::uint32_t face = 0;
  const FaceState& state;
  const Rule& rule;
  Slots to;
  std::uint32_t end_face = 0;  // to.face plus the number of faces; first_corner[to.face] is written already
  NewArguments& arguments;
  CornerTexture* base_texture = nullptr;  // room for one per corner; vertex kNoVertex: not given
};
inline constexpr std::uint32_t kNoVertex = 0xFFFFFFFFU;

// Writes vertices, faces, symbols and arguments to their slots. The result's kind is kNone if all is well.
Failure expand(const Expansion&);

}  // namespace terrabench::growing
