// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/model/import_clouds.h"

#include <fmt/format.h>

#include "pointclouds/formats.h"
#include "survey/geodesy.h"

namespace standpoint {

namespace {

namespace fs = std::filesystem;

// Of a projected CRS; empty where the cloud states none that is known.
std::string statedCrs(const Underlay& cloud) {
  const auto found = findCrs(cloud.crs);
  return !cloud.crs.empty() && found && found->projected ? found->code : std::string();
}

Result<void> refuseModelOptions(const AddOptions& options) {
  const char* const option = options.up ? "--up" : options.unit ? "--unit" : options.types ? "--types" : nullptr;
  if (option == nullptr) return {};
  return failure(ErrorKind::usage, "this option is for models; a point cloud is read in metres, with Z up", option);
}

}  // namespace

ImportFiles sorted(const std::vector<fs::path>& files) {
  ImportFiles result;
  for (const auto& file : files) (readableCloudFormat(file) != nullptr ? result.clouds : result.models).push_back(file);
  return result;
}

Result<void> addClouds(Answered<ImportAnswer>& outcome, const std::vector<fs::path>& clouds, Progress& progress) {
  for (const auto& file : clouds) {
    TRY_ASSIGN(auto added, readUnderlay(outcome.document, {.add = file}, outcome.report, progress));
    outcome.document.underlays.push_back(std::make_shared<const Underlay>(std::move(added)));
  }
  for (const auto& underlay : outcome.document.underlays) outcome.answer.underlays.push_back(underlayRow(*underlay));
  outcome.document.import_report = std::make_shared<const Report>(outcome.report);
  return {};
}

Result<Answered<ImportAnswer>> importClouds(const Document& document, const std::vector<fs::path>& clouds,
                                            const ImportVerbOptions& options, Progress& progress) {
  TRY(refuseModelOptions(options));
  Georeference georeference;
  if (!options.crs.empty()) {
    TRY_ASSIGN(auto found, findCrs(options.crs));
    georeference.crs = found.code;
  }
  Answered<ImportAnswer> outcome;
  auto& made = outcome.document;
  made.name = document.name.empty() ? clouds.front().stem().string() : document.name;
  made.imported = std::make_shared<const Environment>();
  made.job = std::make_shared<const Job>(Job{made.name, {}, {}, {}});
  made.georeference = std::make_shared<const Georeference>(georeference);
  TRY(addClouds(outcome, clouds, progress));
  if (georeference.crs.empty()) georeference.crs = statedCrs(*made.underlays.front());
  georeference.shift_m =
      chooseShift({.shift = options.shift.mode, .given_shift_m = options.shift.given_m}, siteInFile(made));
  made.georeference = std::make_shared<const Georeference>(georeference);
  outcome.answer.georeference = georeference;
  std::uint64_t points = 0;
  for (const auto& underlay : made.underlays) points += underlay->points;
  outcome.description = fmt::format("Imported {}: {} points", clouds.front().filename().string(), points);
  if (clouds.size() > 1) outcome.description += fmt::format(" of {} clouds", clouds.size());
  return outcome;
}

}  // namespace standpoint
