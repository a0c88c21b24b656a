// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/panels/material_card_panel.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <imgui.h>

#include "core/units.h"
#include "editor/model/material_card.h"
#include "editor/panels/actions.h"
#include "editor/panels/panel.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/number_field.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/widgets.h"
#include "editor/words/sentences.h"
#include "editor/words/words.h"
#include "materials/materials.h"

namespace standpoint {

namespace {

constexpr double kFirst_nm = 400, kLast_nm = 1700;

// A frame with what lies in it as shares of its width (from the left) and height (from below).
class Plot {
 public:
  Plot(const Model& model, float height_pt) : list_(*ImGui::GetWindowDrawList()), scale_(model.scale) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float margin = ImGui::CalcTextSize("1000 %").x + model.px(6);
    size_ = {ImGui::GetContentRegionAvail().x - margin - model.px(4), model.px(height_pt)};
    low_ = {corner.x + margin, corner.y + model.px(4)};
    list_.AddRectFilled(low_, {low_.x + size_.x, low_.y + size_.y}, tone::kPlot);
    ImGui::Dummy({margin + size_.x, size_.y + ImGui::GetTextLineHeight() + model.px(10)});
  }
  ImVec2 at(double x, double y) const {
    return {low_.x + static_cast<float>(x) * size_.x,
            low_.y + static_cast<float>(1 - std::clamp(y, 0.0, 1.0)) * size_.y};
  }
  void level(double y, const std::string& text) const {
    const ImVec2 p = at(0, y), words = ImGui::CalcTextSize(text.c_str());
    list_.AddLine(p, at(1, y), tone::kLine, scale_);
    list_.AddText({p.x - words.x - 5 * scale_, p.y - words.y / 2}, tone::kDim, text.c_str());
  }
  void column(double x, const std::string& text, ImU32 tone) const {
    const ImVec2 p = at(x, 0), words = ImGui::CalcTextSize(text.c_str());
    list_.AddLine(p, at(x, 1), tone, scale_);
    const float left = std::clamp(p.x - words.x / 2, low_.x, low_.x + size_.x - words.x);
    list_.AddText({left, p.y + 2 * scale_}, tone::kDim, text.c_str());
  }
  void line(const std::vector<ImVec2>& points, ImU32 tone, float width = 1.8F) const {
    list_.AddPolyline(points.data(), static_cast<int>(points.size()), tone, 0, width * scale_);
  }
  bool hovered() const {
    return ImGui::IsMouseHoveringRect(low_, {low_.x + size_.x, low_.y + size_.y}) && ImGui::IsWindowHovered();
  }
  double pointer() const {
    return std::clamp(static_cast<double>((ImGui::GetIO().MousePos.x - low_.x) / size_.x), 0.0, 1.0);
  }

