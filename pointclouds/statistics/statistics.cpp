// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/statistics/statistics.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "core/progress_part.h"
#include "pointclouds/formats.h"
#include "pointclouds/statistics/cloud_distances.h"
#include "pointclouds/statistics/coverage.h"
#include "pointclouds/statistics/neighbourhoods.h"

namespace standpoint {
namespace {

// First pass: all that one look at each point gives, and the choice of the samples.
class SurveySink final : public PointSink {
 public:
  explicit SurveySink(const StatisticsOptions& options) : options_(options) {}
  Result<void> begin(const ScanHeader& header) override;
  Result<void> write(const PointBlock& block) override;
  Result<void> end() override { return {}; }
  Result<void> close() override { return {}; }

  CloudStatistics statistics() const;
  std::vector<Neighbourhood> samples() const;  // in the order of the file
  Coverage coverage;

 private:
  void consider(const PointBlock& block, std::size_t i, const Eigen::Vector3d& point);
  StatisticsOptions options_;
  CloudStatistics result_;
  ScanHeader header_;
  Moments intensity_;
  std::map<std::string, Moments> materials_;
  std::vector<Moments*> material_of_;  // by the scan's label
  // A heap with the largest hash on top: those with the smallest hashes stay.
  std::vector<std::pair<std::uint64_t, Neighbourhood>> chosen_;
};

Result<void> SurveySink::begin(const ScanHeader& header) {
  ++result_.scans;
  header_ = header;
  material_of_.clear();
  for (const auto& name : header.materials) material_of_.push_back(&materials_[name]);
  return {};
}

void SurveySink::consider(const PointBlock& block, std::size_t i, const Eigen::Vector3d& point) {
  const std::uint64_t hash = mixed(result_.points);
  const auto less = [](const auto& a, const auto& b) { return a.first < b.first; };
  if (chosen_.size() == options_.samples) {
    if (chosen_.empty() || hash >= chosen_.front().first) return;
    std::pop_heap(chosen_.begin(), chosen_.end(), less);
    chosen_.pop_back();
  }
  Neighbourhood at;
  at.index = result_.points;
  at.scan = static_cast<std::uint32_t>(result_.scans - 1);
  at.centre = point;
  at.beam = (point - header_.file_from_scanner.translation).normalized();
  at.intensity = block.intensity[i];
  chosen_.emplace_back(hash, std::move(at));
  std::push_heap(chosen_.begin(), chosen_.end(), less);
}

Result<void> SurveySink::write(const PointBlock& block) {
  for (std::size_t i = 0; i < block.size(); ++i) {
    const Eigen::Vector3d point = header_.file_from_scanner * Eigen::Vector3d(block.x_m[i], block.y_m[i], block.z_m[i]);
    result_.low = result_.points == 0 ? point : result_.low.cwiseMin(point);
    result_.high = result_.points == 0 ? point : result_.high.cwiseMax(point);
    coverage.add(hashOf(cellAt(point, options_.cell_m)));
    intensity_.add(block.intensity[i]);
    if (header_.has_labels) material_of_[block.material[i]]->add(block.intensity[i]);
    consider(block, i, point);
    ++result_.points;
  }
  return {};
}

CloudStatistics SurveySink::statistics() const {
  CloudStatistics result = result_;
  for (const auto& [name, moments] : materials_)
    if (moments.n > 0) result.materials.push_back({name, moments.n, moments.mean, moments.sigma()});
  std::vector<double> intensities;
  for (const auto& [hash, sample] : chosen_) intensities.push_back(sample.intensity);
  result.intensity = distributionOf(std::move(intensities));
  result.intensity.samples = intensity_.n;
  result.intensity.mean = intensity_.mean;
  result.intensity.sigma = intensity_.sigma();
  return result;
}

std::vector<Neighbourhood> SurveySink::samples() const {
  std::vector<Neighbourhood> all;
  for (const auto& [hash, sample] : chosen_) all.push_back(sample);
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.index < b.index; });
  return all;
}

// Passes on the scans of one name, or all of them where it has none.
class ScanOfName final : public PointSink {
 public:
  ScanOfName(PointSink& sink, const std::string& name) : sink_(sink), name_(name) {}
  Result<void> begin(const ScanHeader& header) override {
    names_.push_back(header.name);
    open_ = name_.empty() || header.name == name_;
    found_ = found_ || open_;
    return open_ ? sink_.begin(header) : Result<void>();
  }
  Result<void> write(const PointBlock& block) override { return open_ ? sink_.write(block) : Result<void>(); }
  Result<void> end() override { return open_ ? sink_.end() : Result<void>(); }
  Result<void> close() override { return sink_.close(); }

  // Once all has been read.
  Result<void> found(const std::filesystem::path& file) const {
    if (name_.empty() || found_) return {};
    return failure(ErrorKind::usage,
                   fmt::format("unknown scan '{}'; available: {}", name_,
                               names_.empty() ? "none" : fmt::format("{}", fmt::join(names_, ", "))),
                   file.string());
  }

