// What a figure contains: its panels and its words. A figure's PNG file carries them as a text chunk, which
// is written by the sheet that drew it and read when the case is recorded; the claims' checks compare them
// with the picture's pixels and with the run's metrics (evidence.h).
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "terrain/image.h"

namespace terrabench {

// A picture within a figure, in pixels of the file.
struct FigurePanel {
  int x = 0, y = 0, width = 0, height = 0;
  bool operator==(const FigurePanel&) const = default;
};

struct FigureLayout {
  std::vector<FigurePanel> panels;  // colour keys are none
  std::vector<std::string> words;   // every text on the sheet, in the order drawn
  bool operator==(const FigureLayout&) const = default;
};

// Adds the layout to a PNG file, which keeps its pixels. Throws bad_input if the file is no PNG,
// environment_error if it cannot be written.
void write_layout(const std::filesystem::path& png, const FigureLayout&);
// Nothing if the file has none that can be read. Reads at most 1 MiB of layout.
std::optional<FigureLayout> read_layout(const std::filesystem::path& png);

// Why the picture does not look as the layout says; empty if it does: each panel lies within the picture and
// shows something, and no two panels show the same, except those of `alike` (from 1).
// O(pixels + panels² · pixels of a panel)
std::string layout_fault(const FigureLayout&, const Image&, std::span<const int> alike = {});
// Whether a number in the words equals the value: exactly, or to its digits if these round by 1/20 at most.
bool says(const FigureLayout&, double value);

}  // namespace terrabench
