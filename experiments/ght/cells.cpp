// §3.2: the host that an event finds, the number of cells at an angle, what a new heightmap's cells become
// over links of the host, and the noise on the walls of a carving. In files of their own (cells.h): the
// heights of cells at an angle, and null links.
#include "experiments/ght/cells.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "experiments/cases.h"
#include "experiments/figures/measures.h"
#include "experiments/ght/site.h"
#include "terrain/error.h"
#include "terrain/events/evaluate.h"

namespace terrabench::ght {
namespace {

using namespace events;

struct Topic {
  std::string_view name;
  void (*measure)(const RunOptions&, Recorder&);
};

// A bowl of `cells` cells' radius around a sample.
RadialErosion bowl_at(const Ght& tree, glm::dvec2 plan, double cells) {
  const double radius = cells * tree.model().tree.grid().spacing();
  return {{plan.x, tree.model().surface.top(tree.model().tree, plan), plan.y}, {radius, radius / 3, radius}};
}

// The host by an exhaustive search: of the heightmaps whose array covers the bowl's rectangle without a void
// cell, the deepest, and of equally deep ones the latest. Bowls have arrays on the root's samples.
NodeId host_of(const Tree& tree, const RadialErosion& bowl) {
  const PlanBox box = plan_box(bowl);
  const glm::dvec2 low = tree.grid().samples_to(box.low), high = tree.grid().samples_to(box.high);
  NodeId host = 0;
  for (NodeId n = 1; n < tree.nodes().size(); ++n) {
    const GroundedHeightmap& node = tree.nodes()[n];
    const double i1 = node.i0 + node.columns - 1, j1 = node.j0 + node.rows - 1;
    if (low.x < node.i0 || low.y < node.j0 || high.x > i1 || high.y > j1) continue;
    bool whole = true;
    for (int j = static_cast<int>(std::ceil(low.y)); j <= high.y; ++j) {
      for (int i = static_cast<int>(std::ceil(low.x)); i <= high.x; ++i) {
        whole = whole && tree.kind(node.cell(i - node.i0, j - node.j0)) != CellKind::kVoid;
      }
    }
    if (whole && node.depth >= tree.nodes()[host].depth) host = n;
  }
  return host;
}

// Bowls of 1.5 to 24 cells at random places: small ones fall into large ones.
void measure_hosts(const RunOptions& options, Recorder& recorder) {
  constexpr int kBowls = 400;
  constexpr double kFar = 26;  // cells from the border
  const Site site = recorded_site(128, 32, options.seed, recorder);
  Ght tree = plain_tree(site.ground);
  Dice dice(options.seed);
  const double cell = site.ground.cell_x;
  std::size_t taken = 0, wrong = 0, inside = 0, deeper = 0;
  for (int k = 0; k < kBowls; ++k) {
    const double x = dice.between(kFar, 128 - kFar) * cell, z = dice.between(kFar, 128 - kFar) * cell;
    const RadialErosion bowl = bowl_at(tree, {x, z}, 1.5 * std::pow(16, dice.between(0, 1)));
    const NodeId host = host_of(tree.model().tree, bowl);
    try {
      tree.apply(bowl);
    } catch (const Error& error) {
      if (error.code() != ExitCode::kBadInput) throw;
      continue;  // it does not fit among the others
    }
    ++taken;
    const std::uint32_t depth = tree.model().tree.nodes()[host].depth;
    wrong += tree.model().tree.events().back().host != host;
    inside += depth >= 1;
    deeper += depth >= 2;
  }
  recorder.add("bowls", "", taken);
  recorder.add("wrong_hosts", "", wrong);
  recorder.add("hosts_below_root", "", inside);
  recorder.add("hosts_below_those", "", deeper);
}

// A bowl beside and partly over an earlier one, whose cells in the root are links then.
struct OverLinks {
  std::size_t cells = 0;      // of the second bowl over links of the root
  std::size_t wrong = 0;      // of them, heights other than the definition's
  std::size_t lowered = 0;    // of them, heights below those of the first bowl
  std::size_t forgotten = 0;  // of them, heights that the root's own first heights would have made wrong

