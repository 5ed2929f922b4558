// The figures of §2 of "ght".
#pragma once

#include <span>

#include "experiments/figures/figure.h"

namespace terrabench::ght {

std::span<const figures::Figure> stage_figures();  // 1 and 3 to 10

// stage_drawings.cpp
figures::Sheet draw_midpoints(figures::Drawing&);
figures::Sheet draw_neighbourhoods(figures::Drawing&);
figures::Sheet draw_diamond_square_steps(figures::Drawing&);
figures::Sheet draw_straddling_diamond(figures::Drawing&);
figures::Sheet draw_first_fault(figures::Drawing&);
figures::Sheet draw_fault_maps(figures::Drawing&);

}  // namespace terrabench::ght
