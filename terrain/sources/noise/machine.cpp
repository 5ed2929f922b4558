// Runs compiled noise programs: one interpreter, compiled for each instruction set, chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "terrain/sources/noise/machine.cpp"
#include <hwy/foreach_target.h>  // re-includes this file for each target
#include <hwy/highway.h>

#include "terrain/sources/noise/gradient_noise_inl.h"
#include "terrain/sources/noise/program.h"

HWY_BEFORE_NAMESPACE();
namespace terrabench::noise {
namespace HWY_NAMESPACE {

struct Machine {
  const Code& code;
  float* scratch;
  PlaneWindow* windows;
  std::uint32_t count;  // samples of the current batch, rounded up to whole vectors

  VF load(const Operand& operand, std::uint32_t at) const {
    return hn::Load(F(), scratch + operand.offset + (at & operand.mask));
  }
  // out[i] = function(i), vector by vector. Constants along the column fill kMaxLanes values.
  template <class Function>
  HWY_INLINE void each(const Operand& out, const Function& function) const {
    float* const to = scratch + out.offset;
    const std::uint32_t n = out.mask == 0 ? kMaxLanes : count;
    for (std::uint32_t i = 0; i < n; i += static_cast<std::uint32_t>(hn::Lanes(F()))) {
      hn::Store(function(i), F(), to + i);
    }
  }
};

// min and max of x86 and ARM differ for NaN; comparisons do not.
HWY_INLINE VF clamp(VF v, VF low, VF high) {
  v = hn::IfThenElse(hn::Lt(v, low), low, v);
  return hn::IfThenElse(hn::Gt(v, high), high, v);
}

HWY_INLINE VF clamp01(VF v) { return clamp(v, hn::Zero(F()), hn::Set(F(), 1.0F)); }

// p = 1/bias - 2.
HWY_INLINE VF schlick_bias(VF t, VF p) {
  const VF one = hn::Set(F(), 1.0F);
  return hn::Div(t, hn::Add(hn::Mul(p, hn::Sub(one, t)), one));
}

// Noise of octave `k` of a fractal for the whole batch.
HWY_NOINLINE void octave_noise(const Machine& m, const Instruction& in, std::uint32_t k, std::uint32_t n,
                               float* HWY_RESTRICT out) {
  const Octave& octave = m.code.octaves[in.first + k];
  const F f;
  const auto lanes = static_cast<std::uint32_t>(hn::Lanes(f));
  const VF frequency = hn::Set(f, octave.frequency), ox = hn::Set(f, octave.offset_x);
  const VF oy = hn::Set(f, octave.offset_y), oz = hn::Set(f, octave.offset_z);
  if (in.along_column) {
    alignas(64) float y[kBatch];
    for (std::uint32_t i = 0; i < n; i += lanes) {
      hn::Store(hn::Add(hn::Mul(m.load(in.b, i), frequency), oy), f, y + i);
    }
    const VF x = hn::Add(hn::Mul(m.load(in.a, 0), frequency), ox);
    const VF z = hn::Add(hn::Mul(m.load(in.c, 0), frequency), oz);
    if (gradient_noise_along_y(x, y, z, octave.seed, n, m.windows[in.window + k], out)) return;
  }
  for (std::uint32_t i = 0; i < n; i += lanes) {
    const VF x = hn::Add(hn::Mul(m.load(in.a, i), frequency), ox);
    const VF y = hn::Add(hn::Mul(m.load(in.b, i), frequency), oy);
    const VF z = hn::Add(hn::Mul(m.load(in.c, i), frequency), oz);
    hn::Store(gradient_noise(x, y, z, hn::Set(U(), octave.seed)), f, out + i);
  }
}

// Noise of all octaves of a fractal that is constant along the column: one octave per lane, instead of equal
// lanes.
HWY_NOINLINE void constant_octaves(const Machine& m, const Instruction& in, float* HWY_RESTRICT out) {
  const F f;
  const auto lanes = static_cast<std::uint32_t>(hn::Lanes(f));
  alignas(64) float x[kMaxLanes], y[kMaxLanes], z[kMaxLanes];
  alignas(64) std::uint32_t seed[kMaxLanes];
  for (std::uint32_t first = 0; first < in.count; first += lanes) {
    for (std::uint32_t i = 0; i < lanes; ++i) {
      const std::uint32_t k = first + i < in.count ? first + i : in.count - 1;
      const Octave& octave = m.code.octaves[in.first + k];
      x[i] = m.scratch[in.a.offset] * octave.frequency + octave.offset_x;
      y[i] = m.scratch[in.b.offset] * octave.frequency + octave.offset_y;
      z[i] = m.scratch[in.c.offset] * octave.frequency + octave.offset_z;
      seed[i] = octave.seed;
    }
    hn::Store(gradient_noise(hn::Load(f, x), hn::Load(f, y), hn::Load(f, z), hn::Load(U(), seed)), f,
              out + first);
  }
}

// Adds octave `k` of a fractal, given its noise, to the running sum in `out`.
HWY_INLINE void accumulate(Op op, bool first, float weight, std::uint32_t n, const float* HWY_RESTRICT noise,
                           float* HWY_RESTRICT feedback, float* HWY_RESTRICT out) {
  const F f;
  const VF one = hn::Set(f, 1.0F), w = hn::Set(f, weight);
  for (std::uint32_t i = 0; i < n; i += static_cast<std::uint32_t>(hn::Lanes(f))) {
    VF signal = hn::Load(f, noise + i);
    if (op == Op::kBillow) signal = hn::Sub(hn::Mul(hn::Abs(signal), hn::Set(f, 2.0F)), one);
    if (op == Op::kRidged) {
      const VF ridge = hn::Sub(one, hn::Abs(signal));
      signal = hn::Mul(ridge, ridge);
      if (!first) signal = hn::Mul(signal, hn::Load(f, feedback + i));
      hn::Store(clamp01(hn::Add(signal, signal)), f, feedback + i);
    }
    const VF term = hn::Mul(signal, w);
    hn::Store(first ? term : hn::Add(hn::Load(f, out + i), term), f, out + i);
  }
}

HWY_NOINLINE void fractal(const Machine& m, const Instruction& in) {
  alignas(64) float noise[kBatch], feedback[kBatch];
  const bool constant = in.out.mask == 0;
  const std::uint32_t n = constant ? kMaxLanes : m.count;
  float* const out = m.scratch + in.out.offset;
  alignas(64) float octaves[kMaxOctaves + kMaxLanes];
  if (constant) constant_octaves(m, in, octaves);
  for (std::uint32_t k = 0; k < in.count; ++k) {
    if (constant) {
      for (std::uint32_t i = 0; i < n; ++i) noise[i] = octaves[k];
    } else {
      octave_noise(m, in, k, n, noise);
    }
    accumulate(in.op, k == 0, m.code.octaves[in.first + k].weight, n, noise, feedback, out);
  }
}

HWY_INLINE bool all_equal(const Machine& m, const Operand& a, float value) {
  const F f;
  const std::uint32_t n = a.mask == 0 ? 1 : m.count;
  for (std::uint32_t i = 0; i < n; i += static_cast<std::uint32_t>(hn::Lanes(f))) {
    if (!hn::AllTrue(f, hn::Eq(m.load(a, i), hn::Set(f, value)))) return false;
  }
  return true;
}

// 0 or 1 when bounds of the control show that the step is that for the whole batch, else -1.
HWY_INLINE int decided(const Machine& m, const Instruction& in) {
  const float first = m.scratch[m.code.y.offset], last = m.scratch[m.code.y.offset + m.count - 1];
  const Interval y = first < last ? Interval{first, last} : Interval{last, first};
  return decide_step(std::span(m.code.intervals).subspan(in.first, in.count), m.scratch, y, in.p);
}

void run(const Machine& m, std::span<const Instruction> program) {
  const F f;
  const VF zero = hn::Zero(f), one = hn::Set(f, 1.0F);
  for (std::size_t at = 0; at < program.size(); ++at) {
    const Instruction& in = program[at];
    const VF p = hn::Set(f, in.p), q = hn::Set(f, in.q);
    switch (in.op) {
      case Op::kInputX:
      case Op::kInputY:
      case Op::kInputZ:
        break;  // filled before the program runs
      case Op::kConstant:
        m.each(in.out, [&](std::uint32_t) { return p; });
        break;
      case Op::kScaleOffset:
        m.each(in.out, [&](std::uint32_t i) { return hn::Add(hn::Mul(m.load(in.a, i), p), q); });
        break;
      case Op::kAdd:
        m.each(in.out, [&](std::uint32_t i) { return hn::Add(m.load(in.a, i), m.load(in.b, i)); });
        break;
      case Op::kMultiply:
        m.each(in.out, [&](std::uint32_t i) {
          const VF a = m.load(in.a, i);
          return hn::IfThenZeroElse(hn::Eq(a, zero), hn::Mul(a, m.load(in.b, i)));
        });
        break;
      case Op::kClamp:
        m.each(in.out, [&](std::uint32_t i) { return clamp(m.load(in.a, i), p, q); });
        break;
      case Op::kStep:
        // NaN gives 0.
        m.each(in.out, [&](std::uint32_t i) { return hn::IfThenElseZero(hn::Ge(m.load(in.a, i), p), one); });
        break;
      case Op::kMix:
        m.each(in.out, [&](std::uint32_t i) {
          return hn::IfThenElse(hn::Eq(m.load(in.a, i), zero), m.load(in.c, i), m.load(in.b, i));
        });
        break;
      case Op::kBias:
        m.each(in.out, [&](std::uint32_t i) { return schlick_bias(clamp01(m.load(in.a, i)), p); });
        break;
      case Op::kFbm:
      case Op::kRidged:
      case Op::kBillow:
        fractal(m, in);
        break;
      case Op::kSkipIfAllZero:
        if (all_equal(m, in.a, 0.0F)) at = in.jump - 1;
        break;
      case Op::kSkipIfAllOne:
        if (all_equal(m, in.a, 1.0F)) at = in.jump - 1;
        break;
      case Op::kSkipIfDecided:
        if (const int value = decided(m, in); value >= 0) {
          m.each(in.out, [&](std::uint32_t) { return value == 0 ? zero : one; });
          at = in.jump - 1;
        }
        break;
    }
  }
}

// Fills the input registers for samples [begin, begin + n), up to whole vectors: a column continues past
// its end, arrays repeat their last sample.
void fill_inputs(const Machine& m, const Samples& samples, std::size_t begin, std::uint32_t n) {
  const Code& code = m.code;
  if (samples.column) {
    const F f;
    const VF y0 = hn::Set(f, samples.y0), dy = hn::Set(f, samples.dy);
    m.each(code.y, [&](std::uint32_t i) {
      const VI at = hn::Iota(I(), static_cast<std::int32_t>(begin + i));
      return hn::Add(y0, hn::Mul(hn::ConvertTo(f, at), dy));
    });
    return;
  }
  for (std::uint32_t i = 0; i < m.count; ++i) {
    const std::size_t at = begin + (i < n ? i : n - 1);
    m.scratch[code.x.offset + i] = samples.xs[at];
    m.scratch[code.y.offset + i] = samples.ys[at];
    m.scratch[code.z.offset + i] = samples.zs[at];
  }
}

std::uint32_t batch_size(const Code& code, std::size_t count) {
  if (!code.skips) return kBatch;
  const std::size_t share = (count / kBatchesPerColumn + kMaxLanes - 1) / kMaxLanes * kMaxLanes;
  return static_cast<std::uint32_t>(share < kMaxLanes      ? kMaxLanes
                                    : share > kBatchToSkip ? kBatchToSkip
                                                           : share);
}

void execute_here(const Code& code, const Samples& samples, const Scratch& scratch, float* out,
                  std::size_t count) {
  const auto lanes = static_cast<std::uint32_t>(hn::Lanes(F()));
  Machine m{code, scratch.registers, scratch.windows, kMaxLanes};
  for (std::uint32_t k = 0; k < code.windows; ++k) m.windows[k].count = 0;
  if (samples.column) {
    m.each(code.x, [&](std::uint32_t) { return hn::Set(F(), samples.x); });
    m.each(code.z, [&](std::uint32_t) { return hn::Set(F(), samples.z); });
  }
  run(m, code.once);
  const std::uint32_t batch = batch_size(code, count);
  for (std::size_t begin = 0; begin < count; begin += batch) {
    const auto n = static_cast<std::uint32_t>(count - begin < batch ? count - begin : batch);
    m.count = (n + lanes - 1) / lanes * lanes;
    fill_inputs(m, samples, begin, n);
    run(m, code.batch);
    for (std::uint32_t i = 0; i < n; ++i) {
      out[begin + i] = m.scratch[code.result.offset + (i & code.result.mask)];
    }
  }
}

const char* target_name() { return hwy::TargetName(HWY_TARGET); }

}  // namespace HWY_NAMESPACE
}  // namespace terrabench::noise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace terrabench::noise {

HWY_EXPORT(execute_here);
HWY_EXPORT(target_name);

void execute(const Code& code, const Samples& samples, const Scratch& scratch, float* out,
             std::size_t count) {
  HWY_DYNAMIC_DISPATCH(execute_here)(code, samples, scratch, out, count);
}

std::string_view simd_name() { return HWY_DYNAMIC_DISPATCH(target_name)(); }

}  // namespace terrabench::noise
#endif
