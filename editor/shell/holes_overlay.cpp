// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/shell/holes_overlay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "editor/colours/colour_scale.h"
#include "editor/model/coverage_view.h"
#include "editor/model/shown_holes.h"
#include "editor/shell/editor.h"
#include "editor/shell/overlay.h"
#include "editor/shell/view_pen.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/widgets.h"
#include "survey/trajectories/path_coverage.h"

namespace standpoint {

namespace {

constexpr ImU32 kHatch = IM_COL32(255, 255, 255, 170), kDark = IM_COL32(20, 12, 18, 200);
constexpr double kEdgeOn = 0.12;  // sine of the angle under which a surface is but a line
constexpr float kBar_pt = 5, kRim_pt = 1.5F, kHatch_pt = 1;

// Why a trajectory leaves a surface blind.
struct BlindReason {
  std::string name;  // of the verb's answer
  Rgba8 colour{};
  const char* words = "";
};
const std::array<BlindReason, kBlindnesses - 1>& blindReasons() {
  static const auto reasons = [] {
    std::array<BlindReason, kBlindnesses - 1> all;
    for (std::size_t k = 0; k < all.size(); ++k) {
      const auto blind = static_cast<Blindness>(k + 1);
      all[k] = {nameOf(blind), blind == Blindness::unreachable ? kOtherColour : classColour(k), wordsOf(blind)};
    }
    return all;
  }();
  return reasons;
}
const BlindReason* reasonOf(const PlanPatch& patch) {
  const auto& all = blindReasons();
  const auto found = std::find_if(all.begin(), all.end(), [&](const BlindReason& r) { return r.name == patch.reason; });
  return found == all.end() ? nullptr : &*found;
}

// What no station sees has the colour of what is not covered in the maps, too; hatched, it is read without colours.
struct HoleTone {
  ImU32 rim, fill;
};
HoleTone toneOf(const Rgba8& c) { return {IM_COL32(c[0], c[1], c[2], 255), IM_COL32(c[0], c[1], c[2], 70)}; }
HoleTone toneOf(const PlanPatch& patch) {
  const BlindReason* const reason = reasonOf(patch);
  return toneOf(reason == nullptr ? kHoleColour : reason->colour);
}

bool isEdgeOn(const HoleInSight& hole, const Camera& camera) {
  const Eigen::Vector3d way =
      camera.orthographic ? camera.forward() : Eigen::Vector3d((hole.middle - camera.eye()).normalized());
  return std::abs(hole.patch->shape.normal.dot(way)) < kEdgeOn;
}

// Those of which something is in the picture, largest first.
std::span<const HoleInSight> holesOf(Editor& editor, const ViewState& view) {
  if (!editor.view.holes || editor.cloud()) return {};
  const auto holes = shownHoles(editor);
  if (holes.patches == nullptr) return {};
  return editor.holes_in_sight.of(editor, *holes.patches, view);
}

// Dear ImGui has indices of 16 bits, unless what draws can begin anew: then the smallest holes are left out.
bool hasRoom(const ImDrawList& list, const HoleInSight& hole) {
  constexpr unsigned int kMost = 55000, kOfOne = 8;
  if ((ImGui::GetIO().BackendFlags & ImGuiBackendFlags_RendererHasVtxOffset) != 0) return true;
  return list._VtxCurrentIdx + kOfOne * (hole.fill.size() + hole.hatching.size() + 2 * hole.rim.size()) < kMost;
}

std::optional<std::array<ImVec2, 4>> onScreen(const ViewPen& pen, const std::array<Eigen::Vector3d, 4>& corners) {
  std::array<ImVec2, 4> places;
  for (std::size_t c = 0; c < corners.size(); ++c) {
    const auto p = pen.at(corners[c]);
    if (!p) return std::nullopt;
    places[c] = *p;
  }
  return places;
}

void drawHole(const ViewPen& pen, const HoleInSight& hole, bool edge_on, ImDrawList& list) {
  for (const auto& [a, b] : hole.rim)
    if (edge_on) pen.line(a, b, kDark, kBar_pt + 2);
  const HoleTone tone = toneOf(*hole.patch);
  for (const auto& [a, b] : hole.rim)
    if (edge_on) pen.line(a, b, tone.rim, kBar_pt);
  if (edge_on) return;
  const auto flags = list.Flags;
  list.Flags &= ~ImDrawListFlags_AntiAliasedFill;  // no seams between the rectangles
  for (const auto& corners : hole.fill)
    if (const auto p = onScreen(pen, corners)) list.AddQuadFilled((*p)[0], (*p)[1], (*p)[2], (*p)[3], tone.fill);
  list.Flags = flags;
  for (const auto& [a, b] : hole.hatching) pen.line(a, b, kHatch, kHatch_pt);
  for (const auto& [a, b] : hole.rim) pen.rod(a, b, tone.rim, kRim_pt);
}

bool isWithin(const std::array<ImVec2, 4>& quad, ImVec2 p) {
  int left = 0, right = 0;
  for (std::size_t i = 0; i < quad.size(); ++i) {
    const ImVec2 a = quad[i], b = quad[(i + 1) % quad.size()];
    const float turn = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
    left += turn > 0 ? 1 : 0, right += turn < 0 ? 1 : 0;
  }
  return left == 0 || right == 0;
}

float distanceTo(ImVec2 a, ImVec2 b, ImVec2 p) {
  const float dx = b.x - a.x, dy = b.y - a.y, length2 = dx * dx + dy * dy;
  const float t = length2 > 0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / length2, 0.0F, 1.0F) : 0.0F;
  return std::hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

bool isUnder(const ViewPen& pen, const HoleInSight& hole, bool edge_on, ImVec2 pointer, float bar_px) {
  if (edge_on)
    return std::any_of(hole.rim.begin(), hole.rim.end(), [&](const auto& side) {
      const auto a = pen.at(side[0]), b = pen.at(side[1]);
      return a && b && distanceTo(*a, *b, pointer) < bar_px;
    });
  return std::any_of(hole.fill.begin(), hole.fill.end(), [&](const auto& corners) {
    const auto p = onScreen(pen, corners);
    return p && isWithin(*p, pointer);
  });
}

std::string areaText(double area_m2) { return figures("{:.{}f} m²", area_m2, area_m2 < 10 ? 1 : 0); }

std::string aboutHole(const PlanPatch& hole) {
  auto text = trf("Not covered: {} of {}", areaText(hole.area_m2),
                  fmt::format("{} {}", tr(readableClass(hole.ifc_class)), hole.name.empty() ? hole.id : hole.name));
  if (const BlindReason* const reason = reasonOf(hole)) return text + "\n" + tr(reason->words);
  return text + "\n" +
         (hole.spacing_m ? trf("Point spacing on the rest of it: {:.1f} mm", *hole.spacing_m * 1000)
                         : tr("No station sees any of it"));
}

}  // namespace

void drawHoles(Editor& editor, const ViewState& view, ImVec2 origin) {
  const ViewPen pen(editor, origin);
  auto& list = *ImGui::GetWindowDrawList();
  for (const auto& hole : holesOf(editor, view))
    if (hasRoom(list, hole)) drawHole(pen, hole, isEdgeOn(hole, view.camera), list);
}

void nameHoles(Editor& editor, const ViewState& view, ImVec2 origin, LabelBoard& labels) {
  const ViewPen pen(editor, origin);
  std::size_t index = 0;
  for (const auto& hole : holesOf(editor, view)) {
    const LabelOf of{LabelKind::hole, index++};
    if (const auto p = pen.at(hole.middle)) labels.over(of, *p, {areaText(hole.patch->area_m2)}, tone::kText);
  }
}

namespace {

// Lines of the legend.
std::vector<std::pair<HoleTone, std::string>> legendOf(const ShownHoles& holes) {
  if (holes.of != ShownHoles::Of::trajectories)
    return {{toneOf(kHoleColour),
             tr(holes.of == ShownHoles::Of::scans ? "Not covered by the scans" : "Not covered as planned")}};
  std::vector<std::pair<HoleTone, std::string>> lines;
  for (const BlindReason& reason : blindReasons())
    if (std::any_of(holes.patches->begin(), holes.patches->end(),
                    [&](const auto& p) { return p.reason == reason.name; }))
      lines.emplace_back(toneOf(reason.colour), tr(reason.words));
  return lines;
}

void drawSwatch(Editor& editor, ImVec2 at, float side, const HoleTone& tone) {
  auto& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(at, {at.x + side, at.y + side}, tone.fill);
  for (const float share : {0.5F, 1.0F}) {
    list.AddLine({at.x, at.y + share * side}, {at.x + share * side, at.y}, kHatch, editor.px(kHatch_pt));
    list.AddLine({at.x + (1 - share) * side, at.y + side}, {at.x + side, at.y + (1 - share) * side}, kHatch,
                 editor.px(kHatch_pt));
  }
  list.AddRect(at, {at.x + side, at.y + side}, tone.rim, 0, 0, editor.px(kRim_pt));
}

}  // namespace

void drawHolesLegend(Editor& editor, ImVec2 origin, ImVec2 size, bool hovered) {
  if (!editor.view.holes || editor.cloud()) return;
  const auto holes = shownHoles(editor);
  if (holes.patches == nullptr || holes.patches->empty()) return;
  const auto lines = legendOf(holes);
  const float side = editor.px(16), gap = editor.px(6), line = std::max(side, ImGui::GetTextLineHeight());
  float wide = 0;
  for (const auto& [tone, text] : lines) wide = std::max(wide, side + gap + ImGui::CalcTextSize(text.c_str()).x);
  const float high = static_cast<float>(lines.size()) * (line + gap) - gap;
  // Above the legend of the colours where there is one.
  const bool plain = editor.view.colour == ColourMode::model || editor.view.colour == ColourMode::material;
  const float above = plain ? 0 : editor.px(64) + ImGui::GetTextLineHeight();
  ImVec2 at(origin.x + editor.px(10), origin.y + size.y - high - editor.px(10) - above);
  drawPlate(editor, at, {wide, high});
  for (const auto& [tone, text] : lines) {
    drawSwatch(editor, at, side, tone);
    ImGui::GetWindowDrawList()->AddText({at.x + side + gap, at.y + (line - ImGui::GetTextLineHeight()) / 2},
                                        tone::kText, text.c_str());
    at.y += line + gap;
  }
  if (!hovered || editor.view.dragging || editor.view.tool != Tool::select) return;
  const ViewPen pen(editor, origin);
  const auto view = editor.viewState();
  const PlanPatch* under = nullptr;  // the smallest, which lies on the others
  for (const auto& hole : holesOf(editor, view))
    if (isUnder(pen, hole, isEdgeOn(hole, view.camera), ImGui::GetIO().MousePos, editor.px(kBar_pt)))
      under = hole.patch;
  if (under != nullptr) ImGui::SetTooltip("%s", aboutHole(*under).c_str());
}

}  // namespace standpoint
