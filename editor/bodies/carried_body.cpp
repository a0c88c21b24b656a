// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/bodies/carried_body.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace standpoint {

namespace {

using CarriedPaint = BodyPaint;
using Spot = Eigen::Vector3d;

Spot inMm(double x, double y, double z) { return Spot(x, y, z) / 1000; }

struct Bench {
  CarriedBody carried;
  SolidMaker make{carried.look.head};

  Bench(std::string_view id, const BodyColour& shell, const BodyColour& trim) {
    carried.look.id = id;
    carried.look.shell = shell;
    carried.look.trim = trim;
  }
  // A round spinning lidar about `axis`, its beams leaving at `middle`: a base, a dark window and a lid; half of its
  // height lies to either side.
  void puck(const Spot& middle, const Spot& axis, double radius_mm, double height_mm) {
    const double r = radius_mm / 1000, half = height_mm / 2000;
    const auto at = [&](double share) { return Spot(middle + share * half * axis); };
    make.rod(CarriedPaint::shell, at(-1), at(-0.36), 0.98 * r, r, 20);
    make.rod(CarriedPaint::glass, at(-0.36), at(0.62), 0.985 * r, 0.95 * r, 20);
    make.rod(CarriedPaint::shell, at(0.62), at(1), r, 0.94 * r, 20);
  }
  // A small round window that looks along `out`.
  void window(const Spot& at, const Spot& out, double radius_mm) {
    make.rod(CarriedPaint::dark, at - 0.003 * out, at + 0.003 * out, radius_mm / 1000, 0.9 * radius_mm / 1000, 10);
    make.rod(CarriedPaint::glass, at, at + 0.0045 * out, 0.6 * radius_mm / 1000, 0.6 * radius_mm / 1000, 8);
  }
};

// Leans forward by that angle.
Spot leaned(double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  return {std::sin(angle), 0, std::cos(angle)};
}

// A slender column with a waist to be held by, under a dome in which the mirror turns; cameras below the dome.
CarriedBody blk2go() {
  Bench b("leica-blk2go", {46, 48, 51}, {30, 31, 34});
  auto& make = b.make;
  make.rod(CarriedPaint::trim, inMm(0, 0, -239), inMm(0, 0, -226), 0.034, 0.036, 24);
  make.rod(CarriedPaint::shell, inMm(0, 0, -226), inMm(0, 0, -190), 0.037, 0.034, 24);
  make.rod(CarriedPaint::rubber, inMm(0, 0, -190), inMm(0, 0, -112), 0.0305, 0.0305, 24);
  make.rod(CarriedPaint::shell, inMm(0, 0, -112), inMm(0, 0, -40), 0.033, 0.04, 24);
  make.rod(CarriedPaint::metal, inMm(0, 0, -40), inMm(0, 0, -34), 0.0395, 0.0395, 24);
  make.rod(CarriedPaint::glass, inMm(0, 0, -34), inMm(0, 0, 16), 0.038, 0.034, 24);
  make.rod(CarriedPaint::glass, inMm(0, 0, 16), inMm(0, 0, 34), 0.034, 0.021, 24);
  make.rod(CarriedPaint::trim, inMm(0, 0, 34), inMm(0, 0, 40), 0.021, 0.012, 24);
  for (const double angle : {0.0, 2.1, -2.1}) {
    const Spot out(std::cos(angle), std::sin(angle), 0);
    b.window(0.0385 * out + inMm(0, 0, -66), out, 8);
  }
  make.rod(CarriedPaint::accent, inMm(-31, 0, -130), inMm(-35, 0, -130), 0.009, 0.008, 12);
  b.carried.look.foot_m = 0.239;
  b.carried.top_m = 0.04;
  b.carried.grip_m = inMm(0, 0, -150);
  return b.carried;
}

// A multi-beam head that lies on its side in front of a motor, on a handle.
CarriedBody onMotorHead(std::string_view id, double radius, double height, const BodyColour& shell) {
  Bench b(id, shell, {38, 40, 44});
  auto& make = b.make;
  const double below = radius + 14;
  b.puck(Spot::Zero(), Spot::UnitX(), radius, height);
  make.block(CarriedPaint::trim, inMm(-height / 2 - 16, 0, -radius * 0.8), inMm(30, 70, 1.7 * radius), 0.01);
  make.block(CarriedPaint::trim, inMm(-12, 0, -below), inMm(92, 78, 14), 0.008);
  make.rod(CarriedPaint::shell, inMm(-12, 0, -below - 62), inMm(-12, 0, -below), 0.036, 0.042, 20);
  make.rod(CarriedPaint::metal, inMm(-12, 0, -below - 70), inMm(-12, 0, -below - 62), 0.03, 0.03, 16);
  make.rod(CarriedPaint::rubber, inMm(-12, 0, -below - 196), inMm(-12, 0, -below - 70), 0.021, 0.019, 16);
  make.rod(CarriedPaint::dark, inMm(-12, 0, -below - 208), inMm(-12, 0, -below - 196), 0.024, 0.024, 16);
  b.window(inMm(34, 0, -below + 7), Spot::UnitX(), 8);
  b.carried.look.foot_m = (below + 208) / 1000;
  b.carried.top_m = radius / 1000;
  b.carried.grip_m = inMm(-12, 0, -below - 132);
  return b.carried;
}

// A frame over both shoulders: one head above them, one steep in front of the chest, cameras on top.
CarriedBody overShoulders(std::string_view id, double radius, double height) {
  Bench b(id, {226, 228, 230}, {44, 47, 52});
  auto& make = b.make;
  b.puck(Spot::Zero(), leaned(15), radius, height);
  b.puck(inMm(200, 0, -290), leaned(75), radius, height);
  make.block(CarriedPaint::trim, inMm(-8, 0, -72), inMm(90, 96, 30), 0.012);
  make.block(CarriedPaint::shell, inMm(-30, 0, -96), inMm(70, 350, 28), 0.01);
  for (const double side : {-1.0, 1.0}) {
    const Spot top = inMm(-30, side * 165, -86), shoulder = inMm(-30, side * 165, -430);
    const Spot chest = inMm(150, side * 150, -470), front = inMm(176, side * 90, -330);
    make.rod(CarriedPaint::trim, shoulder, top, 0.014, 0.014, 10);
    make.rod(CarriedPaint::trim, shoulder, chest, 0.016, 0.014, 10);
    make.rod(CarriedPaint::trim, chest, front, 0.013, 0.013, 10);
    make.rod(CarriedPaint::rubber, inMm(-70, side * 165, -452), inMm(60, side * 165, -452), 0.03, 0.03, 10);
    make.rod(CarriedPaint::trim, shoulder, inMm(-130, side * 120, -700), 0.016, 0.014, 10);
    b.window(inMm(8, side * 150, -82), Spot::UnitX(), 13);
    b.window(inMm(-30, side * 176, -82), side * Spot::UnitY(), 13);
  }
  make.block(CarriedPaint::trim, inMm(168, 0, -352), inMm(30, 200, 26), 0.008);
  make.block(CarriedPaint::shell, inMm(-140, 0, -730), inMm(70, 260, 190), 0.02);
  b.carried.look.foot_m = 0.73;
  b.carried.top_m = 0.06;
  b.carried.worn = true;
  return b.carried;
}

// A spinning multi-beam lidar by itself, on a plate.
CarriedBody onPlate(std::string_view id, double radius, double height, double origin_up, int ribs,
                    const BodyColour& shell) {
  Bench b(id, shell, {60, 63, 68});
  const Spot middle = inMm(0, 0, height / 2 - origin_up);
  b.puck(middle, Spot::UnitZ(), radius, height);
  for (int rib = 0; rib < ribs; ++rib) {
    const double angle = 2 * std::numbers::pi * rib / ribs;
    const Spot out(std::cos(angle), std::sin(angle), 0);
    b.make.rod(CarriedPaint::shell, radius / 1000 * out + inMm(0, 0, height * 0.8 - origin_up),
               radius / 1000 * out + inMm(0, 0, height - origin_up), 0.004, 0.003, 6);
  }
  b.make.block(CarriedPaint::trim, inMm(0, 0, -origin_up - 10), inMm(1.9 * radius, 1.9 * radius, 10), 0.004);
  b.carried.look.foot_m = (origin_up + 10) / 1000;
  b.carried.top_m = (height - origin_up) / 1000;
  return b.carried;
}

// A box that hangs below an aircraft, with a band of glass around it through which the mirror looks across the flight.
CarriedBody vux() {
  Bench b("riegl-vux-1uav", {196, 199, 203}, {52, 55, 60});
  auto& make = b.make;
  make.block(CarriedPaint::shell, inMm(-104, 0, -62), inMm(148, 180, 125), 0.014);
  make.rod(CarriedPaint::trim, inMm(-30, 0, 0), inMm(-22, 0, 0), 0.061, 0.058, 24);
  make.rod(CarriedPaint::glass, inMm(-22, 0, 0), inMm(20, 0, 0), 0.055, 0.055, 24);
  make.rod(CarriedPaint::trim, inMm(20, 0, 0), inMm(49, 0, 0), 0.058, 0.046, 24);
  make.block(CarriedPaint::trim, inMm(-104, 0, 63), inMm(120, 150, 12), 0.004);
  for (int fin = 0; fin < 5; ++fin) make.block(CarriedPaint::dark, inMm(-150 + 22 * fin, 0, -68), inMm(8, 150, 8), 0);
  b.carried.look.foot_m = 0.068;
  b.carried.top_m = 0.075;
  return b.carried;
}

// Any other: a box with one window ahead.
CarriedBody plainBox() {
  Bench b("generic", {178, 182, 187}, {78, 82, 88});
  auto& make = b.make;
  make.block(CarriedPaint::shell, inMm(-70, 0, -50), inMm(150, 110, 96), 0.014);
  make.block(CarriedPaint::trim, inMm(-70, 0, -60), inMm(120, 80, 10), 0.004);
  make.rod(CarriedPaint::trim, inMm(0, 0, 0), inMm(16, 0, 0), 0.034, 0.03, 20);
  make.rod(CarriedPaint::glass, inMm(10, 0, 0), inMm(18, 0, 0), 0.022, 0.022, 16);
  b.carried.look.foot_m = 0.06;
  b.carried.top_m = 0.046;
  return b.carried;
}

}  // namespace

std::span<const CarriedBody> carriedBodies() {
  static const std::vector<CarriedBody> all = {blk2go(),
                                               onMotorHead("geoslam-zeb-horizon", 51.5, 72, {206, 208, 210}),
                                               onMotorHead("faro-orbis", 51.5, 76, {58, 61, 66}),
                                               overShoulders("navvis-vlx2", 51.5, 72),
                                               overShoulders("navvis-vlx3", 51.5, 76),
                                               onPlate("velodyne-vlp-16", 51.5, 72, 37.7, 0, {176, 179, 184}),
                                               onPlate("hesai-xt32", 51.5, 76, 47, 0, {50, 52, 56}),
                                               onPlate("ouster-os1-128", 42.5, 73.5, 36.2, 28, {158, 161, 166}),
                                               vux(),
                                               plainBox()};
  return all;
}

const CarriedBody& carriedBodyOf(std::string_view instrument) {
  const auto bodies = carriedBodies();
  const auto own = std::find_if(bodies.begin(), bodies.end(), [&](const auto& b) { return b.look.id == instrument; });
  return own == bodies.end() ? bodies.back() : *own;
}

}  // namespace standpoint
