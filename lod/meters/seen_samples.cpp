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

#include "lod/meters/depth_buffer.h"
#include "terrain/frustum.h"

namespace terrabench {
namespace {

constexpr int kBlock = 32;  // cells along the side of what is culled at once

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
