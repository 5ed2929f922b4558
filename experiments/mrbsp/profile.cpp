// Table 1 and figure 2: the two-dimensional example of visibility.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "experiments/drill/sheet.h"
#include "experiments/mrbsp/mrbsp.h"
#include "lod/mrbsp/profile_visibility.h"
#include "lod/mrbsp/visibility_file.h"

namespace terrabench::mrbsp {
namespace {

using drill::Sheet;
using drill::SheetPoint;

// Coarse and fine changes, as the table prints them; where it breaks off, so do these.
struct Line {
  std::string_view step, coarse, fine;
};
constexpr std::array<Line, 3> kTable1{{{"a-b", "11", "1100, 1101, 1110, 1111"},
                                       {"d-e", "00, 01, 10, 11", "0000, 0001, 0010, 0011,"},
                                       {"g-h", "00", "0000, 0001, 0010, 0011"}}};

// Lines of the file that are not the table's, and lines of the table that are not in the file.
std::size_t differing_lines(const VisibilityTable& table, int fine_depth) {
  const std::string text = visibility_text(table);
  std::vector<std::string> steps;
  std::size_t at = text.find("\nstart ") + 1;
  for (at = text.find('\n', at) + 1; at < text.size(); at = text.find('\n', at) + 1) {
    steps.push_back(text.substr(at, text.find('\n', at) - at));
  }
  std::size_t found = 0;
  for (const Line& line : kTable1) {
    for (int step = 0; step < table.steps(); ++step) {
      const std::string name = cell_name(table.cells, step, 0) + "-" + cell_name(table.cells, step + 1, 0);
      if (name != line.step) continue;
      const bool coarse =
          std::find(steps.begin(), steps.end(), fmt::format("{} {}", line.step, line.coarse)) != steps.end();
      const std::string fine = fine_changes(table.step(step), table.depth, fine_depth);
      found += coarse && fine.starts_with(line.fine);
    }
  }
  return kTable1.size() - found + (steps.size() - std::min(steps.size(), found));
}

constexpr double kLeft = 70, kTop = 40, kWidth = 880, kHeight = 250;
constexpr drill::SheetPoint kSheet{980, 470};
constexpr Rgb kInk{0, 0, 0}, kCoarse{165, 165, 165}, kDark{110, 110, 110}, kPale{228, 228, 228},
    kWords{32, 32, 32};

class Drawing {
 public:
  Drawing(const ProfileScene& profile, const VisibilityTable& table)
      : profile_(profile), table_(table), sheet_(kSheet.x, kSheet.y) {}

  const Sheet& draw() {
    cells();
    // Coarse below fine, so that both show where they run close together.
    const std::size_t stride = profile_.heights.size() / (std::size_t{1} << profile_.coarse_depth);
    outline(stride, {.colour = kCoarse, .thickness = 5}, 9);
    outline(1, {.colour = kInk, .thickness = 2}, 5);
    labels(profile_.depth, kTop + kHeight + 34, 12, kInk);
    labels(profile_.coarse_depth, kTop + kHeight + 58, 14, kDark);
    sheet_.text(kLeft - 12, kTop + kHeight + 34, "fine", 12, "end");
    sheet_.text(kLeft - 12, kTop + kHeight + 58, "coarse", 12, "end", kDark);
    sheet_.text(kLeft - 12, kTop + kHeight + 94, "cell", 12, "end");
    sheet_.text(kLeft - 12, kTop - 18, "height", 12, "end");
    for (const int height : {0, 5, 10}) {
      sheet_.text(kLeft - 12, at(0, static_cast<float>(height)).y + 4, std::to_string(height), 12, "end");
    }
    return sheet_;
  }

 private:
  SheetPoint at(double x, float height) const {
    return {kLeft + kWidth * x / static_cast<double>(profile_.heights.size() - 1),
            kTop + kHeight * (1 - height / 10.0)};
  }
  void outline(std::size_t stride, const drill::Stroke& stroke, double tick) {
    std::vector<SheetPoint> points;
    for (std::size_t k = 0; k < profile_.heights.size(); k += stride) {
      points.push_back(at(static_cast<double>(k), profile_.heights[k]));
    }
    sheet_.line(points, stroke);
    for (const SheetPoint& p : points) {
      sheet_.line(std::array{SheetPoint{p.x, p.y - tick}, SheetPoint{p.x, p.y + tick}}, stroke);
    }
  }
  void labels(int depth, double y, int size, Rgb colour) {
    const std::uint64_t count = std::uint64_t{1} << depth;
    for (std::uint64_t k = 0; k < count; ++k) {
      sheet_.text(kLeft + kWidth * (static_cast<double>(k) + 0.5) / static_cast<double>(count), y,
                  label(count + k), size, "middle", colour);
    }
  }
  // Dark where a step to a neighbour changes what is seen.
  void cells() {
    const double side = kWidth / table_.cells.columns, y = kTop + kHeight + 74;
    for (int c = 0; c < table_.cells.columns; ++c) {
      const bool changes =
          (c > 0 && !table_.step(c - 1).empty()) || (c + 1 < table_.cells.columns && !table_.step(c).empty());
      sheet_.box(kLeft + c * side + 1, y, side - 2, 30, changes ? kDark : kPale);
      sheet_.text(kLeft + (c + 0.5) * side, y + 20, cell_name(table_.cells, c, 0), 15, "middle",
                  changes ? Rgb{255, 255, 255} : kWords);
      if (c > 0) {
        sheet_.line(std::array{SheetPoint{kLeft + c * side, kTop - 10}, SheetPoint{kLeft + c * side, y}},
                    {.colour = kPale, .dashes = "4,4"});
      }
      if (c + 1 < table_.cells.columns && !table_.step(c).empty()) {
        std::string words;
        for (const std::uint32_t e : table_.step(c)) {
          words += (words.empty() ? "" : ", ") + label((NodeNumber{1} << table_.depth) + e);
        }
        const double x = kLeft + (c + 1) * side;
        sheet_.line(std::array{SheetPoint{x, y + 30}, SheetPoint{x, y + 40}}, {.colour = kInk});
        sheet_.text(x, y + 56, words, 13, "middle");
      }
    }
    sheet_.text(kLeft - 12, y + 56, "changes", 12, "end");
  }

  const ProfileScene& profile_;
  const VisibilityTable& table_;
  Sheet sheet_;
};

}  // namespace

std::vector<Case> profile_cases(const RunOptions&) { return {Case{"profile", Parameters(), ""}}; }

void measure_profile(const Case&, const RunOptions&, Recorder& recorder, Progress&) {
  const ProfileScene& profile = table1_profile();
  const VisibilityTable table = changes_of(find_visible(profile));
  recorder.add("differing_lines", "", static_cast<double>(differing_lines(table, profile.depth)));
  recorder.add("changes", "", static_cast<double>(table.changes.size()));
  // And through the file and back.
  const VisibilityTable again = parse_visibility(visibility_text(table), "table 1");
  recorder.add("lost_in_the_file", "", again == table ? 0 : 1);
  Drawing(profile, table)
      .draw()
      .write(recorder.figure(
          "mrbsp.F2", "png",
          "Figure 2 of the paper: fine segments (black) and coarse ones (grey) with their numbers in the "
          "tree, "
          "and cells; those beside a change of visibility are dark, with the coarse segments that change"));
}

}  // namespace terrabench::mrbsp
