// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/recovery/left_work.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <optional>
#include <signal.h>
#include <sstream>
#include <sys/stat.h>
#include <tuple>
#include <unistd.h>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "core/part_file.h"
#include "editor/words/sentences.h"
#include "editor/words/words.h"

namespace standpoint {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kMarkFile = "owner.json";
constexpr const char* kSeen = "seen";  // a start has counted this crash

// Of all processes that ever had this number, which one: when it started, since which boot. Empty: there is none now.
// One that is ending is gone, though its memory takes seconds to free, or nobody asks how it ended.
std::string startOf(long process) {
  constexpr int kState = 3, kFlags = 9, kStart = 22;  // proc_pid_stat(5)
  constexpr unsigned long kEnding = 0x4;              // PF_EXITING of the kernel
  std::ifstream stat("/proc/" + std::to_string(process) + "/stat"), boot("/proc/sys/kernel/random/boot_id");
  std::string text, field, boot_id;
  std::getline(stat, text);
  std::getline(boot, boot_id);
  std::istringstream fields(text.substr(std::min(text.size(), text.rfind(')') + 1)));
  for (int i = kState; i <= kStart; ++i) {
    fields >> field;
    if (i == kState && (field == "Z" || field == "X")) return {};
    if (i == kFlags && (std::strtoul(field.c_str(), nullptr, 10) & kEnding) != 0) return {};
  }
  return fields ? boot_id + ' ' + field : std::string();
}

// Another process may have the number by now.
bool ownerLives(long process, const json& owner) {
  if (kill(static_cast<pid_t>(process), 0) != 0 && errno != EPERM) return false;
  const auto start = owner.is_object() ? owner.value("process_start", json()) : json();
  const auto now = startOf(process);
  return !now.empty() && (!start.is_string() || start.get<std::string>() == now);
}

std::optional<long> processOf(const fs::path& folder) {
  const auto name = folder.filename().string();
  long process = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), process);
  if (error != std::errc() || end != name.data() + name.size() || process <= 0) return std::nullopt;
  return process;
}

json readMark(const fs::path& folder) {
  std::ifstream in(folder / kMarkFile);
  auto mark = json::parse(in, nullptr, false);
  return mark.is_object() ? mark : json::object();
}

template <class T>
void take(const json& object, const char* key, T& value) {
  const auto found = object.find(key);
  if (found == object.end()) return;
  if constexpr (std::is_same_v<T, bool>) {
    if (found->is_boolean()) value = found->template get<T>();
  } else if constexpr (std::is_same_v<T, std::string>) {
    if (found->is_string()) value = found->template get<T>();
  } else {
    if (found->is_number_unsigned()) value = found->template get<T>();
  }
}

SessionMark markFrom(const json& object) {
  SessionMark mark{.young = false};
  take(object, "name", mark.name);
  take(object, "saved_in", mark.saved_in);
  take(object, "changes", mark.changes);
  take(object, "young", mark.young);
  take(object, "after_crash", mark.after_crash);
  take(object, "display_lost", mark.display_lost);
  if (const auto shown = object.find("shown"); shown != object.end() && shown->is_object()) mark.shown = *shown;
  const auto jobs = object.find("jobs");
  if (jobs == object.end() || !jobs->is_array()) return mark;
  for (const auto& row : *jobs) {
    if (!row.is_object()) continue;
    LeftJob job;
    take(row, "title", job.title);
    take(row, "stage", job.stage);
    take(row, "percent", job.percent);
    take(row, "verb", job.verb);
    if (const auto options = row.find("options"); options != row.end() && options->is_object()) job.options = *options;
    mark.jobs.push_back(std::move(job));
  }
  return mark;
}

// Each folder of an editor that is gone, with its mark.
template <class Visit>
void eachDead(const fs::path& root, Visit visit) {
  std::error_code error;
  for (fs::directory_iterator i(root, error), end; !error && i != end; i.increment(error)) {
    const auto process = processOf(i->path());
    if (!process) continue;
    const auto mark = readMark(i->path());
    if (!ownerLives(*process, mark)) visit(i->path(), mark);
  }
}

bool hasCopy(const fs::path& folder) {
  std::error_code ignored;
  return fs::is_regular_file(folder / "copy" / "project.json", ignored);
}

// Of the newest thing that it wrote; 0: unknown.
std::time_t lastHeard(const fs::path& folder) {
  std::time_t newest = 0;
  for (const auto& file : {folder / kMarkFile, folder / "copy" / "project.json"}) {
    struct stat seen {};
    if (::stat(file.c_str(), &seen) == 0) newest = std::max(newest, seen.st_mtime);
  }
  return newest;
}

