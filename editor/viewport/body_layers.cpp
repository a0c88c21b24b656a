// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/viewport/body_layers.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <vtkMatrix4x4.h>
#include <vtkProperty.h>

#include "editor/bodies/tripod.h"
#include "editor/viewport/texture.h"

namespace standpoint {

namespace {

using Eigen::Vector3d;

void append(MergedTriangles& all, const BodyMesh& mesh, const InstrumentBody& body,
            const Eigen::Isometry3d& local_from_mesh) {
  const auto first = static_cast<std::int64_t>(all.positions.size() / 3);
  for (const auto& p : mesh.positions) {
    const Vector3d q = local_from_mesh * p.cast<double>();
    for (const double x : {q.x(), q.y(), q.z()}) all.positions.push_back(static_cast<float>(x));
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (const auto corner : mesh.triangles[i]) all.corners.push_back(first + corner);
    const auto colour = colourOf(body, mesh.paints[i]);
    all.colours.push_back({colour[0], colour[1], colour[2], 255});
  }
}

Eigen::Isometry3d placeOf(const StandingInstrument& s) {
  Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
  place.linear() = s.rotation.toRotationMatrix();
  place.translation() = s.centre_m;
  return place;
}

// Upright, and turned as the instrument is.
Eigen::Isometry3d uprightPlaceOf(const StandingInstrument& s) {
  const Vector3d ahead = s.rotation * Vector3d::UnitX();
  Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
  place.linear() = Eigen::AngleAxisd(std::atan2(ahead.y(), ahead.x()), Vector3d::UnitZ()).toRotationMatrix();
  place.translation() = s.centre_m;
  return place;
}

// However it leans and turns.
Bounds boundsOf(const StandingInstrument& s) {
  constexpr double kReach_m = 0.4;
  const double legs_m = std::max(kReach_m, 0.5 * s.height_m);
  return {s.centre_m - Vector3d(legs_m, legs_m, std::max(kReach_m, s.height_m)),
          s.centre_m + Vector3d(legs_m, legs_m, kReach_m)};
}

// However it tilts, with what bears it.
Bounds boundsOf(const CarriedInstrument& instrument) {
  constexpr double kReach_m = 2.5;  // of a car
  const Vector3d& at = instrument.pose.translation;
  return {at - Vector3d(kReach_m, kReach_m, kReach_m + instrument.height_m),
          at + Vector3d(kReach_m, kReach_m, kReach_m)};
}

Eigen::Isometry3d turnedBy(double head_rad) {
  return Eigen::Isometry3d(Eigen::AngleAxisd(-head_rad, Vector3d::UnitZ()));
}

// Triangles whose colour runs from corner to corner.
struct GlowMaker {
  MergedTriangles& all;
  Eigen::Isometry3d place;

