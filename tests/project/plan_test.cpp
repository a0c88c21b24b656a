// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pointclouds/formats.h"
#include "scanners/forecast/scan_forecast.h"
#include "survey/instruments.h"
#include "survey/stations/survey_plan.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

using nlohmann::json;
using testing::HasSubstr;

constexpr double kPi = std::numbers::pi;
const double kBlind = kPi * std::pow(1.5 / std::tan(kPi / 3), 2);  // of the floor, below a FARO 1.5 m above it

// A room of 10 x 8 x 3 m, drawn as one skin that looks inwards, around (0, 0, 1.5); and what a test puts into it.
Document room(const std::function<void(Environment&)>& add = {}) {
  Document d = twoStoreyDocument();
  auto e = std::make_shared<Environment>();
  e->surfaces = d.imported->surfaces;
  e->spatial = d.imported->spatial;
  addBox(*e, "room", "", {-5, -4, 0}, {5, 4, 3});
  auto mesh = std::make_shared<Mesh>(*e->meshes[0]);
  for (auto& t : mesh->triangles) std::swap(t[1], t[2]);
  e->meshes[0] = mesh;
  if (add) add(*e);
  d.imported = e;
  d.georeference = std::make_shared<const Georeference>();
  return d;
}
constexpr double kRoom_m2 = 2 * (80 + 30 + 24);

void addPlate(Environment& e) {  // 1 m², 2 m in front of (0, 0, 1.5)
  auto m = std::make_shared<Mesh>();
  m->positions = {{2, -0.5F, 1}, {2, 0.5F, 1}, {2, 0.5F, 2}, {2, -0.5F, 2}};
  m->triangles = {{0, 1, 2}, {0, 2, 3}};
  m->surface_of_triangle = {0, 0};
  Product p;
  p.id = "plate";
  p.ifc_class = "IfcPlate";
  e.instances.push_back({static_cast<std::uint32_t>(e.meshes.size()), static_cast<std::uint32_t>(e.products.size()),
                         Eigen::Affine3d::Identity()});
  e.products.push_back(p);
  e.meshes.push_back(m);
}

Document with(Document d, const std::vector<std::pair<const char*, json>>& stations) {
  for (const auto& [name, at] : stations) {
    const auto placed = run("station", d, {{"add", name}, {"at", at}});
    EXPECT_TRUE(placed) << describe(placed.error());
    if (placed) d = placed->document;
  }
  return d;
}

json plan(const Document& d, json more = json::object()) {
  json options = {{"instrument", "faro-focus-s350"}, {"set", {"resolution=1/16", "quality=4x"}}};
  options.update(more);
  const auto done = run("plan", d, options);
  EXPECT_TRUE(done) << describe(done.error());
  return done ? done->answer : json();
}

TEST(Plan, SeesAllOfAnEmptyRoomButTheDiscBelowTheInstrument) {
  const auto p = plan(with(room(), {{"S", {0, 0, 1.5}}}));
  EXPECT_NEAR(p["area_m2"].get<double>(), kRoom_m2, 1e-3);
  EXPECT_NEAR(p["exposed_m2"].get<double>(), kRoom_m2, 1e-3);
  EXPECT_NEAR(p["seen_m2"].get<double>(), kRoom_m2 - kBlind, 0.2);
}

TEST(Plan, MissesTheShadowOfWhatStandsInTheWay) {
  const auto p = plan(with(room(addPlate), {{"S", {0, 0, 1.5}}}));
  EXPECT_NEAR(p["seen_m2"].get<double>(), kRoom_m2 + 1 - kBlind - 6.25, 0.3) << "2.5 m x 2.5 m on the wall behind";
  EXPECT_NEAR(p["classes"][1]["coverage"].get<double>(), 1, 1e-9) << "the plate itself, from one side";
  EXPECT_EQ(p["holes"][0]["id"], "room");
  EXPECT_NEAR(p["holes"][0]["unseen_m2"].get<double>(), kBlind + 6.25, 0.3);
  const auto two = plan(with(room(addPlate), {{"S", {0, 0, 1.5}}, {"T", {4, 0, 1.5}}}));
  EXPECT_NEAR(two["coverage"].get<double>(), 1, 1e-3) << "each sees what the other does not";
}

