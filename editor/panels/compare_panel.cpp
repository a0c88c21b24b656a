// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>
#include <imgui.h>

#include "editor/panels/actions.h"
#include "editor/panels/panel.h"
#include "editor/widgets/drop_down.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/widgets.h"
#include "editor/words/words.h"
#include "project/verbs/file_verbs.h"

namespace standpoint {

namespace {

constexpr const char *kCompare = ICON_COMPRESS "  Compare###compare-clouds", *kClean = ICON_DROP "  Clean A…###clean-a";

constexpr float kResult_pt = 300;  // of the panel: all figures and the first materials are in sight

struct ComparedPart {
  std::filesystem::path file;
  std::string scan;  // "": all of the file
  bool operator==(const ComparedPart&) const = default;
};

struct CompareState {
  ComparedPart a, b;
  ComparedPart shown_a, shown_b;                    // of the answer that is shown
  std::shared_ptr<const CloudDistances> looked_at;  // of it, in the view
};

// Of a file that holds the scans of several stations, that of one.
ComparedPart partOf(const std::vector<InspectedCloud>& clouds, const InspectedCloud& cloud) {
  const auto shares = [&](const InspectedCloud& other) { return other.file == cloud.file && other.scan != cloud.scan; };
  return {cloud.file, std::any_of(clouds.begin(), clouds.end(), shares) ? cloud.scan : std::string()};
}

std::string nameOf(const std::vector<InspectedCloud>& clouds, const ComparedPart& part) {
  for (const auto& cloud : clouds)
    if (partOf(clouds, cloud) == part) return cloud.label;
  return part.file.empty() ? tr("Choose a cloud") : part.file.filename().string();
}

// One of the project's clouds, or any file.
void chooseCloud(float width, Actions& actions, const char* id, const std::vector<InspectedCloud>& clouds,
                 ComparedPart& part, PanelStates& states, bool is_a) {
  ImGui::SetNextItemWidth(width);
  const auto name = nameOf(clouds, part);
  const float room = width - ImGui::GetFrameHeight() - 2 * ImGui::GetStyle().FramePadding.x;  // beside its arrow
  const bool open = ui::beginDropDown(id, ui::fittingMiddle(name, room).c_str());
  if (!open) {
    ui::tooltip(name);
    return;
  }
  for (std::size_t i = 0; i < clouds.size(); ++i)
    if (const auto offered = partOf(clouds, clouds[i]);
        ui::choice((clouds[i].label + "###" + id + std::to_string(i)).c_str(), part == offered))
      part = offered;
  ImGui::Separator();
  if (ui::choice(ui::Label("Another file…")))
    actions.askForFile(FileDialogState::Purpose::openFile, "Choose a point cloud", "Choose",
                       {".e57", ".las", ".laz", ".ply", ".pcd", ".ptx", ".pts", ".xyz"}, "",
                       [&states, is_a](Actions&, const std::filesystem::path& chosen) {
                         auto& state = states.of<CompareState>();
                         (is_a ? state.a : state.b) = {chosen, {}};
                       });
  ui::endDropDown();
}

std::string whyNotCompare(const Model& model, const CompareState& state) {
  if (state.a.file.empty() || state.b.file.empty()) return "Choose two clouds";
  if (state.a == state.b) return "Choose two different clouds";
  return model.session.whyNot("compare");
}

struct Row {
  std::string name, unit;
  double a = 0, b = 0;
  int decimals = 2;
};

std::vector<Row> rowsOf(const CompareAnswer& answer) {
  constexpr double kMm = 1000;
  const auto &a = answer.a, &b = answer.b;
  return {{tr("Points"), tr("million"), static_cast<double>(a.points) / 1e6, static_cast<double>(b.points) / 1e6, 3},
          {tr("Covered by the other"), "%", answer.a_covered_by_b * 100, answer.b_covered_by_a * 100, 1},
          {tr("Distance to the other cloud, median"), "mm", answer.a_from_b_m.median * kMm,
           answer.b_from_a_m.median * kMm, 2},
          {tr("Distance to the other cloud, 95 %"), "mm", answer.a_from_b_m.p95 * kMm, answer.b_from_a_m.p95 * kMm, 2},
          {tr("Noise on planes, median"), "mm", a.plane_noise_m.median * kMm, b.plane_noise_m.median * kMm, 3},
          {tr("Noise on planes, 95 %"), "mm", a.plane_noise_m.p95 * kMm, b.plane_noise_m.p95 * kMm, 3},
          {tr("Roughness (r 0.05 m), median"), "mm", a.roughness_m.median * kMm, b.roughness_m.median * kMm, 3},
          {tr("Roughness (r 0.05 m), 95 %"), "mm", a.roughness_m.p95 * kMm, b.roughness_m.p95 * kMm, 3},
          {tr("Intensity, mean"), "", a.intensity.mean, b.intensity.mean, 4},
          {tr("Intensity, sigma"), "", a.intensity.sigma, b.intensity.sigma, 4},
          {tr("Cells of 5 cm with points"), tr("thousand"), static_cast<double>(a.occupied_cells) / 1e3,
           static_cast<double>(b.occupied_cells) / 1e3, 1}};
}

std::string number(double value, int decimals) { return figures("{:.{}f}", value, decimals); }

std::string changeText(const Row& row) {
  constexpr double kManyTimes = 10;
  if (row.unit == "%") return trf("{} pp", figures("{:+.{}f}", row.b - row.a, row.decimals));  // percentage points
  if (row.a == 0) return figures("{:+.{}f}", row.b - row.a, row.decimals);
  if (row.b / row.a >= kManyTimes) return figures("× {:.1f}", row.b / row.a);
  return figures("{:+.1f} %", (row.b / row.a - 1) * 100);
}

TableRows tableOf(const std::vector<Row>& rows, const std::string& a, const std::string& b) {
  TableRows table = {{tr("Figure"), tr("Unit"), "A: " + a, "B: " + b, tr("B against A")}};
  for (const auto& row : rows)
    table.push_back({row.name, row.unit, number(row.a, row.decimals), number(row.b, row.decimals), changeText(row)});
  return table;
}

// Both as bars, to the longer of them.
void drawBars(const Model& model, const Row& row) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = ImGui::GetTextLineHeight();
  const double most = std::max({std::abs(row.a), std::abs(row.b), 1e-12});
  auto& list = *ImGui::GetWindowDrawList();
  const auto bar = [&](double value, float from, ImU32 tone) {
    list.AddRectFilled({at.x, at.y + height * from},
                       {at.x + std::max(model.px(1), width * static_cast<float>(std::abs(value) / most)),
                        at.y + height * (from + 0.4F)},
                       tone, model.px(1));
  };
  bar(row.a, 0.08F, IM_COL32(86, 180, 233, 255));
  bar(row.b, 0.54F, IM_COL32(230, 159, 0, 255));
  ImGui::Dummy({width, height});
}

void drawRow(const Model& model, const Row& row) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ui::fittedMiddle(row.unit.empty() ? row.name : row.name + ", " + row.unit, ImGui::GetContentRegionAvail().x);
  for (const auto& text : {number(row.a, row.decimals), number(row.b, row.decimals), changeText(row)}) {
    ImGui::TableNextColumn();
    ui::textRightAligned(text);
  }
  ImGui::TableNextColumn();
  drawBars(model, row);
}

