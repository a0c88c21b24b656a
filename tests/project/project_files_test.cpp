// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/storage/project_files.h"

#include <csignal>
#include <fstream>
#include <sys/resource.h>

#include <gtest/gtest.h>

#include "project/storage/session.h"
#include "project/survey/file_places.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

namespace fs = std::filesystem;

std::string textOf(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void writeText(const fs::path& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; }

void expectSameGeometry(const Environment& a, const Environment& b) {
  ASSERT_EQ(a.meshes.size(), b.meshes.size());
  for (std::size_t i = 0; i < a.meshes.size(); ++i) {
    EXPECT_EQ(a.meshes[i]->positions, b.meshes[i]->positions) << i;
    EXPECT_EQ(a.meshes[i]->triangles, b.meshes[i]->triangles) << i;
    EXPECT_EQ(a.meshes[i]->surface_of_triangle, b.meshes[i]->surface_of_triangle) << i;
  }
  ASSERT_EQ(a.instances.size(), b.instances.size());
  for (std::size_t i = 0; i < a.instances.size(); ++i) {
    EXPECT_EQ(a.instances[i].mesh, b.instances[i].mesh);
    EXPECT_EQ(a.instances[i].product, b.instances[i].product);
    EXPECT_EQ(a.instances[i].world_from_mesh.matrix(), b.instances[i].world_from_mesh.matrix());
  }
  EXPECT_EQ(a.surfaces, b.surfaces);
}

Document fullDocument() {
  Document d = twoStoreyDocument();
  auto e = std::make_shared<Environment>(*d.imported);
  e->instances[3].world_from_mesh.rotate(Eigen::AngleAxisd(0.1234567890123, Eigen::Vector3d::UnitZ()));
  e->products[1].properties = {{"Pset_WallCommon", "FireRating", "F30 \"a\" \xC3\xA4"}};
  e->products[1].layers = {{"Plaster", 0.015}};
  d.imported = e;
  Georeference g = *d.georeference;
  g.crs = "EPSG:25832";
  g.map_from_file = MapConversion{0.1, 1e7 / 3, 2, 0.6, 0.8, 1.0000001};
  g.site = GeographicPosition{48.1, 11.5, 510};
  g.true_north_rad = 0.25;
  d.georeference = std::make_shared<const Georeference>(g);
  d.scanning = std::make_shared<const ScanChoice>(
      ScanChoice{.instrument = "leica-rtc360",
                 .settings = {{"resolution", "3mm"}},
                 .seed = 7,
                 .effects = Effects().without(Effect::striping).without(Effect::panes),
                 .weather = {5, 2, 0, 120, 0},
                 .truth = true,
                 .compensator = false,
                 .panorama = true,
                 .panorama_columns = 2048,
                 .quality = ScanQuality::preview});
  return run("station", d, {{"add", "S1"}, {"at", {500002.1, 5600002, 1.6}}, {"yaw-deg", 33.3}})->document;
}

TEST(Project, ComesBackFromTheDiskAsItWas) {
  const TemporaryFolder folder;
  Progress progress;
  const Document d = fullDocument();
  ASSERT_TRUE(saveProject(d, folder.path() / "p", progress));
  const auto back = loadProject(folder.path() / "p", progress);
  ASSERT_TRUE(back) << describe(back.error());
  expectSameGeometry(*d.imported, *back->imported);
  EXPECT_EQ(back->imported->products[1].properties[0].value, "F30 \"a\" \xC3\xA4");
  EXPECT_EQ(back->imported->products[1].layers[0].thickness_m, 0.015);
  EXPECT_EQ(back->georeference->shift_m, d.georeference->shift_m);
  EXPECT_EQ(back->georeference->map_from_file->northings_m, 1e7 / 3);
  EXPECT_EQ(*back->georeference->true_north_rad, 0.25);
  EXPECT_EQ(back->job->stations[0].true_pose.rotation.coeffs(), d.job->stations[0].true_pose.rotation.coeffs());
  EXPECT_EQ(*back->scanning, *d.scanning);
  EXPECT_EQ(back->name, "p");
}

TEST(Project, SavedTwiceHasTheSameFiles) {
  const TemporaryFolder folder;
  Progress progress;
  const Document d = fullDocument();
  ASSERT_TRUE(saveProject(d, folder.path(), progress));
  std::vector<std::string> first;
  for (const auto& f : fs::recursive_directory_iterator(folder.path())) first.push_back(f.path().string());
  ASSERT_TRUE(saveProject(*loadProject(folder.path(), progress), folder.path(), progress));
  std::vector<std::string> second;
  for (const auto& f : fs::recursive_directory_iterator(folder.path())) second.push_back(f.path().string());
  std::sort(first.begin(), first.end());
  std::sort(second.begin(), second.end());
  EXPECT_EQ(first, second);
}

// A full disk, by the limit on the size of a file: writing fails in the middle with EFBIG.
TEST(Project, FindsScansThatMoveWithItAndThoseThatStay) {
  const TemporaryFolder folder, elsewhere;
  Progress progress;
  fs::create_directory(folder / "site");
  Document d = fullDocument();
  Job job = *d.job;
  job.stations[0].scans = {{.file = (folder / "site" / "S1.e57").string()}, {.file = (elsewhere / "S1.e57").string()}};
  job.trajectories = {{.name = "T1", .file = (folder / "site" / "p" / "T1.csv").string(), .format = "csv"}};
  d.job = std::make_shared<const Job>(job);
  ASSERT_TRUE(saveProject(d, folder / "site" / "p", progress));
  fs::rename(folder / "site", folder / "moved");
  const auto back = loadProject(folder / "moved" / "p", progress);
  ASSERT_TRUE(back) << describe(back.error());
  const auto& scans = back->job->stations[0].scans;
  EXPECT_EQ(scans[0].file, (folder / "moved" / "S1.e57").string());
  EXPECT_EQ(scans[1].file, (elsewhere / "S1.e57").string());
  EXPECT_EQ(back->job->trajectories[0].file, (folder / "moved" / "p" / "T1.csv").string());
}

// As projects of before had them.
TEST(Project, FindsAScanWhereTheCommandLineRanThatMadeIt) {
  const TemporaryFolder folder;
  EXPECT_EQ(placeOf("S1.e57", folder.path()), folder / "S1.e57") << "it is nowhere";
  const auto relative = fs::path(SOURCE_DIR).lexically_relative(fs::current_path()) / "README.md";
  EXPECT_EQ(placeOf(relative.string(), folder.path()), fs::path(SOURCE_DIR) / "README.md");
}

TEST(Project, IsAsItWasBeforeWhenTheDiskIsFull) {
  const TemporaryFolder folder;
  Progress progress;
  Document d = fullDocument();
  ASSERT_TRUE(saveProject(d, folder.path(), progress));
  const auto before = textOf(folder.path() / "project.json");

  auto bigger = std::make_shared<Environment>(*d.imported);
  bigger->products[0].name = std::string(5000, 'x');
  d.imported = bigger;
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit limit{};
  getrlimit(RLIMIT_FSIZE, &limit);
  const rlimit small{1500, limit.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const auto saved = saveProject(d, folder.path(), progress);
  setrlimit(RLIMIT_FSIZE, &limit);

  ASSERT_FALSE(saved);
  EXPECT_EQ(saved.error().kind, ErrorKind::file_system);
  EXPECT_EQ(textOf(folder.path() / "project.json"), before);
  EXPECT_TRUE(loadProject(folder.path(), progress));
}

TEST(Project, FromANewerProgramIsRefusedWithARemedy) {
  const TemporaryFolder folder;
  Progress progress;
  ASSERT_TRUE(saveProject(fullDocument(), folder.path(), progress));
  auto text = textOf(folder.path() / "project.json");
  const auto at = text.find("\"version\": 1");
  ASSERT_NE(at, std::string::npos);
  writeText(folder.path() / "project.json", text.replace(at, 12, "\"version\": 9"));
  const auto back = loadProject(folder.path(), progress);
  ASSERT_FALSE(back);
  EXPECT_EQ(back.error().kind, ErrorKind::unusable);
  EXPECT_NE(back.error().message.find("newer"), std::string::npos);
  EXPECT_NE(back.error().source.find("/version"), std::string::npos);
}

TEST(Project, OfEachVersionThatThereWasIsRead) {
  int versions = 0;
  for (const auto& sample : fs::directory_iterator(SOURCE_DIR "/tests/projects")) {
    Progress progress;
    Report report;
    const auto d = loadProject(sample.path(), progress, &report);
    ASSERT_TRUE(d) << describe(d.error());
    EXPECT_EQ(said(report), "") << sample.path();
    ++versions;
    ASSERT_EQ(d->job->stations.size(), 2U);
    EXPECT_EQ(d->job->stations[0].name, "S1");
    ASSERT_EQ(d->job->stations[0].scans.size(), 1U);
    EXPECT_FALSE(d->job->stations[0].scans[0].as_scanned) << "which was not kept then";
    EXPECT_TRUE(d->job->stations[1].solved_pose);
    EXPECT_EQ(d->job->targets.size(), 1U);
    EXPECT_TRUE(d->simplified && d->collision && d->materials && d->scanning && d->verification && d->treatments);
    EXPECT_EQ(d->underlays.size(), 1U);
    EXPECT_EQ(d->georeference->crs, "EPSG:25832");
    EXPECT_GT(triangleCount(*d->imported), 100U);
  }
  EXPECT_EQ(versions, kProjectVersion) << "a new version keeps a sample of the one before";
}

TEST(Project, SaysThatADamagedComparisonIsDropped) {
  const TemporaryFolder folder;
  Progress progress;
  for (const char* part : {"{}", "7", "{\"basis\": 5}", "{\"basis\": \"1\", \"answer\": []}"}) {
    ASSERT_TRUE(saveProject(fullDocument(), folder.path(), progress));
    auto text = textOf(folder.path() / "project.json");
    text.insert(1, std::string("\"verification\": ") + part + ",");
    writeText(folder.path() / "project.json", text);
    Report report;
    const auto back = loadProject(folder.path(), progress, &report);
    ASSERT_TRUE(back) << part << ": " << describe(back.error());
    EXPECT_FALSE(back->verification);
    EXPECT_NE(said(report).find("/verification: the comparison with an underlay is damaged"), std::string::npos)
        << part;
    Progress again;
    const auto listed = runOnDisk(*findVerb(verbs(), "station"), {{"project", folder.path().string()}}, again);
    ASSERT_TRUE(listed) << describe(listed.error());
    EXPECT_NE(said(listed->report).find("compare again"), std::string::npos);
  }
}

TEST(Project, ThatIsNotThereIsAFileSystemErrorWithARemedy) {
  Progress progress;
  const auto back = loadProject("/nonexistent/project", progress);
  ASSERT_FALSE(back);
  EXPECT_EQ(back.error().kind, ErrorKind::file_system);
  EXPECT_NE(back.error().message.find("import a model"), std::string::npos);
}

TEST(Project, DamagedAnywhereIsAnErrorAndNeverACrash) {
  const TemporaryFolder folder;
  Progress progress;
  ASSERT_TRUE(saveProject(fullDocument(), folder.path(), progress));
  const auto whole = textOf(folder.path() / "project.json");
  for (std::size_t cut = 0; cut < whole.size(); cut += whole.size() / 60 + 1) {
    writeText(folder.path() / "project.json", whole.substr(0, cut));
    EXPECT_FALSE(loadProject(folder.path(), progress)) << cut;
  }
  for (std::size_t at = 0; at < whole.size(); at += whole.size() / 200 + 1) {
    auto mutated = whole;
    mutated[at] = mutated[at] == '1' ? '9' : '1';
    writeText(folder.path() / "project.json", mutated);
    (void)loadProject(folder.path(), progress);
  }
  writeText(folder.path() / "project.json", whole);
  for (const auto& part : fs::directory_iterator(folder.path() / "geometry")) {
    const auto content = textOf(part.path());
    writeText(part.path(), content.substr(0, content.size() / 2));
    EXPECT_FALSE(loadProject(folder.path(), progress)) << part.path();
    writeText(part.path(), content);
  }
  EXPECT_TRUE(loadProject(folder.path(), progress));
}

}  // namespace
}  // namespace standpoint
