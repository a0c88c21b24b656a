// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <string>

#include "editor/instrument/desk.h"
#include "editor/shell/widgets.h"

namespace standpoint {

namespace {

using Kind = RehearsalAction::Kind;

// Buttons that flow into rows.
bool flowing(const std::string& label, bool first) {
  const float width = ImGui::CalcTextSize(label.c_str(), nullptr, true).x + 2 * ImGui::GetStyle().FramePadding.x;
  if (!first) {
    ImGui::SameLine();
    if (ImGui::GetContentRegionAvail().x < width) ImGui::NewLine();
  }
  if (ImGui::GetContentRegionAvail().x >= width) return ui::button(label.c_str());
  const auto text = label.find("###");
  return ui::wideButton(label.c_str() + text, label.substr(0, text));
}

void stationChoice(InstrumentDesk& desk, const Document& document) {
  const auto& now = desk.shown()->state().around.station;
  ui::propertyLabel("Stands at");
  ImGui::SetNextItemWidth(-1);
  if (ImGui::BeginCombo("##station", now.empty() ? "nowhere" : now.c_str())) {
    if (document.job)
      for (const auto& s : document.job->stations)
        if (ImGui::Selectable(s.name.c_str(), s.name == now)) act(desk, {Kind::hand, "stand_at", s.name, 0, {}});
    ImGui::EndCombo();
  }
}

}  // namespace

// What hands do beside the device, and, for the lecturer, what can befall it.
void drawHands(InstrumentDesk& desk, Editor& editor) {
  const Device& device = *desk.shown();
  const auto& document = desk.rehearsal ? desk.rehearsal->document() : editor.session.document();
  if (ui::beginProperties("hands")) {
    stationChoice(desk, document);
    ui::property("Battery", device.shown("battery"));
    ui::property("Memory", device.shown("card"));
    ui::property("Tilt", device.shown("tilt"));
    ui::endProperties();
  }
  bool first = true;
  for (const auto& hand : handRows()) {
    const std::string id = hand.id;
    if (id == "stand_at" || id == "tilt") continue;
    if (flowing(device.word("hand." + id) + "###" + id, first)) act(desk, {Kind::hand, id, "", 0, {}});
    first = false;
  }
  if (desk.rehearsal && desk.guidance == Guidance::tested) return;
  ui::gap(editor);
  if (!ImGui::CollapsingHeader("Troubles")) return;
  first = true;
  for (const auto& trouble : troubleRows()) {
    const std::string id = trouble.id;
    if (flowing(device.word("trouble." + id) + "###trouble_" + id, first)) (void)desk.shown()->trouble(id);
    first = false;
  }
}

}  // namespace standpoint
