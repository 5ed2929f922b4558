// Which bucket a triangle or a diamond belongs to, and when to ask again.
#include <algorithm>
#include <bit>
#include <cmath>

#include "lod/roam/roam.h"

namespace terrabench {

using roam::Distortion;
using roam::kNone;
using roam::Node;
using roam::Patience;
using roam::Spot;

namespace {

// Where the order counts and no threshold is near, a change by a bucket's width is worth a look.
constexpr double kBucketShare = 1 / (1 + 1.0 / 16);

// As many nodes ahead a list's are fetched.
constexpr std::size_t kAhead = 16;

}  // namespace

std::uint16_t Roam::bucket_of(double ratio) {
  const auto value = static_cast<float>(ratio);
  if (!(value > 0)) return 0;
  const int bucket = static_cast<int>(std::bit_cast<std::uint32_t>(value) >> 19) - kFirst;
  return static_cast<std::uint16_t>(std::clamp(bucket, 0, kBuckets - 1));
}

double Roam::ratio_from(int bucket) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(bucket + kFirst) << 19);
}

Distortion Roam::distortion(const Node& node, const Spot& a, const Spot& b, const Spot& c) const {
  if (!node.visible() || node.thickness == 0) return {};
  return camera_.distortion(a, b, c, node.thickness);
}

Distortion Roam::distortion(std::uint32_t id, const roam::Corners& corners) const {
  const auto [a, b, c] = corners.at;
  return distortion(mesh_.nodes()[id], camera_.spot(a), camera_.spot(b), camera_.spot(c));
}

void Roam::take_off(std::uint32_t id) {
  (mesh_.nodes()[id].leaf() ? splits_ : merges_).remove(mesh_.nodes(), id);
  deadlines_.remove(mesh_.nodes(), id);
}

void Roam::reconsider(std::uint32_t id) {
  const Node& node = mesh_.nodes()[id];
  if (node.leaf()) {
    rank_leaf(id, distortion(id, mesh_.corners(node)));
    return;
  }
  requeue_diamond(id);
  // The other half of one that stands on edge counts for whoever's merge takes it along.
  if (node.base != kNone && mesh_.on_edge(mesh_.nodes()[node.base])) {
    requeue_diamond(mesh_.nodes()[node.base].parent);
  }
}

void Roam::reconsider_due() {
  const std::vector<Node>& nodes = mesh_.nodes();
  for (std::size_t k = 0; k < due_.size(); ++k) {
    if (k + 2 * kAhead < due_.size()) mesh_.prefetch(due_[k + 2 * kAhead]);
    if (k + kAhead < due_.size()) mesh_.prefetch_corners(nodes[due_[k + kAhead]]);
    reconsider(due_[k]);
  }
}

void Roam::reconsider_all() {
  const std::size_t made = first_ ? mesh_.roots() : mesh_.nodes().size();
  for (std::uint32_t id = 0; id < made; ++id) {
    if (mesh_.nodes()[id].in_use) reconsider(id);
  }
}

// A leaf that a split would gain nothing for is in no queue.
void Roam::rank_leaf(std::uint32_t id, const Distortion& now) {
  std::vector<Node>& nodes = mesh_.nodes();
  fresh_.push_back(id);
  deadlines_.remove(nodes, id);
  if (now.pixels == 0) return splits_.remove(nodes, id);
  const double ratio = now.pixels / options_.max_error;
  if (const std::uint16_t bucket = bucket_of(ratio); bucket != nodes[id].bucket) {
    splits_.remove(nodes, id);
    splits_.push(nodes, id, bucket);
  }
  // From below the reference it must be looked at before it can have risen to it.
  const double share = ratio / ratio_from(reference_);
  nodes[id].patience = patience(now, share < 1 ? share : kBucketShare);
}

// Until the error can have changed to or from a share of it.
Patience Roam::patience(const Distortion& now, double share) {
  return {static_cast<float>(0.9999 * (1 - share) * now.scale), static_cast<float>(1.0001 * now.reach)};
}

// Most triangles that a frame makes are split on in the same frame, so only what is left at its end is drawn
// and made to wait.
void Roam::place_fresh() {
  std::vector<Node>& nodes = mesh_.nodes();
  for (std::size_t k = fresh_.size(); k-- > 0;) {
    if (k >= kAhead) mesh_.prefetch(fresh_[k - kAhead]);
    const std::uint32_t id = fresh_[k];
    const Node& node = nodes[id];
    if (!node.in_use || !node.leaf()) continue;
    show(id);
    if (node.bucket == roam::kNoList || node.due != roam::kNoList) continue;
    deadlines_.put_off(nodes, id, node.patience);
  }
  fresh_.clear();
}

// Puts a diamond, by its name, into the merge queue, by the larger error of its halves.
void Roam::rank_diamond(std::uint32_t id) {
  Distortion now;
  const auto include = [&](std::uint32_t part) {
    const Distortion other = distortion(part, mesh_.corners(mesh_.nodes()[part]));
    if (other.pixels > now.pixels) now = other;
  };
  for (const std::uint32_t half : halves(id)) {
    if (half == kNone) continue;
    include(half);
    // What its merge takes along: see merge().
    for (const std::uint32_t child : {mesh_.nodes()[half].child, mesh_.nodes()[half].child + 1}) {
      const Node& node = mesh_.nodes()[child];
      if (!node.leaf() && node.base != kNone) include(node.base);
    }
  }
  const double ratio = now.pixels / options_.max_error;
  merges_.push(mesh_.nodes(), id, bucket_of(ratio));
  if (now.pixels == 0) return;  // until its sight changes
  deadlines_.put_off(mesh_.nodes(), id,
                     patience(now, std::min(ratio_from(reference_) / ratio, kBucketShare)));
}

// Most diamonds that a frame makes are split on in the same frame, so they are queued when it comes to
// merging only.
void Roam::rank_pending() {
  const std::vector<Node>& nodes = mesh_.nodes();
  for (std::size_t k = 0; k < pending_.size(); ++k) {
    if (k + 2 * kAhead < pending_.size()) mesh_.prefetch(pending_[k + 2 * kAhead]);
    if (k + kAhead < pending_.size()) mesh_.prefetch(nodes[pending_[k + kAhead]].base);
    const std::uint32_t id = pending_[k];
    const Node& node = nodes[id];
    if (node.in_use && !node.leaf()) requeue_diamond(id);
  }
  pending_.clear();
}

// A diamond goes by the lower number of its halves.
std::uint32_t Roam::diamond(std::uint32_t id) const {
  const std::uint32_t base = mesh_.nodes()[id].base;
  return base == kNone ? id : std::min(id, base);
}

bool Roam::mergeable(std::uint32_t id) const {
  for (const std::uint32_t half : halves(id)) {
    if (half == kNone) continue;
    const Node& node = mesh_.nodes()[half];
    if (node.split_children > 0 || mesh_.on_edge(node)) return false;
  }
  return true;
}

// Puts the diamond of a triangle that is split where it belongs now: into the merge queue or out of it.
void Roam::requeue_diamond(std::uint32_t id) {
  if (id == kNone) return;
  const std::uint32_t name = diamond(id);
  take_off(name);
  if (mergeable(name)) rank_diamond(name);
}

}  // namespace terrabench
