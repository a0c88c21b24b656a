// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/shell/status_bar.h"

#include <algorithm>
#include <chrono>
#include <cstring>

#include <fmt/format.h>
#include <imgui.h>

#include "editor/shell/actions.h"
#include "editor/shell/editor.h"
#include "editor/shell/inspect_tools.h"
#include "editor/shell/shell.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/job_progress.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/widgets.h"

namespace standpoint {

namespace {

std::string placeText(const Eigen::Vector3d& place) {
  return figures("{:.3f}  {:.3f}  {:.3f} m", place.x(), place.y(), place.z());
}

// What a tool measures there, else the product under the pointer.
std::string hoverText(const Editor& editor) {
  const auto& view = editor.view;
  if (measures(editor) && view.measured && !view.measured->cloud.empty())
    return trf("Point of {}   {}", view.measured->cloud, placeText(view.measured->position + editor.shift_m()));
  const auto& hover = view.door_hover ? view.door_hover : view.hover;
  if (measures(editor) && (editor.cloud() || !view.measured)) return {};  // the model is not what is measured
  if (!hover || !editor.environment() || hover->product >= editor.environment()->products.size()) return {};
  const auto& product = editor.environment()->products[hover->product];
  return fmt::format("{}   {}   {}", tr(readableClass(product.ifc_class)), productLabel(product),
                     placeText(hover->position + editor.shift_m()));
}

// A task, else the scan or the underlay that is being read to be shown.
bool drawRunningTask(Editor& editor) {
  const auto& running = editor.session.running();
  VerbTask* shown = nullptr;
  for (const auto& task : running)
    if (std::strcmp(task->verb().name, "save-recovery") != 0) shown = task.get();
  const bool scan = shown == nullptr && editor.readingCloud();
  Progress* const followed = shown != nullptr ? &shown->progress()
                             : scan           ? editor.cloudLoader().progress()
                                              : editor.underlays.progress();
  if (followed == nullptr) return false;
  auto& progress = *followed;
  const std::string title = shown != nullptr ? shown->title()
                            : scan           ? tr("Reading the scan")
                                             : trf("Showing {}", editor.underlays.reading());
  const std::string how_far = ui::jobText(progress, shown != nullptr ? shown->seconds()
                                                    : scan           ? editor.cloudLoader().seconds()
                                                                     : 0);
  const std::string text = how_far.empty() ? title : title + "   " + how_far;
  const float bar = editor.px(160), cancel = editor.px(64);
  const float width = ImGui::CalcTextSize(text.c_str()).x + bar + cancel + editor.px(30);
  ImGui::SameLine(std::max(0.0F, ImGui::GetWindowWidth() - width - editor.px(10)));
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(text.c_str());
  ImGui::SameLine();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::SetCursorScreenPos({at.x, at.y + (ImGui::GetFrameHeight() - editor.px(6)) / 2});
  ui::jobBar(editor, progress, bar);
  ImGui::SetCursorScreenPos({at.x + bar + editor.px(10), at.y});
  ui::cancelButton(editor, "Cancel###cancel-task", progress, 64);
  return true;
}

// At the right of the status bar.
void drawNextStep(Editor& editor) {
  const auto& steps = editor.guide.of(editor);
  const auto next = nextStep(steps);
  if (!editor.environment() || !next || *steps[*next].advice == 0) return;
  const std::string text = trf("Next: {}  {}", tr(steps[*next].advice), ICON_CHEVRON_RIGHT);
  const float width = ImGui::CalcTextSize(text.c_str()).x + 2 * ImGui::GetStyle().FramePadding.x;
  ImGui::SameLine(std::max(0.0F, ImGui::GetWindowWidth() - width - editor.px(10)));
  ImGui::PushStyleColor(ImGuiCol_Button, ImVec4(0, 0, 0, 0));
  ImGui::PushStyleColor(ImGuiCol_Text, tone::kLink);
  if (ImGui::Button((text + "###next-step").c_str())) takeStep(editor, steps[*next]);
  ImGui::PopStyleColor(2);
  ui::tooltip(fmt::format("{}: {}", tr(steps[*next].title), tr(steps[*next].status)));
}

// For as long as it is so; a click leads to a place where the work can be saved.
void drawKeepingProblem(Editor& editor) {
  if (editor.keeping_problem.empty()) return;
  ImGui::PushStyleColor(ImGuiCol_Button, ImVec4(0, 0, 0, 0));
  ImGui::PushStyleColor(ImGuiCol_Text, tone::kBad);
  if (ImGui::Button(ICON_WARNING "  Unsaved work is not being kept###keeping-problem")) invoke(editor, "save-as");
  ImGui::PopStyleColor(2);
  ui::tooltip(editor.keeping_problem + "\nClick to save the project to another folder.");
  ImGui::SameLine();
}

}  // namespace

void drawStatusBar(Editor& editor) {
  ImGui::AlignTextToFramePadding();
  drawKeepingProblem(editor);
  const auto hover = hoverText(editor);
  if (!editor.notice.text.empty() && std::chrono::steady_clock::now() < editor.notice.until) {
    ImGui::TextColored(colour(tone::kWarning), "%s  %s", ICON_INFO, editor.notice.text.c_str());
  } else if (!hover.empty()) {
    ImGui::TextUnformatted(hover.c_str());
  } else if (const auto& clouds = editor.session.document().underlays;
             editor.environment() && !clouds.empty() && !editor.session.document().hasModel()) {
    std::uint64_t points = 0;
    for (const auto& underlay : clouds) points += underlay->points;
    ui::dimText(trf("{} points", groupedDigits(points)));
  } else if (const auto& environment = editor.environment()) {
    std::string text = trf("{} products   {} triangles", groupedDigits(environment->products.size()),
                           groupedDigits(editor.triangles()));
    if (!editor.selection.empty()) text += trf("   {} selected", editor.selection.products().size());
    if (editor.visibility.anyHidden()) text += trf("   {} hidden", editor.visibility.hiddenCount());
    ui::dimText(text);
  } else {
    ui::dimText("No model");
  }
  if (!drawRunningTask(editor)) drawNextStep(editor);
}

}  // namespace standpoint