  void add(const Site& site, const RadialErosion& first, const RadialErosion& second) {
    constexpr double kSame = 1e-3;  // metres
    Ght tree = plain_tree(site.ground);
    tree.apply(first);
    const Ght before = tree;
    const Tree& old = before.model().tree;
    tree.apply(second);
    const Tree& now = tree.model().tree;
    const Evaluation defined(std::make_shared<Sculpture>(Sculpture{site.ground, {first, second}}));
    std::vector<Stretch> stretches;
    const GroundedHeightmap& node = now.nodes().back();
    for (int j = 0; j < node.rows; ++j) {
      for (int i = 0; i < node.columns; ++i) {
        const int x = node.i0 + i, z = node.j0 + j;
        const CellId root = old.root_cell(x, z), cell = node.cell(i, j);
        if (old.kind(root) != CellKind::kLink || now.kind(cell) == CellKind::kVoid) continue;
        ++cells;
        const glm::dvec2 plan(now.grid().x(x), now.grid().z(z));
        defined.column(plan, stretches);
        const double height = stretches.front().top;
        wrong += std::abs(now.position(now.resolve(root)).y - height) > kSame;
        lowered += height < old.position(old.resolve(root)).y - kSame;
        const double alone = std::min<double>(site.ground.at(x, z), second.bottom(plan));
        forgotten += std::abs(alone - height) > kSame;
      }
    }
  }
};

void measure_links(const RunOptions& options, Recorder& recorder) {
  constexpr int kPairs = 40;
  constexpr double kRadius = 8, kFar = 26;  // cells
  const Site site = recorded_site(128, 32, options.seed, recorder);
  const Ght fresh = plain_tree(site.ground);
  const double cell = site.ground.cell_x;
  Dice dice(options.seed);
  OverLinks over;
  for (int k = 0; k < kPairs; ++k) {
    const double x = dice.between(kFar, 128 - kFar), z = dice.between(kFar, 128 - kFar),
                 turn = dice.between(0, 6.28);
    const glm::dvec2 at(x, z), beside = at + kRadius * glm::dvec2(std::cos(turn), std::sin(turn));
    over.add(site, bowl_at(fresh, at * cell, kRadius), bowl_at(fresh, beside * cell, kRadius));
  }
  recorder.add("cells_over_links", "", over.cells);
  recorder.add("wrong_heights", "", over.wrong);
  recorder.add("lowered_heights", "", over.lowered);
  recorder.add("forgotten_heights", "", over.forgotten);
}

// Cells with heights of the heightmaps at an angle, and the host's cells that they replaced.
void measure_inclined(const RunOptions& options, Recorder& recorder) {
  const Site site = recorded_site(128, 32, options.seed, recorder);
  for (const Kind kind : {Kind::kLinearErosion, Kind::kNormalFault, Kind::kInverseFault}) {
    Ght ght = plain_tree(site.ground);
    ght.apply(single_event(site, kind));
    const Tree& tree = ght.model().tree;
    const CellId host = tree.nodes()[0].cells();
    std::size_t cells = 0, replaced = 0;
    for (CellId c = 0; c < tree.cells(); ++c) {
      replaced += c < host && tree.kind(c) == CellKind::kLink;
      cells += c >= host && tree.kind(c) == CellKind::kHeight;
    }
    recorder.add(metric_of("cells", kind), "", cells);
    recorder.add(metric_of("host_cells", kind), "", replaced);
  }
}

// A tunnel 52 m long through a dam, samples 1 m apart.
Ght noisy_tunnel(std::uint64_t seed, double roughness) {
  constexpr int kWide = 129, kDeep = 65;
  std::vector<float> heights;
  for (int j = 0; j < kDeep; ++j) {
    for (int i = 0; i < kWide; ++i) {
      heights.push_back(40 * std::clamp(2.0F - std::abs(static_cast<float>(i) - 64) / 22, 0.0F, 1.0F));
    }
  }
  Ght tree({kWide, kDeep, 1, 1, 0, 0}, std::move(heights), -5);
  Carving tunnel{false, {38, 16, 32}, {90, 16, 32}, {}};
  tunnel.section = {{-8, -8}, {8, -8}, {8, 8}, {-8, 8}};
  tunnel.roughness = roughness;
  tunnel.seed = seed;
  tree.apply(tunnel);
  return tree;
}

// Heights of walls over their planes: how large they are, and how alike they are at neighbouring cells, at
// cells 20 m apart along the axis, and at the same cells under another seed.
struct WallNoise {
  static constexpr double kRoughness = 0.8;  // metres
  static constexpr int kFarRows = 40;        // two rows per metre
  figures::Correlation near, far, seeds;
  std::size_t cells = 0, beyond = 0;
  double squares = 0;

