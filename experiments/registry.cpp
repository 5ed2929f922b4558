#include <array>

#include "experiments/experiment.h"
#include "terrain/error.h"

// One line per experiment, in the order in which they run and are listed: the paper's namespace, the value.
#define TERRABENCH_EXPERIMENTS(ENTRY)  \
  ENTRY(hybrid, kKernels)              \
  ENTRY(hybrid, kImplicit)             \
  ENTRY(hybrid, kTable1)               \
  ENTRY(hybrid, kTable2)               \
  ENTRY(hybrid, kQueryRates)           \
  ENTRY(hybrid, kCaves)                \
  ENTRY(hybrid, kNoiseStages)          \
  ENTRY(hybrid, kFresnel)              \
  ENTRY(hybrid, kSky)                  \
  ENTRY(hybrid, kLandscape)            \
  ENTRY(hybrid, kClipmapFigures)       \
  ENTRY(hybrid, kSumHeights)           \
  ENTRY(hybrid, kStitch)               \
  ENTRY(hybrid, kLessGeometry)         \
  ENTRY(hybrid, kTable3)               \
  ENTRY(hybrid, kSlope)                \
  ENTRY(hybrid, kBary)                 \
  ENTRY(hybrid, kGrassFigures)         \
  ENTRY(hybrid, kHero)                 \
  ENTRY(ght, kGenerators)              \
  ENTRY(ght, kStages)                  \
  ENTRY(ght, kEventFigures)            \
  ENTRY(ght, kCounts)                  \
  ENTRY(ght, kContinuity)              \
  ENTRY(ght, kOverhang)                \
  ENTRY(ght, kEdits)                   \
  ENTRY(ght, kReach)                   \
  ENTRY(ght, kComplex)                 \
  ENTRY(drill, kChannels)              \
  ENTRY(drill, kFactorial)             \
  ENTRY(drill, kEffects)               \
  ENTRY(drill, kAhdReadings)           \
  ENTRY(drill, kTime)                  \
  ENTRY(drill, kGrowth)                \
  ENTRY(drill, kSize)                  \
  ENTRY(drill, kExtensions)            \
  ENTRY(drill, kPromises)              \
  ENTRY(mrbsp, kHeights)               \
  ENTRY(mrbsp, kWalk)                  \
  ENTRY(mrbsp, kThreshold)             \
  ENTRY(mrbsp, kHoles)                 \
  ENTRY(mrbsp, kLodFigure)             \
  ENTRY(mrbsp, kVisibility)            \
  ENTRY(mrbsp, kCellSizes)             \
  ENTRY(mrbsp, kQuality)               \
  ENTRY(mrbsp, kProfile)               \
  ENTRY(mrbsp, kLand)                  \
  ENTRY(mrbsp, kRoughness)             \
  ENTRY(mrbsp, kDrawing)               \
  ENTRY(meshgrow, kSubdivisionFigures) \
  ENTRY(meshgrow, kStandard)           \
  ENTRY(meshgrow, kSpectrum)           \
  ENTRY(meshgrow, kLimit)              \
  ENTRY(meshgrow, kModels)             \
  ENTRY(meshgrow, kFork)               \
  ENTRY(meshgrow, kRefinement)         \
  ENTRY(meshgrow, kGrowingFigures)     \
  ENTRY(meshgrow, kModelFigures)       \
  ENTRY(meshgrow, kLod)                \
  ENTRY(meshgrow, kForest)             \
  ENTRY(cross, kRepresentations)       \
  ENTRY(cross, kLodEqualError)         \
  ENTRY(cross, kScale)                 \
  ENTRY(cross, kRoundTrip)             \
  ENTRY(relief, kRelief)               \
  ENTRY(cross, kLodDisk)               \
  ENTRY(cross, kLodEndless)

namespace terrabench {

#define DECLARE(paper, value)    \
  namespace paper {              \
  extern const Experiment value; \
  }
TERRABENCH_EXPERIMENTS(DECLARE)

std::span<const std::reference_wrapper<const Experiment>> experiments() {
#define REFER(paper, value) std::cref(paper::value),
  static const std::array all{TERRABENCH_EXPERIMENTS(REFER)};
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

}  // namespace terrabench
