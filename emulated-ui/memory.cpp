// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/memory.h"

#include <algorithm>
#include <array>

#include "core/part_file.h"
#include "emulated-ui/device/replaced.h"

namespace standpoint {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr int kMemoryVersion = 1;
const std::string kScans = "scans:";  // stands for the folder

// Of the fields that were typed, those whose content is kept; the others are of the moment.
constexpr std::array kKeptEntries = {"button", "bundle", "profile", "profile_settings", "station_id"};

// What was typed need not be sound UTF-8.
std::string dumped(const json& j, int indent = -1) {
  return j.dump(indent, ' ', false, json::error_handler_t::replace);
}

// The folder as it begins a file's name within JSON.
std::string inJson(const fs::path& folder) {
  const auto quoted = dumped(json((folder / "").string()));
  return quoted.substr(1, quoted.size() - 2);
}

json toJson(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
json toJson(const Eigen::Quaterniond& q) { return {q.w(), q.x(), q.y(), q.z()}; }
json toJson(const Pose& pose) { return {{"turn", toJson(pose.rotation)}, {"place", toJson(pose.translation)}}; }
Eigen::Vector3d vectorFrom(const json& j) {
  return {j.at(0).get<double>(), j.at(1).get<double>(), j.at(2).get<double>()};
}
Pose poseFrom(const json& j) {
  const auto& q = j.at("turn");
  const Eigen::Quaterniond turn(q.at(0).get<double>(), q.at(1).get<double>(), q.at(2).get<double>(),
                                q.at(3).get<double>());
  return {turn.normalized(), vectorFrom(j.at("place"))};
}

json toJson(const LinkResult& l) {
  return {{"joined", l.joined},
          {"error_m", l.error_m},
          {"overlap", l.overlap},
          {"true_error_m", l.true_error_m},
          {"true_error_deg", l.true_error_deg},
          {"error", toJson(l.error)},
          {"to", l.to}};
}
LinkResult linkFrom(const json& j) {
  return {j.at("joined"),         j.at("error_m"),         j.at("overlap"),  j.at("true_error_m"),
          j.at("true_error_deg"), poseFrom(j.at("error")), j.value("to", "")};
}

json toJson(const FittedTarget& t) {
  return {{"name", t.name},
          {"kind", t.kind},
          {"points", t.points},
          {"range_m", t.range_m},
          {"residual_m", t.residual_m},
          {"error_m", t.error_m},
          {"found", t.found},
          {"why_not", t.why_not},
          {"levelled_m", toJson(t.levelled_m)},
          {"centre_m", toJson(t.centre_m)}};
}
FittedTarget targetFrom(const json& j) {
  FittedTarget t;
  t.name = j.at("name"), t.kind = j.at("kind"), t.points = j.at("points"), t.range_m = j.at("range_m");
  t.residual_m = j.at("residual_m"), t.error_m = j.at("error_m"), t.found = j.at("found"), t.why_not = j.at("why_not");
  t.levelled_m = vectorFrom(j.at("levelled_m")), t.centre_m = vectorFrom(j.at("centre_m"));
  return t;
}

json toJson(const PlaceError& e) { return {e.plan_m, e.height_m, e.turn_rad}; }
PlaceError placeErrorFrom(const json& j) { return {j.at(0), j.at(1), j.at(2)}; }

json toJson(const WalkResult& w) {
  return {{"way", w.way},           {"seconds", w.seconds}, {"length_m", w.length_m},
          {"closures", w.closures}, {"held", w.held},       {"errors", w.errors}};
}
WalkResult walkFrom(const json& j) {
  WalkResult w;
  w.way = j.at("way").get<WalkedWay>();
  w.seconds = j.at("seconds"), w.length_m = j.at("length_m");
  w.closures = j.at("closures"), w.held = j.at("held");
  w.errors = j.at("errors").get<std::vector<std::array<double, 5>>>();
  return w;
}

json toJson(const StoredSetup& s) {
  json j = {{"file", s.file},
            {"number", s.number},
            {"partial", s.partial},
            {"unlevelled", s.unlevelled},
            {"lean_deg", {s.lean_x_deg, s.lean_y_deg}},
            {"stood_deg", {s.stood_x_deg, s.stood_y_deg}},
            {"moved", s.moved},
            {"tracked", s.tracked},
            {"looked_at", s.looked_at},
            {"transferred", s.transferred},
            {"notes", s.notes}};
  for (const auto& t : s.targets) j["targets"].push_back(toJson(t));
  if (s.link) j["link"] = toJson(*s.link);
  if (s.operator_in_view) j["operator_in_view"] = true;
  if (s.placed) j["placed"] = toJson(*s.placed);
  if (s.walk) j["walk"] = toJson(*s.walk);
  return j;
}
// The rest of it is what the project holds.
void recallSetup(const json& j, StoredSetup& s) {
  s.number = j.at("number");
  s.partial = j.at("partial"), s.unlevelled = j.at("unlevelled"), s.moved = j.at("moved"), s.tracked = j.at("tracked");
  s.lean_x_deg = j.at("lean_deg").at(0), s.lean_y_deg = j.at("lean_deg").at(1);
  if (j.contains("stood_deg")) s.stood_x_deg = j["stood_deg"].at(0), s.stood_y_deg = j["stood_deg"].at(1);
  s.looked_at = j.at("looked_at"), s.transferred = j.at("transferred");
  s.notes = j.at("notes").get<SettingValues>();
  s.targets.clear();
  for (const auto& t : j.value("targets", json::array())) s.targets.push_back(targetFrom(t));
  if (j.contains("link")) s.link = linkFrom(j["link"]);
  s.operator_in_view = j.value("operator_in_view", false);
  if (j.contains("placed")) s.placed = placeErrorFrom(j["placed"]);
  if (j.contains("walk")) s.walk = walkFrom(j["walk"]);
}

json toJson(const std::vector<ControlPlace>& places) {
  json j = json::array();
  for (const auto& p : places) j.push_back({{"name", p.name}, {"place_m", toJson(p.place_m)}});
  return j;
}
std::vector<ControlPlace> placesFrom(const json& j) {
  std::vector<ControlPlace> places;
  for (const auto& p : j) places.push_back({p.at("name"), vectorFrom(p.at("place_m"))});
  return places;
}

json toJson(const SightedTarget& s) {
  return {{"id", s.id},
          {"place_m", toJson(s.place_m)},
          {"height_m", s.height_m},
          {"residual_m", s.residual_m},
          {"points", s.points},
          {"used", s.used}};
}
SightedTarget sightFrom(const json& j) {
  return {j.at("id"), vectorFrom(j.at("place_m")), j.at("height_m"), j.at("residual_m"), j.at("points"), j.at("used")};
}

json toJson(const StationOrientation& o) {
  json j = {{"method", o.method},     {"station", o.station},         {"pose", toJson(o.pose)},
            {"rms_m", o.rms_m},       {"compensator", o.compensator}, {"local", o.local},
            {"accepted", o.accepted}, {"targets", json::array()}};
  for (const auto& t : o.targets) j["targets"].push_back({{"id", t.id}, {"residual_m", t.residual_m}});
  if (o.carried_away) j["carried_away"] = true;
  if (o.error) j["error"] = toJson(*o.error);
  return j;
}
StationOrientation orientationFrom(const json& j) {
  StationOrientation o;
  o.method = j.at("method"), o.station = j.at("station"), o.pose = poseFrom(j.at("pose")), o.rms_m = j.at("rms_m");
  o.compensator = j.at("compensator"), o.local = j.at("local"), o.accepted = j.at("accepted");
  for (const auto& t : j.at("targets")) o.targets.push_back({t.at("id"), t.at("residual_m")});
  o.carried_away = j.value("carried_away", false);
  if (j.contains("error")) o.error = placeErrorFrom(j["error"]);
  return o;
}

json toJson(const DeviceProject& p) {
  json j = {{"name", p.name},
            {"base", p.base},
            {"note", p.note},
            {"first", p.first},
            {"cluster", p.cluster},
            {"photo", p.photo},
            {"carried", toJson(p.carried)},
            {"setups", json::array()}};
  for (const auto& s : p.setups) j["setups"].push_back(toJson(s));
  return j;
}

bool isKept(const DeviceType& type, const std::string& value) {
  const auto* row = findValue(type.definition, value);
  return row == nullptr ? value != "false_start"
                        : row->kept;  // what code has added, such as annotations; a trouble is none
}

// A choice that the device does not have any more is as good as none.
bool stillThere(const DeviceType& type, const std::string& id, const std::string& value) {
  const auto* row = findValue(type.definition, id);
  return row == nullptr || row->choices.empty() ||
         std::find(row->choices.begin(), row->choices.end(), value) != row->choices.end();
}

// Takes the setup of that file out of the projects that hold it.
std::optional<StoredSetup> taken(std::vector<DeviceProject>& projects, const std::string& file) {
  for (auto& p : projects)
    for (auto s = p.setups.begin(); s != p.setups.end(); ++s)
      if (s->file == file) {
        StoredSetup found = std::move(*s);
        p.setups.erase(s);
        return found;
      }
  return std::nullopt;
}

std::vector<DeviceProject> recalledProjects(const json& memory, std::vector<DeviceProject> held) {
  std::vector<DeviceProject> projects;
  for (const auto& row : memory) {
    DeviceProject p;
    p.name = row.at("name"), p.base = row.at("base"), p.note = row.at("note"), p.first = row.at("first");
    p.cluster = row.at("cluster"), p.photo = row.at("photo"), p.carried = placesFrom(row.at("carried"));
    for (const auto& s : row.at("setups"))
      if (auto setup = taken(held, s.at("file"))) {
        setup->project = p.name;
        recallSetup(s, *setup);
        p.setups.push_back(*std::move(setup));
      }
    projects.push_back(std::move(p));
  }
  for (auto& p : held) {
    if (p.setups.empty()) continue;
    const auto same = std::find_if(projects.begin(), projects.end(),
                                   [&](const DeviceProject& known) { return known.name == p.name; });
    if (same == projects.end())
      projects.push_back(std::move(p));
    else
      same->setups.insert(same->setups.end(), p.setups.begin(), p.setups.end());
  }
  return projects;
}

void recallState(const json& m, const DeviceType& type, DeviceState& s) {
  using Texts = std::map<std::string, std::string>;
  for (const auto& [id, value] : m.at("values").get<Texts>())
    if (isKept(type, id) && stillThere(type, id, value)) s.values[id] = value;
  for (const auto& [id, text] : m.at("entries").get<Texts>()) s.entries[id] = text;
  if (const auto language = s.values.find("language"); language != s.values.end()) s.language = language->second;
  s.projects = recalledProjects(m.at("projects"), s.projects);
  const auto name = m.at("open").get<std::string>();
  const auto open =
      std::find_if(s.projects.begin(), s.projects.end(), [&](const DeviceProject& p) { return p.name == name; });
  s.project = open == s.projects.end() ? -1 : static_cast<int>(open - s.projects.begin());
  s.shown = -1;
  s.around.card_used_bytes = m.at("card_used_bytes");
  const auto station = m.at("station").get<std::string>();
  const auto& stands = s.control.stations;
  if (std::none_of(stands.begin(), stands.end(), [&](const ControlPlace& p) { return p.name == station; })) return;
  s.around.station = station;
  for (const auto& t : m.at("sighted")) s.sighted.push_back(sightFrom(t));
  if (m.contains("orientation")) s.orientation = orientationFrom(m["orientation"]);
  if (m.contains("accepted"))
    s.accepted = orientationFrom(m["accepted"]);
  else if (s.orientation && s.orientation->accepted)
    s.accepted = s.orientation;  // of a version that kept one
}

}  // namespace

json deviceMemory(const Device& device, const fs::path& scans_folder) {
  const auto& s = device.state();
  json m = {{"version", kMemoryVersion},
            {"settings", s.settings},
            {"values", json::object()},
            {"entries", json::object()},
            {"projects", json::array()},
            {"open", device.project() == nullptr ? "" : device.project()->name},
            {"card_used_bytes", s.around.card_used_bytes},
            {"station", s.around.station},
            {"sighted", json::array()}};
  for (const auto& [id, value] : s.values)
    if (isKept(device.type(), id)) m["values"][id] = value;
  for (const char* id : kKeptEntries)
    if (const auto text = device.entry(id); !text.empty()) m["entries"][id] = text;
  for (const auto& p : s.projects) m["projects"].push_back(toJson(p));
  for (const auto& t : s.sighted) m["sighted"].push_back(toJson(t));
  if (s.orientation) m["orientation"] = toJson(*s.orientation);
  if (s.accepted) m["accepted"] = toJson(*s.accepted);
  return json::parse(replaced(dumped(m), inJson(scans_folder), kScans));
}

Result<void> recallMemory(Device& device, const json& memory, const fs::path& scans_folder) {
  try {
    if (memory.at("version").get<int>() != kMemoryVersion)
      return failure(ErrorKind::unusable, "created by a different version", "/version");
    const auto m = json::parse(replaced(dumped(memory), kScans, inJson(scans_folder)));
    DeviceState recalled = device.state();
    recallState(m, device.type(), recalled);
    const auto settings = m.at("settings").get<SettingValues>();
    device.change() = std::move(recalled);
    (void)device.setSettings(settings);  // those of a data sheet that has changed since are the standard ones
    return {};
  } catch (const json::exception& e) {
    return failure(ErrorKind::unusable, e.what(), "device memory");
  }
}

Result<void> writeMemory(const fs::path& file, const json& memory) {
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  if (error)
    return failure(ErrorKind::file_system, "cannot create the folder: " + error.message(), file.parent_path().string());
  return writeWholeText(file, dumped(memory, 1) + "\n");
}

fs::path memoryFile(const fs::path& scans_folder, const DeviceType& type) {
  return scans_folder / (type.instrument.id + ".device.json");
}

}  // namespace standpoint
