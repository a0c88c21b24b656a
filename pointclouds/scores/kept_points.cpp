// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/scores/kept_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "core/environment.h"
#include "pointclouds/filters/cleaning.h"
#include "pointclouds/formats.h"
#include "pointclouds/statistics/coverage.h"
#include "pointclouds/targets/place_grid.h"

namespace standpoint {

namespace {

constexpr std::uint64_t kMostAtOnce = 8'000'000;
constexpr double kCube_m = 1;  // points of one are in one group

// A point with its number in the file and its flags, 0 without truth.
using TakePoint = std::function<void(const Eigen::Vector3d& at_m, std::uint64_t number, std::uint8_t flags)>;

class EachSink final : public PointSink {
 public:
  explicit EachSink(const TakePoint& take) : take_(take) {}
  Result<void> begin(const ScanHeader& header) override {
    pose_ = header.file_from_scanner;
    has_truth_ = header.has_truth;
    return {};
  }
  Result<void> write(const PointBlock& b) override {
    for (std::size_t i = 0; i < b.size(); ++i, ++points) {
      const Eigen::Vector3d at = pose_ * Eigen::Vector3d(b.x_m[i], b.y_m[i], b.z_m[i]);
      if (at.allFinite()) take_(at, points, has_truth_ ? b.truth.flags[i] : std::uint8_t{0});
    }
    return {};
  }
  Result<void> end() override { return {}; }
  Result<void> close() override { return {}; }
  std::uint64_t points = 0;

 private:
  const TakePoint& take_;
  Pose pose_;
  bool has_truth_ = false;
};

Result<std::uint64_t> forEach(const std::filesystem::path& cloud, const TakePoint& take, Progress& progress) {
  EachSink sink(take);
  TRY(readCloud(cloud, sink, progress));
  return sink.points;
}

// The group of a place, of so many; those of cubes that a place is within `reach` of.
std::uint64_t groupOf(const Eigen::Vector3d& at, std::uint64_t groups) {
  return groups == 1 ? 0 : hashOf(cellAt(at, kCube_m)) % groups;
}
bool isNearGroup(const Eigen::Vector3d& at, double reach, std::uint64_t group, std::uint64_t groups) {
  if (groups == 1) return true;
  const Cell low = cellAt(at.array() - reach, kCube_m), high = cellAt(at.array() + reach, kCube_m);
  for (std::int64_t x = low.x(); x <= high.x(); ++x)
    for (std::int64_t y = low.y(); y <= high.y(); ++y)
      for (std::int64_t z = low.z(); z <= high.z(); ++z)
        if (hashOf(Cell(x, y, z)) % groups == group) return true;
  return false;
}

// Points of a group.
struct Places {
  std::vector<Eigen::Vector3d> at;
  std::vector<std::uint64_t> number;
  void clear() { at.clear(), number.clear(); }
  void add(const Eigen::Vector3d& place, std::uint64_t n) { at.push_back(place), number.push_back(n); }
};

// The places of the truth by cells a few tolerances wide: mostly one or two are asked for.
class NearestFree {
 public:
  NearestFree(const Places& places, const std::vector<std::uint8_t>& kept, double tolerance_m)
      : places_(places), kept_(kept), tolerance_m_(tolerance_m), cell_m_(4 * tolerance_m) {
    entries_.reserve(places.at.size());
    for (std::size_t i = 0; i < places.at.size(); ++i)
      entries_.emplace_back(hashOf(cellAt(places.at[i], cell_m_)), static_cast<std::uint32_t>(i));
    std::sort(entries_.begin(), entries_.end());
  }

  struct Found {
    std::optional<std::uint32_t> free;  // nearest, of equal ones the first
    double squared_m2 = 0;
    bool any = false;  // free or not
  };
  Found near(const Eigen::Vector3d& at) const {
    Found found;
    const Cell low = cellAt(at.array() - tolerance_m_, cell_m_), high = cellAt(at.array() + tolerance_m_, cell_m_);
    for (std::int64_t x = low.x(); x <= high.x(); ++x)
      for (std::int64_t y = low.y(); y <= high.y(); ++y)
        for (std::int64_t z = low.z(); z <= high.z(); ++z) lookInto(hashOf(Cell(x, y, z)), at, found);
    return found;
  }

 private:
  void lookInto(std::uint64_t hash, const Eigen::Vector3d& at, Found& found) const {
    for (auto entry = std::lower_bound(entries_.begin(), entries_.end(), std::pair{hash, std::uint32_t{0}});
         entry != entries_.end() && entry->first == hash; ++entry) {
      const double squared_m2 = (places_.at[entry->second] - at).squaredNorm();
      if (squared_m2 > tolerance_m_ * tolerance_m_) continue;
      found.any = true;
      if (kept_[places_.number[entry->second]] != 0) continue;
      if (found.free &&
          (squared_m2 > found.squared_m2 || (squared_m2 == found.squared_m2 && entry->second >= *found.free)))
        continue;
      found.free = entry->second;
      found.squared_m2 = squared_m2;
    }
  }

