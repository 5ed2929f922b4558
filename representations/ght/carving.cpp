// Carvings (Alonso, Joan-Arinyo & Solano, §3.2, figures 15 and 16): a heightmap of type border at each mouth,
// on the root's lattice and void where the section comes out; one of type indoor for each side of the
// section, along the axis, with smooth noise for heights; and for a cave one that closes its end. As in the
// paper they hang from the root.
//
// Walls end at the last row under the ground; from there triangles lead to the border's cells around the
// hole, so a mouth is true to half a cell along the axis and a cell around it. O(cells of the walls · log).
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>

#include "representations/ght/dispatch.h"
#include "representations/ght/triangulate.h"
#include "terrain/events/section.h"

namespace terrabench::ght {
namespace {

constexpr double kRowsPerCell = 2;
// A narrower section has no inside between the cells of its walls.
constexpr double kFewestCells = 2;
// Ground left between a carving and whatever else there is, in cells: both are true to one.
constexpr double kClearance = 1;
// By how much of a cell the ground is cut outside a rim, so that the ring around it has a width.
constexpr double kMargin = 0.1;
// Of one carving's walls: far more than any terrain has room for, far less than memory.
constexpr double kMostWallCells = 1 << 26;

constexpr std::string_view kDeeper = "move 'from' and 'to' deeper into the ground, or take a smaller section";

using Loop = std::vector<CellId>;

// The loops of edges that only one of the faces has, directed as there; nothing when two of them meet in a
// cell.
std::optional<std::vector<Loop>> boundary(std::span<const Face> faces) {
  struct Edge {
    CellId from, to;
    auto operator<=>(const Edge&) const = default;
  };
  std::vector<Edge> edges, open;
  for (const Face& face : faces) {
    for (std::size_t k = 0; k < 3; ++k) edges.push_back({face[k], face[(k + 1) % 3]});
  }
  std::sort(edges.begin(), edges.end());
  for (const Edge& e : edges) {
    if (!std::binary_search(edges.begin(), edges.end(), Edge{e.to, e.from})) open.push_back(e);
  }
  std::vector<Loop> loops;
  std::vector<char> used(open.size(), 0);
  for (std::size_t start = 0; start < open.size(); ++start) {
    if (start > 0 && open[start].from == open[start - 1].from) return std::nullopt;
    if (used[start] != 0) continue;
    loops.emplace_back();
    for (std::size_t at = start; used[at] == 0;) {
      used[at] = 1;
      loops.back().push_back(open[at].from);
      const CellId next = open[at].to;
      at = static_cast<std::size_t>(std::lower_bound(open.begin(), open.end(), Edge{next, 0}) - open.begin());
      if (at == open.size() || open[at].from != next) return std::nullopt;
    }
  }
  return loops;
}

double doubled_area(std::span<const glm::dvec2> polygon) {
  double area = 0;
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k) area += turn(polygon[0], polygon[k], polygon[k + 1]);
  return area;
}

// Whether the point lies within a simple polygon, at least `margin` from its sides.
bool well_within(std::span<const glm::dvec2> polygon, glm::dvec2 p, double margin) {
  bool inside = false;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const glm::dvec2 a = polygon[k], b = polygon[(k + 1) % polygon.size()], along = b - a;
    const double length = glm::dot(along, along);
    const double at = length > 0 ? std::clamp(glm::dot(p - a, along) / length, 0.0, 1.0) : 0;
    if (glm::distance(p, a + at * along) < margin) return false;
    if ((a.y <= p.y) != (b.y <= p.y) && p.x < a.x + along.x * (p.y - a.y) / along.y) inside = !inside;
  }
  return inside;
}

