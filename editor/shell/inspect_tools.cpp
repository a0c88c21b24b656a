// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/shell/inspect_tools.h"

#include <algorithm>
#include <initializer_list>
#include <utility>

#include "editor/shell/editor.h"
#include "editor/shell/label_board.h"
#include "editor/shell/view_pen.h"
#include "editor/widgets/drop_down.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/keyboard.h"
#include "editor/widgets/theme.h"
#include "editor/words/figures.h"
#include "editor/words/sentences.h"
#include "editor/words/words.h"
#include "project/survey/measure_verb.h"

namespace standpoint {

namespace {

constexpr double kReach_px = 5;  // of a point of a cloud
constexpr double kSnap_px = 10;
constexpr float kMissed_px = 60, kRim_px = 24;

// Keeps what was clicked as a measurement of the project; the tool stays for the next one.
void finish(Editor& editor) {
  auto& measuring = editor.view.measuring;
  const auto name = freeMeasurementName(editor.session.document());
  MeasureOptions options{.add = name};
  options.kind = measuring.kind;
  for (const auto& p : measuring.points) options.points.push_back(p + editor.shift_m());
  if (measuring.square) options.note = tr("Square to both faces");
  measuring.problem.clear();
  if (const auto fits = checkMeasurement({name, measuring.kind, measuring.points, {}}); !fits)
    measuring.problem = trSentence(fits.error().message);
  else if (!editor.session.start(options, trf("Measure {} {}", tr(rowOf(measuring.kind).name), name)))
    measuring.problem = editor.session.whyNot("measure");
  if (!measuring.problem.empty()) editor.say(measuring.problem);
  measuring = {measuring.kind, {}, std::move(measuring.problem)};
}

ImU32 toneOf(bool chosen) { return chosen ? static_cast<ImU32>(tone::kAccent) : IM_COL32(240, 190, 70, 255); }

void drawDot(const ViewPen& pen, const Editor& editor, const Eigen::Vector3d& place, ImU32 tone) {
  const auto at = pen.at(place);
  if (!at) return;
  auto& list = *ImGui::GetWindowDrawList();
  list.AddCircleFilled(*at, editor.px(4), tone);
  list.AddCircle(*at, editor.px(4), IM_COL32(16, 18, 22, 220 * (tone >> IM_COL32_A_SHIFT) / 255), 0, editor.px(1.2F));
}

// What the pointer holds on to, by its shape: a square on a corner, a cross on an edge, a right angle where the
// distance is square to both faces.
void drawPointer(const ViewPen& pen, const Editor& editor, const MeasurablePlace& place) {
  drawDot(pen, editor, place.position, tone::kAccent);
  const auto at = pen.at(place.position);
  if (!at) return;
  auto& list = *ImGui::GetWindowDrawList();
  const float r = editor.px(8);
  const auto stroke = [&](std::initializer_list<ImVec2> places, ImDrawFlags closed = 0) {
    for (const auto& [tone, width] : {std::pair(IM_COL32(16, 18, 22, 220), 4.0F), {tone::kAccent, 2.0F}}) {
      for (const auto& p : places) list.PathLineTo({at->x + r * p.x, at->y + r * p.y});
      list.PathStroke(tone, closed, editor.px(width));
    }
  };
  if (place.square) return stroke({{-1.4F, 0}, {-1.4F, -1.4F}, {0, -1.4F}});
  if (place.snap == Snap::corner) return stroke({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, ImDrawFlags_Closed);
  if (place.snap == Snap::edge) {
    stroke({{-1, -1}, {1, 1}});
    stroke({{-1, 1}, {1, -1}});
  }
}

void drawShape(const ViewPen& pen, const Editor& editor, const Measurement& m, ImU32 tone) {
  const auto& p = m.points;
  switch (m.kind) {
    case MeasurementKind::distance:
    case MeasurementKind::angle:
      for (std::size_t i = 0; i + 1 < p.size(); ++i) pen.rod(p[i], p[i + 1], tone, 2);
      break;
    case MeasurementKind::height: {
      const Eigen::Vector3d corner(p[0].x(), p[0].y(), p[1].z());
      pen.rod(p[0], corner, tone, 2);
      pen.rod(corner, p[1], tone, 1);
      break;
    }
    case MeasurementKind::area:
    case MeasurementKind::plane:
      for (std::size_t i = 0; i < p.size(); ++i) pen.rod(p[i], p[(i + 1) % p.size()], tone, 2);
      break;
  }
  for (const auto& place : p) drawDot(pen, editor, place, tone);
}

// How much of a kept measurement the view shows: what is cut away is not drawn, what lies behind something is drawn
// faintly and not named.
enum class Sight { cut_away, behind, clear };
Sight sightOf(const Editor& editor, const ViewState& state, const Measurement& m) {
  const auto cutAway = [&](const Eigen::Vector3d& p) {
    constexpr double kOnTheCut_m = 0.005;
    return (state.cut_height_m && p.z() > *state.cut_height_m + kOnTheCut_m) ||
           (state.clip && !state.clip->contains(p));
  };
  if (std::all_of(m.points.begin(), m.points.end(), cutAway)) return Sight::cut_away;
  if (editor.cloud()) return Sight::clear;
  const auto seen = [&](const Eigen::Vector3d& p) { return editor.picker.isInSight(p, state); };
  const bool any = std::any_of(m.points.begin(), m.points.end(), seen) || seen(labelPlace(m));
  return any ? Sight::clear : Sight::behind;
}

void drawKept(Editor& editor, const ViewPen& pen, LabelBoard& labels) {
  const auto& kept = editor.session.document().measurements;
  if (!kept || !editor.view.measurements) return;
  const ViewState state = editor.viewState();
  for (std::size_t i = 0; i < kept->size(); ++i) {
    const auto& m = (*kept)[i];
    const bool chosen = editor.survey.measurement == static_cast<int>(i);
    const auto sight = chosen ? Sight::clear : sightOf(editor, state, m);
    if (sight == Sight::cut_away) continue;
    if (sight == Sight::behind) {
      drawShape(pen, editor, m, (toneOf(false) & 0x00FFFFFFU) | 0x50000000U);
      continue;
    }
    drawShape(pen, editor, m, toneOf(chosen));
    const auto result = figuresIn(figureText(figuresOf(m)[0]));
    if (const auto at = pen.at(labelPlace(m)); at && editor.view.labels)
      labels.over({LabelKind::measurement, i}, *at, {m.name + "   " + result, result},
                  chosen ? tone::kAccent : tone::kText, chosen);
  }
}

void drawUnfinished(const Editor& editor, const ViewPen& pen, LabelBoard& labels) {
  const auto& view = editor.view;
  if (view.tool != Tool::measure) return;
  for (const auto& p : view.measuring.points) drawDot(pen, editor, p, tone::kAccent);
  const auto next = view.measured ? std::optional(view.measured->position) : std::nullopt;
  const auto so_far = measuredSoFar(view.measuring, next);
  if (so_far)
    drawShape(pen, editor, *so_far, tone::kAccent);
  else if (!view.measuring.points.empty() && next)
    pen.rod(view.measuring.points.back(), *next, tone::kAccent, 2);
  if (view.measured) drawPointer(pen, editor, *view.measured);
  if (!so_far) return;
  std::string text;
  const auto add = [&](const std::string& line) { text += (text.empty() ? "" : "\n") + line; };
  const bool square = view.measured && view.measured->square;
  for (const auto& figure : figuresOf(*so_far)) {
    add(tr(figure.label) + "  " + figuresIn(figureText(figure)));
    if (square) break;
  }
  if (square) add(tr("Square to both faces"));
  if (const auto at = pen.at(so_far->points.back())) labels.over({LabelKind::measuring, 0}, *at, {text}, tone::kText);
}

void drawWall(Editor& editor, const ViewPen& pen) {
  const auto& wall = editor.wall.result();
  if (!wall) return;
  const auto corners = cornersOf(*wall);
  pen.fan((corners[0] + corners[2]) / 2, corners, (toneOf(true) & 0x00FFFFFFU) | 0x38000000U);
  pen.ring(corners, tone::kAccent, 2);
}

// A click beside everything is answered where it was made.
bool missed(ViewportState& view) {
  view.missed_px = view.measured ? std::nullopt : std::optional(view.measured_px);
  return view.missed_px.has_value();
}

// A tool that measures a distance holds on to corners, edges and faces, and is square to parallel ones, unless Ctrl is
// held.
std::optional<MeasurablePlace> placeUnder(Editor& editor, const Eigen::Vector2d& pixel) {
  const auto& view = editor.view;
  const double reach_px = editor.px(kReach_px);
  if (view.tool != Tool::measure || ImGui::GetIO().KeyCtrl) return editor.measurableAt(pixel, reach_px);
  auto place = editor.snappedAt(pixel, reach_px, editor.px(kSnap_px));
  return place ? std::optional(squared(view.measuring, *std::move(place))) : std::nullopt;
}

void take(Editor& editor, const MeasurablePlace& place) {
  auto& measuring = editor.view.measuring;
  if (measuring.points.empty()) measuring.problem.clear();
  measuring = with(std::move(measuring), place);
  if (isFull(measuring)) finish(editor);
}

void takeOpposite(Editor& editor) {
  if (const auto place = editor.measurableOpposite()) return take(editor, *place);
  editor.say(tr("Nothing lies opposite that face. Click where the distance ends."));
}

// Moved inwards from the rim of the view, where it would not be whole.
void drawMissed(const Editor& editor, ImVec2 origin, LabelBoard& labels) {
  const auto& px = editor.view.missed_px;
  if (!px) return;
  auto words = tr("Nothing to measure here");
  const Eigen::Vector2d rim(editor.px(kRim_px) + ImGui::CalcTextSize(words.c_str()).x / 2,
                            editor.px(kRim_px) + ImGui::GetTextLineHeight());
  const Eigen::Vector2d inner(editor.view.size.x() - rim.x(), editor.view.size.y());
  const Eigen::Vector2d at = px->cwiseMin(inner).cwiseMax(rim);
  labels.over({LabelKind::measuring, 1}, {origin.x + static_cast<float>(at.x()), origin.y + static_cast<float>(at.y())},
              {std::move(words)}, tone::kWarning);
}

}  // namespace

bool measures(const Editor& editor) {
  const auto tool = editor.view.tool;
  return tool == Tool::measure || tool == Tool::pickWall || tool == Tool::pickSection;
}

void followInspectTools(Editor& editor, ImVec2 origin, bool hovered) {
  auto& view = editor.view;
  if (!measures(editor)) {
    view.measured.reset();
    view.missed_px.reset();
    return;
  }
  if (!view.dragging) {
    const ImVec2 p = ImGui::GetIO().MousePos;
    view.measured_px = {p.x - origin.x, p.y - origin.y};
    view.measured = hovered ? placeUnder(editor, view.measured_px) : std::nullopt;
    if (view.missed_px && (*view.missed_px - view.measured_px).norm() > editor.px(kMissed_px)) view.missed_px.reset();
  }
  if (view.tool != Tool::measure || ImGui::GetIO().WantTextInput || editor.device_has_keys ||
      ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopupId))
    return;
  const bool enter = keyboard::pressed(kKeyEnter) || keyboard::pressed(kKeyPadEnter);
  if (enter && !ui::dropDownIsOpen() && isEnough(view.measuring))
    finish(editor);
  else if (enter && !ui::dropDownIsOpen() && towardsOpposite(view.measuring))
    takeOpposite(editor);
  if (keyboard::pressed(kKeyBackspace) && !view.measuring.points.empty()) view.measuring.points.pop_back();
}

void clickMeasure(Editor& editor) {
  if (!missed(editor.view)) take(editor, *editor.view.measured);
}

void clickWall(Editor& editor) {
  auto& view = editor.view;
  if (missed(view)) return;
  // Only where the model itself was clicked its face says which wall is meant.
  std::optional<Eigen::Vector3d> normal;
  if (!editor.cloud() && view.hover && (view.hover->position - view.measured->position).norm() < 1e-6)
    normal = view.hover->normal;
  editor.measureWall(view.measured->position, normal);
  editor.wanted_tab[1] = "wall";
}

void drawInspectMarks(Editor& editor, ImVec2 origin, LabelBoard& labels) {
  const ViewPen pen(editor, origin);
  const ImVec2 size(static_cast<float>(editor.view.size.x()), static_cast<float>(editor.view.size.y()));
  auto& list = *ImGui::GetWindowDrawList();
  list.PushClipRect(origin, {origin.x + size.x, origin.y + size.y}, true);
  drawWall(editor, pen);
  drawMissed(editor, origin, labels);
  drawUnfinished(editor, pen, labels);
  drawKept(editor, pen, labels);
  list.PopClipRect();
}

}  // namespace standpoint
