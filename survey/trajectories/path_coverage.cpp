// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/trajectories/path_coverage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include <tbb/parallel_for.h>

#include "optimizer/walk/walkable_map.h"
#include "scanners/patterns/scan_pattern.h"
#include "survey/stations/station_places.h"

namespace standpoint {

namespace {

constexpr int kRows = 90, kColumns = 90;  // 2 by 4 degrees
constexpr double kPi = std::numbers::pi;

std::size_t binOf(const Eigen::Vector3d& d) {
  const double elevation = std::asin(std::clamp(d.z(), -1.0, 1.0)), azimuth = std::atan2(d.y(), d.x());
  const int row = std::clamp(static_cast<int>(std::floor((elevation / kPi + 0.5) * kRows)), 0, kRows - 1);
  const int column = static_cast<int>(std::floor((azimuth / (2 * kPi) + 0.5) * kColumns + 0.5)) % kColumns;
  return static_cast<std::size_t>(row * kColumns + column);
}

double solidAngle(int row) {
  const auto edge = [](int r) { return std::sin((static_cast<double>(r) / kRows - 0.5) * kPi); };
  return (edge(row + 1) - edge(row)) * 2 * kPi / kColumns;
}

struct TimedPlace {
  double after_s = 0, lasts_s = 0;
  Pose pose;
};

std::vector<TimedPlace> placesAlong(const CarriedMotion& carried) {
  constexpr double kStep_s = 0.25, kStep_m = 0.25;
  constexpr double kMost = 6000;
  const double seconds = carried.seconds(), first = carried.path->first_s();
  const double wanted = std::max({1.0, std::ceil(seconds / kStep_s), std::ceil(carried.length_m / kStep_m)});
  const auto count = static_cast<std::size_t>(std::min(wanted, kMost));
  std::vector<TimedPlace> places(count);
  for (std::size_t k = 0; k < count; ++k) {
    const double after = seconds * (static_cast<double>(k) + 0.5) / static_cast<double>(count);
    places[k] = {after, seconds / static_cast<double>(count), carried.truth->pose(first + after)};
  }
  return places;
}

// What has been met of a sample so far that gives no point that counts.
struct Misses {
  bool grazing = false, out_of_view = false, weak = false, hidden = false;
  double passed_per_m2 = 0;  // points that what moves has kept away
};

Blindness reasonOf(const SampleSight& sight, const Misses& misses, const CoveredWhen& wanted) {
  if (sight.density_per_m2 >= wanted.density_per_m2) return Blindness::covered;
  if (sight.density_per_m2 + misses.passed_per_m2 >= wanted.density_per_m2) return Blindness::passed_by;
  if (sight.density_per_m2 > 0 || misses.passed_per_m2 > 0) return Blindness::sparse;
  if (misses.grazing) return Blindness::grazing;
  if (misses.out_of_view) return Blindness::out_of_view;
  if (misses.hidden && !misses.weak) return Blindness::occluded;
  return Blindness::out_of_range;
}

void addPoints(SampleSight& sight, const ExpectedReturn& expected, double points, double after_s,
               const CoveredWhen& wanted) {
  const bool first = sight.passes == 0;
  if (first || after_s - sight.last_s > wanted.pass_gap_s) ++sight.passes;
  sight.range_m = first ? expected.range_m : std::min(sight.range_m, expected.range_m);
  sight.incidence_rad = first ? expected.incidence_rad : std::min(sight.incidence_rad, expected.incidence_rad);
  if (first) sight.first_s = after_s;
  sight.last_s = after_s;
  sight.density_per_m2 += points;
}

// What a path sees, sample by sample.
class Prediction {
 public:
  Prediction(const Expectation& expectation, const PulseDensity& pulses, const CoveredWhen& wanted,
             const PassingBodies* passing, double path_first_s)
      : expectation_(expectation), pulses_(pulses), wanted_(wanted), passing_(passing), first_s_(path_first_s) {}

  void see(const SurfaceSample& sample, std::span<const TimedPlace> along, SampleSight& sight, Misses& misses) const {
    for (const TimedPlace& here : along) see(sample, here, sight, misses);
  }

 private:
  void see(const SurfaceSample& sample, const TimedPlace& here, SampleSight& sight, Misses& misses) const {
    SurfacePlace place = sample.place;
    const Eigen::Vector3d way = place.position - here.pose.translation;
    const double range = way.norm();
    if (range < 1e-6 || range > expectation_.law().settings().max_range_m) return;
    const Eigen::Vector3d direction = way / range;
    if (place.normal.dot(direction) > 0) place.normal *= -1;  // the side that is turned to the path
    const double cosine = -place.normal.dot(direction);
    const double density = pulses_.along(here.pose.rotation.conjugate() * direction);
    // What a ray would tell is known already.
    const bool slants = cosine < least_cosine_, unseen = density <= 0;
    if ((slants && misses.grazing) || (unseen && (misses.out_of_view || misses.grazing || sight.passes > 0))) return;
    const auto expected = expectation_.from(here.pose.translation, place);
    if (expected.fate == ReturnFate::hidden)
      misses.hidden = true;
    else if (expected.fate != ReturnFate::returned)
      misses.weak = true;
    else if (unseen)
      misses.out_of_view = true;
    else if (slants)
      misses.grazing = true;
    else if (passing_ != nullptr &&
             passing_->hide(here.pose.translation, place.position, sample.product, first_s_ + here.after_s))
      misses.passed_per_m2 += density * here.lasts_s * cosine / (range * range);
    else
      addPoints(sight, expected, density * here.lasts_s * cosine / (range * range), here.after_s, wanted_);
  }

