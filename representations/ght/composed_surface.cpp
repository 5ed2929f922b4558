#include "representations/ght/composed_surface.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "representations/ght/triangulate.h"

namespace terrabench::ght {
namespace {

// The share of the way from low to high. Positions are floats: one within rounding of a sample is on it.
double share(float position, float low, float high) {
  const float slip = position * 0x1p-22F;
  if (position - low <= slip) return 0;
  if (high - position <= slip) return 1;
  return (static_cast<double>(position) - low) / (static_cast<double>(high) - low);
}

// On which side of the edge a → b the point lies: +1 left, -1 right, 0 only for an edge without length in
// plan. A point on the edge is taken as moved east by an infinitely small step and south by a smaller one, so
// that exactly one of the faces around an edge or corner contains it. Both faces at an edge get the same
// side.
int side(glm::vec3 a, glm::vec3 b, double x, double z) {
  const bool swap = a.x > b.x || (a.x == b.x && a.z > b.z);
  if (swap) std::swap(a, b);
  const double ex = static_cast<double>(b.x) - a.x, ez = static_cast<double>(b.z) - a.z;
  const double turn = ez * (x - a.x) - ex * (z - a.z);
  int sign = turn > 0 ? 1 : turn < 0 ? -1 : 0;
  if (sign == 0) sign = ez > 0 ? 1 : ez < 0 ? -1 : ex > 0 ? -1 : ex < 0 ? 1 : 0;
  return swap ? -sign : sign;
}

// Height of the triangle's plane at a point in it, limited to the heights of its corners for thin triangles.
float height_at(const std::array<glm::vec3, 3>& p, double x, double z) {
  const glm::dvec2 at{x, -z}, a = map_point(p[0]), b = map_point(p[1]), c = map_point(p[2]);
  const double area = turn(a, b, c);
  if (area == 0) return p[0].y;
  const double y = (turn(at, b, c) * p[0].y + turn(a, at, c) * p[1].y + turn(a, b, at) * p[2].y) / area;
  const auto [low, high] = std::minmax({p[0].y, p[1].y, p[2].y});
  return static_cast<float>(std::clamp(y, static_cast<double>(low), static_cast<double>(high)));
}

PlanBounds bounds_of(const Tree& tree, const Face& face) {
  PlanBounds box;
  for (const CellId c : face) box.add(tree.plan(c));
  return box;
}

}  // namespace

ComposedSurface::ComposedSurface(const SampleGrid& grid)
    : grid_(grid),
      per_x_(1.0 / grid.spacing_x),
      per_z_(1.0 / grid.spacing_z),
      tiles_x_((static_cast<std::size_t>(std::max(grid.width - 1, 1)) + kSide - 1) / kSide) {
  const std::size_t tiles_z = (static_cast<std::size_t>(std::max(grid.depth - 1, 1)) + kSide - 1) / kSide;
  tile_of_.assign(tiles_x_ * tiles_z, kNone);
}

bool ComposedSurface::find(float x, float z, Square& at) const {
  const int last_i = grid_.width - 2, last_j = grid_.depth - 2;
  if (last_i < 0 || last_j < 0 ||
      !(x >= grid_.x(0) && z >= grid_.z(0) && x <= grid_.x(last_i + 1) && z <= grid_.z(last_j + 1))) {
    return false;
  }
  int i = std::min(static_cast<int>((x - grid_.origin_x) * per_x_), last_i),
      j = std::min(static_cast<int>((z - grid_.origin_z) * per_z_), last_j);
  // The quotient may be off by rounding: compare with the exact samples.
  if (i > 0 && x < grid_.x(i)) --i;
  if (i < last_i && x >= grid_.x(i + 1)) ++i;
  if (j > 0 && z < grid_.z(j)) --j;
  if (j < last_j && z >= grid_.z(j + 1)) ++j;
  at = {i, j};
  return true;
}

bool ComposedSurface::hole(const Tree& tree, Square s) {
  if (!tree.has_holes()) return false;
  for (int k = 0; k < 4; ++k) {
    if (tree.kind(tree.root_cell(s.i + k % 2, s.j + k / 2)) == CellKind::kVoid) return true;
  }
  return false;
}

std::array<CellId, 4> ComposedSurface::corners(const Tree& tree, Square s) {
  return {tree.at_sample(s.i, s.j), tree.at_sample(s.i, s.j + 1), tree.at_sample(s.i + 1, s.j + 1),
          tree.at_sample(s.i + 1, s.j)};
}

std::vector<CellId> ComposedSurface::cells_at(const Tree& tree, std::span<const Square> squares,
                                              std::span<const FaceId> faces) const {
  std::vector<CellId> cells;
  for (const Square s : squares) {
    const auto at = corners(tree, s);
    cells.insert(cells.end(), at.begin(), at.end());
  }
  for (const FaceId f : faces) cells.insert(cells.end(), faces_[f].begin(), faces_[f].end());
  sort_unique(cells);
  return cells;
}

SquareRange ComposedSurface::range(glm::dvec2 low, glm::dvec2 high) const {
  const auto clip = [](double at, int squares) {
    return static_cast<int>(std::clamp(at, 0.0, static_cast<double>(std::max(squares - 1, 0))));
  };
  // Slightly wider, because the quotients are rounded.
  constexpr double kSlip = 1e-5;
  const glm::dvec2 first = grid_.samples_to(low), last = grid_.samples_to(high);
  return {clip(first.x - kSlip, grid_.width - 1), clip(first.y - kSlip, grid_.depth - 1),
          clip(last.x + kSlip, grid_.width - 1), clip(last.y + kSlip, grid_.depth - 1)};
}

SquareRange ComposedSurface::range(const Tree& tree, const Face& face) const {
  const PlanBounds box = bounds_of(tree, face);
  return range(box.low, box.high);
}

// One step wider than the face on each side, which is more than rounding amounts to.
std::uint32_t ComposedSurface::box_in(Square s, const PlanBounds& face) const {
  const auto step = [](double at, double wider) {
    return static_cast<std::uint32_t>(std::clamp(std::floor(at * kBoxSteps) + wider, 0.0, kBoxSteps - 1));
  };
  const glm::dvec2 at(s.i, s.j), low = grid_.samples_to(face.low) - at,
                                 high = grid_.samples_to(face.high) - at;
  return step(low.x, -1) | step(high.x, 1) << 8U | step(low.y, -1) << 16U | step(high.y, 1) << 24U;
}

float ComposedSurface::plain_height(const Tree& tree, float x, float z, Square s) {
  const SampleGrid& grid = tree.grid();
  const double u = share(x, grid.x(s.i), grid.x(s.i + 1)), v = share(z, grid.z(s.j), grid.z(s.j + 1));
  const auto height = [&](int i, int j) -> double { return tree.height(tree.at_sample(i, j)); };
  const double ne = height(s.i + 1, s.j), sw = height(s.i, s.j + 1);
  return static_cast<float>(u + v <= 1
                                ? (1 - u - v) * height(s.i, s.j) + u * ne + v * sw
                                : (u + v - 1) * height(s.i + 1, s.j + 1) + (1 - v) * ne + (1 - u) * sw);
}

void ComposedSurface::prefetch(Square s, int step) const {
  const std::uint32_t& tile = tile_of_[tile_index(s)];
  if (step == 0) return __builtin_prefetch(&tile);
  if (tile == kNone) return;
  const std::uint32_t& first = tiles_[tile].first[slot(s)];
  if (step == 1) return __builtin_prefetch(&first);
  if (first != kNone) __builtin_prefetch(&entries_[first]);
}

void ComposedSurface::crossings(const Tree& tree, float x, float z, Square s,
                                std::vector<Crossing>& out) const {
  if (plain(tree, s)) out.push_back({plain_height(tree, x, z, s), 1});
  const std::uint32_t tile = tile_of_[tile_index(s)];
  if (tile == kNone) return;
  const auto step = [](double at) {
    return static_cast<std::uint32_t>(std::clamp(at * kBoxSteps, 0.0, kBoxSteps - 1));
  };
  const std::uint32_t i = step((x - grid_.origin_x) * per_x_ - s.i),
                      j = step((z - grid_.origin_z) * per_z_ - s.j);
  for (std::uint32_t e = tiles_[tile].first[slot(s)]; e != kNone; e = entries_[e].next) {
    const std::uint32_t box = entries_[e].box;
    if (i < (box & 255U) || i > (box >> 8U & 255U) || j < (box >> 16U & 255U) || j > box >> 24U) continue;
    const Face& face = faces_[entries_[e].face];
    std::array<glm::vec3, 3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = tree.position(face[k]);
    const int turn = side(p[0], p[1], x, z);
    if (turn == 0 || side(p[1], p[2], x, z) != turn || side(p[2], p[0], x, z) != turn) continue;
    out.push_back({height_at(p, x, z), turn});
  }
}

float ComposedSurface::top(const Tree& tree, glm::dvec2 plan) const {
  Square s;
  const auto x = static_cast<float>(plan.x), z = static_cast<float>(plan.y);
  if (!find(x, z, s)) return Heightfield::kNoData;
  if (plain(tree, s)) return plain_height(tree, x, z, s);
  thread_local std::vector<Crossing> crossed;
  crossed.clear();
  crossings(tree, x, z, s, crossed);
  float top = Heightfield::kNoData;
  for (const Crossing& c : crossed) top = std::fmax(top, c.y);
  return top;
}

void ComposedSurface::prepare(const Tree& tree, std::span<const Square> covered,
                              std::span<const Face> added) {
  std::size_t entries = entry_count_;
  std::vector<std::size_t> tiles;
  const auto touch = [&](const SquareRange& r) {
    r.tiles(kSide).each([&](Square at) {
      const std::size_t t = static_cast<std::size_t>(at.j) * tiles_x_ + static_cast<std::size_t>(at.i);
      if (tile_of_[t] == kNone && (tiles.empty() || tiles.back() != t)) tiles.push_back(t);
    });
  };
  for (const Square s : covered) touch({s.i, s.j, s.i, s.j});
  for (const Face& face : added) {
    const SquareRange r = range(tree, face);
    entries += r.count();
    touch(r);
  }
  std::sort(tiles.begin(), tiles.end());
  tiles.erase(std::unique(tiles.begin(), tiles.end()), tiles.end());
  grow(tiles_, tiles_.size() + tiles.size());
  grow(faces_, face_count_ + added.size());
  grow(entries_, entries);
}

ComposedSurface::Tile& ComposedSurface::tile(Square s) noexcept {
  std::uint32_t& tile = tile_of_[tile_index(s)];
  if (tile == kNone) {
    tile = static_cast<std::uint32_t>(tiles_.size());
    tiles_.emplace_back();
  }
  return tiles_[tile];
}

void ComposedSurface::set_covered(Square s, bool covered) noexcept {
  if (!covered && tile_of_[tile_index(s)] == kNone) return;
  std::uint64_t& word = tile(s).covered[slot(s) / 64];
  const std::uint64_t bit = std::uint64_t{1} << slot(s) % 64;
  word = covered ? word | bit : word & ~bit;
}

FaceId ComposedSurface::number(const Face& face) noexcept {
  FaceId f = free_face_;
  if (f == kNone) {
    f = static_cast<FaceId>(faces_.size());
    faces_.push_back(face);
  } else {
    free_face_ = faces_[f][1];
    faces_[f] = face;
  }
  ++face_count_;
  return f;
}

void ComposedSurface::enter(Square s, FaceId face, std::uint32_t box) noexcept {
  std::uint32_t e = free_entry_;
  if (e == kNone) {
    e = static_cast<std::uint32_t>(entries_.size());
    entries_.push_back({});
  } else {
    free_entry_ = entries_[e].next;
  }
  std::uint32_t& first = tile(s).first[slot(s)];
  entries_[e] = {face, first, box};
  first = e;
  ++entry_count_;
}

std::vector<ComposedSurface::Placed> ComposedSurface::place(const Tree& tree,
                                                            std::span<const Face> faces) const {
  std::vector<Placed> placed;
  for (std::uint32_t k = 0; k < faces.size(); ++k) {
    const PlanBounds box = bounds_of(tree, faces[k]);
    range(box.low, box.high).each([&](Square s) { placed.push_back({s, k, box_in(s, box)}); });
  }
  std::sort(placed.begin(), placed.end(), [](const Placed& a, const Placed& b) {
    return a.square != b.square ? a.square < b.square : a.face < b.face;
  });
  return placed;
}

void ComposedSurface::add(std::span<const Face> faces, std::span<const Placed> placed,
                          std::span<FaceId> ids) noexcept {
  for (std::size_t k = 0; k < faces.size(); ++k) ids[k] = number(faces[k]);
  for (const Placed& p : placed) enter(p.square, ids[p.face], p.box);
}

void ComposedSurface::remove(const Tree& tree, FaceId f) noexcept {
  range(tree, faces_[f]).each([&](Square s) {
    std::uint32_t* link = &tile(s).first[slot(s)];
    while (entries_[*link].face != f) link = &entries_[*link].next;
    const std::uint32_t e = *link;
    *link = entries_[e].next;
    entries_[e].next = free_entry_;
    free_entry_ = e;
    --entry_count_;
  });
  faces_[f] = {kNone, free_face_, kNone};
  free_face_ = f;
  --face_count_;
}

Memory ComposedSurface::memory() const {
  Memory memory = index_memory(tile_of_, tiles_);
  memory += payload_memory(faces_);
  memory += index_memory(entries_);
  return memory;
}

}  // namespace terrabench::ght
