// What a figure contains: its panels and its words. The sheet that draws it says so to the record; the
// claims' checks compare them with the picture's pixels and with the run's metrics (evidence.h).
#pragma once

#include <filesystem>
#include <functional>
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
  // Panels that show the same, from 1: of each such panel the first that shows it and its own number. Taken
  // from the picture as it was drawn, since two parts of a WebP file with losses are never the same.
  std::vector<int> repeats = {};
  bool operator==(const FigureLayout&) const = default;
};

// A figure that is to be drawn: the file to write, and what takes its layout; nothing needs to. One of which
// nothing is said is recorded as a single panel.
struct FigureFile {
  std::filesystem::path path;
  std::function<void(const FigureLayout&)> contains = [](const FigureLayout&) {};
};

// The layout with `repeats` as this picture has them. O(panels² · pixels of a panel)
FigureLayout with_repeats(FigureLayout, const Image&);
// Why the picture does not look as the layout says; empty if it does: each panel lies within the picture and
// shows something that the eye can see, and no panel repeats another, except those of `alike` (from 1).
// O(pixels)
std::string layout_fault(const FigureLayout&, const Image&, std::span<const int> alike = {});
// Whether a number in the words equals the value: exactly, or to its digits if these round by 1/20 at most.
bool says(const FigureLayout&, double value);

}  // namespace terrabench
