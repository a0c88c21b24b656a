// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/recovery.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <fstream>
#include <signal.h>
#include <sstream>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "core/part_file.h"
#include "editor/model/file_list.h"
#include "editor/model/session.h"

namespace standpoint {

namespace {

// Of all processes that ever had this number, which one: when it started, since which boot. Empty: there is none now.
std::string startOf(long process) {
  std::ifstream stat("/proc/" + std::to_string(process) + "/stat"), boot("/proc/sys/kernel/random/boot_id");
  std::string text, field, boot_id;
  std::getline(stat, text);
  std::getline(boot, boot_id);
  std::istringstream fields(text.substr(std::min(text.size(), text.rfind(')') + 1)));
  for (int i = 3; i <= 22; ++i) fields >> field;
  return fields ? boot_id + ' ' + field : std::string();
}

// Another process may have the number by now.
bool ownerLives(long process, const nlohmann::json& owner) {
  if (kill(static_cast<pid_t>(process), 0) != 0 && errno != EPERM) return false;
  const auto start = owner.is_object() ? owner.value("process_start", nlohmann::json()) : nlohmann::json();
  return !start.is_string() || start.get<std::string>() == startOf(process);
}

std::optional<long> processOf(const std::filesystem::path& folder) {
  const auto name = folder.filename().string();
  long process = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), process);
  if (error != std::errc() || end != name.data() + name.size() || process <= 0) return std::nullopt;
  return process;
}

std::filesystem::file_time_type changed(const std::filesystem::path& file) {
  std::error_code ignored;
  const auto time = std::filesystem::last_write_time(file, ignored);
  return ignored ? std::filesystem::file_time_type::min() : time;
}

}  // namespace

std::filesystem::path recoveryFolder(const std::filesystem::path& root, long process) {
  return root / std::to_string(process);
}

Result<void> writeRecoveryOwner(const std::filesystem::path& folder, const std::string& name,
                                const std::string& saved_in) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  return writeWholeText(
      folder / "owner.json",
      nlohmann::json{{"name", name}, {"saved_in", saved_in}, {"process_start", startOf(getpid())}}.dump(2) + '\n');
}

std::vector<RecoveryCopy> findRecoveryCopies(const std::filesystem::path& root) {
  std::vector<RecoveryCopy> copies;
  std::error_code error;
  for (std::filesystem::directory_iterator i(root, error), end; !error && i != end; i.increment(error)) {
    const auto process = processOf(i->path());
    if (!process || !isProjectFolder(i->path() / "copy")) continue;
    std::ifstream in(i->path() / "owner.json");
    const auto owner = nlohmann::json::parse(in, nullptr, false);
    if (ownerLives(*process, owner)) continue;
    RecoveryCopy copy{i->path(), i->path() / "copy", "", ""};
    if (owner.is_object()) {
      if (owner.contains("name") && owner["name"].is_string()) copy.name = owner["name"];
      if (owner.contains("saved_in") && owner["saved_in"].is_string()) copy.saved_in = owner["saved_in"];
    }
    copies.push_back(std::move(copy));
  }
  std::sort(copies.begin(), copies.end(), [](const RecoveryCopy& a, const RecoveryCopy& b) {
    return changed(a.project / "project.json") > changed(b.project / "project.json");
  });
  return copies;
}

void removeRecovery(const std::filesystem::path& folder) {
  std::error_code ignored;  // what cannot be removed is offered again at the next start
  std::filesystem::remove(folder / "copy" / "project.json", ignored);  // first: half a copy is none
  std::filesystem::remove_all(folder, ignored);
}

void RecoveryKeeper::keep(Session& session) {
  if (!session.modified() || !session.document().imported) {
    if (there_ && !session.keepsRecovery()) {
      removeRecovery(folder_);
      there_ = false;
      tried_revision_ = 0;
    }
    return;
  }
  if (upToDate(session) || tried_revision_ == session.revision() || session.keepsRecovery()) return;
  tried_revision_ = session.revision();
  const auto saved_in = session.folder().string();
  if (!there_ || owner_name_ != session.name() || owner_saved_in_ != saved_in) {
    if (auto written = writeRecoveryOwner(folder_, session.name(), saved_in); !written)
      return session.say(LogLevel::error, written.error().source, written.error().message);
    owner_name_ = session.name();
    owner_saved_in_ = saved_in;
  }
  there_ = session.saveRecovery(folder_ / "copy");
}

bool RecoveryKeeper::upToDate(const Session& session) const {
  return !session.modified() || !session.document().imported ||
         (there_ && session.keptRevision() == session.revision());
}

}  // namespace standpoint
