#include <array>

#include "experiments/experiment.h"
#include "experiments/timing.h"
#include "terrain/error.h"

// One line per experiment, in the order in which they are listed: whether any of its cases records a time
// (TIMED), and whether each of its cases is measured in a process of its own (FRESH, also timed); the paper's
// namespace; the value.
#define TERRABENCH_EXPERIMENTS(TIMED, UNTIMED, FRESH) \
  UNTIMED(hybrid, kKernels)                           \
  TIMED(hybrid, kImplicit)                            \
  TIMED(hybrid, kTable1)                              \
  TIMED(hybrid, kTable2)                              \
  TIMED(hybrid, kReuse)                               \
  TIMED(hybrid, kQueryRates)                          \
  UNTIMED(hybrid, kCaves)                             \
  UNTIMED(hybrid, kNoiseStages)                       \
  UNTIMED(hybrid, kFresnel)                           \
  UNTIMED(hybrid, kWaterPasses)                       \
  UNTIMED(hybrid, kTexturing)                         \
  UNTIMED(hybrid, kAir)                               \
  UNTIMED(hybrid, kSky)                               \
  UNTIMED(hybrid, kLandscape)                         \
  UNTIMED(hybrid, kClipmapFigures)                    \
  UNTIMED(hybrid, kSumHeights)                        \
  UNTIMED(hybrid, kStitch)                            \
  UNTIMED(hybrid, kLessGeometry)                      \
  TIMED(hybrid, kTable3)                              \
  UNTIMED(hybrid, kSlope)                             \
  UNTIMED(hybrid, kBary)                              \
  UNTIMED(hybrid, kRandom)                            \
  UNTIMED(hybrid, kGrassFigures)                      \
  TIMED(hybrid, kHero)                                \
  UNTIMED(ght, kGenerators)                           \
  UNTIMED(ght, kStages)                               \
  UNTIMED(ght, kEventFigures)                         \
  UNTIMED(ght, kCounts)                               \
  UNTIMED(ght, kCells)                                \
  UNTIMED(ght, kContinuity)                           \
  UNTIMED(ght, kOverhang)                             \
  TIMED(ght, kEdits)                                  \
  TIMED(ght, kReach)                                  \
  TIMED(ght, kComplex)                                \
  UNTIMED(drill, kChannels)                           \
  UNTIMED(drill, kLargestFlow)                        \
  UNTIMED(drill, kFactorial)                          \
  UNTIMED(drill, kEffects)                            \
  UNTIMED(drill, kAhdReadings)                        \
  TIMED(drill, kTime)                                 \
  TIMED(drill, kGrowth)                               \
  UNTIMED(drill, kSize)                               \
  UNTIMED(drill, kExtensions)                         \
  UNTIMED(drill, kPromises)                           \
  UNTIMED(drill, kHydrography)                        \
  UNTIMED(drill, kSweep)                              \
  UNTIMED(mrbsp, kHeights)                            \
  TIMED(mrbsp, kWalk)                                 \
  UNTIMED(mrbsp, kThreshold)                          \
  UNTIMED(mrbsp, kHoles)                              \
  UNTIMED(mrbsp, kLodFigure)                          \
  TIMED(mrbsp, kVisibility)                           \
  TIMED(mrbsp, kPreprocessing)                        \
  TIMED(mrbsp, kCellSizes)                            \
  UNTIMED(mrbsp, kQuality)                            \
  UNTIMED(mrbsp, kProfile)                            \
  UNTIMED(mrbsp, kLand)                               \
  UNTIMED(mrbsp, kRoughness)                          \
  UNTIMED(mrbsp, kDrawing)                            \
  UNTIMED(meshgrow, kSubdivisionFigures)              \
  UNTIMED(meshgrow, kStandard)                        \
  UNTIMED(meshgrow, kSpectrum)                        \
  UNTIMED(meshgrow, kLimit)                           \
  UNTIMED(meshgrow, kLimitAt)                         \
  UNTIMED(meshgrow, kApproximation)                   \
  UNTIMED(meshgrow, kHeightField)                     \
  TIMED(meshgrow, kModels)                            \
  UNTIMED(meshgrow, kFork)                            \
  TIMED(meshgrow, kRefinement)                        \
  UNTIMED(meshgrow, kGrowingFigures)                  \
  UNTIMED(meshgrow, kModelFigures)                    \
  UNTIMED(meshgrow, kLod)                             \
  TIMED(meshgrow, kForest)                            \
  TIMED(cross, kRepresentations)                      \
  UNTIMED(cross, kErrorMaps)                          \
  TIMED(cross, kLodEqualError)                        \
  TIMED(cross, kLodRanks)                             \
  TIMED(cross, kLodFrames)                            \
  TIMED(cross, kLodJump)                              \
  UNTIMED(cross, kLodSeams)                           \
  TIMED(cross, kLodSurface)                           \
  TIMED(cross, kLodEdit)                              \
  FRESH(cross, kScale)                                \
  UNTIMED(cross, kRoundTrip)                          \
  TIMED(relief, kRelief)                              \
  TIMED(cross, kLodDisk)                              \
  TIMED(cross, kLodEndless)

namespace terrabench {

#define DECLARE(paper, value)    \
  namespace paper {              \
  extern const Experiment value; \
  }
TERRABENCH_EXPERIMENTS(DECLARE, DECLARE, DECLARE)

std::span<const std::reference_wrapper<const Experiment>> experiments() {
#define REFER(paper, value) std::cref(paper::value),
  static const std::array all{TERRABENCH_EXPERIMENTS(REFER, REFER, REFER)};
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

#define IS(paper, value) &experiment == &paper::value ||
#define NONE(paper, value)
bool records_times(const Experiment& experiment) { return TERRABENCH_EXPERIMENTS(IS, NONE, IS) false; }
bool in_fresh_process(const Experiment& experiment) { return TERRABENCH_EXPERIMENTS(NONE, NONE, IS) false; }

}  // namespace terrabench
