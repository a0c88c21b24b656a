// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "core/units.h"
#include "project/answers.h"
#include "project/survey/station_placing.h"
#include "project/survey/station_row.h"
#include "project/survey/survey_verbs.h"
#include "survey/instruments.h"
#include "survey/scene/bodies.h"
#include "survey/stations/levelling.h"
#include "survey/stations/placement.h"
#include "survey/stations/station_places.h"
#include "survey/stations/survey_plan.h"

namespace standpoint {

namespace {

// What a station stands on and how it stands, as the options say it.
struct Setup {
  TripodStand stand;
  double trunnion_m = kUsualTrunnion_m, height_m = kUsualHeight_m;
  bool free = false;  // it hangs or is held: no ground is asked for
};

Result<Setup> setupFrom(const StationOptions& options) {
  Setup setup;
  TRY_ASSIGN(auto stand, readTripodStand(tripodStandFile()));
  setup.stand = stand;
  if (!options.instrument.empty()) {
    TRY_ASSIGN(const auto instrument, instrumentNamed(options.instrument));
    if (instrument.moving)
      return failure(
          ErrorKind::usage,
          fmt::format("the {} {} is carried and cannot be placed on a tripod", instrument.maker, instrument.model),
          "--instrument");
    setup.trunnion_m = instrument.trunnion_height_m;
    setup.height_m = instrument.tripod_height_m;
  }
  setup.height_m = options.height_m.value_or(setup.height_m);
  setup.free = options.stand == StationStand::free;
  return setup;
}

bool saysLevel(const StationOptions& options) { return options.tilt_deg || options.levelling_error_deg; }

// Turned by its yaw and then leant over by its tilt, as stated or drawn.
Eigen::Quaterniond standingRotation(const StationOptions& options, const std::string& name) {
  Tilt tilt{options.tilt_deg.value_or(0) * kRadPerDeg, options.tilt_towards_deg * kRadPerDeg};
  if (options.levelling_error_deg) tilt = drawnTilt(*options.levelling_error_deg * kRadPerDeg, options.seed, name);
  return rotationOf(options.yaw_deg * kRadPerDeg, tilt);
}

StationRow stationRow(const Station& s, const Georeference& g) {
  const Tilt tilt = tiltOf(s.true_pose.rotation);
  StationRow row{s.name,
                 s.true_pose.translation + g.shift_m,
                 s.instrument_height_m,
                 yawOf(s.true_pose.rotation),
                 tilt.angle_rad,
                 {},
                 {}};
  if (tilt.angle_rad > 0) row.tilt_towards_rad = tilt.towards_rad;
  for (const auto& scan : s.scans) row.scans.push_back({scan.instrument, scan.file, scan.points});
  return row;
}

// Beside other stations: what is not seen from any of them yet.
Result<std::optional<NextStation>> addingMost(const Document& document, const StationPlacement& placement,
                                              const GroundSearch& search, Progress& progress) {
  constexpr std::size_t kSamples = 12000;
  TRY_ASSIGN(const auto samples, sampleSurfaces(placement.scene(), kSamples, 1, progress));
  std::vector<std::uint8_t> seen;
  for (const auto& sample : samples.samples)
    seen.push_back(static_cast<std::uint8_t>(std::any_of(
        document.job->stations.begin(), document.job->stations.end(),
        [&](const Station& s) { return inSight(placement.scene(), s.true_pose.translation, sample.place, {}); })));
  return nextStation(*document.job, search, placement, samples, seen, {}, progress);
}

// Where nothing was said.
Result<Eigen::Vector3d> bestPlace(const Document& document, const StationPlacement& placement, double height_m,
                                  Report& report, Progress& progress) {
  const auto& scene = placement.scene();
  const GroundSearch search{document.walkable(), height_m, document.georeference->shift_m.z()};
  if (!document.job->stations.empty()) {
    TRY_ASSIGN(auto next, addingMost(document, placement, search, progress));
    if (next) return next->centre;
  }
  const auto worth = [&](const Eigen::Vector3d& centre) { return roomAround(scene, centre); };
  const auto grounds = groundsToTry(*document.job, scene, search);
  if (const auto chosen = bestOf(grounds, *document.job, placement, height_m, worth, progress)) return *chosen;
  if (const auto lowest = bestOf({groundWithoutFloor(scene)}, *document.job, placement, height_m, worth, progress)) {
    report.warn("station", "no free floor in the model: the tripod was placed at the model's lowest level");
    return *lowest;
  }
  TRY(progress.check());
  return failure(ErrorKind::unusable, "no free place found for the tripod; specify a place");
}

// The instrument's centre in the local frame, from --at or --on.
Result<Eigen::Vector3d> centreFrom(const RayScene& scene, const Georeference& g, const StationOptions& options,
                                   double height) {
  if (options.at) return *options.at - g.shift_m;
  const auto& on = *options.on;
  const double x = on.x_m - g.shift_m.x();
  const double y = on.y_m - g.shift_m.y();
  const auto floors = floorsAt(scene, x, y, height);
  const auto z = on.z_m ? std::optional(*on.z_m - g.shift_m.z()) : std::nullopt;
  auto chosen =
      floors.empty() ? Result<double>(failure(ErrorKind::unusable, "")) : chosenFloor(floors, on.z_m, g.shift_m.z());
  if (!chosen)
    if (const auto blocked = blockedFloorAt(scene, x, y, height, z))
      return failure(ErrorKind::unusable,
                     fmt::format("no room for the tripod at ({}, {}): {} is in the way, {:.2f} m above the floor at "
                                 "{:.2f}; {:.2f} m are needed; choose another place",
                                 on.x_m, on.y_m, productText(scene.environment().products[blocked->product]),
                                 blocked->free_m, blocked->floor_m + g.shift_m.z(), height + kRoomAbove_m));
  if (floors.empty())
    return failure(ErrorKind::unusable, fmt::format("no floor at ({}, {}) with {:.2f} m of free height for the tripod; "
                                                    "choose another place, or specify the instrument centre",
                                                    on.x_m, on.y_m, height + kRoomAbove_m));
  TRY_ASSIGN(const auto floor, chosen);
  return Eigen::Vector3d(x, y, floor + height);
}

tl::unexpected<Error> refused(const std::string& name, const Refusal& why) {
  return failure(ErrorKind::unusable, fmt::format("cannot place station {}: {}; {}", name, why.reason, why.remedy));
}

// Who gives the height of a floor to --at means --on: "" where no floor with room for the tripod is that near.
std::string onFloorRemedy(const StationPlacement& placement, const Eigen::Vector3d& at, const Eigen::Vector3d& centre,
                          double height) {
  constexpr double kSameFloor_m = 0.25;
  for (const auto floor : floorsAt(placement.scene(), centre.x(), centre.y(), height)) {
    if (std::abs(floor - centre.z()) > kSameFloor_m || placement.whyNot({centre.x(), centre.y(), floor + height}))
      continue;
    return fmt::format(
        "if {} is the height of the floor, specify the place on the floor (--on {},{},{}), to which the tripod adds "
        "its height",
        at.z(), at.x(), at.y(), at.z());
  }
  return {};
}

// `before` is what moves: where no place is said but a tilt is, it stays where it is.
Result<Station> standing(const Document& document, const RayScene& scene, const std::string& name,
                         const StationOptions& options, const Station* before, Report& report, Progress& progress) {
  if (options.at && options.on)
    return failure(ErrorKind::usage, "specify either --at X,Y,Z (instrument centre) or --on X,Y[,Z] (floor)");
  TRY_ASSIGN(const auto setup, setupFrom(options));
  const StationPlacement placement(scene, setup.stand, setup.trunnion_m);
  const bool somewhere = options.at || options.on;
  const bool stays = !somewhere && before != nullptr && saysLevel(options);
  if (!setup.free && !options.at && !stays)
    if (auto why = placement.badHeight(setup.height_m)) return refused(name, *why);
  TRY_ASSIGN(auto centre, stays       ? Result<Eigen::Vector3d>(before->true_pose.translation)
                          : somewhere ? centreFrom(scene, *document.georeference, options, setup.height_m)
                                      : bestPlace(document, placement, setup.height_m, report, progress));
  if (auto why = setup.free ? placement.tooNear(centre) : placement.whyNot(centre)) {
    if (options.at && !setup.free)
      if (auto remedy = onFloorRemedy(placement, *options.at, centre, setup.height_m); !remedy.empty())
        why->remedy = std::move(remedy);
    return refused(name, *why);
  }
  if (const auto odd = placement.remark(centre)) report.warn(name, *odd);
  Station station;
  station.name = name;
  station.instrument_height_m = setup.height_m;
  if (const auto ground = placement.groundBelow(centre)) {
    station.instrument_height_m = centre.z() - ground->z;
    if (!ground->modelled() && !setup.free && somewhere)
      report.warn(name, "outside the model: the tripod is placed on ground at the model's lowest level");
  }
  station.true_pose.translation = centre;
  station.true_pose.rotation = standingRotation(options, name);
  return station;
}

std::vector<Station>::iterator find(Job& job, const std::string& name) {
  return std::find_if(job.stations.begin(), job.stations.end(), [&](const Station& s) { return s.name == name; });
}

tl::unexpected<Error> noStation(const Job& job, const std::string& name) {
  std::vector<std::string> names;
  for (const auto& s : job.stations) names.push_back(s.name);
  return failure(ErrorKind::usage, fmt::format("unknown station '{}'; available: {}", name,
                                               names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
}

// It becomes part of file names and of lists.
Result<void> checkStationName(Job& job, const std::string& name) {
  if (name.empty()) return failure(ErrorKind::usage, "a station needs a name");
  if (name.find_first_of(",/\\") != std::string::npos)
    return failure(ErrorKind::usage,
                   fmt::format("invalid station name '{}': commas and slashes are not allowed", name));
  if (find(job, name) != job.stations.end())
    return failure(ErrorKind::usage, fmt::format("station '{}' already exists; move it, or use another name", name));
  return {};
}

Result<void> checkRow(const StationOptions& options) {
  if (!options.row_to) {
    if (options.row_count || options.row_spacing_m)
      return failure(ErrorKind::usage, "a row needs both ends: --on X,Y[,Z] and --row-to X,Y[,Z]");
    return {};
  }
  if (!options.add || !options.on)
    return failure(ErrorKind::usage, "--row-to continues what --add NAME --on X,Y[,Z] begins");
  if (options.row_count.has_value() == options.row_spacing_m.has_value())
    return failure(ErrorKind::usage, "specify either --row-count or --row-spacing");
  return {};
}

// Those of a row that can stand; what is left out is in the report. Refused where none can.
Result<std::string> addRow(const Document& document, const RayScene& scene, Job& job, const StationOptions& options,
                           Answered<StationAnswer>& outcome, Progress& progress) {
  const auto &on = *options.on, &to = *options.row_to;
  const Eigen::Vector3d from(on.x_m, on.y_m, on.z_m.value_or(0)), end(to.x_m, to.y_m, to.z_m.value_or(from.z()));
  std::string name = *options.add, first, last;
  std::optional<Error> why;
  std::size_t added = 0;
  for (const auto& floor : rowPlaces(from, end, {options.row_count, options.row_spacing_m})) {
    StationOptions one = options;
    one.on = FloorPlace{floor.x(), floor.y(), on.z_m ? std::optional(floor.z()) : std::nullopt};
    auto station = placeStation(document, scene, name, one, outcome.report, progress);
    if (!station && station.error().kind != ErrorKind::unusable) return tl::unexpected(station.error());
    if (!station) {
      outcome.report.warn(name, "left out of the row: " + station.error().message);
      if (!why) why = station.error();
      continue;
    }
    if (added++ == 0) first = name, outcome.answer.placed = stationRow(*station, *document.georeference);
    last = name;
    job.stations.push_back(*std::move(station));
    name = nextStationName(job, name);
  }
  if (added == 0) return tl::unexpected(*why);
  return added == 1 ? "Added station " + first : fmt::format("Added {} stations: {} to {}", added, first, last);
}

}  // namespace

Result<Station> placeStation(const Document& document, const RayScene& scene, const std::string& name,
                             const StationOptions& options, Report& report, Progress& progress) {
  return standing(document, scene, name, options, nullptr, report, progress);
}

std::span<const Choice<StationStand>> choices(StationStand) {
  static constexpr std::array kStands = {Choice<StationStand>{"tripod", StationStand::tripod},
                                         Choice<StationStand>{"free", StationStand::free}};
  return kStands;
}

const Fields<StationOptions>& stationFields() {
  using O = StationOptions;
  static const Fields<O> fields = {
      {"add", &O::add, "name of a new station"},
      {"move", &O::move, "name of the station to move"},
      {"rename", &O::rename, "name of the station to rename"},
      {"name", &O::name, "its new name"},
      {"remove", &O::remove, "name of the station to remove"},
      {"at", &O::at, "X,Y,Z of the instrument's centre, in the file's frame", {.unit = "m", .label = "Centre at"}},
      {"on",
       &O::on,
       "X,Y[,Z] of the floor, to which the tripod adds its height; without Z the lowest floor with room",
       {.unit = "m", .label = "On the floor at"}},
      {"height",
       &O::height_m,
       "height of the instrument's centre above the floor (default: the instrument's, else 1.6)",
       {.unit = "m", .minimum = 0.1, .maximum = 10}},
      {"instrument", &O::instrument, "id or file of the instrument to set up, for its heights"},
      {"stand", &O::stand, "free: suspended or hand-held; only its clearance is checked"},
      {"tilt-deg",
       &O::tilt_deg,
       "tilt of the standing axis from the plumb line",
       {.unit = "deg", .minimum = 0, .maximum = 60}},
      {"tilt-towards-deg",
       &O::tilt_towards_deg,
       "direction of the tilt, counter-clockwise from the file's X",
       {.unit = "deg", .minimum = -360, .maximum = 360}},
      {"levelling-error-deg",
       &O::levelling_error_deg,
       "maximum of a tilt drawn by seed and name, instead of a stated one",
       {.unit = "deg", .minimum = 0, .maximum = 60}},
      {"seed", &O::seed, "seed of that tilt", {.minimum = 0, .maximum = 9007199254740991.0}},
      {"yaw-deg",
       &O::yaw_deg,
       "direction of the instrument's X axis, counter-clockwise from the file's X",
       {.unit = "deg", .minimum = -360, .maximum = 360}},
      {"row-to", &O::row_to, "X,Y[,Z] of the floor at the other end of a row that begins at `on`", {.unit = "m"}},
      {"row-count", &O::row_count, "number of stations of the row, both ends included", {.minimum = 2, .maximum = 100}},
      {"row-spacing",
       &O::row_spacing_m,
       "distance of the stations of the row, instead of their number",
       {.unit = "m", .minimum = 0.5, .maximum = 1000}}};
  return fields;
}

const AnswerFields<StationScan>& answerFields(const StationScan*) {
  using A = StationScan;
  static const AnswerFields<A> fields = {{"instrument", &A::instrument}, {"file", &A::file}, {"points", &A::points}};
  return fields;
}

const AnswerFields<StationRow>& answerFields(const StationRow*) {
  using A = StationRow;
  static const AnswerFields<A> fields = {{"name", &A::name},
                                         {"at", &A::at},
                                         {"instrument_height", &A::instrument_height_m},
                                         {"yaw_deg", &A::yaw_rad, answers::degrees},
                                         {"tilt_deg", &A::tilt_rad, answers::degrees},
                                         {"tilt_towards_deg", &A::tilt_towards_rad, answers::degrees, kLeftOut},
                                         {"scans", &A::scans}};
  return fields;
}

const AnswerFields<StationAnswer>& answerFields(const StationAnswer*) {
  using A = StationAnswer;
  static const AnswerFields<A> fields = {{"placed", &A::placed, kLeftOut}, {"stations", &A::stations}};
  return fields;
}

Result<Answered<StationAnswer>> runStation(const Document& document, const StationOptions& options,
                                           Progress& progress) {
  progress.stage("Station");
  const int asked = static_cast<int>(options.add.has_value()) + static_cast<int>(options.move.has_value()) +
                    static_cast<int>(options.rename.has_value()) + static_cast<int>(options.remove.has_value());
  if (asked > 1)
    return failure(ErrorKind::usage, "specify one of --add NAME, --move NAME, --rename NAME, --remove NAME");
  if (options.tilt_deg && options.levelling_error_deg)
    return failure(ErrorKind::usage, "use either --tilt-deg, or --levelling-error-deg for a random tilt");
  TRY(checkRow(options));
  Answered<StationAnswer> outcome{document};
  Job job = *document.job;
  const auto& g = *document.georeference;
  std::shared_ptr<const RayScene> scene;
  if (options.add || options.move) {
    TRY_ASSIGN(scene, RayScene::build(document.environment(), progress));
  }
  if (options.row_to) {
    TRY(checkStationName(job, *options.add));
    TRY_ASSIGN(outcome.description, addRow(document, *scene, job, options, outcome, progress));
  } else if (options.add) {
    const auto& name = *options.add;
    TRY(checkStationName(job, name));
    TRY_ASSIGN(auto station, placeStation(document, *scene, name, options, outcome.report, progress));
    outcome.answer.placed = stationRow(station, g);
    outcome.description = "Added station " + name;
    job.stations.push_back(std::move(station));
  } else if (options.move) {
    const auto& name = *options.move;
    const auto at = find(job, name);
    if (at == job.stations.end()) return noStation(job, name);
    TRY_ASSIGN(auto station, standing(document, *scene, name, options, &*at, outcome.report, progress));
    const double distance = (station.true_pose.translation - at->true_pose.translation).norm();
    station.scans = at->scans;
    *at = std::move(station);
    outcome.answer.placed = stationRow(*at, g);
    constexpr double kStays_m = 0.005;  // 0.00 m as it would be said
    outcome.description = distance < kStays_m ? fmt::format("Turned station {}", name)
                                              : fmt::format("Moved station {} by {:.2f} m", name, distance);
  } else if (options.rename) {
    const auto at = find(job, *options.rename);
    if (at == job.stations.end()) return noStation(job, *options.rename);
    if (options.name != at->name) TRY(checkStationName(job, options.name));
    at->name = options.name;
    outcome.answer.placed = stationRow(*at, g);
    outcome.description = fmt::format("Renamed station {} to {}", *options.rename, options.name);
  } else if (options.remove) {
    const auto& name = *options.remove;
    const auto at = find(job, name);
    if (at == job.stations.end()) return noStation(job, name);
    job.stations.erase(at);
    outcome.description = "Removed station " + name;
  }
  for (const auto& s : job.stations) outcome.answer.stations.push_back(stationRow(s, g));
  if (asked == 1) outcome.document.job = std::make_shared<const Job>(std::move(job));
  return outcome;
}

}  // namespace standpoint
