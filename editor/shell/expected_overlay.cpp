// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/shell/expected_overlay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "core/units.h"
#include "editor/shell/editor.h"
#include "editor/shell/overlay.h"
#include "editor/widgets/drop_down.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/widgets.h"
#include "editor/words/words.h"

namespace standpoint {

namespace {

constexpr float kGrip_pt = 11;  // how near the pointer must be to take the probe
constexpr double kFloor = 0.7;  // upward part of a normal that can be stood on

// At the chosen station, else the first, else above the floor in the middle of what is looked at.
void placeProbe(Editor& editor) {
  auto& probe = editor.view.probe;
  const auto& job = editor.session.document().job;
  if (job && !job->stations.empty()) {
    const auto chosen = static_cast<std::size_t>(std::max(0, editor.survey.station));
    const auto& station = job->stations[std::min(chosen, job->stations.size() - 1)];
    probe.position = station.true_pose.translation;
    probe.height_m = station.instrument_height_m;
    return;
  }
  const Bounds all = editor.buildingBounds();
  const Eigen::Vector3d middle = (all.min + all.max) / 2;
  const auto scene = editor.picker.scene();
  const auto below = scene->intersect({middle.x(), middle.y(), std::min(middle.z(), all.min.z() + 2.0)},
                                      -Eigen::Vector3d::UnitZ(), 1e4);
  putProbeOn(editor, below ? below->position : Eigen::Vector3d(middle.x(), middle.y(), all.min.z()));
}

std::optional<ImVec2> onScreen(const Editor& editor, ImVec2 origin) {
  if (!editor.view.probe.position) return std::nullopt;
  const auto pixel = project(editor.view.camera, *editor.view.probe.position, editor.view.size);
  if (!pixel) return std::nullopt;
  return ImVec2(origin.x + static_cast<float>(pixel->x()), origin.y + static_cast<float>(pixel->y()));
}

// On the floor under the pointer, else where it is at the height of the floor that it stands on.
void follow(Editor& editor, ImVec2 origin) {
  auto& probe = editor.view.probe;
  const ImVec2 p = ImGui::GetIO().MousePos;
  const auto ray = rayThrough(editor.view.camera, {p.x - origin.x, p.y - origin.y}, editor.view.size);
  const auto hit = editor.picker.pick(ray, editor.viewState());
  if (hit && hit->normal.z() > kFloor) return putProbeOn(editor, hit->position);
  const double height = probe.position->z() - probe.height_m;
  const double travel = (height - ray.origin.z()) / ray.direction.z();
  if (std::isfinite(travel) && travel > 0 && travel < 1e4) putProbeOn(editor, ray.origin + travel * ray.direction);
}

void drawProbe(const Editor& editor, ImVec2 origin) {
  const auto at = onScreen(editor, origin);
  if (!at) return;
  auto& list = *ImGui::GetWindowDrawList();
  const auto& probe = editor.view.probe;
  const Eigen::Vector3d floor = *probe.position - Eigen::Vector3d(0, 0, probe.height_m);
  if (const auto foot = project(editor.view.camera, floor, editor.view.size))
    list.AddLine(*at, {origin.x + static_cast<float>(foot->x()), origin.y + static_cast<float>(foot->y())},
                 IM_COL32(255, 255, 255, 170), editor.px(2));
  list.AddCircleFilled(*at, editor.px(kGrip_pt - 3), IM_COL32(255, 255, 255, 235));
  list.AddCircleFilled(*at, editor.px(kGrip_pt - 6), tone::kAccent);
}

struct Legend {
  ImVec2 at;
  float width;
};

void drawScale(Editor& editor, const Legend& legend, ExpectedQuantity quantity, const Instrument& instrument) {
  auto& list = *ImGui::GetWindowDrawList();
  constexpr int kParts = 48;
  const float height = editor.px(8);
  for (int i = 0; i < kParts; ++i)
    list.AddRectFilled({legend.at.x + legend.width * static_cast<float>(i) / kParts, legend.at.y},
                       {legend.at.x + legend.width * static_cast<float>(i + 1) / kParts, legend.at.y + height},
                       packed(scaleColour(quantity, (i + 0.5) / kParts)));
  const auto text = [&](float x, const std::string& words) {
    list.AddText({x, legend.at.y + height + editor.px(2)}, tone::kText, words.c_str());
  };
  const bool noise = quantity == ExpectedQuantity::noise;
  const auto most = noise ? trf("{:.0f} mm or more", kNoiseFullScale_m * 1000)
                          : fmt::format("1 ({:.0f} dB)", instrument.intensity_high_db);
  text(legend.at.x, noise ? "0" : fmt::format("0 ({:.0f} dB)", instrument.intensity_low_db));
  text(legend.at.x + legend.width - ImGui::CalcTextSize(most.c_str()).x, most);
  const char* title = noise ? "Expected range noise (1 σ)" : "Expected intensity";
  list.AddText({legend.at.x, legend.at.y - ImGui::GetTextLineHeight() - editor.px(2)}, tone::kText, tr(title).c_str());
}

// The swatches with their names, in as many rows as a width needs.
struct FateRows {
  struct Entry {
    ReturnFate fate;
    ImVec2 at;  // from the upper left
  };
  std::vector<Entry> entries;
  float width = 0, height = 0;
};

FateRows fateRows(const Editor& editor, float most_width, bool with_returned) {
  FateRows rows;
  ImVec2 at(0, 0);
  for (const auto fate : {ReturnFate::returned, ReturnFate::too_weak, ReturnFate::seen_through, ReturnFate::hidden,
                          ReturnFate::too_near, ReturnFate::too_far}) {
    if (fate == ReturnFate::returned && !with_returned) continue;
    const float width = editor.px(15) + ImGui::CalcTextSize(tr(fateName(fate)).c_str()).x;
    if (at.x > 0 && at.x + width > most_width) at = {0, at.y + ImGui::GetTextLineHeight() + editor.px(3)};
    rows.entries.push_back({fate, at});
    rows.width = std::max(rows.width, at.x + width);
    at.x += width + editor.px(14);
  }
  rows.height = at.y + ImGui::GetTextLineHeight();
  return rows;
}

void drawFates(const Editor& editor, ImVec2 corner, const FateRows& rows) {
  auto& list = *ImGui::GetWindowDrawList();
  const float swatch = editor.px(10);
  for (const auto& [fate, from] : rows.entries) {
    const ImVec2 at(corner.x + from.x, corner.y + from.y);
    list.AddRectFilled({at.x, at.y + editor.px(2)}, {at.x + swatch, at.y + editor.px(2) + swatch},
                       packed(fateColour(fate)));
    list.AddText({at.x + swatch + editor.px(5), at.y}, tone::kText, tr(fateName(fate)).c_str());
  }
}

void drawReading(Editor& editor, const Expectation& expectation) {
  const auto& hit = editor.view.hover;
  if (!hit || editor.view.probe.dragged || editor.view.dragging) return;
  const auto expected =
      expectation.from(*editor.view.probe.position, {hit->position, hit->normal, hit->instance, hit->triangle});
  const auto& choice = editor.session.document().materials;
  const std::int32_t material = choice ? expectation.materialAt(hit->instance, hit->triangle) : -1;
  auto text = trf("{}\n{:.2f} m, {:.0f}° incidence",
                  material < 0 ? tr("No material")
                               : tr(choice->result.assignment.materials[static_cast<std::size_t>(material)].label),
                  expected.range_m, expected.incidence_rad / kRadPerDeg);
  if (expected.fate == ReturnFate::returned)
    text += "\n" + trf("intensity {:.3f}, σ {:.2f} mm, {:.0f} % detected", expected.intensity, expected.sigma_m * 1000,
                       expected.probability * 100);
  else
    text += fmt::format("\n{}", tr(fateName(expected.fate)));
  ImGui::SetTooltip("%s", text.c_str());
}

}  // namespace

std::optional<ExpectedQuantity> expectedQuantity(ColourMode mode) {
  switch (mode) {
    case ColourMode::expected_intensity: return ExpectedQuantity::intensity;
    case ColourMode::expected_noise: return ExpectedQuantity::noise;
    case ColourMode::expected_fate: return ExpectedQuantity::fate;
    default: return std::nullopt;
  }
}

void putProbeOn(Editor& editor, const Eigen::Vector3d& floor) {
  editor.view.probe.position = floor + Eigen::Vector3d(0, 0, editor.view.probe.height_m);
}

bool dragProbe(Editor& editor, ImVec2 origin, bool hovered) {
  auto& probe = editor.view.probe;
  if (!expectedQuantity(editor.view.colour) || editor.view.tool != Tool::select) return probe.dragged = false;
  const auto at = onScreen(editor, origin);
  const ImVec2 p = ImGui::GetIO().MousePos;
  const bool near = hovered && at && std::hypot(p.x - at->x, p.y - at->y) < editor.px(kGrip_pt);
  if (near && ImGui::IsMouseClicked(0)) {
    probe.dragged = true;
    probe.dragged_from = probe.position;
  }
  if (!ImGui::IsMouseDown(0)) probe.dragged = false;
  if (near || probe.dragged) ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
  if (probe.dragged && ImGui::IsMouseDragging(0, 0)) follow(editor, origin);
  return near || probe.dragged;
}

void drawRequested(Editor& editor, ExpectedRequest request, ImVec2 origin, ImVec2 size) {
  request.scene = editor.picker.scene();
  request.view.camera = editor.view.camera;  // what rays depend on, no more
  request.view.hidden = editor.visibility.shared();
  request.view.cut_height_m = editor.visibility.cut_height_m;
  request.view.edges = editor.view.edges;
  request.width = static_cast<int>(size.x);
  request.height = static_cast<int>(size.y);
  editor.expected.want(request);
  const auto picture = editor.expected.picture(editor.view.camera);
  const std::uint64_t texture = editor.scene != nullptr && picture ? editor.scene->texture(picture) : 0;
  if (texture != 0)
    ImGui::GetWindowDrawList()->AddImage(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(texture)), origin,
                                         {origin.x + size.x, origin.y + size.y});
}

