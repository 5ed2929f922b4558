// The one exception type whose text the user sees. Thrown where input enters (files, options, OpenGL), caught
// once in main(). Inside algorithms a broken precondition is an assertion, not an Error.
#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace terrabench {

// The program's documented exit codes.
enum class ExitCode {
  kGood = 0,
  kClaimFallsShort = 1,  // a claim's verdict is not the known one, or exact figures differ
  kUsage = 2,            // invalid option, unknown name
  kBadInput = 3,         // a file is damaged, or its content is unusable
  kEnvironment = 4,      // no GL context, disk full, unwritable folder
  kInterrupted = 130,    // Ctrl-C or SIGTERM; what was measured so far is kept
};

class Error : public std::runtime_error {
 public:
  // `what` went wrong, `where` (a file, an option, a position; may be empty), and `advice` on what to do.
  Error(ExitCode code, std::string_view what, std::string_view where, std::string_view advice);

  ExitCode code() const { return code_; }
  const std::string& advice() const { return advice_; }

 private:
  ExitCode code_;
  std::string advice_;
};

Error usage_error(std::string_view what, std::string_view where, std::string_view advice);
Error bad_input(std::string_view what, std::string_view where, std::string_view advice);
Error environment_error(std::string_view what, std::string_view where, std::string_view advice);

// "unknown <kind> 'jaksboro'; did you mean 'jacksboro'?", with all known names as advice. The suggestion is
// the name at the least edit distance, given only when it is close enough to be a typing slip.
Error unknown_name(std::string_view kind, std::string_view name, std::span<const std::string_view> known);

// "invalid value 'sample' for 'visibility': expected off, sampled or conservative; did you mean 'sampled'?",
// the suggestion as above. `allowed` is not empty.
std::string invalid_value(std::string_view name, std::string_view value,
                          std::span<const std::string_view> allowed);
std::string alternatives(std::span<const std::string_view> words);  // "off, sampled or conservative"

}  // namespace terrabench
