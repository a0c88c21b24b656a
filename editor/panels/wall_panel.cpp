// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include <imgui.h>

#include "core/units.h"
#include "editor/panels/actions.h"
#include "editor/panels/panel.h"
#include "editor/widgets/drop_down.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/number_field.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/widgets.h"
#include "editor/words/words.h"
#include "project/survey/measure_verb.h"

namespace standpoint {

namespace {

std::string millimetres(double value_m) { return figures("{:.2f} mm", value_m * 1000); }

void drawChoice(const Model& model, Actions& actions) {
  WallChoice choice = model.wall_choice;
  const auto clouds = inspectedClouds(model.session.document());
  const auto chosen = model.wallCloud();
  if (ui::beginProperties("wall-choice", 0.42F)) {
    ui::propertyLabel("Cloud");
    ImGui::SetNextItemWidth(-1);
    if (ui::beginDropDown("###wall-cloud", (chosen ? chosen->label : tr("none")).c_str())) {
      for (std::size_t i = 0; i < clouds.size(); ++i)
        if (ui::choice((clouds[i].label + "###cloud" + std::to_string(i)).c_str(),
                       chosen && chosen->file == clouds[i].file))
          choice.cloud = clouds[i].file;
      ui::endDropDown();
    }
    ui::tooltip("All of its points near the picked place are used, not only those shown");
    ui::propertyLabel("Radius");
    ui::numberField("###wall-radius", choice.radius_m,
                    {.kind = {.unit = "m", .least = 0.05, .most = 50}, .decimals = 2, .drag = 0.01},
                    "Of the region around the picked place. Large walls bow: take 0.3 to 0.5 m for the noise");
    ui::propertyLabel("Roughness radius");
    ui::numberField("###wall-roughness", choice.roughness_radius_m,
                    {.kind = {.unit = "m", .least = 0.005, .most = 1}, .decimals = 3, .drag = 0.001},
                    "Of the neighbours whose plane the distance of a point is taken from");
    ui::endProperties();
  }
  actions.set(choice);
}

struct WallPlot {
  ImVec2 at, size;
  float x(double fraction) const { return at.x + size.x * static_cast<float>(fraction); }
  float y(double fraction) const { return at.y + size.y * static_cast<float>(1 - fraction); }  // from below
};

WallPlot beginWallPlot(const Model& model, const char* id, float height_pt) {
  const float line = ImGui::GetTextLineHeight();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  ImGui::InvisibleButton(id, {width, model.px(height_pt) + line + model.px(4)});
  WallPlot plot{{corner.x, corner.y}, {width, model.px(height_pt)}};
  ImGui::GetWindowDrawList()->AddRectFilled(plot.at, {plot.at.x + plot.size.x, plot.at.y + plot.size.y}, tone::kPlot,
                                            model.px(2));
  return plot;
}

// Words under a plot: at its left, middle and right end.
void drawEnds(const Model& model, const WallPlot& plot, const std::string& left, const std::string& middle,
              const std::string& right) {
  auto& list = *ImGui::GetWindowDrawList();
  const float y = plot.at.y + plot.size.y + model.px(2);
  list.AddText({plot.at.x, y}, tone::kDim, left.c_str());
  list.AddText({plot.at.x + (plot.size.x - ImGui::CalcTextSize(middle.c_str()).x) / 2, y}, tone::kText, middle.c_str());
  list.AddText({plot.at.x + plot.size.x - ImGui::CalcTextSize(right.c_str()).x, y}, tone::kDim, right.c_str());
}

// With the normal distribution of the same sigma as a line.
void drawHistogram(const Model& model, const WallFit& fit) {
  ui::dimText("Residuals of all points in the region");
  const WallPlot plot = beginWallPlot(model, "###wall-histogram", 84);
  auto& list = *ImGui::GetWindowDrawList();
  const double most = std::max<double>(1, *std::max_element(fit.histogram.begin(), fit.histogram.end()));
  constexpr auto kBins = static_cast<double>(WallFit::kBins);
  for (std::size_t i = 0; i < WallFit::kBins; ++i) {
    const double height = fit.histogram[i] / most * 0.94;
    list.AddRectFilled({plot.x(static_cast<double>(i) / kBins) + model.px(0.5F), plot.y(height)},
                       {plot.x(static_cast<double>(i + 1) / kBins) - model.px(0.5F), plot.y(0)}, tone::kCurve);
  }
  const double reach = fit.histogram_reach_m, bin_m = 2 * reach / kBins;
  ImVec2 before(0, 0);
  for (int i = 0; i <= 80; ++i) {
    const double at = i / 80.0, d = (2 * at - 1) * reach / std::max(fit.sigma_m, 1e-9);
    const double count = static_cast<double>(fit.fitted) * bin_m / (std::max(fit.sigma_m, 1e-9) * std::sqrt(2 * M_PI)) *
                         std::exp(-d * d / 2);
    const ImVec2 here(plot.x(at), plot.y(std::min(1.0, count / most * 0.94)));
    if (i > 0) list.AddLine(before, here, tone::kWarning, model.px(1.5F));
    before = here;
  }
  drawEnds(model, plot, "−" + millimetres(reach), trf("{} beyond", groupedDigits(fit.beyond)),
           "+" + millimetres(reach));
}

// The mean residual along the wall with a band of its sigma.
void drawProfile(const Model& model, const WallFit& fit, const WallProfile& profile, const char* id, const char* title,
                 double extent_m) {
  ui::dimText(title);
  const WallPlot plot = beginWallPlot(model, id, 64);
  auto& list = *ImGui::GetWindowDrawList();
  const double reach = std::max(3 * fit.sigma_m, 1e-6);
  const auto y = [&](double d) { return plot.y(std::clamp(0.5 + 0.5 * d / reach, 0.0, 1.0)); };
  list.AddLine({plot.x(0), y(0)}, {plot.x(1), y(0)}, tone::kLine, model.px(1));
  const auto bins = static_cast<double>(profile.bins.size());
  for (std::size_t i = 0; i + 1 < profile.bins.size(); ++i) {
    const auto &a = profile.bins[i], &b = profile.bins[i + 1];
    if (a.points == 0 || b.points == 0) continue;
    const float from = plot.x((static_cast<double>(i) + 0.5) / bins),
                to = plot.x((static_cast<double>(i) + 1.5) / bins);
    list.AddQuadFilled({from, y(a.mean_m + a.sigma_m)}, {to, y(b.mean_m + b.sigma_m)}, {to, y(b.mean_m - b.sigma_m)},
                       {from, y(a.mean_m - a.sigma_m)}, (static_cast<ImU32>(tone::kCurve) & 0x00FFFFFFU) | 0x50000000U);
    list.AddLine({from, y(a.mean_m)}, {to, y(b.mean_m)}, tone::kCurve, model.px(1.5F));
  }
  drawEnds(model, plot, "0 m", "±" + millimetres(reach), figures("{:.2f} m", extent_m));
}

void drawFigures(const WallResult& wall) {
  const auto& fit = wall.fit;
  if (!ui::beginProperties("wall", 0.52F)) return;
  ui::property("Points in region", groupedDigits(wall.inside));
  ui::property("Fitted points", figures("{}  ({:.1f} %)", groupedDigits(fit.fitted),
                                        100.0 * static_cast<double>(fit.fitted) / static_cast<double>(fit.points)));
  ui::property("Sigma", millimetres(fit.sigma_m));
  ui::property("Sigma along the beam", fit.beam_sigma_m ? millimetres(*fit.beam_sigma_m) : "no station in the file");
  ui::property("Largest residual", millimetres(fit.max_m));
  ui::property(fit.level ? "Tilt from level" : "Tilt from plumb",
               figures("{:.3f}°  ({:.2f} mm/m)", fit.tilt_rad / kRadPerDeg, std::tan(fit.tilt_rad) * 1000));
  if (fit.incidence_rad) ui::property("Mean incidence", figures("{:.1f}°", *fit.incidence_rad / kRadPerDeg));
  ui::property(trf("Roughness (r {:.3g} m)", fit.roughness.radius_m).c_str(),
               fit.roughness.samples > 0 ? millimetres(fit.roughness.mean_m) : "too few neighbours");
  ui::property("Extent", figures("{:.2f} × {:.2f} m", fit.width_m, fit.height_m));
  ui::endProperties();
}

void keep(const Model& model, Actions& actions, const WallResult& wall) {
  const auto name = freeMeasurementName(model.session.document());
  MeasureOptions options{.add = name};
  options.kind = MeasurementKind::plane;
  for (const auto& corner : cornersOf(wall)) options.points.push_back(corner + model.shift_m());
  options.note = wallNote(wall);
  actions.start(options, trf("Keep wall {}", name));
}

void drawButtons(const Model& model, Actions& actions, const WallResult& wall) {
  const float width = ui::shareOfRow(3);
  if (ui::button(ui::fittingLabel(ICON_REDO, "Again", "wall-again", width).c_str(), {}, {width, 0},
                 "Measure at the same place with the cloud and the radius above")) {
    const Eigen::Vector3d place = wall.request.local_from_cloud * wall.request.ball.centre;
    std::optional<Eigen::Vector3d> normal = wall.request.options.normal;
    if (normal) normal = wall.request.local_from_cloud.rotation * *normal;
    actions.measureWall(place, normal);
  }
  ImGui::SameLine();
  if (ui::button(ui::fittingLabel(ICON_SAVE, "Keep", "wall-keep", width).c_str(), model.session.whyNot("measure"),
                 {width, 0}, "Keep it among the measurements of the project"))
    keep(model, actions, wall);
  ImGui::SameLine();
  if (ui::button(ui::fittingLabel(ICON_COPY, "Copy", "wall-copy", width).c_str(), {}, {width, 0},
                 "Copy the figures as text"))
    ImGui::SetClipboardText(wallText(wall).c_str());
}

void drawWall(const Model& model, Actions& actions) {
  if (!model.wallCloud()) {
    ui::emptyState(model, ICON_CROSSHAIRS, "No points", "Scan from a station, or add a point cloud.");
    return;
  }
  actions.button("pick-wall", "Pick a wall", ImGui::GetContentRegionAvail().x);
  drawChoice(model, actions);
  if (model.wall.busy()) {
    ui::dimText("Reading the points around the picked place …");
    return;
  }
  if (!model.wall.problem().empty()) {
    ImGui::PushStyleColor(ImGuiCol_Text, tone::kBad);
    ui::wrapped(model.wall.problem());
    ImGui::PopStyleColor();
  }
  const auto wall = model.wall.result();  // a copy: a button may begin another
  if (!wall) {
    if (model.wall.problem().empty())
      ui::dimWrapped("Click a wall, a floor or a ceiling: on the model, or on the points of a scan.");
    return;
  }
  ui::heading(model, trf("Plane in {}", wall->request.cloud).c_str());
  drawFigures(*wall);
  drawButtons(model, actions, *wall);
  ui::gap(model);
  drawHistogram(model, wall->fit);
  drawProfile(model, wall->fit, wall->fit.across, "###wall-across", "Profile across, mean and sigma",
              wall->fit.width_m);
  drawProfile(model, wall->fit, wall->fit.upward, "###wall-upward",
              wall->fit.level ? "Profile along the other axis" : "Profile upwards, mean and sigma", wall->fit.height_m);
}

}  // namespace

void drawWallPanel(const Model& model, PanelStates&, Actions& actions) { drawWall(model, actions); }

}  // namespace standpoint