std::string inWords(std::time_t time) {
  return time == 0 ? std::string() : fmt::format("{:%H:%M, %Y-%m-%d}", fmt::localtime(time));
}

}  // namespace

fs::path recoveryFolder(const fs::path& root, long process) { return root / std::to_string(process); }

Result<void> writeSessionMark(const fs::path& folder, const SessionMark& mark) {
  std::error_code error;
  fs::create_directories(folder, error);
  json jobs = json::array();
  for (const auto& job : mark.jobs)
    jobs.push_back({{"title", job.title},
                    {"stage", job.stage},
                    {"percent", job.percent},
                    {"verb", job.verb},
                    {"options", job.options}});
  const json object = {{"name", mark.name},
                       {"saved_in", mark.saved_in},
                       {"changes", mark.changes},
                       {"jobs", std::move(jobs)},
                       {"young", mark.young},
                       {"after_crash", mark.after_crash},
                       {"display_lost", mark.display_lost},
                       {"shown", mark.shown},
                       {kSeen, false},
                       {"process_start", startOf(getpid())}};
  return writeWholeText(folder / kMarkFile, object.dump(2) + '\n');
}

std::vector<LeftWork> findLeftWork(const fs::path& root) {
  std::vector<std::pair<std::time_t, LeftWork>> found;
  eachDead(root, [&](const fs::path& folder, const json& object) {
    LeftWork left{folder, hasCopy(folder) ? folder / "copy" : fs::path(), markFrom(object), {}};
    if (left.project.empty() && left.mark.jobs.empty()) return;
    const auto time = lastHeard(folder);
    left.last_heard = inWords(time);
    found.emplace_back(time, std::move(left));
  });
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<LeftWork> sorted;
  for (auto& [time, left] : found) sorted.push_back(std::move(left));
  return sorted;
}

void removeRecovery(const fs::path& folder) {
  std::error_code ignored;                                // what cannot be removed is offered again at the next start
  fs::remove(folder / "copy" / "project.json", ignored);  // first: half a copy is none
  fs::remove_all(folder, ignored);
}

NewCrashes takeNewCrashes(const fs::path& root) {
  NewCrashes crashes;
  eachDead(root, [&](const fs::path& folder, json object) {
    const auto mark = markFrom(object);
    if (object.contains(kSeen) && object[kSeen] == json(false)) {
      crashes.any |= !mark.display_lost;
      crashes.again_at_start |= mark.young && mark.after_crash && !mark.display_lost;
    }
    if (!hasCopy(folder) && mark.jobs.empty()) return removeRecovery(folder);
    object[kSeen] = true;
    std::error_code unknown;
    const auto written = fs::last_write_time(folder / kMarkFile, unknown);    // when the editor was heard of last
    std::ignore = writeWholeText(folder / kMarkFile, object.dump(2) + '\n');  // a full disk: it counts once more
    if (!unknown) fs::last_write_time(folder / kMarkFile, written, unknown);
  });
  return crashes;
}

const LeftJob* leftScan(const LeftWork& left) {
  const auto& jobs = left.mark.jobs;
  const auto scan = std::find_if(jobs.begin(), jobs.end(), [](const LeftJob& job) { return job.verb == "scan"; });
  return scan == jobs.end() ? nullptr : &*scan;
}

std::vector<std::string> sentencesOf(const LeftWork& left) {
  const auto& mark = left.mark;
  std::vector<std::string> said;
  said.push_back(mark.display_lost ? tr("The display was lost.") : tr("The editor closed unexpectedly."));
  if (!mark.name.empty()) said.push_back(trf("The project '{}' was open.", mark.name));
  if (!left.last_heard.empty()) said.push_back(trf("Last seen at {}.", left.last_heard));
  if (!left.project.empty() && mark.saved_in.empty())
    said.push_back(tr("The project was never saved. A recovery copy of it is available."));
  else if (!left.project.empty() && mark.changes == 0)
    said.push_back(tr("A recovery copy is available."));
  else if (!left.project.empty())
    said.push_back(trn("A recovery copy is available. {} change is newer than the project.",
                       "A recovery copy is available. {} changes are newer than the project.", mark.changes,
                       mark.changes));
  for (const auto& job : mark.jobs) {
    said.push_back(trf("{} stopped at {} %.", trSentence(job.stage.empty() ? job.title : job.stage), job.percent));
    if (job.verb == "scan") said.push_back(tr("Stations that were finished are kept."));
  }
  return said;
}

}  // namespace standpoint
