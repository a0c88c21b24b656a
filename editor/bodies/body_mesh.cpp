// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/bodies/body_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace standpoint {

namespace {

using Ring = std::vector<Eigen::Vector3d>;

// Anticlockwise seen from above.
Ring ringOf(const Section& s, const Eigen::Isometry3d& frame, bool cut) {
  const double w = s.wide_m, d = s.deep_m, c = std::min({s.cut_m, s.wide_m, s.deep_m});
  const auto at = [&](double x, double y) { return Eigen::Vector3d(frame * Eigen::Vector3d(x, y, s.along_m)); };
  if (!cut) return {at(w, d), at(-w, d), at(-w, -d), at(w, -d)};
  return {at(w, d - c),   at(w - c, d),   at(-w + c, d), at(-w, d - c),
          at(-w, -d + c), at(-w + c, -d), at(w - c, -d), at(w, -d + c)};
}

// Any frame whose Z goes that way.
Eigen::Isometry3d frameAlong(const Eigen::Vector3d& from, const Eigen::Vector3d& way) {
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  frame.linear() = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), way).toRotationMatrix();
  frame.translation() = from;
  return frame;
}

}  // namespace

// A side between each ring and the next, and a lid at both ends; all rings have as many corners.
void SolidMaker::rings(BodyPaint paint, const std::vector<std::vector<Eigen::Vector3d>>& rings) {
  const auto n = static_cast<std::uint32_t>(rings.front().size());
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const auto& ring : rings)
    for (const auto& p : ring) mesh.positions.emplace_back(p.cast<float>());
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh.triangles.push_back({first + a, first + b, first + c});
    mesh.paints.push_back(paint);
  };
  const auto last = static_cast<std::uint32_t>(rings.size() - 1) * n;
  for (std::uint32_t ring = 0; ring < last; ring += n)
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t j = (i + 1) % n;
      add(ring + i, ring + j, ring + n + j);
      add(ring + i, ring + n + j, ring + n + i);
    }
  for (std::uint32_t i = 1; i + 1 < n; ++i) {
    add(0, i + 1, i);
    add(last, last + i, last + i + 1);
  }
}

void SolidMaker::loft(BodyPaint paint, const Eigen::Isometry3d& frame, const std::vector<Section>& sections) {
  const bool cut = std::any_of(sections.begin(), sections.end(), [](const Section& s) { return s.cut_m > 0; });
  std::vector<Ring> all;
  for (const auto& s : sections) all.push_back(ringOf(s, frame, cut));
  rings(paint, all);
}

void SolidMaker::block(BodyPaint paint, const Eigen::Vector3d& foot_m, const Eigen::Vector3d& size_m, double cut_m,
                       const Eigen::Vector2d& narrowed) {
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  frame.translation() = foot_m;
  const double w = size_m.x() / 2, d = size_m.y() / 2, h = size_m.z();
  const double top_w = w * narrowed.x(), top_d = d * narrowed.y();
  if (cut_m <= 0) return loft(paint, frame, {{0, w, d, 0}, {h, top_w, top_d, 0}});
  const double rim = cut_m / 2;
  loft(paint, frame,
       {{0, w - rim, d - rim, cut_m},
        {rim, w, d, cut_m},
        {h - rim, top_w, top_d, cut_m},
        {h, top_w - rim, top_d - rim, cut_m}});
}

void SolidMaker::rod(BodyPaint paint, const Eigen::Vector3d& from_m, const Eigen::Vector3d& to_m, double from_radius_m,
                     double to_radius_m, int sides) {
  const auto frame = frameAlong(from_m, to_m - from_m);
  const double length = (to_m - from_m).norm();
  std::vector<Ring> both(2);
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * (i + 0.5) / sides;
    const Eigen::Vector3d out(std::cos(angle), std::sin(angle), 0);
    both[0].emplace_back(frame * (from_radius_m * out));
    both[1].emplace_back(frame * (to_radius_m * out + Eigen::Vector3d(0, 0, length)));
  }
  rings(paint, both);
}

void SolidMaker::bow(BodyPaint paint, const Eigen::Vector3d& from_m, const Eigen::Vector3d& to_m, double rise_m,
                     double bar_m) {
  constexpr int kSteps = 8;
  const Eigen::Vector3d middle = (from_m + to_m) / 2, along = (to_m - from_m) / 2, side = along.normalized();
  const Eigen::Vector3d up(0, 0, 1), across = up.cross(side);
  std::vector<Ring> all;
  for (int i = 0; i <= kSteps; ++i) {
    const double angle = std::numbers::pi * i / kSteps;
    const Eigen::Vector3d centre = middle - std::cos(angle) * along + std::sin(angle) * rise_m * up;
    const Eigen::Vector3d out = -std::cos(angle) * side + std::sin(angle) * up;
    const double half = bar_m / 2;
    all.push_back({centre + half * (out + across), centre + half * (-out + across), centre + half * (-out - across),
                   centre + half * (out - across)});
  }
  rings(paint, all);
}

}  // namespace standpoint
