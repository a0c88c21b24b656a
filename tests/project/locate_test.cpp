// SPDX-License-Identifier: GPL-3.0-or-later
#include <fstream>

#include <gmock/gmock.h>

#include "project/survey/locate_verb.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;

void cloudFile(const fs::path& file, double x_m, int points = 3) {
  std::ofstream out(file);
  for (int i = 0; i < points; ++i) out << x_m + i << " 0 " << i << '\n';
}

class Locate : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(there());
    cloudFile(at("hall.xyz"), 500000);
    cloudFile(at("roof.xyz"), 500005, 4);
    for (const char* name : {"hall.xyz", "roof.xyz"}) document = done("underlay", {{"add", at(name)}}).document;
    document = done("station", {{"add", "S1"}, {"on", {500002, 5600002, 0}}}).document;
    const auto scanned = done(
        "scan",
        {{"instrument", "faro-focus-s350"}, {"set", {"resolution=1/32", "quality=4x"}}, {"output", at("scan.e57")}});
    document = scanned.document;
  }
  std::string at(const std::string& name) const { return (folder_.path() / name).string(); }
  fs::path there() const { return folder_.path() / "there"; }
  std::string thereAt(const char* name) const { return (there() / name).string(); }
  void move(const char* name) const { fs::rename(at(name), thereAt(name)); }
  Outcome done(const char* verb, const json& options) const {
    auto outcome = run(verb, document, options);
    EXPECT_TRUE(outcome) << verb << ": " << describe(outcome.error());
    return outcome ? *outcome : Outcome{document};
  }
  std::string refused(const json& options) const {
    const auto outcome = run("locate", document, options);
    return outcome ? "not refused" : describe(outcome.error());
  }
  TemporaryFolder folder_;
  Document document = twoStoreyDocument();
};

TEST_F(Locate, ListsTheFilesOfAProjectAndWhetherTheyAreThere) {
  move("hall.xyz");
  const auto listed = done("locate", json::object());
  EXPECT_TRUE(listed.description.empty());
  const auto& files = listed.answer.at("files");
  ASSERT_EQ(files.size(), 3u);
  EXPECT_EQ(files[0].at("used_by"), json({"scan of S1"}));
  EXPECT_EQ(files[0].at("there"), true);
  EXPECT_EQ(files[1].at("file"), at("hall.xyz"));
  EXPECT_EQ(files[1].at("there"), false);
}

TEST_F(Locate, PointsTheProjectAtTheNewPlaceOfAScanAndOfAnUnderlay) {
  move("hall.xyz");
  move("scan.e57");
  const auto hall = done("locate", {{"file", "hall.xyz"}, {"to", thereAt("hall.xyz")}});
  EXPECT_EQ(hall.description, "Located hall.xyz");
  EXPECT_EQ(hall.document.underlays[0]->file, thereAt("hall.xyz"));
  EXPECT_EQ(hall.document.underlays[0]->file_from_cloud.translation,
            document.underlays[0]->file_from_cloud.translation);
  EXPECT_EQ(document.underlays[0]->file, at("hall.xyz")) << "a verb changes no document: undo is the one before";
  const auto scan = done("locate", {{"file", at("scan.e57")}, {"to", thereAt("scan.e57")}});
  EXPECT_EQ(scan.document.job->stations[0].scans[0].file, thereAt("scan.e57"));
}

TEST_F(Locate, FindsAllThatAreMissingInAFolder) {
  for (const char* name : {"hall.xyz", "roof.xyz", "scan.e57"}) move(name);
  const auto found = done("locate", {{"to", there().string()}});
  EXPECT_EQ(found.description, "Located 3 files");
  for (const auto& file : filesOf(found.document)) EXPECT_TRUE(file.there) << file.file;
}

TEST_F(Locate, LeavesOutOfAFolderWhatIsAnotherFileAndSaysSo) {
  for (const char* name : {"hall.xyz", "roof.xyz"}) move(name);
  cloudFile(there() / "roof.xyz", 500005, 5);
  const auto found = done("locate", {{"to", there().string()}});
  EXPECT_EQ(found.answer.at("located").size(), 1u);
  EXPECT_THAT(said(found.report), HasSubstr("another cloud: it has 5 points, underlay roof has 4"));
}

TEST_F(Locate, RefusesAFileOfAnotherKindOrContent) {
  move("scan.e57");
  const auto model = at("m.obj");
  std::ofstream(model) << "v 0 0 0\n";
  EXPECT_THAT(refused({{"file", "scan.e57"}, {"to", model}}), HasSubstr("m.obj: this is no point cloud"));
  EXPECT_THAT(refused({{"file", "scan.e57"}, {"to", at("hall.xyz")}}), HasSubstr("this is another file: it has 3"));
  std::ofstream(at("broken.e57")) << "no E57 at all";
  EXPECT_THAT(refused({{"file", "scan.e57"}, {"to", at("broken.e57")}}), HasSubstr("broken.e57"));
  cloudFile(at("beside.xyz"), 500001);
  EXPECT_THAT(refused({{"file", "hall.xyz"}, {"to", at("beside.xyz")}}), HasSubstr("in another place"));
}

TEST_F(Locate, RefusesWhatItCannotMean) {
  EXPECT_THAT(refused({{"to", there().string()}}), HasSubstr("are where it has them"));
  EXPECT_THAT(refused({{"file", "hall.xyz"}}), HasSubstr("--to"));
  EXPECT_THAT(refused({{"file", "cellar.xyz"}, {"to", at("hall.xyz")}}), HasSubstr("does not use this file; it uses"));
  EXPECT_THAT(refused({{"file", "hall.xyz"}, {"to", at("none.xyz")}}), HasSubstr("none.xyz: file not found"));
  EXPECT_THAT(refused({{"file", "hall.xyz"}, {"to", there().string()}}), HasSubstr("no file of this name"));
  for (const char* name : {"hall.xyz", "roof.xyz"}) move(name);
  EXPECT_THAT(refused({{"to", thereAt("hall.xyz")}}), HasSubstr("2 files are missing: specify a folder"));
}

}  // namespace
}  // namespace standpoint
