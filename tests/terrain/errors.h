// Runs a call that must fail and returns how it failed.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "terrain/error.h"

namespace terrabench {

struct Failure {
  ExitCode code = ExitCode::kGood;  // kGood: it did not fail
  std::string what, advice;
};

template <class Call>
Failure failure_of(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return {error.code(), error.what(), error.advice()};
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

}  // namespace terrabench
