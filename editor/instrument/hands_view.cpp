// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <string>

#include <fmt/format.h>

#include "editor/instrument/desk.h"
#include "editor/widgets/drop_down.h"
#include "editor/widgets/number_field.h"
#include "editor/widgets/widgets.h"
#include "editor/words/figures.h"

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
  ui::propertyLabel("Station");
  ImGui::SetNextItemWidth(-1);
  if (ui::beginDropDown("##station", now.empty() ? tr("not set up").c_str() : now.c_str())) {
    if (document.job)
      for (const auto& s : document.job->stations)
        if (ui::choice(s.name.c_str(), s.name == now)) carryTo(desk, document, s.name);
    ui::endDropDown();
  }
}

// Each turn is an action of its own, so that a recorded exercise has it; Ctrl turns ten times as far.
void footScrews(InstrumentDesk& desk) {
  const auto& around = desk.shown()->state().around;
  if (!ui::beginProperties("screws")) return;
  std::array tilts{around.tilt_x_deg, around.tilt_y_deg};
  bool turned = false;
  for (std::size_t i = 0; i < tilts.size(); ++i) {
    ui::propertyLabel(i == 0 ? "Foot screw X" : "Foot screw Y");
    ImGui::SetNextItemWidth(-1);
    turned |= ui::numberField(fmt::format("###screw{}", i).c_str(), tilts[i],
                              {.kind = {.unit = "°"}, .decimals = 3, .step = 0.02});
  }
  ui::endProperties();
  if (turned) act(desk, {Kind::hand, "tilt", fmt::format("{},{}", tilts[0], tilts[1]), 0, {}});
}

}  // namespace

// What hands do beside the device, and, for the lecturer, what can befall it.
void drawHands(InstrumentDesk& desk, Editor& editor) {
  const Device& device = *desk.shown();
  const auto& document = documentOf(desk, editor);
  if (ui::beginProperties("hands")) {
    stationChoice(desk, document);
    ui::property("Battery", device.shown("battery"));
    ui::property("Memory", tr(device.shown("card")));
    ui::property("Tilt", asFigure(device.shown("tilt")));
    ui::endProperties();
  }
  std::string group;
  bool first = true;
  for (const auto& hand : handRows()) {
    const std::string id = hand.id;
    const bool carried = device.type().instrument.moving.has_value();
    if (std::string(hand.group) == (carried ? "tripod" : "walk")) continue;
    if (hand.group != group) {
      group = hand.group;
      ui::gap(editor);
      ui::dimText(device.word("hands." + group));
      if (group == "tripod") footScrews(desk);
      first = true;
    }
    if (id == "stand_at" || id == "tilt") continue;
    if (flowing(device.word("hand." + id) + "###" + id, first)) act(desk, {Kind::hand, id, "", 0, {}});
    first = false;
  }
  if (desk.rehearsal && desk.guidance == Guidance::tested) return;
  ui::gap(editor);
  if (!ui::foldedSection(std::string(ui::Label("Simulate a fault")))) return;
  first = true;
  for (const auto& trouble : troubleRows()) {
    const std::string id = trouble.id;
    if (flowing(device.word("trouble." + id) + "###trouble_" + id, first)) (void)desk.shown()->trouble(id);
    first = false;
  }
}

}  // namespace standpoint