class Bore {
 public:
  Bore(Model& model, const events::Carving& e, NodeId host, const Refusal& refusal)
      : model_(model),
        e_(e),
        host_(host),
        refusal_(refusal),
        lattice_(model.tree.lattice()),
        line_(e.line()),
        cell_(lattice_.cell()),
        edit_(model, refusal) {
    divide();
    check_cover();
    find_ends();
    check_clearance();
    build_walls();
    const auto rims = boundary(edit_.faces());
    if (!rims || rims->size() != 2) refuse_mouth();
    const bool first_is_from = middle((*rims)[0]) < middle((*rims)[1]);
    const Loop &from = (*rims)[first_is_from ? 0 : 1], &to = (*rims)[first_is_from ? 1 : 0];
    open_mouth(from);
    if (e.cave) {
      close_end({to.rbegin(), to.rend()});
    } else {
      open_mouth(to);
    }
    edit_.commit(e.cave ? events::Kind::kCave : events::Kind::kTunnel, host);
  }

 private:
  const Tree& tree() const { return model_.tree; }
  [[noreturn]] void refuse_mouth() const {
    refusal_.refuse("has a mouth that is not one simple hole in the ground",
                    "let it come out of a slope that is smoother, and neither flat nor upright");
  }

  // Into rows of at most half a cell along the axis and columns of at most a cell across the sides.
  void divide() {
    const glm::dvec3 axis = e_.to - e_.from;
    const double rows = std::max(1.0, std::ceil(kRowsPerCell * glm::length(axis) / cell_));
    const double largest = std::max(e_.scale_from, e_.scale_to),
                 smallest = std::min(e_.scale_from, e_.scale_to);
    glm::dvec2 low(HUGE_VAL), high(-HUGE_VAL);
    double ring = 0;
    for (std::size_t k = 0; k < e_.section.size(); ++k) {
      low = glm::min(low, e_.section[k]);
      high = glm::max(high, e_.section[k]);
      const double side = glm::distance(e_.section[k], e_.section[(k + 1) % e_.section.size()]) * largest;
      ring += std::ceil(side / cell_);
    }
    if (!(std::min(high.x - low.x, high.y - low.y) * smallest >= kFewestCells * cell_)) {
      refusal_.refuse("has a section less than two cells wide or high", "take a larger section or scale");
    }
    if (!(rows * ring < kMostWallCells)) {
      refusal_.refuse("has walls of too many cells", "make it shorter or its section smaller");
    }
    rows_ = static_cast<int>(rows);
    step_ = line_.length / rows_;
    first_.push_back(0);
    for (std::size_t k = 0; k < e_.section.size(); ++k) {
      const double side = glm::distance(e_.section[k], e_.section[(k + 1) % e_.section.size()]) * largest;
      first_.push_back(first_.back() + std::max(1, static_cast<int>(std::ceil(side / cell_))));
    }
    bottom_ = low.y;
    top_ = high.y;
  }
  int columns(std::size_t side) const { return first_[side + 1] - first_[side]; }
  // The wall's columns in order around the section; the last of a side is the first of the next.
  int ring(std::size_t side, int column) const { return (first_[side] + column) % first_.back(); }

  glm::dvec3 point(std::size_t side, int column, int row) const {
    const double u = row * step_;
    const glm::dvec2 wall = e_.wall(side, u, static_cast<double>(column) / columns(side));
    const glm::dvec2 plan = line_.plan({u, -wall.x});
    return {plan.x, e_.height(u) + wall.y, plan.y};
  }
  bool on_terrain(glm::dvec2 plan) const {
    return plan.x >= 0 && plan.y >= 0 && plan.x <= lattice_.x(lattice_.width - 1) &&
           plan.y <= lattice_.z(lattice_.depth - 1);
  }
  double ground(glm::dvec2 plan) const {
    const float y = model_.surface.top(tree(), plan);
    if (Heightfield::is_no_data(y)) refusal_.refuse("touches ground without data", "fill the no-data cells");
    return y;
  }

  // Calls visit(a, plan) across the section at u, and `beyond` it on both sides.
  template <class Visit>
  void across(double u, double beyond, const Visit& visit) const {
    const events::Run reach = events::section_reach(e_, u);
    const double low = reach.low - beyond, high = reach.high + beyond;
    const int samples = 2 + static_cast<int>(2 * (high - low) / cell_);
    for (int s = 0; s <= samples; ++s) {
      const double a = low + (high - low) * s / samples;
      const glm::dvec2 plan = line_.plan({u, -a});
      if (on_terrain(plan)) visit(a, plan);
    }
  }