void drawExpected(Editor& editor, ImVec2 origin, ImVec2 size) {
  const auto quantity = expectedQuantity(editor.view.colour);
  const auto expectation = quantity && !editor.cloud() ? editor.expectation() : nullptr;
  if (!expectation) return;
  if (!editor.view.probe.position) placeProbe(editor);
  ExpectedRequest request;
  request.expectation = expectation;
  request.station = *editor.view.probe.position;
  request.quantity = *quantity;
  drawRequested(editor, std::move(request), origin, size);
}

void drawExpectedLegend(Editor& editor, ImVec2 origin, ImVec2 size) {
  const auto quantity = expectedQuantity(editor.view.colour);
  if (!quantity) return;
  const auto expectation = editor.expectation();
  if (!expectation || !editor.view.probe.position) {
    ImGui::GetWindowDrawList()->AddText({origin.x + editor.px(10), origin.y + size.y - editor.px(24)}, tone::kDim,
                                        tr("Preparing the model for ray tracing …").c_str());
    return;
  }
  drawProbe(editor, origin);
  const bool fates_only = *quantity == ExpectedQuantity::fate;
  const float line = ImGui::GetTextLineHeight(), x = origin.x + editor.px(10);
  const auto rows = fateRows(editor, size.x - editor.px(20), fates_only);
  const float bottom = origin.y + size.y - editor.px(8) - rows.height;
  const float top = bottom - editor.px(4) - (fates_only ? 0 : 2 * line + editor.px(18));
  const float wide =
      std::min(std::max(rows.width + editor.px(6), editor.px(fates_only ? 530 : 430)), size.x - editor.px(14));
  ImGui::GetWindowDrawList()->AddRectFilled({x - editor.px(6), top}, {x + wide, origin.y + size.y - editor.px(4)},
                                            tone::kOverlay, editor.px(4));
  drawFates(editor, {x, bottom}, rows);
  if (!fates_only)
    drawScale(editor, {{x, bottom - line - editor.px(18)}, editor.px(220)}, *quantity, expectation->law().instrument());
  if (ImGui::IsItemHovered()) drawReading(editor, *expectation);
}

