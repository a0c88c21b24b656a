// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The makers behind the table of point_filters.cpp. Values are complete and within their domains; what contradicts
// itself is an error without a place.

#include "pointclouds/filters/point_filter.h"

namespace standpoint {

using MadeFilter = Result<std::unique_ptr<PointFilter>>;

MadeFilter makeRangeGate(const FilterValues& values);
MadeFilter makeIntensityGate(const FilterValues& values);
MadeFilter makeIncidenceGate(const FilterValues& values);
MadeFilter makeFractionFilter(const FilterValues& values);
MadeFilter makeEveryFilter(const FilterValues& values);
MadeFilter makeBoxFilter(const FilterValues& values);
MadeFilter makeSphereFilter(const FilterValues& values);
MadeFilter makeVoxelFilter(const FilterValues& values);
MadeFilter makeDuplicateFilter(const FilterValues& values);
MadeFilter makeOutlierFilter(const FilterValues& values);
MadeFilter makeMixedFilter(const FilterValues& values);

}  // namespace standpoint
