// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/shell/trajectory_overlay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "core/motion/carriers.h"
#include "core/units.h"
#include "editor/bodies/under_way.h"
#include "editor/colours/colour_scale.h"
#include "editor/model/outliner_rows.h"
#include "editor/model/trajectory_steps.h"
#include "editor/shell/actions.h"
#include "editor/shell/editor.h"
#include "editor/shell/label_board.h"
#include "editor/shell/overlay.h"
#include "editor/shell/view_pen.h"
#include "editor/widgets/drop_down.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/number_field.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/verdict_sign.h"
#include "editor/words/words.h"

namespace standpoint {

namespace {

using Eigen::Vector3d;

constexpr double kRibbonHalf_m = 0.16, kOnFoot = 0.4;  // as wide for whoever stands on it
constexpr double kLeastLeg_m = 0.05;
constexpr double kRibbonAbove_m = 0.03;  // of the ribbon, so that the floor does not hide it
constexpr std::size_t kSegments = 500, kSegmentsOfOthers = 160;
constexpr double kArrowEvery_m = 2.5;

enum class RibbonColour { plain, time, speed, turn, error };

// By what the ribbons are coloured.
struct RibbonChoice {
  RibbonColour by = RibbonColour::plain;
};

struct NamedRibbon {
  RibbonColour by;
  const char *name, *unit;
};
constexpr std::array kRibbons = {
    NamedRibbon{RibbonColour::plain, "one colour", ""}, NamedRibbon{RibbonColour::time, "time", "s"},
    NamedRibbon{RibbonColour::speed, "speed", "m/s"}, NamedRibbon{RibbonColour::turn, "turn rate", "°/s"},
    NamedRibbon{RibbonColour::error, "expected error", "mm"}};

double figureOf(const TrajectoryWay& way, std::size_t i, RibbonColour by) {
  const PathSample& sample = way.samples[i];
  switch (by) {
    case RibbonColour::time: return sample.after_s;
    case RibbonColour::speed: return sample.speed_mps;
    case RibbonColour::turn: return sample.turn_radps / kRadPerDeg;
    case RibbonColour::error: return i < way.expected_m.size() ? 1e3 * way.expected_m[i] : 0;
    case RibbonColour::plain: break;
  }
  return 0;
}

// The colours of one way: from nothing to the most that it has.
struct RibbonScale {
  RibbonColour by = RibbonColour::plain;
  ImU32 plain = 0;
  double most = 0;
  ImU32 toneOf(const TrajectoryWay& way, std::size_t i) const {
    return by == RibbonColour::plain ? plain : packed(viridis(most > 0 ? figureOf(way, i, by) / most : 0));
  }
};

RibbonScale scaleOf(const TrajectoryWay& way, RibbonColour by, ImU32 plain) {
  RibbonScale scale{by, plain, 0};
  for (std::size_t i = 0; i < way.samples.size(); ++i) scale.most = std::max(scale.most, figureOf(way, i, by));
  return scale;
}

ImU32 thinned(ImU32 tone, unsigned alpha) { return (tone & ~IM_COL32_A_MASK) | (alpha << IM_COL32_A_SHIFT); }

// A moment of the way as the ribbon has it.
Vector3d onRibbon(const TrajectoryWay& way, const PathSample& sample) {
  return sample.position_m - Vector3d(0, 0, std::max(0.0, way.lift_m - kRibbonAbove_m));
}

Vector3d across(const Vector3d& way) {
  const Vector3d side(-way.y(), way.x(), 0);
  return side.norm() < 1e-9 ? Vector3d(0, 0, 0) : Vector3d(side.normalized() * kRibbonHalf_m);
}

// A part of the picture.
struct Frame {
  ImVec2 low{1e9F, 1e9F}, high{-1e9F, -1e9F};
  void extend(ImVec2 p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  bool meets(const Frame& other) const {
    return low.x < other.high.x && other.low.x < high.x && low.y < other.high.y && other.low.y < high.y;
  }
};

// What the instrument and whoever bears it take up in the picture: the way is not drawn over them. Nothing where it is
// not shown, or reaches behind the eye.
std::optional<Frame> frameOfBearer(const ViewState& state, const ViewPen& pen, const TrajectoryWay& way,
                                   double after_s) {
  if (!state.under_way || !way.motion.truth) return std::nullopt;
  const Pose pose = way.motion.truth->pose(way.motion.truth->first_s() + after_s);
  for (const auto& carried : state.under_way->carried) {
    if ((carried.pose.translation - pose.translation).norm() > 1e-6) continue;
    constexpr float kInstrument_m = 0.2F;  // half of one
    auto corners = bearerOf(carried).positions;
    for (int i = 0; i < 8; ++i)
      corners.push_back(pose.translation.cast<float>() + kInstrument_m * Eigen::Vector3f((i & 1) != 0 ? 1 : -1,
                                                                                         (i & 2) != 0 ? 1 : -1,
                                                                                         (i & 4) != 0 ? 1 : -1));
    Frame frame;
    for (const auto& corner : corners) {
      const auto pixel = pen.at(corner.cast<double>());
      if (!pixel) return std::nullopt;
      frame.extend(*pixel);
    }
    return frame;
  }
  return std::nullopt;
}

// False where it is not drawn: behind the eye, or over `spared`.
bool quad(const ViewPen& pen, const std::array<Vector3d, 4>& corners, ImU32 tone, const std::optional<Frame>& spared) {
  std::array<ImVec2, 4> pixels;
  Frame frame;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto pixel = pen.at(corners[i]);
    if (!pixel) return false;
    frame.extend(pixels[i] = *pixel);
  }
  if (spared && frame.meets(*spared)) return false;
  ImGui::GetWindowDrawList()->AddQuadFilled(pixels[0], pixels[1], pixels[2], pixels[3], tone);
  return true;
}

// Which way it goes.
void arrow(const ViewPen& pen, const Vector3d& at, const Vector3d& way, double size, ImU32 tone) {
  const Vector3d ahead = way.normalized() * size * 0.22, side = size * across(way) * 0.75;
  const auto tip = pen.at(at + ahead), left = pen.at(at - ahead * 0.4 + side), right = pen.at(at - ahead * 0.4 - side);
  if (tip && left && right) ImGui::GetWindowDrawList()->AddTriangleFilled(*tip, *left, *right, tone);
}

// Where something hides it, it shines through.
void drawRibbon(const Editor& editor, const ViewState& state, const ViewPen& pen, const TrajectoryWay& way,
                const RibbonScale& scale, bool chosen, const std::optional<Frame>& spared = {}) {
  const auto& samples = way.samples;
  if (samples.size() < 2) return;
  const std::size_t step = std::max<std::size_t>(1, samples.size() / (chosen ? kSegments : kSegmentsOfOthers));
  auto& list = *ImGui::GetWindowDrawList();
  const auto flags = list.Flags;
  list.Flags &= ~ImDrawListFlags_AntiAliasedFill;  // no seams between the parts
  Vector3d from = onRibbon(way, samples.front());
  Vector3d side_before = Vector3d::Zero();
  double since_arrow = kArrowEvery_m / 2;
  const double wide = editor.walk.active() ? kOnFoot : 1;
  std::vector<std::array<Vector3d, 2>> arrows;  // over the whole ribbon, which would cover parts of them
  for (std::size_t i = 0; i + 1 < samples.size(); i += step) {
    const std::size_t there = std::min(i + step, samples.size() - 1);
    const Vector3d to = onRibbon(way, samples[there]), leg = to - from;
    if (leg.norm() < kLeastLeg_m) continue;  // it stands, or sways
    const Vector3d side = wide * across(leg), before = side_before.isZero() ? side : side_before;
    if (!keeps(state, to, kMarkAboveFloor_m)) {
      from = to, side_before = side;
      continue;
    }
    const bool seen = editor.picker.isInSight(to, state);
    const bool drawn =
        quad(pen, {from + before, to + side, to - side, from - before},
             thinned(scale.toneOf(way, there), seen ? (chosen ? 215 : 150) : (chosen ? 70 : 40)), spared);
    since_arrow += leg.norm();
    if (since_arrow > kArrowEvery_m && seen && drawn) {
      arrows.push_back({to, leg});
      since_arrow = 0;
    }
    from = to, side_before = side;
  }
  list.Flags = flags;
  for (const auto& [at, leg] : arrows) arrow(pen, at, leg, wide, IM_COL32(20, 22, 26, chosen ? 235 : 150));
}

void drawObstacles(const ViewState& state, const ViewPen& pen, LabelBoard& labels, const TrajectoryWay& way,
                   bool named) {
  for (std::size_t i = 0; i < way.obstacles.size(); ++i) {
    const auto at = pen.at(way.obstacles[i].place_m);
    if (!at || !keeps(state, way.obstacles[i].place_m, kMarkAboveFloor_m)) continue;
    const bool opens = way.obstacles[i].closed_door;  // who walks there opens it
    const ImU32 tone = opens ? ImU32(tone::kText) : verdictTone(Verdict::bad);
    const char* const icon = opens ? ICON_INFO : ICON_WARNING;
    auto& list = *ImGui::GetWindowDrawList();
    const float r = ImGui::GetFontSize() * 0.5F;
    list.AddCircleFilled(*at, r * 1.25F, IM_COL32(20, 22, 26, 220));
    const ImVec2 size = ImGui::CalcTextSize(icon);
    list.AddText({at->x - size.x / 2, at->y - size.y / 2}, tone, icon);
    if (named)
      labels.over({LabelKind::obstacle, i}, *at,
                  {trf("{} after {:.1f} s", withReadableClasses(way.obstacle_products[i]), way.obstacles[i].after_s),
                   figures("{:.1f} s", way.obstacles[i].after_s)},
                  tone);
  }
}

void drawWaypointsOf(const Editor& editor, const ViewState& state, const ViewPen& pen, LabelBoard& labels,
                     const std::vector<Waypoint>& waypoints, double height_m, bool flown, int chosen,
                     const std::optional<Frame>& spared = {}) {
  auto& list = *ImGui::GetWindowDrawList();
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    const auto& waypoint = waypoints[i];
    if (!keeps(state, waypoint.floor_m, 0)) continue;
    const Vector3d knob = waypoint.floor_m + Vector3d(0, 0, kRibbonAbove_m);
    const auto at = pen.at(knob);
    if (at && spared && spared->meets({*at, *at})) continue;
    if (flown) pen.line(knob, knob + Vector3d(0, 0, height_m), thinned(tone::kAccent, 120), 1.5F);
    if (waypoint.look_rad)
      pen.rod(knob, knob + 0.6 * Vector3d(std::cos(*waypoint.look_rad), std::sin(*waypoint.look_rad), 0), tone::kAccent,
              2);
    if (!at) continue;
    const bool this_one = chosen == static_cast<int>(i);
    list.AddCircleFilled(*at, editor.px(this_one ? 7 : 5), IM_COL32(20, 22, 26, 255));
    list.AddCircleFilled(*at, editor.px(this_one ? 5 : 3.5F), this_one ? tone::kAccent : tone::kText);
    if (!editor.view.labels) continue;
    std::string text = std::to_string(i + 1);
    if (waypoint.stop_s > 0) text += "   " + trf("stops {:.3g} s", waypoint.stop_s);
    labels.over({LabelKind::waypoint, i}, *at, {text, std::to_string(i + 1)}, tone::kText, this_one);
  }
}

void drawOf(const Editor& editor, const ViewState& state, const ViewPen& pen, LabelBoard& labels,
            const CarriedTrajectory& trajectory, std::size_t index, const TrajectoryWay* way, bool chosen,
            RibbonColour colours) {
  std::optional<Frame> spared;
  if (way != nullptr && way->problem.empty()) {
    const RibbonColour by = chosen ? colours : RibbonColour::plain;
    if (chosen && editor.path_moment.plays) spared = frameOfBearer(state, pen, *way, shownMoment_s(editor));
    drawRibbon(editor, state, pen, *way, scaleOf(*way, by, chosen ? tone::kAccent : tone::kStation), chosen, spared);
    drawObstacles(state, pen, labels, *way, chosen);
  } else {
    for (std::size_t i = 0; i + 1 < trajectory.waypoints.size(); ++i)
      pen.line(trajectory.waypoints[i].floor_m, trajectory.waypoints[i + 1].floor_m, thinned(tone::kAccent, 120), 1.5F);
  }
  if (chosen)
    drawWaypointsOf(editor, state, pen, labels, trajectory.waypoints,
                    carriedHeight_m(trajectory.carrier, trajectory.height_m), trajectory.carrier == "uav",
                    editor.survey.waypoint, spared);
  if (!editor.view.labels) return;
  const auto begin = !trajectory.waypoints.empty()             ? std::optional(trajectory.waypoints.front().floor_m)
                     : way != nullptr && !way->samples.empty() ? std::optional(way->samples.front().position_m)
                                                               : std::nullopt;
  if (const auto at = begin && keeps(state, *begin, kMarkAboveFloor_m) ? pen.at(*begin) : std::nullopt)
    labels.over({LabelKind::trajectory, index}, *at, {trajectory.name}, tone::kText, chosen);
}

// The way whose colours are shown: of what is laid, or chosen; null where there is none.
const TrajectoryWay* colouredWay(const Editor& editor) {
  const auto* way = editor.view.tool == Tool::layTrajectory ? editor.trajectory_ways.draft()
                    : editor.survey.trajectory >= 0
                        ? editor.trajectory_ways.of(static_cast<std::size_t>(editor.survey.trajectory))
                        : nullptr;
  return way != nullptr && way->samples.size() > 1 ? way : nullptr;
}

// At the lower left, as the other scales are.
void drawRibbonScale(const Editor& editor, RibbonColour by, ImVec2 origin) {
  const auto* way = colouredWay(editor);
  if (way == nullptr || by == RibbonColour::plain) return;
  const auto named = std::find_if(kRibbons.begin(), kRibbons.end(), [&](const auto& r) { return r.by == by; });
  const RibbonScale scale = scaleOf(*way, by, 0);
  constexpr int kSteps = 32;
  auto& list = *ImGui::GetWindowDrawList();
  const float width = editor.px(160), height = editor.px(8), x = origin.x + editor.px(14),
              y = origin.y + static_cast<float>(editor.view.size.y()) - editor.px(70);
  drawPlate(editor, {x, y}, {width, height + editor.px(2) + ImGui::GetTextLineHeight()});
  for (int i = 0; i < kSteps; ++i)
    list.AddRectFilled({x + width * static_cast<float>(i) / kSteps, y},
                       {x + width * static_cast<float>(i + 1) / kSteps, y + height},
                       packed(viridis((i + 0.5) / kSteps)));
  list.AddText({x, y + height + editor.px(2)}, tone::kDim, "0");
  const std::string most = figures("{:.3g} {}", scale.most, named->unit);
  list.AddText({x + width - ImGui::CalcTextSize(most.c_str()).x, y + height + editor.px(2)}, tone::kDim, most.c_str());
}

void ribbonChip(Editor& editor) {
  auto& choice = editor.panels.of<RibbonChoice>();
  const auto named = std::find_if(kRibbons.begin(), kRibbons.end(), [&](const auto& r) { return r.by == choice.by; });
  const std::string label = trf("Path: {}", tr(named->name));
  nextRow();
  ImGui::SetNextItemWidth(chipWidth(editor, label, 110));
  if (ui::beginDropDown("###ribbon-colour", label.c_str(), ImGuiComboFlags_NoArrowButton)) {
    for (const auto& ribbon : kRibbons)
      if (ui::choice(ui::Label(ribbon.name), ribbon.by == choice.by)) choice.by = ribbon.by;
    ui::endDropDown();
  } else {
    ui::tooltip("By what the chosen path is coloured");
  }
  ImGui::SameLine();  // else the next row would leave one out
}

// Of a field that is as wide as the chips are.
bool figure(const Editor& editor, const char* id, double& value, const char* unit, double most,
            const std::string& usual, const char* help) {
  ImGui::SameLine();
  ImGui::SetNextItemWidth(editor.px(128));
  return ui::numberField(
      id, value, {.kind = {.unit = unit, .least = 0, .most = most}, .decimals = 2, .zero = usual.c_str()}, help);
}

void chipButton(Editor& editor, const char* command, const char* text) {
  const auto& action = *findAction(command);
  const auto label = fmt::format("{}  {}###chip-{}", action.icon, tr(text), command);
  const auto tip = tr(action.title) + "  (" + shortcutText(action.shortcut) + ")";
  if (ui::button(label.c_str(), whyNot(action, editor), {0, 0}, tip.c_str())) action.run(editor);
}

}  // namespace

