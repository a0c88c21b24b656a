// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <imgui.h>

#include "editor/model/stairs.h"
#include "editor/shell/editor.h"
#include "editor/shell/holes_overlay.h"
#include "editor/shell/label_board.h"
#include "editor/shell/live_overlay.h"
#include "editor/shell/overlay.h"
#include "editor/shell/trajectory_overlay.h"
#include "editor/widgets/drop_down.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/widgets.h"

namespace standpoint {

namespace {

constexpr float kHidden = 0.25F, kHiddenChosen = 0.7F;  // how strong a mark is that something hides

ImU32 faded(ImU32 packed, float alpha) {
  ImVec4 c = colour(packed);
  c.w *= alpha;
  return ImGui::ColorConvertFloat4ToU32(c);
}

class Pen {
 public:
  Pen(const Editor& editor, ImVec2 origin, LabelBoard& board)
      : labels(board), editor_(editor), origin_(origin), list_(*ImGui::GetWindowDrawList()) {}

  std::optional<ImVec2> at(const Eigen::Vector3d& p) const {
    const auto pixel = project(editor_.view.camera, p, editor_.view.size);
    if (!pixel) return std::nullopt;
    return ImVec2(origin_.x + static_cast<float>(pixel->x()), origin_.y + static_cast<float>(pixel->y()));
  }
  void line(const Eigen::Vector3d& a, const Eigen::Vector3d& b, ImU32 tone, float width) const {
    const auto from = at(a), to = at(b);
    if (from && to) list_.AddLine(*from, *to, tone, width * editor_.scale);
  }
  void circle(ImVec2 p, float radius, ImU32 fill, ImU32 rim) const {
    list_.AddCircleFilled(p, radius * editor_.scale, fill);
    list_.AddCircle(p, radius * editor_.scale, rim, 0, 1.5F * editor_.scale);
  }

  LabelBoard& labels;

