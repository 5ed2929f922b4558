// Changes heights of samples of a triangulation by greedy insertion where they changed. The vertices at those
// samples and beside them are taken out; then of all samples in changed triangles the one that is missed by
// most becomes a vertex, until none is missed by more than the limit (Garland & Heckbert 1995, algorithm III,
// from these triangles on). The result is the Delaunay triangulation of its vertices, as any other.
//
// A triangulation does not have the samples that it was built from. The ground to be met is the surface
// itself before the change, at each sample of the triangles that change, and the heights that are set. So
// each change moves the samples that it does not set by at most the limit, and only within triangles that
// gain or lose a corner. Keeping the samples would bound the sum of many changes too, at 4 B per sample,
// where the whole triangulation of noise hills takes 5 to 6.
//
// O(s + v log v) for s samples in changed triangles and v new vertices.
#pragma once

#include <queue>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "representations/tin/height_window.h"
#include "representations/tin/locator.h"
#include "terrain/tin/greedy_insertion.h"

namespace terrabench::tin {

class Reinsertion {
 public:
  // `largest_error` in metres; where planes cannot be evaluated so closely, what floats can.
  Reinsertion(Approximation&, Locator&, int width, int depth, float largest_error, float highest);

  // As it was, or as it was set; NaN is no data.
  float height(Sample s) { return known(s); }
  void set(Sample, float height);
  // Returns whether anything changed. To be called once, after the last set().
  bool finish();

 private:
  struct Due {
    Candidate candidate;
    std::uint32_t triangle;
    bool operator<(const Due& other) const {
      if (candidate.error != other.candidate.error) return candidate.error < other.candidate.error;
      return before(other.candidate.at, candidate.at);
    }
  };

  float& known(Sample);
  bool is_hole(std::uint32_t triangle) const { return !holes_.empty() && holes_[triangle] != 0; }
  void keep(std::uint32_t triangle);
  template <class Visit>
  void around(Sample, const Visit& visit) const;
  void locate(Sample s) { near_ = surface_.locate(s, near_); }
  void take_out(Sample, bool changed);
  void changed_since(std::size_t before);
  bool no_data(int i, int j);
  bool on_rim(Sample);
  bool solid(const Triangle&);
  void insert(Sample);
  void scan_changed();
  void compact();

  Delaunay& surface_;
  std::vector<float>& heights_;
  std::vector<std::uint8_t>& holes_;
  Locator& locator_;
  int width_, depth_;
  float limit_;

  HeightWindow window_;
  std::vector<Sample> set_;
  bool changing_ = false;                   // the locator is out of date
  std::uint32_t near_ = 0;                  // where the next walk begins
  std::unordered_set<std::uint32_t> kept_;  // triangles of which the window knows all samples
  std::vector<std::uint32_t> changed_;      // triangles, since the last scan
  std::unordered_map<std::uint32_t, Candidate> candidates_;  // of all changed triangles
  std::priority_queue<Due> due_;                             // some no longer candidates
};

}  // namespace terrabench::tin
