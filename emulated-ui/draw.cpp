// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/draw.h"

#include <algorithm>
#include <cstdlib>
#include <optional>

#include <imgui.h>
#include <imgui_stdlib.h>

namespace standpoint {

// A dark body with a light display and a red key: the family's look, drawn by us.
const Skin kLeicaSkin{IM_COL32(46, 48, 51, 255),    IM_COL32(244, 245, 246, 255), IM_COL32(58, 61, 66, 255),
                      IM_COL32(255, 255, 255, 255), IM_COL32(228, 232, 238, 255), IM_COL32(198, 40, 40, 255),
                      IM_COL32(198, 40, 40, 255),   IM_COL32(33, 36, 41, 255),    IM_COL32(112, 119, 128, 255), 0.62F};

namespace {

struct Press {
  std::string widget, value;
};

class Display {
 public:
  Display(const Skin& skin, float unit) : skin_(skin), unit_(unit) {}

  // The press, if there was one; the menu is asked only after everything was drawn.
  std::optional<Press> press;

  void titleBar(const Screen& screen) {
    ImDrawList* list = ImGui::GetWindowDrawList();
    const ImVec2 at = ImGui::GetWindowPos();
    const float width = ImGui::GetWindowWidth();
    const float height = 2.4F * unit_;
    list->AddRectFilled(at, {at.x + width, at.y + height}, skin_.title_bar);
    const float line = ImGui::GetTextLineHeight();
    list->AddText({at.x + unit_, at.y + (height - line) / 2}, IM_COL32_WHITE, screen.title.c_str());
    float right = at.x + width - unit_;
    for (const auto& w : screen.widgets) {
      if (w.kind != WidgetKind::status) continue;
      const std::string text = w.label + " " + w.value;
      right -= ImGui::CalcTextSize(text.c_str()).x;
      list->AddText({right, at.y + (height - line) / 2}, w.why_not.empty() ? IM_COL32(214, 217, 221, 255) : IM_COL32(255, 138, 128, 255), text.c_str());
      right -= 1.2F * unit_;
    }
    ImGui::SetCursorPosY(height + 0.6F * unit_);
  }

  void widget(const Widget& w) {
    switch (w.kind) {
      case WidgetKind::status: break;
      case WidgetKind::readout: readout(w); break;
      case WidgetKind::button: tile(w); break;
      case WidgetKind::key: key(w); break;
      case WidgetKind::lamp: lamp(w); break;
      case WidgetKind::choice:
      case WidgetKind::toggle: choice(w); break;
      case WidgetKind::text: text(w, 0); break;
      case WidgetKind::number: text(w, ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_CharsDecimal); break;
      case WidgetKind::list: rows(w); break;
      case WidgetKind::progress: progress(w); break;
      case WidgetKind::note: paragraph(w.label); break;
      case WidgetKind::area:
      case WidgetKind::level:
      case WidgetKind::preview:
      case WidgetKind::plan: break;
    }
  }

  void dialog(const Dialog& d) {
    paragraph(d.text);
    for (const auto& button : d.buttons) tile(button);
  }

 private:
  void readout(const Widget& w) {
    ImGui::SetCursorPosX(unit_);
    ImGui::PushStyleColor(ImGuiCol_Text, skin_.dim);
    ImGui::TextUnformatted(w.label.c_str());
    ImGui::PopStyleColor();
    if (!w.value.empty()) {
      ImGui::SameLine();
      ImGui::SetCursorPosX(std::max(ImGui::GetCursorPosX(), ImGui::GetWindowWidth() - unit_ - ImGui::CalcTextSize(w.value.c_str()).x));
      ImGui::TextUnformatted(w.value.c_str());
    }
  }

