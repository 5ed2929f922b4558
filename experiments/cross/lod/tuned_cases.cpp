#include "experiments/cross/lod/tuned_cases.h"

#include <fmt/format.h>

#include "experiments/ground.h"
#include "terrain/sources/catalogue.h"

namespace terrabench::cross {

const std::array<ParameterSpec, 6> kTunedSpecs{
    ParameterSpec{"method", std::string("roam"), "",
                  "a name of `terrabench list lods`: a method, or a variant such as geomipmap_morph; for "
                  "cross.lod-equal-error also all, for a picture of their triangles side by side"},
    ParameterSpec{"options", std::string(), "",
                  "options of methods, such as geomipmap.patch=32,mrbsp.threshold=area"},
    ParameterSpec{"error", 2.0, "px", "required 99th percentile of the screen-space error", 0.01, 1000},
    ParameterSpec{"path", std::string("fly"), "", "camera path: cross, fly, low, turn, walk, or a TOML file"},
    ParameterSpec{"frames", std::int64_t{24}, "", "frames of the path that are metered", 1, 100000},
    ParameterSpec{"size", std::int64_t{257}, "samples", "side of the generated grounds, 2^n + 1", 3, 8193},
};

std::string path_over(std::string_view terrain) {
  return terrain == "fractal" || terrain == "maine" || terrain == kHelensMosaic ? "low" : "fly";
}

Case case_on(const std::string& terrain, const std::string& name, std::span<const ParameterSpec> specs,
             const RunOptions& options) {
  const bool paper = options.profile == Profile::kPaper;
  const std::int64_t size = paper ? 1025 : 257, frames = paper ? 24 : 12;
  return {name, {specs, {{"path", path_over(terrain)}, {"frames", frames}, {"size", size}}}, terrain};
}

std::vector<std::string> compared_grounds(const RunOptions& options) {
  const std::string main(kMainGround);
  if (options.profile == Profile::kQuick) return grounds(options, {main, "fractal"});
  return grounds(options, {main, "helens", "maine", "fractal", "peak"});
}

std::vector<Case> tuned_cases(const RunOptions& options) {
  std::vector<Case> cases;
  for (const std::string& terrain : compared_grounds(options)) {
    for (const Entrant& entrant : entrants()) {
      cases.push_back(case_on(terrain, fmt::format("{}/{}", terrain, entrant.name), kTunedSpecs, options));
      cases.back().parameters.set("method", entrant.name);
    }
  }
  return cases;
}

Flight& flight_of(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  Flight& flight = flight_along(
      {at.terrain, at.parameters.text("path"), at.integer("size"), at.integer("frames"), options.seed},
      progress);
  recorder.terrain(flight.source);
  return flight;
}

std::unique_ptr<Lod> TunedMethod::build(const Heightfield& ground, Progress& progress) const {
  std::unique_ptr<Lod> lod = method.build(ground, progress);
  lod->tune(tuned.knob);
  return lod;
}

TunedMethod tune_case(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  Flight& flight = flight_of(at, options, recorder, progress);
  ConfiguredMethod method = named_method(at.parameters.text("method"), at.parameters.text("options"));
  const Tuned tuned = tune_to(flight, method, at.parameters.number("error"), progress);
  return {flight, std::move(method), tuned};
}

}  // namespace terrabench::cross
