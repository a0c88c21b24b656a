// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/data_folder.h"
#include "survey/instruments.h"
#include "survey/quality/place_verdict.h"
#include "survey/stations/station_places.h"
#include "survey/stations/survey_plan.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

// Ground of 20 x 20 m with a wall, a roof to stand on, and what a test puts there.
class PlaceOnGround : public testing::Test {
 protected:
  void SetUp() override {
    addBox(*environment, "ground", "IfcSlab", {-10, -10, -0.5}, {10, 10, 0});
    addBox(*environment, "wall", "IfcWallStandardCase", {1, -3, 0}, {1.5, 3, 3});
    addBox(*environment, "roof", "IfcRoof", {-8, 4, 2.8}, {-3, 9, 3});
    environment->surfaces.push_back({"grey", {0.5F, 0.5F, 0.5F, 1}, "", {}, {}});
    build();
  }
  void build() {
    Progress progress;
    scene = *RayScene::build(environment, progress);
    placement = std::make_unique<StationPlacement>(*scene, *readTripodStand(tripodStandFile()), kUsualTrunnion_m);
  }
  PlaceVerdict judge(const Eigen::Vector3d& above, double height_m = 1.6) const {
    const auto hit = scene->intersect(above, -Eigen::Vector3d::UnitZ(), 100);
    EXPECT_TRUE(hit);
    return judgePlace(*placement, *hit, height_m, 0.5);
  }
  std::shared_ptr<Environment> environment = std::make_shared<Environment>();
  std::shared_ptr<const RayScene> scene;
  std::unique_ptr<StationPlacement> placement;
};

TEST_F(PlaceOnGround, IsGoodWhereNothingSpeaksAgainstIt) {
  const auto place = judge({-4, -4, 5});
  EXPECT_EQ(place.verdict, Verdict::good);
  EXPECT_EQ(place.brief, "Good place");
}

TEST_F(PlaceOnGround, IsRefusedNearerToAWallThanTwentyCentimetresAndSaysHowNear) {
  const auto place = judge({0.82, 0, 1});
  EXPECT_EQ(place.verdict, Verdict::bad);
  EXPECT_EQ(place.brief, "18 cm from wall");
  EXPECT_NE(place.reason.find("move it 20 mm away"), std::string::npos) << place.reason;
}

TEST_F(PlaceOnGround, IsDoubtfulNearerThanTheInstrumentMeasures) {
  const auto place = judge({0.6, 0, 1});
  EXPECT_EQ(place.verdict, Verdict::warn);
  EXPECT_EQ(place.brief, "40 cm from wall");
}

TEST_F(PlaceOnGround, AStationThatStandsThereIsJudgedAsThePlaceWas) {
  const auto stands = [&](const Eigen::Vector3d& centre, bool on_tripod = true) {
    return judgeStation(*placement, centre, on_tripod, 0.5);
  };
  EXPECT_EQ(stands({-4, -4, 1.6}).brief, "Good place");
  EXPECT_EQ(stands({0.6, 0, 1.6}).verdict, Verdict::warn);
  EXPECT_EQ(stands({0.6, 0, 1.6}).brief, "40 cm from wall");
  EXPECT_EQ(stands({0.82, 0, 1.6}).brief, "18 cm from wall");
  EXPECT_NE(stands({0.82, 0, 1.6}).reason.find("move it 20 mm away"), std::string::npos);
  EXPECT_EQ(stands({-5.5, 6.5, 4.6}).brief, "On a roof");
  EXPECT_EQ(stands({-4, -4, 8}).verdict, Verdict::bad) << "no tripod is so high";
  EXPECT_EQ(stands({-4, -4, 8}, false).verdict, Verdict::good) << "it hangs";
  EXPECT_EQ(stands({0.6, 0, 2.9}, false).brief, "40 cm from wall");
  EXPECT_EQ(stands({0.82, 0, 2.9}, false).verdict, Verdict::bad);
}

TEST_F(PlaceOnGround, InsideAWallIsRefusedAsSuch) {
  const auto hit = scene->intersect({1.25, 0, -0.001}, Eigen::Vector3d::UnitZ(), 100);
  const auto why = placement->whyNot({1.25, 0, 1.6});
  ASSERT_TRUE(why && hit);
  EXPECT_EQ(why->brief, "In a wall");
}

TEST_F(PlaceOnGround, OnARoofIsDoubtful) {
  const auto place = judge({-5.5, 6.5, 8});
  EXPECT_EQ(place.verdict, Verdict::warn);
  EXPECT_EQ(place.brief, "On a roof");
}

