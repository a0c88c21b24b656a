// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/rehearsal/proof_places.h"

#include <algorithm>
#include <functional>
#include <memory>

#include <gtest/gtest.h>

#include "emulated-ui/rehearsal/marks.h"
#include "emulated-ui/rehearsal/sample_solution.h"
#include "pointclouds/formats.h"
#include "scanners/engine/ray_engine.h"
#include "tests/emulated-ui/marked.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

using Actions = std::vector<RehearsalAction>;
using Eigen::Vector3d;
using Kind = RehearsalAction::Kind;

// The points of files as they are written, in the files' frame, that lie within a ball: read without any of the code
// that finds the places.
struct InBall final : PointSink {
  Vector3d centre;
  double radius_m = 0;
  Pose pose;
  std::vector<Vector3d> points;
  Result<void> begin(const ScanHeader& header) override { return pose = header.file_from_scanner, Result<void>{}; }
  Result<void> write(const PointBlock& block) override {
    for (std::size_t i = 0; i < block.size(); ++i) {
      const Vector3d p = pose * Vector3d(block.x_m[i], block.y_m[i], block.z_m[i]);
      if ((p - centre).norm() <= radius_m) points.push_back(p);
    }
    return {};
  }
  Result<void> end() override { return {}; }
  Result<void> close() override { return {}; }
};
std::vector<Vector3d> pointsNear(const Marks& marks, const Vector3d& centre, double radius_m) {
  InBall ball;
  ball.centre = centre;
  ball.radius_m = radius_m;
  Progress quiet;
  for (const auto& file : marks.files) EXPECT_TRUE(cloudFormatFor(file.file)->read(file.file, ball, quiet));
  return std::move(ball.points);
}

// Along the normal, from the place.
double meanHeight_m(const std::vector<Vector3d>& points, const Vector3d& centre, const Vector3d& normal) {
  double sum = 0;
  for (const auto& p : points) sum += normal.dot(p - centre);
  return sum / static_cast<double>(points.size());
}

// Its own solution and one with a mistake, both carried out; they stay for all tests.
struct Pair {
  Exercise exercise;
  TemporaryFolder folder;
  std::unique_ptr<Rehearsal> mistaken;
  Marks marks, good_marks;
  std::unique_ptr<CarriedOutSolution> good;
  Progress quiet;

  const MarkedRule& rule(const std::string& id) const {
    for (const auto& r : marks.rules)
      if (r.id == id) return r;
    ADD_FAILURE() << "no rule " << id;
    return marks.rules.front();
  }
  Vector3d centre(const std::string& id) const {
    const auto& place = rule(id).place;
    EXPECT_TRUE(place) << id << "\n" << marksText(marks);
    return place ? Vector3d(place->x_m, place->y_m, place->z_m) : Vector3d::Zero();
  }
  // Of the solution's marks and of those with the mistake, as proof_places.h measures it.
  PlaceFigure figure(const std::string& id, bool of_good) const {
    const auto place = of_good ? samePlace(*rule(id).shown, *good->rehearsal) : *rule(id).shown;
    const auto scans = scansOf(place, of_good ? *good->rehearsal : *mistaken);
    EXPECT_TRUE(scans);
    Progress quiet;
    const auto figure = figureAt(place, *scans, quiet);
    EXPECT_TRUE(figure);
    return *figure;
  }
};

std::unique_ptr<Pair> carriedOut(const std::string& id, const std::function<void(Actions&)>& spoil,
                                 bool compare = true) {
  auto pair = std::make_unique<Pair>();
  const auto known = findExercise(id);
  EXPECT_TRUE(known);
  pair->exercise = known->exercise;
  Progress quiet;
  auto started = Rehearsal::start(pair->exercise, {}, pair->folder.path(), {}, quiet);
  EXPECT_TRUE(started) << describe(started.error());
  pair->mistaken = *std::move(started);
  auto actions = pair->exercise.solution;
  spoil(actions);
  for (const auto& action : actions)
    if (auto done = pair->mistaken->act(action, quiet); !done)
      ADD_FAILURE() << toJson(action).dump() << ": " << describe(done.error());
  pair->marks = marked(*pair->mistaken);
  if (!compare) return pair;
  auto good = carryOutSolution(pair->exercise, {}, quiet);
  EXPECT_TRUE(good) << describe(good.error());
  pair->good = std::make_unique<CarriedOutSolution>(*std::move(good));
  EXPECT_TRUE(pair->good->refused.empty()) << pair->good->refused;
  pair->good_marks = marked(*pair->good->rehearsal);
  return pair;
}

void insertAfter(Actions& actions, const std::string& name, const Actions& more) {
  for (std::size_t i = 0; i < actions.size(); ++i)
    if (actions[i].name == name) {
      actions.insert(actions.begin() + static_cast<std::ptrdiff_t>(i) + 1, more.begin(), more.end());
      i += more.size();
    }
}
void with(Actions& actions, const std::string& name, const std::string& value) {
  for (auto& action : actions)
    if (action.name == name) action.value = value;
}

