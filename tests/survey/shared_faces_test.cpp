// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/scene/shared_faces.h"

#include "tests/project/support.h"

namespace standpoint {
namespace {

const Eigen::Vector3d kUp = Eigen::Vector3d::UnitZ();

// The table's lower face lies in the upper one of the slab.
Document tableOf(const char* material) {
  return run("materials", twoStoreyDocument(),
             {{"assign", {"class:IfcSlab=concrete_construction", std::string("table=") + material}}})
      ->document;
}

bool sharedAt(const Document& d, const Eigen::Vector3d& place, const Eigen::Vector3d& normal) {
  const auto& assignment = d.materials->result.assignment;
  std::int32_t slab = -1;
  for (std::size_t m = 0; m < assignment.materials.size(); ++m)
    if (assignment.materials[m].id == "concrete_construction") slab = static_cast<std::int32_t>(m);
  return SharedFaces(*d.environment(), assignment).at(place, normal, slab);
}

TEST(SharedFaces, AreWhereFacesOfTwoMaterialsLieInOnePlace) {
  const Document d = tableOf("bark");
  EXPECT_TRUE(sharedAt(d, {4.5, 3, 0}, kUp));
  EXPECT_TRUE(sharedAt(d, {4.5, 3, 0.0005}, kUp));
  EXPECT_FALSE(sharedAt(d, {1, 1, 0}, kUp)) << "the slab alone";
  EXPECT_FALSE(sharedAt(d, {4.5, 3, 0.003}, kUp)) << "a layer of its own";
  EXPECT_FALSE(sharedAt(d, {4, 3, 0.3}, kUp)) << "the table's side is not level";
  EXPECT_FALSE(sharedAt(tableOf("concrete_construction"), {4.5, 3, 0}, kUp)) << "whichever it is, it is of the same";
}

}  // namespace
}  // namespace standpoint
