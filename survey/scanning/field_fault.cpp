// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/scanning/field_fault.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "core/units.h"

namespace standpoint {

namespace {

constexpr double kTripodMove_m = 0.004, kTripodMove_rad = 0.05 * kRadPerDeg;
constexpr double kPasserBy_m = 2;

// Passes points on, with their truth moved by `to_from`.
class TruthMoved final : public PointSink {
 public:
  TruthMoved(PointSink& sink, const Pose& to_from) : sink_(sink), to_from_(to_from) {}
  Result<void> begin(const ScanHeader& header) override { return sink_.begin(header); }
  Result<void> write(const PointBlock& block) override {
    if (block.truth.flags.empty()) return sink_.write(block);
    PointBlock moved = block;
    auto& t = moved.truth;
    for (std::size_t i = 0; i < t.x_m.size(); ++i) {
      const Eigen::Vector3d p = to_from_ * Eigen::Vector3d(t.x_m[i], t.y_m[i], t.z_m[i]);
      t.x_m[i] = static_cast<float>(p.x());
      t.y_m[i] = static_cast<float>(p.y());
      t.z_m[i] = static_cast<float>(p.z());
    }
    return sink_.write(moved);
  }
  Result<void> end() override { return sink_.end(); }
  Result<void> close() override { return sink_.close(); }

 private:
  PointSink& sink_;
  Pose to_from_;
};

// Puts a person in front of what lies behind, over the directions that a body covers.
class Person final : public PointSink {
 public:
  struct Place {
    double away_m = 0, azimuth_rad = 0;                         // azimuths go clockwise
    std::uint32_t from_column = 0, until_column = 0xFFFFFFFFU;  // while the laser measures these
  };
  struct Label {
    std::uint32_t product = 0, material = 0;
  };
  Person(PointSink& sink, const Place& place, const Label& label)
      : sink_(sink),
        away_m_(place.away_m),
        towards_(std::cos(place.azimuth_rad), -std::sin(place.azimuth_rad)),
        place_(place),
        label_(label) {}
  Result<void> begin(const ScanHeader& header) override { return sink_.begin(header); }
  Result<void> write(const PointBlock& block) override {
    PointBlock crossed = block;
    auto& t = crossed.truth;
    for (std::size_t i = 0; i < crossed.size(); ++i) {
      if (crossed.column[i] < place_.from_column || crossed.column[i] >= place_.until_column) continue;
      const Eigen::Vector2d flat(crossed.x_m[i], crossed.y_m[i]);
      const double away = flat.norm();
      if (away <= away_m_) continue;
      // Where the direction meets the cylinder.
      const double along = flat.dot(towards_) / away, across = std::sqrt(std::max(0.0, 1 - along * along)) * away_m_;
      if (along <= 0 || across > kHalfWidth_m) continue;
      const double scale = (away_m_ * along - std::sqrt(kHalfWidth_m * kHalfWidth_m - across * across)) / away;
      const double z = crossed.z_m[i] * scale;
      if (z < -kEyeHeight_m || z > kTall_m - kEyeHeight_m) continue;
      for (auto* axis : {&crossed.x_m, &crossed.y_m, &crossed.z_m}) (*axis)[i] = static_cast<float>((*axis)[i] * scale);
      if (!crossed.product.empty()) crossed.product[i] = label_.product, crossed.material[i] = label_.material;
      if (t.flags.empty()) continue;
      t.x_m[i] = crossed.x_m[i], t.y_m[i] = crossed.y_m[i], t.z_m[i] = crossed.z_m[i];
      t.range_m[i] = static_cast<float>(t.range_m[i] * scale);
      t.flags[i] |= point_flag::kMoving;
    }
    return sink_.write(crossed);
  }
  Result<void> end() override { return sink_.end(); }
  Result<void> close() override { return sink_.close(); }

