// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/e57_scan_reader.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "pointclouds/block_check.h"
#include "pointclouds/e57_labels.h"

namespace standpoint::e57 {
namespace {

using Columns = std::vector<std::vector<double>>;
using Place = std::optional<std::size_t>;

// Which stream holds what.
struct Roles {
  Place x, y, z;
  bool spherical = false;
  Place intensity, colour[3], row, column, product, material, time, return_index, return_count, truth[7];
  Place cartesian_state, spherical_state, intensity_invalid, colour_invalid, time_invalid;

  template <class F>
  void forEach(F f) const {
    for (const Place& place : {x,
                               y,
                               z,
                               intensity,
                               colour[0],
                               colour[1],
                               colour[2],
                               row,
                               column,
                               product,
                               material,
                               time,
                               return_index,
                               return_count,
                               truth[0],
                               truth[1],
                               truth[2],
                               truth[3],
                               truth[4],
                               truth[5],
                               truth[6],
                               cartesian_state,
                               spherical_state,
                               intensity_invalid,
                               colour_invalid,
                               time_invalid})
      if (place) f(*place);
  }
};

struct Tally {
  std::uint64_t invalid = 0, no_intensity = 0, no_colour = 0, no_time = 0, outside_grid = 0, no_return = 0,
                no_truth = 0;
};

Roles rolesOf(const std::vector<StoredField>& fields, const ScanPlan& plan) {
  const auto at = [&](std::string_view name) { return fieldNamed(fields, name); };
  const ScanHeader& header = plan.header;
  Roles r{.x = at("cartesianX"), .y = at("cartesianY"), .z = at("cartesianZ")};
  r.spherical = !(r.x && r.y && r.z);
  if (r.spherical) r.x = at("sphericalRange"), r.y = at("sphericalAzimuth"), r.z = at("sphericalElevation");
  r.intensity = at("intensity");
  if (header.has_colour) {
    r.colour[0] = at("colorRed"), r.colour[1] = at("colorGreen"), r.colour[2] = at("colorBlue");
    r.colour_invalid = at("isColorInvalid");
  }
  if (hasGrid(header)) r.row = at("rowIndex"), r.column = at("columnIndex");
  if (header.has_labels) r.product = at(plan.prefix + "product"), r.material = at(plan.prefix + "material");
  if (header.has_time) r.time = at("timeStamp"), r.time_invalid = at("isTimeStampInvalid");
  if (header.has_returns) r.return_index = at("returnIndex"), r.return_count = at("returnCount");
  if (header.has_truth)
    for (std::size_t i = 0; i < kTruthFields.size(); ++i) r.truth[i] = at(plan.prefix + kTruthFields[i]);
  (r.spherical ? r.spherical_state : r.cartesian_state) =
      at(r.spherical ? "sphericalInvalidState" : "cartesianInvalidState");
  r.intensity_invalid = at("isIntensityInvalid");
  return r;
}

// Without indexBounds the grid is as large as the indices that occur.
Result<void> measureGrid(PagedReader& file, const Element& points, ScanPlan& plan) {
  auto reader = VectorReader::open(file, points, plan.source);
  if (!reader) return failure(reader.error());
  const Place at[2] = {fieldNamed(reader->fields(), "rowIndex"), fieldNamed(reader->fields(), "columnIndex")};
  for (const Place& place : at) reader->want(*place);
  double least[2] = {INFINITY, INFINITY}, most[2] = {-INFINITY, -INFINITY};
  Columns columns;
  for (;;) {
    const auto n = reader->next(columns);
    if (!n) return failure(n.error());
    if (*n == 0) break;
    for (int side = 0; side < 2; ++side)
      for (const double v : columns[*at[side]])
        least[side] = std::min(least[side], v), most[side] = std::max(most[side], v);
  }
  constexpr double kLargestSide = 1 << 30;
  if (!(most[0] - least[0] < kLargestSide && most[1] - least[1] < kLargestSide)) return {};  // no grid
  plan.first_row = least[0];
  plan.first_column = least[1];
  plan.header.rows = static_cast<std::uint32_t>(most[0] - least[0]) + 1;
  plan.header.columns = static_cast<std::uint32_t>(most[1] - least[1]) + 1;
  return {};
}

// Turns the file's columns into those of a block, column by column.
class ScanReading {
 public:
  ScanReading(const ScanPlan& plan, const Roles& roles) : plan_(plan), roles_(roles) {}
  // Uses `from` up.
  Result<void> take(Columns& from, std::size_t records, FoundPoints& to);
  const Tally& tally() const { return tally_; }

