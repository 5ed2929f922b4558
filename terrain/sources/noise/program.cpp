#include "terrain/sources/noise/program.h"

#include <cassert>
#include <vector>

namespace terrabench::noise {
namespace {

struct alignas(64) Registers {
  float values[kMaxLanes];
};

// The thread's own scratch, as large as the largest program run so far needs.
Scratch scratch(const Code& code) {
  thread_local std::vector<Registers> registers;
  thread_local std::vector<PlaneWindow> windows;
  const std::size_t blocks = code.scratch_floats / kMaxLanes;
  if (registers.size() < blocks) registers.resize(blocks);
  if (windows.size() < code.windows) windows.resize(code.windows);
  return {reinterpret_cast<float*>(registers.data()), windows.data()};
}

}  // namespace

Program::Program(const Graph& graph, Node root, Evaluation evaluation)
    : evaluation_(evaluation),
      column_(
          compile(graph, root, evaluation == Evaluation::kEverySample ? Mode::kEverySample : Mode::kColumn)),
      points_(compile(graph, root, Mode::kPoints)) {}

void Program::column(const ColumnSamples& at, std::span<float> out) const {
  if (evaluation_ == Evaluation::kEverySample) {
    thread_local std::vector<float> x, y, z;
    x.assign(out.size(), at.x);
    z.assign(out.size(), at.z);
    y.resize(out.size());
    for (std::size_t i = 0; i < y.size(); ++i) y[i] = at.y0 + static_cast<float>(i) * at.dy;
    const Samples samples{.xs = x.data(), .ys = y.data(), .zs = z.data()};
    return execute(column_, samples, scratch(column_), out.data(), out.size());
  }
  const Samples samples{.column = true, .x = at.x, .z = at.z, .y0 = at.y0, .dy = at.dy};
  execute(column_, samples, scratch(column_), out.data(), out.size());
}

void Program::points(std::span<const float> x, std::span<const float> y, std::span<const float> z,
                     std::span<float> out) const {
  assert(x.size() == out.size() && y.size() == out.size() && z.size() == out.size());
  const Samples samples{.xs = x.data(), .ys = y.data(), .zs = z.data()};
  execute(points_, samples, scratch(points_), out.data(), out.size());
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
