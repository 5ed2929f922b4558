// Starts the program as a user does, in a folder of its own, for tests of exit codes, output and what is left
// on disk.
#pragma once

#include <gtest/gtest.h>
#include <sys/types.h>

#include <cstddef>
#include <filesystem>
#include <string>

namespace terrabench {

class CommandLine : public ::testing::Test {
 protected:
  CommandLine();
  ~CommandLine() override;

  struct Outcome {
    int code = -1;
    std::string text;  // standard output and standard error
  };

  // A shell command in which $T is the program; standard input is empty. start() does not wait for it.
  pid_t start(const std::string& command) const;
  Outcome wait(pid_t child) const;
  Outcome call(const std::string& command) const { return wait(start(command)); }

  std::size_t temporary_files() const;

  std::filesystem::path folder_;
};

}  // namespace terrabench
