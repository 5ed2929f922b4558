#include "representations/procedural_mesh/growing/apply_rule.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "terrain/splitmix.h"

namespace terrabench::growing {
namespace {

constexpr glm::dvec3 kUp{0, 1, 0};
// A face is degenerate if its area is below this share of the square of its size; a needle 1e6 long passes.
constexpr double kLeastArea = 1e-9;

class RuleApplier {
 public:
  explicit RuleApplier(const Replacement& r)
      : r_(r),
        mesh_(r.grown.mesh),
        value_(r.system, r.grown, r.face, r.state),
        base_(mesh_.face(r.face).data()),
        n_(static_cast<std::uint32_t>(mesh_.face(r.face).size())),
        to_(r.to) {}

  Failure run() {
    const Rule& rule = r_.rule;
    for (std::size_t i = 0; i < rule.locals.size(); ++i) {
      value_.set(rule.first_local + i, value_(rule.locals[i]));
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
    for (std::uint32_t i = 0; i < n_ && !given.empty(); ++i) {
      value_.set(kSide, i);
      const TextureAt& at = given.size() == 1 ? given[0] : given[i];
      if (at.given()) r_.base_texture[i] = {base_[i], {value_(at.u), value_(at.v)}};
    }
  }

  void symbol(const SymbolChoice& choice) {
    for (const SymbolChoice::Option& option : choice.options) {
      if (option.condition.given() && value_(option.condition) == 0) continue;
      mesh_.symbols[to_.faces] = option.symbol;
      double* arguments = r_.made.arguments_of(to_.faces);
      for (const Expression& e : option.arguments) *arguments++ = value_(e);
      return;
    }
    mesh_.symbols[to_.faces] = kNoSymbol;
  }

  void corner(std::uint32_t vertex) { mesh_.corners[to_.corners++] = vertex; }

  void end_face() {
    const std::uint32_t first = mesh_.first_corner[to_.faces];
    const FaceShape shape = face_shape({&mesh_.corners[first], to_.corners - first}, mesh_.positions);
    if (!(shape.area > kLeastArea * shape.size * shape.size)) {
      value_.fail(Failure::kDegenerate, r_.rule.place);
    }
    r_.made.shapes[to_.faces - r_.made.first] = shape;
    // The first corner of the next rule's faces is not ours to write: another thread may read it.
    if (++to_.faces < r_.end_face) {
      mesh_.first_corner[to_.faces] = static_cast<std::uint32_t>(to_.corners);
    }
  }

  // Of corner i, in the section's plane, before scaling.
  glm::dvec2 outline(std::uint32_t i, bool regular) const {
    if (!regular) {
      const glm::dvec3 p = r_.state.shape.frame.to_local(glm::dvec3(mesh_.positions[base_[i]]));
      return {p.x, p.y};
    }
    // Edge 0 along x, as the frame of the base has it.
    const double turns = (static_cast<double>(i) - 0.5) / n_ - 0.25;
    const double angle = 2 * std::numbers::pi * turns;
    return {std::cos(angle), std::sin(angle)};
  }

  void extrude() {
    const Template& t = r_.rule.replacement;
    base_texture(t.texture);
    value_.set(kSide, 0);
    Frame frame = r_.state.shape.frame;
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
      const auto first = static_cast<std::uint32_t>(to_.vertices);
      ring(section, frame, regular, scale, below);
      sides(section, s, first, below);
      for (std::uint32_t i = 0; section.crease > 0 && i < n_; ++i) {
        mesh_.creases[to_.creases++] = {first + i, first + (i + 1) % n_, section.crease};
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
    for (std::uint32_t i = 0; i < n_; ++i, ++to_.vertices) {
      value_.set(kSide, i);
      const glm::dvec2 stretch(value_.optional(section.stretch[0], 1),
                               value_.optional(section.stretch[1], 1));
      const glm::dvec2 at = outline(i, regular) * (scale * stretch);
      mesh_.positions[to_.vertices] = glm::vec3(frame.to_world({at, 0}));
      mesh_.texture[to_.vertices] = mesh_.texture[below == kNoVertex ? base_[i] : below + i];
      if (section.texture.empty()) continue;
      mesh_.texture[to_.vertices] =
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
    const Template& t = r_.rule.replacement;
    base_texture(t.texture);
    const auto first = static_cast<std::uint32_t>(to_.vertices);
    for (std::size_t v = 0; v < t.vertices.size(); ++v, ++to_.vertices) {
      const TemplateVertex& vertex = t.vertices[v];
      const Frame& frame = r_.state.shape.frame;
      glm::dvec3 at = vertex.weights.empty() ? frame.origin : glm::dvec3(0);
      glm::dvec2 texture_at(0);
      for (std::size_t i = 0; i < vertex.weights.size(); ++i) {
        const double weight = value_(vertex.weights[i]);
        at += weight * glm::dvec3(mesh_.positions[base_[i]]);
        texture_at += weight * glm::dvec2(mesh_.texture[base_[i]]);
      }
      const glm::dvec3 offset = three(vertex.offset);
      mesh_.positions[to_.vertices] =
          glm::vec3(at + frame.x * offset.x + frame.y * offset.y + frame.z * offset.z);
      const bool given = !t.texture.empty() && t.texture[n_ + v].given();
      mesh_.texture[to_.vertices] = given ? texture(t.texture[n_ + v]) : glm::vec2(texture_at);
    }
    const auto global = [&](std::uint32_t v) { return v < n_ ? base_[v] : first + v - n_; };
    for (std::size_t f = 0; f < t.mesh.faces(); ++f) {
      value_.set(kSide, static_cast<double>(f));
      value_.salt(f + 1);
      symbol(t.symbols[f]);
      for (const std::uint32_t v : t.mesh.face(f)) corner(global(v));
      end_face();
    }
    for (const Crease& c : t.mesh.creases) {
      mesh_.creases[to_.creases++] = {global(c.a), global(c.b), c.sharpness};
    }
  }

  const Replacement& r_;
  FaceMesh& mesh_;
  FaceValues value_;
  const std::uint32_t* base_;
  std::uint32_t n_;
  Sizes to_;
};

}  // namespace

Sizes added_by(const Template& t, std::uint32_t n) {
  if (!t.extruded()) return {t.vertices.size(), t.mesh.faces(), t.mesh.corners.size(), t.mesh.creases.size()};
  const std::size_t sections = t.sections.size();
  const auto creased = static_cast<std::size_t>(
      std::ranges::count_if(t.sections, [](const Section& s) { return s.crease > 0; }));
  return {sections * n, sections * n + 1, sections * n * 4 + n, creased * n};
}

FaceValues::FaceValues(const RuleSystem& system, const GrownMesh& grown, std::uint32_t face,
                       const FaceState& state)
    : values_{{slots_, kMostSlots}, system.tables, 0},
      key_(combine(combine(system.seed, state.path), grown.steps)) {
  const Frame& f = state.shape.frame;
  const double shared[kShared] = {f.origin.x,
                                  f.origin.y,
                                  f.origin.z,  // px, py, pz
                                  f.x.y,
                                  f.y.y,
                                  f.z.y,  // up_x, up_y, up_z
                                  state.shape.size,
                                  state.shape.area,  //
                                  static_cast<double>(grown.mesh.face(face).size()),
                                  0,  // side
                                  static_cast<double>(grown.steps)};
  std::copy(std::begin(shared), std::end(shared), slots_);
  const std::size_t parameters = system.symbols[grown.mesh.symbols[face]].parameters.size();
  std::copy_n(grown.parameters.begin() + state.first_parameter, parameters, slots_ + kShared);
  salt(0);
}

void FaceValues::salt(std::uint64_t number) { values_.random = combine(key_, number); }

double FaceValues::operator()(const Expression& e) {
  const double value = evaluate(e, values_);
  if (std::isfinite(value)) return value;
  fail(Failure::kNotFinite, e.place);
  return 0;
}

Failure apply_rule(const Replacement& r) { return RuleApplier(r).run(); }

}  // namespace terrabench::growing
