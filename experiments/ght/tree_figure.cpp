// Figure 23 of "ght": the tree of the terrain of figure 22, a box for each heightmap with its cells.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "experiments/ght/figures.h"

namespace terrabench::ght {
namespace {

using figures::Sheet;
using figures::SheetPoint;

constexpr Rgb kHeight{200, 200, 200}, kLink{213, 94, 0}, kVoid{0, 114, 178}, kEdge{70, 70, 75};
constexpr double kMargin = 24, kBox = 74, kStep = 128, kRow = 150, kRoot = 150;
constexpr std::size_t kMostBoxes = 10;  // in a row, unless one event has more

// One pixel per cell. A larger array is reduced to `most` pixels along that axis; a pixel shows the cell at
// its middle.
Image cells_image(const Tree& tree, const GroundedHeightmap& node, int most) {
  const int across = std::min(node.columns, most), down = std::min(node.rows, most);
  Image image(across, down, {});
  for (int y = 0; y < down; ++y) {
    for (int x = 0; x < across; ++x) {
      const CellKind kind = tree.kind(
          node.cell((2 * x + 1) * node.columns / (2 * across), (2 * y + 1) * node.rows / (2 * down)));
      image.set(x, y, kind == CellKind::kHeight ? kHeight : kind == CellKind::kLink ? kLink : kVoid);
    }
  }
  return image;
}

std::string part_name(const Tree& tree, const Applied& event, NodeId n) {
  static const std::array<std::vector<const char*>, events::kKinds> kParts{{
      {"left side", "right side", "end at 'from'", "end at 'to'"},
      {"bowl"},
      {"raised block", "sunk block", "scarp"},
      {"raised block", "sunk block", "scarp"},
      {"left piece", "right piece"},
  }};  // in the order of Kind; carvings have walls and mouths
  const std::size_t k = n - event.first;
  const std::vector<const char*>& parts = kParts[static_cast<std::size_t>(event.kind)];
  if (!parts.empty()) return parts.at(k);
  if (tree.nodes()[n].area == Area::kBorder) return "mouth";
  return event.kind == events::Kind::kCave && k + 1 == event.nodes ? "end" : fmt::format("wall {}", k + 1);
}

const char* area_name(Area area) {
  return area == Area::kOutdoor ? "outdoor" : area == Area::kIndoor ? "indoor" : "border";
}

// Rows of boxes, each of one or more events on the same host, below it and further right. The children of the
// rightmost box of a row come first, so that no edge crosses a row.
class TreeSheet {
 public:
  explicit TreeSheet(const Tree& tree) : tree_(tree), box_(tree.nodes().size()) {
    y_ = kMargin + kRoot + 70;
    right_ = kMargin + kRoot;
    place_children(0, kMargin);
  }
  // How many cells of a colour the boxes show.
  double cells(const Rgb& colour) const {
    double shown = 0;
    for (NodeId n = 0; n < tree_.nodes().size(); ++n) {
      const Image image = picture(n);
      for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) shown += image.pixel(x, y) == colour;
      }
    }
    return shown;
  }
  Sheet draw() const {
    Sheet sheet(std::max(right_ + kMargin, 640.0), y_);
    for (const Applied& event : tree_.events()) edges(sheet, event);
    box(sheet, 0, "root");
    for (std::size_t e = 0; e < tree_.events().size(); ++e) {
      const Applied& event = tree_.events()[e];
      for (NodeId n = event.first; n < event.first + event.nodes; ++n) {
        box(sheet, n, part_name(tree_, event, n));
      }
      std::string words(events::name(event.kind));
      std::replace(words.begin(), words.end(), '-', ' ');
      const SheetPoint at = box_[event.first];
      sheet.text(at.x + kBox / 2 + 5, at.y - 20, fmt::format("{}. {}", e + 1, words), 13, "start");
    }
    legend(sheet, kMargin + kRoot + 60, kMargin + 40);
    sheet.text(kMargin + kRoot + 10, kMargin + 50,
               fmt::format("{} heightmaps after {} events", tree_.nodes().size(), tree_.events().size()), 13,
               "start", {90, 90, 90});
    return sheet;
  }

