#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "representations/ght/surgery.h"
#include "representations/ght/triangulate.h"

namespace terrabench::ght {
namespace {

constexpr std::string_view kMove = "move the event, or make it smaller";
// Times that a cut may grow until its border is one loop.
constexpr int kMostWidenings = 8;

bool contains(const std::vector<Square>& sorted, Square s) {
  return std::binary_search(sorted.begin(), sorted.end(), s);
}

template <class T>
void sort_unique(std::vector<T>& v) {
  std::sort(v.begin(), v.end());
  v.erase(std::unique(v.begin(), v.end()), v.end());
}

glm::dvec2 plan_of(const Tree& tree, CellId c) { return tree.plan(c); }

class Surveyor {
 public:
  Surveyor(const Model& model, const Refusal& refusal)
      : model_(model), tree_(model.tree), refusal_(refusal) {}

  template <class Shape>
  void take(const Shape& region, Cut& out) const {
    const auto corners = region.corners();
    glm::dvec2 low = corners[0], high = corners[0];
    for (const glm::dvec2 p : corners) low = glm::min(low, p), high = glm::max(high, p);
    const Lattice& lattice = tree_.lattice();
    if (!(low.x >= lattice.x(0) && low.y >= lattice.z(0) && high.x <= lattice.x(lattice.width - 1) &&
          high.y <= lattice.z(lattice.depth - 1))) {
      at_border();
    }
    const SquareRange rows = model_.surface.range(low, high);
    for (int j = rows.j0; j <= rows.j1; ++j) {
      const auto [west, east] = extent_in_row(corners, lattice.z(j), lattice.z(j + 1));
      if (west > east) continue;
      const SquareRange row = model_.surface.range({west, lattice.z(j)}, {east, lattice.z(j)});
      for (int i = row.i0; i <= row.i1; ++i) take(region, {i, j}, out);
    }
    finish(out);
  }

  // All that has a cell as a corner.
  void take_around(CellId c, Cut& out) const {
    const glm::dvec2 p = plan_of(tree_, c);
    const SquareRange r = model_.surface.range(p, p);
    for (int j = r.j0; j <= r.j1; ++j) {
      for (int i = r.i0; i <= r.i1; ++i) {
        const Square s{i, j};
        if (model_.surface.plain(tree_, s)) {
          const auto corners = Surface::corners(tree_, s);
          if (std::find(corners.begin(), corners.end(), c) != corners.end()) out.squares.push_back(s);
        }
        model_.surface.over(s, [&](FaceId f) {
          const Face& face = model_.surface.face(f);
          if (std::find(face.begin(), face.end(), c) != face.end()) out.faces.push_back(f);
        });
      }
    }
  }

  void finish(Cut& out) const {
    sort_unique(out.squares);
    sort_unique(out.faces);
    for (const Square s : out.squares) check(s);
    for (const FaceId f : out.faces) check(f);
  }

