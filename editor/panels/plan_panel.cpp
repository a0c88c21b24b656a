// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include <fmt/format.h>
#include <imgui.h>

#include "editor/desktop/file_list.h"
#include "editor/panels/actions.h"
#include "editor/panels/panel.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/number_field.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/widgets.h"
#include "project/survey/survey_verbs.h"

namespace standpoint {

namespace {

constexpr double kLowOverlap = 0.3;

std::string percent(double fraction) { return fmt::format("{:.0f} %", fraction * 100); }
void start(const Model& model, Actions& actions) {
  const auto& [spacing_mm, max_incidence_deg] = model.seen;
  constexpr std::size_t kSamples = 200000;  // so that gaps are drawn by squares of some 20 cm in a house
  PlanOptions options{
      .instrument = model.scan_choice.instrument, .settings = model.scan_choice.settings, .samples = kSamples};
  if (spacing_mm > 0) options.spacing_m = spacing_mm / 1000;
  if (max_incidence_deg < 90) options.max_incidence_deg = max_incidence_deg;
  actions.start(options, "Plan the scans");
}

// The same as the view's colour chip, where it is wanted.
void drawMapSwitch(const Model& model, Actions& actions) {
  struct Map {
    const char* label;
    ColourMode mode;
    const char* help;
  };
  static constexpr Map kMaps[] = {
      {"Stations###map-stations", ColourMode::coverage, "Number of stations that see each surface; gaps are magenta"},
      {"Spacing###map-spacing", ColourMode::coverage_spacing, "Point spacing of the densest scan"},
      {"Incidence###map-incidence", ColourMode::coverage_incidence, "Smallest angle of incidence on each surface"}};
  ui::dimText("Show on the model");
  const float width = ui::shareOfRow(3);
  for (const auto& map : kMaps) {
    if (&map != kMaps) ImGui::SameLine();
    const bool lit = model.view.colour == map.mode;
    ImGui::PushStyleColor(ImGuiCol_Button,
                          lit ? ImVec4(0.25F, 0.56F, 0.97F, 0.45F) : ImGui::GetStyleColorVec4(ImGuiCol_Button));
    if (ui::button(map.label, {}, {width, 0}, map.help)) actions.colourBy(lit ? ColourMode::model : map.mode);
    ImGui::PopStyleColor();
  }
}

void drawWishes(const Model& model, Actions& actions) {
  if (!ui::beginProperties("wishes", 0.46F)) return;
  SeenLimits limits = model.seen;
  ui::propertyLabel("Point spacing");
  ui::numberField("###spacing", limits.spacing_mm, {.kind = {.unit = "mm", .least = 0}, .decimals = 1, .zero = "any"},
                  "Maximum point spacing for a surface to count as covered; 0 = any return counts");
  ui::propertyLabel("Max incidence");
  ui::numberField("###incidence", limits.max_incidence_deg,
                  {.kind = {.unit = "°", .least = 1, .most = 90}, .decimals = 0});
  actions.set(limits);
  ui::endProperties();
}

void coverageRow(const std::string& name, const PlanCoverage& row) {
  ui::property(name.empty() ? "(none)" : name.c_str(), trf("{}  of {:.1f} m²", percent(row.coverage), row.exposed_m2));
}

void drawCoverage(const Model& model, const PlanAnswer& answer) {
  ui::heading(model, "By storey");
  if (ui::beginProperties("By storey", 0.56F)) {
    for (const auto& row : answer.storeys) coverageRow(row.storey, row);
    ui::endProperties();
  }
  ui::heading(model, "By class");
  if (!ui::beginProperties("By class", 0.56F)) return;
  for (const auto& row : answer.classes)
    coverageRow(row.ifc_class.empty() ? row.ifc_class : tr(readableClass(row.ifc_class)), row);
  ui::endProperties();
}

void drawStations(const Model& model, const PlanAnswer& answer) {
  ui::heading(model, "Stations");
  ui::copyTable("planned", [&] {
    TableRows table = {{tr("Station"), tr("Sees") + ", m²", tr("Points"), tr("File") + ", MB"}};
    for (const auto& s : answer.stations)
      table.push_back({s.station, figures("{:.2f}", s.seen_m2), std::to_string(s.points),
                       figures("{:.1f}", static_cast<double>(s.bytes) / 1e6)});
    return table;
  });
  if (!ImGui::BeginTable("planned", 4, ImGuiTableFlags_RowBg | ImGuiTableFlags_PadOuterX)) return;
  for (const char* title : {"Station", "Sees", "Points", "File"}) ImGui::TableSetupColumn(ui::Label(title));
  ImGui::TableHeadersRow();
  const auto row = [](const std::string& name, const std::string& sees, std::int64_t points, std::int64_t bytes) {
    ImGui::TableNextRow();
    for (const auto& text : {name, sees, figures("{:.1f} M", static_cast<double>(points) / 1e6),
                             readableSize(static_cast<std::uint64_t>(bytes))}) {
      ImGui::TableNextColumn();
      ui::fitted(text, ImGui::GetContentRegionAvail().x);
    }
  };
  for (const auto& s : answer.stations) row(s.station, fmt::format("{:.0f} m²", s.seen_m2), s.points, s.bytes);
  row(tr("All"), percent(answer.coverage), answer.points, answer.bytes);
  ImGui::EndTable();
  ui::dimText(trf("Time on site: {}", durationText(answer.instrument_seconds)));
}

void drawPairs(const Model& model, const std::vector<PlanPair>& pairs) {
  if (pairs.empty()) return;
  ui::heading(model, "Overlap");
  if (!ui::beginProperties("pairs", 0.56F)) return;
  for (const auto& pair : pairs)
    ui::property(fmt::format("{} – {}", pair.a, pair.b).c_str(),
                 percent(pair.overlap) + (pair.overlap < kLowOverlap ? tr("   low overlap") : ""));
  ui::endProperties();
}

void drawHoles(const Model& model, Actions& actions, const std::vector<PlanHole>& holes) {
  if (holes.empty()) return;
  ui::heading(model, "Not covered");
  actions.button("holes-plan", "Show on the plan", -FLT_MIN);
  const auto& products = model.environment()->products;
  for (std::size_t k = 0; k < holes.size(); ++k) {
    const auto& hole = holes[k];
    ImGui::PushID(static_cast<int>(k));
    if (ImGui::Selectable(
            figures("{:.1f} m²   {} {}###hole", hole.unseen_m2, tr(readableClass(hole.ifc_class)), hole.name).c_str()))
      for (std::uint32_t p = 0; p < products.size(); ++p)
        if (products[p].id == hole.id) actions.reveal(p);
    ImGui::PopID();
  }
}

void drawProposal(const Model& model, Actions& actions, const PlanProposal& proposed) {
  const auto text = trf(ICON_STATION "  Add station: +{:.0f} m²###add-proposed", proposed.adds_m2);
  if (!ui::button(text.c_str(), model.session.whyNot("station"), {-FLT_MIN, 0},
                  "Adds a station at the place with the largest coverage gain"))
    return;
  const auto& stations = model.session.document().job->stations;
  for (std::size_t i = stations.size() + 1;; ++i) {
    const auto name = fmt::format("S{}", i);
    if (std::any_of(stations.begin(), stations.end(), [&](const Station& s) { return s.name == name; })) continue;
    actions.start(StationOptions{.add = name, .at = proposed.at}, trf("Add station {}", name));
    return;
  }
}

}  // namespace

void drawPlanPanel(const Model& model, PanelStates&, Actions& actions) {
  if (!model.environment() || !model.session.document().job) {
    ui::emptyState(model, ICON_EYE, "Nothing to plan", "Import a model first.");
    return;
  }
  const auto* instrument = model.instrument(model.scan_choice.instrument);
  ui::dimText(instrument == nullptr ? tr("Choose an instrument in the Scan panel")
                                    : trf("{} {}, as set in the Scan panel", instrument->maker, instrument->model));
  drawWishes(model, actions);
  const std::string why = instrument == nullptr ? "Choose an instrument in the Scan panel first"
                          : model.session.document().job->stations.empty()
                              ? "Add a station first: press Shift+T and click the floor"
                              : model.session.whyNot("plan");
  if (ui::primaryButton(ICON_EYE "  Compute coverage###run-plan", why, {-FLT_MIN, model.px(28)})) start(model, actions);
  if (!why.empty() && model.session.whyNot("plan").empty()) ui::dimWrapped(tr(why));
  if (instrument != nullptr && model.session.document().job->stations.empty() &&
      ui::button(ICON_MAGIC "  Find a first place###first-place", model.session.whyNot("plan"), {-FLT_MIN, 0},
                 "Computes which place sees most, and proposes a station there"))
    start(model, actions);
  drawMapSwitch(model, actions);
  const auto* last = model.session.lastOf("plan");
  const auto* answer = last == nullptr ? nullptr : answerAs<PlanAnswer>(last->answer);
  if (answer == nullptr) return;
  if (model.session.isOutOfDate(*last)) ui::dimWrapped("Coverage is out of date. Compute it again.");
  ui::meter(model, answer->coverage, tone::kGood);
  ui::dimText(trf("{} of {:.0f} m² of exposed surface", percent(answer->coverage), answer->exposed_m2));
  if (answer->proposed) drawProposal(model, actions, *answer->proposed);
  drawStations(model, *answer);
  drawPairs(model, answer->pairs);
  drawCoverage(model, *answer);
  drawHoles(model, actions, answer->holes);
}

}  // namespace standpoint
