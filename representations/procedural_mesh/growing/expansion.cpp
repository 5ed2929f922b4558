#include "representations/procedural_mesh/growing/expansion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "terrain/splitmix.h"

namespace terrabench::growing {
namespace {

constexpr glm::dvec3 kUp{0, 1, 0};

class Expander {
 public:
  explicit Expander(const Expansion& e)
      : e_(e),
        mesh_(e.grown.mesh),
        value_(e.system, e.grown, e.face, e.state),
        base_(mesh_.corners.data() + mesh_.first_corner[e.face]),
        n_(mesh_.first_corner[e.face + 1] - mesh_.first_corner[e.face]),
        to_(e.to) {}

  Failure run() {
    const Rule& rule = e_.rule;
    for (std::size_t i = 0; i < rule.locals.size(); ++i) {
      value_.set(rule.first_local + static_cast<std::uint32_t>(i), value_(rule.locals[i]));
    }
    if (rule.replacement.corners != 0 && rule.replacement.corners != n_) {
      value_.fail(Failure::kCorners, rule.place);
    } else if (rule.replacement.extruded()) {
      extrude();
    } else {
      place_mesh();
    }
    return value_.failure();
  }

 private:
  glm::dvec3 three(const std::array<Expression, 3>& e) {
    return {value_.optional(e[0], 0), value_.optional(e[1], 0), value_.optional(e[2], 0)};
  }

  glm::vec2 texture(const TextureAt& at) {
    const double u = value_(at.u), v = value_(at.v);
    return {static_cast<float>(u), static_cast<float>(v)};
  }

  void base_texture(const std::vector<TextureAt>& given) {
    for (std::uint32_t i = 0; i < n_; ++i) {
      e_.base_texture[i].vertex = kNoVertex;
      if (given.empty()) continue;
      value_.set(kSide, i);
      const TextureAt& at = given.size() == 1 ? given[0] : given[i];
      if (!at.given()) continue;
      e_.base_texture[i] = {base_[i], {value_(at.u), value_(at.v)}};
    }
  }

  void symbol(const SymbolChoice& choice) {
    const std::uint32_t face = to_.face;
    for (const SymbolChoice::Option& option : choice.options) {
      if (option.condition.given() && value_(option.condition) == 0) continue;
      mesh_.symbols[face] = option.symbol;
      double* const arguments =
          e_.arguments.values.data() +
          static_cast<std::size_t>(face - e_.arguments.first_face) * e_.arguments.stride;
      for (std::size_t a = 0; a < option.arguments.size(); ++a) arguments[a] = value_(option.arguments[a]);
      return;
    }
    mesh_.symbols[face] = kNoSymbol;
  }

  void corner(std::uint32_t vertex) { mesh_.corners[to_.corner++] = vertex; }
  // The first corner of the next expansion's faces is not ours to write: another thread may read it.
  void end_face() {
    if (++to_.face < e_.end_face) mesh_.first_corner[to_.face] = to_.corner;
  }

  // Of corner i, in the section's plane, before scaling.
  glm::dvec2 outline(std::uint32_t i, bool regular) const {
    if (!regular) {
      const glm::dvec3 p = e_.state.shape.frame.to_local(glm::dvec3(mesh_.positions[base_[i]]));
      return {p.x, p.y};
    }
    // Edge 0 along x, as the frame of the base has it.
    const double turns = (static_cast<double>(i) - 0.5) / n_ - 0.25;
    const double angle = 2 * std::numbers::pi * turns;
    return {std::cos(angle), std::sin(angle)};
  }

  void extrude() {
    const Template& t = e_.rule.replacement;
    base_texture(t.base_texture);
    value_.set(kSide, 0);
    Frame frame = e_.state.shape.frame;
    bool regular = false;
    double scale = 1;
    std::uint32_t below = kNoVertex;  // first vertex of the section below; the base's has none
    for (std::size_t s = 0; s < t.sections.size(); ++s) {
      const Section& section = t.sections[s];
      turn(frame, three(section.turn));
      turn_towards(frame, kUp, value_.optional(section.tropism, 0));
      frame.origin = frame.to_world(three(section.move));
      if (section.radius.given()) {
        regular = true;
        scale = value_(section.radius);
      }
      scale *= value_.optional(section.scale, 1);
      const std::uint32_t first = to_.vertex;
      ring(section, frame, regular, scale, below);
      sides(section, s, first, below);
      for (std::uint32_t i = 0; section.crease > 0 && i < n_; ++i) {
        mesh_.creases[to_.crease++] = {first + i, first + (i + 1) % n_, section.crease};
      }
      below = first;
    }
    value_.set(kSide, 0);
    value_.salt(t.sections.size() * (1ULL << 32));
    symbol(t.cap);
    for (std::uint32_t i = 0; i < n_; ++i) corner(below + i);
    end_face();
  }

  void ring(const Section& section, const Frame& frame, bool regular, double scale, std::uint32_t below) {
    for (std::uint32_t i = 0; i < n_; ++i, ++to_.vertex) {
      value_.set(kSide, i);
      const glm::dvec2 stretch(value_.optional(section.stretch[0], 1),
                               value_.optional(section.stretch[1], 1));
      const glm::dvec2 at = outline(i, regular) * (scale * stretch);
      mesh_.positions[to_.vertex] = glm::vec3(frame.to_world({at, 0}));
      mesh_.texture[to_.vertex] = mesh_.texture[below == kNoVertex ? base_[i] : below + i];
      if (section.texture.empty()) continue;
      mesh_.texture[to_.vertex] =
          texture(section.texture.size() == 1 ? section.texture[0] : section.texture[i]);
    }
  }