void drawTrajectories(Editor& editor, const ViewState& state, ImVec2 origin, LabelBoard& labels) {
  const auto& job = editor.session.document().job;
  if (!job) return;
  const ViewPen pen(editor, origin);
  const auto dragged = draggedTrajectory(editor);
  const RibbonColour colours = editor.panels.of<RibbonChoice>().by;
  editor.trajectory_ways.expectErrors(colours == RibbonColour::error);
  for (std::size_t i = 0; i < job->trajectories.size(); ++i) {
    const bool chosen = editor.survey.trajectory == static_cast<int>(i);
    if (chosen && dragged) {
      drawOf(editor, state, pen, labels, *dragged, i, editor.trajectory_ways.draft(), true, colours);
      continue;
    }
    drawOf(editor, state, pen, labels, job->trajectories[i], i, editor.trajectory_ways.of(i), chosen, colours);
  }
  drawRibbonScale(editor, colours, origin);
  const auto& draft = editor.view.draft;
  if (editor.view.tool != Tool::layTrajectory || draft.waypoints.empty()) return;
  const auto* way = draft.waypoints.size() < 2 ? nullptr : editor.trajectory_ways.draft();
  if (way != nullptr && way->problem.empty()) {
    drawRibbon(editor, state, pen, *way, scaleOf(*way, colours, tone::kAccent), true);
    drawObstacles(state, pen, labels, *way, true);
  }
  drawWaypointsOf(editor, state, pen, labels, draft.waypoints, carriedHeight_m(draft.carrier, draft.height_m),
                  draft.carrier == "uav", -1);
}

