// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/panels/point_colours.h"

#include <imgui.h>

#include "editor/model/model.h"
#include "editor/widgets/drop_down.h"
#include "editor/widgets/widgets.h"
#include "editor/words/words.h"

namespace standpoint {

std::string pointColourName(const Model& model) {
  const auto* legend = model.pointLegend();
  const bool own = model.view.points_by == ColourBy::natural && legend != nullptr;  // of a difference
  return tr(own ? legend->title.c_str() : rowOf(model.view.points_by).name);
}

std::string whyNoPointColour(const Model& model, ColourBy colour) {
  if (!model.cloud()) return "Show the points of a scan first";
  if (colour == ColourBy::deviation)
    if (auto why = whyNoModel(model.session.document()); !why.empty()) return why;
  return whyNotColoured(colour, model.cloud()->header);
}

std::optional<ColourBy> choosePointColour(const Model& model) {
  std::optional<ColourBy> chosen;
  for (const auto& row : coloursBy()) {
    const auto why = whyNoPointColour(model, row.colour);
    ImGui::BeginDisabled(!why.empty());
    if (ui::choice(ui::Label(row.name), model.view.points_by == row.colour)) chosen = row.colour;
    ImGui::EndDisabled();
    ui::tooltip(why);
  }
  return chosen;
}

}  // namespace standpoint
