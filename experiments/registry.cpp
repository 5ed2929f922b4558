#include <array>

#include "experiments/cross/cross.h"
#include "experiments/drill/drill.h"
#include "experiments/experiment.h"
#include "experiments/ght/ght.h"
#include "experiments/hybrid/hybrid.h"
#include "experiments/overview/overview.h"

namespace terrabench {
namespace {

const std::array kExperiments{
    Experiment{"hybrid.table1", "hybrid", "Table 1: memory of the discrete data structure",
               hybrid::kSizeParameters, hybrid::table1_cases, hybrid::measure_table1},
    Experiment{"hybrid.table2", "hybrid", "Table 2: terrain generation times", hybrid::kSizeParameters,
               hybrid::table2_cases, hybrid::measure_table2},
    Experiment{"hybrid.caves", "hybrid", "§3.1.3: overhangs, caves and floating islands",
               hybrid::kCaveParameters, hybrid::cave_cases, hybrid::measure_caves},
    Experiment{"hybrid.noise-stages", "hybrid", "Figures 3-13: the noise pipeline, step by step",
               hybrid::kStageParameters, hybrid::stage_cases, hybrid::measure_stage},
    Experiment{"ght.generators", "ght", "§2.3: what the generators of base terrain promise",
               ght::kGeneratorParameters, ght::generator_cases, ght::measure_generator},
    Experiment{"ght.stages", "ght", "Figures 1 and 3-10: the generators, step by step", ght::kStageParameters,
               ght::stage_cases, ght::draw_stage},
    Experiment{"drill.channels", "drill", "§3.1: channel pixels and the largest flow",
               drill::kChannelParameters, drill::channel_cases, drill::measure_channels},
    Experiment{"drill.factorial", "drill", "§3: the factorial of 54 parameter sets",
               drill::kFactorialParameters, drill::factorial_cases, drill::measure_factorial},
    Experiment{"drill.effects", "drill", "§3.1: best sets, main effects, figures 1-4",
               drill::kGroundParameters, drill::ground_cases, drill::measure_effects},
    Experiment{"drill.time", "drill", "§3.1: time against channel pixels", drill::kGroundParameters,
               drill::ground_cases, drill::measure_time},
    Experiment{"drill.growth", "drill", "§3.1: time against the size of the ground", drill::kGrowthParameters,
               drill::growth_cases, drill::measure_growth},
    Experiment{"drill.size", "drill", "§4.1: values and bytes", drill::kGroundParameters, drill::ground_cases,
               drill::measure_size},
    Experiment{"drill.extensions", "drill", "§4.1: what the paper leaves as future work",
               drill::kExtensionParameters, drill::extension_cases, drill::measure_extension},
    Experiment{"drill.promises", "drill", "§2.3 and §4: order of drills, pits", drill::kGroundParameters,
               drill::ground_cases, drill::measure_promises},
    Experiment{"cross.lod-equal-error", "cross", "Level-of-detail methods at the same screen-space error",
               cross::kEqualErrorParameters, cross::equal_error_cases, cross::measure_equal_error},
    Experiment{"overview.relief", "overview", "Shaded relief of each terrain in each representation",
               overview_experiments::kReliefParameters, overview_experiments::relief_cases,
               overview_experiments::measure_relief},
};

}  // namespace

std::span<const Experiment> experiments() { return kExperiments; }

}  // namespace terrabench
