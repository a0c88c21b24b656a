// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "project/survey/assess_verb.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

using nlohmann::json;
using testing::HasSubstr;
namespace fs = std::filesystem;

const double kBlind_m = 1.5 / std::tan(std::numbers::pi / 3);  // radius on the floor, below a FARO 1.5 m above it
constexpr double kRadius_m = 0.05;                             // by so much marks reach over an edge
constexpr double kRoom_m2 = 2 * (80 + 30 + 24);

// A room of 10 x 8 x 3 m, drawn as one skin that looks inwards, around (0, 0, 1.5); and perhaps a plate of 1 m² in it,
// 2 m in front of (0, 0, 1.5).
Document closedRoom(bool plate = false) {
  Document d = twoStoreyDocument();
  auto e = std::make_shared<Environment>();
  e->surfaces = d.imported->surfaces;
  e->spatial = d.imported->spatial;
  addBox(*e, "room", "", {-5, -4, 0}, {5, 4, 3});
  auto mesh = std::make_shared<Mesh>(*e->meshes[0]);
  for (auto& t : mesh->triangles) std::swap(t[1], t[2]);
  e->meshes[0] = mesh;
  if (plate) addBox(*e, "plate", "IfcPlate", {2, -0.5, 1}, {2.02, 0.5, 2});
  d.imported = e;
  d.georeference = std::make_shared<const Georeference>();
  return d;
}

class Assess : public testing::Test {
 protected:
  Document with(Document d, const char* name, const json& at) {
    const auto placed = run("station", d, {{"add", name}, {"at", at}, {"stand", "free"}});
    EXPECT_TRUE(placed) << describe(placed.error());
    return placed ? placed->document : d;
  }
  Document scanned(const Document& d, const json& more = {{"ideal", true}}, const char* file = "s.e57") {
    json options = {{"instrument", "faro-focus-s350"},
                    {"set", {"resolution=1/20", "quality=4x"}},
                    {"output", (folder.path() / file).string()}};
    options.update(more);
    const auto done = run("scan", d, options);
    EXPECT_TRUE(done) << describe(done.error());
    return done ? done->document : d;
  }
  static json assess(const Document& d, const json& more = json::object()) {
    const auto done = run("assess", d, more);
    EXPECT_TRUE(done) << describe(done.error());
    return done ? done->answer : json();
  }
  static json row(const json& answer, const std::string& id) {
    for (const auto& r : answer["rows"])
      if (r["id"] == id) return r;
    return {};
  }
  static double value(const json& answer, const std::string& id) {
    const auto v = row(answer, id)["value"];
    return v.is_number() ? v.get<double>() : std::nan("");
  }
  TemporaryFolder folder;
};

TEST_F(Assess, AClosedRoomIsCoveredButForTheDiscBelowTheInstrument) {
  const auto page = folder.path() / "q.html";
  const auto answer = assess(scanned(with(closedRoom(), "S", {0, 0, 1.5})), {{"output", page.string()}});
  EXPECT_NEAR(answer["exposed_m2"].get<double>(), kRoom_m2, 1e-3);
  const double unseen = std::numbers::pi * std::pow(kBlind_m - kRadius_m, 2);
  EXPECT_NEAR(value(answer, "coverage"), 100 * (1 - unseen / kRoom_m2), 0.15);
  ASSERT_FALSE(answer["patches"].empty());
  EXPECT_NEAR(answer["patches"][0]["area_m2"].get<double>(), unseen, 0.2);
  EXPECT_NEAR(std::hypot(answer["patches"][0]["at"][0].get<double>(), answer["patches"][0]["at"][1].get<double>()), 0,
              0.2);
  std::ifstream in(page);
  EXPECT_NE(std::string(std::istreambuf_iterator<char>(in), {}).find("Largest gaps"), std::string::npos);
  const auto worst = row(answer, "coverage")["worst"];
  EXPECT_EQ(worst["product"]["id"], "room");
  EXPECT_EQ(worst["what"], fmt::format("Not seen from any station: {:.1f} m²", unseen));
  EXPECT_NEAR(worst["at"][0].get<double>(), 0, 1);
  EXPECT_NEAR(worst["at"][2].get<double>(), 0, 0.01) << "on the floor";
  EXPECT_EQ(row(answer, "coverage")["verdict"], "good");
  EXPECT_EQ(row(answer, "overlap")["verdict"], "unknown") << "one station overlaps nothing";
  EXPECT_NEAR(value(answer, "deviation_95"), 0, 0.01);
  EXPECT_EQ(value(answer, "stray"), 0);
  EXPECT_NEAR(value(answer, "pose_position"), 0, 1e-6);
}

