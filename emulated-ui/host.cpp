// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/host.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <fmt/format.h>

#include "core/json_file.h"
#include "core/units.h"
#include "emulated-ui/device/numbers.h"
#include "emulated-ui/hand_over.h"
#include "emulated-ui/memory.h"
#include "emulated-ui/preview.h"
#include "emulated-ui/sensors.h"
#include "emulated-ui/sighting.h"
#include "emulated-ui/walk_motion.h"
#include "emulated-ui/walk_scan.h"
#include "pointclouds/filters/cleaning.h"
#include "project/survey/register_verb.h"
#include "project/survey/scan_preparation.h"
#include "project/survey/survey_verbs.h"
#include "project/verbs/file_verbs.h"
#include "survey/stations/levelling.h"

namespace standpoint {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

// Adds a scan to a station of the document as it is now.
Document withScan(Document document, const std::string& station_name, const Scan& scan) {
  Job job = *document.job;
  for (auto& station : job.stations)
    if (station.name == station_name) station.scans.push_back(scan);
  document.job = std::make_shared<const Job>(std::move(job));
  return document;
}

// Adds a walk with its scan to the document as it is now.
Document withWalk(Document document, const CarriedTrajectory& walked) {
  Job job = *document.job;
  std::erase_if(job.trajectories, [&](const CarriedTrajectory& t) { return t.name == walked.name; });
  job.trajectories.push_back(walked);
  document.job = std::make_shared<const Job>(std::move(job));
  return document;
}

// The last number in a setup's name.
int numberIn(const std::string& name) {
  auto from = name.find_last_not_of("0123456789");
  from = from == std::string::npos ? 0 : from + 1;
  int number = 0;
  return std::sscanf(name.c_str() + from, "%9d", &number) == 1 ? number : 0;
}

LinkResult linkFrom(const RegisterAnswer& answer, const Document& solved) {
  const auto& row = answer.stations.back();
  LinkResult link;
  if (!row.fit) return link;
  link.error_m = row.fit->rms_m;
  link.overlap = row.fit->used_fraction;
  link.true_error_m = row.true_error_m;
  link.true_error_deg = row.true_turn_error_rad / kRadPerDeg;
  if (const auto* station = stationOf(solved, row.name); station != nullptr && station->solved_pose) {
    const Pose &to = *station->solved_pose, &from = station->true_pose;
    link.error.rotation = to.rotation * from.rotation.conjugate();
    link.error.translation = to.translation - link.error.rotation * from.translation;
  }
  link.joined = row.fit->settled && row.fit->free.empty();
  return link;
}

// Of the turn: where the operator stands; nothing where the scan does not look.
std::optional<double> operatorAt(const ScanOrder& order, const Instrument& instrument) {
  if (!order.operator_in_view) return std::nullopt;
  const auto settings = resolveSettings(instrument, order.settings);
  if (!order.operator_place.azimuth_deg || !settings) return 0.5;
  const double from = settings->azimuth_from_rad / kRadPerDeg, to = settings->azimuth_to_rad / kRadPerDeg;
  const double behind = *order.operator_place.azimuth_deg - from;
  const double fraction = (behind - 360 * std::floor(behind / 360)) / (to - from);
  return fraction <= 1 ? std::optional(fraction) : std::nullopt;
}

FieldFault faultsOf(const ScanOrder& order, const Instrument& instrument) {
  FieldFault fault;
  fault.until_fraction = order.until_fraction;
  fault.noise_factor = std::max(1.0, order.noise_factor);
  fault.tripod_moved_at_fraction = order.tripod_moved_at_fraction;
  fault.passer_by_at_fraction = order.passer_by_at_fraction;
  fault.operator_at_fraction = operatorAt(order, instrument);
  fault.operator_m = order.operator_place.away_m;
  fault.operator_from_fraction = order.operator_from_fraction;
  fault.operator_until_fraction = order.operator_until_fraction;
  return fault;
}

const Scan* lastScanOf(const Document& document, const std::string& station_name) {
  const auto* station = stationOf(document, station_name);
  return station == nullptr || station->scans.empty() ? nullptr : &station->scans.back();
}

// Scans what was ordered. The device's own filters take their points out of the file before it is stored.
Result<Scan> scanned(const Document& document, const ScanOrder& order, const ScanVerbOptions& wanted,
                     const ScanSurroundings& company, Progress& progress) {
  ScanVerbOptions options = wanted;
  const fs::path& file = wanted.output;
  if (!order.filters.empty()) options.output = file.parent_path() / (file.stem().string() + ".raw.e57");
  TRY_ASSIGN(const auto outcome, runScan(document, options, company, progress));
  const auto* last = lastScanOf(outcome.document, order.station);
  if (last == nullptr) return failure(ErrorKind::usage, "unknown station", order.station);
  Scan scan = *last;
  if (order.filters.empty()) return scan;
  TRY_ASSIGN(const auto filters, filtersFrom(order.filters));
  const auto cleaned = cleanCloud(options.output, file, filters, progress);
  std::error_code ignored;
  fs::remove(options.output, ignored);
  if (!cleaned) return failure(cleaned.error());
  scan.file = file.string();
  scan.points = cleaned->points_out;
  return scan;
}

}  // namespace

