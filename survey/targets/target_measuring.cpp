// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/targets/target_measuring.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "core/random.h"
#include "pointclouds/formats.h"
#include "pointclouds/statistics/coverage.h"

namespace standpoint {

namespace {

using Eigen::Vector3d;
namespace fs = std::filesystem;

constexpr double kSearch_m = 0.5;
constexpr std::size_t kMostNearTarget = 3000000;
constexpr std::size_t kMostInSample = 1000000;

// Keeps what it is offered, and every second of it each time it has grown too large.
class Kept {
 public:
  explicit Kept(std::size_t most) : most_(most) {}
  void offer(const Vector3d& p, float intensity) {
    const std::uint64_t hash = mixed(seen_++);
    if (hash > limit_) return;
    points.push_back(p), bright.push_back(intensity), hashes_.push_back(hash);
    if (points.size() <= most_) return;
    limit_ /= 2;
    std::size_t n = 0;
    for (std::size_t i = 0; i < hashes_.size(); ++i)
      if (hashes_[i] <= limit_) points[n] = points[i], bright[n] = bright[i], hashes_[n] = hashes_[i], ++n;
    points.resize(n), bright.resize(n), hashes_.resize(n);
  }
  std::vector<Vector3d> points;
  std::vector<float> bright;

 private:
  std::size_t most_;
  std::uint64_t seen_ = 0, limit_ = std::numeric_limits<std::uint64_t>::max();
  std::vector<std::uint64_t> hashes_;
};

struct Near {
  std::size_t target;
  Vector3d predicted;  // own frame of the station
  double radius_m;
  Kept points{kMostNearTarget};
};

struct StationPoints {
  ScannedStation scan;
  std::vector<Near> near;
  Kept sample{kMostInSample};
};

// Where the operator clicks: beside the target by up to so much, drawn for each station and target.
Vector3d clicked(const Station& station, const Target& target, std::size_t number, const MeasuringRequest& request) {
  const Vector3d place = station.true_pose.rotation.conjugate() * (target.centre - station.true_pose.translation);
  const auto r = philox({request.seed, static_cast<std::uint32_t>(stableHash(station.name.c_str()))},
                        static_cast<std::uint32_t>(number), 0, 601);
  const double z = 2 * uniform(r[0]) - 1, azimuth = 2 * M_PI * uniform(r[1]), flat = std::sqrt(1 - z * z);
  return place +
         request.click_m * std::cbrt(uniform(r[2])) * Vector3d(flat * std::cos(azimuth), flat * std::sin(azimuth), z);
}

class NearSink final : public PointSink {
 public:
  NearSink(const Job& job, const MeasuringRequest& request, const fs::path& file, std::vector<StationPoints>& all)
      : job_(job), request_(request), file_(file), all_(all), stations_(job, file) {}
  Result<void> begin(const ScanHeader& header) override {
    TRY_ASSIGN(auto station, stations_.next(header));
    for (const auto& s : all_)
      if (s.scan.station == station)
        return failure(ErrorKind::usage,
                       fmt::format("station {} is also in {}: specify one scan per station",
                                   job_.stations[station].name, s.scan.file),
                       file_.string());
    StationPoints points;
    points.scan = {station, file_.string(), header.intensity_max > header.intensity_min, {}};
    for (std::size_t t = 0; request_.targets && t < job_.targets.size(); ++t)
      points.near.push_back(
          {t, clicked(job_.stations[station], job_.targets[t], t, request_), kSearch_m + job_.targets[t].size_m});
    all_.push_back(std::move(points));
    return {};
  }
  Result<void> write(const PointBlock& block) override {
    auto& now = all_.back();
    const bool bright = block.intensity.size() == block.size();
    for (std::size_t i = 0; i < block.size(); ++i) {
      const Vector3d p(block.x_m[i], block.y_m[i], block.z_m[i]);
      const float intensity = bright ? block.intensity[i] : 0;
      for (auto& n : now.near)
        if ((p - n.predicted).squaredNorm() <= n.radius_m * n.radius_m) n.points.offer(p, intensity);
      if (request_.sample) now.sample.offer(p, intensity);
    }
    return {};
  }
  Result<void> end() override { return {}; }
  Result<void> close() override { return {}; }

