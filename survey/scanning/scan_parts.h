// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "core/part_file.h"
#include "core/points.h"
#include "core/progress.h"
#include "scanners/engine/ray_engine.h"

namespace standpoint {

// What a run over several stations has finished, beside its output in OUTPUT.parts, so that neither a crash nor a
// cancel loses a station: a record of each, and where all go into one file its points as they went there. A record is
// written after the points are, whole or not at all.
class ScanParts {
 public:
  explicit ScanParts(const std::filesystem::path& output);

  struct Finished {
    ScanCount count;
    std::uint64_t bytes = 0;  // of the station's own file, or of its points here
  };
  // Nothing when the station is not finished, or was scanned otherwise: the guid says so.
  std::optional<Finished> finished(const std::string& station, const std::string& guid) const;
  bool hasRecord(const std::string& station) const;
  Result<void> record(const std::string& station, const std::string& guid, const Finished& finished) const;
  // After all went well.
  void remove(const std::string& station) const;

  std::filesystem::path pointsOf(const std::string& station) const;
  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path recordOf(const std::string& station) const;
  std::filesystem::path folder_;
};

// Passes the points of one scan on and keeps them in a file, too. Its begin() and close() are not those of the sink
// behind it: a scan begins and ends there, the file stays open.
class PointTape : public PointSink {
 public:
  static Result<std::unique_ptr<PointTape>> create(const std::filesystem::path& file, PointSink& behind);
  Result<void> begin(const ScanHeader& header) override;
  Result<void> write(const PointBlock& block) override;
  Result<void> picture(const StationPicture& picture) override;
  Result<void> end() override;
  Result<void> close() override;  // of the tape only
  std::uint64_t size() const { return file_.size(); }

 private:
  PointTape(PartFile file, PointSink& behind) : file_(std::move(file)), behind_(behind) {}
  Result<void> put(std::uint8_t kind);  // what `buffer_` holds

  PartFile file_;
  PointSink& behind_;
  std::vector<std::uint8_t> buffer_;
};

// Plays a tape to a sink that has begun the scan. A tape that is damaged is an error that names the file.
Result<void> playTape(const std::filesystem::path& file, PointSink& sink, Progress& progress);

}  // namespace standpoint