// Around the room a field of 40 x 40 m, of which a station in the room sees nothing.
TEST_F(Assess, TheWorstPlaceOfAnIndoorSurveyIsInTheRoomAndNotOnTheGroundOutside) {
  auto d = closedRoom();
  auto e = std::make_shared<Environment>(*d.imported);
  addBox(*e, "field", "IfcGeographicElement", {-20, -20, -0.25}, {20, 20, -0.05});
  d.imported = e;
  const auto inside = assess(scanned(with(d, "S", {0, 0, 1.5})));
  EXPECT_EQ(inside["holes"][0]["id"], "field") << "the list of products still begins with the largest gap";
  const auto worst = row(inside, "coverage")["worst"];
  EXPECT_EQ(worst["product"]["id"], "room");
  EXPECT_NEAR(std::hypot(worst["at"][0].get<double>(), worst["at"][1].get<double>()), 0, 1)
      << "the disc below the instrument";
  const auto outside = assess(scanned(with(d, "T", {12, 0, 0.5}), {{"ideal", true}}, "t.e57"));
  const auto at = row(outside, "coverage")["worst"]["at"];
  EXPECT_GT(std::max(std::abs(at[0].get<double>()) - 5, std::abs(at[1].get<double>()) - 4), -1)
      << "who surveys the outside has missed something there";
}

TEST_F(Assess, WhatStandsInTheWayHidesTheWallBehindItAndItsOwnBack) {
  const auto answer = assess(scanned(with(closedRoom(true), "S", {0, 0, 1.5})));
  const double blind = std::numbers::pi * std::pow(kBlind_m - kRadius_m, 2), shadow = std::pow(2.5 - 2 * kRadius_m, 2);
  const double plate = 2 * (1 + 4 * 0.02 / 2);
  const double unseen = blind + shadow + plate / 2;
  EXPECT_NEAR(value(answer, "coverage"), 100 * (1 - unseen / (kRoom_m2 + plate)), 0.3);
  ASSERT_EQ(answer["holes"].size(), 2U);
  EXPECT_EQ(answer["holes"][1]["id"], "plate");
  EXPECT_NEAR(answer["holes"][1]["unseen_m2"].get<double>(), plate / 2, 0.1)
      << "points on its front are not its back's";
}

TEST_F(Assess, OverlapIsTheCommonSurfaceAsAShareOfTheSmallerView) {
  const auto d = with(with(closedRoom(), "S", {-2, 0, 1.5}), "T", {2, 0, 1.5});
  const json dense = {"resolution=1/8", "quality=2x"};  // so that rows are nearer than 0.1 m on the floor at 8 m
  const auto answer = assess(scanned(d, {{"ideal", true}, {"set", dense}}));
  const double blind = std::numbers::pi * std::pow(kBlind_m - kRadius_m, 2);
  EXPECT_NEAR(value(answer, "overlap"), 100 * (kRoom_m2 - 2 * blind) / (kRoom_m2 - blind), 0.3);
  EXPECT_EQ(row(answer, "overlap")["worst"]["stations"], (json{"S", "T"}));
  EXPECT_EQ(row(answer, "overlap")["worst"]["what"],
            fmt::format("Overlap {:.0f} % between S and T", value(answer, "overlap")));
  EXPECT_NEAR(value(answer, "coverage"), 100, 0.05);
  EXPECT_NEAR(value(answer, "coverage_twice"), 100 * (kRoom_m2 - 2 * blind) / kRoom_m2, 0.3);
}

