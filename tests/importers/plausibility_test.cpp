// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/plausibility.h"

#include <gmock/gmock.h>

namespace standpoint::test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

// Rectangles with a normal along one axis.
void addRectangle(Mesh& mesh, int axis, double at, Eigen::Vector3d size) {
  const auto base = static_cast<std::uint32_t>(mesh.positions.size());
  for (int i = 0; i < 4; ++i) {
    Eigen::Vector3d p;
    p[axis] = at;
    p[(axis + 1) % 3] = i == 1 || i == 2 ? size[(axis + 1) % 3] : 0;
    p[(axis + 2) % 3] = i >= 2 ? size[(axis + 2) % 3] : 0;
    mesh.positions.push_back(p.cast<float>());
  }
  mesh.triangles.push_back({base, base + 1, base + 2});
  mesh.triangles.push_back({base, base + 2, base + 3});
  mesh.surface_of_triangle.resize(mesh.triangles.size(), 0);
}

// A house of two storeys: outer walls, three slabs with two sides each.
Environment house(double scale, bool lying = false) {
  const Eigen::Vector3d size(12, 9, 6);
  auto mesh = std::make_shared<Mesh>();
  for (const int axis : {0, 1, 2})
    for (const double share : {0.0, 1.0}) addRectangle(*mesh, axis, share * size[axis], size);
  for (const double z : {0.3, 2.7, 3.0, 5.7}) addRectangle(*mesh, 2, z, size);
  for (auto& p : mesh->positions) {
    if (lying) p = {p.x(), -p.z(), p.y()};
    p *= static_cast<float>(scale);
  }
  Environment e;
  e.meshes = {mesh};
  e.surfaces.resize(1);
  e.products.resize(1);
  e.instances.push_back({});
  return e;
}

TEST(Plausibility, AHouseInMetresIsNotDoubted) { EXPECT_THAT(plausibility(house(1), {}), IsEmpty()); }

TEST(Plausibility, AHouseOfSixKilometresIsInMillimetres) {
  const auto issues = plausibility(house(1000), {});
  ASSERT_THAT(issues, SizeIs(1));
  EXPECT_EQ(issues[0].severity, Severity::warning);
  EXPECT_THAT(issues[0].message, HasSubstr("6 km high"));
  EXPECT_THAT(issues[0].message, HasSubstr("--unit mm"));
}

TEST(Plausibility, AUnitThatTheUserStatedIsDoubtedToo) {
  const auto tiny = plausibility(house(0.001), {.metres_per_unit = 0.001, .unit_stated = true});
  ASSERT_THAT(tiny, SizeIs(1));
  EXPECT_THAT(tiny[0].message, HasSubstr("look like metres"));
}

TEST(Plausibility, AHouseOnItsSideIsPointedOutUnlessTheAxisWasStated) {
  const auto issues = plausibility(house(1, true), {});
  ASSERT_THAT(issues, SizeIs(1));
  EXPECT_THAT(issues[0].message, HasSubstr("--up z"));
  EXPECT_THAT(plausibility(house(1, true), {.up_stated = true}), IsEmpty());
}

TEST(Plausibility, AModelWithoutFacesHasNothingToDoubt) { EXPECT_THAT(plausibility({}, {}), IsEmpty()); }

}  // namespace
}  // namespace standpoint::test