 private:
  static constexpr double kHalfWidth_m = 0.25, kTall_m = 1.75, kEyeHeight_m = 1.6;
  PointSink& sink_;
  double away_m_;
  Eigen::Vector2d towards_;
  Place place_;
  Label label_;
};

std::uint32_t columnAt(double fraction, std::uint32_t columns) {
  return static_cast<std::uint32_t>(std::clamp(std::llround(fraction * columns), 0LL, static_cast<long long>(columns)));
}

}  // namespace

Result<FieldFault> fieldFaultFrom(const std::vector<std::string>& pairs) {
  FieldFault field_fault;
  for (const auto& pair : pairs) {
    const auto equals = std::min(pair.find('='), pair.size());
    const auto key = pair.substr(0, equals);
    const auto text = equals < pair.size() ? pair.substr(equals + 1) : std::string();
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool number = error == std::errc() && end == text.data() + text.size();
    const bool fraction = number && value >= 0 && value <= 1;
    if (key == "until" && fraction)
      field_fault.until_fraction = value;
    else if (key == "tripod_moved" && fraction)
      field_fault.tripod_moved_at_fraction = value;
    else if (key == "passer_by" && fraction)
      field_fault.passer_by_at_fraction = value;
    else if (key == "operator_in_view" && fraction)
      field_fault.operator_at_fraction = value;
    else if (key == "operator_from" && fraction)
      field_fault.operator_from_fraction = value;
    else if (key == "operator_until" && fraction)
      field_fault.operator_until_fraction = value;
    else if (key == "operator_distance" && number && value >= FieldFault::kNearest_m &&
             value <= FieldFault::kFarthest_m)
      field_fault.operator_m = value;
    else if (key == "noise" && number && value >= 1 && value <= 100)
      field_fault.noise_factor = value;
    else
      return failure(ErrorKind::usage,
                     fmt::format("invalid field fault '{}': use until=FRACTION, tripod_moved=FRACTION, "
                                 "passer_by=FRACTION, operator_in_view=FRACTION, operator_from=FRACTION, "
                                 "operator_until=FRACTION (0 to 1), operator_distance=METRES ({:g} to {:g}) or "
                                 "noise=FACTOR (1 to 100)",
                                 pair, FieldFault::kNearest_m, FieldFault::kFarthest_m));
  }
  return field_fault;
}

std::vector<std::string> pairsOf(const FieldFault& fault) {
  std::vector<std::string> pairs;
  const auto say = [&](const char* key, double value) { pairs.push_back(fmt::format("{}={}", key, value)); };
  if (fault.until_fraction < 1) say("until", fault.until_fraction);
  if (fault.noise_factor != 1) say("noise", fault.noise_factor);
  if (fault.tripod_moved_at_fraction) say("tripod_moved", *fault.tripod_moved_at_fraction);
  if (fault.passer_by_at_fraction) say("passer_by", *fault.passer_by_at_fraction);
  if (!fault.operator_at_fraction) return pairs;
  say("operator_in_view", *fault.operator_at_fraction);
  if (fault.operator_m != FieldFault::kOperator_m) say("operator_distance", fault.operator_m);
  if (fault.operator_from_fraction > 0) say("operator_from", fault.operator_from_fraction);
  if (fault.operator_until_fraction < 1) say("operator_until", fault.operator_until_fraction);
  return pairs;
}

LabelledProduct personLabel() { return {"", "", "Person", "a person in the field"}; }

Pose tripodMoved(const Pose& pose) {
  Pose moved = pose;
  moved.translation += pose.rotation * Eigen::Vector3d(kTripodMove_m, 0, 0);
  moved.rotation = pose.rotation * Eigen::AngleAxisd(kTripodMove_rad, Eigen::Vector3d::UnitZ());
  return moved;
}

Result<ScanCount> scanWithFieldFault(const RayScene& scene, const MaterialAssignment& assignment,
                                     const Instrument& instrument, const ScanSettings& settings, const Pose& pose,
                                     const ScanOptions& options, const FieldFault& field_fault, PointSink& sink,
                                     Progress& progress) {
  const auto azimuth = [&](double fraction) {
    return std::lerp(settings.azimuth_from_rad, settings.azimuth_to_rad, fraction);
  };
  const Person::Label person{static_cast<std::uint32_t>(scene.environment().products.size() + 1),
                             static_cast<std::uint32_t>(assignment.materials.size())};
  if (field_fault.operator_at_fraction) {
    FieldFault others = field_fault;
    others.operator_at_fraction.reset();
    const Person::Place place{field_fault.operator_m, azimuth(*field_fault.operator_at_fraction),
                              columnAt(field_fault.operator_from_fraction, settings.columns),
                              columnAt(field_fault.operator_until_fraction, settings.columns)};
    Person beside(sink, place, person);
    return scanWithFieldFault(scene, assignment, instrument, settings, pose, options, others, beside, progress);
  }
  if (field_fault.passer_by_at_fraction) {
    FieldFault others = field_fault;
    others.passer_by_at_fraction.reset();
    if (settings.passes > 1)
      return scanWithFieldFault(scene, assignment, instrument, settings, pose, options, others, sink, progress);
    Person passer_by(sink, {kPasserBy_m, azimuth(*field_fault.passer_by_at_fraction)}, person);
    return scanWithFieldFault(scene, assignment, instrument, settings, pose, options, others, passer_by, progress);
  }
  if (!field_fault.any()) return scan(scene, assignment, instrument, settings, pose, options, sink, progress);
  ScanSettings noisier = settings;
  noisier.noise_factor *= field_fault.noise_factor;
  ScanOptions part = options;
  part.end_column = std::min(options.end_column, columnAt(field_fault.until_fraction, settings.columns));
  if (!field_fault.tripod_moved_at_fraction)
    return scan(scene, assignment, instrument, noisier, pose, part, sink, progress);
  const auto push =
      std::clamp(columnAt(*field_fault.tripod_moved_at_fraction, settings.columns), part.first_column, part.end_column);
  ScanOptions after = part;
  part.end_column = after.first_column = push;
  ScanCount count;
  const Pose moved = tripodMoved(pose);
  const Pose before_after{pose.rotation.conjugate() * moved.rotation,
                          pose.rotation.conjugate() * (moved.translation - pose.translation)};
  TruthMoved truth(sink, before_after);
  for (const bool late : {false, true}) {
    const auto& options_of_part = late ? after : part;
    if (options_of_part.first_column >= options_of_part.end_column) continue;
    const auto some = scan(scene, assignment, instrument, noisier, late ? moved : pose, options_of_part,
                           late ? static_cast<PointSink&>(truth) : sink, progress);
    if (!some) return some;
    count.pulses += some->pulses;
    count.returns += some->returns;
    count.points += some->points;
  }
  return count;
}

}  // namespace standpoint
