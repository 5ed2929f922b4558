// A figure of a paper: a number, a caption and the function that draws its sheet. An experiment that draws
// figures is a table of these; its cases, one per figure, differ in the parameter "figure".
#pragma once

#include <memory>
#include <span>
#include <string_view>

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
  int number;             // in the paper
  std::string_view name;  // its case and the value of "figure": "F13"
  std::string_view caption;
  Sheet (*draw)(Drawing&);
};

// Draws the case's figure as "PAPER.NAME.png", and records its number as the metric "figure".
void draw_figure(std::span<const Figure>, std::string_view paper, const Case&, const RunOptions&, Recorder&);

}  // namespace terrabench::figures