TEST(ProofPlace, OfATiltedScanIsWhereItsPointsLieFarthestOffTheirSurface) {
  const auto pair = carriedOut("E05", [](Actions& actions) {
    std::erase_if(actions, [](const RehearsalAction& a) { return a.name == "level"; });
    insertAfter(actions, "start_scan", {{Kind::press, "continue", "", 0, {}}});
  });
  const auto& rule = pair->rule("levelled");
  ASSERT_TRUE(rule.shown) << marksText(pair->marks);
  EXPECT_EQ(rule.shown->kind, ProofKind::offset);
  ASSERT_TRUE(rule.shown->normal);
  const auto centre = pair->centre("levelled");
  const double off_m = std::abs(rule.shown->offset_m);
  EXPECT_GT(off_m, 0.1) << "5.8° at metres";
  const auto bad = pointsNear(pair->marks, centre + rule.shown->offset_m * *rule.shown->normal, 0.05);
  ASSERT_GT(bad.size(), 5U) << "the student's points stand where the tilt takes them";
  EXPECT_NEAR(meanHeight_m(bad, centre, *rule.shown->normal), rule.shown->offset_m, 0.03);
  const auto good = pointsNear(pair->good_marks, centre, 0.1);
  ASSERT_GT(good.size(), 20U);
  EXPECT_NEAR(meanHeight_m(good, centre, *rule.shown->normal), 0, 0.004) << "and those of the solution on the surface";
  const auto of_bad = pair->figure("levelled", false), of_good = pair->figure("levelled", true);
  ASSERT_TRUE(of_bad.value_mm && of_good.value_mm);
  EXPECT_NEAR(*of_bad.value_mm, off_m * 1000, 0.25 * off_m * 1000);
  EXPECT_LT(*of_good.value_mm, 4);
  for (const auto& held : pair->good_marks.rules)
    EXPECT_TRUE(held.held && !held.place && !held.cost) << held.id << ": what holds needs no proof";
  EXPECT_NE(rule.place->text.find(" from S1"), std::string::npos) << rule.place->text;
}

TEST(ProofPlace, OfAWrongTargetHeightIsAFloorOrCeilingThatIsOffByThatMuch) {
  const auto pair = carriedOut("E14", [](Actions& actions) {
    insertAfter(actions, "view_list", {{Kind::press, "target_height", "0.18", 0, {}}});
  });
  const auto& rule = pair->rule("delivered");
  ASSERT_TRUE(rule.shown) << marksText(pair->marks);
  const auto& normal = *rule.shown->normal;
  EXPECT_GT(std::abs(normal.z()), 0.99) << "walls only slide along themselves";
  EXPECT_NEAR(std::abs(rule.shown->offset_m), 0.18, 0.005);
  const auto centre = pair->centre("delivered");
  const auto bad = pointsNear(pair->marks, centre + rule.shown->offset_m * normal, 0.15);
  const auto good = pointsNear(pair->good_marks, centre, 0.15);
  ASSERT_GT(bad.size(), 10U);
  ASSERT_GT(good.size(), 10U);
  EXPECT_NEAR(std::abs(meanHeight_m(bad, centre, normal) - meanHeight_m(good, centre, normal)), 0.18, 0.008);
}

TEST(ProofPlace, OfTooCoarseAScanIsASurfaceWithThatManyPointsFewer) {
  const auto pair = carriedOut("E03", [](Actions& actions) { with(actions, "resolution", "1/16"); });
  const auto& rule = pair->rule("fine_enough");
  ASSERT_TRUE(rule.shown) << marksText(pair->marks);
  EXPECT_EQ(rule.shown->kind, ProofKind::spacing);
  const auto bad = pointsNear(pair->marks, pair->centre("fine_enough"), rule.shown->radius_m);
  const auto good = pointsNear(pair->good_marks, pair->centre("fine_enough"), rule.shown->radius_m);
  ASSERT_GT(bad.size(), 100U);
  EXPECT_NEAR(static_cast<double>(good.size()) / static_cast<double>(bad.size()), 16, 2) << "1/16 and 1/4";
  const auto of_bad = pair->figure("fine_enough", false), of_good = pair->figure("fine_enough", true);
  EXPECT_NEAR(*of_bad.value_mm / *of_good.value_mm, 4, 0.3);
}

TEST(ProofPlace, OfAPersonInTheScanIsWhereThePersonWas) {
  const auto pair = carriedOut("E12", [](Actions& actions) { with(actions, "double_scan", "off"); });
  const auto& rule = pair->rule("clean");
  ASSERT_TRUE(rule.shown) << marksText(pair->marks);
  EXPECT_EQ(rule.shown->kind, ProofKind::stray);
  const auto place = pair->centre("clean");
  const double radius_m = 0.5 * rule.shown->radius_m;  // within it, so that no wall is
  const auto bad = pointsNear(pair->marks, place, radius_m), good = pointsNear(pair->good_marks, place, radius_m);
  EXPECT_GT(bad.size(), 50U);
  EXPECT_LT(good.size(), bad.size() / 10) << "nobody is there where both scans are compared";
  EXPECT_GT(pair->figure("clean", false).points, 50U);
  EXPECT_EQ(pair->figure("clean", true).points, 0U);
}

