#include "representations/procedural_mesh/growing/grow.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <string_view>

#include "representations/procedural_mesh/growing/apply_rule.h"
#include "terrain/error.h"
#include "terrain/splitmix.h"

namespace terrabench::growing {
namespace {

constexpr std::size_t kGroup = 8192;         // most faces that are replaced together,
constexpr std::size_t kGroupFaces = 262144;  // and new faces after which a group ends
// Fewer faces or parameters that are no longer needed are never dropped before the end of grow().
constexpr std::size_t kFewDead = 65536;
constexpr std::uint64_t kChoice = 0xC401CE;  // what the random number that chooses a rule is for

bool reads_step_or_random(const Expression& e) {
  return std::ranges::any_of(e.code, [](const Operation& o) {
    return o.code == Code::kRandom || o.code == Code::kRandomBetween ||
           (o.code == Code::kVariable && o.where == kStep);
  });
}

// A condition that depends on the face alone never changes while growing.
bool may_apply_later(const RuleSystem& system, const Symbol& symbol) {
  return std::any_of(
      system.rules.begin() + symbol.first_rule, system.rules.begin() + symbol.first_rule + symbol.rules,
      [](const Rule& rule) { return rule.probability.given() || reads_step_or_random(rule.when); });
}

// A face that may grow.
struct Growing {
  std::uint32_t face, state;
};

// New elements are appended to the arrays of the mesh, in groups of bounded size, so that only a group's
// arguments exist twice. Replaced faces stay in the arrays until there are many, or until the end.
class Grower {
 public:
  Grower(const RuleSystem& system, GrownMesh& grown, const GrowOptions& options)
      : system_(system),
        grown_(grown),
        options_(options),
        limits_(options.limits),
        replaced_(grown.mesh.faces(), false) {
    for (const Symbol& symbol : system.symbols) {
      retries_.push_back(may_apply_later(system, symbol));
      made_.stride = std::max(made_.stride, symbol.parameters.size());
    }
    std::uint32_t state = 0;
    for (std::uint32_t f = 0; f < grown.mesh.faces(); ++f) {
      if (symbol_of(f).grows()) (selected(f) ? active_ : resting_).push_back({f, state++});
    }
  }

  std::size_t run() {
    const std::size_t most = options_.to_the_end ? SIZE_MAX : options_.steps;
    std::size_t replaced = 0;
    for (std::size_t s = 0; s < most && !active_.empty(); ++s, ++grown_.steps) {
      if (grown_.steps >= limits_.steps) {
        throw bad_input(fmt::format("the model still grows after {} steps", limits_.steps), system_.file,
                        "add a condition that ends its growth, or raise the limit of steps");
      }
      replaced += step();
      if (should_drop()) drop_replaced();
    }
    resting_.insert(resting_.end(), active_.begin(), active_.end());
    active_.clear();
    std::ranges::sort(resting_, {}, &Growing::face);
    drop_replaced();
    return replaced;
  }

 private:
  struct Chosen {
    Growing face;
    const Rule* rule = nullptr;
    Failure failure{};
    Sizes to{};
    std::size_t end_face = 0, first_base_texture = 0;
  };

  // Replaces the active faces that have a rule. Afterwards the new faces that may grow are active, and the
  // old ones that may still grow later; faces that cannot grow before this call of grow() ends rest. Returns
  // the number of faces replaced.
  std::size_t step() {
    choose_rules();
    active_.clear();
    std::size_t replaced = 0;
    for (std::size_t first = 0, last = 0; first < chosen_.size(); first = last) {
      last = lay_out(first);
      const std::span<Chosen> group(chosen_.data() + first, last - first);
      apply_rules(group);
      for (const Chosen& chosen : group) replaced += keep_states(chosen);
    }
    average_texture();
    return replaced;
  }