  void tile(const Widget& w) {
    ImGui::SetCursorPosX(unit_);
    ImGui::PushID(w.id.c_str());
    ImGui::PushStyleColor(ImGuiCol_Button, skin_.tile);
    ImGui::PushStyleColor(ImGuiCol_ButtonHovered, skin_.tile_hover);
    ImGui::PushStyleColor(ImGuiCol_ButtonActive, skin_.tile_hover);
    ImGui::PushStyleVar(ImGuiStyleVar_ButtonTextAlign, {0, 0.5F});
    ImGui::BeginDisabled(!w.enabled);
    const std::string label = (w.value.empty() ? w.label : w.label + ":  " + w.value) + "###" + w.id;
    if (ImGui::Button(label.c_str(), {ImGui::GetWindowWidth() - 2 * unit_, 2.6F * unit_})) press = Press{w.id, {}};
    ImGui::EndDisabled();
    reason(w);
    ImGui::PopStyleVar();
    ImGui::PopStyleColor(3);
    ImGui::PopID();
  }

  void key(const Widget& w) {
    ImGui::SetCursorPosX(unit_);
    ImGui::PushStyleColor(ImGuiCol_Button, skin_.key);
    ImGui::PushStyleColor(ImGuiCol_ButtonHovered, IM_COL32(218, 62, 62, 255));
    ImGui::PushStyleColor(ImGuiCol_ButtonActive, IM_COL32(170, 28, 28, 255));
    ImGui::PushStyleColor(ImGuiCol_Text, IM_COL32_WHITE);
    ImGui::BeginDisabled(!w.enabled);
    if (ImGui::Button((w.label + "###" + w.id).c_str(), {ImGui::GetWindowWidth() - 2 * unit_, 3.6F * unit_})) press = Press{w.id, {}};
    ImGui::EndDisabled();
    ImGui::PopStyleColor(4);
    reason(w);
  }

  void choice(const Widget& w) {
    ImGui::SetCursorPosX(unit_);
    ImGui::PushStyleColor(ImGuiCol_Text, skin_.dim);
    ImGui::TextUnformatted(w.label.c_str());
    ImGui::PopStyleColor();
    ImGui::PushID(w.id.c_str());
    ImGui::SetCursorPosX(unit_);
    const auto count = static_cast<float>(w.options.size());
    const float gap = 0.3F * unit_;
    const float whole = ImGui::GetWindowWidth() - 2 * unit_;
    float widest = 0;
    for (const auto& option : w.options) widest = std::max(widest, ImGui::CalcTextSize(option.label.c_str()).x + 2 * ImGui::GetStyle().FramePadding.x);
    const bool stacked = widest > (whole - gap * (count - 1)) / count;   // too wide for a row: one below the other
    const float width = stacked ? whole : (whole - gap * (count - 1)) / count;
    for (const auto& option : w.options) {
      if (stacked) ImGui::SetCursorPosX(unit_);
      const bool chosen = option.label == w.value || (w.kind == WidgetKind::toggle && option.value == w.value);
      ImGui::PushStyleColor(ImGuiCol_Button, chosen ? skin_.accent : skin_.tile);
      ImGui::PushStyleColor(ImGuiCol_ButtonHovered, chosen ? skin_.accent : skin_.tile_hover);
      ImGui::PushStyleColor(ImGuiCol_ButtonActive, skin_.accent);
      ImGui::PushStyleColor(ImGuiCol_Text, chosen ? IM_COL32_WHITE : skin_.text);
      ImGui::BeginDisabled(!option.enabled);
      if (ImGui::Button((option.label + "###" + option.value).c_str(), {width, 2.4F * unit_})) press = Press{w.id, option.value};
      ImGui::EndDisabled();
      ImGui::PopStyleColor(4);
      if (!stacked && &option != &w.options.back()) ImGui::SameLine(0, gap);
    }
    ImGui::PopID();
  }

  void text(const Widget& w, ImGuiInputTextFlags flags) {
    ImGui::SetCursorPosX(unit_);
    ImGui::PushStyleColor(ImGuiCol_Text, skin_.dim);
    ImGui::TextUnformatted(w.label.c_str());
    ImGui::PopStyleColor();
    ImGui::SetCursorPosX(unit_);
    ImGui::SetNextItemWidth(ImGui::GetWindowWidth() - 2 * unit_);
    ImGui::PushStyleColor(ImGuiCol_FrameBg, skin_.tile);
    std::string entry = w.value;
    if (ImGui::InputText(("###" + w.id).c_str(), &entry, flags)) press = Press{w.id, entry};
    ImGui::PopStyleColor();
  }

