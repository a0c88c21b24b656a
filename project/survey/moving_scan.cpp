// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/survey/moving_scan.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

#include <fmt/format.h>

#include "core/motion/carriers.h"
#include "core/motion/paced_way.h"
#include "core/motion/rotation_vector.h"
#include "core/random.h"
#include "core/units.h"
#include "project/answers.h"
#include "project/survey/error_profile.h"
#include "project/survey/scan_header.h"
#include "project/survey/scan_request.h"
#include "project/survey/watched_sink.h"
#include "survey/scanning/scan_age.h"
#include "survey/scanning/scan_identity.h"
#include "survey/trajectories/carried_motion.h"
#include "survey/trajectories/trajectory_file.h"

namespace standpoint {

namespace {

namespace fs = std::filesystem;

constexpr double kWritten_hz = 200;  // of trajectories beside the points: chords of a gait stray by 9 micrometres

// Of the job, or of a file.
Result<CarriedTrajectory> trajectoryNamed(const Job& job, const std::string& name) {
  const auto found = std::find_if(job.trajectories.begin(), job.trajectories.end(),
                                  [&](const CarriedTrajectory& t) { return t.name == name; });
  if (found != job.trajectories.end()) return *found;
  std::error_code code;
  if (fs::is_regular_file(name, code)) {
    CarriedTrajectory of_file;
    of_file.name = fs::path(name).stem().string();
    of_file.file = name;
    of_file.carrier.clear();  // nobody has said
    return of_file;
  }
  return failure(ErrorKind::usage, fmt::format("unknown trajectory '{}', and no such file", name), "--trajectory");
}

// "x=0.1 yaw=2": place and turn on what carries it, and what its clock is ahead.
Result<Mounting> mountingFrom(const KeyValues& texts, const char* option) {
  static constexpr std::array<const char*, 7> kKeys = {"x", "y", "z", "roll", "pitch", "yaw", "clock"};
  std::array<double, 7> figures{};
  for (const auto& [key, text] : texts) {
    const auto at = std::find(kKeys.begin(), kKeys.end(), key);
    if (at == kKeys.end())
      return failure(ErrorKind::usage, fmt::format("'{}' must be x, y, z, roll, pitch, yaw or clock", key), option);
    const auto number = parseNumbers(text);
    if (!number || number->size() != 1)
      return failure(ErrorKind::usage, fmt::format("'{}' must be a number, not '{}'", key, text), option);
    figures[static_cast<std::size_t>(at - kKeys.begin())] = (*number)[0];
  }
  const EulerAngles angles{figures[3] * kRadPerDeg, figures[4] * kRadPerDeg, figures[5] * kRadPerDeg};
  return Mounting{{unitRotation(rotationOf(angles)), {figures[0], figures[1], figures[2]}}, figures[6]};
}

// Somebody on foot who holds the scanner, or has it on the back. A file says nothing of that by itself: only where its
// trajectory was added with a carrier.
Result<std::optional<ScanOperator>> operatorOf(const CarriedTrajectory& trajectory, const CarriedMotion& carried,
                                               bool on_foot, const ScanVerbOptions& options) {
  const Carrier* const carrier = carrierOf(trajectory.carrier);
  if (carrier == nullptr || carrier->gait <= 0) return std::nullopt;
  PoseFunctionPtr path = carried.path;
  if (!trajectory.file.empty() && !on_foot) {
    TRY_ASSIGN(path, wayOnFoot(*carried.truth));
  }
  return ScanOperator{.scanner_path = std::move(path),
                      .height_m = carriedHeight_m(trajectory.carrier, trajectory.height_m),
                      .in_front = carrier->id == "hand",
                      .ahead_s = options.movers_from_s.value_or(0)};
}

Result<void> writeTrajectory(const PoseFunction& function, const Georeference& georeference, fs::path beside,
                             const char* ending) {
  beside.replace_extension(ending);
  const TrajectoryFormat* const format = trajectoryFormat("csv");
  TRY_ASSIGN(const auto frame, fileFrame(georeference, format->id));
  TRY(format->write(beside, evenSamples(function, kWritten_hz), frame));
  return {};
}

// What of the trajectory decides the points, as a text.
std::string motionText(const CarriedTrajectory& trajectory, const CarriedMotion& carried, const SolvedMotion& solved,
                       const ErrorProfile* profile) {
  std::uint64_t hash = stableHash("standpoint trajectory");
  for (int k = 0; k <= 64; ++k) {
    const double time_s = carried.truth->first_s() + carried.seconds() * k / 64;
    for (const PoseFunctionPtr& function : {carried.truth, solved.pose}) {
      if (!function) continue;
      const Pose pose = function->pose(time_s);
      hash = stableHash(fmt::format("{} {} {} {} {} {}", pose.translation.x(), pose.translation.y(),
                                    pose.translation.z(), pose.rotation.x(), pose.rotation.y(), pose.rotation.z())
                            .c_str(),
                        hash);
    }
  }
  return fmt::format("trajectory={}, {:.1f} m in {:.1f} s, {}, {:08x}", trajectory.name, carried.length_m,
                     carried.seconds(), profile == nullptr ? "known exactly" : profile->id, hash & 0xFFFFFFFFU);
}

Result<CarriedMotion> motionOf(const CarriedTrajectory& trajectory, const Georeference& georeference,
                               const ScanSurroundings& company, Report& report, Progress& progress) {
  if (company.carried) return company.carried->motion;
  return carriedMotion(trajectory, georeference, report, progress);
}

// The stretches of the walk of which points are kept, as blocks of its pattern: all of it where nothing else is known.
std::vector<std::array<std::uint32_t, 2>> blocksKept(const ScanSurroundings& company, const ScanOptions& options,
                                                     std::uint32_t blocks, double seconds) {
  if (!company.carried) return {{options.first_column, options.end_column}};
  std::vector<std::array<std::uint32_t, 2>> kept;
  const auto at = [&](double time_s) {
    return static_cast<std::uint32_t>(
        std::clamp(std::round(blocks * time_s / seconds), 0.0, static_cast<double>(blocks)));
  };
  for (const auto& [from_s, to_s] : company.carried->recorded) kept.push_back({at(from_s), at(to_s)});
  return kept;
}

}  // namespace

Result<Answered<ScanAnswer>> runMovingScan(const Document& document, const ScanVerbOptions& options,
                                           const ScanSurroundings& company, Progress& progress) {
  const auto started = std::chrono::steady_clock::now();
  TRY_ASSIGN(auto request, scanRequestFrom(document, options));
  TRY_ASSIGN(const auto trajectory, trajectoryNamed(*document.job, options.trajectory));
  TRY_ASSIGN(const auto mounting, mountingFrom(options.mounting, "--mounting"));
  TRY_ASSIGN(const auto believed, mountingFrom(options.mounting_error, "--mounting-error"));
  const ErrorProfile* const profile =
      request.options.effects == Effects::none() && options.trajectory_error == TrajectoryError::of_instrument
          ? nullptr
          : errorProfile(options.trajectory_error, request.instrument.moving->mount);
  TRY_ASSIGN(auto solving, motionSolving(options, profile, *document.georeference, request.settings.max_range_m));
  solving.seed = request.options.seed;
  if (company.carried)
    solving.control.insert(solving.control.end(), company.carried->control.begin(), company.carried->control.end());
  Answered<ScanAnswer> outcome{document};
  Report& report = outcome.report;
  noteDefaultRules(document, report);
  progress.stage("Prepare " + trajectory.name, 0, 0.1);
  TRY_ASSIGN(const auto carried, motionOf(trajectory, *document.georeference, company, report, progress));
  if (company.carried) request.settings.firing_s *= company.carried->one_pulse_in;
  ScanSurroundings at_hand = company;
  const bool with_movers = options.movers == Switch::on;
  std::optional<ScanOperator> carries;
  if (options.operator_there == Switch::on) {
    TRY_ASSIGN(carries, operatorOf(trajectory, carried, company.carried != nullptr, options));
  }
  if (carries || !at_hand.preparation || !at_hand.preparation->fits(document, with_movers)) {
    TRY_ASSIGN(at_hand.preparation, prepareScan(document, nullptr, progress, with_movers, carries));
  }
  const RayScene& scene = *at_hand.preparation->scene;
  findObstacles(carried, scene, *document.georeference, trajectory.name,
                with_movers ? openedDoors(document.job->movers) : std::vector<std::string>(), report);
  progress.stage("Solve " + trajectory.name, 0.1, 0.15);
  TRY_ASSIGN(const auto solved,
             solveMotion(carried, scene, document.job->stations, trajectory.name, solving, progress));
  if (company.carried && company.carried->solved) company.carried->solved(carried, solved);
  const PoseFunction& known = solved.pose ? *solved.pose : *carried.truth;
  request.notes.push_back(motionText(trajectory, carried, solved, profile));
  if (options.deskew != Deskew::pulse)
    for (const auto& deskew : choices(options.deskew))
      if (deskew.value == options.deskew) request.notes.push_back(std::string("deskew=") + deskew.name);
  for (const auto& [key, text] : options.mounting) request.notes.push_back("mounting-" + key + "=" + text);
  for (const auto& [key, text] : options.mounting_error) request.notes.push_back("mounting-error-" + key + "=" + text);
  if (options.shard) request.notes.push_back(fmt::format("shard={}/{}", options.shard->index, options.shard->count));
  request.options.station_key = static_cast<std::uint32_t>(stableHash(trajectory.name.c_str()));
  request.settings.scan_seconds = carried.seconds();

  // Upright and at whole metres near the beginning: single precision is enough for the points, and the same place
  // whatever the error.
  const Pose start{Eigen::Quaterniond::Identity(),
                   carried.truth->pose(carried.truth->first_s()).translation.array().round().matrix()};
  Station as_station;
  as_station.name = trajectory.name;
  as_station.true_pose = start;
  const auto guid = guidOf(at_hand.preparation->fingerprint, as_station, start, request);
  const fs::path file = fileOf(request, as_station);
  ScanMotion motion{.true_pose = *carried.truth, .solved_pose = solved.pose.get()};
  motion.from_s = carried.truth->first_s(), motion.to_s = carried.truth->last_s();
  motion.deskew = options.deskew;
  motion.truth = mounting;
  motion.assumed = {mounting.body_from_device * believed.body_from_device,
                    mounting.clock_ahead_s + believed.clock_ahead_s};
  motion.local_from_points = start;
  if (options.shard) {
    const std::uint64_t blocks = blocksOf(request.instrument, request.settings, carried.seconds());
    request.options.first_column =
        static_cast<std::uint32_t>(blocks * (options.shard->index - 1) / options.shard->count);
    request.options.end_column = static_cast<std::uint32_t>(blocks * options.shard->index / options.shard->count);
  }

  progress.stage("Scan " + trajectory.name, 0.15, 1);
  TRY_ASSIGN(const auto writer, request.writer(file));
  ScanHeader header =
      scanHeader(document, at_hand.preparation->world, trajectory.name, start, guid, request, kFirstStart_gps_s);
  header.rows = header.columns = 0;
  const auto watched = company.watcher == nullptr ? nullptr : std::make_unique<WatchedSink>(*writer, *company.watcher);
  PointSink& sink = watched ? static_cast<PointSink&>(*watched) : *writer;
  TRY(sink.begin(header));
  ScanCount count;
  const auto all_blocks = blocksOf(request.instrument, request.settings, carried.seconds());
  for (const auto& [first, end] : blocksKept(company, request.options, all_blocks, carried.seconds())) {
    request.options.first_column = first, request.options.end_column = end;
    TRY_ASSIGN(const auto part, scan(scene, at_hand.preparation->world.assignment, request.instrument, request.settings,
                                     motion, request.options, sink, progress));
    count.pulses += part.pulses, count.returns += part.returns, count.points += part.points;
  }
  TRY(sink.end());
  TRY(writer->close());
  report.append(writer->report());
  TRY(writeTrajectory(known, *document.georeference, file, ".trajectory.csv"));
  if (options.truth) TRY(writeTrajectory(*carried.truth, *document.georeference, file, ".true.csv"));

  if (count.points == 0) report.warn(trajectory.name, "no surface is in range of the instrument along the trajectory");
  if (profile != nullptr) reportSolved(solved, trajectory.name, report);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  outcome.answer.stations.push_back(
      {trajectory.name, count.points, count.pulses, count.returns, seconds, carried.seconds(), file, std::nullopt});
  outcome.description =
      fmt::format("Scanned along {} with {} {}", trajectory.name, request.instrument.maker, request.instrument.model);
  Job job = *document.job;
  for (CarriedTrajectory& of_job : job.trajectories)
    if (of_job.name == trajectory.name && of_job.file == trajectory.file)
      of_job.scans.push_back({.instrument = request.instrument.id,
                              .file = fs::absolute(file).lexically_normal().string(),
                              .format = request.format->name,
                              .settings = request.settings.values,
                              .seed = request.options.seed,
                              .pulses = count.pulses,
                              .points = count.points,
                              .instrument_seconds = carried.seconds(),
                              .along = wayFingerprint(trajectory)});
  outcome.document.job = std::make_shared<const Job>(std::move(job));
  return outcome;
}

}  // namespace standpoint
