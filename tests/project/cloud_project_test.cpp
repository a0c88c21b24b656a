// SPDX-License-Identifier: GPL-3.0-or-later
#include <fstream>

#include <gmock/gmock.h>

#include "project/model/import_verb.h"
#include "project/storage/project_files.h"
#include "project/survey/underlays.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

// In UTM 32N, on its central meridian.
const Eigen::Vector3d kFar(500000, 5600002, 101);

// The corners of a box of 4 x 2 x 3 m from `at`.
std::string cloudFile(const fs::path& file, const Eigen::Vector3d& at) {
  std::ofstream out(file);
  out.precision(17);
  for (int i = 0; i < 8; ++i)
    out << at.x() + ((i & 1) != 0 ? 4 : 0) << ' ' << at.y() + ((i & 2) != 0 ? 2 : 0) << ' '
        << at.z() + ((i & 4) != 0 ? 3 : 0) << '\n';
  return file.string();
}

std::string modelFile(const fs::path& file) {
  std::ofstream(file) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  return file.string();
}

Document projectOf(const std::vector<std::string>& files) {
  auto done = run("import", {}, {{"files", files}});
  EXPECT_TRUE(done) << describe(done.error());
  return done ? done->document : Document();
}

TEST(CloudProject, IsMadeOfACloudAloneAtItsTruePlace) {
  const TemporaryFolder folder;
  const auto done = run("import", {}, {{"files", {cloudFile(folder.path() / "hall.xyz", kFar)}}});
  ASSERT_TRUE(done) << describe(done.error());
  EXPECT_EQ(done->description, "Imported hall.xyz: 8 points");
  EXPECT_TRUE(done->answer.at("products").empty());
  const json corners = {{500000, 5600002, 101}, {500004, 5600004, 104}};
  EXPECT_EQ(done->answer.at("underlays").at(0).at("bounds_in_model"), corners);
  EXPECT_THAT(said(done->report), ::testing::Not(HasSubstr("model")));
  const Document& d = done->document;
  EXPECT_FALSE(d.hasModel());
  EXPECT_EQ(d.name, "hall");
  const Bounds local = fileBounds(siteInFile(d), -d.georeference->shift_m);
  EXPECT_LT(local.min.cwiseAbs().maxCoeff(), 3) << "near the local origin, where a float is exact";
  EXPECT_EQ(d.georeference->shift_m, d.georeference->shift_m.array().round().matrix());
}

TEST(CloudProject, ComesBackFromTheDisk) {
  const TemporaryFolder folder;
  const auto document = projectOf({cloudFile(folder.path() / "hall.xyz", kFar)});
  Progress progress;
  ASSERT_TRUE(saveProject(document, folder.path() / "p", progress));
  const auto back = loadProject(folder.path() / "p", progress);
  ASSERT_TRUE(back) << describe(back.error());
  EXPECT_FALSE(back->hasModel());
  ASSERT_TRUE(back->imported) << "so that it can be saved and measured in";
  EXPECT_EQ(siteInFile(*back).max, siteInFile(document).max);
  EXPECT_EQ(back->georeference->shift_m, document.georeference->shift_m);
}

TEST(CloudProject, IsMeasuredBookmarkedAndLocatedInItsOwnCoordinates) {
  const TemporaryFolder folder;
  auto document = projectOf({cloudFile(folder.path() / "hall.xyz", kFar)});
  const auto measured =
      run("measure", document, {{"add", "width"}, {"points", {"500000,5600002,101", "500004,5600002,101"}}});
  ASSERT_TRUE(measured) << describe(measured.error());
  EXPECT_THAT(measured->answer.dump(), HasSubstr("4.0"));
  EXPECT_TRUE(run("bookmark", document, {{"add", "whole"}}));
  const auto placed = run("georeference", document, {{"crs", "EPSG:25832"}});
  ASSERT_TRUE(placed) << describe(placed.error());
  // The middle of the box is 2 m east of the meridian of 9 degrees.
  EXPECT_NEAR(placed->answer.at("geographic").at("longitude_deg"), 9 + 2 / 70000.0, 1e-5);
  EXPECT_EQ(placed->answer.at("reference_point"), json({500002, 5600003, 102.5}));
}

