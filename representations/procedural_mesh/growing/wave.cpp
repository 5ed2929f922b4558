#include "representations/procedural_mesh/growing/wave.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "representations/procedural_mesh/growing/hashing.h"
#include "representations/procedural_mesh/growing/operations.h"
#include "terrain/error.h"

namespace terrabench::growing {
namespace {

constexpr std::size_t kGroup = 8192;         // faces that are expanded together
constexpr std::uint64_t kChoice = 0xC401CE;  // what the random number that chooses a rule is for
// A face is degenerate if its area is below this share of the square of its size; a needle 1e6 long passes.
constexpr double kLeastArea = 1e-9;

bool reads_step_or_random(const Expression& e) {
  return std::any_of(e.code.begin(), e.code.end(), [](const Operation& o) {
    const auto code = static_cast<Code>(o.code);
    return code == Code::kRandom || code == Code::kRandomBetween ||
           (code == Code::kVariable && o.where == kStep);
  });
}

// A condition that depends on the face alone never changes while growing.
bool may_apply_later(const RuleSystem& system, const Symbol& symbol) {
  for (std::uint32_t r = symbol.first_rule; r < symbol.first_rule + symbol.rules; ++r) {
    const Rule& rule = system.rules[r];
    if (rule.probability.given() || reads_step_or_random(rule.when)) return true;
  }
  return false;
}

}  // namespace

Wave::Wave(const RuleSystem& system, GrownMesh& grown, const GrowOptions& options)
    : system_(system),
      grown_(grown),
      only_(options.only),
      limits_(options.limits),
      replaced_(grown.mesh.faces(), false) {
  for (const Symbol& symbol : system.symbols) {
    retries_.push_back(may_apply_later(system, symbol));
    stride_ = std::max(stride_, static_cast<std::uint32_t>(symbol.parameters.size()));
  }
}

void Wave::fail(const Failure& failure, const Active& active) const {
  constexpr std::string_view kWhat[] = {
      "", "the value is not a finite number",
      "the template does not fit the face, which has another number of corners",
      "the rule makes a degenerate face"};
  constexpr std::string_view kAdvice[] = {"", "divide by no zero, and keep every value in its range",
                                          "give the symbol to faces with as many corners as the base has",
                                          "keep its corners apart"};
  const Symbol& symbol = system_.symbols[grown_.mesh.symbols[active.face]];
  throw bad_input(
      fmt::format("{}, where '{}' grows in step {}", kWhat[failure.kind], symbol.name, grown_.steps + 1),
      fmt::format("{}:{}:{}", system_.file, failure.place.line, failure.place.column), kAdvice[failure.kind]);
}

// Among the rules whose condition holds, each is taken with its probability; what is left of 1 is the
// probability that the face stays as it is. Probabilities whose sum is above 1 are taken as shares of it.
const Rule* Wave::rule_for(const Active& active, Failure& failure) const {
  const FaceState& state = grown_.states[active.state];
  const Symbol& symbol = system_.symbols[grown_.mesh.symbols[active.face]];
  FaceValues value(system_, grown_, active.face, state);
  double sum = 0;
  const auto each = [&](auto&& visit) {
    for (std::uint32_t r = symbol.first_rule; r < symbol.first_rule + symbol.rules; ++r) {
      const Rule& rule = system_.rules[r];
      if (value.optional(rule.when, 1) == 0) continue;
      const double probability = std::max(0.0, value.optional(rule.probability, 1));
      if (visit(rule, probability)) return;
    }
  };
  each([&](const Rule&, double probability) {
    sum += probability;
    return false;
  });
  double left = share(combine(combine(system_.seed ^ kChoice, state.path), grown_.steps), kChoice);
  left *= std::max(1.0, sum);
  const Rule* chosen = nullptr;
  each([&](const Rule& rule, double probability) {
    left -= probability;
    if (left < 0) chosen = &rule;
    return chosen != nullptr;
  });
  failure = value.failure();
  return chosen;
}

void Wave::choose(const std::vector<Active>& active) {
  chosen_.assign(active.size(), {});
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, active.size(), 256), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      chosen_[i].active = active[i];
      chosen_[i].rule = rule_for(active[i], chosen_[i].failure);
    }
  });
  for (const Chosen& chosen : chosen_) {
    if (chosen.failure.kind != Failure::kNone) fail(chosen.failure, chosen.active);
  }
}

