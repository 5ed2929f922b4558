// The two queues of the least-cost search (flow.h). Both give the pixel of the lowest key, of equal keys the
// one that waited longest; both find the lowest of their buckets by a bit set of bit sets, in constant time,
// because heights in pits put lower keys back behind the search.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace terrabench::hydrology {

// Which of up to 2^24 buckets hold something. Four levels of 64 bits a word.
class BucketSet {
 public:
  explicit BucketSet(std::size_t buckets) {
    std::size_t bits = buckets;
    for (auto& level : levels_) {
      bits = (bits + 63) / 64;
      level.assign(bits, 0);
    }
    assert(levels_.back().size() == 1);
  }
  void insert(std::uint32_t bucket) {
    for (auto& level : levels_) {
      level[bucket / 64] |= std::uint64_t{1} << (bucket % 64);
      bucket /= 64;
    }
  }
  void erase(std::uint32_t bucket) {
    for (auto& level : levels_) {
      level[bucket / 64] &= ~(std::uint64_t{1} << (bucket % 64));
      if (level[bucket / 64] != 0) return;
      bucket /= 64;
    }
  }
  bool empty() const { return levels_.back()[0] == 0; }
  std::uint32_t lowest() const {
    std::uint32_t word = 0;
    for (std::size_t k = levels_.size(); k-- > 0;) {
      word = word * 64 + static_cast<std::uint32_t>(std::countr_zero(levels_[k][word]));
    }
    return word;
  }

 private:
  std::array<std::vector<std::uint64_t>, 4> levels_;
};

// One first-in-first-out bucket a key, for whole numbers. Buckets are chains of blocks from one pool, so that
// a bucket's pixels lie together and the ones to come can be fetched into the cache ahead of their turn.
// O(1) a pixel.
class BucketQueue {
 public:
  explicit BucketQueue(std::uint32_t keys) : buckets_(keys), filled_(keys) {}

  bool empty() const { return current_ == kNone && filled_.empty(); }

  void push(std::uint32_t key, std::uint32_t pixel) {
    Bucket& bucket = buckets_[key];
    if (slot(bucket.tail) == kSlots) grow(key, bucket);
    pool_[block(bucket.tail)].pixels[slot(bucket.tail)] = pixel;
    ++bucket.tail;
    if (key < current_) current_ = kNone;  // also when there is none
  }

  // `fetch` is called with pixels whose turn comes soon; some of them may be wrong.
  template <class Fetch>
  std::uint32_t pop(const Fetch& fetch) {
    if (current_ == kNone) {
      current_ = filled_.lowest();
      const Bucket& next = buckets_[current_];
      const std::uint32_t end = std::min(slot(next.head) + kAhead, kSlots);
      for (std::uint32_t i = slot(next.head); i < end; ++i) fetch(pool_[block(next.head)].pixels[i]);
    }
    Bucket& bucket = buckets_[current_];
    if (slot(bucket.head) == kSlots) {
      const std::uint32_t used = block(bucket.head);
      bucket.head = pool_[used].next * kBlock;
      free_.push_back(used);
    }
    const Block& from = pool_[block(bucket.head)];
    const std::uint32_t at = slot(bucket.head), ahead = at + kAhead;
    if (ahead < kSlots) {
      fetch(from.pixels[ahead]);
    } else if (block(bucket.tail) != block(bucket.head)) {
      fetch(pool_[from.next].pixels[ahead - kSlots]);
    }
    const std::uint32_t pixel = from.pixels[at];
    ++bucket.head;
    if (bucket.head == bucket.tail) clear(bucket);
    return pixel;
  }

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;
  static constexpr std::uint32_t kBlock = 32, kSlots = kBlock - 1;  // two cache lines a block
  // How many pops ahead to fetch: enough to cover a memory access, few enough to stay in the nearest cache.
  static constexpr std::uint32_t kAhead = 8;

  struct Block {
    std::uint32_t pixels[kSlots];
    std::uint32_t next;
  };
  // Positions are block · kBlock + slot; a position at slot kSlots stands at the end of its block. No block
  // yet looks like the end of one.
  struct Bucket {
    std::uint32_t head = kNone, tail = kNone;
  };
  static std::uint32_t block(std::uint32_t position) { return position / kBlock; }
  static std::uint32_t slot(std::uint32_t position) { return position % kBlock; }

  void grow(std::uint32_t key, Bucket& bucket) {
    std::uint32_t added;
    if (free_.empty()) {
      added = static_cast<std::uint32_t>(pool_.size());
      pool_.emplace_back();
    } else {
      added = free_.back();
      free_.pop_back();
    }
    if (bucket.tail == kNone) {
      bucket.head = added * kBlock;
      filled_.insert(key);
    } else {
      pool_[block(bucket.tail)].next = added;
    }
    bucket.tail = added * kBlock;
  }

  void clear(Bucket& bucket) {
    free_.push_back(block(bucket.tail - 1));
    bucket = Bucket{};
    filled_.erase(current_);
    current_ = kNone;
  }

  std::vector<Bucket> buckets_;
  std::vector<Block> pool_;
  std::vector<std::uint32_t> free_;
  BucketSet filled_;
  std::uint32_t current_ = kNone;  // the lowest filled bucket, when known
};

// Heaps of pixels in buckets of near heights, for any numbers. O(log of the bucket's size) a pixel: nearly
// constant when heights spread over the buckets, O(log n) at worst.
// `BucketOf` maps keys to buckets and never falls as keys rise.
template <class BucketOf>
class HeapQueue {
 public:
  HeapQueue(std::uint32_t buckets, BucketOf bucket_of)
      : heaps_(buckets), filled_(buckets), bucket_of_(std::move(bucket_of)) {}

  bool empty() const { return filled_.empty(); }

  void push(std::uint32_t key, std::uint32_t pixel) {
    const std::uint32_t bucket = bucket_of_(key);
    std::vector<Entry>& heap = heaps_[bucket];
    if (heap.empty()) filled_.insert(bucket);
    heap.push_back({key, turn_++, pixel});
    std::push_heap(heap.begin(), heap.end(), later);
  }

  template <class Fetch>
  std::uint32_t pop(const Fetch&) {
    const std::uint32_t bucket = filled_.lowest();
    std::vector<Entry>& heap = heaps_[bucket];
    std::pop_heap(heap.begin(), heap.end(), later);
    const std::uint32_t pixel = heap.back().pixel;
    heap.pop_back();
    if (heap.empty()) filled_.erase(bucket);
    return pixel;
  }

 private:
  struct Entry {
    std::uint32_t key, turn, pixel;
  };
  static bool later(const Entry& a, const Entry& b) {
    return a.key != b.key ? a.key > b.key : a.turn > b.turn;
  }

  std::vector<std::vector<Entry>> heaps_;
  BucketSet filled_;
  BucketOf bucket_of_;
  std::uint32_t turn_ = 0;
};

}  // namespace terrabench::hydrology
