// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/rehearsal/recorded_exercise.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "core/data_folder.h"
#include "core/part_file.h"
#include "core/units.h"
#include "emulated-ui/rehearsal/plain_words.h"
#include "survey/stations/levelling.h"

namespace standpoint {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Kind = RehearsalAction::Kind;

constexpr double kShortestWait_s = 1;

json spokenEverywhere(const Device& device, const std::function<std::string(const std::string&)>& in) {
  json texts;
  for (const auto& language : device.type().words->languages()) texts[language] = in(language);
  return texts;
}
json spokenEverywhere(const Device& device, const std::string& english) {
  return spokenEverywhere(device, [&](const std::string&) { return english; });
}

json placeOf(const Document& document, const Eigen::Vector3d& local) {
  const Eigen::Vector3d at = local + document.georeference->shift_m;
  return {at.x(), at.y(), at.z()};
}

// The verbs that put up what stands there.
json standing(const Document& document) {
  json verbs = json::array();
  if (!document.job || !document.georeference) return verbs;
  for (const auto& s : document.job->stations)
    verbs.push_back({{"verb", "station"},
                     {"options",
                      {{"add", s.name},
                       {"at", placeOf(document, s.true_pose.translation)},
                       {"yaw-deg", yawOf(s.true_pose.rotation) / kRadPerDeg},
                       {"stand", "free"}}}});
  for (const auto& t : document.job->targets) {
    json options = {{"add", t.name},
                    {"at", placeOf(document, t.centre)},
                    {"kind", t.kind == TargetKind::sphere ? "sphere" : "checkerboard"},
                    {"size", t.size_m}};
    if (t.kind == TargetKind::checkerboard) options["normal"] = {t.normal.x(), t.normal.y(), t.normal.z()};
    verbs.push_back({{"verb", "target"}, {"options", std::move(options)}});
  }
  return verbs;
}

// A step for it would be done before anybody comes.
bool isStandard(const Device& device, const std::string& key) {
  for (const auto& s : device.type().instrument.settings)
    if (s.key == key) return s.default_value == device.setting(key);
  return false;
}

class Demands {
 public:
  explicit Demands(const Device& device) : device_(device) {}

  void step(const std::string& id, const std::string& condition, double points, const std::string& widget = {}) {
    json row = {{"id", id}, {"text", texts(condition)}, {"done", condition}, {"points", points}};
    if (!widget.empty()) row["widget"] = widget;
    add(false, std::move(row));
  }
  void rule(const std::string& id, const std::string& when, const std::string& condition) {
    add(true, {{"id", id}, {"text", texts(condition)}, {"when", when}, {"holds", condition}, {"points", 1}});
  }
  std::vector<RecordedDemand> found;

 private:
  // The condition, in words.
  json texts(const std::string& condition) const {
    const auto parsed = Condition::parse(condition);
    return spokenEverywhere(device_, [&](const std::string& language) {
      return PlainWords{device_, Exercise(), language}.condition(parsed ? *parsed : Condition());
    });
  }
  void add(bool is_rule, json row) {
    const auto language = row["text"].contains(device_.state().language) ? device_.state().language : "en";
    auto text = row["text"][language].get<std::string>();
    found.push_back({is_rule, std::move(text), std::move(row), true});
  }
  const Device& device_;
};

}  // namespace

Recording::Recording(const Device& device, const Document& document, const Exercise* exercise)
    : clock_s_(device.state().clock_s), was_busy_(device.busy()) {
  if (exercise != nullptr) {
    model_ = exercise->model;
    if (fs::path(model_).has_extension()) model_file_ = exercise->folder / model_;
    setup_ = exercise->setup;
    for (const auto& action : exercise->start) start_.push_back(toJson(action));
    return;
  }
  if (!document.sources.empty()) {
    const fs::path source = document.sources.front();
    std::error_code error;
    const bool sample = fs::exists(samplesFolder() / (source.stem().string() + ".ifc"), error);
    model_ = sample ? source.stem().string() : source.filename().string();
    if (!sample) model_file_ = source;
  }
  setup_ = standing(document);
  if (device.on()) {
    start_.push_back({{"press", device.type().definition.keys.front().id}});
    start_.push_back({{"finish", true}});
  }
  if (const auto& station = device.state().around.station; !station.empty())
    start_.push_back({{"hand", "stand_at"}, {"value", station}});
}

