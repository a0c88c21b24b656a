// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/widgets/widgets.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <sstream>
#include <vector>

#include <fmt/format.h>
#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include "core/number_breaks.h"
#include "editor/model/style.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/theme.h"

namespace standpoint {

namespace ui {

Label::Label(const char* english) : text_(tr(english)) {
  if (text_ != english && std::strstr(english, "###") == nullptr) text_ += std::string("###") + english;
}

void filterButton(const Style& style, const char* list, const char* icon, const char* name, std::size_t count,
                  ImU32 shade, bool& shown) {
  ImGui::PushStyleColor(ImGuiCol_Button, shown ? colour(tone::kLit) : ImVec4(0, 0, 0, 0));
  ImGui::PushStyleColor(ImGuiCol_Text,
                        shown && count > 0 ? colour(shade) : ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  if (ImGui::Button(fmt::format("{}  {}###{}-{}", icon, groupedDigits(count), list, name).c_str())) shown = !shown;
  ImGui::PopStyleColor(2);
  ui::tooltip(trf("{}: {}", tr(shown ? "Hide" : "Show"), tr(name)));
  ImGui::SameLine(0, style.px(4));
}

void listEach(const char* list, bool& each) {
  checkbox(fmt::format("{}###{}-each", tr("List all"), list).c_str(), &each);
  ui::tooltip("List every issue, including similar ones");
  ImGui::SameLine(0, ImGui::GetStyle().ItemSpacing.x);
}

namespace {

template <class Draw>
bool withEdge(const Draw& draw) {
  ImGui::PushStyleVar(ImGuiStyleVar_FrameBorderSize, 1);
  ImGui::PushStyleColor(ImGuiCol_Border, colour(tone::kEdge));
  const bool pressed = draw();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar();
  return pressed;
}

// Icons are not all of one width, so that they are drawn in the middle of a room of their own.
class MenuIcon {
 public:
  MenuIcon(const char* icon, bool enabled)
      : icon_(icon), enabled_(enabled), list_(ImGui::GetWindowDrawList()), at_(ImGui::GetCursorScreenPos()) {}
  static constexpr const char* kRoom = "       ";
  void draw() const {  // after the entry, whose ground may be lit
    if (*icon_ == 0) return;
    const float room = ImGui::CalcTextSize(kRoom).x - ImGui::CalcTextSize("  ").x;
    const float left = at_.x + std::max(0.0F, (room - ImGui::CalcTextSize(icon_).x) / 2);
    list_->AddText({left, at_.y}, ImGui::GetColorU32(enabled_ ? ImGuiCol_Text : ImGuiCol_TextDisabled), icon_);
  }

 private:
  const char* icon_;
  bool enabled_;
  ImDrawList* list_;
  ImVec2 at_;
};

}  // namespace

bool menuItem(const char* icon, const std::string& label, const char* keys, const std::string& why) {
  const MenuIcon drawn(icon, why.empty());
  const bool chosen = ImGui::MenuItem((MenuIcon::kRoom + label).c_str(), keys, false, why.empty());
  drawn.draw();
  tooltip(tr(why));
  return chosen;
}

bool beginMenu(const char* icon, const char* label, bool enabled) {
  const MenuIcon drawn(icon, enabled);
  const bool open = ImGui::BeginMenu((MenuIcon::kRoom + std::string(Label(label))).c_str(), enabled);
  drawn.draw();
  return open;
}

bool checkbox(const char* label, bool* on) {
  return withEdge([&] { return ImGui::Checkbox(label, on); });
}

bool radioButton(const char* label, bool chosen) {
  return withEdge([&] { return ImGui::RadioButton(label, chosen); });
}

namespace {

constexpr double kTooltipWaits_s = 0.4;

// What the pointer rests on. Items without an id differ in their place.
struct Rested {
  ImVec2 place{-1, -1};
  double since_s = 0;  // of ImGui's clock
  int frame = -1;      // in which it was seen last
  bool shown = false;  // its tooltip
  int shown_for = 0;   // frames; Dear ImGui measures it in the first, and draws it from the second on
};
Rested rested;

// Whether it has rested there for long enough. Beside one whose tooltip is shown, the next is shown at once.
bool hasRested(ImVec2 place) {
  const double now_s = ImGui::GetTime();
  const int frame = ImGui::GetFrameCount();
  const bool followed = frame == rested.frame + 1;
  if (!followed || place.x != rested.place.x || place.y != rested.place.y)
    rested = {place, followed && rested.shown ? now_s - kTooltipWaits_s : now_s, frame};
  rested.frame = frame;
  rested.shown = now_s - rested.since_s >= kTooltipWaits_s;
  if (rested.shown) ++rested.shown_for;
  return rested.shown;
}

// Where the tooltip covers no other control: beside the panel or dialog that the item is in, where that is narrow and
// the item lies near that side; else below the item, or above it.
void placeTooltip(ImVec2 size, bool above) {
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax(), screen = ImGui::GetIO().DisplaySize;
  const auto* panel = ImGui::GetCurrentWindow()->RootWindow;
  const float gap = ImGui::GetFontSize() * 0.4F, left = panel->Pos.x, right = panel->Pos.x + panel->Size.x;
  ImVec2 at{low.x, high.y + gap};
  constexpr float kNear = 16;  // heights of a line
  const bool to_the_right = screen.x - right >= size.x + gap;
  const bool modal = (panel->Flags & ImGuiWindowFlags_Modal) != 0;
  if (above && size.y <= (low.y + high.y) / 2)  // of the item itself a part may be covered
    at.y = low.y - gap - size.y;
  else if (panel->Size.x < screen.x * (modal ? 0.48F : 0.36F) && panel->Size.y > 4 * (high.y - low.y) &&
           (to_the_right ? right - high.x : low.x - left) < kNear * ImGui::GetFontSize())
    at = {to_the_right ? right + gap : left - gap - size.x, low.y};
  else if (at.y + size.y > screen.y)
    at.y = low.y - gap - size.y;
  ImGui::SetNextWindowPos({std::clamp(at.x, 0.0F, std::max(0.0F, screen.x - size.x)),
                           std::clamp(at.y, 0.0F, std::max(0.0F, screen.y - size.y))});
}

}  // namespace

double tooltipDue_s() {
  if (ImGui::GetFrameCount() != rested.frame || rested.shown_for > 1) return -1;
  return std::max(0.0, rested.since_s + kTooltipWaits_s - ImGui::GetTime());
}

std::string wholeNumbers(const std::string& text, float width) {
  const ImFont& font = *ImGui::GetFont();
  const float scale = ImGui::GetFontSize() / font.FontSize;
  std::string whole = text;
  for (std::size_t line = 0; line < whole.size();) {
    const char* const all = whole.data();
    auto at = static_cast<std::size_t>(font.CalcWordWrapPositionA(scale, all + line, all + whole.size(), width) - all);
    while (at < whole.size() && whole[at] == ' ') ++at;  // blanks end the line before
    if (at <= line || at >= whole.size()) break;
    if (const auto number = beginOfNumber(whole, at); number < at && number > line) {
      whole[number - 1] = '\n';
      at = number;
    }
    line = at;
  }
  return whole;
}

namespace {

void showTooltip(const Text& text, bool above) {
  if (text.empty() || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
  const bool another = ImGui::GetFrameCount() == rested.frame;  // of a row and of a text in it: one below the other
  if (another ? !rested.shown : !hasRested(ImGui::GetItemRectMin())) return;
  const float wrap = ImGui::GetFontSize() * 26;
  const ImVec2 padding = ImGui::GetStyle().WindowPadding;
  const std::string said = wholeNumbers(text, wrap);
  const ImVec2 words = ImGui::CalcTextSize(said.c_str(), nullptr, false, wrap);
  if (!another) placeTooltip({words.x + 2 * padding.x, words.y + 2 * padding.y}, above);
  ImGui::PushStyleVar(ImGuiStyleVar_Alpha, 1.0F);  // also inside a disabled block
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(wrap + padding.x);
  ImGui::TextUnformatted(said.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
  ImGui::PopStyleVar();
}

}  // namespace

void tooltip(const Text& text) { showTooltip(text, false); }
void tooltipAbove(const Text& text) { showTooltip(text, true); }

bool button(const char* label, const std::string& why, ImVec2 size, const char* tip) {
  ImGui::BeginDisabled(!why.empty());
  const Label said(label);
  if (size.x > 0)  // in another language a text may be longer
    size.x = std::max(size.x, ImGui::CalcTextSize(said, nullptr, true).x + 2 * ImGui::GetStyle().FramePadding.x);
  const bool pressed = ImGui::Button(said, size);
  ImGui::EndDisabled();
  tooltip(tr(why.empty() && tip != nullptr ? tip : why));
  return pressed;
}

bool primaryButton(const char* label, const std::string& why, ImVec2 size) {
  if (!why.empty()) return button(label, why, size);  // thinned letters on a thinned blue are hard to read
  ImGui::PushStyleColor(ImGuiCol_Button, ImVec4(0.17F, 0.41F, 0.74F, 1));
  ImGui::PushStyleColor(ImGuiCol_ButtonHovered, ImVec4(0.22F, 0.48F, 0.84F, 1));
  ImGui::PushStyleColor(ImGuiCol_ButtonActive, ImVec4(0.14F, 0.36F, 0.66F, 1));
  ImGui::PushStyleColor(ImGuiCol_Text, tone::kText.dark);  // its ground is dark in either theme
  const bool pressed = button(label, why, size);
  ImGui::PopStyleColor(4);
  return pressed;
}

bool wideButton(const char* id, const Text& text, const std::string& why, const char* tip) {
  const ImVec2 padding = ImGui::GetStyle().FramePadding, at = ImGui::GetCursorScreenPos();
  const float width = std::max(1.0F, ImGui::GetContentRegionAvail().x), room = std::max(1.0F, width - 2 * padding.x);
  const float height = ImGui::CalcTextSize(text.c_str(), nullptr, false, room).y + 2 * padding.y;
  const bool pressed = button(id, why, {width, height}, tip);
  const ImU32 ink = ImGui::GetColorU32(why.empty() ? ImGuiCol_Text : ImGuiCol_TextDisabled);
  const ImVec2 from{at.x + padding.x, at.y + padding.y};
  ImGui::GetWindowDrawList()->AddText(nullptr, 0, from, ink, text.c_str(), nullptr, room);
  return pressed;
}

bool iconButton(const char* label, const char* tip, const std::string& why, bool lit) {
  ImGui::PushStyleColor(ImGuiCol_Button, lit ? kLit : ImVec4(0, 0, 0, 0));
  ImGui::BeginDisabled(!why.empty());
  const bool pressed = ImGui::Button(Label(label));
  ImGui::EndDisabled();
  ImGui::PopStyleColor();
  tooltip(why.empty() ? tr(tip) : tr(tip) + "\n" + tr(why));
  return pressed;
}

void heading(const Style& style, const char* text) {
  ImGui::Dummy({0, style.px(3)});
  if (style.fonts.bold != nullptr) ImGui::PushFont(style.fonts.bold);
  ImGui::TextUnformatted(tr(text).c_str());
  if (style.fonts.bold != nullptr) ImGui::PopFont();
}

bool foldedSection(const std::string& label) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImVec2 end{at.x + ImGui::GetContentRegionAvail().x, at.y + ImGui::GetFrameHeight()};
  ImGui::GetWindowDrawList()->AddRectFilled(at, end, ImGui::GetColorU32(ImGuiCol_Header),
                                            ImGui::GetStyle().FrameRounding);
  return ImGui::TreeNodeEx(label.c_str(), ImGuiTreeNodeFlags_NoTreePushOnOpen | ImGuiTreeNodeFlags_FramePadding |
                                              ImGuiTreeNodeFlags_SpanAvailWidth);
}

void copyTable(const char* id, const std::function<TableRows()>& table) {
  ImGui::SameLine(ImGui::GetContentRegionMax().x - ImGui::GetFrameHeight());
  if (iconButton(fmt::format("{}###copy-{}", ICON_COPY, id).c_str(), "Copy table"))
    ImGui::SetClipboardText(rowsText(table()).c_str());
}

void dimText(const Text& text) { ImGui::TextDisabled("%s", text.c_str()); }

namespace {

float wrapWidth() { return ImGui::CalcWrapWidthForPos(ImGui::GetCursorScreenPos(), 0); }

}  // namespace

void wrapped(const Text& text) {
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(wholeNumbers(text, wrapWidth()).c_str());
  ImGui::PopTextWrapPos();
}

void dimWrapped(const Text& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  wrapped(text);
  ImGui::PopStyleColor();
}

// Dear ImGui 1.90.1 gives an item the keyboard only where its window has it already.
void focusNext() {
  ImGui::SetWindowFocus();
  ImGui::SetKeyboardFocusHere();
}

void gap(const Style& style, float points) { ImGui::Dummy({0, style.px(points)}); }

void emptyState(const Style& style, const char* icon, const char* title, const char* text) {
  const float width = ImGui::GetContentRegionAvail().x;
  const float left = ImGui::GetCursorPosX();
  const auto centred = [&](const char* line) {
    const float own = ImGui::CalcTextSize(line).x;
    ImGui::SetCursorPosX(left + std::max(0.0F, (width - own) / 2));
  };
  ImGui::Dummy({0, std::min(style.px(28), ImGui::GetContentRegionAvail().y * 0.12F)});
  if (style.fonts.huge != nullptr) ImGui::PushFont(style.fonts.huge);
  centred(icon);
  ImGui::TextColored(colour(tone::kFaint), "%s", icon);
  if (style.fonts.huge != nullptr) ImGui::PopFont();
  const Text said(title);
  centred(said.c_str());
  ImGui::TextUnformatted(said.c_str());
  const std::string lines = tr(text);
  const float room = std::min(width - 2 * std::min(width * 0.08F, style.px(40)), style.px(420));
  const float indent = (width - ImGui::CalcTextSize(lines.c_str(), nullptr, false, room).x) / 2;
  ImGui::SetCursorPosX(left + indent);
  ImGui::PushTextWrapPos(left + indent + room);
  ImGui::TextDisabled("%s", lines.c_str());
  ImGui::PopTextWrapPos();
  gap(style, 6);
}

namespace {

// In as many lines as it takes; a word that is too long for one is cut.
void wholeLabel(const Text& text) {
  const float room = ImGui::GetContentRegionAvail().x;
  const auto fits = [&](const std::string& part) { return ImGui::CalcTextSize(part.c_str()).x <= room; };
  std::istringstream words(text);
  if (fits(text) || !std::all_of(std::istream_iterator<std::string>(words), std::istream_iterator<std::string>(), fits))
    return fitted(text, room);
  ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + room);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
}

}  // namespace

bool beginProperties(const char* id, float label_fraction) {
  if (!ImGui::BeginTable(id, 2, ImGuiTableFlags_SizingStretchProp | ImGuiTableFlags_NoPadOuterX)) return false;
  ImGui::TableSetupColumn("label", ImGuiTableColumnFlags_WidthStretch, label_fraction);
  ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch, 1 - label_fraction);
  return true;
}

void propertyLabel(const Text& label) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::AlignTextToFramePadding();
  wholeLabel(label);
  ImGui::TableNextColumn();
  ImGui::SetNextItemWidth(-FLT_MIN);
}

void property(const Text& label, const Text& value) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  wholeLabel(label);
  ImGui::PopStyleColor();
  ImGui::TableNextColumn();
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(value.empty() ? "–" : wholeNumbers(value, wrapWidth()).c_str());
  ImGui::PopTextWrapPos();
  if (!value.empty() && ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(0))
    ImGui::SetClipboardText(value.c_str());
}

