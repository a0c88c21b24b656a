// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/walk/obstacles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <BulletCollision/BroadphaseCollision/btDbvt.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/CollisionShapes/btConvexPointCloudShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpa2.h>

#include "optimizer/surface/triangle_distance.h"

namespace standpoint {

namespace {

using Eigen::Vector3d;

constexpr double kContact = 1e-5;  // m; this near is contact
constexpr double kSliding = 1e-6;  // approach for each metre of way that is no approach
constexpr double kDeepest = 1e-3;  // m; a body this far in something is stuck, wherever it goes
constexpr int kMostAdvances = 100;

btVector3 toBullet(const Vector3d& p) { return {p.x(), p.y(), p.z()}; }
Vector3d fromBullet(const btVector3& p) { return {p.x(), p.y(), p.z()}; }

// The middle line of a capsule: its radius is ours, as Bullet would make a margin of it.
class Core : public btConvexPointCloudShape {
 public:
  Core(const Body& body, const Vector3d& feet) : low(feet + Vector3d(0, 0, body.radius_m)), high(low) {
    high.z() = std::max(low.z(), feet.z() + body.height_m - body.radius_m);
    setMargin(0);
    ends_[0] = btVector3(0, 0, 0);
    ends_[1] = btVector3(0, 0, high.z() - low.z());
    setPoints(ends_, 2, false);
  }
  Vector3d low, high;  // local frame

 private:
  btVector3 ends_[2];
};

btTransform at(const Vector3d& p) { return btTransform(btMatrix3x3::getIdentity(), toBullet(p)); }

struct Visitor final : btDbvt::ICollide {
  const std::function<void(std::uint32_t)>* visit = nullptr;
  void Process(const btDbvtNode* leaf) override { (*visit)(static_cast<std::uint32_t>(leaf->dataAsInt)); }
};

}  // namespace

struct Obstacles::World {
  // One convex thing: a whole shape, or one triangle of a mesh.
  struct Item {
    std::uint32_t shape = 0;
    std::int32_t triangle = -1;
  };
  struct Shape {
    std::uint32_t product = 0;
    std::unique_ptr<btConvexHullShape> hull;  // null: a mesh
    std::vector<Vector3d> positions;
    std::vector<Triangle> triangles;
  };
  std::vector<Shape> shapes;
  std::vector<Item> items;
  btDbvt tree;

  template <class Visit>
  void inBox(const Vector3d& low, const Vector3d& high, Visit visit) const {
    const std::function<void(std::uint32_t)> each = [&](std::uint32_t i) { visit(items[i]); };
    Visitor visitor;
    visitor.visit = &each;
    tree.collideTV(tree.m_root, btDbvtVolume::FromMM(toBullet(low), toBullet(high)), visitor);
  }

  Corners corners(const Shape& shape, const Triangle& t) const {
    return {shape.positions[t[0]], shape.positions[t[1]], shape.positions[t[2]]};
  }

  // The points of the core and of the item that are nearest to each other; nothing where the two overlap.
  std::optional<NearestPoints> nearest(const Core& core, const Item& item) const {
    const Shape& shape = shapes[item.shape];
    if (!shape.hull)
      return nearestPoints(core.low, core.high,
                           corners(shape, shape.triangles[static_cast<std::size_t>(item.triangle)]));
    btGjkEpaSolver2::sResults result;
    const Vector3d guess = core.low - shape.positions[0];
    if (btGjkEpaSolver2::Distance(&core, at(core.low), shape.hull.get(), btTransform::getIdentity(), toBullet(guess),
                                  result)) {
      const NearestPoints found{fromBullet(result.witnesses[0]), fromBullet(result.witnesses[1])};
      if (isNearest(core, shape, found)) return found;
    }
    return nearestToFaces(core, shape);  // GJK gives up where shapes are thin, far or only just apart
  }

  // Distances are at most those between any two points, and at least those between two parting planes.
  bool isNearest(const Core& core, const Shape& shape, const NearestPoints& found) const {
    const Vector3d normal = (found.first - found.second).normalized();
    double farthest = -std::numeric_limits<double>::infinity();
    for (const auto& p : shape.positions) farthest = std::max(farthest, normal.dot(p));
    const double distance = std::sqrt(found.squaredDistance());
    return distance > kContact &&
           std::min(normal.dot(core.low), normal.dot(core.high)) - farthest > distance - kContact;
  }

  std::optional<NearestPoints> nearestToFaces(const Core& core, const Shape& shape) const {
    bool inside = true;
    std::optional<NearestPoints> best;
    for (const auto& t : shape.triangles) {
      const auto face = corners(shape, t);
      const auto found = nearestPoints(core.low, core.high, face);
      if (!found) return std::nullopt;
      if (!best || found->squaredDistance() < best->squaredDistance()) best = found;
      inside = inside && (face[1] - face[0]).cross(face[2] - face[0]).dot(core.low - face[0]) <= 0;
    }
    return inside ? std::nullopt : best;
  }