  const Expectation& expectation_;
  const PulseDensity& pulses_;
  const CoveredWhen& wanted_;
  const PassingBodies* passing_;
  double first_s_;
  double least_cosine_ = std::cos(wanted_.max_incidence_rad);
};

// All at once; where things move one by one, so that a thread asks where they are at one time, and not to and fro.
std::vector<std::span<const TimedPlace>> stretchesOf(const std::vector<TimedPlace>& along, bool things_move) {
  std::vector<std::span<const TimedPlace>> stretches;
  const std::size_t step = things_move ? 1 : along.size();
  for (std::size_t begin = 0; begin < along.size(); begin += step) stretches.emplace_back(&along[begin], step);
  return stretches;
}

}  // namespace

const char* nameOf(Blindness blind) {
  static constexpr std::array<const char*, kBlindnesses> kNames = {
      "covered", "hidden by a mover", "sparse", "grazing", "out of view", "out of range", "occluded", "unreachable"};
  return kNames[static_cast<std::size_t>(blind)];
}

PulseDensity::PulseDensity(const MovingHead& head, const ScanSettings& settings)
    : bins_(static_cast<std::size_t>(kRows) * kColumns) {
  constexpr double kSeconds = 20, kMostPulses = 4e6;
  const ScanPattern pattern(head, settings);
  const auto firings = static_cast<std::uint64_t>(kSeconds / pattern.firing_s());
  const double pulses = static_cast<double>(firings) * pattern.channels();
  const auto step = static_cast<std::uint64_t>(std::ceil(pulses / kMostPulses));
  for (std::uint64_t f = 0; f < firings; f += step)
    for (std::uint32_t c = 0; c < pattern.channels(); ++c) {
      const Pulse pulse = pattern.pulse(f, c);
      if (pulse.measured) bins_[binOf(pulse.direction)] += static_cast<double>(step) / kSeconds;
    }
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column)
      bins_[static_cast<std::size_t>(row * kColumns + column)] /= solidAngle(row);
}

double PulseDensity::along(const Eigen::Vector3d& direction_device) const { return bins_[binOf(direction_device)]; }

Result<std::vector<SampleSight>> predictSights(const CarriedMotion& carried, const Expectation& expectation,
                                               const PulseDensity& pulses, const SurfaceSamples& samples,
                                               const CoveredWhen& wanted, Progress& progress,
                                               const PassingBodies* passing) {
  const std::size_t batch = passing == nullptr ? 512 : 8192;  // of rays a like number
  const auto along = placesAlong(carried);
  const Prediction prediction(expectation, pulses, wanted, passing, carried.path->first_s());
  std::vector<SampleSight> sights(samples.samples.size());
  std::vector<Misses> misses(sights.size());
  const auto stretches = stretchesOf(along, passing != nullptr);
  for (std::size_t s = 0; s < stretches.size(); ++s)
    for (std::size_t begin = 0; begin < sights.size(); begin += batch) {
      TRY(progress.check());
      progress.advance((static_cast<double>(s) + static_cast<double>(begin) / static_cast<double>(sights.size())) /
                       static_cast<double>(stretches.size()));
      tbb::parallel_for(begin, std::min(begin + batch, sights.size()), [&](std::size_t k) {  // each into its own slot
        if (samples.samples[k].exposed) prediction.see(samples.samples[k], stretches[s], sights[k], misses[k]);
      });
    }
  for (std::size_t k = 0; k < sights.size(); ++k)
    if (samples.samples[k].exposed) sights[k].blind = reasonOf(sights[k], misses[k], wanted);
  return sights;
}

SightSink::SightSink(const SampleCells& cells, double radius_m, const SurfaceSamples& samples,
                     const CarriedMotion& carried, const Eigen::Vector3d& shift_m, const CoveredWhen& wanted)
    : cells_(cells),
      radius_m_(radius_m),
      samples_(samples),
      carried_(carried),
      shift_m_(shift_m),
      wanted_(wanted),
      counts_(samples.samples.size()),
      sights_(samples.samples.size()) {}

Result<void> SightSink::begin(const ScanHeader& header) {
  local_from_points_ = header.file_from_scanner;
  local_from_points_.translation -= shift_m_;
  return {};
}

