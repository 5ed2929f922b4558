#include "terrain/sources/noise/program.h"

#include <cassert>
#include <memory>
#include <new>
#include <vector>

#include "terrain/sources/noise/compiler.h"

namespace terrabench::noise {
namespace {

constexpr std::align_val_t kAlignment{64};  // of the widest vector

struct Release {
  void operator()(float* block) const { ::operator delete[](block, kAlignment); }
};

// The thread's registers, as many as the largest program needed so far.
float* scratch(std::size_t floats) {
  thread_local std::unique_ptr<float[], Release> block;
  thread_local std::size_t size = 0;
  if (size < floats) {
    block.reset(new (kAlignment) float[floats]());
    size = floats;
  }
  return block.get();
}

}  // namespace

Program::Program(const Graph& graph, Node root)
    : column_(compile(graph, root, Mode::kColumn)), points_(compile(graph, root, Mode::kPoints)) {}

void Program::column(const ColumnSamples& at, std::span<float> out) const {
  const Samples samples{.column = true, .x = at.x, .z = at.z, .y0 = at.y0, .dy = at.dy};
  execute(column_, samples, scratch(column_.scratch_floats), out.data(), out.size());
}

void Program::points(std::span<const float> x, std::span<const float> y, std::span<const float> z,
                     std::span<float> out) const {
  assert(x.size() == out.size() && y.size() == out.size() && z.size() == out.size());
  const Samples samples{.xs = x.data(), .ys = y.data(), .zs = z.data()};
  execute(points_, samples, scratch(points_.scratch_floats), out.data(), out.size());
}

void Program::slice(const Slice& s, std::span<float> out) const {
  assert(out.size() == static_cast<std::size_t>(s.width) * static_cast<std::size_t>(s.height));
  std::vector<float> values(static_cast<std::size_t>(s.height));
  for (int i = 0; i < s.width; ++i) {
    column({s.x0 + static_cast<float>(i) * s.dx, s.z, s.y0, s.dy}, values);
    for (std::size_t j = 0; j < values.size(); ++j) {
      out[j * static_cast<std::size_t>(s.width) + static_cast<std::size_t>(i)] = values[j];
    }
  }
}

}  // namespace terrabench::noise
