// Every experiment: declared, and in the order in which they are listed and measured.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <set>

#include "experiments/experiment.h"
#include "results/claims/claims.h"
#include "results/store/glob.h"
#include "terrain/error.h"

namespace terrabench {

namespace hybrid {
extern const Experiment kKernels, kImplicit, kTable1, kTable2, kReuse, kQueryRates, kCaves, kNoiseStages,
    kFresnel, kWaterPasses, kTexturing, kAir, kSky, kLandscape, kClipmapFigures, kSumHeights, kStitch,
    kLessGeometry, kTable3, kSlope, kBary, kRandom, kGrassFigures, kHero;
}
namespace ght {
extern const Experiment kGenerators, kStages, kEventFigures, kCounts, kCells, kContinuity, kOverhang, kEdits,
    kReach, kComplex;
}
namespace drill {
extern const Experiment kChannels, kLargestFlow, kFactorial, kEffects, kAhdReadings, kTime, kGrowth, kSize,
    kExtensions, kPromises, kHydrography, kSweep;
}
namespace mrbsp {
extern const Experiment kHeights, kWalk, kThreshold, kHoles, kLodFigure, kVisibility, kPreprocessing,
    kCellSizes, kQuality, kProfile, kLand, kRoughness, kDrawing;
}
namespace meshgrow {
extern const Experiment kSubdivisionFigures, kStandard, kSpectrum, kLimit, kLimitAt, kApproximation,
    kHeightField, kModels, kFork, kRefinement, kGrowingFigures, kModelFigures, kLod, kForest;
}
namespace cross {
extern const Experiment kRepresentations, kErrorMaps, kFileSize, kLodEqualError, kLodRanks, kLodFrames,
    kLodJump, kLodGpu, kLodSeams, kLodSurface, kLodEdit, kScale, kRoundTrip, kLodDisk, kLodDiskChunked,
    kLodEndless;
}
namespace relief {
extern const Experiment kRelief;
}

std::span<const std::reference_wrapper<const Experiment>> experiments() {
  static const std::reference_wrapper<const Experiment> all[] = {
      hybrid::kKernels,
      hybrid::kImplicit,
      hybrid::kTable1,
      hybrid::kTable2,
      hybrid::kReuse,
      hybrid::kQueryRates,
      hybrid::kCaves,
      hybrid::kNoiseStages,
      hybrid::kFresnel,
      hybrid::kWaterPasses,
      hybrid::kTexturing,
      hybrid::kAir,
      hybrid::kSky,
      hybrid::kLandscape,
      hybrid::kClipmapFigures,
      hybrid::kSumHeights,
      hybrid::kStitch,
      hybrid::kLessGeometry,
      hybrid::kTable3,
      hybrid::kSlope,
      hybrid::kBary,
      hybrid::kRandom,
      hybrid::kGrassFigures,
      hybrid::kHero,
      ght::kGenerators,
      ght::kStages,
      ght::kEventFigures,
      ght::kCounts,
      ght::kCells,
      ght::kContinuity,
      ght::kOverhang,
      ght::kEdits,
      ght::kReach,
      ght::kComplex,
      drill::kChannels,
      drill::kLargestFlow,
      drill::kFactorial,
      drill::kEffects,
      drill::kAhdReadings,
      drill::kTime,
      drill::kGrowth,
      drill::kSize,
      drill::kExtensions,
      drill::kPromises,
      drill::kHydrography,
      drill::kSweep,
      mrbsp::kHeights,
      mrbsp::kWalk,
      mrbsp::kThreshold,
      mrbsp::kHoles,
      mrbsp::kLodFigure,
      mrbsp::kVisibility,
      mrbsp::kPreprocessing,
      mrbsp::kCellSizes,
      mrbsp::kQuality,
      mrbsp::kProfile,
      mrbsp::kLand,
      mrbsp::kRoughness,
      mrbsp::kDrawing,
      meshgrow::kSubdivisionFigures,
      meshgrow::kStandard,
      meshgrow::kSpectrum,
      meshgrow::kLimit,
      meshgrow::kLimitAt,
      meshgrow::kApproximation,
      meshgrow::kHeightField,
      meshgrow::kModels,
      meshgrow::kFork,
      meshgrow::kRefinement,
      meshgrow::kGrowingFigures,
      meshgrow::kModelFigures,
      meshgrow::kLod,
      meshgrow::kForest,
      cross::kRepresentations,
      cross::kErrorMaps,
      cross::kFileSize,
      cross::kLodEqualError,
      cross::kLodRanks,
      cross::kLodFrames,
      cross::kLodJump,
      cross::kLodGpu,
      cross::kLodSeams,
      cross::kLodSurface,
      cross::kLodEdit,
      cross::kScale,
      cross::kRoundTrip,
      relief::kRelief,
      cross::kLodDisk,
      cross::kLodDiskChunked,
      cross::kLodEndless,
  };
  return all;
}

const Experiment& experiment(std::string_view id) {
  std::vector<std::string_view> ids;
  for (const Experiment& each : experiments()) {
    if (each.id == id) return each;
    ids.push_back(each.id);
  }
  throw unknown_name("experiment", id, ids);
}

namespace {

// Those that measure the claims that the glob matches, or whose ids begin with it: "mrbsp.T2" for
// "mrbsp.T2.time".
std::set<std::string_view> measuring(const std::string& glob) {
  std::set<std::string_view> ids;
  for (const Paper& paper : papers()) {
    for (const Claim& claim : paper.claims) {
      if (!matches_glob(glob, claim.id) && !matches_glob(glob + ".*", claim.id)) continue;
      for (const std::string_view id : claim.experiments()) ids.insert(id);
    }
  }
  return ids;
}

}  // namespace

void demand_experiments(std::span<const std::string> globs) {
  std::vector<std::string_view> ids;
  for (const Experiment& each : experiments()) ids.push_back(each.id);
  for (const std::string& glob : globs) {
    if (std::ranges::any_of(ids, [&](std::string_view id) { return matches_glob(glob, id); })) continue;
    if (const auto found = measuring(glob); !found.empty()) {
      throw usage_error(fmt::format("'{}' names claims, not experiments", glob), "",
                        fmt::format("they are measured by: terrabench run {}", fmt::join(found, " ")));
    }
  }
  demand_matches(globs, ids, "experiment", "terrabench list experiments");
}

}  // namespace terrabench