void drawTable(const Model& model, const std::vector<Row>& rows, const char* id) {
  if (!ImGui::BeginTable(id, 5, ImGuiTableFlags_RowBg | ImGuiTableFlags_PadOuterX)) return;
  ImGui::TableSetupColumn(ui::Label("Figure"), ImGuiTableColumnFlags_WidthStretch, 3.2F);
  ImGui::TableSetupColumn("A", ImGuiTableColumnFlags_WidthStretch, 0.8F);
  ImGui::TableSetupColumn("B", ImGuiTableColumnFlags_WidthStretch, 0.8F);
  ImGui::TableSetupColumn(ui::Label("B against A"), ImGuiTableColumnFlags_WidthStretch, 0.9F);
  ImGui::TableSetupColumn(ui::Label("A blue, B orange"), ImGuiTableColumnFlags_WidthStretch, 1.2F);
  ui::tableHead({1, 2, 3});
  for (const auto& row : rows) drawRow(model, row);
  ImGui::EndTable();
}

// Those that both have.
std::vector<Row> materialRows(const Model& model, const CompareAnswer& answer) {
  const auto name = [&](const std::string& id) {
    const auto* material = model.offeredMaterial(id);
    return material != nullptr ? tr(material->label) : id;
  };
  std::vector<Row> rows;
  for (const auto& a : answer.a.materials)
    for (const auto& b : answer.b.materials)
      if (a.material == b.material) rows.push_back({name(a.material), "", a.mean, b.mean, 4});
  return rows;
}

