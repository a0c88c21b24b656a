// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <map>
#include <memory>

#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wshadow"
#endif
#include <carve/csg.hpp>
#include <carve/mesh.hpp>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

#include "importers/geometry/boolean_ways.h"
#include "importers/geometry/polygon.h"

namespace standpoint::geometry {
namespace {

using MeshSet = carve::mesh::MeshSet<3>;
using Key = std::vector<std::size_t>;  // a face's points, sorted

struct Input {
  std::unique_ptr<MeshSet> mesh;
  std::map<Key, std::uint32_t> tag_of_face;
};

Key keyOf(const MeshSet& mesh, const MeshSet::face_t* face) {
  Key key;
  const MeshSet::edge_t* edge = face->edge;
  for (std::size_t i = 0; i < face->nEdges(); ++i, edge = edge->next) {
    key.push_back(static_cast<std::size_t>(edge->vert - mesh.vertex_storage.data()));
  }
  std::sort(key.begin(), key.end());
  return key;
}

// Snapped to the grid and welded; faces with holes become triangles, for carve's faces have one outline.
std::optional<Input> toCarve(PolyMesh mesh) {
  for (Eigen::Vector3d& p : mesh.points) p = (p / kSnap_m).array().round() * kSnap_m;
  const std::vector<std::uint32_t> map = weldMap(mesh.points, 0.5 * kSnap_m);
  std::vector<carve::geom::vector<3>> points;
  std::vector<std::uint32_t> to(mesh.points.size());
  for (std::uint32_t i = 0; i < map.size(); ++i) {
    if (map[i] == i) {
      to[i] = static_cast<std::uint32_t>(points.size());
      points.push_back(carve::geom::VECTOR(mesh.points[i].x(), mesh.points[i].y(), mesh.points[i].z()));
    } else {
      to[i] = to[map[i]];
    }
  }
  Input input;
  std::vector<int> indices;
  std::size_t count = 0;
  const auto add = [&](std::vector<std::uint32_t> loop, std::uint32_t tag) {
    for (std::uint32_t& i : loop) i = to[i];
    loop.erase(std::unique(loop.begin(), loop.end()), loop.end());
    while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
    if (loop.size() < 3) return;
    indices.push_back(static_cast<int>(loop.size()));
    indices.insert(indices.end(), loop.begin(), loop.end());
    Key key(loop.begin(), loop.end());
    std::sort(key.begin(), key.end());
    input.tag_of_face.try_emplace(std::move(key), tag);
    ++count;
  };
  for (const Face& face : mesh.faces) {
    if (face.holes.empty()) {
      add(face.outer, face.tag);
      continue;
    }
    std::vector<Triangle> triangles;
    if (!triangulate(mesh.points, face, triangles)) return std::nullopt;
    for (const Triangle& t : triangles) add({t[0], t[1], t[2]}, face.tag);
  }
  if (count < 4) return std::nullopt;
  input.mesh = std::make_unique<MeshSet>(points, count, indices);
  return input;
}

// Notes from which face each face of the result was cut.
class TagHook : public carve::csg::CSG::Hook {
 public:
  TagHook(const Input& a, const Input& b) : a_(a), b_(b) {}
  void resultFace(const MeshSet::face_t* made, const MeshSet::face_t* from, bool /*flipped*/) override {
    const bool of_a = from->mesh && from->mesh->meshset == a_.mesh.get();
    const Input& input = of_a ? a_ : b_;
    const auto tag = input.tag_of_face.find(keyOf(*input.mesh, from));
    if (tag != input.tag_of_face.end()) tag_of_[made] = tag->second;
  }
  std::uint32_t tagOf(const MeshSet::face_t* face) const {
    const auto found = tag_of_.find(face);
    return found == tag_of_.end() ? 0 : found->second;
  }

 private:
  const Input &a_, &b_;
  std::map<const MeshSet::face_t*, std::uint32_t> tag_of_;  // looked up only
};

bool before(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

// Carve hashes pointers, so that its order changes from run to run: each outline starts at its least point, and the
// faces are sorted.
PolyMesh fromCarve(const MeshSet& set, const TagHook& hook) {
  struct Outline {
    std::vector<Eigen::Vector3d> points;
    std::uint32_t tag;
  };
  std::vector<Outline> outlines;
  for (const auto* part : set.meshes) {
    for (const auto* face : part->faces) {
      Outline& own = outlines.emplace_back(Outline{{}, hook.tagOf(face)});
      const MeshSet::edge_t* edge = face->edge;
      for (std::size_t i = 0; i < face->nEdges(); ++i, edge = edge->next)
        own.points.emplace_back(edge->vert->v.x, edge->vert->v.y, edge->vert->v.z);
      std::rotate(own.points.begin(), std::min_element(own.points.begin(), own.points.end(), before), own.points.end());
    }
  }
  std::sort(outlines.begin(), outlines.end(), [](const Outline& a, const Outline& b) {
    return std::lexicographical_compare(a.points.begin(), a.points.end(), b.points.begin(), b.points.end(), before);
  });
  PolyMesh mesh;
  std::map<std::array<double, 3>, std::uint32_t> index;
  for (const Outline& outline : outlines) {
    Face& own = mesh.faces.emplace_back(Face{{}, {}, outline.tag});
    for (const auto& p : outline.points) {
      const auto [it, fresh] = index.try_emplace({p.x(), p.y(), p.z()}, static_cast<std::uint32_t>(mesh.points.size()));
      if (fresh) mesh.points.push_back(p);
      own.outer.push_back(it->second);
    }
  }
  return mesh;
}

carve::csg::CSG::OP opOf(Operation operation) {
  switch (operation) {
    case Operation::difference: return carve::csg::CSG::A_MINUS_B;
    case Operation::intersection: return carve::csg::CSG::INTERSECTION;
    case Operation::unite: return carve::csg::CSG::UNION;
  }
  return carve::csg::CSG::UNION;
}

}  // namespace

Result<PolyMesh> combineWithCarve(const PolyMesh& a, const PolyMesh& b, Operation operation) {
  try {
    const std::optional<Input> first = toCarve(a), second = toCarve(b);
    if (!first || !second) return failure(ErrorKind::unusable, "carve: a body is not a polyhedron");
    if (!first->mesh->isClosed() || !second->mesh->isClosed()) {
      return failure(ErrorKind::unusable, "carve: a body is not closed");
    }
    carve::csg::CSG csg;
    auto* hook = new TagHook(*first, *second);  // owned by csg, which deletes it also where compute throws
    csg.hooks.registerHook(hook, carve::csg::CSG::Hooks::RESULT_FACE_BIT);
    const std::unique_ptr<MeshSet> result(csg.compute(first->mesh.get(), second->mesh.get(), opOf(operation)));
    if (!result) return failure(ErrorKind::unusable, "carve: no result");
    return fromCarve(*result, *hook);
  } catch (const carve::exception& e) {
    return failure(ErrorKind::unusable, "carve: " + e.str());
  } catch (const std::exception& e) {
    return failure(ErrorKind::unusable, std::string("carve: ") + e.what());
  }
}

}  // namespace standpoint::geometry
