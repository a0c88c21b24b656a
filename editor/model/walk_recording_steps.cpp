// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/walk_recording_steps.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "editor/model/file_kinds.h"
#include "editor/model/model.h"
#include "editor/model/scan_form.h"
#include "editor/model/trajectory_steps.h"
#include "editor/words/sentences.h"
#include "editor/words/words.h"
#include "survey/trajectories/trajectory_file.h"

namespace standpoint {

namespace {

namespace fs = std::filesystem;

constexpr double kLeastWalk_m = 0.5;

PaceLimits limitsOf(const Model& model) {
  const Instrument* const carried = carriedOnFoot(model);
  return carried == nullptr ? PaceLimits() : paceLimits(*carried);
}

// Into a file of the project.
Result<fs::path> writeWalk(const RecordedWalk& walk, const fs::path& folder, const std::string& name,
                           const Georeference& georeference) {
  TRY_ASSIGN(const auto trajectory, carriedAlong(walk.moments, *walk.carrier, 1, name));
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return failure(ErrorKind::file_system, error.message(), folder.string());
  const TrajectoryFormat* const format = trajectoryFormat("csv");
  TRY_ASSIGN(const auto frame, fileFrame(georeference, format->id));
  auto file = freeFile(folder / (name + format->extension));
  TRY(format->write(file, trajectory, frame));
  return file;
}

// What cannot be written is still a way through waypoints.
void takeInFile(Model& model) {
  auto& recording = model.recording;
  if (!recording.writes || !recording.writes->done() || !recording.kept) return;
  auto written = std::exchange(recording.writes, nullptr)->take();
  auto& options = recording.kept->options;
  if (!written) {
    model.session.errors().push_back({"The turns and tilts of the walk could not be kept", written.error()});
    return;
  }
  options.through.clear();
  options.speed_mps.reset(), options.height_m.reset();
  options.file = *std::move(written), options.format = "csv";
}

// As soon as its file is written and the document is free.
void addKept(Model& model) {
  auto& recording = model.recording;
  takeInFile(model);
  if (!recording.kept || recording.writes || !model.session.whyNot("trajectory").empty()) return;
  RecordedWalk walk = *std::exchange(recording.kept, std::nullopt);
  const std::string name = freeTrajectoryName(*model.session.document().job);
  walk.options.add = name;
  if (!model.session.start(walk.options, trf("Add trajectory {}", name))) return;
  model.trajectory_wanted = name;
  if (walk.carrier != nullptr) recording.scanned = name;
}

void keepRecorded(Model& model) {
  auto& recording = model.recording;
  recording.record.end();
  recording.live.end();
  const auto& document = model.session.document();
  if (!document.job || !document.georeference) return;
  if (recording.record.length_m() < kLeastWalk_m) {
    recording.live.drop();
    model.say(trf("Nothing was recorded: walk at least {:.1f} m", kLeastWalk_m));
    return;
  }
  CarriedTrajectory walked;
  walked.waypoints = recording.record.waypoints();
  walked.speed_mps = std::max(0.1, std::round(100 * recording.record.speed_mps()) / 100);
  RecordedWalk kept;
  const Instrument* const scanned = recording.moments.size() < 2 ? nullptr : model.instrument(recording.instrument);
  if (scanned != nullptr) {
    kept.carrier = carrierOnFoot(scanned->moving->mount);
    walked.carrier = kept.carrier->id;
    kept.moments = std::exchange(recording.moments, {});
  }
  kept.options = changeTo(walked, *document.georeference);
  kept.options.change.reset();
  recording.kept = kept;
  if (kept.carrier != nullptr) {
    const auto work = [walk = std::move(kept), folder = model.session.ownFolder() / "walks",
                       name = freeTrajectoryName(*document.job), georeference = document.georeference](
                          Progress&) -> Result<fs::path> { return writeWalk(walk, folder, name, *georeference); };
    recording.writes = std::make_unique<Task<fs::path>>("Write the walk", work, model.wake);
  }
  addKept(model);
}

void beginRecord(Model& model) {
  auto& recording = model.recording;
  recording.record.begin();
  recording.pace.begin(limitsOf(model));
  recording.began_s = model.walk.clock_s();
  recording.moments.clear();
}

// Once what the scan needs is there. Nothing of the way is recorded until then: it would have no points.
void beginWantedScan(Model& model) {
  auto& recording = model.recording;
  if (!recording.scan_wanted) return;
  const Instrument* const carried = carriedOnFoot(model);
  if (!model.walk.active() || carried == nullptr) {
    recording.scan_wanted = false;
    return;
  }
  const auto& document = model.session.document();
  model.scan_readiness.follow(document, model.picker.scene(), model.wake);
  const auto world = model.scan_readiness.at_hand();
  if (!world || !world->fits(document)) return;
  recording.scan_wanted = false;
  auto settings = resolveMovingSettings(*carried, model.carried_scan.choice.settings);
  if (!settings) {
    model.session.errors().push_back({"Cannot scan while walking", settings.error()});
    return;
  }
  beginRecord(model);
  recording.instrument = carried->id;
  recording.scanned.clear();
  model.showClouds({});  // points come into the model
  recording.live.begin({world, *carried, *std::move(settings)}, model.walk.feet().array().round().matrix());
}

}  // namespace

const Instrument* carriedOnFoot(const Model& model) {
  const Instrument* const chosen = model.instrument(model.carried_scan.choice.instrument);
  return chosen != nullptr && chosen->moving && carrierOnFoot(chosen->moving->mount) != nullptr ? chosen : nullptr;
}

void finishRecord(Model& model) {
  auto& recording = model.recording;
  recording.scan_wanted = false;
  if (recording.record.active()) keepRecorded(model);
  if (recording.writes) recording.writes->wait();
  addKept(model);
  if (model.trajectory_wanted.empty()) return;
  model.session.wait();
}

void forgetRecord(Model& model) {
  auto& recording = model.recording;
  recording.record.end();
  recording.live.drop();
  recording.moments.clear();
  recording.scan_wanted = false;
  recording.kept.reset();
  recording.writes.reset();
  recording.scanned.clear();
}

std::string whyNotRecordWalk(const Model& model) {
  if (model.recording.record.active()) return "";
  if (!model.walk.active()) return "Walk first: what somebody walks is recorded";
  return model.session.whyNot("trajectory");
}

void recordWalk(Model& model) {
  if (scansWalk(model)) return scanWalk(model);
  if (model.recording.record.active())
    keepRecorded(model);
  else
    beginRecord(model);
}

bool scansWalk(const Model& model) { return model.recording.scan_wanted || model.recording.live.active(); }

std::string whyNotScanWalk(const Model& model) {
  if (scansWalk(model)) return "";
  if (!model.walk.active()) return "Walk first: the scanner goes where you walk";
  if (carriedOnFoot(model) == nullptr) return "Choose an instrument that is carried on foot in the Scan panel first";
  return model.session.whyNot("trajectory");
}

void scanWalk(Model& model) {
  auto& recording = model.recording;
  if (recording.live.active()) return keepRecorded(model);
  if (std::exchange(recording.scan_wanted, false)) return;
  if (recording.record.active()) keepRecorded(model);
  recording.scan_wanted = true;
  beginWantedScan(model);
}

void followRecord(Model& model) {
  auto& recording = model.recording;
  addKept(model);
  beginWantedScan(model);
  recording.live.poll();
  if (!recording.record.active()) return;
  const double now_s = model.walk.clock_s() - recording.began_s;
  if (!model.walk.active() || !recording.record.follow(now_s, model.walk.feet())) return keepRecorded(model);
  const Instrument* const carried =
      recording.live.active() ? model.instrument(recording.instrument) : carriedOnFoot(model);
  const WalkMoment moment{now_s, model.walk.feet(),
                          scannerOf(model.view.camera, carried == nullptr ? "hand" : carried->moving->mount)};
  recording.pace.follow(now_s, moment.feet, moment.local_from_scanner.rotation);
  if (!recording.live.active()) return;
  recording.live.follow(moment);
  if (recording.moments.empty() || moment.time_s > recording.moments.back().time_s) recording.moments.push_back(moment);
}

std::string whyNotScanWalked(const Model& model) {
  const auto& job = model.session.document().job;
  const auto& name = model.recording.scanned;
  const bool there = job && std::any_of(job->trajectories.begin(), job->trajectories.end(),
                                        [&](const auto& t) { return !name.empty() && t.name == name; });
  if (!there || model.instrument(model.recording.instrument) == nullptr) return "Scan while walking first";
  return model.session.whyNot("scan");
}

void scanWalked(Model& model) {
  const std::string name = model.recording.scanned;
  CarriedScan carried = model.carried_scan;
  const Instrument* const instrument = model.instrument(model.recording.instrument);
  if (carried.choice.instrument != instrument->id) chooseInstrument(carried.choice, *instrument);
  auto options = optionsAlong(carried, name);
  const fs::path folder = model.session.ownFolder() / "scans";
  std::error_code error;
  fs::create_directories(folder, error);
  options.output = freeFile(folder / (name + ".e57"));
  if (!model.startScan(options, trf("Scan along {}", name))) return;
  dropLivePoints(model);
}

std::string whyNoLivePoints(const Model& model) {
  if (model.recording.live.active()) return "End the scan first";
  return model.recording.live.empty() ? "There are no points of a walk" : "";
}

void dropLivePoints(Model& model) {
  model.recording.live.drop();
  model.recording.scanned.clear();
}

}  // namespace standpoint
