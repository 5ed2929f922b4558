// The bits and their sums, the neighbours that nodes have by their numbers, and the triangles, which are
// those of rtin.
#include "lod/cbt/cbt.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

#include "lod/meters/cracks.h"
#include "lod/meters/triangle_set.h"
#include "lod/rtin/rtin.h"
#include "tests/lod/drawing.h"
#include "tests/lod/variants.h"

namespace terrabench::test {
namespace {

using cbt::NodeId, cbt::Place;

// The leaves below a node, from left to right.
std::vector<NodeId> leaves_below(const cbt::BitTree& tree, NodeId node) {
  if (!tree.is_split(node)) return {node};
  std::vector<NodeId> all = leaves_below(tree, 2 * node);
  for (const NodeId leaf : leaves_below(tree, 2 * node + 1)) all.push_back(leaf);
  return all;
}

TEST(BitTree, SumsTheLeavesOfEveryNode) {
  for (const int depth : {1, 2, 5, 9}) {
    std::mt19937 random(static_cast<unsigned>(depth));
    cbt::BitTree tree(depth);
    tree.add_leaf(1);
    std::set<NodeId> leaves{1};
    for (int k = 0; k < 400; ++k) {
      const NodeId node = *std::next(leaves.begin(), random() % leaves.size());
      if (random() % 3 > 0 && cbt::level_of(node) < depth) {
        tree.split(node);
        leaves.erase(node);
        leaves.insert({2 * node, 2 * node + 1});
      } else if (node > 1 && leaves.contains(node ^ 1)) {
        tree.merge(node / 2);
        leaves.erase(node);
        leaves.erase(node ^ 1);
        leaves.insert(node / 2);
      }
    }
    std::map<NodeId, std::size_t> sums;
    for (const NodeId leaf : leaves) {
      for (NodeId node = leaf; node > 0; node /= 2) ++sums[node];
    }
    for (const auto& [node, sum] : sums) EXPECT_EQ(tree.sum(node), sum);
    const std::vector<NodeId> found = leaves_below(tree, 1);
    EXPECT_EQ(std::set<NodeId>(found.begin(), found.end()), leaves);
    EXPECT_EQ(tree.leaves(), leaves.size());
  }
}

TEST(BitTree, TakesTheBytesOfThePaper) {
  for (const int depth : {6, 11, 17})
    EXPECT_EQ(cbt::BitTree(depth).memory().index, std::size_t{1} << (depth - 1));
}

using Edge = std::array<int, 4>;
Edge edge(glm::ivec2 from, glm::ivec2 to) { return {from.x, from.y, to.x, to.y}; }

// Over 3 × 2 root squares, level by level: across each edge lies the triangle with the same edge the other
// way.
TEST(Bisection, NodesHaveTheNeighboursThatShareTheirEdges) {
  const rtin::Lattice lattice(13, 9);
  ASSERT_EQ(lattice.roots, glm::ivec2(3, 2));
  const cbt::Bisection bisection(lattice);
  EXPECT_EQ(bisection.depth(), bisection.root_level() + 4);
  for (int below = 0; below <= 4; ++below) {
    std::vector<Place> level;
    for (NodeId root = 0; root < bisection.roots(); ++root) {
      for (NodeId k = 0; k < NodeId{1} << below; ++k)
        level.push_back(bisection.at((bisection.root(root) << below) + k));
    }
    std::map<Edge, NodeId> owner;
    for (const Place& p : level) {
      const auto& [a, b, c] = p.triangle;
      for (const Edge& e : {edge(a, b), edge(b, c), edge(c, a)}) EXPECT_TRUE(owner.emplace(e, p.node).second);
    }
    const auto beyond = [&](glm::ivec2 from, glm::ivec2 to) {
      const auto found = owner.find(edge(to, from));
      return found == owner.end() ? NodeId{0} : found->second;
    };
    for (const Place& p : level) {
      const auto& [a, b, c] = p.triangle;
      EXPECT_EQ(p.across, beyond(a, b));
      EXPECT_EQ(p.beside_b, beyond(b, c));
      EXPECT_EQ(p.beside_a, beyond(c, a));
    }
  }
}

TEST(Cbt, DrawsTheTrianglesOfRtinWhateverItDrewBefore) {
  for (const auto& [width, depth] : {std::pair{202, 173}, {129, 129}, {100, 37}, {2, 9}}) {
    const Heightfield field = hilly(width, depth, 0.7F, 1, 5, 5);
    Rtin rtin(field, {}, silent());
    Cbt cbt(field, {}, silent());
    for (const double pixels : {2.0, 0.5, 8.0}) {
      rtin.tune(pixels);
      cbt.tune(pixels);
      for (const View& view : path_over(field, 60)) {
        const TriangleSet drawn(cbt.update(view));
        ASSERT_EQ(drawn, TriangleSet(rtin.update(view)));
        EXPECT_GT(drawn.size(), 0U);
      }
    }
  }
}

TEST(Cbt, WithOnePassPerUpdateApproachesThemByALevelPerFrame) {
  const Heightfield field = hilly(257, 257, 0.7F, 1, 5, 5);
  const std::vector<View> path = path_over(field, 100);
  Cbt slow(field, {.passes = 1}, silent()), whole(field, {}, silent());
  for (const View& view : {path.front(), path.back()}) {
    const TriangleSet wanted(whole.update(view));
    std::size_t frames = 0, changes = 0;
    for (bool equal = false; !equal; ++frames) {
      ASSERT_LT(frames, 40U);
      const Frame& frame = slow.update(view);
      EXPECT_TRUE(find_cracks(frame, field.width, field.depth, view).tight());
      changes += frame.stats.changes;
      equal = TriangleSet(frame) == wanted;
    }
    EXPECT_GT(frames, 4U);
    EXPECT_GT(changes, 100U);
  }
  // Triangles out of view may still be merged.
  for (int k = 0; k < 40 && slow.update(path.back()).stats.changes > 0; ++k) continue;
  EXPECT_EQ(slow.update(path.back()).stats.changes, 0U);
  EXPECT_EQ(slow.tree().leaves(), whole.tree().leaves());
}

TEST(Cbt, ByEdgesDrawsNoEdgeLongerThanThePixelsAllow) {
  const Heightfield field = hilly(202, 173, 0.7F, 1, 5, 5);
  Cbt lod(field, {.by_edge = true}, silent());
  lod.tune(100);
  std::size_t fine = 0;
  for (const View& view : path_over(field, 60)) {
    const Frame& frame = lod.update(view);
    EXPECT_TRUE(find_cracks(frame, field.width, field.depth, view).tight());
    const std::vector<glm::vec3> corners = corners_of(frame);
    const float focal = 0.5F * static_cast<float>(view.height) / std::tan(0.5F * view.vertical_fov);
    for (std::size_t k = 0; k < corners.size(); k += 3) {
      const glm::vec3 &a = corners[k], &b = corners[k + 1];
      const float length = glm::distance(glm::vec2(a.x, a.z), glm::vec2(b.x, b.z));
      const float pixels = focal * length / glm::distance(0.5F * (a + b), view.eye);
      if (length < 1.5F * field.cell_x) continue;  // not split further
      EXPECT_LE(pixels, 100 * 1.001F);
      fine += pixels > 40 ? 1 : 0;
    }
  }
  EXPECT_GT(fine, 0U);
}

}  // namespace
}  // namespace terrabench::test
