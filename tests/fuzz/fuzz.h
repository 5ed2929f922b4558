// A fuzz target defines these: the entry point, and valid inputs to start from.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
using FuzzSeeds = std::vector<std::vector<std::uint8_t>>;
FuzzSeeds fuzz_seeds();  // at least one

inline std::string_view fuzz_text(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}
inline FuzzSeeds seeds_of(std::span<const std::string_view> texts) {
  FuzzSeeds seeds;
  for (const std::string_view text : texts) seeds.emplace_back(text.begin(), text.end());
  return seeds;
}