void putOnPlan(StoredSetup& setup, const Pose& pose) {
  const Eigen::Vector3d forward = pose.rotation * Eigen::Vector3d::UnitX();
  setup.plan_x_m = pose.translation.x();
  setup.plan_y_m = pose.translation.y();
  setup.plan_turn_rad = std::atan2(forward.y(), forward.x());
}

fs::path scanFile(const fs::path& scans_folder, const ScanOrder& order) {
  const fs::path folder =
      order.folder.empty() ? scans_folder / order.project : scans_folder / order.project / order.folder;
  return folder / (order.name + ".e57");
}

namespace {

// Nothing where another instrument made it, or its name has no number.
std::optional<StoredSetup> storedSetup(const Scan& scan, const DeviceType& type) {
  const fs::path file = scan.file;
  const int number = numberIn(file.stem().string());
  if (scan.instrument != type.instrument.id || number == 0) return std::nullopt;
  StoredSetup s;
  s.project = file.parent_path().filename().string();
  s.number = number;
  s.name = file.stem().string();
  s.settings = scan.settings;
  s.file = scan.file;
  s.points = scan.points;
  s.bytes = static_cast<double>(scan.points) * type.definition.body.bytes_per_point;
  s.instrument_seconds = scan.instrument_seconds;
  return s;
}

}  // namespace

std::vector<StoredSetup> storedSetups(const Document& document, const DeviceType& type) {
  std::vector<StoredSetup> stored;
  if (!document.job) return stored;
  for (const auto& station : document.job->stations)
    for (const auto& scan : station.scans)
      if (auto s = storedSetup(scan, type)) {
        s->station = station.name;
        putOnPlan(*s, station.solved_pose ? *station.solved_pose : station.true_pose);
        stored.push_back(*std::move(s));
      }
  for (const auto& trajectory : document.job->trajectories)
    for (const auto& scan : trajectory.scans)
      if (auto s = storedSetup(scan, type)) stored.push_back(*std::move(s));
  std::stable_sort(stored.begin(), stored.end(), [](const StoredSetup& a, const StoredSetup& b) {
    return std::pair(a.project, a.number) < std::pair(b.project, b.number);
  });
  return stored;
}

Eigen::Quaterniond leaning(const Eigen::Quaterniond& rotation, double x_deg, double y_deg) {
  if (x_deg == 0 && y_deg == 0) return rotation;
  const double angle_rad =
      std::acos(std::clamp(std::cos(x_deg * kRadPerDeg) * std::cos(y_deg * kRadPerDeg), -1.0, 1.0));
  return rotationOf(yawOf(rotation), {angle_rad, std::atan2(y_deg, x_deg)});
}

DeviceHost::DeviceHost(std::shared_ptr<const DeviceType> type, const Document& document, std::function<void()> wake)
    : device_(std::move(type)), wake_(std::move(wake)) {
  device_.load(storedSetups(document, device_.type()));
  device_.know(controlOf(document));
  known_of_ = document.job;
}

