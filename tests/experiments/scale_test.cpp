#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "experiments/cross/scale/run.h"
#include "experiments/cross/scale/scaling.h"
#include "experiments/experiment.h"
#include "lod/lod.h"
#include "representations/representation.h"
#include "terrain/error.h"

namespace terrabench::cross {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<double> samples(const Record& record, std::string_view metric) {
  const Metric* const found = record.find(metric);
  return found == nullptr ? std::vector<double>{} : found->samples;
}

template <class Part>
Record recorded(const Part& part) {
  Record record;
  Recorder recorder(record, "");
  part.record(recorder);
  return record;
}

TEST(Sides, DoubleOrClimbByHalfOctaves) {
  EXPECT_THAT(doubled_sides(129, 1025), ElementsAre(129, 257, 513, 1025));
  EXPECT_THAT(doubled_sides(129, 1024), ElementsAre(129, 257, 513));
  EXPECT_THAT(half_octave_sides(32, 128), ElementsAre(32, 48, 64, 96, 128));
  EXPECT_THAT(half_octave_sides(9, 20), ElementsAre(9, 18));
  EXPECT_THAT(doubled_sides(20, 10), IsEmpty());
}

// A quarter of the time is left after two sizes that took 1 s and 4 s; the next would take 16 s.
TEST(SizePlan, SkipsWhatTheTimeLeftDoesNotCover) {
  SizePlan plan("build", {20, 600}, {1, 1});
  ASSERT_TRUE(plan.admits(1));
  plan.measured(1, 1, 10);
  ASSERT_TRUE(plan.admits(4));
  plan.measured(4, 4, 40);
  EXPECT_FALSE(plan.admits(16));
  EXPECT_FALSE(plan.admits(64)) << "after a size that was skipped, the larger ones are skipped too";
  EXPECT_EQ(plan.sizes(), 2U);
  const Record record = recorded(plan);
  EXPECT_THAT(samples(record, "build_short_of_time"), ElementsAre(1));
  EXPECT_THAT(samples(record, "build_short_of_memory"), ElementsAre(1));
  EXPECT_THAT(samples(record, "build_refused"), ElementsAre(0));
}

TEST(SizePlan, AdmitsExactlyWhatTheBudgetCovers) {
  SizePlan plan("build", {21, 160}, {1, 1});
  for (const double columns : {1.0, 4.0, 16.0}) {
    ASSERT_TRUE(plan.admits(columns));
    plan.measured(columns, columns, static_cast<std::int64_t>(10 * columns));
  }
  EXPECT_EQ(plan.sizes(), 3U);
}

TEST(SizePlan, SkipsWhatMemoryDoesNotHold) {
  SizePlan plan("mesh", {1e6, 639}, {1, 1.5});
  ASSERT_TRUE(plan.admits(1));
  EXPECT_EQ(plan.expected_bytes(1), 0U);
  plan.measured(1, 1, 10);
  EXPECT_EQ(plan.expected_bytes(4), 80U);
  EXPECT_GT(plan.expected_bytes(1e300), std::uint64_t{1} << 59) << "no overflow";
  ASSERT_TRUE(plan.admits(4)) << "10 · 4^1.5 = 80";
  plan.measured(4, 1, 80);
  EXPECT_FALSE(plan.admits(16)) << "640";
  EXPECT_THAT(samples(recorded(plan), "mesh_short_of_memory"), ElementsAre(1));
}

TEST(SizePlan, TheFirstSizeIsAlwaysMeasuredAndARefusalEndsThePlan) {
  SizePlan plan("build", {0, 0}, {1, 1});
  EXPECT_TRUE(plan.admits(100));
  plan.measured(100, 1, 1);
  SizePlan other("build", {1e6, 1 << 30}, {1, 1});
  EXPECT_TRUE(other.admits(1));
  other.measured(1, 1, 1);
  EXPECT_TRUE(other.admits(4));
  other.refused();
  EXPECT_FALSE(other.admits(16));
  EXPECT_THAT(samples(recorded(other), "build_refused"), ElementsAre(2));
}

TEST(Cost, RecordsTheExponentThroughTheMediansBesideTheTheory) {
  Cost cost("build", "s", 1);
  for (const double columns : {1.0, 4.0, 16.0}) {
    for (const double factor : {0.5, 1.0, 100.0}) cost.add(columns, factor * std::pow(columns, 1.25));
  }
  const Record record = recorded(cost);
  EXPECT_THAT(samples(record, "build").size(), 9U);
  EXPECT_THAT(samples(record, "build_columns"), ElementsAre(1, 1, 1, 4, 4, 4, 16, 16, 16));
  EXPECT_NEAR(samples(record, "build_exponent").at(0), 1.25, 1e-9);
  EXPECT_NEAR(samples(record, "build_excess").at(0), 0.25, 1e-9);
  EXPECT_NEAR(samples(record, "build_low").at(0), 1.25, 1e-6);
  EXPECT_NEAR(samples(record, "build_high").at(0), 1.25, 1e-6);
  EXPECT_EQ(record.find("build_exponent")->unit, "exponent") << "varies from run to run";
  EXPECT_THAT(samples(record, "build_largest"), ElementsAre(16));
  EXPECT_THAT(samples(record, "build_fitted"), ElementsAre(3));
}

TEST(Cost, ATimeOfZeroIsAFaultAndNoBytesHaveNoExponent) {
  Cost time("edit", "s", 0), bytes("uploaded", "B", 0);
  for (const double columns : {1.0, 4.0, 16.0}) {
    time.add(columns, columns > 1 ? 1e-6 : 0);
    bytes.add(columns, columns > 1 ? 8 : 0);
  }
  try {
    recorded(time);
    FAIL() << "took no time";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("edit took no time at 1 columns"));
  }
  const Record record = recorded(bytes);
  EXPECT_EQ(record.find("uploaded_exponent"), nullptr);
  EXPECT_EQ(record.find("uploaded_fitted"), nullptr);
}

