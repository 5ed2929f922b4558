// Random places, and how long structures take to answer there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "experiments/stopwatch.h"
#include "representations/representation.h"

namespace terrabench::cross {

// Random numbers, the same on every machine.
class Numbers {
 public:
  explicit Numbers(std::uint64_t seed) : random_(static_cast<std::mt19937::result_type>(seed)) {}
  float between(float low, float high) {
    return low + (high - low) * 0x1p-24F * static_cast<float>(random_() >> 8);
  }
  std::size_t below(std::size_t n) { return random_() % n; }

 private:
  std::mt19937 random_;
};

// Random places in the middle `share` of the sides of a structure's bounds.
class Places {
 public:
  Places(const Bounds& bounds, double share, Numbers& numbers)
      : bounds_(bounds), margin_(0.5F * static_cast<float>(1 - share) * bounds.size()), numbers_(numbers) {}

  // As many as the spans have room for.
  void columns(std::span<float> x, std::span<float> z) { fill(x, 0), fill(z, 2); }
  // At any height.
  void points(std::span<float> x, std::span<float> y, std::span<float> z) { columns(x, z), fill(y, 1); }

 private:
  void fill(std::span<float> all, int axis) {
    const float low = bounds_.low[axis] + margin_[axis], high = bounds_.high[axis] - margin_[axis];
    for (float& one : all) one = numbers_.between(low, high);
  }

  Bounds bounds_;
  glm::vec3 margin_;
  Numbers& numbers_;
};

inline constexpr int kBatch = 1024;  // places or rays per call

// Processor seconds on one thread per item of batches of kBatch: 64 batches, or as many as take 0.05 s.
// next() chooses what work() then does. The first batch is not counted; no batch repeats another.
template <class Next, class Work>
double seconds_per_item(const Next& next, const Work& work) {
  constexpr int kMost = 1 << 16;
  constexpr double kEnough = 0.05;
  double spent = 0;
  int done = -kBatch;
  while (done < kMost && spent < kEnough) {
    next();
    const double taken = processor_seconds(work);
    if (done >= 0) spent += taken;
    done += kBatch;
  }
  return spent / done;
}

inline double seconds_per_column(const Representation& structure, Places places) {
  std::vector<float> x(kBatch), z(kBatch);
  SpanSink sink;
  return seconds_per_item([&] { places.columns(x, z); },
                          [&] {
                            sink.clear();
                            structure.spans({x, z}, sink);
                          });
}

inline double seconds_per_point(const Representation& structure, Places places) {
  std::vector<float> x(kBatch), y(kBatch), z(kBatch);
  std::vector<Material> materials(kBatch);
  return seconds_per_item([&] { places.points(x, y, z); },
                          [&] {
                            structure.materials({x, y, z}, materials);
                          });
}

}  // namespace terrabench::cross
