// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/panels/optimise_panel.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <imgui.h>

#include "core/units.h"
#include "editor/panels/actions.h"
#include "editor/panels/panel.h"
#include "editor/widgets/drop_down.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/number_field.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/widgets.h"

namespace standpoint {

namespace {

void drawResult(const Model& model, const OptimiseState& state, const SimplifiedModel& light) {
  ui::heading(model, "Result");
  const auto& all = light.all;
  const double fraction = all.triangles_before > 0
                              ? static_cast<double>(all.triangles_after) / static_cast<double>(all.triangles_before)
                              : 1;
  ui::meter(model, fraction, tone::kAccent);
  // A product may be farther from itself before than from what stands around it.
  double largest_m = all.max_deviation_m;
  for (const auto& product : light.products) largest_m = std::max(largest_m, product.max_deviation_m);
  if (ui::beginProperties("result", 0.5F)) {
    ui::property("Triangles before", groupedDigits(all.triangles_before));
    ui::property("Triangles after", figures("{}  ({:.1f} %)", groupedDigits(all.triangles_after), fraction * 100));
    ui::property("Largest deviation", figures("{:.1f} mm", largest_m * 1000));
    ui::property("Mean deviation", figures("{:.3f} mm", all.mean_deviation_m * 1000));
    ui::property("Normal deviation", trf("{:.2f}° mean", all.mean_turn_rad / kRadPerDeg));
    ui::endProperties();
  }
  if (state.asked > 0 && all.triangles_after > state.asked && light.request.budget == all.triangles_after)
    ui::dimWrapped(
        trf("{} triangles cannot be reached within this deviation: these are the fewest.", groupedDigits(state.asked)));
  else if (light.request.budget.value_or(0) > 0 && all.triangles_after > *light.request.budget)
    ImGui::TextColored(colour(tone::kWarning), "%s  %s", ICON_WARNING,
                       tr("Budget not reachable within this deviation").c_str());
}

std::string lengthText(double metres) {
  return metres < 1e-3 ? figures("{:.1f} mm", metres * 1000) : fmt::format("{:.0f} mm", metres * 1000);
}

// Of the area of both models, how much stands how far from the other one.
void drawHistogram(const Model& model, Actions& actions) {
  ui::heading(model, "Surface deviation");
  actions.wantDeviation();
  const auto both = model.deviation.of(model.session.document());
  if (!both) {
    ui::dimText(model.deviation.busy() ? "Comparing with the original …" : "Not compared");
    return;
  }
  const auto& area = both->histogram.area_m2;
  double sum = 0, most = 0;
  for (const double a : area) sum += a, most = std::max(most, a);
  if (!(sum > 0)) return;
  const auto upTo = [&](std::size_t i) {
    return i + 1 == area.size() ? trf("over {}", lengthText(DeviationHistogram::kLimits_m[i - 1]))
                                : trf("to {}", lengthText(DeviationHistogram::kLimits_m[i]));
  };
  ui::copyTable("histogram", [&] {
    TableRows table = {{tr("Surface deviation"), "m²", "%"}};
    for (std::size_t i = 0; i < area.size(); ++i)
      table.push_back({upTo(i), figures("{:.3f}", area[i]), figures("{:.3f}", area[i] / sum * 100)});
    return table;
  });
  if (!ImGui::BeginTable("histogram", 3)) return;
  ImGui::TableSetupColumn("to", ImGuiTableColumnFlags_WidthFixed, model.px(86));
  ImGui::TableSetupColumn("bar", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("share", ImGuiTableColumnFlags_WidthFixed, model.px(58));
  for (std::size_t i = 0; i < area.size(); ++i) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ui::dimText(upTo(i));
    ImGui::TableNextColumn();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x, height = ImGui::GetTextLineHeight();
    // By the root: what is rare is what one looks for.
    const auto length = static_cast<float>(std::sqrt(area[i] / most)) * width;
    const auto c =
        deviationColour(i == 0 ? 0 : std::min(DeviationHistogram::kLimits_m[i], 1.0), both->lighter->full_scale_m);
    ImGui::GetWindowDrawList()->AddRectFilled({at.x, at.y + height * 0.2F}, {at.x + length, at.y + height * 0.9F},
                                              IM_COL32(c[0], c[1], c[2], 255));
    ImGui::Dummy({width, height});
    ImGui::TableNextColumn();
    ui::textRightAligned(figures("{:.2f} %", area[i] / sum * 100));
  }
  ImGui::EndTable();
  const bool shown = model.view.colour == ColourMode::deviation && model.view.side == ModelSide::both;
  if (ui::button(shown ? ICON_CUBE "  Show model colours###map" : ICON_PAINT "  Show on both models###map", "",
                 {-FLT_MIN, 0})) {
    actions.colourBy(shown ? ColourMode::model : ColourMode::deviation);
    actions.showSide(shown ? ModelSide::lighter : ModelSide::both);
  }
}

// What lost most, so that one can look at it.
void drawWorst(const Model& model, Actions& actions, const SimplifiedModel& light) {
  std::vector<std::uint32_t> order;
  for (std::uint32_t p = 0; p < light.products.size(); ++p)
    if (light.products[p].max_deviation_m > 0) order.push_back(p);
  if (order.empty()) return;
  const auto shown = std::min<std::size_t>(order.size(), 50);
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(shown), order.end(),
                    [&](std::uint32_t a, std::uint32_t b) {
                      return light.products[a].max_deviation_m > light.products[b].max_deviation_m;
                    });
  ui::heading(model, "Largest deviations");
  ui::copyTable("worst", [&] {
    TableRows table = {{tr("Product"), "mm", tr("Triangles"), tr("Original")}};
    for (std::size_t i = 0; i < shown; ++i) {
      const auto& loss = light.products[order[i]];
      table.push_back({productLabel(model.environment()->products[order[i]]),
                       figures("{:.3f}", loss.max_deviation_m * 1000), std::to_string(loss.triangles_after),
                       std::to_string(loss.triangles_before)});
    }
    return table;
  });
  const float height = std::max(ImGui::GetContentRegionAvail().y, model.px(150));  // else the panel is scrolled
  if (!ImGui::BeginTable("worst", 3, ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg, {0, height})) return;
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn(ui::Label("Product"), ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("mm", ImGuiTableColumnFlags_WidthFixed, model.px(44));
  ImGui::TableSetupColumn(ui::Label("Triangles"), ImGuiTableColumnFlags_WidthFixed, model.px(96));
  ui::tableHead({1, 2});
  for (std::size_t i = 0; i < shown; ++i) {
    const auto& loss = light.products[order[i]];
    ImGui::PushID(static_cast<int>(i));
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    if (ImGui::Selectable("###worst", model.selection.contains(order[i]), ImGuiSelectableFlags_SpanAllColumns)) {
      actions.reveal(order[i]);
      actions.showSelection();
    }
    ImGui::SameLine(0, 0);
    ui::fitted(productLabel(model.environment()->products[order[i]]), ImGui::GetContentRegionAvail().x);
    ImGui::TableNextColumn();
    ui::textRightAligned(figures("{:.1f}", loss.max_deviation_m * 1000));
    ImGui::TableNextColumn();
    ui::textRightAligned(
        fmt::format("{} → {}", groupedDigits(loss.triangles_before), groupedDigits(loss.triangles_after)));
    ImGui::PopID();
  }
  ImGui::EndTable();
}

// But for the engine, which a preview has no choice of.
SimplificationRequest requestOf(const Model& model, const OptimiseState& state, std::uint64_t budget) {
  return {.budget = state.only_lossless ? 0 : std::max<std::uint64_t>(1, budget),
          .max_deviation_m = state.max_deviation_mm / 1000,
          .by_view = state.by_view && model.session.document().collision};
}

// A project that is opened was simplified by its own request, not by this form's.
void followProject(OptimiseState& state, const Document& document, std::uint64_t before) {
  if (state.followed == document.simplified) return;
  state.followed = document.simplified;
  if (state.asked > 0 || !state.followed || before == 0) return;
  const auto& request = state.followed->request;
  if (request.budget) state.only_lossless = *request.budget == 0;
  if (request.budget.value_or(0) > 0)
    state.budget_fraction = std::min(1.0, static_cast<double>(*request.budget) / static_cast<double>(before));
  state.max_deviation_mm = request.max_deviation_m * 1000;
}

// Asks for the model at the sliders' budget, and says what has come of it.
void drawPreview(const Model& model, const OptimiseState& state, Actions& actions, std::uint64_t budget) {
  if (!state.only_lossless) actions.wantBudget(requestOf(model, state, budget));
  const auto preview = model.budget_preview.state();
  if (!preview.error.empty())
    ImGui::TextColored(colour(tone::kWarning), "%s  %s", ICON_WARNING, preview.error.c_str());
  else if (preview.preparing || !preview.shown)
    ui::dimText("Preparing all levels …");
  else if (preview.triangles > budget)
    ImGui::TextColored(colour(tone::kWarning), "%s  %s", ICON_WARNING,
                       trf("Minimum about {} at this deviation", groupedDigits(preview.least)).c_str());
  else
    ui::dimText(trf("{} triangles in view", groupedDigits(preview.triangles)));
}

void chooseEngine(std::string& engine) {
  const auto choices = engineChoices();
  const auto chosen =
      std::find_if(choices.begin(), choices.end(), [&](const EngineChoice& choice) { return choice.id == engine; });
  const bool open = ui::beginDropDown("###engine", tr(chosen->title).c_str());
  if (!open) {
    ui::tooltip(chosen->help);
    return;
  }
  for (const auto& choice : choices) {
    if (ui::choice(ui::Label(choice.title), engine == choice.id)) engine = choice.id;
    ui::tooltip(choice.help);
  }
  ui::endDropDown();
}

void draw(const Model& model, OptimiseState& state, Actions& actions) {
  const auto& document = model.session.document();
  if (!document.imported) {
    ui::emptyState(model, ICON_COMPRESS, "Nothing to optimise", "Import a model first.");
    return;
  }
  const auto before = sceneTriangleCount(*document.imported);
  followProject(state, document, before);
  ui::dimText(trf("The imported model has {} triangles.", groupedDigits(before)));
  ui::gap(model, 2);
  ui::checkbox(ui::Label("Lossless only"), &state.only_lossless);
  ui::tooltip("Merges planar regions without moving any surface");
  const auto budget = static_cast<std::uint64_t>(std::llround(state.budget_fraction * static_cast<double>(before)));
  ImGui::BeginDisabled(state.only_lossless);
  if (ui::beginProperties("options", 0.42F)) {
    ui::propertyLabel("Budget");
    double percent = state.budget_fraction * 100;
    if (ui::numberSlider("###budget", percent, 1, 100,
                         {.kind = {.unit = "%", .least = 0.01, .most = 100}, .decimals = 0}))
      state.budget_fraction = percent / 100;
    ui::propertyLabel(" ");
    double triangles = static_cast<double>(budget);
    ImGui::SetNextItemWidth(-FLT_MIN);
    if (std::exchange(state.budget_wanted, false)) ui::focusNext();
    if (ui::numberField("###budget-triangles", triangles,
                        {.kind = {.unit = "triangles", .least = 1, .most = static_cast<double>(before)}, .decimals = 0},
                        "Triangles that the whole model may have"))
      state.budget_fraction = triangles / static_cast<double>(before);
    ui::propertyLabel("Max deviation");
    ui::numberSlider("###deviation", state.max_deviation_mm, 0.5, 100,
                     {.kind = {.unit = "mm", .least = 0.001, .most = 10000}, .decimals = 1}, nullptr, true);
    ui::propertyLabel("Engine");
    chooseEngine(state.engine);
    ui::endProperties();
  }
  ImGui::BeginDisabled(!document.collision);
  ui::checkbox(ui::Label("Prioritise visible surfaces"), &state.by_view);
  ImGui::EndDisabled();
  ui::tooltip(document.collision ? "Weights errors by visibility from the walkable surface"
                                 : "Compute collision shapes first (Collision panel)");
  ui::checkbox(ui::Label("Live preview"), &state.live);
  ui::tooltip("The view follows the sliders. Choose Optimise to measure and keep the result.");
  if (state.live) drawPreview(model, state, actions, budget);
  if (!state.only_lossless)
    ui::dimWrapped("Goes as far towards the budget as the maximum deviation allows. Nothing moves further than that.");
  ImGui::EndDisabled();
  if (ui::primaryButton(ICON_COMPRESS "  Optimise###run-optimise", model.session.whyNot("optimize"), {-FLT_MIN, 0})) {
    state.live = false;
    auto request = requestOf(model, state, budget);
    request.engine = state.engine;
    state.asked = request.budget.value_or(0);
    actions.optimise(request);
  }
  if (!document.simplified) return;
  drawResult(model, state, *document.simplified);
  drawHistogram(model, actions);
  drawWorst(model, actions, *document.simplified);
}

}  // namespace

void drawOptimisePanel(const Model& model, PanelStates& states, Actions& actions) {
  draw(model, states.of<OptimiseState>(), actions);
}

}  // namespace standpoint
