#include "terrain/progress.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <thread>

#include "terrain/progress_listener.h"
#include "tests/terrain/errors.h"

namespace terrabench {
namespace {

using testing::HasSubstr;

// The flag belongs to the process: no test may leave it set.
class ProgressTest : public testing::Test {
 protected:
  void TearDown() override { Progress::clear_interrupt(); }
};

TEST_F(ProgressTest, InterruptReachesWhoeverWorks) {
  Progress progress;
  progress.begin("counting", 10);
  EXPECT_NO_THROW(progress.advance());
  Progress::interrupt();
  const Failure failure = failure_of([&] { progress.advance(); });
  EXPECT_EQ(failure.code, ExitCode::kInterrupted);
  EXPECT_THAT(failure.what, HasSubstr("counting"));
  Progress::clear_interrupt();
  EXPECT_NO_THROW(progress.advance());
}

TEST_F(ProgressTest, InterruptCancelsAParallelLoop) {
  Progress progress;
  progress.begin("looping", 1000000);
  std::atomic<int> done{0};
  const Failure failure = failure_of([&] {
    tbb::parallel_for(0, 1000000, [&](int) {
      if (++done == 100) Progress::interrupt();
      progress.advance();
    });
  });
  EXPECT_EQ(failure.code, ExitCode::kInterrupted);
  EXPECT_LT(done, 1000000);
}

TEST_F(ProgressTest, SilentSaysNothingAndTheTerminalShowsAnEstimate) {
  testing::internal::CaptureStderr();
  {
    Progress silent;
    silent.begin("quiet", 2);
    std::this_thread::sleep_for(std::chrono::milliseconds(120));
    silent.advance();
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  testing::internal::CaptureStderr();
  {
    Progress terminal(Progress::Output::kTerminal);
    terminal.begin("building", 4);
    std::this_thread::sleep_for(std::chrono::milliseconds(120));
    terminal.advance();
  }
  EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("building: 25 %, about 0 s left"));
}

TEST_F(ProgressTest, AListenerTakesTheTerminalsPlace) {
  std::string heard;
  double share = 0;
  listen_to_progress([&](std::string_view what, double done) {
    heard = what;
    share = done;
  });
  testing::internal::CaptureStderr();
  {
    Progress terminal(Progress::Output::kTerminal);
    terminal.begin("building", 4);
    std::this_thread::sleep_for(std::chrono::milliseconds(120));
    terminal.advance();
  }
  listen_to_progress(nullptr);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(heard, "building");
  EXPECT_EQ(share, 0.25);
}

}  // namespace
}  // namespace terrabench