void Recording::note(const RehearsalAction& action, const Device& device) {
  const double now = device.state().clock_s, waited = now - clock_s_;
  if (was_busy_ && !device.busy() && action.kind != Kind::finish && waited > 0)
    actions_.push_back({Kind::finish, {}, {}, 0, {}});
  else if (waited >= kShortestWait_s && action.kind != Kind::wait && action.kind != Kind::finish)
    actions_.push_back({Kind::wait, {}, {}, std::ceil(waited), {}});
  actions_.push_back(action);
  clock_s_ = now;
  was_busy_ = device.busy();
}

std::vector<RecordedDemand> demandsOf(const Recording& recording, const Device& device) {
  Demands demands(device);
  std::set<std::string> settings;
  for (const auto& action : recording.actions())
    if (action.kind == Kind::press && !action.value.empty() && !device.setting(action.name).empty() &&
        !isStandard(device, action.name) && settings.insert(action.name).second)
      demands.step(action.name, fmt::format("setting.{} == '{}'", action.name, device.setting(action.name)), 1,
                   action.name);
  if (const auto setups = device.number("setups"); setups > 0) {
    std::string scanned = fmt::format("setups >= {}", setups);
    for (const auto& key : settings)
      if (const auto with = device.fact("newest.setting." + key))
        scanned += fmt::format(" and newest.setting.{} == '{}'", key, with->text);
    demands.step("scan", scanned, 2);
    demands.rule("whole", "end", "newest.partial == no and newest.tripod_moved == no");
    demands.rule("level", "each scan_started", "level == good");
  }
  if (const auto looked = device.number("setups.looked_at"); looked > 0)
    demands.step("look", fmt::format("setups.looked_at >= {}", looked), 1);
  if (device.fact("orientation.accepted") && device.fact("orientation.accepted")->text == "yes")
    demands.step("station_setup", "orientation.accepted == yes", 1);
  if (const auto link = device.fact("link"); link && link->text == "joined")
    demands.step("link", "links.joined >= 1", 1);
  if (const auto copied = device.number("setups.transferred"); copied > 0)
    demands.step("copy", fmt::format("setups.transferred >= {}", copied), 1);
  if (demands.found.empty()) demands.step("on", "power == on", 1);
  return std::move(demands.found);
}

json recordedExercise(const Recording& recording, const Device& device, const std::vector<RecordedDemand>& demands,
                      const std::string& id) {
  json steps = json::array(), rules = json::array(), solution = json::array();
  for (const auto& demand : demands)
    if (demand.wanted) (demand.is_rule ? rules : steps).push_back(demand.row);
  for (const auto& action : recording.actions_) solution.push_back(toJson(action));
  if (recording.was_busy_) solution.push_back({{"finish", true}});
  json exercise = {{"id", id},
                   {"title", spokenEverywhere(device, "A recorded exercise")},
                   {"goal", spokenEverywhere(device, "Describe the goal here.")},
                   {"devices", {device.type().definition.id}},
                   {"instrument", device.type().instrument.id},
                   {"model", recording.model_},
                   {"setup", recording.setup_},
                   {"start", recording.start_},
                   {"in_order", false},
                   {"steps", std::move(steps)},
                   {"rules", std::move(rules)},
                   {"pass_mark", 0.7},
                   {"expect", {{"score", 1}}},
                   {"solution", std::move(solution)}};
  return exercise;
}

Result<void> writeRecorded(const json& exercise, const fs::path& model, const fs::path& file, Progress& progress) {
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  const auto beside = file.parent_path() / model.filename();
  if (!error && !model.empty() && !fs::exists(beside, error)) fs::copy_file(model, beside, error);
  if (error) return failure(ErrorKind::file_system, "cannot write there: " + error.message(), file.string());
  // Under a name that no list shows, until it is known to be good.
  const fs::path trial = file.parent_path() / ("." + file.filename().string() + ".trial");
  TRY(writeWholeText(trial, exercise.dump(2) + '\n'));
  const auto tried = [&]() -> Result<void> {
    TRY_ASSIGN(const auto read, readExercise(trial));
    if (const auto faults = checkExercise(read); !faults.empty()) return failure(faults.front());
    Report report;
    return checkSolution(read, report, progress);
  }();
  if (!tried) {
    fs::remove(trial, error);
    return tried;
  }
  fs::rename(trial, file, error);
  if (error) return failure(ErrorKind::file_system, "cannot write: " + error.message(), file.string());
  return {};
}

}  // namespace standpoint
