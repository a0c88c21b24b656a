// SPDX-License-Identifier: GPL-3.0-or-later
#include <fstream>

#include <gmock/gmock.h>

#include "pointclouds/formats.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;

// The lower room with two stations and four spheres of 20 cm; scanned once for all tests.
class Registration : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    Document d = twoStoreyDocument();
    d = run("station", d, {{"add", "S1"}, {"at", {500001.5, 5600001, 1.6}}})->document;
    d = run("station", d, {{"add", "S2"}, {"at", {500004.5, 5600001.8, 1.6}}, {"yaw-deg", 140}})->document;
    const std::vector<json> targets = {
        {{"add", "K1"}, {"on", {500003, 5600001}}, {"height", 1.4}, {"type", "sphere-200"}},
        {{"add", "K2"}, {"on", {500002.2, 5600003.4}}, {"height", 2.2}, {"type", "sphere-200"}},
        {{"add", "K3"}, {"on", {500003.3, 5600003.2}}, {"height", 0.5}, {"type", "sphere-200"}},
        {{"add", "K4"}, {"on-surface", {500003.6, 5600000.1, 2.1}}, {"type", "sphere-200"}}};
    for (const auto& t : targets) d = run("target", d, t)->document;
    scanned_ = new Document(*scan(d, "ideal.e57", true));
    noisy_ = new Document(*scan(d, "noisy.e57", false));
  }
  static void TearDownTestSuite() { delete scanned_, delete noisy_, delete folder_; }

  static std::optional<Document> scan(const Document& d, const std::string& file, bool ideal) {
    const auto done = run(
        "scan", d,
        {{"instrument", "faro-focus-s350"}, {"set", {"resolution=1/16"}}, {"ideal", ideal}, {"output", path(file)}});
    EXPECT_TRUE(done) << describe(done.error());
    return done ? std::optional(done->document) : std::nullopt;
  }
  static std::string path(const std::string& file) { return (folder_->path() / file).string(); }
  static std::string refused(const Document& d, const json& options) {
    const auto done = run("register", d, options);
    return done ? "registered" : describe(done.error());
  }
  static TemporaryFolder* folder_;
  static Document* scanned_;
  static Document* noisy_;
};
TemporaryFolder* Registration::folder_ = nullptr;
Document* Registration::scanned_ = nullptr;
Document* Registration::noisy_ = nullptr;

double shiftError(const Station& s) { return (s.solved_pose->translation - s.true_pose.translation).norm(); }

TEST_F(Registration, ByTargetsOfAnIdealScanSolvesTheTruthAndKeepsItApart) {
  const auto done = run("register", *scanned_, {{"files", {path("ideal.e57")}}});
  ASSERT_TRUE(done) << describe(done.error());
  const auto& stations = done->document.job->stations;
  ASSERT_TRUE(stations[1].solved_pose);
  EXPECT_EQ(stations[1].true_pose.translation, scanned_->job->stations[1].true_pose.translation);
  EXPECT_LT(shiftError(stations[1]), 2e-4) << "the spheres' facets are 0.1 mm off";
  EXPECT_FALSE(scanned_->job->stations[1].solved_pose) << "the old value is untouched";
  const json& link = done->answer.at("links").at(0);
  EXPECT_EQ(link.at("targets"), 4);
  EXPECT_LT(link.at("rms_m").get<double>(), 3e-4);
  EXPECT_EQ(done->answer.at("measured").at("found").size(), 8U);
}

TEST_F(Registration, WithNoiseTellsResidualsSmallerThanItsTrueErrors) {
  const auto done = run("register", *noisy_, {{"files", {path("noisy.e57")}}});
  ASSERT_TRUE(done) << describe(done.error());
  const double off = shiftError(done->document.job->stations[1]);
  EXPECT_LT(off, 0.005) << "range 1 mm, angles 19 seconds at 3 m";
  EXPECT_GT(off, 1e-5);
  EXPECT_DOUBLE_EQ(done->answer.at("stations").at(1).at("true_error_m").get<double>(), off);
  const json& link = done->answer.at("links").at(0);
  EXPECT_NEAR(link.at("unbiased_m").get<double>(), link.at("rms_m").get<double>() * std::sqrt(2.0), 1e-12)
      << "√(3n / (3n − 6)), n = 4";
  EXPECT_THAT(done->text, HasSubstr("S1 – S2: 4 targets"));
}