void DeviceHost::startScan(const ScanOrder& order, const Document& document, const fs::path& scans_folder) {
  file_ = scanFile(scans_folder, order);
  std::error_code error;
  fs::create_directories(file_.parent_path(), error);
  if (error) return device_.orderFailed("Cannot create " + file_.parent_path().string() + ": " + error.message());
  notes_ = order.notes;
  if (order.walk) return startWalk(order, document);
  if (const auto* station = stationOf(document, order.station)) {
    const auto readings =
        sensorReadings(document, *station, device_.type().definition.sensors, order.sensors, seed, order.number);
    notes_.insert(notes_.end(), readings.begin(), readings.end());
  }
  ScanVerbOptions options;
  options.instrument = order.instrument;
  options.settings = order.settings;
  options.stations.names = {order.station};
  options.seed = seed;
  options.output = file_;
  options.panorama = order.panorama;
  options.compensator = order.compensator ? Switch::on : Switch::off;
  options.field_fault = faultsOf(order, device_.type().instrument);
  options.truth = truth;
  options.notes = notes_;
  Document leans = leaning(document, order.station);
  ScanSurroundings company;
  if (const auto* station = stationOf(leans, order.station); station != nullptr && order.orientation) {
    auto pose = believedBy(*order.orientation, *station, order.compensator, document);
    if (!pose) return device_.orderFailed(describe(pose.error()));
    company.believed = *std::move(pose);
  }
  if (watch) company.watcher = watch(order);
  startTask(fmt::format("{}: {} at {}", device_.type().definition.title, order.name, order.station),
            [order, options, company, d = std::move(leans)](Progress& p) -> Result<Delivery> {
              auto scan = scanned(d, order, options, company, p);
              if (!scan) return failure(scan.error());
              return [order, scan = *std::move(scan)](DeviceHost& host, const Document& now) {
                host.takeScan(order, scan, now);
              };
            });
}

Result<void> DeviceHost::wayIsFree(const std::string& walk_to) const {
  const auto& walk = device_.state().walk;
  const auto numbers = numbersIn(walk_to);
  if (!walk.at || !numbers || numbers->size() < 2) return {};  // the hand itself says what is wrong
  const auto from = walk.legs.empty() ? *walk.at : std::array{walk.legs.back().x_m, walk.legs.back().y_m};
  const auto wall = map_.between(from, {numbers->at(0), numbers->at(1)});
  if (!wall.empty()) return failure(ErrorKind::usage, device_.word("in_the_way") + ": " + wall, "walk_to");
  return {};
}

Result<void> DeviceHost::hand(const std::string& id, const std::string& value) {
  if (id == "walk_to") TRY(wayIsFree(value));
  return device_.hand(id, value);
}

void DeviceHost::startWalk(const ScanOrder& order, const Document& document) {
  const WalkScanOptions options{file_, seed, truth, device_.type().instrument.moving->mount};
  startTask(fmt::format("{}: {}", device_.type().definition.title, order.name),
            [order, options, document](Progress& p) -> Result<Delivery> {
              auto scanned = scanWalk(document, order, options, p);
              if (!scanned) return failure(scanned.error());
              return [order, scanned = *std::move(scanned)](DeviceHost& host, const Document&) {
                host.takeWalk(order, scanned.trajectory, scanned.result);
              };
            });
}

// Of a scan from there: by the station set-up, levelled as far as the compensator helped it and helps the scan.
Result<Pose> DeviceHost::believedBy(const StationOrientation& orientation, const Station& station, bool compensator,
                                    const Document& document) const {
  TRY_ASSIGN(const auto level,
             levelledFromScanner(station, device_.type().instrument, compensator && orientation.compensator, seed));
  if (orientation.local) return Pose{level, -document.georeference->shift_m};  // its centre is the origin of the file
  return Pose{orientation.pose.rotation * level, orientation.pose.translation};
}

// The station leans as the device does: what its hands and the ground made of it.
Document DeviceHost::leaning(Document document, const std::string& station_name) const {
  const auto& around = device_.state().around;
  if (!document.job) return document;
  Job job = *document.job;
  for (auto& station : job.stations)
    if (station.name == station_name)
      station.true_pose.rotation =
          standpoint::leaning(station.true_pose.rotation, around.tilt_x_deg, around.tilt_y_deg);
  document.job = std::make_shared<const Job>(std::move(job));
  return document;
}

void DeviceHost::startTask(std::string title, Task<Delivery>::Work work) {
  task_ = std::make_unique<Task<Delivery>>(std::move(title), std::move(work), wake_);
}