 private:
  ImDrawList& list_;
  ImVec2 low_, size_;
  float scale_;
};

std::vector<ImVec2> curve(const Plot& plot, const std::vector<std::pair<double, double>>& table) {
  std::vector<ImVec2> points;
  constexpr int kSteps = 130;
  for (int i = 0; i <= kSteps; ++i) {
    const double wavelength = kFirst_nm + (kLast_nm - kFirst_nm) * i / kSteps;
    // Beyond what was measured nothing is drawn: the reader's constant is a default, no figure.
    if (wavelength >= table.front().first && wavelength <= table.back().first)
      points.push_back(plot.at(static_cast<double>(i) / kSteps, atWavelength(table, wavelength)));
  }
  return points;
}

void drawSpectrum(const Model& model, Actions& actions, const PhysicalMaterial& m) {
  ui::heading(model, "Spectrum");
  const Plot plot(model, 120);
  for (const double fraction : {0.0, 0.5, 1.0}) plot.level(fraction, fmt::format("{:.0f} %", fraction * 100));
  const auto x = [](double wavelength) { return (wavelength - kFirst_nm) / (kLast_nm - kFirst_nm); };
  for (const double wavelength : {532.0, 905.0, 1550.0})
    plot.column(x(wavelength), fmt::format("{:.0f}", wavelength), tone::kLine);
  plot.column(x(model.view.wavelength_nm), "", tone::kAccent);
  if (!m.transmittance.empty()) plot.line(curve(plot, m.transmittance), tone::kCurve);
  if (!m.reflectance.empty()) plot.line(curve(plot, m.reflectance), tone::kStation);
  if (plot.hovered()) {
    const double wavelength = kFirst_nm + plot.pointer() * (kLast_nm - kFirst_nm);
    auto text = trf("{:.0f} nm\nreflectance {:.1f} %", wavelength, 100 * atWavelength(m.reflectance, wavelength));
    if (!m.transmittance.empty())
      text += "\n" + trf("transmittance {:.1f} %", 100 * atWavelength(m.transmittance, wavelength));
    ImGui::SetTooltip("%s", text.c_str());
    if (ImGui::IsMouseClicked(0)) actions.showReflectanceAt(std::round(wavelength));
  }
  ui::dimWrapped(m.transmittance.empty() ? "Diffuse reflectance by wavelength (nm). Click to choose a wavelength."
                                         : "Diffuse reflectance and transmittance (blue) by wavelength (nm)");
}

// As a scanner's own light shows them: a ball, and a plane that turns away from it.
void drawBodies(const Model& model, const std::array<float, 81>& response) {
  auto& list = *ImGui::GetWindowDrawList();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float radius = model.px(34);
  const ImVec2 centre(corner.x + radius, corner.y + radius);
  const auto grey = [&](double degrees) {
    const double fraction = std::clamp(
        static_cast<double>(response[static_cast<std::size_t>(std::clamp(degrees, 0.0, 80.0))]) / 100, 0.0, 1.0);
    const int level = static_cast<int>(std::lround(255 * std::pow(fraction, 1 / 2.2)));
    return IM_COL32(level, level, level, 255);
  };
  for (int degrees = 90; degrees >= 0; degrees -= 3)
    list.AddCircleFilled(centre, radius * static_cast<float>(std::sin(degrees * kRadPerDeg)), grey(degrees), 48);
  const float left = corner.x + 2 * radius + model.px(14),
              width = ImGui::GetContentRegionAvail().x - 2 * radius - model.px(18);
  for (int degrees = 0; degrees < 80; degrees += 2)
    list.AddRectFilled({left + width * static_cast<float>(degrees) / 80, corner.y + model.px(12)},
                       {left + width * static_cast<float>(degrees + 2) / 80, corner.y + 2 * radius - model.px(18)},
                       grey(degrees + 1));
  const float below = corner.y + 2 * radius - model.px(16);
  list.AddText({left, below}, tone::kDim, "0°");
  list.AddText({left + width - ImGui::CalcTextSize("80°").x, below}, tone::kDim, "80°");
  ImGui::Dummy({2 * radius, 2 * radius + model.px(4)});
}

void drawAngles(const Model& model, const PhysicalMaterial& m) {
  ui::heading(model, trf("Scanner response at {:.0f} nm", model.view.wavelength_nm).c_str());
  const auto response = angularResponse(m, model.view.wavelength_nm);
  drawBodies(model, response);
  const double head_on = 100 * atWavelength(m.reflectance, model.view.wavelength_nm);
  const double most = std::max(head_on, static_cast<double>(*std::max_element(response.begin(), response.end())));
  const double top = most > 100  ? std::pow(10, std::ceil(std::log10(most)))
                     : most > 50 ? 100
                     : most > 20 ? 50
                     : most > 5  ? 20
                                 : 5;
  const Plot plot(model, 90);
  for (const double fraction : {0.0, 0.5, 1.0}) plot.level(fraction, figures("{:g} %", fraction * top));
  for (const int degrees : {0, 20, 40, 60, 80}) plot.column(degrees / 80.0, fmt::format("{}°", degrees), tone::kLine);
  std::vector<ImVec2> own, lambert;
  for (int degrees = 0; degrees <= 80; ++degrees) {
    own.push_back(plot.at(degrees / 80.0, static_cast<double>(response[static_cast<std::size_t>(degrees)]) / top));
    lambert.push_back(plot.at(degrees / 80.0, head_on * std::cos(degrees * kRadPerDeg) / top));
  }
  plot.line(lambert, tone::kDim, 1);
  plot.line(own, tone::kStation);
  if (plot.hovered()) {
    const auto degrees = static_cast<std::size_t>(std::lround(plot.pointer() * 80));
    ui::tooltip(trf("{}°: equals a white target of {:.1f} % at normal incidence", degrees,
                    static_cast<double>(response[degrees])));
  }
  ui::dimWrapped("Relative to a white Lambertian target at normal incidence; thin line: Lambert's cosine law");
}

std::string reading(const ExpectedReturn& expected) {
  if (expected.fate != ReturnFate::returned) return tr(fateName(expected.fate));
  return figures("{:.2f}\n{:.1f} mm", expected.intensity, expected.sigma_m * 1000);
}

void drawReported(const Model& model, MaterialCardState& state, const PhysicalMaterial& m) {
  ui::heading(model, "Reported by scanners");
  auto& degrees = state.incidence_deg;
  ui::copyTable("reported", [&] {
    TableRows table = {{tr("Instrument"), "nm"}};
    for (const double range : kCardRanges_m) table[0].push_back(fmt::format("{:.0f} m", range));
    for (const auto& row : reportedOf(m, model.catalogue().instruments, degrees * kRadPerDeg)) {
      table.push_back({row.instrument, fmt::format("{:.0f}", row.wavelength_nm)});
      for (const auto& expected : row.at) table.back().push_back(reading(expected));
    }
    return table;
  });
  ImGui::AlignTextToFramePadding();
  ui::dimText("Incidence");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-FLT_MIN);
  ui::numberSlider("###incidence", degrees, 0, 80, {.kind = {.unit = "°", .least = 0, .most = 89}, .decimals = 0});
  if (!ImGui::BeginTable("reported", 1 + static_cast<int>(kCardRanges_m.size()), ImGuiTableFlags_RowBg)) return;
  ImGui::TableSetupColumn("###instrument", ImGuiTableColumnFlags_WidthStretch, 1.5F);
  for (const double range : kCardRanges_m)
    ImGui::TableSetupColumn(fmt::format("{:.0f} m", range).c_str(), ImGuiTableColumnFlags_WidthStretch, 1);
  ImGui::TableHeadersRow();
  for (const auto& row : reportedOf(m, model.catalogue().instruments, degrees * kRadPerDeg)) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(row.instrument.c_str());
    ui::dimText(fmt::format("{:.0f} nm", row.wavelength_nm));
    for (const auto& expected : row.at) {
      ImGui::TableNextColumn();
      if (expected.fate == ReturnFate::returned)
        ImGui::TextUnformatted(reading(expected).c_str());
      else
        ui::wrapped(reading(expected));
    }
  }
  ImGui::EndTable();
  ui::dimWrapped("Stored intensity, range noise (1 σ)");
}

