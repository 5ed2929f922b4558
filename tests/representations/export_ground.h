// What a representation answers along the lines of an export, asked one line at a time.
#pragma once

#include "representations/line_grid.h"
#include "tests/representations/ground.h"

namespace terrabench::test {

inline std::vector<float> tops(const Representation& built, const LineGrid& lines) {
  std::vector<float> x, z;
  for (int j = 0; j < lines.depth; ++j) {
    for (int i = 0; i < lines.width; ++i) {
      x.push_back(lines.x(i));
      z.push_back(lines.z(j));
    }
  }
  std::vector<float> heights(x.size());
  topmost(spans_of(built, {x, z}), heights);
  return heights;
}

}  // namespace terrabench::test
