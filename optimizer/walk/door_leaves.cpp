// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/walk/door_leaves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>

namespace standpoint {

namespace {

using Eigen::Vector3d;

constexpr double kOuterEdge = 0.015;  // m from the side of the opening: what reaches so far is fixed to the wall
constexpr double kPostWidth = 0.25;   // of the opening's width, …
constexpr double kBeamHeight = 0.2;   // … and height: what is narrower or lower is no leaf
constexpr double kLightAbove = 0.7;   // of its height, from where a light is
constexpr double kWholeLeaf = 0.6;    // of its width, from where there is one leaf only
constexpr double kHandle = 0.35;      // m, as large as handles are
constexpr double kHandleLowest = 0.7, kHandleHighest = 1.4;  // m over the door's lower edge

// Triangles of one instance that hang together. Its box is in the passage's frame: through, across, up.
struct DoorPart {
  std::size_t instance = 0;
  std::vector<std::uint32_t> triangles;
  Bounds box;
  bool covers_middle = false;
  int leaf = -1;  // of this door

  double width() const { return box.max.y() - box.min.y(); }
  double height() const { return box.max.z() - box.min.z(); }
};

Vector3d inFrame(const Passage& passage, const Vector3d& p) {
  const Vector3d off = p - passage.middle;
  return {passage.through.dot(off), passage.across.dot(off), off.z()};
}

std::vector<std::uint32_t> partOfTriangle(const Mesh& mesh) {
  std::vector<std::uint32_t> root(mesh.positions.size());
  std::iota(root.begin(), root.end(), 0U);
  const auto rootOf = [&](std::uint32_t i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  std::map<std::array<float, 3>, std::uint32_t> first;
  for (std::uint32_t i = 0; i < root.size(); ++i) {
    const auto& p = mesh.positions[i];
    root[i] = first.try_emplace({p.x(), p.y(), p.z()}, i).first->second;
  }
  for (const auto& t : mesh.triangles)
    for (const auto v : {t[1], t[2]}) root[rootOf(v)] = rootOf(t[0]);
  std::vector<std::uint32_t> parts;
  for (const auto& t : mesh.triangles) parts.push_back(rootOf(t[0]));
  return parts;
}

// Seen along the passage, whether a triangle is over the middle of the part's box.
bool coversMiddle(const DoorPart& part, const std::array<Vector3d, 3>& corners) {
  const Vector3d middle = 0.5 * (part.box.min + part.box.max);
  const auto side = [&](const Vector3d& a, const Vector3d& b) {
    return (b.y() - a.y()) * (middle.z() - a.z()) - (b.z() - a.z()) * (middle.y() - a.y());
  };
  const double u = side(corners[0], corners[1]), v = side(corners[1], corners[2]), w = side(corners[2], corners[0]);
  return (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
}

std::vector<DoorPart> partsOf(const Environment& environment, const Passage& passage,
                              std::span<const std::size_t> instances) {
  std::vector<DoorPart> parts;
  for (const auto i : instances) {
    const auto& instance = environment.instances[i];
    const auto& mesh = *environment.meshes[instance.mesh];
    std::map<std::uint32_t, DoorPart> found;
    const auto part_of = partOfTriangle(mesh);
    const auto corners = [&](std::uint32_t t) {
      std::array<Vector3d, 3> result;
      for (std::size_t k = 0; k < 3; ++k)
        result[k] = inFrame(passage, instance.world_from_mesh * mesh.positions[mesh.triangles[t][k]].cast<double>());
      return result;
    };
    for (std::uint32_t t = 0; t < part_of.size(); ++t) {
      auto& part = found[part_of[t]];
      part.instance = i;
      part.triangles.push_back(t);
      for (const auto& p : corners(t)) part.box.extend(p);
    }
    for (auto& of_root : found) {
      auto& part = of_root.second;
      part.covers_middle = std::any_of(part.triangles.begin(), part.triangles.end(),
                                       [&](std::uint32_t t) { return coversMiddle(part, corners(t)); });
      parts.push_back(std::move(part));
    }
  }
  return parts;
}

bool standsStill(const DoorPart& part, const Passage& passage, bool only_part) {
  const bool left =
      part.box.min.y()<-passage.half_width + kOuterEdge, right = part.box.max.y()> passage.half_width - kOuterEdge;
  if (left && right) return !(only_part && part.covers_middle);
  const double width = 2 * passage.half_width;
  if ((left || right) && part.width() < kPostWidth * width && part.height() > passage.height / 2) return true;
  return part.box.min.z() > kLightAbove * passage.height;
}

bool isLarge(const DoorPart& part, const Passage& passage) {
  return part.width() > kPostWidth * 2 * passage.half_width && part.height() > kBeamHeight * passage.height;
}

// The part's leaf, of `count`: that on whose side its middle is.
int leafOf(const DoorPart& part, int count) { return count == 2 && part.box.min.y() + part.box.max.y() > 0 ? 1 : 0; }

// How many leaves the door has, 0 to 2; the parts are told which is theirs.
int findLeaves(std::vector<DoorPart>& parts, const Passage& passage) {
  const auto large = std::count_if(parts.begin(), parts.end(), [&](const auto& p) { return isLarge(p, passage); });
  int count = 0;
  for (const auto& part : parts) {
    if (standsStill(part, passage, large == 1) || !isLarge(part, passage)) continue;
    if (part.width() > kWholeLeaf * 2 * passage.half_width) {
      count = 1;
      break;
    }
    count = 2;
  }
  if (count == 0) return 0;
  for (auto& part : parts)
    if (!standsStill(part, passage, large == 1)) part.leaf = leafOf(part, count);
  return count;
}

// Where the leaf's axis is, in the passage's frame, and to which side of it the leaf lies.
struct Hinge {
  Vector3d at = Vector3d::Zero();
  double side = 1;
};

Hinge hingeOf(const std::vector<DoorPart>& parts, int leaf, int count) {
  Bounds box;
  double handles = 0;  // to which side of the leaf's middle they are
  for (const auto& part : parts)
    if (part.leaf == leaf) box.extend(part.box);
  const Vector3d middle = 0.5 * (box.min + box.max);
  for (const auto& part : parts) {
    const double height = 0.5 * (part.box.min.z() + part.box.max.z());
    if (part.leaf == leaf && part.width() < kHandle && part.height() < kHandle && height > kHandleLowest &&
        height < kHandleHighest)
      handles += 0.5 * (part.box.min.y() + part.box.max.y()) - middle.y();
  }
  const bool at_low_end = count == 2 ? leaf == 0 : handles >= 0;
  return {{middle.x(), at_low_end ? box.min.y() : box.max.y(), 0}, at_low_end ? 1.0 : -1.0};
}

std::shared_ptr<const Mesh> meshOf(const Mesh& whole, const std::vector<std::uint32_t>& triangles) {
  Mesh mesh;
  mesh.positions = whole.positions;
  for (const auto t : triangles) {
    mesh.triangles.push_back(whole.triangles[t]);
    mesh.surface_of_triangle.push_back(whole.surface_of_triangle[t]);
  }
  return std::make_shared<const Mesh>(std::move(mesh));
}

void addDoor(const Environment& environment, std::uint32_t product, std::span<const std::size_t> instances,
             DoorLeaves& result) {
  const auto passage = passageOf(environment, product);
  if (!passage) return;
  auto parts = partsOf(environment, *passage, instances);
  const int count = findLeaves(parts, *passage);
  if (count == 0) return;
  const auto first = static_cast<std::int32_t>(result.leaves.size());
  for (int leaf = 0; leaf < count; ++leaf) {
    const auto hinge = hingeOf(parts, leaf, count);
    const Vector3d at = passage->middle + hinge.at.x() * passage->through + hinge.at.y() * passage->across;
    result.leaves.push_back({static_cast<std::uint32_t>(result.doors.size()), at, -hinge.side});
  }
  for (const auto i : instances)
    for (int leaf = -1; leaf < count; ++leaf) {
      std::vector<std::uint32_t> triangles;
      for (const auto& part : parts)
        if (part.instance == i && part.leaf == leaf)
          triangles.insert(triangles.end(), part.triangles.begin(), part.triangles.end());
      if (triangles.empty()) continue;
      std::sort(triangles.begin(), triangles.end());
      const auto& instance = environment.instances[i];
      result.scene.meshes.push_back(meshOf(*environment.meshes[instance.mesh], triangles));
      result.scene.instances.push_back(
          {static_cast<std::uint32_t>(result.scene.meshes.size() - 1), product, instance.world_from_mesh});
      result.leaf_of_instance.push_back(leaf < 0 ? -1 : first + leaf);
    }
  auto& shown = result.scene.products[product];
  shown.excluded = false;
  shown.ifc_class = environment.products[product].ifc_class;
  result.doors.push_back({product, *passage});
}

}  // namespace

DoorLeaves doorLeaves(const Environment& environment) {
  DoorLeaves result;
  result.scene.surfaces = environment.surfaces;
  for (auto& surface : result.scene.surfaces) surface.image = -1;
  Product hidden;
  hidden.excluded = true;
  result.scene.products.assign(environment.products.size(), hidden);
  const auto door_of = doorOf(environment);
  std::map<std::uint32_t, std::vector<std::size_t>> instances;
  for (std::size_t i = 0; i < environment.instances.size(); ++i) {
    const auto product = environment.instances[i].product;
    if (door_of[product] == static_cast<std::int32_t>(product) && environment.products[product].inScene())
      instances[product].push_back(i);
  }
  for (const auto& [product, own] : instances) addDoor(environment, product, own, result);
  return result;
}

Environment swung(const DoorLeaves& leaves, std::span<const double> opened) {
  Environment scene = leaves.scene;
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    if (leaves.leaf_of_instance[i] < 0) continue;
    const auto& leaf = leaves.leaves[static_cast<std::size_t>(leaves.leaf_of_instance[i])];
    const double angle = leaf.turn * opened[leaf.door] * std::numbers::pi / 2;
    scene.instances[i].world_from_mesh = Eigen::Translation3d(leaf.hinge) *
                                         Eigen::AngleAxisd(angle, Vector3d::UnitZ()) *
                                         Eigen::Translation3d(-leaf.hinge) * scene.instances[i].world_from_mesh;
  }
  return scene;
}

}  // namespace standpoint