  std::int64_t corner(const Vector3d& p, const LampColour& colour, double alpha) {
    const Vector3d q = place * p;
    for (const double x : {q.x(), q.y(), q.z()}) all.positions.push_back(static_cast<float>(x));
    all.colours.push_back({colour[0], colour[1], colour[2], static_cast<std::uint8_t>(std::lround(alpha))});
    return static_cast<std::int64_t>(all.positions.size() / 3) - 1;
  }
  void triangle(std::int64_t a, std::int64_t b, std::int64_t c) {
    for (const auto i : {a, b, c}) all.corners.push_back(i);
  }
  // Around `centre`, in the plane of both axes: between two radii, from step to step of `steps` in a whole turn.
  void ring(const Vector3d& centre, const Vector3d& x, const Vector3d& y, std::array<double, 2> radii,
            std::array<double, 2> alphas, const LampColour& colour, int first, int end, int steps) {
    std::int64_t before[2] = {0, 0};
    for (int i = first; i <= end; ++i) {
      const double angle = 2 * std::numbers::pi * i / steps;
      const Vector3d out = std::cos(angle) * x + std::sin(angle) * y;
      const std::int64_t now[2] = {corner(centre + radii[0] * out, colour, alphas[0]),
                                   corner(centre + radii[1] * out, colour, alphas[1])};
      if (i > first) {
        triangle(before[0], before[1], now[1]);
        triangle(before[0], now[1], now[0]);
      }
      before[0] = now[0];
      before[1] = now[1];
    }
  }
};

vtkSmartPointer<vtkTexture> textureOf(const PixelPicture& picture) {
  std::vector<Rgba> from_below;
  const auto width = static_cast<std::ptrdiff_t>(picture.width);
  for (auto row = picture.height - 1; row >= 0; --row)
    from_below.insert(from_below.end(), picture.rgba.begin() + row * width, picture.rgba.begin() + (row + 1) * width);
  for (auto& pixel : from_below) pixel[3] = 255;
  return clampedTexture(picture.width, picture.height, from_below);
}

constexpr LampColour kBeam = {255, 70, 54};
constexpr double kNearAlpha = 66, kFarAlpha = 30;

void addLamp(GlowMaker& make, const InstrumentBody& body, const WorkingMotion& motion) {
  constexpr int kSteps = 16;
  const Vector3d& out = body.lamp_faces;
  const Vector3d x = std::abs(out.z()) > 0.9 ? Vector3d::UnitX() : Vector3d(-out.y(), out.x(), 0);
  const Vector3d y = out.cross(x);
  const Vector3d centre = body.lamp_m + 0.002 * out;
  if (body.key_ring)
    for (int i = 0; i < kRingSegments; ++i) {
      const bool lit = (i - motion.ring_from + kRingSegments) % kRingSegments < motion.ring_lit;
      if (lit) make.ring(centre, x, y, {0.0145, 0.0185}, {255, 255}, *motion.lamp, i, i + 1, kRingSegments);
    }
  else
    make.ring(centre, x, y, {0, 0.006}, {255, 255}, *motion.lamp, 0, kSteps, kSteps);
  const double inner = body.key_ring ? 0.0185 : 0.006;
  make.ring(centre, x, y, {inner, 4 * inner}, {130, 0}, *motion.lamp, 0, kSteps, kSteps);
}

// What a plate that turns some fifty times a second leaves of itself.
void addBlur(GlowMaker& make, double radius) {
  constexpr LampColour kBlur = {150, 160, 172};
  const Vector3d x = Vector3d::UnitX(), z = Vector3d::UnitZ();
  make.ring(Vector3d::Zero(), x, z, {0, 0.75 * radius}, {70, 120}, kBlur, 0, 24, 24);
  make.ring(Vector3d::Zero(), x, z, {0.75 * radius, 1.02 * radius}, {120, 40}, kBlur, 0, 24, 24);
}

void addFan(GlowMaker& make, const SweepFan& fan) {
  const auto origin = make.corner(Vector3d::Zero(), kBeam, kNearAlpha);
  const auto steps = fan.ranges_m.size() - 1;
  std::int64_t before = 0;
  for (std::size_t i = 0; i <= steps; ++i) {
    const double elevation =
        fan.from_rad + (fan.to_rad - fan.from_rad) * static_cast<double>(i) / static_cast<double>(steps);
    const Vector3d way(std::cos(fan.azimuth_rad) * std::cos(elevation),
                       -std::sin(fan.azimuth_rad) * std::cos(elevation), std::sin(elevation));
    const auto now = make.corner(static_cast<double>(fan.ranges_m[i]) * way, kBeam, kFarAlpha);
    if (i > 0) make.triangle(origin, before, now);
    before = now;
  }
}

}  // namespace

MergedTriangles mergeStanding(const std::vector<StandingInstrument>& still, const StandingInstrument* working) {
  MergedTriangles all;
  for (const auto& s : still) {
    append(all, tripodOf(*s.body, s.height_m), *s.body, uprightPlaceOf(s));
    for (const auto* part : {&s.body->foot, &s.body->head, &s.body->mirror}) append(all, *part, *s.body, placeOf(s));
  }
  if (working != nullptr) {
    append(all, tripodOf(*working->body, working->height_m), *working->body, uprightPlaceOf(*working));
    append(all, working->body->foot, *working->body, placeOf(*working));
  }
  return all;
}

MergedTriangles mergeUnderWay(const std::vector<CarriedInstrument>& carried) {
  MergedTriangles all;
  for (const auto& instrument : carried) {
    Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
    place.linear() = instrument.pose.rotation.toRotationMatrix();
    place.translation() = instrument.pose.translation;
    append(all, instrument.body->look.head, instrument.body->look, place);
    append(all, bearerOf(instrument), instrument.body->look, Eigen::Isometry3d::Identity());
  }
  return all;
}

MergedTriangles mergeHead(const InstrumentBody& body, bool mirror_turns) {
  MergedTriangles all;
  append(all, body.head, body, Eigen::Isometry3d::Identity());
  if (!mirror_turns) append(all, body.mirror, body, Eigen::Isometry3d::Identity());
  return all;
}

PaintedTriangles mergeDisplay(const InstrumentBody& body, const PixelPicture& shown) {
  constexpr double kProud_m = 0.0045;  // of the glass and its frame
  const double aspect = static_cast<double>(shown.width) / shown.height;
  const double high = std::min(body.display_m.y(), body.display_m.x() / aspect), wide = high * aspect;
  const Vector3d up = Vector3d::UnitZ(), right = up.cross(body.face_faces);
  const Vector3d middle = body.face_m + kProud_m * body.face_faces;
  PaintedTriangles painted;
  painted.unlit = true;
  for (const auto& [u, v] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}) {
    const Vector3d p = middle + (u - 0.5) * wide * right + (v - 0.5) * high * up;
    for (const double x : {p.x(), p.y(), p.z()}) painted.triangles.positions.push_back(static_cast<float>(x));
    painted.coordinates.push_back(static_cast<float>(u));
    painted.coordinates.push_back(static_cast<float>(v));
  }
  for (const std::int64_t corner : {0, 1, 2, 0, 2, 3}) painted.triangles.corners.push_back(corner);
  painted.triangles.colours.assign(2, {255, 255, 255, 255});
  return painted;
}

