// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/motion/carriers.h"
#include "core/number_text.h"
#include "core/output_place.h"
#include "core/units.h"
#include "project/survey/clicked_places.h"
#include "project/survey/error_profile.h"
#include "project/survey/survey_verbs.h"
#include "survey/instruments.h"
#include "survey/trajectories/carried_motion.h"
#include "survey/trajectories/trajectory_file.h"

namespace standpoint {

namespace {

auto trajectoryAt(Job& job, const std::string& name) {
  return std::find_if(job.trajectories.begin(), job.trajectories.end(),
                      [&](const CarriedTrajectory& t) { return t.name == name; });
}

tl::unexpected<Error> noTrajectory(const Job& job, const std::string& name) {
  std::string names;
  for (const auto& t : job.trajectories) names += (names.empty() ? "" : ", ") + t.name;
  return failure(ErrorKind::usage,
                 fmt::format("unknown trajectory '{}'; available: {}", name, names.empty() ? "none" : names));
}

Result<void> checkTrajectoryName(Job& job, const std::string& name, const char* option) {
  if (name.empty() || name.find_first_of("/\\:,\"\n") != std::string::npos)
    return failure(ErrorKind::usage, fmt::format("'{}' cannot be a trajectory's name", name), option);
  if (trajectoryAt(job, name) != job.trajectories.end())
    return failure(ErrorKind::usage, fmt::format("there is a trajectory '{}' already", name), option);
  return {};
}

double heightOf(const CarriedTrajectory& t) { return carriedHeight_m(t.carrier, t.height_m); }

Result<std::vector<Waypoint>> waypointsFrom(const RayScene& scene, const Georeference& g, const CarriedTrajectory& of,
                                            const std::vector<std::string>& through) {
  if (through.size() < 2)
    return failure(ErrorKind::usage, "specify at least two places as X,Y or X,Y,Z, or a file", "--through");
  return waypointsOf(through, scene, g, heightOf(of), "--through", of.waypoints);
}

Result<CarriedTrajectory> newTrajectory(const RayScene& scene, const Georeference& georeference,
                                        const TrajectoryOptions& options) {
  CarriedTrajectory made;
  made.name = *options.add;
  made.seed = options.seed.value_or(1);
  made.carrier = options.carrier;
  made.height_m = options.height_m.value_or(0);
  if (!options.file.empty()) {
    if (!options.through.empty()) return failure(ErrorKind::usage, "use either waypoints or a file", "--through");
    made.file = std::filesystem::absolute(options.file).lexically_normal().string();
    made.format = options.format;
    if (made.format.empty()) {
      TRY_ASSIGN(const auto* format, trajectoryFormatOf(options.file));
      if (format == nullptr)
        return failure(ErrorKind::usage, "the format of this trajectory is not known; state it with --format",
                       options.file.string());
      made.format = format->id;
    }
    return made;
  }
  if (made.carrier.empty()) made.carrier = "hand";
  made.speed_mps = options.speed_mps.value_or(0);
  TRY_ASSIGN(made.waypoints, waypointsFrom(scene, georeference, made, options.through));
  return made;
}

Result<CarriedTrajectory> changedTrajectory(const RayScene& scene, const Georeference& georeference,
                                            CarriedTrajectory changed, const TrajectoryOptions& options) {
  if (!changed.file.empty())
    return failure(ErrorKind::usage,
                   fmt::format("'{}' is what its file has; remove it and add the changed file", changed.name),
                   "--change");
  if (!options.file.empty()) return failure(ErrorKind::usage, "use either waypoints or a file", "--file");
  if (!options.carrier.empty()) changed.carrier = options.carrier;
  changed.height_m = options.height_m.value_or(changed.height_m);
  changed.speed_mps = options.speed_mps.value_or(changed.speed_mps);
  changed.seed = options.seed.value_or(changed.seed);
  if (options.through.empty()) return changed;
  TRY_ASSIGN(changed.waypoints, waypointsFrom(scene, georeference, changed, options.through));
  return changed;
}

// Of what it takes to go it; a trajectory that cannot be made is listed with the reason.
TrajectoryRow trajectoryRow(const CarriedTrajectory& t, const Georeference& g, Report& report, Progress& progress) {
  TrajectoryRow row{t.name, t.carrier, t.waypoints.size(), {}, {}, {}, t.file, t.scans.size()};
  Report of_file;
  const auto carried = carriedMotion(t, g, of_file, progress);
  if (!carried) {
    report.warn(t.name, describe(carried.error()));
    return row;
  }
  row.length_m = carried->length_m, row.seconds = carried->seconds();
  if (carried->seconds() > 0) row.mean_mps = carried->length_m / carried->seconds();
  return row;
}

// As it is found with an instrument: what a scan of the same seed places its points by.
Result<SolvedMotion> solvedFor(const Document& document, const CarriedTrajectory& trajectory,
                               const CarriedMotion& carried, const TrajectoryOptions& options, Report& report,
                               Progress& progress) {
  TRY_ASSIGN(const auto instrument, instrumentNamed(options.solved_for));
  if (!instrument.moving)
    return failure(ErrorKind::usage, "this instrument stands on a tripod, and has no trajectory", "--solved-for");
  TRY_ASSIGN(const auto settings, resolveMovingSettings(instrument, {}));
  const auto* const profile = errorProfile(options.trajectory_error, instrument.moving->mount);
  TRY_ASSIGN(auto solving, motionSolving(options, profile, *document.georeference, settings.max_range_m));
  solving.seed = options.error_seed;
  TRY_ASSIGN(const auto scene, RayScene::build(document.environment(), progress));
  TRY_ASSIGN(auto solved, solveMotion(carried, *scene, document.job->stations, trajectory.name, solving, progress));
  if (solved.pose) reportSolved(solved, trajectory.name, report);
  return solved;
}

Result<void> writeTrajectoryFile(const Document& document, const CarriedTrajectory& trajectory,
                                 const TrajectoryOptions& options, Report& report, Progress& progress) {
  const Georeference& g = *document.georeference;
  const TrajectoryFormat* const format =
      options.format.empty() ? trajectoryFormatFor(options.output) : trajectoryFormat(options.format);
  if (format == nullptr) {
    std::string known;
    for (const auto& f : trajectoryFormats()) known += (known.empty() ? "" : ", ") + std::string(f.extension);
    return failure(ErrorKind::usage,
                   fmt::format("unsupported format '{}'; use {}", options.output.extension().string(), known),
                   "--output");
  }
  TRY(checkFolderOf(options.output, "--output"));
  TRY_ASSIGN(const auto carried, carriedMotion(trajectory, g, report, progress));
  TRY_ASSIGN(const auto frame, fileFrame(g, format->id));
  SolvedMotion solved;
  if (!options.solved_for.empty()) {
    TRY_ASSIGN(solved, solvedFor(document, trajectory, carried, options, report, progress));
  }
  const PoseFunction& written = solved.pose ? *solved.pose : *carried.truth;
  TRY_ASSIGN(const auto lost, format->write(options.output, evenSamples(written, options.rate_hz), frame));
  report.append(lost);
  return {};
}

}  // namespace

const Fields<TrajectoryOptions>& trajectoryFields() {
  using O = TrajectoryOptions;
  static const Fields<O> fields = {
      {"add", &O::add, "name of a new trajectory, with --through or --file"},
      {"change", &O::change,
       "name of a trajectory that gets other places with --through, or another carrier, height, speed or seed"},
      {"through", &O::through,
       "places on the floor that it passes, X,Y or X,Y,Z in the model's own frame; X,Y:SECONDS stops there, "
       "X,Y:SECONDS:DEGREES looks that way from there on, counter-clockwise from X"},
      {"file", &O::file, "file of a recorded trajectory, instead: CSV, SBET, TUM, KITTI, EuRoC, HELIOS++"},
      {"format",
       &O::format,
       "of the file that is read or written, where its name and first lines do not say",
       {.choices = {"csv", "sbet", "tum", "euroc", "kitti", "helios", "helios-arinc"}}},
      {"carrier",
       &O::carrier,
       "what bears the scanner: pace, gait and shaking follow from it, and of a file who is in the scanner's sight",
       {.choices = {"hand", "backpack", "trolley", "vehicle", "uav"}}},
      {"height",
       &O::height_m,
       "of the scanner above the floor; without it, or 0, the carrier's",
       {.unit = "m", .minimum = 0, .maximum = 1000}},
      {"speed",
       &O::speed_mps,
       "at most; without it, or 0, the carrier's",
       {.unit = "m/s", .minimum = 0, .maximum = 100}},
      {"seed", &O::seed, "of gait and shaking; without it 1", {.minimum = 0, .maximum = 9007199254740991.0}},
      {"rename", &O::rename, "name of the trajectory that gets another --name"},
      {"name", &O::name, "its new name"},
      {"remove", &O::remove, "name of a trajectory to remove; its scans stay where they are"},
      {"write", &O::write, "name of a trajectory to write to --output"},
      {"output", &O::output, "file to write: .csv, .sbet, .tum, .kitti, .trj"},
      {"rate", &O::rate_hz, "samples of that file", {.unit = "Hz", .minimum = 1, .maximum = 10000}},
      {"solved-for", &O::solved_for,
       "id of an instrument: --write the trajectory as it is found with it, not as it is"},
      {"trajectory-error", &O::trajectory_error,
       "how such a trajectory errs; without it as the instrument's kind does"},
      {"closures", &O::closures, "off: places that the trajectory comes back to are not recognised"},
      {"anchors", &O::anchors, "on: scanned stations within 3 m of the trajectory hold it"},
      {"control", &O::control, "text file of control points that hold it where it stops: name X Y Z [sigma in mm]"},
      {"error-seed",
       &O::error_seed,
       "of its error: the seed of the scan that it belongs to",
       {.minimum = 0, .maximum = 9007199254740991.0}}};
  return fields;
}

const AnswerFields<TrajectoryRow>& answerFields(const TrajectoryRow*) {
  using A = TrajectoryRow;
  static const AnswerFields<A> fields = {
      {"name", &A::name},       {"carrier", &A::carrier},   {"waypoints", &A::waypoints}, {"length_m", &A::length_m},
      {"seconds", &A::seconds}, {"mean_mps", &A::mean_mps}, {"file", &A::file},           {"scans", &A::scans}};
  return fields;
}

const AnswerFields<TrajectoryAnswer>& answerFields(const TrajectoryAnswer*) {
  using A = TrajectoryAnswer;
  static const AnswerFields<A> fields = {{"trajectories", &A::trajectories}, {"file", &A::file, kLeftOut}};
  return fields;
}

std::string waypointText(const Waypoint& waypoint, const Georeference& georeference) {
  const Eigen::Vector3d p = waypoint.floor_m + georeference.shift_m;
  std::string text = exactText(p.x()) + "," + exactText(p.y()) + "," + exactText(p.z());
  if (waypoint.stop_s > 0 || waypoint.look_rad) text += ":" + exactText(waypoint.stop_s);
  if (waypoint.look_rad) text += ":" + exactText(*waypoint.look_rad / kRadPerDeg);
  return text;
}

Result<Answered<TrajectoryAnswer>> runTrajectory(const Document& document, const TrajectoryOptions& options,
                                                 Progress& progress) {
  progress.stage("Trajectory");
  int asked = 0;
  for (const auto* name : {&options.add, &options.change, &options.rename, &options.remove, &options.write})
    asked += static_cast<int>(name->has_value());
  if (asked > 1)
    return failure(ErrorKind::usage,
                   "specify one of --add NAME, --change NAME, --rename NAME, --remove NAME, --write NAME");
  if (!options.add && !options.change && (!options.through.empty() || !options.file.empty()))
    return failure(ErrorKind::usage, "name the trajectory with --add NAME, or --change NAME", "--add");
  if (options.write.has_value() == options.output.empty())
    return failure(ErrorKind::usage, "--write NAME and --output FILE belong together", "--output");
  Answered<TrajectoryAnswer> outcome{document};
  Job job = *document.job;
  const auto& g = *document.georeference;
  if (options.add || options.change) {
    if (options.add) TRY(checkTrajectoryName(job, *options.add, "--add"));
    const auto at = options.change ? trajectoryAt(job, *options.change) : job.trajectories.end();
    if (options.change && at == job.trajectories.end()) return noTrajectory(job, *options.change);
    TRY_ASSIGN(const auto scene, RayScene::build(document.environment(), progress));
    TRY_ASSIGN(auto made, options.add ? newTrajectory(*scene, g, options) : changedTrajectory(*scene, g, *at, options));
    TRY_ASSIGN(const auto carried, carriedMotion(made, g, outcome.report, progress));
    findObstacles(carried, *scene, g, made.name, openedDoors(job.movers), outcome.report);
    outcome.description = (options.add ? "Added trajectory " : "Changed trajectory ") + made.name;
    if (options.add)
      job.trajectories.push_back(std::move(made));
    else
      *at = std::move(made);
  } else if (options.rename || options.remove || options.write) {
    const std::string& name = options.rename ? *options.rename : options.remove ? *options.remove : *options.write;
    const auto at = trajectoryAt(job, name);
    if (at == job.trajectories.end()) return noTrajectory(job, name);
    if (options.rename) {
      if (options.name != name) TRY(checkTrajectoryName(job, options.name, "--name"));
      at->name = options.name;
      outcome.description = fmt::format("Renamed trajectory {} to {}", name, options.name);
    } else if (options.remove) {
      job.trajectories.erase(at);
      outcome.description = "Removed trajectory " + name;
    } else {
      TRY(writeTrajectoryFile(document, *at, options, outcome.report, progress));
      outcome.answer.file = options.output;
    }
  }
  for (const auto& t : job.trajectories)
    outcome.answer.trajectories.push_back(trajectoryRow(t, g, outcome.report, progress));
  if (options.add || options.change || options.rename || options.remove)
    outcome.document.job = std::make_shared<const Job>(std::move(job));
  return outcome;
}

}  // namespace standpoint