void DeviceHost::start(const Order& order, const Document& document, const fs::path& scans_folder) {
  if (scans_folder.empty()) return device_.orderFailed("Save the project first. Scans are stored in its folder.");
  running_ = order;
  if (const auto* scan = std::get_if<ScanOrder>(&order)) return startScan(*scan, document, scans_folder);
  if (const auto* link = std::get_if<LinkOrder>(&order)) {
    RegisterOptions options;
    options.files = {link->to_file, link->from_file};
    options.cloud = true;
    options.seed = seed;
    if (link->shift_x_m != 0 || link->shift_y_m != 0 || link->turn_deg != 0)
      options.start_offset = StartOffset{link->shift_x_m, link->shift_y_m, link->turn_deg};
    startTask("Link", [document, options](Progress& p) -> Result<Delivery> {
      TRY_ASSIGN(const auto outcome, runRegister(document, options, p));
      return [link = linkFrom(outcome.answer, outcome.document)](DeviceHost& host, const Document&) {
        host.device_.linkDone(link);
      };
    });
  } else if (const auto* targets = std::get_if<TargetOrder>(&order)) {
    startTask("Targets", [document, file = targets->file, s = seed](Progress& p) -> Result<Delivery> {
      auto found = targetsIn(document, file, s, p);
      if (!found) return failure(found.error());
      return [found = *std::move(found)](DeviceHost& host, const Document&) { host.device_.targetsDone(found); };
    });
  } else if (const auto* pick = std::get_if<PickOrder>(&order)) {
    startTask("Target", [document, order = *pick, s = seed](Progress& p) -> Result<Delivery> {
      auto picked = pickedTarget(document, order, s, p);
      if (!picked) return failure(picked.error());
      return [file = order.file, picked = *std::move(picked)](DeviceHost& host, const Document&) {
        host.device_.pickDone(file, picked);
      };
    });
  } else if (std::holds_alternative<SceneOrder>(order)) {
    startTask("Surroundings", [document](Progress& p) -> Result<Delivery> {
      TRY_ASSIGN(auto scene, RayScene::build(document.environment(), p));
      return [scene = std::move(scene), g = *document.georeference](DeviceHost& host, const Document&) {
        const auto& moving = host.device_.type().instrument.moving;
        host.map_.begin(scene, g, carrierOfMount(moving ? moving->mount : "").limits.height_m);
        host.device_.sceneDone();
      };
    });
  } else if (const auto* preview = std::get_if<PreviewOrder>(&order)) {
    startTask("Preview", [file = preview->file](Progress& p) -> Result<Delivery> {
      auto read = readPreview(file, p);
      if (!read) return failure(read.error());
      return
          [file, read = *std::move(read)](DeviceHost& host, const Document&) { host.device_.previewDone(file, read); };
    });
  } else if (const auto* sight = std::get_if<SightOrder>(&order)) {
    std::error_code ignored;
    fs::create_directories(scans_folder, ignored);
    startTask("Target",
              [document = leaning(document, sight->station), order = *sight, file = scans_folder / "target.e57",
               s = seed](Progress& p) -> Result<Delivery> {
                auto target = sightTarget(document, order, file, s, p);
                if (!target) return failure(target.error());
                return [target = *std::move(target)](DeviceHost& host, const Document&) {
                  host.device_.sightDone(target);
                };
              });
  } else if (const auto* transfer = std::get_if<TransferOrder>(&order)) {
    startTask("Transfer",
              [order = *transfer, links = linkedPlaces(device_.state()), shift = document.georeference->shift_m,
               office = officeBeside(scans_folder)](Progress& p) -> Result<Delivery> {
                Report report;
                TRY(handOver(order, links, shift, office, report, p));
                return [files = order.files, report = std::move(report)](DeviceHost& host, const Document&) {
                  host.report_.append(report);
                  host.device_.transferDone(files);
                };
              });
  }
}

StoredSetup DeviceHost::setupOf(const ScanOrder& order, const Scan& scan) const {
  StoredSetup s;
  s.project = order.project;
  s.number = order.number;
  s.name = order.name;
  s.settings = order.settings;
  s.file = file_.string();
  s.points = scan.points;
  s.bytes = static_cast<double>(s.points) * device_.type().definition.body.bytes_per_point;
  s.instrument_seconds = scan.instrument_seconds;
  s.notes = notes_;
  return s;
}

void DeviceHost::takeWalk(const ScanOrder& order, const CarriedTrajectory& trajectory, const WalkResult& result) {
  const Scan& scan = trajectory.scans.back();
  StoredSetup s = setupOf(order, scan);
  s.walk = result;
  station_.clear();
  walked_ = trajectory;
  finished_ = scan;
  device_.scanDone(std::move(s));
}

void DeviceHost::takeScan(const ScanOrder& order, const Scan& scan, const Document& document) {
  StoredSetup s = setupOf(order, scan);
  s.station = order.station;
  if (const auto* station = stationOf(document, order.station)) {
    putOnPlan(s, station->true_pose);
    if (order.orientation && !order.orientation->local) s.placed = errorOf(order.orientation->pose, station->true_pose);
  }
  s.operator_in_view = order.operator_in_view;
  station_ = order.station;
  finished_ = scan;
  device_.scanDone(std::move(s));
}

