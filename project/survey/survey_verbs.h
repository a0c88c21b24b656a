// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "project/answers.h"
#include "project/fields.h"
#include "scanners/engine/ray_engine.h"
#include "scanners/instruments/instrument.h"
#include "scanners/radiometry/atmosphere.h"
#include "scanners/radiometry/effects.h"
#include "scanners/radiometry/sun.h"
#include "survey/scanning/field_fault.h"
#include "survey/stations/surface_holes.h"
#include "survey/targets/target_placing.h"
#include "survey/targets/target_sight.h"

namespace standpoint {

enum class StationStand { tripod, free };  // free: it hangs or is held, and only its clearance is checked
std::span<const Choice<StationStand>> choices(StationStand);

// Of add, move, rename and remove at most one; none lists. Places in metres, the frame of the model's file.
struct StationOptions {
  std::optional<std::string> add, move, rename, remove;
  std::string name;                   // the new one, for `rename`
  std::optional<Eigen::Vector3d> at;  // the instrument's centre
  std::optional<FloorPlace> on;
  std::optional<double> height_m;
  std::string instrument;  // id; empty: the usual heights
  StationStand stand = StationStand::tripod;
  std::optional<double> tilt_deg;
  double tilt_towards_deg = 0;
  std::optional<double> levelling_error_deg;
  std::uint64_t seed = 1;
  double yaw_deg = 0;
  std::optional<FloorPlace> row_to;  // of what is added: a row from `on` to there
  std::optional<std::uint32_t> row_count;
  std::optional<double> row_spacing_m;
};
const Fields<StationOptions>& stationFields();

struct StationScan {
  std::string instrument, file;
  std::uint64_t points = 0;
};
const AnswerFields<StationScan>& answerFields(const StationScan*);
struct StationRow {
  std::string name;
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  // the instrument's centre, m, the model's file frame
  double instrument_height_m = 0;
  double yaw_rad = 0, tilt_rad = 0;
  std::optional<double> tilt_towards_rad;  // where it is tilted
  std::vector<StationScan> scans;
};
const AnswerFields<StationRow>& answerFields(const StationRow*);
struct StationAnswer {
  std::optional<StationRow> placed;  // what was added or moved
  std::vector<StationRow> stations;
};
const AnswerFields<StationAnswer>& answerFields(const StationAnswer*);
Result<Answered<StationAnswer>> runStation(const Document& document, const StationOptions& options, Progress& progress);

std::span<const Choice<TargetKind>> choices(TargetKind);

// Places in metres, the frame of the model's file.
struct TargetOptions : TargetPlace {
  std::optional<std::string> add, move, rename, remove;
  std::string name;  // the new one, for `rename`
  std::string type;  // article; empty: the first of the kind
  std::optional<TargetKind> kind;
  std::optional<double> size_m;
  bool sight = false;
  std::string instrument;
  KeyValues settings;
};
const Fields<TargetOptions>& targetFields();

struct TargetAnswerRow {
  std::string name, kind;
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  // its centre, m, the model's file frame
  double size_m = 0;
  std::optional<Eigen::Vector3d> normal;  // of a checkerboard
  std::optional<std::string> stands_on;   // of one that was added
};
const AnswerFields<TargetAnswerRow>& answerFields(const TargetAnswerRow*);
const AnswerFields<TargetSight>& answerFields(const TargetSight*);
using TargetSights = std::vector<TargetSight>;  // by station
struct TargetAnswer {
  std::optional<TargetAnswerRow> placed;
  std::optional<std::variant<TargetSights, std::map<std::string, TargetSights>>> seen_from;  // of placed, or by target
  std::vector<TargetAnswerRow> targets;
};
const AnswerFields<TargetAnswer>& answerFields(const TargetAnswer*);
Result<Answered<TargetAnswer>> runTarget(const Document& document, const TargetOptions& options, Progress& progress);

// "all", or names separated by commas.
struct StationNames {
  std::vector<std::string> names;  // empty: all
};
template <>
struct FieldValue<StationNames> {
  static constexpr auto kKind = ParameterKind::text;
  static void describe(Parameter&) {}
  static Result<StationNames> read(const nlohmann::json& text);
  static nlohmann::json write(const StationNames& stations);
};

// "i/n": every n-th station from the i-th; 1 <= i <= n.
struct Shard {
  unsigned index = 1, count = 1;
};
template <>
struct FieldValue<Shard> {
  static constexpr auto kKind = ParameterKind::text;
  static void describe(Parameter&) {}
  static Result<Shard> read(const nlohmann::json& text);
  static nlohmann::json write(const Shard& shard);
};

// What the stations' scans would bring, before they are made: coverage, overlap, points, time, and a place for another
// one.
struct PlanOptions {
  StationNames stations;
  std::string instrument;
  KeyValues settings;
  std::optional<double> spacing_m, max_incidence_deg, max_range_m;  // what counts as seen; nothing: SeenWhen's own
  std::size_t samples = 40000;
  std::uint64_t seed = 1;
};
const Fields<PlanOptions>& planFields();

struct PlanCoverage {
  double exposed_m2 = 0;
  double seen_m2 = 0, twice_m2 = 0;  // by one station, by two or more
  double coverage = 0;               // 0..1, of what is exposed
};
const AnswerFields<PlanCoverage>& answerFields(const PlanCoverage*);
struct PlanClass : PlanCoverage {
  std::string ifc_class;
};
const AnswerFields<PlanClass>& answerFields(const PlanClass*);
struct PlanStorey : PlanCoverage {
  std::string storey;
};
const AnswerFields<PlanStorey>& answerFields(const PlanStorey*);
struct PlanHole : PlanCoverage, ProductIdentity {
  double unseen_m2 = 0;
};
const AnswerFields<PlanHole>& answerFields(const PlanHole*);
// A part of a surface that no station sees, or that is blind from trajectories.
struct PlanPatch : ProductIdentity {
  double area_m2 = 0;
  std::optional<double> spacing_m;               // of the points on what is seen of the product; nothing: all is hidden
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  // on it, near its middle; the model's file frame
  HoleShape shape;                               // local frame; not written
  std::optional<std::string> reason;             // why no trajectory sees it: "occluded"; of stations nothing
};
const AnswerFields<PlanPatch>& answerFields(const PlanPatch*);
std::vector<PlanPatch> patchesOf(const std::vector<SurfaceHole>& holes, const Environment& environment,
                                 const Eigen::Vector3d& shift_m);
struct PlanStation {
  std::string station;
  double seen_m2 = 0;
  std::int64_t points = 0;
  double instrument_seconds = 0;
  std::int64_t bytes = 0;
};
const AnswerFields<PlanStation>& answerFields(const PlanStation*);
struct PlanPair {
  std::string a, b;
  double common_m2 = 0;
  double of_a = 0, of_b = 0;  // 0..1, of what each sees
  double overlap = 0;         // the larger of them
};
const AnswerFields<PlanPair>& answerFields(const PlanPair*);
struct PlanProposal {
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  // the instrument's centre, m, the model's file frame
  double adds_m2 = 0;
};
const AnswerFields<PlanProposal>& answerFields(const PlanProposal*);

struct PlanAnswer : PlanCoverage {  // of all products
  double area_m2 = 0;
  std::size_t samples = 0;
  double coverage_sigma = 0;  // 1 σ, by the number of samples
  std::vector<PlanClass> classes;
  std::vector<PlanStorey> storeys;
  std::vector<PlanHole> holes;  // largest first, like the patches
  std::vector<PlanPatch> patches;
  std::vector<PlanStation> stations;
  std::int64_t points = 0;  // of all stations, like those below
  double instrument_seconds = 0;
  std::int64_t bytes = 0;
  std::vector<PlanPair> pairs;
  std::optional<PlanProposal> proposed;  // the next station
};
const AnswerFields<PlanAnswer>& answerFields(const PlanAnswer*);
Result<Answered<PlanAnswer>> runPlan(const Document& document, const PlanOptions& options, Progress& progress);

template <>
struct FieldValue<Effects> {  // named are those that are left out
  static constexpr auto kKind = ParameterKind::text;
  static void describe(Parameter&) {}
  static Result<Effects> read(const nlohmann::json& text);
  static nlohmann::json write(Effects effects);
};
template <>
struct FieldValue<Weather> {
  static constexpr auto kKind = ParameterKind::text;
  static void describe(Parameter&) {}
  static Result<Weather> read(const nlohmann::json& text);
  static nlohmann::json write(const Weather& weather);
};
template <>
struct FieldValue<Sun> {
  static constexpr auto kKind = ParameterKind::text;
  static void describe(Parameter&) {}
  static Result<Sun> read(const nlohmann::json& text);
  static nlohmann::json write(const Sun& sun);
};

template <>
struct FieldValue<FieldFault> {
  static constexpr auto kKind = ParameterKind::pairs;
  static void describe(Parameter&) {}
  static Result<FieldFault> read(const nlohmann::json& pairs) { return fieldFaultFrom(pairs); }
  static nlohmann::json write(const FieldFault& fault) {
    const auto pairs = pairsOf(fault);
    return pairs.empty() ? nlohmann::json() : nlohmann::json(pairs);
  }
};

enum class Switch { on, off };
std::span<const Choice<Switch>> choices(Switch);

std::span<const Choice<ScanQuality>> choices(ScanQuality);

// How the trajectory of a carried scanner is known: with the error that its kind of instrument has, with none, or with
// that of a profile (core/motion/error_profiles.h).
enum class TrajectoryError { of_instrument, none, wearable, handheld, poor, survey_mms, uav, mems };
std::span<const Choice<TrajectoryError>> choices(TrajectoryError);
std::span<const Choice<Deskew>> choices(Deskew);

struct ScanVerbOptions {
  StationNames stations;
  std::string trajectory;  // instead of stations: its name, or a file
  TrajectoryError trajectory_error = TrajectoryError::of_instrument;
  Switch closures = Switch::on;
  Switch anchors = Switch::off;
  std::filesystem::path control;  // of a trajectory: points that it stops at
  Deskew deskew = Deskew::pulse;
  KeyValues mounting, mounting_error;  // x, y, z in m; roll, pitch, yaw in degrees; clock in s
  std::string instrument;              // id
  KeyValues settings;                  // in the device's own words
  std::uint64_t seed = 1;
  bool ideal = false;
  std::optional<Effects> without;  // the effects that are left
  ScanQuality quality = ScanQuality::standard;
  std::optional<Weather> weather;
  std::optional<Sun> sun;
  double interference = 0;  // 0..1
  FieldFault field_fault;
  KeyValues notes;
  bool panorama = false;
  std::optional<std::uint32_t> panorama_columns;
  Switch compensator = Switch::on;
  Switch movers = Switch::on;
  std::optional<double> movers_from_s;  // their clock when a scan's own shows 0; nothing: 0 at the first station, on
                                        // from there at the others, as the crew gets to them
  Switch operator_there = Switch::on;   // of a scanner that is carried: in its sight
  bool truth = false;
  std::string as;   // variant of the format
  int threads = 0;  // 0: all
  bool resume = false;
  std::optional<Shard> shard;
  std::filesystem::path output;
};
const Fields<ScanVerbOptions>& scanFields();
// The scans that `result` has and `base` has not, at the stations of `newest` of the same names.
Document scansCarriedOver(const Document& base, const Document& result, const Document& newest);

struct ScanAnswerRow {
  std::string station;
  std::uint64_t points = 0, pulses = 0, returns = 0;
  double seconds = 0;  // that the simulation took
  double instrument_seconds = 0;
  std::filesystem::path file;
  std::optional<bool> resumed;  // true where an earlier run had finished it
};
const AnswerFields<ScanAnswerRow>& answerFields(const ScanAnswerRow*);
struct ScanAnswer {
  std::vector<ScanAnswerRow> stations;
};
const AnswerFields<ScanAnswer>& answerFields(const ScanAnswer*);
Result<Answered<ScanAnswer>> runScan(const Document& document, const ScanVerbOptions& options, Progress& progress);

struct MoverOptions {
  std::optional<std::string> add, remove;
  std::string kind;                              // empty: person
  std::vector<std::string> through;              // waypoints: "X,Y[,Z][:STOP]"
  std::vector<std::string> products;             // ids or GlobalIds
  std::optional<Eigen::Vector3d> axis_at, axis;  // the model's own frame
  std::optional<double> speed_mps, turn_dps;
  std::optional<double> angle_deg, way_m;
  bool repeat = false;
  double begin_s = 0;
  int count = 10;                         // of a crowd
  std::vector<std::string> gives_way_to;  // trajectories, of a crowd
  std::uint64_t seed = 1;
};
const Fields<MoverOptions>& moverFields();
struct MoverRow {
  std::string name, kind;
  std::uint64_t waypoints = 0, products = 0;
  double begins_s = 0;
  std::optional<double> seconds;  // that its way takes; nothing: it goes on for ever
};
const AnswerFields<MoverRow>& answerFields(const MoverRow*);
struct MoverAnswer {
  std::vector<MoverRow> movers;
};
const AnswerFields<MoverAnswer>& answerFields(const MoverAnswer*);
Result<Answered<MoverAnswer>> runMover(const Document& document, const MoverOptions& options, Progress& progress);

struct TrajectoryOptions {
  std::optional<std::string> add, change, rename, remove, write;
  std::string name;                  // the new one, for `rename`
  std::vector<std::string> through;  // waypoints of what is added or changed: "X,Y[,Z][:STOP[:LOOK]]"
  std::filesystem::path file;        // or where it is
  std::string format;                // of the file, in or out; empty: as it looks
  std::string carrier;               // id; empty: hand, or as it was
  std::optional<double> height_m, speed_mps;
  std::optional<std::uint64_t> seed;
  std::filesystem::path output;  // for `write`
  double rate_hz = 200;
  std::string solved_for;  // id of the instrument that it is solved with, for `write`; empty: as it truly is
  TrajectoryError trajectory_error = TrajectoryError::of_instrument;
  Switch closures = Switch::on, anchors = Switch::off;
  std::filesystem::path control;
  std::uint64_t error_seed = 1;
};
const Fields<TrajectoryOptions>& trajectoryFields();
// A waypoint as `through` has it, in the frame of the model's file: the text reads as the same place again.
std::string waypointText(const Waypoint& waypoint, const Georeference& georeference);

struct TrajectoryRow {
  std::string name, carrier;
  std::uint64_t waypoints = 0;
  std::optional<double> length_m, seconds, mean_mps;  // nothing: it cannot be made, as the report says
  std::filesystem::path file;
  std::uint64_t scans = 0;
};
const AnswerFields<TrajectoryRow>& answerFields(const TrajectoryRow*);
struct TrajectoryAnswer {
  std::vector<TrajectoryRow> trajectories;
  std::optional<std::filesystem::path> file;  // that was written
};
const AnswerFields<TrajectoryAnswer>& answerFields(const TrajectoryAnswer*);
Result<Answered<TrajectoryAnswer>> runTrajectory(const Document& document, const TrajectoryOptions& options,
                                                 Progress& progress);

}  // namespace standpoint
