#include "representations/procedural_mesh/lazy/part_cache.h"

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <random>
#include <stdexcept>

namespace terrabench::growing {
namespace {

// What exists of all parts of a test, in and out of the cache.
struct Living {
  std::atomic<std::size_t> bytes{0}, made{0};
};

class Part {
 public:
  Part(Living& living, std::uint64_t key, std::size_t bytes) : key(key), living_(living), bytes_(bytes) {}
  ~Part() {
    if (counted_) living_.bytes -= bytes_;
  }
  // The cache asks when the part is complete, before it makes room.
  std::size_t bytes() const { return bytes_; }
  void count() const {
    if (!counted_.exchange(true)) living_.bytes += bytes_;
  }
  const std::uint64_t key;

 private:
  Living& living_;
  std::size_t bytes_;
  mutable std::atomic<bool> counted_{false};
};

std::size_t bytes_of(std::uint64_t key) { return 10 + key * 7 % 23; }

// A plain list of keys, from the one used last.
class Oracle {
 public:
  explicit Oracle(std::size_t most) : most_(most) {}
  void use(std::uint64_t key) {
    const auto found = std::find(order.begin(), order.end(), key);
    if (found != order.end()) {
      order.erase(found);
      ++hits;
    } else {
      ++misses;
      while (bytes() + bytes_of(key) > most_) {
        order.pop_back();
        ++evictions;
      }
    }
    order.insert(order.begin(), key);
  }
  std::size_t bytes() const {
    std::size_t sum = 0;
    for (const std::uint64_t key : order) sum += bytes_of(key);
    return sum;
  }
  std::vector<std::uint64_t> order;
  std::uint64_t hits = 0, misses = 0, evictions = 0;

 private:
  std::size_t most_;
};

TEST(PartCache, DropsWhatWasUsedLeastRecently) {
  Living living;
  PartCache<Part> cache(200);
  Oracle oracle(200);
  std::mt19937 random(3);
  for (int step = 0; step < 5000; ++step) {
    const std::uint64_t key = random() % (step % 1000 < 500 ? 12 : 60);
    oracle.use(key);
    cache.with(
        key, [&] { return std::make_unique<Part>(living, key, bytes_of(key)); },
        [&](const Part& part) { EXPECT_EQ(part.key, key); });
    ASSERT_EQ(cache.order(), oracle.order) << "step " << step;
    ASSERT_EQ(cache.bytes(), oracle.bytes());
  }
  EXPECT_EQ(cache.counts().hits, oracle.hits);
  EXPECT_EQ(cache.counts().misses, oracle.misses);
  EXPECT_EQ(cache.counts().evictions, oracle.evictions);
  EXPECT_GT(oracle.evictions, 1000U);
  EXPECT_LE(cache.counts().peak_bytes, 200U);
}

// Parts in use count themselves: the sum of those that exist in the cache never exceeds the bound, and a part
// lives while it is used.
TEST(PartCache, HoldsItsBoundAtEveryMomentWithManyThreads) {
  Living living;
  constexpr std::size_t kMost = 100;
  PartCache<Part> cache(kMost);
  std::atomic<std::size_t> over{0}, wrong{0};
  tbb::parallel_for(0, 8000, [&](int i) {
    const std::uint64_t key = static_cast<std::uint64_t>(i) * 2654435761U % 40;
    cache.with(
        key, [&] { return std::make_unique<Part>(living, key, bytes_of(key)); },
        [&](const Part& part) {
          part.count();
          if (living.bytes > kMost || cache.bytes() > kMost) ++over;
          if (part.key != key) ++wrong;
        });
  });
  EXPECT_EQ(over, 0U);
  EXPECT_EQ(wrong, 0U);
  EXPECT_LE(cache.counts().peak_bytes, kMost);
  EXPECT_EQ(cache.counts().hits + cache.counts().misses, 8000U);
}

TEST(PartCache, MakesAPartOnceForAllThreadsThatWait) {
  Living living;
  PartCache<Part> cache(1000);
  tbb::parallel_for(0, 64, [&](int) {
    cache.with(
        7,
        [&] {
          ++living.made;
          return std::make_unique<Part>(living, 7, 10);
        },
        [](const Part&) {});
  });
  EXPECT_EQ(living.made, 1U);
}

TEST(PartCache, APartThatExceedsTheBoundIsAnError) {
  Living living;
  PartCache<Part> cache(9);
  bool used = false;
  try {
    cache.with(
        1, [&] { return std::make_unique<Part>(living, 1, 10); }, [&](const Part&) { used = true; });
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("10 bytes does not fit into a cache of 9 bytes"),
              std::string::npos)
        << error.what();
  }
  EXPECT_FALSE(used);
  EXPECT_EQ(cache.bytes(), 0U);
  cache.with(
      1, [&] { return std::make_unique<Part>(living, 1, 9); }, [&](const Part&) { used = true; });
  EXPECT_TRUE(used);
}

TEST(PartCache, AFailureLeavesNoTrace) {
  Living living;
  PartCache<Part> cache(100);
  const auto fails = []() -> std::unique_ptr<Part> { throw std::runtime_error("no"); };
  EXPECT_THROW(cache.with(1, fails, [](const Part&) {}), std::runtime_error);
  EXPECT_FALSE(cache.holds(1));
  const auto make = [&] { return std::make_unique<Part>(living, 1, 60); };
  EXPECT_THROW(cache.with(1, make, [](const Part&) { throw std::runtime_error("no"); }), std::runtime_error);
  // It is no longer in use, so it makes room.
  cache.with(
      2, [&] { return std::make_unique<Part>(living, 2, 60); }, [](const Part&) {});
  EXPECT_FALSE(cache.holds(1));
  EXPECT_TRUE(cache.holds(2));
}

}  // namespace
}  // namespace terrabench::growing
