#include "lod/meters/seen_samples.h"

#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <utility>

#include "terrain/frustum.h"

namespace terrabench {
namespace {

constexpr int kBlock = 32;  // cells along the side of what is culled at once

// Keeps for every pixel centre the inverse of the least depth, which is linear on the screen; 0 is the sky.
class DepthBuffer {
 public:
  explicit DepthBuffer(const View& view)
      : width_(view.width),
        height_(view.height),
        near_(view.near),
        project_(view),
        nearness_(static_cast<std::size_t>(width_) * height_, 0.0F) {}

  struct Vertex {
    glm::dvec3 place;
    ScreenPoint screen;
  };
  Vertex vertex(const glm::dvec3& place) const { return {place, project_(place)}; }

  void draw(const Vertex& a, const Vertex& b, const Vertex& c) {
    const int before = (a.screen.depth < near_) + (b.screen.depth < near_) + (c.screen.depth < near_);
    if (before == 3) return;
    if (before == 0) return draw(a.screen, b.screen, c.screen);
    // Cut at the near plane: three or four corners are left.
    const std::array<const Vertex*, 3> corners = {&a, &b, &c};
    std::array<ScreenPoint, 4> cut;
    std::size_t n = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vertex &p = *corners[k], &q = *corners[(k + 1) % 3];
      const double at_p = p.screen.depth - near_, at_q = q.screen.depth - near_;
      if (at_p >= 0) cut[n++] = p.screen;
      if ((at_p < 0) != (at_q < 0)) cut[n++] = project_(glm::mix(p.place, q.place, at_p / (at_p - at_q)));
    }
    for (std::size_t k = 2; k < n; ++k) draw(cut[0], cut[k - 1], cut[k]);
  }

  std::vector<float> take() { return std::move(nearness_); }

 private:
  void draw(const ScreenPoint& a, const ScreenPoint& b, const ScreenPoint& c) {
    // Clamped before the conversion: beside a near plane a triangle may reach any number of pixels.
    const auto first = [](double low, int size) {
      return static_cast<int>(std::ceil(std::clamp<double>(low - 0.5, 0, size)));
    };
    const auto last = [](double high, int size) {
      return static_cast<int>(std::floor(std::clamp(high - 0.5, -1.0, size - 1.0)));
    };
    const int x0 = first(std::min({a.x, b.x, c.x}), width_), x1 = last(std::max({a.x, b.x, c.x}), width_);
    const int y0 = first(std::min({a.y, b.y, c.y}), height_), y1 = last(std::max({a.y, b.y, c.y}), height_);
    if (x0 > x1 || y0 > y1) return;
    const double area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
    if (area == 0) return;
    // A hair over the edge counts, so that rounding opens no gap between neighbours.
    constexpr double kHair = -1e-9;
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) {
        const double px = x + 0.5, py = y + 0.5;
        const double v = ((px - a.x) * (c.y - a.y) - (c.x - a.x) * (py - a.y)) / area;
        const double w = ((b.x - a.x) * (py - a.y) - (px - a.x) * (b.y - a.y)) / area;
        const double u = 1 - v - w;
        if (u < kHair || v < kHair || w < kHair) continue;
        raise(x, y, static_cast<float>(u / a.depth + v / b.depth + w / c.depth));
      }
    }
  }

  void raise(int x, int y, float nearness) {
    const std::atomic_ref<float> kept(nearness_[static_cast<std::size_t>(y) * width_ + x]);
    float now = kept.load(std::memory_order_relaxed);
    while (nearness > now && !kept.compare_exchange_weak(now, nearness, std::memory_order_relaxed)) {
    }
  }

  int width_, height_;
  double near_;
  Projector project_;
  std::vector<float> nearness_;
};

glm::dvec3 place(const Heightfield& ground, int i, int j) {
  return {static_cast<float>(i) * ground.cell_x, ground.at(i, j), static_cast<float>(j) * ground.cell_z};
}

// Cells [i0, i1) × [j0, j1).
Bounds box_of(const Heightfield& ground, int i0, int i1, int j0, int j1) {
  Bounds box{place(ground, i0, j0), place(ground, i1, j1)};
  box.low.y = box.high.y = ground.at(i0, j0);
  for (int j = j0; j <= j1; ++j) {
    for (int i = i0; i <= i1; ++i) {
      box.low.y = std::min(box.low.y, ground.at(i, j));
      box.high.y = std::max(box.high.y, ground.at(i, j));
    }
  }
  return box;
}

