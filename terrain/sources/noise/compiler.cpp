// Turns a noise graph into Code, for columns or for arbitrary points.
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "terrain/sources/noise/code.h"

namespace terrabench::noise {
namespace {

using Id = std::uint32_t;  // the index of a value in Compiler::values_
constexpr Id kNone = ~Id{0};
constexpr std::uint32_t kRootRegion = 0;

// One operation in static single assignment form. Operands come before the values that use them.
struct Value {
  Op op = Op::kConstant;
  std::array<Id, 3> operands{kNone, kNone, kNone};
  float p = 0, q = 0;
  std::uint32_t first = 0, count = 0;  // octaves
  bool varies = false;                 // along a column
  bool even = false;                   // input y, scaled and offset by what is constant along the column
};

// Instructions that run only when a batch needs them: operand `slot` of value `user`. The regions form a
// tree.
struct Region {
  Id user = kNone;
  int slot = 0;
  std::uint32_t parent = kRootRegion, depth = 0;
};

struct Coordinates {
  Id x, y, z;
  auto operator<=>(const Coordinates&) const = default;
};

// Whether an operand is evaluated only where needed.
bool is_lazy(Op op, int slot) {
  return (op == Op::kMultiply && slot == 1) || (op == Op::kMix && slot >= 1) || op == Op::kStep;
}

class Compiler {
 public:
  Compiler(const Graph& graph, Mode mode) : graph_(graph), mode_(mode) {
    const bool column = mode == Mode::kColumn;
    input_ = {add({.op = Op::kInputX, .varies = !column}),
              add({.op = Op::kInputY, .varies = true, .even = column}),
              add({.op = Op::kInputZ, .varies = !column})};
  }

  Code compile(Node root) {
    result_ = evaluate(root, input_);
    find_regions();
    assign_registers();
    emit();
    return std::move(code_);
  }

 private:
  // from nodes to values
  Id add(const Value& value);
  Id add_operation(Op op, std::array<Id, 3> operands, float p = 0, float q = 0);
  Id constant(float value) { return add({.op = Op::kConstant, .p = value}); }
  Id scale_offset(Id a, float scale, float offset);
  Id sum(Id a, Id b);
  Id fractal(Op op, const Fractal& fractal, const Coordinates& at);
  Id gradient(const Module& module, const Coordinates& at);
  Id evaluate(Node node, const Coordinates& at);
  Id evaluate_module(const Module& module, const Coordinates& at);

  // from values to code
  std::uint32_t common(std::uint32_t a, std::uint32_t b) const;
  void find_regions();
  void assign_registers();
  std::optional<std::uint32_t> interval(Id id, std::map<Id, std::uint32_t>& known,
                                        std::vector<IntervalStep>& steps) const;
  Instruction instruction(Id id);
  void emit();
  void emit_lazily(Id user, int slot);
  void emit_region(std::uint32_t region);

  const Graph& graph_;
  Mode mode_;
  Coordinates input_{};
  Id result_ = kNone;
  std::vector<Value> values_;
  std::map<std::array<std::uint32_t, 8>, Id> by_content_;
  std::map<std::pair<std::uint32_t, Coordinates>, Id> evaluated_;
  std::map<std::array<std::uint32_t, 6>, std::uint32_t> octaves_of_;  // first octave of a fractal

