// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/engine/return_lanes.h"

#include <algorithm>

namespace standpoint {

namespace {

constexpr std::array<std::uint8_t, 3> kWhite = {255, 255, 255};

}  // namespace

// What is never set must have finite figures, too.
ReturnLanes::ReturnLanes() : signal{} {
  std::fill_n(signal.range_m, kReturnLanes, 1.0F);
  std::fill_n(signal.cosine, kReturnLanes, 1.0F);
  std::fill_n(signal.gain, kReturnLanes, 1.0F);
  std::fill_n(signal.variation, kReturnLanes, 1.0F);
  std::fill_n(signal.known_x, kReturnLanes, -1.0F);
}

void ReturnLanes::begin(std::uint32_t first_row, const double* sines, const double* cosines) {
  for (std::uint32_t k = 0; k < kReturnLanes; ++k) row[k] = first_row + k;
  std::copy_n(cosines, kReturnLanes, cosine);
  std::copy_n(sines, kReturnLanes, sine);
  if (!marked) return;
  marked = false;
  std::fill_n(signal.gain, kReturnLanes, 1.0F);
  std::fill_n(signal.known_x, kReturnLanes, -1.0F);
  std::fill_n(flags, kReturnLanes, std::uint8_t{0});
  std::fill_n(deviation_m, kReturnLanes, 0.0F);
}

void ReturnLanes::setOptics(int lane, const Optics& of, float scale) {
  if (optics[lane] == &of && factor[lane] == scale) return;
  optics[lane] = &of, factor[lane] = scale;
  signal.diffuse[lane] = std::min(1.0F, of.diffuse * scale);
  signal.roughness[lane] = of.roughness;
  signal.glint[lane] = of.glint;
  signal.steepness[lane] = of.steepness;
  variation[lane] = of.variation;
  texture_scale_m[lane] = of.texture_scale_m;
}

void ReturnLanes::setSurface(const ScanPlan& plan, int from, int to, const MetFacet& met) {
  const auto& colour = plan.colours[met.facet.surface];
  for (int k = from; k < to; ++k) {
    setOptics(k, *met.optics, met.factor);
    product[k] = met.facet.product, material[k] = met.material;
    red[k] = colour[0], green[k] = colour[1], blue[k] = colour[2];
  }
}

void ReturnLanes::setEcho(const ScanPlan& plan, int lane, const PathEnd& end, const Echo& echo) {
  marked = true;
  setOptics(lane, *end.optics, end.paint);
  range_m[lane] = echo.range_m;
  signal.range_m[lane] = static_cast<float>(end.path_m);
  signal.cosine[lane] = end.cosine;
  signal.gain[lane] = end.gain;
  signal.known_x[lane] = echo.x;
  place_x[lane] = end.place.x(), place_y[lane] = end.place.y(), place_z[lane] = end.place.z();
  product[lane] = end.product, material[lane] = end.material;
  const auto& colour = end.surface == kNoSurface ? kWhite : plan.colours[end.surface];
  red[lane] = colour[0], green[lane] = colour[1], blue[lane] = colour[2];
  const double tolerance = edgeTolerance(plan.instrument, end.path_m);
  const bool mixed = static_cast<double>(echo.spread_m) > tolerance;
  const bool folded = plan.unambiguous_m > 0 && echo.range_m >= plan.unambiguous_m;
  flags[lane] =
      static_cast<std::uint8_t>(end.flags | (mixed ? point_flag::kMixed : 0) | (folded ? point_flag::kMirrored : 0));
  deviation_m[lane] = echo.deviation_m;
  normal_x[lane] = end.normal.x(), normal_y[lane] = end.normal.y(), normal_z[lane] = end.normal.z();
}

}  // namespace standpoint
