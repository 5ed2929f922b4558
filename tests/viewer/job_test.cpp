// Work beside the window: its result, its failure, its end.
#include "viewer/job.h"

#include <gtest/gtest.h>

#include "terrain/error.h"

namespace terrabench::viewer {
namespace {

void wait_for(Job& job) {
  while (!job.finish()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

TEST(Job, ItsResultIsTakenOverByTheCaller) {
  Job job;
  const std::thread::id here = std::this_thread::get_id();
  std::thread::id worked, taken;
  job.start("counting", [&](Progress&) -> Job::TakeOver {
    worked = std::this_thread::get_id();
    return [&] { taken = std::this_thread::get_id(); };
  });
  EXPECT_TRUE(job.running());
  EXPECT_EQ(job.state().what, "counting");
  wait_for(job);
  EXPECT_FALSE(job.running());
  EXPECT_NE(worked, here);
  EXPECT_EQ(taken, here);
}

TEST(Job, ItsFailureReachesTheCaller) {
  Job job;
  job.start("failing", [](Progress&) -> Job::TakeOver { throw bad_input("damaged", "file", "mend it"); });
  EXPECT_THROW(wait_for(job), Error);
  EXPECT_FALSE(job.running());
}

TEST(Job, TellsHowFarItIs) {
  Job job;
  std::atomic<bool> seen{false};
  job.start("", [&](Progress& progress) -> Job::TakeOver {
    progress.begin("sampling", 1000000);
    while (!seen) {
      progress.advance();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return nullptr;
  });
  while (job.state().share == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_EQ(job.state().what, "sampling");
  seen = true;
  wait_for(job);
}

TEST(Job, CancelledWorkStopsAndIsForgotten) {
  Job job;
  bool taken = false;
  const auto endless = [&](Progress& progress) -> Job::TakeOver {
    progress.begin("working", 1);
    for (;;) progress.advance();
    return [&] { taken = true; };
  };
  job.start("", endless);
  job.cancel();
  EXPECT_FALSE(job.running());
  EXPECT_FALSE(job.finish());
  EXPECT_FALSE(Progress::interrupted());
  job.start("", endless);
  job.start("", [](Progress&) -> Job::TakeOver { return nullptr; });  // cancels the one before
  wait_for(job);
  EXPECT_FALSE(taken);
}

}  // namespace
}  // namespace terrabench::viewer
