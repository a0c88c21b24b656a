// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <imgui.h>

#include "core/units.h"
#include "editor/panels/actions.h"
#include "editor/panels/panel.h"
#include "editor/panels/point_colours.h"
#include "editor/widgets/drop_down.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/widgets.h"
#include "editor/words/words.h"

namespace standpoint {

namespace {

using Files = std::vector<std::filesystem::path>;

void drawColour(const Model& model, Actions& actions) {
  ui::propertyLabel("Colour by");
  ImGui::SetNextItemWidth(-1);
  if (!ui::beginDropDown("###points-by", tr(rowOf(model.view.points_by).name).c_str(), ImGuiComboFlags_HeightLarge))
    return;
  if (const auto chosen = choosePointColour(model)) actions.colourPointsBy(*chosen);
  ui::endDropDown();
}

// A scan with the ways to look at it.
void drawCloud(const Model& model, Actions& actions, const InspectedCloud& cloud) {
  std::error_code ignored;
  const bool there = std::filesystem::is_regular_file(cloud.file, ignored);
  const std::string gone = there ? std::string() : trf("The file is missing: {}", cloud.file.string());
  const bool shown = model.cloud() && model.cloud()->file == cloud.file;
  const bool over_model = model.session.document().hasModel();
  ui::fitted(cloud.label, ImGui::GetContentRegionAvail().x);
  if (ui::iconButton(shown ? ICON_EYE_OFF "###show-points" : ICON_EYE "###show-points",
                     shown ? (over_model ? "Return to the model" : "Return to all clouds")
                           : (over_model ? "Show its points instead of the model" : "Show only its points"),
                     gone, shown))
    actions.showScans(shown ? Files() : Files{cloud.file});
  ImGui::SameLine();
  if (ui::iconButton(ICON_GLOBE "###show-panorama", "Panorama: what its station saw", gone)) {
    actions.showPanorama(cloud, {});
    actions.open(Workspace::inspect, "panorama");
  }
  ImGui::SameLine();
  if (ui::iconButton(ICON_FOLDER_OPEN "###show-folder", "Show in folder", gone)) actions.openFolderOf(cloud.file);
  ImGui::SameLine();
  const std::string missing = !cloudCompareProgram().empty() ? gone : "CloudCompare is not installed";
  if (ui::iconButton(ICON_EXPORT "###cloud-compare", "Open with CloudCompare", missing))
    actions.openInCloudCompare(cloud.file);
  ImGui::SameLine();
  if (ui::iconButton(ICON_SAVE "###export-cloud", "Export points (E57, LAS, PTX, PLY, …)",
                     there ? model.session.whyNot("convert") : gone))
    actions.exportPoints(cloud.file);
  if (there) return;
  ImGui::SameLine();
  if (ui::button(ICON_SEARCH "  Locate…###locate", model.session.whyNot("locate"), {0, 0},
                 "Choose where the file is now"))
    actions.locate(cloud.file);
}

void drawTogether(const Model& model, Actions& actions, const std::vector<InspectedCloud>& clouds) {
  const auto files = newestOfStations(clouds);
  if (files.size() < 2) return;
  std::error_code ignored;
  std::string gone;
  for (const auto& file : files)
    if (!std::filesystem::is_regular_file(file, ignored)) gone = trf("The file is missing: {}", file.string());
  const bool shown = model.cloud() && !model.cloud()->files.empty();
  if (ui::button(shown ? ICON_EYE_OFF "  Return to the model###show-together"
                       : ICON_EYE "  Show all scans together###show-together",
                 gone, {-FLT_MIN, 0}, "The newest scan of each station; of large ones an even part"))
    actions.showScans(shown ? Files() : files);
}

// Where the scans lie: where they were made, or where registration believes them to be.
void drawPoses(const Model& model, Actions& actions) {
  const auto& job = model.session.document().job;
  const bool registered = job && hasSolvedPose(*job);
  const bool believed = model.view.poses == ScanPoses::solved;
  bool wanted = believed;
  ImGui::BeginDisabled(!registered);
  if (ui::checkbox(ui::Label("Solved poses"), &wanted))
    actions.drawScansAt(wanted ? ScanPoses::solved : ScanPoses::truth);
  ImGui::EndDisabled();
  ui::tooltip(registered ? "Draws each scan where registration has its station, instead of where it was made"
                         : "Register the stations first");
  if (!believed) return;
  for (const auto& offset : poseOffsets(*job))
    ui::dimText(offset.registered ? trf("{} is off by {:.1f} mm and {:.4f}°", offset.station, offset.moved_m * 1000,
                                        offset.turned_rad / kRadPerDeg)
                                  : trf("{} is not registered", offset.station));
}

void drawPoints(const Model& model, Actions& actions) {
  const auto clouds = inspectedClouds(model.session.document());
  if (clouds.empty() && !model.cloud()) {
    ui::emptyState(model, ICON_EYE, "No points", "Scan from a station, or add a point cloud.");
    return;
  }
  if (ui::beginProperties("points", 0.36F)) {
    drawColour(model, actions);
    ui::propertyLabel("Point size");
    int size = model.view.point_size_px;
    ImGui::SetNextItemWidth(-1);
    if (ImGui::SliderInt("###point-size", &size, 1, kMostPointSize_px, "%d px", ImGuiSliderFlags_AlwaysClamp))
      actions.pointSize(size);
    ui::endProperties();
  }
  drawPoses(model, actions);
  bool shaded = model.view.shaded_points;
  if (ui::checkbox(ui::Label("Shade by depth"), &shaded)) actions.run("shaded-points");
  ui::tooltip("Eye-dome lighting: edges of what lies in front are darkened while the view is at rest");
  ui::heading(model, trf("Clouds  {}", clouds.size()).c_str());
  drawTogether(model, actions, clouds);
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    drawCloud(model, actions, clouds[i]);
    ImGui::PopID();
  }
}

}  // namespace

void drawPointsPanel(const Model& model, PanelStates&, Actions& actions) { drawPoints(model, actions); }

}  // namespace standpoint