TEST_F(PlaceOnGround, OnTheTopOfAWallHasNoGroundUnderTheFeet) {
  EXPECT_EQ(judge({1.25, 0, 8}).brief, "No ground under the feet");
}

TEST_F(PlaceOnGround, ThatIsSteepSaysHowSteep) {
  auto mesh = std::make_shared<Mesh>();
  mesh->positions = {{-9, -9, 0.2F}, {-5, -9, 3.5F}, {-5, -5, 3.5F}, {-9, -5, 0.2F}};
  mesh->triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh->surface_of_triangle = {0, 0};
  const auto number = static_cast<std::uint32_t>(environment->meshes.size());
  environment->meshes.push_back(mesh);
  environment->products.emplace_back();
  environment->instances.push_back({number, number, Eigen::Affine3d::Identity()});
  build();
  EXPECT_EQ(judge({-7, -7, 8}).brief, "On a slope of 40°");
}

TEST(PlaceBrief, NamesAProductAsPeopleDo) {
  Product product;
  EXPECT_EQ(someKind(product), "an object");
  product.ifc_class = "IfcWallStandardCase";
  EXPECT_EQ(someKind(product), "a wall");
  product.ifc_class = "IfcOpeningElement";
  EXPECT_EQ(someKind(product), "an opening element");
}

TEST(PlaceVerdictWithForecast, WarnsOfALowOverlapWithAllStations) {
  PlaceForecast forecast;
  EXPECT_EQ(withForecast({Verdict::good, "Good place", {}}, forecast).verdict, Verdict::good) << "the first station";
  forecast.overlaps = {{"K1", 0.001, 4}};
  EXPECT_EQ(withForecast({Verdict::good, "Good place", {}}, forecast).brief, "Overlaps no other station");
  forecast.overlaps = {{"K1", 0.05, 4}, {"K2", 0.12, 5}};
  const auto low = withForecast({Verdict::good, "Good place", {}}, forecast);
  EXPECT_EQ(low.verdict, Verdict::warn);
  EXPECT_EQ(low.brief, "Overlaps K2 by 12 %");
  forecast.overlaps.push_back({"K3", 0.6, 6});
  EXPECT_EQ(withForecast({Verdict::good, "Good place", {}}, forecast).verdict, Verdict::good) << "one is enough";
  forecast.overlaps[0] = {"K1", 1, 0.2};
  EXPECT_EQ(withForecast({Verdict::good, "Good place", {}}, forecast).brief, "20 cm from K1");
  EXPECT_EQ(withForecast({Verdict::bad, "In a wall", {}}, forecast).brief, "In a wall");
}

TEST(PlaceVerdictWithForecast, IsNeverBetterThanAFigureThatHasASign) {
  const auto verdictOf = [](const PlaceForecast& forecast) {
    return withForecast({Verdict::good, "Good place", {}}, forecast);
  };
  PlaceForecast forecast;
  forecast.incidence_rad = 1.52;  // 87°, which other stations see less slanting
  EXPECT_EQ(verdictOf(forecast).verdict, Verdict::good);
  forecast.spacing_m = 0.004;
  EXPECT_EQ(spacingVerdict(forecast), Verdict::good);
  EXPECT_EQ(verdictOf(forecast).verdict, Verdict::good);
  forecast.spacing_m = 0.04;
  EXPECT_EQ(spacingVerdict(forecast), Verdict::warn);
  EXPECT_EQ(verdictOf(forecast).brief, "Points 40 mm apart");
  forecast.others = 2;
  EXPECT_EQ(overlapVerdict(forecast), Verdict::warn);
  EXPECT_EQ(verdictOf(forecast).brief, "No other station nearby");
  forecast.overlaps = {{"K1", 0.05, 4}, {"K2", 0.6, 5}};
  forecast.spacing_m.reset();
  EXPECT_EQ(forecast.largestOverlap(), &forecast.overlaps[1]);
  EXPECT_EQ(overlapVerdict(forecast), Verdict::good);
  EXPECT_EQ(verdictOf(forecast).verdict, Verdict::good);
}

// A room of 6 x 4 x 2.8 m as IfcSpace between the slabs and walls of the ground floor.
class PlaceInRoom : public testing::Test {
 protected:
  void SetUp() override {
    document = twoStoreyDocument();
    auto e = std::make_shared<Environment>(*document.imported);
    addBox(*e, "room", "IfcSpace", {0, 0, 0}, {6, 4, 2.8});
    e->products.back().tangible = false;
    Progress progress;
    scene = *RayScene::build(e, progress);
    const auto instrument = *instrumentById("leica-rtc360");
    settings = *resolveSettings(instrument, {});
    laws = std::make_shared<const Expectation>(scene, std::make_shared<const MaterialAssignment>(),
                                               ReturnLaw(instrument, settings));
    forecaster = *PlaceForecaster::make(laws, progress);
  }
  static Pose at(double x, double y, double z = 1.6) { return {Eigen::Quaterniond::Identity(), {x, y, z}}; }
  Document document;
  std::shared_ptr<const RayScene> scene;
  ScanSettings settings;
  std::shared_ptr<const Expectation> laws;
  std::unique_ptr<PlaceForecaster> forecaster;
};

