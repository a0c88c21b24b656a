// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/dataset/set_folder.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdlib>
#include <tuple>
#include <unistd.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/json_fields.h"
#include "core/json_file.h"
#include "core/part_file.h"

namespace standpoint {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr double kMostCount = 9007199254740991.0;  // that a JSON number holds exactly

std::string hostName() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? std::string(name.data()) : "host";
}

// Which numbers of processes are of the same processes: a container may have its own.
std::string processSpace() {
  std::error_code error;
  const auto text = fs::read_symlink("/proc/self/ns/pid", error).string();  // "pid:[4026531836]"
  const auto from = text.find('['), to = text.find(']');
  return to < text.size() && from < to ? text.substr(from + 1, to - from - 1) : "0";
}

// "rack7.4026531836." of this process and those beside it.
std::string machineName() { return fmt::format("{}.{}.", hostName(), processSpace()); }

// "8_3.1." in the second start of task 3 of Slurm's job 8, else nothing.
std::string taskName() {
  const auto word = [](const char* name) {
    const char* const value = std::getenv(name);
    std::string text = value != nullptr ? value : "";
    std::erase_if(text, [](unsigned char c) { return std::isalnum(c) == 0; });
    return text;
  };
  const auto array = word("SLURM_ARRAY_JOB_ID"), job = array.empty() ? word("SLURM_JOB_ID") : array;
  if (job.empty()) return {};
  const auto task = word("SLURM_ARRAY_TASK_ID"), restart = word("SLURM_RESTART_COUNT");
  return fmt::format("{}{}{}.{}.", job, task.empty() ? "" : "_", task, restart.empty() ? "0" : restart);
}

// The work folder of a process of this machine that has ended.
bool isLeft(const std::string& name) {
  const auto machine = machineName();
  const auto at = name.rfind(machine);
  if (at == std::string::npos || (at > 0 && name[at - 1] != '.')) return false;
  pid_t process = 0;
  const char* const end = name.data() + name.size();
  if (std::from_chars(name.data() + at + machine.size(), end, process).ptr != end || process <= 0) return false;
  return ::kill(process, 0) != 0 && errno == ESRCH;
}

// Anything that no set begins with.
bool holdsOther(const fs::path& set) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(set, error)) {
    const auto name = entry.path().filename();
    if (name != kWorkFolder && name != "slurm" && name != "classes") return true;
  }
  return false;
}

// What a set begins with, and what is said of a set that has another one.
struct BeginningFile {
  fs::path in_set;
  std::string text;
  const char* other;
};
std::vector<BeginningFile> filesToBegin(const Recipe& recipe) {
  std::vector<BeginningFile> files = {
      {"recipe.json", recipe.text, "the set was begun with another recipe: choose a new folder"}};
  for (const auto& map : recipe.classes)
    files.push_back({fs::path("classes") / (map.id + ".json"), map.text,
                     "the set was begun with other classes of this name: choose a new folder"});
  return files;
}

tl::unexpected<Error> cannotMake(const fs::path& path, const std::error_code& error) {
  return failure(ErrorKind::file_system, "cannot create: " + error.message(), path.string());
}

std::uint64_t wholeAt(JsonFields& fields, const char* key) {
  return static_cast<std::uint64_t>(fields.number(key, 0, kMostCount));
}

SetEnvironmentRecord::MapPlace placeOf(JsonFields& map) {
  constexpr double kFarthest_m = 1e9;
  SetEnvironmentRecord::MapPlace place;
  const auto pair = [&](const nlohmann::json& value, const std::string& pointer) -> std::pair<double, double> {
    if (!value.is_array() || value.size() != 2) {
      map.fault().needs(pointer, value, "a list of two numbers");
      return {};
    }
    return {numberAt(map.fault(), value[0], pointer + "/0", -kFarthest_m, kFarthest_m),
            numberAt(map.fault(), value[1], pointer + "/1", -kFarthest_m, kFarthest_m)};
  };
  place.crs = map.text("crs");
  if (const auto* heights = map.required("heights"))
    std::tie(place.lowest_m, place.highest_m) = pair(*heights, map.pointer("heights"));
  const auto* corners = map.required("corners");
  for (std::size_t k = 0; corners != nullptr && corners->is_array() && k < corners->size(); ++k)
    place.corners.push_back(pair((*corners)[k], fmt::format("{}/{}", map.pointer("corners"), k)));
  return place;
}

}  // namespace

