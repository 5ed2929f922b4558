// A figure of a paper: a number, a caption and the function that draws its sheet, most often a grid of
// panels. An experiment that draws figures is a table of these; its cases, one per figure, differ in the
// parameter "figure".
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "experiments/experiment.h"
#include "experiments/figures/sheet.h"
#include "renderers/context.h"

namespace terrabench::figures {

// What a figure is drawn with.
class Drawing {
 public:
  explicit Drawing(const RunOptions& options) : options_(options) {}  // keeps a reference
  std::uint64_t seed() const { return options_.seed; }
  GlContext& gl();  // opened at the first call; throws as open_context() does

 private:
  const RunOptions& options_;
  std::unique_ptr<GlContext> gl_;
};

struct Figure {
  int number;                // in the paper
  std::string_view name;     // its case and the value of "figure": "F13"
  std::string_view caption;  // after "Figure 13 of the paper: "
  Sheet (*draw)(Drawing&);
};

// Draws the case's figure as "PAPER.NAME.png", and records its number as the metric "figure".
void draw_figure(std::span<const Figure>, std::string_view paper, const Case&, const RunOptions&, Recorder&);

using PanelRows = std::vector<std::vector<Panel>>;  // rows are not empty

struct PanelStyle {      // in units of the sheet
  double margin = 14;    // around and between panels
  double words = 26;     // height of the strip under each picture
  double baseline = 17;  // of the words, below the picture
  int text_size = 14;
  std::optional<Rgb> frame{};  // one unit wide around each picture
};

// Pictures of one row have one height; a row narrower than the sheet is centred.
Sheet panel_sheet(const PanelRows&, const PanelStyle& = {});
// The panels in rows of `across`, the last one possibly shorter.
PanelRows in_rows_of(std::size_t across, std::vector<Panel>);

}  // namespace terrabench::figures
