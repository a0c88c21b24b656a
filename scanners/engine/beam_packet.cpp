// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/engine/beam_packet.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/portable_math.h"
#include "scanners/math/target_clones.h"

namespace standpoint {

namespace {

constexpr float kNowhere_m = 1e15F;
constexpr double kSpan = 0.94;          // cosine of the angle between the first beam and those together with it
constexpr float kNearest_m = 1e-3F;     // ahead of a beam's origin
constexpr double kRounding = 2e-6;      // of coordinates in single precision and what is made of them
constexpr float kTurnRounding = 1e-6F;  // of the product of two lengths

// A box is in front of a plane if its corner that is farthest along the normal is.
STANDPOINT_INLINE std::uint32_t inFront(const EightBoxes& boxes, const BeamPacket::Pyramid& pyramid) {
  std::uint32_t bits[kEight];
  for (unsigned k = 0; k < kEight; ++k) bits[k] = 1U << k;
  for (int plane = 0; plane < BeamPacket::Pyramid::kPlanes; ++plane) {
    const float *normal = pyramid.normal[plane], least = pyramid.least[plane];
    const float* x = normal[0] > 0 ? boxes.high[0] : boxes.low[0];
    const float* y = normal[1] > 0 ? boxes.high[1] : boxes.low[1];
    const float* z = normal[2] > 0 ? boxes.high[2] : boxes.low[2];
    for (unsigned k = 0; k < kEight; ++k)
      bits[k] = normal[0] * x[k] + normal[1] * y[k] + normal[2] * z[k] >= least ? bits[k] : 0;
  }
  std::uint32_t found = 0;
  for (const std::uint32_t bit : bits) found |= bit;
  return found;
}

// An edge is outside where both ends are behind one plane, or where the pyramid is on one side of the plane through
// apex and edge: its corners are, by more than `aside_m` as near as the edge comes.
STANDPOINT_INLINE std::uint32_t inside(const EightEdges& edges, const BeamPacket::Pyramid& pyramid) {
  std::uint32_t bits[kEight];
  for (unsigned k = 0; k < kEight; ++k) bits[k] = 1U << k;
  for (int plane = 0; plane < BeamPacket::Pyramid::kPlanes; ++plane) {
    const float *n = pyramid.normal[plane], least = pyramid.least[plane];
    for (unsigned k = 0; k < kEight; ++k) {
      const float from = n[0] * edges.from[0][k] + n[1] * edges.from[1][k] + n[2] * edges.from[2][k];
      const float to = n[0] * edges.to[0][k] + n[1] * edges.to[1][k] + n[2] * edges.to[2][k];
      bits[k] = std::max(from, to) >= least ? bits[k] : 0;
    }
  }
  const auto& axes = pyramid.axes;
  for (unsigned k = 0; k < kEight; ++k) {
    const float x = edges.from[0][k] - pyramid.apex[0], dx = edges.to[0][k] - edges.from[0][k];
    const float y = edges.from[1][k] - pyramid.apex[1], dy = edges.to[1][k] - edges.from[1][k];
    const float z = edges.from[2][k] - pyramid.apex[2], dz = edges.to[2][k] - edges.from[2][k];
    const float across = axes[0][0] * x + axes[0][1] * y + axes[0][2] * z;
    const float upward = axes[1][0] * x + axes[1][1] * y + axes[1][2] * z;
    const float ahead = axes[2][0] * x + axes[2][1] * y + axes[2][2] * z;
    const float d_across = axes[0][0] * dx + axes[0][1] * dy + axes[0][2] * dz;
    const float d_upward = axes[1][0] * dx + axes[1][1] * dy + axes[1][2] * dz;
    const float d_ahead = axes[2][0] * dx + axes[2][1] * dy + axes[2][2] * dz;
    const float u = upward * d_ahead - ahead * d_upward, v = ahead * d_across - across * d_ahead;
    const float w = across * d_upward - upward * d_across;  // the plane's normal
    const float most =
        w + std::max(u * pyramid.low[0], u * pyramid.high[0]) + std::max(v * pyramid.low[1], v * pyramid.high[1]);
    const float least =
        w + std::min(u * pyramid.low[0], u * pyramid.high[0]) + std::min(v * pyramid.low[1], v * pyramid.high[1]);
    const float size = (std::abs(across) + std::abs(upward) + std::abs(ahead)) *
                       (std::abs(d_across) + std::abs(d_upward) + std::abs(d_ahead));
    const float beside = std::max(0.0F, std::max(least, -most) - kTurnRounding * size);
    const float off = beside * std::max(0.0F, std::min(ahead, ahead + d_ahead) - pyramid.aside_m);
    const float allowed = pyramid.aside_m * pyramid.aside_m * (u * u + v * v + w * w);
    bits[k] = off * off <= allowed ? bits[k] : 0;
  }
  std::uint32_t found = 0;
  for (const std::uint32_t bit : bits) found |= bit;
  return found;
}

// A half more than the square of a beam's radius is more than what single precision loses.
STANDPOINT_INLINE std::uint32_t nearLanes(const BeamPacket::Lanes& b, const float* from, const float* to) {
  constexpr auto kMost = static_cast<float>(1.5 * kBeamEdge * kBeamEdge / 4);
  std::uint32_t bits[kPacket];
  for (int k = 0; k < kPacket; ++k) {
    const float fx = from[0] - b.origin[0][k], fy = from[1] - b.origin[1][k], fz = from[2] - b.origin[2][k];
    const float tx = to[0] - b.origin[0][k], ty = to[1] - b.origin[1][k], tz = to[2] - b.origin[2][k];
    const float f = b.direction[0][k] * fx + b.direction[1][k] * fy + b.direction[2][k] * fz;
    const float t = b.direction[0][k] * tx + b.direction[1][k] * ty + b.direction[2][k] * tz;
    const float f_near = 1 / std::max(f, kNearest_m), t_near = 1 / std::max(t, kNearest_m);
    const float u = (b.across[0][k] * fx + b.across[1][k] * fy + b.across[2][k] * fz) * f_near;
    const float v = (b.upward[0][k] * fx + b.upward[1][k] * fy + b.upward[2][k] * fz) * f_near;
    const float du = (b.across[0][k] * tx + b.across[1][k] * ty + b.across[2][k] * tz) * t_near - u;
    const float dv = (b.upward[0][k] * tx + b.upward[1][k] * ty + b.upward[2][k] * tz) * t_near - v;
    const float square = du * du + dv * dv, toward = -(u * du + v * dv) / std::max(square, 1e-30F);
    const float along = toward > 0 ? (toward < 1 ? toward : 1) : 0;
    const float x = u + along * du, y = v + along * dv, nearness = f_near + along * (t_near - f_near);
    const float exit = b.exit_m * nearness;
    const bool beside = x * x + y * y <= kMost * (exit * exit + b.divergence_rad * b.divergence_rad);
    const bool cut = (f < kNearest_m) != (t < kNearest_m);
    bits[k] = beside || cut ? 1U << static_cast<unsigned>(k) : 0;
  }
  std::uint32_t lanes = 0;
  for (const std::uint32_t bit : bits) lanes |= bit;
  return lanes;
}

STANDPOINT_CLONES void roundBeams(const BeamLanes& from, BeamPacket::Lanes& to) {
  const double centre[3] = {static_cast<double>(to.centre[0]), static_cast<double>(to.centre[1]),
                            static_cast<double>(to.centre[2])};
  const auto round = [](const double* of, double less, float* rounded) {
    for (int k = 0; k < kPacket; ++k) rounded[k] = static_cast<float>(of[k] - less);
  };
  const auto roundAll = [&round](const VectorLanes& of, const double* less, float(*rounded)[kPacket]) {
    round(of.x, less[0], rounded[0]), round(of.y, less[1], rounded[1]), round(of.z, less[2], rounded[2]);
  };
  constexpr double kNothing[3] = {};
  roundAll(from.axes.origin, centre, to.origin), roundAll(from.axes.direction, kNothing, to.direction);
  roundAll(from.across, kNothing, to.across), roundAll(from.upward, kNothing, to.upward);
}

std::uint32_t firstOf(std::uint32_t lanes) { return static_cast<std::uint32_t>(std::countr_zero(lanes)); }

STANDPOINT_CLONES std::uint32_t meetBoxes(const EightBoxes& boxes, const BeamPacket::Pyramid& pyramid) {
  return inFront(boxes, pyramid);
}
STANDPOINT_CLONES std::uint32_t meetEdges(const EightEdges& edges, const BeamPacket::Pyramid& pyramid) {
  return inside(edges, pyramid);
}
STANDPOINT_CLONES std::uint32_t meetLanes(const BeamPacket::Lanes& beams, const float* from, const float* to) {
  return nearLanes(beams, from, to);
}

}  // namespace

EightBoxes::EightBoxes() {
  std::fill_n(low[0], 3 * kEight, kNowhere_m);
  std::fill_n(high[0], 3 * kEight, -kNowhere_m);
}

EightEdges::EightEdges() {
  std::fill_n(from[0], 3 * kEight, kNowhere_m);
  std::fill_n(to[0], 3 * kEight, kNowhere_m);
}

void BeamPacket::set(std::uint32_t lanes, const BeamLanes& beams, double farthest_coordinate_m) {
  const Eigen::Vector3f centre = beams.axes.origin.at(firstOf(lanes)).cast<float>();
  std::copy_n(centre.data(), 3, lanes_.centre);
  rounding_m_ = kRounding * (farthest_coordinate_m + static_cast<double>(centre.cwiseAbs().maxCoeff()));
  lanes_.exit_m = static_cast<float>(instrument_.exit_diameter_m + rounding_m_);
  lanes_.divergence_rad = static_cast<float>(instrument_.divergence_rad);
  beams_ = beams;
  roundBeams(beams, lanes_);
}

std::uint32_t BeamPacket::together(std::uint32_t lanes) const {
  const Eigen::Vector3d first = beams_.axes.direction.at(firstOf(lanes));
  std::uint32_t found = 0;
  forLanes(lanes, [&](std::uint32_t k) {
    if (beams_.axes.direction.at(k).dot(first) >= kSpan) found |= 1U << k;
  });
  return found;
}

// A beam is 0.75 (D + γR) about its axis at most (footprint.h): what it holds leans by tan δ = 0.75 γ, and is 0.75 D
// aside of that. Leaning by δ changes the tangent of an angle θ by sin δ / (cos θ cos(θ + δ)) at most.
void BeamPacket::narrow(std::uint32_t lanes, double reach_m) {
  narrowed_ = lanes, reach_m_ = reach_m;
  const Beam first = beam(firstOf(lanes)), last = beam(static_cast<std::uint32_t>(std::bit_width(lanes)) - 1);
  const Eigen::Vector3d apex = 0.5 * (first.origin + last.origin);
  Eigen::Vector3d axes[3];
  axes[2] = (first.direction + last.direction).normalized();
  const Eigen::Vector3d turned = last.direction - first.direction, across = turned - turned.dot(axes[2]) * axes[2];
  axes[0] = across.norm() > 1e-6 ? Eigen::Vector3d(across.normalized()) : axes[2].unitOrthogonal();
  axes[1] = axes[2].cross(axes[0]);
  double low[2] = {1e9, 1e9}, high[2] = {-1e9, -1e9}, cosine = 1, spread = 0;
  forLanes(lanes, [&](std::uint32_t k) {
    const Eigen::Vector3d direction = beams_.axes.direction.at(k);
    const double ahead = direction.dot(axes[2]);
    for (int i = 0; i < 2; ++i) {
      const double place = direction.dot(axes[i]) / ahead;
      low[i] = std::min(low[i], place), high[i] = std::max(high[i], place);
    }
    cosine = std::min(cosine, ahead);
    spread = std::max(spread, (beams_.axes.origin.at(k) - apex).norm());
  });
  const double leaning = kBeamEdge * instrument_.divergence_rad / 2, sine = std::sqrt(1 - cosine * cosine);
  const double leans = leaning / (cosine * (cosine - sine * leaning)) + 1e-7;
  const double aside_m = kBeamEdge * instrument_.exit_diameter_m / 2 + spread + rounding_m_;
  const auto set = [&](int plane, const Eigen::Vector3d& inward, double from_apex_m) {
    const Eigen::Vector3d unit = inward.normalized();
    for (int i = 0; i < 3; ++i) pyramid_.normal[plane][i] = static_cast<float>(unit[i]);
    pyramid_.least[plane] = static_cast<float>(unit.dot(apex) - from_apex_m - aside_m);
  };
  for (int i = 0; i < 2; ++i) {
    low[i] -= leans, high[i] += leans;
    pyramid_.low[i] = static_cast<float>(low[i]), pyramid_.high[i] = static_cast<float>(high[i]);
    set(2 * i, axes[i] - low[i] * axes[2], 0);
    set(2 * i + 1, high[i] * axes[2] - axes[i], 0);
  }
  set(4, -axes[2], reach_m * std::sqrt(1 + leaning * leaning));
  for (int i = 0; i < 3; ++i) {
    pyramid_.apex[i] = static_cast<float>(apex[i]);
    for (int k = 0; k < 3; ++k) pyramid_.axes[i][k] = static_cast<float>(axes[i][k]);
  }
  pyramid_.aside_m = static_cast<float>(aside_m);
}

std::uint32_t BeamPacket::meets(const EightBoxes& boxes) const { return meetBoxes(boxes, pyramid_); }
std::uint32_t BeamPacket::meets(const EightEdges& edges) const { return meetEdges(edges, pyramid_); }

std::uint32_t BeamPacket::near(const EightEdges& edges, std::uint32_t edge) const {
  float from[3], to[3];
  for (int i = 0; i < 3; ++i) {
    from[i] = edges.from[i][edge] - lanes_.centre[i];
    to[i] = edges.to[i][edge] - lanes_.centre[i];
  }
  return narrowed_ & meetLanes(lanes_, from, to);
}

}  // namespace standpoint
