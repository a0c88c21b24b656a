// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/e57/e57_columns.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace standpoint::e57 {
namespace {

template <class T>
void convert(const std::vector<double>& from, double shift, std::vector<T>& to) {
  to.resize(from.size());
  for (std::size_t i = 0; i < from.size(); ++i) to[i] = static_cast<T>(from[i] - shift);
}

}  // namespace

std::uint64_t ColumnTaker::blank(Columns& from, const Place& marks, std::span<const Place> places) const {
  if (!marks) return 0;
  std::uint64_t marked = 0;
  for (std::size_t i = 0; i < from[*marks].size(); ++i) {
    if (from[*marks][i] == 0) continue;
    ++marked;
    for (const Place& place : places) from[*place][i] = 0;
  }
  return marked;
}

void ColumnTaker::dropInvalid(Columns& from, std::size_t& records) {
  const Place& state = roles_.spherical ? roles_.spherical_state : roles_.cartesian_state;
  dropped_.assign(records, 0);
  std::uint64_t invalid = 0, outside = 0;
  if (state)
    for (std::size_t i = 0; i < records; ++i) invalid += dropped_[i] = from[*state][i] != 0;
  if (roles_.row)
    for (std::size_t i = 0; i < records; ++i) {
      const double row = from[*roles_.row][i] - plan_.first_row, column = from[*roles_.column][i] - plan_.first_column;
      const bool inside = row >= 0 && row < plan_.header.rows && column >= 0 && column < plan_.header.columns;
      outside += !inside && !dropped_[i];
      dropped_[i] |= !inside;
    }
  tally_.invalid += invalid;
  tally_.outside_grid += outside;
  if (invalid + outside == 0) return;
  roles_.forEach([&](std::size_t place) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < records; ++i)
      if (!dropped_[i]) from[place][kept++] = from[place][i];
    from[place].resize(kept);
  });
  records -= invalid + outside;
}

void ColumnTaker::takePlaces(Columns& from, FoundPoints& to) const {
  to.x.swap(from[*roles_.x]), to.y.swap(from[*roles_.y]), to.z.swap(from[*roles_.z]);
  if (!roles_.spherical) return;
  for (std::size_t i = 0; i < to.x.size(); ++i) {
    const double range = to.x[i], azimuth = to.y[i], elevation = to.z[i];
    to.x[i] = range * std::cos(elevation) * std::cos(azimuth);
    to.y[i] = range * std::cos(elevation) * std::sin(azimuth);
    to.z[i] = range * std::sin(elevation);
  }
}

void ColumnTaker::takeColours(Columns& from, PointBlock& to) {
  tally_.no_colour += blank(from, roles_.colour_invalid, {});
  std::vector<std::uint8_t>* const colours[3] = {&to.red, &to.green, &to.blue};
  for (int k = 0; k < 3; ++k) {
    const std::vector<double>& column = from[*roles_.colour[k]];
    const double least = plan_.colour_least[k], most = plan_.colour_most[k];
    if (least == 0 && most == 255) {
      colours[k]->resize(column.size());
      // Written so that a NaN becomes 0.
      for (std::size_t i = 0; i < column.size(); ++i)
        (*colours[k])[i] =
            column[i] > 0 ? static_cast<std::uint8_t>(static_cast<int>(std::min(column[i], 255.0) + 0.5)) : 0;
    } else {
      colours[k]->clear();
      for (const double value : column) {
        const double fraction = (value - least) / (most - least);
        colours[k]->push_back(fraction > 0 ? static_cast<std::uint8_t>(std::lround(std::min(fraction, 1.0) * 255)) : 0);
      }
    }
    if (roles_.colour_invalid)
      for (std::size_t i = 0; i < column.size(); ++i)
        if (from[*roles_.colour_invalid][i] != 0) (*colours[k])[i] = 0;
  }
}

Result<void> ColumnTaker::takeLabels(const Columns& from, PointBlock& to) const {
  const auto products = static_cast<double>(plan_.header.products.size());
  const auto materials = static_cast<double>(plan_.header.materials.size());
  bool inside = true;
  for (const double v : from[*roles_.product]) inside &= v >= 0 && v < products;
  for (const double v : from[*roles_.material]) inside &= v >= 0 && v < materials;
  if (!inside) return failure(ErrorKind::unusable, "a point's label is outside the label table", plan_.source);
  convert(from[*roles_.product], 0, to.product);
  convert(from[*roles_.material], 0, to.material);
  return {};
}

