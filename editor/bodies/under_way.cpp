// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/bodies/under_way.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/motion/limbs.h"
#include "survey/movers/mover_shapes.h"

namespace standpoint {

namespace {

using BearerPaint = BodyPaint;
using Spot = Eigen::Vector3d;

bool samePose(const Pose& a, const Pose& b) {
  return a.translation == b.translation && a.rotation.coeffs() == b.rotation.coeffs();
}

void moveTo(const Pose& pose, BodyMesh& mesh, std::size_t first) {
  for (std::size_t i = first; i < mesh.positions.size(); ++i)
    mesh.positions[i] = (pose * mesh.positions[i].cast<double>()).cast<float>();
}

void addAt(BodyMesh& all, const Mesh& mesh, const Pose& pose, BodyPaint paint) {
  const std::size_t first = all.positions.size();
  const auto before = static_cast<std::uint32_t>(first);
  all.positions.insert(all.positions.end(), mesh.positions.begin(), mesh.positions.end());
  for (const auto& t : mesh.triangles) {
    all.triangles.push_back({before + t[0], before + t[1], before + t[2]});
    all.paints.push_back(paint);
  }
  moveTo(pose, all, first);
}

// Upright below the instrument, looking where it does; what bears it stands on z = 0 there.
Pose onGround(const CarriedInstrument& instrument) {
  const Spot ahead = instrument.pose.rotation * Spot::UnitX();
  Pose pose;
  pose.rotation = Eigen::AngleAxisd(std::atan2(ahead.y(), ahead.x()), Spot::UnitZ());
  pose.translation = instrument.pose.translation - instrument.height_m * Spot::UnitZ();
  return pose;
}

Spot mastTopOf(const CarriedInstrument& instrument) {
  return instrument.pose * Spot(0, 0, -instrument.body->look.foot_m);
}

// From the shoulder to what the hand holds, bent at the elbow, which hangs down.
void addReachingArm(SolidMaker& make, const Spot& shoulder, const Spot& hand) {
  constexpr double kUpper_m = 0.3, kFore_m = 0.34;
  const Spot way = hand - shoulder;
  const double reach = std::clamp(way.norm(), 0.1, kUpper_m + kFore_m);
  const double along = (kUpper_m * kUpper_m - kFore_m * kFore_m + reach * reach) / (2 * reach);
  const double off = std::sqrt(std::max(0.0, kUpper_m * kUpper_m - along * along));
  const Spot direction = way.normalized();
  const Spot down = -Spot::UnitZ() + direction.z() * direction;
  const Spot elbow = shoulder + along * direction + off * (down.norm() > 1e-6 ? down.normalized() : Spot::UnitX());
  make.rod(BearerPaint::clothes, shoulder, elbow, 0.055, 0.045, 12);
  make.rod(BearerPaint::clothes, elbow, hand, 0.045, 0.03, 12);
}

// A pole under an instrument without a handle, to hold it by.
Spot heldAt(SolidMaker& make, const CarriedInstrument& instrument) {
  constexpr double kPole_m = 0.22;
  if (instrument.body->grip_m) return instrument.pose * *instrument.body->grip_m;
  const Spot foot = mastTopOf(instrument), down = -(instrument.pose.rotation * Spot::UnitZ());
  make.rod(BearerPaint::dark, foot + kPole_m * down, foot, 0.016, 0.016, 12);
  return foot + 0.6 * kPole_m * down;
}

// A rucksack with a mast behind the head and an arm over it.
void addMast(BodyMesh& mesh, SolidMaker& make, const CarriedInstrument& instrument) {
  const Pose& trunk = instrument.limbs.front();
  const std::size_t first = mesh.positions.size();
  make.block(BearerPaint::trim, Spot(-0.2, 0, 1.0), Spot(0.15, 0.3, 0.44), 0.03);
  for (const double side : {-1.0, 1.0})
    make.rod(BearerPaint::dark, Spot(-0.13, side * 0.1, 1.4), Spot(0.03, side * 0.11, 1.45), 0.018, 0.018, 8);
  moveTo(trunk, mesh, first);
  const Spot foot = mastTopOf(instrument), pack = trunk * Spot(-0.2, 0, 1.42);
  const Spot bend(pack.x(), pack.y(), std::max(foot.z() - 0.02, pack.z() + 0.05));
  make.rod(BearerPaint::metal, pack, bend, 0.017, 0.014, 12);
  make.rod(BearerPaint::metal, bend, foot, 0.014, 0.014, 12);
}

void addPerson(BodyMesh& mesh, SolidMaker& make, const CarriedInstrument& instrument) {
  const bool by_hand = instrument.carrier == "hand" && !instrument.body->worn;
  for (std::size_t k = 0; k < kLimbs.size(); ++k)
    if (!by_hand || kLimbs[k] != Limb::right_arm)
      addAt(mesh, limbMesh(kLimbs[k]), instrument.limbs[k], BearerPaint::clothes);
  const Pose& trunk = instrument.limbs.front();
  if (by_hand)
    addReachingArm(make, trunk * Spot(0, -kShoulderAside_m, kShoulder_m), heldAt(make, instrument));
  else if (!instrument.body->worn)
    addMast(mesh, make, instrument);
}

void addTrolley(BodyMesh& mesh, SolidMaker& make, const CarriedInstrument& instrument) {
  const std::size_t first = mesh.positions.size();
  make.block(BearerPaint::trim, Spot(-0.1, 0, 0.2), Spot(0.7, 0.46, 0.07), 0.02);
  make.block(BearerPaint::shell, Spot(-0.16, 0, 0.27), Spot(0.34, 0.34, 0.3), 0.03);
  for (const double x : {-0.36, 0.16})
    for (const double side : {-1.0, 1.0})
      make.rod(BearerPaint::rubber, Spot(x, side * 0.2, 0.1), Spot(x, side * 0.25, 0.1), 0.1, 0.1, 16);
  for (const double side : {-1.0, 1.0})
    make.rod(BearerPaint::metal, Spot(-0.4, side * 0.2, 0.25), Spot(-0.56, side * 0.2, 1.02), 0.014, 0.014, 8);
  make.rod(BearerPaint::rubber, Spot(-0.56, -0.22, 1.02), Spot(-0.56, 0.22, 1.02), 0.018, 0.018, 8);
  const Pose ground = onGround(instrument);
  moveTo(ground, mesh, first);
  make.rod(BearerPaint::metal, ground * Spot(0, 0, 0.27), mastTopOf(instrument), 0.024, 0.018, 12);
}

void addCar(BodyMesh& mesh, SolidMaker& make, const CarriedInstrument& instrument) {
  const Pose ground = onGround(instrument);
  addAt(mesh, vehicleMesh(), ground, BearerPaint::metal);
  const std::size_t first = mesh.positions.size();
  make.block(BearerPaint::dark, Spot(-0.15, 0, 1.43), Spot(1.0, 1.1, 0.08), 0.02);
  moveTo(ground, mesh, first);
  make.rod(BearerPaint::metal, ground * Spot(0, 0, 1.5), mastTopOf(instrument), 0.035, 0.025, 12);
}

// Six rotors above the instrument, tilted as it is.
void addMulticopter(BodyMesh& mesh, SolidMaker& make, const CarriedInstrument& instrument) {
  constexpr double kArm_m = 0.62, kRotor_m = 0.27;
  const std::size_t first = mesh.positions.size();
  const double top = instrument.body->top_m, deck = top + 0.12;
  make.rod(BearerPaint::dark, Spot(0, 0, top - 0.01), Spot(0, 0, deck), 0.03, 0.04, 12);
  make.block(BearerPaint::shell, Spot(0, 0, deck), Spot(0.34, 0.28, 0.12), 0.04);
  for (int i = 0; i < 6; ++i) {
    const double angle = std::numbers::pi * (2 * i + 1) / 6;
    const Spot out(std::cos(angle), std::sin(angle), 0), end = kArm_m * out + Spot(0, 0, deck + 0.07);
    make.rod(BearerPaint::dark, 0.1 * out + Spot(0, 0, deck + 0.06), end, 0.016, 0.012, 8);
    make.rod(BearerPaint::metal, end - Spot(0, 0, 0.02), end + Spot(0, 0, 0.045), 0.022, 0.018, 10);
    make.rod(BearerPaint::dark, end + Spot(0, 0, 0.045), end + Spot(0, 0, 0.051), kRotor_m, kRotor_m, 20);
  }
  for (const double side : {-1.0, 1.0}) {
    const Spot knee(0, side * 0.3, deck - 0.36);
    make.rod(BearerPaint::dark, Spot(0, side * 0.12, deck + 0.02), knee, 0.011, 0.011, 8);
    make.rod(BearerPaint::dark, knee - Spot(0.22, 0, 0), knee + Spot(0.22, 0, 0), 0.012, 0.012, 8);
  }
  moveTo(instrument.pose, mesh, first);
}

}  // namespace

bool CarriedInstrument::operator==(const CarriedInstrument& other) const {
  return body == other.body && samePose(pose, other.pose) && carrier == other.carrier && height_m == other.height_m &&
         std::equal(limbs.begin(), limbs.end(), other.limbs.begin(), other.limbs.end(), samePose);
}

BodyMesh bearerOf(const CarriedInstrument& instrument) {
  BodyMesh mesh;
  SolidMaker make{mesh};
  if (!instrument.limbs.empty())
    addPerson(mesh, make, instrument);
  else if (instrument.carrier == "trolley")
    addTrolley(mesh, make, instrument);
  else if (instrument.carrier == "vehicle")
    addCar(mesh, make, instrument);
  else if (instrument.carrier == "uav")
    addMulticopter(mesh, make, instrument);
  return mesh;
}

}  // namespace standpoint
