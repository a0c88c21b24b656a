// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <imgui.h>

#include "editor/panels/actions.h"
#include "editor/panels/panel.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/widgets.h"
#include "editor/words/sentences.h"

namespace standpoint {

namespace {

struct HistoryState {
  std::size_t seen = 0, position = 0;  // steps when it was drawn last, and the current one: it is kept in view
};

void drawStep(const Model& model, Actions& actions, std::size_t step) {
  const auto& history = model.session.history();
  const bool current = step == history.position(), undone = step > history.position();
  ImGui::PushID(static_cast<int>(step));
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  if (current) ImGui::TextColored(colour(tone::kAccent), "%s", ICON_CHEVRON_RIGHT);
  ImGui::TableNextColumn();
  ui::dimText(fmt::format("{}", step));
  ImGui::TableNextColumn();
  const auto why = current ? std::string() : model.session.whyNotGoTo(step);
  ImGui::BeginDisabled(!why.empty());
  ImGui::PushStyleColor(ImGuiCol_Text, undone ? tone::kDim : tone::kText);
  const std::string label =
      fmt::format("{}{}###step", trSentence(history.description(step)), undone ? "  " + tr("(undone)") : "");
  if (ImGui::Selectable(label.c_str(), current, ImGuiSelectableFlags_SpanAllColumns) && !current) actions.goTo(step);
  ImGui::PopStyleColor();
  ImGui::EndDisabled();
  ui::tooltip(why);
  ImGui::TableNextColumn();
  if (history.isSaved(step)) ui::dimText("saved");
  ImGui::PopID();
}

void draw(const Model& model, HistoryState& state, Actions& actions) {
  const auto& history = model.session.history();
  if (history.size() == 1 && !model.environment()) {
    ui::dimText("No steps. Each change appears here; click a step to go back to it.");
    return;
  }
  ui::heading(model, "History: click a step to undo or redo to it");
  ui::copyTable("steps", [&] {
    TableRows table = {{"n", tr("Step"), tr("State")}};
    for (std::size_t i = 0; i < history.size(); ++i)
      table.push_back({std::to_string(i), trSentence(history.description(i)),
                       i > history.position() ? tr("(undone)")
                       : history.isSaved(i)   ? tr("saved")
                                              : std::string()});
    return table;
  });
  if (!ImGui::BeginTable("steps", 4, ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg)) return;
  ImGui::TableSetupColumn("current", ImGuiTableColumnFlags_WidthFixed, model.px(18));
  ImGui::TableSetupColumn("number", ImGuiTableColumnFlags_WidthFixed, model.px(34));
  ImGui::TableSetupColumn("step", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("saved", ImGuiTableColumnFlags_WidthFixed, model.px(60));
  const bool moved = state.seen != history.size() || state.position != history.position();
  state = {history.size(), history.position()};
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(history.size()));
  while (clipper.Step())
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i)
      drawStep(model, actions, static_cast<std::size_t>(i));
  if (moved) {
    const float row = ImGui::GetTextLineHeightWithSpacing();
    ImGui::SetScrollY(row * static_cast<float>(state.position) - ImGui::GetWindowHeight() / 2);
  }
  ImGui::EndTable();
}

}  // namespace

void drawHistoryPanel(const Model& model, PanelStates& states, Actions& actions) {
  draw(model, states.of<HistoryState>(), actions);
}

}  // namespace standpoint