TEST_F(Assess, StationsOfTwoStoreysDoNotOverlap) {
  const auto d = with(with(twoStoreyDocument(), "S", {500002.5, 5600002, 1.6}), "T", {500003, 5600001.5, 4.6});
  const auto answer = assess(scanned(d));
  EXPECT_LT(value(answer, "overlap"), 1);
  EXPECT_EQ(row(answer, "overlap")["verdict"], "bad");
}

TEST_F(Assess, APasserByIsStrayPointsAndNobodyIsNone) {
  const auto d = with(closedRoom(), "S", {0, 0, 1.5});
  const auto walked = assess(scanned(d, {{"ideal", true}, {"field-fault", {"passer_by=0.5"}}}));
  EXPECT_GT(value(walked, "stray"), 0.5);
  const auto at = row(walked, "stray")["worst"]["at"];
  EXPECT_NEAR(std::hypot(at[0].get<double>(), at[1].get<double>()), 2, 0.5) << "2 m from the instrument";
  EXPECT_EQ(value(assess(scanned(d)), "stray"), 0);
}

TEST_F(Assess, NoiseOnPlanesIsHeldAgainstWhatTheInstrumentStates) {
  const auto d = with(closedRoom(), "S", {0, 0, 1.5});
  EXPECT_NEAR(value(assess(scanned(d, json::object())), "noise"), 1, 0.2);
  const auto dusty = assess(scanned(d, {{"field-fault", {"noise=2.5"}}}));
  EXPECT_NEAR(value(dusty, "noise"), 2.5, 0.5);
  EXPECT_EQ(row(dusty, "noise")["verdict"], "bad");
  const auto worst = row(dusty, "noise")["worst"];
  EXPECT_TRUE(worst["what"].get<std::string>().starts_with("Noise ")) << worst.dump();
  EXPECT_TRUE(worst["what"].get<std::string>().ends_with(" mm in the scan of S")) << worst.dump();
  const auto& at = worst["at"];
  EXPECT_GT(std::hypot(at[0].get<double>(), at[1].get<double>(), at[2].get<double>() - 1.5), kBlind_m)
      << "on a surface, not in the scanner";
}

TEST_F(Assess, AStationThatWasMovedAfterItsScanIsReported) {
  const auto d = scanned(with(closedRoom(), "S", {0, 0, 1.5}));
  const auto moved = run("station", d, {{"move", "S"}, {"at", {1, 0, 1.5}}, {"stand", "free"}});
  ASSERT_TRUE(moved) << describe(moved.error());
  const auto answer = assess(moved->document);
  EXPECT_THAT(row(answer, "scan")["note"].get<std::string>(),
              HasSubstr("moved after s.e57 was scanned: scan it again"));
  EXPECT_EQ(row(answer, "scan")["verdict"], "warn");
  EXPECT_EQ(row(answer, "pose_position")["verdict"], "unknown");
  EXPECT_NEAR(value(answer, "coverage"), value(assess(d), "coverage"), 1e-9) << "its points are where they were";
}

TEST_F(Assess, AWrongSolvedPoseIsAnErrorOfThePoseAndMovesThePoints) {
  auto d = scanned(with(closedRoom(), "S", {0, 0, 1.5}));
  Job job = *d.job;
  job.stations[0].solved_pose = job.stations[0].true_pose;
  job.stations[0].solved_pose->translation.z() += 0.02;
  d.job = std::make_shared<const Job>(job);
  const auto answer = assess(d);
  EXPECT_NEAR(value(answer, "pose_position"), 20, 1e-6);
  EXPECT_EQ(row(answer, "pose_position")["note"], "known only to a simulator");
  EXPECT_NEAR(value(answer, "deviation_95"), 20, 0.1) << "floor and ceiling";
  EXPECT_EQ(row(assess(d, {{"profile", "LOA20"}}), "deviation_95")["verdict"], "good") << "up to 50 mm";
}

