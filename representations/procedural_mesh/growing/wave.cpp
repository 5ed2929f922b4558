#include "representations/procedural_mesh/growing/wave.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "representations/procedural_mesh/growing/operations.h"
#include "terrain/error.h"
#include "terrain/splitmix.h"

namespace terrabench::growing {
namespace {

constexpr std::size_t kGroup = 8192;         // most faces that are expanded together,
constexpr std::size_t kGroupFaces = 262144;  // and new faces after which a group ends
// Fewer faces or parameters that are no longer needed are never dropped before the end of grow().
constexpr std::size_t kFewDead = 65536;
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
      "the rule makes a degenerate face", "a probability is negative"};
  constexpr std::string_view kAdvice[] = {"", "check the divisors, and keep every value in its range",
                                          "give the symbol to faces with as many corners as the base has",
                                          "keep its corners apart", "use max(0, …) where it may fall below"};
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
      const double probability = value.optional(rule.probability, 1);
      if (probability < 0) value.fail(Failure::kNegative, rule.probability.place);
      if (visit(rule, probability)) return;
    }
  };
  each([&](const Rule&, double probability) {
    sum += probability;
    return false;
  });
  double left = random_share(combine(combine(system_.seed ^ kChoice, state.path), grown_.steps), kChoice);
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

void Wave::fail_beyond(std::size_t limit, std::string_view what) const {
  throw bad_input(fmt::format("the model grows beyond {} {} in step {}", limit, what, grown_.steps + 1),
                  system_.file, "let it grow less, or raise the limit of faces, to 100,000,000 at most");
}

// Faces that were replaced do not count, but their number is bounded, too: see should_drop().
void Wave::check_limits(const Counts& all, std::size_t replaced, std::size_t replaced_corners) const {
  const std::size_t most = limits_.elements();
  if (all.faces - replaced > limits_.faces) fail_beyond(limits_.faces, "faces");
  if (all.corners - replaced_corners > most) fail_beyond(most, "corners of faces");
  if (all.vertices > most) fail_beyond(most, "vertices");
  if (all.creases > most) fail_beyond(most, "creases");
}

// Gives every expansion of a group its place in the arrays.
std::size_t Wave::lay_out(std::size_t first) {
  const FaceMesh& mesh = grown_.mesh;
  Counts all{mesh.positions.size(), mesh.faces(), mesh.corners.size(), mesh.creases.size()};
  std::size_t base_corners = base_texture_.size(), replaced = removed_, replaced_corners = removed_corners_;
  arguments_.first_face = static_cast<std::uint32_t>(all.faces);
  std::size_t last = first;
  while (last < chosen_.size() && last < first + kGroup && all.faces < arguments_.first_face + kGroupFaces) {
    Chosen& chosen = chosen_[last++];
    chosen.to = {static_cast<std::uint32_t>(all.vertices), static_cast<std::uint32_t>(all.faces),
                 static_cast<std::uint32_t>(all.corners), static_cast<std::uint32_t>(all.creases)};
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
    all.vertices += counts.vertices;
    all.faces += counts.faces;
    all.corners += counts.corners;
    all.creases += counts.creases;
    check_limits(all, ++replaced, replaced_corners += n);
    chosen.end_face = static_cast<std::uint32_t>(all.faces);
  }
  made_ += all.faces - arguments_.first_face;
  if (made_ > limits_.made()) fail_beyond(limits_.made(), "faces, with those that it replaces,");
  reserve(all, base_corners, first, last);
  return last;
}

