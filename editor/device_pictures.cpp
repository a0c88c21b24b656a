// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/device_pictures.h"

#include <algorithm>
#include <cmath>
#include <iostream>

#include <imgui.h>

#include "core/data_folder.h"
#include "editor/instrument/preview_picture.h"
#include "emulated-ui/draw/device_view.h"
#include "emulated-ui/host.h"
#include "emulated-ui/menus.h"
#include "emulated-ui/preview.h"
#include "emulated-ui/walk_map.h"
#include "emulated-ui/walk_motion.h"

namespace standpoint {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

FittedTarget fitted(const char* name, const char* kind, int points, double range_m) {
  FittedTarget t;
  t.name = name;
  t.kind = kind;
  t.points = points;
  t.range_m = range_m;
  t.residual_m = 0.0007;
  t.found = points > 0;
  if (!t.found) t.why_not = "too few points";
  return t;
}

// A walk through living room and hall, as far as the last leg but one.
Result<WalkState> walkedHouse(const Document& document) {
  constexpr std::array<std::array<double, 2>, 6> kWay = {
      {{4, 1.6}, {5.5, 1.6}, {5.5, 3.45}, {7.2, 3.45}, {7.2, 4.6}, {7.2, 3.45}}};
  Progress quiet;
  TRY_ASSIGN(auto scene, RayScene::build(document.environment(), quiet));
  WalkMap map;
  map.begin(std::move(scene), *document.georeference, carrierOfMount("hand").limits.height_m);
  WalkState walk;
  walk.recording = walk.scene = true;
  for (const auto& [x, y] : kWay) {
    walk.way.push_back({x, y, walk.recorded_s});
    walk.recorded_s += 4;
  }
  walk.at = {6.4, 3.45};
  walk.ahead_of = {-1, 0};
  walk.speed_mps = 0.8;
  walk.seen = map.grow(walk);
  return walk;
}

// What two quick scans of the sample house look like on any device, and a walk through it.
struct SampleWork {
  std::vector<StoredSetup> setups;
  WalkState walk;
};
Result<SampleWork> scannedHouse(const fs::path& folder) {
  Progress quiet;
  Document document;
  const auto run = [&](const char* verb, const json& options) -> Result<void> {
    TRY_ASSIGN(auto outcome, runVerb(*findVerb(verbs(), verb), document, options, quiet));
    document = std::move(outcome.document);
    return {};
  };
  TRY(run("import", {{"files", {(samplesFolder() / "house.ifc").string()}}}));
  const std::pair<const char*, std::array<double, 3>> kStations[] = {{"S1", {4.3, 1.6, 0}}, {"S2", {4.4, 5.9, 0}}};
  for (const auto& [name, on] : kStations) TRY(run("station", {{"add", name}, {"on", on}}));
  TRY(run(
      "scan",
      {{"instrument", "faro-focus-s350"}, {"set", {"resolution=1/20", "quality=4x"}}, {"output", folder.string()}}));
  std::vector<StoredSetup> setups;
  for (const auto& station : document.job->stations) {
    StoredSetup s;
    s.number = static_cast<int>(setups.size()) + 1;
    s.name = "Setup 00" + std::to_string(s.number);
    s.station = station.name;
    s.file = station.scans.back().file;
    s.points = station.scans.back().points;
    s.bytes = static_cast<double>(s.points) * 26;
    s.instrument_seconds = station.scans.back().instrument_seconds;
    putOnPlan(s, station.true_pose);
    TRY_ASSIGN(auto preview, readPreview(s.file, quiet));
    s.preview = preview;
    if (s.number == 2) s.link = LinkResult{true, 0.0021, 0.43, 0.001, 0.01};
    s.targets = {fitted("T1", "sphere", 142, 4.31), fitted("T2", "checkerboard", 388, 3.02),
                 fitted("T3", "sphere", 0, 0)};
    setups.push_back(std::move(s));
  }
  TRY_ASSIGN(auto walk, walkedHouse(document));
  return SampleWork{std::move(setups), std::move(walk)};
}

// The phase that shows the screen, rather with the laser on; else the one that waits for the next scan.
const PhaseRow& phaseFor(const DeviceDefinition& d, const std::string& screen) {
  const PhaseRow *own = nullptr, *rest = nullptr;
  for (const auto& p : d.phases) {
    if (p.on && p.screen == screen && (own == nullptr || (p.laser && !own->laser))) own = &p;
    if (p.on && p.lamp.starts_with("green") && (!p.ends() || p.waits)) rest = &p;
  }
  if (own == nullptr && rest == nullptr) return d.phases.at(1);
  return own != nullptr ? *own : *rest;
}

// The walk that is recorded, waits for the office, or came back from there.
void putWalk(Device& device, const std::string& screen, const WalkState& sample) {
  auto& s = device.change();
  if (screen == "booting" || screen == "options") return;
  s.walk = sample;
  s.walk.recording = screen == "walking";
  if (screen != "processing") s.phase = s.walk.recording ? "recording" : "ready", s.running.reset();
  if (screen != "result" && screen != "walks") return;
  for (auto& setup : s.projects.front().setups) {
    setup.name = "Walk 00" + std::to_string(setup.number);
    setup.station.clear();
    setup.link.reset();
    setup.walk = WalkResult{sample.way, sample.recorded_s, lengthOf(sample.way), 1, 0, {}, sample.seen};
  }
  s.walk.way.clear();
}

// What only some devices have.
void putDetails(Device& device, const std::string& screen, const std::vector<StoredSetup>& setups) {
  auto& s = device.change();
  if (const auto* connection = findValue(device.type().definition, "connection");
      connection != nullptr && connection->choices.front() == "OK")
    s.values["connection"] = screen == "connect" ? "Disconnected" : "OK";
  if (screen == "error") s.entries["error"] = "Device_Moved", s.moved = true;
  for (const auto& setup : setups) s.values["registration." + setup.file] = "registered";
  for (const char* action : {"propose_project", "propose_new", "propose_position", "propose_pattern", "propose_area"})
    for (const auto* rows : {&device.type().program.actions, &sharedActions()})
      for (const auto& row : *rows)
        if (std::string(row.name) == action) (void)row.act(device, {});
}

void putInto(Device& device, const std::string& screen, const SampleWork& sample, const std::string& language) {
  const auto& setups = sample.setups;
  auto& s = device.change();
  const auto& phase = phaseFor(device.type().definition, screen);
  s.language = language;
  s.values["language"] = language;
  s.around.station = "S2";
  s.around.tilt_x_deg = 0.012;
  s.around.tilt_y_deg = -0.021;
  s.around.battery = 0.82;
  DeviceProject project;
  project.name = "House";
  project.base = "house_";
  project.setups = setups;
  s.projects = {project};
  s.project = 0;
  s.shown = 1;
  for (const auto& setup : setups) s.around.card_used_bytes += setup.bytes;
  s.phase = phase.id;
  s.screen = screen;
  for (const auto& row : device.type().definition.screens)  // as one comes there
    if (row.entry && row.id != screen && phase.screen != screen) s.came_from = {row.id};
  s.elapsed_s = 0.4 * device.fact("phase.lasts")->number.value_or(0);
  if (phase.screen == screen && phase.ends() && !phase.waits) {
    s.running = ScanOrder{};
    s.data = StoredSetup{};
    s.scanned_s = 0.4 * (device.expected().scan_seconds + device.expected().imaging_seconds);
  }
  putDetails(device, screen, setups);
  if (device.type().instrument.moving) putWalk(device, screen, sample.walk);
  s.entries["measured"] = "3.4180";
  s.entries["tapped"] = "0.21,0.55;0.62,0.5";
}

}  // namespace