MergedTriangles mergeGlow(const WorkingInstrument& working) {
  MergedTriangles all;
  all.graded = true;
  const auto place = placeOf(working.stands);
  const auto& body = *working.stands.body;
  GlowMaker in_head{all, place * turnedBy(working.motion.head_rad)};
  if (working.motion.mirror_turns && !body.mirror.triangles.empty()) addBlur(in_head, body.mirror_m);
  GlowMaker in_scanner{all, place};
  for (const auto& fan : working.motion.fans)
    if (fan.ranges_m.size() > 1) addFan(in_scanner, fan);
  if (working.motion.lamp) addLamp(in_head, body, working.motion);
  return all;
}

BodyLayers::BodyLayers() {
  solids_.drawSurface(0);
  head_.drawSurface(0);
  display_.drawSurface(-1);
  under_way_.drawSurface(0);
  glow_.drawSurface(0);
  glow_.light(false);
  glow_.actor->ForceTranslucentOn();
  for (Layer* layer : {&solids_, &head_, &display_, &glow_, &under_way_}) layer->hide();
}

void BodyLayers::addSolids(vtkRenderer* renderer) const {
  for (const Layer* layer : {&solids_, &head_, &display_, &under_way_}) renderer->AddActor(layer->actor);
}

bool BodyLayers::moves(const vtkProp* prop) const {
  return prop == head_.actor.Get() || prop == display_.actor.Get() || prop == glow_.actor.Get();
}

void BodyLayers::addGlow(vtkRenderer* renderer) const { renderer->AddActor(glow_.actor); }

void BodyLayers::update(const ViewState& state, const ViewState* last) {
  const auto& working = state.working;
  const bool same_place = last != nullptr && last->working.has_value() == working.has_value() &&
                          (!working || last->working->stands == working->stands);
  if (!same_place || last->instruments != state.instruments) {
    static const std::vector<StandingInstrument> kNone;
    const auto& still = state.instruments ? state.instruments->still : kNone;
    solids_.hide();
    if (!still.empty() || working) solids_.show(mergeStanding(still, working ? &working->stands : nullptr));
    standing_bounds_ = {};
    for (const auto& s : still) standing_bounds_.extend(boundsOf(s));
    if (working) standing_bounds_.extend(boundsOf(working->stands));
  }
  if (last == nullptr || last->under_way != state.under_way) {
    under_way_.hide();
    if (state.under_way) under_way_.show(mergeUnderWay(state.under_way->carried));
  }
  bounds_ = standing_bounds_;
  if (state.under_way)
    for (const auto& instrument : state.under_way->carried) bounds_.extend(boundsOf(instrument));
  if (last != nullptr && last->working == working && last->display == state.display) return;
  head_.reveal(working.has_value());
  display_.hide();
  glow_.hide();
  if (!working) return;
  if (head_of_ != working->stands.body || head_without_mirror_ != working->motion.mirror_turns) {
    head_of_ = working->stands.body;
    head_without_mirror_ = working->motion.mirror_turns;
    head_.show(mergeHead(*head_of_, head_without_mirror_));
  }
  const Eigen::Matrix4d place = (placeOf(working->stands) * turnedBy(working->motion.head_rad)).matrix();
  vtkNew<vtkMatrix4x4> matrix;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) matrix->SetElement(row, column, place(row, column));
  head_.actor->SetUserMatrix(matrix);
  display_.actor->SetUserMatrix(matrix);
  if (state.display && (last == nullptr || last->display != state.display || !display_.filled))
    display_.show(mergeDisplay(*head_of_, *state.display), textureOf(*state.display));
  display_.reveal(state.display != nullptr);
  glow_.show(mergeGlow(*working));
}

}  // namespace standpoint
