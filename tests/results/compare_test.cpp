#include "results/compare/compare.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "results/store/provenance.h"
#include "results/store/record_json.h"
#include "terrain/error.h"
#include "tests/results/fake_results.h"
#include "tests/terrain/errors.h"

namespace terrabench {
namespace {

using testing::HasSubstr;

class CompareTest : public FolderTest {
 protected:
  void write(const std::string& name, const std::vector<Metric>& metrics, std::uint64_t seed = 1,
             const Provenance& run = fake_provenance()) {
    Store store(folder_ / name);
    store.begin_run(run);
    Record record = fake_record(run, "e", "c");
    record.metrics = metrics;
    record.seed = seed;
    store.append(record);
  }
  Change change(const Metric& before, const Metric& after) {
    std::filesystem::remove_all(folder_ / "a");
    std::filesystem::remove_all(folder_ / "b");
    write("a", {before});
    write("b", {after});
    return compare(folder_ / "a", folder_ / "b").metrics.at(0).change;
  }
};

TEST_F(CompareTest, ExactMetricsMustBeEqual) {
  EXPECT_EQ(change({"bytes", "B", {100}}, {"bytes", "B", {100}}), Change::kSame);
  EXPECT_EQ(change({"bytes", "B", {100}}, {"bytes", "B", {101}}), Change::kDiffers);
  EXPECT_EQ(change({"bytes", "B", {1e9}}, {"bytes", "B", {1e9 + 1}}), Change::kDiffers);
  EXPECT_EQ(change({"cells", "", {100000}}, {"cells", "", {100001}}), Change::kDiffers);
  EXPECT_EQ(change({"bytes", "B", {100}}, {"bytes", "KiB", {100}}), Change::kDiffers);
}

TEST_F(CompareTest, TimingsChangeOnlyBeyondTheirNoise) {
  const Metric base{"t", "s", {1.0, 1.1, 0.9, 1.05, 0.95}}, noisy{"t", "s", {1.02, 1.12, 0.88, 1.0, 1.01}},
      slow{"t", "s", {2.0, 2.1, 1.9, 2.05, 1.95}};
  EXPECT_EQ(change(base, noisy), Change::kSame);
  EXPECT_EQ(change(base, slow), Change::kRose);
  EXPECT_EQ(change(slow, base), Change::kFell);
  EXPECT_EQ(change(base, {"t", "s", {7.0}}), Change::kUnresolved);
  EXPECT_EQ(change({"t", "s", {0, 0, 0}}, base), Change::kUnresolved);
  EXPECT_EQ(change({"faults", "faults", {0, 5, 5}}, {"faults", "faults", {0, 50, 50}}), Change::kUnresolved);
  EXPECT_EQ(change({"t", "s", {1, 1.5, 1.8}}, {"t", "s", {1, 1.5, 1.8}}), Change::kSame)
      << "from 0.56 to 1.8";
  EXPECT_EQ(change({"t", "s", {1, 1.5, 2.2}}, {"t", "s", {1, 1.5, 2.2}}), Change::kUnresolved)
      << "from 0.45 to 2.2";
  EXPECT_EQ(change({"t", "s", {1, 1.1}}, {"t", "s", {3, 3.1}}), Change::kUnresolved) << "two samples of each";
}

TEST_F(CompareTest, RatiosOfTimesAreComparedAsTimes) {
  const Metric varying{"share", "", {0.5, 0.51, 0.49}, true}, plain{"share", "", {0.5, 0.51, 0.49}};
  EXPECT_EQ(change(varying, {"share", "", {0.505, 0.5, 0.495}, true}), Change::kSame);
  EXPECT_EQ(change(varying, {"share", "", {0.7, 0.71, 0.72}, true}), Change::kRose);
  EXPECT_EQ(change(varying, {"share", "", {0.7}, true}), Change::kUnresolved);
  EXPECT_EQ(change(plain, {"share", "", {0.505, 0.5, 0.495}, true}), Change::kSame) << "an older run";
  EXPECT_EQ(change(plain, {"share", "", {0.505, 0.5, 0.495}}), Change::kDiffers);
}

// 41 times whose logarithms changed by -0.2 to 0.2, evenly, and one that tripled.
TEST_F(CompareTest, WhatMostTimesDoIsNoise) {
  const std::vector<double> samples{1, 1.001, 0.999};
  std::vector<Metric> before, after;
  const auto add_time = [&](const std::string& name, double factor) {
    before.push_back({name, "s", samples});
    Metric& changed = after.emplace_back(before.back());
    for (double& sample : changed.samples) sample *= factor;
  };
  for (int k = -20; k <= 20; ++k) add_time(std::to_string(k), std::exp(0.01 * k + 1e-6));  // none stays equal
  add_time("tripled", 3);
  write("a", before);
  write("b", after);
  const Comparison c = compare(folder_ / "a", folder_ / "b");
  EXPECT_EQ(c.noise.timings, 42U);
  EXPECT_NEAR(c.noise.deviation, std::exp(1.4826 * 0.105), 0.01);
  EXPECT_EQ(c.count(Change::kSame), 41U);
  EXPECT_EQ(c.metrics.back().change, Change::kRose);
  const std::string text = compare_text(c, false);
  EXPECT_THAT(text,
              HasSubstr("42 times: median ratio × 1.005; noise from × 0.627 to × 1.595, three deviations "
                        "of × 1.168"));
  before.resize(Noise::kLeast - 1);
  after.resize(Noise::kLeast - 1);
  write("few-a", before);
  write("few-b", after);
  EXPECT_EQ(compare(folder_ / "few-a", folder_ / "few-b").count(Change::kFell), Noise::kLeast - 1);
}

// Experiment e: of each of 25 cases the time "quiet" changes by -1 to 1 % and "noisy" by -20 to 20 %; of a
// further case both change by 10 %. Experiment f: 21 times of different names change by -5 to 5 %, one by 20
// %. Experiment g: one time changes by 50 %.
class AlikeTimes : public CompareTest {
 protected:
  Comparison compared() {
    write_run("a", false);
    write_run("b", true);
    return compare(folder_ / "a", folder_ / "b");
  }
  static Metric time(const std::string& name, double factor) {
    return {name, "s", {factor, 1.0001 * factor, 0.9999 * factor}};
  }

