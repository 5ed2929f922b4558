#include "viewer/interface.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

#include "terrain/machine_error.h"

namespace terrabench::viewer {
namespace {

constexpr std::pair<ImGuiKey_, int> kKeys[] = {
    {ImGuiKey_Tab, GLFW_KEY_TAB},
    {ImGuiKey_LeftArrow, GLFW_KEY_LEFT},
    {ImGuiKey_RightArrow, GLFW_KEY_RIGHT},
    {ImGuiKey_UpArrow, GLFW_KEY_UP},
    {ImGuiKey_DownArrow, GLFW_KEY_DOWN},
    {ImGuiKey_PageUp, GLFW_KEY_PAGE_UP},
    {ImGuiKey_PageDown, GLFW_KEY_PAGE_DOWN},
    {ImGuiKey_Home, GLFW_KEY_HOME},
    {ImGuiKey_End, GLFW_KEY_END},
    {ImGuiKey_Insert, GLFW_KEY_INSERT},
    {ImGuiKey_Delete, GLFW_KEY_DELETE},
    {ImGuiKey_Backspace, GLFW_KEY_BACKSPACE},
    {ImGuiKey_Space, GLFW_KEY_SPACE},
    {ImGuiKey_Enter, GLFW_KEY_ENTER},
    {ImGuiKey_Escape, GLFW_KEY_ESCAPE},
    {ImGuiKey_KeyPadEnter, GLFW_KEY_KP_ENTER},
    {ImGuiKey_A, GLFW_KEY_A},
    {ImGuiKey_C, GLFW_KEY_C},
    {ImGuiKey_V, GLFW_KEY_V},
    {ImGuiKey_X, GLFW_KEY_X},
    {ImGuiKey_Y, GLFW_KEY_Y},
    {ImGuiKey_Z, GLFW_KEY_Z},
};

const char* pasted(void* window) {
  static std::string text;  // ImGui reads it before it asks again
  text = static_cast<Window*>(window)->clipboard();
  return text.c_str();
}

// With the signs of units; ImGui's own font lacks them, but serves where the file is absent.
void load_font(ImFontAtlas& fonts) {
  constexpr const char* kFile = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";  // fonts-dejavu-core
  static constexpr ImWchar kSigns[] = {0x20, 0xFF, 0x2010, 0x203A, 0x2190, 0x2193, 0x2248, 0x2265, 0};
  std::error_code error;
  if (std::filesystem::exists(kFile, error)) fonts.AddFontFromFileTTF(kFile, 14, nullptr, kSigns);
}

void copied(void* window, const char* text) { static_cast<Window*>(window)->set_clipboard(text); }

}  // namespace

Interface::Interface(Window& window) : window_(window) {
  window_.make_current();
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGui::StyleColorsLight();
  ImGui::GetStyle().WindowRounding = 3;
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // leaves no file in the user's folder
  io.ClipboardUserData = &window_;
  io.GetClipboardTextFn = pasted;
  io.SetClipboardTextFn = copied;
  load_font(*io.Fonts);
  for (const auto& [key, number] : kKeys) io.KeyMap[key] = number;
  if (!ImGui_ImplOpenGL3_Init("#version 450 core"))
    throw MachineError("Dear ImGui cannot load OpenGL", "viewer", "install Debian's package libgl1");
}

Interface::~Interface() {
  window_.make_current_to_delete();
  ImGui_ImplOpenGL3_Shutdown();
  ImGui::DestroyContext();
}

void Interface::take(const WindowEvent& event) {
  ImGuiIO& io = ImGui::GetIO();
  const auto code = static_cast<std::size_t>(event.code);
  switch (event.kind) {
    case WindowEvent::Kind::kKey:
      if (code < std::size(io.KeysDown)) io.KeysDown[code] = event.down;
      io.KeyCtrl = io.KeysDown[GLFW_KEY_LEFT_CONTROL] || io.KeysDown[GLFW_KEY_RIGHT_CONTROL];
      io.KeyShift = io.KeysDown[GLFW_KEY_LEFT_SHIFT] || io.KeysDown[GLFW_KEY_RIGHT_SHIFT];
      io.KeyAlt = io.KeysDown[GLFW_KEY_LEFT_ALT] || io.KeysDown[GLFW_KEY_RIGHT_ALT];
      break;
    case WindowEvent::Kind::kText:
      io.AddInputCharacter(static_cast<unsigned>(event.code));
      break;
    case WindowEvent::Kind::kMove:
      io.MousePos = {static_cast<float>(event.at.x), static_cast<float>(event.at.y)};
      break;
    case WindowEvent::Kind::kButton:
      if (code >= down_.size()) break;
      down_[code] = event.down;
      pressed_[code] = pressed_[code] || event.down;
      break;
    case WindowEvent::Kind::kScroll:
      io.MouseWheelH += static_cast<float>(event.at.x);
      io.MouseWheel += static_cast<float>(event.at.y);
      break;
    case WindowEvent::Kind::kDrop:
    case WindowEvent::Kind::kExposed:
      break;
  }
}

bool Interface::takes_mouse() const { return ImGui::GetIO().WantCaptureMouse; }
bool Interface::takes_keys() const { return ImGui::GetIO().WantTextInput; }

void Interface::begin(glm::ivec2 size, double seconds) {
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {static_cast<float>(size.x), static_cast<float>(size.y)};
  io.DeltaTime = static_cast<float>(seconds);
  for (std::size_t button = 0; button < down_.size(); ++button) {
    io.MouseDown[button] = down_[button] || pressed_[button];
  }
  pressed_ = {};
  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();
}

void Interface::end() {
  ImGui::Render();
  window_.bind();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace terrabench::viewer