  // Between its two points all of the section lies under ground.
  void check_cover() const {
    std::vector<events::Run> runs;
    const auto check = [&](double u, std::string_view what) {
      across(u, 0, [&](double a, glm::dvec2 plan) {
        events::section_runs(e_, u, a, runs);
        if (!runs.empty() && e_.height(u) + runs.back().high + kClearance * cell_ > ground(plan)) {
          refusal_.refuse(what, kDeeper);
        }
      });
    };
    check(0, "starts in the air, or less than a cell under ground");
    check(line_.length, "ends in the air, or less than a cell under ground");
    for (int j = 1; j < rows_; ++j) check(j * step_, "leaves the ground, or comes within a cell of it");
  }

  // Where each column of the walls comes out.
  void find_ends() {
    low_.assign(static_cast<std::size_t>(first_.back()), 0);
    high_.assign(low_.size(), rows_);
    for (std::size_t k = 0; k < e_.section.size(); ++k) {
      for (int i = 0; i < columns(k); ++i) {
        const auto r = static_cast<std::size_t>(ring(k, i));
        low_[r] = last_under_ground(k, i, 0, -1);
        if (!e_.cave) high_[r] = last_under_ground(k, i, rows_, 1);
      }
    }
    check_out(low_, -1);
    if (!e_.cave) check_out(high_, 1);
    trim(low_, -1);
    trim(high_, 1);
    row0_ = *std::min_element(low_.begin(), low_.end());
    row1_ = *std::max_element(high_.begin(), high_.end());
  }
  // A row on from the last, all of the section is in the air: no column has gone back into the ground.
  // Before, none goes back by more than a cell, which walls that end where each first comes out would leave
  // standing.
  void check_out(const std::vector<int>& ends, int sign) const {
    const int last = sign < 0 ? *std::min_element(ends.begin(), ends.end()) - 1
                              : *std::max_element(ends.begin(), ends.end()) + 1;
    for (std::size_t k = 0; k < e_.section.size(); ++k) {
      for (int i = 0; i < columns(k); ++i) {
        for (int row = ends[static_cast<std::size_t>(ring(k, i))] + sign; row != last + sign; row += sign) {
          const glm::dvec3 p = point(k, i, row);
          const glm::dvec2 plan{p.x, p.z};
          if (!on_terrain(plan) || p.y + (row == last ? 0 : cell_) < ground(plan)) refuse_mouth();
        }
      }
    }
  }
  // Cells further out than one beyond both neighbouring columns would be part of no face.
  static void trim(std::vector<int>& ends, int sign) {
    const std::vector<int> before = ends;
    const std::size_t n = ends.size();
    for (std::size_t r = 0; r < n; ++r) {
      const int further = std::max(sign * before[(r + n - 1) % n], sign * before[(r + 1) % n]);
      ends[r] = sign * std::min(sign * before[r], further + 1);
    }
  }
  int last_under_ground(std::size_t side, int column, int row, int step) const {
    for (;; row += step) {
      if (std::abs(row) * static_cast<double>(first_.back()) > kMostWallCells) {
        refusal_.refuse("has walls of too many cells", "let its axis be less upright, or make it shorter");
      }
      const glm::dvec3 p = point(side, column, row + step);
      const glm::dvec2 plan{p.x, p.z};
      if (!on_terrain(plan) || e_.scale((row + step) * step_) <= 0) {
        refusal_.refuse(step < 0 ? "does not come out of the ground beyond 'from'"
                                 : "does not come out of the ground beyond 'to'",
                        "let the axis rise to the surface, and more steeply than the ground");
      }
      if (p.y >= ground(plan)) return row;
    }
  }