void Wave::reserve(const Counts& all, std::size_t base_corners, std::size_t first, std::size_t last) {
  FaceMesh& mesh = grown_.mesh;
  mesh.positions.resize(all.vertices);
  mesh.texture.resize(all.vertices);
  mesh.first_corner.resize(all.faces + 1);
  for (std::size_t i = first; i < last; ++i) mesh.first_corner[chosen_[i].to.face] = chosen_[i].to.corner;
  mesh.first_corner[all.faces] = static_cast<std::uint32_t>(all.corners);
  mesh.corners.resize(all.corners);
  mesh.symbols.resize(all.faces);
  mesh.creases.resize(all.creases);
  replaced_.resize(all.faces, false);
  base_texture_.resize(base_corners, {kNoVertex, {}});
  arguments_.stride = stride_;
  arguments_.values.resize((all.faces - arguments_.first_face) * stride_);
  shapes_.resize(all.faces - arguments_.first_face);
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
    const std::uint32_t* const corners = grown_.mesh.first_corner.data() + chosen.active.face;
    removed_corners_ += corners[1] - corners[0];
    const std::uint64_t path = grown_.states[chosen.active.state].path;
    for (std::uint32_t f = chosen.to.face; f < chosen.end_face; ++f) {
      const std::uint32_t symbol = grown_.mesh.symbols[f];
      if (!system_.symbols[symbol].grows()) continue;
      const auto parameters = static_cast<std::uint32_t>(system_.symbols[symbol].parameters.size());
      const double* const values =
          arguments_.values.data() + static_cast<std::size_t>(f - arguments_.first_face) * stride_;
      const auto state = static_cast<std::uint32_t>(grown_.states.size());
      if (grown_.parameters.size() + parameters > 2 * limits_.elements()) {
        fail_beyond(2 * limits_.elements(), "parameters of its faces");
      }
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
  for (std::size_t first = 0, last = 0; first < chosen_.size(); first = last) {
    last = lay_out(first);
    expand_group(first, last);
    keep_states(first, last, next, resting);
  }
  average_texture();
  active = std::move(next);
  return removed_ - removed_before;
}

bool Wave::should_drop() const {
  const std::size_t live = grown_.mesh.faces() - removed_;
  const std::size_t live_corners = grown_.mesh.corners.size() - removed_corners_;
  return removed_ > std::max(live, kFewDead) || removed_corners_ > std::max(live_corners, kFewDead) ||
         grown_.states.size() > std::max(2 * live, kFewDead) || grown_.parameters.size() > limits_.elements();
}

void Wave::drop_replaced(std::initializer_list<std::vector<Active>*> lists) {
  FaceMesh& mesh = grown_.mesh;
  std::vector<std::uint32_t> number(replaced_.size());
  std::uint32_t face = 0, corner = 0;
  for (std::uint32_t f = 0; f < replaced_.size(); ++f) {
    number[f] = face;
    if (replaced_[f]) continue;
    const std::uint32_t first = mesh.first_corner[f], last = mesh.first_corner[f + 1];
    mesh.symbols[face] = mesh.symbols[f];
    mesh.first_corner[face++] = corner;
    for (std::uint32_t c = first; c < last; ++c) mesh.corners[corner++] = mesh.corners[c];
  }
  mesh.first_corner[face] = corner;
  mesh.first_corner.resize(face + 1);
  mesh.corners.resize(corner);
  mesh.symbols.resize(face);
  std::size_t count = 0, needed = 0;
  for (const std::vector<Active>* const list : lists) {
    count += list->size();
    for (const Active& active : *list) needed += active.parameters;
  }
  // After a subdivision the faces of one parent share its parameters; here each gets its own.
  if (needed > limits_.elements()) fail_beyond(limits_.elements(), "parameters of its faces");
  std::vector<FaceState> states;
  std::vector<double> parameters;
  states.reserve(count);
  parameters.reserve(needed);
  for (std::vector<Active>* const list : lists) {
    for (Active& active : *list) {
      const FaceState& old = grown_.states[active.state];
      const auto from = grown_.parameters.begin() + old.first_parameter;
      active.face = number[active.face];
      active.state = static_cast<std::uint32_t>(states.size());
      states.push_back(old);
      states.back().first_parameter = static_cast<std::uint32_t>(parameters.size());
      parameters.insert(parameters.end(), from, from + active.parameters);
    }
  }
  grown_.states = std::move(states);
  grown_.parameters = std::move(parameters);
  replaced_.assign(face, false);
  removed_ = removed_corners_ = 0;
}

}  // namespace terrabench::growing
