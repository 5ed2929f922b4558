#include "experiments/processes.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <set>
#include <system_error>

#include "terrain/error.h"
#include "terrain/files.h"
#include "terrain/progress.h"

namespace terrabench {
namespace {

using ::testing::HasSubstr;

void none_dies(std::size_t task, const std::string& how) { ADD_FAILURE() << task << ": " << how; }

class Processes : public ::testing::Test {
 protected:
  Processes() {
    std::string name = (std::filesystem::temp_directory_path() / "terrabench_processes_XXXXXX").string();
    folder_ = mkdtemp(name.data());
  }
  ~Processes() override { std::filesystem::remove_all(folder_); }

  // Leaves a file that says which process did the task.
  void note(std::size_t task) const {
    write_file(folder_ / std::to_string(task), std::string_view(std::to_string(getpid())));
  }
  std::size_t noted() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder_), {}));
  }
  // The Error of 100 tasks in 3 processes, the 8th of which fails.
  Error error_of(const std::function<void()>& fail) const {
    try {
      run_in_processes(
          3, 100,
          [&](std::size_t i) {
            if (i == 7) fail();
            note(i);
            usleep(2000);
          },
          [](std::size_t i, const std::string& how) {
            throw bad_input(how, "task " + std::to_string(i), "");
          });
    } catch (const Error& error) {
      return error;
    }
    ADD_FAILURE() << "nothing was thrown";
    return usage_error("", "", "");
  }

  std::filesystem::path folder_;
};

TEST_F(Processes, DoEveryTaskOnceBesideEachOther) {
  run_in_processes(
      3, 20,
      [&](std::size_t i) {
        ASSERT_FALSE(std::filesystem::exists(folder_ / std::to_string(i)));
        note(i);
        usleep(5000);
      },
      none_dies);
  EXPECT_EQ(noted(), 20U);
  std::set<std::string> processes;
  for (int i = 0; i < 20; ++i) processes.insert(read_file(folder_ / std::to_string(i)));
  EXPECT_EQ(processes.size(), 3U);
  EXPECT_EQ(processes.count(std::to_string(getpid())), 0U);
  run_in_processes(
      4, 0, [&](std::size_t i) { note(i); }, none_dies);
  EXPECT_EQ(noted(), 20U);
}

TEST_F(Processes, AnErrorOfATaskEndsTheRest) {
  const Error error = error_of([] { throw bad_input("the seventh is damaged", "file", "mend it"); });
  EXPECT_EQ(error.code(), ExitCode::kBadInput);
  EXPECT_STREQ(error.what(), "file: the seventh is damaged");
  EXPECT_EQ(error.advice(), "mend it");
  EXPECT_LT(noted(), 50U);
}

TEST_F(Processes, TheTasksOfKilledOnesAreNamedAndTheOthersDone) {
  for (const int jobs : {1, 3}) {
    std::vector<std::string> died;
    run_in_processes(
        jobs, 20,
        [&](std::size_t i) {
          if (i % 5 == 2) kill(getpid(), i == 2 ? SIGKILL : SIGSEGV);
          if (i == 19) _exit(3);
          note(i);
        },
        [&](std::size_t i, const std::string& how) { died.push_back(std::to_string(i) + " " + how); });
    EXPECT_THAT(died, ::testing::UnorderedElementsAre(
                          HasSubstr("2 the process was ended by signal 9 (Killed), as when memory runs out"),
                          HasSubstr("7 the process was ended by signal 11"), HasSubstr("12 the process"),
                          HasSubstr("17 the process"), HasSubstr("19 the process ended with exit status 3")));
    EXPECT_EQ(noted(), 15U);
    for (int i = 0; i < 20; ++i) std::filesystem::remove(folder_ / std::to_string(i));
  }
}

TEST_F(Processes, AnErrorAboutAKilledOneEndsTheRest) {
  const Error error = error_of([] { kill(getpid(), SIGKILL); });
  EXPECT_EQ(error.code(), ExitCode::kBadInput);
  EXPECT_THAT(error.what(), HasSubstr("task 7: the process was ended by signal 9"));
  EXPECT_LT(noted(), 50U);
}

// The program then ends with the code of a closed pipe.
TEST_F(Processes, ABrokenPipeStaysOne) {
  try {
    run_in_processes(
        1, 1,
        [](std::size_t) { throw std::system_error(std::make_error_code(std::errc::broken_pipe), "output"); },
        none_dies);
    FAIL() << "nothing was thrown";
  } catch (const std::system_error& error) {
    EXPECT_EQ(error.code(), std::errc::broken_pipe);
  }
}

TEST_F(Processes, ReturnText) {
  EXPECT_EQ(call_in_process([] { return std::to_string(getppid()); }), std::to_string(getpid()));
  EXPECT_EQ(call_in_process([] { return std::string(1000000, 'x'); }).size(), 1000000U);
  EXPECT_THROW(call_in_process([]() -> std::string { throw usage_error("no", "", ""); }), Error);
}

TEST_F(Processes, StopWithTheirGroupAndOutliveASecondSignal) {
  EXPECT_EQ(call_in_process([] { return std::to_string(getpgrp()); }), std::to_string(getpgrp()))
      << "what Ctrl-Z stops";
  const std::string seen = call_in_process([] {
    for (const int signal : {SIGINT, SIGTERM, SIGINT}) std::raise(signal);
    return std::string(Progress::interrupted() ? "interrupted" : "");
  });
  EXPECT_EQ(seen, "interrupted");
}

}  // namespace
}  // namespace terrabench
