#include "viewer/panels.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "lod/camera/camera_path.h"
#include "renderers/frame_renderer.h"
#include "terrain/error.h"

namespace terrabench::viewer {
namespace {

ImU32 ink(const Rgb& colour) { return IM_COL32(colour[0], colour[1], colour[2], 255); }

void text(const std::string& words) { ImGui::TextUnformatted(words.c_str()); }

// What goes wrong, such as a folder that takes no picture, is a message: between Begin and End nothing may
// throw.
template <class Work>
void attempt(Session& session, const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    session.message = error.what();
  }
}

void button(const char* name, Action action, Session& session, Controls& controls) {
  if (ImGui::Button(name)) attempt(session, [&] { perform(action, session, controls); });
}

// A bar of colours with words at its ends.
void legend(std::span<const Rgb> colours, const std::string& left, const std::string& right) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, each = width / static_cast<float>(colours.size());
  for (std::size_t k = 0; k < colours.size(); ++k) {
    const float x = at.x + static_cast<float>(k) * each;
    ImGui::GetWindowDrawList()->AddRectFilled({x, at.y}, {x + each, at.y + 10}, ink(colours[k]));
  }
  ImGui::Dummy({width, 10});
  text(left);
  ImGui::SameLine(std::max(0.0F, width - ImGui::CalcTextSize(right.c_str()).x));
  text(right);
}

void show_method(Session& session, int k) {
  Side& side = session.side(k);
  const Knob& knob = side.method().type->knob;
  ImGui::PushID(k);
  if (ImGui::BeginCombo("method", side.method().label.c_str())) {
    for (const Method& one : methods()) {
      if (ImGui::Selectable(one.label.c_str(), one.name == side.method().name))
        attempt(session, [&] { session.show_method(k, one.name); });
    }
    ImGui::EndCombo();
  }
  if (side.method().type->tunable()) {
    auto value = static_cast<float>(side.knob());
    const auto [low, high] = std::minmax(knob.finest, knob.coarsest);
    const std::string unit = fmt::format("%.{}f {}", knob.whole ? 0 : 3, knob.unit);
    const std::string name(knob.name);
    if (ImGui::SliderFloat(name.c_str(), &value, static_cast<float>(low), static_cast<float>(high),
                           unit.c_str(), ImGuiSliderFlags_Logarithmic))
      session.tune(k, static_cast<double>(value));
  }
  ImGui::PopID();
}

template <class Value>
void plot(const Side& side, const char* name, const char* format, const Value& of) {
  const std::vector<float> values = side.history().values(of);
  const float last = values.empty() ? 0 : values.back();
  const std::string words = fmt::format(fmt::runtime(format), last);
  const float most = values.empty() ? 1 : *std::ranges::max_element(values);
  ImGui::PlotLines(name, values.data(), static_cast<int>(values.size()), 0, words.c_str(), 0, 1.1F * most,
                   {0, 36});
}

void show_costs(Session& session, int k) {
  const Side& side = session.side(k);
  ImGui::PushID(k);
  if (session.sides() > 1) text(side.method().label);
  plot(side, "triangles", "{:.0f}", [](const FrameSample& s) { return s.triangles; });
  plot(side, "choose ms", "{:.2f}", [](const FrameSample& s) { return s.choose; });
  plot(side, "send ms", "{:.2f}", [](const FrameSample& s) { return s.send; });
  plot(side, "draw ms", "{:.2f}", [](const FrameSample& s) { return s.draw; });
  plot(side, "sent kB", "{:.1f}",
       [](const FrameSample& s) { return 1e-3 * static_cast<double>(s.bytes_sent); });
  plot(side, "memory MB", "{:.2f}",
       [](const FrameSample& s) { return 1e-6 * static_cast<double>(s.memory); });
  if (const Deviation* error = side.error())
    text(fmt::format("error: 99 % within {:.2f} px,\nlargest {:.2f} px", error->p99, error->largest));
  ImGui::PopID();
}

void show_colours(Session& session) {
  int chosen = static_cast<int>(session.look.colours);
  ImGui::RadioButton("heights", &chosen, 0);
  ImGui::SameLine();
  ImGui::RadioButton("triangle size", &chosen, 1);
  ImGui::SameLine();
  ImGui::RadioButton("error", &chosen, 2);
  session.look.colours = static_cast<Colours>(chosen);
  if (session.look.colours == Colours::kTriangleSize) legend(triangle_size_colours(), "1 cell", "128 cells");
  if (session.look.colours != Colours::kError) return;
  std::vector<Rgb> colours;
  for (int k = 0; k < 16; ++k) colours.push_back(error_colour(k / 15.0));
  legend(colours, "0 px", fmt::format("{:.3g} px", session.look.full_error));
  auto full = static_cast<float>(session.look.full_error);
  if (ImGui::SliderFloat("darkest", &full, 0.25F, 64, "%.2f px", ImGuiSliderFlags_Logarithmic))
    session.look.full_error = static_cast<double>(full);
}

void show_look(Session& session, Controls& controls) {
  ImGui::Checkbox("wires", &session.look.wires);
  ImGui::SameLine();
  bool frozen = session.frozen().has_value();
  if (ImGui::Checkbox("freeze", &frozen)) session.freeze(frozen);
  ImGui::SameLine();
  bool two = session.sides() > 1;
  if (ImGui::Checkbox("two methods", &two))
    attempt(session, [&] { perform(Action::kSecond, session, controls); });
  ImGui::Checkbox("landscape", &session.look.landscape);
  show_colours(session);
  auto pixels = static_cast<float>(controls.pixels);
  ImGui::SetNextItemWidth(90);
  if (ImGui::InputFloat("px", &pixels, 0, 0, "%.2f")) controls.pixels = std::clamp(pixels, 0.01F, 1000.0F);
  ImGui::SameLine();
  button("same error here", Action::kEqualise, session, controls);
}

