// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scanners/engine/column_hits.h"

namespace standpoint {

// The column that is being worked on and those that its beams reach, sixteen rows of each traced when they are asked
// for.
class ColumnWindow {
 public:
  ColumnWindow(const ScanPlan& plan, FacetCache& facets)
      : facets_(facets), columns_(2 * plan.reach() + 1, ColumnHits(plan)), beside_(columns_.size()) {}
  void moveTo(std::uint32_t column) {
    current_ = column;
    for (std::uint32_t i = 0; i < beside_.size(); ++i) beside_[i] = &columns_[(column + i) % columns_.size()];
  }
  ColumnHits& current() {
    if (beside_[0]->column() != current_) beside_[0]->begin(current_);
    return *beside_[0];
  }
  // With sixteen rows from a multiple of sixteen on.
  const ColumnHits& current(std::uint32_t first_row) { return of(current_, *beside_[0], first_row); }
  // Up to as many columns aside as beams reach.
  const ColumnHits& before(std::uint32_t apart, std::uint32_t first_row) {
    return of(current_ - apart, *beside_[columns_.size() - apart], first_row);
  }
  const ColumnHits& after(std::uint32_t apart, std::uint32_t first_row) {
    return of(current_ + apart, *beside_[apart], first_row);
  }

 private:
  const ColumnHits& of(std::uint32_t number, ColumnHits& column, std::uint32_t first_row) {
    if (column.column() != number) column.begin(number);
    column.need(first_row, facets_);
    return column;
  }

  FacetCache& facets_;
  std::uint32_t current_ = 0;
  std::vector<ColumnHits> columns_;  // by their number
  std::vector<ColumnHits*> beside_;  // from the current one on, and round to those before it
};

// Finds the pulses beside whose axis, as far aside as the beam is wide, another axis meets something else. That is
// where the beam may meet several surfaces. Looked at are the pulses next to the axis, at the beam's edge and half-way.
class EdgeFinder {
 public:
  EdgeFinder(const ScanPlan& plan, ColumnWindow& columns, FacetCache& facets)
      : plan_(plan),
        columns_(columns),
        facets_(facets),
        row_step_(plan.rowStep_rad()),
        column_step_(plan.columnStep_rad()) {}
  // Of the sixteen rows from `first_row` on of the current column, as bits.
  std::uint32_t find(std::uint32_t first_row);

 private:
  // How many pulses apart the axes are that the beam's edge reaches, up and across; at least 1.
  struct Reach {
    std::uint32_t rows = 1, columns = 1;
  };
  Reach reachAt(double range_m, std::uint32_t row) const;
  std::uint32_t unlike(const ColumnHits& own, std::uint32_t first_row);
  bool atEdge(const ColumnHits& own, std::uint32_t row);

  const ScanPlan& plan_;
  ColumnWindow& columns_;
  FacetCache& facets_;
  double row_step_, column_step_;  // rad
};

}  // namespace standpoint
