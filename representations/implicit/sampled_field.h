// A scalar field in space, positive in solid ground, from which the extractors make a surface.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>

namespace terrabench {

// Samples a field on planes of equal z, in ascending order. For one thread.
class FieldPlanes {
 public:
  virtual ~FieldPlanes() = default;
  // The values at (xs[i], ys[k], z) as out[i·ys.size() + k]; z is not below the last call's. A whole plane
  // per call, so that the virtual call is paid once.
  virtual void sample(double z, std::span<float> out) = 0;
};

class SampledField {
 public:
  virtual ~SampledField() = default;
  // xs and ys ascend, metres; they must outlive the result. The same position has the same value in all
  // planes, to the bit. Thread-safe.
  virtual std::unique_ptr<FieldPlanes> planes(std::span<const float> xs, std::span<const float> ys) const = 0;
  virtual float at(glm::vec3) const = 0;  // thread-safe

  // Over the rectangle from low to high in plan: below `solid` the field is positive, from `air` on it is
  // not. All air when air ≤ solid.
  struct Heights {
    double solid, air;
  };
  virtual Heights heights(glm::dvec2 low, glm::dvec2 high) const = 0;
};

}  // namespace terrabench
