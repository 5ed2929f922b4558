// broken_invariants() of trees with a planted error: one line each, and the right one.
#include "tests/representations/ght_ground.h"

namespace terrabench::test {
namespace {

using namespace ght;
using testing::ElementsAre;
using testing::HasSubstr;

class PlantedFault : public testing::Test {
 protected:
  PlantedFault() {
    Ght ght = make_ght(rolling(49, 49));
    ght.apply(events::DipFault{false, {16, 26}, {34, 22}, 10, 3, 60});
    model_ = ght.model();
    EXPECT_THAT(broken_invariants(model_), testing::IsEmpty());
  }
  FaceId some_face() const {
    FaceId some = kNone;
    model_.surface.each_face([&](FaceId f) { some = f; });
    return some;
  }
  void expect_one(std::string_view what) const {
    EXPECT_THAT(broken_invariants(model_), ElementsAre(HasSubstr(std::string(what))));
  }
  void add_faces(const std::vector<Face>& faces) {
    std::vector<FaceId> ids(faces.size());
    model_.surface.prepare(model_.tree, {}, faces);
    model_.surface.add(faces, model_.surface.place(model_.tree, faces), ids);
  }
  // A node that nothing refers to, part of no event.
  NodeId spare() {
    GroundedHeightmap node;
    node.columns = node.rows = 2;
    node.parent = 0;
    node.aligned = true;
    node.i0 = node.j0 = 5;
    return model_.tree.append(node);
  }

  Model model_;
};

TEST_F(PlantedFault, AVoidCorner) {
  model_.tree.set_void(model_.surface.face(some_face())[0]);
  EXPECT_THAT(broken_invariants(model_),
              testing::Contains(HasSubstr("corners of the surface without a height")));
}

TEST_F(PlantedFault, ALinkToAnUnusedCell) {
  CellId link = 0;
  while (model_.tree.kind(link) != CellKind::kLink) ++link;
  model_.tree.set_link(link, model_.tree.nodes()[spare()].first);
  EXPECT_THAT(broken_invariants(model_),
              testing::Contains(HasSubstr("links that do not lead to the surface")));
}

TEST_F(PlantedFault, AMissingFace) {
  // Within one heightmap, so that no link goes with it.
  FaceId inner = kNone;
  const Tree& tree = model_.tree;
  model_.surface.each_face([&](FaceId f) {
    const Face& face = model_.surface.face(f);
    if (tree.node_of(face[0]) == tree.node_of(face[1]) && tree.node_of(face[1]) == tree.node_of(face[2]))
      inner = f;
  });
  ASSERT_NE(inner, kNone);
  model_.surface.remove(tree, inner);
  expect_one("edges with one face only");
}

TEST_F(PlantedFault, AFaceTwice) {
  add_faces({model_.surface.face(some_face())});
  expect_one("edges that two faces have in the same direction");
}

TEST_F(PlantedFault, AHeightmapTooMany) {
  spare();
  expect_one("heightmaps that no event added");
}

TEST_F(PlantedFault, AnEventOfTooFewHeightmaps) {
  const NodeId n = spare();
  model_.tree.append(Applied{events::Kind::kLateralFault, 0, n, 1});
  expect_one("the paper's number of heightmaps");
}

TEST_F(PlantedFault, AnUnlinkedBoundaryCell) {
  // A separate two-sided surface: closed, but joined to nothing.
  const NodeId n = spare();
  const CellId c = model_.tree.nodes()[n].first;
  for (CellId k = c; k < c + 4; ++k) model_.tree.set_height(k, 20);
  add_faces({{c, c + 1, c + 2}, {c, c + 2, c + 1}});
  model_.tree.append(Applied{events::Kind::kRadialErosion, 0, n, 1});
  expect_one("without a link to another one: 3");
  EXPECT_EQ(unlinked_boundary_cells(model_), 3U);
}

// Each kind of wrong stored link is one difference.
TEST_F(PlantedFault, AWrongBoundaryLink) {
  const LinkReport right = check_boundary_links(model_);
  EXPECT_EQ(right.wrong, 0U);
  EXPECT_EQ(right.stored, right.derived);
  EXPECT_GT(right.stored, 50U);
  std::pair<CellId, CellId> some;
  model_.links.each([&](CellId c, CellId to) { some = {c, to}; });

  const auto [cell, target] = some;
  model_.links.set(cell, target - 1);
  expect_one("boundary links other than the surface's triangles have: 1");
  model_.links.set(cell, target);
  EXPECT_THAT(broken_invariants(model_), testing::IsEmpty());

  model_.links.erase(cell);
  EXPECT_EQ(check_boundary_links(model_).wrong, 1U);
  EXPECT_EQ(check_boundary_links(model_).stored, right.stored - 1);
  model_.links.set(cell, target);

  model_.links.prepare(2);
  model_.links.set(0, target);  // the root has none
  model_.links.set(model_.tree.cells() + 5, target);
  EXPECT_EQ(check_boundary_links(model_).wrong, 2U);
}

TEST(GhtFacts, HaveThousandsSeparators) {
  const Ght ght({129, 129, 1, 1, 0, 0}, std::vector<float>(129 * 129, 5.0F), 0);
  const auto facts = ght.facts();
  EXPECT_EQ(facts.at(1).second, "16,641 heights, 0 links, 0 void");
}

}  // namespace
}  // namespace terrabench::test