void drawGaps(const Model& model, const PhysicalMaterial& m) {
  const auto gaps = gapsOf(m);
  if (gaps.empty()) return;
  ui::heading(model, "Unknown");
  for (const auto& gap : gaps) ui::dimWrapped(shownSentence(gap));
}

void drawSources(const Model& model, const PhysicalMaterial& m) {
  ui::heading(model, "Sources");
  for (const auto& source : m.sources) {
    const bool unsourced = source.text.starts_with("unsourced");
    ImGui::TextColored(colour(unsourced ? tone::kWarning : tone::kGood), "%s", unsourced ? ICON_WARNING : ICON_CHECK);
    ImGui::SameLine();
    ui::wrapped(
        fmt::format("{}: {}{}", source.figure, source.text, source.licence.empty() ? "" : " (" + source.licence + ")"));
  }
}

// The one that is chosen in the list, else that of what is selected.
const PhysicalMaterial* shownMaterial(const Model& model) {
  const auto& choice = model.session.document().materials;
  if (!choice) return nullptr;
  const auto& assignment = choice->result.assignment;
  if (const auto* chosen = model.offeredMaterial(model.material.id)) return chosen;
  if (model.selection.empty()) return nullptr;
  for (const auto& s : assignment.surfaces)
    if (s.product == model.selection.primary() && s.material >= 0)
      return &assignment.materials[static_cast<std::size_t>(s.material)];
  return nullptr;
}

void drawNothing(const Model& model) {
  const auto& selected = model.selection.products();
  if (selected.empty() || !model.environment() || model.selection.primary() >= model.environment()->products.size())
    return ui::emptyState(
        model, ICON_PAINT, "No material selected",
        "Select a material in the list or a surface in the view to see its spectrum, angular response and "
        "scanner readings.");
  const auto what = selected.size() == 1
                        ? productLabel(model.environment()->products[selected.front()])
                        : trn("{} product", "{} products", selected.size(), groupedDigits(selected.size()));
  ui::emptyState(model, ICON_PAINT, "No material yet",
                 trf("{}: no physical material is assigned. Assign materials by rules, or choose one in the "
                     "Inspector.",
                     what)
                     .c_str());
}

void draw(const Model& model, MaterialCardState& state, Actions& actions) {
  if (state.edit) return drawMaterialForm(model, state, actions);
  const auto* material = shownMaterial(model);
  if (material == nullptr) return drawNothing(model);
  ImGui::BeginChild("card");
  if (model.fonts.bold != nullptr) ImGui::PushFont(model.fonts.bold);
  ui::wrapped(tr(material->label));
  if (model.fonts.bold != nullptr) ImGui::PopFont();
  ui::dimText(material->id);
  if (ui::button(ICON_PENCIL "  Copy and edit###edit-material")) state.edit = editOf(*material);
  drawSpectrum(model, actions, *material);
  drawAngles(model, *material);
  drawReported(model, state, *material);
  drawGaps(model, *material);
  drawSources(model, *material);
  ImGui::EndChild();
}

}  // namespace

void drawMaterialCardPanel(const Model& model, PanelStates& states, Actions& actions) {
  draw(model, states.of<MaterialCardState>(), actions);
}

}  // namespace standpoint
