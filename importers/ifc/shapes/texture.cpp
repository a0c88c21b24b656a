// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/shapes/texture.h"

#include <algorithm>

#include "importers/ifc/model/model.h"
#include "importers/ifc/shapes/curve.h"
#include "importers/ifc/shapes/faceted.h"
#include "importers/ifc/shapes/placement.h"

namespace standpoint::ifc {
namespace {

Eigen::Vector2d pair(const Value& list) {
  Eigen::Vector2d p = Eigen::Vector2d::Zero();
  int i = 0;
  for (const Value v : list)
    if (i < 2) p[i++] = v.number(0);
  return p;
}

// One face's indices into a list that counts from 1; none when one of them leaves it.
std::vector<std::uint32_t> indices(const Value& list, std::size_t count) {
  std::vector<std::uint32_t> found;
  for (const Value v : list)
    if (const auto i = v.integer(); i >= 1 && i <= static_cast<std::int64_t>(count))
      found.push_back(static_cast<std::uint32_t>(i - 1));
    else
      return {};
  return found;
}

}  // namespace

// The texture's transformation in 2D; IFC counts upwards from the lower left corner, glTF downwards from the upper
// left.
Eigen::Vector2d onPicture(const Eigen::Vector2d& st, const Entity& texture) {
  Eigen::Vector2d p = st;
  if (const Entity t = texture.ref(3)) {
    Eigen::Vector2d x = pair(t.ref(0)[0]);
    if (x.norm() < 1e-12) x = Eigen::Vector2d::UnitX();
    x.normalize();
    const Eigen::Vector2d y(-x.y(), x.x());
    const double scale = t[3].number(1);
    p = pair(t.ref(2)[0]) + scale * (p.x() * x + p.y() * y);
  }
  return {p.x(), 1 - p.y()};
}

std::optional<Eigen::Vector2d> TexturedFace::at(const Eigen::Vector3d& p) const {
  if (corners.size() < 3) return {};
  constexpr double kSame_m = 1e-4;
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < corners.size(); ++i)
    if ((corners[i] - p).squaredNorm() < (corners[nearest] - p).squaredNorm()) nearest = i;
  if ((corners[nearest] - p).norm() < kSame_m) return coordinates[nearest];
  // The widest triangle at the first corner.
  const Eigen::Vector3d& o = corners[0];
  std::size_t a = 1, b = 2;
  double widest = 0;
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    if (const double w = (corners[i] - o).cross(corners[i + 1] - o).norm(); w > widest) widest = w, a = i, b = i + 1;
  if (widest < 1e-12) return {};
  const Eigen::Vector3d u = corners[a] - o, v = corners[b] - o, normal = u.cross(v).normalized(), d = p - o;
  if (std::abs(d.dot(normal)) > 1e-3) return {};
  const double s = d.cross(v).dot(normal) / u.cross(v).dot(normal), t = u.cross(d).dot(normal) / u.cross(v).dot(normal);
  return coordinates[0] + s * (coordinates[a] - coordinates[0]) + t * (coordinates[b] - coordinates[0]);
}

TexturedItem::TexturedItem(const TextureMaps::Source& source, const Entity& texture, const Model& model) {
  const Entity item = model.file.entity(source.item), map = model.file.entity(source.map);
  if (map.is("IFCTEXTUREMAP"))
    readFace(item, map, model);
  else
    readFaceSet(item, map, model);
  for (auto& c : coordinates_) c = onPicture(c, texture);
}

void TexturedItem::readFaceSet(const Entity& face_set, const Entity& map, const Model& model) {
  Scope scope(model);
  points_ = pointList(face_set.ref(0), scope);
  const Value list = map.ref(2)[0];
  for (const Value v : list) coordinates_.push_back(pair(v));
  const bool polygonal = face_set.is("IFCPOLYGONALFACESET");
  std::vector<std::uint32_t> through;  // PnIndex
  for (const Value v : pnIndex(face_set)) through.push_back(static_cast<std::uint32_t>(v.integer()));
  const auto corners = [&](const Value& of_face) {
    Indices at = indices(of_face, through.empty() ? points_.size() : through.size());
    for (auto& i : at)
      if (!through.empty()) i = through[i] - 1;
    if (std::any_of(at.begin(), at.end(), [&](std::uint32_t i) { return i >= points_.size(); })) at.clear();
    return at;
  };
  if (!polygonal) {
    for (const Value row : face_set[3]) corners_.push_back(corners(row));
    for (const Value row : map[3]) on_.push_back(indices(row, coordinates_.size()));
    if (on_.empty()) on_ = corners_;  // textured point by point
    return;
  }
  std::map<Id, Indices> on_of_polygon;  // the map is a set: each entry says whose it is
  for (const Entity& entry : map.refs(3))
    on_of_polygon.emplace(entry[1].reference(), indices(entry[0], coordinates_.size()));
  for (const Entity& polygon : face_set.refs(2)) {
    corners_.push_back(corners(polygon[0]));
    on_.push_back(on_of_polygon[polygon.id()]);
  }
}

void TexturedItem::readFace(const Entity& face, const Entity& map, const Model& model) {
  Scope scope(model);
  Indices all;
  for (const Entity& bound : face.refs(0))
    for (const Entity& point : bound.ref(0).refs(0)) {
      all.push_back(static_cast<std::uint32_t>(points_.size()));
      points_.push_back(cartesianPoint(point, scope));
    }
  for (const Entity& vertex : map.refs(1)) coordinates_.push_back(pair(vertex[0]));
  corners_ = {all};
  on_ = {all.size() <= coordinates_.size() ? all : Indices()};
}

TexturedFace TexturedItem::face(std::size_t number) const {
  TexturedFace found;
  if (number >= corners_.size() || number >= on_.size() || corners_[number].size() != on_[number].size()) return found;
  for (std::size_t i = 0; i < corners_[number].size(); ++i) {
    if (on_[number][i] >= coordinates_.size()) return {};
    found.corners.push_back(points_[corners_[number][i]]);
    found.coordinates.push_back(coordinates_[on_[number][i]]);
  }
  return found;
}

}  // namespace standpoint::ifc
