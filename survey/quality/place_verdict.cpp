// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/quality/place_verdict.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/units.h"
#include "survey/stations/storeys.h"

namespace standpoint {

namespace {

constexpr double kEvenEnough_rad = 10 * kRadPerDeg;  // steeper ground holds a tripod, but makes levelling awkward

// What is too near to be measured; "" nothing.
std::string nearness(const StationPlacement& placement, const Eigen::Vector3d& centre, double nearest_m) {
  const auto near = placement.nearest(centre, nearest_m);
  if (!near) return {};
  const auto& product = placement.scene().environment().products[near->product];
  return fmt::format("{:.0f} cm from {}", near->distance_m * 100, plainKind(product));
}

PlaceVerdict refused(const Refusal& refusal) { return {Verdict::bad, refusal.brief, sentenceOf(refusal)}; }

PlaceVerdict doubted(std::string doubt) {
  if (doubt.empty()) return {Verdict::good, "Good place", {}};
  return {Verdict::warn, std::move(doubt), {}};
}

// What speaks against a place that is not refused; "" nothing.
std::string doubtOf(const StationPlacement& placement, const RayHit& hit, double height_m, double nearest_m) {
  const auto& environment = placement.scene().environment();
  const auto& ground = environment.products[hit.product];
  if (!isMadeForStanding(ground)) return "On " + someKind(ground);
  const Eigen::Vector3d centre = hit.position + Eigen::Vector3d(0, 0, height_m);
  if (auto near = nearness(placement, centre, nearest_m); !near.empty()) return near;
  if (const double slope = slopeOf(hit); slope > kEvenEnough_rad)
    return fmt::format("On a slope of {:.0f}°", slope / kRadPerDeg);
  return placement.remark(centre) ? "Inside a closed body" : "";
}

}  // namespace

std::string sentenceOf(const Refusal& refusal) {
  auto text = refusal.reason + "; " + refusal.remedy + ".";
  if (text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

PlaceVerdict judgePlace(const StationPlacement& placement, const RayHit& hit, double height_m, double nearest_m) {
  if (const auto refusal = placement.whyNotOn(hit, height_m)) return refused(*refusal);
  return doubted(doubtOf(placement, hit, height_m, nearest_m));
}

PlaceVerdict judgeStation(const StationPlacement& placement, const Eigen::Vector3d& centre, bool on_tripod,
                          double nearest_m) {
  constexpr double kFar_m = 100;  // a tripod is no higher
  if (on_tripod)
    if (const auto hit = placement.scene().intersect(centre, -Eigen::Vector3d::UnitZ(), kFar_m))
      return judgePlace(placement, *hit, centre.z() - hit->position.z(), nearest_m);
  if (const auto refusal = on_tripod ? placement.whyNot(centre) : placement.tooNear(centre)) return refused(*refusal);
  return doubted(nearness(placement, centre, nearest_m));
}

namespace {

// By the limit of the assessment of that id. A place is bad only where it is refused.
Verdict verdictBy(const char* limit_id, double value) {
  static const auto limits = qualityLimits(QualityProfile::loa30);
  const auto limit =
      std::find_if(limits.begin(), limits.end(), [&](const QualityLimit& l) { return l.id == limit_id; });
  if (limit == limits.end()) return Verdict::unknown;
  return verdictOf(*limit, value) == Verdict::good ? Verdict::good : Verdict::warn;
}

}  // namespace

Verdict overlapVerdict(const PlaceForecast& forecast) {
  if (const auto* largest = forecast.largestOverlap()) return verdictBy("overlap", largest->fraction * 100);
  return forecast.others > 0 ? Verdict::warn : Verdict::unknown;
}

Verdict spacingVerdict(const PlaceForecast& forecast) {
  return forecast.spacing_m ? verdictBy("spacing", *forecast.spacing_m * 1000) : Verdict::unknown;
}

PlaceVerdict withForecast(PlaceVerdict verdict, const PlaceForecast& forecast) {
  if (verdict.verdict != Verdict::good) return verdict;
  constexpr double kApart_m = 0.5;  // two tripods there would stand in each other's way
  if (!forecast.overlaps.empty() && forecast.overlaps.front().distance_m < kApart_m)
    return {
        Verdict::warn,
        fmt::format("{:.0f} cm from {}", forecast.overlaps.front().distance_m * 100, forecast.overlaps.front().station),
        {}};
  if (overlapVerdict(forecast) == Verdict::warn) {
    constexpr double kNone = 0.005;  // 0 % as it would be shown
    const auto* largest = forecast.largestOverlap();
    if (largest == nullptr) return {Verdict::warn, "No other station nearby", {}};
    if (largest->fraction < kNone) return {Verdict::warn, "Overlaps no other station", {}};
    return {Verdict::warn, fmt::format("Overlaps {} by {:.0f} %", largest->station, largest->fraction * 100), {}};
  }
  if (spacingVerdict(forecast) == Verdict::warn)
    return {Verdict::warn, fmt::format("Points {:.0f} mm apart", *forecast.spacing_m * 1000), {}};
  return verdict;
}

}  // namespace standpoint