TEST_F(Assess, WhatOfTheFilesIsMissingOrDamagedIsARowWithTheRemedy) {
  auto d = with(with(closedRoom(), "S", {-2, 0, 1.5}), "T", {2, 0, 1.5});
  d = scanned(scanned(d, {{"ideal", true}, {"stations", "S"}}, "s.e57"), {{"ideal", true}, {"stations", "T"}}, "t.e57");
  d = with(d, "U", {0, 2, 1.5});
  const auto whole = folder.path() / "s.e57", damaged = folder.path() / "t.e57";
  fs::resize_file(damaged, fs::file_size(damaged) / 2);
  const auto cut = assess(d);
  EXPECT_THAT(cut.dump(), HasSubstr("t.e57 cannot be read"));
  EXPECT_THAT(cut.dump(), HasSubstr("not scanned yet"));
  EXPECT_GT(value(cut, "coverage"), 98) << "by the other";
  std::ofstream(damaged) << "no cloud";
  EXPECT_THAT(assess(d).dump(), HasSubstr("t.e57 cannot be read"));
  fs::remove(damaged);
  EXPECT_THAT(assess(d).dump(), HasSubstr("t.e57 is missing: put it back, or scan T again"));
  fs::remove(whole);
  const auto none = assess(d);
  EXPECT_EQ(row(none, "coverage")["note"], "no scan could be read");
  EXPECT_EQ(none["bad"], 2);
  EXPECT_TRUE(none["holes"].empty()) << "nothing is known of the surface";
}

TEST_F(Assess, AMissingFileOfAStationThatWasScannedAgainIsOnlyWorthALook) {
  auto d = scanned(with(closedRoom(), "S", {0, 0, 1.5}), {{"ideal", true}}, "old.e57");
  d = scanned(d, {{"ideal", true}}, "new.e57");
  fs::remove(folder.path() / "old.e57");
  const auto answer = assess(d);
  EXPECT_EQ(row(answer, "scan")["verdict"], "warn");
  EXPECT_EQ(row(answer, "coverage")["verdict"], "good");
}

TEST_F(Assess, WithoutAnyScanSaysWhatToDo) {
  const auto done = run("assess", with(closedRoom(), "S", {0, 0, 1.5}), json::object());
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().kind, ErrorKind::unusable);
  EXPECT_THAT(done.error().message, HasSubstr("scan from a station first"));
}

TEST_F(Assess, LimitsComeFromAFileWhoseMistakesAreNamedWithTheirPlace) {
  const auto d = scanned(with(closedRoom(), "S", {0, 0, 1.5}));
  const auto limits = folder.path() / "limits.json";
  const auto judged = [&](const char* text) {
    std::ofstream(limits) << text;
    return run("assess", d, {{"limits", limits.string()}});
  };
  const auto strict = judged(R"({"coverage": {"good": 99.9, "bad": 99.8}})");
  ASSERT_TRUE(strict) << describe(strict.error());
  EXPECT_EQ(row(strict->answer, "coverage")["verdict"], "bad");
  EXPECT_EQ(row(strict->answer, "coverage")["limit_source"], "limits file");
  EXPECT_EQ(row(strict->answer, "spacing")["good"], 13) << "those of the profile stay";
  EXPECT_THAT(describe(judged(R"({"covrage": {"good": 90}})").error()), HasSubstr("limits.json /covrage"));
  EXPECT_THAT(describe(judged(R"({"stray": {"god": 2}})").error()), HasSubstr("limits.json /stray/god"));
  EXPECT_THAT(describe(judged(R"({"stray": {"good": 9}})").error()), HasSubstr("limits.json /stray/good"));
}

TEST_F(Assess, TargetsAreCountedWhereTheJobHasAny) {
  auto d = with(closedRoom(), "S", {0, 0, 1.5});
  EXPECT_EQ(row(assess(scanned(d)), "targets")["note"], "the job has no targets");
  for (const auto& [name, at] : std::vector<std::pair<const char*, json>>{{"A", {3, 1, 1}}, {"B", {3, -1, 2}}}) {
    const auto placed = run("target", d, {{"add", name}, {"at", at}});
    ASSERT_TRUE(placed) << describe(placed.error());
    d = placed->document;
  }
  const auto answer = assess(scanned(d));
  EXPECT_EQ(value(answer, "targets"), 2);
  EXPECT_EQ(row(answer, "targets")["verdict"], "warn");
}

