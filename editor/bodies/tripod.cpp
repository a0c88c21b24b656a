// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/bodies/tripod.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace standpoint {

namespace {

using P = BodyPaint;
using V = Eigen::Vector3d;

constexpr double kTribrach_m = 0.066, kClamp_m = 0.034, kHead_m = 0.03;  // how high they are
constexpr double kLeastLegs_m = 0.25;                                    // below that a plate has to do
constexpr double kFirstLeg_rad = 0.4;                                    // so that none hides the foot in front

V around(int third, double radius_m, double z_m) {
  const double angle = kFirstLeg_rad + third * 2 * std::numbers::pi / 3;
  return {radius_m * std::cos(angle), radius_m * std::sin(angle), z_m};
}

void tribrach(SolidMaker& make, double top_m) {
  make.rod(P::dark, V(0, 0, top_m - 0.016), V(0, 0, top_m), 0.082, 0.076, 12);
  for (int screw = 0; screw < 3; ++screw) {
    make.rod(P::metal, around(screw, 0.062, top_m - 0.052), around(screw, 0.062, top_m - 0.018), 0.009, 0.009, 6);
    make.rod(P::rubber, around(screw, 0.062, top_m - 0.046), around(screw, 0.062, top_m - 0.026), 0.018, 0.018, 10);
  }
  make.rod(P::metal, V(0, 0, top_m - kTribrach_m), V(0, 0, top_m - 0.05), 0.09, 0.084, 12);
}

void quickClamp(SolidMaker& make, double top_m) {
  make.rod(P::metal, V(0, 0, top_m - kClamp_m), V(0, 0, top_m), 0.042, 0.034, 12);
  make.block(P::accent, around(0, 0.05, top_m - 0.022), V(0.05, 0.014, 0.014), 0);
}

// Two rods, a blade between them that slides out, and a pointed shoe.
void woodenLeg(SolidMaker& make, int third, double top_m, double floor_m, double spread_m) {
  const V top = around(third, 0.085, top_m), foot = around(third, spread_m, floor_m);
  const V along = foot - top, side = V::UnitZ().cross(around(third, 1, 0)) * 0.036;
  const V middle = top + 0.58 * along;
  for (const double which : {-1.0, 1.0})
    make.rod(P::legs, top + which * side, middle + which * 0.7 * side, 0.015, 0.013, 6);
  make.rod(P::dark, top + 0.55 * along - 0.9 * side, top + 0.55 * along + 0.9 * side, 0.018, 0.018, 6);
  make.rod(P::legs, top + 0.5 * along, top + 0.95 * along, 0.017, 0.015, 6);
  make.rod(P::metal, top + 0.94 * along, foot, 0.02, 0.004, 6);
}

// Tubes that slide into each other.
void tubeLeg(SolidMaker& make, int third, double top_m, double floor_m, double spread_m) {
  const V top = around(third, 0.045, top_m), foot = around(third, spread_m, floor_m), along = foot - top;
  make.rod(P::legs, top, top + 0.52 * along, 0.0155, 0.0155, 8);
  make.rod(P::metal, top + 0.5 * along, top + 0.55 * along, 0.02, 0.02, 8);
  make.rod(P::legs, top + 0.5 * along, top + 0.97 * along, 0.0115, 0.0115, 8);
  make.rod(P::rubber, top + 0.95 * along, foot, 0.016, 0.01, 8);
}

}  // namespace

BodyMesh tripodOf(const InstrumentBody& body, double height_m) {
  BodyMesh mesh;
  SolidMaker make{mesh};
  const bool with_screws = body.mount == Mount::tribrach;
  const double floor = -height_m, top = -body.foot_m, plate = top - (with_screws ? kTribrach_m : kClamp_m);
  if (plate > floor && with_screws) tribrach(make, top);
  if (plate > floor && !with_screws) quickClamp(make, top);
  const double under = std::max(0.0, plate - floor);
  if (under < kLeastLegs_m) {
    if (under > 0.004) make.rod(P::metal, V(0, 0, floor), V(0, 0, plate), 0.12, 0.08, 12);
    return mesh;
  }
  const double spread = std::clamp(0.4 * under, 0.16, 0.75);
  make.rod(P::dark, V(0, 0, plate - kHead_m), V(0, 0, plate), body.heavy_tripod ? 0.105 : 0.052,
           body.heavy_tripod ? 0.1 : 0.045, body.heavy_tripod ? 12 : 10);
  if (!body.heavy_tripod) {
    make.rod(P::legs, V(0, 0, plate - std::min(0.3, 0.4 * under)), V(0, 0, plate - kHead_m), 0.014, 0.014, 8);
    make.rod(P::dark, V(0, 0, plate - kHead_m - 0.03), V(0, 0, plate - kHead_m), 0.05, 0.055, 10);
  }
  for (int leg = 0; leg < 3; ++leg)
    body.heavy_tripod ? woodenLeg(make, leg, plate - 0.02, floor, spread)
                      : tubeLeg(make, leg, plate - kHead_m - 0.015, floor, spread);
  return mesh;
}

}  // namespace standpoint
