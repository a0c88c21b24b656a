// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/quality/place_forecast.h"

#include <algorithm>
#include <cmath>

#include "survey/stations/survey_plan.h"

namespace standpoint {

namespace {

constexpr std::size_t kNearby = 4;  // stations whose overlap is asked for
constexpr double kNearby_m = 40;
constexpr double kIntoRoom_m = 0.08;  // from a surface: spaces end a little before the plaster, or in it

double fractile95(std::vector<double>& values) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

bool isThere(const Pose& a, const Pose& b) {
  return a.translation == b.translation && a.rotation.coeffs() == b.rotation.coeffs();
}

std::vector<const Station*> nearbyOf(std::span<const Station* const> stations, const Eigen::Vector3d& place) {
  const auto away = [&](const Station* s) { return (s->true_pose.translation - place).norm(); };
  std::vector<const Station*> nearby;
  for (const auto* station : stations)
    if (away(station) < kNearby_m) nearby.push_back(station);
  std::stable_sort(nearby.begin(), nearby.end(), [&](auto* a, auto* b) { return away(a) < away(b); });
  if (nearby.size() > kNearby) nearby.resize(kNearby);
  return nearby;
}

}  // namespace

PlaceForecaster::PlaceForecaster(std::shared_ptr<const Expectation> expectation)
    : expectation_(std::move(expectation)), spaces_(spaceBodies(expectation_->scene().environment())) {}

Result<std::unique_ptr<PlaceForecaster>> PlaceForecaster::make(std::shared_ptr<const Expectation> expectation,
                                                               Progress& progress) {
  std::unique_ptr<PlaceForecaster> made(new PlaceForecaster(std::move(expectation)));
  TRY_ASSIGN(made->samples_,
             sampleSurfaces(made->expectation_->scene(), PlanRequest().samples, PlanRequest().seed, progress));
  return made;
}

const std::vector<std::uint8_t>& PlaceForecaster::seenFrom(const Station& station) {
  auto& kept = kept_[station.name];
  if (kept.seen.empty() || !isThere(kept.pose, station.true_pose))
    kept = {station.true_pose, seenSamples(*expectation_, station.true_pose, samples_, {})};
  return kept.seen;
}

const std::vector<std::uint8_t>& PlaceForecaster::inRoom(std::uint32_t product) {
  auto& in = room_samples_[product];
  if (!in.empty()) return in;
  in.assign(samples_.samples.size(), 0);
  for (const auto& space : spaces_) {
    if (space.product != product) continue;
    for (std::size_t k = 0; k < in.size(); ++k) {
      const auto& place = samples_.samples[k].place;
      const Eigen::Vector3d step = kIntoRoom_m * place.normal;
      if (samples_.samples[k].exposed &&
          (space.contains(place.position + step) || space.contains(place.position - step)))
        in[k] = 1;
    }
  }
  return in;
}

const std::vector<std::uint8_t>& PlaceForecaster::inStorey(const std::string& storey) {
  auto& in = storey_samples_[storey];
  if (!in.empty()) return in;
  const auto& products = expectation_->scene().environment().products;
  for (const auto& sample : samples_.samples)
    in.push_back(static_cast<std::uint8_t>(sample.exposed && products[sample.product].storey == storey));
  return in;
}

// As the assessment of scans does it, with the laws in place of points.
void PlaceForecaster::measure(PlaceForecast& forecast, const Pose& place, const std::vector<std::uint8_t>& seen) {
  const auto* near = forecast.room              ? &inRoom(*forecast.room)
                     : !forecast.storey.empty() ? &inStorey(forecast.storey)
                                                : nullptr;
  std::size_t exposed = 0;
  std::vector<double> spacings, incidences;
  for (std::size_t k = 0; k < seen.size(); ++k) {
    if (near != nullptr && (*near)[k] == 0) continue;
    exposed += static_cast<std::size_t>(samples_.samples[k].exposed);
    if (seen[k] == 0) continue;
    const auto& sample = samples_.samples[k].place;
    const Eigen::Vector3d way = sample.position - place.translation;
    const double range = way.norm();
    const double incidence = std::acos(std::clamp(std::abs(sample.normal.dot(way)) / range, 0.0, 1.0));
    incidences.push_back(incidence);
    spacings.push_back(spacingAt(expectation_->law().settings(), place, sample));
  }
  if (near != nullptr && exposed > 0)
    forecast.near_seen = static_cast<double>(spacings.size()) / static_cast<double>(exposed);
  if (spacings.empty()) return;
  forecast.spacing_m = fractile95(spacings);
  forecast.incidence_rad = fractile95(incidences);
}

const PlaceForecast::Overlap* PlaceForecast::largestOverlap() const {
  const auto largest = std::max_element(overlaps.begin(), overlaps.end(),
                                        [](const auto& a, const auto& b) { return a.fraction < b.fraction; });
  return largest == overlaps.end() ? nullptr : &*largest;
}

PlaceForecast PlaceForecaster::at(const Pose& place, std::span<const Station* const> others) {
  PlaceForecast forecast;
  forecast.others = others.size();
  if (samples_.samples.empty()) return forecast;
  forecast.room = spaceAt(spaces_, place.translation);
  const auto& scene = expectation_->scene();
  if (const auto below = scene.intersect(place.translation, -Eigen::Vector3d::UnitZ(), kNearby_m))
    forecast.storey = scene.environment().products[below->product].storey;
  const auto seen = seenSamples(*expectation_, place, samples_, {});
  const auto nearby = nearbyOf(others, place.translation);
  std::vector<const std::vector<std::uint8_t>*> all = {&seen};
  for (const auto* station : nearby) all.push_back(&seenFrom(*station));
  const auto counted = countSeen(samples_, scene.environment(), all);
  if (counted.all.exposed > 0)
    forecast.model_seen = counted.seen_m2.front() / (samples_.each_m2() * static_cast<double>(counted.all.exposed));
  for (const auto& pair : counted.pairs)
    if (pair.a == 0)
      forecast.overlaps.push_back({nearby[pair.b - 1]->name, pair.overlap(),
                                   (nearby[pair.b - 1]->true_pose.translation - place.translation).norm()});
  measure(forecast, place, seen);
  return forecast;
}

}  // namespace standpoint