TEST_F(Assess, TheAnswerIsTheSameOnAnyNumberOfThreads) {
  const auto d = scanned(with(with(closedRoom(true), "S", {-2, 0, 1.5}), "T", {2, 1, 1.5}), json::object());
  std::string one;
  for (const std::size_t threads : {1U, 2U, 7U}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const auto answer = assess(d).dump();
    if (one.empty()) one = answer;
    EXPECT_EQ(answer, one) << threads << " threads";
  }
}

TEST_F(Assess, TheReportHasASignAndAWordBesideEachColourAndNothingFromElsewhere) {
  const auto d = scanned(with(with(closedRoom(), "S <1>", {-2, 0, 1.5}), "T", {2, 0, 1.5}));
  const auto html = folder.path() / "q.html", csv = folder.path() / "q.csv";
  const auto answer = assess(d, {{"output", html.string()}});
  assess(d, {{"output", csv.string()}});
  const auto textOf = [](const fs::path& file) {
    std::ifstream in(file);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  const auto page = textOf(html);
  EXPECT_THAT(page, HasSubstr("#009E73\">✓</span> good"));
  EXPECT_THAT(page, HasSubstr("S &lt;1&gt; – T"));
  EXPECT_THAT(page, HasSubstr("size:A4"));
  EXPECT_EQ(page.find("Largest gaps"), std::string::npos) << "nothing is hidden from both";
  EXPECT_EQ(page.find("http"), std::string::npos);
  const auto lines = textOf(csv);
  EXPECT_EQ(static_cast<std::size_t>(std::count(lines.begin(), lines.end(), '\n')), answer["rows"].size() + 1);
  const auto wrong = run("assess", d, {{"output", (folder.path() / "q.pdf").string()}});
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().kind, ErrorKind::usage);
}

TEST(QualityLimits, ScaleTheMillimetresWithTheProfileAndJudgeAtTheirBounds) {
  const auto limitOf = [](QualityProfile profile, const std::string& id) {
    for (const auto& limit : qualityLimits(profile))
      if (limit.id == id) return limit;
    return QualityLimit();
  };
  EXPECT_EQ(limitOf(QualityProfile::loa20, "deviation_95").good, 50);
  EXPECT_EQ(limitOf(QualityProfile::loa40, "deviation_95").good, 5);
  const auto more = limitOf(QualityProfile::loa30, "coverage"), less = limitOf(QualityProfile::loa30, "incidence");
  EXPECT_EQ(verdictOf(more, 95), Verdict::good);
  EXPECT_EQ(verdictOf(more, 94.9), Verdict::warn);
  EXPECT_EQ(verdictOf(more, 84.9), Verdict::bad);
  EXPECT_EQ(verdictOf(less, 60), Verdict::good);
  EXPECT_EQ(verdictOf(less, 75), Verdict::warn);
  EXPECT_EQ(verdictOf(less, 75.1), Verdict::bad);
}

TEST(QualityLimits, AreThoseOfTheirPage) {
  std::ifstream stream(SOURCE_DIR "/docs/explanation/quality.md");
  const std::string page{std::istreambuf_iterator<char>(stream), {}};
  const auto by20 = qualityLimits(QualityProfile::loa20), by30 = qualityLimits(QualityProfile::loa30),
             by40 = qualityLimits(QualityProfile::loa40);
  for (std::size_t k = 0; k < by30.size(); ++k) {
    const auto from = page.find("| `" + by30[k].id + "` |");
    ASSERT_NE(from, std::string::npos) << by30[k].id;
    const auto line = page.substr(from, page.find('\n', from) - from);
    const auto cell = [&](const QualityLimit& limit) {
      std::ostringstream text;
      text << limit.good << ", " << limit.bad << (limit.unit.empty() ? "" : " ") << limit.unit << " | ";
      return text.str();
    };
    EXPECT_THAT(line, HasSubstr("| " + cell(by20[k]) + cell(by30[k]) + cell(by40[k])));
  }
}

}  // namespace
}  // namespace standpoint
