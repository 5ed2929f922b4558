#include <algorithm>
#include <array>
#include <utility>

#include "experiments/mrbsp/figures.h"
#include "lod/mrbsp/visibility/codec.h"

namespace terrabench::mrbsp {
namespace {

using figures::Sheet;
using figures::SheetPoint;

constexpr double kLeft = 90, kTop = 40, kWidth = 880, kHeight = 250;
constexpr figures::SheetPoint kSheet{1000, 450};
constexpr Rgb kInk{0, 0, 0}, kCoarse{165, 165, 165}, kDark{110, 110, 110}, kPale{228, 228, 228},
    kWords{32, 32, 32};

class ProfileDrawing {
 public:
  ProfileDrawing(std::span<const float> profile, std::span<const ProfileStep> steps)
      : profile_(profile), steps_(steps) {}

  ProfileSheet draw() {
    sheet_.panel(0, 0, kSheet.x, kSheet.y);
    cells();
    // Coarse under fine, so that both show where they nearly coincide.
    outline(profile_.size() >> kCoarseDigits, {.colour = kCoarse, .thickness = 5}, 9);
    outline(1, {.colour = kInk, .thickness = 2}, 5);
    drawn_.fine_segments = numbers(kFineDigits, kTop + kHeight + 34, 12, kInk);
    drawn_.coarse_segments = numbers(kCoarseDigits, kTop + kHeight + 58, 14, kDark);
    caption(kTop + kHeight + 34, "fine", kWords);
    caption(kTop + kHeight + 58, "coarse", kDark);
    caption(kTop + kHeight + 94, "cell (2 m)", kWords);
    caption(kTop - 18, "height (m)", kWords);
    for (const int height : {0, 5, 10}) {
      caption(at(0, static_cast<float>(height)).y + 4, std::to_string(height), kWords);
    }
    return std::move(drawn_);
  }

 private:
  SheetPoint at(double x, float height) const {
    return {kLeft + kWidth * x / static_cast<double>(profile_.size() - 1),
            kTop + kHeight * (1 - height / 10.0)};
  }
  void caption(double y, std::string_view words, Rgb colour) {
    sheet_.text(kLeft - 12, y, words, 12, "end", colour);
  }
  void outline(std::size_t stride, const figures::Stroke& stroke, double tick) {
    std::vector<SheetPoint> points;
    for (std::size_t k = 0; k < profile_.size(); k += stride) {
      points.push_back(at(static_cast<double>(k), profile_[k]));
    }
    sheet_.line(points, stroke);
    for (const SheetPoint& p : points) {
      sheet_.line(std::array{SheetPoint{p.x, p.y - tick}, SheetPoint{p.x, p.y + tick}}, stroke);
    }
  }
  // Returns how many.
  int numbers(int digits, double y, int size, Rgb colour) {
    const std::uint32_t count = 1U << digits;
    for (std::uint32_t k = 0; k < count; ++k) {
      sheet_.text(kLeft + kWidth * (k + 0.5) / count, y, segment_labels(std::array{k}, digits), size,
                  "middle", colour);
    }
    return static_cast<int>(count);
  }
  bool changes(std::size_t step) const { return step < steps_.size() && !steps_[step].coarse.empty(); }
  // Dark where a step to a neighbouring cell changes visibility.
  void cells() {
    const double side = kWidth / kProfileCells, y = kTop + kHeight + 74;
    for (std::size_t c = 0; c < kProfileCells; ++c) {
      const bool dark = changes(c) || (c > 0 && changes(c - 1));
      ++drawn_.cells;
      drawn_.dark_cells += dark;
      const double x = kLeft + static_cast<double>(c) * side;
      sheet_.box(x + 1, y, side - 2, 30, dark ? kDark : kPale);
      sheet_.text(x + 0.5 * side, y + 20,
                  visibility::cell_name({kProfileCells, 1, 1}, {static_cast<int>(c), 0}), 15, "middle",
                  dark ? Rgb{255, 255, 255} : kWords);
      if (c > 0) {
        sheet_.line(std::array{SheetPoint{x, kTop - 10}, SheetPoint{x, kTop + kHeight + 16}},
                    {.colour = kPale, .dashes = "4,4"});
      }
      if (changes(c)) {
        sheet_.line(std::array{SheetPoint{x + side, y + 30}, SheetPoint{x + side, y + 40}}, {.colour = kInk});
        sheet_.text(x + side, y + 56, segment_labels(steps_[c].coarse, kCoarseDigits), 13, "middle");
      }
    }
    caption(y + 56, "changes", kWords);
  }

