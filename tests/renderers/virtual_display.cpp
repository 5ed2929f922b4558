#include "tests/renderers/virtual_display.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <string>

namespace terrabench {
namespace {

// The number of the display that Xvfb chose, as it writes it; empty if it did not start.
std::string start_xvfb() {
  std::array<int, 2> pipes{};
  if (pipe(pipes.data()) != 0) return "";
  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(1);
    const int nowhere = open("/dev/null", O_WRONLY);  // for the warnings of the keyboard compiler
    dup2(nowhere, 2);
    dup2(pipes[1], 3);
    execlp("Xvfb", "Xvfb", "-displayfd", "3", "-screen", "0", "640x480x24", "-nolisten", "tcp",
           static_cast<char*>(nullptr));
    _exit(1);
  }
  close(pipes[1]);
  std::string number;
  pollfd ready{pipes[0], POLLIN, 0};
  std::array<char, 16> text{};
  while (number.find('\n') == std::string::npos && poll(&ready, 1, 60'000) > 0) {
    const ssize_t count = read(pipes[0], text.data(), text.size());
    if (count <= 0) return "";  // Xvfb is not installed, or it ended
    number.append(text.data(), static_cast<std::size_t>(count));
  }
  close(pipes[0]);
  number.erase(number.find('\n') == std::string::npos ? 0 : number.find('\n'));
  return number;
}

}  // namespace

bool start_virtual_display() {
  static const std::string number = start_xvfb();
  if (number.empty()) {
    ADD_FAILURE() << "Xvfb does not start: install Debian's package xvfb";
    return false;
  }
  setenv("DISPLAY", (":" + number).c_str(), 1);
  return true;
}

Rgb pixel_on_display(int x, int y) {
  // Loaded here: the macros of Xlib's header break GoogleTest's.
  void* const library = dlopen("libX11.so.6", RTLD_NOW | RTLD_LOCAL);
  const auto function = [&](auto* type, const char* name) {
    return reinterpret_cast<decltype(type)>(dlsym(library, name));
  };
  const auto open_display = function(static_cast<void* (*)(const char*)>(nullptr), "XOpenDisplay");
  const auto root = function(static_cast<unsigned long (*)(void*)>(nullptr), "XDefaultRootWindow");
  const auto get_image = function(
      static_cast<void* (*)(void*, unsigned long, int, int, unsigned, unsigned, unsigned long, int)>(nullptr),
      "XGetImage");
  const auto get_pixel = function(static_cast<unsigned long (*)(void*, int, int)>(nullptr), "XGetPixel");
  const auto destroy = function(static_cast<int (*)(void*)>(nullptr), "XDestroyImage");
  const auto close_display = function(static_cast<int (*)(void*)>(nullptr), "XCloseDisplay");
  void* const display = open_display(nullptr);
  constexpr int kZPixmap = 2;
  void* const image = get_image(display, root(display), x, y, 1, 1, ~0UL, kZPixmap);
  const unsigned long pixel = get_pixel(image, 0, 0);
  destroy(image);
  close_display(display);
  return {static_cast<std::uint8_t>(pixel >> 16), static_cast<std::uint8_t>(pixel >> 8),
          static_cast<std::uint8_t>(pixel)};
}

}  // namespace terrabench
