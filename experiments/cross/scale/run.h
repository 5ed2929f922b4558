// What the parts of the experiment cross.scale share: the sizes of a case, its budget, and how work is timed.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiments/cross/scale/memory_state.h"
#include "experiments/cross/scale/scaling.h"
#include "experiments/experiment.h"
#include "experiments/samples.h"
#include "experiments/stopwatch.h"
#include "terrain/error.h"
#include "terrain/memory.h"

namespace terrabench::cross {

inline double squared(int side) { return static_cast<double>(side) * side; }

// All the sizes of one case, with one budget per stage.
class Run {
 public:
  Run(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress)
      : at_(at), options_(options), recorder_(recorder), progress_(progress), base_(HeapCounter::live()) {}

  SizePlan plan(std::string name, double share, Growth growth) const {
    constexpr double kAvailable = 0.85;  // share of the memory left that is used
    const double asked = at_.parameters.number("memory") * 1024 * 1024 * 1024;
    const double left = kAvailable * static_cast<double>(available_memory());
    return {std::move(name),
            {share * at_.parameters.number("seconds"), static_cast<std::uint64_t>(std::min(asked, left))},
            growth};
  }

  // Does the work at one size if the plan admits it. A structure may refuse a size, but not the first.
  template <class Work>
  bool measured(SizePlan& plan, double columns, const Work& work) const {
    if (!plan.admits(columns)) return false;
    const auto held = static_cast<std::uint64_t>(std::max<std::int64_t>(0, HeapCounter::live() - base_));
    const std::uint64_t expected = std::max(held, plan.expected_bytes(columns));
    // The heap may be fragmented, so that the work cannot use freed blocks again. If too little other memory
    // is available, the freed pages go back to the system first.
    if (available_memory() < expected - held) keep_.give_back();
    keep_.provide(expected - held);
    HeapCounter::reset_peak();
    const double begin = process_seconds();
    try {
      work();
    } catch (const Error& error) {
      if (error.code() == ExitCode::kInterrupted || plan.sizes() == 0) throw;
      plan.refused();
      return false;
    }
    plan.measured(columns, process_seconds() - begin, HeapCounter::peak() - base_);
    return true;
  }

  // Processor seconds of each repetition of the work on one thread. Before each, outside the timed part,
  // clear() frees what the last one made, and the caches are emptied: otherwise they would hold the data of
  // small sizes, but not of large ones. The time therefore includes cache misses on the code, too, which
  // matters most at the smallest sizes. There are six repetitions, or one if it takes more than a second,
  // since the largest sizes take minutes; before them one that is not counted, if it takes under 0.2 s.
  template <class Clear, class Work>
  void add_samples(Cost& cost, double columns, const Clear& clear, const Work& work) const {
    constexpr double kShort = 0.2, kLong = 1;  // seconds
    bool first = true;
    for (Repetitions repetitions(kLong); repetitions.more();) {
      clear();
      caches_.evict();
      const double taken = processor_seconds(work);
      if (std::exchange(first, false) && taken < kShort) continue;
      cost.add(columns, taken);
      repetitions.add(taken);
    }
  }

  // Calls work(side) for every size of the case, in ascending order.
  template <class Work>
  void at_each_side(std::string_view what, bool solid, const Work& work) const {
    const int smallest = at_.integer("smallest"), largest = at_.integer("largest");
    if (largest < smallest) {
      throw usage_error("the largest ground is smaller than the smallest", "largest", "exchange the two");
    }
    const std::vector<int> sides =
        solid ? half_octave_sides(smallest, largest) : doubled_sides(smallest, largest);
    progress_.begin(what, sides.size());
    for (const int side : sides) {
      work(side);
      progress_.advance();
    }
    progress_.end();
  }

  const Case& at() const { return at_; }
  std::uint64_t seed() const { return options_.seed; }
  Recorder& recorder() const { return recorder_; }
  Progress& progress() const { return progress_; }
  const ColdCaches& caches() const { return caches_; }

 private:
  const Case& at_;
  const RunOptions& options_;
  Recorder& recorder_;
  Progress& progress_;
  ColdCaches caches_;
  std::int64_t base_;  // heap bytes before the case, with the block of caches_
  KeepFreedMemory keep_;
};

// Structures over height maps or over a solid: structures.cpp. Over a solid, only types that hold
// overhangs and are not lossless are measured: a lossless type keeps the samples that it was built from, and
// a solid has none.
void measure_structure(const Run&, bool solid, std::string_view name);
std::vector<std::string_view> scaled_structures(bool solid);

// Level of detail along a path: lods.cpp.
void measure_lod(const Run&, std::string_view method);

}  // namespace terrabench::cross
