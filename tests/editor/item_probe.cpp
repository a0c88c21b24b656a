// SPDX-License-Identifier: GPL-3.0-or-later
#include "item_probe.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include "editor/shell/shell.h"
#include "editor/widgets/keyboard.h"
#include "editor/widgets/theme.h"
#include "editor/words/words.h"

namespace standpoint {

ItemProbe& itemProbe() {
  static ItemProbe probe;
  return probe;
}

const GuiItem* ItemProbe::find(const std::string& part) const {
  for (const auto& item : items) {
    const auto& label = item.label;
    if (label == part ||
        (label.size() > part.size() && label.compare(label.size() - part.size(), part.size(), part) == 0))
      return &item;
  }
  return nullptr;
}

}  // namespace standpoint

using standpoint::itemProbe;

static void keepText(const char* text, const char* end) {
  auto& probe = itemProbe();
  if (probe.listens) probe.texts.push_back(end != nullptr ? std::string(text, end) : std::string(text));
}

// The mangled names of ImGui::ItemAdd, ImGuiWindow::GetID, ImGui::PushID and both ImDrawList::AddText in Dear
// ImGui 1.86 and 1.90.
extern "C" {
bool __real__ZN5ImGui7ItemAddERK6ImRectjPS1_i(const ImRect& box, ImGuiID id, const ImRect* nav, ImGuiItemFlags flags);
bool __wrap__ZN5ImGui7ItemAddERK6ImRectjPS1_i(const ImRect& box, ImGuiID id, const ImRect* nav, ImGuiItemFlags flags) {
  const bool visible = __real__ZN5ImGui7ItemAddERK6ImRectjPS1_i(box, id, nav, flags);
  if (id == 0) return visible;
  auto& probe = itemProbe();
  const auto label = probe.labels.find(id);
  probe.items.push_back({id, nav != nullptr ? *nav : box, label == probe.labels.end() ? "" : label->second,
                         GImGui->CurrentWindow->Name, !visible,
                         (GImGui->LastItemData.InFlags & ImGuiItemFlags_Disabled) != 0});
  return visible;
}

ImGuiID __real__ZN11ImGuiWindow5GetIDEPKcS1_(ImGuiWindow* window, const char* text, const char* end);
ImGuiID __wrap__ZN11ImGuiWindow5GetIDEPKcS1_(ImGuiWindow* window, const char* text, const char* end) {
  const ImGuiID id = __real__ZN11ImGuiWindow5GetIDEPKcS1_(window, text, end);
  auto& labels = itemProbe().labels;
  std::string label = end != nullptr ? std::string(text, end) : std::string(text);
  if (label.empty())  // a menu's entry: its label is on the stack
    if (const auto above = labels.find(window->IDStack.back()); above != labels.end()) label = above->second;
  labels[id] = label;
  return id;
}

void __real__ZN5ImGui6PushIDEPKc(const char* text);
void __wrap__ZN5ImGui6PushIDEPKc(const char* text) {
  __real__ZN5ImGui6PushIDEPKc(text);
  itemProbe().labels[GImGui->CurrentWindow->IDStack.back()] = text;
}

void __real__ZN10ImDrawList7AddTextEPK6ImFontfRK6ImVec2jPKcS7_fPK6ImVec4(ImDrawList* list, const ImFont* font,
                                                                         float size, const ImVec2& at, ImU32 colour,
                                                                         const char* text, const char* end, float wrap,
                                                                         const ImVec4* clip);
void __wrap__ZN10ImDrawList7AddTextEPK6ImFontfRK6ImVec2jPKcS7_fPK6ImVec4(ImDrawList* list, const ImFont* font,
                                                                         float size, const ImVec2& at, ImU32 colour,
                                                                         const char* text, const char* end, float wrap,
                                                                         const ImVec4* clip) {
  keepText(text, end);
  __real__ZN10ImDrawList7AddTextEPK6ImFontfRK6ImVec2jPKcS7_fPK6ImVec4(list, font, size, at, colour, text, end, wrap,
                                                                      clip);
}

void __real__ZN10ImDrawList7AddTextERK6ImVec2jPKcS4_(ImDrawList* list, const ImVec2& at, ImU32 colour, const char* text,
                                                     const char* end);
void __wrap__ZN10ImDrawList7AddTextERK6ImVec2jPKcS4_(ImDrawList* list, const ImVec2& at, ImU32 colour, const char* text,
                                                     const char* end) {
  keepText(text, end);
  __real__ZN10ImDrawList7AddTextERK6ImVec2jPKcS4_(list, at, colour, text, end);
}
}

