#include "results/report/report_parts.h"

#include <tbb/parallel_for_each.h>

#include "results/plot/plot.h"
#include "results/plot/rasterise.h"
#include "results/report/fill.h"
#include "results/report/preview.h"
#include "results/report/report_tables.h"
#include "terrain/error.h"
#include "terrain/files.h"

namespace terrabench {
namespace {

constexpr int kBitmapWidth = 1760;  // twice the plots' own size: sharp in print
constexpr int kPreviewWidth = 896;  // as the page shows them: 56 rem

std::vector<Link> run_links(const std::vector<std::string>& runs) {
  std::vector<Link> links;
  for (const std::string& run : runs) links.push_back({"run " + short_id(run), "#" + run_anchor(run)});
  return links;
}

}  // namespace

ReportParts::ReportParts(const Store& store, std::string profile, std::filesystem::path out)
    : store_(store), profile_(std::move(profile)), out_(std::move(out)) {
  for (const Record& record : store_.records()) {
    if (record.profile != profile_) continue;
    for (const RecordedFigure& figure : record.figures) {
      if (store_.intact(figure)) previews_[{figure.checksum, figure.file}];
    }
  }
  tbb::parallel_for_each(previews_, [&](auto& picture_and_preview) {
    auto& [picture, preview] = picture_and_preview;
    try {
      preview = webp_preview(read_png(store_.folder() / picture.second), kPreviewWidth);
    } catch (const Error& error) {
      if (error.code() != ExitCode::kBadInput) throw;
    }
  });
}

TableBlock ReportParts::table(Table table, const std::vector<std::string>& runs) const {
  const std::string stem = "tables/" + file_name(table.id);
  write_file(out_ / (stem + ".csv"), csv(table));
  write_file(out_ / (stem + ".md"), markdown(table));
  write_file(out_ / (stem + ".tex"), latex(table));
  std::vector<Link> links = run_links(runs);
  links.push_back({"CSV", stem + ".csv"});
  links.push_back({"Markdown", stem + ".md"});
  links.push_back({"LaTeX", stem + ".tex"});
  return {std::move(table), std::move(links)};
}

std::optional<Gallery> ReportParts::plot(const PlotLayout& layout) const {
  const FilledPlot filled = fill(layout, store_, profile_);
  if (filled.runs.empty()) return std::nullopt;
  const std::string stem = "figures/" + file_name(layout.id);
  write_file(out_ / (stem + ".svg"), plot_svg(filled.plot));
  svg_to_png(out_ / (stem + ".svg"), out_ / (stem + ".png"), kBitmapWidth);
  std::vector<Link> links = run_links(filled.runs);
  links.push_back({"PNG", stem + ".png"});
  return Gallery{
      {{layout.title, layout.caption, stem + ".svg", stem + ".png", std::move(links), "", layout.id}}};
}

std::optional<Picture> ReportParts::picture(const Record& record, const RecordedFigure& figure,
                                            std::string title, std::string caption) const {
  const auto preview = previews_.find({figure.checksum, figure.file});
  if (preview == previews_.end() || preview->second.empty()) return std::nullopt;
  const std::string to = picture_file(figure), original = "../" + url_path(figure.file);
  write_file(out_ / to, preview->second);
  std::vector<Link> links = run_links({record.run});
  links.push_back({"Full size", original});
  return Picture{std::move(title), std::move(caption), to, "", std::move(links), original};
}

}  // namespace terrabench