TEST(Cost, OneSizeHasNoExponentAndTwoHaveNoInterval) {
  Cost one("bytes", "B", 1);
  one.add(4, 8);
  EXPECT_EQ(recorded(one).find("bytes_exponent"), nullptr);
  EXPECT_EQ(recorded(Cost("bytes", "B", 1)).metrics.size(), 0U);
  one.add(16, 32);
  const Record two = recorded(one);
  EXPECT_NEAR(samples(two, "bytes_exponent").at(0), 1, 1e-12);
  EXPECT_EQ(two.find("bytes_exponent")->unit, "");
  EXPECT_EQ(two.find("bytes_low"), nullptr);
}

TEST(Cost, ALogarithmAddsWhatItAddsOverTheSizes) {
  Cost cost("route", "s", 1, true);
  for (const double n : {1e4, 1e6, 1e8}) cost.add(n, n * std::log(n));
  EXPECT_NEAR(cost.theory().value(), 1 + std::log(2.0) / std::log(1e4), 1e-12);
  EXPECT_NEAR(samples(recorded(cost), "route_excess").at(0), 0, 1e-3);
}

TEST(ScaleCases, NameEveryStructureAndMethod) {
  std::set<std::string> names;
  for (const Case& at : experiment("cross.scale").cases({})) names.insert(at.name);
  for (const RepresentationType& type : representations()) {
    EXPECT_TRUE(names.contains("heights/" + std::string(type.name))) << type.name;
  }
  for (const LodType& type : lods()) EXPECT_TRUE(names.contains("lods/" + std::string(type.name)));
}

// The whole experiment on a few small sizes, and with budgets that leave out all but the first.
Record measured(const char* name, std::initializer_list<std::pair<std::string_view, Value>> given) {
  const Experiment& scale = experiment("cross.scale");
  Case at;
  for (const Case& one : scale.cases({})) {
    if (one.name == name) at = one;
  }
  for (const auto& [parameter, value] : given) at.parameters.set(parameter, value);
  Record record;
  Recorder recorder(record, "");
  Progress silent;
  scale.measure(at, {}, recorder, silent);
  return record;
}