  std::vector<Region> regions_;
  std::vector<std::uint32_t> region_of_;                     // by value; ~0: not needed
  std::map<std::pair<Id, int>, std::uint32_t> lazy_region_;  // by user and slot
  std::vector<std::vector<Id>> members_;                     // by region, in order
  std::vector<Operand> registers_;                           // by value
  Code code_;
};

Id Compiler::add(const Value& v) {
  const std::array<std::uint32_t, 8> key = {static_cast<std::uint32_t>(v.op),
                                            v.operands[0],
                                            v.operands[1],
                                            v.operands[2],
                                            std::bit_cast<std::uint32_t>(v.p),
                                            std::bit_cast<std::uint32_t>(v.q),
                                            v.first,
                                            v.count};
  const auto [at, inserted] = by_content_.try_emplace(key, static_cast<Id>(values_.size()));
  if (inserted) values_.push_back(v);
  return at->second;
}

Id Compiler::add_operation(Op op, std::array<Id, 3> operands, float p, float q) {
  Value value{.op = op, .operands = operands, .p = p, .q = q};
  for (const Id operand : operands) {
    if (operand != kNone) value.varies |= values_[operand].varies;
  }
  const auto steady = [&](Id id) { return values_[id].even || !values_[id].varies; };
  if (op == Op::kScaleOffset || op == Op::kAdd) {
    const bool one_moves =
        op == Op::kScaleOffset || !(values_[operands[0]].even && values_[operands[1]].even);
    value.even =
        value.varies && one_moves && steady(operands[0]) && (operands[1] == kNone || steady(operands[1]));
  }
  return add(value);
}

Id Compiler::scale_offset(Id a, float scale, float offset) {
  if (scale == 0) return constant(offset);
  if (scale == 1 && offset == 0) return a;
  if (values_[a].op == Op::kConstant) return constant(values_[a].p * scale + offset);
  return add_operation(Op::kScaleOffset, {a, kNone, kNone}, scale, offset);
}

Id Compiler::sum(Id a, Id b) {
  if (a > b) std::swap(a, b);  // addition commutes, so both orders are one value
  return add_operation(Op::kAdd, {a, b, kNone});
}

Id Compiler::fractal(Op op, const Fractal& f, const Coordinates& at) {
  const std::array<std::uint32_t, 6> key = {
      static_cast<std::uint32_t>(f.seed),         static_cast<std::uint32_t>(f.seed >> 32),
      std::bit_cast<std::uint32_t>(f.frequency),  static_cast<std::uint32_t>(f.octaves),
      std::bit_cast<std::uint32_t>(f.lacunarity), std::bit_cast<std::uint32_t>(f.gain)};
  const auto [known, inserted] =
      octaves_of_.try_emplace(key, static_cast<std::uint32_t>(code_.octaves.size()));
  if (inserted) {
    const std::vector<Octave> drawn = octaves(f);
    code_.octaves.insert(code_.octaves.end(), drawn.begin(), drawn.end());
  }
  Value value{.op = op,
              .operands = {at.x, at.y, at.z},
              .first = known->second,
              .count = static_cast<std::uint32_t>(f.octaves)};
  value.varies = values_[at.x].varies || values_[at.y].varies || values_[at.z].varies;
  return add(value);
}

Id Compiler::gradient(const Module& m, const Coordinates& at) {
  const Id axes[] = {at.x, at.y, at.z};
  Id total = kNone;
  for (int axis = 2; axis >= 0; --axis) {
    const float slope = m.parameters[static_cast<std::size_t>(axis)];
    if (slope == 0) continue;
    // The constant term is added to the first axis with a slope.
    const Id term = scale_offset(axes[axis], slope, total == kNone ? m.parameters[3] : 0.0F);
    total = total == kNone ? term : sum(total, term);
  }
  return total;
}

Id Compiler::evaluate(Node node, const Coordinates& at) {
  assert(node.index < graph_.modules().size());
  const std::pair key{node.index, at};
  if (const auto known = evaluated_.find(key); known != evaluated_.end()) return known->second;
  const Id id = evaluate_module(graph_.modules()[node.index], at);
  evaluated_.emplace(key, id);
  return id;
}

Id Compiler::evaluate_module(const Module& m, const Coordinates& at) {
  const auto input = [&](int i) { return evaluate(m.inputs[static_cast<std::size_t>(i)], at); };
  const auto& p = m.parameters;
  switch (m.kind) {
    case Kind::kConstant:
      return constant(p[0]);
    case Kind::kGradient:
      return gradient(m, at);
    case Kind::kFbm:
      return fractal(Op::kFbm, m.fractal, at);
    case Kind::kRidgedMultifractal:
      return fractal(Op::kRidged, m.fractal, at);
    case Kind::kBillow:
      return fractal(Op::kBillow, m.fractal, at);
    case Kind::kClamp:
      return add_operation(Op::kClamp, {input(0), kNone, kNone}, p[0], p[1]);
    case Kind::kSelect: {
      const Id t = add_operation(Op::kStep, {input(2), kNone, kNone}, p[0]);
      const Id low = input(0), high = input(1);
      const auto is = [&](Id id, float value) {
        return values_[id].op == Op::kConstant && values_[id].p == value && !std::signbit(values_[id].p);
      };
      return is(low, 0) && is(high, 1) ? t : add_operation(Op::kMix, {t, high, low});
    }
    case Kind::kScaleOffset:
      return scale_offset(input(0), p[0], p[1]);
    case Kind::kBias:
      return add_operation(Op::kBias, {input(0), kNone, kNone}, 1.0F / p[0] - 2.0F);
    case Kind::kAdd:
      return sum(input(0), input(1));
    case Kind::kMultiply:
      return add_operation(Op::kMultiply, {input(0), input(1), kNone});
    case Kind::kTranslateDomain: {
      const auto moved = [&](Id axis, int i) {
        return m.inputs[static_cast<std::size_t>(i)] == Node{} ? axis : sum(axis, input(i));
      };
      return evaluate(m.inputs[0], {moved(at.x, 1), moved(at.y, 2), moved(at.z, 3)});
    }
    case Kind::kScaleDomain:
      return evaluate(m.inputs[0], {scale_offset(at.x, p[0], 0), scale_offset(at.y, p[1], 0),
                                    scale_offset(at.z, p[2], 0)});
    case Kind::kCache:
      return input(0);
  }
  return kNone;
}

// The innermost region that contains both.
std::uint32_t Compiler::common(std::uint32_t a, std::uint32_t b) const {
  while (a != b) {
    std::uint32_t& deeper = regions_[a].depth >= regions_[b].depth ? a : b;
    deeper = regions_[deeper].parent;
  }
  return a;
}

// Users come after their operands: going backwards, the regions of all users of a value are known.
// A value belongs to the innermost region that contains all its uses.
void Compiler::find_regions() {
  constexpr std::uint32_t kUnused = ~std::uint32_t{0};
  regions_.assign(1, {});
  region_of_.assign(values_.size(), kUnused);
  region_of_[result_] = kRootRegion;
  for (const Id input : {input_.x, input_.y, input_.z}) region_of_[input] = kRootRegion;
  for (Id id = static_cast<Id>(values_.size()); id-- > 0;) {
    if (region_of_[id] == kUnused) continue;
    const Value& value = values_[id];
    for (int slot = 0; slot < 3; ++slot) {
      const Id operand = value.operands[static_cast<std::size_t>(slot)];
      if (operand == kNone) continue;
      std::uint32_t use = region_of_[id];
      if (mode_ != Mode::kEverySample && is_lazy(value.op, slot) && value.varies && values_[operand].varies) {
        use = static_cast<std::uint32_t>(regions_.size());
        regions_.push_back({id, slot, region_of_[id], regions_[region_of_[id]].depth + 1});
        lazy_region_[{id, slot}] = use;
      }
      std::uint32_t& region = region_of_[operand];
      region = region == kUnused ? use : common(region, use);
    }
  }
  members_.resize(regions_.size());
  for (Id id = 0; id < values_.size(); ++id) {
    if (region_of_[id] != kUnused && values_[id].varies) members_[region_of_[id]].push_back(id);
  }
}

void Compiler::assign_registers() {
  registers_.resize(values_.size());
  for (Id id = 0; id < values_.size(); ++id) {
    if (region_of_[id] == ~std::uint32_t{0}) continue;
    registers_[id] = {code_.scratch_floats, values_[id].varies ? ~std::uint32_t{0} : 0};
    code_.scratch_floats += values_[id].varies ? kBatch : kMaxLanes;
  }
  code_.x = registers_[input_.x];
  code_.y = registers_[input_.y];
  code_.z = registers_[input_.z];
  code_.result = registers_[result_];
}

Instruction Compiler::instruction(Id id) {
  const Value& v = values_[id];
  const auto reg = [&](int slot) {
    const Id operand = v.operands[static_cast<std::size_t>(slot)];
    return operand == kNone ? Operand{} : registers_[operand];
  };
  Instruction in{
      .op = v.op, .out = registers_[id], .a = reg(0), .b = reg(1), .c = reg(2), .p = v.p, .q = v.q};
  in.first = v.first;
  in.count = v.count;
  if (v.op == Op::kFbm || v.op == Op::kRidged || v.op == Op::kBillow) {
    in.along_column =
        !values_[v.operands[0]].varies && !values_[v.operands[2]].varies && values_[v.operands[1]].even;
    in.window = code_.windows;
    if (in.along_column) code_.windows += in.count;
  }
  return in;
}

// Appends the steps that bound a value, operands first; nothing when there are too many.
std::optional<std::uint32_t> Compiler::interval(Id id, std::map<Id, std::uint32_t>& known,
                                                std::vector<IntervalStep>& steps) const {
  if (const auto at = known.find(id); at != known.end()) return at->second;
  const Value& v = values_[id];
  IntervalStep step{.op = v.op, .p = v.p, .q = v.q};
  if (!v.varies) {
    step.op = Op::kConstant;
    step.a = registers_[id].offset;
  } else if (v.op == Op::kFbm || v.op == Op::kBillow || v.op == Op::kRidged || v.op == Op::kStep) {
    step.p = v.op == Op::kFbm || v.op == Op::kBillow ? -1.0F : 0.0F;
    step.q = 1.0F;
  } else {
    std::uint32_t* const operands[] = {&step.a, &step.b, &step.c};
    for (std::size_t slot = 0; slot < 3; ++slot) {
      if (v.operands[slot] == kNone) continue;
      const auto operand = interval(v.operands[slot], known, steps);
      if (!operand) return std::nullopt;
      *operands[slot] = *operand;
    }
  }
  if (steps.size() == kMaxIntervalSteps) return std::nullopt;
  steps.push_back(step);
  return known[id] = static_cast<std::uint32_t>(steps.size() - 1);
}

// The code of a lazy operand, after the jump that skips it.
void Compiler::emit_lazily(Id user, int slot) {
  const auto region = lazy_region_.find({user, slot});
  if (region == lazy_region_.end() || members_[region->second].empty()) return;
  const Value& v = values_[user];
  Instruction skip;
  if (v.op == Op::kStep) {
    std::map<Id, std::uint32_t> known;
    std::vector<IntervalStep> steps;
    if (mode_ == Mode::kPoints || !interval(v.operands[0], known, steps)) {
      emit_region(region->second);
      return;
    }
    skip.op = Op::kSkipIfDecided;
    skip.out = registers_[user];
    skip.p = v.p;
    skip.first = static_cast<std::uint32_t>(code_.intervals.size());
    skip.count = static_cast<std::uint32_t>(steps.size());
    code_.intervals.insert(code_.intervals.end(), steps.begin(), steps.end());
  } else {
    skip.op = v.op == Op::kMix && slot == 2 ? Op::kSkipIfAllOne : Op::kSkipIfAllZero;
    skip.a = registers_[v.operands[0]];
  }
  const std::size_t at = code_.batch.size();
  code_.batch.push_back(skip);
  code_.skips = true;
  emit_region(region->second);
  // A decided step also skips its own instruction, which follows the region.
  code_.batch[at].jump = static_cast<std::uint32_t>(code_.batch.size()) + (v.op == Op::kStep ? 1 : 0);
}

void Compiler::emit_region(std::uint32_t region) {
  for (const Id id : members_[region]) {
    if (values_[id].op <= Op::kInputZ) continue;
    for (int slot = 0; slot < 3; ++slot) emit_lazily(id, slot);
    code_.batch.push_back(instruction(id));
  }
}

void Compiler::emit() {
  for (Id id = 0; id < values_.size(); ++id) {
    const bool needed = region_of_[id] != ~std::uint32_t{0};
    if (needed && !values_[id].varies && values_[id].op > Op::kInputZ) code_.once.push_back(instruction(id));
  }
  emit_region(kRootRegion);
}

}  // namespace

Code compile(const Graph& graph, Node root, Mode mode) { return Compiler(graph, mode).compile(root); }

}  // namespace terrabench::noise
