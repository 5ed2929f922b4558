// Geotectonic events (Alonso, Joan-Arinyo & Solano, §3.2, figures 13 and 14). Where the new heightmaps have
// the host's orientation and lattice, as under a radial erosion, superseded cells link straight to the new
// ones and no seam is needed. All others have an array of their own along the event, with cells no larger
// than the root's; heights are read from the surface ("simple linear interpolation"), and the inclined plane
// does the rest.
#include <algorithm>
#include <cmath>
#include <functional>

#include "representations/ght/dispatch.h"

namespace terrabench::ght {
namespace {

using events::Line;

// By how much of a cell cuts stay outside an outline, so that the ring around it has a width.
constexpr double kMargin = 0.1;

// Steps of at most a cell along a length.
int steps(double length, const Lattice& lattice) {
  return std::max(1, static_cast<int>(std::ceil(length / lattice.cell() - 1e-6)));
}

// Coordinates along a line and upward as a vector in space.
glm::vec3 spatial(const Line& line, double u, double d, double y) {
  const glm::dvec2 plan = u * line.along + d * line.left;
  return {plan.x, y, plan.y};
}
glm::vec3 spatial_point(const Line& line, double u, double d, double y) {
  const glm::dvec2 plan = line.plan({u, d});
  return {plan.x, y, plan.y};
}

// Outlines list cells in order; a corner that two sides share comes once.
class Outline {
 public:
  explicit Outline(const Tree& tree) : tree_(tree) {}
  void add(CellId c) {
    c = tree_.resolve(c);
    if (cells_.empty() || cells_.back() != c) cells_.push_back(c);
  }
  std::span<const CellId> close() {
    while (cells_.size() > 1 && cells_.back() == cells_.front()) cells_.pop_back();
    return cells_;
  }

 private:
  const Tree& tree_;
  std::vector<CellId> cells_;
};

// What all events on an array of their own do: what lies under the outline is cut out, `build` makes the new
// heightmaps and says where a point of the old ground is now.
using Nearest = std::function<CellId(glm::dvec2 local)>;

class Replacement {
 public:
  Replacement(Model& model, const Line& line, Region outline, const Refusal& refusal)
      : model_(model), line_(line), refusal_(refusal), edit(model, refusal) {
    const double margin = kMargin * model.tree.lattice().cell();
    outline = {line, outline.u0 - margin, outline.u1 + margin, outline.d0 - margin, outline.d1 + margin};
    cut_ = cut(model, outline, refusal);
    edit.remove(cut_);
  }

  // Height of the ground before; nodes are cut out but still there.
  float ground(glm::dvec2 local) const {
    const float y = model_.surface.top(model_.tree, line_.plan(local));
    if (Heightfield::is_no_data(y)) refusal_.refuse("touches ground without data", "fill the no-data cells");
    return y;
  }

  void finish(std::span<const CellId> outline, const Nearest& nearest, events::Kind kind, NodeId host) {
    for (const Sheet& sheet : sheets) edit.quads(sheet.node, sheet.mirrored);
    edit.close_ring(cut_.loop, outline);
    edit.keep_clear_of_carvings();
    for (const CellId c : cut_.superseded) {
      edit.relink(c, model_.tree.resolve(nearest(line_.local(model_.tree.plan(c)))));
    }
    edit.commit(kind, host);
  }

 private:
  Model& model_;
  Line line_;
  const Refusal& refusal_;
  Cut cut_;

 public:
  struct Sheet {
    Node node;
    bool mirrored;
  };
  Edit edit;
  std::vector<Sheet> sheets;  // new nodes whose quadrilaterals are surface
};

int nearest_step(double at, int steps) {
  return static_cast<int>(std::lround(std::clamp(at, 0.0, 1.0) * steps));
}

// Trench. Sides are trapezia of rows that taper to the bottom edge, ends are triangles on a square array;
// both have as many rows, so that the hips between them are shared.
class Trench {
 public:
  Trench(Model& model, const events::LinearErosion& e, NodeId host, const Refusal& refusal)
      : model_(model),
        e_(e),
        line_(e.line()),
        w_(e.width()),
        replace_(model, line_, Region{line_, -w_, line_.length + w_, -w_, w_}, refusal),
        rows_(steps(std::hypot(w_, e.depth), model.tree.lattice())),
        columns_(steps(line_.length + 2 * w_, model.tree.lattice())) {
    left_ = side(host, 1);
    right_ = side(host, -1);
    from_ = end(host, -1);
    to_ = end(host, 1);
    fill_side(left_, 1);
    fill_side(right_, -1);
    fill_end(from_, -1);
    fill_end(to_, 1);
    Outline outline(model.tree);
    for (int i = 0; i <= columns_; ++i) outline.add(right_.cell(i, rows_));
    for (int k = 0; k <= 2 * rows_; ++k) outline.add(to_.cell(2 * rows_ - k, rows_));
    for (int i = columns_; i >= 0; --i) outline.add(left_.cell(i, rows_));
    for (int k = 0; k <= 2 * rows_; ++k) outline.add(from_.cell(2 * rows_ - k, rows_));
    replace_.finish(
        outline.close(), [&](glm::dvec2 local) { return nearest(local); }, events::Kind::kLinearErosion,
        host);
  }

