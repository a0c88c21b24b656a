// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/shell/view_actions.h"

#include <algorithm>
#include <array>

#include "editor/desktop/interface_scale.h"
#include "editor/model/bookmark_steps.h"
#include "editor/model/floor_plan.h"
#include "editor/model/stairs.h"
#include "editor/shell/editor.h"
#include "editor/shell/graphics_choice.h"
#include "editor/shell/moving.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/keyboard.h"
#include "project/model/treatments.h"

namespace standpoint {

namespace {

std::string whyNoSelection(const Editor& e) { return e.selection.empty() ? "Select something first" : ""; }
std::string whyNoCollision(const Editor& e) {
  return e.session.document().collision ? "" : "Compute collision shapes first (Collision panel)";
}
std::string whyNotOptimised(const Editor& e) {
  return e.session.document().simplified ? "" : "Optimise the model first (Optimise panel)";
}
std::string whyNotLarger(const Editor& e) {
  return e.view.point_size_px < kMostPointSize_px ? "" : "A point covers 8 pixels each way already";
}
std::string whyNotSmaller(const Editor& e) { return e.view.point_size_px > 1 ? "" : "A point is one pixel already"; }
void sayRefused(Editor& e, const std::string& why) {
  if (!why.empty()) e.say(tr(why));
}
void walk(Editor& e) {
  if (e.view.tool == Tool::walk) return;  // its key is the one to go ahead
  startWalking(e);
}
std::string whyWalkNot(const Editor& e) {
  if (auto why = whyNoModel(e); !why.empty()) return why;
  const auto& collision = e.session.document().collision;
  return collision && collision->walkable.triangles.empty() ? "There is no walkable surface" : "";
}
void lookFrom(Editor& e, StandardView view) {
  stopFlying(e);
  stopWalking(e);
  look(e.view.camera, view);
  e.view.camera.orthographic = view != StandardView::corner;
  frame(e.view.camera, e.buildingBounds(), e.view.size.x() / std::max(e.view.size.y(), 1.0));
}
std::string whyNoHoles(const Editor& e) {
  if (auto why = whyNoModel(e); !why.empty()) return why;
  return shownHoles(e).patches == nullptr
             ? "Compute the coverage of the plan or of a trajectory, or assess the scans, first"
             : "";
}
void showHolesOnPlan(Editor& e) {
  e.view.holes = true;
  e.view.colour = ColourMode::model;
  e.showClouds({});
  lookAtNextPlan(e);
}
void frameAll(Editor& e) {
  stopFlying(e);
  stopWalking(e);
  e.bringIntoView(e.buildingBounds());
}
// What is said of the selection, each product by what it keeps through an update of the model.
void treat(Editor& e, TreatmentKind as, const char* title) {
  std::vector<std::string> selectors;
  for (const auto p : e.selection.products()) {
    const auto& product = e.environment()->products[p];
    selectors.push_back(product.global_id.empty() ? product.id : product.global_id);
  }
  e.session.start(TreatOptions{.products = std::move(selectors), .as = as}, title);
}
std::string whyTreatNot(const Editor& e) {
  if (auto why = whyNoSelection(e); !why.empty()) return why;
  return e.session.whyNot("treat");
}
std::string whyNoLarger(const Editor& e) {
  return e.settings.user_scale >= kUserScales.back() ? "Already at maximum size" : "";
}
std::string whyNoSmaller(const Editor& e) {
  return e.settings.user_scale <= kUserScales.front() ? "Already at minimum size" : "";
}
template <bool ViewportState::*flag>
void flip(Editor& e) {
  e.view.*flag = !(e.view.*flag);
}
template <bool ViewportState::*flag>
bool isOn(const Editor& e) {
  return e.view.*flag;
}
template <ColourMode mode>
void colourModelBy(Editor& e) {
  e.view.colour = mode;
}
template <ColourMode mode>
bool isColouredBy(const Editor& e) {
  return e.view.colour == mode;
}
template <GraphicsChoice choice>
void chooseGraphicsBy(Editor& e) {
  chooseGraphics(e, choice);
}
template <GraphicsChoice choice>
bool isGraphics(const Editor& e) {
  return e.settings.graphics == choice;
}
template <Theme theme>
void chooseTheme(Editor& e) {
  e.settings.theme = theme;
}

const std::array kView = {
    Action{"frame", "Frame selection", ICON_EXPAND, {'F'}, [](Editor& e) { e.frameSelection(); }, whyNothingOpen},
    Action{"frame-all", "Frame whole model", "", {kKeyHome}, frameAll, whyNothingOpen},
    Action{"view-front", "Front view", "", {'1'}, [](Editor& e) { lookFrom(e, StandardView::front); }, whyNothingOpen},
    Action{
        "view-back", "Back view", "", {'1', true}, [](Editor& e) { lookFrom(e, StandardView::back); }, whyNothingOpen},
    Action{"view-right", "Right view", "", {'3'}, [](Editor& e) { lookFrom(e, StandardView::right); }, whyNothingOpen},
    Action{
        "view-left", "Left view", "", {'3', true}, [](Editor& e) { lookFrom(e, StandardView::left); }, whyNothingOpen},
    Action{"view-top", "Top view", "", {'7'}, [](Editor& e) { lookFrom(e, StandardView::top); }, whyNothingOpen},
    Action{"view-plan",
           "Floor plan (again: next storey)",
           ICON_MAP,
           {'9'},
           [](Editor& e) { lookAtNextPlan(e); },
           whyNoModel},
    Action{"view-corner",
           "Isometric view",
           ICON_HOME,
           {'0'},
           [](Editor& e) { lookFrom(e, StandardView::corner); },
           whyNothingOpen},
    Action{"view-parallel",
           "Parallel projection",
           "",
           {'5'},
           [](Editor& e) { e.view.camera.orthographic = !e.view.camera.orthographic; },
           nullptr,
           [](const Editor& e) { return e.view.camera.orthographic; }},
    Action{"hide",
           "Hide selection",
           ICON_EYE_OFF,
           {'H'},
           [](Editor& e) {
             e.visibility.show(e.selection.products(), false);
             e.selection.clear();
           },
           whyNoSelection},
    Action{"isolate",
           "Isolate selection",
           ICON_CROSSHAIRS,
           {'H', false, true},
           [](Editor& e) { e.visibility.isolate(e.selection.products()); },
           whyNoSelection},
    Action{"show-all",
           "Show all",
           ICON_EYE,
           {'H', true},
           [](Editor& e) {
             e.visibility.showAll();
             e.visibility.cut_height_m.reset();
           },
           whyNothingOpen},
    Action{"exclude",
           "Exclude from the scene",
           ICON_BAN,
           {'X'},
           [](Editor& e) { treat(e, TreatmentKind::excluded, "Exclude from the scene"); },
           whyTreatNot},
    Action{"keep",
           "Never simplify",
           ICON_CHECK_CIRCLE,
           {'K'},
           [](Editor& e) { treat(e, TreatmentKind::kept, "Never simplify"); },
           whyTreatNot},
    Action{"by-rules",
           "Reset to rules",
           ICON_UNDO,
           {'X', false, true},
           [](Editor& e) { treat(e, TreatmentKind::as_rules, "Reset to rules"); },
           whyTreatNot},
    Action{"edges", "Edges", "", {'L'}, flip<&ViewportState::edges>, nullptr, isOn<&ViewportState::edges>},
    Action{"grid", "Ground grid", "", {'G'}, flip<&ViewportState::grid>, nullptr, isOn<&ViewportState::grid>},
    Action{"shaded-points",
           "Shade points by depth",
           "",
           {},
           flip<&ViewportState::shaded_points>,
           nullptr,
           isOn<&ViewportState::shaded_points>},
    Action{"points-larger",
           "Larger points",
           "",
           {kKeyPlus, false, false, true},
           [](Editor& e) { ++e.view.point_size_px; },
           whyNotLarger},
    Action{"points-smaller",
           "Smaller points",
           "",
           {kKeyMinus, false, false, true},
           [](Editor& e) { --e.view.point_size_px; },
           whyNotSmaller},
    Action{"labels", "Labels", "", {}, flip<&ViewportState::labels>, nullptr, isOn<&ViewportState::labels>},
    Action{"room-names",
           "Room names",
           "",
           {},
           flip<&ViewportState::room_names>,
           nullptr,
           isOn<&ViewportState::room_names>},
    Action{"labels-through-walls",
           "Labels through walls",
           "",
           {},
           flip<&ViewportState::labels_through_walls>,
           nullptr,
           isOn<&ViewportState::labels_through_walls>},
    Action{
        "holes", "Gaps in the coverage", "", {}, flip<&ViewportState::holes>, whyNoHoles, isOn<&ViewportState::holes>},
    Action{"holes-plan", "Gaps on the plan (again: next storey)", ICON_EYE, {}, showHolesOnPlan, whyNoHoles},
    Action{"walkable",
           "Walkable area",
           ICON_WALK,
           {},
           flip<&ViewportState::walkable>,
           whyNoCollision,
           isOn<&ViewportState::walkable>},
    Action{"walk",
           "Walk mode",
           ICON_WALK,
           {'W'},
           walk,
           whyWalkNot,
           [](const Editor& e) { return e.view.tool == Tool::walk || e.wanted_walk != nullptr; }},
    Action{"fly",
           "Fly mode (again: walk)",
           ICON_PLANE,
           {'U'},
           [](Editor& e) { e.view.tool == Tool::fly ? startWalking(e) : startFlying(e); },
           whyNothingOpen},
    Action{"door",
           "Open or close the door ahead (E)",
           "",
           {},
           [](Editor& e) { e.walk.toggleDoor(e.view.camera); },
           [](const Editor& e) {
             return e.walk.doorInReach(e.view.camera) ? std::string() : std::string("Walk up to a door first");
           }},
    Action{"take-stair",
           "Walk up or down the stair in sight (Q)",
           ICON_STOREY,
           {},
           [](Editor& e) { takeStair(e); },
           [](const Editor& e) { return whyNoStair(e); }},
    Action{"step-out-of-sight",
           "Step out of sight of the scanner (H)",
           ICON_EYE_OFF,
           {},
           [](Editor& e) { sayRefused(e, stepOutOfSight(e)); },
           [](const Editor& e) { return whyNotStepOutOfSight(e); }},
    Action{"return-to-instrument",
           "Return to the scanner (R)",
           ICON_UNDO,
           {},
           [](Editor& e) { sayRefused(e, returnToInstrument(e)); },
           [](const Editor& e) { return whyNotReturn(e); }},
    Action{"teleport",
           "Teleport: click where to stand (T: to the pointer)",
           ICON_CROSSHAIRS,
           {},
           [](Editor& e) { e.view.teleport.by_click = true; },
           whyWalkNot,
           [](const Editor& e) { return e.view.teleport.active(); }},
    Action{"view-before",
           "Previous view",
           "",
           {kKeyLeft, false, false, true},
           [](Editor& e) { goBackInViews(e); },
           [](const Editor& e) { return e.views.empty() ? std::string("No previous view") : std::string(); }},
    Action{"add-bookmark",
           "Add bookmark of this view",
           ICON_BOOKMARK,
           {'B', true},
           [](Editor& e) { addBookmark(e); },
           [](const Editor& e) { return e.environment() ? e.session.whyNot("bookmark") : whyNothingOpen(e); }},
    Action{"shapes",
           "Collision shapes",
           ICON_CUBES,
           {},
           flip<&ViewportState::shapes>,
           whyNoCollision,
           isOn<&ViewportState::shapes>},
    Action{"colour-model",
           "Model colours",
           "",
           {},
           colourModelBy<ColourMode::model>,
           nullptr,
           isColouredBy<ColourMode::model>},
    Action{"colour-material",
           "Physical material colours",
           "",
           {},
           colourModelBy<ColourMode::material>,
           whyNoModel,
           isColouredBy<ColourMode::material>},
    Action{"colour-reflectance",
           "Reflectance at a wavelength",
           "",
           {},
           colourModelBy<ColourMode::reflectance>,
           whyNoModel,
           isColouredBy<ColourMode::reflectance>},
    Action{"colour-confidence",
           "Assignment confidence",
           "",
           {},
           colourModelBy<ColourMode::confidence>,
           whyNoModel,
           isColouredBy<ColourMode::confidence>},
    Action{"colour-intensity",
           "Expected intensity from a station",
           "",
           {},
           colourModelBy<ColourMode::expected_intensity>,
           whyNoModel,
           isColouredBy<ColourMode::expected_intensity>},
    Action{"colour-noise",
           "Expected range noise from a station",
           "",
           {},
           colourModelBy<ColourMode::expected_noise>,
           whyNoModel,
           isColouredBy<ColourMode::expected_noise>},
    Action{"colour-fate",
           "Expected detections from a station",
           "",
           {},
           colourModelBy<ColourMode::expected_fate>,
           whyNoModel,
           isColouredBy<ColourMode::expected_fate>},
    Action{"colour-coverage",
           "Coverage: number of stations",
           "",
           {},
           colourModelBy<ColourMode::coverage>,
           whyNoModel,
           isColouredBy<ColourMode::coverage>},
    Action{"colour-spacing",
           "Coverage: point spacing",
           "",
           {},
           colourModelBy<ColourMode::coverage_spacing>,
           whyNoModel,
           isColouredBy<ColourMode::coverage_spacing>},
    Action{"colour-incidence",
           "Coverage: incidence",
           "",
           {},
           colourModelBy<ColourMode::coverage_incidence>,
           whyNoModel,
           isColouredBy<ColourMode::coverage_incidence>},
    Action{"colour-deviation",
           "Deviation from the original",
           "",
           {},
           colourModelBy<ColourMode::deviation>,
           whyNotOptimised,
           isColouredBy<ColourMode::deviation>},
    Action{"both-models",
           "Original and simplified model side by side",
           ICON_COMPRESS,
           {'B'},
           [](Editor& e) { e.view.side = e.view.side == ModelSide::both ? ModelSide::lighter : ModelSide::both; },
           whyNotOptimised,
           [](const Editor& e) { return e.view.side == ModelSide::both; }},
    Action{"interface-larger",
           "Increase interface size",
           "",
           {kKeyPlus, true},
           [](Editor& e) { e.settings.user_scale = neighbourScale(e.settings.user_scale, 1); },
           whyNoLarger},
    Action{"interface-smaller",
           "Decrease interface size",
           "",
           {kKeyMinus, true},
           [](Editor& e) { e.settings.user_scale = neighbourScale(e.settings.user_scale, -1); },
           whyNoSmaller},
    Action{"interface-usual",
           "Reset interface size",
           "",
           {'0', true},
           [](Editor& e) { e.settings.user_scale = 1; },
           nullptr},
    Action{"graphics-automatic",
           "Graphics: Automatic",
           "",
           {},
           chooseGraphicsBy<GraphicsChoice::automatic>,
           nullptr,
           isGraphics<GraphicsChoice::automatic>},
    Action{"graphics-low",
           "Graphics: Low",
           "",
           {},
           chooseGraphicsBy<GraphicsChoice::low>,
           nullptr,
           isGraphics<GraphicsChoice::low>},
    Action{"graphics-medium",
           "Graphics: Medium",
           "",
           {},
           chooseGraphicsBy<GraphicsChoice::medium>,
           nullptr,
           isGraphics<GraphicsChoice::medium>},
    Action{"graphics-high",
           "Graphics: High",
           "",
           {},
           chooseGraphicsBy<GraphicsChoice::high>,
           nullptr,
           isGraphics<GraphicsChoice::high>},
    Action{"theme-dark", "Dark theme", "", {}, chooseTheme<Theme::dark>, nullptr},
    Action{"theme-light", "Light theme", "", {}, chooseTheme<Theme::light>, nullptr},
    Action{"sounds",
           "Instrument sounds",
           "",
           {},
           [](Editor& e) { e.settings.sounds = !e.settings.sounds; },
           nullptr,
           [](const Editor& e) { return e.settings.sounds; }},
    Action{"language-system",
           "Language: As the system",
           "",
           {},
           [](Editor& e) { chooseLanguage(e, ""); },
           nullptr,
           [](const Editor& e) { return e.settings.language.empty(); }},
    Action{"language-en",
           "Language: English",
           "",
           {},
           [](Editor& e) { chooseLanguage(e, "en"); },
           nullptr,
           [](const Editor& e) { return e.settings.language == "en"; }},
    Action{"language-de",
           "Language: Deutsch",
           "",
           {},
           [](Editor& e) { chooseLanguage(e, "de"); },
           nullptr,
           [](const Editor& e) { return e.settings.language == "de"; }},
    Action{"language-uk",
           "Language: Українська",
           "",
           {},
           [](Editor& e) { chooseLanguage(e, "uk"); },
           nullptr,
           [](const Editor& e) { return e.settings.language == "uk"; }},
};

}  // namespace

std::span<const Action> viewActions() { return kView; }

}  // namespace standpoint
