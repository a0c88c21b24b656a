// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "importers/geometry/kernel.h"
#include "tests/core/own_seconds.h"

namespace standpoint::geometry {
namespace {

using Eigen::Vector3d;

// A face under construction, laid into a tilted plane so that no axis is special.
struct Sheet {
  std::vector<Vector3d> points;
  Face face;
  Eigen::Affine3d place =
      Eigen::Affine3d(Eigen::Translation3d(5, -3, 2) * Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()));

  std::vector<std::uint32_t> add(const std::vector<Eigen::Vector2d>& loop) {
    std::vector<std::uint32_t> indices;
    for (const auto& p : loop) {
      indices.push_back(static_cast<std::uint32_t>(points.size()));
      points.push_back(place * Vector3d(p.x(), p.y(), 0));
    }
    return indices;
  }
};

double areaOf(const Sheet& sheet, const std::vector<Triangle>& triangles, bool& all_forward) {
  const Vector3d normal = sheet.place.linear() * Vector3d::UnitZ();
  double sum = 0;
  all_forward = true;
  for (const Triangle& t : triangles) {
    const Vector3d a = sheet.points[t[0]], b = sheet.points[t[1]], c = sheet.points[t[2]];
    const double area = 0.5 * (b - a).cross(c - a).dot(normal);
    all_forward = all_forward && area > -1e-12;
    sum += area;
  }
  return sum;
}

void expectArea(const Sheet& sheet, double expected) {
  std::vector<Triangle> triangles;
  ASSERT_TRUE(triangulate(sheet.points, sheet.face, triangles));
  bool all_forward = false;
  EXPECT_NEAR(areaOf(sheet, triangles, all_forward), expected, 1e-9 * std::max(1.0, expected));
  EXPECT_TRUE(all_forward);
}

TEST(Triangulation, OfConvexAndConcavePolygons) {
  Sheet quad;
  quad.face.outer = quad.add({{0, 0}, {2, 0}, {2, 1}, {0, 1}});
  expectArea(quad, 2);
  Sheet arrow;
  arrow.face.outer = arrow.add({{0, 0}, {2, 0}, {2, 2}, {1.9, 0.1}});
  expectArea(arrow, 0.2);
}

TEST(Triangulation, UsesCollinearPointsSoThatNeighboursMatch) {
  Sheet sheet;
  sheet.face.outer = sheet.add({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}});
  std::vector<Triangle> triangles;
  ASSERT_TRUE(triangulate(sheet.points, sheet.face, triangles));
  EXPECT_EQ(triangles.size(), 6u);
  expectArea(sheet, 4);
}

TEST(Triangulation, OfHolesThatTouchTheOutlineAndEachOther) {
  Sheet sheet;
  sheet.face.outer = sheet.add({{0, 0}, {6, 0}, {6, 6}, {0, 6}});
  sheet.face.holes.push_back(sheet.add({{0, 3}, {1, 4}, {2, 3}, {1, 2}}));  // corner on the outline's edge
  sheet.face.holes.push_back(sheet.add({{2, 3}, {3, 4}, {4, 3}, {3, 2}}));  // corner on the other hole's
  sheet.face.holes.push_back(sheet.add({{4, 1}, {5, 1}, {5, 2}}));          // turned the other way
  expectArea(sheet, 36 - 2 - 2 - 0.5);
}

TEST(Triangulation, OfAKeyholeOutlineThatRunsAnEdgeTwice) {
  Sheet sheet;
  sheet.face.outer = sheet.add({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}});
  expectArea(sheet, 12);
}

TEST(Triangulation, OfRepeatedAndNearlyPlanarPoints) {
  Sheet sheet;
  sheet.face.outer = sheet.add({{0, 0}, {0, 0}, {3, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}, {0, 0}});
  expectArea(sheet, 5);
  sheet.points[4] += sheet.place.linear() * Vector3d(0, 0, 1e-4);
  std::vector<Triangle> triangles;
  EXPECT_TRUE(triangulate(sheet.points, sheet.face, triangles));
}

