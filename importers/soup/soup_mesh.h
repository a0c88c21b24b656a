// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <unordered_map>
#include <vector>

#include "importers/soup/face_soup.h"

namespace standpoint {

// How often something was found, and the first face that has it.
struct FaceTally {
  std::size_t count = 0, first_face = 0;
  void add(std::size_t face) {
    if (count++ == 0 || face < first_face) first_face = face;
  }
  void add(const FaceTally& other) {
    if (other.count == 0) return;
    if (count == 0 || other.first_face < first_face) first_face = other.first_face;
    count += other.count;
  }
};

struct SoupFindings {
  FaceTally unclean;     // polygons that cross themselves or have no area
  FaceTally collapsed;   // triangles with two corners in one place: left out
  FaceTally twice;       // the same triangle again: left out
  FaceTally repainted;   // the same again with another material: left out
  FaceTally flat;        // triangles of three places and no area: kept, since their edges may close a solid
  FaceTally unpainted;   // corners without texture coordinates on a surface that has an image
  FaceTally inside_out;  // products that are closed and have a negative volume
  void add(const SoupFindings& other);
};

struct SoupMesh {
  Mesh mesh;
  SoupFindings findings;
};

// Makes the meshes of products, one after the other; keep one for each thread, since it holds four bytes for each
// position of the soup.
class SoupMesher {
 public:
  explicit SoupMesher(const FaceSoup& soup) : soup_(soup), first_of_(soup.positions.size(), kUnused) {}

  // `runs` are those of one product, sorted by surface.
  SoupMesh mesh(std::span<const FaceRun> runs, const Eigen::Vector3d& origin);

 private:
  static constexpr std::uint32_t kUnused = 0xFFFFFFFFU;

  void face(std::size_t face, std::uint32_t surface);
  std::uint32_t vertex(std::uint64_t corner);
  std::uint32_t newVertex(std::uint32_t position, std::uint32_t texture);
  void polygon(std::size_t face, std::uint64_t begin, std::size_t corners);
  void triangle(std::size_t face, const Triangle& t);
  void dropRepeats();
  void judgeOrientation();

  const FaceSoup& soup_;
  std::vector<std::uint32_t> first_of_;                    // position → its first vertex of the mesh
  std::vector<std::uint32_t> next_;                        // vertex → the next at the same position
  std::vector<std::uint32_t> position_of_, texture_of_;    // vertex → soup
  std::unordered_map<std::uint64_t, std::uint32_t> many_;  // (position, texture) → vertex, where a position has many
  std::vector<std::uint32_t> face_of_;                     // triangle → face
  std::vector<std::uint32_t> polygon_vertices_;
  std::vector<Eigen::Vector3d> polygon_;
  Eigen::Vector3d origin_;
  std::uint32_t surface_ = 0;
  bool textured_ = false;
  SoupMesh out_;
};

}  // namespace standpoint
