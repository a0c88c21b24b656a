// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/surface/identical.h"

#include <algorithm>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "tests/optimizer/models.h"

namespace standpoint {
namespace {

using Eigen::Affine3d;
using Eigen::AngleAxisd;
using Eigen::Translation3d;
using Eigen::Vector3d;

Mesh moved(const Mesh& mesh, const Affine3d& motion) {
  Mesh result = mesh;
  for (auto& p : result.positions) p = (motion * p.cast<double>()).cast<float>();
  return result;
}

// The same surface, its vertices and triangles in another order, the corners of each turned.
Mesh shuffled(const Mesh& mesh, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<std::uint32_t> place(mesh.positions.size());
  std::iota(place.begin(), place.end(), 0U);
  std::shuffle(place.begin(), place.end(), random);
  Mesh result = mesh;
  for (std::size_t i = 0; i < place.size(); ++i) result.positions[place[i]] = mesh.positions[i];
  std::shuffle(result.triangles.begin(), result.triangles.end(), random);
  for (auto& t : result.triangles) {
    for (auto& v : t) v = place[v];
    std::rotate(t.begin(), t.begin() + random() % 3, t.end());
  }
  return result;
}

// No symmetry at all.
Mesh odd() {
  Mesh mesh = models::box({1, 0.7, 0.4}, 2);
  models::append(mesh, models::box({0.2, 0.3, 0.9}, 1), Affine3d(Translation3d(0.1, 0.2, 0.3)));
  models::append(mesh, models::cylinder(0.1, 0.5, 12, 2), Affine3d(Translation3d(0.9, 0.6, 0.1)));
  return mesh;
}

std::vector<Repetition> repetitions(const std::vector<Mesh>& meshes) {
  std::vector<Shape> shapes;
  for (const auto& mesh : meshes) shapes.push_back(weld(mesh));
  return findRepetitions(shapes, std::vector<std::uint32_t>(shapes.size(), 0));
}

const Affine3d kElsewhere = Translation3d(31, -7, 4) * AngleAxisd(1.1, Vector3d(1, 2, 3).normalized());

TEST(Repetitions, AreFoundInAnyPlaceAndOrder) {
  for (const auto& mesh :
       {odd(), models::sphere(0.5, 12, 20), models::box({2, 1, 3}, 1), models::cylinder(0.2, 1, 32, 1)}) {
    const auto found = repetitions({mesh, moved(mesh, kElsewhere), moved(shuffled(mesh, 5), kElsewhere)});
    EXPECT_EQ(found[1].first, 0);
    EXPECT_EQ(found[2].first, 0);
    for (const int k : {1, 2}) {
      EXPECT_LT(found[k].residual_m, 1e-4);
      EXPECT_NEAR(found[k].motion.linear().determinant(), 1, 1e-9);
    }
    EXPECT_LT((found[1].motion.linear() - kElsewhere.linear()).norm() * (mesh.triangles == odd().triangles ? 1 : 0),
              1e-3);
  }
}

TEST(Repetitions, AreNotMirroredStretchedBentOrOfAnotherSurface) {
  const Mesh mesh = odd();
  Affine3d mirror = Affine3d::Identity(), stretch = Affine3d::Identity();
  mirror.linear().diagonal() = Vector3d(-1, 1, 1);
  stretch.linear() *= 1.001;
  Mesh mirrored = moved(mesh, mirror);
  for (auto& t : mirrored.triangles) std::swap(t[1], t[2]);
  Mesh bent = mesh;
  bent.positions[3].z() += 0.001F;
  Mesh painted = mesh;
  painted.surface_of_triangle.assign(mesh.triangles.size(), 4);
  Mesh inside_out = mesh;
  for (auto& t : inside_out.triangles) std::swap(t[1], t[2]);
  const auto found = repetitions({mesh, mirrored, moved(mesh, stretch), bent, painted, inside_out});
  for (std::uint32_t i = 0; i < found.size(); ++i) EXPECT_EQ(found[i].first, i);
}

TEST(Repetitions, OfThousandsOfBoxesOfAllSizesAreFoundSoon) {
  std::vector<Mesh> meshes;
  for (int i = 0; i < 4000; ++i)
    meshes.push_back(
        moved(models::box({0.1 + 0.001 * (i % 1000), 0.2, 0.3}, 1), Affine3d(Translation3d(0.01 * i, 0, 0))));
  const auto found = repetitions(meshes);
  for (std::uint32_t i = 0; i < found.size(); ++i) EXPECT_EQ(found[i].first, i % 1000);
}

}  // namespace
}  // namespace standpoint