std::string textOf(const SetRecord& record, const Recipe& recipe, const std::string& scan) {
  Json files = Json::array(), classes = Json::object();
  for (const auto& file : record.files)
    files.push_back({{"path", file.path}, {"bytes", file.bytes}, {"sha256", file.sha256}});
  for (const auto& map : recipe.classes) {
    auto& counts = classes[map.id] = Json::object();
    for (std::size_t k = 0; k < map.map.classes.size(); ++k)
      counts[map.map.classes[k].name] = record.classes.at(map.id)[k];
  }
  const Json json = {{"scan", scan},
                     {"seed", record.seed},
                     {"points", record.points},
                     {"pulses", record.pulses},
                     {"returns", record.returns},
                     {"instrument_seconds", record.instrument_seconds},
                     {"files", std::move(files)},
                     {"classes", std::move(classes)}};
  return json.dump(2) + "\n";
}

Result<SetRecord> readSetRecord(const fs::path& file, const Recipe& recipe) {
  TRY_ASSIGN(const auto json, readJsonFile(file));
  JsonFault fault(nameWithFolder(file));
  JsonFields root(fault, json, "");
  SetRecord record;
  root.text("scan");
  record.seed = wholeAt(root, "seed");
  record.points = wholeAt(root, "points");
  record.pulses = wholeAt(root, "pulses");
  record.returns = wholeAt(root, "returns");
  record.instrument_seconds = root.number("instrument_seconds", 0, kMostCount);
  root.list("files", [&](JsonFields& one) {
    record.files.push_back({one.text("path"), wholeAt(one, "bytes"), one.text("sha256")});
  });
  root.object("classes", [&](JsonFields& maps) {
    for (const auto& map : recipe.classes) {
      auto& counts = record.classes[map.id];
      maps.required(map.id);
      maps.object(map.id, [&](JsonFields& fields) {
        for (const auto& one : map.map.classes) counts.push_back(wholeAt(fields, one.name.c_str()));
      });
      counts.resize(map.map.classes.size());
    }
  });
  root.close();
  TRY(fault.result());
  return record;
}

std::optional<SetRecord> finishedScan(const fs::path& set, const Recipe& recipe, const SetFiles& files) {
  auto record = readSetRecord(set / files.record, recipe);
  if (!record) return std::nullopt;
  const auto isWhole = [&](const SetFile& file) {
    std::error_code error;
    return fs::file_size(set / file.path, error) == file.bytes && !error;
  };
  if (record->files.size() != files.labels.size() + 2 ||
      !std::all_of(record->files.begin(), record->files.end(), isWhole))
    return std::nullopt;
  return *std::move(record);
}

Result<SetEnvironmentRecord> readEnvironmentRecord(const fs::path& set, const RecipeEnvironment& environment) {
  const auto file = set / environmentFile(environment);
  TRY_ASSIGN(const auto json, readJsonFile(file));
  JsonFault fault(nameWithFolder(file));
  JsonFields root(fault, json, "");
  SetEnvironmentRecord record;
  const bool is_file = root.has("model_sha256");
  record.identity =
      (is_file ? "sha256 of the file: " : "what beams can meet: ") + root.text(is_file ? "model_sha256" : "world");
  if (root.isNull("map"))
    root.skip("map");
  else
    root.object("map", [&](JsonFields& map) { record.map = placeOf(map); });
  root.list("materials", [&](JsonFields& one) {
    auto id = one.text("id");
    record.materials.emplace_back(std::move(id), one.texts("licenses"));
  });
  root.list("without_effect", [&](JsonFields& one) {
    auto entry = one.text("materials");
    record.without_effect.push_back({std::move(entry), one.text(one.has("rules") ? "rules" : "assign")});
  });
  root.object("picture", [&](JsonFields& one) {
    record.picture = {one.text("path"), wholeAt(one, "bytes"), one.text("sha256")};
  });
  root.list("stations", [&](JsonFields& one) {
    record.stations.push_back(one.text("name"));
    one.skip("at");
    one.skip("height_m");
  });
  record.without_room = root.texts("without_room");
  if (record.picture.path != pictureFile(environment).generic_string()) root.wrong("picture", "is another file");
  TRY(fault.result());
  return record;
}

