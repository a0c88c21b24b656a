// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/recovery.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <fstream>
#include <signal.h>

#include <nlohmann/json.hpp>

#include "core/part_file.h"
#include "editor/model/file_list.h"

namespace standpoint {

namespace {

bool processLives(long process) { return kill(static_cast<pid_t>(process), 0) == 0 || errno == EPERM; }

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
  return writeWholeText(folder / "owner.json", nlohmann::json{{"name", name}, {"saved_in", saved_in}}.dump(2) + '\n');
}

std::vector<RecoveryCopy> findRecoveryCopies(const std::filesystem::path& root) {
  std::vector<RecoveryCopy> copies;
  std::error_code error;
  for (std::filesystem::directory_iterator i(root, error), end; !error && i != end; i.increment(error)) {
    const auto process = processOf(i->path());
    if (!process || processLives(*process) || !isProjectFolder(i->path() / "copy")) continue;
    std::ifstream in(i->path() / "owner.json");
    const auto owner = nlohmann::json::parse(in, nullptr, false);
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
  std::filesystem::remove_all(folder, ignored);
}

}  // namespace standpoint
