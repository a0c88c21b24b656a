// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>

#include <fmt/format.h>
#include <imgui.h>

#include "editor/panels/actions.h"
#include "editor/panels/panel.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/keyboard.h"
#include "editor/widgets/number_field.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/widgets.h"
#include "project/model/bookmarks.h"

namespace standpoint {

namespace {

struct BookmarksState {
  int chosen = -1;
  int renamed = -1;  // whose name is edited
  std::string name;
  bool begun = false;  // the field has the keyboard
};

void drawName(BookmarksState& state, Actions& actions, const Bookmark& bookmark) {
  ImGui::SetNextItemWidth(-2 * ImGui::GetFrameHeight());
  if (!state.begun) ui::focusNext();
  const bool changed = ui::textField("###bookmark-name", state.name);
  if (changed && state.name != bookmark.name)
    actions.start(BookmarkOptions{.rename = bookmark.name, .name = state.name},
                  trf("Rename bookmark {}", bookmark.name));
  if (changed || (state.begun && !ImGui::IsItemActive())) state.renamed = -1;
  state.begun = true;
}

void beginRenaming(BookmarksState& state, int i, const Bookmark& bookmark) {
  state.renamed = i;
  state.name = bookmark.name;
  state.begun = false;
}

void drawRow(const Model& model, BookmarksState& state, Actions& actions, const Bookmark& bookmark, int i) {
  ImGui::PushID(i);
  const float button = ImGui::GetFrameHeight();
  if (state.renamed == i) {
    drawName(state, actions, bookmark);
  } else {
    if (ImGui::Selectable("###bookmark", state.chosen == i,
                          ImGuiSelectableFlags_AllowItemOverlap | ImGuiSelectableFlags_AllowDoubleClick,
                          {ImGui::GetContentRegionAvail().x - button, 0})) {
      state.chosen = i;
      if (ImGui::IsMouseDoubleClicked(0))
        beginRenaming(state, i, bookmark);
      else
        actions.goToBookmark(static_cast<std::size_t>(i));
    }
    ui::tooltip("Go there; double click or F2 to rename");
    ImGui::SameLine(model.px(10));
    ImGui::TextDisabled("%s", bookmark.on_foot ? ICON_WALK : ICON_BOOKMARK);
    ImGui::SameLine();
    ui::fitted(bookmark.name, ImGui::GetContentRegionAvail().x - button - model.px(4));
  }
  ImGui::SameLine(ImGui::GetContentRegionMax().x - button);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(model.px(4), 0));
  if (ui::iconButton(ICON_TRASH "###remove-bookmark", "Remove", model.session.whyNot("bookmark")))
    actions.start(BookmarkOptions{.remove = bookmark.name}, trf("Remove bookmark {}", bookmark.name));
  ImGui::PopStyleVar();
  ImGui::PopID();
}

void draw(const Model& model, BookmarksState& state, Actions& actions) {
  if (!model.environment()) {
    ui::emptyState(model, ICON_BOOKMARK, "No bookmarks", "Import a model first.");
    return;
  }
  actions.button("add-bookmark", "Keep this view", -FLT_MIN);
  const auto& bookmarks = model.session.document().bookmarks;
  if (!bookmarks) {
    ui::gap(model);
    ui::dimWrapped("Views that you keep are listed here, and found by * in the command palette.");
    state = {};
    return;
  }
  const int count = static_cast<int>(bookmarks->size());
  if (state.chosen >= count) state.chosen = -1;
  if (state.renamed >= count) state.renamed = -1;
  if (state.chosen >= 0 && state.renamed < 0 && ImGui::IsWindowFocused() && keyboard::pressed(kKeyF2))
    beginRenaming(state, state.chosen, (*bookmarks)[static_cast<std::size_t>(state.chosen)]);
  for (int i = 0; i < count; ++i) drawRow(model, state, actions, (*bookmarks)[static_cast<std::size_t>(i)], i);
}

}  // namespace

void drawBookmarksPanel(const Model& model, PanelStates& states, Actions& actions) {
  draw(model, states.of<BookmarksState>(), actions);
}

}  // namespace standpoint