  // Nothing but the ground above may come near: no other carving, no overhang.
  void check_clearance() const {
    const double far = kClearance * cell_, near_rows = std::ceil(far / step_);
    if (!model_.carved && !has_overhangs()) return;
    std::vector<Crossing> crossed;
    for (double j = row0_ - near_rows; j <= row1_ + near_rows; ++j) {
      const double u = j * step_, scale = e_.scale(u);
      const double low = e_.height(u) + bottom_ * scale - e_.roughness - far;
      const double high = e_.height(u) + top_ * scale + e_.roughness + far;
      across(u, far, [&](double, glm::dvec2 plan) {
        const auto x = static_cast<float>(plan.x), z = static_cast<float>(plan.y);
        Square s;
        if (!model_.surface.find(x, z, s)) return;
        crossed.clear();
        model_.surface.crossings(tree(), x, z, s, crossed);
        const auto top = std::max_element(crossed.begin(), crossed.end(),
                                          [](const Crossing& a, const Crossing& b) { return a.y < b.y; });
        for (auto c = crossed.begin(); c != crossed.end(); ++c) {
          if (c == top || c->y < low || c->y > high) continue;
          refusal_.refuse("comes within a cell of another tunnel or cave, or of an overhang", "move it away");
        }
      });
    }
  }
  bool has_overhangs() const {
    return std::any_of(tree().events().begin(), tree().events().end(),
                       [](const Applied& a) { return a.kind == events::Kind::kInverseFault; });
  }

  // A vector of the section, to the right and up, in space.
  glm::dvec3 spatial(glm::dvec2 section) const {
    return {-line_.left.x * section.x, section.y, -line_.left.y * section.x};
  }

  void build_walls() {
    const std::size_t sides = e_.section.size();
    for (std::size_t k = 0; k < sides; ++k) walls_.push_back(edit_.append(wall(k)));
    for (std::size_t k = 0; k < sides; ++k) {
      const Node& node = walls_[k];
      for (int i = 0; i < node.columns; ++i) {
        const auto r = static_cast<std::size_t>(ring(k, i));
        for (int j = low_[r]; j <= high_[r]; ++j) {
          const CellId c = node.cell(i, j - row0_);
          // Links run to later cells: the last side holds both its edges, the others their first.
          if (i == columns(k) && k + 1 < sides) {
            edit_.tree().set_link(c, walls_[k + 1].cell(0, j - row0_));
          } else if (i == 0 && k == 0) {
            edit_.tree().set_link(c, walls_[sides - 1].cell(columns(sides - 1), j - row0_));
          } else {
            const double share = static_cast<double>(i) / columns(k);
            edit_.tree().set_height(c, static_cast<float>(-e_.bulge(k, j * step_, share)));
          }
        }
      }
    }
    for (const Node& node : walls_) edit_.quads(node, false);
  }

  // Heights measure inwards from the flat side.
  Node wall(std::size_t side) const {
    const glm::dvec2 a = e_.section[side], b = e_.section[(side + 1) % e_.section.size()];
    const double u0 = row0_ * step_, m = columns(side);
    const double growth = (e_.scale_to - e_.scale_from) / rows_;  // of the scale, a row
    const glm::dvec2 plan = line_.plan({u0, 0});
    const double rise = (e_.to.y - e_.from.y) / rows_;
    Node node = new_node(model_, host_, Area::kIndoor);
    node.columns = columns(side) + 1;
    node.rows = row1_ - row0_ + 1;
    node.frame.origin = glm::dvec3(plan.x, e_.height(u0), plan.y) + spatial(e_.scale(u0) * a);
    node.frame.u = spatial(e_.scale(u0) / m * (b - a));
    node.frame.v = glm::dvec3(line_.along.x * step_, rise, line_.along.y * step_) + spatial(growth * a);
    node.frame.taper = spatial(growth / m * (b - a));
    node.frame.height = spatial(glm::normalize(glm::dvec2(a.y - b.y, b.x - a.x)));
    return node;
  }

  double middle(const Loop& loop) const {  // along the axis
    double sum = 0;
    for (const CellId c : loop) sum += line_.local(tree().plan(c)).x;
    return sum / static_cast<double>(loop.size());
  }