 private:
  void dropInvalid(Columns& from, std::size_t& records);
  void takePlaces(Columns& from, FoundPoints& to) const;
  void takeColours(Columns& from, PointBlock& to);
  Result<void> takeLabels(const Columns& from, PointBlock& to) const;
  void takeReturns(const Columns& from, PointBlock& to);
  void takeTruth(Columns& from, FoundPoints& to);
  // Values that the file marks as invalid become 0; how many there are.
  std::uint64_t blank(Columns& from, const Place& marks, std::span<const Place> places) const;
  const ScanPlan& plan_;
  const Roles& roles_;
  Tally tally_;
  std::vector<std::uint8_t> dropped_;
};

template <class T>
void convert(const std::vector<double>& from, double shift, std::vector<T>& to) {
  to.resize(from.size());
  for (std::size_t i = 0; i < from.size(); ++i) to[i] = static_cast<T>(from[i] - shift);
}

std::uint64_t ScanReading::blank(Columns& from, const Place& marks, std::span<const Place> places) const {
  if (!marks) return 0;
  std::uint64_t marked = 0;
  for (std::size_t i = 0; i < from[*marks].size(); ++i) {
    if (from[*marks][i] == 0) continue;
    ++marked;
    for (const Place& place : places) from[*place][i] = 0;
  }
  return marked;
}

void ScanReading::dropInvalid(Columns& from, std::size_t& records) {
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

void ScanReading::takePlaces(Columns& from, FoundPoints& to) const {
  to.x.swap(from[*roles_.x]), to.y.swap(from[*roles_.y]), to.z.swap(from[*roles_.z]);
  if (!roles_.spherical) return;
  for (std::size_t i = 0; i < to.x.size(); ++i) {
    const double range = to.x[i], azimuth = to.y[i], elevation = to.z[i];
    to.x[i] = range * std::cos(elevation) * std::cos(azimuth);
    to.y[i] = range * std::cos(elevation) * std::sin(azimuth);
    to.z[i] = range * std::sin(elevation);
  }
}

void ScanReading::takeColours(Columns& from, PointBlock& to) {
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
        const double share = (value - least) / (most - least);
        colours[k]->push_back(share > 0 ? static_cast<std::uint8_t>(std::lround(std::min(share, 1.0) * 255)) : 0);
      }
    }
    if (roles_.colour_invalid)
      for (std::size_t i = 0; i < column.size(); ++i)
        if (from[*roles_.colour_invalid][i] != 0) (*colours[k])[i] = 0;
  }
}

Result<void> ScanReading::takeLabels(const Columns& from, PointBlock& to) const {
  const auto products = static_cast<double>(plan_.header.products.size());
  const auto materials = static_cast<double>(plan_.header.materials.size());
  bool inside = true;
  for (const double v : from[*roles_.product]) inside &= v >= 0 && v < products;
  for (const double v : from[*roles_.material]) inside &= v >= 0 && v < materials;
  if (!inside) return failure(ErrorKind::unusable, "a point's label lies outside the label table", plan_.source);
  convert(from[*roles_.product], 0, to.product);
  convert(from[*roles_.material], 0, to.material);
  return {};
}

void ScanReading::takeReturns(const Columns& from, PointBlock& to) {
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

void ScanReading::takeTruth(Columns& from, FoundPoints& to) {
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

Result<void> ScanReading::take(Columns& from, std::size_t records, FoundPoints& to) {
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
  if (roles_.return_index) takeReturns(from, block);
  if (plan_.header.has_truth) takeTruth(from, to);
  return plan_.header.has_labels ? takeLabels(from, block) : Result<void>{};
}

void list(const Tally& tally, const std::string& source, Report& report) {
  const auto count = [](std::uint64_t n) { return std::to_string(n); };
  if (tally.invalid > 0)
    report.note(source, count(tally.invalid) + " points that the file marks as invalid are left out");
  if (tally.no_intensity > 0)
    report.note(source, count(tally.no_intensity) + " intensities are marked as invalid: 0 stands for them");
  if (tally.no_colour > 0)
    report.note(source, count(tally.no_colour) + " colours are marked as invalid: black stands for them");
  if (tally.no_time > 0)
    report.note(source, count(tally.no_time) + " times are marked as invalid: 0 stands for them");
  if (tally.no_return > 0)
    report.warn(source, count(tally.no_return) + " return numbers are none of their pulse: 1 of 1 stands for them");
  if (tally.no_truth > 0) report.lose(source, count(tally.no_truth) + " true values are no numbers: 0 stands for them");
  if (tally.outside_grid > 0)
    report.lose(source, count(tally.outside_grid) + " points lie outside the file's indexBounds");
}

}  // namespace

Result<void> readScan(PagedReader& file, const Element& points, ScanPlan plan,
                      const std::vector<ListedPicture>& pictures, PointSink& sink, Report& report, Progress& progress) {
  if (!plan.has_index_bounds)
    if (auto measured = measureGrid(file, points, plan); !measured) return measured;
  auto reader = VectorReader::open(file, points, plan.source);
  if (!reader) return failure(reader.error());
  const Roles roles = rolesOf(reader->fields(), plan);
  if (!roles.x || !roles.y || !roles.z)
    return failure(ErrorKind::unusable, "the points have neither cartesian nor spherical coordinates", plan.source);
  roles.forEach([&](std::size_t place) { reader->want(place); });
  const auto single = [&](const Place& place) {
    return reader->fields()[*place].kind == StoredField::Kind::single_float;
  };
  LocalPoints local(sink, plan.header, roles.spherical || !single(roles.x) || !single(roles.y) || !single(roles.z));
  ScanReading reading(plan, roles);
  Columns columns;
  FoundPoints found;
  for (std::uint64_t done = 0;;) {
    const auto n = reader->next(columns);
    if (!n) return failure(n.error());
    if (*n == 0) break;
    if (auto taken = reading.take(columns, *n, found); !taken) return taken;
    if (auto written = local.write(found); !written) return written;
    done += *n;
    progress.advance(static_cast<double>(done) / static_cast<double>(reader->records()));
    if (auto going = progress.check(); !going) return going;
  }
  list(reading.tally(), plan.source, report);
  for (const ListedPicture& listed : pictures) {
    const auto picture = readPicture(file, listed, report);
    if (!picture) {  // the points are worth having without it
      report.lose(picture.error().source, picture.error().message);
      continue;
    }
    if (auto passed = local.picture(*picture); !passed) return passed;
    if (auto going = progress.check(); !going) return going;
  }
  return local.finish(report);
}

}  // namespace standpoint::e57
