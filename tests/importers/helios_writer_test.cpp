// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/helios/helios_writer.h"

#include <cmath>
#include <fstream>

#include <gtest/gtest.h>

#include "tests/importers/mesh_files.h"

namespace standpoint::test {
namespace {

namespace fs = std::filesystem;

class HeliosScene : public ::testing::Test {
 protected:
  HeliosScene() {
    brick_.id = "brick";
    brick_.label = "Brick";
    brick_.reflectance = {{532, 0.1}, {1064, 0.5}};
    pane_ = brick_;
    pane_.id = "pane";
    pane_.transmittance = {{532, 0.9}};
    auto mesh = std::make_shared<Mesh>();
    mesh->positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh->triangles = {{0, 1, 2}, {0, 2, 1}, {1, 2, 0}};
    mesh->surface_of_triangle = {0, 1, 2};
    environment_.surfaces = {{"Red brick, with spaces"}, {"glass"}, {"who knows"}};
    environment_.meshes = {mesh};
    environment_.products.resize(1);
    environment_.instances = {{0, 0, Eigen::Affine3d::Identity()}};
  }
  Report written() {
    Report report;
    Progress progress;
    const auto done =
        writeHeliosScene(environment_, {&brick_, &pane_, nullptr}, {}, folder_ / "my scene.xml", report, progress);
    EXPECT_TRUE(done) << describe(done.error());
    return report;
  }
  // As its reader takes them: 26 lines of header; below the first wavelength it interpolates from (0, 0).
  double reflectanceByHelios(const std::string& spectrum, double wavelength_um) const {
    std::ifstream in(folder_ / "spectra" / (spectrum + ".txt"));
    std::string line;
    for (int i = 0; i < 26; ++i) std::getline(in, line);
    double before_w = 0, before_r = 0, w = 0, r = 0;
    while (std::getline(in, line)) {
      const auto tab = line.find('\t');
      w = std::stod(line.substr(0, tab));
      r = std::stod(line.substr(tab + 1));
      if (w >= wavelength_um) break;
      before_w = w, before_r = r;
    }
    return before_r + (wavelength_um - before_w) / (w - before_w) * (r - before_r);
  }

  Environment environment_;
  PhysicalMaterial brick_, pane_;
  fs::path folder_ = scratch();
};

TEST_F(HeliosScene, HasASpectrumOfEachMaterialThatReadsBackAsItsReflectance) {
  written();
  EXPECT_NEAR(reflectanceByHelios("brick", 0.798), 30, 1e-3);  // half way
  EXPECT_NEAR(reflectanceByHelios("brick", 0.4), 10, 1e-3);    // below what was measured
  EXPECT_NEAR(reflectanceByHelios("brick", 1.55), 50, 1e-3);   // and above
}

TEST_F(HeliosScene, NamesItsFilesAndMaterialsWithoutSpaces) {
  written();
  EXPECT_NE(readBytes(folder_ / "my scene.xml").find("value=\"my_scene.obj\""), std::string::npos);
  const auto mtl = readBytes(folder_ / "my_scene.mtl");
  EXPECT_NE(mtl.find("newmtl brick\n"), std::string::npos);
  EXPECT_NE(mtl.find("helios_spectra brick\n"), std::string::npos);
  EXPECT_NE(readBytes(folder_ / "my_scene.obj").find("usemtl unassigned_2\n"), std::string::npos);
}

TEST_F(HeliosScene, TellsWhatHeliosHasNoWordsFor) {
  const auto report = written();
  std::string all;
  for (const auto& issue : report.issues) all += issue.message + "\n";
  EXPECT_NE(all.find("panes are opaque"), std::string::npos);
  EXPECT_NE(all.find("no material assigned"), std::string::npos);
}

TEST_F(HeliosScene, ThatCannotBeWrittenIsAnErrorWithItsFile) {
  Report report;
  Progress progress;
  const auto done =
      writeHeliosScene(environment_, {&brick_, &pane_, nullptr}, {}, "/nonexistent/scene.xml", report, progress);
  ASSERT_FALSE(done);
  EXPECT_NE(describe(done.error()).find("/nonexistent/"), std::string::npos);
}

}  // namespace
}  // namespace standpoint::test