void drawNextWaypoint(Editor& editor, ImVec2 origin) {
  const auto& view = editor.view;
  const auto scene = editor.picker.scene();
  if (view.tool != Tool::layTrajectory || !view.hover || view.dragging || !scene) return;
  const ViewPen pen(editor, origin);
  const auto& draft = view.draft;
  const auto refused = whyNoWaypoint(*scene, *view.hover, carriedHeight_m(draft.carrier, draft.height_m));
  const Verdict verdict = refused ? Verdict::bad : Verdict::good;
  const Vector3d floor = view.hover->position;
  if (!draft.waypoints.empty()) pen.line(draft.waypoints.back().floor_m, floor, thinned(tone::kAccent, 150), 1.5F);
  if (const auto at = pen.at(floor)) {
    ImGui::GetWindowDrawList()->AddCircleFilled(*at, editor.px(6), IM_COL32(20, 22, 26, 255));
    ImGui::GetWindowDrawList()->AddCircleFilled(*at, editor.px(4.5F), verdictTone(verdict));
  }
  std::string text = refused ? refused->brief : trf("Waypoint {}", draft.waypoints.size() + 1);
  const auto* way = editor.trajectory_ways.draft();
  if (!refused && way != nullptr && draft.waypoints.size() >= 2)
    text += way->problem.empty() ? figures("   {:.1f} m   {}", way->length_m, durationText(way->seconds))
                                 : "   " + way->problem;
  const ImVec2 pointer = ImGui::GetIO().MousePos;
  pen.plate({pointer.x + editor.px(20), pointer.y + editor.px(16)}, verdictSign(verdict), verdictTone(verdict),
            tr(text));
}