  void open_mouth(const Loop& rim) {
    std::vector<glm::dvec2> plan, map;
    for (const CellId c : rim) {
      plan.emplace_back(tree().plan(c));
      map.push_back(map_point(tree().position(c)));
    }
    if (!(doubled_area(map) > 0)) refuse_mouth();
    const Cut hole = cut(model_, Patch{plan, kMargin * cell_}, refusal_);
    edit_.remove(hole);
    edit_.close_ring(border(hole), rim);
  }

  // The border: a rectangle of the root's lattice around the hole. Its cells take over the heights of the
  // ground that stand there, but for those that other heightmaps are sewn to. What lay over the hole is void.
  // Returns the hole's loop with its cells as they are then.
  Loop border(const Cut& hole) {
    glm::dvec2 low(HUGE_VAL), high(-HUGE_VAL);
    for (const CellId c : hole.loop) {
      const glm::dvec2 at = lattice_.samples_to(tree().plan(c));
      low = glm::min(low, at);
      high = glm::max(high, at);
    }
    Node node = new_node(model_, host_, Area::kBorder);
    node.aligned = true;
    node.i0 = static_cast<int>(std::floor(low.x));
    node.j0 = static_cast<int>(std::floor(low.y));
    node.columns = std::min(static_cast<int>(std::ceil(high.x)), lattice_.width - 1) - node.i0 + 1;
    node.rows = std::min(static_cast<int>(std::ceil(high.y)), lattice_.depth - 1) - node.j0 + 1;
    for (const Node& other : borders_) {
      if (node.i0 < other.i0 + other.columns && other.i0 < node.i0 + node.columns &&
          node.j0 < other.j0 + other.rows && other.j0 < node.j0 + node.rows) {
        refusal_.refuse("has two mouths in one place", "make it longer, or its section smaller");
      }
    }
    borders_.push_back(node = edit_.append(node));
    // The links of what lay over the hole lead to empty cells.
    for (const CellId c : hole.superseded) {
      const glm::dvec2 at = glm::round(lattice_.samples_to(tree().plan(c)));
      edit_.relink(c, node.cell(std::clamp(static_cast<int>(at.x) - node.i0, 0, node.columns - 1),
                                std::clamp(static_cast<int>(at.y) - node.j0, 0, node.rows - 1)));
    }
    std::vector<std::pair<CellId, CellId>> taken;  // from, to
    for (int j = 0; j < node.rows; ++j) {
      for (int i = 0; i < node.columns; ++i) {
        const CellId now = tree().at_sample(node.i0 + i, node.j0 + j), next = node.cell(i, j);
        if (!stands_alone({node.i0 + i, node.j0 + j}, now, hole)) continue;
        edit_.tree().set_height(next, tree().height(now));
        edit_.relink(now, next);
        const CellId root = tree().root_cell(node.i0 + i, node.j0 + j);
        if (root != now) edit_.relink(root, next);
        taken.emplace_back(now, next);
      }
    }
    std::sort(taken.begin(), taken.end());
    Loop loop = hole.loop;
    for (CellId& c : loop) {
      const auto at = std::lower_bound(taken.begin(), taken.end(), std::pair(c, CellId{0}));
      if (at != taken.end() && at->first == c) c = at->second;
    }
    return loop;
  }

  // Whether the cell is that of the ground at a sample, outside the hole and a corner of plain squares alone.
  bool stands_alone(Square sample, CellId now, const Cut& hole) const {
    if (tree().kind(now) != CellKind::kHeight) return false;
    if (std::binary_search(hole.superseded.begin(), hole.superseded.end(), now)) return false;
    if (tree().plan(now) != glm::vec2(lattice_.x(sample.i), lattice_.z(sample.j))) return false;
    bool plain = false, sewn = false;
    for (int k = 0; k < 4; ++k) {
      const Square s{sample.i - k % 2, sample.j - k / 2};
      if (s.i < 0 || s.j < 0 || s.i + 1 >= lattice_.width || s.j + 1 >= lattice_.depth) continue;
      plain |= model_.surface.plain(tree(), s);
      model_.surface.over(s, [&](FaceId f) {
        const Face& face = model_.surface.face(f);
        sewn |= std::find(face.begin(), face.end(), now) != face.end() &&
                !std::binary_search(hole.faces.begin(), hole.faces.end(), f);
      });
    }
    return plain && !sewn;
  }

