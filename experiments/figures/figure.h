// A figure of a paper: its number, its caption and a function that draws its sheet, most often a grid of
// panels. An experiment that draws figures has a table of these, and one case per figure, with the figure's
// name as the parameter "figure". (A figure that a record holds is RecordedFigure, results/store/record.h.)
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "experiments/cases.h"
#include "experiments/figures/sheet.h"
#include "renderers/context.h"

namespace terrabench::figures {

// What a function that draws a figure may use.
class Drawing {
 public:
  // Keeps references. Without a recorder, what record() is given is lost.
  explicit Drawing(const RunOptions& options, Recorder* recorder = nullptr)
      : options_(options), recorder_(recorder) {}
  std::uint64_t seed() const { return options_.seed; }
  GlContext& gl();  // opened at the first call; throws as open_context() does
  // A metric of the figure's case: a count that the figure prints, so that a check can compare the two.
  void record(std::string_view metric, double value) {
    if (recorder_ != nullptr) recorder_->add(metric, "", value);
  }

 private:
  const RunOptions& options_;
  Recorder* const recorder_;
  std::unique_ptr<GlContext> gl_;
};

struct Figure {
  int number;                // in the paper
  std::string_view name;     // the case's name and the value of "figure", such as "F13"
  std::string_view caption;  // follows "Figure 13 of the paper: "
  Sheet (*draw)(Drawing&);
};

// Draws the case's figure as "PAPER.NAME".
void draw_figure(std::span<const Figure>, std::string_view paper, const Case&, const RunOptions&, Recorder&);

// An experiment that draws the figures of a table, such as `constexpr std::array kFigures{Figure{…}, …}`.
template <const auto& kFigures>
Experiment figure_experiment(std::string_view id, std::string_view title) {
  static const std::array kNames = names_of(kFigures);
  static const std::array kSpecs{choice("figure", kNames, "figure of the paper")};
  static const std::string_view paper = id.substr(0, id.find('.'));
  return {id, title, kSpecs, [](const RunOptions&) { return cases_by("figure", kSpecs); },
          [](const Case& at, const RunOptions& options, Recorder& recorder, Progress&) {
            draw_figure(kFigures, paper, at, options, recorder);
          }};
}

using PanelRows = std::vector<std::vector<Panel>>;  // rows are not empty

struct PanelStyle {      // in units of the sheet
  double margin = 14;    // around and between panels
  double words = 26;     // height of the strip for the text under each picture
  double baseline = 17;  // of the text, below the picture
  int text_size = 14;
  std::optional<Rgb> frame{};  // colour of a frame one unit wide around each picture
};

// All pictures of a row must have the same height. A row narrower than the sheet is centred.
Sheet panel_sheet(const PanelRows&, const PanelStyle& = {});
// The panels in rows of `across`; the last row may be shorter.
PanelRows in_rows_of(std::size_t across, std::vector<Panel>);

}  // namespace terrabench::figures