 private:
  PointSink& sink_;
  const std::string& name_;
  std::vector<std::string> names_;
  bool open_ = false, found_ = false;
};

// Hands everything to both.
class BothSinks final : public PointSink {
 public:
  BothSinks(PointSink& one, PointSink& other) : one_(one), other_(other) {}
  Result<void> begin(const ScanHeader& header) override {
    TRY(one_.begin(header));
    return other_.begin(header);
  }
  Result<void> write(const PointBlock& block) override {
    TRY(one_.write(block));
    return other_.write(block);
  }
  Result<void> end() override {
    TRY(one_.end());
    return other_.end();
  }
  Result<void> close() override {
    TRY(one_.close());
    return other_.close();
  }

 private:
  PointSink &one_, &other_;
};

Result<Report> readPart(const CloudFormat& format, const CloudPart& part, PointSink& sink, Progress& progress) {
  ScanOfName scans(sink, part.scan);
  TRY_ASSIGN(auto report, format.read(part.file, scans, progress));
  TRY(scans.found(part.file));
  return report;
}

struct Measured {
  CloudStatistics statistics;
  Coverage coverage;
  PlaceSampler places;
};

Result<Measured> measure(const CloudPart& part, const StatisticsOptions& options, Report& report, Progress& progress) {
  const auto& file = part.file;
  const CloudFormat* const format = cloudFormatFor(file);
  if (!format || !format->read) return failure(ErrorKind::usage, "unsupported point-cloud format", file.string());
  if (!(options.radius_m > 0) || !(options.cell_m > 0))
    return failure(ErrorKind::usage, "radius and cell must be positive", file.string());
  SurveySink survey(options);
  constexpr double kSurveyed = 0.4;  // of the time: what is kept is looked up in the second pass
  ProgressPart surveying(progress, 0, kSurveyed), measuring(progress, kSurveyed, 1);
  TRY_ASSIGN(const auto read, readPart(*format, part, survey, surveying));
  report.append(read);
  survey.coverage.settle();
  std::vector<Neighbourhood> samples = survey.samples();
  NeighbourSink neighbours(samples, options.radius_m);
  auto statistics = survey.statistics();
  PlaceSampler places(statistics.low);
  BothSinks both(neighbours, places);
  TRY(readPart(*format, part, both, measuring));
  std::vector<double> noise, rough;
  for (const Neighbourhood& sample : samples) {
    if (const auto v = planeNoise(sample)) noise.push_back(*v);
    if (const auto v = roughness(sample)) rough.push_back(*v);
  }
  Measured result{std::move(statistics), std::move(survey.coverage), std::move(places)};
  result.statistics.plane_noise_m = distributionOf(std::move(noise));
  result.statistics.roughness_m = distributionOf(std::move(rough));
  result.statistics.occupied_cells = result.coverage.cells();
  return result;
}

// Of the work with two files, that with the first, by their sizes.
double shareOf(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code of_a, of_b;
  const auto size_a = static_cast<double>(std::filesystem::file_size(a, of_a)),
             size_b = static_cast<double>(std::filesystem::file_size(b, of_b));
  return of_a || of_b || size_a + size_b <= 0 ? 0.5 : size_a / (size_a + size_b);
}

}  // namespace

Result<CloudStatistics> measureCloud(const std::filesystem::path& file, const StatisticsOptions& options,
                                     Report& report, Progress& progress) {
  TRY_ASSIGN(auto measured, measure({file}, options, report, progress));
  return std::move(measured.statistics);
}

Result<CloudComparison> compareClouds(const CloudPart& a, const CloudPart& b, const StatisticsOptions& options,
                                      Progress& progress) {
  CloudComparison comparison;
  constexpr double kShareOfTime = 0.7;  // for each cloud by itself
  const double share = kShareOfTime * shareOf(a.file, b.file);
  ProgressPart of_a(progress, 0, share), of_b(progress, share, kShareOfTime);
  ProgressPart a_from_b(progress, kShareOfTime, (1 + kShareOfTime) / 2), b_from_a(progress, (1 + kShareOfTime) / 2, 1);
  TRY_ASSIGN(auto first, measure(a, options, comparison.report, of_a));
  TRY_ASSIGN(auto second, measure(b, options, comparison.report, of_b));
  comparison.a = std::move(first.statistics);
  comparison.b = std::move(second.statistics);
  comparison.a_covered_by_b = first.coverage.sharedWith(second.coverage);
  comparison.b_covered_by_a = second.coverage.sharedWith(first.coverage);
  TRY_ASSIGN(comparison.a_from_b, distancesBetween(first.places, second.places, a_from_b));
  TRY_ASSIGN(comparison.b_from_a, distancesBetween(second.places, first.places, b_from_a));
  return comparison;
}

}  // namespace standpoint