  // An upright lattice across the axis: cells within the section hold the height 0, and a ring joins them to
  // the walls. Where there are too few for that, the walls' last row alone is closed.
  void close_end(const Loop& ring) {
    std::vector<glm::dvec2> outer;
    glm::dvec2 low(HUGE_VAL), high(-HUGE_VAL);
    for (const CellId c : ring) {
      outer.push_back(section_point(tree().position(c)));
      low = glm::min(low, outer.back());
      high = glm::max(high, outer.back());
    }
    const glm::ivec2 steps = glm::max(glm::ivec2(glm::ceil((high - low) / cell_)), glm::ivec2(4));
    const glm::dvec2 pitch = (high - low) / glm::dvec2(steps);
    const glm::dvec2 plan = line_.plan({line_.length, 0});
    Node node = new_node(model_, host_, Area::kIndoor);
    node.columns = steps.x + 1;
    node.rows = steps.y + 1;
    node.frame.origin = glm::dvec3(plan.x, e_.to.y, plan.y) + spatial(low);
    node.frame.u = spatial({pitch.x, 0});
    node.frame.v = spatial({0, pitch.y});
    node.frame.height = {-line_.along.x, 0, -line_.along.y};
    node = edit_.append(node);
    const double margin = 0.4 * std::min(pitch.x, pitch.y);
    for (int j = 0; j < node.rows; ++j) {
      for (int i = 0; i < node.columns; ++i) {
        if (well_within(outer, low + pitch * glm::dvec2(i, j), margin))
          edit_.tree().set_height(node.cell(i, j), 0);
      }
    }
    const std::size_t before = edit_.faces().size();
    edit_.quads(node, false);
    const auto loops = boundary(edit_.faces().subspan(before));
    if (loops && loops->size() == 1 && sew(ring, outer, (*loops)[0])) return;
    edit_.drop_faces(before);
    const auto triangles = triangulate(outer);
    if (!triangles) refusal_.refuse("has an end that cannot be closed", "take a smoother or simpler section");
    for (const Triangle& t : *triangles) edit_.face(ring[t[0]], ring[t[1]], ring[t[2]]);
  }
  glm::dvec2 section_point(glm::vec3 p) const { return {-line_.local({p.x, p.z}).y, p.y - e_.to.y}; }
  bool sew(const Loop& ring, std::span<const glm::dvec2> outer, const Loop& loop) {
    std::vector<glm::dvec2> inner;
    for (const CellId c : loop) inner.push_back(section_point(tree().position(c)));
    const auto triangles = triangulate_ring(outer, inner);
    if (!triangles) return false;
    const auto cell = [&](std::uint32_t k) { return k < ring.size() ? ring[k] : loop[k - ring.size()]; };
    for (const Triangle& t : *triangles) edit_.face(cell(t[0]), cell(t[1]), cell(t[2]));
    return true;
  }

  Model& model_;
  const events::Carving& e_;
  NodeId host_;
  const Refusal& refusal_;
  const Lattice& lattice_;
  events::Line line_;
  double cell_;
  Edit edit_;
  int rows_ = 0;                 // steps between the two points
  double step_ = 0;              // metres along the axis in plan, a row
  double bottom_ = 0, top_ = 0;  // of the section before scaling
  std::vector<int> first_;       // column around the section of each side's first, and their number
  std::vector<int> low_, high_;  // first and last row under ground of each column
  int row0_ = 0, row1_ = 0;
  std::vector<Node> walls_, borders_;
};

}  // namespace

void apply(Model& model, const events::Carving& e, NodeId host, const Refusal& refusal) {
  Bore(model, e, host, refusal);
}

}  // namespace terrabench::ght
