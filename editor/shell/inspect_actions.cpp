// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/shell/inspect_actions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "editor/panels/point_colours.h"
#include "editor/panels/quality_panel.h"
#include "editor/shell/editor.h"
#include "editor/shell/panel_actions.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/keyboard.h"

namespace standpoint {

namespace {

std::string whyNothingShown(const Editor& e) { return e.cloud() ? "" : whyNothingOpen(e); }
std::string whyMeasureNot(const Editor& e) {
  if (auto why = whyNothingShown(e); !why.empty()) return why;
  return e.session.whyNot("measure");
}
std::string whyWallNot(const Editor& e) {
  if (auto why = whyNothingShown(e); !why.empty()) return why;
  std::string why;
  e.wallCloud(&why);
  return why;
}

template <MeasurementKind kind>
bool measures(const Editor& e) {
  return e.view.tool == Tool::measure && e.view.measuring.kind == kind;
}

template <MeasurementKind kind>
void measureKind(Editor& e) {
  e.view.tool = Tool::measure;
  e.view.measuring = {kind, {}, {}};
}

template <ColourBy by>
std::string whyColourNot(const Editor& e) {
  return whyNoPointColour(e, by);
}

template <ColourBy by>
void colourBy(Editor& e) {
  e.view.points_by = by;
}
template <ColourBy by>
bool arePointsBy(const Editor& e) {
  return e.view.points_by == by;
}

void showChosenPanorama(Editor& e) {
  if (const auto cloud = e.wallCloud()) e.showPanorama(*cloud);
  e.workspace = Workspace::inspect;
  e.wanted_tab[2] = "panorama";
}

void openComparison(Editor& e) {
  e.workspace = Workspace::inspect;
  e.wanted_tab[2] = "compare";
}

void pickWall(Editor& e) {
  e.view.tool = Tool::pickWall;
  e.workspace = Workspace::inspect;
  e.wanted_tab[1] = "wall";
}

void assessScans(Editor& e) {
  PanelActions actions(e);
  assess(e.panels.of<QualityState>(), actions);
}

std::string whyNoWorstPlace(const Editor& e) {
  const auto* answer = e.session.lastAnswer<AssessAnswer>("assess");
  if (answer == nullptr) return "Assess the survey first";
  return worstRow(answer->rows) ? "" : "No figure is outside its limit";
}

void goToWorstPlace(Editor& e) {
  const auto& rows = e.session.lastAnswer<AssessAnswer>("assess")->rows;
  PanelActions actions(e);
  goToRow(e, e.panels.of<QualityState>(), actions, *worstRow(rows));
}

std::string whyNoClip(const Editor& e) { return e.view.clip.box ? "" : "Nothing is clipped"; }

// Through the middle of what is looked at.
template <int axis>
void sectionAcross(Editor& e) {
  e.clipSection(e.view.camera.target, Eigen::Vector3d::Unit(axis));
}

void turnClip(Editor& e) {
  auto& yaw = e.view.clip.box->yaw_rad;
  yaw = std::remainder(yaw + std::numbers::pi / 2, 2 * std::numbers::pi);
}

const std::array kInspectActions = {
    Action{"measure",
           "Measure distance",
           ICON_MEASURE,
           {'M'},
           measureKind<MeasurementKind::distance>,
           whyMeasureNot,
           measures<MeasurementKind::distance>},
    Action{"measure-height",
           "Measure height difference",
           ICON_MEASURE,
           {'M', false, true},
           measureKind<MeasurementKind::height>,
           whyMeasureNot,
           measures<MeasurementKind::height>},
    Action{"measure-angle",
           "Measure angle at the second of three points",
           ICON_MEASURE,
           {'M', true},
           measureKind<MeasurementKind::angle>,
           whyMeasureNot,
           measures<MeasurementKind::angle>},
    Action{"measure-area",
           "Measure area of a polygon",
           ICON_MEASURE,
           {'M', true, true},
           measureKind<MeasurementKind::area>,
           whyMeasureNot,
           measures<MeasurementKind::area>},
    Action{"measure-plane",
           "Measure plane through points",
           ICON_MEASURE,
           {'M', false, false, true},
           measureKind<MeasurementKind::plane>,
           whyMeasureNot,
           measures<MeasurementKind::plane>},
    Action{"measurements",
           "Measurements in the view",
           "",
           {},
           [](Editor& e) { e.view.measurements = !e.view.measurements; },
           nullptr,
           [](const Editor& e) { return e.view.measurements; }},
    Action{"assess",
           "Assess the scans",
           ICON_CHECK_CIRCLE,
           {},
           assessScans,
           [](const Editor& e) { return whyNotAssess(e); }},
    Action{"worst-place", "Go to the worst place", ICON_CROSSHAIRS, {}, goToWorstPlace, whyNoWorstPlace},
    Action{"place-points",
           "Points around the worst place",
           ICON_DROP,
           {},
           [](Editor& e) { e.view.place_points = !e.view.place_points; },
           [](const Editor& e) { return e.view.worst_place ? std::string() : "Go to a worst place first"; },
           [](const Editor& e) { return e.view.place_points; }},
    Action{"pick-wall",
           "Measure a wall: plane, noise, roughness",
           ICON_CROSSHAIRS,
           {'N'},
           pickWall,
           whyWallNot,
           [](const Editor& e) { return e.view.tool == Tool::pickWall; }},
    Action{"points-by-natural",
           "Colour points by RGB and intensity",
           ICON_PAINT,
           {},
           colourBy<ColourBy::natural>,
           whyColourNot<ColourBy::natural>,
           arePointsBy<ColourBy::natural>},
    Action{"points-by-rgb",
           "Colour points by RGB",
           ICON_PAINT,
           {},
           colourBy<ColourBy::rgb>,
           whyColourNot<ColourBy::rgb>,
           arePointsBy<ColourBy::rgb>},
    Action{"points-by-intensity",
           "Colour points by intensity",
           ICON_PAINT,
           {},
           colourBy<ColourBy::intensity>,
           whyColourNot<ColourBy::intensity>,
           arePointsBy<ColourBy::intensity>},
    Action{"points-by-range",
           "Colour points by range",
           ICON_PAINT,
           {},
           colourBy<ColourBy::range>,
           whyColourNot<ColourBy::range>,
           arePointsBy<ColourBy::range>},
    Action{"points-by-height",
           "Colour points by height",
           ICON_PAINT,
           {},
           colourBy<ColourBy::height>,
           whyColourNot<ColourBy::height>,
           arePointsBy<ColourBy::height>},
    Action{"points-by-incidence",
           "Colour points by incidence",
           ICON_PAINT,
           {},
           colourBy<ColourBy::incidence>,
           whyColourNot<ColourBy::incidence>,
           arePointsBy<ColourBy::incidence>},
    Action{"points-by-product",
           "Colour points by product",
           ICON_PAINT,
           {},
           colourBy<ColourBy::product>,
           whyColourNot<ColourBy::product>,
           arePointsBy<ColourBy::product>},
    Action{"points-by-material",
           "Colour points by material",
           ICON_PAINT,
           {},
           colourBy<ColourBy::material>,
           whyColourNot<ColourBy::material>,
           arePointsBy<ColourBy::material>},
    Action{"points-by-return-number",
           "Colour points by return",
           ICON_PAINT,
           {},
           colourBy<ColourBy::return_number>,
           whyColourNot<ColourBy::return_number>,
           arePointsBy<ColourBy::return_number>},
    Action{"points-by-flags",
           "Colour points by flags: mixed, ghost, pane, weather",
           ICON_PAINT,
           {},
           colourBy<ColourBy::flags>,
           whyColourNot<ColourBy::flags>,
           arePointsBy<ColourBy::flags>},
    Action{"points-by-residual",
           "Colour points by measured minus true range",
           ICON_PAINT,
           {},
           colourBy<ColourBy::residual>,
           whyColourNot<ColourBy::residual>,
           arePointsBy<ColourBy::residual>},
    Action{"points-by-deviation",
           "Colour points by distance from model",
           ICON_PAINT,
           {},
           colourBy<ColourBy::deviation>,
           whyColourNot<ColourBy::deviation>,
           arePointsBy<ColourBy::deviation>},
    Action{"points-by-time",
           "Colour points by time",
           ICON_PAINT,
           {},
           colourBy<ColourBy::time>,
           whyColourNot<ColourBy::time>,
           arePointsBy<ColourBy::time>},
    Action{"points-by-station",
           "Colour points by station",
           ICON_PAINT,
           {},
           colourBy<ColourBy::station>,
           whyColourNot<ColourBy::station>,
           arePointsBy<ColourBy::station>},
    Action{
        "show-panorama", "Panorama of the chosen scan", ICON_GLOBE, {'O', false, true}, showChosenPanorama, whyWallNot},
    Action{"compare-clouds", "Compare two clouds", ICON_COMPRESS, {}, openComparison, nullptr},
    Action{"clip-box",
           "Clip box around selection or model",
           ICON_CUT,
           {'C', false, false, true},
           [](Editor& e) { e.clipAroundSelection(); },
           whyNothingOpen},
    Action{"clip-none",
           "Clear clip box and section",
           ICON_CLOSE,
           {'C', true, true},
           [](Editor& e) { e.view.clip.box.reset(); },
           whyNoClip},
    Action{"section-wall",
           "Section along a wall: click it",
           ICON_CUT,
           {'X', false, false, true},
           [](Editor& e) { e.view.tool = Tool::pickSection; },
           whyNothingOpen},
    Action{"section-x", "Section across X", ICON_CUT, {}, sectionAcross<0>, whyNothingOpen},
    Action{"section-y", "Section across Y", ICON_CUT, {}, sectionAcross<1>, whyNothingOpen},
    Action{"section-z", "Level section", ICON_CUT, {}, sectionAcross<2>, whyNothingOpen},
    Action{"clip-look",
           "Look along the section",
           ICON_EYE,
           {'S', false, false, true},
           [](Editor& e) { e.lookAlongClip(); },
           whyNoClip},
    Action{"clip-turn", "Turn clip box or section by 90°", ICON_REDO, {}, turnClip, whyNoClip},
    Action{"clip-handles",
           "Handles of the clip box",
           "",
           {},
           [](Editor& e) { e.view.clip.handles = !e.view.clip.handles; },
           nullptr,
           [](const Editor& e) { return e.view.clip.handles; }},
};

}  // namespace

std::span<const Action> inspectActions() { return kInspectActions; }

}  // namespace standpoint
