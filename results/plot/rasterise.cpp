#include "results/plot/rasterise.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <string>
#include <vector>

#include "terrain/files.h"
#include "terrain/machine_error.h"
#include "terrain/progress.h"
#include "terrain/temporary_name.h"

extern char** environ;

namespace terrabench {
namespace {

// Runs rsvg-convert with these arguments, its output thrown away. Throws MachineError unless it succeeds,
// Error(kInterrupted) if Ctrl-C ended it, which a terminal sends to it too.
void run_rsvg(std::vector<std::string> arguments) {
  std::string program = "rsvg-convert", epoch = "SOURCE_DATE_EPOCH=0";  // the date in a PDF
  std::vector<char*> argv = {program.data()}, variables = {epoch.data()};
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  for (char** variable = environ; *variable != nullptr; ++variable) variables.push_back(*variable);
  variables.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const int error = posix_spawnp(&child, program.c_str(), &actions, nullptr, argv.data(), variables.data());
  posix_spawn_file_actions_destroy(&actions);
  int status = 0;
  if (error == 0) {
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
  }
  // A C library may report a missing program only as the child's exit status 127.
  if (error != 0 || (WIFEXITED(status) && WEXITSTATUS(status) == 127)) {
    throw MachineError(fmt::format("cannot be run: {}", std::strerror(error != 0 ? error : ENOENT)), program,
                       "install Debian's librsvg2-bin, which turns plots into pictures and PDF");
  }
  const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  if (signal == SIGINT || signal == SIGTERM || (status != 0 && Progress::interrupted())) {
    throw Error(ExitCode::kInterrupted, "interrupted", program, "");
  }
  if (status != 0) {
    throw MachineError(fmt::format("failed with status {}", status), program + " " + arguments.back(),
                       "check the free space on the disk and the folder's permissions");
  }
}

// Runs `convert` on a file with this text, which is removed afterwards; so is `result` if it fails.
template <class Convert>
void with_svg_file(std::string_view svg, const std::filesystem::path& result, Convert convert) {
  const std::filesystem::path file = temporary_name(result);
  write_file(file, svg);
  std::error_code ignored;
  try {
    convert(file);
  } catch (...) {
    std::filesystem::remove(file, ignored);
    std::filesystem::remove(result, ignored);
    throw;
  }
  std::filesystem::remove(file, ignored);
}

}  // namespace

Image write_svg(std::string_view svg, const std::filesystem::path& picture, int width) {
  Image image;
  with_svg_file(svg, picture, [&](const std::filesystem::path& file) {
    run_rsvg({"--width", std::to_string(width), "--output", picture.string(), file.string()});
    image = read_picture(picture);  // still PNG, whatever its name
    write_picture(picture, image);
  });
  return image;
}

void svg_text_to_pdf(std::string_view svg, const std::filesystem::path& pdf, double millimetres) {
  with_svg_file(svg, pdf, [&](const std::filesystem::path& file) {
    run_rsvg({"--format", "pdf", "--width", fmt::format("{}mm", millimetres), "--keep-aspect-ratio",
              "--output", pdf.string(), file.string()});
  });
}

}  // namespace terrabench
