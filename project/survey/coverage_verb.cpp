// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/survey/coverage_verb.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "core/motion/carriers.h"
#include "core/motion/trajectory_error.h"
#include "core/units.h"
#include "pointclouds/formats.h"
#include "project/answers.h"
#include "project/survey/error_profile.h"
#include "project/survey/scan_request.h"
#include "survey/instruments.h"
#include "survey/movers/moving_world.h"
#include "survey/scanning/scan_world.h"
#include "survey/stations/surface_holes.h"
#include "survey/trajectories/carried_motion.h"
#include "survey/trajectories/path_coverage.h"

namespace standpoint {

namespace {

namespace fs = std::filesystem;
using Sights = std::vector<SampleSight>;

constexpr std::size_t kMostProducts = 30;
constexpr double kDisc_m = 0.08;  // on which points of a scan are counted

void add(CoverageShare& share, const SampleSight& sight, double each_m2) {
  share.exposed_m2 += each_m2;
  if (sight.passes > 1) share.twice_m2 += each_m2;
  switch (sight.blind) {
    case Blindness::covered: share.covered_m2 += each_m2; break;
    case Blindness::passed_by: share.passed_by_m2 += each_m2; break;
    case Blindness::sparse: share.sparse_m2 += each_m2; break;
    case Blindness::grazing: share.grazing_m2 += each_m2; break;
    case Blindness::out_of_view: share.out_of_view_m2 += each_m2; break;
    case Blindness::out_of_range: share.out_of_range_m2 += each_m2; break;
    case Blindness::occluded: share.occluded_m2 += each_m2; break;
    case Blindness::unreachable: share.unreachable_m2 += each_m2; break;
  }
}

void finish(CoverageShare& share) {
  if (share.exposed_m2 <= 0) return;
  share.coverage = share.covered_m2 / share.exposed_m2;
  share.twice = share.twice_m2 / share.exposed_m2;
}

CoverageShare shareOf(const Sights& sights, const SurfaceSamples& samples) {
  CoverageShare share;
  for (std::size_t k = 0; k < sights.size(); ++k)
    if (samples.samples[k].exposed) add(share, sights[k], samples.each_m2());
  finish(share);
  return share;
}

// One trajectory with what is seen from it.
struct Path {
  const CarriedTrajectory* trajectory = nullptr;
  CarriedMotion carried;
  Instrument instrument;
  ScanSettings settings;
  MotionSolving solving;  // how it will be known
  Sights sights;
};

Result<std::vector<const CarriedTrajectory*>> trajectoriesFrom(const Job& job, const std::vector<std::string>& names) {
  std::vector<const CarriedTrajectory*> wanted;
  for (const auto& trajectory : job.trajectories)
    if (names.empty()) wanted.push_back(&trajectory);
  for (const auto& name : names) {
    const auto found = std::find_if(job.trajectories.begin(), job.trajectories.end(),
                                    [&](const CarriedTrajectory& t) { return t.name == name; });
    if (found == job.trajectories.end())
      return failure(ErrorKind::usage, fmt::format("unknown trajectory '{}'", name), "--trajectories");
    wanted.push_back(&*found);
  }
  if (wanted.empty())
    return failure(ErrorKind::usage, "there is no trajectory yet; add one with trajectory --add NAME");
  return wanted;
}

Result<Path> pathOf(const Document& document, const CarriedTrajectory& trajectory, const CoverageOptions& options,
                    Report& report, Progress& progress) {
  Path path;
  path.trajectory = &trajectory;
  const Scan* const last = trajectory.scans.empty() ? nullptr : &trajectory.scans.back();
  if (options.measured && last == nullptr)
    return failure(
        ErrorKind::usage,
        fmt::format("trajectory {} has not been scanned yet; scan along it, or leave --measured out", trajectory.name),
        "--measured");
  if (options.instrument.empty() && last == nullptr)
    return failure(ErrorKind::usage,
                   fmt::format("trajectory {} has not been scanned yet; specify the instrument", trajectory.name),
                   "--instrument");
  const bool as_scanned = last != nullptr && (options.measured || options.instrument.empty());
  TRY_ASSIGN(path.instrument, instrumentNamed(as_scanned ? last->instrument : options.instrument));
  TRY_ASSIGN(path.settings, resolveMovingSettings(path.instrument, as_scanned ? last->settings : options.settings));
  TRY_ASSIGN(path.carried, carriedMotion(trajectory, *document.georeference, report, progress));
  return path;
}

// Points of the last scan on each sample.
Result<Sights> measuredSights(const Document& document, const RayScene& scene, const Path& path,
                              const SurfaceSamples& samples, const CoveredWhen& wanted, Report& report,
                              Progress& progress) {
  const fs::path file = path.trajectory->scans.back().file;
  std::error_code ignored;
  if (!fs::exists(file, ignored)) return failure(ErrorKind::file_system, "file not found", file.string());
  const CloudFormat* const format = readableCloudFormat(file);
  if (format == nullptr || format->read == nullptr)
    return failure(ErrorKind::usage, "unsupported point-cloud format", file.string());
  const SampleCells cells(scene, samples, kDisc_m);
  SightSink sink(cells, kDisc_m, samples, path.carried, document.georeference->shift_m, wanted);
  TRY_ASSIGN(const auto read, format->read(file, sink, progress));
  report.append(read);
  if (!sink.hadTimes())
    return failure(ErrorKind::unusable, "its points have no times; scan to E57, LAS or PLY instead", file.string());
  return sink.sights(path.sights);
}

CoverageTrajectory rowOf(const Path& path, const SurfaceSamples& samples) {
  CoverageTrajectory row{shareOf(path.sights, samples)};
  row.trajectory = path.trajectory->name;
  row.instrument = path.instrument.id;
  row.length_m = path.carried.length_m;
  row.seconds = path.carried.seconds();
  if (row.seconds > 0) row.mean_mps = row.length_m / row.seconds;
  for (const auto& sample : pathSamples(path.carried, 20000)) {
    row.fastest_mps = std::max(row.fastest_mps, sample.speed_mps);
    row.fastest_turn_degps = std::max(row.fastest_turn_degps, sample.turn_radps / kRadPerDeg);
  }
  return row;
}

// Where it closes and how well it will be known, all seeds together.
Result<void> expectError(CoverageTrajectory& row, const Path& path, const RayScene& scene, const Document& document,
                         Progress& progress) {
  TRY_ASSIGN(const auto closures, closuresOf(path.carried, scene, path.solving.max_range_m));
  row.closures = closures.size();
  TRY_ASSIGN(const auto expected, expectedMotion(path.carried, scene, document.job->stations, path.solving, progress));
  std::vector<double> times;
  for (const auto& sample : pathSamples(path.carried, 2000))
    times.push_back(path.carried.path->first_s() + sample.after_s);
  for (const double sigma : expectedAt(expected, times)) {
    row.expected_rms_m += sigma * sigma / static_cast<double>(times.size());
    row.expected_most_m = std::max(row.expected_most_m, sigma);
  }
  row.expected_rms_m = std::sqrt(row.expected_rms_m);
  return {};
}

// What each covers that no other does, and what all of them do.
void compare(CoverageAnswer& answer, const std::vector<Path>& paths, const SurfaceSamples& samples) {
  for (std::size_t k = 0; k < samples.samples.size(); ++k) {
    if (!samples.samples[k].exposed) continue;
    const auto covers = [&](const Path& p) { return p.sights[k].blind == Blindness::covered; };
    const auto count = static_cast<std::size_t>(std::count_if(paths.begin(), paths.end(), covers));
    if (count == paths.size()) answer.common_m2 += samples.each_m2();
    if (count != 1) continue;
    const auto only = std::find_if(paths.begin(), paths.end(), covers) - paths.begin();
    answer.trajectories[static_cast<std::size_t>(only)].alone_m2 += samples.each_m2();
  }
  for (auto& row : answer.trajectories)
    if (row.seconds > 0) row.alone_m2_per_minute = row.alone_m2 / row.seconds * 60;
}

void addParts(CoverageAnswer& answer, const Sights& sights, const SurfaceSamples& samples,
              const Environment& environment) {
  std::map<std::string, CoverageShare> classes, storeys;
  std::map<std::uint32_t, CoverageShare> products;
  for (std::size_t k = 0; k < sights.size(); ++k) {
    const auto& sample = samples.samples[k];
    if (!sample.exposed) continue;
    const auto& product = environment.products[sample.product];
    for (auto* share : {&classes[product.ifc_class], &storeys[product.storey], &products[sample.product]})
      add(*share, sights[k], samples.each_m2());
  }
  for (auto& [name, share] : classes) finish(share), answer.classes.push_back({share, name});
  for (auto& [name, share] : storeys) finish(share), answer.storeys.push_back({share, name});
  for (auto& [product, share] : products) {
    finish(share);
    if (share.covered_m2 < share.exposed_m2)
      answer.products.push_back({share, identityOf(environment.products[product])});
  }
  const auto blind = [](const CoverageShare& s) { return s.exposed_m2 - s.covered_m2; };
  std::stable_sort(answer.products.begin(), answer.products.end(),
                   [&](const auto& a, const auto& b) { return blind(a) > blind(b); });
  if (answer.products.size() > kMostProducts) answer.products.resize(kMostProducts);
}

// Each reason's own, as what is blind for one reason is often beside what is blind for another.
void addPatches(CoverageAnswer& answer, const Sights& sights, const SurfaceSamples& samples,
                const Environment& environment, const Eigen::Vector3d& shift_m) {
  for (std::size_t reason = 1; reason < kBlindnesses; ++reason) {
    std::vector<double> spacing(sights.size(), 1);
    for (std::size_t k = 0; k < sights.size(); ++k)
      if (static_cast<std::size_t>(sights[k].blind) == reason) spacing[k] = 0;
    for (PlanPatch& patch : patchesOf(surfaceHoles(samples, spacing, kMostPatches), environment, shift_m)) {
      patch.spacing_m.reset();
      patch.reason = nameOf(static_cast<Blindness>(reason));
      answer.blind.push_back(std::move(patch));
    }
  }
  std::stable_sort(answer.blind.begin(), answer.blind.end(),
                   [](const auto& a, const auto& b) { return a.area_m2 > b.area_m2; });
  if (answer.blind.size() > kMostPatches) answer.blind.resize(kMostPatches);
}

std::string line(const std::string& name, const CoverageShare& s) {
  const auto of = [&](double part) { return s.exposed_m2 > 0 ? 100 * part / s.exposed_m2 : 0; };
  return fmt::format("{:24} {:8.1f} {:7.1f} {:7.1f} {:7.1f} {:7.1f} {:8.1f} {:8.1f} {:8.1f} {:9.1f} {:11.1f}\n", name,
                     s.exposed_m2, of(s.covered_m2), of(s.twice_m2), of(s.passed_by_m2), of(s.sparse_m2),
                     of(s.grazing_m2), of(s.out_of_view_m2), of(s.out_of_range_m2), of(s.occluded_m2),
                     of(s.unreachable_m2));
}

std::string textOf(const CoverageAnswer& answer) {
  std::string text = fmt::format("{:24} {:>8} {:>7} {:>7} {:>7} {:>7} {:>8} {:>8} {:>8} {:>9} {:>11}\n",
                                 answer.measured ? "measured, % of m2" : "predicted, % of m2", "m2", "covered", "twice",
                                 "mover", "sparse", "grazing", "no view", "range", "occluded", "unreachable");
  for (const auto& row : answer.trajectories) text += line(row.trajectory, row);
  if (answer.trajectories.size() > 1) text += line("together", answer);
  for (const auto& row : answer.storeys) text += line("storey " + (row.storey.empty() ? "(none)" : row.storey), row);
  for (const auto& row : answer.classes)
    text += line("class " + (row.ifc_class.empty() ? "(none)" : row.ifc_class), row);
  for (const auto& row : answer.trajectories)
    text += fmt::format(
        "{}: {:.1f} m in {:.1f} min, {:.2f} m/s, at most {:.2f} m/s and {:.0f} deg/s, {} closures; "
        "expected error {:.1f} mm (rms), {:.1f} mm at most; alone {:.1f} m2, {:.1f} m2/min\n",
        row.trajectory, row.length_m, row.seconds / 60, row.mean_mps, row.fastest_mps, row.fastest_turn_degps,
        row.closures, 1e3 * row.expected_rms_m, 1e3 * row.expected_most_m, row.alone_m2, row.alone_m2_per_minute);
  for (std::size_t k = 0; k < std::min<std::size_t>(10, answer.blind.size()); ++k) {
    const auto& patch = answer.blind[k];
    text += fmt::format("blind, {}: {:.2f} m2 of {} {} {} at {:.2f},{:.2f},{:.2f}\n", *patch.reason, patch.area_m2,
                        patch.ifc_class, patch.id, patch.name, patch.at.x(), patch.at.y(), patch.at.z());
  }
  return text;
}

// What moves meanwhile; null where nothing does.
Result<std::unique_ptr<const PassingBodies>> passingOf(const Document& document, const CoverageOptions& options,
                                                       ScanWorld world, Progress& progress) {
  if (options.movers == Switch::off || document.job->movers.empty()) return nullptr;
  TRY(addMovers(document.job->movers, world));
  TRY_ASSIGN(auto scene, RayScene::build(world.environment, progress, world.balls, {}, world.bodies));
  return std::make_unique<const PassingBodies>(std::move(scene), options.movers_from_s);
}

double eyeHeight_m(const CarriedTrajectory& trajectory) {
  if (trajectory.height_m > 0) return trajectory.height_m;
  const Carrier* const carrier = carrierOf(trajectory.carrier);
  // Of a file or a flight nothing says how high people would carry it.
  const bool walked = trajectory.file.empty() && carrier != nullptr && trajectory.carrier != "uav";
  return walked ? carrier->limits.height_m : PathLimits().height_m;
}

}  // namespace

const Fields<CoverageOptions>& coverageFields() {
  using O = CoverageOptions;
  static const Fields<O> fields = {
      {"trajectories", &O::trajectories, "names (default: all)"},
      {"instrument", &O::instrument, "id of an instrument that is carried (default: that of the last scan)"},
      {"set", &O::settings, "settings in the device's own words, such as resolution=12mm"},
      {"trajectory-error", &O::trajectory_error,
       "how the trajectory is known: with the error of the instrument's kind, none, or that of a profile"},
      {"closures", &O::closures, "off: places that the trajectory comes back to are not recognised"},
      {"anchors", &O::anchors, "on: scanned stations within 3 m of the trajectory hold it"},
      {"control", &O::control, "text file of control points that hold it where it stops: name X Y Z [sigma in mm]"},
      {"movers", &O::movers, "off: nothing moves, and nobody stands in the way"},
      {"movers-from",
       &O::movers_from_s,
       "time of the movers' clock when the trajectory begins",
       {.unit = "s", .minimum = -1e9, .maximum = 1e9}},
      {"measured", &O::measured, "of the last scan along each trajectory, instead of a prediction"},
      {"density",
       &O::density_per_m2,
       "points on a square metre from which on a surface counts as covered",
       {.unit = "1/m2", .minimum = 0.01, .maximum = 1e7}},
      {"max-incidence-deg",
       &O::max_incidence_deg,
       "maximum angle of incidence of points that count",
       {.unit = "deg", .minimum = 1, .maximum = 90}},
      {"pass-gap",
       &O::pass_gap_s,
       "what is seen again after more than this is seen in another pass",
       {.unit = "s", .minimum = 0, .maximum = 86400}},
      {"samples", &O::samples, "number of sample points on the surfaces", {.minimum = 100, .maximum = 5000000}},
      {"seed", &O::seed, "seed of the sample points", {.minimum = 0, .maximum = 9007199254740991.0}}};
  return fields;
}

const AnswerFields<CoverageShare>& answerFields(const CoverageShare*) {
  using A = CoverageShare;
  static const AnswerFields<A> fields = {{"exposed_m2", &A::exposed_m2},
                                         {"covered_m2", &A::covered_m2},
                                         {"twice_m2", &A::twice_m2},
                                         {"coverage", &A::coverage},
                                         {"twice", &A::twice},
                                         {"passed_by_m2", &A::passed_by_m2},
                                         {"sparse_m2", &A::sparse_m2},
                                         {"grazing_m2", &A::grazing_m2},
                                         {"out_of_view_m2", &A::out_of_view_m2},
                                         {"out_of_range_m2", &A::out_of_range_m2},
                                         {"occluded_m2", &A::occluded_m2},
                                         {"unreachable_m2", &A::unreachable_m2}};
  return fields;
}

const AnswerFields<CoverageTrajectory>& answerFields(const CoverageTrajectory* row) {
  using A = CoverageTrajectory;
  static const auto fields = withBases<A>({{"trajectory", &A::trajectory},
                                           {"instrument", &A::instrument},
                                           {"length_m", &A::length_m},
                                           {"seconds", &A::seconds},
                                           {"mean_mps", &A::mean_mps},
                                           {"fastest_mps", &A::fastest_mps},
                                           {"fastest_turn_degps", &A::fastest_turn_degps},
                                           {"closures", &A::closures},
                                           {"expected_rms_m", &A::expected_rms_m},
                                           {"expected_most_m", &A::expected_most_m},
                                           {"alone_m2", &A::alone_m2},
                                           {"alone_m2_per_minute", &A::alone_m2_per_minute}},
                                          answerFields(static_cast<const CoverageShare*>(row)));
  return fields;
}

const AnswerFields<CoverageClass>& answerFields(const CoverageClass* row) {
  static const auto fields = withBases<CoverageClass>({{"class", &CoverageClass::ifc_class}},
                                                      answerFields(static_cast<const CoverageShare*>(row)));
  return fields;
}

const AnswerFields<CoverageStorey>& answerFields(const CoverageStorey* row) {
  static const auto fields = withBases<CoverageStorey>({{"storey", &CoverageStorey::storey}},
                                                       answerFields(static_cast<const CoverageShare*>(row)));
  return fields;
}

const AnswerFields<CoverageProduct>& answerFields(const CoverageProduct* row) {
  static const auto fields = withBases<CoverageProduct>({}, answerFields(static_cast<const CoverageShare*>(row)),
                                                        answerFields(static_cast<const ProductIdentity*>(row)));
  return fields;
}

const AnswerFields<CoverageAnswer>& answerFields(const CoverageAnswer* answer) {
  using A = CoverageAnswer;
  static const auto fields = withBases<A>({{"measured", &A::measured},
                                           {"common_m2", &A::common_m2},
                                           {"trajectories", &A::trajectories},
                                           {"classes", &A::classes},
                                           {"storeys", &A::storeys},
                                           {"products", &A::products},
                                           {"blind", &A::blind}},
                                          answerFields(static_cast<const CoverageShare*>(answer)));
  return fields;
}

Result<Answered<CoverageAnswer>> runCoverage(const Document& document, const CoverageOptions& options,
                                             Progress& progress) {
  Answered<CoverageAnswer> outcome{document};
  CoverageAnswer& answer = outcome.answer;
  Report& report = outcome.report;
  const CoveredWhen wanted{options.density_per_m2, options.max_incidence_deg * kRadPerDeg, options.pass_gap_s};
  TRY_ASSIGN(const auto trajectories, trajectoriesFrom(*document.job, options.trajectories));
  std::vector<Path> paths;
  TRY_ASSIGN(const auto solving, motionSolving(options, nullptr, *document.georeference, 0));
  for (const auto* trajectory : trajectories) {
    TRY_ASSIGN(auto path, pathOf(document, *trajectory, options, report, progress));
    path.solving = solving;
    path.solving.profile = errorProfile(options.trajectory_error, path.instrument.moving->mount);
    path.solving.max_range_m = path.settings.max_range_m;
    paths.push_back(std::move(path));
  }
  noteDefaultRules(document, report);
  progress.stage("Sample surfaces", 0, 0.1);
  TRY_ASSIGN(auto assignment, scanAssignment(document, progress));
  const ScanWorld world = scanWorld(document.environment(), document.job->targets, assignment);
  if (sceneTriangleCount(*world.environment) == 0)
    return failure(ErrorKind::unusable,
                   "the scene contains no products to plan for; import a model, or include products again");
  TRY_ASSIGN(const auto scene, RayScene::build(world.environment, progress, world.balls));
  TRY_ASSIGN(const auto samples, sampleSurfaces(*scene, options.samples, options.seed, progress));
  const auto materials = std::make_shared<const MaterialAssignment>(world.assignment);
  TRY_ASSIGN(const auto passing, passingOf(document, options, world, progress));
  if (document.walkable() == nullptr)
    report.note("collide", "the walkable surface has not been computed; every floor counts as walkable");
  for (std::size_t i = 0; i < paths.size(); ++i) {
    auto& path = paths[i];
    const auto part = [&](std::size_t k) {
      return 0.1 + 0.85 * static_cast<double>(k) / static_cast<double>(paths.size());
    };
    progress.stage("Coverage of " + path.trajectory->name, part(i), part(i + 1));
    const Expectation expectation(scene, materials, ReturnLaw(path.instrument, path.settings));
    const PulseDensity pulses(*path.instrument.moving, path.settings);
    TRY_ASSIGN(path.sights, predictSights(path.carried, expectation, pulses, samples, wanted, progress, passing.get()));
    const auto places = walkablePlaces(*scene, document.walkable(), eyeHeight_m(*path.trajectory));
    TRY(findUnreachable(path.sights, samples, *scene, places, path.settings.max_range_m, wanted, progress));
    if (options.measured) {
      TRY_ASSIGN(path.sights, measuredSights(document, *scene, path, samples, wanted, report, progress));
    }
    answer.trajectories.push_back(rowOf(path, samples));
    TRY(expectError(answer.trajectories.back(), path, *scene, document, progress));
  }
  std::vector<const Sights*> each;
  for (const auto& path : paths) each.push_back(&path.sights);
  const Sights all = together(each, wanted);
  static_cast<CoverageShare&>(answer) = shareOf(all, samples);
  answer.measured = options.measured;
  compare(answer, paths, samples);
  addParts(answer, all, samples, *world.environment);
  addPatches(answer, all, samples, *world.environment, document.georeference->shift_m);
  outcome.description = paths.size() == 1
                            ? fmt::format("{} covers {:.1f} % of {:.0f} m2", paths.front().trajectory->name,
                                          answer.coverage * 100, answer.exposed_m2)
                            : fmt::format("{} trajectories cover {:.1f} % of {:.0f} m2", paths.size(),
                                          answer.coverage * 100, answer.exposed_m2);
  outcome.text = textOf(answer);
  return outcome;
}

}  // namespace standpoint
