#include "experiments/interference.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <limits>
#include <thread>

#include "experiments/stopwatch.h"

namespace terrabench {
namespace {

// Eight independent chains of integer operations keep all units of a core busy, so that a second thread on
// it is felt at once. No memory is used.
double loop_once() {
  constexpr int kSteps = 40000;  // some 0.08 ms
  std::uint64_t chain[8] = {1, 2, 3, 4, 5, 6, 7, 8};
  const double begin = thread_seconds();
  for (int step = 0; step < kSteps; ++step) {
#pragma GCC unroll 8
    for (int k = 0; k < 8; ++k) chain[k] += (chain[k] >> (k + 1)) ^ static_cast<std::uint64_t>(step);
  }
  const double taken = thread_seconds() - begin;
  std::uint64_t sum = 0;
  for (const std::uint64_t one : chain) sum += one;
  [[maybe_unused]] const volatile std::uint64_t used = sum;
  return taken;
}

std::atomic<double> g_shortest = std::numeric_limits<double>::infinity();

// The shorter of two loops, since an interrupt can hit one.
double loop_now() {
  const double taken = std::min(loop_once(), loop_once());
  double shortest = g_shortest;
  while (taken < shortest && !g_shortest.compare_exchange_weak(shortest, taken)) {
  }
  return taken;
}

}  // namespace

double shortest_loop() { return g_shortest; }

double loop_seconds() {
  if (shortest_loop() == std::numeric_limits<double>::infinity()) {
    constexpr int kFirst = 60;
    for (int k = 0; k < kFirst; ++k) loop_now();
  }
  constexpr int kAgain = 3;
  double taken = loop_now();
  for (int again = 0; again < kAgain && disturbed(taken); ++again) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    taken = std::min(taken, loop_now());
  }
  return taken;
}

std::size_t Turns::undisturbed() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(samples_, [](const Sample& sample) { return !disturbed(sample.loop); }));
}

bool Turns::more(std::size_t wanted) const {
  return undisturbed() < wanted && taken() < (wanted == 1 ? 1 : 2 * wanted);
}

void Turns::add(std::vector<double> sample, double loop) { samples_.push_back({std::move(sample), loop}); }

std::vector<std::vector<double>> Turns::kept(std::size_t enough) const {
  const bool all = undisturbed() < enough;
  std::vector<std::vector<double>> kept;
  for (const Sample& sample : samples_) {
    if (all || !disturbed(sample.loop)) kept.push_back(sample.values);
  }
  return kept;
}

}  // namespace terrabench