Result<int> drawDevicePictures(const fs::path& folder, const std::string& language, float scale) {
  const auto scratch = fs::temp_directory_path() / "standpoint-device-pictures";
  TRY_ASSIGN(const auto sample, scannedHouse(scratch));
  std::error_code error;
  int count = 0;
  for (const auto& row : emulatedDevices()) {
    TRY_ASSIGN(const auto type, loadDevice(row));
    TRY_ASSIGN(auto layout, loadLayout(row, *type));
    const auto shared = std::make_shared<const Layout>(std::move(layout));
    fs::create_directories(folder / row.id, error);
    if (error) return failure(ErrorKind::file_system, error.message(), (folder / row.id).string());
    for (const auto& face : shared->faces) {
      const float fit = scale * std::min(kLayoutRoom[0] / face.box[0], kLayoutRoom[1] / face.box[1]);
      const std::array<float, 2> room = {std::ceil(fit * face.box[0]), std::ceil(fit * face.box[1])};
      const float margin = 8 * scale;
      TRY_ASSIGN(const auto offscreen, Offscreen::create(static_cast<int>(room[0] + 2 * margin),
                                                         static_cast<int>(room[1] + 2 * margin), scale));
      std::vector<std::string> screens;
      if (&face == &shared->faces.front()) screens.emplace_back();
      for (const auto& screen : type->definition.screens)
        if (faceOf(*shared, screen.id).id == face.id) screens.push_back(screen.id);
      for (const auto& screen : screens) {
        Device device(type);
        if (!screen.empty()) putInto(device, screen, sample, language);
        DeviceView view;
        view.layout = shared;
        view.still = true;
        view.font = [&](float pixels) { return lettersFor(offscreen->fonts(), pixels); };
        PreviewPictures pictures;
        view.texture = [&](const std::shared_ptr<const ScanPreview>& preview) {
          return offscreen->scene().texture(pictures.of(preview, device.value("colouring")));
        };
        const auto draw = [&] {
          ImGui::SetNextWindowPos({0, 0});
          ImGui::SetNextWindowSize({room[0] + 2 * margin, room[1] + 2 * margin});
          ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {margin, margin});
          ImGui::Begin("device", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoBackground);
          (void)drawDevice(device, view, room[0], room[1]);
          ImGui::End();
          ImGui::PopStyleVar();
        };
        TRY(offscreen->picture(draw, folder / row.id / ((screen.empty() ? "off" : screen) + ".png")));
        for (const auto& cut : view.cut) std::cerr << row.id << '/' << screen << ": cut " << cut << '\n';
        ++count;
      }
    }
  }
  fs::remove_all(scratch, error);
  return count;
}

}  // namespace standpoint
