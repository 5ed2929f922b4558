// Mesh-based parametric L-systems (Tobler, Maierhofer and Wilkie, §4 and §5): each face of a mesh carries a
// symbol with parameters, and a rule replaces such a face by a template mesh whose faces carry symbols again.
//
// A template is a complete mesh. Its first face, the base, is laid on the face that the rule expands: corner
// i on corner i, the frames of both faces aligned. Both faces vanish. The base is therefore listed in the
// order of the expanded face: counter-clockwise seen from outside the growing mesh, that is from inside the
// template.
//
// Frame of a face: origin at the mean of its corners, z along its normal, x along its edge from corner 0 to
// corner 1 (made perpendicular to z), y = z × x. Axes have unit length: templates are in metres.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "representations/procedural_mesh/face_mesh.h"
#include "representations/procedural_mesh/growing/expression.h"

namespace terrabench::subdivision {
struct Topology;
}

namespace terrabench::growing {

inline constexpr std::uint32_t kNoSymbol = 0;

struct Symbol {
  std::string name;
  std::vector<std::string> parameters;
  std::uint32_t first_rule = 0, rules = 0;  // in RuleSystem::rules
  bool grows() const { return rules > 0; }
};

// A symbol with arguments, chosen by conditions: the first whose condition is not 0. The last has none.
struct SymbolChoice {
  struct Option {
    Expression condition;
    std::uint32_t symbol = kNoSymbol;
    std::vector<Expression> arguments;
  };
  std::vector<Option> options;
};

// Texture coordinates of a vertex; not given: they are left as they are, or (0, 0).
struct TextureAt {
  Expression u, v;
  bool given() const { return u.given(); }
};

// A cross-section of an extruded template: one vertex per corner of the base. The frame of the section before
// is turned about its y axis, then x, then z (turn[1], turn[0], turn[2]), then towards the world's up
// (`tropism`), then moved along its axes; the section lies in its x,y plane.
struct Section {
  std::array<Expression, 3> turn, move;  // degrees, metres
  Expression tropism;  // degrees by which z turns to the world's up at most; negative: to the ground
  Expression scale;    // of the section before; not given: 1
  Expression radius;   // makes the section a regular polygon instead
  std::array<Expression, 2> stretch;  // of this section alone along x and y, per corner; not given: 1
  std::vector<TextureAt> texture;     // none, or one per corner
  std::vector<SymbolChoice> sides;    // of the faces below the section: one for all, or one per corner
  int crease = 0;                     // sharpness of the section's edges
};

// A vertex beyond the base: a weighted sum of the base's corners plus an offset in the base's frame.
struct TemplateVertex {
  std::vector<Expression> weights;  // one per corner, or empty: the origin of the frame
  std::array<Expression, 3> offset;
};

struct Template {
  std::uint32_t corners = 0;  // of the base; 0: any, for extruded templates
  // Either sections and a cap,
  std::vector<Section> sections;
  SymbolChoice cap;
  // or a mesh: faces and creases among vertices, of which 0 … corners - 1 are those of the base.
  std::vector<TemplateVertex> vertices;
  FaceMesh mesh;
  std::vector<SymbolChoice> symbols;  // of its faces
  // Of the vertices, the base's first: none, or one per vertex; for sections, of the base alone.
  std::vector<TextureAt> texture;
  bool extruded() const { return !sections.empty(); }
};

struct Rule {
  std::uint32_t symbol = kNoSymbol;
  Expression when, probability;    // not given: always, 1
  std::vector<Expression> locals;  // stored in slots first_local, first_local + 1, …
  std::uint32_t first_local = 0;
  Template replacement;
  Place place;
};

// Slots that every rule's expressions share, in this order. All lengths are metres.
inline constexpr std::string_view kSharedNames[] = {
    "px",     // origin of the face's frame
    "py",     //
    "pz",     //
    "up_x",   // the world's up in the face's frame; up_z: how far the face looks upwards
    "up_y",   //
    "up_z",   //
    "size",   // mean distance of two opposite corners, the paper's local scale factor (§3)
    "area",   // of the face
    "sides",  // corners of the face
    "side",   // while the symbol of a side face is made: its number, from 0
    "step",   // growing steps before this one
};
enum SharedSlot : std::uint8_t {
  kPx,
  kPy,
  kPz,
  kUpX,
  kUpY,
  kUpZ,
  kSize,
  kArea,
  kSides,
  kSide,
  kStep,
  kShared
};
inline constexpr std::size_t kMostSlots = 128;

struct RuleSystem {
  std::string file;             // for messages
  std::vector<Symbol> symbols;  // symbol 0 is "none"
  std::vector<Rule> rules;      // those of a symbol lie together
  std::vector<double> tables;   // constants that expressions index
  std::uint64_t seed = 0;
};

// Whether the meshes that a model writes down are well formed (§4): then growing adds no T-vertex, no hole
// and no non-manifold edge (well_formed.cpp).
//
// Throws bad_input at `where` if a face has fewer than 3 corners, one of them twice, no area, or a vertex
// that does not exist; if an edge has more than two faces, or two in the same direction; if a vertex joins
// two fans of faces, or has no face. O(corners log valence).
subdivision::Topology check_base(const FaceMesh&, const std::string& where);

// The same, but for areas, of a template that is a mesh, together with its base: every edge of the base is
// used once, in its direction; every other edge by two faces, and it does not join two corners of the base.
subdivision::Topology check_template(const Template&, const std::string& where);

}  // namespace terrabench::growing
