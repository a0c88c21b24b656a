// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/shapes/flaps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <Eigen/Dense>

namespace standpoint::ifc {
namespace {

constexpr double kSheet_m = 2e-5;   // faces closer than this are back to back
constexpr double kLeast_m2 = 1e-5;  // and overlap by more than rounding

struct Flat {
  Eigen::Vector3d normal;
  double offset;
  std::size_t face;
};

Eigen::Vector3d areaVector(const geometry::PolyMesh& mesh, const geometry::Face& face) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const Eigen::Vector3d& o = mesh.points[face.outer.front()];
  for (std::size_t i = 1; i + 1 < face.outer.size(); ++i)
    sum += (mesh.points[face.outer[i]] - o).cross(mesh.points[face.outer[i + 1]] - o);
  return sum / 2;
}

geometry::Region2 inPlane(const geometry::PolyMesh& mesh, const geometry::Face& face, const Eigen::Vector3d& x,
                          const Eigen::Vector3d& y) {
  const auto loop = [&](const std::vector<std::uint32_t>& indices) {
    geometry::Loop2 flat;
    for (const std::uint32_t i : indices) flat.emplace_back(mesh.points[i].dot(x), mesh.points[i].dot(y));
    return flat;
  };
  geometry::Region2 region{loop(face.outer), {}};
  for (const auto& hole : face.holes) region.holes.push_back(loop(hole));
  geometry::normalise(region);
  return region;
}

bool overlap(const geometry::PolyMesh& mesh, const Flat& a, const Flat& b) {
  const Eigen::Vector3d x = a.normal.unitOrthogonal(), y = a.normal.cross(x);
  const geometry::Region2 first = inPlane(mesh, mesh.faces[a.face], x, y),
                          second = inPlane(mesh, mesh.faces[b.face], x, y);
  const auto common = geometry::intersection(std::span(&first, 1), std::span(&second, 1));
  double area = 0;
  if (common)
    for (const auto& part : *common) area += geometry::area(part);
  return area > kLeast_m2;
}

}  // namespace

bool hasFlaps(const geometry::PolyMesh& mesh) {
  std::vector<Flat> flats;
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    if (mesh.faces[i].outer.size() < 3) continue;
    const Eigen::Vector3d area = areaVector(mesh, mesh.faces[i]);
    if (area.norm() < kLeast_m2) continue;
    const Eigen::Vector3d normal = area.normalized();
    flats.push_back({normal, normal.dot(mesh.points[mesh.faces[i].outer.front()]), i});
  }
  // A face and its opposite have offsets of equal size: they are neighbours in that order.
  std::sort(flats.begin(), flats.end(), [](const Flat& a, const Flat& b) {
    return std::pair(std::abs(a.offset), a.face) < std::pair(std::abs(b.offset), b.face);
  });
  for (std::size_t i = 0; i < flats.size(); ++i)
    for (std::size_t j = i + 1; j < flats.size() && std::abs(flats[j].offset) - std::abs(flats[i].offset) < kSheet_m;
         ++j)
      if (flats[i].normal.dot(flats[j].normal) < -1 + 1e-9 && std::abs(flats[i].offset + flats[j].offset) < kSheet_m &&
          overlap(mesh, flats[i], flats[j]))
        return true;
  return false;
}

geometry::PolyMesh grown(geometry::PolyMesh tool, double by_m) {
  std::map<std::array<std::int64_t, 3>, std::vector<Eigen::Vector3d>> normals;  // of the faces at a corner, each once
  const auto key = [&](std::uint32_t i) {
    std::array<std::int64_t, 3> k{};
    for (int c = 0; c < 3; ++c) k[static_cast<std::size_t>(c)] = std::llround(tool.points[i][c] * 1e6);
    return k;
  };
  for (const geometry::Face& face : tool.faces) {
    if (face.outer.size() < 3) continue;
    const Eigen::Vector3d normal = areaVector(tool, face).normalized();
    if (!normal.allFinite()) continue;
    const auto add = [&](const std::vector<std::uint32_t>& loop) {
      for (const std::uint32_t i : loop) {
        auto& known = normals[key(i)];
        if (std::none_of(known.begin(), known.end(), [&](const Eigen::Vector3d& n) { return n.dot(normal) > 0.999; }))
          known.push_back(normal);
      }
    };
    add(face.outer);
    for (const auto& hole : face.holes) add(hole);
  }
  for (std::uint32_t i = 0; i < tool.points.size(); ++i) {
    const auto at = normals.find(key(i));
    if (at == normals.end()) continue;  // no face has it
    Eigen::MatrixXd rows(at->second.size(), 3);
    for (std::size_t k = 0; k < at->second.size(); ++k)
      rows.row(static_cast<Eigen::Index>(k)) = at->second[k].transpose();
    const Eigen::Vector3d move =
        rows.completeOrthogonalDecomposition().solve(Eigen::VectorXd::Constant(rows.rows(), by_m));
    tool.points[i] += move * std::min(1.0, 10 * by_m / std::max(move.norm(), 1e-300));
  }
  return tool;
}

}  // namespace standpoint::ifc
