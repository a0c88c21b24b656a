// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "materials/materials.h"
#include "project/answers.h"
#include "project/materials/materials_verb.h"
#include "project/materials/verification.h"
#include "project/materials/verify_answer.h"
#include "survey/instruments.h"
#include "survey/registration/cloud_fit.h"

namespace standpoint {

namespace {

// A fit that would move the cloud by more than this says that it lies wrong.
constexpr double kMisplaced_m = 0.02;
constexpr double kPlacementReach_m = 0.3;
// Of the points that have a station: with fewer on the model it is not the model's cloud, or it lies elsewhere.
constexpr double kFewOnModel = 0.02;

std::string lower(std::string text) {
  for (auto& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

Result<std::shared_ptr<const Underlay>> underlayFor(const Document& document, const VerifyOptions& options) {
  const auto& all = document.underlays;
  if (all.empty()) return failure(ErrorKind::usage, "there is no underlay: add one first", "verify");
  const auto& name = options.underlay;
  if (name.empty() && all.size() == 1) return all.front();
  std::vector<std::string> names;
  for (const auto& u : all) {
    if (u->name == name) return u;
    names.push_back(u->name);
  }
  return failure(ErrorKind::usage,
                 name.empty() ? fmt::format("specify an underlay: {}", fmt::join(names, ", "))
                              : fmt::format("unknown underlay '{}'; available: {}", name, fmt::join(names, ", ")),
                 "verify");
}

// The one that is named, else the one whose maker and model the cloud's scans name.
Result<Instrument> instrumentFor(const VerifyOptions& options, const CloudSample& sample, Report& report) {
  if (!options.instrument.empty()) return instrumentNamed(options.instrument);
  TRY_ASSIGN(const auto all, knownInstruments());
  // The longest model that fits: "Focus S350" before "Focus".
  const Instrument* best = nullptr;
  for (const auto& scan : sample.scans) {
    const auto said = lower(scan.sensor_vendor + " " + scan.sensor_model);
    for (const auto& i : all)
      if (said.find(lower(i.maker)) != std::string::npos && said.find(lower(i.model)) != std::string::npos &&
          (best == nullptr || i.model.size() > best->model.size()))
        best = &i;
  }
  if (best == nullptr)
    return failure(ErrorKind::usage,
                   fmt::format("the point cloud does not identify its instrument: specify the one with the closest "
                               "wavelength; available: {}",
                               idsOf(all)),
                   "--instrument");
  report.note("instrument",
              fmt::format("{} {} at {:.0f} nm, from the point cloud", best->maker, best->model, best->wavelength_nm));
  return *best;
}

Result<CloudSample> usableSample(const Underlay& underlay, const VerifyOptions& options, Progress& progress) {
  TRY_ASSIGN(auto sample, sampleCloud(underlay.file, options.points, progress));
  if (sample.intensity.empty())
    return failure(ErrorKind::unusable,
                   "the point cloud has no intensity: export it with intensity from the scanner software",
                   underlay.name);
  if (!(sample.max_intensity > sample.min_intensity))
    return failure(
        ErrorKind::unusable,
        fmt::format(
            "all points have the same intensity, {}: intensity was lost during export; export the point cloud again",
            sample.min_intensity),
        underlay.name);
  std::size_t without = 0;
  for (auto& scan : sample.scans) {
    const Pose& pose = underlay.file_from_cloud;
    if (options.from && !scan.station) scan.station = pose.rotation.conjugate() * (*options.from - pose.translation);
    without += scan.station ? 0 : 1;
  }
  if (without == sample.scans.size())
    return failure(ErrorKind::unusable,
                   "the point cloud has no scanner position: import single scans with poses (E57 or PTX with grid), or "
                   "specify the position",
                   underlay.name);
  return sample;
}

Result<VerifyFound> found(const Document& document, const Underlay& underlay, const CloudSample& sample,
                          const Instrument& instrument, const std::vector<PhysicalMaterial>& library,
                          const VerifyOptions& options, Progress& progress) {
  VerifyFound f;
  f.underlay = underlay.name;
  f.instrument = &instrument;
  f.library = &library;
  f.document = &document;
  TRY_ASSIGN(auto settings, resolveSettings(instrument, {}));
  progress.stage("Rays of the model", 0.4, 0.45);
  TRY_ASSIGN(auto scene, RayScene::build(document.environment(), progress));
  // A part of the document: it outlives the expectation.
  const std::shared_ptr<const MaterialAssignment> assignment(document.materials,
                                                             &document.materials->result.assignment);
  const Expectation expectation(scene, assignment, ReturnLaw(instrument, settings));
  Pose local_from_cloud = underlay.file_from_cloud;
  local_from_cloud.translation -= document.georeference->shift_m;
  MeetingTolerance tolerance;
  tolerance.met_m = options.tolerance_m;
  tolerance.window_m = std::max(tolerance.window_m, tolerance.met_m);
  progress.stage("Beams to the points", 0.45, 0.6);
  TRY_ASSIGN(auto measured, measuredReturns(sample, local_from_cloud, expectation, library, tolerance, progress));
  f.measured = std::move(measured);
  std::uint64_t with_station = 0;
  for (const auto n : f.measured.meetings) with_station += n;
  const auto of = [&](BeamMeeting meeting) { return f.measured.meetings[static_cast<std::size_t>(meeting)]; };
  const auto near = of(BeamMeeting::met) + of(BeamMeeting::near) + of(BeamMeeting::edge) + of(BeamMeeting::shared);
  constexpr std::uint64_t kFewest = 100;  // fewer say nothing of any material
  if (with_station < kFewest)
    return failure(ErrorKind::unusable,
                   fmt::format("points with a known scanner position: {}, at least {} required; add a more complete "
                               "export of the scan as an underlay",
                               with_station, kFewest),
                   underlay.name);
  if (near < kFewest || static_cast<double>(near) < kFewOnModel * static_cast<double>(with_station))
    return failure(ErrorKind::unusable,
                   fmt::format("only {} of {} points are on the model: register underlay {} first", near, with_station,
                               underlay.name),
                   underlay.name);
  progress.stage("Placement of the cloud", 0.6, 0.85);
  f.placement = fitCloudToModel(*document.environment(), document.georeference->shift_m, sample,
                                underlay.file_from_cloud, kPlacementReach_m, progress);
  if (!f.placement && f.placement.error().kind == ErrorKind::cancelled) return failure(f.placement.error());
  progress.stage("Materials by intensity", 0.85, 1);
  TRY_ASSIGN(auto comparison,
             compareMaterials(f.measured.returns, f.measured.groups, library, instrument, {}, progress));
  f.comparison = std::move(comparison);
  return f;
}

// A cloud that lies wrong has points on the wrong products: what they seem to be made of is no evidence.
void judgePlacement(VerifyFound& f) {
  std::string wrong;
  if (!f.placement)
    wrong = "cannot check the position of the cloud: " + f.placement.error().message;
  else if (f.placement->moved_m > kMisplaced_m && !f.placement->settled)
    wrong = "cannot check the position of the cloud: the fit to the model surface does not converge";
  else if (f.placement->moved_m > kMisplaced_m)
    wrong = fmt::format(
        "the cloud is {:.3f} m off the model: register it first with `standpoint underlay PROJECT --register {} --icp`",
        f.placement->moved_m, f.underlay);
  if (wrong.empty()) return;
  f.comparison.no_verdict = wrong;
  f.comparison.proposals.clear();
}

}  // namespace

const Fields<VerifyOptions>& verifyFields() {
  using O = VerifyOptions;
  static const Fields<O> fields = {
      {"underlay", &O::underlay, "name of the underlay (default: the only one)", {.positional = true}},
      {"instrument", &O::instrument,
       "id or file of the instrument that measured, for its wavelength (default: as the cloud says)"},
      {"from", &O::from, "X,Y,Z of the station in the model's file frame, where the cloud has none", {.unit = "m"}},
      {"tolerance",
       &O::tolerance_m,
       "maximum distance of compared points from their surface",
       {.unit = "m", .minimum = 0.001, .maximum = 0.2}},
      {"points",
       &O::points,
       "maximum number of points, drawn evenly from the cloud",
       {.minimum = 1000, .maximum = 20000000}}};
  return fields;
}

Result<Answered<VerifyAnswer>> runVerify(const Document& document, const VerifyOptions& options, Progress& progress) {
  progress.stage("Verify", 0, 0.4);
  TRY_ASSIGN(auto underlay, underlayFor(document, options));
  if (!document.materials) return failure(ErrorKind::usage, "no materials assigned: assign them first", "verify");
  TRY_ASSIGN(auto library, shippedMaterials());
  Answered<VerifyAnswer> outcome{document};
  progress.stage("Reading " + underlay->name, 0, 0.4);
  TRY_ASSIGN(const auto sample, usableSample(*underlay, options, progress));
  TRY_ASSIGN(const auto instrument, instrumentFor(options, sample, outcome.report));
  const auto all = withOwn(std::move(library), document.materials->own);
  TRY_ASSIGN(auto f, found(document, *underlay, sample, instrument, all, options, progress));
  judgePlacement(f);
  outcome.answer = verifyAnswer(f);
  tellVerified(f, outcome.report);
  const auto proposals = f.comparison.proposals.size();
  outcome.description =
      f.comparison.no_verdict.empty()
          ? fmt::format("Verified materials with {}: {} proposal{}", f.underlay, proposals, proposals == 1 ? "" : "s")
          : fmt::format("Verified materials with {}: no verdict", f.underlay);
  outcome.document.verification = std::make_shared<const Verification>(verificationOf(document, outcome.answer));
  return outcome;
}

}  // namespace standpoint