constexpr const char *kOfA = "A by distance to B", *kOfB = "B by distance to A";

void lookAt(const Model& model, CompareState& state, Actions& actions, const CompareAnswer& answer, bool of_b,
            const std::vector<InspectedCloud>& clouds) {
  const auto& part = of_b ? state.shown_b : state.shown_a;
  const auto& distances = of_b ? answer.b_distances : answer.a_distances;
  Pose local_from_cloud;
  local_from_cloud.translation = -model.shift_m();
  if (const auto* cloud = cloudOf(clouds, part.file)) local_from_cloud = cloud->local_from_cloud;
  actions.showDifference(*distances, local_from_cloud, of_b ? kOfB : kOfA);
  state.looked_at = distances;
}

// Whose points are in the view.
bool isOfB(const CompareState& state, const CompareAnswer& answer) { return state.looked_at == answer.b_distances; }

// Of the cubic metre with the most of it, which is no largest distance of a point.
void goToLargest(const CompareState& state, const CompareAnswer& answer, const Model& model, Actions& actions,
                 const std::vector<InspectedCloud>& clouds) {
  const bool of_b = isOfB(state, answer);
  const auto& largest = *(of_b ? answer.b_largest : answer.a_largest);
  Eigen::Vector3d at = largest.at_m - model.shift_m();
  if (const auto* cloud = cloudOf(clouds, (of_b ? state.shown_b : state.shown_a).file))
    at = cloud->local_from_cloud * largest.at_m;
  const double d = largest.distance_m;
  const auto far = d < 1 ? figures("{:.0f} mm", d * 1000) : figures("{:.1f} m", d);
  actions.showWorstPlace({at,
                          trf("{} points of {} in one cubic metre, on average {} from {}",
                              groupedDigits(largest.points), of_b ? "B" : "A", far, of_b ? "A" : "B"),
                          {},
                          true});
}

// Where they differ, in the view: at once when they have been compared.
void drawDifferences(const Model& model, CompareState& state, Actions& actions, const CompareAnswer& answer,
                     const std::vector<InspectedCloud>& clouds) {
  const auto &of_a = answer.a_distances, &of_b = answer.b_distances;
  if (!of_a || !of_b || of_a->distance_m.empty()) return;
  const bool shown = state.looked_at == of_a || state.looked_at == of_b;
  // First the one that has more to show: the points of A may all be near B, and not the other way round.
  const auto most_m = [](const auto& largest) { return largest ? largest->distance_m : 0; };
  if (!shown) lookAt(model, state, actions, answer, most_m(answer.b_largest) > most_m(answer.a_largest), clouds);
  const auto* legend = model.pointLegend();
  const auto choice = [&](bool b, const std::string& label, const char* tooltip) {
    const bool lit = legend != nullptr && legend->title == (b ? kOfB : kOfA);
    ImGui::PushStyleColor(ImGuiCol_Button, lit ? ui::kLit : ImGui::GetStyleColorVec4(ImGuiCol_Button));
    if (ui::button(label.c_str(), {}, {0, 0}, tooltip)) lookAt(model, state, actions, answer, b, clouds);
    ImGui::PopStyleColor();
    ImGui::SameLine();
  };
  choice(false, std::string(ICON_EYE "  ") + tr(kOfA) + "###difference-a", "Shows the points of A in the view");
  choice(true, std::string(ICON_EYE "  ") + tr(kOfB) + "###difference-b", "Shows the points of B in the view");
  const bool in_b = isOfB(state, answer);
  const bool any = (in_b ? answer.b_largest : answer.a_largest).has_value();
  const auto most = trf("The cubic metre where the points of {} are farthest from {}, taken together", in_b ? "B" : "A",
                        in_b ? "A" : "B");
  if (ui::button(ICON_CROSSHAIRS "  Fly to where they differ most###most-difference",
                 any ? "" : "The clouds do not differ", {0, 0}, most.c_str()))
    goToLargest(state, answer, model, actions, clouds);
}