void show_camera(Session& session, Controls& controls) {
  int motion = static_cast<int>(session.camera.motion());
  if (ImGui::Combo("motion", &motion, "fly\0walk\0orbit\0plan\0"))
    session.camera.set_motion(static_cast<Motion>(motion));
  button(session.recorder.recording() ? "end recording" : "record a path", Action::kRecord, session,
         controls);
  ImGui::SameLine();
  if (session.playing()) {
    button("stop", Action::kPlay, session, controls);
  } else if (ImGui::BeginCombo("##play", "play a path")) {
    for (const CameraPath& path : camera_paths()) {
      if (!ImGui::Selectable(path.name.c_str())) continue;
      controls.path = path;
      attempt(session, [&] { session.play(path); });
    }
    if (!controls.path.keyframes.empty() && ImGui::Selectable(("again: " + controls.path.name).c_str()))
      attempt(session, [&] { session.play(controls.path); });
    ImGui::EndCombo();
  }
}

void show_edits(Session& session, Controls& controls) {
  const Heightfield& ground = session.ground().heights;
  const float side = std::max(ground.extent_x(), ground.extent_z());
  auto radius = controls.brush > 0 ? static_cast<float>(controls.brush) : 0.02F * side;
  if (ImGui::SliderFloat("radius", &radius, 0.002F * side, 0.2F * side, "%.0f m",
                         ImGuiSliderFlags_Logarithmic))
    controls.brush = static_cast<double>(radius);
  text("X digs and C fills under the mouse");
  ImGui::SameLine();
  button("undo", Action::kUndo, session, controls);
}

void show_help() {
  text("WASD, Q, E and the arrows move and turn; Shift: faster.\nDrag: look. Wheel: speed, or distance.");
  for (const Binding& one : bindings()) {
    text(std::string(one.name));
    ImGui::SameLine(50);
    text(std::string(one.what));
  }
}

}  // namespace

std::string comparison(Session& session) {
  std::string rows =
      "ground\tmethod\tknob\ttriangles\terror p99 px\tchoose ms\tsend ms\tdraw ms\tsent B\tmemory B\n";
  for (int k = 0; k < session.sides(); ++k) {
    const Side& side = session.side(k);
    if (side.history().empty()) continue;
    const FrameSample& last = side.history().last();
    rows += fmt::format("{}\t{}\t{:.4g}\t{}\t{}\t{:.3f}\t{:.3f}\t{:.3f}\t{}\t{}\n", session.ground().name,
                        side.method().name, side.knob(), last.triangles,
                        side.error() == nullptr ? "" : fmt::format("{:.3f}", side.error()->p99), last.choose,
                        last.send, last.draw, last.bytes_sent, last.memory);
  }
  return rows;
}

void show_panels(Session& session, Controls& controls, double frame_seconds) {
  ImGui::SetNextWindowPos({8, 8}, ImGuiCond_Once);
  ImGui::SetNextWindowSize({310, std::min(620.0F, static_cast<float>(controls.window.y) - 16)},
                           ImGuiCond_Once);
  ImGui::Begin("terrabench");
  ImGui::PushItemWidth(190);
  text(fmt::format("{}   {:.0f} fps", session.ground().name, 1 / std::max(1e-3, frame_seconds)));
  for (int k = 0; k < session.sides(); ++k) show_method(session, k);
  show_look(session, controls);
  if (ImGui::CollapsingHeader("Camera", ImGuiTreeNodeFlags_DefaultOpen)) show_camera(session, controls);
  if (ImGui::CollapsingHeader("Cost of the last 10 s", ImGuiTreeNodeFlags_DefaultOpen)) {
    for (int k = 0; k < session.sides(); ++k) show_costs(session, k);
    if (ImGui::Button("copy as a table")) ImGui::SetClipboardText(comparison(session).c_str());
  }
  if (ImGui::CollapsingHeader("Edit")) show_edits(session, controls);
  button("picture at print size", Action::kPicture, session, controls);
  if (ImGui::CollapsingHeader("Keys")) show_help();
  ImGui::PopItemWidth();
  ImGui::End();
}

void show_work(const Session& session, const Controls& controls) {
  std::string words = session.message;
  if (session.working()) {
    const Job::State state = session.work();
    words = state.share > 0 ? fmt::format("{}: {:.0f} %", state.what, 100 * state.share)
                            : fmt::format("{}: {:.1f} s", state.what, state.seconds);
  }
  if (words.empty()) return;
  const auto width = static_cast<float>(controls.window.x), height = static_cast<float>(controls.window.y);
  ImGui::SetNextWindowPos({0.5F * width, height - 8}, ImGuiCond_Always, {0.5F, 1});
  ImGui::SetNextWindowSizeConstraints({0, 0}, {width - 16, height});
  ImGui::Begin("##work", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoInputs);
  ImGui::PushTextWrapPos(width - 32);
  text(words);
  ImGui::PopTextWrapPos();
  ImGui::End();
}

}  // namespace terrabench::viewer
