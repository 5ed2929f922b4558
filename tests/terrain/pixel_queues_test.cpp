// Both queues of the least-cost search against a sorted set of (key, turn).
#include "terrain/hydrology/pixel_queues.h"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <tuple>

namespace terrabench::hydrology {
namespace {

constexpr auto kFetchNothing = [](std::uint32_t) {};

// Alternates pushes and pops, in series of random length; `near` of 100 keys lie near the last one popped.
template <class Queue>
void check_order(Queue& queue, std::uint32_t keys, unsigned near, std::size_t pushes, unsigned seed) {
  std::mt19937 random(seed);
  std::set<std::tuple<std::uint32_t, std::uint32_t>> expected;  // key, pixel: pixels count the turns
  std::uint32_t turn = 0, last = keys / 2;
  const auto pop = [&] {
    const auto [key, pixel] = *expected.begin();
    expected.erase(expected.begin());
    ASSERT_FALSE(queue.empty());
    ASSERT_EQ(queue.pop(kFetchNothing), pixel) << "key " << key;
    last = key;
  };
  while (turn < pushes) {
    for (unsigned n = random() % 700; n > 0; --n) {
      const std::uint32_t step = random() % 9;
      const std::uint32_t key = random() % 100 < near ? std::min(last + step, keys - 1) : random() % keys;
      expected.emplace(key, turn);
      queue.push(key, turn++);
    }
    for (unsigned n = random() % 650; n > 0 && !expected.empty(); --n) ASSERT_NO_FATAL_FAILURE(pop());
  }
  while (!expected.empty()) ASSERT_NO_FATAL_FAILURE(pop());
  EXPECT_TRUE(queue.empty());
}

TEST(BucketQueue, TakesTheLowestAndOfEqualOnesTheLongestWaiting) {
  for (const std::uint32_t keys : {1U, 2U, 63U, 65U, 5000U, 1U << 20}) {
    for (const unsigned near : {0U, 60U, 100U}) {
      BucketQueue queue(keys);
      ASSERT_NO_FATAL_FAILURE(check_order(queue, keys, near, 60000, keys + near));
    }
  }
}

TEST(SortedBucketQueue, TakesTheLowestAndOfEqualOnesTheLongestWaiting) {
  // Few keys: many ties. Few buckets: most pushes meet the heap, which outgrows the bucket many times over.
  for (const std::uint32_t keys : {1U, 3U, 200U, 1U << 24}) {
    for (const std::uint32_t buckets : {1U, 3U, 64U, 4096U}) {
      for (const unsigned near : {0U, 60U, 100U}) {
        const auto bucket_of = [=](std::uint32_t key) {
          return static_cast<std::uint32_t>(std::uint64_t{key} * buckets / keys);
        };
        SortedBucketQueue queue(buckets, bucket_of);
        ASSERT_NO_FATAL_FAILURE(check_order(queue, keys, near, 60000, keys + buckets + near));
      }
    }
  }
}

// Keys that fall and fall, as the search goes down into a basin, and rise again.
TEST(SortedBucketQueue, FollowsABasinDownAndUp) {
  const auto bucket_of = [](std::uint32_t key) { return key / 100; };
  SortedBucketQueue queue(1000, bucket_of);
  std::set<std::tuple<std::uint32_t, std::uint32_t>> expected;
  std::uint32_t turn = 0;
  const auto push = [&](std::uint32_t key) {
    expected.emplace(key, turn);
    queue.push(key, turn++);
  };
  const auto pop = [&] {
    ASSERT_EQ(queue.pop(kFetchNothing), std::get<1>(*expected.begin()));
    expected.erase(expected.begin());
  };
  for (std::uint32_t level = 99999; level > 20; level -= 7) {
    for (std::uint32_t i = 0; i < 4; ++i) push(level - i % 3);
    ASSERT_NO_FATAL_FAILURE(pop());
  }
  while (!expected.empty()) {
    const std::uint32_t level = std::get<0>(*expected.begin());
    ASSERT_NO_FATAL_FAILURE(pop());
    if (turn % 3 == 0 && level < 99000) push(level + 500);
    ++turn;
  }
  EXPECT_TRUE(queue.empty());
}

}  // namespace
}  // namespace terrabench::hydrology
