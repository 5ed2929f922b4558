// Figure 2 and table 1 of the paper as pictures.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "experiments/mrbsp/extruded_profile.h"

namespace terrabench::mrbsp {

// "00, 01" for segments 0 and 1 of two digits; "d-e" for the step from the fourth cell.
std::string segment_labels(std::span<const std::uint32_t> segments, int digits);
std::string step_name(std::size_t step);

void draw_profile(std::span<const float> profile, std::span<const ProfileStep>,
                  const std::filesystem::path& png);

// A row of table 1 as printed.
struct PrintedStep {
  std::string_view name, coarse, fine;
};
// Printed and computed rows side by side, for all steps in either.
void draw_table(std::span<const PrintedStep>, std::span<const ProfileStep>, const std::filesystem::path& png);

}  // namespace terrabench::mrbsp
