// What the experiments share that compare all methods along one path over the same grounds: their parameters,
// and their cases, one per ground or one per ground and method.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "experiments/cross/lod/flight.h"

namespace terrabench::cross {

// method, options, error, path, frames, size.
extern const std::array<ParameterSpec, 6> kTunedSpecs;

// The name of the camera path that suits a ground: over wide ground, `fly`, as high as the width implies,
// would not resolve the samples.
std::string path_over(std::string_view terrain);
// A case on a ground, along the path that suits it; `specs` must contain path, frames and size. Generated
// grounds have 257² samples, in the paper profile 1025²; 12 frames are metered, or 24.
Case case_on(const std::string& terrain, const std::string& name, std::span<const ParameterSpec> specs,
             const RunOptions&);
std::vector<std::string> compared_grounds(const RunOptions&);  // those that the user names, or our own
// One case per ground and method or variant, named GROUND/METHOD, with kTunedSpecs.
std::vector<Case> tuned_cases(const RunOptions&);

// The flight of a case made by case_on(). Records its ground.
Flight& flight_of(const Case&, const RunOptions&, Recorder&, Progress&);

struct TunedMethod {
  Flight& flight;
  ConfiguredMethod method;
  Tuned tuned;

  // With its knob set. Over a ground of the same size as the flight's, or over the flight's own.
  std::unique_ptr<Lod> build(const Heightfield&, Progress&) const;
  std::unique_ptr<Lod> build(Progress& progress) const { return build(flight.ground(), progress); }
};

// The method of a case of tuned_cases(), tuned so that 99 % of the visible samples keep the case's error.
// Records the ground.
TunedMethod tune_case(const Case&, const RunOptions&, Recorder&, Progress&);

}  // namespace terrabench::cross