void endProperties() { ImGui::EndTable(); }

void meter(const Style& style, double fraction, ImU32 fill, float wanted_width) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = wanted_width > 0 ? wanted_width : ImGui::GetContentRegionAvail().x, height = style.px(6);
  auto& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(at, {at.x + width, at.y + height}, tone::kWell, height / 2);
  const float filled = width * static_cast<float>(std::clamp(fraction, 0.0, 1.0));
  if (filled > height / 2) list.AddRectFilled(at, {at.x + filled, at.y + height}, fill, height / 2);
  ImGui::Dummy({width, height});
}

void swatch(const Style& style, const Colour& shown) {
  const float size = ImGui::GetTextLineHeight() - style.px(3);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float top = at.y + (ImGui::GetTextLineHeight() - size) / 2;
  ImGui::GetWindowDrawList()->AddRectFilled({at.x, top}, {at.x + size, top + size},
                                            ImGui::ColorConvertFloat4ToU32({shown.r, shown.g, shown.b, 1}),
                                            style.px(3));
  ImGui::Dummy({size, ImGui::GetTextLineHeight()});
}

bool searchField(const char* id, const char* hint, std::string& text) {
  ImGui::PushID(id);
  const float clear_width = text.empty() ? 0 : ImGui::GetFrameHeight() + ImGui::GetStyle().ItemSpacing.x / 2;
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - clear_width);
  bool changed = ImGui::InputTextWithHint("###search", fmt::format("{}  {}", ICON_SEARCH, tr(hint)).c_str(), &text);
  if (clear_width > 0) {
    ImGui::SameLine(0, ImGui::GetStyle().ItemSpacing.x / 2);
    if (iconButton(ICON_CLOSE "###clear", "Clear search")) {
      text.clear();
      changed = true;
    }
  }
  ImGui::PopID();
  return changed;
}

