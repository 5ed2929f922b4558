#include "experiments/figures/figure.h"

#include <fmt/format.h>

namespace terrabench::figures {

GlContext& Drawing::gl() {
  if (!gl_) gl_ = open_context(options_.renderer, 64, 64);  // each picture sets its own size
  return *gl_;
}

void draw_figure(std::span<const Figure> figures, std::string_view paper, const Case& at,
                 const RunOptions& options, Recorder& recorder) {
  const Figure& figure = figures[at.parameters.choice("figure")];
  recorder.add("figure", "", figure.number);
  Drawing drawing(options);
  figure.draw(drawing).write(
      recorder.figure(fmt::format("{}.{}", paper, figure.name), "png", figure.caption));
}

}  // namespace terrabench::figures