TEST(ProofPlace, OfAScanThatWasCutShortIsWhereTheRoomHasNoPoints) {
  const auto pair = carriedOut("T-FOCUS", [](Actions& actions) {
    const auto at = std::find_if(actions.begin(), actions.end(), [](const auto& a) { return a.name == "start_scan"; });
    actions.erase(at + 1, actions.end());
    for (const auto& action : Actions{{Kind::wait, "", "", 25, {}},
                                      {Kind::press, "stop", "", 0, {}},
                                      {Kind::press, "keep_partial", "", 0, {}},
                                      {Kind::finish, "", "", 0, {}}})
      actions.push_back(action);
  });
  const auto& rule = pair->rule("whole");
  ASSERT_TRUE(rule.shown) << marksText(pair->marks);
  EXPECT_EQ(rule.shown->kind, ProofKind::hole);
  EXPECT_EQ(pointsNear(pair->marks, pair->centre("whole"), 0.1).size(), 0U);
  EXPECT_GT(pointsNear(pair->good_marks, pair->centre("whole"), 0.1).size(), 20U);
}

TEST(ProofPlace, OfSpheresWithTooFewPointsIsTheSphereWithTheFewest) {
  const auto pair = carriedOut("E09", [](Actions& actions) { with(actions, "resolution", "1/32"); });
  const auto& rule = pair->rule("sampled");
  ASSERT_TRUE(rule.shown) << marksText(pair->marks);
  EXPECT_EQ(rule.shown->kind, ProofKind::target);
  const auto of_bad = pair->figure("sampled", false), of_good = pair->figure("sampled", true);
  EXPECT_LT(of_bad.points, 60U);
  EXPECT_GE(of_good.points, 60U);
  auto newest = pair->marks;
  newest.files = {pair->marks.files.back()};
  const auto raw = pointsNear(newest, pair->centre("sampled"), 1.1 * rule.shown->target_radius_m).size();
  EXPECT_GE(raw, of_bad.points) << "the fit leaves some at its edge out";
  EXPECT_LT(raw, 2 * of_bad.points);
  EXPECT_EQ(static_cast<double>(of_bad.points), *pair->mistaken->fact("newest.sampled")->number) << "as the mark says";
}

TEST(ProofPlace, OfALinkThatIsTurnedRoundIsMetresOff) {
  const auto pair = carriedOut(
      "E16",
      [](Actions& actions) { std::erase_if(actions, [](const RehearsalAction& a) { return a.name == "refine"; }); },
      false);
  const auto& rule = pair->rule("no_wrong");
  ASSERT_TRUE(rule.shown) << marksText(pair->marks);
  EXPECT_EQ(rule.shown->kind, ProofKind::offset);
  EXPECT_FALSE(rule.shown->one_scan);
  EXPECT_GT(std::abs(rule.shown->offset_m), 0.3);
  EXPECT_EQ(rule.shown->scans.size(), 2U);
}

TEST(ProofPlace, OfAPlanWithTooFewStationsIsASurfaceThatOneOfTheSolutionWouldSee) {
  const auto pair = carriedOut(
      "E06", [](Actions& actions) { actions.resize(1); }, false);
  const auto& rule = pair->rule("surfaces");
  ASSERT_TRUE(rule.shown) << marksText(pair->marks);
  EXPECT_TRUE(rule.shown->scans.empty()) << "nothing was scanned";
  const auto scene = RayScene::build(pair->mistaken->document().environment(), pair->quiet);
  ASSERT_TRUE(scene);
  const auto clear = [&](const Vector3d& eye) {  // by a ray of the test's own
    const Vector3d way = rule.shown->centre_m + 0.01 * *rule.shown->normal - eye;
    return !(*scene)->intersect(eye, way.normalized(), way.norm() - 0.005);
  };
  for (const auto& station : pair->mistaken->document().job->stations)
    EXPECT_FALSE(clear(station.true_pose.translation)) << station.name;
  EXPECT_TRUE(clear(rule.shown->seen_from_m));
}

TEST(ProofPlace, IsNoneWhereAnAnswerWasWrongOrNothingWasScanned) {
  const auto pair = carriedOut(
      "E15", [](Actions& actions) { actions.clear(); }, false);
  for (const auto& rule : pair->marks.rules) {
    EXPECT_FALSE(rule.held) << rule.id;
    EXPECT_FALSE(rule.place) << rule.id;
  }
  EXPECT_TRUE(pair->rule("plumb").cost) << "that it costs something is true all the same";
}

}  // namespace
}  // namespace standpoint
