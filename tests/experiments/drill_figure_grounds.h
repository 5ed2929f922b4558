// What the tests of the drill paper's figures share: a ground whose figures are drawn, and its mirror image.
#pragma once

#include "experiments/drill/figures.h"
#include "experiments/drill/ground.h"
#include "tests/experiments/sheet_reader.h"

namespace terrabench::drill {

// A ground of hills, and its mirror image: the same heights in other places.
struct Grounds {
  Heightfield one = crop(noise_hills(110, 3), 0, 0, 110, 90), other = one;
  FlowNetwork network, other_network;
  Grounds() {
    for (int j = 0; j < one.depth; ++j) {
      for (int i = 0; i < one.width; ++i) other.at(i, j) = one.at(one.width - 1 - i, j);
    }
    network = route_flow(one);
    other_network = route_flow(other);
  }
  Study study() const { return {one, network, kVariants[0], "hills", ""}; }
  Study mirrored() const { return {other, other_network, kVariants[0], "hills", ""}; }
};

inline const Grounds& grounds() {
  static const Grounds both;
  return both;
}

inline SheetReader read(figures::Sheet sheet) { return SheetReader(sheet); }

}  // namespace terrabench::drill