  void choose_rules() {
    chosen_.assign(active_.size(), {});
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, active_.size(), 256), [&](const auto& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i) {
        chosen_[i].face = active_[i];
        chosen_[i].rule = rule_for(active_[i], chosen_[i].failure);
      }
    });
    refuse_failures(chosen_);
  }

  // Among the rules whose condition holds, each is taken with its probability; what is left of 1 is the
  // probability that the face stays as it is. Probabilities whose sum is above 1 are taken as shares of it.
  const Rule* rule_for(const Growing& face, Failure& failure) const {
    const FaceState& state = grown_.states[face.state];
    const Symbol& symbol = symbol_of(face.face);
    FaceValues value(system_, grown_, face.face, state);
    thread_local std::vector<std::pair<const Rule*, double>> fitting;
    fitting.clear();
    double sum = 0;
    for (std::uint32_t r = symbol.first_rule; r < symbol.first_rule + symbol.rules; ++r) {
      const Rule& rule = system_.rules[r];
      if (value.optional(rule.when, 1) == 0) continue;
      const double probability = value.optional(rule.probability, 1);
      if (probability < 0) value.fail(Failure::kNegative, rule.probability.place);
      fitting.emplace_back(&rule, probability);
      sum += probability;
    }
    failure = value.failure();
    double left = random_share(combine(combine(system_.seed ^ kChoice, state.path), grown_.steps), kChoice);
    left *= std::max(1.0, sum);
    for (const auto& [rule, probability] : fitting) {
      left -= probability;
      if (left < 0) return rule;
    }
    return nullptr;
  }

  // Gives every replacement of a group its place in the arrays. Returns where the group ends.
  std::size_t lay_out(std::size_t first) {
    const FaceMesh& mesh = grown_.mesh;
    Sizes all{mesh.positions.size(), mesh.faces(), mesh.corners.size(), mesh.creases.size()};
    std::size_t base_corners = base_texture_.size(), dead = dead_, dead_corners = dead_corners_;
    made_.first = all.faces;
    std::size_t last = first;
    while (last < chosen_.size() && last < first + kGroup && all.faces < made_.first + kGroupFaces) {
      Chosen& chosen = chosen_[last++];
      chosen.to = all;
      chosen.end_face = all.faces;
      if (chosen.rule == nullptr) continue;
      const Template& replacement = chosen.rule->replacement;
      const auto n = static_cast<std::uint32_t>(mesh.face(chosen.face.face).size());
      if (replacement.corners != 0 && replacement.corners != n) {
        fail({Failure::kCorners, chosen.rule->place}, chosen.face);
      }
      const Sizes added = added_by(replacement, n);
      all = {all.vertices + added.vertices, all.faces + added.faces, all.corners + added.corners,
             all.creases + added.creases};
      chosen.end_face = all.faces;
      chosen.first_base_texture = base_corners;
      base_corners += n;
      check_limits(all, ++dead, dead_corners += n);
    }
    made_in_all_ += all.faces - made_.first;
    if (made_in_all_ > limits_.made()) {
      fail_beyond(limits_.made(), "faces, with those that it replaces,");
    }
    make_room(all, {chosen_.data() + first, last - first});
    base_texture_.resize(base_corners);
    return last;
  }

  // Faces that were replaced do not count, but their number is bounded, too: see should_drop().
  void check_limits(const Sizes& all, std::size_t dead, std::size_t dead_corners) const {
    const std::size_t most = limits_.elements();
    if (all.faces - dead > limits_.faces) fail_beyond(limits_.faces, "faces");
    if (all.corners - dead_corners > most) fail_beyond(most, "corners of faces");
    if (all.vertices > most) fail_beyond(most, "vertices");
    if (all.creases > most) fail_beyond(most, "creases");
  }

  void make_room(const Sizes& all, std::span<const Chosen> group) {
    FaceMesh& mesh = grown_.mesh;
    mesh.positions.resize(all.vertices);
    mesh.texture.resize(all.vertices);
    mesh.first_corner.resize(all.faces + 1);
    for (const Chosen& c : group) mesh.first_corner[c.to.faces] = static_cast<std::uint32_t>(c.to.corners);
    mesh.first_corner[all.faces] = static_cast<std::uint32_t>(all.corners);
    mesh.corners.resize(all.corners);
    mesh.symbols.resize(all.faces);
    mesh.creases.resize(all.creases);
    replaced_.resize(all.faces, false);
    made_.arguments.resize((all.faces - made_.first) * made_.stride);
    made_.shapes.resize(all.faces - made_.first);
  }

  void apply_rules(std::span<Chosen> group) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, group.size(), 32), [&](const auto& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i) {
        Chosen& c = group[i];
        if (c.rule == nullptr) continue;
        c.failure = apply_rule({system_, grown_, c.face.face, grown_.states[c.face.state], *c.rule, c.to,
                                c.end_face, made_, base_texture_.data() + c.first_base_texture});
      }
    });
    refuse_failures(group);
  }

  // Whether the face was replaced.
  bool keep_states(const Chosen& chosen) {
    const std::uint32_t old = chosen.face.face;
    if (chosen.rule == nullptr) {
      (retries_[grown_.mesh.symbols[old]] ? active_ : resting_).push_back(chosen.face);
      return false;
    }
    replaced_[old] = true;
    ++dead_;
    dead_corners_ += grown_.mesh.face(old).size();
    const std::uint64_t path = grown_.states[chosen.face.state].path;
    for (std::size_t f = chosen.to.faces; f < chosen.end_face; ++f) {
      const Symbol& symbol = symbol_of(f);
      if (!symbol.grows()) continue;
      const auto state = static_cast<std::uint32_t>(grown_.states.size());
      grown_.states.push_back({made_.shapes[f - made_.first], combine(path, f - chosen.to.faces),
                               static_cast<std::uint32_t>(grown_.parameters.size())});
      add_parameters(grown_.parameters, made_.arguments_of(f), symbol, 2 * limits_.elements());
      (selected(f) ? active_ : resting_).push_back({static_cast<std::uint32_t>(f), state});
    }
    return true;
  }

  void add_parameters(std::vector<double>& to, const double* from, const Symbol& symbol,
                      std::size_t most) const {
    to.insert(to.end(), from, from + symbol.parameters.size());
    if (to.size() > most) fail_beyond(most, "parameters of its faces");
  }

  // Sums in the order of the faces, so that the result does not depend on threads.
  void average_texture() {
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

  // Whether the faces that were replaced take more memory than those that live.
  bool should_drop() const {
    const std::size_t live = grown_.mesh.faces() - dead_;
    const std::size_t live_corners = grown_.mesh.corners.size() - dead_corners_;
    return dead_ > std::max(live, kFewDead) || dead_corners_ > std::max(live_corners, kFewDead) ||
           grown_.states.size() > std::max(2 * live, kFewDead) ||
           grown_.parameters.size() > limits_.elements();
  }

  // Removes the faces that were replaced, and the states and parameters of all but the faces that may grow.
  // States then lie in the order of these. After a subdivision the faces of one parent share its parameters;
  // here each gets its own.
  void drop_replaced() {
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
    std::vector<FaceState> states;
    std::vector<double> parameters;
    states.reserve(active_.size() + resting_.size());
    for (std::vector<Growing>* const list : {&active_, &resting_}) {
      for (Growing& growing : *list) {
        FaceState& state = states.emplace_back(grown_.states[growing.state]);
        const double* const from = grown_.parameters.data() + state.first_parameter;
        growing = {number[growing.face], static_cast<std::uint32_t>(states.size() - 1)};
        state.first_parameter = static_cast<std::uint32_t>(parameters.size());
        add_parameters(parameters, from, symbol_of(growing.face), limits_.elements());
      }
    }
    grown_.states = std::move(states);
    grown_.parameters = std::move(parameters);
    replaced_.assign(face, false);
    dead_ = dead_corners_ = 0;
  }

  const Symbol& symbol_of(std::size_t face) const { return system_.symbols[grown_.mesh.symbols[face]]; }
  bool selected(std::size_t face) const {
    return options_.only.empty() || options_.only[grown_.mesh.symbols[face]];
  }

  void refuse_failures(std::span<const Chosen> all) const {
    for (const Chosen& chosen : all) {
      if (chosen.failure.kind != Failure::kNone) fail(chosen.failure, chosen.face);
    }
  }

  [[noreturn]] void fail(const Failure& failure, const Growing& face) const {
    constexpr std::pair<std::string_view, std::string_view> kWhat[] = {
        {},
        {kNotFinite, kKeepInRange},
        {"the template does not fit the face, which has another number of corners",
         "give the symbol to faces with as many corners as the base has"},
        {"the rule makes a degenerate face", "keep its corners apart"},
        {"a probability is negative", "use max(0, …) where it may fall below"}};
    const auto& [what, advice] = kWhat[failure.kind];
    throw bad_input(
        fmt::format("{}, where '{}' grows in step {}", what, symbol_of(face.face).name, grown_.steps + 1),
        fmt::format("{}:{}:{}", system_.file, failure.place.line, failure.place.column), advice);
  }

  [[noreturn]] void fail_beyond(std::size_t limit, std::string_view what) const {
    throw bad_input(fmt::format("the model grows beyond {} {} in step {}", limit, what, grown_.steps + 1),
                    system_.file, "let it grow less, or raise the limit of faces, to 100,000,000 at most");
  }

  const RuleSystem& system_;
  GrownMesh& grown_;
  const GrowOptions& options_;
  const Limits& limits_;
  std::vector<Growing> active_, resting_;
  std::vector<bool> replaced_;               // per face
  std::size_t dead_ = 0, dead_corners_ = 0;  // replaced since they were dropped last
  std::size_t made_in_all_ = 0;              // new faces so far
  std::vector<bool> retries_;  // per symbol: whether its rules may apply later to a face that they left alone
  std::vector<Chosen> chosen_;
  NewFaces made_;  // of the group
  std::vector<CornerTexture> base_texture_;
  std::vector<glm::dvec2> sums_;
  std::vector<std::uint32_t> shares_;
};

}  // namespace

GrownMesh plant(const RuleSystem& system, FaceMesh mesh, const std::vector<std::vector<double>>& arguments) {
  GrownMesh grown;
  mesh.texture.resize(mesh.positions.size());
  mesh.symbols.resize(mesh.faces());
  for (std::uint32_t f = 0; f < mesh.faces(); ++f) {
    if (!system.symbols[mesh.symbols[f]].grows()) continue;
    grown.states.push_back({face_shape(mesh.face(f), mesh.positions), scramble(f),
                            static_cast<std::uint32_t>(grown.parameters.size())});
    grown.parameters.insert(grown.parameters.end(), arguments[f].begin(), arguments[f].end());
  }
  grown.mesh = std::move(mesh);
  return grown;
}

std::size_t grow(const RuleSystem& system, GrownMesh& grown, const GrowOptions& options) {
  return Grower(system, grown, options).run();
}

}  // namespace terrabench::growing
