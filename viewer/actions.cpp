#include "viewer/actions.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "terrain/error.h"
#include "terrain/files.h"
#include "viewer/pick.h"

namespace terrabench::viewer {
namespace {

constexpr Binding kBindings[] = {
    {GLFW_KEY_1, "1", Action::kFly, "fly"},
    {GLFW_KEY_2, "2", Action::kWalk, "walk, 1.8 m above the ground"},
    {GLFW_KEY_3, "3", Action::kOrbit, "orbit the place in the middle"},
    {GLFW_KEY_4, "4", Action::kPlan, "plan, looking straight down"},
    {GLFW_KEY_HOME, "Home", Action::kHome, "back to the start"},
    {GLFW_KEY_M, "M", Action::kNextMethod, "next method"},
    {GLFW_KEY_B, "B", Action::kSecond, "a second method beside it, or one alone"},
    {GLFW_KEY_LEFT_BRACKET, "[", Action::kFiner, "finer"},
    {GLFW_KEY_RIGHT_BRACKET, "]", Action::kCoarser, "coarser"},
    {GLFW_KEY_T, "T", Action::kEqualise, "the same error for what is shown"},
    {GLFW_KEY_G, "G", Action::kWires, "wires"},
    {GLFW_KEY_L, "L", Action::kColours, "colours: heights, triangle size, error"},
    {GLFW_KEY_N, "N", Action::kLandscape, "landscape: materials, water, sky and shadows"},
    {GLFW_KEY_F, "F", Action::kFreeze, "freeze the triangles, and look from outside"},
    {GLFW_KEY_R, "R", Action::kRecord, "record a camera path, and end it"},
    {GLFW_KEY_P, "P", Action::kPlay, "play the last path, or stop"},
    {GLFW_KEY_X, "X", Action::kDig, "dig a sphere under the mouse"},
    {GLFW_KEY_C, "C", Action::kFill, "fill a sphere there"},
    {GLFW_KEY_Z, "Z", Action::kUndo, "take the last edit back"},
    {GLFW_KEY_F12, "F12", Action::kPicture, "picture at print size (174 mm, 300 dpi)"},
    {GLFW_KEY_H, "H", Action::kPanels, "hide or show the panels"},
    {GLFW_KEY_ESCAPE, "Esc", Action::kQuit, "close"},
};

constexpr double kKnobStep = 1.189207115002721;  // of a knob per key: a quarter octave

// In the working folder: path-1.toml, or the first number that is free.
std::string free_name(std::string_view stem, std::string_view extension) {
  for (int number = 1;; ++number) {
    std::string name = fmt::format("{}-{}{}", stem, number, extension);
    if (!std::filesystem::exists(name)) return name;
  }
}

void next_method(Session& session) {
  const std::vector<Method> all = methods();
  const auto at =
      std::ranges::find(all, session.side(0).method().name, [](const Method& one) { return one.name; });
  session.show_method(0, all[static_cast<std::size_t>(at - all.begin() + 1) % all.size()].name);
}

void second(Session& session) {
  if (session.sides() > 1) {
    session.close_second();
  } else {
    session.show_method(1, session.side(0).method().name == "geomipmap" ? "roam" : "geomipmap");
  }
}

void step_knobs(Session& session, bool finer) {
  for (int k = 0; k < session.sides(); ++k) {
    const Knob& knob = session.side(k).method().type->knob;
    const bool down = finer == (knob.finest < knob.coarsest);
    double value = session.side(k).knob() * (down ? 1 / kKnobStep : kKnobStep);
    if (knob.whole && std::round(value) == session.side(k).knob())
      value = session.side(k).knob() + (down ? -1 : 1);
    session.tune(k, value);
  }
}

void record(Session& session, Controls& controls) {
  if (!session.recorder.recording()) {
    session.recorder.begin(controls.window);
    session.message = "recording a path; R ends it";
    return;
  }
  const auto path = session.recorder.end();
  if (!path) {
    session.message = "nothing recorded: the eye did not move";
    return;
  }
  const std::string file = free_name("path", ".toml");
  write_file(file, to_toml(*path));
  controls.path = *path;
  session.message = fmt::format("{}: {} keyframes, for `run --set path={}` and `render --path {}`", file,
                                path->keyframes.size(), file, file);
  fmt::print("recorded    {}\n", file);
}

void stroke(Session& session, const Controls& controls, bool digs) {
  const Heightfield& ground = session.ground().heights;
  const double side = static_cast<double>(std::max(ground.extent_x(), ground.extent_z()));
  const auto at = pick(ground, session.view(controls.window), controls.mouse);
  if (at) session.edit({*at, controls.brush > 0 ? controls.brush : 0.02 * side, digs});
}

}  // namespace

std::span<const Binding> bindings() { return kBindings; }

glm::ivec2 print_size(glm::ivec2 window) {
  constexpr double kPixels = 174 / 25.4 * 300;
  const double tall = kPixels * window.y / std::max(1, window.x);
  return {static_cast<int>(std::lround(kPixels)),
          std::clamp(static_cast<int>(std::lround(tall)), 1, kLargestPictureSide)};
}

void write_picture_of(Session& session, const std::string& file, glm::ivec2 size, float scale) {
  const std::string command = session.command(size);
  write_picture(file, session.picture(size, scale));
  session.message = fmt::format("{}: {} × {} pixels", file, size.x, size.y);
  fmt::print("picture     {}\n", file);
  if (!command.empty()) fmt::print("the same    {} --out {}\n", command, file);
}

void perform(Action action, Session& session, Controls& controls) {
  if (action == Action::kQuit) controls.quit = true;
  if (action == Action::kPanels) controls.panels = !controls.panels;
  if (!session.ready()) return;
  switch (action) {
    case Action::kFly:
    case Action::kWalk:
    case Action::kOrbit:
    case Action::kPlan:
      return session.camera.set_motion(static_cast<Motion>(action));
    case Action::kHome:
      return session.camera.home();
    case Action::kNextMethod:
      return next_method(session);
    case Action::kSecond:
      return second(session);
    case Action::kFiner:
    case Action::kCoarser:
      return step_knobs(session, action == Action::kFiner);
    case Action::kEqualise:
      return session.equalise(controls.pixels);
    case Action::kWires:
      session.look.wires = !session.look.wires;
      return;
    case Action::kColours:
      session.look.colours = static_cast<Colours>((static_cast<int>(session.look.colours) + 1) % 3);
      return;
    case Action::kLandscape:
      session.look.landscape = !session.look.landscape;
      return;
    case Action::kFreeze:
      return session.freeze(!session.frozen());
    case Action::kRecord:
      return record(session, controls);
    case Action::kPlay:
      if (session.playing() || controls.path.keyframes.empty()) return session.stop();
      return session.play(controls.path);
    case Action::kDig:
    case Action::kFill:
      return stroke(session, controls, action == Action::kDig);
    case Action::kUndo:
      return session.undo();
    case Action::kPicture:
      return write_picture_of(
          session, free_name("view", ".png"), print_size(controls.window),
          static_cast<float>(print_size(controls.window).x) / static_cast<float>(controls.window.x));
    case Action::kPanels:
    case Action::kQuit:
      return;
  }
}

}  // namespace terrabench::viewer