TEST(Scale, BytesOfAHeightMapGrowWithItsColumns) {
  const Record record =
      measured("heights/heightmap",
               {{"smallest", std::int64_t{65}}, {"largest", std::int64_t{257}}, {"seconds", 1e6}});
  EXPECT_THAT(samples(record, "bytes_columns"), ElementsAre(65 * 65, 129 * 129, 257 * 257));
  EXPECT_NEAR(samples(record, "bytes_exponent").at(0), 1, 0.02);
  EXPECT_THAT(samples(record, "build_fitted"), ElementsAre(3));
  EXPECT_EQ(samples(record, "query_exponent").size(), 1U);
}

// Six samples of queries, rays and edits at each of three sizes, and those only where the structure has them.
TEST(Scale, QueriesRaysEditsAndFilesAreMeasuredAtEverySize) {
  const auto over = [](const char* name) {
    return measured(name, {{"smallest", std::int64_t{65}}, {"largest", std::int64_t{257}}, {"seconds", 1e6}});
  };
  const Record stack = over("heights/layered_stack"), map = over("heights/heightmap"),
               tree = over("heights/ght");
  for (const char* const cost : {"query", "query_near", "ray", "ray_near", "edit", "edit_cached"}) {
    EXPECT_EQ(samples(stack, cost).size(), 18U) << cost;
    for (const double seconds : samples(stack, cost)) EXPECT_GT(seconds, 0) << cost;
  }
  for (const char* const cost : {"edit", "edit_cached"}) EXPECT_EQ(samples(tree, cost).size(), 18U) << cost;
  for (const char* const cost : {"edit", "edit_cached"}) EXPECT_EQ(samples(map, cost).size(), 18U) << cost;
  const Record mesh = over("heights/procedural_mesh");
  EXPECT_EQ(mesh.find("edit"), nullptr) << "a subdivision surface takes no edits";
  EXPECT_EQ(mesh.find("ray"), nullptr) << "cast through its mesh";
  EXPECT_THAT(samples(map, "load_smallest"), ElementsAre(65 * 65));
  EXPECT_THAT(samples(map, "load_largest"), ElementsAre(257 * 257));
}

TEST(Scale, DiggingIsMeasuredOnlyWhereTheGroundHasRoomForTheHoles) {
  const Record record =
      measured("solids/layered_stack",
               {{"smallest", std::int64_t{32}}, {"largest", std::int64_t{64}}, {"seconds", 1e6}});
  EXPECT_THAT(samples(record, "query_smallest"), ElementsAre(32 * 32));
  EXPECT_THAT(samples(record, "edit_smallest"), ElementsAre(64 * 64));
  for (const double seconds : samples(record, "edit")) EXPECT_GT(seconds, 0);
}

// Of this thread so far, without those that needed a disk: the first use of memory that the system gave.
double page_faults() {
  rusage used{};
  getrusage(RUSAGE_THREAD, &used);
  return static_cast<double>(used.ru_minflt);
}

// By default glibc allocates blocks of 64 MiB with mmap if no free block fits.
TEST(Scale, ProvidedMemoryComesWithoutFaultsAndIsGivenBack) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer has an allocator of its own";
#endif
  const auto resident_pages = [] {
    std::ifstream file("/proc/self/statm");
    long size = 0, resident = 0;
    file >> size >> resident;
    return resident;
  };
  const auto faults = [] {
    const double before = page_faults();
    std::vector<std::vector<char>> blocks;
    for (int k = 0; k < 3; ++k) blocks.emplace_back(std::size_t{64} << 20, '\1');
    return page_faults() - before;
  };
  const long before = resident_pages();
  {
    const KeepFreedMemory keep;
    keep.give_back();
    EXPECT_GE(faults(), 96) << "each page causes a fault: at least 96 with pages of 2 MiB";
    keep.provide(std::uint64_t{3 * 64 + 8} << 20);
    EXPECT_LT(faults(), 100);
  }
  EXPECT_LT(resident_pages(), before + (1 << 14))
      << "at most a third of the pages stay; threads of other tests may hold some";
}

