// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <sstream>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "core/readable_name.h"
#include "editor/labels/alphabetical.h"
#include "editor/model/bookmark_steps.h"
#include "editor/model/selection_view.h"
#include "editor/panels/panels.h"
#include "editor/shell/actions.h"
#include "editor/shell/dialogs.h"
#include "editor/shell/editor.h"
#include "editor/shell/graphics_choice.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/keyboard.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/widgets.h"

namespace standpoint {

namespace {

struct Entry {
  std::string id, icon, title, detail, why;
  std::function<void()> run;
  std::string also = {};  // other words that it is found by
};

// What others call the same.
std::string otherWords(std::string_view action) {
  struct Called {
    std::string_view action;
    const char* words;
  };
  constexpr std::array kCalled = {
      Called{"add-row", "array line several copies of stations"},
      Called{"teleport", "jump go to"},
      Called{"view-before", "back return go back"},
      Called{"add-target", "sphere checkerboard"},
      Called{"picture", "screenshot image"},
      Called{"panorama", "image sphere"},
      Called{"turntable", "video movie"},
      Called{"walk-through", "video movie"},
      Called{"preferences", "settings options language graphics quality"},
      Called{"export", "save model as glTF OBJ"},
      Called{"export-points", "save scan point cloud as E57 LAS PTX PLY"},
      Called{"walk", "first person"},
      Called{"scan-walk", "live carried mobile handheld SLAM BLK2GO"},
      Called{"record-walk", "path trajectory"},
      Called{"shortcuts", "keys help"},
  };
  const auto* found = std::find_if(kCalled.begin(), kCalled.end(), [&](const auto& c) { return c.action == action; });
  return found == kCalled.end() ? std::string() : tr(found->words);
}

bool matches(const std::string& text, const std::string& query) {
  const std::string all = forSearch(text);
  std::istringstream words(forSearch(query));
  for (std::string word; words >> word;)
    if (all.find(word) == std::string::npos) return false;
  return true;
}

bool ownToEditor(const Verb& verb) {
  const std::string_view name = verb.name;
  return name == "save-project" || name == "open-project" || name == "save-recovery" || name == "open-recovery";
}

std::vector<Entry> entries(Editor& editor) {
  std::vector<Entry> all;
  for (const auto& action : actions()) {
    const auto about = aboutGraphics(editor, action.id);
    all.push_back({action.id, action.icon, tr(action.title), about.empty() ? shortcutText(action.shortcut) : about,
                   whyNot(action, editor), [&editor, &action] { action.run(editor); }, otherWords(action.id)});
  }
  for (const auto& verb : editor.session.verbs())
    if (!ownToEditor(verb))
      all.push_back({fmt::format("verb-{}", verb.name), ICON_GEAR, tr(verb.summary), verb.name,
                     editor.session.whyNot(verb.name), [&editor, &verb] { openVerbForm(editor, verb.name); }});
  for (const auto& recent : editor.settings.recent)
    all.push_back({fmt::format("recent-{}", recent), ICON_HISTORY,
                   trf("Open {}", std::filesystem::path(recent).filename().string()), recent,
                   editor.session.whyNot("open-project"), [&editor, recent] { openPath(editor, recent); }});
  return all;
}

void sortAsPeopleDo(std::vector<Entry>& entries) {
  std::vector<std::pair<std::string, std::size_t>> keys;
  for (std::size_t i = 0; i < entries.size(); ++i) keys.emplace_back(alphabeticalKey(entries[i].title), i);
  std::sort(keys.begin(), keys.end());
  std::vector<Entry> sorted;
  for (const auto& [key, i] : keys) sorted.push_back(std::move(entries[i]));
  entries = std::move(sorted);
}

std::vector<Entry> roomsAndStoreys(Editor& editor) {
  std::vector<Entry> all;
  const auto& environment = editor.session.document().imported;
  if (!environment) return all;
  for (std::uint32_t p = 0; p < environment->products.size(); ++p) {
    const auto& product = environment->products[p];
    if (product.ifc_class == "IfcSpace" && !product.excluded)
      all.push_back({fmt::format("room-{}", p), ICON_WALK, readableName(product), product.storey, "",
                     [&editor, p] { jumpToRoom(editor, p); }});
  }
  sortAsPeopleDo(all);
  for (const auto& level : editor.storeys()) {
    const auto& name = environment->spatial[static_cast<std::size_t>(level.node)].name;
    all.push_back({fmt::format("storey-{}", level.node), ICON_STOREY, name.empty() ? tr("Storey") : name,
                   trf("Storey at {:+.2f} m", level.elevation_m + editor.shift_m().z()), "",
                   [&editor, node = level.node] { jumpToStorey(editor, node); }});
  }
  return all;
}

std::vector<Entry> stations(Editor& editor) {
  std::vector<Entry> all;
  const auto& job = editor.session.document().job;
  for (std::size_t i = 0; job && i < job->stations.size(); ++i)
    all.push_back({fmt::format("station-{}", i), ICON_STATION, job->stations[i].name, tr("Station"), "",
                   [&editor, i] { jumpToStation(editor, i); }});
  return all;
}

std::vector<Entry> bookmarks(Editor& editor) {
  std::vector<Entry> all;
  const auto& kept = editor.session.document().bookmarks;
  for (std::size_t i = 0; kept && i < kept->size(); ++i)
    all.push_back({fmt::format("bookmark-{}", i), ICON_BOOKMARK, (*kept)[i].name, tr("Bookmark"), "",
                   [&editor, i] { goToBookmark(editor, i); }});
  return all;
}

// Of a building with ten thousand, as many as anybody reads; looked for when the words change, not in every frame.
const std::vector<std::uint32_t>& foundProducts(Editor& editor, const std::string& words) {
  constexpr std::size_t kMost = 200;
  auto& found = editor.dialogs.palette.found;
  const auto& environment = editor.environment();
  if (found.environment == environment && found.words == words) return found.products;
  found = {environment, words, {}};
  for (std::uint32_t p = 0; environment && p < environment->products.size() && found.products.size() < kMost; ++p) {
    const auto& product = environment->products[p];
    if (product.inScene() && matches(productLabel(product) + " " + product.storey, words)) found.products.push_back(p);
  }
  return found.products;
}

std::vector<Entry> products(Editor& editor, const std::string& words) {
  std::vector<Entry> all;
  for (const auto p : foundProducts(editor, words)) {
    const auto& product = editor.environment()->products[p];
    all.push_back({fmt::format("product-{}", p), ICON_CUBE, productLabel(product), product.storey, "", [&editor, p] {
                     editor.select(p, true);
                     showSelection(editor);
                   }});
  }
  return all;
}

// Commands first, then the places and things of the project. "@" asks for rooms and storeys alone, "#" for stations,
// "*" for bookmarks, "/" for products; without a word there are commands alone.
std::vector<Entry> matching(Editor& editor, const std::string& query) {
  const char kind = query.empty() || std::string_view("@#*/").find(query[0]) == std::string_view::npos ? 0 : query[0];
  const std::string words = kind == 0 ? query : query.substr(1);
  std::vector<Entry> shown;
  const auto add = [&](std::vector<Entry> found) {
    for (auto& entry : found)
      if (matches(entry.title + " " + entry.detail + " " + entry.also, words)) shown.push_back(std::move(entry));
  };
  const auto wanted = [&](char own) { return kind == own || (kind == 0 && !words.empty()); };
  if (kind == 0) add(entries(editor));
  if (wanted('@')) add(roomsAndStoreys(editor));
  if (wanted('#')) add(stations(editor));
  if (wanted('*')) add(bookmarks(editor));
  if (wanted('/')) add(products(editor, words));
  return shown;
}

void drawEntry(Editor& editor, const Entry& entry, bool chosen, bool& done) {
  const auto flags = entry.why.empty() ? ImGuiSelectableFlags_None : ImGuiSelectableFlags_Disabled;
  const float right = ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x - editor.px(8);
  ImGui::SetNextItemWidth(-FLT_MIN);
  const bool pressed = ImGui::Selectable(("###palette-" + entry.id).c_str(), chosen, flags);
  ui::tooltip(tr(entry.why));
  ImGui::SameLine(editor.px(16));
  ImGui::BeginDisabled(!entry.why.empty());
  ImGui::TextDisabled("%s", entry.icon.c_str());
  ImGui::SameLine(editor.px(44));
  const float room = right - editor.px(44 + 24) - ImGui::CalcTextSize(entry.title.c_str()).x;
  const float width = std::min(ImGui::CalcTextSize(entry.detail.c_str()).x, std::max(room, editor.px(220)));
  ui::fitted(entry.title, right - width - editor.px(44 + 12));
  ImGui::EndDisabled();
  ImGui::SameLine(right - width);
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  ui::fitted(entry.detail, width);
  ImGui::PopStyleColor();
  if (!pressed) return;
  done = true;
  entry.run();
}

// A field that has just got the keyboard has all of its text selected, which the first letter would replace.
int typeAtEnd(ImGuiInputTextCallbackData* data) {
  if (!std::exchange(*static_cast<bool*>(data->UserData), false)) return 0;
  data->ClearSelection();
  data->CursorPos = data->BufTextLen;
  return 0;
}

}  // namespace

void openPalette(Editor& editor) { editor.dialogs.palette = {.open = true}; }

void openPaletteOfRooms(Editor& editor) { editor.dialogs.palette = {.open = true, .query = "@", .at_end = true}; }

void drawPalette(Editor& editor) {
  auto& state = editor.dialogs.palette;
  constexpr const char* kId = "###palette";
  if (state.open && !state.shown) ImGui::OpenPopup(kId);
  state.shown = state.open;
  const float width = std::min(editor.px(600), ImGui::GetIO().DisplaySize.x * 0.9F);
  ImGui::SetNextWindowPos({ImGui::GetIO().DisplaySize.x / 2, editor.px(80)}, ImGuiCond_Always, {0.5F, 0});
  ImGui::SetNextWindowSize({width, 0});
  if (!ImGui::BeginPopup(kId, ImGuiWindowFlags_NoMove)) {
    state.open = false;  // by a click beside it
    return;
  }
  if (ImGui::IsWindowAppearing()) ui::focusNext();
  ImGui::SetNextItemWidth(-FLT_MIN);
  if (ImGui::InputTextWithHint("###query",
                               tr("Search; only @ rooms and storeys, # stations, * bookmarks, / products").c_str(),
                               &state.query, ImGuiInputTextFlags_CallbackAlways, typeAtEnd, &state.at_end))
    state.chosen = 0;
  const bool enter = keyboard::pressed(kKeyEnter);
  const auto shown = matching(editor, state.query);
  if (enter && shown.empty()) {  // Enter ends the field, but there is more to be typed
    ImGui::SetKeyboardFocusHere(-1);
    state.at_end = true;
  }
  const int last = std::max(0, static_cast<int>(shown.size()) - 1);
  const int step = (keyboard::pressedOrRepeated(kKeyDown) ? 1 : 0) - (keyboard::pressedOrRepeated(kKeyUp) ? 1 : 0);
  const bool moved = step != 0;
  state.chosen += step;
  state.chosen = std::clamp(state.chosen, 0, last);
  bool done = false;
  ImGui::BeginChild("list", {0, editor.px(340)});
  // A row reaches half of the space between rows beyond its text, the first one too.
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ImGui::GetStyle().ItemSpacing.x, editor.px(6)});
  ImGui::SetCursorPosY(editor.px(3));
  for (int i = 0; i < static_cast<int>(shown.size()); ++i) {
    const auto& entry = shown[static_cast<std::size_t>(i)];
    drawEntry(editor, entry, i == state.chosen, done);
    if (i == state.chosen && moved) ImGui::SetScrollHereY();
    if (i == state.chosen && enter && entry.why.empty()) {
      done = true;
      entry.run();
    }
  }
  if (shown.empty()) ui::dimText("No matches");
  ImGui::PopStyleVar();
  ImGui::EndChild();
  if (done) {
    state.open = false;
    ImGui::CloseCurrentPopup();
  }
  ImGui::EndPopup();
}

}  // namespace standpoint
