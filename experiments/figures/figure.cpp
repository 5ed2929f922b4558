#include "experiments/figures/figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace terrabench::figures {

GlContext& Drawing::gl() {
  if (!gl_) gl_ = open_context(options_.renderer, 64, 64);  // each picture sets its own size
  return *gl_;
}

void draw_figure(std::span<const Figure> figures, std::string_view paper, const Case& at,
                 const RunOptions& options, Recorder& recorder) {
  const Figure& figure = figures[at.parameters.choice("figure")];
  Drawing drawing(options, &recorder);
  const Sheet sheet = figure.draw(drawing);
  sheet.write(recorder.figure(fmt::format("{}.{}", paper, figure.name),
                              fmt::format("Figure {} of the paper: {}", figure.number, figure.caption)));
}

Sheet panel_sheet(const PanelRows& rows, const PanelStyle& style) {
  const auto across = [&](const std::vector<Panel>& row) {
    double width = style.margin;
    for (const Panel& panel : row) width += panel.width() + style.margin;
    return width;
  };
  double width = 0, height = style.margin;
  for (const std::vector<Panel>& row : rows) {
    width = std::max(width, across(row));
    height += row[0].height() + style.words + style.margin;
  }
  Sheet sheet(width, height);
  double y = style.margin;
  for (const std::vector<Panel>& row : rows) {
    double x = style.margin + (width - across(row)) / 2;
    for (const Panel& panel : row) {
      const double wide = panel.width(), high = panel.height();
      if (style.frame) sheet.box(x - 1, y - 1, wide + 2, high + 2, *style.frame);
      sheet.picture(x, y, wide, high, panel.image);
      sheet.text(x + wide / 2, y + high + style.baseline, panel.words, style.text_size, "middle");
      x += wide + style.margin;
    }
    y += row[0].height() + style.words + style.margin;
  }
  return sheet;
}

PanelRows in_rows_of(std::size_t across, std::vector<Panel> panels) {
  PanelRows rows;
  for (std::size_t k = 0; k < panels.size(); ++k) {
    if (k % across == 0) rows.emplace_back();
    rows.back().push_back(std::move(panels[k]));
  }
  return rows;
}

}  // namespace terrabench::figures
