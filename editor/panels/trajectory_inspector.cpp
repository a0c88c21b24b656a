// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/panels/trajectory_inspector.h"

#include <algorithm>

#include <fmt/format.h>
#include <imgui.h>

#include "core/motion/carriers.h"
#include "core/units.h"
#include "editor/model/outliner_rows.h"
#include "editor/model/shown_holes.h"
#include "editor/model/trajectory_steps.h"
#include "editor/panels/actions.h"
#include "editor/panels/panel.h"
#include "editor/panels/survey_edit.h"
#include "editor/widgets/drop_down.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/number_field.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/widgets.h"
#include "editor/words/words.h"
#include "project/survey/coverage_verb.h"
#include "survey/scanning/scan_age.h"
#include "survey/trajectories/trajectory_file.h"

namespace standpoint {

namespace {

struct TrajectoryEdit {
  SurveyEdit common;
  double height_m = 0, speed_mps = 0;
  int waypoint = -1;  // whose fields these are
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
  double stop_s = 0, look_deg = 0;
  bool looks = false;
};

const NumberFormat kMetres{.kind = {.unit = "m"}, .decimals = 3};

std::vector<std::string> trajectoryExtensions() {
  std::vector<std::string> all;
  for (const auto& format : trajectoryFormats())
    if (std::find(all.begin(), all.end(), format.extension) == all.end()) all.emplace_back(format.extension);
  return all;
}

// After a file, as no other trajectory is called.
std::string nameAfter(const std::filesystem::path& file, const Job& job) {
  std::string stem = file.stem().string();
  for (char& c : stem)
    if (std::string_view("/\\:,\"\n").find(c) != std::string_view::npos) c = ' ';
  const auto taken = [&](const std::string& name) {
    return std::any_of(job.trajectories.begin(), job.trajectories.end(), [&](const auto& t) { return t.name == name; });
  };
  std::string name = stem;
  for (int i = 2; taken(name); ++i) name = fmt::format("{} {}", stem, i);
  return name;
}

// Where the file does not say what it is, the form asks.
void import(Actions& actions, const std::filesystem::path& file, const Job& job) {
  TrajectoryOptions options{.add = nameAfter(file, job)};
  options.file = file;
  actions.chooseTrajectory(*options.add);
  const auto format = trajectoryFormatOf(file);
  if (format && *format == nullptr)
    actions.openForm(options);
  else
    actions.start(options, trf("Import trajectory {}", *options.add));
}

void askForImport(const Model& model, Actions& actions) {
  auto extensions = trajectoryExtensions();
  extensions.insert(extensions.end(), {".out", ".txt"});
  actions.askForFile(FileDialogState::Purpose::openFile, "Import trajectory", "Import", std::move(extensions), "",
                     [&model](Actions& later, const std::filesystem::path& file) {
                       if (const auto job = model.session.document().job) import(later, file, *job);
                     });
}

void askForExport(Actions& actions, const std::string& name) {
  actions.askForFile(FileDialogState::Purpose::saveFile, "Export trajectory", "Export", trajectoryExtensions(),
                     name + ".csv", [name](Actions& later, const std::filesystem::path& file) {
                       TrajectoryOptions options{.write = name};
                       options.output = file;
                       later.start(options, trf("Export trajectory {}", name));
                     });
}

// How much of a list is shown at once.
float listHeight(const Model& model, std::size_t rows) {
  return std::min(model.px(26) + ImGui::GetTextLineHeightWithSpacing() * static_cast<float>(rows), model.px(180));
}

std::string carriedBy(const CarriedTrajectory& trajectory) {
  return trajectory.file.empty() ? carrierName(trajectory.carrier) : tr("file");
}

bool isKnown(const TrajectoryWay* way) { return way != nullptr && way->problem.empty(); }

std::string lengthOf(const TrajectoryWay* way) {
  return isKnown(way) ? figures("{:.1f} m", way->length_m) : way == nullptr ? "…" : "–";
}

std::string durationOf(const TrajectoryWay* way) {
  return isKnown(way) ? durationText(way->seconds) : way == nullptr ? "…" : "–";
}

// What it goes through that nobody can open.
std::size_t wallsOn(const TrajectoryWay* way) {
  return way == nullptr ? 0 : way->obstacles.size() - way->closedDoors();
}

// What its row has no room for.
std::string aboutTrajectory(const TrajectoryWay* way, const CarriedTrajectory& trajectory) {
  std::string text = fmt::format("{}: {}", tr("Carrier"), carriedBy(trajectory));
  if (isKnown(way))
    text += fmt::format("\n{}: {}\n{}: {}", tr("Length"), lengthOf(way), tr("Duration"), durationOf(way));
  if (way != nullptr && !way->problem.empty()) text += "\n" + way->problem;
  if (const std::size_t walls = wallsOn(way); walls > 0)
    text += "\n" + trn("It goes through {} surface", "It goes through {} surfaces", walls, walls);
  if (const std::size_t doors = way == nullptr ? 0 : way->closedDoors(); doors > 0)
    text +=
        "\n" + trn("A scan finds {} door on its way closed", "A scan finds {} doors on its way closed", doors, doors);
  return text;
}

// Of the list, in points of the screen; 0 of one that it has no room for. A name has what they leave.
struct FigureColumns {
  float length = 0, duration = 0, scans = 0;
};

FigureColumns columnsBeside(const Model& model, const Job& job) {
  const auto wide = [](const std::string& text) { return ImGui::CalcTextSize(text.c_str()).x; };
  FigureColumns wanted{wide(tr("Length")), wide(tr("Duration")), wide(tr("Scans"))};
  for (std::size_t i = 0; i < job.trajectories.size(); ++i) {
    const auto* way = model.trajectory_ways.of(i);
    wanted.length = std::max(wanted.length, wide(lengthOf(way)));
    wanted.duration = std::max(wanted.duration, wide(durationOf(way)));
  }
  const auto& style = ImGui::GetStyle();
  const float gap = 2 * style.CellPadding.x, name = model.px(120);
  float left = ImGui::GetContentRegionAvail().x - style.ScrollbarSize - wanted.scans - 2 * gap - name;
  FigureColumns columns{0, 0, wanted.scans};
  for (const auto column : {&FigureColumns::length, &FigureColumns::duration}) {
    if (left < wanted.*column + gap) break;
    left -= wanted.*column + gap;
    columns.*column = wanted.*column;
  }
  return columns;
}

void drawRow(const Model& model, Actions& actions, const CarriedTrajectory& trajectory, int i,
             const FigureColumns& columns) {
  const auto* way = model.trajectory_ways.of(static_cast<std::size_t>(i));
  const bool troubled = way != nullptr && (!way->problem.empty() || wallsOn(way) > 0);
  ImGui::PushID(i);
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  if (ImGui::Selectable("###trajectory", model.survey.trajectory == i,
                        ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowDoubleClick)) {
    actions.inspect(SurveyChoice{.trajectory = i});
    if (ImGui::IsMouseDoubleClicked(0)) actions.showTrajectory(static_cast<std::size_t>(i));
  }
  ui::tooltip(aboutTrajectory(way, trajectory));
  ImGui::SameLine(0, 0);
  ImGui::TextColored(colour(troubled ? tone::kWarning : tone::kStation), "%s", troubled ? ICON_WARNING : ICON_WALK);
  ImGui::SameLine();
  ui::fitted(trajectory.name, ImGui::GetContentRegionAvail().x);
  if (columns.length > 0) {
    ImGui::TableNextColumn();
    ui::textRightAligned(lengthOf(way));
  }
  if (columns.duration > 0) {
    ImGui::TableNextColumn();
    ui::textRightAligned(durationOf(way));
  }
  ImGui::TableNextColumn();
  ui::textRightAligned(trajectory.scans.empty() ? "–" : std::to_string(trajectory.scans.size()));
  ImGui::PopID();
}

void carrierRow(Actions& actions, TrajectoryEdit& edit, const CarriedTrajectory& trajectory,
                const Georeference& georeference) {
  ui::propertyLabel("Carrier");
  if (!ui::beginDropDown("###carrier", carrierName(trajectory.carrier).c_str())) return;
  for (const auto& carrier : kCarriers)
    if (ui::choice((tr(std::string(carrier.name)) + "###carrier-" + std::string(carrier.id)).c_str(),
                   carrier.id == trajectory.carrier) &&
        carrier.id != trajectory.carrier) {
      CarriedTrajectory changed = trajectory;
      changed.carrier = carrier.id;
      startEdit(actions, edit.common, changeTo(changed, georeference),
                trf("Change carrier of trajectory {}", trajectory.name));
    }
  ui::endDropDown();
}

void figureRows(Actions& actions, TrajectoryEdit& edit, const CarriedTrajectory& trajectory,
                const Georeference& georeference) {
  const Carrier* const own = carrierOf(trajectory.carrier);
  const PathLimits limits = own == nullptr ? PathLimits() : own->limits;
  const auto usual_height = trf("usual, {:.2f} m", limits.height_m),
             usual_speed = trf("usual, {:.1f} m/s", limits.speed_mps);
  ui::propertyLabel("Above floor");
  bool changed =
      ui::numberField("###carried-height", edit.height_m,
                      {.kind = {.unit = "m", .least = 0, .most = 1000}, .decimals = 2, .zero = usual_height.c_str()},
                      "Height of the scanner above the floor; 0 is the carrier's usual one");
  ui::propertyLabel("Speed at most");
  changed =
      ui::numberField("###carried-speed", edit.speed_mps,
                      {.kind = {.unit = "m/s", .least = 0, .most = 100}, .decimals = 2, .zero = usual_speed.c_str()},
                      "It is slower in bends; 0 is the carrier's usual one") ||
      changed;
  if (!changed) return;
  CarriedTrajectory other = trajectory;
  other.height_m = edit.height_m, other.speed_mps = edit.speed_mps;
  startEdit(actions, edit.common, changeTo(other, georeference), trf("Change pace of trajectory {}", trajectory.name));
}

// As many rows while the way is still worked out as when it is known: nothing moves under the pointer.
void drawFacts(const TrajectoryWay* way, const CarriedTrajectory& trajectory) {
  if (way == nullptr || isKnown(way)) {
    ui::property("Length", lengthOf(way));
    ui::property("Duration", durationOf(way));
    const bool stands = isKnown(way) && way->seconds <= 0;
    if (!stands) ui::property("Mean speed", isKnown(way) ? figures("{:.2f} m/s", way->length_m / way->seconds) : "…");
  }
  if (!trajectory.file.empty()) ui::property("File", trajectory.file);
}

// The closed doors on the way, or all else that it goes through, each to be looked at by a click.
void drawPlaces(Actions& actions, const TrajectoryWay& way, bool doors) {
  constexpr std::size_t kMost = 20;
  std::size_t count = 0;
  for (std::size_t i = 0; i < way.obstacles.size(); ++i) {
    const auto& obstacle = way.obstacles[i];
    if (obstacle.closed_door != doors || ++count > kMost) continue;
    ImGui::PushID(static_cast<int>(i));
    if (ImGui::Selectable("###obstacle")) bringNear(actions, obstacle.place_m);
    ui::tooltip("Frame in view");
    ImGui::SameLine(0, 0);
    ImGui::TextColored(colour(doors ? tone::kDim : tone::kWarning), "%s", doors ? ICON_INFO : ICON_WARNING);
    ImGui::SameLine();
    ui::fitted(trf("{} after {:.1f} s", withReadableClasses(way.obstacle_products[i]), obstacle.after_s),
               ImGui::GetContentRegionAvail().x);
    ImGui::PopID();
  }
  if (count > kMost) ui::dimText(trf("and {} more", count - kMost));
}

// What is wrong with the way.
void drawTrouble(const Model& model, Actions& actions, const TrajectoryWay& way) {
  if (!way.problem.empty()) {
    ImGui::PushStyleColor(ImGuiCol_Text, tone::kBad);
    ui::wrapped(way.problem);
    ImGui::PopStyleColor();
  }
  if (wallsOn(&way) == 0) return;
  ui::heading(model, trf("Goes through  {}", wallsOn(&way)).c_str());
  drawPlaces(actions, way, false);
}

// A mover that has opened them before any scan begins.
MoverOptions openingOf(const Model& model, const TrajectoryWay& way, const std::string& trajectory) {
  constexpr double kLongBefore_s = -60;
  const auto& movers = model.session.document().job->movers;
  MoverOptions options{.add = trf("Doors of {}", trajectory), .kind = "door", .begin_s = kLongBefore_s};
  for (int i = 2; std::any_of(movers.begin(), movers.end(), [&](const Mover& m) { return m.name == *options.add; });
       ++i)
    options.add = fmt::format("{} {}", trf("Doors of {}", trajectory), i);
  for (const auto& obstacle : way.obstacles)
    if (obstacle.closed_door) options.products.push_back(model.environment()->products[obstacle.product].id);
  return options;
}

// No fault of the way: who walks there opens them.
void drawClosedDoors(const Model& model, Actions& actions, const TrajectoryWay& way, const std::string& trajectory) {
  if (way.closedDoors() == 0) return;
  ui::heading(model, trf("Closed doors  {}", way.closedDoors()).c_str());
  ui::dimWrapped("A scan finds them closed, as the model has them.");
  drawPlaces(actions, way, true);
  if (ui::button(ICON_WALK "  Open for scans###open-doors", model.session.whyNot("mover"), {-FLT_MIN, 0},
                 "Adds a mover that holds them open in every scan; undo closes them again"))
    actions.start(openingOf(model, way, trajectory), trf("Open the doors of {}", trajectory));
}

std::string waypointLine(const Model& model, const Waypoint& waypoint, std::size_t number) {
  const Eigen::Vector3d p = waypoint.floor_m + model.shift_m();
  std::string text = figures("{}   {:.2f}  {:.2f}  {:.2f}", number, p.x(), p.y(), p.z());
  if (waypoint.stop_s > 0) text += "   " + trf("stops {:.3g} s", waypoint.stop_s);
  if (waypoint.look_rad) text += "   " + trf("looks {:.0f}°", *waypoint.look_rad / kRadPerDeg);
  return text;
}

void fillWaypoint(const Model& model, TrajectoryEdit& edit, const Waypoint& waypoint, int index) {
  edit.waypoint = index;
  edit.at = waypoint.floor_m + model.shift_m();
  edit.stop_s = waypoint.stop_s;
  edit.looks = waypoint.look_rad.has_value();
  edit.look_deg = waypoint.look_rad.value_or(0) / kRadPerDeg;
}

// True when one of them has become another.
bool waypointRows(TrajectoryEdit& edit) {
  bool changed = false;
  static constexpr const char* kAxes[] = {"X", "Y", "Z"};
  for (Eigen::Index i = 0; i < 3; ++i) {
    ui::propertyLabel(kAxes[i]);
    changed = ui::numberField(fmt::format("###waypoint-{}", kAxes[i]).c_str(), edit.at[i], kMetres) || changed;
  }
  ui::propertyLabel("Stop");
  changed = ui::numberField("###waypoint-stop", edit.stop_s,
                            {.kind = {.unit = "s", .least = 0, .most = 3600}, .decimals = 1, .zero = "none"},
                            "How long the carrier stands here") ||
            changed;
  ui::propertyLabel("Look ahead");
  bool ahead = !edit.looks;
  if (ui::checkbox("###look-ahead", &ahead)) edit.looks = !ahead, changed = true;
  ui::tooltip("Off: from here to the next waypoint the scanner looks in a direction of its own");
  if (!edit.looks) return changed;
  ui::propertyLabel("Look towards");
  return ui::numberField("###waypoint-look", edit.look_deg,
                         {.kind = {.unit = "°", .least = -360, .most = 360}, .decimals = 1, .drag = 0.5},
                         "Counter-clockwise from the file's X") ||
         changed;
}

// Between this one and the next; after the last one a metre further on.
Waypoint after(const std::vector<Waypoint>& waypoints, std::size_t i) {
  const Eigen::Vector3d here = waypoints[i].floor_m;
  if (i + 1 < waypoints.size()) return {(here + waypoints[i + 1].floor_m) / 2, 0, {}};
  const Eigen::Vector3d way = here - waypoints[i - 1].floor_m;
  return {here + way.normalized(), 0, {}};
}

void drawWaypoint(const Model& model, TrajectoryEdit& edit, Actions& actions, const CarriedTrajectory& trajectory,
                  std::size_t i, const std::string& why) {
  const auto& georeference = *model.session.document().georeference;
  if (edit.waypoint != static_cast<int>(i)) fillWaypoint(model, edit, trajectory.waypoints[i], static_cast<int>(i));
  CarriedTrajectory changed = trajectory;
  if (ui::beginProperties("waypoint", 0.36F)) {
    ImGui::BeginDisabled(!why.empty());
    if (waypointRows(edit)) {
      Waypoint& waypoint = changed.waypoints[i];
      waypoint = {edit.at - model.shift_m(), edit.stop_s, {}};
      if ((waypoint.floor_m - trajectory.waypoints[i].floor_m).norm() < 1e-6)
        waypoint.floor_m = trajectory.waypoints[i].floor_m;
      if (edit.looks) waypoint.look_rad = edit.look_deg * kRadPerDeg;
      startEdit(actions, edit.common, changeTo(changed, georeference),
                trf("Change waypoint {} of {}", i + 1, trajectory.name));
    }
    ImGui::EndDisabled();
    ui::endProperties();
  }
  const float half = columnWidth(2);
  if (smallButton(ICON_ADD, "Insert after", "insert-waypoint", half, why, "Adds a waypoint half-way to the next one")) {
    changed.waypoints.insert(changed.waypoints.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                             after(trajectory.waypoints, i));
    startEdit(actions, edit.common, changeTo(changed, georeference), trf("Add waypoint to {}", trajectory.name));
  }
  ImGui::SameLine();
  const auto why_not_remove = !why.empty()                      ? why
                              : trajectory.waypoints.size() > 2 ? ""
                                                                : "A trajectory has at least two waypoints";
  if (smallButton(ICON_TRASH, "Remove", "remove-waypoint", half, why_not_remove, "Remove waypoint")) {
    changed.waypoints.erase(changed.waypoints.begin() + static_cast<std::ptrdiff_t>(i));
    startEdit(actions, edit.common, changeTo(changed, georeference),
              trf("Remove waypoint {} of {}", i + 1, trajectory.name));
  }
}

void drawWaypoints(const Model& model, TrajectoryEdit& edit, Actions& actions, const CarriedTrajectory& trajectory,
                   const std::string& why) {
  if (trajectory.waypoints.empty()) return;
  ui::heading(model, trf("Waypoints  {}", trajectory.waypoints.size()).c_str());
  const int chosen = model.survey.waypoint;
  if (ImGui::BeginChild("waypoints", {0, listHeight(model, trajectory.waypoints.size()) - model.px(16)})) {
    for (int i = 0; i < static_cast<int>(trajectory.waypoints.size()); ++i) {
      const auto number = static_cast<std::size_t>(i);
      const auto line = waypointLine(model, trajectory.waypoints[number], number + 1);
      if (ImGui::Selectable(fmt::format("{}###waypoint{}", line, i).c_str(), chosen == i))
        actions.choose(SurveyChoice{.trajectory = model.survey.trajectory, .waypoint = i});
    }
  }
  ImGui::EndChild();
  if (chosen >= 0 && chosen < static_cast<int>(trajectory.waypoints.size()))
    drawWaypoint(model, edit, actions, trajectory, static_cast<std::size_t>(chosen), why);
  else
    ui::dimWrapped("Select a waypoint here or in the view to edit it. Drag it in the view to move it.");
}

void drawTrajectoryButtons(const Model& model, Actions& actions, const CarriedTrajectory& trajectory,
                           const TrajectoryWay* way, const std::string& why) {
  std::string why_no_scan = model.session.whyNot("scan");
  if (why_no_scan.empty() && way != nullptr) why_no_scan = way->problem;
  if (ui::button(ICON_PLAY "  Scan along this trajectory…###scan-along", why_no_scan, {-FLT_MIN, 0},
                 "Open the Scan panel")) {
    CarriedScan scan = model.carried_scan;
    scan.wanted = true;
    actions.set(scan);
    actions.run("scan");
  }
  const float width = columnWidth(3);
  if (smallButton(ICON_CROSSHAIRS, "Look", "look-trajectory", width, {},
                  "All of it from above; what would hide it is cut away"))
    actions.showTrajectory(static_cast<std::size_t>(model.survey.trajectory));
  ImGui::SameLine();
  const std::string why_no_export = way != nullptr ? way->problem : std::string();
  if (smallButton(ICON_EXPORT, "Export…", "export-trajectory", width, why_no_export, "Write its poses to a file"))
    askForExport(actions, trajectory.name);
  ImGui::SameLine();
  if (smallButton(ICON_TRASH, "Remove", "remove-trajectory", width, why, "Remove trajectory; its scans stay"))
    actions.start(TrajectoryOptions{.remove = trajectory.name}, trf("Remove trajectory {}", trajectory.name));
}

// When, along the way, the instrument is drawn in the view.
void drawMoment(const Model& model, Actions& actions, const CarriedTrajectory& trajectory, const TrajectoryWay* way) {
  if (way != nullptr && (!way->motion.truth || way->seconds <= 0)) return;
  if (ui::beginProperties("moment", 0.36F)) {
    ui::propertyLabel("Time");
    double after_s = shownMoment_s(model);
    const double seconds = way == nullptr ? 1 : way->seconds;
    const NumberFormat format{.kind = {.unit = "s", .least = 0, .most = seconds}, .decimals = 1};
    ImGui::BeginDisabled(way == nullptr);
    if (ui::numberSlider("###path-moment", after_s, 0, seconds, format,
                         "When the instrument is drawn along the way. Left and Right step by half a second."))
      actions.showMoment(trajectory.name, after_s);
    ImGui::EndDisabled();
    ui::endProperties();
  }
  const auto& style = ImGui::GetStyle();
  const float follow = ImGui::GetFrameHeight() + style.ItemInnerSpacing.x + ImGui::CalcTextSize(tr("Follow").c_str()).x;
  actions.button("play-trajectory", model.path_moment.plays ? "Stop" : "Play",
                 ImGui::GetContentRegionAvail().x - follow - style.ItemSpacing.x);
  ImGui::SameLine();
  bool follows = model.path_moment.follows;
  if (ui::checkbox("Follow###follow-bearer", &follows)) actions.followBearer(follows);
  ui::tooltip("While it plays, the view goes along behind the scanner until you move it");
}

CoverageOptions coverageOf(const Model& model, const CarriedTrajectory& trajectory) {
  constexpr std::size_t kSamples = 60000;  // so that blind spots are drawn by squares of some 40 cm in a house
  const CarriedScan& scan = model.carried_scan;
  return {.trajectories = {trajectory.name},
          .instrument = scan.choice.instrument,
          .settings = scan.choice.settings,
          .trajectory_error = scan.error,
          .closures = scan.closures ? Switch::on : Switch::off,
          .anchors = scan.anchors ? Switch::on : Switch::off,
          .samples = kSamples};
}

void drawShares(const CoverageAnswer& answer) {
  if (!ui::beginProperties("blind", 0.5F)) return;
  const auto row = [](const char* label, double area_m2) {
    if (area_m2 > 0) ui::property(label, figures("{:.1f} m²", area_m2));
  };
  row("Seen twice", answer.twice_m2);
  row(wordsOf(Blindness::passed_by), answer.passed_by_m2);
  row(wordsOf(Blindness::sparse), answer.sparse_m2);
  row(wordsOf(Blindness::grazing), answer.grazing_m2);
  row(wordsOf(Blindness::out_of_view), answer.out_of_view_m2);
  row(wordsOf(Blindness::out_of_range), answer.out_of_range_m2);
  row(wordsOf(Blindness::occluded), answer.occluded_m2);
  row(wordsOf(Blindness::unreachable), answer.unreachable_m2);
  ui::endProperties();
}

void drawPathCoverage(const Model& model, Actions& actions, const CarriedTrajectory& trajectory,
                      const TrajectoryWay* way) {
  ui::heading(model, "Coverage");
  const auto* instrument = model.instrument(model.carried_scan.choice.instrument);
  std::string why = model.session.whyNot("coverage");
  if (why.empty() && instrument == nullptr) why = "Choose an instrument in the Scan panel first";
  if (why.empty() && way != nullptr) why = way->problem;
  if (ui::button(ICON_EYE "  Compute coverage###coverage-along", why, {-FLT_MIN, 0},
                 "What is covered along this trajectory, and why the rest is blind"))
    actions.start(coverageOf(model, trajectory), trf("Coverage along {}", trajectory.name));
  if (instrument != nullptr)
    ui::dimText(trf("{} {}, as chosen for scans along trajectories", instrument->maker, instrument->model));
  const auto* last = model.session.lastOf("coverage");
  const auto* answer = last == nullptr ? nullptr : answerAs<CoverageAnswer>(last->answer);
  if (answer == nullptr || answer->trajectories.size() != 1 || answer->trajectories[0].trajectory != trajectory.name)
    return;
  if (model.session.isOutOfDate(*last)) ui::dimWrapped("Coverage is out of date. Compute it again.");
  ui::meter(model, answer->coverage, tone::kGood);
  ui::dimText(
      trf("{} of {:.0f} m² of exposed surface", fmt::format("{:.0f} %", answer->coverage * 100), answer->exposed_m2));
  drawShares(*answer);
  if (!answer->blind.empty()) actions.button("holes-plan", "Show blind spots on the plan", -FLT_MIN);
}

}  // namespace

void drawTrajectories(const Model& model, Actions& actions) {
  const auto job = model.session.document().job;  // a copy: a button may change it
  ui::heading(model, trf("Trajectories  {}", job->trajectories.size()).c_str());
  const auto why = model.session.whyNot("trajectory");
  const float half = columnWidth(2);
  if (ui::button(ui::fittingLabel(ICON_WALK, "Add trajectory", "add-trajectory", half).c_str(), why, {half, 0},
                 "Click the waypoints of a path for a scanner that is carried"))
    actions.run("add-trajectory");
  ImGui::SameLine();
  if (ui::button(ui::fittingLabel(ICON_IMPORT, "Import…", "import-trajectory", half).c_str(), why, {half, 0},
                 "A recorded trajectory: CSV, SBET, TUM, KITTI, EuRoC or HELIOS++"))
    askForImport(model, actions);
  if (job->trajectories.empty()) {
    ui::dimWrapped("No trajectories. They carry mobile scanners.");
    return;
  }
  const auto columns = columnsBeside(model, *job);
  const int count = 2 + static_cast<int>(columns.length > 0) + static_cast<int>(columns.duration > 0);
  if (!ImGui::BeginTable(fmt::format("trajectories-{}", count).c_str(), count,
                         ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg,
                         {0, listHeight(model, job->trajectories.size())}))
    return;
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn(ui::Label("Name"), ImGuiTableColumnFlags_WidthStretch);
  const auto setUp = [](const char* label, float width) {
    if (width > 0) ImGui::TableSetupColumn(ui::Label(label), ImGuiTableColumnFlags_WidthFixed, width);
  };
  setUp("Length", columns.length);
  setUp("Duration", columns.duration);
  setUp("Scans", columns.scans);
  ImGui::TableHeadersRow();
  for (int i = 0; i < static_cast<int>(job->trajectories.size()); ++i)
    drawRow(model, actions, job->trajectories[static_cast<std::size_t>(i)], i, columns);
  ImGui::EndTable();
}

void drawTrajectory(const Model& model, PanelStates& states, Actions& actions, const CarriedTrajectory& trajectory) {
  auto& edit = states.of<TrajectoryEdit>();
  if (begins(edit.common, &trajectory, actions)) {
    edit.common.name = trajectory.name;
    edit.height_m = trajectory.height_m, edit.speed_mps = trajectory.speed_mps;
    edit.waypoint = -1;
  }
  const auto& georeference = *model.session.document().georeference;
  const auto* way = model.trajectory_ways.of(static_cast<std::size_t>(model.survey.trajectory));
  const auto why = model.session.whyNot("trajectory");
  ui::heading(model, trf("Trajectory {}", trajectory.name).c_str());
  if (ui::beginProperties("trajectory", 0.36F)) {
    ImGui::BeginDisabled(!why.empty());
    if (nameRow(model, actions, edit.common)) {
      TrajectoryOptions options{.rename = trajectory.name, .name = edit.common.name};
      startEdit(actions, edit.common, options, trf("Rename trajectory {}", trajectory.name));
    }
    if (trajectory.file.empty()) {
      carrierRow(actions, edit, trajectory, georeference);
      figureRows(actions, edit, trajectory, georeference);
    }
    ImGui::EndDisabled();
    drawFacts(way, trajectory);
    ui::endProperties();
  }
  drawProblem(edit.common);
  if (way != nullptr) drawTrouble(model, actions, *way);
  drawTrajectoryButtons(model, actions, trajectory, way, why);
  drawMoment(model, actions, trajectory, way);
  if (way != nullptr) drawClosedDoors(model, actions, *way, trajectory.name);
  drawPathCoverage(model, actions, trajectory, way);
  drawWaypoints(model, edit, actions, trajectory, why);
  drawScans(model, actions, trajectory.scans, [&](const Scan& scan) { return ageText(scan, trajectory); });
}

}  // namespace standpoint
