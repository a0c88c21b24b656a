// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <fstream>

#include <gtest/gtest.h>

#include "core/data_folder.h"
#include "editor/model/material_edit.h"
#include "materials/materials.h"
#include "project/verb.h"
#include "tests/temporary_folder.h"

namespace standpoint {
namespace {

std::filesystem::path library() { return std::filesystem::path(dataFolder()) / "materials" / "library"; }

Result<std::vector<PhysicalMaterial>> readBack(const MaterialEdit& edit) {
  const TemporaryFolder folder;
  return readOwnMaterials(folder.write("own.json", libraryFileOf(edit).dump()), library());
}

TEST(MaterialEdit, OfEveryShippedMaterialThatIsNoGapReadsBackAsALibrary) {
  const auto shipped = readMaterialLibrary(library());
  ASSERT_TRUE(shipped);
  for (const auto& m : *shipped) {
    if (isGap(m)) continue;
    const auto edit = editOf(m);
    ASSERT_EQ(flawOf(edit), "") << m.id;
    const auto own = readBack(edit);
    ASSERT_TRUE(own) << m.id << ": " << describe(own.error());
    ASSERT_EQ(own->size(), 1U);
    EXPECT_NEAR(atWavelength(own->front().reflectance, 905), atWavelength(m.reflectance, 905), 0.0006) << m.id;
    EXPECT_EQ(own->front().panes, m.panes) << m.id;
    EXPECT_DOUBLE_EQ(own->front().gap_m, m.gap_m) << m.id;
    EXPECT_EQ(own->front().complex_index, m.complex_index) << m.id;
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

// Gold at 1000 nm: n = 0.257, k = 6.82 (Johnson and Christy), of which F0 = ((n - 1)² + k²) / ((n + 1)² + k²) = 0.979.
TEST(MaterialEdit, OfAMetalHasRowsOfNAndK) {
  MaterialEdit edit;
  edit.id = "gold";
  edit.label = "Gold";
  edit.metal = true;
  EXPECT_NE(flawOf(edit), "");
  addIndexRow(edit, 0);
  edit.complex_index[0] = {1000, 0.257, 6.82};
  EXPECT_EQ(flawOf(edit), "");
  edit.index_of_refraction = 1.5;  // of before it was called a metal: it does not come along
  edit.pane = true;
  const auto own = readBack(edit);
  ASSERT_TRUE(own) << describe(own.error());
  EXPECT_NEAR(specularAtNormal(own->front(), 905), 0.979, 0.0005);
  EXPECT_EQ(own->front().index_of_refraction, 0);
}

TEST(MaterialEdit, AddsRowsHalfwayAndBehindAndTakesThemAway) {
  MaterialEdit edit;
  edit.complex_index = {{600, 1, 4}, {800, 2, 6}};
  addIndexRow(edit, 0);
  EXPECT_EQ(edit.complex_index, (std::vector<ComplexIndex>{{600, 1, 4}, {700, 1.5, 5}, {800, 2, 6}}));
  addIndexRow(edit, 2);
  EXPECT_EQ(edit.complex_index.back(), (ComplexIndex{900, 2, 6}));
  takeIndexRow(edit, 1);
  EXPECT_EQ(edit.complex_index, (std::vector<ComplexIndex>{{600, 1, 4}, {800, 2, 6}, {900, 2, 6}}));
}

TEST(MaterialEdit, OfAMetalSaysWhichRowIsWrong) {
  MaterialEdit edit;
  edit.id = "metal";
  edit.label = "Metal";
  edit.metal = true;
  const auto flaw = [&](std::vector<ComplexIndex> rows) {
    edit.complex_index = std::move(rows);
    const auto said = flawOf(edit);
    EXPECT_EQ(said.empty(), readBack(edit).has_value()) << said;  // no more and no less than the reader
    return said;
  };
  EXPECT_EQ(flaw({{532, 1, 1}, {905, 1, 1}}), "");
  EXPECT_NE(flaw({{905, 1, 1}, {532, 1, 1}}).find("Row 2: wavelengths must increase"), std::string::npos);
  EXPECT_NE(flaw({{905, 1, 1}, {905, 1, 1}}).find("Row 2"), std::string::npos);
  EXPECT_NE(flaw({{100, 1, 1}}).find("Row 1: wavelength must be from 200 to 20 000 nm"), std::string::npos);
  EXPECT_NE(flaw({{905, 0, 1}}).find("n must be from"), std::string::npos);
  EXPECT_NE(flaw({{905, 1, -1}}).find("k must be from"), std::string::npos);
  EXPECT_NE(flaw({{905, 1, std::nan("")}}).find("k must be from"), std::string::npos);
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
