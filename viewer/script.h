// A scripted session: a text file whose lines do what a user does, for tests and demonstrations.
// docs/view.md lists the commands. Time passes in steps of 1/60 s per frame, so that the same script moves
// the camera alike on any machine.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "renderers/window.h"
#include "viewer/actions.h"

namespace terrabench::viewer {

class Script {
 public:
  static constexpr double kStep = 1.0 / 60;  // seconds

  // Throws bad_input, naming the line, for a command that is unknown or has other arguments.
  Script(std::string_view text, const std::string& origin);

  // What happens before the next frame: does what is no event, and returns the events. Throws bad_input,
  // naming the line, for what cannot be done.
  std::vector<WindowEvent> step(Window&, Session&, Controls&);
  bool ended() const { return next_ == commands_.size() && frames_ == 0; }

 private:
  struct Command {
    std::vector<std::string> words;
    int line;
  };
  [[noreturn]] void fail(const Command&, std::string_view what) const;
  void check(const Command&) const;
  double number(const Command&, std::size_t word) const;
  void pass(const Command&, std::size_t word);
  void press(const Command&, std::vector<WindowEvent>&);
  void drag(const Command&, std::vector<WindowEvent>&);
  void act(const Command&, Window&, Session&, Controls&, std::vector<WindowEvent>&);
  void set(const Command&, Session&, Controls&);

  std::string origin_;
  std::vector<Command> commands_;
  std::size_t next_ = 0;
  int frames_ = 0;                   // still to pass before the next command
  std::vector<WindowEvent> at_end_;  // of these frames
  bool press_ = false;               // before them, once the mouse is there
  glm::dvec2 mouse_{0}, by_{0};      // pixels; by_: per frame of a drag
};

}  // namespace terrabench::viewer
