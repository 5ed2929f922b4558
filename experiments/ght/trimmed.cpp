// Panels without the white around their pictures, so that a sheet is filled by what it shows.
#include <algorithm>
#include <cstddef>
#include <map>

#include "experiments/ght/figures.h"

namespace terrabench::ght {
namespace {

constexpr int kMargin = 8;  // pixels

struct Range {
  int low = 1 << 30, high = -1;
  void add(int at) { low = std::min(low, at), high = std::max(high, at); }
  // With a margin, and an even number of pixels, which makes a whole number of the sheet's units.
  Range widened(int size) const {
    if (high < 0) return {0, size - 1};  // nothing but white
    Range wide{std::max(low - kMargin, 0), std::min(high + kMargin, size - 1)};
    if ((wide.high - wide.low) % 2 == 0) {
      if (wide.high + 1 < size) {
        ++wide.high;
      } else if (wide.low > 0) {
        --wide.low;
      }  // else a picture of an odd size, which is left whole
    }
    return wide;
  }
};

void add_inked(const Image& image, Range& columns, Range& rows) {
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (image.pixel(x, y) == Rgb{255, 255, 255}) continue;
      columns.add(x);
      rows.add(y);
    }
  }
}

Image part(const Image& image, Range columns, Range rows) {
  Image cut(columns.high - columns.low + 1, rows.high - rows.low + 1, {});
  for (int y = 0; y < cut.height; ++y) {
    for (int x = 0; x < cut.width; ++x) cut.set(x, y, image.pixel(columns.low + x, rows.low + y));
  }
  return cut;
}

}  // namespace

figures::PanelRows trimmed(figures::PanelRows panels) {
  std::map<std::size_t, Range> columns;  // by the number of panels in a row
  std::vector<Range> rows(panels.size());
  for (std::size_t r = 0; r < panels.size(); ++r) {
    for (const figures::Panel& panel : panels[r]) {
      add_inked(panel.image, columns[panels[r].size()], rows[r]);
    }
  }
  for (std::size_t r = 0; r < panels.size(); ++r) {
    for (figures::Panel& panel : panels[r]) {
      const Range across = columns[panels[r].size()].widened(panel.image.width),
                  down = rows[r].widened(panel.image.height);
      panel.image = part(panel.image, across, down);
    }
  }
  return panels;
}

}  // namespace terrabench::ght
