// A figure that is a grid of pictures with words under each.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/figures/sheet.h"

namespace terrabench::figures {

struct Panel {
  Image image;
  std::string words;
  double scale = 1.0 / Sheet::kPixels;  // units of the sheet per pixel of the image
  double width() const { return scale * image.width; }
  double height() const { return scale * image.height; }
};
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
