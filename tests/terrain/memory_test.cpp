#include "terrain/memory.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <map>
#include <memory>
#include <random>
#include <thread>

namespace terrabench {
namespace {

TEST(Memory, CounterAgreesWithWhatAVectorSays) {
  const HeapScope scope;
  std::vector<float> values(100003);
  const Memory memory = payload_memory(values);
  EXPECT_EQ(memory.payload, 100003 * sizeof(float));
  EXPECT_EQ(scope.held(), static_cast<std::int64_t>(memory.total()));
  std::vector<float>().swap(values);
  EXPECT_EQ(scope.held(), 0);
  EXPECT_EQ(payload_memory(values).total(), 0U);
}

TEST(Memory, ReservedSpaceIsSlack) {
  std::vector<std::uint64_t> values;
  values.reserve(1000);
  values.resize(10);
  const Memory payload = payload_memory(values), index = index_memory(values);
  EXPECT_EQ(payload.payload, 80U);
  EXPECT_GE(payload.slack, 990 * 8U);
  EXPECT_EQ(index.payload, 0U);
  EXPECT_EQ(index.index, 80U);
  EXPECT_EQ(index.total(), payload.total());
  Memory sum = payload;
  sum += index;
  EXPECT_EQ(sum.total(), 2 * payload.total());
}

TEST(Memory, PeakRemembersWhatWasFreed) {
  HeapCounter::reset_peak();
  const std::int64_t before = HeapCounter::live();
  std::int64_t size = 0;
  {
    const std::vector<std::byte> large(5 << 20);
    size = static_cast<std::int64_t>(heap_bytes(large.data()));
  }
  EXPECT_EQ(HeapCounter::live(), before);
  EXPECT_EQ(HeapCounter::peak(), before + size);
  HeapCounter::reset_peak();
  EXPECT_EQ(HeapCounter::peak(), before);
}

TEST(Memory, EveryFormOfNewIsCounted) {
  struct alignas(256) Wide {
    std::byte bytes[512];
  };
  const HeapScope scope;
  {
    const auto one = std::make_unique<int>(1);
    const auto wide = std::make_unique<Wide>();
    const auto wides = std::make_unique<Wide[]>(3);
    EXPECT_GE(scope.held(), static_cast<std::int64_t>(sizeof(int) + 4 * sizeof(Wide)));
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(wide.get()) % 256, 0U);
  }
  EXPECT_EQ(scope.held(), 0);
}

TEST(Memory, ThreadsAreCountedTogether) {
  std::vector<std::unique_ptr<std::vector<int>>> blocks(4);
  const HeapScope scope;
  {
    std::vector<std::thread> threads;
    for (auto& block : blocks) {
      threads.emplace_back([&] {
        for (int k = 0; k < 1000; ++k) block = std::make_unique<std::vector<int>>(1000);
      });
    }
    for (std::thread& thread : threads) thread.join();
  }
  std::size_t expected = 0;
  for (const auto& block : blocks) expected += heap_bytes(block.get()) + heap_bytes(block->data());
  EXPECT_EQ(scope.held(), static_cast<std::int64_t>(expected));
}

// Whatever lies on the heap, holes of all sizes from C libraries included, and however often large blocks
// were freed, after which malloc takes fewer of them as pages of their own.
TEST(Memory, EqualBlocksCountEqualBytes) {
  constexpr std::array<std::size_t, 12> kSizes{0,    1,    24,     25,     40,     100,
                                               1000, 4096, 126976, 126977, 200000, 3000000};
  struct alignas(64) Line {
    std::byte bytes[64];
  };
  std::map<std::size_t, std::size_t> counted, counted_aligned;
  std::mt19937 random(5);
  std::vector<void*> foreign(2000);
  std::vector<std::vector<char>> own(200);
  for (int k = 0; k < 20000; ++k) {
    void*& hole = foreign[random() % foreign.size()];
    std::free(hole);
    hole = std::malloc(random() % 300);
    const std::size_t size = kSizes[random() % (k % 16 == 0 ? kSizes.size() : 8)];
    const std::unique_ptr<std::byte[]> block(new std::byte[size]);
    const std::size_t bytes = heap_bytes(block.get());
    EXPECT_GE(bytes, size);
    EXPECT_EQ(counted.try_emplace(size, bytes).first->second, bytes) << size;
    const std::unique_ptr<Line[]> lines(new Line[1 + size / 64]);
    const std::size_t aligned = heap_bytes(lines.get());
    EXPECT_GE(aligned, 64 * (1 + size / 64));
    EXPECT_EQ(counted_aligned.try_emplace(size, aligned).first->second, aligned) << size;
    own[random() % own.size()] = std::vector<char>(random() % 600);
  }
  for (void* const hole : foreign) std::free(hole);
  EXPECT_EQ(counted.size(), kSizes.size());
}

TEST(Memory, BlocksCountLittleMoreThanTheirSize) {
  for (const auto& [size, counted] : {std::pair<std::size_t, std::size_t>{0, 24},
                                      {24, 24},
                                      {25, 56},
                                      {1016, 1016},
                                      {1017, 1080},
                                      {126976, 127032},
                                      {126977, 131048}}) {
    const std::unique_ptr<std::byte[]> block(new std::byte[size]);
    EXPECT_EQ(heap_bytes(block.get()), counted) << size;
  }
}

TEST(Memory, AnyAlignmentIsAllowed) {
  const HeapScope scope;
  for (std::size_t align = 1; align <= 1024; align *= 2) {
    void* const block = operator new(10, std::align_val_t(align));
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(block) % align, 0U);
    operator delete(block, std::align_val_t(align));
  }
  EXPECT_EQ(scope.held(), 0);
}

TEST(Memory, TheMachineHasSome) {
  EXPECT_GT(physical_memory(), std::uint64_t{1} << 28);
  EXPECT_GT(available_memory(), 0U);
  EXPECT_LE(available_memory(), physical_memory());
}

}  // namespace
}  // namespace terrabench