void ColumnTaker::takeReturns(const Columns& from, PointBlock& to) {
  const std::vector<double>&index = from[*roles_.return_index], &count = from[*roles_.return_count];
  to.return_number.resize(index.size());
  to.return_count.resize(index.size());
  for (std::size_t i = 0; i < index.size(); ++i) {
    const bool sensible = index[i] >= 0 && index[i] < count[i] && count[i] <= 255;
    tally_.no_return += !sensible;
    to.return_number[i] = sensible ? static_cast<std::uint8_t>(index[i] + 1) : 1;  // the file counts from 0
    to.return_count[i] = sensible ? static_cast<std::uint8_t>(count[i]) : 1;
  }
}

void ColumnTaker::takeTruth(Columns& from, FoundPoints& to) {
  for (int k = 0; k < 7; ++k)
    for (double& value : from[*roles_.truth[k]]) {
      const bool sensible = k == 6 ? value >= 0 && value <= 255 : std::abs(value) <= std::numeric_limits<float>::max();
      tally_.no_truth += !sensible;
      if (!sensible) value = 0;
    }
  to.true_x.swap(from[*roles_.truth[0]]), to.true_y.swap(from[*roles_.truth[1]]),
      to.true_z.swap(from[*roles_.truth[2]]);
  PointTruth& truth = to.columns.truth;
  convert(from[*roles_.truth[3]], 0, truth.range_m);
  convert(from[*roles_.truth[4]], 0, truth.incidence_rad);
  convert(from[*roles_.truth[5]], 0, truth.received_db);
  convert(from[*roles_.truth[6]], 0, truth.flags);
}

Result<void> ColumnTaker::take(Columns& from, std::size_t records, FoundPoints& to) {
  dropInvalid(from, records);
  PointBlock& block = to.columns;
  takePlaces(from, to);
  if (roles_.intensity) {
    tally_.no_intensity += blank(from, roles_.intensity_invalid, {{roles_.intensity}});
    convert(from[*roles_.intensity], 0, block.intensity);
  } else {
    block.intensity.assign(records, 0);
  }
  if (roles_.row) {
    convert(from[*roles_.row], plan_.first_row, block.row);
    convert(from[*roles_.column], plan_.first_column, block.column);
  } else {
    block.row.assign(records, 0);
    block.column.assign(records, 0);
  }
  if (plan_.header.has_colour) takeColours(from, block);
  if (roles_.time) {
    tally_.no_time += blank(from, roles_.time_invalid, {{roles_.time}});
    block.time_s.swap(from[*roles_.time]);
    for (double& time : block.time_s)
      if (!std::isfinite(time)) ++tally_.no_time, time = 0;
  }
  if (roles_.channel) {
    for (double& channel : from[*roles_.channel])
      if (!(channel >= 0 && channel <= 255)) ++tally_.no_channel, channel = 0;
    convert(from[*roles_.channel], 0, block.channel);
  }
  if (roles_.return_index) takeReturns(from, block);
  if (plan_.header.has_truth) takeTruth(from, to);
  return plan_.header.has_labels ? takeLabels(from, block) : Result<void>{};
}

void ColumnTaker::list(const std::string& source, Report& report) const {
  const auto count = [](std::uint64_t n) { return std::to_string(n); };
  if (tally_.invalid > 0) report.note(source, count(tally_.invalid) + " points marked as invalid were skipped");
  if (tally_.no_intensity > 0)
    report.note(source, count(tally_.no_intensity) + " intensities marked as invalid were set to 0");
  if (tally_.no_colour > 0)
    report.note(source, count(tally_.no_colour) + " colours marked as invalid were set to black");
  if (tally_.no_time > 0) report.note(source, count(tally_.no_time) + " times marked as invalid were set to 0");
  if (tally_.no_channel > 0) report.warn(source, count(tally_.no_channel) + " invalid channels were set to 0");
  if (tally_.no_return > 0) report.warn(source, count(tally_.no_return) + " invalid return numbers were set to 1 of 1");
  if (tally_.no_truth > 0) report.lose(source, count(tally_.no_truth) + " non-numeric truth values were set to 0");
  if (tally_.outside_grid > 0)
    report.lose(source, count(tally_.outside_grid) + " points are outside the file's indexBounds");
}

}  // namespace standpoint::e57
