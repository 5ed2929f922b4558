#include "results/store/timing_conditions.h"

#include <gmock/gmock.h>

#include <sstream>

namespace terrabench {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// An idle machine of 8 processors, all allowed, and a release build.
TimingConditions good() {
  return {.build_type = "Release",
          .flags = "-O3 -DNDEBUG",
          .busy = 0.1,
          .processors = 8,
          .allowed_processors = 8,
          .quota = 0,
          .governor = ""};
}

TEST(TimingConditions, GoodOnesGiveNoWarning) {
  EXPECT_THAT(timing_warnings(good()), IsEmpty());
  TimingConditions pinned = good();
  pinned.allowed_processors = 2;
  pinned.quota = 2;
  EXPECT_THAT(timing_warnings(pinned), IsEmpty()) << "fewer processors, but whole ones";
}

TEST(TimingConditions, EachBadOneGivesItsWarning) {
  const auto warnings = [](auto change) {
    TimingConditions now = good();
    change(now);
    return timing_warnings(now);
  };
  EXPECT_THAT(warnings([](auto& now) { now.build_type = "Debug", now.flags = "-g"; }),
              ElementsAre(HasSubstr("this build (Debug) is not optimised")));
  EXPECT_THAT(warnings([](auto& now) { now.flags += " -fsanitize=address,undefined"; }),
              ElementsAre(HasSubstr("sanitizers")));
  EXPECT_THAT(warnings([](auto& now) { now.busy = 3.14; }),
              ElementsAre(HasSubstr("other work uses 3.1 of 8 processors")));
  EXPECT_THAT(warnings([](auto& now) { now.governor = "powersave"; }),
              ElementsAre(HasSubstr("governor 'powersave'")));
  EXPECT_THAT(warnings([](auto& now) { now.quota = 1.5; }), ElementsAre(HasSubstr("1.5 of 8 processors")));
  EXPECT_EQ(warnings([](auto& now) { now.busy = 8, now.quota = 1, now.governor = "ondemand"; }).size(), 3U);
}

TEST(TimingConditions, IdleProcessorsAndThoseThatWaitForADiskAreNotBusy) {
  std::istringstream stat("cpu  10 1 5 200 40 2 3 4 7 0\ncpu0 5 0 0 0 0 0 0 0 0 0\n"), other("intr 1 2");
  const ProcessorTicks ticks = read_ticks(stat), none = read_ticks(other);
  EXPECT_EQ(ticks.busy, 10 + 1 + 5 + 2 + 3 + 4);
  EXPECT_EQ(ticks.all, 25 + 240);
  EXPECT_EQ(none.all, 0);
}

TEST(TimingConditions, AreReadFromThisMachine) {
  const TimingConditions now = read_timing_conditions();
  EXPECT_FALSE(now.flags.empty());
  EXPECT_GE(now.processors, 1);
  EXPECT_GE(now.allowed_processors, 1);
  EXPECT_GE(now.busy, 0);
}

}  // namespace
}  // namespace terrabench
