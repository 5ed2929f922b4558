#include "viewer/script.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <iterator>
#include <sstream>
#include <utility>

#include "lod/camera/camera_path.h"
#include "terrain/error.h"
#include "terrain/number.h"

namespace terrabench::viewer {
namespace {

struct Form {
  std::string_view name, arguments;
  std::size_t least, most;  // numbers of arguments
};
constexpr Form kForms[] = {
    {"wait", "", 0, 0},
    {"frames", "COUNT", 1, 1},
    {"key", "NAME [FRAMES]", 1, 2},
    {"move", "X Y", 2, 2},
    {"drag", "X0 Y0 X1 Y1 FRAMES", 5, 5},
    {"scroll", "STEPS", 1, 1},
    {"resize", "WIDTH HEIGHT", 2, 2},
    {"drop", "FILE", 1, 1},
    {"method", "SIDE NAME", 2, 2},
    {"knob", "SIDE VALUE", 2, 2},
    {"equal", "PIXELS", 1, 1},
    {"split", "SHARE", 1, 1},
    {"eye", "X Y Z HEADING PITCH", 5, 5},
    {"play", "PATH", 1, 1},
    {"picture", "FILE [WIDTH HEIGHT]", 1, 3},
};

constexpr std::pair<std::string_view, int> kKeys[] = {{"Left", GLFW_KEY_LEFT},
                                                      {"Right", GLFW_KEY_RIGHT},
                                                      {"Up", GLFW_KEY_UP},
                                                      {"Down", GLFW_KEY_DOWN},
                                                      {"Shift", GLFW_KEY_LEFT_SHIFT}};

// Of the bindings, of those above, and letters.
int key_number(std::string_view name) {
  for (const Binding& one : bindings()) {
    if (one.name == name) return one.key;
  }
  for (const auto& [known, key] : kKeys) {
    if (known == name) return key;
  }
  return name.size() == 1 && name[0] >= 'A' && name[0] <= 'Z' ? name[0] : 0;
}

WindowEvent moved(const glm::dvec2& to) { return {.kind = WindowEvent::Kind::kMove, .at = to}; }
WindowEvent button(bool down) { return {.kind = WindowEvent::Kind::kButton, .code = 0, .down = down}; }

}  // namespace

Script::Script(std::string_view text, const std::string& origin) : origin_(origin) {
  std::istringstream lines{std::string(text)};
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    std::istringstream words(line.substr(0, line.find('#')));
    Command command{{std::istream_iterator<std::string>(words), {}}, number};
    if (command.words.empty()) continue;
    check(command);
    commands_.push_back(std::move(command));
  }
}

void Script::fail(const Command& command, std::string_view what) const {
  throw bad_input(what, fmt::format("{}:{}", origin_, command.line), "correct the script (docs/view.md)");
}

void Script::check(const Command& command) const {
  std::vector<std::string_view> known;
  for (const Form& form : kForms) {
    known.push_back(form.name);
    if (form.name != command.words[0]) continue;
    const std::size_t given = command.words.size() - 1;
    if (given >= form.least && given <= form.most) return;
    fail(command, fmt::format("expected: {} {}", form.name, form.arguments));
  }
  fail(command, unknown_name("command", command.words[0], known).what());
}

double Script::number(const Command& command, std::size_t word) const {
  const auto value = parse_number<double>(command.words[word]);
  if (!value || !std::isfinite(*value)) fail(command, fmt::format("'{}' is no number", command.words[word]));
  return *value;
}

void Script::pass(const Command& command, std::size_t word) {
  frames_ = static_cast<int>(std::clamp(number(command, word), 1.0, 1e6));
}

void Script::press(const Command& command, std::vector<WindowEvent>& events) {
  const int key = key_number(command.words[1]);
  if (key == 0) fail(command, fmt::format("unknown key '{}'", command.words[1]));
  events.push_back({.kind = WindowEvent::Kind::kKey, .code = key, .down = true});
  at_end_ = {{.kind = WindowEvent::Kind::kKey, .code = key, .down = false}};
  frames_ = 1;
  if (command.words.size() > 2) pass(command, 2);
}

