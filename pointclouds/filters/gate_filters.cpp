// SPDX-License-Identifier: GPL-3.0-or-later
// Filters that judge a point by itself.
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "core/environment.h"
#include "pointclouds/filters/filters.h"
#include "pointclouds/statistics/cloud_sample.h"
#include "pointclouds/statistics/coverage.h"

namespace standpoint {
namespace {

// Takes each point that `Judge::stays` does not want.
template <class Judge>
class Gate final : public PointFilter {
 public:
  explicit Gate(Judge judge) : judge_(std::move(judge)) {}
  Result<void> know(const FilterCloud& cloud) override {
    if constexpr (requires { judge_.know(cloud); }) return judge_.know(cloud);
    return {};
  }
  Result<void> beginScan(const ScanHeader& header) override {
    if constexpr (requires { judge_.begin(header); }) return judge_.begin(header);
    return {};
  }
  Result<void> see(const PointBlock& block, std::uint64_t first, Remaining& remaining) override {
    for (std::size_t i = 0; i < block.size(); ++i)
      if (remaining.has(first + i) && !judge_.stays(block, i, first + i)) remaining.take(first + i);
    return {};
  }

 private:
  Judge judge_;
};

template <class Judge>
MadeFilter gate(Judge judge) {
  return std::make_unique<Gate<Judge>>(std::move(judge));
}

struct Interval {
  double from = -std::numeric_limits<double>::infinity(), to = std::numeric_limits<double>::infinity();
  bool has(double value) const { return value >= from && value <= to; }
};

Result<Interval> intervalFrom(const GateOptions& options) {
  if (!options.from && !options.to) return failure(ErrorKind::usage, "a gate requires 'from' or 'to'");
  Interval interval;
  interval.from = options.from.value_or(interval.from);
  interval.to = options.to.value_or(interval.to);
  if (interval.from > interval.to)
    return failure(ErrorKind::usage, "'from' is larger than 'to': no points would remain");
  return interval;
}

struct RangeJudge {
  Interval interval;
  Result<void> begin(const ScanHeader& header) {
    if (stationOf(header)) return {};
    return failure(ErrorKind::unusable, "no scanner position: range is unknown", header.name);
  }
  bool stays(const PointBlock& b, std::size_t i, std::uint64_t) const {
    return interval.has(Eigen::Vector3d(b.x_m[i], b.y_m[i], b.z_m[i]).norm());
  }
};

struct IntensityJudge {
  Interval interval;
  Result<void> begin(const ScanHeader& header) {
    if (header.intensity_max > header.intensity_min) return {};
    return failure(ErrorKind::unusable, "points have no intensity", header.name);
  }
  bool stays(const PointBlock& b, std::size_t i, std::uint64_t) const { return interval.has(b.intensity[i]); }
};

struct IncidenceJudge {
  Interval interval;  // rad
  Result<void> begin(const ScanHeader& header) {
    if (header.has_truth) return {};
    return failure(ErrorKind::unusable, "no true values: incidence is unknown; scan with them", header.name);
  }
  bool stays(const PointBlock& b, std::size_t i, std::uint64_t) const { return interval.has(b.truth.incidence_rad[i]); }
};

struct FractionJudge {
  double fraction;
  std::uint64_t seed;
  bool stays(const PointBlock&, std::size_t, std::uint64_t point) const {
    return static_cast<double>(mixed(mixed(seed) ^ point) >> 11) * 0x1p-53 < fraction;
  }
};

struct EveryJudge {
  std::uint64_t n, seen = 0;
  bool stays(const PointBlock&, std::size_t, std::uint64_t) { return seen++ % n == 0; }
};

struct BoxJudge {
  Bounds box;
  bool inside;
  Pose pose{};
  Result<void> begin(const ScanHeader& header) { return pose = header.file_from_scanner, Result<void>{}; }
  bool stays(const PointBlock& b, std::size_t i, std::uint64_t) const {
    const Eigen::Vector3d p = pose * Eigen::Vector3d(b.x_m[i], b.y_m[i], b.z_m[i]);
    return ((p.array() >= box.min.array()).all() && (p.array() <= box.max.array()).all()) == inside;
  }
};

struct SphereJudge {
  double radius;
  bool inside;
  std::string station;                    // looked for …
  std::optional<Eigen::Vector3d> centre;  // … unless the place is given
  Pose pose{};
  Result<void> know(const FilterCloud& cloud) {
    if (centre) return {};
    std::string names;
    for (const FilterScan& scan : cloud.scans) {
      if (scan.name == station && scan.station) return centre = scan.station, Result<void>{};
      if (scan.station) names += (names.empty() ? "" : ", ") + scan.name;
    }
    return failure(ErrorKind::usage,
                   "unknown station '" + station + "'; available: " + (names.empty() ? "none" : names));
  }
  Result<void> begin(const ScanHeader& header) { return pose = header.file_from_scanner, Result<void>{}; }
  bool stays(const PointBlock& b, std::size_t i, std::uint64_t) const {
    return ((pose * Eigen::Vector3d(b.x_m[i], b.y_m[i], b.z_m[i]) - *centre).norm() <= radius) == inside;
  }
};

}  // namespace

MadeFilter makeRangeGate(const GateOptions& options) {
  TRY_ASSIGN(const auto interval, intervalFrom(options));
  return gate(RangeJudge{interval});
}

MadeFilter makeIntensityGate(const GateOptions& options) {
  TRY_ASSIGN(const auto interval, intervalFrom(options));
  return gate(IntensityJudge{interval});
}

MadeFilter makeIncidenceGate(const GateOptions& options) {
  TRY_ASSIGN(auto interval, intervalFrom(options));
  return gate(IncidenceJudge{{interval.from * std::numbers::pi / 180, interval.to * std::numbers::pi / 180}});
}

MadeFilter makeFractionFilter(const FractionOptions& options) {
  return gate(FractionJudge{options.keep, options.seed});
}

MadeFilter makeEveryFilter(const EveryOptions& options) { return gate(EveryJudge{options.n}); }

MadeFilter makeBoxFilter(const BoxOptions& options) {
  const Bounds box{options.from, options.to};
  if ((box.min.array() > box.max.array()).any())
    return failure(ErrorKind::usage, "'from' exceeds 'to': the box is empty");
  return gate(BoxJudge{box, options.keep == Side::inside});
}

MadeFilter makeSphereFilter(const SphereOptions& options) {
  if (options.at.has_value() == options.station.has_value())
    return failure(ErrorKind::usage, "a sphere requires 'station' or 'at'");
  return gate(SphereJudge{options.radius_m, options.keep == Side::inside, options.station.value_or(""), options.at});
}

}  // namespace standpoint
