// How a representation differs from the ground that it was built from: heights, volumes, surfaces, and what
// it loses under overhangs. Everything is derived from spans(), which all types answer, at the same places.
//
// The ground is sampled along vertical lines on a square lattice with a prime number of lines, so that they
// meet the sample points of no structure throughout. A solid's lines are sampled at four points per distance
// of two lines, and at 16 more between two that differ; those of heights have one exact span.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "representations/representation.h"
#include "terrain/source.h"

namespace terrabench::cross {

struct Part {
  float bottom, top;  // metres
};

// Spans of lines, without materials; those that touch are joined.
class LineParts {
 public:
  void add(Part part);  // upward
  void end_line() { ends_.push_back(static_cast<std::uint32_t>(parts_.size())); }
  void append(const LineParts&);
  std::size_t lines() const { return ends_.size(); }
  std::span<const Part> line(std::size_t i) const {
    const std::uint32_t first = i == 0 ? 0 : ends_[i - 1];
    return {parts_.data() + first, ends_[i] - first};
  }

 private:
  std::vector<Part> parts_;
  std::vector<std::uint32_t> ends_;
};

struct GroundLines {
  int width = 0, depth = 0;  // lines along x and z
  float step = 0;            // metres between lines
  std::vector<float> x, z;   // per line, row by row
  Bounds bounds;
  LineParts parts;

  std::size_t index(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(width) + static_cast<std::size_t>(i);
  }
};

// `along` lines on the longer side. O(lines · height / step), parallel, the same for any number of threads.
GroundLines ground_lines(const TerrainSource&, int along);
// The same with each line at a random place of its square, so that no structure whose columns are searched
// can coincide with them: for volumes.
GroundLines random_lines(const TerrainSource&, int along, std::uint64_t seed);
// The representation's spans on the same lines, cut to the ground's bounds.
LineParts lines_of(const Representation&, const GroundLines&);

struct Differences {
  // Tops of columns: at every sample of a height field, or on the lines of a solid. Metres. Of no columns, 0.
  double rmse = 0, p99 = 0, largest = 0;
  std::size_t columns = 0, lost_columns = 0;  // lost: only one of the two has ground
  std::optional<double> volume_iou;           // on the lines; nothing if neither has volume there
  // Distances between points on both surfaces, sampled alike: on the lines, and on walls along the lines next
  // to them, so that walls stand up to a step beside their true place in both. 0 for equal lines; metres;
  // nothing if one of the two has no points.
  struct Distance {
    double from_ground = 0, to_ground = 0;
    double hausdorff() const { return std::max(from_ground, to_ground); }
  };
  std::optional<Distance> distance;
  // Air under a roof, in cubic metres. The core is what lies more than `margin` away from all that is solid.
  double cavities = 0, cores = 0;
  double cavities_filled = 0, cores_filled = 0;  // the representation's solid parts within
};

// `margin` in metres.
Differences differences(const Representation&, const TerrainSource&, const GroundLines&, float margin);
// Only those of tops and volumes, which cost much less.
Differences top_and_volume_differences(const Representation&, const TerrainSource&, const GroundLines&);
// What representation and ground do not share, 1 - IoU: of their volumes, and of the air under overhangs of
// either. 0 if neither has any.
struct VolumeErrors {
  double volume = 0, air = 0;
};
VolumeErrors volume_errors(const Representation&, const GroundLines&);

// The parts of differences(), for tests.
double overlap(std::span<const Part>, std::span<const Part>);  // metres
std::vector<Part> without(std::span<const Part>, std::span<const Part> removed, float margin);

}  // namespace terrabench::cross
