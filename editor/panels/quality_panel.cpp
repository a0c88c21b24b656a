// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/panels/quality_panel.h"

#include <algorithm>
#include <array>
#include <numeric>

#include <fmt/format.h>
#include <imgui.h>

#include "editor/model/walking.h"
#include "editor/panels/actions.h"
#include "editor/panels/panel.h"
#include "editor/widgets/drop_down.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/verdict_sign.h"
#include "editor/widgets/widgets.h"
#include "editor/words/figures.h"
#include "editor/words/sentences.h"

namespace standpoint {

namespace {

void drawProfile(QualityState& state) {
  const auto all = choices(QualityProfile{});
  if (!ui::beginProperties("limits", 0.40F)) return;
  ui::propertyLabel("Limits for");
  ImGui::SetNextItemWidth(-1);
  const auto chosen = std::find_if(all.begin(), all.end(), [&](const auto& c) { return c.value == state.profile; });
  if (ui::beginDropDown("###profile", tr(chosen->name).c_str())) {
    for (const auto& choice : all)
      if (ui::choice(ui::Label(choice.name), choice.value == state.profile)) state.profile = choice.value;
    ui::endDropDown();
  }
  ui::tooltip("Level of accuracy: the limits in millimetres scale with it");
  ui::endProperties();
}

std::string productName(const ProductIdentity& product) {
  return tr(readableClass(product.ifc_class)) + " " + (product.name.empty() ? product.id : product.name);
}

// The place, or, where none is known, the product: selected, it would have one colour all over, as if nothing else were
// to be seen there.
void goTo(const Model& model, Actions& actions, const AssessPlace& place) {
  const auto& products = model.environment()->products;
  actions.select({});
  if (!place.at) {
    for (std::uint32_t p = 0; place.product && p < products.size(); ++p)
      if (products[p].id == place.product->id) actions.reveal(p);
    return;
  }
  std::string what = place.what.empty() ? tr("Worst place") : trSentence(place.what);
  if (place.product) what += " · " + productName(*place.product);
  actions.showWorstPlace({*place.at - model.shift_m(), std::move(what), place.stations});
}

std::string placeText(const Model& model, const AssessPlace& place) {
  std::string text = tr("Go to the worst place");
  if (!place.what.empty()) text += "\n" + trSentence(place.what);
  if (place.at)
    if (const auto where = placeName(model, *place.at - model.shift_m()); !where.empty()) text += "\n" + where;
  if (!place.stations.empty()) text += fmt::format("\n{}", fmt::join(place.stations, " – "));
  if (place.product) text += "\n" + productName(*place.product);
  return text;
}

// All of it, for what the columns are too narrow for.
std::string rowText(const AssessRow& row) {
  std::string text = fmt::format("{}: {}", tr(row.label), figuresIn(valueText(row)));
  if (!row.note.empty()) text += "\n" + trSentence(row.note);
  return text + "\n" +
         trf("Good {}, bad {} ({})", figuresIn(row.good_text), figuresIn(row.bad_text), trSentence(row.limit_source));
}

void drawRow(const Model& model, QualityState& state, Actions& actions, const AssessRow& row, std::size_t index) {
  ImGui::PushID(static_cast<int>(index));
  ImGui::TableNextRow();
  if (state.shown_row == index) ImGui::TableSetBgColor(ImGuiTableBgTarget_RowBg1, ImGui::GetColorU32(ImGuiCol_Header));
  ImGui::TableNextColumn();
  ImGui::AlignTextToFramePadding();
  ui::verdict(row.verdict);
  ImGui::TableNextColumn();
  ImGui::AlignTextToFramePadding();
  ui::wrapped(tr(row.label));
  ui::tooltip(rowText(row));
  for (const auto& text : {figuresIn(valueText(row)), figuresIn(row.good_text)}) {
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    ui::textRightAligned(text);
  }
  ImGui::TableNextColumn();
  if (row.worst && ui::iconButton(ICON_CROSSHAIRS "###go", placeText(model, *row.worst).c_str()))
    goToRow(model, state, actions, index);
  ImGui::PopID();
}

TableRows tableOf(const std::vector<AssessRow>& rows) {
  TableRows table = {{tr("Figure"), tr("Value"), tr("Limit"), tr("State")}};
  for (const auto k : worstFirst(rows))
    if (const auto& row = rows[k]; !row.good_text.empty())
      table.push_back(
          {tr(row.label), figuresIn(valueText(row)), figuresIn(row.good_text), tr(verdictWord(row.verdict))});
  return table;
}

void drawRows(const Model& model, QualityState& state, Actions& actions, const std::vector<AssessRow>& rows) {
  ui::heading(model, "Figures");
  ui::copyTable("figures", [&] { return tableOf(rows); });
  if (!ImGui::BeginTable("figures", 5, ImGuiTableFlags_RowBg | ImGuiTableFlags_PadOuterX)) return;
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, model.px(16));
  ImGui::TableSetupColumn(ui::Label("Figure"), ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn(ui::Label("Value"), ImGuiTableColumnFlags_WidthFixed, model.px(62));
  ImGui::TableSetupColumn(ui::Label("Limit"), ImGuiTableColumnFlags_WidthFixed, model.px(62));
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, model.px(26));
  ui::tableHead({2, 3});
  for (const auto k : worstFirst(rows))
    if (!rows[k].good_text.empty()) drawRow(model, state, actions, rows[k], k);
  ImGui::EndTable();
}

// What the verdicts of single scans ask for.
void drawRemedies(const AssessAnswer& answer) {
  for (const auto& row : answer.rows) {
    if (!row.good_text.empty()) continue;
    ui::verdict(row.verdict);
    ui::wrapped(trSentence(row.label) + ": " + trSentence(row.note));
  }
}

void drawVerdict(const Model& model, const AssessAnswer& answer) {
  const auto verdict = answer.bad > 0 ? Verdict::bad : answer.warn > 0 ? Verdict::warn : Verdict::good;
  ui::verdict(verdict);
  if (model.fonts.bold != nullptr) ImGui::PushFont(model.fonts.bold);
  ImGui::TextColored(colour(verdictInk(verdict)), "%s", tr(verdictWord(verdict)).c_str());
  if (model.fonts.bold != nullptr) ImGui::PopFont();
  ui::dimWrapped(trf("{}, by {}", trSentence(verdictText(answer)), tr(answer.profile)));
}

// Of what was assessed: later changes of the project are not in it.
void drawSave(const AssessAnswer& answer, Actions& actions) {
  if (!ui::button(ICON_SAVE "  Save report…###save-quality", {}, {-FLT_MIN, 0},
                  "Printable page (.html) or table (.csv)"))
    return;
  actions.askForFile(FileDialogState::Purpose::saveFile, "Save report", "Save", {".html", ".csv"}, "quality.html",
                     [answer](Actions& later, const std::filesystem::path& chosen) {
                       if (const auto written = writeQualityReport(answer, chosen); !written)
                         later.report("The report could not be saved", written.error());
                     });
}

void draw(const Model& model, QualityState& state, Actions& actions) {
  if (!model.environment() || !model.session.document().job) {
    ui::emptyState(model, ICON_CHECK_CIRCLE, "Nothing to assess", "Import a model, then scan it.");
    return;
  }
  drawProfile(state);
  if (ui::primaryButton(ICON_CHECK_CIRCLE "  Assess scans###assess", whyNotAssess(model), {-FLT_MIN, model.px(28)}))
    assess(state, actions);
  const auto* last = model.session.lastOf("assess");
  const auto* answer = last == nullptr ? nullptr : answerAs<AssessAnswer>(last->answer);
  if (answer == nullptr) {
    ui::dimWrapped("Compares the scans with the model and with limits, and shows the worst place of each figure.");
    return;
  }
  if (model.session.isOutOfDate(*last)) ui::wrapped("The project has changed since. Assess the scans again.");
  drawVerdict(model, *answer);
  drawSave(*answer, actions);
  drawRemedies(*answer);
  drawRows(model, state, actions, answer->rows);
  if (!answer->patches.empty()) actions.button("holes-plan", "Show uncovered areas on the plan", -FLT_MIN);
}

}  // namespace