  std::span<const float> profile_;
  std::span<const ProfileStep> steps_;
  ProfileSheet drawn_{Sheet(kSheet.x, kSheet.y)};
  Sheet& sheet_ = drawn_.sheet;
};

}  // namespace

std::string segment_labels(std::span<const std::uint32_t> segments, int digits) {
  std::string text;
  for (const std::uint32_t segment : segments) {
    text += (text.empty() ? "" : ", ") + label((NodeNumber{1} << digits) + segment);
  }
  return text;
}

std::string step_name(std::size_t step) {
  const visibility::CellGrid cells{kProfileCells, 1, 1};
  const int cell = static_cast<int>(step);
  return cell_name(cells, {cell, 0}) + "-" + cell_name(cells, {cell + 1, 0});
}

ProfileSheet profile_sheet(std::span<const float> profile, std::span<const ProfileStep> steps) {
  return ProfileDrawing(profile, steps).draw();
}

Sheet table_sheet(std::span<const PrintedStep> printed, std::span<const ProfileStep> steps) {
  constexpr std::array kColumns{20.0, 100.0, 240.0, 380.0, 590.0};
  constexpr double kRow = 24, kRight = 980;
  constexpr std::size_t kPerLine = 8;  // fine segments
  std::vector<std::array<std::string, kColumns.size()>>
      lines;  // empty cells where a step takes several lines
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const std::span<const std::uint32_t> coarse(steps[k].coarse), fine(steps[k].fine);
    const auto row = std::find_if(printed.begin(), printed.end(),
                                  [&](const PrintedStep& p) { return p.name == step_name(k); });
    const bool in_print = row != printed.end();
    if (!in_print && coarse.empty() && fine.empty()) continue;
    lines.push_back({step_name(k), in_print ? std::string(row->coarse) : "none",
                     coarse.empty() ? "none" : segment_labels(coarse, kCoarseDigits),
                     in_print ? std::string(row->fine) : "none", fine.empty() ? "none" : ""});
    for (std::size_t at = 0; at < fine.size(); at += kPerLine) {
      const auto part = fine.subspan(at, std::min(kPerLine, fine.size() - at));
      if (at > 0) lines.emplace_back();
      lines.back().back() = segment_labels(part, kFineDigits) + (at + part.size() < fine.size() ? "," : "");
    }
  }
  Sheet sheet(kRight + 20, 74 + kRow * static_cast<double>(lines.size()) + 20);
  sheet.panel(0, 0, kRight + 20, 74 + kRow * static_cast<double>(lines.size()) + 20);
  const auto rule = [&](double y) {
    sheet.line(std::array{SheetPoint{kColumns[0], y}, SheetPoint{kRight, y}}, {.colour = kDark});
  };
  rule(16);
  sheet.text(kColumns[0], 48, "Step", 13);
  sheet.text(kColumns[1], 36, "Coarse change", 13);
  sheet.text(kColumns[3], 36, "Fine change", 13);
  for (const std::size_t c : {1U, 3U}) {
    sheet.text(kColumns[c], 58, "in the paper", 12, "start", kDark);
    sheet.text(kColumns[c + 1], 58, "computed", 12, "start", kDark);
  }
  rule(68);
  double y = 68;
  for (const auto& line : lines) {
    y += kRow;
    for (std::size_t c = 0; c < line.size(); ++c) {
      if (!line[c].empty()) sheet.text(kColumns[c], y - 6, line[c], 13);
    }
  }
  rule(y + 4);
  return sheet;
}

}  // namespace terrabench::mrbsp
