// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/widgets/number_field.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <unordered_map>

#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include "editor/widgets/keyboard.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/widgets.h"
#include "editor/words/figures.h"
#include "editor/words/sentences.h"
#include "editor/words/words.h"

namespace standpoint::ui {

namespace {

// What is being typed into a field, or was left in it though it cannot be taken. It lives as long as the field is on
// the screen.
struct Draft {
  std::string text, before;  // now, and when editing began
  std::string problem;
  double of = 0;  // the value that it would replace
  bool editing = false;
  int drawn = 0;  // the last frame with it
};

struct Drafts {
  const ImGuiContext* context = nullptr;  // tests make one after another
  std::unordered_map<ImGuiID, Draft> of;
  ImGuiID pulled = 0;  // by the mouse, to be put back by Esc
  double pulled_from = 0;
};

Drafts& drafts() {
  static Drafts all;
  if (all.context != ImGui::GetCurrentContext()) all = {ImGui::GetCurrentContext(), {}, 0, 0};
  return all;
}

Draft* draftOf(ImGuiID id, double value) {
  auto& all = drafts().of;
  const auto found = all.find(id);
  if (found == all.end()) return nullptr;
  Draft& draft = found->second;
  const bool left = draft.drawn + 1 < ImGui::GetFrameCount();
  const bool outdated = !draft.editing && draft.of != value;  // by an undo, say
  if (left || outdated) {
    all.erase(found);
    return nullptr;
  }
  draft.drawn = ImGui::GetFrameCount();
  return &draft;
}

std::string shownText(double value, const NumberFormat& format) {
  if (value == 0 && format.zero != nullptr) return tr(format.zero);
  if (format.kind.whole) return exactText(value);
  const bool lost = value != 0 && std::abs(value) < std::pow(10.0, -format.decimals) / 2;  // 0.00 would be wrong
  return format.decimals < 0 || lost ? figures("{:.6g}", value) : figures("{:.{}f}", value, format.decimals);
}

Result<double> typedNumber(const std::string& text, const NumberFormat& format) {
  if (format.zero != nullptr && text == format.zero) return 0.0;
  return numberFromText(text, format.kind);
}

float unitWidth(const NumberFormat& format) {
  if (format.kind.unit.empty()) return 0;
  const std::string unit = tr(format.kind.unit);
  return ImGui::CalcTextSize(unit.c_str()).x + ImGui::GetStyle().FramePadding.x;
}

// Begins, goes on with and ends an edit by what has become of the field. True when the text is to be taken over.
bool followEdit(ImGuiID id, Draft*& draft, const std::string& before, const std::string& now, double value,
                const NumberFormat& format) {
  const bool active = ImGui::GetActiveID() == id;
  if (active && (draft == nullptr || !draft->editing)) {
    draft =
        &(drafts().of[id] = {now, before, draft != nullptr ? draft->problem : "", value, true, ImGui::GetFrameCount()});
    return false;
  }
  if (draft == nullptr || !draft->editing) return false;
  draft->text = now;
  if (!draft->problem.empty() && typedNumber(now, format)) draft->problem.clear();
  draft->editing = active;
  if (active) return false;
  if (keyboard::pressed(kKeyEscape) || (now == draft->before && draft->problem.empty())) {
    drafts().of.erase(id);  // nothing was typed, so not even a digit that is not shown gets lost
    draft = nullptr;
    return false;
  }
  return true;
}

bool takeOver(ImGuiID id, Draft*& draft, double& value, const NumberFormat& format) {
  const auto number = typedNumber(draft->text, format);
  if (!number) {
    draft->problem = number.error().message;
    return false;
  }
  drafts().of.erase(id);
  draft = nullptr;
  if (*number == value) return false;
  value = *number;
  return true;
}

// Over the frame, so that the unit is no part of what is edited.
void drawUnit(const NumberFormat& format, const ImRect& frame, double value, bool editing) {
  if (format.kind.unit.empty() || (!editing && value == 0 && format.zero != nullptr)) return;
  const std::string unit = tr(format.kind.unit);
  const auto padding = ImGui::GetStyle().FramePadding;
  const float x = frame.Max.x - unitWidth(format);
  ImGui::GetWindowDrawList()->AddText({x, frame.Min.y + padding.y}, ImGui::GetColorU32(ImGuiCol_TextDisabled),
                                      unit.c_str());
}

void drawShown(const std::string& text, const ImRect& input) {
  const auto padding = ImGui::GetStyle().FramePadding;
  const ImVec2 from{input.Min.x + padding.x, input.Min.y + padding.y};
  const ImRect clip(from, {input.Max.x, input.Max.y});
  ImGui::RenderTextClipped(from, {input.Max.x, input.Max.y - padding.y}, text.c_str(), nullptr, nullptr, {0, 0}, &clip);
}

double roundedTo(double value, const NumberFormat& format) {
  const double unit = std::pow(10.0, format.kind.whole ? 0 : -format.decimals);
  return std::clamp(std::round(value / unit) * unit, format.kind.least, format.kind.most);
}

// Remembers where a pull began; Esc puts the number back.
bool putBack(ImGuiID id, double& value) {
  auto& all = drafts();
  if (ImGui::IsItemActivated()) all.pulled = id, all.pulled_from = value;
  if (!ImGui::IsItemActive() || all.pulled != id || !keyboard::pressed(kKeyEscape)) return false;
  value = all.pulled_from;
  ImGui::ClearActiveID();
  return true;
}

bool dragUnit(const char* id, double& value, const NumberFormat& format, const ImRect& frame) {
  const ImVec2 after = ImGui::GetCursorScreenPos();
  auto& extent = ImGui::GetCurrentWindow()->DC.CursorMaxPos;
  const ImVec2 extent_before = extent;  // the way back to the next line would make the field higher than others
  const float width = unitWidth(format);
  ImGui::SetCursorScreenPos({frame.Max.x - width, frame.Min.y});
  ImGui::InvisibleButton((std::string(id) + "-drag").c_str(), {width, frame.GetHeight()});
  if (ImGui::IsItemHovered() || ImGui::IsItemActive()) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  bool changed = putBack(ImGui::GetItemID(), value);
  const float way = ImGui::GetIO().MouseDelta.x;
  if (!changed && ImGui::IsItemActive() && way != 0) {
    const double to = roundedTo(value + way * format.drag * (ImGui::GetIO().KeyShift ? 0.1 : 1.0), format);
    changed = to != value;
    value = to;
  }
  ImGui::SetCursorScreenPos(after);
  extent = extent_before;
  return changed;
}

bool stepButtons(double& value, const NumberFormat& format, const ImRect& frame) {
  const float side = ImGui::GetFrameHeight(), between = ImGui::GetStyle().ItemInnerSpacing.x;
  bool changed = false;
  for (const double sign : {-1.0, 1.0}) {
    ImGui::SameLine(0, between);
    if (sign < 0) ImGui::SetCursorScreenPos({frame.Max.x + between, frame.Min.y});
    ImGui::PushButtonRepeat(true);
    if (ImGui::Button(sign < 0 ? "-###less" : "+###more", {side, side})) {
      const double step = sign * format.step * (ImGui::GetIO().KeyCtrl ? 10 : 1);
      const double to = std::clamp(value + step, format.kind.least, format.kind.most);
      changed = changed || to != value;
      value = std::round(to * 1e9) / 1e9;  // 0.1 + 0.2 is to be 0.3
    }
    ImGui::PopButtonRepeat();
  }
  return changed;
}

struct Look {
  float width;
  bool bad, active, draggable;
};

// The frame goes around text and unit; inside it the input has none of its own.
bool inputIn(const char* id, std::string& text, const Look& look, float unit) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImRect frame(at, {at.x + look.width, at.y + ImGui::GetFrameHeight()});
  const bool hovered = ImGui::IsMouseHoveringRect(frame.Min, frame.Max) && ImGui::IsWindowHovered();
  ImGui::RenderFrame(frame.Min, frame.Max, ImGui::GetColorU32(hovered ? ImGuiCol_FrameBgHovered : ImGuiCol_FrameBg),
                     true, ImGui::GetStyle().FrameRounding);
  const bool disabled = (ImGui::GetCurrentContext()->CurrentItemFlags & ImGuiItemFlags_Disabled) != 0;
  if (hovered && !disabled && ImGui::GetIO().MousePos.x > frame.Max.x - unit && ImGui::IsMouseClicked(0) &&
      !look.draggable)
    focusNext();  // a click on the unit is one into the field
  ImGui::SetNextItemWidth(std::max(1.0F, look.width - unit));
  ImGui::PushStyleColor(ImGuiCol_FrameBg, 0);
  ImGui::PushStyleVar(ImGuiStyleVar_FrameBorderSize, 0);
  if (!look.active) ImGui::PushStyleColor(ImGuiCol_Text, 0);  // what is shown then is rounded
  const bool edited = ImGui::InputText(id, &text, ImGuiInputTextFlags_AutoSelectAll);
  if (!look.active) ImGui::PopStyleColor();
  ImGui::PopStyleVar();
  ImGui::PopStyleColor();
  if (look.bad)
    ImGui::GetWindowDrawList()->AddRect(frame.Min, frame.Max, tone::kBad, ImGui::GetStyle().FrameRounding, 0, 1.5F);
  return edited;
}

}  // namespace

