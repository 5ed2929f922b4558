#include <array>

#include "experiments/cross/cross.h"
#include "experiments/cross/lod_disk.h"
#include "experiments/cross/lod_endless.h"
#include "experiments/drill/drill.h"
#include "experiments/experiment.h"
#include "experiments/ght/ght.h"
#include "experiments/hybrid/hybrid.h"
#include "experiments/mrbsp/mrbsp.h"
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
    Experiment{"ght.event-figures", "ght", "Figures 13, 15 and 17-24: events and their trees",
               ght::kEventFigureParameters, ght::event_figure_cases, ght::draw_event_figure},
    Experiment{"ght.counts", "ght", "§3.2: heightmaps that each event adds", ght::kCountParameters,
               ght::count_cases, ght::measure_count},
    Experiment{"ght.continuity", "ght", "§3.2: nothing dangles, nothing is open", ght::kContinuityParameters,
               ght::continuity_cases, ght::measure_continuity},
    Experiment{"ght.overhang", "ght", "§1: what a heightmap cannot hold", ght::kOverhangParameters,
               ght::overhang_cases, ght::measure_overhang},
    Experiment{"ght.edits", "ght", "§4: an event on ever larger terrains, beside stacks and voxels",
               ght::kEditParameters, ght::edit_cases, ght::measure_edit},
    Experiment{"ght.reach", "ght", "§4: ever larger events, beside stacks and voxels", ght::kReachParameters,
               ght::reach_cases, ght::measure_reach},
    Experiment{"ght.complex", "ght", "§4.2: the sequence of events and the rain of particles",
               ght::kComplexParameters, ght::complex_cases, ght::measure_complex},
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
    Experiment{"mrbsp.heights", "mrbsp", "§2: levels of the tree, and heights of its vertices",
               mrbsp::kHeightParameters, mrbsp::height_cases, mrbsp::measure_heights},
    Experiment{"mrbsp.walk", "mrbsp", "Table 2: triangles and time of LOD, visibility and both",
               mrbsp::kWalkParameters, mrbsp::walk_cases, mrbsp::measure_walk},
    Experiment{"mrbsp.threshold", "mrbsp", "§3: apparent size of triangles against distance",
               mrbsp::kThresholdParameters, mrbsp::threshold_cases, mrbsp::measure_threshold},
    Experiment{"mrbsp.holes", "mrbsp", "§3: holes that the rules leave", mrbsp::kHoleParameters,
               mrbsp::hole_cases, mrbsp::measure_holes},
    Experiment{"mrbsp.lod-figure",
               "mrbsp",
               "Figure 1: thresholds at the vertices",
               {},
               mrbsp::lod_figure_cases,
               mrbsp::draw_lod_figure},
    Experiment{"mrbsp.visibility", "mrbsp", "§4: what the stored sets miss, and their bytes",
               mrbsp::kVisibilityParameters, mrbsp::visibility_cases, mrbsp::measure_visibility},
    Experiment{"mrbsp.profile",
               "mrbsp",
               "Table 1 and figure 2: visibility of a profile",
               {},
               mrbsp::profile_cases,
               mrbsp::measure_profile},
    Experiment{"mrbsp.land", "mrbsp", "§5: LOD's gain against the size of the land", mrbsp::kLandParameters,
               mrbsp::land_cases, mrbsp::measure_land},
    Experiment{"mrbsp.roughness", "mrbsp", "§5: visibility's gain against roughness",
               mrbsp::kRoughnessParameters, mrbsp::roughness_cases, mrbsp::measure_roughness},
    Experiment{"mrbsp.drawing", "mrbsp", "§1: land from drawings", mrbsp::kDrawingParameters,
               mrbsp::drawing_cases, mrbsp::measure_drawing},
    Experiment{"cross.lod-equal-error", "cross", "Level-of-detail methods at the same screen-space error",
               cross::kEqualErrorParameters, cross::equal_error_cases, cross::measure_equal_error},
    Experiment{"overview.relief", "overview", "Shaded relief of each terrain in each representation",
               overview_experiments::kReliefParameters, overview_experiments::relief_cases,
               overview_experiments::measure_relief},
    Experiment{"cross.lod-disk", "cross", "A clipmap over ground that stays on disk",
               cross::kLodDiskParameters, cross::lod_disk_cases, cross::measure_lod_disk},
    Experiment{"cross.lod-endless", "cross", "A clipmap over ground without bounds",
               cross::kLodEndlessParameters, cross::lod_endless_cases, cross::measure_lod_endless},
};

}  // namespace

std::span<const Experiment> experiments() { return kExperiments; }

}  // namespace terrabench
