#include "representations/ght/cut_out.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "representations/ght/triangulate.h"

namespace terrabench::ght {
namespace {

// How often a part may grow until its rim is one loop.
constexpr int kMostWidenings = 8;

// Collects squares and faces of the surface, and refuses those that an event may not change.
class Collector {
 public:
  explicit Collector(const Edit& edit)
      : edit_(edit), tree_(edit.tree()), surface_(edit.model().surface), grid_(edit.grid()) {}

  template <class Shape>
  void add_touched(const Shape& shape, RemovedPart& part) const {
    const auto corners = shape.corners();
    PlanBounds box;
    for (const glm::dvec2 p : corners) box.add(p);
    const auto [low, high] = box;
    if (!(low.x >= grid_.x(0) && low.y >= grid_.z(0) && high.x <= grid_.x(grid_.width - 1) &&
          high.y <= grid_.z(grid_.depth - 1))) {
      at_border();
    }
    const SquareRange rows = surface_.range(low, high);
    for (int j = rows.j0; j <= rows.j1; ++j) {
      const auto [west, east] = extent_in_row(corners, grid_.z(j), grid_.z(j + 1));
      if (west > east) continue;
      const SquareRange row = surface_.range({west, grid_.z(j)}, {east, grid_.z(j)});
      for (int i = row.i0; i <= row.i1; ++i) add_touched(shape, {i, j}, part);
    }
    sort_and_check(part);
  }

  // Everything with a corner at the cell.
  void add_around(CellId c, RemovedPart& part) const {
    const glm::dvec2 p = tree_.plan(c);
    const SquareRange r = surface_.range(p, p);
    for (int j = r.j0; j <= r.j1; ++j) {
      for (int i = r.i0; i <= r.i1; ++i) {
        const Square s{i, j};
        if (surface_.plain(tree_, s)) {
          const auto corners = ComposedSurface::corners(tree_, s);
          if (std::find(corners.begin(), corners.end(), c) != corners.end()) part.squares.push_back(s);
        }
        surface_.over(s, [&](FaceId f) {
          const Face& face = surface_.face(f);
          if (std::find(face.begin(), face.end(), c) != face.end()) part.faces.push_back(f);
        });
      }
    }
  }

  void sort_and_check(RemovedPart& part) const {
    sort_unique(part.squares);
    sort_unique(part.faces);
    for (const Square s : part.squares) check(s);
    for (const FaceId f : part.faces) check(f);
  }

 private:
  [[noreturn]] void at_border() const {
    edit_.refuse("comes too near to the terrain's border", "keep two sample spacings between them");
  }

  // Where the outline lies between two lines of equal z.
  static std::pair<double, double> extent_in_row(std::span<const glm::dvec2> corners, double z0, double z1) {
    double west = HUGE_VAL, east = -HUGE_VAL;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const glm::dvec2 a = corners[k], b = corners[(k + 1) % corners.size()];
      const double low = std::max(std::min(a.y, b.y), z0), high = std::min(std::max(a.y, b.y), z1);
      if (low > high) continue;
      for (const double z : {low, high}) {
        const double x = a.y == b.y ? a.x : a.x + (b.x - a.x) * (z - a.y) / (b.y - a.y);
        for (const double end : a.y == b.y ? std::array{a.x, b.x} : std::array{x, x}) {
          west = std::min(west, end);
          east = std::max(east, end);
        }
      }
    }
    return {west, east};
  }

  template <class Shape>
  void add_touched(const Shape& shape, Square s, RemovedPart& part) const {
    if (!surface_.covered(s)) {
      const glm::dvec2 nw{grid_.x(s.i), grid_.z(s.j)}, se{grid_.x(s.i + 1), grid_.z(s.j + 1)};
      const glm::dvec2 sw{nw.x, se.y}, ne{se.x, nw.y};
      if (shape.touches({nw, sw, ne}) || shape.touches({ne, sw, se})) part.squares.push_back(s);
    }
    surface_.over(s, [&](FaceId f) {
      const Face& face = surface_.face(f);
      if (indoor(face)) return;
      if (shape.touches({tree_.plan(face[0]), tree_.plan(face[1]), tree_.plan(face[2])})) {
        part.faces.push_back(f);
      }
    });
  }

  bool indoor(const Face& face) const {
    return std::all_of(face.begin(), face.end(), [&](CellId c) { return area(c) == Area::kIndoor; });
  }
  // Whether the cell is part of a carving, and of which kind; overhangs count as outdoor here.
  Area area(CellId c) const {
    if (!edit_.model().carved || c < tree_.nodes()[0].cells()) return Area::kOutdoor;
    const GroundedHeightmap& node = tree_.nodes()[tree_.node_of(c)];
    return is_carving(tree_.events()[node.event].kind) ? node.area : Area::kOutdoor;
  }

  void check(Square s) const {
    if (s.i < 1 || s.j < 1 || s.i + 2 >= grid_.width - 1 || s.j + 2 >= grid_.depth - 1) at_border();
    if (tree_.has_holes()) {  // meshes have walls along holes for plain squares only
      SquareRange{s.i - 1, s.j - 1, s.i + 1, s.j + 1}.each([&](Square neighbour) {
        if (ComposedSurface::hole(tree_, neighbour)) edit_.refuse(kNoData, kFillNoData);
      });
    }
    for (const CellId c : ComposedSurface::corners(tree_, s)) check_outdoor(c);
  }

