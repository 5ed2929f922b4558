// Evaluates a noise graph (graph.h): compiled once to a flat register program, then run over batches of
// samples.
//  - Equal expressions at equal coordinates are evaluated once (hash consing while compiling).
//  - Expressions that are constant along a column are evaluated once per column.
//  - Operands of multiply, select and blend that a whole batch does not need are skipped; so is the control
//  of
//    a select that interval bounds decide. Skipping never changes a value.
//  - SIMD on the best instruction set of the machine, bit-identical on all of them, for columns and points.
// Compiling is O(nodes), a few microseconds. Evaluation allocates nothing after a thread's first call.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "terrain/solid.h"
#include "terrain/sources/noise/code.h"
#include "terrain/sources/noise/graph.h"

namespace terrabench::noise {

// An image of the vertical plane at `z`: pixel (i, j) lies at (x0 + i·dx, y0 + j·dy), rows bottom up.
struct Slice {
  float x0 = 0, y0 = 0, dx = 1, dy = 1, z = 0;
  int width = 0, height = 0;
};

// The values are the same; the time is not.
enum class Evaluation : std::uint8_t {
  kWhereNeeded,  // shares work along a column and skips what bounds decide
  kEverySample   // evaluates every module at every sample of a column, as a plain noise library does
};

class Program {
 public:
  Program(const Graph& graph, Node root, Evaluation = Evaluation::kWhereNeeded);

  // Values at (x, y0 + i·dy, z), i = 0 … out.size() - 1. Thread-safe, as are all below.
  void column(const ColumnSamples& samples, std::span<float> out) const;
  // Values at (x[i], y[i], z[i]); all four have one length.
  void points(std::span<const float> x, std::span<const float> y, std::span<const float> z,
              std::span<float> out) const;
  // width·height values, row-major.
  void slice(const Slice& slice, std::span<float> out) const;

 private:
  Evaluation evaluation_;
  Code column_, points_;
};

// The instruction set in use, by Highway's name: "AVX3", "AVX2", "SSE4", …
std::string_view simd_name();

}  // namespace terrabench::noise