TEST_F(PlaceInRoom, SeesAllOfARoomButTheDiscBelowAndWhatATableHides) {
  const auto forecast = forecaster->at(at(2, 2), {});
  ASSERT_TRUE(forecast.room && forecast.near_seen);
  EXPECT_EQ(scene->environment().products[*forecast.room].id, "room");
  // Walls, floor and ceiling: 48 + 56 m². The blind disc: its radius is height / tan(60°…); the table hides some more.
  const double blind = std::numbers::pi * std::pow(1.6 / std::tan(-settings.elevation_from_rad), 2);
  EXPECT_NEAR(*forecast.near_seen, 1 - blind / (48 + 56), 0.06);
  EXPECT_LT(*forecast.near_seen, 1 - blind / (48 + 56) + 0.01);
  EXPECT_LT(forecast.model_seen, *forecast.near_seen / 2) << "there is an upper floor, and an outside";
}

TEST_F(PlaceInRoom, WithoutSpacesCountsTheStorey) {
  auto e = std::make_shared<Environment>(*document.imported);
  for (std::size_t p = 0; p < e->products.size(); ++p)
    e->products[p].storey = e->products[p].id.ends_with("0") || e->products[p].id == "table" ? "Ground floor" : "Above";
  Progress progress;
  const auto instrument = *instrumentById("leica-rtc360");
  const auto without = *PlaceForecaster::make(
      std::make_shared<const Expectation>(*RayScene::build(e, progress), std::make_shared<const MaterialAssignment>(),
                                          ReturnLaw(instrument, settings)),
      progress);
  const auto forecast = without->at(at(2, 2), {});
  EXPECT_FALSE(forecast.room);
  EXPECT_EQ(forecast.storey, "Ground floor");
  ASSERT_TRUE(forecast.near_seen);
  EXPECT_GT(*forecast.near_seen, forecast.model_seen);
  EXPECT_LT(*forecast.near_seen, 0.6) << "the outer faces are its, too";
}

TEST_F(PlaceInRoom, TellsSpacingAndIncidenceOfTheRoom) {
  const auto middle = forecaster->at(at(3, 2), {}), corner = forecaster->at(at(0.3, 0.3), {});
  ASSERT_TRUE(middle.spacing_m && corner.spacing_m && middle.incidence_rad && corner.incidence_rad);
  EXPECT_GT(*corner.spacing_m, *middle.spacing_m);
  EXPECT_GT(*corner.incidence_rad, *middle.incidence_rad);
  EXPECT_LT(*middle.incidence_rad, std::numbers::pi / 2);
}

TEST_F(PlaceInRoom, OverlapsAStationBesideItAndNotOneOnAnotherStorey) {
  Station beside, above;
  beside.name = "K1";
  beside.true_pose = at(3.4, 2);
  above.name = "K2";
  above.true_pose = at(3, 2, 4.6);
  const auto forecast = forecaster->at(at(2.8, 2), std::array<const Station*, 2>{&above, &beside});
  ASSERT_EQ(forecast.overlaps.size(), 2U);
  EXPECT_EQ(forecast.overlaps[0].station, "K1") << "nearest first";
  EXPECT_GT(forecast.overlaps[0].fraction, 0.8);
  EXPECT_LT(forecast.overlaps[1].fraction, 0.02);
}

TEST_F(PlaceInRoom, AgreesWithTheSurveyPlan) {
  Job job;
  Station a, b;
  a.name = "A";
  a.true_pose = at(1, 1);
  b.name = "B";
  b.true_pose = at(5, 3.2);
  job.stations = {a, b};
  Progress progress;
  const PlanRequest request{.instrument = *instrumentById("leica-rtc360"),
                            .settings = settings,
                            .stations = {0, 1},
                            .channels = {},
                            .wanted = {}};
  const auto plan = planSurvey(job, scene, std::make_shared<const MaterialAssignment>(), request, progress);
  ASSERT_TRUE(plan);
  const auto forecast = forecaster->at(b.true_pose, std::array<const Station*, 1>{&a});
  EXPECT_NEAR(forecast.overlaps.at(0).fraction, plan->pairs.at(0).overlap(), 1e-9);
}

}  // namespace
}  // namespace standpoint