 private:
  const Job& job_;
  const MeasuringRequest& request_;
  const fs::path& file_;
  std::vector<StationPoints>& all_;
  StationsOfFile stations_;
};

Result<TargetFit> measured(const Target& target, const Near& near, bool has_intensity) {
  if (target.kind == TargetKind::sphere) {
    SphereSearch search;
    search.search_m = kSearch_m, search.radius_m = target.size_m / 2;
    return findSphere(near.points.points, near.predicted, search);
  }
  CheckerboardSearch search;
  search.search_m = kSearch_m, search.side_m = target.size_m;
  return findCheckerboard(near.points.points,
                          has_intensity ? std::span<const float>(near.points.bright) : std::span<const float>(),
                          near.predicted, search);
}

void measure(const Job& job, StationPoints& station, TargetMeasurements& result) {
  std::vector<Result<TargetFit>> fits(station.near.size(), failure(ErrorKind::internal, "not fitted"));
  tbb::parallel_for(std::size_t{0}, station.near.size(), [&](std::size_t i) {
    fits[i] = measured(job.targets[station.near[i].target], station.near[i], station.scan.has_intensity);
  });
  for (std::size_t i = 0; i < fits.size(); ++i) {
    if (fits[i])
      result.found.push_back({station.scan.station, station.near[i].target, *fits[i]});
    else
      result.missed.push_back(
          {station.scan.station, station.near[i].target, fits[i].error().message, noFitOf(fits[i].error())});
  }
}

}  // namespace

StationsOfFile::StationsOfFile(const Job& job, fs::path file) : job_(job), file_(std::move(file)) {
  for (std::size_t i = 0; i < job.stations.size(); ++i)
    for (const auto& scan : job.stations[i].scans)
      if (fs::path(scan.file).filename() == file_.filename() && (in_file_.empty() || in_file_.back() != i))
        in_file_.push_back(i);
}

Result<std::size_t> StationsOfFile::next(const ScanHeader& header) {
  const std::size_t number = scans_++;
  if (header.rows == 0 || header.columns == 0)
    return failure(
        ErrorKind::unusable,
        fmt::format(
            "scan '{}' has no scanner grid, so the viewpoint of its points is unknown: use the original E57 or PTX",
            header.name),
        file_.string());
  for (std::size_t i = 0; i < job_.stations.size(); ++i)
    if (job_.stations[i].name == header.name) return i;
  if (number < in_file_.size()) return in_file_[number];
  std::vector<std::string> names;
  for (const auto& s : job_.stations) names.push_back(s.name);
  return failure(
      ErrorKind::usage,
      fmt::format("scan '{}' matches no station of this project ({}): scan it here, or rename a station to match",
                  header.name, names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))),
      file_.string());
}

Result<TargetMeasurements> measureTargets(const Job& job, const MeasuringRequest& request, Progress& progress) {
  TargetMeasurements result;
  std::vector<StationPoints> all;
  for (std::size_t i = 0; i < request.files.size(); ++i) {
    const auto& file = request.files[i];
    const CloudFormat* const format = readableCloudFormat(file);
    if (format == nullptr || format->read == nullptr)
      return failure(ErrorKind::usage, "unsupported point-cloud format", file.string());
    const auto fraction = [&](std::size_t k) {
      return 0.8 * static_cast<double>(k) / static_cast<double>(request.files.size());
    };
    progress.stage("Reading " + file.filename().string(), fraction(i), fraction(i + 1));
    NearSink sink(job, request, file, all);
    TRY_ASSIGN(auto read, format->read(file, sink, progress));
    result.report.append(read);
  }
  std::sort(all.begin(), all.end(),
            [](const StationPoints& a, const StationPoints& b) { return a.scan.station < b.scan.station; });
  progress.stage("Measuring targets", 0.8, 0.95);
  for (auto& station : all) {
    TRY(progress.check());
    measure(job, station, result);
    station.scan.sample = std::move(station.sample.points);
    result.scans.push_back(std::move(station.scan));
  }
  return result;
}

}  // namespace standpoint