Result<void> SightSink::write(const PointBlock& block) {
  if (block.time_s.size() != block.size()) {
    had_times_ = false;
    return {};
  }
  const double least_cosine = std::cos(wanted_.max_incidence_rad), first = carried_.path->first_s();
  for (std::size_t i = 0; i < block.size(); ++i) {
    const Eigen::Vector3d point = local_from_points_ * Eigen::Vector3d(block.x_m[i], block.y_m[i], block.z_m[i]);
    const Eigen::Vector3d origin = carried_.truth->pose(first + block.time_s[i]).translation;
    found_.clear();
    cells_.samplesAt(point, origin, found_);
    const Eigen::Vector3d way = point - origin;
    const double range = way.norm();
    for (const std::uint32_t k : found_) {
      const double cosine = std::abs(samples_.samples[k].place.normal.dot(way)) / std::max(range, 1e-9);
      if (cosine < least_cosine) continue;
      ExpectedReturn met;
      met.range_m = range, met.incidence_rad = std::acos(std::min(1.0, cosine));
      addPoints(sights_[k], met, 0, block.time_s[i], wanted_);
      ++counts_[k];
    }
  }
  return {};
}

std::vector<SampleSight> SightSink::sights(const std::vector<SampleSight>& predicted) const {
  std::vector<SampleSight> measured = sights_;
  for (std::size_t k = 0; k < measured.size(); ++k) {
    auto& sight = measured[k];
    sight.density_per_m2 = static_cast<double>(counts_[k]) / (kPi * radius_m_ * radius_m_);
    if (sight.density_per_m2 >= wanted_.density_per_m2)
      sight.blind = Blindness::covered;
    else if (predicted[k].blind == Blindness::passed_by)
      sight.blind = Blindness::passed_by;
    else if (counts_[k] > 0 || predicted[k].blind <= Blindness::sparse)
      sight.blind = Blindness::sparse;
    else
      sight.blind = predicted[k].blind;
  }
  return measured;
}

std::vector<Eigen::Vector3d> walkablePlaces(const RayScene& scene, const Mesh* walkable, double height_m) {
  constexpr double kGrid_m = 1;
  std::optional<WalkableMap> map;
  if (walkable != nullptr && !walkable->triangles.empty()) map.emplace(*walkable);
  Bounds all;
  for (const auto& box : productBounds(scene.environment()))
    if (!box.empty()) all.extend(box);
  std::vector<Eigen::Vector3d> places;
  if (all.empty()) return places;
  for (double x = std::ceil(all.min.x()); x < all.max.x(); x += kGrid_m)
    for (double y = std::ceil(all.min.y()); y < all.max.y(); y += kGrid_m)
      for (const double floor : floorsAt(scene, x, y, height_m))
        if (!map || map->under({x, y, floor})) places.emplace_back(x, y, floor + height_m);
  return places;
}

Result<void> findUnreachable(std::vector<SampleSight>& sights, const SurfaceSamples& samples, const RayScene& scene,
                             std::span<const Eigen::Vector3d> places, double max_range_m, const CoveredWhen& wanted,
                             Progress& progress) {
  constexpr std::size_t kBatch = 512;
  const SightLimits limits{max_range_m, std::cos(wanted.max_incidence_rad), -kPi / 2, kPi / 2};
  for (std::size_t begin = 0; begin < sights.size(); begin += kBatch) {
    TRY(progress.check());
    tbb::parallel_for(begin, std::min(begin + kBatch, sights.size()), [&](std::size_t k) {  // each into its own slot
      auto& blind = sights[k].blind;
      if (!samples.samples[k].exposed || (blind != Blindness::occluded && blind != Blindness::out_of_range)) return;
      const auto sees = [&](const Eigen::Vector3d& eye) {
        return inSight(scene, eye, samples.samples[k].place, limits);
      };
      if (std::none_of(places.begin(), places.end(), sees)) blind = Blindness::unreachable;
    });
  }
  return {};
}

std::vector<SampleSight> together(std::span<const std::vector<SampleSight>* const> paths, const CoveredWhen& wanted) {
  std::vector<SampleSight> all = paths.empty() ? std::vector<SampleSight>() : *paths.front();
  for (std::size_t i = 1; i < paths.size(); ++i)
    for (std::size_t k = 0; k < all.size(); ++k) {
      SampleSight& sum = all[k];
      const SampleSight& other = (*paths[i])[k];
      if (other.passes > 0 && sum.passes > 0) {
        sum.range_m = std::min(sum.range_m, other.range_m);
        sum.incidence_rad = std::min(sum.incidence_rad, other.incidence_rad);
      } else if (other.passes > 0) {
        sum.range_m = other.range_m, sum.incidence_rad = other.incidence_rad;
      }
      sum.density_per_m2 += other.density_per_m2;
      sum.passes += other.passes;
      sum.blind = sum.density_per_m2 >= wanted.density_per_m2 ? Blindness::covered : std::min(sum.blind, other.blind);
    }
  return all;
}

}  // namespace standpoint