void Script::drag(const Command& command, std::vector<WindowEvent>& events) {
  mouse_ = {number(command, 1), number(command, 2)};
  pass(command, 5);
  by_ = (glm::dvec2(number(command, 3), number(command, 4)) - mouse_) / static_cast<double>(frames_);
  events.push_back(moved(mouse_));
  press_ = true;
  at_end_ = {button(false)};
}

std::vector<WindowEvent> Script::step(Window& window, Session& session, Controls& controls) {
  std::vector<WindowEvent> events;
  if (press_) {
    press_ = false;
    return {button(true)};
  }
  if (frames_ > 0) {
    if (by_ != glm::dvec2(0)) events.push_back(moved(mouse_ += by_));
    if (--frames_ == 0) {
      events.insert(events.end(), at_end_.begin(), at_end_.end());
      at_end_.clear();
      by_ = {0, 0};
    }
    return events;
  }
  // What takes no time happens before the same frame.
  while (next_ < commands_.size() && frames_ == 0) {
    const Command& command = commands_[next_];
    if (session.working() && command.words[0] == "wait") return events;
    ++next_;
    act(command, window, session, controls, events);
    if (command.words[0] == "wait") return events;  // what was built is drawn first
  }
  return events;
}

// Those that are events, or pass time.
void Script::act(const Command& command, Window& window, Session& session, Controls& controls,
                 std::vector<WindowEvent>& events) {
  const std::string& what = command.words[0];
  if (what == "frames") {
    pass(command, 1);
  } else if (what == "key") {
    press(command, events);
  } else if (what == "move") {
    events.push_back(moved({number(command, 1), number(command, 2)}));
    frames_ = 1;
  } else if (what == "drag") {
    drag(command, events);
  } else if (what == "scroll") {
    events.push_back({.kind = WindowEvent::Kind::kScroll, .at = {0, number(command, 1)}});
    frames_ = 1;
  } else if (what == "resize") {
    window.resize({static_cast<int>(number(command, 1)), static_cast<int>(number(command, 2))});
    frames_ = 2;
  } else if (what == "drop") {
    events.push_back({.kind = WindowEvent::Kind::kDrop, .files = {command.words[1]}});
    frames_ = 1;
  } else if (what != "wait") {
    if (!session.ready()) fail(command, "there is no ground yet: put `wait` before it");
    set(command, session, controls);
  }
}

void Script::set(const Command& command, Session& session, Controls& controls) {
  const std::string& what = command.words[0];
  const auto side = [&] {
    const double at = number(command, 1);
    if (at != 0 && at != 1) fail(command, "the side is 0 or 1");
    return static_cast<int>(at);
  };
  if (what == "method") {
    session.show_method(side(), command.words[2]);
  } else if (what == "knob") {
    if (side() >= session.sides()) fail(command, "there is no second method yet");
    session.tune(side(), number(command, 2));
  } else if (what == "equal") {
    controls.pixels = number(command, 1);
    perform(Action::kEqualise, session, controls);
  } else if (what == "split") {
    session.look.split = std::clamp(static_cast<float>(number(command, 1)), 0.0F, 1.0F);
  } else if (what == "eye") {
    session.camera.place({number(command, 1), number(command, 2), number(command, 3)}, number(command, 4),
                         number(command, 5));
  } else if (what == "play") {
    controls.path = open_camera_path(command.words[1]);
    session.play(controls.path);
  } else {
    const bool sized = command.words.size() == 4;
    const glm::ivec2 size = sized ? glm::ivec2(number(command, 2), number(command, 3)) : controls.window;
    write_picture_of(session, command.words[1], size, 1);
  }
}

}  // namespace terrabench::viewer