  void add(const Tree& tree, const GroundedHeightmap& wall, const Tree& other,
           const GroundedHeightmap& twin) {
    for (int j = 0; j < wall.rows; ++j) {
      for (int i = 1; i + 1 < wall.columns; ++i) {
        if (tree.kind(wall.cell(i, j)) != CellKind::kHeight) continue;
        const double height = tree.height(wall.cell(i, j));
        ++cells;
        squares += height * height;
        beyond += std::abs(height) > kRoughness;
        pair(near, height, tree, wall, i, j + 1);
        pair(far, height, tree, wall, i, j + kFarRows);
        pair(seeds, height, other, twin, i, j);
      }
    }
  }

 private:
  static void pair(figures::Correlation& pairs, double height, const Tree& tree,
                   const GroundedHeightmap& wall, int i, int j) {
    if (i >= wall.columns || j >= wall.rows || tree.kind(wall.cell(i, j)) != CellKind::kHeight) return;
    pairs.add(height, tree.height(wall.cell(i, j)));
  }
};

void measure_walls(const RunOptions& options, Recorder& recorder) {
  constexpr std::uint64_t kTunnels = 8;
  WallNoise noise;
  Ght tunnel = noisy_tunnel(options.seed, WallNoise::kRoughness);
  for (std::uint64_t k = 1; k <= kTunnels; ++k) {
    Ght next = noisy_tunnel(options.seed + k, WallNoise::kRoughness);
    const Tree &tree = tunnel.model().tree, &other = next.model().tree;
    for (NodeId n = 1; n < std::min(tree.nodes().size(), other.nodes().size()); ++n) {
      if (tree.nodes()[n].area == Area::kIndoor) noise.add(tree, tree.nodes()[n], other, other.nodes()[n]);
    }
    tunnel = std::move(next);
  }
  recorder.add("wall_cells", "", noise.cells);
  recorder.add("beyond_roughness", "", noise.beyond);
  recorder.add("height_share", "",
               std::sqrt(noise.squares / static_cast<double>(noise.cells)) / WallNoise::kRoughness);
  recorder.add("near_correlation", "", noise.near.value());
  recorder.add("far_correlation", "", noise.far.value());
  recorder.add("seed_correlation", "", noise.seeds.value());
}

constexpr std::array kTopics{Topic{"hosts", measure_hosts},
                             Topic{"inclined", measure_inclined},
                             Topic{"interpolated", measure_interpolated},
                             Topic{"links", measure_links},
                             Topic{"null-links", measure_null_links},
                             Topic{"walls", measure_walls}};
constexpr std::array kNames = names_of(kTopics);
const std::array kSpecs{choice("topic", kNames, "what is measured")};

std::vector<Case> cases(const RunOptions&) { return cases_by("topic", kSpecs); }

void measure(const Case& test_case, const RunOptions& options, Recorder& recorder, Progress&) {
  kTopics[test_case.parameters.choice("topic")].measure(options, recorder);
}

}  // namespace

extern const Experiment kCells{"ght.cells", "§3.2: hosts, inclined cells, links, walls", kSpecs, cases,
                               measure};

}  // namespace terrabench::ght
