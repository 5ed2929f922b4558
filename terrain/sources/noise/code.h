// The flat register program that a noise graph is compiled to, shared by the compiler and the
// per-instruction-set machine. Registers are runs of floats in one scratch array: kMaxLanes
// equal values for what is constant along a column, kBatch values for what varies.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "terrain/sources/noise/graph.h"

namespace terrabench::noise {

// The gradient noise lattice. Odd multipliers that spread the three lattice coordinates over 32 bits before
// they are combined.
inline constexpr std::uint32_t kLatticeX = 0x9E3779B1U, kLatticeY = 0x85EBCA77U, kLatticeZ = 0xC2B2AE3DU;
// Multipliers after each of the two xor-shifts of the lattice hash.
inline constexpr std::uint32_t kMixXz = 0x7FEB352DU, kMixY = 0x846CA68BU;
// A third of the 29 hash bits that choose a gradient's zero component.
inline constexpr std::int32_t kThird = 0x0AAAAAAA;

// Coordinates of at least this magnitude count as 0: their cell would not fit 32 bits.
inline constexpr float kLatticeLimit = 1073741824.0F;  // 2^30

// 1 / (the largest value of the sum of corner weights times the best gradient's product, 1.0363538), rounded
// down so that float rounding cannot leave [-1, 1].
inline constexpr float kNormalise = 0.96492F;

// Shared lattice planes are used where y fits exactly and a batch has at least this many samples per cell:
// making a plane costs half a sample's noise, and finding a sample's plane costs more the more planes a
// vector spans.
inline constexpr float kPlaneLimit = 4194304.0F;  // 2^22
inline constexpr float kPlaneCost = 1.5F;

inline constexpr std::uint32_t kMaxLanes = 16;  // lanes of the widest vector used
inline constexpr std::uint32_t kMaxOctaves = 24;
// Samples evaluated at a time. A program with jumps takes a share of the column, within limits, so that the
// parts that it skips depend on the terrain and not on the resolution; one without takes as many as the
// registers hold.
inline constexpr std::uint32_t kBatch = 256;
inline constexpr std::uint32_t kBatchToSkip = 64;
inline constexpr std::uint32_t kBatchesPerColumn = 8;

enum class Op : std::uint8_t {
  kInputX,
  kInputY,
  kInputZ,
  kConstant,
  kScaleOffset,  // a·p + q
  kAdd,
  kMultiply,  // 0 where a is 0, else a·b
  kClamp,     // to [p, q]
  kStep,      // 0 below p, 1 from p on
  kMix,       // c where a is 0, b where it is 1
  kBias,
  kFbm,
  kRidged,
  kBillow,
  // Jumps, to the instruction `jump`.
  kSkipIfAllZero,
  kSkipIfAllOne,
  kSkipIfDecided  // fills register `out` when bounds show that a kStep is all 0 or all 1
};

// Sample i of an operand is scratch[offset + (i & mask)].
struct Operand {
  std::uint32_t offset = 0;
  std::uint32_t mask = 0;  // 0: constant along the column, else all ones
};

struct Instruction {
  Op op = Op::kConstant;
  bool along_column = false;  // fractal with constant x and z and evenly spaced y
  std::uint32_t window = 0;   // its first PlaneWindow, one per octave
  Operand out, a, b, c;
  float p = 0, q = 0;
  std::uint32_t first = 0, count = 0;  // octaves of a fractal, or interval steps of kSkipIfDecided
  std::uint32_t jump = 0;
};

// One octave of a fractal: seed and offsets are drawn from the fractal's seed.
struct Octave {
  std::uint32_t seed = 0;
  float frequency = 1;
  float offset_x = 0, offset_y = 0, offset_z = 0;
  float weight = 1;  // gain^i, divided by the sum of all of the fractal
};

std::vector<Octave> octaves(const Fractal&);

// Interval arithmetic on one batch: step i computes interval i from earlier ones, the last is the control's.
struct IntervalStep {
  Op op = Op::kConstant;
  std::uint32_t a = 0, b = 0, c = 0;  // earlier steps; or a = scratch offset for a value known (kConstant)
  float p = 0, q = 0;                 // for fractals: the range
};
inline constexpr std::uint32_t kMaxIntervalSteps = 64;

struct Code {
  std::vector<Instruction> once;   // run once per column, for what is constant along it
  std::vector<Instruction> batch;  // run for each batch
  std::vector<IntervalStep> intervals;
  std::vector<Octave> octaves;
  Operand x, y, z, result;
  std::uint32_t scratch_floats = 0;
  std::uint32_t windows = 0;
  bool skips = false;  // whether `batch` has jumps
};

// Lattice planes of one octave of noise along the current column, which gradient_noise_inl.h computes once
// for all samples between the same planes.
struct alignas(64) PlaneWindow {
  static constexpr std::uint32_t kSize =
      (static_cast<std::uint32_t>(kBatch / kPlaneCost) + 5 + kMaxLanes - 1) / kMaxLanes * kMaxLanes;
  float a[kSize], b[kSize];
  std::int32_t base = 0;    // cell height of the first
  std::uint32_t count = 0;  // 0: none computed
};

// A program's memory. Registers are aligned to 64 bytes.
struct Scratch {
  float* registers = nullptr;      // Code::scratch_floats
  PlaneWindow* windows = nullptr;  // Code::windows
};

// The positions of the samples: a column (x, z, y0, dy), or arrays.
struct Samples {
  bool column = false;
  float x = 0, z = 0, y0 = 0, dy = 0;
  const float *xs = nullptr, *ys = nullptr, *zs = nullptr;
};

enum class Mode {
  kColumn,
  kPoints,
  kEverySample  // points, without jumps: every instruction runs for every sample
};
Code compile(const Graph& graph, Node root, Mode mode);  // compiler.cpp

struct Interval {
  float low = 0, high = 0;
};
// 0 or 1 when kStep(control, p) has that value everywhere in a batch of a column, -1 when the bounds do not
// decide. Tens of nanoseconds. (intervals.cpp)
int decide_step(std::span<const IntervalStep> steps, const float* scratch, Interval y, float p);

// Evaluates `count` samples into `out`. (machine.cpp)
void execute(const Code& code, const Samples& samples, const Scratch& scratch, float* out, std::size_t count);

}  // namespace terrabench::noise