// Poses and the first point of each scan of a file.
class PoseSink : public PointSink {
 public:
  std::vector<ScanHeader> headers;
  std::vector<Eigen::Vector3f> first;
  Result<void> begin(const ScanHeader& h) override { return headers.push_back(h), Result<void>(); }
  Result<void> write(const PointBlock& b) override {
    if (first.size() < headers.size() && b.size() > 0) first.emplace_back(b.x_m[0], b.y_m[0], b.z_m[0]);
    return {};
  }
  Result<void> end() override { return {}; }
  Result<void> close() override { return {}; }
};

PoseSink readBack(const fs::path& file) {
  PoseSink sink;
  Progress progress;
  const auto read = cloudFormatFor(file)->read(file, sink, progress);
  EXPECT_TRUE(read) << describe(read.error());
  return sink;
}

TEST_F(Registration, WritesCopiesOfTheScansWithTheirSolvedPoses) {
  const fs::path to = path("registered");
  const auto done = run("register", *noisy_, {{"files", {path("noisy.e57")}}, {"output", to.string()}});
  ASSERT_TRUE(done) << describe(done.error());
  EXPECT_EQ(done->answer.at("files"), json({(to / "noisy.e57").string()}));
  const auto as_scanned = readBack(path("noisy.e57")), registered = readBack(to / "noisy.e57");
  ASSERT_EQ(registered.headers.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& station = done->document.job->stations[i];
    const auto& pose = registered.headers[i].file_from_scanner;
    EXPECT_EQ(registered.headers[i].name, station.name);
    EXPECT_LT((pose.translation - station.solved_pose->translation - Eigen::Vector3d(500000, 5600000, 0)).norm(), 1e-9);
    EXPECT_LT(pose.rotation.angularDistance(station.solved_pose->rotation), 1e-9);
    EXPECT_EQ(registered.first[i], as_scanned.first[i]) << "points are in the scanner's frame";
    EXPECT_NE(registered.headers[i].guid, as_scanned.headers[i].guid);
    EXPECT_THAT(registered.headers[i].description, HasSubstr("pose by registration"));
  }
  const double moved =
      (registered.headers[1].file_from_scanner.translation - as_scanned.headers[1].file_from_scanner.translation)
          .norm();
  EXPECT_NEAR(moved, shiftError(done->document.job->stations[1]), 1e-9)
      << "level stations are scanned with the true pose";
  EXPECT_GT(moved, 1e-5);
  // One file in, another format out.
  ASSERT_TRUE(run("register", *noisy_, {{"files", {path("noisy.e57")}}, {"output", path("one.ptx")}}));
  EXPECT_LT((readBack(path("one.ptx")).headers[1].file_from_scanner.translation -
             registered.headers[1].file_from_scanner.translation)
                .norm(),
            1e-5);
  EXPECT_THAT(refused(*noisy_, {{"files", {path("noisy.e57")}}, {"output", path("")}}),
              HasSubstr("overwrite the input"));
  EXPECT_THAT(refused(*noisy_, {{"files", {path("noisy.e57")}}, {"output", path("nowhere/x.e57")}}),
              AllOf(HasSubstr("nowhere"), HasSubstr("create it")));
  EXPECT_EQ(readBack(path("noisy.e57")).headers[1].guid, as_scanned.headers[1].guid) << "the input is as it was";
}

TEST_F(Registration, ByGeometryNeedsNoNames) {
  const auto done = run("register", *noisy_, {{"files", {path("noisy.e57")}}, {"by", "geometry"}});
  ASSERT_TRUE(done) << describe(done.error());
  EXPECT_EQ(done->answer.at("wrong_matches"), 0);
  EXPECT_LT(shiftError(done->document.job->stations[1]), 0.005);
}

TEST_F(Registration, CloudToCloudOfAnIdealScanComesBackFromWhereItWasLaidByEye) {
  const auto done = run("register", *scanned_, {{"files", {path("ideal.e57")}}, {"cloud", true}, {"fix", "S2"}});
  ASSERT_TRUE(done) << describe(done.error());
  EXPECT_LT(shiftError(done->document.job->stations[0]), 5e-4);
  EXPECT_EQ(shiftError(done->document.job->stations[1]), 0);
}

