// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/shell/place_ghost.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include "core/readable_name.h"
#include "core/units.h"
#include "editor/model/station_steps.h"
#include "editor/shell/editor.h"
#include "editor/shell/view_pen.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/verdict_sign.h"
#include "editor/words/sentences.h"
#include "editor/words/words.h"
#include "survey/stations/station_places.h"

namespace standpoint {

namespace {

using Eigen::Vector3d;

constexpr int kRimCorners = 72;
constexpr double kRimReach_m = 30;  // a shallow cone meets nothing for long

ImU32 withAlpha(ImU32 tone, unsigned alpha) { return (tone & ~IM_COL32_A_MASK) | (alpha << IM_COL32_A_SHIFT); }

// The edge of what lies below the field of view, on whatever stands there; empty where it sees straight down.
std::vector<Vector3d> blindRim(const Editor& editor, const Pose& pose, double height_m, double lowest_rad) {
  std::vector<Vector3d> rim;
  constexpr double kStraightDown = -89 * kRadPerDeg;
  const auto scene = editor.picker.scene();
  if (!scene || lowest_rad < kStraightDown) return rim;
  for (int i = 0; i < kRimCorners; ++i) {
    const double azimuth = 2 * std::numbers::pi * i / kRimCorners;
    const Vector3d way = pose.rotation * Vector3d(std::cos(lowest_rad) * std::cos(azimuth),
                                                  std::cos(lowest_rad) * std::sin(azimuth), std::sin(lowest_rad));
    const double to_floor = way.z() < -1e-3 ? std::min(kRimReach_m, height_m / -way.z()) : kRimReach_m;
    const auto hit = scene->intersect(pose.translation, way, to_floor);
    rim.push_back(hit ? hit->position : pose.translation + to_floor * way);
  }
  return rim;
}

void drawLegs(const Editor& editor, const ViewPen& pen, const Pose& pose, double height_m, ImU32 tone) {
  const auto* placement = editor.placement.placement();
  const double radius = placement != nullptr ? placement->stand().foot_radius_m : 0.4;
  const Vector3d plate = pose.translation - Vector3d(0, 0, std::min(kUsualTrunnion_m, height_m / 2));
  for (int leg = 0; leg < 3; ++leg) {
    const double azimuth = leg * 2 * std::numbers::pi / 3 + 0.4;
    pen.rod(plate, pose.translation + Vector3d(radius * std::cos(azimuth), radius * std::sin(azimuth), -height_m), tone,
            3);
  }
}

// A box of an instrument's size around its centre, and its X axis.
void drawHead(const ViewPen& pen, const Pose& pose, ImU32 tone) {
  std::array<Vector3d, 8> corners;
  for (unsigned i = 0; i < 8; ++i)
    corners[i] = pose * Vector3d((i & 1U) != 0 ? 0.1 : -0.1, (i & 2U) != 0 ? 0.12 : -0.12, (i & 4U) != 0 ? 0.18 : -0.2);
  pen.body(corners, IM_COL32(30, 33, 39, 235), tone);
  pen.rod(pose.translation, pose * Vector3d(0.3, 0, 0), tone, 2);
}

void drawCross(const ViewPen& pen, const Vector3d& floor, ImU32 tone) {
  const Vector3d a(0.28, 0.28, 0), b(0.28, -0.28, 0);
  pen.rod(floor - a, floor + a, tone, 3);
  pen.rod(floor - b, floor + b, tone, 3);
}

struct FigureRow {
  std::string label, value;
  Verdict verdict = Verdict::unknown;  // unknown: the figure has no limit
};

std::string percent(double fraction) { return fmt::format("{:.0f} %", fraction * 100); }

std::vector<FigureRow> figureRows(const PlaceForecast& forecast) {
  std::vector<FigureRow> rows;
  if (forecast.near_seen)
    rows.push_back({forecast.room ? "Room coverage" : "Storey coverage", percent(*forecast.near_seen)});
  rows.push_back({"Model coverage", percent(forecast.model_seen)});
  for (const auto& overlap : forecast.overlaps)
    rows.push_back({trf("Overlap with {}", overlap.station), percent(overlap.fraction),
                    &overlap == forecast.largestOverlap() ? overlapVerdict(forecast) : Verdict::unknown});
  if (forecast.overlaps.empty() && forecast.others > 0)
    rows.push_back({"Overlap", "no station nearby", overlapVerdict(forecast)});
  if (forecast.spacing_m)
    rows.push_back({"Spacing, 95 %", figures("{:.1f} mm", *forecast.spacing_m * 1000), spacingVerdict(forecast)});
  if (forecast.incidence_rad)
    rows.push_back({"Incidence, 95 %", fmt::format("{:.0f}°", *forecast.incidence_rad / kRadPerDeg)});
  return rows;
}

// Of a new station whose numbers are typed, while the pointer holds none.
void drawTypedStation(const Editor& editor, const ViewPen& pen, const TypedStation& typed) {
  if (typed.refused) return;
  const Vector3d& centre = typed.centre;
  const auto* verdict = verdictOfStation(editor, centre, true);
  if (verdict == nullptr) return;
  const auto scene = editor.picker.scene();
  const auto below = scene->intersect(centre, -Vector3d::UnitZ(), kRimReach_m);
  const HeldStation held{"", below ? centre.z() - below->position.z() : kUsualHeight_m, Eigen::Quaterniond::Identity()};
  const Vector3d floor = centre - Vector3d(0, 0, held.height_m);
  drawHeldStation(editor, pen, held, floor, verdict->verdict);
  const auto pixel = project(editor.view.camera, centre, editor.view.size);
  const Eigen::AlignedBox2d view(Eigen::Vector2d::Zero(), editor.view.size);
  const auto place = pen.at(centre);
  if (place && pixel && view.contains(*pixel))  // no words without their tripod
    pen.verdict({place->x + editor.px(20), place->y + editor.px(16)}, verdict->verdict, trSentence(verdict->brief));
}

std::string placeTitle(const Editor& editor, const HeldStation& held, const PlaceForecast* forecast) {
  const auto title = held.name.empty() ? tr("New station") : trf("Station {}", held.name);
  const auto scene = editor.picker.scene();
  if (forecast == nullptr || !scene) return title;
  const auto where = forecast->room ? readableName(scene->environment().products[*forecast->room]) : forecast->storey;
  return where.empty() ? title : title + "  ·  " + where;
}

// On a plate at the right, below the axes. While the figures are of an older place they are dim, with "…".
void drawFigures(const Editor& editor, const HeldStation& held, ImVec2 origin, ImVec2 size) {
  const auto* forecast = editor.place_figures.forecast();
  const bool old = editor.place_figures.old();
  std::vector<FigureRow> rows = {{"Expected view", "…"}};
  if (forecast != nullptr) rows = figureRows(*forecast);
  const float pad = editor.px(10), line = ImGui::GetTextLineHeight() + editor.px(5), width = editor.px(236);
  const float height = 2 * pad + line * static_cast<float>(rows.size() + 1) - editor.px(2);
  const float right_x = origin.x + size.x - width - editor.px(10), y_from = origin.y + editor.px(124);
  const ImVec2 pointer = ImGui::GetIO().MousePos;  // it and the tripod over it are not to be covered
  const bool covered = pointer.x > right_x - editor.px(90) && pointer.y < y_from + height + editor.px(170);
  const ImVec2 low(covered ? origin.x + editor.px(10) : right_x, y_from);
  auto& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(low, {low.x + width, low.y + height}, tone::kOverlay, editor.px(5));
  float y = low.y + pad;
  list.PushClipRect(low, {low.x + width - pad, low.y + height}, true);
  list.AddText({low.x + pad, y}, tone::kText, placeTitle(editor, held, forecast).c_str());
  list.PopClipRect();
  for (const auto& row : rows) {
    y += line;
    const std::string said = tr(row.value), value = old && forecast != nullptr ? said + " …" : said;
    const float right = low.x + width - pad - editor.px(18);
    list.AddText({low.x + pad, y}, tone::kDim, tr(row.label).c_str());
    list.AddText({right - ImGui::CalcTextSize(value.c_str()).x, y}, old ? tone::kDim : tone::kText, value.c_str());
    if (row.verdict != Verdict::unknown && !old)
      list.AddText({right + editor.px(6), y}, verdictTone(row.verdict), verdictSign(row.verdict));
  }
}

void wantFigures(Editor& editor, const HeldStation& held, const Vector3d& centre) {
  const auto* instrument = editor.instrument(editor.scan_choice.instrument);
  const auto& document = editor.session.document();
  if (instrument == nullptr || !document.job || !editor.picker.scene()) return editor.place_figures.drop();
  PlaceWish wish{editor.picker.scene(), document.materials, document.job, editor.scan_choice.settings,
                 instrument->id,        held.name,          centre,       held.rotation.coeffs()};
  editor.place_figures.want(std::move(wish), *instrument);
}

// Of the last refusal, until the next click.
void drawRefused(const Editor& editor, const ViewPen& pen, ImVec2 origin, ImVec2 size) {
  const auto& refused = editor.view.refused_place;
  if (!refused) return;
  if (!refused->floor)
    return pen.plate({origin.x + editor.px(14), origin.y + size.y - editor.px(90)}, verdictSign(Verdict::bad),
                     verdictTone(Verdict::bad), trSentence(refused->brief) + ": " + trSentence(refused->reason));
  drawCross(pen, *refused->floor, verdictTone(Verdict::bad));
  const auto place = pen.at(*refused->floor);
  if (!place) return;
  const auto stays = refused->station.empty() ? std::string() : trf(". {} stays where it was", refused->station);
  pen.verdict({place->x + editor.px(18), place->y + editor.px(14)}, Verdict::bad, trSentence(refused->brief) + stays);
}

// The name of the chosen station where the title is about it.
std::string chosenStation(const Editor& editor, const std::string& title) {
  const auto& job = editor.session.document().job;
  const auto chosen = static_cast<std::size_t>(editor.survey.station);
  if (!job || editor.survey.station < 0 || chosen >= job->stations.size()) return {};
  const auto& name = job->stations[chosen].name;
  return title.ends_with(" " + name) ? name : std::string();
}

}  // namespace

std::optional<HeldStation> heldStation(const Editor& editor) {
  const auto& view = editor.view;
  const auto& job = editor.session.document().job;
  if (!job || !view.hover || view.dragging || view.placed_at) return std::nullopt;
  if (view.tool == Tool::placeStation || (view.tool == Tool::placeRow && !view.row_from))
    return HeldStation{"", kUsualHeight_m, Eigen::Quaterniond::Identity()};
  if (view.dragged_station < 0 || view.dragged_station >= static_cast<int>(job->stations.size()) ||
      !view.station_drag_begun)
    return std::nullopt;
  const auto& station = job->stations[static_cast<std::size_t>(view.dragged_station)];
  return HeldStation{station.name, station.instrument_height_m, station.true_pose.rotation};
}

PlaceVerdict verdictUnderPointer(Editor& editor, const HeldStation& held) {
  return editor.placement.judge(*editor.view.hover, held.height_m, nearestRange_m(editor));
}

void refusePlace(Editor& editor, const HeldStation& held, const PlaceVerdict& verdict) {
  editor.view.refused_place = RefusedPlace{held.name, verdict.brief, verdict.reason, editor.view.hover->position};
}

void takePlaceRefusals(Editor& editor) {
  auto& errors = editor.session.errors();
  for (auto error = errors.begin(); error != errors.end();) {
    const auto& done = editor.session.finished();
    const bool of_station =
        error->error.kind == ErrorKind::unusable && std::any_of(done.begin(), done.end(), [&](const FinishedTask& t) {
          return !t.ok && t.verb == "station" && t.title == error->title;
        });
    if (of_station)
      editor.view.refused_place =
          RefusedPlace{chosenStation(editor, error->title), error->title, error->error.message, std::nullopt};
    error = of_station ? errors.erase(error) : error + 1;
  }
}

void drawHeldStation(const Editor& editor, const ViewPen& pen, const HeldStation& held, const Vector3d& floor,
                     Verdict verdict) {
  const Pose pose{held.rotation, floor + Vector3d(0, 0, held.height_m)};
  const ImU32 tone = verdictTone(verdict);
  if (const auto settings = editor.plannedSettings(); settings && verdict != Verdict::bad) {
    const auto rim = blindRim(editor, pose, held.height_m, settings->elevation_from_rad);
    pen.fan(floor, rim, withAlpha(tone, 70));
    pen.ring(rim, tone, 1.5F);
  }
  if (verdict == Verdict::bad) drawCross(pen, floor, tone);
  drawLegs(editor, pen, pose, held.height_m, tone);
  drawHead(pen, pose, tone);
}

void drawPlaceGhost(Editor& editor, ImVec2 origin, ImVec2 size) {
  const ViewPen pen(editor, origin);
  constexpr float kLeft = 6;  // pt, from where the pointer has left what it has placed
  const auto& placed = editor.view.placed_at;
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  if (placed && std::hypot(mouse.x - placed->x(), mouse.y - placed->y()) > editor.px(kLeft))
    editor.view.placed_at.reset();
  const auto held = heldStation(editor);
  if (!held) {
    editor.place_figures.drop();
    if (editor.view.tool == Tool::placeStation && editor.view.typed_station)
      drawTypedStation(editor, pen, *editor.view.typed_station);
    return drawRefused(editor, pen, origin, size);
  }
  auto verdict = verdictUnderPointer(editor, *held);
  const Vector3d floor = editor.view.hover->position;
  const Pose pose{held->rotation, floor + Vector3d(0, 0, held->height_m)};
  if (verdict.verdict == Verdict::bad) {
    editor.place_figures.drop();
  } else {
    wantFigures(editor, *held, pose.translation);
    const auto* forecast = editor.place_figures.forecast();
    if (forecast != nullptr && !editor.place_figures.old()) verdict = withForecast(std::move(verdict), *forecast);
  }
  drawHeldStation(editor, pen, *held, floor, verdict.verdict);
  if (verdict.verdict != Verdict::bad) drawFigures(editor, *held, origin, size);
  const ImVec2 pointer = ImGui::GetIO().MousePos;
  pen.verdict({pointer.x + editor.px(20), pointer.y + editor.px(16)}, verdict.verdict, trSentence(verdict.brief));
}

}  // namespace standpoint
