// The setting of a method's knob that gives a wanted error, by bisection on a logarithmic scale with
// interpolation between the ends of the bracket. What was tried for one target serves the next.
#pragma once

#include <functional>
#include <map>

#include "lod/lod.h"

namespace terrabench::cross {

struct Tuned {
  double knob = 0, error = 0;
  // The error is at most the target, and within kSlack of it unless the next setting has more. False too
  // where even the coarsest setting has less: such a method is not at the asked error.
  bool reached = false;
};

class KnobSearch {
 public:
  // A tried setting this little below the target is as good as it.
  static constexpr double kSlack = 0.02;

  explicit KnobSearch(const Knob& knob);

  // The coarsest setting found with error ≤ target; the finest there is when even that has more. About six
  // calls of error_at(knob), which should rise from finest to coarsest.
  Tuned find(double target, const std::function<double(double)>& error_at);
  std::size_t tried() const { return errors_.size(); }

 private:
  double knob_at(double place) const;  // 0 finest … 1 coarsest
  double place_of(double knob) const;
  double next_place(double target) const;  // negative when there is nothing more to try

  Knob knob_;
  double octaves_;                   // from one end of the knob to the other
  std::map<double, double> errors_;  // by place
};

}  // namespace terrabench::cross
