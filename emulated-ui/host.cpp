// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/host.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <fmt/format.h>

#include "core/units.h"
#include "emulated-ui/memory.h"
#include "emulated-ui/preview.h"
#include "emulated-ui/sensors.h"
#include "emulated-ui/sighting.h"
#include "materials/json_file.h"
#include "pointclouds/files/file_access.h"
#include "pointclouds/filters/cleaning.h"
#include "pointclouds/formats.h"
#include "project/levelling.h"

namespace standpoint {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

const char* const kCopies = "office";  // folder beside the scans, where copies go

// Adds a scan to a station of the document as it is now.
Document withScan(Document document, const std::string& station_name, const Scan& scan) {
  Job job = *document.job;
  for (auto& station : job.stations)
    if (station.name == station_name) station.scans.push_back(scan);
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

LinkResult linkFrom(const json& answer, const Document& solved) {
  const auto& row = answer.at("stations").back();
  LinkResult link;
  if (!row.contains("fit")) return link;
  link.error_m = row["fit"].at("rms_m");
  link.overlap = row["fit"].at("used_share");
  link.true_error_m = row.at("true_error_m");
  link.true_error_deg = row.at("true_turn_error_deg");
  if (const auto* station = stationOf(solved, row.at("name").get<std::string>());
      station != nullptr && station->solved_pose) {
    const Pose &to = *station->solved_pose, &from = station->true_pose;
    link.error.rotation = to.rotation * from.rotation.conjugate();
    link.error.translation = to.translation - link.error.rotation * from.translation;
  }
  link.joined = row["fit"].at("settled").get<bool>() && row["fit"].at("not_held").empty();
  return link;
}

// Converted where another format is asked for; that the points are there is what convertCloud promises.
Result<void> copyAs(const fs::path& from, const fs::path& to, Report& report, Progress& progress) {
  const auto written = convertCloud(from, to, "", report, progress);
  if (!written) return failure(written.error());
  return {};
}

constexpr std::size_t kCopiedAtOnce = 4U << 20U;

// Byte for byte. A copy that was broken off is not taken for a whole one (PartFile).
Result<void> copyFile(const fs::path& from, const fs::path& to, Progress& progress) {
  const auto in = InputFile::open(from);
  if (!in) return failure(in.error());
  auto out = PartFile::create(to);
  if (!out) return failure(out.error());
  std::vector<std::uint8_t> buffer(kCopiedAtOnce);
  while (out->size() < in->size()) {
    if (auto going = progress.check(); !going) return failure(going.error());
    const auto read = in->read(out->size(), buffer);
    if (!read) return failure(read.error());
    if (*read == 0) return failure(ErrorKind::file_system, "the file was truncated while copying", from.string());
    if (auto written = out->append({buffer.data(), *read}); !written) return written;
    progress.advance(static_cast<double>(out->size()) / static_cast<double>(in->size()));
  }
  return out->commit();
}

Result<Outcome> copyFiles(const Document& document, const TransferOrder& order, const fs::path& folder,
                          Progress& progress) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return failure(ErrorKind::file_system, "cannot create the folder: " + error.message(), folder.string());
  json copied = json::array();
  Report report;
  const double each = 1.0 / static_cast<double>(order.files.size());
  for (const auto& file : order.files) {
    if (auto going = progress.check(); !going) return failure(going.error());
    fs::path to =
        folder / (fs::path(file).parent_path().filename().string() + " - " + fs::path(file).filename().string());
    const double from_fraction = static_cast<double>(copied.size()) * each;
    progress.stage("Copying " + fs::path(file).filename().string(), from_fraction, from_fraction + each);
    const auto done = order.extension.empty() ? copyFile(file, to, progress)
                                              : copyAs(file, to.replace_extension(order.extension), report, progress);
    if (!done) return failure(done.error());
    copied.push_back(file);
  }
  return Outcome{document, copied, report, {}, {}};
}

}  // namespace

fs::path scanFile(const fs::path& scans_folder, const ScanOrder& order) {
  const fs::path folder =
      order.folder.empty() ? scans_folder / order.project : scans_folder / order.project / order.folder;
  return folder / (order.name + ".e57");
}

