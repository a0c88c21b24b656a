// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/dataset/set_verify.h"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "core/json_file.h"
#include "core/sha256.h"

namespace standpoint {

namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLargestSums = std::uintmax_t{1} << 30U;
constexpr std::size_t kDigits = 64;

// What a run leaves beside the set: nothing that was promised.
bool isBeside(const std::string& path) {
  return path == kSumsFile || path.starts_with(std::string(kWorkFolder) + "/") || path.starts_with("slurm/");
}

class SetChecker {
 public:
  SetChecker(const fs::path& set, const Recipe& recipe, const Shard& shard)
      : set_(set), recipe_(recipe), shard_(shard) {}

  Result<SetCheck> check(Progress& progress) {
    progress.stage("Verify " + recipe_.name);
    TRY(readSums());
    TRY(listFiles());
    TRY(shared("recipe.json", progress));
    for (const auto& map : recipe_.classes) TRY(shared("classes/" + map.id + ".json", progress));
    std::map<std::size_t, std::set<std::string>> none;  // of each environment the places without room
    for (std::size_t e = 0; e < recipe_.environments.size(); ++e) TRY(environment(e, none[e], progress));
    const auto variants = variantsOf(recipe_);
    const auto places = placesOf(recipe_, shard_);
    for (std::size_t k = 0; k < places.size(); ++k) {
      progress.advance(static_cast<double>(k) / static_cast<double>(places.size()));
      if (none[places[k].environment].contains(places[k].station)) continue;
      for (const auto& variant : variants) TRY(scan(places[k], variant, progress));
    }
    if (!isFirst()) return std::move(found_);
    for (const auto& place : placesOf(recipe_))  // of the other shards: they look at them
      for (const auto& variant : variants)
        if (!none[place.environment].contains(place.station)) leave(filesOf(recipe_, place, variant));
    for (const auto& [path, sum] : sums_)  // what only the list knows
      if (!seen_.contains(path)) TRY(listed(path, sum, progress));
    for (const auto& path : there_)
      if (!seen_.contains(path) && !sums_.contains(path)) found_.unknown.push_back(path);
    return std::move(found_);
  }

 private:
  bool isFirst() const { return shard_.index == 1; }

  Result<void> readSums() {
    std::error_code error;
    if (!fs::exists(set_ / kSumsFile, error)) return {};
    TRY_ASSIGN(const auto text, readWholeFile(set_ / kSumsFile, kLargestSums));
    std::size_t number = 0;
    for (std::size_t from = 0; from < text.size();) {
      const auto end = std::min(text.find('\n', from), text.size());
      const auto line = text.substr(from, end - from);
      from = end + 1;
      ++number;
      if (line.size() < kDigits + 3)
        return failure(ErrorKind::unusable, "must be a checksum and a path; write the manifest again",
                       fmt::format("{} line {}", kSumsFile, number));
      sums_[line.substr(kDigits + 2)] = line.substr(0, kDigits);
    }
    return {};
  }

  Result<void> listFiles() {
    std::error_code error;
    for (fs::recursive_directory_iterator at(set_, error), end; !error && at != end; at.increment(error)) {
      if (!at->is_regular_file()) continue;
      const auto path = fs::relative(at->path(), set_).generic_string();
      if (!isBeside(path)) there_.insert(path);
    }
    if (error) return failure(ErrorKind::file_system, "cannot list: " + error.message(), set_.string());
    return {};
  }

  // Its sum; nothing where it is missing, which is noted.
  Result<std::optional<SetFile>> summed(const std::string& path, Progress& progress) {
    seen_.insert(path);
    if (!there_.contains(path)) {
      found_.missing.push_back(path);
      return std::optional<SetFile>();
    }
    TRY_ASSIGN(auto sum, sha256OfFile(set_ / path, progress));
    std::error_code error;
    ++found_.files;
    SetFile file{path, fs::file_size(set_ / path, error), std::move(sum)};
    found_.bytes += file.bytes;
    if (const auto at = sums_.find(path); at != sums_.end() && at->second != file.sha256) damaged(path);
    return std::optional(std::move(file));
  }

  void damaged(const std::string& path) {
    if (found_.damaged.empty() || found_.damaged.back() != path) found_.damaged.push_back(path);
  }

  Result<void> listed(const std::string& path, const std::string& sum, Progress& progress) {
    TRY_ASSIGN(const auto file, summed(path, progress));
    if (file && file->sha256 != sum) damaged(path);
    return {};
  }

  Result<void> other(const std::string& path, Progress& progress) {
    TRY_ASSIGN(auto file, summed(path, progress));
    if (file) found_.others.push_back(*std::move(file));
    return {};
  }

  // What belongs to no place is looked at by the first shard alone.
  Result<void> shared(const std::string& path, Progress& progress) {
    return isFirst() ? other(path, progress) : Result<void>();
  }

  void leave(const SetFiles& files) {
    seen_.insert(files.record.generic_string());
    for (const auto& file : expected(files)) seen_.insert(file);
  }

  // Each shard reads its record, which says where no tripod can stand.
  Result<void> environment(std::size_t index, std::set<std::string>& none, Progress& progress) {
    const auto& environment = recipe_.environments[index];
    const auto path = environmentFile(environment).generic_string();
    TRY(shared(path, progress));
    if (!there_.contains(path)) return {};
    auto record = readEnvironmentRecord(set_, environment);
    if (!record) {
      if (isFirst()) damaged(path);
      return {};
    }
    none = {record->without_room.begin(), record->without_room.end()};
    if (!isFirst()) return {};
    TRY(other(record->picture.path, progress));
    if (there_.contains(record->picture.path) && found_.others.back().sha256 != record->picture.sha256)
      damaged(record->picture.path);
    found_.environments.push_back(*std::move(record));
    return {};
  }

  Result<void> scan(const SetPlace& place, const SetVariant& variant, Progress& progress) {
    SetScan one{place, variant, filesOf(recipe_, place, variant), {}};
    const auto record_path = one.files.record.generic_string();
    if (!there_.contains(record_path)) {
      ++found_.not_made;
      found_.missing.push_back(record_path);
      leave(one.files);
      return {};
    }
    TRY(other(record_path, progress));
    auto record = readSetRecord(set_ / record_path, recipe_);
    std::vector<std::string> names;
    if (record)
      for (const auto& file : record->files) names.push_back(file.path);
    if (!record || names != expected(one.files)) {
      damaged(record_path);
      leave(one.files);
      return {};
    }
    for (const auto& file : record->files) {
      TRY_ASSIGN(const auto is, summed(file.path, progress));
      if (is && is->sha256 != file.sha256) damaged(file.path);
    }
    one.record = *std::move(record);
    found_.scans.push_back(std::move(one));
    return {};
  }

  static std::vector<std::string> expected(const SetFiles& files) {
    std::vector<std::string> names = {files.cloud.generic_string()};
    for (const auto& file : files.labels) names.push_back(file.generic_string());
    names.push_back(files.instances.generic_string());
    return names;
  }

  const fs::path& set_;
  const Recipe& recipe_;
  const Shard shard_;
  std::map<std::string, std::string> sums_;  // of the list, by path
  std::set<std::string> there_, seen_;
  SetCheck found_;
};

}  // namespace

Result<SetCheck> checkSet(const fs::path& set, const Recipe& recipe, const Shard& shard, Progress& progress) {
  return SetChecker(set, recipe, shard).check(progress);
}

}  // namespace standpoint
