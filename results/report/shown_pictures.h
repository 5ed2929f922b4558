// Which pictures the report and the LaTeX bundle show, with their titles and captions.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "results/claims/judge.h"
#include "results/claims/layouts.h"
#include "results/report/document.h"

namespace terrabench {

// A picture of a store; points into it.
struct ShownPicture {
  const Record* record;
  const RecordedFigure* figure;
  std::string title, caption;
};

// The drawn pictures that the paper's claims judge, in the claims' order. A picture that a claim of class F
// judges is shown with that claim only, although other claims may have it as a condition too. Reads no file.
std::vector<ShownPicture> claimed_pictures(const Store&, const JudgedResults&, const Paper&);

// The figures that these cases drew, in this order. Reads no file. Captions have `label`, what readers call
// the ground, instead of the path of its DEM.
std::vector<ShownPicture> drawn_pictures(const Store&, std::string_view profile,
                                         std::span<const PageLayout::Drawn> cases, std::string_view label);

// The panels of a figure by their names, "(a) …", if all have one and all are of one size, so that they can
// be laid over each other; otherwise none.
std::vector<NamedPanel> comparable_panels(const FigureLayout&);

}  // namespace terrabench