TEST(Triangulation, RefusesWhatIsNoPolygon) {
  const auto refuses = [](const Sheet& sheet) {
    std::vector<Triangle> triangles;
    const bool done = triangulate(sheet.points, sheet.face, triangles);
    return !done && triangles.empty();
  };
  Sheet sheet;
  EXPECT_TRUE(refuses(sheet));
  sheet.face.outer = sheet.add({{0, 0}, {1, 1}});
  EXPECT_TRUE(refuses(sheet));
  Sheet line;
  line.place.setIdentity();
  line.face.outer = line.add({{0, 0}, {1, 0}, {2, 0}, {3, 0}});
  EXPECT_TRUE(refuses(line));
  Sheet nan;
  nan.face.outer = nan.add({{0, 0}, {1, 0}, {NAN, 1}});
  EXPECT_TRUE(refuses(nan));
  Sheet out;
  out.face.outer = {0, 1, 2};
  EXPECT_TRUE(refuses(out));
  Sheet crossing;
  crossing.face.outer = crossing.add({{0, 0}, {4, 0}, {4, 1}, {1, -1}, {0, 3}});
  EXPECT_TRUE(refuses(crossing));
}

// Star-shaped around the origin: simple by construction, with an area that is the sum of its spokes' triangles.
std::vector<Eigen::Vector2d> star(std::mt19937& random, int n, double low, double high, double& area) {
  std::uniform_real_distribution<double> radius(low, high);
  std::vector<Eigen::Vector2d> loop;
  for (int i = 0; i < n; ++i) {
    const double r = radius(random), angle = 2 * std::numbers::pi * i / n;
    loop.emplace_back(r * std::cos(angle), r * std::sin(angle));
  }
  area = 0;
  for (int i = 0; i < n; ++i) {
    const auto &a = loop[static_cast<std::size_t>(i)], &b = loop[static_cast<std::size_t>((i + 1) % n)];
    area += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  return loop;
}

TEST(Triangulation, OfRandomStarsWithHolesKeepsTheArea) {
  std::mt19937 random(5);
  for (int round = 0; round < 500; ++round) {
    Sheet sheet;
    double outer = 0, inner = 0;
    // Spokes at most 60° apart: an outer edge stays further out than half its shorter end, the hole further in.
    const int n = 6 + static_cast<int>(random() % 120);
    sheet.face.outer = sheet.add(star(random, n, 1.0, 3.0, outer));
    if (round % 2)
      sheet.face.holes.push_back(sheet.add(star(random, 3 + static_cast<int>(random() % 20), 0.1, 0.45, inner)));
    expectArea(sheet, outer - inner);
  }
}

TEST(Triangulation, OfALargePolygonIsDoneInSeconds) {
  std::mt19937 random(6);
  Sheet sheet;
  double outer = 0;
  sheet.face.outer = sheet.add(star(random, 50000, 1.0, 3.0, outer));
  const double begin = test::ownSeconds();
  expectArea(sheet, outer);
  EXPECT_LT(test::ownSeconds() - begin, 5);
}

TEST(Triangulation, OfAnOutlineThatRunsToAndFroOnOneLineIsGivenUp) {
  // 1,000 edges on each other would be cut at every end of every other one, and their pieces again.
  std::mt19937 random(7);
  std::uniform_real_distribution<double> along(0, 100);
  std::vector<Eigen::Vector2d> loop{{50, 1e-7}};
  for (int i = 0; i < 1000; ++i) loop.emplace_back(i % 2 ? along(random) : -along(random), 0);
  Sheet sheet;
  sheet.face.outer = sheet.add(loop);
  std::vector<Triangle> triangles;
  EXPECT_FALSE(triangulate(sheet.points, sheet.face, triangles));
}

}  // namespace
}  // namespace standpoint::geometry
