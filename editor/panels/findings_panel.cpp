// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "editor/panels/actions.h"
#include "editor/panels/panel.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/widgets.h"
#include "editor/words/sentences.h"
#include "project/materials/material_findings.h"
#include "project/materials/materials_verb.h"

namespace standpoint {

namespace {

struct FindingsState {
  std::string chosen;   // MaterialFinding::id
  std::string because;  // what stands in the field
  std::uint64_t seen_revision = ~0ULL;
  std::vector<MaterialFinding> all;  // of that revision
};

// Ids of materials, which verifying knows them by, as the lists call them.
std::string withMaterialNames(const Model& model, const std::string& english) {
  const auto isOfId = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_'; };
  std::string named;
  for (std::size_t at = 0; at < english.size();) {
    const auto end = static_cast<std::size_t>(
        std::find_if_not(english.begin() + static_cast<std::ptrdiff_t>(at), english.end(), isOfId) - english.begin());
    const auto word = english.substr(at, std::max<std::size_t>(end - at, 1));
    const bool may_be_id = word.find('_') != std::string::npos || (at > 0 && english[at - 1] == '\'');
    const auto* material = may_be_id ? model.offeredMaterial(word) : nullptr;
    named += material == nullptr ? word : material->label;
    at += word.size();
  }
  return named;
}

std::string shownMessage(const Model& model, const std::string& english) {
  return withReadableClasses(shownSentence(withMaterialNames(model, english)));
}

void choose(FindingsState& state, Actions& actions, const MaterialFinding& finding) {
  state.chosen = finding.id;
  state.because = finding.because;
  actions.select(finding.products);
}

// Alone, as what is doubtful often stands in a room.
void look(Actions& actions, const MaterialFinding& finding) {
  actions.select(finding.products);
  actions.isolate(finding.products);
  actions.showSelection();
}

void drawMark(const MaterialFinding& finding) {
  if (!finding.because.empty()) return ImGui::TextColored(colour(tone::kGood), "%s", ICON_CHECK);
  const bool warning = finding.severity == "warning";
  ImGui::TextColored(colour(warning ? tone::kWarning : tone::kDim), "%s", warning ? ICON_WARNING : ICON_INFO);
}

void drawList(const Model& model, FindingsState& state, Actions& actions,
              const std::vector<MaterialFinding>& findings) {
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(findings.size()));
  while (clipper.Step())
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
      const auto& finding = findings[static_cast<std::size_t>(i)];
      ImGui::PushID(i);
      if (ImGui::Selectable("###finding", state.chosen == finding.id)) choose(state, actions, finding);
      ImGui::SameLine(0, 0);
      drawMark(finding);
      ImGui::SameLine();
      const auto area = figures("{:.1f} m²", finding.area_m2);
      const float room = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(area.c_str()).x - model.px(14);
      ui::fitted(shownMessage(model, finding.message), room);
      ImGui::SameLine();
      ui::textRightAligned(area);
      ImGui::PopID();
    }
}

// A remedy whose material is the user's to choose takes the one that is chosen in the lists.
void drawRemedy(const Model& model, Actions& actions, const Remedy& remedy, const std::string& why) {
  const bool open = remedy.material.empty();
  const auto& material = open ? model.material.id : remedy.material;
  const auto* known = model.offeredMaterial(material);
  const std::string blocked = !why.empty() ? why : known == nullptr ? "Select a material in the list first" : "";
  const std::string text = open ? fmt::format("{}: {}", shownSentence(remedy.text),
                                              known == nullptr ? tr("Select a material") : tr(known->label))
                                : shownMessage(model, remedy.text);
  if (ui::button(fmt::format("{}  {}###{}{}", ICON_MAGIC, text, remedy.selector, remedy.material).c_str(), blocked,
                 {-FLT_MIN, 0}))
    actions.start(MaterialsOptions{{.assign = overridesBy(remedy, material)}}, remedy.text);
}

void drawAcceptance(const Model& model, FindingsState& state, Actions& actions, const MaterialFinding& finding,
                    const std::string& why) {
  if (!finding.because.empty()) {
    ui::wrapped(trf("Accepted: {}", finding.because));
    if (ui::button(ICON_UNDO "  Reopen###reopen", why, {-FLT_MIN, 0}))
      actions.start(MaterialsOptions{{.reopen = {finding.id}}}, "Reopen finding");
    return;
  }
  const float button = model.px(84);
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - button - ImGui::GetStyle().ItemSpacing.x);
  ImGui::InputTextWithHint("###because", tr("Reason for accepting").c_str(), &state.because);
  ImGui::SameLine();
  const std::string blocked = !why.empty() ? why : state.because.empty() ? "Enter a reason" : "";
  if (ui::button(ICON_CHECK "  Accept###accept", blocked, {button, 0}))
    actions.start(MaterialsOptions{{.accept = {finding.id}, .because = state.because}}, "Accept finding");
}

void drawFinding(const Model& model, FindingsState& state, Actions& actions, const MaterialFinding& finding) {
  ui::wrapped(shownMessage(model, finding.message));
  ImGui::PushStyleColor(ImGuiCol_Text, tone::kDim);
  ui::wrapped(shownMessage(model, finding.why));
  ImGui::PopStyleColor();
  if (ui::iconButton(ICON_CROSSHAIRS "  Isolate###look", "Hides everything else and frames the products",
                     finding.products.empty() ? "This finding has no products" : ""))
    look(actions, finding);
  ImGui::SameLine();
  if (ui::iconButton(ICON_EYE "  Show all###show-all", "Shows all products")) actions.showAll();
  const auto why = model.session.whyNot("materials");
  for (const auto& remedy : finding.remedies) drawRemedy(model, actions, remedy, why);
  drawAcceptance(model, state, actions, finding, why);
}

void draw(const Model& model, FindingsState& state, Actions& actions) {
  const auto& choice = model.session.document().materials;
  if (!choice) return ui::dimText("Assign materials to get findings.");
  if (state.seen_revision != model.session.revision()) {
    state.seen_revision = model.session.revision();
    state.all = materialFindings(model.session.document());
  }
  const auto& findings = state.all;
  const auto open =
      std::count_if(findings.begin(), findings.end(), [](const MaterialFinding& f) { return f.because.empty(); });
  if (findings.empty()) {
    ImGui::TextColored(colour(tone::kGood), "%s", ICON_CHECK);
    ImGui::SameLine();
    return ImGui::TextUnformatted(tr("No findings").c_str());
  }
  const auto chosen =
      std::find_if(findings.begin(), findings.end(), [&](const MaterialFinding& f) { return f.id == state.chosen; });
  const float width = ImGui::GetContentRegionAvail().x;
  ImGui::BeginChild("list", {chosen == findings.end() ? width : width * 0.52F, 0});
  ui::dimText(open == 0 ? trf("All {} accepted", findings.size()) : trf("{} open of {}", open, findings.size()));
  drawList(model, state, actions, findings);
  ImGui::EndChild();
  if (chosen == findings.end()) return;
  ImGui::SameLine();
  ImGui::BeginChild("finding");
  drawFinding(model, state, actions, *chosen);
  ImGui::EndChild();
}

}  // namespace

void drawFindingsPanel(const Model& model, PanelStates& states, Actions& actions) {
  draw(model, states.of<FindingsState>(), actions);
}

}  // namespace standpoint