 private:
  // Places the rows of all events on the host, from y_ down; `x` is the left of the host.
  void place_children(NodeId host, double x) {
    if (host == 0) box_[0] = {x, kMargin};
    const double left = x + 40;
    std::vector<NodeId> row;  // the boxes of the row that is being filled
    const auto end_row = [&] {
      y_ += kRow;
      for (; !row.empty(); row.pop_back()) place_children(row.back(), box_[row.back()].x);
    };
    for (const Applied& event : tree_.events()) {
      if (event.host != host) continue;
      if (!row.empty() && row.size() + event.nodes > kMostBoxes) end_row();
      for (NodeId k = 0; k < event.nodes; ++k) {
        box_[event.first + k] = {left + static_cast<double>(row.size()) * kStep, y_};
        row.push_back(event.first + k);
      }
      right_ = std::max(right_, left + static_cast<double>(row.size()) * kStep);
    }
    if (!row.empty()) end_row();
  }

  void edges(Sheet& sheet, const Applied& event) const {
    const SheetPoint host = box_[event.host];
    const double bar = box_[event.first].y - 12;
    double trunk = host.x + 12;
    if (event.host == 0) {
      sheet.stroke({trunk, host.y + kRoot}, {trunk, bar}, kEdge, 1.5);
    } else {  // beside the words under the box
      const GroundedHeightmap& node = tree_.nodes()[event.host];
      trunk = host.x - 16;
      const double from = host.y + kBox * node.rows / std::max(node.columns, node.rows) / 2;
      sheet.stroke({host.x + kBox / 2, from}, {trunk, from}, kEdge, 1.5);
      sheet.stroke({trunk, from}, {trunk, bar}, kEdge, 1.5);
    }
    sheet.stroke({trunk, bar}, {box_[event.first + event.nodes - 1].x + kBox / 2, bar}, kEdge, 1.5);
    for (NodeId n = event.first; n < event.first + event.nodes; ++n) {
      sheet.stroke({box_[n].x + kBox / 2, bar}, {box_[n].x + kBox / 2, box_[n].y}, kEdge, 1.5);
    }
  }

  static double side_of(NodeId n) { return n == 0 ? kRoot : kBox; }
  Image picture(NodeId n) const {
    return cells_image(tree_, tree_.nodes()[n], static_cast<int>(2 * side_of(n)));
  }

  // As large as fits a square of side_of(), with the proportions of the node's array.
  void box(Sheet& sheet, NodeId n, const std::string& words) const {
    const GroundedHeightmap& node = tree_.nodes()[n];
    const double side = side_of(n), scale = side / std::max(node.columns, node.rows);
    const double wide = std::max(scale * node.columns, 6.0), high = std::max(scale * node.rows, 6.0);
    const SheetPoint at = box_[n];
    const double x = at.x + (side - wide) / 2;
    sheet.box(x - 1, at.y - 1, wide + 2, high + 2, kEdge);
    sheet.picture(x, at.y, wide, high, picture(n));
    const double under = at.y + side + 13;
    const bool root = n == 0;
    sheet.text(root ? at.x + side + 10 : at.x + side / 2, root ? at.y + 14 : under, words, root ? 14 : 12,
               root ? "start" : "middle");
    sheet.text(root ? at.x + side + 10 : at.x + side / 2, root ? at.y + 32 : under + 14,
               fmt::format("{}, {} × {}", area_name(node.area), node.columns, node.rows), root ? 13 : 11,
               root ? "start" : "middle", {90, 90, 90});
  }

  static void legend(Sheet& sheet, double x, double y) {
    const std::array<std::pair<Rgb, const char*>, 3> kinds{{{kHeight, "height over the ground plane"},
                                                            {kLink, "link to a cell of another heightmap"},
                                                            {kVoid, "void"}}};
    for (const auto& [colour, words] : kinds) {
      y += 26;
      sheet.box(x - 51, y - 1, 18, 18, kEdge);
      sheet.box(x - 50, y, 16, 16, colour);
      sheet.text(x - 26, y + 13, words, 13);
    }
  }

  const Tree& tree_;
  std::vector<SheetPoint> box_;
  double y_ = 0, right_ = 0;
};

}  // namespace

Sheet draw_tree(figures::Drawing& drawing) {
  const Ght ght = sequence_tree(drawing.seed());
  const Tree& tree = ght.model().tree;
  drawing.record("events", static_cast<double>(tree.events().size()));
  drawing.record("heightmaps", static_cast<double>(tree.nodes().size()));
  const TreeSheet drawn(tree);
  drawing.record("height_cells", drawn.cells(kHeight));
  drawing.record("link_cells", drawn.cells(kLink));
  drawing.record("void_cells", drawn.cells(kVoid));
  return drawn.draw();
}

}  // namespace terrabench::ght