TEST(Plan, SaysOfEachHoleHowLargeItIsAndWhere) {
  const auto p = plan(with(room(addPlate), {{"S", {0, 0, 1.5}}}));
  ASSERT_EQ(p["patches"].size(), 2U) << "the disc below the scanner, and the plate's shadow";
  const auto &shadow = p["patches"][0], &disc = p["patches"][1];
  EXPECT_EQ(shadow["id"], "room");
  EXPECT_NEAR(shadow["area_m2"].get<double>(), 6.25, 0.3);
  EXPECT_NEAR(disc["area_m2"].get<double>(), kBlind, 0.15);
  EXPECT_NEAR(shadow["at"][0].get<double>(), 5, 1e-6) << "on the wall behind the plate";
  EXPECT_NEAR(shadow["at"][1].get<double>(), 0, 0.2);
  EXPECT_NEAR(shadow["at"][2].get<double>(), 1.5, 0.2);
  EXPECT_NEAR(disc["at"][2].get<double>(), 0, 1e-6) << "on the floor";
  EXPECT_NEAR(std::hypot(disc["at"][0].get<double>(), disc["at"][1].get<double>()), 0, 0.2);
  const double step = 2 * std::numbers::pi / 2556;  // 1/16 of 40,960 on the turn
  EXPECT_GT(shadow["spacing_m"].get<double>(), 3 * step) << "half of the room is farther than 3 m";
  EXPECT_LT(shadow["spacing_m"].get<double>(), 8 * step);
}

TEST(Plan, DrawsAHoleAsItLies) {
  const auto done = run("plan", with(room(addPlate), {{"S", {0, 0, 1.5}}}),
                        {{"instrument", "faro-focus-s350"}, {"set", {"resolution=1/16", "quality=4x"}}});
  ASSERT_TRUE(done) << describe(done.error());
  const auto& patches = answerAs<PlanAnswer>(done->typed)->patches;
  ASSERT_EQ(patches.size(), 2U);
  for (const auto& patch : patches) {
    const double square = patch.shape.right.norm() * patch.shape.up.norm();
    EXPECT_NEAR(square * static_cast<double>(patch.shape.squares.size()), patch.area_m2, 0.15 * patch.area_m2);
  }
  const auto& shadow = patches[0].shape;
  EXPECT_NEAR(std::abs(shadow.normal.x()), 1, 1e-6);
  const double side = shadow.right.norm();
  for (const auto& s : shadow.squares) {
    const auto middle = shadow.middle(s);
    EXPECT_NEAR(middle.x(), 5, 1e-6);
    EXPECT_LT(std::abs(middle.y()), 1.25 + side);
    EXPECT_LT(std::abs(middle.z() - 1.5), 1.25 + side);
  }
  double rim = 0;
  for (const auto& [a, b] : rimOf({shadow.squares.begin(), shadow.squares.end()}))
    rim += (shadow.corner(a) - shadow.corner(b)).norm();
  EXPECT_GT(rim, 4 * 2.5 - 1);
  EXPECT_LT(rim, 2 * 4 * 2.5) << "around it, in steps, and nowhere within";
}

TEST(RimOfAHole, RunsStraightAroundItAndAroundWhatIsInIt) {
  std::set<HoleSquare> ring;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (i != 1 || j != 1) ring.insert({i, j});
  const auto rim = rimOf(ring);
  EXPECT_EQ(rim.size(), 8U) << "four sides without and four within";
  int length = 0;
  for (const auto& [a, b] : rim) length += b[0] - a[0] + b[1] - a[1];
  EXPECT_EQ(length, 12 + 4);
}