void expectedChips(Editor& editor) {
  if (!expectedQuantity(editor.view.colour)) return;
  auto& probe = editor.view.probe;
  const auto* instrument = editor.instrument(probe.instrument);
  nextRow();
  const auto label = fmt::format("{}  {}", ICON_TABLET, instrument != nullptr ? instrument->model : tr("Instrument"));
  ImGui::SetNextItemWidth(chipWidth(editor, label, 166));
  if (ui::beginDropDown("###probe-instrument", label.c_str(), ImGuiComboFlags_NoArrowButton)) {
    for (const auto& i : editor.catalogue().instruments)
      if (ui::choice(fmt::format("{} {}, {:.0f} nm###{}", i.maker, i.model, i.wavelength_nm, i.id).c_str(),
                     i.id == probe.instrument))
        probe.instrument = i.id;
    ui::endDropDown();
  }
  ImGui::SameLine();
  if (ImGui::GetCursorScreenPos().x + editor.px(128) > overlayEnd(editor)) ImGui::NewLine();
  const auto& job = editor.session.document().job;
  if (!job || job->stations.empty()) {
    const ui::Text hint("Drag the white dot to move the scanner");
    if (ImGui::GetCursorScreenPos().x + ImGui::CalcTextSize(hint.c_str()).x > overlayEnd(editor)) ImGui::NewLine();
    return ImGui::TextUnformatted(hint.c_str());
  }
  ImGui::SetNextItemWidth(editor.px(128));
  const auto standing = std::find_if(job->stations.begin(), job->stations.end(),
                                     [&](const Station& s) { return probe.position == s.true_pose.translation; });
  if (!ui::beginDropDown(
          "###probe-place",
          fmt::format("{}  {}", ICON_STATION, standing != job->stations.end() ? standing->name : tr("Drag the dot"))
              .c_str(),
          ImGuiComboFlags_NoArrowButton))
    return;
  for (const auto& s : job->stations)
    if (ui::choice(s.name.c_str())) {
      probe.position = s.true_pose.translation;
      probe.height_m = s.instrument_height_m;
    }
  ui::endDropDown();
}

}  // namespace standpoint
