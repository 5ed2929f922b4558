#include "results/mutants.h"

#include <gtest/gtest.h>

#include <cstdio>

namespace terrabench {
namespace {

TEST(Mutants, NoClaimSurvives) {
  const Store store = Store::open(std::filesystem::path(TERRABENCH_SOURCE_DIR) / "results/reference");
  for (const Survivor& survivor : survivors(store, papers())) {
    ADD_FAILURE() << survivor.claim->id << ": " << survivor.reason;
  }
}

}  // namespace
}  // namespace terrabench