  void rows(const Widget& w) {
    ImGui::PushID(w.id.c_str());
    for (const auto& option : w.options) {
      Widget row;
      row.id = option.value;
      row.kind = WidgetKind::button;
      row.label = option.label;
      row.enabled = w.enabled && option.enabled;
      const auto before = press;
      tile(row);
      if (press && !before) press = Press{w.id, row.id};
    }
    ImGui::PopID();
  }

  void progress(const Widget& w) {
    ImGui::SetCursorPosX(unit_);
    ImGui::PushStyleColor(ImGuiCol_PlotHistogram, skin_.accent);
    ImGui::PushStyleColor(ImGuiCol_FrameBg, skin_.tile_hover);
    ImGui::ProgressBar(static_cast<float>(w.number), {ImGui::GetWindowWidth() - 2 * unit_, 0.8F * unit_}, "");
    ImGui::PopStyleColor(2);
    const std::string& text = w.value;
    ImGui::SetCursorPosX(ImGui::GetWindowWidth() - unit_ - ImGui::CalcTextSize(text.c_str()).x);
    ImGui::TextUnformatted(text.c_str());
  }

  void paragraph(const std::string& text) {
    ImGui::Dummy({0, unit_});
    ImGui::SetCursorPosX(unit_);
    ImGui::PushTextWrapPos(ImGui::GetWindowWidth() - unit_);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::Dummy({0, unit_});
  }

  void lamp(const Widget& w) {
    ImGui::SetCursorPosX(unit_);
    ImGui::TextUnformatted((w.label + ": " + w.value).c_str());
  }

  static void reason(const Widget& w) {
    if (!w.why_not.empty() && ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) ImGui::SetTooltip("%s", w.why_not.c_str());
  }

  const Skin& skin_;
  float unit_;
};

}  // namespace

void drawDevice(Device& device, const Skin& skin, float width, float height, std::string& error) {
  const Screen screen = device.screen();
  const float unit = ImGui::GetFontSize() * 0.8F;
  const float bezel = 1.2F * unit;
  const float keys = 5 * unit;
  const float display_width = std::max(10 * unit, std::min(width, height * skin.display_aspect) - 2 * bezel);
  const float display_height = std::max(10 * unit, height - 2 * bezel - keys);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + display_width + 2 * bezel, at.y + display_height + 2 * bezel + keys}, skin.body, 1.5F * unit);
  ImGui::SetCursorScreenPos({at.x + bezel, at.y + bezel});
  const bool dark = screen.id.empty();
  ImGui::PushStyleColor(ImGuiCol_ChildBg, dark ? IM_COL32(12, 13, 14, 255) : skin.display);
  ImGui::PushStyleColor(ImGuiCol_Text, skin.text);
  ImGui::PushStyleVar(ImGuiStyleVar_FrameRounding, 0.3F * unit);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0.4F * unit, 0.5F * unit});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  Display display(skin, unit);
  if (ImGui::BeginChild("display", {display_width, display_height}, false) && !dark) {
    display.titleBar(screen);
    if (screen.has_dialog) display.dialog(screen.dialog);
    else
      for (const auto& w : screen.widgets) display.widget(w);
    ImGui::Dummy({0, 0.5F * unit});
  }
  ImGui::EndChild();
  ImGui::SetCursorScreenPos({at.x + bezel, at.y + bezel + display_height});
  if (ImGui::BeginChild("keys", {display_width, keys}, false))
    for (const auto& w : screen.body) display.widget(w);
  ImGui::EndChild();
  ImGui::PopStyleVar(3);
  ImGui::PopStyleColor(2);
  if (!display.press) return;
  const auto done = device.act(display.press->widget, display.press->value);
  error = done ? std::string() : done.error().message;
}

}  // namespace standpoint
