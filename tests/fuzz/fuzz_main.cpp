// Drives a libFuzzer target without libFuzzer: `NAME [--runs N] [--seed S] [FILE …]`. Runs each given file as
// it is, then the target's own seeds, then N mutations of them (bits, bytes, numbers at their limits, cuts,
// splices). Deterministic.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string_view>

#include "terrain/files.h"
#include "tests/fuzz/fuzz.h"

namespace {

using Input = std::vector<std::uint8_t>;

void mutate(Input& input, const std::vector<Input>& seeds, std::mt19937_64& random) {
  const auto below = [&](std::size_t n) { return n == 0 ? 0 : static_cast<std::size_t>(random() % n); };
  const std::size_t at = below(input.size());
  switch (random() % 7) {
    case 0:  // one bit
      if (!input.empty()) input[at] ^= static_cast<std::uint8_t>(1U << below(8));
      break;
    case 1:  // one byte
      if (!input.empty()) input[at] = static_cast<std::uint8_t>(random());
      break;
    case 2:  // four bytes at a limit
      for (std::size_t i = at; i < std::min(at + 4, input.size()); ++i)
        input[i] = random() % 2 == 0 ? 0xFF : 0x00;
      break;
    case 3:  // cut the end
      input.resize(at);
      break;
    case 4:  // remove a stretch
      if (!input.empty()) {
        const std::size_t end = std::min(input.size(), at + 1 + below(16));
        input.erase(input.begin() + static_cast<long>(at), input.begin() + static_cast<long>(end));
      }
      break;
    case 5:  // insert noise
      for (std::size_t n = 1 + below(8); n > 0; --n) {
        input.insert(input.begin() + static_cast<long>(at), static_cast<std::uint8_t>(random()));
      }
      break;
    default:  // splice with another seed
      const Input& other = seeds[below(seeds.size())];
      const std::size_t from = below(other.size());
      input.resize(at);
      input.insert(input.end(), other.begin() + static_cast<long>(from), other.end());
  }
}

}  // namespace

int main(int argc, char** argv) {
  long runs = 1000;
  std::mt19937_64 random(1);
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    if (argument == "--runs" && i + 1 < argc) {
      runs = std::atol(argv[++i]);
    } else if (argument == "--seed" && i + 1 < argc) {
      random.seed(std::strtoull(argv[++i], nullptr, 10));
    } else {
      const std::string file = terrabench::read_file(argv[i]);
      LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(file.data()), file.size());
    }
  }
  std::vector<Input> seeds = fuzz_seeds();
  for (const Input& seed : seeds) LLVMFuzzerTestOneInput(seed.data(), seed.size());
  for (long run = 0; run < runs; ++run) {
    Input input = seeds[random() % seeds.size()];
    for (std::uint64_t n = 1 + random() % 4; n > 0; --n) mutate(input, seeds, random);
    LLVMFuzzerTestOneInput(input.data(), input.size());
  }
  std::printf("%ld mutations of %zu seeds\n", runs, seeds.size());
}
