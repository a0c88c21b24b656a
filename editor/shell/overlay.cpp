// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/shell/overlay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <imgui_internal.h>

#include "editor/model/station_steps.h"
#include "editor/panels/point_colours.h"
#include "editor/shell/actions.h"
#include "editor/shell/banners.h"
#include "editor/shell/coverage_overlay.h"
#include "editor/shell/dialogs.h"
#include "editor/shell/editor.h"
#include "editor/shell/expected_overlay.h"
#include "editor/shell/live_overlay.h"
#include "editor/shell/moving.h"
#include "editor/shell/navigation_cube_view.h"
#include "editor/shell/points_legend.h"
#include "editor/shell/row_overlay.h"
#include "editor/shell/teleport.h"
#include "editor/shell/trajectory_overlay.h"
#include "editor/widgets/drop_down.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/number_field.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/widgets.h"

namespace standpoint {

namespace {

constexpr float kMargin = 10;
const char* colourName(ColourMode mode) {
  switch (mode) {
    case ColourMode::model: return "Model colours";
    case ColourMode::material: return "Physical materials";
    case ColourMode::reflectance: return "Reflectance";
    case ColourMode::confidence: return "Confidence";
    case ColourMode::deviation: return "Deviation";
    case ColourMode::expected_intensity: return "Expected intensity";
    case ColourMode::expected_noise: return "Expected noise";
    case ColourMode::expected_fate: return "Detection";
    case ColourMode::coverage: return "Stations";
    case ColourMode::coverage_spacing: return "Point spacing";
    case ColourMode::coverage_incidence: return "Incidence";
  }
  return "";
}

// Of the points that are shown instead of the model.
void pointColourChip(Editor& editor) {
  const auto label = fmt::format("{}  {}", ICON_PAINT, pointColourName(editor));
  ImGui::SetNextItemWidth(chipWidth(editor, label, 152));
  if (!ui::beginDropDown("###colour", label.c_str(), ImGuiComboFlags_NoArrowButton | ImGuiComboFlags_HeightLarge))
    return;
  if (const auto chosen = choosePointColour(editor)) editor.view.points_by = *chosen;
  ui::endDropDown();
}

void colourChip(Editor& editor) {
  const auto label = fmt::format("{}  {}", ICON_PAINT, tr(colourName(editor.view.colour)));
  ImGui::SetNextItemWidth(chipWidth(editor, label, 152));
  if (!ui::beginDropDown("###colour", label.c_str(), ImGuiComboFlags_NoArrowButton)) return;
  for (const auto mode : {ColourMode::model, ColourMode::material, ColourMode::reflectance, ColourMode::confidence,
                          ColourMode::expected_intensity, ColourMode::expected_noise, ColourMode::expected_fate,
                          ColourMode::coverage, ColourMode::coverage_spacing, ColourMode::coverage_incidence})
    if (ui::choice(ui::Label(colourName(mode)), editor.view.colour == mode)) editor.view.colour = mode;
  if (editor.session.document().simplified &&
      ui::choice(ui::Label(colourName(ColourMode::deviation)), editor.view.colour == ColourMode::deviation))
    editor.view.colour = ColourMode::deviation;
  ui::endDropDown();
}

// Those of the emulated scanners, and where the libraries begin.
void wavelengthChip(Editor& editor) {
  if (editor.view.colour != ColourMode::reflectance) return;
  beside(editor, editor.px(90));
  ImGui::SetNextItemWidth(editor.px(90));
  if (!ui::beginDropDown("###wavelength", fmt::format("{:.0f} nm", editor.view.wavelength_nm).c_str())) return;
  for (const double wavelength : {532.0, 660.0, 785.0, 830.0, 905.0, 1064.0, 1550.0})
    if (ui::choice(fmt::format("{:.0f} nm", wavelength).c_str(), editor.view.wavelength_nm == wavelength))
      editor.view.wavelength_nm = wavelength;
  ui::endDropDown();
}

const char* sideName(ModelSide side) {
  switch (side) {
    case ModelSide::lighter: return "Simplified model";
    case ModelSide::original: return "Original";
    case ModelSide::both: return "Side by side";
  }
  return "";
}

void sideChip(Editor& editor) {
  if (!editor.session.document().simplified || isExpected(editor.view.colour)) return;
  const auto label = fmt::format("{}  {}", ICON_COMPRESS, tr(sideName(editor.view.side)));
  const float width = chipWidth(editor, label, 112);
  beside(editor, width);
  ImGui::SetNextItemWidth(width);
  if (!ui::beginDropDown("###side", label.c_str(), ImGuiComboFlags_NoArrowButton)) return;
  for (const auto side : {ModelSide::lighter, ModelSide::original, ModelSide::both})
    if (ui::choice(ui::Label(sideName(side)), editor.view.side == side)) editor.view.side = side;
  ui::endDropDown();
}

std::string storeyName(const Editor& editor, const StoreyLevel& level) {
  const auto& node = editor.environment()->spatial[static_cast<std::size_t>(level.node)];
  return node.name.empty() ? tr("Storey") : node.name;
}

// Who stands in the building, as after a walk, would see what is cut from within.
void lookInFromOutside(Editor& editor, const Bounds& building) {
  const Eigen::Vector3d eye = editor.view.camera.eye();
  const bool in = (eye.array() >= building.min.array()).all() && (eye.array() <= building.max.array()).all();
  if (in) invoke(editor, "view-corner");
}

void cutChip(Editor& editor) {
  auto& cut = editor.visibility.cut_height_m;
  const double shift = editor.shift_m().z();
  const std::string label = cut ? trf("{}  Cut at {:.2f} m", ICON_CUT, *cut + shift) : tr(ICON_CUT "  No cut");
  const float width = chipWidth(editor, label, 96);
  beside(editor, width);
  ImGui::SetNextItemWidth(width);
  if (ui::beginDropDown("###cut", label.c_str(), ImGuiComboFlags_HeightLarge | ImGuiComboFlags_NoArrowButton)) {
    if (ui::choice(ui::Label("No cut"), !cut)) cut.reset();
    std::optional<double> wanted;
    const auto& storeys = editor.storeys();
    for (std::size_t i = storeys.size(); i-- > 0;) {
      const double height = storeys[i].elevation_m + kCutAboveFloor_m;
      if (ui::choice(
              figures("{}   {:+.2f} m###storey{}", storeyName(editor, storeys[i]), storeys[i].elevation_m + shift, i)
                  .c_str(),
              cut && std::abs(*cut - height) < 1e-6))
        wanted = height;
    }
    if (wanted) {
      const Bounds building = editor.buildingBounds();  // as yet uncut, or by the cut before
      cut = wanted;
      lookInFromOutside(editor, building);
    }
    if (storeys.empty()) {
      const Bounds all = editor.visibleBounds();
      if (!all.empty() && ui::choice(ui::Label("Half height"))) cut = (all.min.z() + all.max.z()) / 2;
    }
    ui::endDropDown();
  }
  if (!cut) return;
  beside(editor, editor.px(90));
  double height = *cut + shift;
  ImGui::SetNextItemWidth(editor.px(90));
  if (ui::numberField("###cut-height", height, {.kind = {.unit = "m"}, .decimals = 2, .drag = 0.02},
                      "Type the height of the cut, or drag its unit"))
    cut = height - shift;
}

float togglesWidth(const Editor& editor) {
  float width = 4 * editor.px(2);
  for (const char* icon : {ICON_CUBE, ICON_GRID, ICON_WALK, ICON_CUBES, ICON_EYE}) width += chipWidth(editor, icon, 0);
  return width;
}

void toggle(Editor& editor, const char* icon, const char* id, bool lit) {
  const auto& action = *findAction(id);
  if (ui::iconButton(fmt::format("{}###view_{}", icon, id).c_str(), action.title, whyNot(action, editor), lit))
    action.run(editor);
  ImGui::SameLine(0, editor.px(2));
}

// They stay together.
void drawToggles(Editor& editor) {
  beside(editor, togglesWidth(editor));
  drawChipGround(editor, togglesWidth(editor));
  toggle(editor, ICON_CUBE, "edges", editor.view.edges);
  toggle(editor, ICON_GRID, "grid", editor.view.grid);
  toggle(editor, ICON_WALK, "walkable", editor.view.walkable);
  toggle(editor, ICON_CUBES, "shapes", editor.view.shapes);
  toggle(editor, ICON_EYE, "show-all", false);
}

// Said among the chips.
void textChip(const Editor& editor, const std::string& text) {
  const ImVec2 at = ImGui::GetCursorScreenPos(), pad = ImGui::GetStyle().FramePadding;
  const float width = ImGui::CalcTextSize(text.c_str()).x + 2 * pad.x;
  drawChipGround(editor, width);
  ImGui::GetWindowDrawList()->AddText({at.x + pad.x, at.y + pad.y}, ImGui::GetColorU32(ImGuiCol_Text), text.c_str());
  ImGui::Dummy({width, ImGui::GetFrameHeight()});
}

// What is shown instead of the model, and the way back.
void cloudChip(Editor& editor) {
  if (editor.readingCloud()) {
    beside(editor, editor.px(120));
    textChip(editor, tr("Reading the scan …"));
    return;
  }
  if (!editor.cloud()) return;
  const auto& cloud = *editor.cloud();
  const auto& document = editor.session.document();
  const std::string name = cloud.file.empty() ? tr("Scan") : cloud.file.filename().string();
  beside(editor, editor.px(150));
  if (!document.hasModel() && document.underlays.size() == 1) {
    textChip(editor, name);
  } else if (ImGui::Button(document.hasModel() ? trf("{}  Return to model###cloud", ICON_CUBE).c_str()
                                               : trf("{}  Return to all clouds###cloud", ICON_CUBE).c_str())) {
    editor.showClouds({});
    editor.visibility.endCutForSight();
    return;
  }
  ui::tooltip(
      trf("{}: {} of {} points shown", name, groupedDigits(cloud.points.size()), groupedDigits(cloud.points_in_file)));
  if (!editor.showsLiveScan()) return;
  beside(editor, editor.px(180));
  textChip(editor, trf("{:.1f} million points loaded", static_cast<double>(cloud.points_in_file) / 1e6));
}

// The worst place that is marked, what was measured around it, and the way back.
void placeChip(Editor& editor) {
  if (!editor.view.worst_place) return;
  nextRow();
  const auto& place = *editor.view.worst_place;
  textChip(editor, place.where.empty() ? place.what : place.what + "   " + place.where);
  const float width = chipWidth(editor, ICON_DROP, 0);
  beside(editor, width);
  drawChipGround(editor, width);
  toggle(editor, ICON_DROP, "place-points", editor.view.place_points);
  const std::string back = tr("Previous view");
  beside(editor, chipWidth(editor, back, 0));
  if (ui::button("Previous view###back-from-place", whyNot(*findAction("view-before"), editor)))
    invoke(editor, "view-before");
  if (!editor.place_points.busy()) return;
  const std::string reading = tr("Reading the scan …");
  beside(editor, chipWidth(editor, reading, 0));
  textChip(editor, reading);
}

// The way on where a cloud that is shown is no longer there.
void locateChip(Editor& editor) {
  if (editor.missingClouds().empty()) return;
  beside(editor, editor.px(90));
  const auto missing = editor.missingClouds().front();
  const auto file = projectFileOf(editor, missing);
  if (file.empty()) return;
  if (ui::button(ICON_SEARCH "  Locate…###locate-cloud", editor.session.whyNot("locate"), {0, 0},
                 "Choose where the file is now"))
    askToLocate(editor, file);
}

// What has become of the clouds that are shown; mostly "".
std::string cloudTrouble(const Editor& editor) {
  const auto& missing = editor.missingClouds();
  if (!missing.empty())
    return trf("{} is no longer there: put it back or locate it to see all of it. What has been read stays on view.",
               missing.front().filename().string());
  const std::string why = editor.scene != nullptr ? editor.scene->trouble() : "";
  return why.empty() ? why : trf("Some points cannot be read: {}. What has been read stays on view.", why);
}

// What the tool waits for; "" for nothing.
ui::Text toolHint(const Editor& editor) {
  const auto& view = editor.view;
  if (editor.walk_ground.preparing())
    return trf("Preparing the walkable surface … {:.0f} %   Esc to cancel", 100 * editor.walk_ground.fraction());
  if (view.teleport.active())
    return view.teleport.by_key
               ? "Aim with the pointer, release T or click to stand there   Alt+Left then comes back   Esc to cancel"
               : "Click where to stand   Alt+Left then comes back   Esc to cancel";
  if (goesOnByClick(editor)) return "Teleported to the pointer; click to go farther   Alt+Left for the previous view";
  if (editor.bearer_view.active()) return "The view follows the scanner; drag to look around yourself   Esc to stop";
  if (view.tool == Tool::select && looksFromStation(editor)) return "Drag to look around   Alt+Left to go back";
  if (const auto moving = movingHint(editor)) return *moving;
  std::string measuring;
  const char* hint = nullptr;
  switch (view.tool) {
    case Tool::placeStation:
      hint = "Click the floor to add a station, or type its coordinates in Survey   Esc to leave";
      break;
    case Tool::placeRow:
      hint = editor.view.row_from ? "Click the floor where the row ends   Esc to leave"
                                  : "Click the floor where the row begins   Esc to leave";
      break;
    case Tool::placeTarget: hint = "Click to place a target   Esc to leave"; break;
    case Tool::measure:
      measuring = view.measuring.problem.empty() ? hintOf(view.measuring) : view.measuring.problem;
      hint = measuring.c_str();
      break;
    case Tool::pickWall: hint = "Click a wall, floor or ceiling to measure its plane   Esc to leave"; break;
    case Tool::pickSection: hint = "Click a wall to cut along it   Esc to leave"; break;
    case Tool::takeMaterial: hint = "Click a surface to pick its material   Esc to leave"; break;
    case Tool::paintMaterial: hint = "Click surfaces to assign the selected material   Esc to leave"; break;
    case Tool::layTrajectory:
      hint = view.draft.waypoints.empty()
                 ? "Click the floor where the path begins   Esc to leave"
                 : "Click to add waypoints   Enter to finish   Backspace to take the last one back   Esc to give up";
      break;
    case Tool::layWay: hint = "Click the floor to add a waypoint   Esc to leave"; break;
    case Tool::walk:
    case Tool::fly:
    case Tool::select: break;
  }
  if (editor.environment() && !editor.picker.ready() && hint != nullptr) hint = "Preparing the model for picking …";
  return hint != nullptr ? hint : "";
}

// What can be done, above it where whoever moves is, how a live scan goes, and what is wrong.
void drawWords(Editor& editor, ImVec2 origin, ImVec2 size) {
  std::vector<Banner> banners = {{toolHint(editor), banner::kHint}};
  if (!editor.walk_ground.preparing()) {
    banners.push_back({movingLine(editor)});
    for (auto& readout : liveReadouts(editor, size.x)) banners.push_back(std::move(readout));
  }
  banners.push_back({cloudTrouble(editor), banner::kWarning});
  drawBanners(editor, origin, size, banners);
}

void drawReflectanceLegend(const Editor& editor, ImVec2 origin, ImVec2 size) {
  if (editor.view.colour != ColourMode::reflectance) return;
  auto& list = *ImGui::GetWindowDrawList();
  const float width = editor.px(160), height = editor.px(8), x = origin.x + editor.px(kMargin),
              y = origin.y + size.y - editor.px(38);
  drawPlate(editor, {x, y}, {width, height + editor.px(2) + ImGui::GetTextLineHeight()});
  list.AddRectFilledMultiColor({x, y}, {x + width, y + height}, IM_COL32(20, 20, 20, 255), IM_COL32(245, 245, 245, 255),
                               IM_COL32(245, 245, 245, 255), IM_COL32(20, 20, 20, 255));
  list.AddText({x, y + height + editor.px(2)}, tone::kDim, "0");
  const char* most = "100 %";
  list.AddText({x + width - ImGui::CalcTextSize(most).x, y + height + editor.px(2)}, tone::kDim, most);
}

void drawConfidenceLegend(const Editor& editor, ImVec2 origin, ImVec2 size) {
  if (editor.view.colour != ColourMode::confidence) return;
  auto& list = *ImGui::GetWindowDrawList();
  float x = origin.x + editor.px(kMargin);
  const float y = origin.y + size.y - editor.px(24), swatch = editor.px(10);
  constexpr std::array<std::pair<double, const char*>, 4> kRows = {
      {{1.0, "named"}, {0.65, "general keyword"}, {0.2, "class or colour only"}, {-1.0, "no material"}}};
  float width = 0;
  for (const auto& [confidence, text] : kRows)
    width += swatch + editor.px(19) + ImGui::CalcTextSize(tr(text).c_str()).x;
  drawPlate(editor, {x, y}, {width - editor.px(14), ImGui::GetTextLineHeight()});
  for (const auto& [confidence, text] : kRows) {
    const Colour c = confidenceColour(confidence);
    list.AddRectFilled({x, y + editor.px(2)}, {x + swatch, y + editor.px(2) + swatch},
                       ImGui::ColorConvertFloat4ToU32({c.r, c.g, c.b, 1}));
    const std::string said = tr(text);
    list.AddText({x + swatch + editor.px(5), y}, tone::kText, said.c_str());
    x += swatch + editor.px(19) + ImGui::CalcTextSize(said.c_str()).x;
  }
}

void drawDeviationLegend(const Editor& editor, ImVec2 origin, ImVec2 size) {
  if (editor.view.colour != ColourMode::deviation) return;
  auto& list = *ImGui::GetWindowDrawList();
  const float caption = editor.view.side == ModelSide::both ? editor.px(22) : 0;
  const float width = editor.px(160), height = editor.px(8), x = origin.x + editor.px(kMargin),
              y = origin.y + size.y - editor.px(38) - caption;
  const auto both = editor.deviation.of(editor.session.document());
  if (!both) {
    list.AddText({x, y}, tone::kDim, tr(editor.deviation.busy() ? "Comparing with the original …" : "").c_str());
    return;
  }
  drawPlate(editor, {x, y}, {width, height + editor.px(2) + ImGui::GetTextLineHeight()});
  constexpr int kSteps = 32;
  for (int i = 0; i < kSteps; ++i) {
    const auto c = deviationColour((i + 0.5) / kSteps, 1);
    list.AddRectFilled({x + width * static_cast<float>(i) / kSteps, y},
                       {x + width * static_cast<float>(i + 1) / kSteps, y + height}, IM_COL32(c[0], c[1], c[2], 255));
  }
  list.AddText({x, y + height + editor.px(2)}, tone::kDim, "0");
  const auto most = trf("{:.3g} mm or more", both->lighter->full_scale_m * 1000);
  list.AddText({x + width - ImGui::CalcTextSize(most.c_str()).x, y + height + editor.px(2)}, tone::kDim, most.c_str());
}

}  // namespace

void drawColourLegend(Editor& editor, ImVec2 origin, ImVec2 size) {
  drawPointsLegend(editor, origin, size);
  if (editor.cloud() != nullptr) return;
  drawReflectanceLegend(editor, origin, size);
  drawConfidenceLegend(editor, origin, size);
  drawDeviationLegend(editor, origin, size);
}

float overlayEnd(const Editor& editor) {
  const float y = ImGui::GetCursorScreenPos().y;
  return y >= editor.beside_cube && y < editor.cube_corner.y() ? editor.cube_corner.x() : editor.overlay_end;
}

void nextRow() {
  if (ImGui::GetCurrentWindow()->DC.CurrLineSize.y > 0) ImGui::NewLine();
}

void beside(const Editor& editor, float width) {
  ImGui::SameLine();
  if (ImGui::GetCursorScreenPos().x + width > overlayEnd(editor)) ImGui::NewLine();
}

float chipWidth(const Editor& editor, const std::string& label, float least_pt) {
  return std::max(editor.px(least_pt), ImGui::CalcTextSize(label.c_str()).x + 2 * ImGui::GetStyle().FramePadding.x);
}

void drawChipGround(const Editor& editor, float width) {
  const ImVec2 at = ImGui::GetCursorScreenPos(), end(at.x + width, at.y + ImGui::GetFrameHeight());
  ImGui::GetWindowDrawList()->AddRectFilled(at, end, tone::kOverlay, editor.px(4));
}

void drawPlate(const Editor& editor, ImVec2 at, ImVec2 size) {
  const float rim = editor.px(4);
  ImGui::GetWindowDrawList()->AddRectFilled({at.x - rim, at.y - rim}, {at.x + size.x + rim, at.y + size.y + rim},
                                            tone::kOverlay, rim);
}

ImVec2 controlsCorner(const Editor& editor, ImVec2 origin) {
  return {origin.x + editor.px(kMargin) + editor.overlay_size.x(),
          origin.y + editor.px(kMargin) + editor.overlay_size.y()};
}

bool overOverlay(const Editor& editor, ImVec2 origin, ImVec2 size) {
  const ImVec2 p = ImGui::GetIO().MousePos;
  if (overNavigationCube(editor, origin, size)) return true;
  const ImVec2 end = controlsCorner(editor, origin);
  return p.y < end.y && p.x < end.x;
}

void drawOverlay(Editor& editor, ImVec2 origin, ImVec2 size) {
  ImGui::SetCursorScreenPos({origin.x + editor.px(kMargin), origin.y + editor.px(kMargin)});
  ImGui::PushStyleColor(ImGuiCol_FrameBg, tone::kOverlay);
  ImGui::BeginGroup();
  const ImVec2 cube = navigationCubeCorner(editor, origin, size);
  editor.overlay_end = origin.x + size.x - editor.px(kMargin);
  editor.beside_cube = origin.y + editor.px(kMargin) + ImGui::GetFrameHeight() / 2;
  editor.cube_corner = {cube.x, cube.y};
  const bool points = editor.cloud() != nullptr;  // and no colours of the model
  if (points) {
    pointColourChip(editor);
  } else {
    colourChip(editor);
    wavelengthChip(editor);
    sideChip(editor);
  }
  const bool on_foot = editor.walk.active();  // the building shall be in sight then, not what is lit over it
  if (!on_foot || editor.visibility.cut_height_m) cutChip(editor);
  cloudChip(editor);
  locateChip(editor);
  if (!on_foot) drawToggles(editor);
  if (!points) {
    expectedChips(editor);
    coverageChips(editor);
  }
  placeChip(editor);
  rowChips(editor);
  trajectoryChips(editor);
  targetChip(editor);
  movingChips(editor);
  livePointChips(editor);
  ImGui::EndGroup();
  const ImVec2 drawn = ImGui::GetItemRectSize();
  editor.overlay_size = {drawn.x, drawn.y};
  ImGui::PopStyleColor();
  drawNavigationCube(editor, origin, size);
  drawColourLegend(editor, origin, size);
  drawWords(editor, origin, size);
}

}  // namespace standpoint