 private:
  const Editor& editor_;
  ImVec2 origin_;
  ImDrawList& list_;
};

// Three legs from below the instrument to the floor, as wide as a real tripod.
void drawTripod(const Pen& pen, const Eigen::Vector3d& centre, double height_m, ImU32 tone, float width) {
  const Eigen::Vector3d head = centre - Eigen::Vector3d(0, 0, std::min(0.2, height_m * 0.3));
  for (int leg = 0; leg < 3; ++leg) {
    const double azimuth = leg * 2 * std::numbers::pi / 3 + 0.4;
    const Eigen::Vector3d foot =
        centre + Eigen::Vector3d(std::cos(azimuth) * 0.38 * height_m, std::sin(azimuth) * 0.38 * height_m, -height_m);
    pen.line(head, foot, tone, width);
  }
  pen.line(head, centre, tone, width + 1);
}

// As an instrument, and large enough to be seen as one.
bool isDrawnAsBody(const Editor& editor, const ViewState& state, const Station& station) {
  constexpr double kLeast_px = 30;
  const auto& centre = station.true_pose.translation;
  const auto& camera = editor.view.camera;
  const double depth_m = (centre - camera.eye()).dot(camera.forward());
  if (station.instrument_height_m / camera.metresPerPixel(depth_m, editor.view.size.y()) < kLeast_px) return false;
  const auto here = [&](const StandingInstrument& s) { return s.centre_m == centre; };
  if (state.working && here(state.working->stands)) return true;
  return state.instruments && std::any_of(state.instruments->still.begin(), state.instruments->still.end(), here);
}

// The model hides nothing where points are shown instead of it.
bool isInSight(const Editor& editor, const ViewState& state, const Eigen::Vector3d& place) {
  return state.cloud || editor.picker.isInSight(place, state);
}

void drawStations(Editor& editor, Pen& pen, const ViewState& state) {
  const auto& job = editor.session.document().job;
  if (!job) return;
  for (std::size_t i = 0; i < job->stations.size(); ++i) {
    const auto& station = job->stations[i];
    const Eigen::Vector3d centre = station.true_pose.translation;
    if ((centre - editor.view.camera.eye()).norm() < kInsideInstrument_m) continue;  // one looks out of it
    if (!keeps(state, centre, station.instrument_height_m)) continue;
    const auto place = pen.at(centre);
    if (!place) continue;
    const bool seen = isInSight(editor, state, centre);
    const bool chosen = editor.survey.station == static_cast<int>(i);
    const float strength = seen ? 1.0F : chosen ? kHiddenChosen : kHidden;
    const ImU32 tone = faded(chosen ? tone::kAccent : tone::kStation, strength);
    if (seen && isDrawnAsBody(editor, state, station)) {
      if (chosen) pen.circle(*place, 6, IM_COL32(20, 22, 26, 60), tone);
    } else {
      drawTripod(pen, centre, station.instrument_height_m, tone, seen ? 2.0F : 1.2F);
      pen.circle(*place, chosen ? 6 : 5, faded(IM_COL32(20, 22, 26, 255), strength), tone);
      if (!station.scans.empty()) pen.circle(*place, 2, tone, tone);
    }
    if (editor.view.labels && (seen || chosen || editor.view.labels_through_walls))
      pen.labels.over({LabelKind::station, i}, *place, {station.name}, tone::kText, chosen);
  }
}

void drawTargets(Editor& editor, Pen& pen, const ViewState& state) {
  const auto& job = editor.session.document().job;
  if (!job) return;
  for (std::size_t i = 0; i < job->targets.size(); ++i) {
    const auto& target = job->targets[i];
    const auto place = pen.at(target.centre);
    if (!place || !keeps(state, target.centre, kMarkAboveFloor_m)) continue;
    const bool seen = isInSight(editor, state, target.centre);
    const bool chosen = editor.survey.target == static_cast<int>(i);
    const ImU32 tone = faded(chosen ? tone::kAccent : tone::kGood, seen ? 1.0F : kHidden);
    pen.circle(*place, 5, faded(IM_COL32(245, 245, 245, 255), seen ? 0.9F : kHidden), tone);
    if (editor.view.labels && (seen || chosen || editor.view.labels_through_walls))
      pen.labels.over({LabelKind::target, i}, *place, {target.name}, tone::kText, chosen);
  }
}

// Where one looks down into rooms, by a cut or because nothing lies over them; not where their names would be larger
// than they are.
void drawRoomNames(Editor& editor, Pen& pen, const ViewState& state) {
  constexpr double kLeastElevation_rad = 0.35, kLargestShare = 1.2;
  const auto& camera = editor.view.camera;
  if (!editor.view.room_names || editor.view.tool == Tool::walk || camera.elevation_rad < kLeastElevation_rad ||
      editor.cloud())
    return;
  const auto& kept = editor.view.clip.box;
  for (const auto& room : editor.room_labels.of(editor.session.document().imported)) {
    const auto place = pen.at(room.anchor);
    if (!place || (kept && !kept->contains(room.anchor)) ||
        (state.cut_height_m && room.anchor.z() > *state.cut_height_m))
      continue;
    const double depth_m = (room.anchor - camera.eye()).dot(camera.forward());
    const double width_px = std::sqrt(room.floor_area_m2) / camera.metresPerPixel(depth_m, editor.view.size.y());
    std::vector<std::string> texts;
    for (const auto& text : {room.number.empty() ? room.name : room.name + "\n" + room.number, room.name, room.number})
      if (!text.empty() && ImGui::CalcTextSize(text.c_str()).x < kLargestShare * width_px) texts.push_back(text);
    if (texts.empty()) continue;
    if (editor.view.labels_through_walls || editor.picker.isInSight(room.anchor, state))
      pen.labels.around({LabelKind::room, room.product}, *place, std::move(texts), tone::kText);
  }
}

// Where a stair leads from the storey of whoever walks; a click on its name goes there.
void drawStairNames(const Editor& editor, Pen& pen, const ViewState& state) {
  if (!editor.view.room_names || editor.cloud()) return;
  for (const auto& stair : stairsAhead(editor, state))
    if (const auto place = pen.at(stair.anchor))
      pen.labels.button({LabelKind::stair, stair.product}, *place,
                        stair.up ? trf("{}  Stair up to {}  (Q)", ICON_ARROW_UP, stair.storey)
                                 : trf("{}  Stair down to {}  (Q)", ICON_ARROW_DOWN, stair.storey));
}

// Where a handheld scanner shall be carried.
void drawWay(const Editor& editor, Pen& pen) {
  std::optional<Eigen::Vector3d> before;
  for (const auto& place : editor.way) {
    const Eigen::Vector3d here = place - editor.shift_m();
    if (before) pen.line(*before, here, tone::kAccent, 2);
    if (const auto at = pen.at(here)) pen.circle(*at, 4, tone::kAccent, tone::kText);
    before = here;
  }
}

const TargetArticle& chosenArticle(const Editor& editor, const TargetKinds& kinds) {
  return kinds.articles[std::min(editor.view.target_article, kinds.articles.size() - 1)];
}

// A target as the click would put it up, and how many points each station's scan would lay on it.
void tellTargetHere(Editor& editor, Pen& pen) {
  const auto& hit = *editor.view.hover;
  const auto* kinds = editor.target_list.kinds();
  if (kinds == nullptr) return;
  const auto& article = chosenArticle(editor, *kinds);
  const bool sphere = article.shape == TargetKind::sphere;
  const Target target{article.label, article.shape, hit.position + (sphere ? article.size_m / 2 : 0.0) * hit.normal,
                      hit.normal, article.size_m};
  if (const auto place = pen.at(target.centre)) pen.circle(*place, 5, IM_COL32(245, 245, 245, 200), tone::kGood);
  const auto scene = editor.picker.scene();
  const auto& job = editor.session.document().job;
  if (!scene || !job) return;
  const auto settings = editor.plannedSettings();
  std::string text = tr(article.label);
  for (const auto& station : job->stations) {
    const auto sight = sightFrom(station, *scene, target, kinds->rules, settings);
    text += figures("\n{}   {:.1f} m   {}", station.name, sight.distance_m,
                    !sight.why_not.empty() ? sight.why_not
                    : sight.points         ? trf("about {:.0f} points", *sight.points)
                                           : tr("in sight"));
  }
  ImGui::SetTooltip("%s", text.c_str());
}

void drawPreview(Editor& editor, Pen& pen) {
  const auto& view = editor.view;
  if (!view.hover) return;
  if (view.tool == Tool::placeTarget) tellTargetHere(editor, pen);
}

void drawWorstPlace(const Editor& editor, Pen& pen) {
  if (!editor.view.worst_place) return;
  const auto& worst = *editor.view.worst_place;
  const auto place = pen.at(worst.at);
  if (!place) return;
  pen.circle(*place, 12, IM_COL32(20, 22, 26, 60), tone::kWarning);
  pen.circle(*place, 2, tone::kWarning, IM_COL32(20, 22, 26, 255));
  std::vector<std::string> texts = {worst.what};
  if (!worst.where.empty()) texts.insert(texts.begin(), worst.what + "\n" + worst.where);
  pen.labels.over({LabelKind::worst_place, 0}, *place, std::move(texts), tone::kText);
}

}  // namespace

void targetChip(Editor& editor) {
  const auto* kinds = editor.target_list.kinds();
  if (editor.view.tool != Tool::placeTarget || kinds == nullptr) return;
  const std::string label = ICON_TARGET "  " + tr(chosenArticle(editor, *kinds).label);
  nextRow();
  ImGui::SetNextItemWidth(chipWidth(editor, label, 150));
  const bool open = ui::beginDropDown("###target-article", label.c_str(), ImGuiComboFlags_NoArrowButton);
  if (!open) return ui::tooltip("Kind of target that the next click puts up");
  for (std::size_t i = 0; i < kinds->articles.size(); ++i)
    if (ui::choice(ui::Label(kinds->articles[i].label.c_str()), i == editor.view.target_article))
      editor.view.target_article = i;
  ui::endDropDown();
}

void drawMarkers(Editor& editor, ImVec2 origin, LabelBoard& labels) {
  Pen pen(editor, origin, labels);
  const ViewState state = editor.viewState();
  auto& list = *ImGui::GetWindowDrawList();
  list.PushClipRect(
      origin,
      {origin.x + static_cast<float>(editor.view.size.x()), origin.y + static_cast<float>(editor.view.size.y())}, true);
  drawHoles(editor, state, origin);
  drawWay(editor, pen);
  drawTrajectories(editor, state, origin, labels);
  drawWalkedRibbon(editor, state, origin);
  drawPreview(editor, pen);
  drawStations(editor, pen, state);
  drawTargets(editor, pen, state);
  drawRoomNames(editor, pen, state);
  drawStairNames(editor, pen, state);
  drawWorstPlace(editor, pen);
  if (editor.view.labels) nameHoles(editor, state, origin, labels);
  list.PopClipRect();
}

}  // namespace standpoint