TEST_F(Registration, CloudToCloudStartsFromWhereTheUserHasLaidTheScan) {
  const auto near =
      run("register", *scanned_, {{"files", {path("ideal.e57")}}, {"cloud", true}, {"start-offset", "0.1,-0.1,2"}});
  ASSERT_TRUE(near) << describe(near.error());
  EXPECT_LT(shiftError(near->document.job->stations[1]), 5e-4);
  // The wrong way round a fit cannot find back, whatever it says of itself: only the true error tells.
  const auto turned =
      run("register", *scanned_, {{"files", {path("ideal.e57")}}, {"cloud", true}, {"start-offset", "0,0,180"}});
  EXPECT_TRUE(!turned || turned->answer.at("stations").back().at("true_turn_error_deg").get<double>() > 90);
  for (const char* wrong : {"1,2", "1,2,3,4", "a,b,c", "1,2,inf"})
    EXPECT_THAT(refused(*scanned_, {{"files", {path("ideal.e57")}}, {"cloud", true}, {"start-offset", wrong}}),
                HasSubstr("x,y,turn"))
        << wrong;
}

TEST_F(Registration, ByControlPointsHoldsNoStationAndKeepsThePoints) {
  std::ofstream control(path("control.txt"));
  control.precision(12);
  control << "# a list\n";
  for (const auto& t : scanned_->job->targets)
    control << t.name << ' ' << t.centre.x() + 500000 << ' ' << t.centre.y() + 5600000 << ' ' << t.centre.z() << " 2\n";
  control << "extra 1 2 3\n";
  control.close();
  const auto done = run("register", *scanned_, {{"files", {path("ideal.e57")}}, {"control", path("control.txt")}});
  ASSERT_TRUE(done) << describe(done.error());
  for (const auto& s : done->document.job->stations) EXPECT_LT(shiftError(s), 2e-4);
  EXPECT_EQ(done->document.job->control_points.size(), 5U);
  std::ofstream(path("bad.txt")) << "K1 1 2 3\nK2 1 2\n";
  EXPECT_THAT(refused(*scanned_, {{"files", {path("ideal.e57")}}, {"control", path("bad.txt")}}),
              HasSubstr("bad.txt line 2"));
}

TEST_F(Registration, SaysWhatIsWrong) {
  const json file = {path("ideal.e57")};
  Document few = *scanned_;
  few = run("target", few, {{"remove", "K4"}})->document;
  EXPECT_TRUE(run("register", few, {{"files", file}}));
  few = run("target", few, {{"remove", "K3"}})->document;
  EXPECT_THAT(refused(few, {{"files", file}}), HasSubstr("2 targets, at least three are required"));
  // A target that was not there when it was scanned: nothing near its place.
  few = run("target", few, {{"add", "late"}, {"on", {500005.3, 5600000.8}}, {"height", 1.2}})->document;
  const auto late = refused(few, {{"files", file}});
  EXPECT_THAT(late, HasSubstr("ideal.e57: 2 targets were measured from station S1"));
  EXPECT_THAT(late, HasSubstr("; late: "));
  EXPECT_THAT(refused(*scanned_, {{"files", file}, {"fix", "S9"}}), HasSubstr("unknown station 'S9'"));
  EXPECT_THAT(refused(*scanned_, {{"files", {path("ideal.e57"), path("noisy.e57")}}}),
              HasSubstr("station S1 is also in"));
  Document other = twoStoreyDocument();
  other.job = std::make_shared<const Job>(Job{"", {}, scanned_->job->targets, {}});
  EXPECT_THAT(refused(other, {{"files", file}}), HasSubstr("'S1' matches no station"));
  std::ofstream(path("list.xyz")) << "0 0 0\n1 0 0\n";
  EXPECT_THAT(refused(*scanned_, {{"files", {path("list.xyz")}}}), HasSubstr("has no scanner grid"));
  EXPECT_THAT(refused(*scanned_, {{"files", {path("none.e57")}}}), HasSubstr("none.e57"));
}

}  // namespace
}  // namespace standpoint
