// What a sheet shows: its pictures and words with their places, and the pixels of the file that it writes.
#pragma once

#include <cstdlib>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/figures/sheet.h"
#include "results/claims/claims.h"
#include "tests/terrain/temporary_folder.h"

namespace terrabench {

// How many panels the claims declare for a figure; 0 for none.
inline int declared_panels(std::string_view figure) {
  for (const Paper& paper : papers()) {
    for (const Claim& claim : paper.claims) {
      for (const Condition& condition : claim.conditions) {
        if (condition.figure == figure && condition.panels > 0) return condition.panels;
      }
    }
  }
  return 0;
}

class SheetReader {
 public:
  struct Picture {
    double x, y, width, height;  // units of the sheet
  };
  struct Words {
    double x, y;
    std::string text;
  };

  explicit SheetReader(const figures::Sheet& sheet) {
    std::istringstream svg(sheet.svg());
    for (std::string line; std::getline(svg, line);) {  // one element per line
      const auto number = [&](const char* name) {
        return std::strtod(line.c_str() + line.find(name) + std::string(name).size(), nullptr);
      };
      if (line.starts_with("<image")) {
        pictures.push_back({number(" x=\""), number(" y=\""), number(" width=\""), number(" height=\"")});
      } else if (line.starts_with("<text")) {
        const std::size_t begin = line.find('>') + 1;
        words.push_back({number(" x=\""), number(" y=\""), line.substr(begin, line.rfind('<') - begin)});
      }
    }
    const TemporaryFolder folder;
    sheet.write({folder / "sheet.png", [&](const FigureLayout& of) { layout = of; }});
    image = read_picture(folder / "sheet.png");
  }

  // Why a check that declares this many panels would refuse the figure; empty if it would not.
  std::string fault_of_panels(int declared) const {
    const int found = static_cast<int>(layout.panels.size());
    return found != declared ? std::to_string(found) + " panels" : layout_fault(layout, image);
  }
  // The number of pictures in each row.
  std::vector<int> rows() const {
    std::vector<int> counts;
    for (std::size_t k = 0; k < pictures.size(); ++k) {
      if (k == 0 || pictures[k].y != pictures[k - 1].y) counts.push_back(0);
      ++counts.back();
    }
    return counts;
  }
  // At this share of the picture's width and height.
  Rgb pixel(const Picture& picture, double across, double down) const {
    constexpr int kPixels = figures::Sheet::kPixels;
    return image.pixel(static_cast<int>(kPixels * (picture.x + across * picture.width)),
                       static_cast<int>(kPixels * (picture.y + down * picture.height)));
  }
  std::vector<Picture> pictures;
  std::vector<Words> words;
  Image image;
  FigureLayout layout;
};

}  // namespace terrabench