void drawAnswer(const Model& model, CompareState& state, Actions& actions, const CompareAnswer& answer,
                const std::vector<InspectedCloud>& clouds) {
  const auto a = nameOf(clouds, state.shown_a), b = nameOf(clouds, state.shown_b);
  auto rows = rowsOf(answer);
  const auto materials = materialRows(model, answer);
  if (ui::iconButton(ICON_COPY "###copy-compare", "Copy table")) {
    rows.insert(rows.end(), materials.begin(), materials.end());
    ImGui::SetClipboardText(rowsText(tableOf(rows, a, b)).c_str());
    rows.resize(rows.size() - materials.size());
  }
  ImGui::SameLine();
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  ui::fitted(fmt::format("A  {}     B  {}", a, b), ImGui::GetContentRegionAvail().x);
  ImGui::PopStyleColor();
  drawDifferences(model, state, actions, answer, clouds);
  if (!ImGui::BeginChild("###compare-tables")) return ImGui::EndChild();
  drawTable(model, rows, "compare-figures");
  if (!materials.empty()) {
    ui::heading(model, "Mean intensity by material");
    drawTable(model, materials, "compare-materials");
  }
  ImGui::EndChild();
}

// Filters one cloud into a file beside it, to be compared with what it was.
void drawClean(const Model& model, CompareState& state, Actions& actions) {
  if (!ui::button(kClean, state.a.file.empty() ? "Choose cloud A first" : model.session.whyNot("clean"), {0, 0},
                  "Filter cloud A into a file beside it, which becomes cloud B: before and after"))
    return;
  const auto& file = state.a.file;
  const auto out = file.parent_path() / (file.stem().string() + "-cleaned" + file.extension().string());
  CleanOptions options;
  options.in = file;
  options.output = out;
  state.b = {out, state.a.scan};
  actions.openForm(options);
}

// As long as none is chosen: the first, and the first that is of another station.
void chooseFirstTwo(const std::vector<InspectedCloud>& clouds, CompareState& state) {
  if (!state.a.file.empty() || !state.b.file.empty()) return;
  for (const auto& cloud : clouds) {
    const auto& first = clouds.front();
    if (cloud.station == first.station && cloud.underlay == first.underlay) continue;
    state.a = partOf(clouds, first), state.b = partOf(clouds, cloud);
    return;
  }
}

void drawComparison(const Model& model, PanelStates& states, Actions& actions) {
  auto& state = states.of<CompareState>();
  const auto clouds = inspectedClouds(model.session.document());
  chooseFirstTwo(clouds, state);
  // Half of what the two letters and the gaps leave, and the two buttons where whole names have room beside them.
  const auto& style = ImGui::GetStyle();
  const float letters = ImGui::CalcTextSize("AB").x + 5 * style.ItemSpacing.x;
  float buttons = 0;
  for (const ui::Label& button : {ui::Label(kCompare), ui::Label(kClean)})
    buttons += ImGui::CalcTextSize(button, nullptr, true).x + 2 * style.FramePadding.x;
  const float room = ImGui::GetContentRegionAvail().x - letters;
  const bool one_row = (room - buttons) / 2 >= model.px(240);
  const float width = std::clamp((one_row ? room - buttons : room) / 2, model.px(80), model.px(320));
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("A");
  ImGui::SameLine();
  chooseCloud(width, actions, "###compare-a", clouds, state.a, states, true);
  ImGui::SameLine();
  ImGui::TextUnformatted("B");
  ImGui::SameLine();
  chooseCloud(width, actions, "###compare-b", clouds, state.b, states, false);
  if (one_row) ImGui::SameLine();
  if (ui::primaryButton(kCompare, whyNotCompare(model, state)) &&
      actions.start(CompareOptions{state.a.file, state.b.file, state.a.scan, state.b.scan}, "Compare two clouds")) {
    state.shown_a = state.a, state.shown_b = state.b;
    actions.growBottom(kResult_pt);
  }
  ImGui::SameLine();
  drawClean(model, state, actions);
  const auto* answer = model.session.lastAnswer<CompareAnswer>("compare");
  if (answer != nullptr)
    drawAnswer(model, state, actions, *answer, clouds);
  else
    ui::dimWrapped(
        "Two scans, a scan and a measured cloud, or a cloud before and after filtering: coverage, noise on "
        "planes, roughness and intensity side by side.");
}

}  // namespace

void drawComparePanel(const Model& model, PanelStates& states, Actions& actions) {
  drawComparison(model, states, actions);
}

}  // namespace standpoint