void textRightAligned(const Text& text) {
  const float free = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text.c_str()).x;
  if (free > 0) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + free);
  ImGui::TextUnformatted(text.c_str());
}

void tableHead(std::initializer_list<int> figures) {
  ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
  for (int column = 0; column < ImGui::TableGetColumnCount(); ++column) {
    if (!ImGui::TableSetColumnIndex(column)) continue;
    const char* name = ImGui::TableGetColumnName(column);
    const float free = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(name, nullptr, true).x;
    if (free > 0 && std::find(figures.begin(), figures.end(), column) != figures.end())
      ImGui::SetCursorPosX(ImGui::GetCursorPosX() + free);
    ImGui::PushID(column);
    ImGui::TableHeader(name);
    ImGui::PopID();
  }
}

float shareOfRow(int count) {
  const auto n = static_cast<float>(count);
  return (ImGui::GetContentRegionAvail().x - (n - 1) * ImGui::GetStyle().ItemSpacing.x) / n;
}

std::string fittingLabel(const char* icon, const char* text, const char* id, float width) {
  const std::string said = tr(text), whole = std::string(icon) + "  " + said;
  const float room = width - 2 * ImGui::GetStyle().FramePadding.x;
  return (ImGui::CalcTextSize(whole.c_str()).x <= room  ? whole
          : ImGui::CalcTextSize(said.c_str()).x <= room ? said
                                                        : std::string(icon)) +
         "###" + id;
}

