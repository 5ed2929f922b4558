// The Fresnel term of "hybrid" (§3.4), "from the dot product of the normal of the water and light reflection
// vector": what water reflects at grazing and at normal view, in three readings of that vector, and in three
// of the term: Schlick's approximation, which the landscape uses, the product itself, and one minus the
// product.
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "experiments/cases.h"
#include "renderers/landscape/probe.h"

namespace terrabench::hybrid {
namespace {

// The first three are numbered as FresnelReading.
constexpr std::array<std::string_view, 5> kReadings{"view", "reflected", "light", "product",
                                                    "one-minus-product"};
const std::array kSpecs{
    choice("reading", kReadings,
           "the vector whose product with the water's normal is taken: towards the eye; the line of sight "
           "reflected by the water; the sun's light reflected by the water, as printed; or with the vector "
           "towards the eye the product itself as the term, and one minus the product"),
    ParameterSpec{"grazing", 88.0, "°", "angle between the view and the normal that counts as grazing", 45,
                  89.9},
    ParameterSpec{"sun_height", 35.0, "°", "height of the sun", 0, 90},
};

std::vector<Case> cases(const RunOptions&) { return cases_by("reading", kSpecs); }

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress&) {
  constexpr double kDegree = std::numbers::pi / 180;
  constexpr int kAngles = 90;
  const auto reading = static_cast<float>(at.parameters.choice("reading"));
  const auto sun = static_cast<float>(at.parameters.number("sun_height") * kDegree);
  const auto input = [&](double degrees, double azimuth) {
    return glm::vec4(degrees * kDegree, sun, azimuth * kDegree, reading);
  };
  std::vector<glm::vec4> inputs{input(0, 0), input(at.parameters.number("grazing"), 0)};
  for (int degrees = 0; degrees < kAngles; ++degrees) inputs.push_back(input(degrees, 60));
  const auto context = open_context(options.renderer, 64, 64);
  const std::vector<float> shares = evaluate(*context, Probe::kReflectance, inputs);
  recorder.add("reflectance_normal", "", shares[0]);
  recorder.add("reflectance_grazing", "", shares[1]);
  // Up to 15° the term is below a float's precision.
  constexpr std::size_t kFirst = 2 + 15;
  double rises = 0;
  for (std::size_t k = kFirst + 1; k < shares.size(); ++k) rises += shares[k] > shares[k - 1] ? 1 : 0;
  recorder.add("rising_share", "", rises / static_cast<double>(shares.size() - kFirst - 1));
}

}  // namespace

extern const Experiment kFresnel{"hybrid.fresnel", "§3.4: reflectance of water in five readings", kSpecs,
                                 cases, measure};

}  // namespace terrabench::hybrid
