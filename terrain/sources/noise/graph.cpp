#include "terrain/sources/noise/graph.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cassert>
#include <cmath>
#include <string_view>

#include "terrain/sources/noise/code.h"
#include "terrain/splitmix.h"

namespace terrabench::noise {
namespace {

constexpr std::string_view kKindNames[] = {"constant",     "gradient", "fbm",      "ridged_multifractal",
                                           "billow",       "clamp",    "select",   "scale_offset",
                                           "bias",         "add",      "multiply", "translate_domain",
                                           "scale_domain", "cache"};

}  // namespace

Node Graph::add_module(const Module& module) {
  for (const Node input : module.inputs) {
    assert(input == Node{} || input.index < modules_.size());
    (void)input;
  }
  modules_.push_back(module);
  return {static_cast<std::uint32_t>(modules_.size() - 1)};
}

Node Graph::add_fractal(Kind kind, const Fractal& fractal) {
  assert(fractal.octaves >= 1 && fractal.octaves <= 24);
  assert(std::isfinite(fractal.frequency) && fractal.frequency > 0);
  assert(std::isfinite(fractal.lacunarity) && fractal.lacunarity > 0);
  assert(std::isfinite(fractal.gain) && fractal.gain > 0);
  return add_module({kind, {}, {}, fractal});
}

Node Graph::constant(float value) { return add_module({Kind::kConstant, {}, {value}, {}}); }

Node Graph::gradient(glm::vec3 from, glm::vec3 to) {
  assert(from != to);
  const glm::vec3 d = to - from;
  const float squared = d.x * d.x + d.y * d.y + d.z * d.z;
  const float offset = -(from.x * d.x + from.y * d.y + from.z * d.z) / squared;
  return add_module({Kind::kGradient, {}, {d.x / squared, d.y / squared, d.z / squared, offset}, {}});
}

Node Graph::fbm(const Fractal& fractal) { return add_fractal(Kind::kFbm, fractal); }
Node Graph::ridged_multifractal(const Fractal& fractal) {
  return add_fractal(Kind::kRidgedMultifractal, fractal);
}
Node Graph::billow(const Fractal& fractal) { return add_fractal(Kind::kBillow, fractal); }

Node Graph::clamp(Node source, float low, float high) {
  assert(low <= high);
  return add_module({Kind::kClamp, {source}, {low, high}, {}});
}

Node Graph::select(Node low, Node high, Node control, float threshold) {
  return add_module({Kind::kSelect, {low, high, control}, {threshold}, {}});
}

Node Graph::scale_offset(Node source, float scale, float offset) {
  return add_module({Kind::kScaleOffset, {source}, {scale, offset}, {}});
}

Node Graph::bias(Node source, float bias) {
  assert(bias > 0 && bias < 1);
  return add_module({Kind::kBias, {source}, {bias}, {}});
}

Node Graph::add(Node a, Node b) { return add_module({Kind::kAdd, {a, b}, {}, {}}); }
Node Graph::multiply(Node mask, Node b) { return add_module({Kind::kMultiply, {mask, b}, {}, {}}); }

Node Graph::translate_domain(Node source, Node dx, Node dy, Node dz) {
  return add_module({Kind::kTranslateDomain, {source, dx, dy, dz}, {}, {}});
}

Node Graph::scale_domain(Node source, float sx, float sy, float sz) {
  return add_module({Kind::kScaleDomain, {source}, {sx, sy, sz}, {}});
}

Node Graph::cache(Node source) { return add_module({Kind::kCache, {source}, {}, {}}); }

std::string Graph::describe() const {
  std::string text;
  for (std::size_t i = 0; i < modules_.size(); ++i) {
    const Module& m = modules_[i];
    text += fmt::format("{} = {}", i, kKindNames[static_cast<std::size_t>(m.kind)]);
    for (const Node input : m.inputs) {
      text += input == Node{} ? std::string(" -") : fmt::format(" @{}", input.index);
    }
    text += fmt::format(" {}", fmt::join(m.parameters, " "));
    const Fractal& f = m.fractal;
    text += fmt::format(" | {} {} {} {} {}\n", f.seed, f.frequency, f.octaves, f.lacunarity, f.gain);
  }
  return text;
}

namespace {

// In [0, 256), in steps of 1/256: far apart, and so coarse that adding one loses few bits of a coordinate.
float lattice_offset(SplitMix& random) { return static_cast<float>(random.next() >> 48) / 256.0F; }

}  // namespace

std::vector<Octave> octaves(const Fractal& f) {
  std::vector<Octave> drawn;
  SplitMix random(f.seed);
  Octave octave{.frequency = f.frequency};
  float total = 0;
  for (int i = 0; i < f.octaves; ++i) {
    octave.seed = static_cast<std::uint32_t>(random.next());
    octave.offset_x = lattice_offset(random);
    octave.offset_y = lattice_offset(random);
    octave.offset_z = lattice_offset(random);
    drawn.push_back(octave);
    total += octave.weight;
    octave.frequency *= f.lacunarity;
    octave.weight *= f.gain;
  }
  // A sum of rounded weights may exceed 1 by half an ulp per octave; the range that graph.h promises, and
  // that bounds rely on, must hold exactly.
  constexpr float kRoom = 1.0F - 2e-6F;
  for (Octave& each : drawn) each.weight = each.weight / total * kRoom;
  return drawn;
}

}  // namespace terrabench::noise