namespace standpoint {

GuiDriver::GuiDriver(Editor& editor, ImVec2 size) : editor_(editor) {
  ImGui::CreateContext();
  auto& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.ConfigInputTextCursorBlink = false;
  io.DisplaySize = size;
  io.DeltaTime = 1.0F / 60;
  io.MousePos = {-FLT_MAX, -FLT_MAX};
  static std::string clipboard;
  io.SetClipboardTextFn = [](void*, const char* text) { clipboard = text; };
  io.GetClipboardTextFn = [](void*) { return clipboard.c_str(); };
  keyboard::connect();
  unsigned char* pixels = nullptr;
  int w = 0, h = 0;
  io.Fonts->GetTexDataAsAlpha8(&pixels, &w, &h);
  applyTheme(1);
  speak("en");  // whatever a test before has chosen
  frames(2);
}

GuiDriver::~GuiDriver() { ImGui::DestroyContext(); }

std::vector<std::string> GuiDriver::texts() {
  itemProbe().texts.clear();
  itemProbe().listens = true;
  frame();
  itemProbe().listens = false;
  return itemProbe().texts;
}

bool GuiDriver::says(const std::string& english) {
  const auto drawn = texts();
  return std::any_of(drawn.begin(), drawn.end(),
                     [&](const std::string& text) { return text.find(english) != std::string::npos; });
}

void GuiDriver::frame() {
  itemProbe().items.clear();
  if (!itemProbe().listens) itemProbe().texts.clear();
  ImGui::NewFrame();
  draws ? draws() : drawShell(editor_);
  ImGui::Render();
}

void GuiDriver::frames(int count) {
  for (int i = 0; i < count; ++i) frame();
}

void GuiDriver::settle() {
  editor_.session.wait();
  editor_.update();
  while (editor_.readingCloud()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  editor_.update();
  editor_.picker.wait();
  frames(2);
}

void GuiDriver::moveTo(ImVec2 place) {
  ImGui::GetIO().MousePos = place;
  frames(2);  // the hovered window is known one frame late
}

void GuiDriver::press(int button) {
  ImGui::GetIO().MouseDown[button] = true;
  frame();
  ImGui::GetIO().MouseDown[button] = false;
  frames(2);
}

bool GuiDriver::click(const std::string& label) {
  const auto* item = find(label);
  if (item == nullptr) return false;
  moveTo(item->rect.GetCenter());
  press();
  return true;
}

void GuiDriver::activate(ImGuiID id) {
  GImGui->NavNextActivateId = id;  // as ActivateItem() of 1.86, ActivateItemByID() of 1.90
  frames(2);
}

void GuiDriver::key(int glfw_key, bool ctrl, bool shift) {
  if (ctrl) keyboard::change(kKeyControl, true);
  if (shift) keyboard::change(kKeyShift, true);
  keyboard::change(glfw_key, true);
  frame();
  keyboard::change(glfw_key, false);
  keyboard::change(kKeyControl, false);
  keyboard::change(kKeyShift, false);
  frames(2);
}

void GuiDriver::type(const std::string& text) {
  ImGui::GetIO().AddInputCharactersUTF8(text.c_str());
  frames(2);
}

}  // namespace standpoint
