// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/e57/e57_scan_reader.h"

#include <algorithm>
#include <cmath>

#include "pointclouds/e57/e57_columns.h"

namespace standpoint::e57 {
namespace {

// Without indexBounds the grid is as large as the indices that occur.
Result<void> measureGrid(PagedReader& file, const Element& points, ScanPlan& plan) {
  TRY_ASSIGN(auto reader, VectorReader::open(file, points, plan.source));
  const Place at[2] = {fieldNamed(reader.fields(), "rowIndex"), fieldNamed(reader.fields(), "columnIndex")};
  for (const Place& place : at) reader.want(*place);
  double least[2] = {INFINITY, INFINITY}, most[2] = {-INFINITY, -INFINITY};
  Columns columns;
  for (;;) {
    TRY_ASSIGN(const auto n, reader.next(columns));
    if (n == 0) break;
    for (int side = 0; side < 2; ++side)
      for (const double v : columns[*at[side]])
        least[side] = std::min(least[side], v), most[side] = std::max(most[side], v);
  }
  constexpr double kLargestSide = 1 << 30;
  for (int side = 0; side < 2; ++side)
    if (const double span = most[side] - least[side]; !(span >= 0 && span < kLargestSide)) return {};  // no grid
  plan.first_row = least[0];
  plan.first_column = least[1];
  plan.header.rows = static_cast<std::uint32_t>(most[0] - least[0]) + 1;
  plan.header.columns = static_cast<std::uint32_t>(most[1] - least[1]) + 1;
  return {};
}

}  // namespace

Result<void> readScan(PagedReader& file, const Element& points, ScanPlan plan,
                      const std::vector<ListedPicture>& pictures, PointSink& sink, Report& report, Progress& progress) {
  if (!plan.has_index_bounds)
    if (auto measured = measureGrid(file, points, plan); !measured) return measured;
  TRY_ASSIGN(auto reader, VectorReader::open(file, points, plan.source));
  const Roles roles = rolesOf(reader.fields(), plan);
  if (!roles.x || !roles.y || !roles.z)
    return failure(ErrorKind::unusable, "the points have neither cartesian nor spherical coordinates", plan.source);
  roles.forEach([&](std::size_t place) { reader.want(place); });
  const auto single = [&](const Place& place) {
    return reader.fields()[*place].kind == StoredField::Kind::single_float;
  };
  LocalPoints local(sink, plan.header, roles.spherical || !single(roles.x) || !single(roles.y) || !single(roles.z));
  ColumnTaker taker(plan, roles);
  Columns columns;
  FoundPoints found;
  for (std::uint64_t done = 0;;) {
    TRY_ASSIGN(const auto n, reader.next(columns));
    if (n == 0) break;
    if (auto taken = taker.take(columns, n, found); !taken) return taken;
    if (auto written = local.write(found); !written) return written;
    done += n;
    progress.advance(static_cast<double>(done) / static_cast<double>(reader.records()));
    if (auto going = progress.check(); !going) return going;
  }
  taker.list(plan.source, report);
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
