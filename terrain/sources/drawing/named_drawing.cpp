#include <array>
#include <utility>

#include "terrain/parameters.h"
#include "terrain/sources/drawing/drawing.h"
#include "terrain/sources/named_file.h"

namespace terrabench {
namespace {

// land_from_drawing() checks the ranges.
const std::array kSpecs{
    ParameterSpec{"cell", 30.0, "m", "side of a pixel"},
    ParameterSpec{"sea_level", 0.3, "", "intensity at the shore"},
    ParameterSpec{"peak", 1000.0, "m", "height of white"},
    ParameterSpec{"seabed", 0.1, "", "depth of black, as a share of the peak"},
    ParameterSpec{"smoothing", std::int64_t{2}, "passes", "of diffusion", 0, 1000},
    ParameterSpec{"mountains", 0.6, "", "height that is never smoothed, as a share of the peak"},
};

}  // namespace

NamedDrawing parse_drawing(std::string_view text) {
  NamedFile named = parse_named_file(text, kSpecs);
  const Parameters& given = named.options;
  const auto number = [&](std::string_view name) { return static_cast<float>(given.number(name)); };
  return {std::move(named.file),
          {.cell = number("cell"),
           .sea_level = number("sea_level"),
           .peak = number("peak"),
           .seabed = number("seabed"),
           .smoothing = static_cast<int>(given.integer("smoothing")),
           .mountains = number("mountains")}};
}

}  // namespace terrabench