TEST(Plan, OverlapIsTheCommonSurfaceAsAShareOfTheSmallerView) {
  const auto p = plan(with(room(), {{"S", {-2, 0, 1.5}}, {"T", {2, 0, 1.5}}}));
  ASSERT_EQ(p["pairs"].size(), 1U);
  EXPECT_NEAR(p["pairs"][0]["common_m2"].get<double>(), kRoom_m2 - 2 * kBlind, 0.3);
  EXPECT_NEAR(p["pairs"][0]["overlap"].get<double>(), (kRoom_m2 - 2 * kBlind) / (kRoom_m2 - kBlind), 2e-3);
  const auto apart =
      plan(with(twoStoreyDocument(), {{"S", {500002.5, 5600002, 1.6}}, {"T", {500003, 5600001.5, 4.6}}}));
  EXPECT_LT(apart["pairs"][0]["overlap"].get<double>(), 1e-3) << "a storey between them";
}

TEST(Plan, CountsASurfaceAsSeenOnlyAsNearAsFlatAndAsDenseAsWanted) {
  const auto d = with(room(), {{"S", {0, 0, 1.5}}});
  const double r2 = 3.5 * 3.5 - 1.5 * 1.5;  // a circle on floor and ceiling; no wall is as near
  EXPECT_NEAR(plan(d, {{"max-range", 3.5}})["seen_m2"].get<double>(), 2 * kPi * r2 - kBlind, 0.3);
  // 45 degrees: discs of 1.5 m on floor and ceiling without the blind one, on the walls circles of their distance, cut
  // off by floor and ceiling 1.5 m from their middles.
  const auto band = [](double radius) {
    return 2 * (1.5 * std::sqrt(radius * radius - 2.25) + radius * radius * std::asin(1.5 / radius));
  };
  EXPECT_NEAR(plan(d, {{"max-incidence-deg", 45}})["seen_m2"].get<double>(),
              2 * kPi * 2.25 - kBlind + 2 * band(4) + 2 * 24, 0.6)
      << "the walls at 5 m are seen whole: their corners are 4 m and 1.5 m off the middle";
  // A point stands for r² dAz dEl cos(el) / cos(incidence). Where that is at most what it is straight ahead at 1.5 m,
  // floor and ceiling have cos(el) <= sin(el)^3: from 55.69 degrees on, discs of 1.0235 m.
  const auto instrument = *instrumentById("faro-focus-s350");
  const auto settings = *resolveSettings(instrument, {{"resolution", "1/16"}, {"quality", "4x"}});
  const double wanted = spacingOf(settings, 1.5, 0, 0);
  EXPECT_NEAR(wanted, 1.5 * 0.024544 / 10, 1e-5) << "1/16 is four times 6.136 mm at 10 m: instrument-facts.md §1.4";
  EXPECT_NEAR(plan(d, {{"spacing", wanted}})["seen_m2"].get<double>(), 2 * kPi * 1.0235 * 1.0235 - kBlind, 0.1);
}

// Points weighed by the surface that each stands for: r² cos(el) dAz dEl / cos(incidence).
class AreaSink : public PointSink {
 public:
  double area = 0;
  std::uint64_t points = 0;
  Result<void> begin(const ScanHeader& h) override {
    step_ = 2 * kPi / h.columns * (150 * kPi / 180 / h.rows);  // of a FARO's whole field
    return {};
  }
  Result<void> write(const PointBlock& b) override {
    for (std::size_t i = 0; i < b.size(); ++i) {
      const double r = b.truth.range_m[i];
      area += r * std::hypot(b.x_m[i], b.y_m[i]) * step_ /
              std::max(0.02, std::cos(static_cast<double>(b.truth.incidence_rad[i])));
    }
    points += b.size();
    return {};
  }
  Result<void> end() override { return {}; }
  Result<void> close() override { return {}; }

 private:
  double step_ = 0;
};

