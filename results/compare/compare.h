// Compares two results folders metric by metric: what changed, and whether the change exceeds the noise; and
// picture by picture (compare_pictures.h).
// Exact figures must be equal on any two machines; what varies (timed() in record.h) is compared within one
// kind of machine.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "results/compare/compare_pictures.h"
#include "results/store/statistics.h"
#include "results/store/store.h"

namespace terrabench {

enum class Change {
  kSame,     // exact and equal, or a timing whose ratio's interval contains 1 or that lies within the noise
  kRose,     // the ratio's interval lies above 1, and the change exceeds the noise
  kFell,     // the ratio's interval lies below 1, and the change exceeds the noise
  kDiffers,  // exact and not equal
  kUnresolved,  // a timing with fewer than three samples in a folder, too few for an interval, or whose
                // interval spans more than a factor of 4 around 1, as of samples taken on grounds of
                // different sizes
  kElsewhere,   // a timing of another kind of machine, which says nothing about the code
  kOnlyBefore,
  kOnlyAfter,
};
std::string_view name(Change);

struct MetricChange {
  std::string experiment, case_name, profile, metric, unit;
  Change change = Change::kSame;
  bool timed = false;            // a time, or computed from times
  double before = 0, after = 0;  // medians
  Summary ratio = {};            // after ÷ before, when both exist
  double threshold = 1;  // a change up to this factor is noise, and so is 1 ÷ it; 1: none was estimated
  bool equal = false;    // both have the same samples
  // Second ÷ first measurement, for each folder that measured it twice: of one kind of machine, positive and
  // finite, and with kFewestSamples or more each time.
  std::vector<double> repeats = {};
  bool same_ground = true;                              // both have the same seed, parameters and terrain
  std::string machine_before = "", machine_after = "";  // machine_name(), where they are of different kinds

  bool one_sided() const;
};

// Times of two runs of one program differ by more than their confidence intervals say: load, clock rate and
// places in memory change, and what takes long or uses much memory feels it more. A time counts as changed
// only if its interval excludes 1 and it changed by more than the threshold of the group of times that are
// most like it. There are three such groups: times of the same profile, experiment and metric; times of the
// same profile and experiment; and all times. The first group counts if it has kRepeats, else the second if
// it has; else the first of the three whose noise can be estimated.
//
// A repeat is the change from the first to the second measurement of a time that one run measured twice
// (Metric::first_look). The program was the same, so every such change is noise, and the threshold is the
// factor that 99 of 100 of them do not exceed. Repeats do not show differences that last for a whole run,
// such as places in memory, nor the noise of cases that are too long to be measured twice. All times of one
// case were repeated at the same moments, so their repeats are alike.
//
// A group with fewer repeats, but with kLeast times, has as its threshold three standard deviations of the
// changes between the runs. This assumes that most times of the group did not change. A quarter of them may,
// with little effect. If about half did, by different factors, the estimate is wide and hides them.
//
// What all of a group share between the runs, such as a new compiler or a busy hour of the machine, is in
// neither: then all count as changed, and the group's median says so. Of many times that did not change a
// few still seem to have.
struct Noise {
  static constexpr std::size_t kLeast = 20, kRepeats = 100;
  std::string profile = "", experiment = "", metric = "";  // empty: of all
  std::size_t timings = 0;           // of one kind of machine, with intervals, that are not the same in both
  std::size_t repeats = 0;           // of these; up to two of a time, one of each run
  std::size_t users = 0;             // times that it applies to
  double median = 1, deviation = 1;  // of after ÷ before, as factors; the deviation of kLeast timings or more
  double threshold = 1;              // a factor up to it is noise, and so is 1 ÷ it; 1: not estimated
  bool by_repeats = false;           // whether the threshold comes from repeats, not from the deviation
};

struct Comparison {
  std::vector<MetricChange> metrics;  // in the first folder's order, then those that only the second has
  std::vector<std::string> warnings, faults;  // of both stores
  Noise noise;                                // of all times
  std::vector<Noise> noises;  // of experiments and of their metrics, where some times use it, sorted by name
  PictureComparison pictures;

  bool exact_equal() const;  // no exact metric differs
  bool passed() const { return exact_equal() && pictures.passed() && faults.empty(); }
  std::size_t count(Change) const;
};

// Throws bad_input when a folder holds no results, and when the two have nothing in common, such as one of
// the paper profile and one of the quick one.
Comparison compare(const std::filesystem::path& before, const std::filesystem::path& after,
                   const PictureLimits& = {});
Comparison compare(const Store& before, const Store& after, const PictureLimits& = {});

// A summary first; then what only one folder has, counted by experiment, and the metrics that changed. `all`:
// a line for every metric instead.
std::string compare_text(const Comparison&, bool colour, bool all = false);
std::string compare_json(const Comparison&);

}  // namespace terrabench