bool numberField(const char* id, double& value, const NumberFormat& format, const char* help) {
  const float buttons = format.step > 0 ? 2 * (ImGui::GetFrameHeight() + ImGui::GetStyle().ItemInnerSpacing.x) : 0;
  const float width = std::max(1.0F, ImGui::CalcItemWidth() - buttons);
  ImGui::BeginGroup();
  const ImGuiID item = ImGui::GetID(id);
  Draft* draft = draftOf(item, value);
  const std::string before = draft != nullptr ? draft->text : asFigure(exactText(value));
  std::string text = before;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImRect frame(at, {at.x + width, at.y + ImGui::GetFrameHeight()});
  const float unit = unitWidth(format);
  const bool was_active = draft != nullptr && draft->editing;
  inputIn(id, text, {width, draft != nullptr && !draft->problem.empty(), was_active, format.drag > 0}, unit);
  const bool hovered = ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled);
  auto& extent = ImGui::GetCurrentWindow()->DC.CursorMaxPos;
  extent.x = std::max(extent.x, frame.Max.x);  // what comes beside it comes behind the unit
  bool changed = followEdit(item, draft, before, text, value, format) && takeOver(item, draft, value, format);
  if (draft == nullptr || !was_active)
    drawShown(draft != nullptr ? draft->text : shownText(value, format),
              {frame.Min, {frame.Max.x - unit, frame.Max.y}});
  drawUnit(format, frame, value, draft != nullptr);
  if (format.step > 0) {
    ImGui::PushID(id);
    changed = stepButtons(value, format, frame) || changed;
    ImGui::PopID();
  }
  if (format.drag > 0) changed = dragUnit(id, value, format, frame) || changed;
  if (draft != nullptr && !draft->problem.empty()) {
    ImGui::PushStyleColor(ImGuiCol_Text, tone::kBad);
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + width + buttons);
    ImGui::TextUnformatted(wholeNumbers(trSentence(draft->problem), width + buttons).c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
  }
  ImGui::EndGroup();
  if (help != nullptr && hovered && !was_active) tooltip(help);
  return changed;
}

