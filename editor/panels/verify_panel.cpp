// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <imgui.h>

#include "editor/model/verification_view.h"
#include "editor/panels/actions.h"
#include "editor/panels/panel.h"
#include "editor/panels/scan_panel.h"
#include "editor/widgets/drop_down.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/widgets.h"
#include "editor/words/sentences.h"
#include "project/materials/materials_verb.h"
#include "project/materials/verification.h"
#include "project/survey/underlays.h"

namespace standpoint {

namespace {

struct VerifyState {
  std::string underlay, instrument;  // instrument "": as the cloud says
  std::string chosen;                // material id
  std::uint64_t seen_revision = ~0ULL;
  VerificationView view;  // of that revision
};

std::string labelOf(const Model& model, const std::string& id) {
  if (id.empty()) return tr("Unassigned");
  const auto* material = model.offeredMaterial(id);
  return material == nullptr ? id : tr(material->label);
}

void chooseUnderlay(const Model& model, VerifyState& state) {
  const auto& underlays = model.session.document().underlays;
  const bool there =
      std::any_of(underlays.begin(), underlays.end(), [&](const auto& u) { return u->name == state.underlay; });
  if (!there) state.underlay = underlays.front()->name;
  ImGui::SetNextItemWidth(-1);
  if (!ui::beginDropDown("###underlay", state.underlay.c_str())) return;
  for (const auto& u : underlays)
    if (ui::choice(u->name.c_str(), u->name == state.underlay)) state.underlay = u->name;
  ui::endDropDown();
}

void chooseInstrument(const Model& model, VerifyState& state) {
  const char* as_said = "Instrument from the point cloud";
  ImGui::SetNextItemWidth(-1);
  if (!ui::beginDropDown("###instrument", state.instrument.empty() ? as_said : state.instrument.c_str())) return;
  if (ui::choice(as_said, state.instrument.empty())) state.instrument.clear();
  for (const auto& i : model.catalogue().instruments)
    if (ui::choice(fmt::format("{} {}  ({:.0f} nm)###{}", i.maker, i.model, i.wavelength_nm, i.id).c_str(),
                   i.id == state.instrument))
      state.instrument = i.id;
  listBrokenInstruments(model);
  ui::endDropDown();
}

void drawVerifyButtons(const Model& model, VerifyState& state, Actions& actions) {
  const float width = ui::shareOfRow(2);
  const auto why =
      !model.session.document().materials ? std::string("Assign materials first") : model.session.whyNot("verify");
  if (ui::primaryButton(ICON_CHECK "  Compare###verify", why, {width, 0}))
    actions.start(VerifyOptions{.underlay = state.underlay, .instrument = state.instrument},
                  trf("Verify materials with {}", state.underlay));
  ImGui::SameLine();
  if (ui::button(ICON_MOVE "  Fit to model###fit", model.session.whyNot("underlay"), {width, 0},
                 "Aligns the point cloud to the model surface, starting from its current position (ICP)")) {
    UnderlayOptions options{.fit = state.underlay};
    options.to_surface = true;
    actions.start(options, trf("Fit {} to the model", state.underlay));
  }
}

// What came of the last fit, as long as it is the last that was done to the clouds.
void drawFit(const Model& model) {
  const auto* last = model.session.lastAnswer<UnderlayAnswer>("underlay");
  if (last == nullptr || !last->registered || !last->registered->icp) return;
  const SurfaceFit& icp = *last->registered->icp;
  const bool good = icp.settled && icp.free.empty() && icp.used_fraction > 0.5;
  ImGui::TextColored(colour(good ? tone::kGood : tone::kWarning), "%s", good ? ICON_CHECK : ICON_WARNING);
  ImGui::SameLine();
  std::string text = trf("Fitted: moved by {:.1f} mm; {:.0f} % of points on the model, RMS {:.1f} mm",
                         icp.moved_m * 1000, icp.used_fraction * 100, icp.rms_m * 1000);
  if (!icp.settled) text += tr("; the fit did not converge: place the cloud closer first");
  if (!icp.free.empty()) text += tr("; not constrained in every direction (see Log)");
  ui::wrapped(text);
}

// Whiskers at 5 and 95 %, the box between the quartiles, and a line where measured is as expected.
void drawBox(const Model& model, const VerifiedMaterial& m, double reach_db) {
  auto& list = *ImGui::GetWindowDrawList();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = ImGui::GetTextLineHeight(),
              middle = corner.y + height / 2;
  const auto x = [&](double db) {
    return corner.x + width * static_cast<float>(0.5 + 0.5 * std::clamp(db / reach_db, -1.0, 1.0));
  };
  const ImU32 tone = !m.judged ? tone::kDim : m.agrees ? tone::kGood : tone::kWarning;
  list.AddLine({x(0), corner.y}, {x(0), corner.y + height}, tone::kLine, model.scale);
  list.AddLine({x(m.off_db[0]), middle}, {x(m.off_db[4]), middle}, tone, model.scale);
  const float half = height * 0.32F, least = model.px(1);
  list.AddRectFilled({x(m.off_db[1]) - least, middle - half}, {x(m.off_db[3]) + least, middle + half},
                     (tone & 0x00FFFFFFU) | 0x70000000U);
  list.AddLine({x(m.off_db[2]), middle - half}, {x(m.off_db[2]), middle + half}, tone, 2 * model.scale);
  ImGui::Dummy({width, height});
}

void drawMaterial(const Model& model, VerifyState& state, Actions& actions, const VerifiedMaterial& m,
                  double reach_db) {
  ImGui::PushID(m.material.c_str());
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  if (ImGui::Selectable("###row", state.chosen == m.material, ImGuiSelectableFlags_SpanAllColumns)) {
    state.chosen = m.material;
    actions.select(m.products);
  }
  ui::tooltip(trf("{}\n{} points\n5 % {:+.1f}, quartiles {:+.1f} and {:+.1f}, 95 % {:+.1f} dB{}", m.material,
                  groupedDigits(m.points), m.off_db[0], m.off_db[1], m.off_db[3], m.off_db[4],
                  m.judged ? "" : "\n" + tr("too few points, ranges or angles for a verdict")));
  ImGui::SameLine(0, 0);
  ui::fitted(labelOf(model, m.material), ImGui::GetContentRegionAvail().x);
  ImGui::TableNextColumn();
  drawBox(model, m, reach_db);
  ImGui::TableNextColumn();
  ui::textRightAligned(m.judged ? figures("{:+.1f}", m.off_db[2]) : "?");
  ImGui::PopID();
}

void drawMaterials(const Model& model, VerifyState& state, Actions& actions, const VerificationView& view) {
  ui::heading(model, "Measured minus expected");
  ui::copyTable("off", [&] {
    TableRows table = {{tr("Material"), tr("Points"), "5 %, dB", "25 %, dB", "50 %, dB", "75 %, dB", "95 %, dB"}};
    for (const auto& m : view.materials) {
      table.push_back({labelOf(model, m.material), std::to_string(m.points)});
      for (const double db : m.off_db) table.back().push_back(figures("{:+.2f}", db));
    }
    return table;
  });
  const auto flags = ImGuiTableFlags_RowBg | ImGuiTableFlags_PadOuterX;
  if (!ImGui::BeginTable("off", 3, flags)) return;
  ImGui::TableSetupColumn(ui::Label("Material"), ImGuiTableColumnFlags_WidthStretch, 1.1F);
  ImGui::TableSetupColumn(fmt::format("−{0:.0f} … +{0:.0f} dB", view.reach_db).c_str(),
                          ImGuiTableColumnFlags_WidthStretch, 1);
  ImGui::TableSetupColumn("dB", ImGuiTableColumnFlags_WidthFixed, model.px(38));
  ui::tableHead({2});
  for (const auto& m : view.materials) drawMaterial(model, state, actions, m, view.reach_db);
  ImGui::EndTable();
}

std::string titleOf(const Model& model, const VerifiedProposal& p) {
  const auto count =
      p.whole_material
          ? std::string()
          : " (" + trn("{} product", "{} products", p.products.size(), groupedDigits(p.products.size())) + ")";
  return trf("{}{} behaves like {}", labelOf(model, p.material), count, labelOf(model, p.behaves_like));
}

// What it proposes is among what the user said: nothing is left to press.
bool isTaken(const Document& document, const VerifiedProposal& p) {
  if (!document.materials) return false;
  const auto& said = document.materials->overrides;
  return std::all_of(p.assign.begin(), p.assign.end(), [&](const MaterialOverride& assign) {
    return std::any_of(said.begin(), said.end(), [&](const MaterialOverride& o) {
      return o.selector == assign.selector && o.material == assign.material;
    });
  });
}

void drawProposal(const Model& model, Actions& actions, const VerifiedProposal& p, int index) {
  ImGui::PushID(index);
  ImGui::TextColored(colour(tone::kWarning), "%s", ICON_WARNING);
  ImGui::SameLine();
  ui::wrapped(titleOf(model, p));
  ui::dimWrapped(trSentence(p.evidence));
  std::vector<std::string> alike;
  for (const auto& id : p.alike) alike.push_back(labelOf(model, id));
  if (!alike.empty()) ui::dimWrapped(trf("As well as: {}", fmt::join(alike, "; ")));
  const std::string why = isTaken(model.session.document(), p) ? "Assigned. Compare again to see the effect."
                                                               : model.session.whyNot("materials");
  if (ui::button(ICON_PAINT "  Assign###assign", why, {0, 0}, "Assigns the material to these products (can be undone)"))
    actions.start(MaterialsOptions{{.assign = p.assign}}, "Assign measured materials");
  ImGui::SameLine();
  if (ui::button(ICON_POINTER "  Select###select", {}, {0, 0})) {
    actions.select(p.products);
    actions.showSelection();
  }
  ui::gap(model, 4);
  ImGui::PopID();
}

void drawVerdict(const Model& model, Actions& actions, const VerificationView& view) {
  if (!view.current) {
    ImGui::TextColored(colour(tone::kWarning), "%s", ICON_WARNING);
    ImGui::SameLine();
    ui::wrapped("Materials or cloud position have changed. Compare again.");
  }
  if (!view.no_verdict.empty()) {
    ImGui::TextColored(colour(tone::kBad), "%s", ICON_WARNING);
    ImGui::SameLine();
    ui::wrapped(trf("No verdict: {}", view.no_verdict));
  } else if (view.proposals.empty()) {
    ImGui::TextColored(colour(tone::kGood), "%s", ICON_CHECK);
    ImGui::SameLine();
    ui::wrapped("The measurements contradict no assigned material.");
  }
  for (std::size_t i = 0; i < view.proposals.size(); ++i)
    drawProposal(model, actions, view.proposals[i], static_cast<int>(i));
}

void drawBasis(const Model& model, const VerificationView& view) {
  ui::heading(model, "Based on");
  if (!ui::beginProperties("basis")) return;
  ui::property("Cloud", view.underlay);
  ui::property("Instrument", view.instrument);
  ui::property("Points", groupedDigits(view.compared));
  if (!view.scale.empty()) ui::property("Vendor's scale", view.scale);
  if (view.moved_m >= 0) ui::property("Off the model", figures("{:.1f} mm", view.moved_m * 1000));
  ui::endProperties();
}

void draw(const Model& model, VerifyState& state, Actions& actions) {
  const auto& document = model.session.document();
  if (!model.environment() || document.underlays.empty()) {
    ui::emptyState(model, ICON_CHECK_CIRCLE, "No measured cloud",
                   "Drop a real scan of the building here (E57, PTX) to verify materials by intensity.");
    return;
  }
  chooseUnderlay(model, state);
  chooseInstrument(model, state);
  drawVerifyButtons(model, state, actions);
  drawFit(model);
  ui::gap(model, 4);
  if (state.seen_revision != model.session.revision()) {
    state.seen_revision = model.session.revision();
    state.view = verificationView(document);
  }
  if (!state.view.there) {
    ui::dimWrapped(
        "Compares measured with expected intensity per surface and proposes better materials where they disagree.");
    return;
  }
  ImGui::BeginChild("verified");
  drawVerdict(model, actions, state.view);
  drawMaterials(model, state, actions, state.view);
  drawBasis(model, state.view);
  ImGui::EndChild();
}

}  // namespace

void drawVerifyPanel(const Model& model, PanelStates& states, Actions& actions) {
  draw(model, states.of<VerifyState>(), actions);
}

}  // namespace standpoint
