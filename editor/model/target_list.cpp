// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/target_list.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/data_folder.h"
#include "editor/words/sentences.h"
#include "project/verb.h"

namespace standpoint {

namespace {

// All that the fits hang on: the files as they were written, and where the targets stand.
std::string keyOf(const Job& job) {
  std::string key;
  for (const auto& s : job.stations)
    if (!s.scans.empty())
      key += fmt::format("{} {} {} {};", s.name, s.scans.back().file, s.scans.back().points, s.scans.size());
  for (const auto& t : job.targets)
    key += fmt::format("{} {} {} {} {};", t.name, t.centre.x(), t.centre.y(), t.centre.z(), t.size_m);
  return key;
}

void takeFits(std::vector<TargetRow>& rows, const TargetMeasurements& measured) {
  for (auto& row : rows) {
    const auto same = [&](const auto& m) { return m.station == row.station && m.target == row.target; };
    if (const auto found = std::find_if(measured.found.begin(), measured.found.end(), same);
        found != measured.found.end())
      row.fit = found->fit;
    if (const auto missed = std::find_if(measured.missed.begin(), measured.missed.end(), same);
        missed != measured.missed.end())
      row.why_not = missed->why;
    row.scanned = row.fit || !row.why_not.empty();
  }
}

}  // namespace

std::vector<std::filesystem::path> lastScanFiles(const Job& job) {
  std::vector<std::filesystem::path> files;
  for (const auto& s : job.stations)
    if (!s.scans.empty() && std::find(files.begin(), files.end(), s.scans.back().file) == files.end())
      files.emplace_back(s.scans.back().file);
  return files;
}

bool TargetList::busy() const {
  const std::lock_guard lock(mutex_);
  return busy_;
}

std::vector<TargetRow> TargetList::rows() const {
  const std::lock_guard lock(mutex_);
  return rows_;
}

std::string TargetList::problem() const {
  const std::lock_guard lock(mutex_);
  return problem_;
}

const TargetKinds* TargetList::kinds() {
  if (!kinds_read_)
    if (auto read = readTargetKinds(dataFolder() / "scanners" / "targets" / "kinds.json")) kinds_ = *std::move(read);
  kinds_read_ = true;
  return kinds_ ? &*kinds_ : nullptr;
}

void TargetList::follow(const Document& document, const std::shared_ptr<const RayScene>& scene,
                        const std::optional<ScanSettings>& settings) {
  if (!document.job || !scene || kinds() == nullptr) return;
  const Wish wish{document.job, scene, settings ? settings->values : SettingValues(), settings ? settings->columns : 0};
  if (wish == wish_) return;
  task_.reset();
  wish_ = wish;
  busy_ = true;  // no worker yet
  task_ = std::make_unique<Task<void>>("Measure targets", [this, document, scene, settings](Progress& progress) {
    work(document, *scene, settings, progress);
    return Result<void>();
  });
}

void TargetList::work(const Document& document, const RayScene& scene, const std::optional<ScanSettings>& settings,
                      Progress& progress) {
  const Job& job = *document.job;
  std::vector<TargetRow> rows;
  for (std::size_t t = 0; t < job.targets.size(); ++t)
    for (std::size_t s = 0; s < job.stations.size(); ++s)
      rows.push_back({t, s, sightFrom(job.stations[s], scene, job.targets[t], kinds_->rules, settings), false, {}, {}});
  const auto key = keyOf(job);
  const auto files = lastScanFiles(job);
  std::string problem;
  if (key != measured_key_ || files.empty()) measured_ = {};
  if (key != measured_key_ && !files.empty() && !job.targets.empty()) {
    {
      const std::lock_guard lock(mutex_);
      rows_ = rows;  // to be looked at while the scans are read
    }
    if (wake_) wake_();
    // The operator clicks on the target itself.
    auto measured =
        measureTargets(job, {.files = files, .seed = 1, .click_m = 0, .targets = true, .sample = false}, progress);
    if (measured)
      measured_ = *std::move(measured);
    else
      problem = trError(measured.error());
  }
  const bool cancelled = progress.cancelled();
  if (!cancelled) measured_key_ = problem.empty() ? key : std::string();
  takeFits(rows, measured_);
  {
    const std::lock_guard lock(mutex_);
    rows_ = std::move(rows);
    problem_ = cancelled ? std::string() : std::move(problem);
    busy_ = false;
  }
  if (wake_) wake_();
}

}  // namespace standpoint
