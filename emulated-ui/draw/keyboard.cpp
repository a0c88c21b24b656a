// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/draw/keyboard.h"

#include <algorithm>
#include <cctype>

#include <imgui.h>

#include "emulated-ui/draw/pen.h"

namespace standpoint {

namespace {

using KeyRow = std::vector<const char*>;

const std::vector<KeyRow>& rowsOf(KeyPage page) {
  static const std::vector<KeyRow> letters = {{"1", "2", "3", "4", "5", "6", "7", "8", "9", "0"},
                                              {"q", "w", "e", "r", "t", "y", "u", "i", "o", "p"},
                                              {"a", "s", "d", "f", "g", "h", "j", "k", "l"},
                                              {"shift", "z", "x", "c", "v", "b", "n", "m", "back"},
                                              {"signs", "-", " ", "_", ".", "ok"}};
  static const std::vector<KeyRow> signs = {{"1", "2", "3", "4", "5", "6", "7", "8", "9", "0"},
                                            {"@", "#", "$", "%", "&", "+", "=", "(", ")", "~"},
                                            {"!", ",", ";", "'", "[", "]", "{", "}", "^"},
                                            {"/", "\\", ":", "*", "?", "\"", "<", ">", "|", "back"},
                                            {"letters", "-", " ", "_", ".", "ok"}};
  static const std::vector<KeyRow> figures = {
      {"7", "8", "9", "back"}, {"4", "5", "6"}, {"1", "2", "3"}, {"-", "0", ".", "ok"}};
  return page == KeyPage::figures ? figures : page == KeyPage::signs ? signs : letters;
}

// In tenths of the keyboard; of figures, which are large, in quarters.
float fractionOf(const std::string& key, KeyPage page) {
  if (page == KeyPage::figures) return 2.5F;
  if (key == " ") return 3.5F;
  if (key == "ok") return 2;
  if (key == "shift" || key == "signs" || key == "letters") return 1.5F;
  return key == "back" && page != KeyPage::signs ? 1.5F : 1;
}

float gapOf(const Pen& pen) { return 0.25F * pen.unit; }

// A finger between two keys presses the nearer one.
bool holds(const Pen& pen, const KeyCap& cap) {
  const auto& k = pen.view.keyboard;
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const float half = gapOf(pen) / 2, x = mouse.x - k.left - cap.x, y = mouse.y - k.top - cap.y;
  return x >= -half && x < cap.width + half && y >= -half && y < cap.height + half;
}

// What no font is sure to have.
void arrow(const Pen& pen, ImVec2 middle, ImU32 colour, bool up) {
  const float s = 0.5F * pen.unit, line = pen.hair(1.5F);
  ImDrawList* list = ImGui::GetWindowDrawList();
  const auto turned = [&](float along, float across) {
    return up ? ImVec2{middle.x + across, middle.y - along} : ImVec2{middle.x - along, middle.y + across};
  };
  list->AddLine(turned(-s, 0), turned(s, 0), colour, line);
  list->AddLine(turned(s, 0), turned(0.2F * s, -0.8F * s), colour, line);
  list->AddLine(turned(s, 0), turned(0.2F * s, 0.8F * s), colour, line);
}

void drawCap(Pen& pen, const KeyCap& cap) {
  const auto& keyboard = pen.view.keyboard;
  const ImVec2 at{keyboard.left + cap.x, keyboard.top + cap.y}, size{cap.width, cap.height};
  const bool hovered = holds(pen, cap), held = hovered && ImGui::IsMouseDown(ImGuiMouseButton_Left);
  const bool lit = cap.key == "ok" || held || (cap.key == "shift" && keyboard.page == KeyPage::capitals);
  const ImU32 ink = lit ? pen.skin.accent_text : pen.skin.tile_text;
  ImDrawList* list = ImGui::GetWindowDrawList();
  const ImVec2 end{at.x + size.x, at.y + size.y};
  const ImU32 fill = lit ? pen.skin.accent : hovered ? pen.skin.tile_hover : pen.skin.tile;
  list->AddRectFilled(at, end, fill, 0.3F * pen.unit);
  if (hovered && lit) list->AddRect(at, end, pen.skin.tile_text, 0.3F * pen.unit, 0, pen.hair());
  const ImVec2 middle{at.x + size.x / 2, at.y + size.y / 2};
  if (cap.key == "shift" || cap.key == "back") return arrow(pen, middle, ink, cap.key == "shift");
  const bool capital = keyboard.page == KeyPage::capitals && cap.key.size() == 1;
  const auto text = capital ? std::string(1, static_cast<char>(std::toupper(static_cast<unsigned char>(cap.key[0]))))
                    : cap.key == "ok"      ? pen.device.word("ok")
                    : cap.key == "signs"   ? "#+="
                    : cap.key == "letters" ? "abc"
                                           : cap.key;
  centred(list, at, size, ink, text);
}

}  // namespace

int keyRows(KeyPage page) { return static_cast<int>(rowsOf(page).size()); }

std::vector<KeyCap> keyCaps(KeyPage page, float width, float height, float gap) {
  const auto& rows = rowsOf(page);
  const float row_height = (height - gap) / static_cast<float>(rows.size()), tenth = (width - gap) / 10;
  std::vector<KeyCap> caps;
  float y = gap;
  for (const auto& row : rows) {
    float fractions = 0;
    for (const char* key : row) fractions += fractionOf(key, page);
    float x = gap + (page == KeyPage::figures ? 0 : (10 - fractions) / 2 * tenth);
    for (const char* key : row) {
      const float own = fractionOf(key, page) * tenth;
      caps.push_back({key, x, y, own - gap, row_height - gap});
      x += own;
    }
    y += row_height;
  }
  return caps;
}

void pressKey(Keyboard& keyboard, const std::string& key) {
  auto& page = keyboard.page;
  if (key == "ok") return;
  if (key == "shift")
    page = page == KeyPage::capitals ? KeyPage::letters : KeyPage::capitals;
  else if (key == "signs")
    page = KeyPage::signs;
  else if (key == "letters")
    page = KeyPage::letters;
  else if (key == "back")
    keyboard.typed += '\b';
  else if (page != KeyPage::capitals)
    keyboard.typed += key;
  else {
    keyboard.typed += static_cast<char>(std::toupper(static_cast<unsigned char>(key[0])));
    page = KeyPage::letters;  // one capital begins a name
  }
}

float keyboardHeight(const Pen& pen, float room) {
  const auto page = pen.view.keyboard.page;
  const auto rows = static_cast<float>(keyRows(page));
  return std::min(rows * (pen.touch() + gapOf(pen)) + gapOf(pen), 0.62F * room);
}

void drawKeyboard(Pen& pen, ImVec2 at, ImVec2 size) {
  auto& keyboard = pen.view.keyboard;
  keyboard.left = at.x, keyboard.top = at.y, keyboard.width = size.x, keyboard.height = size.y;
  ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + size.x, at.y + size.y}, pen.skin.line);
  const auto caps = keyCaps(keyboard.page, size.x, size.y, gapOf(pen));
  for (const auto& cap : caps) drawCap(pen, cap);
  if (!ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem)) return;
  for (const auto& cap : caps)
    if (holds(pen, cap) && ImGui::IsMouseClicked(ImGuiMouseButton_Left, cap.key == "back"))
      return pressKey(keyboard, cap.key);
}

bool keyboardIsPressed(const Pen& pen) {
  const auto& k = pen.view.keyboard;
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  if (mouse.x < k.left || mouse.x >= k.left + k.width || mouse.y < k.top || mouse.y >= k.top + k.height) return false;
  for (const auto& cap : keyCaps(k.page, k.width, k.height, gapOf(pen)))
    if (holds(pen, cap)) return cap.key != "ok";
  return true;
}

}  // namespace standpoint
