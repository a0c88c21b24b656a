// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/e57_scan_reader.h"

#include <algorithm>
#include <cmath>

#include "pointclouds/block_check.h"

namespace standpoint::e57 {
namespace {

using Columns = std::vector<std::vector<double>>;
using Place = std::optional<std::size_t>;

// Which stream holds what.
struct Roles {
  Place x, y, z;
  bool spherical = false;
  Place intensity, colour[3], row, column, product, material;
  Place cartesian_state, spherical_state, intensity_invalid, colour_invalid;
};

struct Tally {
  std::uint64_t invalid = 0, no_intensity = 0, no_colour = 0, outside_grid = 0;
};

Roles rolesOf(const std::vector<StoredField>& fields, const ScanPlan& plan) {
  const auto at = [&](std::string_view name) { return fieldNamed(fields, name); };
  Roles r{.x = at("cartesianX"), .y = at("cartesianY"), .z = at("cartesianZ")};
  r.spherical = !(r.x && r.y && r.z);
  if (r.spherical) r.x = at("sphericalRange"), r.y = at("sphericalAzimuth"), r.z = at("sphericalElevation");
  r.intensity = at("intensity");
  if (plan.header.has_colour) {
    r.colour[0] = at("colorRed"), r.colour[1] = at("colorGreen"), r.colour[2] = at("colorBlue");
    r.colour_invalid = at("isColorInvalid");
  }
  if (hasGrid(plan.header)) r.row = at("rowIndex"), r.column = at("columnIndex");
  if (plan.header.has_labels)
    r.product = at(plan.label_prefix + "product"), r.material = at(plan.label_prefix + "material");
  r.cartesian_state = at("cartesianInvalidState");
  r.spherical_state = at("sphericalInvalidState");
  r.intensity_invalid = at("isIntensityInvalid");
  return r;
}

void want(VectorReader& reader, const Roles& r) {
  for (const Place& place :
       {r.x, r.y, r.z, r.intensity, r.colour[0], r.colour[1], r.colour[2], r.row, r.column, r.product, r.material,
        r.cartesian_state, r.spherical_state, r.intensity_invalid, r.colour_invalid})
    if (place) reader.want(*place);
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

class ScanReading {
 public:
  ScanReading(const ScanPlan& plan, const Roles& roles) : plan_(plan), roles_(roles) {}
  Result<void> take(const Columns& from, std::size_t records, FoundPoints& to);
  const Tally& tally() const { return tally_; }

 private:
  static bool set(const Columns& from, const Place& place, std::size_t i) { return place && from[*place][i] != 0; }
  bool kept(const Columns& from, std::size_t i);
  void takePosition(const Columns& from, std::size_t i, FoundPoints& to) const;
  void takeColour(const Columns& from, std::size_t i, PointBlock& to);
  Result<void> takeLabels(const Columns& from, std::size_t i, PointBlock& to) const;
  const ScanPlan& plan_;
  const Roles& roles_;
  Tally tally_;
};

bool ScanReading::kept(const Columns& from, std::size_t i) {
  if (set(from, roles_.spherical ? roles_.spherical_state : roles_.cartesian_state, i)) return ++tally_.invalid, false;
  if (!roles_.row) return true;
  const double row = from[*roles_.row][i] - plan_.first_row, column = from[*roles_.column][i] - plan_.first_column;
  if (row >= 0 && row < plan_.header.rows && column >= 0 && column < plan_.header.columns) return true;
  return ++tally_.outside_grid, false;
}

void ScanReading::takePosition(const Columns& from, std::size_t i, FoundPoints& to) const {
  const double a = from[*roles_.x][i], b = from[*roles_.y][i], c = from[*roles_.z][i];
  to.x.push_back(roles_.spherical ? a * std::cos(c) * std::cos(b) : a);
  to.y.push_back(roles_.spherical ? a * std::cos(c) * std::sin(b) : b);
  to.z.push_back(roles_.spherical ? a * std::sin(c) : c);
}

void ScanReading::takeColour(const Columns& from, std::size_t i, PointBlock& to) {
  const bool invalid = set(from, roles_.colour_invalid, i);
  tally_.no_colour += invalid;
  std::vector<std::uint8_t>* const colours[3] = {&to.red, &to.green, &to.blue};
  for (int k = 0; k < 3; ++k) {
    const double share =
        (from[*roles_.colour[k]][i] - plan_.colour_least[k]) / (plan_.colour_most[k] - plan_.colour_least[k]);
    // Written so that a NaN becomes 0.
    colours[k]->push_back(!invalid && share > 0 ? static_cast<std::uint8_t>(std::lround(std::min(share, 1.0) * 255))
                                                : 0);
  }
}

Result<void> ScanReading::takeLabels(const Columns& from, std::size_t i, PointBlock& to) const {
  const double product = from[*roles_.product][i], material = from[*roles_.material][i];
  const ScanHeader& header = plan_.header;
  if (!(product >= 0 && product < static_cast<double>(header.products.size()) && material >= 0 &&
        material < static_cast<double>(header.materials.size())))
    return failure(ErrorKind::unusable, "a point's label lies outside the label table", plan_.source);
  to.product.push_back(static_cast<std::uint32_t>(product));
  to.material.push_back(static_cast<std::uint32_t>(material));
  return {};
}

Result<void> ScanReading::take(const Columns& from, std::size_t records, FoundPoints& to) {
  PointBlock& block = to.columns;
  for (std::size_t i = 0; i < records; ++i) {
    if (!kept(from, i)) continue;
    takePosition(from, i, to);
    const bool no_intensity = !roles_.intensity || set(from, roles_.intensity_invalid, i);
    tally_.no_intensity += no_intensity && roles_.intensity;
    block.intensity.push_back(no_intensity ? 0.0f : static_cast<float>(from[*roles_.intensity][i]));
    block.row.push_back(roles_.row ? static_cast<std::uint32_t>(from[*roles_.row][i] - plan_.first_row) : 0);
    block.column.push_back(roles_.row ? static_cast<std::uint32_t>(from[*roles_.column][i] - plan_.first_column) : 0);
    if (plan_.header.has_colour) takeColour(from, i, block);
    if (plan_.header.has_labels)
      if (auto taken = takeLabels(from, i, block); !taken) return taken;
  }
  return {};
}

void list(const Tally& tally, const std::string& source, Report& report) {
  const auto count = [](std::uint64_t n) { return std::to_string(n); };
  if (tally.invalid > 0)
    report.note(source, count(tally.invalid) + " points that the file marks as invalid are left out");
  if (tally.no_intensity > 0)
    report.note(source, count(tally.no_intensity) + " intensities are marked as invalid: 0 stands for them");
  if (tally.no_colour > 0)
    report.note(source, count(tally.no_colour) + " colours are marked as invalid: black stands for them");
  if (tally.outside_grid > 0)
    report.lose(source, count(tally.outside_grid) + " points lie outside the file's indexBounds");
}

}  // namespace

Result<void> readScan(PagedReader& file, const Element& points, ScanPlan plan, PointSink& sink, Report& report,
                      Progress& progress) {
  if (!plan.has_index_bounds)
    if (auto measured = measureGrid(file, points, plan); !measured) return measured;
  auto reader = VectorReader::open(file, points, plan.source);
  if (!reader) return failure(reader.error());
  const Roles roles = rolesOf(reader->fields(), plan);
  if (!roles.x || !roles.y || !roles.z)
    return failure(ErrorKind::unusable, "the points have neither cartesian nor spherical coordinates", plan.source);
  want(*reader, roles);
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
  return local.finish(report);
}

}  // namespace standpoint::e57
