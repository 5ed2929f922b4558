#include "representations/procedural_mesh/lazy/part_cache.h"

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <random>
#include <stdexcept>

#include "tests/terrain/errors.h"

namespace terrabench::growing {
namespace {

std::size_t bytes_of(std::uint64_t key) { return 10 + key * 7 % 23; }

std::atomic<std::size_t> g_living{0};  // bytes of the parts that were used and still exist

struct Part {
  explicit Part(std::uint64_t key) : key(key) {}
  ~Part() {
    if (used) g_living -= bytes();
  }
  std::size_t bytes() const { return bytes_of(key); }
  void use() const {
    if (!used.exchange(true)) g_living += bytes();
  }
  const std::uint64_t key;
  mutable std::atomic<bool> used{false};
};

std::unique_ptr<Part> part_of(std::uint64_t key) { return std::make_unique<Part>(key); }

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
  PartCache<Part> cache(200);
  Oracle oracle(200);
  std::mt19937 random(3);
  for (int step = 0; step < 5000; ++step) {
    const std::uint64_t key = random() % (step % 1000 < 500 ? 12 : 60);
    oracle.use(key);
    cache.with(
        key, [&] { return part_of(key); }, [&](const Part& part) { EXPECT_EQ(part.key, key); });
    ASSERT_EQ(cache.order(), oracle.order) << "step " << step;
    ASSERT_EQ(cache.bytes(), oracle.bytes());
  }
  EXPECT_EQ(cache.counts().hits, oracle.hits);
  EXPECT_EQ(cache.counts().misses, oracle.misses);
  EXPECT_EQ(cache.counts().evictions, oracle.evictions);
  EXPECT_GT(oracle.evictions, 1000U);
  EXPECT_LE(cache.counts().peak_bytes, 200U);
}

// Parts in use count: those that exist in the cache never exceed the bound, and a part lives while it is
// used.
TEST(PartCache, HoldsItsBoundAtEveryMomentWithManyThreads) {
  constexpr std::size_t kMost = 100;
  PartCache<Part> cache(kMost);
  std::atomic<std::size_t> over{0}, wrong{0};
  tbb::parallel_for(0, 8000, [&](int i) {
    const std::uint64_t key = static_cast<std::uint64_t>(i) * 2654435761U % 40;
    cache.with(
        key, [&] { return part_of(key); },
        [&](const Part& part) {
          part.use();
          if (g_living > kMost || cache.bytes() > kMost) ++over;
          if (part.key != key) ++wrong;
        });
  });
  EXPECT_EQ(over, 0U);
  EXPECT_EQ(wrong, 0U);
  EXPECT_LE(cache.counts().peak_bytes, kMost);
  EXPECT_EQ(cache.counts().hits + cache.counts().misses, 8000U);
}

TEST(PartCache, MakesAPartOnceForAllThreadsThatWait) {
  PartCache<Part> cache(1000);
  std::atomic<int> made{0};
  const auto make = [&] { return ++made, part_of(7); };
  tbb::parallel_for(0, 64, [&](int) { cache.with(7, make, [](const Part&) {}); });
  EXPECT_EQ(made, 1);
}

TEST(PartCache, APartThatExceedsTheBoundIsAnError) {
  PartCache<Part> cache(bytes_of(0));
  bool used = false;
  const auto use = [&](const Part&) { used = true; };
  const Failure failure = failure_of([&] {
    cache.with(
        1, [] { return part_of(1); }, use);
  });
  EXPECT_NE(failure.what.find("a part of 17 bytes does not fit into a cache of 10 bytes"), std::string::npos)
      << failure.what;
  EXPECT_FALSE(used);
  EXPECT_EQ(cache.bytes(), 0U);
  cache.with(
      0, [] { return part_of(0); }, use);
  EXPECT_TRUE(used);
}

TEST(PartCache, AFailureLeavesNoTrace) {
  PartCache<Part> cache(20);
  const auto fails = []() -> std::unique_ptr<Part> { throw std::runtime_error("no"); };
  const auto make = [] { return part_of(1); };
  EXPECT_THROW(cache.with(1, fails, [](const Part&) {}), std::runtime_error);
  EXPECT_TRUE(cache.order().empty());
  EXPECT_THROW(cache.with(1, make, [](const Part&) { throw std::runtime_error("no"); }), std::runtime_error);
  // It is no longer in use, so it makes room.
  cache.with(
      0, [] { return part_of(0); }, [](const Part&) {});
  EXPECT_EQ(cache.order(), std::vector<std::uint64_t>{0});
}

}  // namespace
}  // namespace terrabench::growing
