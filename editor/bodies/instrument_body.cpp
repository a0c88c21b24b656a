// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/bodies/instrument_body.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace standpoint {

namespace {

using P = BodyPaint;
using V = Eigen::Vector3d;

// Millimetres, as the sketches have them.
V mm(double x, double y, double z) { return V(x, y, z) / 1000; }

struct Workshop {
  InstrumentBody body;
  SolidMaker foot{body.foot}, head{body.head}, mirror{body.mirror};

  // A plate at 45 degrees on an axis along Y, seen through the slot.
  void plate(double radius, double length) {
    body.mirror_m = radius / 1000;
    Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
    frame.linear() = Eigen::AngleAxisd(std::numbers::pi / 4, V::UnitX()).toRotationMatrix();
    const double r = radius / 1000, thick = 0.004;
    mirror.loft(P::glass, frame, {{-thick, r, r, 0.5 * r}, {thick, r, r, 0.5 * r}});
    mirror.rod(P::metal, mm(0, -length / 2, 0), mm(0, -0.3 * radius, 0), 0.6 * r, 0.5 * r, 10);
  }
  // A small round window in a face that looks along `out`.
  void lens(const V& at, const V& out, double radius) {
    head.rod(P::dark, at - 0.004 * out, at + 0.004 * out, radius / 1000, 0.9 * radius / 1000, 10);
    head.rod(P::glass, at, at + 0.0055 * out, 0.6 * radius / 1000, 0.6 * radius / 1000, 8);
  }
  // A display, or what one works with, in the face that looks along `out`.
  void display(const V& at, const V& out, double wide, double high) {
    body.face_m = at;
    body.face_faces = out;
    body.display_m = {wide / 1000, high / 1000};
    const bool along_x = std::abs(out.x()) > 0.5;
    const V size = along_x ? mm(6, wide, high) : mm(wide, 6, high);
    const V frame = along_x ? mm(4, wide + 12, high + 12) : mm(wide + 12, 4, high + 12);
    head.block(P::dark, at - V(0, 0, frame.z() / 2) + 0.001 * out, frame, 0);
    head.block(P::glass, at - V(0, 0, size.z() / 2) + 0.001 * out, size, 0);
  }
  void lamp(const V& at, const V& out) {
    body.lamp_m = at + 0.004 * out;
    body.lamp_faces = out;
    head.rod(P::metal, at - 0.004 * out, at + 0.003 * out, 0.006, 0.006, 8);
  }
};

// A slab with a slot between two cheeks on a foot plate; cameras all around.
InstrumentBody rtc360() {
  Workshop w;
  w.body.id = "leica-rtc360";
  w.body.foot_m = 0.148;
  w.body.shell = {203, 206, 209};
  w.body.trim = {52, 54, 58};
  w.foot.rod(P::dark, mm(0, 0, -148), mm(0, 0, -132), 0.052, 0.058, 16);
  w.head.block(P::trim, mm(0, 0, -132), mm(112, 232, 30), 0.014);
  w.head.block(P::shell, mm(0, 0, -104), mm(120, 240, 46), 0.022);
  for (const double side : {-1.0, 1.0}) {
    w.head.block(P::shell, mm(0, side * 84, -60), mm(120, 72, 142), 0.022, {0.88, 0.94});
    w.head.block(P::trim, mm(0, side * 46, -58), mm(86, 8, 120), 0.004);
    for (const double front : {-1.0, 1.0}) w.lens(mm(front * 58, side * 84, 22), V(front, 0, 0), 11);
    w.lens(mm(0, side * 119, 44), V(0, side, 0), 9);
  }
  w.lens(mm(59, 0, -84), V::UnitX(), 8);
  w.plate(34, 84);
  w.display(mm(0, 119, -22), V::UnitY(), 56, 92);
  w.lamp(mm(60, 44, -84), V::UnitX());
  return w.body;
}

// A can with a flat top; a gap for the mirror under a cap that two narrow posts carry.
InstrumentBody blk360(const char* id, double radius, double height) {
  Workshop w;
  w.body.id = id;
  w.body.key_ring = true;
  const double top = 38, foot = top - height;
  w.body.foot_m = -foot / 1000;
  w.body.shell = {44, 46, 49};
  w.body.trim = {28, 29, 31};
  const double r = radius / 1000;
  w.foot.rod(P::metal, mm(0, 0, foot), mm(0, 0, foot + 12), 0.8 * r, 0.9 * r, 20);
  w.head.rod(P::shell, mm(0, 0, foot + 12), mm(0, 0, foot + 20), 0.95 * r, r, 24);
  w.head.rod(P::shell, mm(0, 0, foot + 20), mm(0, 0, -26), r, r, 24);
  w.head.rod(P::trim, mm(0, 0, -26), mm(0, 0, -20), 0.94 * r, 0.7 * r, 24);
  w.head.rod(P::shell, mm(0, 0, 24), mm(0, 0, top - 3), r, r, 24);
  w.head.rod(P::trim, mm(0, 0, top - 3), mm(0, 0, top), r, 0.92 * r, 24);
  for (const double side : {-1.0, 1.0}) w.head.block(P::shell, mm(0, side * 0.86 * radius, -26), mm(22, 10, 52), 0);
  w.plate(0.5 * radius, 1.5 * radius);
  for (const double angle : {-0.75, 0.75, 3.14}) {
    const V out(std::cos(angle), std::sin(angle), 0);
    w.lens(out * r + mm(0, 0, -46), out, 8);
  }
  const V front = mm(radius, 0, 0.5 * foot);
  w.body.face_m = front;
  w.head.rod(P::metal, front - mm(6, 0, 0), front + mm(1, 0, 0), 0.019, 0.019, 20);
  w.head.rod(P::trim, front, front + mm(3, 0, 0), 0.013, 0.012, 16);
  w.lamp(front + mm(0.5, 0, 0), V::UnitX());
  return w.body;
}

// A big U with a bar to carry it, on a tribrach.
InstrumentBody pSeries() {
  Workshop w;
  w.body.id = "leica-p-series";
  w.body.mount = Mount::tribrach;
  w.body.heavy_tripod = true;
  w.body.foot_m = 0.235;
  w.body.shell = {214, 216, 214};
  w.body.trim = {60, 63, 66};
  w.foot.rod(P::dark, mm(0, 0, -235), mm(0, 0, -212), 0.072, 0.085, 20);
  w.head.block(P::trim, mm(0, 0, -212), mm(226, 330, 22), 0.03);
  w.head.block(P::shell, mm(0, 0, -192), mm(238, 358, 128), 0.045, {0.86, 1});
  for (const double side : {-1.0, 1.0}) {
    w.head.block(P::shell, mm(0, side * 132, -72), mm(200, 94, 196), 0.035, {0.72, 0.9});
    w.head.block(P::trim, mm(0, side * 84, -60), mm(120, 10, 160), 0.005);
    w.head.block(P::dark, mm(0, side * 104, 120), mm(34, 22, 34), 0.006);
  }
  w.head.block(P::dark, mm(0, 0, 138), mm(36, 232, 22), 0.008);
  w.plate(52, 158);
  w.display(mm(-112, 0, -128), -V::UnitX(), 124, 92);
  w.head.block(P::accent, mm(-113, 96, -160), mm(6, 30, 64), 0);
  w.lamp(mm(113, 0, -128), V::UnitX());
  return w.body;
}

// A landscape brick: two thick shells with an open slot for the mirror between them, the foot below.
InstrumentBody focus() {
  Workshop w;
  w.body.id = "faro-focus";
  w.body.foot_m = 0.112;
  w.body.shell = {226, 228, 231};
  w.body.trim = {46, 62, 92};
  w.foot.rod(P::metal, mm(0, 0, -112), mm(0, 0, -96), 0.034, 0.04, 16);
  w.foot.rod(P::dark, mm(0, 0, -96), mm(0, 0, -84), 0.05, 0.05, 16);
  w.head.block(P::trim, mm(0, 0, -84), mm(92, 150, 40), 0.012);
  for (const double side : {-1.0, 1.0}) {
    w.head.block(P::shell, mm(0, side * 76, -88), mm(103, 78, 160), 0.03, {0.9, 1});
    w.head.block(P::trim, mm(0, side * 36, -44), mm(78, 5, 106), 0);
  }
  w.lens(mm(49, 76, 34), V::UnitX(), 10);
  w.plate(29, 68);
  w.head.rod(P::accent, mm(0, 76, 68), mm(0, 76, 75), 0.011, 0.01, 14);
  w.display(mm(0, -113, -18), -V::UnitY(), 62, 46);
  w.lamp(mm(18, 76, 71), V::UnitZ());
  return w.body;
}

// A tall narrow fork on a round base that holds the collimator.
InstrumentBody x7() {
  Workshop w;
  w.body.id = "trimble-x7";
  w.body.foot_m = 0.213;
  w.body.shell = {62, 64, 68};
  w.body.trim = {32, 33, 36};
  w.foot.rod(P::dark, mm(0, 0, -213), mm(0, 0, -196), 0.066, 0.08, 20);
  w.foot.rod(P::shell, mm(0, 0, -196), mm(0, 0, -128), 0.085, 0.08, 20);
  w.head.block(P::trim, mm(0, 0, -128), mm(148, 160, 14), 0.03);
  w.head.block(P::shell, mm(0, 0, -114), mm(158, 174, 52), 0.034);
  for (const double side : {-1.0, 1.0}) {
    w.head.block(P::shell, mm(0, side * 63, -66), mm(132, 50, 206), 0.026, {0.66, 0.86});
    w.head.block(P::accent, mm(0, side * 87, -48), mm(20, 4, 130), 0);
  }
  w.head.rod(P::trim, mm(0, -40, 0), mm(0, -24, 0), 0.052, 0.046, 18);
  w.plate(30, 74);
  for (const double side : {-1.0, 1.0}) w.lens(mm(62, side * 63, -30), V::UnitX(), 9);
  const V key = mm(79, 0, -90);
  w.body.face_m = key;
  w.head.rod(P::accent, key - mm(3, 0, 0), key + mm(3, 0, 0), 0.013, 0.012, 14);
  w.lamp(mm(79, 28, -90), V::UnitX());
  return w.body;
}

// A drum that widens upwards, with a tall window at its side, two bow handles on the lid and a camera between them.
InstrumentBody vz() {
  Workshop w;
  w.body.id = "riegl-vz";
  w.body.mount = Mount::tribrach;
  w.body.heavy_tripod = true;
  w.body.foot_m = 0.188;
  w.body.fans = 1;
  w.body.shell = {150, 155, 160};
  w.body.trim = {58, 61, 65};
  w.foot.rod(P::metal, mm(0, 0, -188), mm(0, 0, -176), 0.062, 0.078, 20);
  w.foot.rod(P::shell, mm(0, 0, -176), mm(0, 0, -120), 0.08, 0.084, 24);
  for (int socket = 0; socket < 4; ++socket) {
    const double angle = 2.2 + 0.45 * socket;
    const V out(std::cos(angle), std::sin(angle), 0);
    w.foot.rod(P::dark, 0.078 * out + mm(0, 0, -148), 0.094 * out + mm(0, 0, -148), 0.011, 0.011, 10);
  }
  w.head.rod(P::trim, mm(0, 0, -120), mm(0, 0, -112), 0.088, 0.088, 24);
  w.head.rod(P::shell, mm(0, 0, -112), mm(0, 0, 106), 0.088, 0.1, 24);
  w.head.rod(P::trim, mm(0, 0, 106), mm(0, 0, 118), 0.103, 0.092, 24);
  // The window bulges out of the drum; the mirror turns behind it.
  w.head.block(P::trim, mm(82, 0, -86), mm(36, 92, 184), 0.012);
  w.head.block(P::glass, mm(87, 0, -76), mm(32, 66, 164), 0.008);
  for (const double side : {-1.0, 1.0})
    w.head.bow(P::dark, mm(-66, side * 62, 114), mm(66, side * 62, 114), 0.05, 0.016);
  w.head.block(P::dark, mm(8, 0, 118), mm(112, 74, 50), 0.012);
  w.head.rod(P::dark, mm(60, 0, 144), mm(92, 0, 144), 0.027, 0.03, 16);
  w.head.rod(P::glass, mm(84, 0, 144), mm(93, 0, 144), 0.022, 0.022, 12);
  for (int slot = 0; slot < 5; ++slot) w.head.block(P::dark, mm(0, 92, -60 + 16 * slot), mm(60, 8, 7), 0);
  w.display(mm(-95, 0, 20), -V::UnitX(), 92, 56);
  w.head.block(P::trim, mm(-92, 0, -52), mm(12, 80, 26), 0.004);
  w.lamp(mm(-98, 30, -39), -V::UnitX());
  w.body.mirror_m = 0.03;
  return w.body;
}

// Any other: a plain fork.
InstrumentBody plain() {
  Workshop w;
  w.body.id = "generic";
  w.body.mount = Mount::tribrach;
  w.body.heavy_tripod = true;
  w.body.foot_m = 0.18;
  w.body.shell = {178, 182, 187};
  w.body.trim = {78, 82, 88};
  w.foot.rod(P::dark, mm(0, 0, -180), mm(0, 0, -160), 0.06, 0.07, 16);
  w.head.block(P::trim, mm(0, 0, -160), mm(150, 200, 30), 0.02);
  w.head.block(P::shell, mm(0, 0, -132), mm(160, 220, 70), 0.025);
  for (const double side : {-1.0, 1.0})
    w.head.block(P::shell, mm(0, side * 80, -66), mm(130, 60, 170), 0.025, {0.9, 1});
  w.head.block(P::trim, mm(0, 0, 102), mm(118, 220, 20), 0.01);
  w.plate(36, 96);
  w.display(mm(-80, 0, -98), -V::UnitX(), 70, 44);
  w.lamp(mm(80, 40, -98), V::UnitX());
  return w.body;
}

// Instruments whose ids begin so, the first that fits.
constexpr std::array<std::pair<std::string_view, std::string_view>, 8> kLooksLike = {{
    {"leica-rtc360", "leica-rtc360"},
    {"leica-blk360-g1", "leica-blk360-g1"},
    {"leica-blk360", "leica-blk360-g2"},
    {"leica-p", "leica-p-series"},
    {"faro-focus", "faro-focus"},
    {"trimble-x7", "trimble-x7"},
    {"trimble-x9", "trimble-x7"},
    {"riegl-vz", "riegl-vz"},
}};

}  // namespace

