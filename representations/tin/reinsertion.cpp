#include "representations/tin/reinsertion.h"

#include <algorithm>
#include <cmath>

#include "terrain/tin/triangle_plane.h"

namespace terrabench::tin {

void HeightWindow::cover(Sample low, Sample high) {
  if (covers(low) && covers(high)) return;
  const bool first = heights_.empty();
  const auto grown = [&](int from, int side, int low_at, int high_at) {  // first and last
    if (first) return std::pair(low_at, high_at);
    const int more = side / 2;
    return std::pair(
        low_at < from ? std::max(0, std::min(low_at, from - more)) : from,
        high_at >= from + side ? std::min(0xFFFF, std::max(high_at, from + side + more)) : from + side - 1);
  };
  const auto [west, east] = grown(low_.i, width_, low.i, high.i);
  const auto [north, south] = grown(low_.j, depth_, low.j, high.j);
  HeightWindow larger;
  larger.low_ = {static_cast<std::uint16_t>(west), static_cast<std::uint16_t>(north)};
  larger.width_ = east - west + 1;
  larger.depth_ = south - north + 1;
  const std::size_t samples = static_cast<std::size_t>(larger.width_) * larger.depth_;
  require_memory(samples * sizeof(float), "edit");
  larger.heights_.assign(samples, kUnknown);
  for (int j = 0; j < depth_; ++j) {
    const auto row = heights_.begin() + std::ptrdiff_t{j} * width_;
    std::copy(row, row + width_,
              larger.heights_.begin() + static_cast<std::ptrdiff_t>(
                                            larger.index({low_.i, static_cast<std::uint16_t>(low_.j + j)})));
  }
  *this = std::move(larger);
}

// The rounding is that of build(); it also bounds what two evaluations of one plane differ by.
Reinsertion::Reinsertion(Approximation& ground, Locator& locator, int width, int depth, float largest_error,
                         float highest)
    : surface_(ground.surface),
      heights_(ground.heights),
      holes_(ground.holes),
      locator_(locator),
      width_(width),
      depth_(depth) {
  const float rounding = kScanRounding * highest;
  limit_ = std::max(largest_error - rounding, rounding);
}

float& Reinsertion::known(Sample s) {
  if (!window_.knows(s)) {
    near_ = changing_ ? surface_.locate(s, near_) : locator_.find(surface_, s);
    keep(near_);  // no sample of a changed triangle is unknown
  }
  return window_.at(s);
}

void Reinsertion::set(Sample s, float height) {
  known(s) = height;
  set_.push_back(s);
}

void Reinsertion::keep(std::uint32_t triangle) {
  if (!kept_.insert(triangle).second) return;
  const Triangle& t = surface_.triangles()[triangle];
  const std::array<Sample, 3> p = surface_.corners(t);
  const std::array<float, 3> h = corner_heights(t, heights_);
  const auto [west, east] = std::minmax({p[0].i, p[1].i, p[2].i});
  const auto [north, south] = std::minmax({p[0].j, p[1].j, p[2].j});
  window_.cover({west, north}, {east, south});
  const auto put = [&](Sample s, float height) {
    if (!window_.knows(s)) window_.at(s) = height;
  };
  for (std::size_t k = 0; k < 3; ++k) put(p[k], h[k]);
  const bool hole = is_hole(triangle);
  const Plane plane(p, h);
  const Rows rows(p);
  for (int j = rows.first(); j <= rows.last(); ++j) {
    const auto [first, last] = rows.columns(j);
    for (int i = first; i <= last; ++i) {
      put({static_cast<std::uint16_t>(i), static_cast<std::uint16_t>(j)},
          hole ? Heightfield::kNoData : static_cast<float>(plane(i, j)));
    }
  }
}

bool Reinsertion::finish() {
  if (set_.empty()) return false;
  std::ranges::sort(set_, before);
  set_.erase(std::unique(set_.begin(), set_.end()), set_.end());
  changing_ = true;
  near_ = locator_.find(surface_, set_[0]);
  for (const Sample s : set_) {
    around(s, [&](Sample beside) { take_out(beside, beside == s); });
  }
  const bool holes =
      !holes_.empty() || std::ranges::any_of(set_, [&](Sample s) { return std::isnan(window_.at(s)); });
  if (holes) {
    holes_.resize(surface_.triangles().size(), 0);
    for (const Sample s : set_) {
      around(s, [&](Sample beside) {
        if (on_rim(beside)) insert(beside);
      });
    }
  }
  for (scan_changed(); !due_.empty(); scan_changed()) {
    const auto [candidate, triangle] = due_.top();
    due_.pop();
    const Candidate& now = candidates_.at(triangle);
    if (now.at != candidate.at || now.error != candidate.error) continue;
    near_ = triangle;
    insert(candidate.at);
  }
  compact();
  return true;
}

// The sample itself and those beside it, along diagonals too.
template <class Visit>
void Reinsertion::around(Sample s, const Visit& visit) const {
  for (int j = std::max(0, s.j - 1); j <= std::min(depth_ - 1, s.j + 1); ++j) {
    for (int i = std::max(0, s.i - 1); i <= std::min(width_ - 1, s.i + 1); ++i)
      visit(Sample{static_cast<std::uint16_t>(i), static_cast<std::uint16_t>(j)});
  }
}

// A vertex at the sample, unless it is a corner of the rectangle.
void Reinsertion::take_out(Sample s, bool changed) {
  locate(s);
  const std::uint32_t vertex = surface_.vertex_at(s, near_);
  if (vertex == Delaunay::kNone) {
    // One triangle that holds the sample is enough, since another one has it on their common edge.
    if (changed) {
      keep(near_);
      changed_.push_back(near_);
    }
    return;
  }
  const bool corner = (s.i == 0 || s.i == width_ - 1) && (s.j == 0 || s.j == depth_ - 1);
  if (corner && !changed) return;
  std::vector<std::uint32_t> star;
  surface_.append_star(vertex, near_, star);
  for (const std::uint32_t t : star) keep(t);
  if (corner) {
    heights_[vertex] = window_.at(s);
    changed_.insert(changed_.end(), star.begin(), star.end());
    return;
  }
  const std::size_t before = changed_.size();
  surface_.remove(vertex, near_, changed_);
  changed_since(before);
}

// Their samples are those of triangles that were kept.
void Reinsertion::changed_since(std::size_t before) {
  kept_.insert(changed_.begin() + static_cast<std::ptrdiff_t>(before), changed_.end());
  near_ = changed_.back();
}

bool Reinsertion::no_data(int i, int j) {
  return std::isnan(known({static_cast<std::uint16_t>(i), static_cast<std::uint16_t>(j)}));
}

// As greedy_insertion(): with data, and in a square of samples without.
bool Reinsertion::on_rim(Sample s) {
  if (no_data(s.i, s.j)) return false;
  bool found = false;
  around(s, [&](Sample beside) { found = found || no_data(beside.i, beside.j); });
  return found;
}

// Whether the square of samples under the middle has data; no edge crosses a rim.
bool Reinsertion::solid(const Triangle& t) {
  if (holes_.empty()) return true;
  int i = 0, j = 0;
  for (const Sample s : surface_.corners(t)) {
    i += s.i;
    j += s.j;
  }
  i = std::min(i / 3, width_ - 2);
  j = std::min(j / 3, depth_ - 2);
  return !no_data(i, j) && !no_data(i + 1, j) && !no_data(i, j + 1) && !no_data(i + 1, j + 1);
}

void Reinsertion::insert(Sample s) {
  locate(s);
  if (surface_.vertex_at(s, near_) != Delaunay::kNone) return;
  std::vector<std::uint32_t> conflicts;
  surface_.append_conflicts(s, near_, conflicts);
  for (const std::uint32_t t : conflicts) keep(t);
  surface_.make_room();
  const std::size_t before = changed_.size();
  const std::uint32_t vertex = surface_.insert(s, near_, changed_);
  changed_since(before);
  if (vertex == heights_.size()) {
    if (heights_.size() == heights_.capacity()) heights_.reserve(surface_.vertices().capacity());
    heights_.push_back(window_.at(s));
  } else {
    heights_[vertex] = window_.at(s);
  }
}

void Reinsertion::scan_changed() {
  std::ranges::sort(changed_);
  changed_.erase(std::unique(changed_.begin(), changed_.end()), changed_.end());
  if (!holes_.empty()) holes_.resize(surface_.triangles().size());
  for (const std::uint32_t at : changed_) {
    if (!surface_.in_use(at)) continue;
    surface_.rotate(at);  // so that a saved copy has the same planes to the bit
    const Triangle& t = surface_.triangles()[at];
    const bool ground = solid(t);
    if (!holes_.empty()) holes_[at] = ground ? 0 : 1;
    const Candidate worst =
        ground ? worst_sample(surface_.corners(t), corner_heights(t, heights_), window_.view()) : Candidate{};
    candidates_[at] = worst;
    if (worst.error > limit_) due_.push({worst, at});
  }
  changed_.clear();
}

void Reinsertion::compact() {
  std::vector<std::uint32_t> touched;
  for (const auto& [triangle, candidate] : candidates_) touched.push_back(triangle);
  for (const auto& [from, to] : surface_.compact_triangles()) {
    if (!holes_.empty()) holes_[to] = holes_[from];
    touched.push_back(to);
  }
  if (!holes_.empty()) holes_.resize(surface_.triangles().size());
  std::erase_if(touched, [&](std::uint32_t t) { return t >= surface_.triangles().size(); });
  std::ranges::sort(touched);
  locator_.update(surface_, touched, width_, depth_);
  const auto find = [&](Sample s) { return locator_.find(surface_, s); };
  for (const auto& [from, to] : surface_.compact_vertices(find)) heights_[to] = heights_[from];
  heights_.resize(surface_.vertices().size());
}

}  // namespace terrabench::tin