 private:
  Tree& tree() { return model_.tree; }
  double step() const { return w_ / rows_; }

  // On the left (sign 1) or right (-1) of the bottom edge; rows outwards.
  Node side(NodeId host, int sign) {
    Node node = new_node(model_, host, Area::kOutdoor);
    node.columns = columns_ + 1;
    node.rows = rows_ + 1;
    node.frame.origin = spatial_point(line_, 0, 0, -e_.depth);
    node.frame.u = spatial(line_, line_.length / columns_, 0, 0);
    node.frame.v = spatial(line_, -step(), sign * step(), e_.depth / rows_);
    node.frame.taper = spatial(line_, 2 * step() / columns_, 0, 0);
    return replace_.edit.append(node);
  }
  // Beyond `from` (sign -1) or `to` (1): rows outwards, 2j + 1 cells in row j, columns so that the array runs
  // counter-clockwise.
  Node end(NodeId host, int sign) {
    Node node = new_node(model_, host, Area::kOutdoor);
    node.columns = 2 * rows_ + 1;
    node.rows = rows_ + 1;
    node.frame.origin = spatial_point(line_, sign < 0 ? 0 : line_.length, sign * w_, -e_.depth);
    node.frame.u = spatial(line_, 0, -sign * step(), 0);
    node.frame.v = spatial(line_, sign * step(), 0, e_.depth / rows_);
    return replace_.edit.append(node);
  }
  // The cell of an end on its hip with the left (across 1) or right (-1) side.
  CellId hip(const Node& node, int sign, int across, int j) const {
    return node.cell(rows_ - sign * across * j, j);
  }

  // Ends hold the hips and the right side holds the bottom edge: the cells of what came before link to them.
  void fill_side(const Node& node, int sign) {
    for (int j = 0; j <= rows_; ++j) {
      const double d = j * step(), width = line_.length + 2 * d;
      for (int i = 0; i <= columns_; ++i) {
        const CellId c = node.cell(i, j);
        if (i == 0) {
          tree().set_link(c, hip(from_, -1, sign, j));
        } else if (i == columns_) {
          tree().set_link(c, hip(to_, 1, sign, j));
        } else if (sign > 0 && j == 0) {
          tree().set_link(c, right_.cell(i, 0));
        } else {
          tree().set_height(c, replace_.ground({-d + width * i / columns_, sign * d}));
        }
      }
    }
    replace_.sheets.push_back({node, sign < 0});
  }
  void fill_end(const Node& node, int sign) {
    const double u0 = sign < 0 ? 0 : line_.length;
    for (int j = 0; j <= rows_; ++j) {
      for (int k = -j; k <= j; ++k) {
        tree().set_height(node.cell(rows_ + k, j),
                          replace_.ground({u0 + sign * j * step(), -sign * k * step()}));
      }
    }
    replace_.sheets.push_back({node, false});
  }

  CellId nearest(glm::dvec2 p) const {
    const double d = std::min(std::abs(p.y), w_), beyond = std::max(-p.x, p.x - line_.length);
    if (beyond > d) {
      const int j = nearest_step(beyond / w_, rows_);
      const int sign = p.x < 0 ? -1 : 1;
      const int k = std::clamp(static_cast<int>(std::lround(-sign * p.y / step())), -j, j);
      return (sign < 0 ? from_ : to_).cell(rows_ + k, j);
    }
    const int j = nearest_step(d / w_, rows_);
    const double at = j * step();
    return (p.y >= 0 ? left_ : right_).cell(nearest_step((p.x + at) / (line_.length + 2 * at), columns_), j);
  }

