// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include <fmt/format.h>
#include <imgui.h>

#include "core/units.h"
#include "editor/panels/actions.h"
#include "editor/panels/panel.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/number_field.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/widgets.h"
#include "editor/words/words.h"

namespace standpoint {

namespace {

// The middle and the sides of the box, typed; in the frame of the model's file.
void drawBox(const Model& model, ClipBox box, Actions& actions) {
  const ClipBox before = box;
  if (!ui::beginProperties("clip-box", 0.42F)) return;
  static constexpr const char* kAxes[] = {"X", "Y", "Z"};
  const NumberFormat place{.kind = {.unit = "m"}, .decimals = 3, .drag = 0.01};
  const NumberFormat side{.kind = {.unit = "m", .least = kThinnestClip_m, .most = 1e5}, .decimals = 3, .drag = 0.01};
  for (Eigen::Index i = 0; i < 3; ++i) {
    ui::propertyLabel(trf("Middle {}", kAxes[i]).c_str());
    double middle = box.centre[i] + model.shift_m()[i];
    if (ui::numberField(fmt::format("###clip-middle-{}", kAxes[i]).c_str(), middle, place))
      box.centre[i] = middle - model.shift_m()[i];
  }
  static constexpr const char* kSides[] = {"Length", "Width", "Height"};
  for (Eigen::Index i = 0; i < 3; ++i) {
    ui::propertyLabel(kSides[i]);
    double length = 2 * box.half[i];
    if (ui::numberField(fmt::format("###clip-{}", kSides[i]).c_str(), length, side)) box.half[i] = length / 2;
  }
  ui::propertyLabel("Heading from X");
  double heading_deg = box.yaw_rad / kRadPerDeg;
  if (ui::numberField("###clip-heading", heading_deg,
                      {.kind = {.unit = "°", .least = -360, .most = 360}, .decimals = 2, .drag = 0.5},
                      "Of its length, counter-clockwise from the file's X"))
    box.yaw_rad = heading_deg * kRadPerDeg;
  ui::endProperties();
  if (!(box == before)) actions.clip(box);
}

void drawSections(const Model& model, Actions& actions, float half) {
  ui::heading(model, "Section");
  double thickness_m = model.view.clip.thickness_m;
  if (ui::beginProperties("clip-section", 0.42F)) {
    ui::propertyLabel("Thickness");
    if (ui::numberField("###clip-thickness", thickness_m,
                        {.kind = {.unit = "m", .least = kThinnestClip_m, .most = 100}, .decimals = 3, .drag = 0.005}))
      actions.clipThickness(thickness_m);
    ui::endProperties();
  }
  actions.button("section-wall", "Along a wall", half);
  ImGui::SameLine();
  actions.button("section-x", "Across X", half);
  actions.button("section-y", "Across Y", half);
  ImGui::SameLine();
  actions.button("section-z", "Level", half);
}

void drawClip(const Model& model, Actions& actions) {
  if (!model.environment()) {
    ui::emptyState(model, ICON_CUT, "Nothing to clip", "Import a model (Ctrl+I).");
    return;
  }
  const float half = ui::shareOfRow(2);
  ui::heading(model, "Clip box");
  actions.button("clip-box", "Around selection", half);
  ImGui::SameLine();
  actions.button("clip-none", "Clear", half);
  drawSections(model, actions, half);
  if (!model.view.clip.box) {
    ui::gap(model);
    ui::dimWrapped(
        "A box or a section cuts the model and the points alike. Pull the dots on its faces, or type its "
        "sides here.");
    return;
  }
  ui::heading(model, "What is kept");
  drawBox(model, *model.view.clip.box, actions);
  actions.button("clip-look", "Look along", half);
  ImGui::SameLine();
  actions.button("clip-turn", "Turn by 90°", half);
  bool handles = model.view.clip.handles;
  if (ui::checkbox(ui::Label("Handles in view"), &handles)) actions.run("clip-handles");
}

}  // namespace

void drawClipPanel(const Model& model, PanelStates&, Actions& actions) { drawClip(model, actions); }

}  // namespace standpoint
