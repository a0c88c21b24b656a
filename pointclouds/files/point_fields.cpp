// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/files/point_fields.h"

#include <bit>
#include <cmath>
#include <limits>

#include "pointclouds/files/block_check.h"

namespace standpoint {
namespace {

using F = PointField;

// Written so that a NaN becomes 0.
std::uint8_t colourByte(double value) {
  return value > 0 ? static_cast<std::uint8_t>(std::min(value, 255.0) + 0.5) : 0;
}

}  // namespace

bool FieldPlaces::all(F first, F last) const {
  for (auto f = static_cast<std::size_t>(first); f <= static_cast<std::size_t>(last); ++f)
    if (!at[f]) return false;
  return true;
}

FieldTaker::FieldTaker(const FieldPlaces& places, ScanHeader& scan, bool placed)
    : places_(places),
      placed_(placed),
      colour_(scan.has_colour = places_.all(F::red, F::blue) || places_[F::packed_colour]),
      labels_(scan.has_labels = places_.all(F::label, F::product) && !scan.products.empty() && !scan.materials.empty()),
      grid_(hasGrid(scan) && places_.all(F::row, F::column)),
      time_(scan.has_time = places_[F::time].has_value()),
      channel_(scan.has_channel = places_[F::channel].has_value()),
      returns_(scan.has_returns = places_.all(F::return_number, F::return_count)),
      truth_(scan.has_truth = places_.all(F::true_x, F::flags)),
      products_(static_cast<double>(scan.products.size())),
      materials_(static_cast<double>(scan.materials.size())),
      pose_(scan.file_from_scanner),
      back_(scan.file_from_scanner.rotation.conjugate()) {
  if (!grid_) scan.rows = scan.columns = 0;
  rows_ = scan.rows, columns_ = scan.columns;
}

bool FieldTaker::isRead(std::size_t number) const {
  for (std::size_t f = 0; f < kPointFields; ++f) {
    if (places_.at[f] != number) continue;
    const auto field = static_cast<F>(f);
    if (field <= F::intensity || field == F::time || field == F::channel) return true;
    if (field <= F::packed_colour) return colour_;
    if (field <= F::product) return labels_;
    if (field <= F::column) return grid_;
    return field <= F::return_count ? returns_ : truth_;
  }
  return false;
}

Eigen::Vector3d FieldTaker::place(const std::vector<double>& numbers, F first) const {
  const auto f = static_cast<std::size_t>(first);
  const Eigen::Vector3d p(numbers[*places_.at[f]], numbers[*places_.at[f + 1]], numbers[*places_.at[f + 2]]);
  return placed_ ? Eigen::Vector3d(back_ * (p - pose_.translation)) : p;
}

void FieldTaker::takeColour(const std::vector<double>& numbers, PointBlock& block) {
  std::vector<std::uint8_t>* const colours[3] = {&block.red, &block.green, &block.blue};
  if (places_[F::packed_colour]) {
    const double value = number(numbers, F::packed_colour);
    const auto packed = value >= 0 && value <= 0xFFFFFFFFp0 ? static_cast<std::uint32_t>(value) : 0;
    for (int k = 0; k < 3; ++k) colours[k]->push_back(static_cast<std::uint8_t>(packed >> (16 - 8 * k)));
    return;
  }
  for (std::size_t k = 0; k < 3; ++k)
    colours[k]->push_back(
        colourByte(numbers[*places_.at[static_cast<std::size_t>(F::red) + k]] * places_.colour_scale[k]));
}

void FieldTaker::takeReturn(const std::vector<double>& numbers, PointBlock& block) {
  const double of_pulse = number(numbers, F::return_number), count = number(numbers, F::return_count);
  const bool sensible = of_pulse >= 1 && of_pulse <= count && count <= 255;
  senseless_returns_ += !sensible;
  block.return_number.push_back(sensible ? static_cast<std::uint8_t>(of_pulse) : 1);
  block.return_count.push_back(sensible ? static_cast<std::uint8_t>(count) : 1);
}

void FieldTaker::takeTruth(const std::vector<double>& numbers, FoundPoints& to) {
  const auto sensible = [&](double v, double least, double most) {
    const bool good = v >= least && v <= most;
    senseless_values_ += !good;
    return good ? v : 0.0;
  };
  constexpr double kMost = std::numeric_limits<float>::max();
  const Eigen::Vector3d p = place(numbers, F::true_x);
  to.true_x.push_back(sensible(p.x(), -kMost, kMost)), to.true_y.push_back(sensible(p.y(), -kMost, kMost));
  to.true_z.push_back(sensible(p.z(), -kMost, kMost));
  const auto real = [&](F field) { return static_cast<float>(sensible(number(numbers, field), -kMost, kMost)); };
  PointTruth& truth = to.columns.truth;
  truth.range_m.push_back(real(F::true_range));
  truth.incidence_rad.push_back(real(F::incidence));
  truth.received_db.push_back(real(F::received_power));
  truth.flags.push_back(static_cast<std::uint8_t>(sensible(number(numbers, F::flags), 0, 255)));
}

Result<void> FieldTaker::takeIndices(const std::vector<double>& numbers, PointBlock& block) const {
  const double row = grid_ ? number(numbers, F::row) : 0, column = grid_ ? number(numbers, F::column) : 0;
  if (grid_ && !(row >= 0 && row < rows_ && column >= 0 && column < columns_))
    return failure(ErrorKind::unusable, "a point's row or column is outside the grid");
  block.row.push_back(static_cast<std::uint32_t>(row));
  block.column.push_back(static_cast<std::uint32_t>(column));
  if (!labels_) return {};
  const double product = number(numbers, F::product), material = number(numbers, F::label);
  if (!(product >= 0 && product < products_ && material >= 0 && material < materials_))
    return failure(ErrorKind::unusable, "a point's label is outside the label table");
  block.product.push_back(static_cast<std::uint32_t>(product));
  block.material.push_back(static_cast<std::uint32_t>(material));
  return {};
}

Result<void> FieldTaker::take(const std::vector<double>& numbers, FoundPoints& to) {
  const Eigen::Vector3d p = place(numbers, F::x);
  to.x.push_back(p.x()), to.y.push_back(p.y()), to.z.push_back(p.z());
  PointBlock& block = to.columns;
  block.intensity.push_back(places_[F::intensity] ? static_cast<float>(number(numbers, F::intensity)) : 0.0F);
  if (colour_) takeColour(numbers, block);
  if (time_) {
    const double time = number(numbers, F::time);
    senseless_values_ += !std::isfinite(time);
    block.time_s.push_back(std::isfinite(time) ? time : 0);
  }
  if (channel_) {
    const double channel = number(numbers, F::channel);
    const bool sensible = channel >= 0 && channel <= 255;
    senseless_values_ += !sensible;
    block.channel.push_back(sensible ? static_cast<std::uint8_t>(channel) : 0);
  }
  if (returns_) takeReturn(numbers, block);
  if (truth_) takeTruth(numbers, to);
  return takeIndices(numbers, block);
}

void FieldTaker::list(const std::string& source, Report& report) const {
  if (senseless_returns_ > 0)
    report.warn(source, std::to_string(senseless_returns_) + " invalid return numbers were set to 1 of 1");
  if (senseless_values_ > 0)
    report.lose(source, std::to_string(senseless_values_) + " invalid times, channels or true values were set to 0");
}

}  // namespace standpoint
