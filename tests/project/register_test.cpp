// SPDX-License-Identifier: GPL-3.0-or-later
#include <fstream>

#include <gmock/gmock.h>

#include "project/survey/underlays.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;

// The test model without its table, scanned without noise from one place in the lower room (frame of the file: 500 000,
// 5 600 000).
Document scannedRoom(const fs::path& file, bool ideal = true) {
  Document d = run("station", twoStoreyDocument(), {{"add", "S1"}, {"at", {500002, 5600001.5, 1.6}}})->document;
  const auto done = run(
      "scan", d,
      {{"instrument", "faro-focus-s350"}, {"set", {"resolution=1/16"}}, {"ideal", ideal}, {"output", file.string()}});
  EXPECT_TRUE(done) << describe(done.error());
  return done->document;
}

double worstCorner(const Underlay& u) {
  double worst = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d p(500000 + 6.0 * (corner & 1), 5600000 + 2.0 * (corner & 2), 0.75 * (corner & 4));
    worst = std::max(worst, (u.file_from_cloud * p - p).norm());
  }
  return worst;
}

class Registered : public ::testing::Test {
 protected:
  // The cloud as scanned, shifted by (dx, dy, dz) and turned about the room.
  Document laid(const Document& d, const Eigen::Vector3d& shift, double yaw_deg) {
    const Eigen::Vector3d pivot(500003, 5600002, 0);
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(yaw_deg * M_PI / 180, Eigen::Vector3d::UnitZ()));
    const Eigen::Vector3d at = pivot + shift - turn * pivot;
    return run("underlay", d,
               {{"add", file_.string()}, {"name", "cloud"}, {"at", {at.x(), at.y(), at.z()}}, {"yaw-deg", yaw_deg}})
        ->document;
  }
  TemporaryFolder folder_;
  fs::path file_ = folder_.path() / "scan.e57";
};

TEST_F(Registered, ToTheSurfaceComesBackFromAKnownMotion) {
  const Document d = laid(scannedRoom(file_), {0.15, -0.1, 0.05}, 1.5);
  EXPECT_GT(worstCorner(*d.underlays[0]), 0.2);
  const auto done = run("underlay", d, {{"register", "cloud"}, {"icp", true}});
  ASSERT_TRUE(done) << describe(done.error());
  EXPECT_LT(worstCorner(*done->document.underlays[0]), 5e-5) << "what an E57 and a float keep";
  const auto& icp = done->answer.at("registered").at("icp");
  EXPECT_GT(icp.at("used_share").get<double>(), 0.95);
  EXPECT_TRUE(icp.at("not_held").empty());
}

TEST_F(Registered, WithNoiseComesBackWithinTheInstrumentsAccuracy) {
  const Document d = laid(scannedRoom(file_, false), {-0.1, 0.12, 0}, -1);
  const auto done = run("underlay", d, {{"register", "cloud"}, {"icp", true}});
  ASSERT_TRUE(done) << describe(done.error());
  EXPECT_LT(worstCorner(*done->document.underlays[0]), 0.003);  // its range accuracy is 1 mm, its angles' 19"
}

TEST_F(Registered, ByPairsAndThenToTheSurfaceFromFarAway) {
  const Document d = laid(scannedRoom(file_), {-400, 300, 20}, 77);
  const json pairs = {"500000,5600000,0=500000.02,5599999.99,0.01", "500006,5600000,0=500006.01,5600000.01,0",
                      "500000,5600004,0=500000,5600004.02,0", "500000,5600000,2.8=500000,5600000,2.79"};
  const auto by_pairs = run("underlay", d, {{"register", "cloud"}, {"pairs", pairs}});
  ASSERT_TRUE(by_pairs) << describe(by_pairs.error());
  EXPECT_LT(worstCorner(*by_pairs->document.underlays[0]), 0.04);
  const auto& rows = by_pairs->answer.at("registered").at("pairs");
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_GT(rows[0].at("residual_m").get<double>(), 0.001);
  const auto both = run("underlay", d, {{"register", "cloud"}, {"pairs", pairs}, {"icp", true}});
  ASSERT_TRUE(both);
  EXPECT_LT(worstCorner(*both->document.underlays[0]), 5e-5);
}

TEST_F(Registered, TellsAScaleAndGuessesItsUnit) {
  std::ofstream(file_.replace_extension("xyz")) << "0 0 0\n1000 0 0\n";
  const Document d =
      run("underlay", twoStoreyDocument(), {{"add", file_.string()}, {"name", "mm"}, {"at", {500000, 5600000, 0}}})
          ->document;
  const auto done =
      run("underlay", d,
          {{"register", "mm"},
           {"pairs", {"0,0,0=500000,5600000,0", "6000,0,0=500006,5600000,0", "0,4000,0=500000,5600004,0"}}});
  ASSERT_TRUE(done) << describe(done.error());
  EXPECT_THAT(said(done->report), HasSubstr("not applied: the cloud unit seems to be millimetres"));
}

TEST_F(Registered, SaysWhatIsWrongWithItsOptions) {
  std::ofstream(file_.replace_extension("xyz")) << "0 0 0\n1 0 0\n";
  const Document d = run("underlay", twoStoreyDocument(), {{"add", file_.string()}, {"name", "cloud"}})->document;
  const auto message = [&](const json& options) {
    const auto done = run("underlay", d, options);
    return done ? std::string("fine") : done.error().message;
  };
  EXPECT_THAT(message({{"register", "cloud"}}), HasSubstr("--pairs"));
  EXPECT_THAT(message({{"icp", true}}), HasSubstr("--register"));
  EXPECT_THAT(message({{"register", "cloud"}, {"pairs", {"0,0,0=1,1"}}}),
              HasSubstr("'0,0,0=1,1' must be X,Y,Z in the cloud"));
  EXPECT_THAT(message({{"register", "cloud"}, {"pairs", {"0,0,0=0,0,0", "1,1,1=1,1,1", "2,2,2=2,2,2"}}}),
              HasSubstr("collinear"));
  EXPECT_THAT(message({{"register", "cloud"}, {"icp", true}}), HasSubstr("only 2 distinct points in the cloud"));
  EXPECT_THAT(message({{"register", "clod"}, {"icp", true}}), HasSubstr("available: cloud"));
}

}  // namespace
}  // namespace standpoint