std::string fittingText(const std::string& text, float width) {
  if (ImGui::CalcTextSize(text.c_str()).x <= width) return text;
  std::string cut = text;
  while (!cut.empty() && ImGui::CalcTextSize((cut + "…").c_str()).x > width) {
    while (!cut.empty() && (static_cast<unsigned char>(cut.back()) & 0xC0) == 0x80) cut.pop_back();  // of one letter
    if (!cut.empty()) cut.pop_back();
  }
  return cut + "…";
}

std::string fittingMiddle(const std::string& text, float width) {
  if (ImGui::CalcTextSize(text.c_str()).x <= width) return text;
  std::vector<std::size_t> letters;  // where each begins
  for (std::size_t i = 0; i < text.size(); ++i)
    if ((static_cast<unsigned char>(text[i]) & 0xC0) != 0x80) letters.push_back(i);
  if (letters.empty()) return text;
  const auto cut = [&](std::size_t kept) {
    const std::size_t tail = kept / 2;
    return text.substr(0, letters[kept - tail]) + "…" +
           (tail > 0 ? text.substr(letters[letters.size() - tail]) : std::string());
  };
  std::size_t kept = letters.size() - 1;
  while (kept > 0 && ImGui::CalcTextSize(cut(kept).c_str()).x > width) --kept;
  return cut(kept);
}