std::string whyNotAssess(const Model& model) {
  const auto& job = model.session.document().job;
  const bool any = job && std::any_of(job->stations.begin(), job->stations.end(),
                                      [](const Station& station) { return !station.scans.empty(); });
  return any ? model.session.whyNot("assess") : "Scan from a station first";
}

void assess(QualityState& state, Actions& actions) {
  if (actions.start(AssessOptions{.profile = state.profile}, "Assess the scans")) state.shown_row.reset();
}

std::vector<std::size_t> worstFirst(const std::vector<AssessRow>& rows) {
  constexpr std::array kOrder = {Verdict::bad, Verdict::warn, Verdict::good, Verdict::unknown};
  const auto rank = [&](std::size_t k) { return std::find(kOrder.begin(), kOrder.end(), rows[k].verdict); };
  std::vector<std::size_t> order(rows.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
  return order;
}

std::optional<std::size_t> worstRow(const std::vector<AssessRow>& rows) {
  for (const auto k : worstFirst(rows))
    if (rows[k].worst && (rows[k].verdict == Verdict::bad || rows[k].verdict == Verdict::warn)) return k;
  return std::nullopt;
}

void goToRow(const Model& model, QualityState& state, Actions& actions, std::size_t row) {
  const auto* answer = model.session.lastAnswer<AssessAnswer>("assess");
  if (answer == nullptr || row >= answer->rows.size() || !answer->rows[row].worst) return;
  state.shown_row = row;
  goTo(model, actions, *answer->rows[row].worst);
}

void drawQualityPanel(const Model& model, PanelStates& states, Actions& actions) {
  draw(model, states.of<QualityState>(), actions);
}

}  // namespace standpoint
