// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "project/dataset/set_scans.h"

namespace standpoint {

// One file of a set, as a record or a list of checksums has it.
struct SetFile {
  std::string path;  // from the set's folder, with '/'
  std::uint64_t bytes = 0;
  std::string sha256;
};

// What is written of a scan once its files are whole: the same bytes on every machine.
struct SetRecord {
  std::uint64_t points = 0, pulses = 0, returns = 0;
  double instrument_seconds = 0;
  std::uint64_t seed = 0;
  std::vector<SetFile> files;
  std::map<std::string, std::vector<std::uint64_t>> classes;  // of each map the points of each class, in its order
};
std::string textOf(const SetRecord& record, const Recipe& recipe, const std::string& scan);
Result<SetRecord> readSetRecord(const std::filesystem::path& file, const Recipe& recipe);
// The record of a scan whose files are there with the sizes that it says; nothing where one is missing.
std::optional<SetRecord> finishedScan(const std::filesystem::path& set, const Recipe& recipe, const SetFiles& files);

// What environments/ID.json says of its places.
struct SetEnvironmentRecord {
  std::vector<std::string> stations, without_room;
  std::string identity;  // of its model: a checksum of the file, or of what beams can meet
  SetFile picture;
  struct MapPlace {
    std::string crs;
    std::vector<std::pair<double, double>> corners;  // of its plan, m
    double lowest_m = 0, highest_m = 0;
  };
  std::optional<MapPlace> map;
  std::vector<std::pair<std::string, std::vector<std::string>>> materials;  // id, and the licences of its figures
  struct WithoutEffect {
    std::string materials, what;  // id of the entry; a selector or a file of rules that matches nothing of the model
  };
  std::vector<WithoutEffect> without_effect;
};
Result<SetEnvironmentRecord> readEnvironmentRecord(const std::filesystem::path& set,
                                                   const RecipeEnvironment& environment);

// The folder of a set while scans are made for it. Files are made in a folder of this process, named by its task, host,
// process space and process, and renamed to their places, so that writers on several machines, and one whose task was
// given to another, never meet in a file.
class SetFolder {
 public:
  // Opens the set of this recipe, or a folder that can become it; a set of another recipe is an error. Takes away what
  // processes of this machine left that have ended.
  static Result<SetFolder> open(const std::filesystem::path& set, const Recipe& recipe);
  // Puts the recipe and its classes in, where they are not there yet: once the first file of the set can be made, so
  // that a recipe whose model turns out to be wrong can be corrected.
  Result<void> begin(const Recipe& recipe) const;
  SetFolder(SetFolder&& other) noexcept;
  SetFolder(const SetFolder&) = delete;
  ~SetFolder();

  const std::filesystem::path& path() const { return set_; }
  const std::filesystem::path& work() const { return work_; }
  std::filesystem::path workFile(const std::filesystem::path& in_set) const { return work_ / in_set.filename(); }
  Result<void> put(const std::filesystem::path& in_set) const;  // from workFile()
  Result<void> putText(const std::filesystem::path& in_set, const std::string& text) const;
  // As putText; where the set has another text already, an error that says `other`.
  Result<void> putSame(const std::filesystem::path& in_set, const std::string& text, const std::string& other) const;

 private:
  explicit SetFolder(std::filesystem::path set, std::filesystem::path work)
      : set_(std::move(set)), work_(std::move(work)) {}
  Result<bool> hasSame(const std::filesystem::path& in_set, const std::string& text, const std::string& other) const;
  std::filesystem::path set_, work_;
};

// Work folders that a set has: of runs that go on, and of such as died on another machine, which nobody here can tell
// apart.
std::vector<std::string> workFoldersOf(const std::filesystem::path& set);

inline constexpr const char* kWorkFolder = ".work";  // in a set

}  // namespace standpoint