  // How far the body is from the item, negative where it reaches in; fills in where they are nearest.
  double gap(const Body& body, const Core& core, const Item& item, Contact& contact) const {
    const auto points = nearest(core, item);
    const double distance = points ? std::sqrt(points->squaredDistance()) : 0;
    if (!(distance > 1e-9)) return -body.radius_m;
    contact.point = points->second;
    contact.normal = (points->first - points->second) / distance;
    return distance - body.radius_m;
  }
};

Obstacles::Obstacles(std::span<const CollisionShape> shapes) : world_(std::make_unique<World>()) {
  world_->shapes.resize(shapes.size());
  for (std::uint32_t i = 0; i < shapes.size(); ++i) {
    auto& shape = world_->shapes[i];
    shape.product = shapes[i].product;
    shape.triangles = shapes[i].mesh.triangles;
    for (const auto& p : shapes[i].mesh.positions) shape.positions.push_back(p.cast<double>());
    const auto add = [&](std::int32_t triangle, const Bounds& box) {
      if (box.empty()) return;
      world_->tree.insert(btDbvtVolume::FromMM(toBullet(box.min), toBullet(box.max)), nullptr)->dataAsInt =
          static_cast<int>(world_->items.size());
      world_->items.push_back({i, triangle});
    };
    if (shapes[i].kind == CollisionShapeKind::mesh) {
      for (std::size_t t = 0; t < shape.triangles.size(); ++t) {
        Bounds box;
        for (const auto v : shape.triangles[t]) box.extend(shape.positions[v]);
        add(static_cast<std::int32_t>(t), box);
      }
      continue;
    }
    shape.hull = std::make_unique<btConvexHullShape>();
    shape.hull->setMargin(0);
    Bounds box;
    for (const auto& p : shape.positions) {
      shape.hull->addPoint(toBullet(p), false);
      box.extend(p);
    }
    shape.hull->recalcLocalAabb();
    add(-1, box);
  }
}

Obstacles::~Obstacles() = default;
Obstacles::Obstacles(Obstacles&&) noexcept = default;
Obstacles& Obstacles::operator=(Obstacles&&) noexcept = default;

std::optional<Contact> Obstacles::sweep(const Body& body, const Vector3d& from, const Vector3d& to) const {
  const Vector3d way = to - from, side(body.radius_m, body.radius_m, 0),
                 up(0, 0, std::max(body.height_m, 2 * body.radius_m));
  std::optional<Contact> first;
  // Conservative advancement: the distance between convex things is a convex function of the way, so a body that does
  // not come nearer now never will, and one that goes on by (gap / speed of approach) cannot yet have met the other.
  world_->inBox(from.cwiseMin(to) - side, from.cwiseMax(to) + side + up, [&](const auto& item) {
    Contact contact{0, from, -way.normalized(), item.shape, world_->shapes[item.shape].product};
    for (int i = 0; i < kMostAdvances; ++i) {
      const double gap = world_->gap(body, Core(body, from + contact.fraction * way), item, contact);
      const double approach = -contact.normal.dot(way);
      if (gap > -kDeepest && approach <= kSliding * way.norm()) return;
      if (gap <= kContact) break;
      contact.fraction += gap / approach;
      if (contact.fraction >= 1 || (first && contact.fraction > first->fraction)) return;
    }
    if (!first || contact.fraction < first->fraction ||
        (contact.fraction == first->fraction && item.shape < first->shape))
      first = contact;
  });
  return first;
}

void Obstacles::near(const Body& body, const Vector3d& feet, double within_m,
                     const std::function<void(const Contact&, double)>& visit) const {
  const Core core(body, feet);
  const Vector3d side(body.radius_m + within_m, body.radius_m + within_m, within_m),
      up(0, 0, std::max(body.height_m, 2 * body.radius_m));
  world_->inBox(feet - side, feet + side + up, [&](const auto& item) {
    Contact contact{0, feet, Vector3d::UnitZ(), item.shape, world_->shapes[item.shape].product};
    if (const double gap = world_->gap(body, core, item, contact); gap < within_m) visit(contact, gap);
  });
}

std::optional<Contact> Obstacles::overlap(const Body& body, const Vector3d& feet, double depth_m) const {
  std::optional<Contact> deepest;
  double deepest_gap = -depth_m;
  near(body, feet, 0, [&](const Contact& contact, double gap) {
    if (gap < deepest_gap || (deepest && gap == deepest_gap && contact.shape < deepest->shape)) {
      deepest = contact;
      deepest_gap = gap;
    }
  });
  return deepest;
}

std::optional<Contact> Obstacles::ray(const Vector3d& from, const Vector3d& to) const {
  const Vector3d way = to - from;
  std::optional<Contact> first;
  world_->inBox(from.cwiseMin(to), from.cwiseMax(to), [&](const auto& item) {
    const auto& shape = world_->shapes[item.shape];
    const auto meet = [&](const Triangle& t) {
      const Vector3d &a = shape.positions[t[0]], ab = shape.positions[t[1]] - a, ac = shape.positions[t[2]] - a;
      const Vector3d normal = ab.cross(ac);
      const double along = way.dot(normal);
      if (along == 0) return;
      const double fraction = (a - from).dot(normal) / along;
      if (!(fraction >= 0 && fraction <= 1) || (first && fraction >= first->fraction)) return;
      const Vector3d p = from + fraction * way - a;
      const double u = p.cross(ac).dot(normal) / normal.squaredNorm(),
                   v = ab.cross(p).dot(normal) / normal.squaredNorm();
      if (u < -1e-9 || v < -1e-9 || u + v > 1 + 1e-9) return;
      first = Contact{fraction, p + a, (along > 0 ? -1 : 1) * normal.normalized(), item.shape, shape.product};
    };
    if (item.triangle >= 0)
      meet(shape.triangles[static_cast<std::size_t>(item.triangle)]);
    else
      for (const auto& t : shape.triangles) meet(t);
  });
  return first;
}

}  // namespace standpoint
