// Radial erosion (Alonso, Joan-Arinyo & Solano, §3.2): one heightmap on the root's own lattice. A particle's
// bowl is the event that comes ten thousand times, so where the ground is plain it is put in without any
// cutting.
#include <algorithm>
#include <cmath>

#include "representations/ght/dispatch.h"

namespace terrabench::ght {
namespace {

class Bowl {
 public:
  Bowl(Model& model, const events::RadialErosion& e, NodeId host, const Refusal& refusal)
      : model_(model), e_(e), host_(host), refusal_(refusal), lattice_(model.tree.lattice()) {}

  void apply() {
    bounds(0);
    if (!lowers()) {
      refusal_.refuse("does not reach the ground at any of its samples",
                      "lower its centre, or give larger radii");
    }
    if (plain()) {
      put_in();
    } else {
      // A sample more on each side, where the ground is as before.
      bounds(1);
      replace();
    }
  }

 private:
  // Samples [i0_, i1_] × [j0_, j1_] within the ellipse, and `more` around them.
  void bounds(int more) {
    const glm::dvec2 low = lattice_.samples_to({e_.centre.x - e_.radii.x, e_.centre.z - e_.radii.z}),
                     high = lattice_.samples_to({e_.centre.x + e_.radii.x, e_.centre.z + e_.radii.z});
    i0_ = std::max(0, static_cast<int>(std::ceil(low.x)) - more);
    j0_ = std::max(0, static_cast<int>(std::ceil(low.y)) - more);
    i1_ = std::min(lattice_.width - 1, static_cast<int>(std::floor(high.x)) + more);
    j1_ = std::min(lattice_.depth - 1, static_cast<int>(std::floor(high.y)) + more);
  }
  double bottom(int i, int j) const { return e_.bottom({lattice_.x(i), lattice_.z(j)}); }
  float ground(int i, int j) const { return model_.surface.top(model_.tree, {lattice_.x(i), lattice_.z(j)}); }

  // Calls visit(i, j, bottom) for all samples within the ellipse until it says true; whether one did.
  template <class Visit>
  bool any_inside(const Visit& visit) const {
    for (int j = j0_; j <= j1_; ++j) {
      for (int i = i0_; i <= i1_; ++i) {
        const double y = bottom(i, j);
        if (y < HUGE_VAL && visit(i, j, y)) return true;
      }
    }
    return false;
  }
  bool lowers() const {
    return any_inside([&](int i, int j, double y) { return y < ground(i, j); });
  }
  // Whether all squares around all samples within are plain, and of the ground alone.
  bool plain() const {
    return !any_inside([&](int i, int j, double) {
      for (int k = 0; k < 4; ++k) {
        const Square s{i - k % 2, j - k / 2};
        if (s.i < 0 || s.j < 0 || s.i + 2 > lattice_.width || s.j + 2 > lattice_.depth) continue;
        if (model_.surface.covered(s)) return true;
      }
      const CellId c = model_.tree.at_sample(i, j);
      if (model_.tree.kind(c) == CellKind::kVoid) {
        refusal_.refuse("touches ground without data", "fill the no-data cells, or move the event");
      }
      return model_.tree.nodes()[model_.tree.node_of(c)].area != Area::kOutdoor;
    });
  }

  Node make_node(Edit& edit) const {
    Node node = new_node(model_, host_, Area::kOutdoor);
    node.aligned = true;
    node.i0 = i0_;
    node.j0 = j0_;
    node.columns = i1_ - i0_ + 1;
    node.rows = j1_ - j0_ + 1;
    return edit.append(node);
  }

  // Superseded cells link straight to the new ones, and so do the root's, for whatever lay between.
  void put_in() {
    Edit edit(model_, refusal_);
    const Node node = make_node(edit);
    any_inside([&](int i, int j, double y) {
      const CellId now = model_.tree.at_sample(i, j), next = node.cell(i - i0_, j - j0_),
                   root = model_.tree.root_cell(i, j);
      edit.tree().set_height(next, static_cast<float>(std::min<double>(y, model_.tree.height(now))));
      edit.relink(now, next);
      if (root != now) edit.relink(root, next);
      return false;
    });
    edit.keep_clear_of_carvings();
    edit.commit(events::Kind::kRadialErosion, host_);
  }

  // Over other heightmaps: all samples of the rectangle, which is plain again afterwards, sewn to what is
  // around.
  void replace() {
    constexpr double kMargin = 0.1;  // cells
    const events::Line east({0, 0}, {1, 0});
    const double margin = kMargin * lattice_.cell();
    const Region region{east, lattice_.x(i0_) - margin, lattice_.x(i1_) + margin, -lattice_.z(j1_) - margin,
                        -lattice_.z(j0_) + margin};
    const Cut cut = ght::cut(model_, region, refusal_);
    Edit edit(model_, refusal_);
    edit.remove(cut);
    const Node node = make_node(edit);
    for (int j = j0_; j <= j1_; ++j) {
      for (int i = i0_; i <= i1_; ++i) {
        const CellId next = node.cell(i - i0_, j - j0_);
        edit.tree().set_height(next, static_cast<float>(std::min<double>(bottom(i, j), ground(i, j))));
        edit.relink(model_.tree.root_cell(i, j), next);
        if (i < i1_ && j < j1_) edit.make_plain({i, j});
      }
    }
    for (const CellId c : cut.superseded) {
      const glm::dvec2 at = lattice_.samples_to(model_.tree.plan(c));
      edit.relink(c, node.cell(nearest(at.x, i0_, i1_), nearest(at.y, j0_, j1_)));
    }
    edit.close_ring(cut.loop, outline(node));
    edit.keep_clear_of_carvings();
    edit.commit(events::Kind::kRadialErosion, host_);
  }
  static int nearest(double at, int first, int last) {
    return std::clamp(static_cast<int>(std::lround(at)), first, last) - first;
  }
  static std::vector<CellId> outline(const Node& node) {  // counter-clockwise seen from above; z runs south
    std::vector<CellId> cells;
    for (int j = 0; j + 1 < node.rows; ++j) cells.push_back(node.cell(0, j));
    for (int i = 0; i + 1 < node.columns; ++i) cells.push_back(node.cell(i, node.rows - 1));
    for (int j = node.rows - 1; j > 0; --j) cells.push_back(node.cell(node.columns - 1, j));
    for (int i = node.columns - 1; i > 0; --i) cells.push_back(node.cell(i, 0));
    return cells;
  }

  Model& model_;
  const events::RadialErosion& e_;
  NodeId host_;
  const Refusal& refusal_;
  const Lattice& lattice_;
  int i0_ = 0, j0_ = 0, i1_ = 0, j1_ = 0;
};

}  // namespace

void apply(Model& model, const events::RadialErosion& e, NodeId host, const Refusal& refusal) {
  Bowl(model, e, host, refusal).apply();
}

}  // namespace terrabench::ght
