#include "lod/meters/depth_buffer.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <glm/common.hpp>

namespace terrabench {

DepthBuffer::DepthBuffer(const View& view)
    : width_(view.width),
      height_(view.height),
      near_(view.near),
      project_(view),
      nearness_(static_cast<std::size_t>(width_) * height_, 0.0F) {}

void DepthBuffer::draw(const Vertex& a, const Vertex& b, const Vertex& c) {
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

void DepthBuffer::draw(const ScreenPoint& a, const ScreenPoint& b, const ScreenPoint& c) {
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

void DepthBuffer::raise(int x, int y, float nearness) {
  const std::atomic_ref<float> kept(nearness_[static_cast<std::size_t>(y) * width_ + x]);
  float now = kept.load(std::memory_order_relaxed);
  while (nearness > now && !kept.compare_exchange_weak(now, nearness, std::memory_order_relaxed)) {
  }
}

}  // namespace terrabench