  Model& model_;
  const events::LinearErosion& e_;
  Line line_;
  double w_;
  Replacement replace_;
  int rows_, columns_;
  Node left_, right_, from_, to_;
};

// Two blocks that tilt and the scarp between their lips. The height in a block's cell is that of the ground
// it was made of; in the scarp's, that of the ground on the line.
class Fault {
 public:
  Fault(Model& model, const events::DipFault& e, NodeId host, const Refusal& refusal)
      : model_(model),
        e_(e),
        refusal_(refusal),
        line_(e.line()),
        lip_((e.inverse ? -0.5 : 0.5) * e.offset()),
        replace_(model, line_, Region{line_, 0, line_.length, -e.extent, e.extent}, refusal),
        columns_(std::max(2, steps(line_.length, model.tree.lattice()))),
        rows_(steps(std::hypot(std::max(e.extent, e.extent - lip_), e.rise / 2), model.tree.lattice())),
        scarp_rows_(steps(std::hypot(e.offset(), e.rise), model.tree.lattice())),
        folded_(rows_under_overhang()) {
    left_ = block(host, 1);
    right_ = block(host, -1);
    scarp_ = scarp(host);
    fill_block(left_, 1);
    fill_block(right_, -1);
    fill_scarp();
    Outline outline(model.tree);
    for (int i = 0; i <= columns_; ++i) outline.add(right_.cell(i, rows_));
    const std::vector<CellId> east = profile(columns_), west = profile(0);
    for (const CellId c : east) outline.add(c);
    for (int i = columns_; i >= 0; --i) outline.add(left_.cell(i, rows_));
    for (auto c = west.rbegin(); c != west.rend(); ++c) outline.add(*c);
    replace_.finish(
        outline.close(), [&](glm::dvec2 local) { return nearest(local); },
        e.inverse ? events::Kind::kInverseFault : events::Kind::kNormalFault, host);
  }

 private:
  Tree& tree() { return model_.tree; }

  Node block(NodeId host, int sign) {
    Node node = new_node(model_, host, Area::kOutdoor);
    node.columns = columns_ + 1;
    node.rows = rows_ + 1;
    node.frame.origin = spatial_point(line_, 0, sign * lip_, sign * e_.rise / 2);
    node.frame.u = spatial(line_, line_.length / columns_, 0, 0);
    node.frame.v = spatial(line_, 0, sign * (e_.extent - lip_) / rows_, -sign * e_.rise / 2 / rows_);
    return replace_.edit.append(node);
  }
  bool at_end(int column) const { return column == 0 || column == columns_; }
  // The height that puts a cell on the ground as it is.
  float height_on_ground(const Node& node, int column, int row) const {
    const glm::dvec3 p = node.frame.at(column, row, 0);
    return replace_.ground(line_.local({p.x, p.z})) - static_cast<float>(p.y);
  }

  // The scarp holds both lips.
  void fill_block(const Node& node, int sign) {
    for (int i = 0; i <= columns_; ++i) {
      for (int j = 0; j <= rows_; ++j) {
        const CellId c = node.cell(i, j);
        if (at_end(i) && sign < 0 && j < folded_) {
          tree().set_link(c, scarp_.cell(i, scarp_rows_));
        } else if (j == 0) {
          tree().set_link(c, scarp_.cell(i, sign < 0 ? 0 : scarp_rows_));
        } else if (at_end(i)) {
          tree().set_height(c, height_on_ground(node, i, j));
        } else {
          tree().set_height(c, replace_.ground({u(i), sign * e_.extent * j / rows_}));
        }
      }
    }
    replace_.sheets.push_back({node, sign < 0});
  }
  double u(int column) const { return line_.length * column / columns_; }

  // From the right block's lip to the left one's.
  Node scarp(NodeId host) {
    Node node = new_node(model_, host, e_.inverse ? Area::kIndoor : Area::kOutdoor);
    node.columns = columns_ + 1;
    node.rows = scarp_rows_ + 1;
    node.frame.origin = spatial_point(line_, 0, -lip_, -e_.rise / 2);
    node.frame.u = spatial(line_, line_.length / columns_, 0, 0);
    node.frame.v = spatial(line_, 0, 2 * lip_ / scarp_rows_, e_.rise / scarp_rows_);
    return replace_.edit.append(node);
  }
  void fill_scarp() {
    for (int i = 0; i <= columns_; ++i) {
      for (int j = 0; j <= scarp_rows_; ++j) {
        const CellId c = scarp_.cell(i, j);
        if (at_end(i) && folded_ > 0 && j < scarp_rows_) {
          tree().set_link(c, scarp_.cell(i, scarp_rows_));
        } else {
          tree().set_height(c, at_end(i) ? height_on_ground(scarp_, i, j) : replace_.ground({u(i), 0}));
        }
      }
    }
    replace_.sheets.push_back({scarp_, false});
  }

  // Rows of the right block that lie under the overhang of an inverse fault.
  int rows_under_overhang() const {
    if (!e_.inverse) return 0;
    const double slip = 1e-3 * model_.tree.lattice().cell(), step = (e_.extent - lip_) / rows_;
    const int rows = static_cast<int>(std::floor((-2 * lip_ + slip) / step)) + 1;
    if (rows > rows_) {
      refusal_.refuse("hangs over all of the sunk block", "give a larger 'extent' or a smaller 'throw'");
    }
    return rows;
  }

