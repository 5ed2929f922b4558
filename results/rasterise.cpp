#include "results/rasterise.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "terrain/error.h"
#include "terrain/files.h"
#include "terrain/image.h"

extern char** environ;

namespace terrabench {

void svg_to_png(const std::filesystem::path& svg, const std::filesystem::path& png, int width,
                Colours colours) {
  std::string program = "rsvg-convert", size = std::to_string(width), in = svg.string(), out = png.string();
  std::string width_option = "--width", output_option = "--output";
  char* const arguments[] = {program.data(), width_option.data(), size.data(), output_option.data(),
                             out.data(),     in.data(),           nullptr};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const int error = posix_spawnp(&child, program.c_str(), &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  int status = 0;
  if (error == 0) {
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
  }
  // A C library may report a missing program only as the child's exit status 127.
  if (error != 0 || (WIFEXITED(status) && WEXITSTATUS(status) == 127)) {
    throw environment_error(fmt::format("cannot be run: {}", std::strerror(error != 0 ? error : ENOENT)),
                            program, "install Debian's librsvg2-bin, which turns plots into PNG");
  }
  if (status == 0) {
    if (colours == Colours::kFew) write_png(png, with_few_colours(read_png(png)));
    return;
  }
  std::error_code ignored;
  std::filesystem::remove(png, ignored);
  throw environment_error(fmt::format("failed with status {}", status), program + " " + in,
                          "check the free space on the disk and the folder's permissions");
}

void svg_text_to_png(std::string_view svg, const std::filesystem::path& png, int width, Colours colours) {
  const std::filesystem::path file = png.string() + fmt::format(".{}.tmp", getpid());
  write_file(file, svg);
  std::error_code ignored;
  try {
    svg_to_png(file, png, width, colours);
  } catch (...) {
    std::filesystem::remove(file, ignored);
    throw;
  }
  std::filesystem::remove(file, ignored);
}

}  // namespace terrabench