// The accepted set-up as the station's solved pose.
Result<Outcome> DeviceHost::oriented(const Document& document, const StationOrientation& orientation) const {
  const auto* station = stationOf(document, orientation.station);
  if (station == nullptr) return failure(ErrorKind::usage, "unknown station", orientation.station);
  const Document leans = leaning(document, orientation.station);
  TRY_ASSIGN(const auto pose,
             believedBy(orientation, *stationOf(leans, orientation.station), orientation.compensator, document));
  Job job = *document.job;
  for (auto& s : job.stations)
    if (s.name == orientation.station) s.solved_pose = pose;
  Outcome outcome{document, json::object(), {}, {}, {}};
  outcome.document.job = std::make_shared<const Job>(std::move(job));
  outcome.description = fmt::format("Oriented {} with {}", orientation.station, device_.type().definition.title);
  return outcome;
}

// Takes the task's result to the device.
void DeviceHost::collect(const Document& document) {
  if (!task_) return;
  device_.orderMoved(task_->progress().fraction());
  if (!task_->done()) return;
  const auto delivery = task_->take();
  task_.reset();
  if (delivery) return (*delivery)(*this, document);
  if (delivery.error().kind == ErrorKind::cancelled) return;
  if (std::holds_alternative<LinkOrder>(*running_)) return device_.linkDone({});  // nothing in common: no link
  device_.orderFailed(describe(delivery.error()));
}

Result<void> DeviceHost::remember(const fs::path& scans_folder) {
  const auto file = memoryFile(scans_folder, device_.type());
  std::error_code none;
  if (!scans_folder.empty() && fs::exists(file, none)) {
    TRY_ASSIGN(const auto memory, readJsonFile(file));
    if (auto recalled = recallMemory(device_, memory, scans_folder); !recalled)
      return failure(recalled.error().kind, recalled.error().message, file.string());
    kept_ = memory;
  }
  kept_at_ = device_.state().noted;
  remembers_ = true;
  return {};
}

// After whatever was done to the device by its user, and at once, as its scans are.
void DeviceHost::keepMemory(const fs::path& scans_folder) {
  const auto& state = device_.state();
  if (!remembers_ || scans_folder.empty() || state.noted == kept_at_) return;
  kept_at_ = state.noted;
  const bool used =
      std::any_of(state.log.begin(), state.log.end(), [](const DeviceEvent& e) { return e.what == "pressed"; });
  auto memory = deviceMemory(device_, scans_folder);
  if (!used || memory == kept_) return;
  const auto written = writeMemory(memoryFile(scans_folder, device_.type()), memory);
  if (!written) device_.ask("failed", describe(written.error()));
  kept_at_ = state.noted;  // a full disk is told once, not in every frame
  kept_ = std::move(memory);
}

std::optional<Outcome> DeviceHost::update(const Document& document, const fs::path& scans_folder, double seconds,
                                          bool may_store) {
  auto outcome = goOn(document, scans_folder, seconds, may_store);
  keepMemory(scans_folder);
  return outcome;
}

std::optional<Outcome> DeviceHost::goOn(const Document& document, const fs::path& scans_folder, double seconds,
                                        bool may_store) {
  if (document.job != known_of_) {
    known_of_ = document.job;
    device_.know(controlOf(document));
  }
  if (device_.takeCancel()) {
    if (task_) {
      task_->progress().cancel();
      (void)task_->take();
      task_.reset();
    }
    if (finished_) {
      std::error_code ignored;
      fs::remove(file_, ignored);
      finished_.reset();
    }
  }
  if (!task_)
    if (const auto order = device_.takeOrder()) start(*order, document, scans_folder);
  collect(document);
  if (!clockStands()) device_.tick(seconds * time_factor);
  if (auto map = map_.grow(device_.state().walk)) device_.seen(std::move(map));
  if (!may_store) return std::nullopt;
  if (const auto orientation = device_.takeOriented()) {
    if (const auto* station = stationOf(document, orientation->station))
      device_.orientationErred(errorOf(orientation->pose, station->true_pose));
    if (auto done = oriented(document, *orientation)) return *std::move(done);
    device_.note("failed", "orientation");
  }
  if (!finished_ || !device_.takeStored()) return std::nullopt;
  const auto name = fs::path(finished_->file).stem().string();
  const auto& title = device_.type().definition.title;
  const bool carried = station_.empty();
  Outcome outcome{
      carried ? withWalk(document, walked_) : withScan(document, station_, *finished_), json::object(), {}, {}, {}};
  outcome.description = carried ? fmt::format("Scanned '{}' on foot with {}", name, title)
                                : fmt::format("Scanned '{}' at {} with {}", name, station_, title);
  finished_.reset();
  return outcome;
}

}  // namespace standpoint
