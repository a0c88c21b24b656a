// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/shell/inspect_tools.h"

#include <algorithm>

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
constexpr float kMissed_px = 60, kRim_px = 24;

// Keeps what was clicked as a measurement of the project; the tool stays for the next one.
void finish(Editor& editor) {
  auto& measuring = editor.view.measuring;
  const auto name = freeMeasurementName(editor.session.document());
  MeasureOptions options{.add = name};
  options.kind = measuring.kind;
  for (const auto& p : measuring.points) options.points.push_back(p + editor.shift_m());
  measuring.problem.clear();
  if (const auto fits = checkMeasurement({name, measuring.kind, measuring.points, {}}); !fits)
    measuring.problem = trSentence(fits.error().message);
  else if (!editor.session.start(options, trf("Measure {} {}", tr(rowOf(measuring.kind).name), name)))
    measuring.problem = editor.session.whyNot("measure");
  if (!measuring.problem.empty()) editor.say(measuring.problem);
  measuring.points.clear();
}

ImU32 toneOf(bool chosen) { return chosen ? static_cast<ImU32>(tone::kAccent) : IM_COL32(240, 190, 70, 255); }

void drawDot(const ViewPen& pen, const Editor& editor, const Eigen::Vector3d& place, ImU32 tone) {
  const auto at = pen.at(place);
  if (!at) return;
  auto& list = *ImGui::GetWindowDrawList();
  list.AddCircleFilled(*at, editor.px(4), tone);
  list.AddCircle(*at, editor.px(4), IM_COL32(16, 18, 22, 220 * (tone >> IM_COL32_A_SHIFT) / 255), 0, editor.px(1.2F));
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

// Of its ends, or of its middle: they lie on walls and floors, a little off which one looks.
bool isInSight(const Editor& editor, const ViewState& state, const Measurement& m) {
  constexpr double kOff_m = 0.02;
  const auto seen = [&](const Eigen::Vector3d& p) {
    const Eigen::Vector3d eye = editor.view.camera.eyeOf(p);
    return editor.picker.sees(eye, p + kOff_m * (eye - p).normalized(), state);
  };
  return state.cloud || std::any_of(m.points.begin(), m.points.end(), seen) || seen(labelPlace(m));
}

ImU32 faint(ImU32 tone) { return (tone & ~IM_COL32_A_MASK) | (64U << IM_COL32_A_SHIFT); }

void drawKept(Editor& editor, const ViewPen& pen, LabelBoard& labels) {
  const auto& kept = editor.session.document().measurements;
  if (!kept || !editor.view.measurements) return;
  const ViewState state = editor.viewState();
  for (std::size_t i = 0; i < kept->size(); ++i) {
    const auto& m = (*kept)[i];
    const bool chosen = editor.survey.measurement == static_cast<int>(i);
    const auto in_picture = [&](const Eigen::Vector3d& p) { return keeps(state, p, kMarkAboveFloor_m); };
    if (std::none_of(m.points.begin(), m.points.end(), in_picture)) continue;
    const bool seen = isInSight(editor, state, m);
    const ImU32 tone = toneOf(chosen);
    drawShape(pen, editor, m, seen ? tone : faint(tone));
    if (!seen && !chosen && !editor.view.labels_through_walls) continue;
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
  if (view.measured_at) drawDot(pen, editor, *view.measured_at, tone::kAccent);
  const auto so_far = measuredSoFar(view.measuring, view.measured_at);
  if (!so_far) {
    if (!view.measuring.points.empty() && view.measured_at)
      pen.rod(view.measuring.points.back(), *view.measured_at, tone::kAccent, 2);
    return;
  }
  drawShape(pen, editor, *so_far, tone::kAccent);
  std::string text;
  for (const auto& figure : figuresOf(*so_far))
    text += (text.empty() ? "" : "\n") + std::string(figure.label) + "  " + figuresIn(figureText(figure));
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
  view.missed_px = view.measured_at ? std::nullopt : std::optional(view.measured_px);
  return view.missed_px.has_value();
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
    view.measured_at.reset();
    view.missed_px.reset();
    return;
  }
  if (!view.dragging) {
    const ImVec2 p = ImGui::GetIO().MousePos;
    const auto place = hovered
                           ? editor.measurableAt(rayThrough(view.camera, {p.x - origin.x, p.y - origin.y}, view.size),
                                                 editor.px(kReach_px))
                           : std::nullopt;
    view.measured_at = place ? std::optional(place->position) : std::nullopt;
    view.measured_cloud = place ? place->cloud : std::string();
    view.measured_px = {p.x - origin.x, p.y - origin.y};
    if (view.missed_px && (*view.missed_px - view.measured_px).norm() > editor.px(kMissed_px)) view.missed_px.reset();
  }
  if (view.tool != Tool::measure || ImGui::GetIO().WantTextInput || editor.device_has_keys ||
      ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopupId))
    return;
  auto& points = view.measuring.points;
  if ((keyboard::pressed(kKeyEnter) || keyboard::pressed(kKeyPadEnter)) && !ui::dropDownIsOpen() &&
      isEnough(view.measuring))
    finish(editor);
  if (keyboard::pressed(kKeyBackspace) && !points.empty()) points.pop_back();
}

void clickMeasure(Editor& editor) {
  auto& view = editor.view;
  if (missed(view)) return;
  if (view.measuring.points.empty()) view.measuring.problem.clear();
  view.measuring.points.push_back(*view.measured_at);
  if (isFull(view.measuring)) finish(editor);
}

void clickWall(Editor& editor) {
  auto& view = editor.view;
  if (missed(view)) return;
  // Only where the model itself was clicked its face says which wall is meant.
  std::optional<Eigen::Vector3d> normal;
  if (!editor.cloud() && view.hover && (view.hover->position - *view.measured_at).norm() < 1e-6)
    normal = view.hover->normal;
  editor.measureWall(*view.measured_at, normal);
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
