// §3.2: where the section of a carving comes out of the ground, the cells of its border heightmap are empty,
// and the host's cells there are null links. A null link of the tree is one that ends in an empty cell of a
// border.
#include <algorithm>
#include <memory>
#include <vector>

#include "experiments/ght/cells.h"
#include "experiments/ght/site.h"
#include "terrain/events/evaluate.h"

namespace terrabench::ght {
namespace {

using namespace events;

// One value per sample of the root.
class SampleSet {
 public:
  explicit SampleSet(const SampleGrid& grid) : width_(grid.width), depth_(grid.depth), has_(grid.samples()) {}
  void mark(int i, int j) { has_[at(i, j)] = 1; }
  bool operator()(int i, int j) const { return has_[at(i, j)] != 0; }
  std::size_t count() const { return static_cast<std::size_t>(std::count(has_.begin(), has_.end(), 1)); }
  // How many samples up to `reach` away along each axis have it; none outside the terrain.
  int around(int i, int j, int reach) const {
    int found = 0;
    for (int z = std::max(0, j - reach); z <= std::min(depth_ - 1, j + reach); ++z) {
      for (int x = std::max(0, i - reach); x <= std::min(width_ - 1, i + reach); ++x) found += (*this)(x, z);
    }
    return found;
  }
  template <class Visit>  // visit(i, j)
  void each(const Visit& visit) const {
    for (int j = 0; j < depth_; ++j) {
      for (int i = 0; i < width_; ++i) visit(i, j);
    }
  }

 private:
  std::size_t at(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(i);
  }
  int width_, depth_;
  std::vector<char> has_;
};

// The samples whose ground the carving takes away, by its definition.
SampleSet mouths(const Site& site, const Event& carving, const SampleGrid& grid) {
  constexpr double kSame = 1e-3;  // metres
  const Evaluation defined(std::make_shared<Sculpture>(Sculpture{site.ground, {carving}}));
  SampleSet open(grid);
  std::vector<Stretch> stretches;
  open.each([&](int i, int j) {
    defined.column({grid.x(i), grid.z(j)}, stretches);
    if (stretches.front().top < site.ground.at(i, j) - kSame) open.mark(i, j);
  });
  return open;
}

SampleSet null_links(const Tree& tree) {
  SampleSet found(tree.grid());
  found.each([&](int i, int j) {
    const CellId root = tree.root_cell(i, j), end = tree.resolve(root);
    const bool is_null = tree.kind(root) == CellKind::kLink && tree.kind(end) == CellKind::kVoid &&
                         tree.nodes()[tree.node_of(end)].area == Area::kBorder;
    if (is_null) found.mark(i, j);
  });
  return found;
}

struct NullLinks {
  std::size_t links = 0;     // null links of the root
  std::size_t empty = 0;     // empty cells of borders
  std::size_t kept = 0;      // of them, those over which the root has no null link
  std::size_t inside = 0;    // samples of a mouth whose eight neighbours are of it too
  std::size_t not_null = 0;  // of them, those without a null link
  std::size_t outside = 0;   // null links with no sample of a mouth within two samples

  void add(const Site& site, const Event& carving) {
    Ght ght = plain_tree(site.ground);
    ght.apply(carving);
    const Tree& tree = ght.model().tree;
    const SampleSet open = mouths(site, carving, tree.grid()), null = null_links(tree);
    links += null.count();
    open.each([&](int i, int j) {
      const bool is_inside = open.around(i, j, 1) == 9;
      inside += is_inside;
      not_null += is_inside && !null(i, j);
      outside += null(i, j) && open.around(i, j, 2) == 0;
    });
    for (const GroundedHeightmap& node : tree.nodes()) {
      if (node.area != Area::kBorder) continue;
      for (int j = 0; j < node.rows; ++j) {
        for (int i = 0; i < node.columns; ++i) {
          if (tree.kind(node.cell(i, j)) != CellKind::kVoid) continue;
          ++empty;
          kept += !null(node.i0 + i, node.j0 + j);
        }
      }
    }
  }
};

}  // namespace

void measure_null_links(const RunOptions& options, Recorder& recorder) {
  const Site site = recorded_site(128, 32, options.seed, recorder);
  NullLinks all;
  for (const Kind kind : {Kind::kTunnel, Kind::kCave}) all.add(site, single_event(site, kind));
  for (const Event& tunnel : two_tunnels(site)) all.add(site, tunnel);
  recorder.add("null_links", "", all.links);
  recorder.add("empty_cells", "", all.empty);
  recorder.add("empty_without_null", "", all.kept);
  recorder.add("mouth_samples", "", all.inside);
  recorder.add("mouth_without_null", "", all.not_null);
  recorder.add("null_outside", "", all.outside);
}

}  // namespace terrabench::ght
