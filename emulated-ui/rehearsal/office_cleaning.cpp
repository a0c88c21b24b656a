// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/rehearsal/office_cleaning.h"

#include <algorithm>
#include <array>

#include "emulated-ui/hand_over.h"
#include "emulated-ui/rehearsal/all_setups.h"
#include "pointclouds/filters/cleaning.h"
#include "pointclouds/formats.h"
#include "pointclouds/scores/cleaning_scores.h"
#include "pointclouds/scores/kept_points.h"
#include "project/verbs/file_verbs.h"

namespace standpoint {

namespace {

namespace fs = std::filesystem;

constexpr const char* kCleaning = "cleaning.";
constexpr std::array kCleaningFigures = {"recall", "precision", "lost"};

fs::path joinedIn(const fs::path& office) { return office / "all scans.e57"; }

Result<void> join(const std::vector<fs::path>& copies, const fs::path& file, Progress& progress) {
  TRY_ASSIGN(const auto writer, cloudFormatFor(file)->writer(file));
  for (const auto& copy : copies) TRY(readCloud(copy, *writer, progress));
  return writer->close();
}

// A share of nothing is none.
void put(std::map<std::string, double>& figures, const std::string& name, std::uint64_t part, std::uint64_t whole) {
  if (whole > 0) figures[name] = static_cast<double>(part) / static_cast<double>(whole);
}

std::size_t bitOf(std::uint8_t flag) {
  std::size_t bit = 0;
  while ((1U << bit) != flag) ++bit;
  return bit;
}

Result<CleaningScores> scoresIn(const fs::path& office, Progress& progress) {
  TRY_ASSIGN(const auto points,
             keptPoints(joinedIn(office), cleanedIn(office), {.shift_m = Eigen::Vector3d::Zero()}, progress));
  return cleaningScores(joinedIn(office), points.kept, progress);
}

}  // namespace

std::vector<fs::path> officeCopies(const Device& device, const fs::path& office) {
  std::vector<fs::path> copies;
  for (const auto* setup : allSetups(device)) {
    if (!isHandedOver(*setup, office)) continue;
    auto copy = copyIn(office, setup->file);
    for (const char* extension : {".e57", ".las", ".ptx"}) {
      std::error_code error;
      if (!fs::exists(copy.replace_extension(extension), error)) continue;
      copies.push_back(copy);
      break;
    }
  }
  return copies;
}

fs::path cleanedIn(const fs::path& office) { return office / "all scans cleaned.e57"; }

Result<void> cleanCopies(const std::vector<fs::path>& copies, const std::vector<std::string>& filters,
                         const fs::path& office, Progress& progress) {
  if (copies.empty()) return failure(ErrorKind::usage, "copy a scan to the office first", "clean");
  TRY_ASSIGN(const auto chosen, filtersFrom(filters));
  for (const auto& text : filters)
    for (const char* key : {"against=", "trajectory="})
      if (text.find(key) != std::string::npos)
        return failure(ErrorKind::usage, "in an exercise the scans are compared with each other: name no file", text);
  std::error_code error;
  fs::remove(cleanedIn(office), error);  // of copies that may have been others
  progress.stage("Joining the scans", 0, 0.3);
  TRY(join(copies, joinedIn(office), progress));
  progress.stage("Cleaning", 0.3, 1);
  TRY(cleanCloud(joinedIn(office), cleanedIn(office), chosen, progress));
  return {};
}

std::map<std::string, double> readCleaning(const fs::path& office) {
  Progress quiet;
  std::error_code error;
  if (!fs::exists(cleanedIn(office), error)) return {};
  const auto scores = scoresIn(office, quiet);
  if (!scores) return {};
  std::map<std::string, double> figures;
  const auto& moving = scores->flags[bitOf(point_flag::kMoving)];
  put(figures, "cleaning.recall", moving.taken, moving.in);
  put(figures, "cleaning.precision", scores->flawed.taken, scores->points.taken);
  put(figures, "cleaning.lost", scores->good.taken, scores->good.in);
  for (const auto& one : scores->classes) {
    const auto name = kCleaning + one.name;
    put(figures, name + ".recall", one.flawed.taken, one.flawed.in);
    put(figures, name + ".precision", one.flawed.taken, one.flawed.taken + one.good.taken);
    put(figures, name + ".lost", one.good.taken, one.good.in);
  }
  return figures;
}

bool isCleaningFact(const std::string& name) {
  const auto figure = name.substr(std::min(name.size(), name.rfind('.') + 1));
  return name.starts_with(kCleaning) &&
         std::find(kCleaningFigures.begin(), kCleaningFigures.end(), figure) != kCleaningFigures.end();
}

std::optional<CleaningOfClass> cleaningOfClass(const std::string& fact) {
  const std::size_t first = std::string_view(kCleaning).size(), last = fact.rfind('.');
  if (!isCleaningFact(fact) || last <= first) return std::nullopt;
  return CleaningOfClass{fact.substr(first, last - first), fact.substr(last + 1)};
}

}  // namespace standpoint