void draw_cells(const Heightfield& ground, int i0, int i1, int j0, int j1, DepthBuffer& buffer) {
  std::array<std::array<DepthBuffer::Vertex, kBlock + 1>, 2> rows;
  for (int j = j0; j <= j1; ++j) {
    auto &above = rows[static_cast<std::size_t>(j % 2)], &here = rows[static_cast<std::size_t>((j + 1) % 2)];
    for (int i = i0; i <= i1; ++i)
      here[static_cast<std::size_t>(i - i0)] = buffer.vertex(place(ground, i, j));
    for (std::size_t k = 0; j > j0 && k < static_cast<std::size_t>(i1 - i0); ++k) {
      buffer.draw(above[k], here[k], above[k + 1]);
      buffer.draw(above[k + 1], here[k], here[k + 1]);
    }
  }
}

}  // namespace

std::size_t SeenSamples::bytes(int width, int depth) {
  return sizeof(std::uint64_t) * static_cast<std::size_t>((width + kSeenAWord - 1) / kSeenAWord) *
         static_cast<std::size_t>(depth);
}

SeenSamples::SeenSamples(const Heightfield& ground, const View& view)
    : width_(ground.width),
      depth_(ground.depth),
      cell_x_(ground.cell_x),
      cell_z_(ground.cell_z),
      view_(view),
      words_(static_cast<std::size_t>((ground.width + kSeenAWord - 1) / kSeenAWord)),
      seen_(words_ * static_cast<std::size_t>(ground.depth), 0) {
  DepthBuffer buffer(view);
  const Frustum frustum(view);
  const auto blocks = [](int samples) { return (samples - 2) / kBlock + 1; };
  tbb::parallel_for(tbb::blocked_range2d<int>(0, blocks(depth_), 0, blocks(width_)), [&](const auto& range) {
    for (int bj = range.rows().begin(); bj < range.rows().end(); ++bj) {
      for (int bi = range.cols().begin(); bi < range.cols().end(); ++bi) {
        const int i0 = bi * kBlock, i1 = std::min(i0 + kBlock, width_ - 1);
        const int j0 = bj * kBlock, j1 = std::min(j0 + kBlock, depth_ - 1);
        if (frustum.see(box_of(ground, i0, i1, j0, j1)) == Sight::kOutside) continue;
        draw_cells(ground, i0, i1, j0, j1, buffer);
      }
    }
  });
  find_seen(ground, buffer.take());
}

void SeenSamples::find_seen(const Heightfield& ground, const std::vector<float>& nearness) {
  // As deep as it takes four pixels side by side: what differs in depth within a pixel does not hide.
  constexpr double kSlackPixels = 4;
  const Projector project(view_);
  const double nearer = 1 - kSlackPixels / project.focal();
  const auto is_hidden = [&](const ScreenPoint& at) {
    const int x = std::min(static_cast<int>(at.x), view_.width - 1);
    const int y = std::min(static_cast<int>(at.y), view_.height - 1);
    float farthest = std::numeric_limits<float>::infinity();
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, view_.height - 1); ++v) {
      for (int u = std::max(x - 1, 0); u <= std::min(x + 1, view_.width - 1); ++u) {
        farthest = std::min(farthest, nearness[static_cast<std::size_t>(v) * view_.width + u]);
      }
    }
    return nearer > 0 && 1 / (at.depth * nearer) < static_cast<double>(farthest);
  };
  static_assert(static_cast<int>(Seen::kOutside) == 0);  // what the bits are at first
  tbb::parallel_for(0, depth_, [&](int j) {
    std::uint64_t* const row = &seen_[static_cast<std::size_t>(j) * words_];
    for (int i = 0; i < width_; ++i) {
      const ScreenPoint at = project(place(ground, i, j));
      if (!project.in_view(at)) continue;
      const Seen seen = is_hidden(at) ? Seen::kHidden : Seen::kVisible;
      row[i / kSeenAWord] |= static_cast<std::uint64_t>(seen) << (2 * (i % kSeenAWord));
    }
  });
}

}  // namespace terrabench
