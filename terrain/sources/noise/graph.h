// A graph of noise modules, with the names of the library that the hybrid paper builds its terrain from
// (§3.1.3; Tippetts' Accidental Noise Library). A graph is a flat array of nodes, a handle is an index into
// it, operands come before what uses them. Building is cheap; Program (program.h) evaluates it.
//
// Coordinates are metres. A coordinate that is not finite, or at least 2^30 in magnitude (in lattice cells),
// counts as 0 inside a fractal; elsewhere NaN follows IEEE rules, and a comparison with NaN is false.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <string>
#include <vector>

namespace terrabench::noise {

enum class Kind : std::uint8_t {
  kConstant,
  kGradient,
  kFbm,
  kRidgedMultifractal,
  kBillow,
  kClamp,
  kSelect,
  kScaleOffset,
  kBias,
  kAdd,
  kMultiply,
  kTranslateDomain,
  kScaleDomain,
  kCache
};

// Octave i has frequency·lacunarity^i cells per metre and the weight gain^i. Each octave's lattice is shifted
// by an offset drawn from the seed; otherwise the zeros of all octaves would coincide at whole coordinates.
struct Fractal {
  std::uint64_t seed = 0;
  float frequency = 1.0F;  // cells per metre of the first octave, finite and > 0
  int octaves = 6;         // 1 … 24 (kMaxOctaves)
  float lacunarity = 2.0F;
  float gain = 0.5F;
  bool operator==(const Fractal&) const = default;
};

struct Node {
  std::uint32_t index = std::numeric_limits<std::uint32_t>::max();
  bool operator==(const Node&) const = default;
};

// One node as stored. The kind decides which fields are used.
struct Module {
  Kind kind = Kind::kConstant;
  std::array<Node, 4> inputs{};       // in the order of the builder's parameters
  std::array<float, 4> parameters{};  // likewise
  Fractal fractal{};
  bool operator==(const Module&) const = default;
};

class Graph {
 public:
  Node constant(float value);

  // ((p - from)·(to - from)) / |to - from|²: 0 in the plane through `from`, 1 in that through `to`, unbounded
  // beyond. The two differ.
  Node gradient(glm::vec3 from, glm::vec3 to);

  // Σ wᵢ nᵢ / Σ wᵢ of gradient noise n (Perlin 2002), wᵢ = gainⁱ. Range [-1, 1], mean 0.
  Node fbm(const Fractal&);
  // Σ wᵢ sᵢ mᵢ / Σ wᵢ with sᵢ = (1 - |nᵢ|)², m₀ = 1, mᵢ = clamp(2·sᵢ₋₁·mᵢ₋₁, 0, 1) (Musgrave 1994): crests,
  // where noise crosses zero, keep their detail, valleys are smooth. Range [0, 1]; 1 on a crest of all
  // octaves.
  Node ridged_multifractal(const Fractal&);
  // Σ wᵢ (2|nᵢ| - 1) / Σ wᵢ: round hills with creases between. Range [-1, 1].
  Node billow(const Fractal&);

  // min(max(source, low), high), low ≤ high.
  Node clamp(Node source, float low, float high);
  // low where control < threshold, else high. The other is not evaluated, and its value, NaN included, does
  // not matter.
  Node select(Node low, Node high, Node control, float threshold);

  // source·scale + offset.
  Node scale_offset(Node source, float scale, float offset);
  // Schlick's bias of t = clamp(source, 0, 1): t / ((1/bias - 2)(1 - t) + 1), bias in (0, 1). Range [0, 1],
  // keeps 0 and 1, maps 1/2 to bias. The rational form instead of a power: it is exact on every machine.
  Node bias(Node source, float bias);

  Node add(Node a, Node b);
  // a·b, and 0 where the mask a is 0, whatever b (NaN included): there b is not evaluated.
  Node multiply(Node mask, Node b);

  // Samples the source at (x + dx, y + dy, z + dz). A handle without a node is an offset of 0. The offsets
  // are sampled at (x, y, z).
  Node translate_domain(Node source, Node dx, Node dy = {}, Node dz = {});
  // Samples the source at (x·sx, y·sy, z·sz). A scale of 0 makes the source constant along that axis.
  Node scale_domain(Node source, float sx, float sy, float sz);

  // The value of the source, unchanged: a hint that it is used more than once. The compiler evaluates equal
  // expressions at equal coordinates once with or without it.
  Node cache(Node source);

  const std::vector<Module>& modules() const { return modules_; }
  // One line per node with all parameters, floats exact: graphs with equal texts have equal values.
  std::string describe() const;

 private:
  Node add_module(const Module&);
  Node add_fractal(Kind, const Fractal&);

  std::vector<Module> modules_;
};

}  // namespace terrabench::noise
