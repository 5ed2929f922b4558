#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <string>

#include "experiments/cross/lod/flight.h"
#include "results/claims/claims.h"
#include "results/store/statistics.h"
#include "terrain/error.h"
#include "terrain/files.h"
#include "tests/experiments/value.h"

namespace terrabench::cross {
namespace {

constexpr Knob kPixels{"error", "px", 0.1, 1000, 1}, kFineness{"size", "", 65536, 1.0 / 64, 1},
    kSamples{"window", "samples", 4095, 15, 255, true};

// Visibility of so many frames exceeds memory: an error before any work.
TEST(Flight, RefusesMoreFramesThanMemoryHolds) {
  const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "endless_path.toml";
  write_file(path,
             std::string_view("kind = \"turn\"\nfield_of_view = 60\nscreen = [80, 60]\n"
                              "frames_per_second = 25\nspeed = 0.03\n"
                              "[[keyframe]]\nat = [10, 10]\nheading = 0\n[[keyframe]]\nheading = 360\n"));
  Progress silent;
  const Route route{"peak", path.string(), 4097, 300000, 1};
  try {
    const Flight flight(route, silent);
    ADD_FAILURE() << "1.2 TB were allocated";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kEnvironment);
    EXPECT_THAT(error.what(), testing::HasSubstr("memory"));
    EXPECT_THAT(error.advice(), testing::HasSubstr("--set frames"));
  }
  std::filesystem::remove(path);
}

TEST(KnobSearch, ComesWithinSlackOfTheTargetInAFewTries) {
  const auto error_at = [](double knob) { return 0.3 * std::pow(knob, 0.8); };
  for (const double target : {0.3, 1.0, 2.0, 4.0, 40.0}) {
    int tried = 0;
    const Tuned tuned = search_knob(kPixels, target, [&](double knob) {
      ++tried;
      return error_at(knob);
    });
    EXPECT_TRUE(tuned.reached);
    EXPECT_LE(tuned.error, target);
    EXPECT_GE(tuned.error, (1 - kKnobSlack) * target);
    EXPECT_NEAR(tuned.error / error_at(tuned.knob), 1, 1e-9);
    EXPECT_LE(tried, 10) << target;
  }
}

TEST(KnobSearch, TurnsKnobsThatAreFineWhenTheyAreLarge) {
  const Tuned tuned = search_knob(kFineness, 1, [](double knob) { return 50 / knob; });
  EXPECT_TRUE(tuned.reached);
  EXPECT_NEAR(tuned.knob, 50, 2);
}

TEST(KnobSearch, WholeKnobsEndAtTheNextNumber) {
  const Tuned tuned = search_knob(kSamples, 1, [](double knob) {
    EXPECT_EQ(knob, std::round(knob));
    return 20.5 / knob;
  });
  EXPECT_EQ(tuned.knob, 21);
}

// Interpolation may round to a number that was tried: the ones beside it are left.
TEST(KnobSearch, FindsTheBestWholeNumberWhereverItBegins) {
  for (double first = 4; first <= 64; ++first) {
    for (const double target : {4.2, 9.5, 17.82, 18.0, 40.9}) {
      int tried = 0;
      const Knob more{"columns", "", 4, 64, first, true}, fewer{"columns", "", 64, 4, first, true};
      const Tuned most = search_knob(more, target, [&](double knob) {
        ++tried;
        return knob;
      });
      EXPECT_EQ(most.knob, std::floor(target)) << "from " << first;
      const Tuned least = search_knob(fewer, 1 / target, [&](double knob) {
        ++tried;
        return 1 / knob;
      });
      EXPECT_EQ(least.knob, std::ceil(target)) << "from " << first;
      EXPECT_LE(tried, 24) << "from " << first << " for " << target;
    }
  }
}

// Errors in steps, such as of files that consist of blocks: interpolation creeps, halving does not.
TEST(KnobSearch, DoesNotCreepAlongSteps) {
  int tried = 0;
  const Tuned tuned = search_knob(kPixels, 1, [&](double knob) {
    ++tried;
    return knob < 300 ? 0.7 : 1.001;
  });
  EXPECT_NEAR(tuned.knob, 300, 3);
  EXPECT_LE(tried, 18);
}

TEST(KnobSearch, SaysWhatCannotBeReached) {
  const Tuned worse = search_knob(kPixels, 1, [](double knob) { return 3 + knob; });
  EXPECT_FALSE(worse.reached);
  EXPECT_EQ(worse.knob, kPixels.finest);
  EXPECT_DOUBLE_EQ(worse.error, 3.1);
  // Flat ground: even the coarsest setting has less error than the target, so the target is not reached.
  const Tuned better = search_knob(kPixels, 1, [](double) { return 0.0; });
  EXPECT_FALSE(better.reached);
  EXPECT_EQ(better.knob, kPixels.coarsest);
}

TEST(KnobSearch, PassesOverSettingsThatAreRefused) {
  int tried = 0;
  const Tuned tuned = search_knob(kPixels, 4, [&](double knob) {
    ++tried;
    return knob > 0.7 ? HUGE_VAL : 0.3 * knob;
  });
  EXPECT_NEAR(tuned.knob, 0.7, 0.01);  // below the target, but nothing coarser is accepted
  EXPECT_TRUE(tuned.reached);
  EXPECT_LE(tried, 16);
}

TEST(KnobSearch, FindsTheFinestSettingThatIsNotRefused) {
  int tried = 0;
  double finest = HUGE_VAL;
  const Tuned tuned = search_knob(kPixels, 1, [&](double knob) {
    ++tried;
    if (knob < 5) return -HUGE_VAL;
    finest = std::min(finest, knob);
    return 0.3 * knob;  // at least 1.5
  });
  EXPECT_FALSE(tuned.reached);
  EXPECT_GE(finest, 5);
  EXPECT_LE(finest, 5.05);
  EXPECT_LE(tried, 16);
}

TEST(ConfiguredMethod, TakesItsOwnOptionsAndRefusesGarbage) {
  const ConfiguredMethod area = configured("mrbsp", "geomipmap.patch=32,mrbsp.threshold=area,mrbsp.depth=7");
  EXPECT_EQ(area.options.text("threshold"), "area");
  EXPECT_EQ(area.options.integer("depth"), 7);
  EXPECT_EQ(configured("roam", "geomipmap.patch=32").type->name, "roam");
  for (const char* const bad :
       {"patch=32", "mrbps.depth=7", "mrbsp.depht=7", "mrbsp.depth", "mrbsp.depth=x", "."}) {
    EXPECT_THROW(configured("mrbsp", bad), Error) << bad;
  }
  EXPECT_THROW(configured("mrpsb", ""), Error);
}

TEST(TuneTo, GivesTheSameWhateverWasTunedBefore) {
  Progress progress;
  const Route route{"fractal", "low", 65, 6, 1};
  const ConfiguredMethod method = configured("mrbsp", "");
  Flight first(route, progress), second(route, progress);
  for (const double pixels : {1.0, 2.0}) tune_to(first, method, pixels, progress);
  tune_to(first, configured("mrbsp", "mrbsp.threshold=area"), 4, progress);
  EXPECT_EQ(tune_to(first, method, 4, progress).knob, tune_to(second, method, 4, progress).knob);
}

TEST(EqualErrorCases, NameEveryMethodOnEveryGroundAndTheTablesShowThem) {
  std::set<std::string> names;
  RunOptions options;
  options.profile = Profile::kPaper;
  for (const Case& at : experiment("cross.lod-equal-error").cases(options)) names.insert(at.name);
  for (const char* const ground : {"jacksboro", "helens", "maine", "fractal", "peak"}) {
    for (const Entrant& entrant : entrants()) {
      const std::string start =
          std::string(ground) + "/" + entrant.name + (entrant.method == "brute_force" ? "" : "/");
      EXPECT_EQ(
          std::count_if(names.begin(), names.end(), [&](const auto& n) { return n.starts_with(start); }),
          configured(entrant.method, entrant.options).tunable() ? 3 : 1);
    }
  }
  std::size_t tables = 0;
  for (const Paper& paper : papers()) {
    for (const TableLayout& table : paper.tables) {
      if (table.experiment != "cross.lod-equal-error") continue;
      ++tables;
      EXPECT_EQ(table.rows.size(), entrants().size());
    }
  }
  EXPECT_EQ(tables, 15U);
}

class EqualError : public ::testing::TestWithParam<std::string_view> {
 protected:
  static Record measure(std::string_view method, std::int64_t size) {
    const Experiment& compared = experiment("cross.lod-equal-error");
    const Case at{
        "small",
        {compared.parameters,
         {{"method", std::string(method)}, {"error", 2.0}, {"frames", std::int64_t{5}}, {"size", size}}},
        "peak"};
    Record record;
    Recorder recorder(record, "unused");
    Progress progress;
    compared.measure(at, {}, recorder, progress);
    return record;
  }
};

TEST_P(EqualError, MeasuresWhatTheTablesShow) {
  const Record record = measure(GetParam(), 65);
  for (const char* const metric :
       {"knob", "triangles", "error_mean", "error_largest", "popping_p99", "popping_largest", "update_time",
        "update_time_p99", "uploaded", "frame_time", "ssim"}) {
    EXPECT_GE(value(record, metric), 0) << metric;
  }
  EXPECT_EQ(value(record, "reached"), 1);
  EXPECT_LE(value(record, "error_of_asked"), 1.1);
  EXPECT_GT(value(record, "triangles"), 0);
  EXPECT_GT(value(record, "samples"), 0);
  EXPECT_EQ(value(record, "cracks") == 0, lod(GetParam()).traits.conforming);
  EXPECT_EQ(value(record, "undrawn_samples"), 0);
  EXPECT_EQ(value(record, "bytes_held"), value(record, "heap_growth"));
  EXPECT_GT(value(record, "ssim"), GetParam() == "brute_force" ? 0.9999 : 0.3);
  if (lod(GetParam()).traits.bounds_error) {
    EXPECT_LE(value(record, "bound_taken"), 1);
  }
}

TEST_P(EqualError, CountsAreTheSameForAnyNumberOfThreads) {
  const auto counts = [](int threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    Progress progress;
    // Another route in between, so that the flight of the previous measurement is not reused.
    flight_along({"peak", "fly", 17, 2, 1}, progress);
    std::vector<Metric> exact = measure(GetParam(), 33).metrics;
    std::erase_if(exact, [](const Metric& m) { return timed(m); });
    return exact;
  };
  const std::vector<Metric> one = counts(1), four = counts(4);
  ASSERT_EQ(one.size(), four.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].name, four[i].name);
    EXPECT_EQ(one[i].samples, four[i].samples) << one[i].name;
  }
}

std::vector<std::string_view> names() {
  std::vector<std::string_view> all;
  for (const LodType& type : lods()) all.push_back(type.name);
  return all;
}
INSTANTIATE_TEST_SUITE_P(EachMethod, EqualError, ::testing::ValuesIn(names()),
                         [](const auto& info) { return std::string(info.param); });

TEST(EqualErrorGround, ThePeakStandsOnFlatLand) {
  const TerrainSource source = open_ground("peak", 257, 1);
  const Heightfield& ground = *source.heights;
  EXPECT_EQ(ground.at(0, 0), 0);
  EXPECT_EQ(ground.at(256, 128), 0);
  const HeightRange range = height_range(ground);
  EXPECT_EQ(ground.at(128, 128), range.highest);
  EXPECT_EQ(range.lowest, 0);
  const auto flat = std::count(ground.heights.begin(), ground.heights.end(), 0.0F);
  EXPECT_GT(static_cast<double>(flat), 0.5 * static_cast<double>(ground.heights.size()));
}

}  // namespace
}  // namespace terrabench::cross
