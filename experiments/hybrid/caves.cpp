// §3.1.3 of "hybrid": overhangs, caves and floating islands that each noise adds to the terrain.
#include <array>

#include "experiments/build_at.h"
#include "experiments/experiment.h"
#include "representations/layered_stack/components.h"
#include "terrain/sources/noise/cave_terrain.h"

namespace terrabench::hybrid {
namespace {

constexpr std::array kSpecs{
    ParameterSpec{"n", std::int64_t{128}, "cells", "cells along each side of the cube", 2, 4096},
    ParameterSpec{"perturb_x", true, "", "move samples sideways (overhangs)"},
    ParameterSpec{"caves", true, "", "carve with two ridged multifractals"},
    ParameterSpec{"attenuation", true, "", "weaken the carving with height"},
    ParameterSpec{"printed_product", false, "",
                  "multiply the two cave maps as printed: a cave where either map has one"},
};

// The same sizes in both profiles: which specks of ground float depends on the cells' size.
std::vector<Case> cases(const RunOptions&) {
  struct Variant {
    const char* name;
    bool perturb_x, caves, attenuation, printed_product;
    std::int64_t n = 256;
  };
  constexpr std::array kVariants{
      Variant{"y-only", false, false, false, false},
      Variant{"x-and-y", true, false, false, false},
      Variant{"caves-no-attenuation", true, true, false, false},
      Variant{"caves-attenuated", true, true, true, false},
      Variant{"caves-printed-product", true, true, true, true},
      Variant{"caves-printed-product-no-attenuation", true, true, false, true},
      Variant{"x-and-y/n=128", true, false, false, false, 128},
      Variant{"caves-attenuated/n=128", true, true, true, false, 128},
  };
  std::vector<Case> cases;
  for (const Variant& variant : kVariants) {
    cases.push_back({variant.name,
                     {kSpecs,
                      {{"n", variant.n},
                       {"perturb_x", variant.perturb_x},
                       {"caves", variant.caves},
                       {"attenuation", variant.attenuation},
                       {"printed_product", variant.printed_product}}},
                     ""});
  }
  return cases;
}

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const noise::CaveOptions terrain{.seed = options.seed,
                                   .perturb_x = at.parameters.flag("perturb_x"),
                                   .caves = at.parameters.flag("caves"),
                                   .attenuation = at.parameters.flag("attenuation"),
                                   .printed_product = at.parameters.flag("printed_product")};
  const TerrainSource source = recorder.terrain(noise::cave_source(terrain));
  const Components found =
      find_components(*stack_at_resolution(source, at.parameters.integer("n"), progress));

  recorder.add("overhang_columns", "", found.overhang_columns);
  recorder.add("solid_components", "", found.total);
  recorder.add("floating_components", "", found.floating);
  recorder.add("floating_volume", "m³", found.floating_volume);
  const glm::vec3 size = source.bounds().size();
  recorder.add("solid_share", "", found.solid_volume / (static_cast<double>(size.x) * size.y * size.z));
}

}  // namespace

extern const Experiment kCaves{"hybrid.caves", "§3.1.3: overhangs, caves and floating islands", kSpecs, cases,
                               measure};

}  // namespace terrabench::hybrid