  void sides(const Section& section, std::size_t s, std::uint32_t first, std::uint32_t below) {
    for (std::uint32_t i = 0; i < n_; ++i) {
      const std::uint32_t next = (i + 1) % n_;
      value_.set(kSide, i);
      value_.salt(s * (1ULL << 32) + i + 1);  // each side draws its own random numbers
      symbol(section.sides.size() == 1 ? section.sides[0] : section.sides[i]);
      corner(below == kNoVertex ? base_[i] : below + i);
      corner(below == kNoVertex ? base_[next] : below + next);
      corner(first + next);
      corner(first + i);
      end_face();
    }
    value_.salt(0);
    value_.set(kSide, 0);
  }

  void place_mesh() {
    const Template& t = e_.rule.replacement;
    base_texture(t.texture);
    const std::uint32_t first = to_.vertex;
    for (std::size_t v = 0; v < t.vertices.size(); ++v, ++to_.vertex) {
      const TemplateVertex& vertex = t.vertices[v];
      const Frame& frame = e_.state.shape.frame;
      glm::dvec3 at = vertex.weights.empty() ? frame.origin : glm::dvec3(0);
      glm::dvec2 texture_at(0);
      for (std::size_t i = 0; i < vertex.weights.size(); ++i) {
        const double weight = value_(vertex.weights[i]);
        at += weight * glm::dvec3(mesh_.positions[base_[i]]);
        texture_at += weight * glm::dvec2(mesh_.texture[base_[i]]);
      }
      const glm::dvec3 offset = three(vertex.offset);
      mesh_.positions[to_.vertex] =
          glm::vec3(at + frame.x * offset.x + frame.y * offset.y + frame.z * offset.z);
      const bool given = !t.texture.empty() && t.texture[n_ + v].given();
      mesh_.texture[to_.vertex] = given ? texture(t.texture[n_ + v]) : glm::vec2(texture_at);
    }
    for (std::size_t f = 0; f < t.faces.size(); ++f) {
      value_.set(kSide, static_cast<double>(f));
      value_.salt(f + 1);
      symbol(t.faces[f]);
      for (std::uint32_t c = t.first_corner[f]; c < t.first_corner[f + 1]; ++c) {
        const std::uint32_t v = t.face_corners[c];
        corner(v < n_ ? base_[v] : first + v - n_);
      }
      end_face();
    }
    for (const Crease& c : t.creases) {
      const auto global = [&](std::uint32_t v) { return v < n_ ? base_[v] : first + v - n_; };
      mesh_.creases[to_.crease++] = {global(c.a), global(c.b), c.sharpness};
    }
  }

  const Expansion& e_;
  FaceMesh& mesh_;
  FaceValues value_;
  const std::uint32_t* base_;
  std::uint32_t n_;
  Slots to_;
};

}  // namespace

Counts counts_of(const Template& t, std::uint32_t n) {
  if (!t.extruded()) {
    return {t.vertices.size(), t.faces.size(), t.face_corners.size(), t.creases.size()};
  }
  const std::size_t sections = t.sections.size();
  const auto creased = static_cast<std::size_t>(
      std::count_if(t.sections.begin(), t.sections.end(), [](const Section& s) { return s.crease > 0; }));
  return {sections * n, sections * n + 1, sections * n * 4 + n, creased * n};
}

FaceValues::FaceValues(const RuleSystem& system, const GrownMesh& grown, std::uint32_t face,
                       const FaceState& state)
    : values_{{slots_, kMostSlots}, system.tables, 0},
      key_(combine(combine(system.seed, state.path), grown.steps)) {
  const FaceMesh& mesh = grown.mesh;
  const Frame& f = state.shape.frame;
  const double shared[kShared] = {f.origin.x,
                                  f.origin.y,
                                  f.origin.z,
                                  f.x.y,
                                  f.y.y,
                                  f.z.y,
                                  state.shape.size,
                                  state.shape.area,
                                  static_cast<double>(mesh.first_corner[face + 1] - mesh.first_corner[face]),
                                  0,
                                  static_cast<double>(grown.steps)};
  std::copy(std::begin(shared), std::end(shared), slots_);
  const std::size_t parameters = system.symbols[mesh.symbols[face]].parameters.size();
  std::copy_n(grown.parameters.begin() + state.first_parameter, parameters, slots_ + kShared);
  salt(0);
}

std::uint64_t FaceValues::combine_key(std::uint64_t number) const { return combine(key_, number); }

double FaceValues::operator()(const Expression& e) {
  const double value = evaluate(e, values_);
  if (std::isfinite(value)) return value;
  fail(Failure::kNotFinite, e.place);
  return 0;
}

double FaceValues::optional(const Expression& e, double otherwise) {
  return e.given() ? (*this)(e) : otherwise;
}

Failure expand(const Expansion& e) { return Expander(e).run(); }

}  // namespace terrabench::growing