std::vector<std::string> workFoldersOf(const fs::path& set) {
  std::vector<std::string> found;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(set / kWorkFolder, error))
    found.push_back((fs::path(kWorkFolder) / entry.path().filename()).generic_string());
  std::sort(found.begin(), found.end());
  return found;
}

Result<SetFolder> SetFolder::open(const fs::path& set, const Recipe& recipe) {
  std::error_code error;
  const auto isBegun = [&] { return fs::exists(set / "recipe.json", error); };
  if (!isBegun() && holdsOther(set) && !isBegun())  // the second time: another shard may begin it meanwhile
    return failure(ErrorKind::usage, "the folder is not empty and no set: choose a new folder", set.string());
  const auto work = set / kWorkFolder / fmt::format("{}{}{}", taskName(), machineName(), ::getpid());
  // Who finds the parent empty removes it: another may do so between the two folders that are made here.
  constexpr int kTries = 10;
  for (int k = 0; k < kTries && (k == 0 || error == std::errc::no_such_file_or_directory); ++k)
    fs::create_directories(work, error);
  if (error) return cannotMake(work, error);
  for (const auto& entry : fs::directory_iterator(set / kWorkFolder, error))
    if (isLeft(entry.path().filename().string())) {
      std::error_code ignored;
      fs::remove_all(entry.path(), ignored);
    }
  SetFolder made(set, work);
  for (const auto& file : filesToBegin(recipe)) TRY(made.hasSame(file.in_set, file.text, file.other));
  return made;
}

Result<void> SetFolder::begin(const Recipe& recipe) const {
  for (const auto& file : filesToBegin(recipe)) TRY(putSame(file.in_set, file.text, file.other));
  return {};
}

SetFolder::SetFolder(SetFolder&& other) noexcept
    : set_(std::move(other.set_)), work_(std::exchange(other.work_, fs::path())) {}

SetFolder::~SetFolder() {
  if (work_.empty()) return;
  std::error_code ignored;
  fs::remove_all(work_, ignored);  // its parent stays: others may be about to make theirs
}

Result<void> SetFolder::put(const fs::path& in_set) const {
  std::error_code error;
  const auto place = set_ / in_set;
  fs::create_directories(place.parent_path(), error);
  if (error) return cannotMake(place.parent_path(), error);
  fs::rename(workFile(in_set), place, error);
  if (error) return failure(ErrorKind::file_system, "cannot finish: " + error.message(), place.string());
  return {};
}

Result<void> SetFolder::putText(const fs::path& in_set, const std::string& text) const {
  TRY(writeWholeText(workFile(in_set), text));
  return put(in_set);
}

Result<bool> SetFolder::hasSame(const fs::path& in_set, const std::string& text, const std::string& other) const {
  std::error_code error;
  if (!fs::exists(set_ / in_set, error)) return false;
  TRY_ASSIGN(const auto before, readWholeFile(set_ / in_set, kLargestJsonFile));
  if (before != text) return failure(ErrorKind::unusable, other, (set_ / in_set).string());
  return true;
}

Result<void> SetFolder::putSame(const fs::path& in_set, const std::string& text, const std::string& other) const {
  TRY_ASSIGN(const bool is_there, hasSame(in_set, text, other));
  return is_there ? Result<void>() : putText(in_set, text);
}

}  // namespace standpoint
