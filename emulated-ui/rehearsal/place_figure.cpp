// SPDX-License-Identifier: GPL-3.0-or-later
// What proof_places.h says of a place that is found: in words, in figures, and in another rehearsal.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "emulated-ui/device/replaced.h"
#include "emulated-ui/rehearsal/all_setups.h"
#include "emulated-ui/rehearsal/measured_scan.h"
#include "emulated-ui/rehearsal/proof_places.h"
#include "emulated-ui/sighting.h"
#include "pointclouds/formats.h"

namespace standpoint {

namespace {

constexpr double kOnSurface_m = 0.03;  // half the thickness of what counts as that surface
constexpr double kOnTarget = 1.15;     // of its radius

// Takes those points of several scans that count at a place.
class PlaceMeter final : public PointSink {
 public:
  explicit PlaceMeter(const ProofPlace& place) : place_(place) {}
  void stand(const Pose& local_from_scanner) { pose_ = local_from_scanner; }
  Result<void> begin(const ScanHeader&) override { return {}; }
  Result<void> write(const PointBlock& block) override {
    const bool known = !block.truth.flags.empty();
    for (std::size_t i = 0; i < block.size(); ++i) {
      const Eigen::Vector3d off = pose_ * Eigen::Vector3d(block.x_m[i], block.y_m[i], block.z_m[i]) - place_.centre_m;
      const std::uint8_t flags = known ? block.truth.flags[i] : 0;
      if (place_.kind == ProofKind::stray ? (flags & place_.flags) == 0 : flags != 0 && place_.kind != ProofKind::hole)
        continue;
      if (!counts(off)) continue;
      points_ += 1;
      if (place_.normal) heights_m_.push_back(place_.normal->dot(off));
    }
    return {};
  }
  Result<void> end() override { return {}; }
  Result<void> close() override { return {}; }

  PlaceFigure figure() {
    constexpr std::uint64_t kFewest = 5;
    PlaceFigure figure{points_, std::nullopt};
    if (points_ < kFewest || heights_m_.empty()) return figure;
    if (place_.kind == ProofKind::spacing)
      figure.value_mm =
          std::sqrt(std::numbers::pi * place_.radius_m * place_.radius_m / static_cast<double>(points_)) * 1000;
    if (place_.kind == ProofKind::offset) figure.value_mm = std::abs(median(heights_m_)) * 1000;
    if (place_.kind == ProofKind::scatter) {
      const double middle = median(heights_m_);
      for (double& h : heights_m_) h = std::abs(h - middle);
      figure.value_mm = 1.4826 * median(heights_m_) * 1000;  // a normal σ from the median of the deviations
    }
    return figure;
  }

 private:
  static double median(std::vector<double>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
  }
  bool counts(const Eigen::Vector3d& off) const {
    const bool flat = place_.normal && (place_.kind == ProofKind::spacing || place_.kind == ProofKind::scatter ||
                                        place_.kind == ProofKind::offset || place_.kind == ProofKind::hole);
    if (!flat) return off.norm() <= place_.radius_m * (place_.kind == ProofKind::target ? targetShare() : 1);
    const double height_m = place_.normal->dot(off);
    const double reach_m =
        place_.kind == ProofKind::offset ? std::abs(place_.offset_m) * 1.5 + kOnSurface_m : kOnSurface_m;
    return std::abs(height_m) <= reach_m && (off - height_m * *place_.normal).norm() <= place_.radius_m;
  }
  double targetShare() const { return place_.target_radius_m * kOnTarget / place_.radius_m; }

  const ProofPlace& place_;
  Pose pose_;
  std::uint64_t points_ = 0;
  std::vector<double> heights_m_;
};

std::string word(const Rehearsal& rehearsal, const std::string& key, const std::string& language) {
  return rehearsal.device().type().words->text({}, "marks." + key, language);
}

}  // namespace

std::string placeText(const ProofPlace& place, const Rehearsal& rehearsal, const std::string& language) {
  const double away_m = (place.centre_m - place.seen_from_m).norm();
  const auto away = replaced(replaced(word(rehearsal, "away", language), "{distance}", fmt::format("{:.1f} m", away_m)),
                             "{station}", place.station);
  if (place.station.empty()) return place.what;
  return place.what.empty() ? away : place.what + ", " + away;
}

Result<std::vector<PlacedScan>> scansOf(const ProofPlace& place, const Rehearsal& rehearsal) {
  std::vector<PlacedScan> scans;
  for (const auto* setup : allSetups(rehearsal.device())) {
    if (std::find(place.scans.begin(), place.scans.end(), setup->file) == place.scans.end()) continue;
    TRY_ASSIGN(const auto poses, posesOf(*setup, rehearsal));
    scans.push_back(
        {setup->file, setup->station, place.kind == ProofKind::offset ? poses.delivered : poses.truth, std::nullopt});
    for (const auto& target : setup->targets)
      if (place.kind == ProofKind::target && target.found && target.name == place.what)
        scans.back().on_target = static_cast<std::uint64_t>(target.points);
  }
  return scans;
}

ProofPlace samePlace(const ProofPlace& place, const Rehearsal& other) {
  ProofPlace same = place;
  same.scans.clear();
  const auto take = [&](bool from_there_only) {
    for (const auto* setup : allSetups(other.device()))
      if (!from_there_only || setup->station == place.station) same.scans.push_back(setup->file);
  };
  take(place.one_scan);
  if (place.one_scan && same.scans.size() > 1) same.scans = {same.scans.back()};  // the newest from there
  if (same.scans.empty()) take(false);
  if (place.kind == ProofKind::target && other.document().job)
    for (const auto& target : other.document().job->targets)
      if (target.name == place.what) same.centre_m = target.centre;
  return same;
}

Result<PlaceFigure> figureAt(const ProofPlace& place, const std::vector<PlacedScan>& scans, Progress& progress) {
  PlaceMeter meter(place);
  for (const auto& scan : scans) {
    const auto* format = readableCloudFormat(scan.file);
    if (format == nullptr) return failure(ErrorKind::usage, "unsupported point-cloud format", scan.file);
    meter.stand(scan.local_from_scanner);
    TRY(format->read(scan.file, meter, progress));
  }
  auto figure = meter.figure();
  // What the mark says of the target and what is shown here are one number: the worst of these scans.
  std::optional<std::uint64_t> fewest;
  for (const auto& scan : scans)
    if (scan.on_target) fewest = std::min(fewest.value_or(*scan.on_target), *scan.on_target);
  if (fewest) figure.points = *fewest;
  return figure;
}

std::string figureText(const ProofPlace& place, const PlaceFigure& figure, const Rehearsal& rehearsal,
                       const std::string& language) {
  constexpr const char* kNames[] = {"spacing", "scatter", "offset", "hole", "stray", "target", "hole"};
  const auto name = word(rehearsal, fmt::format("figure.{}", kNames[static_cast<int>(place.kind)]), language);
  const bool in_mm =
      place.kind == ProofKind::spacing || place.kind == ProofKind::scatter || place.kind == ProofKind::offset;
  if (in_mm && !figure.value_mm) return word(rehearsal, "figure.none", language);
  return fmt::format("{}: {}", name,
                     in_mm ? fmt::format("{:.3g} mm", *figure.value_mm) : fmt::format("{}", figure.points));
}

}  // namespace standpoint
