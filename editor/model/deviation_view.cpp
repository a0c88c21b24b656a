// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/deviation_view.h"

#include <algorithm>
#include <cmath>

namespace standpoint {

namespace {

void count(const DeviationField& field, DeviationHistogram& histogram) {
  for (const auto& instance : field.of_instance)
    for (std::size_t i = 0; i < instance->distance_m.size(); ++i) {
      std::size_t bin = 0;
      while (instance->distance_m[i] > DeviationHistogram::kLimits_m[bin] && bin + 1 < histogram.area_m2.size()) ++bin;
      histogram.area_m2[bin] += instance->area_m2[i];
    }
}

double largest(const DeviationField& field) {
  double most = 0;
  for (const auto& instance : field.of_instance)
    for (const float d : instance->distance_m)
      if (std::isfinite(d)) most = std::max(most, static_cast<double>(d));
  return most;
}

std::shared_ptr<DeviationField> fieldOf(const std::shared_ptr<const Environment>& from, const Environment& to,
                                        Progress& progress) {
  auto distances = vertexDeviation(sceneOf(*from), to, progress);
  if (!distances) return nullptr;
  auto field = std::make_shared<DeviationField>(DeviationField{from, {}, 0});
  auto next = distances->begin();
  for (const auto& instance : from->instances)
    field->of_instance.push_back(
        from->products[instance.product].inScene() ? *next++ : std::make_shared<const InstanceDeviation>());
  return field;
}

std::shared_ptr<const Comparison> compare(const std::shared_ptr<const Environment>& original,
                                          const std::shared_ptr<const Environment>& lighter, double limit_m,
                                          Progress& progress) {
  const auto lost = fieldOf(original, sceneOf(*lighter), progress),
             off = lost ? fieldOf(lighter, sceneOf(*original), progress) : nullptr;
  if (!off) return nullptr;
  const double most = std::max(largest(*lost), largest(*off));
  lost->full_scale_m = off->full_scale_m = std::max(1e-4, std::min(most, limit_m));
  auto result = std::make_shared<Comparison>();
  count(*lost, result->histogram);
  count(*off, result->histogram);
  result->original = lost;
  result->lighter = off;
  return result;
}

}  // namespace

std::array<std::uint8_t, 4> deviationColour(double distance_m, double full_scale_m) {
  static constexpr std::array<std::array<double, 3>, 5> kStops = {
      {{178, 186, 196}, {250, 222, 120}, {246, 148, 66}, {212, 58, 46}, {118, 8, 40}}};
  const double at =
      (std::isfinite(distance_m) ? std::clamp(distance_m / full_scale_m, 0.0, 1.0) : 1.0) * (kStops.size() - 1);
  const auto stop = std::min(static_cast<std::size_t>(at), kStops.size() - 2);
  std::array<std::uint8_t, 4> colour = {0, 0, 0, 255};
  for (std::size_t k = 0; k < 3; ++k)
    colour[k] = static_cast<std::uint8_t>(
        std::lround(std::lerp(kStops[stop][k], kStops[stop + 1][k], at - static_cast<double>(stop))));
  return colour;
}

void DeviationView::follow(const Document& document, const std::function<void()>& wake) {
  const auto lighter = document.simplified ? document.simplified->environment : nullptr;
  if (document.imported == original_ && lighter == lighter_) return;
  task_.reset();
  original_ = document.imported;
  lighter_ = lighter;
  if (!original_ || !lighter_) return;
  const double limit_m = document.simplified->request.lod_rules.empty() ? document.simplified->request.max_deviation_m
                                                                        : document.simplified->all.max_deviation_m;
  using Compared = std::shared_ptr<const Comparison>;
  task_ = std::make_unique<Task<Compared>>(
      "Compare with the original",
      [original = original_, lighter, limit_m](Progress& progress) -> Result<Compared> {
        return compare(original, lighter, limit_m, progress);
      },
      wake);
}

std::shared_ptr<const Comparison> DeviationView::of(const Document& document) const {
  if (!task_ || !task_->done() || !document.simplified || document.imported != original_ ||
      document.simplified->environment != lighter_)
    return nullptr;
  return task_->result().value_or(nullptr);
}

}  // namespace standpoint