std::vector<StoredSetup> storedSetups(const Document& document, const DeviceType& type) {
  std::vector<StoredSetup> stored;
  if (!document.job) return stored;
  for (const auto& station : document.job->stations)
    for (const auto& scan : station.scans) {
      const fs::path file = scan.file;
      const int number = numberIn(file.stem().string());
      if (scan.instrument != type.instrument.id || number == 0) continue;
      StoredSetup s;
      s.project = file.parent_path().filename().string();
      s.number = number;
      s.name = file.stem().string();
      s.station = station.name;
      s.settings = scan.settings;
      s.file = scan.file;
      s.points = scan.points;
      s.bytes = static_cast<double>(scan.points) * type.definition.body.bytes_per_point;
      s.instrument_seconds = scan.instrument_seconds;
      const auto& pose = station.solved_pose ? *station.solved_pose : station.true_pose;
      s.plan_x_m = pose.translation.x();
      s.plan_y_m = pose.translation.y();
      stored.push_back(std::move(s));
    }
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
  json options = scanOptions(order.instrument, order.settings, order.station, seed, file_);
  if (order.panorama) options["panorama"] = true;
  if (!order.compensator) options["compensator"] = "off";
  json field_fault = json::array();
  if (order.until_fraction < 1) field_fault.push_back(fmt::format("until={}", order.until_fraction));
  if (order.noise_factor > 1) field_fault.push_back(fmt::format("noise={}", order.noise_factor));
  if (order.tripod_moved_at_fraction)
    field_fault.push_back(fmt::format("tripod_moved={}", *order.tripod_moved_at_fraction));
  if (order.passer_by_at_fraction) field_fault.push_back(fmt::format("passer_by={}", *order.passer_by_at_fraction));
  if (order.operator_in_view) field_fault.push_back("operator_in_view=0.5");
  if (!field_fault.empty()) options["field-fault"] = field_fault;
  if (truth) options["truth"] = true;
  notes_ = order.notes;
  if (const auto* station = stationOf(document, order.station)) {
    const auto readings =
        sensorReadings(document, *station, device_.type().definition.sensors, order.sensors, seed, order.number);
    notes_.insert(notes_.end(), readings.begin(), readings.end());
  }
  for (const auto& [key, text] : notes_) options["note"].push_back(key + "=" + text);
  const auto title = fmt::format("{}: {} at {}", device_.type().definition.title, order.name, order.station);
  if (!order.filters.empty()) return startFiltered(title, order, document, options);
  task_ = std::make_unique<Task>(title, *findVerb(verbs(), "scan"), leaning(document, order.station), options, wake_);
}

