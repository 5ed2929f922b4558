// The two queues of the least-cost search (flow.h). Both return the pixel of the lowest key, first in first
// out among equal keys. Both find the lowest bucket in constant time by a bit set of bit sets, because in
// pits keys lower than the last one returned are pushed. Both report the pixels that come next, so that their
// neighbourhoods can be prefetched.
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

// The set of non-empty buckets, of up to 2^24. Four levels of 64 bits per word.
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

// Numbered blocks of entries, of which buckets are chains: a bucket's pixels lie together, and no
// bucket needs an allocation of its own.
template <class Block>
class BlockPool {
 public:
  Block& operator[](std::uint32_t block) { return blocks_[block]; }
  const Block& operator[](std::uint32_t block) const { return blocks_[block]; }
  std::uint32_t take() {
    if (free_.empty()) {
      blocks_.emplace_back();
      return static_cast<std::uint32_t>(blocks_.size() - 1);
    }
    const std::uint32_t block = free_.back();
    free_.pop_back();
    return block;
  }
  void give_back(std::uint32_t block) { free_.push_back(block); }

 private:
  std::vector<Block> blocks_;
  std::vector<std::uint32_t> free_;
};

// Prefetch distance, in pops: enough to cover a memory access, few enough to stay in the nearest cache.
inline constexpr std::uint32_t kAhead = 8;

// One first-in-first-out bucket per key, for whole numbers. O(1) per pixel.
class BucketQueue {
 public:
  explicit BucketQueue(std::uint32_t keys) : buckets_(keys), filled_(keys) {}

  bool empty() const { return current_ == kNone && filled_.empty(); }

  void push(std::uint32_t key, std::uint32_t pixel) {
    Bucket& bucket = buckets_[key];
    if (slot(bucket.tail) == kSlots) grow(key, bucket);
    pool_[block(bucket.tail)].pixels[slot(bucket.tail)] = pixel;
    ++bucket.tail;
    if (key < current_) current_ = kNone;  // also when it is kNone
  }

  // Calls `fetch` with pixels that are likely to be popped soon.
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
      pool_.give_back(used);
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
  static constexpr std::uint32_t kBlock = 32, kSlots = kBlock - 1;  // two cache lines per block

  struct Block {
    std::uint32_t pixels[kSlots];
    std::uint32_t next;
  };
  // Positions are block · kBlock + slot; slot kSlots is the end of a block. kNone, no block
  // yet, has that slot too.
  struct Bucket {
    std::uint32_t head = kNone, tail = kNone;
  };
  static std::uint32_t block(std::uint32_t position) { return position / kBlock; }
  static std::uint32_t slot(std::uint32_t position) { return position % kBlock; }

  void grow(std::uint32_t key, Bucket& bucket) {
    const std::uint32_t added = pool_.take();
    if (bucket.tail == kNone) {
      bucket.head = added * kBlock;
      filled_.insert(key);
    } else {
      pool_[block(bucket.tail)].next = added;
    }
    bucket.tail = added * kBlock;
  }

  void clear(Bucket& bucket) {
    pool_.give_back(block(bucket.tail - 1));
    bucket = Bucket{};
    filled_.erase(current_);
    current_ = kNone;
  }

  std::vector<Bucket> buckets_;
  BlockPool<Block> pool_;
  BucketSet filled_;
  std::uint32_t current_ = kNone;  // the lowest filled bucket, when known
};

// For any numbers: buckets of near heights (Denardo & Fox 1979). The lowest bucket is sorted into a run and
// popped in order. Keys pushed at or under it meanwhile, mostly in pits, go to a heap; when the heap outgrows
// the run, as in a deep basin, run and heap are put back into buckets. Nearly O(1) per pixel when heights
// spread over the buckets, O(log n) at worst. `BucketOf` maps keys to buckets, monotonically.
template <class BucketOf>
class SortedBucketQueue {
 public:
  SortedBucketQueue(std::uint32_t buckets, BucketOf bucket_of)
      : buckets_(buckets), filled_(buckets), bucket_of_(std::move(bucket_of)) {}

  bool empty() const { return next_ == run_.size() && heap_.empty() && filled_.empty(); }

  void push(std::uint32_t key, std::uint32_t pixel) {
    const std::uint32_t bucket = bucket_of_(key);
    if (current_ == kNone || bucket > current_) {
      put(bucket, {key, pixel});
    } else {
      heap_.push_back({std::uint64_t{key} << 32 | turn_++, pixel});
      std::push_heap(heap_.begin(), heap_.end(), later);
    }
  }

