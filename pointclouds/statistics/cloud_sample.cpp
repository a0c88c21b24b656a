// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/statistics/cloud_sample.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pointclouds/formats.h"
#include "pointclouds/statistics/coverage.h"

namespace standpoint {

// local_points.h
bool isOfScanner(const Pose& file_from_scanner) {
  const auto& t = file_from_scanner.translation;
  const bool whole_metres = (t.array() - t.array().round()).abs().maxCoeff() < 1e-9;
  return file_from_scanner.rotation.vec().norm() > 1e-9 || !whole_metres;
}

// That of a grid is its scanner's anyway.
std::optional<Eigen::Vector3d> stationOf(const ScanHeader& header) {
  const bool grid = header.rows > 0 && header.columns > 0;
  if (grid || isOfScanner(header.file_from_scanner)) return header.file_from_scanner.translation;
  return std::nullopt;
}

namespace {

class SampleSink final : public PointSink {
 public:
  SampleSink(CloudSample& sample, std::size_t most) : sample_(sample), most_(std::max<std::size_t>(2, most)) {}
  Result<void> begin(const ScanHeader& header) override {
    pose_ = header.file_from_scanner;
    any_intensity_ = any_intensity_ || header.intensity_max > header.intensity_min;
    sample_.scans.push_back({header.name, header.sensor_vendor, header.sensor_model, stationOf(header), 0});
    return {};
  }
  Result<void> write(const PointBlock& block) override {
    for (std::size_t i = 0; i < block.size(); ++i) {
      const float intensity = i < block.intensity.size() ? block.intensity[i] : 0;
      low_ = std::min(low_, intensity), high_ = std::max(high_, intensity);
      const std::uint64_t hash = mixed(sample_.points++);
      if (hash > limit_) continue;
      sample_.position.push_back(pose_ * Eigen::Vector3d(block.x_m[i], block.y_m[i], block.z_m[i]));
      sample_.intensity.push_back(intensity);
      sample_.scan.push_back(static_cast<std::uint32_t>(sample_.scans.size() - 1));
      hash_.push_back(hash);
      if (hash_.size() > most_) halve();
    }
    sample_.scans.back().points += block.size();
    return {};
  }
  Result<void> end() override { return {}; }
  Result<void> close() override { return {}; }
  void finish() {
    if (!any_intensity_) sample_.intensity.clear();
    if (sample_.points > 0) sample_.min_intensity = low_, sample_.max_intensity = high_;
  }

 private:
  void halve() {
    limit_ /= 2;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < hash_.size(); ++i) {
      if (hash_[i] > limit_) continue;
      hash_[kept] = hash_[i];
      sample_.position[kept] = sample_.position[i];
      sample_.intensity[kept] = sample_.intensity[i];
      sample_.scan[kept] = sample_.scan[i];
      ++kept;
    }
    hash_.resize(kept), sample_.position.resize(kept), sample_.intensity.resize(kept), sample_.scan.resize(kept);
  }

  CloudSample& sample_;
  std::size_t most_;
  std::uint64_t limit_ = std::numeric_limits<std::uint64_t>::max();
  std::vector<std::uint64_t> hash_;
  Pose pose_;
  bool any_intensity_ = false;
  float low_ = std::numeric_limits<float>::max(), high_ = std::numeric_limits<float>::lowest();
};

}  // namespace

Result<CloudSample> sampleCloud(const std::filesystem::path& file, std::size_t most, Progress& progress) {
  const CloudFormat* const format = readableCloudFormat(file);
  if (format == nullptr || format->read == nullptr)
    return failure(ErrorKind::usage, "unsupported point-cloud format", file.string());
  CloudSample sample;
  SampleSink sink(sample, most);
  TRY_ASSIGN(auto read, format->read(file, sink, progress));
  sink.finish();
  sample.report = std::move(read);
  if (sample.points == 0) return failure(ErrorKind::unusable, "the point cloud is empty", file.string());
  return sample;
}

std::vector<std::size_t> thinned(const std::vector<Eigen::Vector3d>& places, double cell_m, std::size_t most) {
  struct Entry {
    std::uint64_t cell;
    std::size_t place;
  };
  std::vector<Entry> entries;
  for (std::size_t i = 0; i < places.size(); ++i)
    if (places[i].allFinite()) entries.push_back({hashOf(cellAt(places[i], cell_m)), i});
  // By the cells' hashes, so that cutting the list at `most` is fair to all of space.
  std::sort(entries.begin(), entries.end(),
            [](const Entry& a, const Entry& b) { return a.cell != b.cell ? a.cell < b.cell : a.place < b.place; });
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < entries.size() && result.size() < most; ++i)
    if (i == 0 || entries[i].cell != entries[i - 1].cell) result.push_back(entries[i].place);
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace standpoint
