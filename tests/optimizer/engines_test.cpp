// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <cstring>
#include <map>
#include <random>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include "optimizer/simplify/engines/engine.h"
#include "optimizer/surface/deviation.h"
#include "tests/optimizer/models.h"

namespace standpoint {
namespace {

using Eigen::Affine3d;
using Eigen::Translation3d;
using Eigen::Vector3d;

struct Simplified {
  Shape before, after;
  std::vector<Collapse> log;
};

class EngineOf : public testing::TestWithParam<Engine> {
 protected:
  static Simplified simplified(const Mesh& mesh, std::size_t triangles) {
    Simplified result{weld(mesh), {}, {}};
    Progress progress;
    auto log = GetParam().simplify(result.before, {triangles}, progress);
    EXPECT_TRUE(log) << describe(log.error());
    if (!log) return result;
    result.log = std::move(*log);
    result.after = replay(result.before, result.log, result.log.size());
    return result;
  }
};

std::string bytesOf(const std::vector<Collapse>& log) {
  std::string bytes;
  for (const auto& step : log) {
    bytes += std::to_string(step.kept) + " " + std::to_string(step.removed) + " " + std::to_string(step.triangles);
    bytes.append(reinterpret_cast<const char*>(step.position.data()), sizeof(double) * 3);
  }
  return bytes;
}

Mesh bumpy(int rings, int segments) {
  Mesh mesh = models::sphere(1, rings, segments);
  for (auto& p : mesh.positions)
    p *= 1 + 0.05F * std::sin(9 * p.x()) * std::sin(8 * p.y()) + 0.03F * std::cos(21 * p.z());
  return mesh;
}

// Three leaves on one edge, each a grid, so that a row of edges has three triangles.
Mesh leaves(int n) {
  Mesh mesh;
  const auto at = [&](int leaf, int i, int j) {
    const double turn = 2.1 * leaf, r = double(j) / n;
    return Vector3d(r * std::cos(turn), r * std::sin(turn), double(i) / n);
  };
  for (int leaf = 0; leaf < 3; ++leaf)
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (const auto& [a, b] : {std::pair{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}})
          mesh.positions.push_back(at(leaf, a, b).cast<float>());
        mesh.triangles.push_back({first, first + 1, first + 2});
        mesh.triangles.push_back({first, first + 2, first + 3});
      }
  mesh.surface_of_triangle.assign(mesh.triangles.size(), 0);
  return mesh;
}

double flippedFraction(const Shape& before, const Shape& after) {
  const TriangleTree tree(before.positions, before.triangles);
  const auto normal = [](const Shape& s, const Triangle& t) {
    return (s.positions[t[1]] - s.positions[t[0]]).cross(s.positions[t[2]] - s.positions[t[0]]).eval();
  };
  double flipped = 0, all = 0;
  for (const auto& t : after.triangles) {
    const Vector3d middle = (after.positions[t[0]] + after.positions[t[1]] + after.positions[t[2]]) / 3;
    const Vector3d n = normal(after, t);
    all += n.norm();
    if (n.dot(normal(before, before.triangles[tree.nearestTriangle(middle).triangle])) < 0) flipped += n.norm();
  }
  return flipped / all;
}

TEST_P(EngineOf, ReachesItsTargetOnSmoothShapes) {
  for (const auto& mesh : {bumpy(60, 90), models::torus(2, 0.6, 90, 50), models::cylinder(0.5, 3, 60, 40)})
    for (const double fraction : {0.5, 0.1, 0.05}) {
      const auto target = static_cast<std::size_t>(fraction * static_cast<double>(mesh.triangles.size()));
      const auto result = simplified(mesh, target);
      EXPECT_LE(result.after.triangles.size(), target);
      EXPECT_GE(result.after.triangles.size() + 2, target);
      std::size_t left = result.before.triangles.size();
      for (const auto& step : result.log) left -= step.triangles;
      EXPECT_EQ(left, result.after.triangles.size()) << "what the log says that it has";
      for (const auto& t : result.after.triangles)
        for (const auto v : t)
          EXPECT_TRUE((result.after.positions[v].cwiseAbs().array() <= result.before.half_size.array()).all());
      EXPECT_LT(flippedFraction(result.before, result.after), 0.002);
    }
}

TEST_P(EngineOf, DeviatesByWhatAnIndependentMeasureFinds) {
  const auto mesh = bumpy(30, 45);
  const auto result = simplified(mesh, mesh.triangles.size() / 5);
  const TriangleTree tree(result.before.positions, result.before.triangles);
  const auto deviation = DeviationMeter(result.before, tree, 20'000, 1).of(result.after);
  const Mesh after = meshOf(result.after);
  const double mean = 0.5 * (models::meanDistance(mesh, after, 1500) + models::meanDistance(after, mesh, 1500)),
               max = std::max(models::farthest(mesh, after, 1500), models::farthest(after, mesh, 1500));
  EXPECT_NEAR(deviation.mean_m / mean, 1, 0.08);
  EXPECT_GE(deviation.max_m, max * 0.999);
  EXPECT_LT(deviation.max_m, max * 1.2);
  EXPECT_LT(deviation.mean_m, 0.008);
}

TEST_P(EngineOf, KeepsBordersOfAMeshAndBetweenSurfaces) {
  const auto mesh = models::plateWithHole(4, 3, 1, 0.0625);
  const auto result = simplified(mesh, 150);
  if (result.log.empty()) return;
  std::map<std::uint32_t, double> was, is;
  const auto add = [](const Shape& shape, std::map<std::uint32_t, double>& areas) {
    for (std::size_t i = 0; i < shape.triangles.size(); ++i) {
      const auto& t = shape.triangles[i];
      areas[shape.surface_of_triangle[i]] +=
          0.5 *
          (shape.positions[t[1]] - shape.positions[t[0]]).cross(shape.positions[t[2]] - shape.positions[t[0]]).norm();
    }
  };
  add(result.before, was);
  add(result.after, is);
  ASSERT_EQ(is.size(), 2);
  for (const auto& [surface, square_metres] : was) EXPECT_NEAR(is[surface] / square_metres, 1, 0.01) << surface;
  const TriangleTree tree(result.before.positions, result.before.triangles);
  EXPECT_LT(DeviationMeter(result.before, tree, 5000, 1).of(result.after).max_m, 0.03);
}

TEST_P(EngineOf, SimplifiesOrRefusesWhereThreeTrianglesMeetAtAnEdge) {
  const auto mesh = leaves(24);
  const Shape before = weld(mesh);
  Progress progress;
  const auto log = GetParam().simplify(before, {400}, progress);
  if (!log) {
    EXPECT_EQ(log.error().kind, ErrorKind::unusable);
    EXPECT_FALSE(log.error().message.empty());
    return;
  }
  const auto after = replay(before, *log, log->size());
  EXPECT_LE(after.triangles.size(), 400);
  const TriangleTree tree(before.positions, before.triangles);
  EXPECT_LT(DeviationMeter(before, tree, 5000, 1).of(after).max_m, 0.02);
}

TEST_P(EngineOf, SimplifiesOrRefusesWhatIsNoMesh) {
  Progress progress;
  std::mt19937 random(7);
  std::uniform_real_distribution<float> place(-1, 1);
  Mesh soup, needles, empty, both_sides;
  for (int i = 0; i < 2000; ++i) {
    for (int k = 0; k < 3; ++k) soup.positions.emplace_back(place(random), place(random), place(random));
    const auto first = static_cast<std::uint32_t>(3 * i);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  for (std::uint32_t i = 0; i < 500; ++i) {
    needles.positions.emplace_back(0.1F * static_cast<float>(i), 0, 0);
    if (i >= 2) needles.triangles.push_back({i - 2, i - 1, i});
  }
  for (std::uint32_t i = 0; i < 300; ++i) {  // any three of a few points
    const std::uint32_t a = random() % 40, b = random() % 40, c = random() % 40;
    both_sides.triangles.push_back({a, b, c});
  }
  for (int i = 0; i < 40; ++i) both_sides.positions.emplace_back(place(random), place(random), place(random));
  for (auto* mesh : {&soup, &needles, &empty, &both_sides}) {
    mesh->surface_of_triangle.assign(mesh->triangles.size(), 0);
    const Shape before = weld(*mesh);
    const auto log = GetParam().simplify(before, {before.triangles.size() / 4}, progress);
    if (!log) {
      EXPECT_EQ(log.error().kind, ErrorKind::unusable);
      EXPECT_FALSE(log.error().message.empty());
      continue;
    }
    const auto after = replay(before, *log, log->size());
    EXPECT_LE(after.triangles.size(), before.triangles.size() / 4);
    for (const auto& t : after.triangles)
      for (const auto v : t)
        EXPECT_TRUE((after.positions[v].cwiseAbs().array() <= before.half_size.array() + 1e-6).all());
  }
}

TEST_P(EngineOf, GivesTheSameForAnyNumberOfThreads) {
  const Shape shape = weld(bumpy(70, 90));
  std::string first;
  for (const std::size_t threads : {1, 2, 7}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    std::vector<std::string> logs(3);
    tbb::parallel_for(std::size_t{0}, logs.size(), [&](std::size_t i) {
      Progress progress;
      logs[i] = bytesOf(GetParam().simplify(shape, {600}, progress).value());
    });
    if (first.empty()) first = logs[0];
    EXPECT_THAT(logs, testing::Each(first));
  }
}

TEST_P(EngineOf, StopsWhenCancelled) {
  Progress progress;
  progress.cancel();
  const auto log = GetParam().simplify(weld(bumpy(60, 90)), {100}, progress);
  ASSERT_FALSE(log);
  EXPECT_EQ(log.error().kind, ErrorKind::cancelled);
}

TEST_P(EngineOf, GoesOnFromAForm) {
  const Shape shape = weld(bumpy(60, 90));
  Progress progress;
  const auto log = recordCollapses(shape, {.max_deviation_m = 100, .floor = 500}, progress);
  const auto whole = simplifyFurther(GetParam(), shape, log, stepsDownTo(shape, log, 2000), {500}, progress);
  ASSERT_TRUE(whole);
  const auto after = replay(shape, *whole, whole->size());
  EXPECT_NEAR(static_cast<double>(after.triangles.size()), 500, 2);
  const TriangleTree tree(shape.positions, shape.triangles);
  EXPECT_LT(DeviationMeter(shape, tree, 5000, 1).of(after).mean_m, 0.02);
}

std::string nameOf(const testing::TestParamInfo<Engine>& one) {
  std::string name;
  for (const char c : one.param.id)
    if (c != '-') name += c;
  return name;
}

INSTANTIATE_TEST_SUITE_P(All, EngineOf, testing::ValuesIn(engines().begin(), engines().end()), nameOf);

}  // namespace
}  // namespace standpoint
