// The flat register program that a noise graph is compiled to, shared by the compiler (compiler.cpp) and the
// per-instruction-set machine (machine.cpp). Registers are runs of floats in one scratch array: kMaxLanes
// equal values for what is constant along a column, kBatch values for what varies.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "terrain/sources/noise/lattice.h"

namespace terrabench::noise {

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

struct Octave {
  std::uint32_t seed = 0;
  float frequency = 1;
  float offset_x = 0, offset_y = 0, offset_z = 0;
  float weight = 1;  // gain^i, divided by the sum of all of the fractal
};

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

// Evaluates `count` samples into `out`.
void execute(const Code& code, const Samples& samples, const Scratch& scratch, float* out, std::size_t count);

}  // namespace terrabench::noise