// Gives every expansion of a group its place in the arrays.
void Wave::lay_out(std::size_t first, std::size_t last) {
  FaceMesh& mesh = grown_.mesh;
  std::size_t vertices = mesh.positions.size(), faces = mesh.faces(), corners = mesh.corners.size();
  std::size_t creases = mesh.creases.size(), base_corners = base_texture_.size();
  arguments_.first_face = static_cast<std::uint32_t>(faces);
  for (std::size_t i = first; i < last; ++i) {
    Chosen& chosen = chosen_[i];
    chosen.to = {static_cast<std::uint32_t>(vertices), static_cast<std::uint32_t>(faces),
                 static_cast<std::uint32_t>(corners), static_cast<std::uint32_t>(creases)};
    chosen.end_face = chosen.to.face;
    if (chosen.rule == nullptr) continue;
    const std::uint32_t f = chosen.active.face;
    const std::uint32_t n = mesh.first_corner[f + 1] - mesh.first_corner[f];
    const Template& replacement = chosen.rule->replacement;
    if (replacement.corners != 0 && replacement.corners != n) {
      fail({Failure::kCorners, chosen.rule->place}, chosen.active);
    }
    const Counts counts = counts_of(replacement, n);
    chosen.first_base_texture = static_cast<std::uint32_t>(base_corners);
    base_corners += n;
    vertices += counts.vertices;
    faces += counts.faces;
    corners += counts.corners;
    creases += counts.creases;
    chosen.end_face = static_cast<std::uint32_t>(faces);
    if (faces - removed_ - (i - first) > limits_.faces) {
      throw bad_input(
          fmt::format("the model grows beyond {} faces in step {}", limits_.faces, grown_.steps + 1),
          system_.file, "let it grow less, or raise the limit of faces");
    }
  }
  mesh.positions.resize(vertices);
  mesh.texture.resize(vertices);
  mesh.first_corner.resize(faces + 1);
  for (std::size_t i = first; i < last; ++i) mesh.first_corner[chosen_[i].to.face] = chosen_[i].to.corner;
  mesh.first_corner[faces] = static_cast<std::uint32_t>(corners);
  mesh.corners.resize(corners);
  mesh.symbols.resize(faces);
  mesh.creases.resize(creases);
  replaced_.resize(faces, false);
  base_texture_.resize(base_corners, {kNoVertex, {}});
  arguments_.stride = stride_;
  arguments_.values.resize((faces - arguments_.first_face) * stride_);
  shapes_.resize(faces - arguments_.first_face);
}

void Wave::expand_one(Chosen& chosen) {
  FaceMesh& mesh = grown_.mesh;
  const FaceState& state = grown_.states[chosen.active.state];
  chosen.failure = expand({system_, grown_, chosen.active.face, state, *chosen.rule, chosen.to,
                           chosen.end_face, arguments_, base_texture_.data() + chosen.first_base_texture});
  if (chosen.failure.kind != Failure::kNone) return;
  for (std::uint32_t f = chosen.to.face; f < chosen.end_face; ++f) {
    const FaceShape shape = face_shape(
        {mesh.corners.data() + mesh.first_corner[f], mesh.corners.data() + mesh.first_corner[f + 1]},
        mesh.positions);
    shapes_[f - arguments_.first_face] = shape;
    if (!(shape.area > kLeastArea * shape.size * shape.size)) {
      chosen.failure = {Failure::kDegenerate, chosen.rule->place};
    }
  }
}

void Wave::expand_group(std::size_t first, std::size_t last) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(first, last, 32), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      if (chosen_[i].rule != nullptr) expand_one(chosen_[i]);
    }
  });
  for (std::size_t i = first; i < last; ++i) {
    if (chosen_[i].failure.kind != Failure::kNone) fail(chosen_[i].failure, chosen_[i].active);
  }
}

void Wave::keep_states(std::size_t first, std::size_t last, std::vector<Active>& next,
                       std::vector<Active>& resting) {
  for (std::size_t i = first; i < last; ++i) {
    const Chosen& chosen = chosen_[i];
    if (chosen.rule == nullptr) {
      const std::uint32_t symbol = grown_.mesh.symbols[chosen.active.face];
      (retries_[symbol] ? next : resting).push_back(chosen.active);
      continue;
    }
    replaced_[chosen.active.face] = true;
    ++removed_;
    const std::uint64_t path = grown_.states[chosen.active.state].path;
    for (std::uint32_t f = chosen.to.face; f < chosen.end_face; ++f) {
      const std::uint32_t symbol = grown_.mesh.symbols[f];
      if (!system_.symbols[symbol].grows()) continue;
      const auto parameters = static_cast<std::uint32_t>(system_.symbols[symbol].parameters.size());
      const double* const values =
          arguments_.values.data() + static_cast<std::size_t>(f - arguments_.first_face) * stride_;
      const auto state = static_cast<std::uint32_t>(grown_.states.size());
      grown_.states.push_back({shapes_[f - arguments_.first_face], combine(path, f - chosen.to.face),
                               static_cast<std::uint32_t>(grown_.parameters.size())});
      grown_.parameters.insert(grown_.parameters.end(), values, values + parameters);
      (selected(symbol) ? next : resting).push_back({f, state, parameters});
    }
  }
}

// Sums in the order of the faces, so that the result does not depend on threads.
void Wave::average_texture() {
  sums_.resize(grown_.mesh.positions.size());
  shares_.resize(grown_.mesh.positions.size());
  for (const CornerTexture& given : base_texture_) {
    if (given.vertex == kNoVertex) continue;
    sums_[given.vertex] += given.at;
    ++shares_[given.vertex];
  }
  for (const CornerTexture& given : base_texture_) {
    if (given.vertex == kNoVertex || shares_[given.vertex] == 0) continue;
    grown_.mesh.texture[given.vertex] =
        glm::vec2(sums_[given.vertex] / static_cast<double>(shares_[given.vertex]));
    sums_[given.vertex] = {};
    shares_[given.vertex] = 0;
  }
  base_texture_.clear();
}

std::size_t Wave::run(std::vector<Active>& active, std::vector<Active>& resting) {
  choose(active);
  std::vector<Active> next;
  const std::size_t removed_before = removed_;
  for (std::size_t first = 0; first < chosen_.size(); first += kGroup) {
    const std::size_t last = std::min(chosen_.size(), first + kGroup);
    lay_out(first, last);
    expand_group(first, last);
    keep_states(first, last, next, resting);
  }
  average_texture();
  active = std::move(next);
  return removed_ - removed_before;
}

}  // namespace terrabench::growing