  void check(FaceId f) const {
    const Face& face = surface_.face(f);
    for (const CellId c : face) check_outdoor(c);
    const std::array<glm::vec3, 3> p = {tree_.position(face[0]), tree_.position(face[1]),
                                        tree_.position(face[2])};
    const double area = turn(map_point(p[0]), map_point(p[1]), map_point(p[2]));
    const double spacing = grid_.spacing(), upright = 1e-4 * spacing * spacing;
    if (area >= -upright) return;  // cliffs are upright
    edit_.refuse("touches ground that lies over itself", kMove);
  }
  void check_outdoor(CellId c) const {
    if (area(c) != Area::kOutdoor) edit_.refuse("touches the mouth of a tunnel or cave", kMove);
  }

  const Edit& edit_;
  const Tree& tree_;
  const ComposedSurface& surface_;
  const SampleGrid& grid_;
};

// All edges of the part's triangles, except those between two of its squares.
std::vector<Edge> edges_of(const Model& model, const RemovedPart& part) {
  std::vector<Edge> edges;
  for (const Square s : part.squares) {
    const auto c = ComposedSurface::corners(model.tree, s);
    const Square beyond[] = {{s.i - 1, s.j}, {s.i, s.j + 1}, {s.i + 1, s.j}, {s.i, s.j - 1}};
    for (std::size_t k = 0; k < 4; ++k) {
      if (!std::binary_search(part.squares.begin(), part.squares.end(), beyond[k])) {
        edges.push_back({c[k], c[(k + 1) % 4]});
      }
    }
  }
  for (const FaceId f : part.faces) add_edges(model.surface.face(f), edges);
  return edges;
}

std::vector<CellId> cells_inside(const Model& model, const RemovedPart& part) {
  const std::vector<CellId> cells = model.surface.cells_at(model.tree, part.squares, part.faces);
  std::vector<CellId> loop = part.loop, inside;
  std::sort(loop.begin(), loop.end());
  std::set_difference(cells.begin(), cells.end(), loop.begin(), loop.end(), std::back_inserter(inside));
  return inside;
}

template <class Shape>
RemovedPart cut_out_shape(Edit& edit, const Shape& shape) {
  const Collector collector(edit);
  RemovedPart part;
  collector.add_touched(shape, part);
  for (int widening = 0; widening <= kMostWidenings; ++widening) {
    std::vector<CellId> around;
    std::vector<Loop> loops = rims(edges_of(edit.model(), part), around);
    if (loops.size() == 1) {
      part.loop = std::move(loops[0]);
      part.superseded = cells_inside(edit.model(), part);
      edit.remove(part.squares, part.faces);
      return part;
    }
    // Whatever touches an inner loop is removed as well, so that the part grows over what the loop encloses.
    const auto area = [&](const Loop& loop) { return doubled_area(map_points(edit.tree(), loop)); };
    const auto outermost = std::max_element(loops.begin(), loops.end(),
                                            [&](const Loop& a, const Loop& b) { return area(a) < area(b); });
    for (auto loop = loops.begin(); loop != loops.end(); ++loop) {
      if (loop != outermost) around.insert(around.end(), loop->begin(), loop->end());
    }
    for (const CellId c : around) collector.add_around(c, part);
    collector.sort_and_check(part);
  }
  edit.refuse("touches ground that is not bounded by one closed loop", kMove);
}

}  // namespace

std::array<glm::dvec2, 4> TurnedRectangle::corners() const {
  return {line.plan({u0, d0}), line.plan({u1, d0}), line.plan({u1, d1}), line.plan({u0, d1})};
}

bool TurnedRectangle::touches(std::array<glm::dvec2, 3> p) const {
  for (glm::dvec2& q : p) q = line.local(q);
  const auto apart = [&](auto axis) {
    const double a = axis(p[0]), b = axis(p[1]), c = axis(p[2]);
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const glm::dvec2 corner : {glm::dvec2{u0, d0}, {u1, d0}, {u1, d1}, {u0, d1}}) {
      low = std::min(low, axis(corner));
      high = std::max(high, axis(corner));
    }
    return std::max({a, b, c}) < low || std::min({a, b, c}) > high;
  };
  if (apart([](glm::dvec2 q) { return q.x; }) || apart([](glm::dvec2 q) { return q.y; })) return false;
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec2 edge = p[(k + 1) % 3] - p[k];
    if (apart([&](glm::dvec2 q) { return q.x * edge.y - q.y * edge.x; })) return false;
  }
  return true;
}

bool WidenedPolygon::touches(std::array<glm::dvec2, 3> triangle) const {
  if (inside(polygon, triangle[0]) || inside(triangle, polygon[0])) return true;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const glm::dvec2 a = polygon[k], b = polygon[(k + 1) % polygon.size()];
    for (std::size_t e = 0; e < 3; ++e) {
      if (segments_within(a, b, triangle[e], triangle[(e + 1) % 3], margin)) return true;
    }
  }
  return false;
}

RemovedPart cut_out(Edit& edit, const TurnedRectangle& shape) { return cut_out_shape(edit, shape); }

RemovedPart cut_out(Edit& edit, const WidenedPolygon& shape) { return cut_out_shape(edit, shape); }

void check_ground(const Edit& edit, const TurnedRectangle& shape) {
  RemovedPart unused;
  Collector(edit).add_touched(shape, unused);
}

}  // namespace terrabench::ght