bool isNumberRefused(const char* id) {
  const auto found = drafts().of.find(ImGui::GetID(id));
  return found != drafts().of.end() && !found->second.problem.empty();
}

bool textField(const char* id, std::string& value, const char* hint) {
  const ImGuiID item = ImGui::GetID(id);
  const double version = static_cast<double>(std::hash<std::string>()(value) >> 12);  // stands for the value
  Draft* draft = draftOf(item, version);
  std::string text = draft != nullptr ? draft->text : value;
  ImGui::InputTextWithHint(id, tr(hint).c_str(), &text, ImGuiInputTextFlags_AutoSelectAll);
  if (!followEdit(item, draft, value, text, version, {})) return false;
  drafts().of.erase(item);
  value = text;
  return true;
}

bool numberSlider(const char* id, double& value, double low, double high, const NumberFormat& format, const char* help,
                  bool logarithmic) {
  const float width = ImGui::CalcItemWidth(), between = ImGui::GetStyle().ItemInnerSpacing.x;
  const float wanted = ImGui::CalcTextSize("00000.00").x + unitWidth(format) + 2 * ImGui::GetStyle().FramePadding.x;
  const float field = std::min(wanted, width);
  const float bar = width - field - between;
  ImGui::BeginGroup();
  bool changed = false, typed = false;
  if (bar > 2 * ImGui::GetFrameHeight()) {
    double pulled = value;
    ImGui::SetNextItemWidth(bar);
    const auto flags = ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoInput | ImGuiSliderFlags_NoRoundToFormat |
                       (logarithmic ? ImGuiSliderFlags_Logarithmic : 0);
    const bool moved =
        ImGui::SliderScalar((std::string(id) + "-bar").c_str(), ImGuiDataType_Double, &pulled, &low, &high, "", flags);
    typed = ImGui::IsItemClicked() && ImGui::GetIO().KeyCtrl;
    changed = putBack(ImGui::GetItemID(), value);
    if (!changed && moved && !ImGui::GetIO().KeyCtrl) {
      const double to = roundedTo(pulled, format);
      changed = to != value;
      value = to;
    }
    ImGui::SameLine(0, between);
  }
  if (typed) focusNext();
  ImGui::SetNextItemWidth(field);
  changed = numberField(id, value, format, help) || changed;
  ImGui::EndGroup();
  return changed;
}

}  // namespace standpoint::ui