// The device's own filters: what they take is never stored.
void DeviceHost::startFiltered(const std::string& title, const ScanOrder& order, const Document& document,
                               const json& options) {
  auto work = [options, filters = order.filters, file = file_, station = order.station](
                  const Document& d, Progress& p) -> Result<Outcome> {
    const fs::path raw = file.parent_path() / (file.stem().string() + ".raw.e57");
    json all = options;
    all["output"] = raw.string();
    auto outcome = runVerb(*findVerb(verbs(), "scan"), d, all, p);
    if (!outcome) return outcome;
    std::vector<ChosenFilter> chosen;
    for (const auto& text : filters) {
      auto filter = filterFrom(text);
      if (!filter) return failure(filter.error());
      chosen.push_back(*std::move(filter));
    }
    const auto cleaned = cleanCloud(raw, file, chosen, p);
    std::error_code ignored;
    fs::remove(raw, ignored);
    if (!cleaned) return failure(cleaned.error());
    outcome->answer["stations"][0]["points"] = cleaned->points_out;
    Job job = *outcome->document.job;
    for (auto& s : job.stations)
      if (s.name == station) s.scans.back().file = file.string(), s.scans.back().points = cleaned->points_out;
    outcome->document.job = std::make_shared<const Job>(std::move(job));
    return outcome;
  };
  task_ = std::make_unique<Task>(title, *findVerb(verbs(), "scan"), leaning(document, order.station), options, wake_,
                                 std::move(work));
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

void DeviceHost::startWork(const std::string& title, const Document& document, Task::Work work) {
  task_ = std::make_unique<Task>(title, *findVerb(verbs(), "register"), document, json{{"files", json::array({"-"})}},
                                 wake_, std::move(work));
}

void DeviceHost::start(const Order& order, const Document& document, const fs::path& scans_folder) {
  if (scans_folder.empty()) return device_.orderFailed("Save the project first. Scans are stored in its folder.");
  running_ = order;
  if (const auto* scan = std::get_if<ScanOrder>(&order)) return startScan(*scan, document, scans_folder);
  if (const auto* link = std::get_if<LinkOrder>(&order)) {
    json options = {{"files", {link->to_file, link->from_file}}, {"cloud", true}, {"seed", seed}};
    if (link->shift_x_m != 0 || link->shift_y_m != 0 || link->turn_deg != 0)
      options["start-offset"] = fmt::format("{},{},{}", link->shift_x_m, link->shift_y_m, link->turn_deg);
    task_ = std::make_unique<Task>("Link", *findVerb(verbs(), "register"), document, options, wake_);
  } else if (const auto* targets = std::get_if<TargetOrder>(&order)) {
    startWork("Targets", document,
              [file = targets->file, s = seed](const Document& d, Progress& p) { return targetsIn(d, file, s, p); });
  } else if (const auto* preview = std::get_if<PreviewOrder>(&order)) {
    startWork("Preview", document, [this, file = preview->file](const Document& d, Progress& p) -> Result<Outcome> {
      auto read = readPreview(file, p);
      if (!read) return failure(read.error());
      preview_ = *std::move(read);
      return Outcome{d, json::object(), {}, {}, {}};
    });
  } else if (const auto* sight = std::get_if<SightOrder>(&order)) {
    std::error_code ignored;
    fs::create_directories(scans_folder, ignored);
    startWork("Target", document,
              [order = *sight, file = scans_folder / "target.e57", s = seed](const Document& d, Progress& p) {
                return sightTarget(d, order, file, s, p);
              });
  } else if (const auto* transfer = std::get_if<TransferOrder>(&order)) {
    startWork("Transfer", document,
              [order = *transfer, folder = scans_folder.parent_path() / kCopies](const Document& d, Progress& p) {
                return copyFiles(d, order, folder, p);
              });
  }
}

void DeviceHost::takeResult(Outcome outcome, const Document& document) {
  if (const auto* scan = std::get_if<ScanOrder>(&*running_)) {
    const auto& row = outcome.answer.at("stations").at(0);
    StoredSetup s;
    s.project = scan->project;
    s.number = scan->number;
    s.name = scan->name;
    s.station = scan->station;
    s.settings = scan->settings;
    s.file = file_.string();
    s.points = row.at("points").get<std::uint64_t>();
    s.bytes = static_cast<double>(s.points) * device_.type().definition.body.bytes_per_point;
    s.instrument_seconds = row.at("instrument_seconds").get<double>();
    s.notes = notes_;
    if (const auto* station = stationOf(document, scan->station)) {
      s.plan_x_m = station->true_pose.translation.x();
      s.plan_y_m = station->true_pose.translation.y();
    }
    station_ = scan->station;
    if (const auto* station = stationOf(outcome.document, scan->station)) finished_ = station->scans.back();
    device_.scanDone(std::move(s));
  } else if (std::holds_alternative<LinkOrder>(*running_)) {
    device_.linkDone(linkFrom(outcome.answer, outcome.document));
  } else if (std::holds_alternative<TargetOrder>(*running_)) {
    device_.targetsDone(targetsFrom(outcome.answer));
  } else if (std::holds_alternative<SightOrder>(*running_)) {
    device_.sightDone(targetsFrom(json::array({outcome.answer})).front());
  } else if (const auto* preview = std::get_if<PreviewOrder>(&*running_)) {
    device_.previewDone(preview->file, std::move(preview_));
  } else if (const auto* transfer = std::get_if<TransferOrder>(&*running_)) {
    device_.transferDone(transfer->files);
  }
}

// The accepted set-up as the station's solved pose.
Result<Outcome> DeviceHost::oriented(const Document& document, const StationOrientation& orientation) const {
  const auto* station = stationOf(document, orientation.station);
  if (station == nullptr) return failure(ErrorKind::usage, "unknown station", orientation.station);
  const auto level = levelledFromScanner(*station, device_.type().instrument, orientation.compensator, seed);
  if (!level) return failure(level.error());
  Job job = *document.job;
  for (auto& s : job.stations)
    if (s.name == orientation.station)
      s.solved_pose = Pose{orientation.pose.rotation * *level, orientation.pose.translation};
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
  auto outcome = task_->take();
  task_.reset();
  if (outcome) return takeResult(*std::move(outcome), document);
  if (outcome.error().kind == ErrorKind::cancelled) return;
  if (std::holds_alternative<LinkOrder>(*running_)) return device_.linkDone({});  // nothing in common: no link
  device_.orderFailed(describe(outcome.error()));
}

Result<void> DeviceHost::remember(const fs::path& scans_folder) {
  const auto file = memoryFile(scans_folder, device_.type());
  std::error_code none;
  if (!scans_folder.empty() && fs::exists(file, none)) {
    const auto memory = readJsonFile(file);
    if (!memory) return failure(memory.error());
    if (auto recalled = recallMemory(device_, *memory, scans_folder); !recalled)
      return failure(recalled.error().kind, recalled.error().message, file.string());
    kept_ = *memory;
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
  if (!may_store) return std::nullopt;
  if (const auto orientation = device_.takeOriented()) {
    if (auto done = oriented(document, *orientation)) return *std::move(done);
    device_.note("failed", "orientation");
  }
  if (!finished_ || !device_.takeStored()) return std::nullopt;
  Outcome outcome{withScan(document, station_, *finished_), json::object(), {}, {}, {}};
  outcome.description = fmt::format("Scanned '{}' at {} with {}", fs::path(finished_->file).stem().string(), station_,
                                    device_.type().definition.title);
  finished_.reset();
  return outcome;
}

}  // namespace standpoint
