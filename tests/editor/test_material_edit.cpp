// SPDX-License-Identifier: GPL-3.0-or-later
#include <fstream>

#include <gtest/gtest.h>

#include "editor/model/material_edit.h"
#include "materials/materials.h"
#include "project/verb.h"

namespace standpoint {
namespace {

std::filesystem::path library() { return std::filesystem::path(dataFolder()) / "materials" / "library"; }

Result<std::vector<PhysicalMaterial>> readBack(const MaterialEdit& edit) {
  const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
  const auto file = std::filesystem::temp_directory_path() / (std::string("standpoint-") + info->name() + ".json");
  std::ofstream(file) << libraryFileOf(edit).dump();
  auto own = readOwnMaterials(file, library());
  std::filesystem::remove(file);
  return own;
}

TEST(MaterialEdit, OfEveryShippedMaterialThatIsNoMetalOrGapReadsBackAsALibrary) {
  const auto shipped = readMaterialLibrary(library());
  ASSERT_TRUE(shipped);
  for (const auto& m : *shipped) {
    if (!m.complex_index.empty() || isGap(m)) continue;
    const auto edit = editOf(m);
    ASSERT_EQ(flawOf(edit), "") << m.id;
    const auto own = readBack(edit);
    ASSERT_TRUE(own) << m.id << ": " << describe(own.error());
    ASSERT_EQ(own->size(), 1U);
    EXPECT_NEAR(atWavelength(own->front().reflectance, 905), atWavelength(m.reflectance, 905), 0.0006) << m.id;
    EXPECT_EQ(own->front().panes, m.panes) << m.id;
  }
}

TEST(MaterialEdit, KeepsWhatTheUserSaysOfItsFigures) {
  MaterialEdit edit;
  edit.id = "my_wall";
  edit.label = "My wall";
  edit.reflectance_percent.fill(30);
  edit.source = "spectrometer, 3 May, sample 7";
  const auto own = readBack(edit);
  ASSERT_TRUE(own) << describe(own.error());
  EXPECT_NE(own->front().sources.front().text.find("sample 7"), std::string::npos);
  edit.source.clear();
  EXPECT_EQ(readBack(edit)->front().sources.front().text.rfind("unsourced", 0), 0U);
}

TEST(MaterialEdit, SaysWhatIsWrongBeforeItIsKept) {
  MaterialEdit edit;
  EXPECT_NE(flawOf(edit), "");
  edit.id = "My Wall";
  edit.label = "x";
  EXPECT_NE(flawOf(edit).find("a-z"), std::string::npos);
  edit.id = "my_wall";
  EXPECT_EQ(flawOf(edit), "");
  edit.gloss_slope = 0.1;
  EXPECT_NE(flawOf(edit).find("index"), std::string::npos);
}

TEST(MaterialEdit, ThatSendsBackMoreThanItGetsIsRefusedByTheReader) {
  MaterialEdit edit;
  edit.id = "mirror";
  edit.label = "Mirror";
  edit.reflectance_percent.fill(99);
  edit.gloss_slope = 0.1;
  edit.index_of_refraction = 1.5;
  const auto own = readBack(edit);
  ASSERT_FALSE(own);
  EXPECT_NE(describe(own.error()).find("exceed 1"), std::string::npos);
}

}  // namespace
}  // namespace standpoint
