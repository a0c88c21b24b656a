// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/soup/soup_mesh.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "importers/soup/obj_polygon.h"

namespace standpoint {

namespace {

std::uint64_t mix(std::uint64_t x) {  // SplitMix64's finaliser (Steele, Lea, Flood 2014)
  x = (x ^ (x >> 30U)) * 0xBF58476D1CE4E5B9U;
  x = (x ^ (x >> 27U)) * 0x94D049BB133111EBU;
  return x ^ (x >> 31U);
}

// The corners in rising order, and whether that took an odd number of exchanges.
struct Sorted {
  std::array<std::uint32_t, 3> corners;
  bool odd = false;
  explicit Sorted(const std::array<std::uint32_t, 3>& t) : corners(t) {
    for (const auto& [i, j] : {std::pair(0U, 1U), std::pair(1U, 2U), std::pair(0U, 1U)})
      if (corners[i] > corners[j]) std::swap(corners[i], corners[j]), odd = !odd;
  }
  bool operator==(const Sorted&) const = default;
  std::uint64_t hash() const { return mix(mix((std::uint64_t{corners[0]} << 32U) | corners[1]) + corners[2]); }
};

// Vertices that only triangles had which are gone.
void dropUnused(Mesh& mesh) {
  std::vector<std::uint32_t> renumbered(mesh.positions.size(), 0);
  for (const auto& t : mesh.triangles)
    for (const auto v : t) renumbered[v] = 1;
  std::uint32_t kept = 0;
  for (std::size_t v = 0; v < renumbered.size(); ++v) {
    if (renumbered[v] == 0) continue;
    mesh.positions[kept] = mesh.positions[v];
    if (!mesh.colours.empty()) mesh.colours[kept] = mesh.colours[v];
    if (!mesh.texture_coordinates.empty()) mesh.texture_coordinates[kept] = mesh.texture_coordinates[v];
    renumbered[v] = kept++;
  }
  mesh.positions.resize(kept);
  if (!mesh.colours.empty()) mesh.colours.resize(kept);
  if (!mesh.texture_coordinates.empty()) mesh.texture_coordinates.resize(kept);
  for (auto& t : mesh.triangles)
    for (auto& v : t) v = renumbered[v];
}

}  // namespace

void SoupFindings::add(const SoupFindings& other) {
  unclean.add(other.unclean), collapsed.add(other.collapsed), twice.add(other.twice), repainted.add(other.repainted);
  flat.add(other.flat), unpainted.add(other.unpainted), inside_out.add(other.inside_out);
}

SoupMesh SoupMesher::mesh(std::span<const FaceRun> runs, const Eigen::Vector3d& origin) {
  origin_ = origin;
  textured_ = false;
  for (const auto& run : runs)
    for (auto c = soup_.beginOf(run.begin); !textured_ && !soup_.texture_corners.empty() && c < soup_.beginOf(run.end);
         ++c)
      textured_ = soup_.texture_corners[c] != kNoTextureCorner;
  for (const auto& run : runs)
    for (std::size_t f = run.begin; f < run.end; ++f) face(f, run.surface);
  dropRepeats();
  judgeOrientation();
  if (out_.findings.collapsed.count + out_.findings.twice.count + out_.findings.repainted.count > 0)
    dropUnused(out_.mesh);
  for (const auto p : position_of_) first_of_[p] = kUnused;
  for (auto* list : {&next_, &position_of_, &texture_of_, &face_of_}) list->clear();
  many_.clear();
  return std::exchange(out_, {});
}

void SoupMesher::face(std::size_t face, std::uint32_t surface) {
  surface_ = surface;
  const auto begin = soup_.beginOf(face);
  const auto corners = static_cast<std::size_t>(soup_.beginOf(face + 1) - begin);
  if (corners != 3) return polygon(face, begin, corners);
  const auto a = vertex(begin), b = vertex(begin + 1), c = vertex(begin + 2);
  triangle(face, {a, b, c});
}

void SoupMesher::polygon(std::size_t face, std::uint64_t begin, std::size_t corners) {
  polygon_.clear();
  polygon_vertices_.clear();
  for (std::size_t i = 0; i < corners; ++i) {
    polygon_.push_back(soup_.positions[soup_.corners[begin + i]]);
    polygon_vertices_.push_back(vertex(begin + i));
  }
  const auto cut = triangulatePolygon(polygon_);
  if (!cut.clean) out_.findings.unclean.add(face);
  for (const auto& t : cut.triangles)
    triangle(face, {polygon_vertices_[t[0]], polygon_vertices_[t[1]], polygon_vertices_[t[2]]});
}

void SoupMesher::triangle(std::size_t face, const Triangle& t) {
  const auto& p = out_.mesh.positions;
  if (p[t[0]] == p[t[1]] || p[t[1]] == p[t[2]] || p[t[2]] == p[t[0]]) return out_.findings.collapsed.add(face);
  out_.mesh.triangles.push_back(t);
  out_.mesh.surface_of_triangle.push_back(surface_);
  face_of_.push_back(static_cast<std::uint32_t>(face));
}

// One vertex for each pair of a position and a texture coordinate. Few positions have many: those are found by a map.
std::uint32_t SoupMesher::vertex(std::uint64_t corner) {
  constexpr int kMany = 16;
  const std::uint32_t position = soup_.corners[corner];
  const std::uint32_t texture = textured_ ? soup_.texture_corners[corner] : kNoTextureCorner;
  if (first_of_[position] == kUnused) return first_of_[position] = newVertex(position, texture);
  std::uint32_t last = first_of_[position];
  for (int walked = 0;; last = next_[last]) {
    if (texture_of_[last] == texture) return last;
    if (++walked == kMany || next_[last] == kUnused) break;
  }
  if (next_[last] == kUnused) {
    const auto added = newVertex(position, texture);
    return next_[last] = added;
  }
  const auto [known, is_new] = many_.try_emplace((std::uint64_t{position} << 32U) | texture, 0);
  if (is_new) known->second = newVertex(position, texture);
  return known->second;
}

std::uint32_t SoupMesher::newVertex(std::uint32_t position, std::uint32_t texture) {
  auto& mesh = out_.mesh;
  const auto index = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.push_back((soup_.positions[position] - origin_).cast<float>());
  if (!soup_.colours.empty()) mesh.colours.push_back(soup_.colours[position]);
  if (textured_) {
    mesh.texture_coordinates.push_back(texture == kNoTextureCorner ? Eigen::Vector2f::Zero()
                                                                   : soup_.texture_coordinates[texture]);
    if (texture == kNoTextureCorner && soup_.surfaces[surface_].image >= 0) ++out_.findings.unpainted.count;
  }
  next_.push_back(kUnused);
  position_of_.push_back(position);
  texture_of_.push_back(texture);
  return index;
}

// Finds triangles of the same three positions that turn the same way; those that turn the other way are a sheet's back.
void SoupMesher::dropRepeats() {
  auto& mesh = out_.mesh;
  const std::size_t count = mesh.triangles.size();
  std::vector<std::uint32_t> table(std::bit_ceil(2 * count + 1), kUnused);
  std::size_t kept = 0;
  const auto key = [&](std::size_t i) {
    const auto& t = mesh.triangles[i];
    return Sorted({position_of_[t[0]], position_of_[t[1]], position_of_[t[2]]});
  };
  for (std::size_t i = 0; i < count; ++i) {
    const Sorted own = key(i);
    std::size_t slot = own.hash() & (table.size() - 1);
    while (table[slot] != kUnused && !(key(table[slot]) == own)) slot = (slot + 1) & (table.size() - 1);
    if (table[slot] != kUnused) {
      const bool same_surface = mesh.surface_of_triangle[table[slot]] == mesh.surface_of_triangle[i];
      (same_surface ? out_.findings.twice : out_.findings.repainted).add(face_of_[i]);
      continue;
    }
    table[slot] = static_cast<std::uint32_t>(kept);
    mesh.triangles[kept] = mesh.triangles[i];
    mesh.surface_of_triangle[kept] = mesh.surface_of_triangle[i];
    face_of_[kept++] = face_of_[i];
  }
  mesh.triangles.resize(kept);
  mesh.surface_of_triangle.resize(kept);
}

// Closed means that every edge is used as often in one direction as in the other; the sum of their hashes, positive in
// one direction and negative in the other, is then zero, and without that it is so by a chance of 2^-64.
void SoupMesher::judgeOrientation() {
  const auto& mesh = out_.mesh;
  std::uint64_t edges = 0;
  double volume = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& t = mesh.triangles[i];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint64_t a = position_of_[t[k]], b = position_of_[t[(k + 1) % 3]];
      edges += a < b ? mix((a << 32U) | b) : 0 - mix((b << 32U) | a);
    }
    const Eigen::Vector3d o = mesh.positions[0].cast<double>(), a = mesh.positions[t[0]].cast<double>() - o;
    const Eigen::Vector3d u = mesh.positions[t[1]].cast<double>() - o, v = mesh.positions[t[2]].cast<double>() - o;
    volume += a.dot(u.cross(v));
    if ((u - a).cross(v - a).isZero(0)) out_.findings.flat.add(face_of_[i]);
  }
  if (edges == 0 && volume < 0) out_.findings.inside_out.add(face_of_[0]);
}

}  // namespace standpoint