TEST(Plan, ForecastsWhatTheScanThenMeasures) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "s.e57";
  for (const auto& d :
       {with(room(addPlate), {{"S", {0.3, 0.2, 1.5}}}), with(twoStoreyDocument(), {{"S", {500002.5, 5600002, 1.6}}})}) {
    const json set = {"resolution=1/16", "quality=4x"};
    const auto p = plan(d, {{"set", set}});
    const auto scanned = run(
        "scan", d,
        {{"instrument", "faro-focus-s350"}, {"set", set}, {"ideal", true}, {"truth", true}, {"output", file.string()}});
    ASSERT_TRUE(scanned) << describe(scanned.error());
    AreaSink sink;
    Progress progress;
    ASSERT_TRUE(cloudFormatFor(file)->read(file, sink, progress));
    EXPECT_NEAR(p["seen_m2"].get<double>() / sink.area, 1, 0.02);
    EXPECT_NEAR(p["stations"][0]["points"].get<double>() / static_cast<double>(sink.points), 1, 0.01);
    EXPECT_EQ(p["stations"][0]["instrument_seconds"], scanned->answer["stations"][0]["instrument_seconds"]);
  }
}

TEST(Plan, ForecastsTheSizeOfTheFile) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "s.e57";
  const auto d = with(twoStoreyDocument(), {{"S", {500002.5, 5600002, 1.6}}});
  const auto p = plan(d);
  ASSERT_TRUE(
      run("scan", d,
          {{"instrument", "faro-focus-s350"}, {"set", {"resolution=1/16", "quality=4x"}}, {"output", file.string()}}));
  EXPECT_NEAR(p["bytes"].get<double>() / static_cast<double>(std::filesystem::file_size(file)), 1, 0.03);
  // With all that is known of each point, as the editor asks for it.
  Progress progress;
  const auto instrument = *instrumentById("faro-focus-s350");
  const auto settings = *resolveSettings(instrument, {{"resolution", "1/16"}, {"quality", "4x"}});
  const auto assignment = std::make_shared<const MaterialAssignment>();
  const auto known = planSurvey(*d.job, *RayScene::build(d.environment(), progress), assignment,
                                {.instrument = instrument,
                                 .settings = settings,
                                 .stations = {0},
                                 .channels = {.time = true, .returns = true, .truth = true},
                                 .wanted = {}},
                                progress);
  ASSERT_TRUE(known) << describe(known.error());
  ASSERT_TRUE(run("scan", d,
                  {{"instrument", "faro-focus-s350"},
                   {"set", {"resolution=1/16", "quality=4x"}},
                   {"truth", true},
                   {"output", file.string()}}));
  EXPECT_NEAR(known->bytes[0] / static_cast<double>(std::filesystem::file_size(file)), 1, 0.03);
}

TEST(Plan, ProposesThePlaceThatAddsMostAndSoDoesAddingAStation) {
  const auto d = with(twoStoreyDocument(), {{"S", {500002.5, 5600002, 1.6}}});
  const auto p = plan(d);
  EXPECT_NEAR(p["proposed"]["at"][2].get<double>(), 4.7, 0.01) << "in the room above, a FARO's height over its floor";
  EXPECT_GT(p["proposed"]["adds_m2"].get<double>(), 80) << "of 56 m² of walls and 48 m² of floor and ceiling";
  const auto added = run("station", d, {{"add", "T"}});
  ASSERT_TRUE(added) << describe(added.error());
  EXPECT_NEAR(added->answer["placed"]["at"][2].get<double>(), 4.6, 0.01);
  const auto none = plan(twoStoreyDocument());
  EXPECT_EQ(none["coverage"], 0) << "no stations: only a place to begin";
  EXPECT_TRUE(none["proposed"].is_object());
}

TEST(Plan, GivesTheSameAnswerAgainAndLeavesHiddenSurfacesOut) {
  const auto d = with(twoStoreyDocument(), {{"S", {500002.5, 5600002, 1.6}}});
  EXPECT_EQ(plan(d), plan(d));
  const auto p = plan(d);
  EXPECT_NEAR(p["area_m2"].get<double>() - p["exposed_m2"].get<double>(), 2, 0.4)
      << "where the table stands on the slab, from both";
}

}  // namespace
}  // namespace standpoint
