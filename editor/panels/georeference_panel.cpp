// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "core/units.h"
#include "editor/panels/actions.h"
#include "editor/panels/panel.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/number_field.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/widgets.h"
#include "editor/words/sentences.h"
#include "project/model/model_verbs.h"
#include "survey/geodesy.h"

namespace standpoint {

namespace {

struct GeoreferenceState {
  std::string crs;
  Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();
  double rotation_deg = 0;
  const void* filled_from = nullptr;  // the georeference that the fields were filled from
  const void* derived_from = nullptr;
  Result<MapFactors> derived = MapFactors();
};

constexpr double kSameNorth_rad = 1e-5;

double rotationDeg(const MapConversion& m) { return std::atan2(m.x_axis_ordinate, m.x_axis_abscissa) / kRadPerDeg; }

void drawStated(const Georeference& g) {
  if (!ui::beginProperties("stated", 0.42F)) return;
  ui::property("Global shift", coordinates(g.shift_m) + " m");
  ui::property("CRS", g.crs.empty() ? tr("unknown") : g.crs);
  if (g.map_from_file) {
    ui::property("Origin on the map", figures("{:.3f}  {:.3f}  {:.3f}", g.map_from_file->eastings_m,
                                              g.map_from_file->northings_m, g.map_from_file->orthogonal_height_m));
    ui::property("Rotation", figures("{:.5f}°", rotationDeg(*g.map_from_file)));
    if (g.map_from_file->scale != 1) ui::property("Scale", figures("{:.8f}", g.map_from_file->scale));
  }
  if (g.site)
    ui::property("Site in the file", figures("{:.6f}°  {:.6f}°", g.site->latitude_deg, g.site->longitude_deg));
  if (g.true_north_rad) ui::property("True north", trf("{:.3f}° clockwise from +Y", *g.true_north_rad / kRadPerDeg));
  ui::endProperties();
  if (g.true_north_rad && std::abs(*g.true_north_rad) > kSameNorth_rad)
    ui::dimWrapped(
        "True north is what the file says of the compass, and turns nothing. Rotation is how the model is turned on "
        "the map: from east to its X axis, counter-clockwise.");
}

// As the file's true north asks for: what it is clockwise from +Y, the X axis is counter-clockwise from east.
void offerTrueNorth(GeoreferenceState& state, const Georeference& g) {
  if (!g.true_north_rad || std::abs(*g.true_north_rad - state.rotation_deg * kRadPerDeg) < kSameNorth_rad) return;
  const double north_deg = *g.true_north_rad / kRadPerDeg;
  if (ui::button(
          (trf("Turn to true north, {:.3f}°", north_deg) + "###take-north").c_str(), {}, {0, 0},
          "Sets the rotation so that true north of the file points north on the map; the convergence is left out"))
    state.rotation_deg = north_deg;
}

void drawUtm(double latitude_deg, double longitude_deg) {
  const auto u = utm(latitude_deg, longitude_deg);
  ui::property("UTM", figures("{}{}\n{:.3f}  {:.3f}", u.zone, u.north ? "N" : "S", u.easting_m, u.northing_m));
  ui::property("Convergence, UTM", figures("{:.6f}°", u.convergence_deg));
  ui::property("Scale, UTM", figures("{:.8f}", u.scale));
}

// What follows from the CRS; computed anew only for another georeference.
void drawDerived(const Model& model, GeoreferenceState& state, const Georeference& g) {
  if (!g.map_from_file || g.crs.empty()) {
    if (g.site && ui::beginProperties("site", 0.42F)) {
      drawUtm(g.site->latitude_deg, g.site->longitude_deg);
      ui::endProperties();
    }
    return;
  }
  if (state.derived_from != &g) {
    state.derived_from = &g;
    state.derived = geographic(g.crs, mapFromFile(*g.map_from_file, g.shift_m));
  }
  ui::heading(model, "On Earth");
  if (!state.derived) {
    ImGui::TextColored(colour(tone::kWarning), "%s", ICON_WARNING);
    ImGui::SameLine();
    ui::wrapped(trError(state.derived.error()));
    return;
  }
  if (!ui::beginProperties("derived", 0.42F)) return;
  const auto& at = state.derived->geographic;
  ui::property("Latitude", figures("{:.8f}°", at.latitude_deg));
  ui::property("Longitude", figures("{:.8f}°", at.longitude_deg));
  ui::property("Convergence, CRS", figures("{:.6f}°", state.derived->grid_convergence_deg));
  ui::property("Scale, CRS", figures("{:.8f}", state.derived->scale_factor));
  drawUtm(at.latitude_deg, at.longitude_deg);
  ui::endProperties();
}

void fill(GeoreferenceState& state, const Georeference& g) {
  if (state.filled_from == &g) return;
  state.filled_from = &g;
  state.crs = g.crs;
  if (!g.map_from_file) return;
  state.origin_m = {g.map_from_file->eastings_m, g.map_from_file->northings_m, g.map_from_file->orthogonal_height_m};
  state.rotation_deg = rotationDeg(*g.map_from_file);
}

void drawForm(const Model& model, GeoreferenceState& state, const Georeference& g, Actions& actions) {
  ui::heading(model, "Set");
  if (ui::beginProperties("form", 0.42F)) {
    ui::propertyLabel("CRS");
    ImGui::InputTextWithHint("###crs", "EPSG:25832", &state.crs);
    ui::propertyLabel("Origin on the map");
    static constexpr const char* kAxes[] = {"E", "N", "H"};
    for (Eigen::Index i = 0; i < 3; ++i) {
      ImGui::AlignTextToFramePadding();
      ui::dimText(kAxes[i]);
      ImGui::SameLine(1.5F * ImGui::GetFontSize());
      ImGui::SetNextItemWidth(-FLT_MIN);
      ui::numberField(fmt::format("###origin{}", i).c_str(), state.origin_m[i], {.kind = {.unit = "m"}, .decimals = 3});
    }
    ui::propertyLabel("Rotation");
    ui::numberField("###rotation", state.rotation_deg, {.kind = {.unit = "°"}, .decimals = 6},
                    "From east on the map to the model's X axis, counter-clockwise");
    offerTrueNorth(state, g);
    ui::endProperties();
  }
  if (!ui::primaryButton(ICON_GLOBE "  Set georeference###georeference", model.session.whyNot("georeference"),
                         {-FLT_MIN, 0}))
    return;
  actions.start(GeoreferenceOptions{.crs = state.crs, .origin = state.origin_m, .rotation_deg = state.rotation_deg},
                "Set georeference");
}

void draw(const Model& model, GeoreferenceState& state, Actions& actions) {
  const auto& georeference = model.session.document().georeference;
  if (!georeference) {
    ui::emptyState(model, ICON_GLOBE, "Not georeferenced", "Georeferencing is read when a model is imported.");
    return;
  }
  fill(state, *georeference);
  drawStated(*georeference);
  drawDerived(model, state, *georeference);
  drawForm(model, state, *georeference, actions);
}

}  // namespace

void drawGeoreferencePanel(const Model& model, PanelStates& states, Actions& actions) {
  draw(model, states.of<GeoreferenceState>(), actions);
}

}  // namespace standpoint