 private:
  void write_run(const std::string& folder, bool later) {
    Store store(folder_ / folder);
    const Provenance run = fake_provenance();
    store.begin_run(run);
    const auto factor = [&](double log) { return later ? std::exp(log) : 1; };
    for (int k = -12; k <= 13; ++k) {
      Record record = fake_record(run, "e", "n=" + std::to_string(k));
      for (const auto& [name, range] : {std::pair{"quiet", 0.01}, std::pair{"noisy", 0.2}})
        record.metrics.push_back(time(name, factor(k == 13 ? 0.1 : range * k / 12)));
      store.append(record);
    }
    Record f = fake_record(run, "f", "c");
    for (int k = -10; k <= 10; ++k) f.metrics.push_back(time(std::to_string(k), factor(0.005 * k)));
    f.metrics.push_back(time("slower", factor(0.2)));
    store.append(f);
    Record g = fake_record(run, "g", "c");
    g.metrics = {time("t", factor(0.5)), {"bytes", "B", {7}}};
    store.append(g);
  }
};

TEST_F(AlikeTimes, ShareTheirNoise) {
  const Comparison c = compared();
  ASSERT_EQ(c.noises.size(), 3U) << "e's two metrics and f; all of e's times have one by metric";
  const Noise &noisy = c.noises[0], &quiet = c.noises[1], &f = c.noises[2];
  EXPECT_EQ(noisy.metric + quiet.metric + f.metric, "noisyquiet");
  EXPECT_EQ(quiet.timings, 25U) << "one has not changed at all";
  EXPECT_EQ(quiet.users, 26U);
  EXPECT_EQ(f.users, 22U);
  EXPECT_EQ(c.noise.timings, 25U + 25U + 21U + 1U);
  EXPECT_EQ(c.noise.users, 1U) << "g has too few times";
  std::vector<std::string> rose;
  for (const MetricChange& m : c.metrics) {
    if (m.change == Change::kRose) rose.push_back(m.experiment + " " + m.metric + " " + m.case_name);
    if (m.experiment == "g" && m.timed) {
      EXPECT_EQ(m.threshold, c.noise.threshold);
    }
    if (m.metric == "quiet") {
      EXPECT_EQ(m.threshold, quiet.threshold);
    }
  }
  EXPECT_THAT(rose, testing::ElementsAre("e quiet n=13", "f slower c", "g t c"));
  EXPECT_EQ(c.count(Change::kFell), 0U);
}

TEST_F(AlikeTimes, AreListedWithTheirNoise) {
  const Comparison c = compared();
  const std::string text = compare_text(c, false);
  EXPECT_THAT(text, HasSubstr("; of these, instead:\n  e noisy "));
  EXPECT_THAT(text, HasSubstr(" 26 times: median ratio × 1.017; noise from × 0."));
  EXPECT_THAT(text, HasSubstr("\n  f, other metrics "));
  const auto json = nlohmann::json::parse(compare_json(c));
  EXPECT_EQ(json["noises"][1]["metric"], "quiet");
  EXPECT_EQ(json["noises"][1]["threshold"], c.noises[1].threshold);
  EXPECT_FALSE(json["noises"][2].contains("metric"));
  EXPECT_TRUE(json["metrics"][0]["timed"]);
  EXPECT_TRUE(json["metrics"][0].contains("threshold"));
  const auto& bytes = json["metrics"].back();
  EXPECT_EQ(bytes["metric"], "bytes");
  EXPECT_FALSE(bytes["timed"]);
  EXPECT_FALSE(bytes.contains("threshold"));
}

// Two runs, each with times that were measured twice. Between these measurements they rose by 9 to 11 %, but
// for the first three, by 90 %. Between the runs they changed by `shift`, and what was measured once by
// factors of its own.
class RepeatedTimes : public CompareTest {
 protected:
  static constexpr double kWithin = 0.1, kSpread = 0.01;  // logarithms
  static Metric once(const std::string& name, double factor) {
    return {name, "s", {factor, 1.0001 * factor, 0.9999 * factor}};
  }
  static Metric twice(const std::string& name, double factor, double change) {
    Metric metric = once(name, factor);
    for (const double sample : once(name, factor * change).samples) metric.samples.push_back(sample);
    metric.first_look = 3;
    return metric;
  }
  // Metrics of the one case of an experiment.
  struct Case {
    std::string experiment;
    std::vector<Metric> before, after;
    void add_once(const std::string& name, double factor) {
      before.push_back(once(name, 1));
      after.push_back(once(name, factor));
    }
  };
  static Case case_with(int count, double shift = 1.0001) {
    Case made{"e", {}, {}};
    for (int k = 0; k < count; ++k) {
      const double change = k < 3 ? 1.9 : std::exp(kWithin - kSpread + 2 * kSpread * k / (count - 1));
      made.before.push_back(twice("t" + std::to_string(k), 1, change));
      made.after.push_back(twice("t" + std::to_string(k), shift, change));
    }
    return made;
  }
  Comparison compared(const std::vector<Case>& cases) {
    const Provenance run = fake_provenance();
    for (const bool later : {false, true}) {
      const std::filesystem::path folder = folder_ / (later ? "b" : "a");
      std::filesystem::remove_all(folder);
      Store store(folder);
      store.begin_run(run);
      for (const Case& one : cases) {
        Record record = fake_record(run, one.experiment, "c");
        record.metrics = later ? one.after : one.before;
        store.append(record);
      }
    }
    return compare(folder_ / "a", folder_ / "b");
  }
};

// Of 600 repeats the 594th counts, and six rose by 90 %.
TEST_F(RepeatedTimes, AreNoiseButForTheFarthestOfAHundred) {
  Case e = case_with(300);
  for (const double factor : {1.1, 0.9, 1.13, 0.88}) e.add_once(std::to_string(factor), factor);
  const Comparison c = compared({e});
  ASSERT_EQ(c.noises.size(), 1U) << "of experiment e";
  const Noise& noise = c.noises[0];
  EXPECT_EQ(noise.timings, 304U);
  EXPECT_EQ(noise.repeats, 600U);
  EXPECT_EQ(noise.users, 304U);
  EXPECT_NEAR(std::log(noise.threshold), kWithin + kSpread, 1e-9);
  EXPECT_EQ(c.count(Change::kSame), 302U);
  EXPECT_EQ(c.metrics[302].change, Change::kRose);
  EXPECT_EQ(c.metrics[303].change, Change::kFell);
  EXPECT_THAT(compare_text(c, false), HasSubstr("304 times: median ratio × 1.000; noise from × 0.896 to × "
                                                "1.116, of 600 repeats"));
  const auto json = nlohmann::json::parse(compare_json(c));
  EXPECT_EQ(json["noises"][0]["repeats"], 600);
  EXPECT_EQ(json["noises"][0]["threshold"], noise.threshold);
  EXPECT_NEAR(compared({case_with(299)}).noise.threshold, 1.9, 1e-9) << "of 598 the 593rd";
}

TEST_F(RepeatedTimes, CountFromAHundredOn) {
  EXPECT_FALSE(compared({case_with(49)}).noise.by_repeats);
  const Comparison c = compared({case_with(50)});
  EXPECT_TRUE(c.noise.by_repeats);
  EXPECT_EQ(c.noise.repeats, 100U);
}

// Experiment f has 20 times of its own and no repeats, and g too few of both. Metric "own" of e has none
// either.
TEST_F(RepeatedTimes, OfTheExperimentCountBeforeDeviationsOfTheMetricAndThoseBeforeAllRepeats) {
  Case f{"f", {}, {}}, g{"g", {}, {}}, e = case_with(60);
  for (int k = 0; k < 20; ++k) f.add_once(std::to_string(k), 1.001 + 0.001 * k);
  g.add_once("t", 1.5);
  e.add_once("own", 1.5);
  const Comparison c = compared({e, f, g});
  ASSERT_EQ(c.noises.size(), 2U);
  EXPECT_TRUE(c.noises[0].by_repeats);
  EXPECT_EQ(c.noises[0].users, 61U);
  EXPECT_FALSE(c.noises[1].by_repeats);
  EXPECT_EQ(c.noises[1].users, 20U);
  EXPECT_LT(c.noises[1].threshold, 1.05);
  EXPECT_TRUE(c.noise.by_repeats);
  EXPECT_EQ(c.noise.users, 1U) << "g's";
  EXPECT_EQ(c.metrics.back().threshold, c.noise.threshold);
}

TEST_F(RepeatedTimes, SayWhatAllOfThemShare) {
  const Comparison c = compared({case_with(100, 3)});
  EXPECT_EQ(c.count(Change::kRose), 100U);
  EXPECT_NEAR(c.noise.median, 3, 1e-9);
  const Comparison few = compared({case_with(10, 3)});
  EXPECT_NEAR(few.noise.median, 3, 1e-9);
  EXPECT_EQ(compare_text(few, false).find("median ratio"), std::string::npos) << "too few times";
  EXPECT_NEAR(nlohmann::json::parse(compare_json(few))["noise"]["median"], 3, 1e-9);
}

// Counters may be the same each time of one run.
TEST_F(RepeatedTimes, TellNothingIfTheyAreAllTheSame) {
  Case e{"e", {}, {}};
  for (int k = 0; k < 60; ++k) {
    e.before.push_back(twice(std::to_string(k), 1, 1));
    e.after.push_back(twice(std::to_string(k), 1 + 0.001 * k, 1));
  }
  const Comparison c = compared({e});
  EXPECT_EQ(c.noise.repeats, 118U) << "one is the same in both runs";
  EXPECT_FALSE(c.noise.by_repeats);
  EXPECT_GT(c.noise.threshold, 1);
}

TEST_F(RepeatedTimes, NeedThreeSamplesOfEachMeasurement) {
  const auto repeats = [&](std::vector<double> samples, std::size_t first_look) {
    const Metric metric{"t", "s", std::move(samples), false, first_look};
    return compared({Case{"e", {metric}, {metric}}}).metrics[0].repeats;
  };
  EXPECT_EQ(repeats({1, 1, 1, 2, 2, 2}, 3), (std::vector<double>{2, 2}));
  EXPECT_TRUE(repeats({1, 1, 1, 2, 2, 2}, 4).empty());
  EXPECT_TRUE(repeats({1, 1, 1, 2, 2, 2}, 2).empty());
  EXPECT_TRUE(repeats({1, 1, 1, 2, 2, 2}, 0).empty());
  EXPECT_TRUE(repeats({0, 0, 0, 1, 1, 1}, 3).empty());
  EXPECT_TRUE(repeats({1, 1, 1, 0, 0, 0}, 3).empty());
  EXPECT_TRUE(repeats({0, 0, 0, 0, 0, 0}, 3).empty());
}

// Counters of pages: most do not change at all, which is no estimate of how much the others may.
TEST_F(CompareTest, EqualSamplesTellNothingOfTheNoise) {
  std::vector<Metric> before, after;
  for (int k = 0; k < 40; ++k) {
    before.push_back({"t" + std::to_string(k), "s", {1, 1.001, 0.999}});
    after.push_back(before.back());
  }
  for (double& sample : after.back().samples) sample *= 1.01;
  write("a", before);
  write("b", after);
  const Comparison c = compare(folder_ / "a", folder_ / "b");
  EXPECT_EQ(c.noise.timings, 1U);
  EXPECT_EQ(c.count(Change::kRose), 1U) << "its interval alone decides";
  EXPECT_EQ(c.count(Change::kSame), 39U);
  EXPECT_FALSE(nlohmann::json::parse(compare_json(c))["noise"].contains("threshold"));
}

TEST_F(CompareTest, SaysWhatOnlyOneSideHasAndWhatWasMeasuredOnOtherGround) {
  write("a", {{"m", "B", {1}}, {"gone", "B", {2}}});
  write("b", {{"m", "B", {1}}, {"new", "B", {3}}}, 9);
  const Comparison c = compare(folder_ / "a", folder_ / "b");
  ASSERT_EQ(c.metrics.size(), 3U);
  EXPECT_EQ(c.metrics[1].change, Change::kOnlyBefore);
  EXPECT_EQ(c.metrics[2].change, Change::kOnlyAfter);
  EXPECT_FALSE(c.metrics[0].same_ground);
  EXPECT_TRUE(c.exact_equal());
  EXPECT_TRUE(c.passed());
  const std::string text = compare_text(c, false);
  EXPECT_THAT(text, HasSubstr("only before"));
  EXPECT_THAT(text, HasSubstr("seed, terrain or parameters differ"));
  const auto json = nlohmann::json::parse(compare_json(c));
  EXPECT_THAT(text, HasSubstr("1 same, 1 only before, 1 only after"));
  EXPECT_EQ(json["metrics"].size(), 3U);
  EXPECT_EQ(json["only_before"], 1);
  EXPECT_EQ(json["only_after"], 1);
  EXPECT_EQ(json["metrics"][2]["change"], "only after");
}

// The summary comes first; a line per metric only for what changed, or for all if asked.
TEST_F(CompareTest, ListsWhatChangedAndCountsTheRest) {
  write("a", {{"same", "B", {1}}, {"other", "B", {1}}, {"gone", "B", {2}}, {"lost", "B", {2}}});
  write("b", {{"same", "B", {1}}, {"other", "B", {2}}, {"new", "B", {3}}});
  const Comparison c = compare(folder_ / "a", folder_ / "b");
  EXPECT_EQ(compare_text(c, false),
            "1 same, 1 differs, 2 only before, 1 only after\n"
            "only before: e (quick), cases: 1, metrics: 2\n"
            "only after: e (quick), cases: 1, metrics: 1\n"
            "e c (quick)\n"
            "  * other                      differs      1 B → 2 B  × 2.0000\n");
  const std::string all = compare_text(c, false, true);
  EXPECT_THAT(all, testing::StartsWith("1 same, 1 differs, "));
  for (const MetricChange& m : c.metrics) EXPECT_THAT(all, HasSubstr(m.metric));
}

// Such as the reference, of profile paper, against a quick run.
TEST_F(CompareTest, NothingInCommonIsBadInput) {
  write_fake_results(folder_ / "a", "quick");
  write_fake_results(folder_ / "b", "paper");
  const Failure failure = failure_of([&] { compare(folder_ / "a", folder_ / "b"); });
  EXPECT_EQ(failure.code, ExitCode::kBadInput);
  EXPECT_THAT(failure.what, HasSubstr("nothing in common: quick against paper"));
  write("c", {{"m", "B", {1}}});
  write("d", {{"n", "B", {1}}});
  EXPECT_THAT(failure_of([&] { compare(folder_ / "c", folder_ / "d"); }).what,
              HasSubstr("nothing in common: both hold profile quick, but other cases"));
}

TEST_F(CompareTest, RatioToZeroIsStillJson) {
  write("a", {{"m", "", {0}}, {"t", "s", {0, 0}}});
  write("b", {{"m", "", {1}}, {"t", "s", {1, 1}}});
  const Comparison c = compare(folder_ / "a", folder_ / "b");
  EXPECT_FALSE(c.exact_equal());
  EXPECT_TRUE(nlohmann::json::accept(compare_json(c)));
}

TEST_F(CompareTest, RunAgainstItselfIsTheSame) {
  write_fake_results(folder_ / "a", "quick");
  const Comparison c = compare(folder_ / "a", folder_ / "a");
  EXPECT_GT(c.metrics.size(), 20U);
  for (const MetricChange& m : c.metrics) EXPECT_EQ(m.change, Change::kSame) << m.case_name << m.metric;
}

// Times of two machines say nothing about the code; exact figures must be the same on both.
TEST_F(CompareTest, ComparesExactFiguresAcrossMachinesAndTimesWithinOne) {
  const Metric fast{"t", "s", {1.0, 1.1, 0.9}}, slow{"t", "s", {2.0, 2.1, 1.9}};
  Provenance other = fake_provenance();
  other.cpu = "Another processor";
  other.id = digest(other);
  write("a", {{"bytes", "B", {100}}, {"error", "m", {0.5}}, fast});
  write("b", {{"bytes", "B", {100}}, {"error", "m", {0.75}}, slow}, 1, other);
  const Comparison c = compare(folder_ / "a", folder_ / "b");
  ASSERT_EQ(c.metrics.size(), 3U);
  EXPECT_EQ(c.metrics[0].change, Change::kSame);
  EXPECT_EQ(c.metrics[1].change, Change::kDiffers);
  EXPECT_EQ(c.metrics[2].change, Change::kElsewhere);
  EXPECT_FALSE(c.passed());
  const std::string text = compare_text(c, false);
  EXPECT_THAT(text, HasSubstr("differs between machines: e c error: 0.5 m on A processor <of & for> tests, 2 "
                              "threads, AVX2, llvmpipe; 0.75 m on Another processor, 2 threads"));
  EXPECT_THAT(text, HasSubstr("1 exact figures differ between machines"));
  const auto json = nlohmann::json::parse(compare_json(c));
  EXPECT_EQ(json["metrics"][1]["machines"][1], machine_name(other));
  EXPECT_EQ(json["metrics"][2]["change"], "elsewhere");
}

TEST_F(CompareTest, OtherCodeOnTheSameMachineIsCompared) {
  Provenance other = fake_provenance();
  other.git_revision = "fedcba";
  other.compiler = "Clang 15";
  other.id = digest(other);
  write("a", {{"t", "s", {1.0, 1.1, 0.9}}});
  write("b", {{"t", "s", {2.0, 2.1, 1.9}}}, 1, other);
  EXPECT_EQ(compare(folder_ / "a", folder_ / "b").metrics.at(0).change, Change::kRose);
  other.threads = 1;
  other.id = digest(other);
  write("c", {{"t", "s", {2.0, 2.1, 1.9}}}, 1, other);
  EXPECT_EQ(compare(folder_ / "a", folder_ / "c").metrics.at(0).change, Change::kElsewhere);
}

TEST_F(CompareTest, FaultsOfEitherSideAreSaidAndFail) {
  write("a", {{"m", "B", {1}}});
  write("b", {{"m", "B", {1}}});
  EXPECT_TRUE(compare(folder_ / "a", folder_ / "b").passed());
  edit(folder_ / "b/measurements.jsonl", "\"seed\":1", "\"seed\":2");
  for (const auto& [before, after] : {std::pair("a", "b"), std::pair("b", "a")}) {
    const Comparison c = compare(folder_ / before, folder_ / after);
    EXPECT_EQ(c.faults.size(), 1U);
    EXPECT_TRUE(c.exact_equal());
    EXPECT_FALSE(c.passed());
    EXPECT_THAT(compare_text(c, false), HasSubstr("altered"));
    EXPECT_EQ(nlohmann::json::parse(compare_json(c))["passed"], false);
  }
}

TEST_F(CompareTest, FolderWithoutResultsIsBadInput) {
  write("a", {{"m", "B", {1}}});
  EXPECT_THROW(compare(folder_ / "a", folder_ / "nothing"), Error);
}

}  // namespace
}  // namespace terrabench