// Without it the faults depend on the blocks that were freed before.
TEST(Scale, FreedMemoryIsUsedAgainWithoutFaults) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer has an allocator of its own";
#endif
  const KeepFreedMemory keep;
  const auto faults = [] {
    const double before = page_faults();
    std::vector<std::vector<char>> blocks;
    for (int k = 0; k < 8; ++k) blocks.emplace_back(std::size_t{16} << 20, '\1');
    return page_faults() - before;
  };
  faults();
  EXPECT_LT(faults(), 100) << "32,768 pages";
}

TEST(Scale, DenseVoxelsGrowWithTheirVoxelsAndSkippedSizesAreRecorded) {
  const Record record =
      measured("solids/dense_voxel",
               {{"smallest", std::int64_t{32}}, {"largest", std::int64_t{64}}, {"seconds", 1e6}});
  EXPECT_NEAR(samples(record, "bytes_exponent").at(0), 1.5, 0.02);
  const Record brief = measured(
      "solids/dense_voxel",
      {{"smallest", std::int64_t{16}}, {"largest", std::int64_t{32}}, {"memory", 0.001}, {"seconds", 0.0}});
  EXPECT_EQ(brief.find("build_fitted"), nullptr) << "one size";
  EXPECT_THAT(samples(brief, "build_short_of_time"), ElementsAre(2)) << "24 and 32 samples";
}

// The block with which the caches are emptied is larger than the limit here, and must not count.
TEST(Scale, TheLimitOfMemoryIsForTheWorkAlone) {
  const Record record = measured(
      "heights/heightmap",
      {{"smallest", std::int64_t{33}}, {"largest", std::int64_t{129}}, {"memory", 0.01}, {"seconds", 1e6}});
  EXPECT_THAT(samples(record, "build_fitted"), ElementsAre(3));
}

TEST(Scale, AWindowOnGrowingGroundHoldsTheSame) {
  const auto over = [](const char* name) {
    return measured(name,
                    {{"smallest", std::int64_t{257}}, {"largest", std::int64_t{2049}}, {"seconds", 1e6}});
  };
  const Record record = over("lods/clipmap");
  EXPECT_NEAR(samples(record, "bytes_exponent").at(0), 0, 0.25);
  const Record brute = over("lods/brute_force");
  EXPECT_GT(samples(brute, "triangles_exponent").at(0), 0.5);
}

// On smaller ground much of what is in view lies beyond the edge.
TEST(Scale, MethodsAreBuiltOnSmallerGroundThanTheyWalkOn) {
  for (const LodType& type : lods()) {
    const Record record = measured(fmt::format("lods/{}", type.name).c_str(),
                                   {{"largest", std::int64_t{1025}}, {"seconds", 1e6}});
    EXPECT_THAT(samples(record, "build_smallest"), ElementsAre(129 * 129)) << type.name;
    EXPECT_THAT(samples(record, "build_fitted"), ElementsAre(4)) << type.name;
    for (const char* const cost : {"bytes", "update", "uploaded", "triangles"}) {
      EXPECT_THAT(samples(record, std::string(cost) + "_smallest"), ElementsAre(513 * 513)) << type.name;
      EXPECT_THAT(samples(record, std::string(cost) + "_fitted"), ElementsAre(2)) << type.name;
    }
  }
}

TEST(Scale, RefusesWhatItDoesNotKnow) {
  EXPECT_THROW(measured("flow/unrounded", {{"method", std::string("rounded")}}), Error);
  EXPECT_THROW(measured("lods/roam", {{"method", std::string("rome")}}), Error);
  EXPECT_THROW(
      measured("heights/heightmap", {{"smallest", std::int64_t{1025}}, {"largest", std::int64_t{65}}}),
      Error);
}

}  // namespace
}  // namespace terrabench::cross
