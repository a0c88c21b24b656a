// SPDX-License-Identifier: GPL-3.0-or-later
// What a Boolean may leave where a tool's face fell on the host's.
#include <gtest/gtest.h>

#include "importers/ifc/shapes/flaps.h"

namespace standpoint::ifc {
namespace {

using geometry::PolyMesh;

// A sheet of 1 × 1 m that goes on from a box of 1 m along its lower face, up and back 1 µm below.
PolyMesh boxWithSheet() {
  PolyMesh mesh = geometry::box({1, 1, 1});
  const auto base = static_cast<std::uint32_t>(mesh.points.size());
  for (const double z : {0.0, 1e-6})
    for (const auto& [x, y] : {std::pair{1.0, 0.0}, {2.0, 0.0}, {2.0, 1.0}, {1.0, 1.0}})
      mesh.points.emplace_back(x, y, z);
  geometry::Face down, up;
  down.outer = {base + 3, base + 2, base + 1, base};
  up.outer = {base + 4, base + 5, base + 6, base + 7};
  mesh.faces.push_back(down);
  mesh.faces.push_back(up);
  return mesh;
}

TEST(IfcFlaps, ASheetWithoutThicknessIsSeen) {
  EXPECT_TRUE(hasFlaps(boxWithSheet()));
  EXPECT_FALSE(hasFlaps(geometry::box({1, 1, 1})));
  EXPECT_FALSE(hasFlaps(geometry::box({1, 1, 0.0005})));  // a metal sheet is thin, but a body
}

TEST(IfcFlaps, TwoBodiesThatOnlyTouchInALineHaveNone) {
  PolyMesh mesh = geometry::box({1, 1, 1}), beside = geometry::box({1, 1, 1});
  geometry::transform(beside, Eigen::Affine3d(Eigen::Translation3d(1, 0, 1)));
  geometry::append(mesh, beside);
  EXPECT_FALSE(hasFlaps(mesh));
}

TEST(IfcFlaps, AGrownToolHasEachFaceThatMuchFurtherOut) {
  EXPECT_NEAR(geometry::volume(grown(geometry::box({1, 2, 3}), 0.001)), 1.002 * 2.002 * 3.002, 1e-9);
  // A thin plate that lies askew: its thickness grows as its length does, which scaling its box would not do.
  PolyMesh plate = geometry::box({2, 0.002, 0.5});
  geometry::transform(plate, Eigen::Affine3d(Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 3).normalized())));
  EXPECT_NEAR(geometry::volume(grown(plate, 1e-4)), 2.0002 * 0.0022 * 0.5002, 1e-9);
}

}  // namespace
}  // namespace standpoint::ifc