  const Places& places_;
  const std::vector<std::uint8_t>& kept_;
  double tolerance_m_, cell_m_;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> entries_;
};

// Each point proposes to the nearest that is free, which takes the nearest of those that propose, until nobody is left
// who can: the nearest pair of all comes first, as in a list of all pairs by distance.
void matchGroup(const Places& truth, const Places& cleaned, double tolerance_m, KeptPoints& points) {
  constexpr std::uint32_t kNobody = ~std::uint32_t{0};
  struct Proposal {
    double squared_m2 = std::numeric_limits<double>::infinity();
    std::uint32_t by = kNobody;
  };
  const NearestFree nearest(truth, points.kept, tolerance_m);
  std::vector<Proposal> proposals(truth.at.size());
  std::vector<std::uint32_t> waiting(cleaned.at.size()), proposed, still;
  for (std::size_t i = 0; i < waiting.size(); ++i) waiting[i] = static_cast<std::uint32_t>(i);
  while (!waiting.empty()) {
    still.clear(), proposed.clear();
    for (const auto c : waiting) {
      const auto found = nearest.near(cleaned.at[c]);
      if (!found.free) {
        ++(found.any ? points.doubled : points.unknown);
        if (!found.any && !points.first_unknown) points.first_unknown = cleaned.at[c];
        continue;
      }
      auto& proposal = proposals[*found.free];
      if (proposal.by == kNobody) proposed.push_back(*found.free);
      if (proposal.by != kNobody) still.push_back(found.squared_m2 < proposal.squared_m2 ? proposal.by : c);
      if (found.squared_m2 < proposal.squared_m2) proposal = {found.squared_m2, c};
    }
    for (const auto t : proposed) points.kept[truth.number[t]] = 1;
    std::sort(still.begin(), still.end());
    waiting.swap(still);
    for (const auto t : proposed) proposals[t] = {};
  }
}

struct Extent {
  Bounds bounds;
  std::uint64_t points = 0;
};
Result<Extent> extentOf(const std::filesystem::path& cloud, const TakePoint& also, Progress& progress) {
  Extent extent;
  TRY_ASSIGN(extent.points, forEach(
                                cloud,
                                [&](const Eigen::Vector3d& at, std::uint64_t number, std::uint8_t flags) {
                                  extent.bounds.extend(at);
                                  also(at, number, flags);
                                },
                                progress));
  return extent;
}

// Points drawn evenly by a hash of their numbers, fewer than 512.
class FewPoints {
 public:
  void add(const Eigen::Vector3d& at, std::uint64_t number) {
    const std::uint64_t hash = mixed(number);
    if (hash > limit_) return;
    few_.emplace_back(hash, at);
    if (few_.size() < 2 * kMost) return;
    std::nth_element(few_.begin(), few_.begin() + kMost, few_.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    limit_ = few_[kMost].first;
    few_.resize(kMost);
  }
  std::vector<Eigen::Vector3d> places() const {
    std::vector<Eigen::Vector3d> all;
    for (const auto& [hash, at] : few_) all.push_back(at);
    return all;
  }

 private:
  static constexpr std::size_t kMost = 256;
  std::uint64_t limit_ = ~std::uint64_t{0};
  std::vector<std::pair<std::uint64_t, Eigen::Vector3d>> few_;
};

// None, then what takes one corner or the middle of a box to that of the other, in ever finer steps.
std::vector<Eigen::Vector3d> possibleShifts(const Bounds& truth, const Bounds& cleaned) {
  std::vector<Eigen::Vector3d> all = {Eigen::Vector3d::Zero()};
  const std::array off = {Eigen::Vector3d(truth.min - cleaned.min), Eigen::Vector3d(truth.max - cleaned.max),
                          Eigen::Vector3d((truth.min + truth.max - cleaned.min - cleaned.max) / 2)};
  for (const double step_m : {1000.0, 100.0, 10.0, 1.0})
    for (const auto& one : off) {
      const Eigen::Vector3d shift = (one / step_m).array().round() * step_m + 0.0;  // no -0
      if (std::find(all.begin(), all.end(), shift) == all.end()) all.push_back(shift);
    }
  return all;
}

// How many of the points are at a place of the truth, by shift.
Result<std::vector<std::size_t>> countMatches(const std::filesystem::path& truth,
                                              const std::vector<Eigen::Vector3d>& few,
                                              const std::vector<Eigen::Vector3d>& shifts, double tolerance_m,
                                              Progress& progress) {
  std::vector<Eigen::Vector3d> places;
  for (const auto& shift : shifts)
    for (const auto& at : few) places.push_back(at + shift);
  const PlaceGrid grid(places, tolerance_m);
  std::vector<bool> found(places.size());
  TRY(forEach(
      truth,
      [&](const Eigen::Vector3d& at, std::uint64_t, std::uint8_t) {
        grid.near(at, tolerance_m, [&](std::size_t k) { found[k] = true; });
      },
      progress));
  std::vector<std::size_t> counts(shifts.size());
  for (std::size_t k = 0; k < found.size(); ++k) counts[k / few.size()] += found[k] ? 1 : 0;
  return counts;
}

std::string percentOf(std::size_t part, std::size_t whole) {
  return std::to_string(whole == 0 ? 0 : 100 * part / whole) + " %";
}

Result<Eigen::Vector3d> shiftOf(const std::filesystem::path& truth, const std::filesystem::path& cleaned,
                                const std::vector<Eigen::Vector3d>& few, const std::vector<Eigen::Vector3d>& shifts,
                                double tolerance_m, Progress& progress) {
  TRY_ASSIGN(const auto counts, countMatches(truth, few, shifts, tolerance_m, progress));
  const auto best = std::max_element(counts.begin(), counts.end());
  if (2 * *best < few.size())
    return failure(ErrorKind::unusable,
                   "only " + percentOf(*best, few.size()) +
                       " of a sample of its points are at a place of the truth: state what the program took off the "
                       "coordinates with --shift, or allow for its rounding with --tolerance",
                   cleaned.string());
  return shifts[static_cast<std::size_t>(best - counts.begin())];
}

}  // namespace

Result<KeptPoints> keptPoints(const std::filesystem::path& truth, const std::filesystem::path& cleaned,
                              const KeptOptions& options, Progress& progress) {
  KeptPoints points;
  FewPoints few;
  progress.stage("Read " + cleaned.filename().string(), 0, 0.1);
  const auto nothing = [](const Eigen::Vector3d&, std::uint64_t, std::uint8_t) {};
  TRY_ASSIGN(const auto other,
             extentOf(
                 cleaned, [&](const Eigen::Vector3d& at, std::uint64_t number, std::uint8_t) { few.add(at, number); },
                 progress));
  progress.stage("Read " + truth.filename().string(), 0.1, 0.3);
  TRY_ASSIGN(const auto all, extentOf(truth, nothing, progress));
  points.cleaned = other.points;
  points.kept.assign(all.points, 0);
  if (other.points == 0) return points;
  const auto shifts = options.shift_m ? std::vector{*options.shift_m} : possibleShifts(all.bounds, other.bounds);
  TRY_ASSIGN(points.shift_m, shiftOf(truth, cleaned, few.places(), shifts, options.tolerance_m, progress));

  const std::uint64_t groups = (all.points + other.points + kMostAtOnce - 1) / kMostAtOnce;
  Places here, there;
  for (std::uint64_t group = 0; group < groups; ++group) {
    const auto share = [&](double done) {
      return 0.3 + 0.7 * (static_cast<double>(group) + done) / static_cast<double>(groups);
    };
    progress.stage("Match the points", share(0), share(0.5));
    here.clear(), there.clear();
    TRY(forEach(
        truth,
        [&](const Eigen::Vector3d& at, std::uint64_t number, std::uint8_t) {
          if (isNearGroup(at, options.tolerance_m, group, groups)) here.add(at, number);
        },
        progress));
    progress.stage("Match the points", share(0.5), share(1));
    TRY(forEach(
        cleaned,
        [&](const Eigen::Vector3d& at, std::uint64_t number, std::uint8_t) {
          const Eigen::Vector3d moved = at + points.shift_m;
          if (groupOf(moved, groups) == group) there.add(moved, number);
        },
        progress));
    matchGroup(here, there, options.tolerance_m, points);
    TRY(progress.check());
  }
  return points;
}

Result<std::uint64_t> keepThinned(const std::filesystem::path& truth, double spacing_m, KeptPoints& points,
                                  Progress& progress) {
  std::uint64_t stood_for = 0;
  const std::uint64_t groups = (points.kept.size() + kMostAtOnce - 1) / kMostAtOnce;
  struct Kind {
    Places kept, gone;
  };
  for (std::uint64_t group = 0; group < groups; ++group) {
    progress.stage("Allow for thinning", static_cast<double>(group) / static_cast<double>(groups),
                   static_cast<double>(group + 1) / static_cast<double>(groups));
    std::array<Kind, 2> kinds;
    TRY(forEach(
        truth,
        [&](const Eigen::Vector3d& at, std::uint64_t number, std::uint8_t flags) {
          Kind& kind = kinds[(flags & kFlawed) != 0 ? 1 : 0];
          if (points.kept[number] == 1) {
            if (isNearGroup(at, spacing_m, group, groups)) kind.kept.add(at, number);
          } else if (groupOf(at, groups) == group) {
            kind.gone.add(at, number);
          }
        },
        progress));
    for (const Kind& kind : kinds) {
      const PlaceGrid grid(kind.kept.at, spacing_m);
      for (std::size_t i = 0; i < kind.gone.at.size(); ++i) {
        auto& kept = points.kept[kind.gone.number[i]];
        grid.near(kind.gone.at[i], spacing_m, [&](std::size_t) { kept = 2; });
        stood_for += kept == 2 ? 1 : 0;
      }
    }
    TRY(progress.check());
  }
  return stood_for;
}

}  // namespace standpoint
