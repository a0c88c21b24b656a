// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <imgui.h>

#include "editor/model/guide.h"
#include "editor/panels/actions.h"
#include "editor/panels/panel.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/widgets.h"

namespace standpoint {

namespace {

struct StepLook {
  const char* icon;
  ImU32 tone;
};

StepLook lookOf(GuideStep::State state) {
  switch (state) {
    case GuideStep::State::done: return {ICON_CHECK_CIRCLE, tone::kGood};
    case GuideStep::State::attention: return {ICON_WARNING, tone::kWarning};
    case GuideStep::State::optional:
    case GuideStep::State::open: return {ICON_CIRCLE, tone::kDim};
  }
  return {ICON_CIRCLE, tone::kDim};
}

void drawStep(const Model& model, Actions& actions, const GuideStep& step, bool next, int number) {
  ImGui::PushID(number);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float height = 2 * ImGui::GetTextLineHeight() + model.px(10);
  if (ImGui::Selectable(fmt::format("###step-{}", nameOf(step.workspace)).c_str(), next,
                        ImGuiSelectableFlags_AllowItemOverlap, {0, height}))
    actions.open(step.workspace, step.tab);
  ImGui::SetCursorScreenPos({at.x + model.px(6), at.y + model.px(4)});
  const auto [icon, tone] = lookOf(step.state);
  ImGui::TextColored(colour(tone), "%s", icon);
  ImGui::SetCursorScreenPos({at.x + model.px(28), at.y + model.px(4)});
  ImGui::TextUnformatted(tr(step.title).c_str());
  if (step.state == GuideStep::State::optional) {
    ImGui::SameLine();
    ui::dimText("optional");
  }
  ImGui::SetCursorScreenPos({at.x + model.px(28), at.y + model.px(4) + ImGui::GetTextLineHeight()});
  ImGui::PushStyleColor(ImGuiCol_Text, tone::kDim);
  ui::fitted(tr(step.status), ImGui::GetContentRegionAvail().x);
  ImGui::PopStyleColor();
  ImGui::SetCursorScreenPos({at.x, at.y + height + model.px(2)});
  ImGui::PopID();
}

}  // namespace

void drawGuidePanel(const Model& model, PanelStates&, Actions& actions) {
  const auto& steps = model.guide.of(model);
  const auto next = nextStep(steps);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const bool is_next = next == i;
    drawStep(model, actions, steps[i], is_next, static_cast<int>(i));
    if (!is_next || *steps[i].advice == 0) continue;
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + model.px(28));
    if (ui::primaryButton(fmt::format("{}###guide-next", tr(steps[i].advice)).c_str(), {}, {-model.px(6), 0}))
      actions.take(steps[i]);
    ui::gap(model, 4);
  }
  if (!next) ui::dimWrapped("All steps are done. Export the environment, or hand over the survey report.");
}

}  // namespace standpoint
