#include <array>
#include <filesystem>

#include "terrain/parameters.h"
#include "terrain/sources/drawing/drawing.h"

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

// Where the adjustments begin: at a comma with "word=" behind it.
std::size_t end_of_file_name(std::string_view text) {
  for (std::size_t at = text.find(','); at != text.npos; at = text.find(',', at + 1)) {
    const std::size_t end = text.find_first_not_of("abcdefghijklmnopqrstuvwxyz_", at + 1);
    if (end != text.npos && end > at + 1 && text[end] == '=') return at;
  }
  return text.size();
}

}  // namespace

NamedDrawing parse_drawing(std::string_view text) {
  std::error_code ignored;
  const bool whole = std::filesystem::exists(std::filesystem::path(text), ignored);
  const std::size_t end = whole ? text.size() : end_of_file_name(text);
  NamedDrawing drawing{std::string(text.substr(0, end)), {}};
  Parameters given(kSpecs);
  for (std::string_view rest = text.substr(end); !rest.empty();) {
    rest.remove_prefix(1);  // the comma
    const std::string_view assignment = rest.substr(0, rest.find(','));
    given.set_from_text(assignment);
    rest.remove_prefix(assignment.size());
  }
  const auto number = [&](std::string_view name) { return static_cast<float>(given.number(name)); };
  drawing.options = {.cell = number("cell"),
                     .sea_level = number("sea_level"),
                     .peak = number("peak"),
                     .seabed = number("seabed"),
                     .smoothing = static_cast<int>(given.integer("smoothing")),
                     .mountains = number("mountains")};
  return drawing;
}

}  // namespace terrabench
