// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/progress.h"
#include "core/result.h"
#include "emulated-ui/device/device.h"

namespace standpoint {

// The copies of a device's set-ups in the office, in the order of their scans; what is not there is left out.
std::vector<std::filesystem::path> officeCopies(const Device& device, const std::filesystem::path& office);

// What a student cleans there: all copies joined into one cloud, and what the filters (pointclouds/filters) leave of
// it, each time anew from the copies. A filter that names a file is refused: the scans are compared with each other, so
// that the same actions give the same cloud on any machine. Without a copy it is an error. What is cancelled leaves no
// cleaned cloud.
Result<void> cleanCopies(const std::vector<std::filesystem::path>& copies, const std::vector<std::string>& filters,
                         const std::filesystem::path& office, Progress& progress);
std::filesystem::path cleanedIn(const std::filesystem::path& office);

// How well that was done, by the truth of each point:
//   cleaning.recall     share of the points on what moved that were removed
//   cleaning.precision  share of what was removed that had to go: on what moved, between surfaces, mirrored, on drops
//   cleaning.lost       share of all other points that were removed, too
//   cleaning.CLASS.recall, .precision, .lost  the same of the points on one class, by what has to go: "Person"
// Nothing where nothing was cleaned; what is a share of nothing is left out.
std::map<std::string, double> readCleaning(const std::filesystem::path& office);
bool isCleaningFact(const std::string& name);
// "Person" and "recall"; nothing: of all classes, or no such fact.
struct CleaningOfClass {
  std::string name, figure;
};
std::optional<CleaningOfClass> cleaningOfClass(const std::string& fact);

}  // namespace standpoint