  // Cells across the fault at one of its ends, from right to left.
  std::vector<CellId> profile(int column) const {
    std::vector<CellId> cells;
    for (int j = rows_; j >= 0; --j) cells.push_back(right_.cell(column, j));
    for (int j = 0; j <= scarp_rows_; ++j) cells.push_back(scarp_.cell(column, j));
    for (int j = 0; j <= rows_; ++j) cells.push_back(left_.cell(column, j));
    return cells;
  }

  CellId nearest(glm::dvec2 p) const {
    const int i = nearest_step(p.x / line_.length, columns_);
    return (p.y >= 0 ? left_ : right_).cell(i, nearest_step(std::abs(p.y) / e_.extent, rows_));
  }

  Model& model_;
  const events::DipFault& e_;
  const Refusal& refusal_;
  Line line_;
  double lip_;  // d of the left block's lip
  Replacement replace_;
  int columns_, rows_, scarp_rows_;
  int folded_;  // rows of the right block whose end cells are gathered in the scarp's last one
  Node left_, right_, scarp_;
};

// Two pieces whose ground comes from further along the line; between them a cliff of no width. At their ends
// they stay on the ground as it is, like a fault's.
class Slip {
 public:
  Slip(Model& model, const events::LateralFault& e, NodeId host, const Refusal& refusal)
      : model_(model),
        e_(e),
        line_(e.line()),
        replace_(model, line_, Region{line_, 0, line_.length, -e.extent, e.extent}, refusal),
        columns_(std::max(2, steps(line_.length, model.tree.lattice()))),
        rows_(steps(e.extent, model.tree.lattice())) {
    survey(model, Region{line_, -e.slip / 2, line_.length + e.slip / 2, -e.extent, e.extent}, refusal);
    left_ = piece(host, 1);
    right_ = piece(host, -1);
    fill(left_, 1);
    fill(right_, -1);
    for (int i = 0; i < columns_; ++i) {
      replace_.edit.quad({right_.cell(i, 0), right_.cell(i + 1, 0), left_.cell(i + 1, 0), left_.cell(i, 0)});
    }
    Outline outline(model.tree);
    for (int i = 0; i <= columns_; ++i) outline.add(right_.cell(i, rows_));
    for (int j = rows_; j >= 0; --j) outline.add(right_.cell(columns_, j));
    for (int j = 0; j <= rows_; ++j) outline.add(left_.cell(columns_, j));
    for (int i = columns_; i >= 0; --i) outline.add(left_.cell(i, rows_));
    for (int j = rows_; j >= 0; --j) outline.add(left_.cell(0, j));
    for (int j = 0; j <= rows_; ++j) outline.add(right_.cell(0, j));
    replace_.finish(
        outline.close(), [&](glm::dvec2 local) { return nearest(local); }, events::Kind::kLateralFault, host);
  }

 private:
  Node piece(NodeId host, int sign) {
    Node node = new_node(model_, host, Area::kOutdoor);
    node.columns = columns_ + 1;
    node.rows = rows_ + 1;
    node.frame.origin = spatial_point(line_, 0, 0, 0);
    node.frame.u = spatial(line_, line_.length / columns_, 0, 0);
    node.frame.v = spatial(line_, 0, sign * e_.extent / rows_, 0);
    return replace_.edit.append(node);
  }
  void fill(const Node& node, int sign) {
    for (int j = 0; j <= rows_; ++j) {
      const double d = sign * e_.extent * j / rows_;
      for (int i = 0; i <= columns_; ++i) {
        const CellId c = node.cell(i, j);
        const bool at_end = i == 0 || i == columns_;
        if (sign > 0 && j == 0 && at_end) {
          model_.tree.set_link(c, right_.cell(i, 0));
        } else {
          const double shift = at_end ? 0 : sign * e_.slip / 2 * (1 - static_cast<double>(j) / rows_);
          model_.tree.set_height(c, replace_.ground({line_.length * i / columns_ - shift, d}));
        }
      }
    }
    replace_.sheets.push_back({node, sign < 0});
  }

  CellId nearest(glm::dvec2 p) const {
    const int i = nearest_step(p.x / line_.length, columns_);
    return (p.y >= 0 ? left_ : right_).cell(i, nearest_step(std::abs(p.y) / e_.extent, rows_));
  }

  Model& model_;
  const events::LateralFault& e_;
  Line line_;
  Replacement replace_;
  int columns_, rows_;
  Node left_, right_;
};

}  // namespace

void apply(Model& model, const events::LinearErosion& e, NodeId host, const Refusal& refusal) {
  Trench(model, e, host, refusal);
}

void apply(Model& model, const events::DipFault& e, NodeId host, const Refusal& refusal) {
  Fault(model, e, host, refusal);
}

void apply(Model& model, const events::LateralFault& e, NodeId host, const Refusal& refusal) {
  Slip(model, e, host, refusal);
}

}  // namespace terrabench::ght
