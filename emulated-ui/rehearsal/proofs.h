// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "emulated-ui/device/device.h"
#include "emulated-ui/rehearsal/exercise.h"
#include "project/document.h"

namespace standpoint {

struct ProofRow {
  const char* name;  // "data.noise"
  const char* unit;  // "mm"
  FactDomain domain;
  const char* about;
};

// What the points say, read from the scans when it is asked for, and kept as long as the scans are the same.
//   data.*     of the newest scan: noise, error, tilt, and shares of points that are mixed, mirrored, moving or weather
//   survey.*  of all stations that are put up, before a scan: see survey_proofs.h
//   plan.*     of the stations that were scanned from: coverage, least overlap of neighbours
//   targets.*  of the targets that were put up: how many, how they are spread, how well they were found
//   links.*    of the links between the setups, against the truth
//   control.*, repeats.*  see field_proofs.h
//   office.*   of the copies
//   cleaning.*  of what a student's cleaning of them left: see office_cleaning.h
class Proofs {
 public:
  std::optional<Fact> fact(const std::string& name, const Exercise& exercise, const Device& device,
                           const Document& document, const std::filesystem::path& folder);

 private:
  std::map<std::string, double> data_;
  std::string data_of_;  // file
  std::map<std::string, double> plan_;
  std::string plan_of_;  // stations and settings
  std::map<std::string, double> parts_;
  std::string parts_of_;  // files
  std::map<std::string, double> cleaning_;
  std::string cleaning_of_;  // when it was done
  std::map<std::string, double> survey_;
  std::string survey_of_;
  std::vector<std::uint8_t> survey_reach_;
};

const std::vector<ProofRow>& proofRows();

}  // namespace standpoint
