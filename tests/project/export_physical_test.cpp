// SPDX-License-Identifier: GPL-3.0-or-later
#include <fstream>

#include "tests/project/support.h"

namespace standpoint {
namespace {

using nlohmann::json;

Document assignedHouse() {
  auto outcome = run("materials", twoStoreyDocument(), {{"assign", {"class:IfcSlab=granite_grey"}}});
  EXPECT_TRUE(outcome) << describe(outcome.error());
  return outcome->document;
}

TEST(ExportPhysical, CarriesTheMaterialsInAGltfAsAnExtension) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "house.gltf";
  ASSERT_TRUE(run("export", assignedHouse(), {{"output", file.string()}}));
  const auto gltf = json::parse(std::ifstream(file));
  EXPECT_EQ(gltf.at("extensionsUsed"), json::array({"STANDPOINT_physical_material"}));
  std::vector<std::string> ids;
  for (const auto& material : gltf.at("materials"))
    ids.push_back(material.at("extensions").at("STANDPOINT_physical_material").at("id"));
  // One look, "Concrete", of two materials: the slabs, and what the rules say of the rest.
  EXPECT_EQ(ids.size(), 2U);
  EXPECT_NE(std::find(ids.begin(), ids.end(), "granite_grey"), ids.end());
  EXPECT_EQ(gltf.at("materials")[0].at("name"), "Concrete");
}

TEST(ExportPhysical, ComesBackWithAGltfThatIsImported) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "house.glb";
  ASSERT_TRUE(run("export", assignedHouse(), {{"output", file.string()}}));
  const auto imported = run("import", {}, {{"files", {file.string()}}});
  ASSERT_TRUE(imported) << describe(imported.error());
  const auto outcome = run("materials", imported->document, json::object());
  ASSERT_TRUE(outcome) << describe(outcome.error());
  std::size_t slabs = 0;
  const auto& assignment = outcome->document.materials->result.assignment;
  for (const auto& s : assignment.surfaces) {
    EXPECT_EQ(s.reason, "from the file");
    slabs += assignment.materials[static_cast<std::size_t>(s.material)].id == "granite_grey" ? 1 : 0;
  }
  EXPECT_EQ(slabs, 3U);
}

TEST(ExportPhysical, NamesTheMaterialsOfAnObjWhereThatIsAskedFor) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "house.obj";
  const auto mtl = [&] {
    std::ifstream in(folder.path() / "house.mtl");
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  ASSERT_TRUE(run("export", assignedHouse(), {{"output", file.string()}, {"physical", true}}));
  EXPECT_NE(mtl().find("newmtl granite_grey\n"), std::string::npos);
  ASSERT_TRUE(run("export", assignedHouse(), {{"output", file.string()}}));
  EXPECT_NE(mtl().find("newmtl Concrete\n"), std::string::npos);
}

TEST(ExportPhysical, WithoutMaterialsIsRefusedWithTheVerbThatAssignsThem) {
  const TemporaryFolder folder;
  for (const char* name : {"scene.xml", "house.obj"}) {
    const auto outcome =
        run("export", twoStoreyDocument(), {{"output", (folder.path() / name).string()}, {"physical", true}});
    ASSERT_FALSE(outcome);
  }
  const auto outcome = run("export", twoStoreyDocument(), {{"output", (folder.path() / "scene.xml").string()}});
  ASSERT_FALSE(outcome);
  EXPECT_NE(outcome.error().message.find("assign them first"), std::string::npos);
}

}  // namespace
}  // namespace standpoint