void trajectoryChips(Editor& editor) {
  // While its way is still worked out, too: what is below must not move when it is known.
  const bool lays = editor.view.tool == Tool::layTrajectory;
  if (lays || chosenTrajectory(editor) != nullptr) ribbonChip(editor);
  if (!lays) return;
  auto& draft = editor.view.draft;
  const Carrier* const own = carrierOf(draft.carrier);
  nextRow();
  const std::string label = ICON_WALK "  " + carrierName(draft.carrier);
  ImGui::SetNextItemWidth(chipWidth(editor, label, 110));
  if (ui::beginDropDown("###draft-carrier", label.c_str(), ImGuiComboFlags_NoArrowButton)) {
    for (const auto& carrier : kCarriers)
      if (ui::choice((tr(std::string(carrier.name)) + "###draft-" + std::string(carrier.id)).c_str(),
                     carrier.id == draft.carrier))
        draft.carrier = carrier.id;
    ui::endDropDown();
  } else {
    ui::tooltip("What carries the scanner: pace, gait and shaking follow from it");
  }
  figure(editor, "###draft-height", draft.height_m, "m", 1000, trf("usual, {:.2f} m", own->limits.height_m),
         "Height of the scanner above the floor; 0 is the carrier's usual one");
  figure(editor, "###draft-speed", draft.speed_mps, "m/s", 100, trf("usual, {:.1f} m/s", own->limits.speed_mps),
         "It is slower in bends; 0 is the carrier's usual one");
  nextRow();
  chipButton(editor, "end-trajectory", "Finish");
  ImGui::SameLine();
  chipButton(editor, "take-back-waypoint", "Take back");
}

}  // namespace standpoint