void fittedMiddle(const Text& text, float width) {
  const auto shown = fittingMiddle(text, width);
  ImGui::TextUnformatted(shown.c_str());
  if (shown != static_cast<const std::string&>(text)) tooltip(text);
}

void fitted(const Text& text, float width) {
  if (ImGui::CalcTextSize(text.c_str()).x <= width) {
    ImGui::TextUnformatted(text.c_str());
    return;
  }
  ImVec2 at = ImGui::GetCursorScreenPos();
  const float height = ImGui::GetTextLineHeight(), down = ImGui::GetCurrentWindow()->DC.CurrLineTextBaseOffset;
  at.y += down;  // beside what has a frame
  ImGui::Dummy({std::max(width, 1.0F), height + down});
  ImGui::RenderTextEllipsis(ImGui::GetWindowDrawList(), at, {at.x + width, at.y + height + 2}, at.x + width,
                            at.x + width, text.c_str(), nullptr, nullptr);
  tooltip(text);
}

}  // namespace ui

std::string metres(double value, int decimals) { return figures("{:.{}f} m", value, decimals); }

std::string coordinates(const Eigen::Vector3d& v) { return figures("{:.3f}  {:.3f}  {:.3f}", v.x(), v.y(), v.z()); }

std::string durationText(double seconds) {
  const auto whole = std::llround(seconds);
  return fmt::format("{}:{:02} min", whole / 60, whole % 60);
}

ImU32 packed(const std::array<std::uint8_t, 4>& c) { return IM_COL32(c[0], c[1], c[2], c[3]); }

}  // namespace standpoint
