// Whether another guest of the machine disturbs the processor core that something is timed on. On a machine
// that others share a core is at times only some 60 % as fast, for tenths of a second or for minutes, because
// its second hardware thread is in use. Neither processor time nor the kernel's count of stolen time shows
// that; a fixed loop does. What was timed beside a slow loop is taken again, and left out if enough is left.
// The loop alone decides: of samples beside equally fast loops none is preferred for its time.
//
// The loop sees the core that runs it, not the others, and nothing of other programs that take their turns on
// it. A process that is disturbed from start to end knows no fast loop, and notices nothing.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace terrabench {

// Processor seconds that the loop takes now, about 1e-4. If that seems slow, it is tried again after some
// milliseconds, so that what the program itself did just before does not count, such as threads that still
// spin. At its first call it takes 10 ms.
double loop_seconds();
double shortest_loop();  // of all so far in this process; infinite before the first

// A core whose second thread is busy takes 1.3 to 1.9 times as long.
inline bool disturbed(double loop) { return loop > 1.2 * shortest_loop(); }

// Samples of one piece of work, each taken in one go.
class Turns {
 public:
  // True until there are `wanted` undisturbed samples, or 2 · wanted in all. If `wanted` is 1, one sample is
  // taken and never repeated, since such work is long.
  bool more(std::size_t wanted) const;
  // `loop`: the slower of those before and after the sample.
  void add(std::vector<double> sample, double loop);
  std::size_t taken() const { return samples_.size(); }
  std::size_t undisturbed() const;
  // The undisturbed samples if there are `enough`, otherwise all, in the order in which they were taken.
  std::vector<std::vector<double>> kept(std::size_t enough) const;

 private:
  struct Sample {
    std::vector<double> values;
    double loop;
  };
  std::vector<Sample> samples_;
};

// Takes samples by work(), which returns a vector of values, until turns.more(wanted) is false.
template <class Work, class Loop = double (*)()>
void take_turns(Turns& turns, std::size_t wanted, const Work& work, Loop loop = loop_seconds) {
  double before = loop();
  while (turns.more(wanted)) {
    std::vector<double> sample = work();
    const double after = loop();
    turns.add(std::move(sample), before > after ? before : after);
    before = after;
  }
}

}  // namespace terrabench
