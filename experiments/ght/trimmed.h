// Panels without the white around their pictures, so that a sheet is filled by what it shows.
#pragma once

#include "experiments/figures/figure.h"

namespace terrabench::ght {

// Takes away white rows of pixels that all panels of a row share, and white columns that all panels of all
// rows with as many panels share: pictures of the same size stay so, and what they show stays in the same
// place. A margin of some pixels remains. O(pixels)
figures::PanelRows trimmed(figures::PanelRows);

}  // namespace terrabench::ght
