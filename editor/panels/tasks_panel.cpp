// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include <fmt/format.h>
#include <imgui.h>

#include "editor/panels/actions.h"
#include "editor/panels/panel.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/job_progress.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/widgets.h"
#include "editor/words/sentences.h"

namespace standpoint {

namespace {

std::string duration(double seconds) {
  if (seconds < 60) return figures("{:.1f} s", seconds);
  return fmt::format("{}:{:02} min", static_cast<int>(seconds) / 60, static_cast<int>(seconds) % 60);
}

void drawRunning(const Model& model, VerbTask& task, int i) {
  auto& progress = task.progress();
  ImGui::PushID(i);
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextColored(colour(tone::kAccent), "%s", ICON_REFRESH);
  ImGui::TableNextColumn();
  ui::fitted(task.title(), ImGui::GetContentRegionAvail().x);
  ImGui::TableNextColumn();
  const float bar = model.px(120), room = ImGui::GetContentRegionAvail().x - bar - model.px(66 + 16);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::SetCursorScreenPos({at.x, at.y + (ImGui::GetFrameHeight() - model.px(6)) / 2});
  ui::jobBar(model, progress, bar);
  ImGui::SetCursorScreenPos({at.x + bar + model.px(8), at.y});
  ImGui::AlignTextToFramePadding();
  ui::fitted(ui::jobText(progress, task.seconds()), std::max(room, 1.0F));
  ImGui::SetCursorScreenPos({at.x + bar + room + model.px(16), at.y});
  ui::cancelButton(model, "Cancel", progress, 66);
  ImGui::TableNextColumn();
  ui::dimText(duration(task.seconds()));
  ImGui::PopID();
}

void drawFinished(const FinishedTask& task) {
  const char* icon = task.ok ? ICON_CHECK : task.cancelled ? ICON_STOP : ICON_BAN;
  const ImU32 tone = task.ok ? tone::kGood : task.cancelled ? tone::kDim : tone::kBad;
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextColored(colour(tone), "%s", icon);
  ImGui::TableNextColumn();
  ui::fitted(task.title, ImGui::GetContentRegionAvail().x);
  ImGui::TableNextColumn();
  ui::fitted(trSentence(task.text), ImGui::GetContentRegionAvail().x);
  ImGui::TableNextColumn();
  ui::dimText(duration(task.seconds));
}

}  // namespace

void drawTasksPanel(const Model& model, PanelStates&, Actions&) {
  if (model.session.running().empty() && model.session.finished().empty()) {
    ui::dimText("No tasks. Running tasks appear here with progress and a cancel button.");
    return;
  }
  ui::heading(model, "Tasks");
  ui::copyTable("tasks", [&] {
    TableRows table = {{tr("Time"), tr("Task"), tr("Result"), "s"}};
    for (const auto& task : model.session.finished())
      table.push_back({task.time, task.title, trSentence(task.text), figures("{:.1f}", task.seconds)});
    return table;
  });
  if (!ImGui::BeginTable("tasks", 4, ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg)) return;
  ImGui::TableSetupColumn("state", ImGuiTableColumnFlags_WidthFixed, model.px(18));
  ImGui::TableSetupColumn("title", ImGuiTableColumnFlags_WidthStretch, 0.34F);
  ImGui::TableSetupColumn("result", ImGuiTableColumnFlags_WidthStretch, 0.66F);
  ImGui::TableSetupColumn("time", ImGuiTableColumnFlags_WidthFixed, model.px(70));
  int i = 0;
  for (const auto& task : model.session.running()) drawRunning(model, *task, i++);
  for (const auto& task : model.session.finished()) drawFinished(task);
  ImGui::EndTable();
}

}  // namespace standpoint