 private:
  [[noreturn]] void at_border() const {
    refusal_.refuse("comes too near to the terrain's border", "keep two cells between them");
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
  void take(const Shape& region, Square s, Cut& out) const {
    const Lattice& lattice = tree_.lattice();
    if (!model_.surface.covered(s)) {
      const glm::dvec2 nw{lattice.x(s.i), lattice.z(s.j)}, se{lattice.x(s.i + 1), lattice.z(s.j + 1)};
      const glm::dvec2 sw{nw.x, se.y}, ne{se.x, nw.y};
      if (region.touches({nw, sw, ne}) || region.touches({ne, sw, se})) out.squares.push_back(s);
    }
    model_.surface.over(s, [&](FaceId f) {
      const Face& face = model_.surface.face(f);
      if (indoor(face)) return;
      if (region.touches({plan_of(tree_, face[0]), plan_of(tree_, face[1]), plan_of(tree_, face[2])})) {
        out.faces.push_back(f);
      }
    });
  }

  bool indoor(const Face& face) const {
    return std::all_of(face.begin(), face.end(), [&](CellId c) { return area(c) == Area::kIndoor; });
  }
  // Of a carving; overhangs count as outdoor here.
  Area area(CellId c) const {
    if (!model_.carved || c < tree_.nodes()[0].cells()) return Area::kOutdoor;
    const Node& node = tree_.nodes()[tree_.node_of(c)];
    return is_carving(tree_.events()[node.event].kind) ? node.area : Area::kOutdoor;
  }

  void check(Square s) const {
    const Lattice& lattice = tree_.lattice();
    if (s.i < 1 || s.j < 1 || s.i + 2 >= lattice.width - 1 || s.j + 2 >= lattice.depth - 1) at_border();
    if (tree_.has_holes()) {  // walls along holes are made for plain squares alone
      for (int j = s.j - 1; j <= s.j + 1; ++j) {
        for (int i = s.i - 1; i <= s.i + 1; ++i) {
          if (Surface::hole(tree_, {i, j})) {
            refusal_.refuse("touches ground without data", "fill the no-data cells, or move the event");
          }
        }
      }
    }
    for (const CellId c : Surface::corners(tree_, s)) check_outdoor(c);
  }

  void check(FaceId f) const {
    const Face& face = model_.surface.face(f);
    for (const CellId c : face) check_outdoor(c);
    const std::array<glm::vec3, 3> p = {tree_.position(face[0]), tree_.position(face[1]),
                                        tree_.position(face[2])};
    const double area = turn(map_point(p[0]), map_point(p[1]), map_point(p[2]));
    const double cell = tree_.lattice().cell(), upright = 1e-4 * cell * cell;
    if (area >= -upright) return;  // cliffs are upright
    refusal_.refuse("touches ground that lies over itself", kMove);
  }
  void check_outdoor(CellId c) const {
    if (area(c) != Area::kOutdoor) refusal_.refuse("touches the mouth of a tunnel or cave", kMove);
  }

  const Model& model_;
  const Tree& tree_;
  const Refusal& refusal_;
};

struct Edge {
  CellId from, to;
  auto operator<=>(const Edge&) const = default;
};

// The edges of a cut's squares and faces that no other one shares, ascending.
std::vector<Edge> border(const Model& model, const Cut& cut) {
  std::vector<Edge> edges;
  for (const Square s : cut.squares) {
    const auto c = Surface::corners(model.tree, s);
    const Square beyond[] = {{s.i - 1, s.j}, {s.i, s.j + 1}, {s.i + 1, s.j}, {s.i, s.j - 1}};
    for (std::size_t k = 0; k < 4; ++k) {
      if (!contains(cut.squares, beyond[k])) edges.push_back({c[k], c[(k + 1) % 4]});
    }
  }
  for (const FaceId f : cut.faces) {
    const Face& face = model.surface.face(f);
    for (std::size_t k = 0; k < 3; ++k) edges.push_back({face[k], face[(k + 1) % 3]});
  }
  const auto undirected = [](const Edge& e) { return std::minmax(e.from, e.to); };
  std::sort(edges.begin(), edges.end(),
            [&](const Edge& a, const Edge& b) { return undirected(a) < undirected(b); });
  std::vector<Edge> left;
  for (std::size_t k = 0; k < edges.size(); ++k) {
    if (k + 1 < edges.size() && edges[k] == Edge{edges[k + 1].to, edges[k + 1].from}) {
      ++k;
    } else {
      left.push_back(edges[k]);
    }
  }
  std::sort(left.begin(), left.end());
  return left;
}

using Loops = std::vector<std::vector<CellId>>;

// Follows the edges around. Cells that two loops share are put into `pinched`, and then there are no
// loops; nor are there of edges that do not close.
Loops loops_of(const std::vector<Edge>& edges, std::vector<CellId>& pinched) {
  for (std::size_t k = 1; k < edges.size(); ++k) {
    if (edges[k].from == edges[k - 1].from) pinched.push_back(edges[k].from);
  }
  Loops loops;
  if (!pinched.empty()) return loops;
  std::vector<char> used(edges.size(), 0);
  for (std::size_t start = 0; start < edges.size(); ++start) {
    if (used[start] != 0) continue;
    loops.emplace_back();
    for (std::size_t at = start; used[at] == 0;) {
      used[at] = 1;
      loops.back().push_back(edges[at].from);
      const CellId next = edges[at].to;
      at = static_cast<std::size_t>(std::lower_bound(edges.begin(), edges.end(), Edge{next, 0}) -
                                    edges.begin());
      if (at == edges.size() || edges[at].from != next) return {};
    }
  }
  return loops;
}

double area(const Tree& tree, const std::vector<CellId>& loop) {
  double twice = 0;
  const glm::dvec2 origin = map_point(tree.position(loop[0]));
  for (std::size_t k = 1; k + 1 < loop.size(); ++k) {
    twice += turn(origin, map_point(tree.position(loop[k])), map_point(tree.position(loop[k + 1])));
  }
  return twice;
}

std::vector<CellId> within(const Model& model, const Cut& cut) {
  std::vector<CellId> cells, loop = cut.loop, inside;
  for (const Square s : cut.squares) {
    const auto c = Surface::corners(model.tree, s);
    cells.insert(cells.end(), c.begin(), c.end());
  }
  for (const FaceId f : cut.faces) {
    const Face& face = model.surface.face(f);
    cells.insert(cells.end(), face.begin(), face.end());
  }
  sort_unique(cells);
  std::sort(loop.begin(), loop.end());
  std::set_difference(cells.begin(), cells.end(), loop.begin(), loop.end(), std::back_inserter(inside));
  return inside;
}

double distance_to_segment(glm::dvec2 p, glm::dvec2 a, glm::dvec2 b) {
  const glm::dvec2 along = b - a;
  const double length = glm::dot(along, along);
  const double at = length > 0 ? std::clamp(glm::dot(p - a, along) / length, 0.0, 1.0) : 0;
  return glm::distance(p, a + at * along);
}

bool segments_within(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c, glm::dvec2 d, double margin) {
  if (turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0) return true;
  return std::min({distance_to_segment(a, c, d), distance_to_segment(b, c, d), distance_to_segment(c, a, b),
                   distance_to_segment(d, a, b)}) < margin;
}

bool inside(std::span<const glm::dvec2> polygon, glm::dvec2 p) {
  bool in = false;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const glm::dvec2 a = polygon[k], b = polygon[(k + 1) % polygon.size()];
    if ((a.y <= p.y) != (b.y <= p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)) in = !in;
  }
  return in;
}

template <class Shape>
Cut cut_along(const Model& model, const Shape& shape, const Refusal& refusal) {
  const Surveyor surveyor(model, refusal);
  Cut cut;
  surveyor.take(shape, cut);
  for (int widening = 0; widening <= kMostWidenings; ++widening) {
    std::vector<CellId> around;
    Loops loops = loops_of(border(model, cut), around);
    if (loops.size() == 1) {
      cut.loop = std::move(loops[0]);
      cut.superseded = within(model, cut);
      return cut;
    }
    // What a loop other than the outermost encloses goes too, from its rim on.
    const auto outermost = std::max_element(loops.begin(), loops.end(), [&](const auto& a, const auto& b) {
      return area(model.tree, a) < area(model.tree, b);
    });
    for (auto loop = loops.begin(); loop != loops.end(); ++loop) {
      if (loop != outermost) around.insert(around.end(), loop->begin(), loop->end());
    }
    for (const CellId c : around) surveyor.take_around(c, cut);
    surveyor.finish(cut);
  }
  refusal.refuse("does not leave one ring of ground around it", kMove);
}

}  // namespace

std::array<glm::dvec2, 4> Region::corners() const {
  return {line.plan({u0, d0}), line.plan({u1, d0}), line.plan({u1, d1}), line.plan({u0, d1})};
}

bool Region::touches(std::array<glm::dvec2, 3> p) const {
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

bool Patch::touches(std::array<glm::dvec2, 3> triangle) const {
  if (inside(polygon, triangle[0]) || inside(triangle, polygon[0])) return true;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const glm::dvec2 a = polygon[k], b = polygon[(k + 1) % polygon.size()];
    for (std::size_t e = 0; e < 3; ++e) {
      if (segments_within(a, b, triangle[e], triangle[(e + 1) % 3], margin)) return true;
    }
  }
  return false;
}

Cut survey(const Model& model, const Region& region, const Refusal& refusal) {
  Cut cut;
  Surveyor(model, refusal).take(region, cut);
  return cut;
}

Cut cut(const Model& model, const Region& region, const Refusal& refusal) {
  return cut_along(model, region, refusal);
}

Cut cut(const Model& model, const Patch& patch, const Refusal& refusal) {
  return cut_along(model, patch, refusal);
}

}  // namespace terrabench::ght