  // Calls `fetch` with pixels that are popped soon.
  template <class Fetch>
  std::uint32_t pop(const Fetch& fetch) {
    if (heap_.size() > kMostInHeap && heap_.size() > 2 * (run_.size() - next_)) put_back();
    if (next_ == run_.size() && heap_.empty()) begin_lowest(fetch);
    // Of equal keys, those in the run were pushed before those in the heap.
    if (next_ < run_.size() && (heap_.empty() || run_[next_].key <= heap_.front().key >> 32)) {
      if (next_ + kAhead < run_.size()) fetch(run_[next_ + kAhead].pixel);
      return run_[next_++].pixel;
    }
    std::pop_heap(heap_.begin(), heap_.end(), later);
    const std::uint32_t pixel = heap_.back().pixel;
    heap_.pop_back();
    return pixel;
  }

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;
  static constexpr std::uint32_t kSlots = 15;       // two cache lines per block
  static constexpr std::size_t kMostInHeap = 4096;  // larger ones leave the nearest cache

  struct Entry {
    std::uint32_t key, pixel;
  };
  struct Late {
    std::uint64_t key;  // the key above, the number of the push below
    std::uint32_t pixel;
  };
  static bool later(const Late& a, const Late& b) { return a.key > b.key; }

  struct Block {
    std::array<Entry, kSlots> entries;
    std::uint32_t used, next;
  };
  struct Bucket {
    std::uint32_t first = kNone, last = kNone;  // blocks; entries in the order of pushing
  };

  void put(std::uint32_t at, Entry entry) {
    Bucket& bucket = buckets_[at];
    if (bucket.last == kNone || pool_[bucket.last].used == kSlots) grow(at, bucket);
    Block& block = pool_[bucket.last];
    block.entries[block.used++] = entry;
  }

  void grow(std::uint32_t at, Bucket& bucket) {
    const std::uint32_t added = pool_.take();
    pool_[added].used = 0;
    pool_[added].next = kNone;
    if (bucket.last == kNone) {
      bucket.first = added;
      filled_.insert(at);
    } else {
      pool_[bucket.last].next = added;
    }
    bucket.last = added;
  }

  template <class Fetch>
  void begin_lowest(const Fetch& fetch) {
    current_ = filled_.lowest();
    filled_.erase(current_);
    waited_.clear();
    order_.clear();
    for (std::uint32_t at = buckets_[current_].first; at != kNone; at = pool_[at].next) {
      for (std::uint32_t i = 0; i < pool_[at].used; ++i) {
        const Entry& entry = pool_[at].entries[i];
        order_.push_back(std::uint64_t{entry.key} << 32 | waited_.size());
        waited_.push_back(entry);
      }
      pool_.give_back(at);
    }
    buckets_[current_] = {};
    std::sort(order_.begin(), order_.end());
    run_.resize(order_.size());
    for (std::size_t i = 0; i < order_.size(); ++i) {
      run_[i] = waited_[static_cast<std::uint32_t>(order_[i])];
      if (i < kAhead) fetch(run_[i].pixel);
    }
    next_ = 0;
  }

  // The run first, then the heap in the order of pushing, so that equal keys stay in order.
  void put_back() {
    for (; next_ < run_.size(); ++next_) put(current_, run_[next_]);
    std::sort(heap_.begin(), heap_.end(), [](const Late& a, const Late& b) {
      return static_cast<std::uint32_t>(a.key) < static_cast<std::uint32_t>(b.key);
    });
    for (const Late& entry : heap_) {
      const auto key = static_cast<std::uint32_t>(entry.key >> 32);
      put(bucket_of_(key), {key, entry.pixel});
    }
    heap_.clear();
  }

  std::vector<Bucket> buckets_;  // those up to the current one are empty
  BlockPool<Block> pool_;
  BucketSet filled_;
  BucketOf bucket_of_;
  std::uint32_t current_ = kNone;
  std::vector<Entry> run_;  // the current bucket in order, from next_ on
  std::size_t next_ = 0;
  std::vector<Late> heap_;
  std::uint32_t turn_ = 0;
  // Scratch of begin_lowest(), kept for its memory.
  std::vector<Entry> waited_;
  std::vector<std::uint64_t> order_;
};

}  // namespace terrabench::hydrology
