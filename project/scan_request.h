// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pointclouds/formats.h"
#include "project/document.h"
#include "project/field_fault.h"
#include "project/levelling.h"
#include "project/survey_verbs.h"
#include "scanners/engine/ray_engine.h"

namespace standpoint {

// What the options of `scan` ask for, checked.
struct ScanRequest {
  Instrument instrument;
  ScanSettings settings;
  ScanOptions options;
  std::vector<std::size_t> stations;  // indices into the job
  const CloudFormat* format = nullptr;
  std::string as;  // variant of the format, or empty
  CloudFormat::Writer writer = nullptr;
  std::filesystem::path output;
  bool one_file = false;  // all stations in `output`; else a file each
  Levelling levelling;
  bool panorama = false;               // each station takes its pictures, and the points are coloured from them
  std::uint32_t panorama_columns = 0;  // that were asked for; 0: the instrument's own
  FieldFault field_fault;
  std::vector<std::string> notes;  // "key=text" for the files' record
  bool resume = false;             // stations that an earlier run finished are not scanned again
};

// What of it the next scan would begin with, and the options that ask for that.
ScanChoice choiceOf(const ScanRequest& request);
ScanVerbOptions optionsOf(const ScanChoice& choice);
// The effects that are left out, separated by commas: what effectsWithout reads.
std::string leftOut(Effects effects);

Result<ScanRequest> scanRequestFrom(const Document& document, const ScanVerbOptions& options);

// Indices into the job.
Result<std::vector<std::size_t>> stationsFrom(const Job& job, const StationNames& wanted);
// What the document assigns, else what the default rules would, and the note that says so.
Result<MaterialAssignment> scanAssignment(const Document& document, Progress& progress);
void noteDefaultRules(const Document& document, Report& report);

// Where the station's points go.
std::filesystem::path fileOf(const ScanRequest& request, const Station& station);

}  // namespace standpoint