std::span<const InstrumentBody> instrumentBodies() {
  static const std::vector<InstrumentBody> all = {
      rtc360(), blk360("leica-blk360-g1", 50, 165), blk360("leica-blk360-g2", 40, 155), pSeries(), focus(), x7(), vz(),
      plain()};
  return all;
}

const InstrumentBody& bodyOf(std::string_view instrument) {
  const auto bodies = instrumentBodies();
  for (const auto& [begins, id] : kLooksLike)
    if (instrument.starts_with(begins))
      return *std::find_if(bodies.begin(), bodies.end(), [&, id = id](const auto& b) { return b.id == id; });
  return bodies.back();
}

BodyColour colourOf(const InstrumentBody& body, BodyPaint paint) {
  switch (paint) {
    case P::shell: return body.shell;
    case P::trim: return body.trim;
    case P::dark: return {34, 36, 39};
    case P::glass: return {16, 24, 34};
    case P::metal: return {138, 143, 148};
    case P::accent: return {196, 64, 44};
    case P::legs: return body.heavy_tripod ? BodyColour{206, 152, 70} : BodyColour{48, 50, 54};
    case P::rubber: return {28, 28, 30};
    case P::clothes: return {92, 108, 130};
  }
  return body.shell;
}

}  // namespace standpoint