TEST(CloudProject, RefusesWhatNeedsAModelAndNamesTheRemedy) {
  const TemporaryFolder folder;
  const auto document = projectOf({cloudFile(folder.path() / "hall.xyz", kFar)});
  for (const auto& verb : verbs()) {
    if (verb.without_model || (verb.scope != VerbScope::changes && verb.scope != VerbScope::reads)) continue;
    json options = json::object();
    for (const auto& p : verb.parameters)  // any value: a model is asked for first
      if (p.required) options[p.name] = p.kind == ParameterKind::list ? json({"x.e57"}) : json("leica-rtc360");
    const auto done = run(verb.name, document, options);
    ASSERT_FALSE(done) << verb.name;
    EXPECT_THAT(done.error().message, HasSubstr("add a model first")) << verb.name;
  }
}

TEST(CloudProject, GetsItsModelLater) {
  const TemporaryFolder folder;
  auto document = projectOf({cloudFile(folder.path() / "hall.xyz", {0, 0, 0})});
  const auto added = run("add", document, {{"files", {modelFile(folder.path() / "m.obj")}}});
  ASSERT_TRUE(added) << describe(added.error());
  EXPECT_TRUE(added->document.hasModel());
  EXPECT_EQ(added->document.underlays, document.underlays);
  EXPECT_TRUE(run("materials", added->document, json::object()));
}

TEST(CloudProject, OfSeveralCloudsIsNearAllOfThem) {
  const TemporaryFolder folder;
  const auto document = projectOf({cloudFile(folder.path() / "a.xyz", kFar),
                                   cloudFile(folder.path() / "b.xyz", kFar + Eigen::Vector3d(100, 0, 0))});
  ASSERT_EQ(document.underlays.size(), 2u);
  EXPECT_NEAR(document.georeference->shift_m.x(), 500052, 1);
  const auto far = run("underlay", document, {{"add", cloudFile(folder.path() / "c.xyz", {0, 0, 0})}});
  ASSERT_TRUE(far);
  EXPECT_THAT(said(far->report), HasSubstr("km from")) << "one that is not of this place is told";
}

TEST(CloudProject, TakesCloudsThatComeWithModelsAsTheirUnderlays) {
  const TemporaryFolder folder;
  const auto document =
      projectOf({cloudFile(folder.path() / "hall.xyz", {0, 0, 0}), modelFile(folder.path() / "m.obj")});
  EXPECT_TRUE(document.hasModel());
  EXPECT_EQ(document.name, "m");
  ASSERT_EQ(document.underlays.size(), 1u);
  EXPECT_THAT(document.sources, ElementsAre((folder.path() / "m.obj").string()));
}

TEST(CloudProject, HasTheCrsThatIsGivenForIt) {
  const TemporaryFolder folder;
  const auto file = cloudFile(folder.path() / "hall.xyz", kFar);
  const auto done = run("import", {}, {{"files", {file}}, {"crs", "EPSG:25832"}, {"shift", "500000,5600000,0"}});
  ASSERT_TRUE(done) << describe(done.error());
  EXPECT_EQ(done->document.georeference->crs, "EPSG:25832");
  EXPECT_EQ(done->document.georeference->shift_m, Eigen::Vector3d(500000, 5600000, 0));
}

TEST(CloudProject, IsRefusedWhereFileOrOptionDoesNotFit) {
  const TemporaryFolder folder;
  const auto file = cloudFile(folder.path() / "hall.xyz", kFar);
  const auto refused = [](const json& options) {
    const auto done = run("import", {}, options);
    return done ? std::string() : describe(done.error());
  };
  EXPECT_THAT(refused({{"files", {file}}, {"up", "y"}}), HasSubstr("--up"));
  EXPECT_THAT(refused({{"files", {(folder.path() / "no.e57").string()}}}), HasSubstr("no.e57: file not found"));
  std::ofstream(folder.path() / "empty.xyz") << "";
  EXPECT_THAT(refused({{"files", {(folder.path() / "empty.xyz").string()}}}), HasSubstr("empty.xyz"));
  std::ofstream(folder.path() / "noise.e57") << "no E57 at all";
  EXPECT_THAT(refused({{"files", {(folder.path() / "noise.e57").string()}}}), HasSubstr("noise.e57"));
  EXPECT_THAT(describe(run("import", projectOf({file}), {{"files", {file}}, {"update", true}}).error()),
              HasSubstr("add it as an underlay"));
  EXPECT_THAT(describe(run("add", projectOf({file}), {{"files", {file}}}).error()), HasSubstr("add it as an underlay"));
}

}  // namespace
}  // namespace standpoint
