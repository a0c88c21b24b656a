// SPDX-License-Identifier: GPL-3.0-or-later
// Whole buildings walked through by keys alone, from the entrance to every room that the walkable surface reaches.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "core/ceiling.h"
#include "core/data_folder.h"
#include "core/readable_name.h"
#include "editor/labels/room_labels.h"
#include "editor/walking/stair_way.h"
#include "editor/walking/walk.h"
#include "importers/importers.h"
#include "optimizer/walk/walkable_map.h"

namespace standpoint {
namespace {

using Eigen::Vector3d;
namespace fs = std::filesystem;

constexpr Body kVisitor{0.25, 1.70};
constexpr double kFrame_s = 1.0 / 60;
constexpr double kArrived_m = 0.12;

fs::path corpus() {
  const char* shared = std::getenv("STANDPOINT_SHARED");
  return fs::path(shared != nullptr ? shared : SOURCE_DIR "/../shared") / "corpus" / "ifc";
}

Document documentOf(const fs::path& file) {
  Progress progress;
  auto model = importFile(file, {}, progress);
  Document document;
  if (model) document.imported = std::make_shared<const Environment>(std::move(model->environment));
  return document;
}

std::shared_ptr<const WalkedGround> groundOf(const Document& document) {
  WalkGround ground;
  ground.prepare(document, kVisitor, [] {});
  ground.wait();
  return ground.of(document, kVisitor);
}

// Turns to the next corner of the way and holds W until it is there; where something is in the way, A or D, too, for a
// moment, as people do.
bool walkAlong(Walk& walk, Camera& camera, const std::vector<Vector3d>& way) {
  constexpr int kPatience = 20, kSidestep = 24;  // frames
  double length = 0;
  for (std::size_t i = 0; i + 1 < way.size(); ++i) length += (way[i + 1] - way[i]).norm();
  const int frames = static_cast<int>((3 * length / walk.speed_mps(false) + 10) / kFrame_s);
  std::size_t next = 0;
  double nearest = 1e300, side = 1;
  int waited = 0;
  for (int i = 0; i < frames; ++i) {
    const auto off = [&] { return Vector3d(way[next] - walk.feet()); };
    const auto before = next;
    while (next < way.size() && off().head<2>().norm() < kArrived_m && std::abs(off().z()) < 0.4) ++next;
    if (next == way.size()) return true;
    if (next != before || off().norm() < nearest - 0.01) {
      nearest = off().norm();
      waited = 0;
    } else if (++waited > kPatience + kSidestep) {
      waited = 0;
      side = -side;
    }
    camera.azimuth_rad = std::atan2(-off().x(), off().y());
    walk.go({{waited > kPatience ? side : 0, waited > kPatience ? 0.3 : 1}}, kFrame_s, camera);
  }
  return false;
}

// The rectangle of the room that is largest, of an island.
std::optional<Vector3d> goalIn(const SpaceBody& space, const WalkableMap& map, std::uint32_t island) {
  std::optional<Vector3d> goal;
  double largest = 0;
  for (std::uint32_t i = 0; i < map.size(); ++i) {
    const Vector3d middle = map.middle(i);
    if (map.islandOf(i) != island || map.area(i) <= largest || !space.contains(middle + Vector3d(0, 0, 0.9))) continue;
    largest = map.area(i);
    goal = middle;
  }
  return goal;
}

// Where one has to get: into each room that is reached, or in a model without rooms to both sides of each door.
struct Goal {
  std::string name;
  std::optional<Vector3d> place;  // nothing: not from this entrance
};

std::vector<Goal> goalsOf(const WalkedGround& ground, const WalkableMap& map, std::uint32_t island) {
  std::vector<Goal> goals;
  for (const auto& room : ground.collision->rooms) {
    if (!room.reached) continue;
    const auto space = std::find_if(ground.spaces.begin(), ground.spaces.end(),
                                    [&](const SpaceBody& s) { return s.product == room.product; });
    goals.push_back({readableName(ground.environment->products[room.product]), goalIn(*space, map, island)});
  }
  if (!ground.collision->rooms.empty()) return goals;
  for (const auto& door : ground.collision->doors) {
    const auto passage = door.led_through ? passageOf(*ground.environment, door.product) : std::nullopt;
    for (const double side : {-0.8, 0.8}) {
      if (!passage) continue;
      const auto i = map.at(passage->middle + side * passage->through);
      if (i && map.islandOf(*i) == island)
        goals.push_back({ground.environment->products[door.product].name, map.middle(*i)});
    }
  }
  return goals;
}

struct Walked {
  int rooms = 0, reached = 0, elsewhere = 0;
  std::string missed;
};

Walked walkToAllRooms(const WalkedGround& ground, const std::shared_ptr<const WalkedGround>& shared) {
  Walked walked;
  const WalkableMap map(ground.collision->walkable);
  const auto start =
      startPlace(*ground.environment, *ground.collision, ground.obstacles, kVisitor, {Vector3d(1e4, 1e4, 1e4), {}});
  if (!start) return walked;
  const auto from = map.at(start->feet);
  if (!from) return walked;
  for (const auto& [name, goal] : goalsOf(ground, map, map.islandOf(*from))) {
    if (!goal) {
      ++walked.elsewhere;
      continue;
    }
    ++walked.rooms;
    Vector3d begin = start->feet;
    begin = begin.cwiseMax(map.box(*from).min).cwiseMin(map.box(*from).max);
    const auto way = map.way(begin, *goal);
    Walk walk;
    Camera camera;
    if (!way.empty() && walk.start(shared, kVisitor, *start, camera) && walkAlong(walk, camera, way))
      ++walked.reached;
    else
      walked.missed += "\n  " + name +
                       (way.empty() ? ": no way"
                                    : ": stopped at " + std::to_string(walk.feet().x()) + " " +
                                          std::to_string(walk.feet().y()) + " " + std::to_string(walk.feet().z()));
  }
  return walked;
}

// How the surface has a place: all around it, nowhere near, or on the rim where it and the body's own sweeps may differ
// by a cell and a skin.
enum class OnSurface { yes, no, rim };
OnSurface onSurface(const WalkableMap& map, const Vector3d& p) {
  constexpr double kBand_m = 0.07;
  int inside = map.under(p) ? 1 : 0;
  constexpr int kAround = 16;
  for (int i = 0; i < kAround; ++i) {
    const double angle = 2 * std::numbers::pi * i / kAround;
    inside += map.under(p + kBand_m * Vector3d(std::cos(angle), std::sin(angle), 0)) ? 1 : 0;
  }
  return inside == 0 ? OnSurface::no : inside == kAround + 1 ? OnSurface::yes : OnSurface::rim;
}

struct Teleports {
  int tried = 0, allowed = 0, wrong = 0;
  std::string where;
};

Teleports teleportAnywhere(const WalkedGround& ground, int count, unsigned seed) {
  // The surface counts height in cells, too: whoever is allowed may be lower by them, whoever is refused has all of it.
  constexpr double kCells_m = 0.1;
  const auto mapFor = [&](double height_m) {
    Progress progress;
    return WalkableMap(
        collide(*ground.environment, {.agent_radius_m = kVisitor.radius_m, .agent_height_m = height_m}, progress)
            ->walkable);
  };
  const WalkableMap map = mapFor(Walker::kCrouched_m), lower = mapFor(Walker::kCrouched_m - kCells_m);
  std::mt19937 random(seed);
  const auto between = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
  Teleports result;
  Bounds box;
  for (std::uint32_t i = 0; i < map.size(); ++i) box.extend(map.box(i));
  if (box.empty()) return result;
  for (int i = 0; i < 50 * count && result.tried < count; ++i) {
    const double x = between(box.min.x() - 1, box.max.x() + 1);  // in an order that no compiler chooses
    const double y = between(box.min.y() - 1, box.max.y() + 1);
    const Vector3d eye(x, y, between(box.min.z(), box.max.z() + 2));
    const auto hit = ground.obstacles.ray(eye, eye - Vector3d(0, 0, 4));
    if (!hit) continue;
    ++result.tried;
    const auto landing = landingOn(ground, kVisitor, hit->point, hit->normal);
    const bool allowed = landing.why_not.empty();
    result.allowed += allowed ? 1 : 0;
    const auto surface = onSurface(allowed ? lower : map, allowed ? landing.feet : hit->point);
    if (surface != (allowed ? OnSurface::no : OnSurface::yes)) continue;
    ++result.wrong;
    const auto& p = allowed ? landing.feet : hit->point;
    result.where += "\n  " + std::to_string(p.x()) + " " + std::to_string(p.y()) + " " + std::to_string(p.z()) +
                    " on " + ground.environment->products[hit->product].ifc_class + ": " +
                    (allowed ? std::string("allowed") : landing.why_not);
  }
  return result;
}

// Nobody starts on a roof, nor on what is over another floor and open to the sky.
void checkStart(const WalkedGround& ground, const Vector3d& eye, const std::optional<Vector3d>& looked_at) {
  const auto start = startPlace(*ground.environment, *ground.collision, ground.obstacles, kVisitor, {eye, looked_at});
  if (!start) return;
  const auto floor = ground.obstacles.ray(start->feet + Vector3d(0, 0, 0.2), start->feet - Vector3d(0, 0, 0.2));
  ASSERT_TRUE(floor) << "in the void at " << start->feet.transpose();
  EXPECT_FALSE(isRoofOrCeiling(*ground.environment, floor->product)) << "on a roof at " << start->feet.transpose();
}

void checkStarts(const WalkedGround& ground) {
  const Bounds box = bounds(*ground.environment);
  if (box.empty()) return;
  const Vector3d middle = 0.5 * (box.min + box.max), size = box.max - box.min;
  for (const Vector3d& eye :
       {Vector3d(middle + 2 * size), Vector3d(middle - 2 * size), Vector3d(middle.x(), middle.y(), box.max.z() + 20),
        Vector3d(middle.x(), middle.y(), box.max.z() + 1), middle}) {
    const auto seen = ground.obstacles.ray(eye, eye + 3 * (middle - eye) - Vector3d(0, 0, 1e-3));
    checkStart(ground, eye, seen ? std::optional(seen->point) : std::nullopt);
  }
}

void walkThrough(const fs::path& file, int teleports, const std::vector<unsigned>& seeds = {7}) {
  SCOPED_TRACE(file.filename());
  const auto document = documentOf(file);
  ASSERT_TRUE(document.imported);
  const auto ground = groundOf(document);
  ASSERT_TRUE(ground);
  checkStarts(*ground);
  const auto walked = walkToAllRooms(*ground, ground);
  EXPECT_EQ(walked.reached, walked.rooms) << walked.missed;
  EXPECT_TRUE(walked.rooms + walked.elsewhere > 0 || ground->collision->rooms.empty());
  std::printf("%s: %d of %d places on foot, %d by another entrance\n", file.filename().c_str(), walked.reached,
              walked.rooms, walked.elsewhere);
  for (const unsigned seed : seeds) {
    const auto landed = teleportAnywhere(*ground, teleports, seed);
    EXPECT_EQ(landed.wrong, 0) << landed.where;
    std::printf("  %d of %d teleports allowed, %d disagree\n", landed.allowed, landed.tried, landed.wrong);
  }
}

// A place of its own with a floor, and what is on it or over it.
class LandingOnTheSurface : public ::testing::Test {
 protected:
  LandingOnTheSurface() {
    environment.surfaces.resize(1);
    addOver("IfcSlab", 3, -0.2F, 0);
  }
  // What is over a quadrilateral, so thick.
  void add(const std::string& ifc_class, const std::array<Eigen::Vector3f, 4>& corners, float thick_m) {
    Mesh mesh;
    for (const float up : {0.0F, thick_m})
      for (const auto& p : corners) mesh.positions.emplace_back(p + Eigen::Vector3f(0, 0, up));
    mesh.triangles = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}};
    for (std::uint32_t i = 0; i < 4; ++i) {
      const std::uint32_t k = (i + 1) % 4;
      mesh.triangles.push_back({i, k, k + 4});
      mesh.triangles.push_back({i, k + 4, i + 4});
    }
    mesh.surface_of_triangle.assign(mesh.triangles.size(), 0);
    Product product;
    product.ifc_class = ifc_class;
    environment.products.push_back(product);
    environment.meshes.push_back(std::make_shared<const Mesh>(std::move(mesh)));
    const auto last = static_cast<std::uint32_t>(environment.products.size() - 1);
    environment.instances.push_back({last, last});
  }
  void addOver(const std::string& ifc_class, float half_m, float low_m, float high_m) {
    add(ifc_class,
        {{{-half_m, -half_m, low_m}, {half_m, -half_m, low_m}, {half_m, half_m, low_m}, {-half_m, half_m, low_m}}},
        high_m - low_m);
  }
  std::string whyNotOn(const Vector3d& place) {
    Document document;
    document.imported = std::make_shared<const Environment>(environment);
    const auto ground = groundOf(document);
    EXPECT_TRUE(ground);
    return ground ? landingOn(*ground, kVisitor, place, Vector3d::UnitZ()).why_not : "no ground";
  }
  Environment environment;
};

// As on the crown of a tree.
TEST_F(LandingOnTheSurface, NotWhereItIsTooSmallToWalkThoughOneHasTheHeightAlmostToStand) {
  addOver("IfcBuildingElementProxy", 0.49F, 0, 1.85F);
  addOver("IfcBuildingElementProxy", 2, 1.85F + 1.75F, 4);
  EXPECT_EQ(whyNotOn({0, 0, 1.85}), "outside the walkable surface");
  EXPECT_EQ(whyNotOn({2, 0, 0}), "");
}

// The body is round above, and gets farther under a slope than the surface, which has all of the height.
TEST_F(LandingOnTheSurface, UnderASteepRoofOnlyAsFarAsOneCrouches) {
  add("IfcRoof", {{{-2, -3, 0.0F}, {0, -3, 4.3F}, {0, 3, 4.3F}, {-2, 3, 0.0F}}}, 0.2F);
  EXPECT_EQ(whyNotOn({-2 + 1.54 / 2.15, 0, 0}), "outside the walkable surface");
  EXPECT_EQ(whyNotOn({-2 + 1.90 / 2.15, 0, 0}), "") << "crouched";
  EXPECT_EQ(whyNotOn({1, 0, 0}), "");
}

TEST(WalkedBuildings, OurSampleHouseToEveryRoom) { walkThrough(samplesFolder() / "house.ifc", 500); }

// A spiral stair between a railing and a newel, with a slab over it.
TEST(WalkedBuildings, WithASpiralStair) {
  const auto file = corpus() / "webifc__AC20-FZK-Haus.ifc";
  if (!fs::exists(file)) GTEST_SKIP() << "the shared corpus is not here";
  walkThrough(file, 100);
}

// Its newel stands at (7.33, 3.2) and one steps on to it from the west. Somebody who holds W alone and turns with the
// stair, a little too late or too early, leans against the railing or the newel and gets up all the same.
TEST(WalkedBuildings, UpASpiralStairByOneKeyThoughOneLeansAgainstItsRailing) {
  const auto file = corpus() / "webifc__AC20-FZK-Haus.ifc";
  if (!fs::exists(file)) GTEST_SKIP() << "the shared corpus is not here";
  const auto ground = groundOf(documentOf(file));
  ASSERT_TRUE(ground);
  const Eigen::Vector2d newel(7.33, 3.2);
  for (const double outwards_deg : {-30, -10, 0, 10, 20, 35, 50})
    for (const double beside_m : {0.45, 0.65}) {
      Walk walk;
      Camera camera;
      ASSERT_TRUE(walk.start(ground, kVisitor, {Vector3d(6.3, 2.95, 0), {}}, camera));
      double seconds = 0;
      for (; seconds < 12 && walk.feet().z() < 2.6; seconds += kFrame_s) {
        const Eigen::Vector2d off = walk.feet().head<2>() - newel;
        const bool before = walk.feet().x() < 6.95 && walk.feet().z() < 0.1;
        const Eigen::Vector2d way = before
                                        ? Eigen::Vector2d(7.0 - walk.feet().x(), newel.y() - beside_m - walk.feet().y())
                                        : Eigen::Vector2d(-off.y(), off.x());
        camera.azimuth_rad = std::atan2(-way.x(), way.y()) - (before ? 0 : outwards_deg * std::numbers::pi / 180);
        walk.go({{0, 1}}, kFrame_s, camera);
      }
      EXPECT_GE(walk.feet().z(), 2.6) << outwards_deg << "° outwards, stopped at " << walk.feet().transpose();
    }
}

// Up and down by itself, from each of several places of the ground floor.
TEST(WalkedBuildings, UpASpiralStairByTheWayThatIsFound) {
  const auto file = corpus() / "webifc__AC20-FZK-Haus.ifc";
  if (!fs::exists(file)) GTEST_SKIP() << "the shared corpus is not here";
  const auto document = documentOf(file);
  const auto ground = groundOf(document);
  ASSERT_TRUE(ground);
  const auto stairs = stairLabels(*ground->environment);
  ASSERT_EQ(stairs.size(), 1U);
  for (const Vector3d& from : {Vector3d(6.3, 2.95, 0), Vector3d(5.5, 4, 0), Vector3d(2, 2, 0)}) {
    Walk walk;
    Camera camera;
    ASSERT_TRUE(walk.start(ground, kVisitor, {from, {}}, camera));
    for (const double storey_m : {2.7, 0.0}) {
      const auto way = stairWay(*ground, walk.feet(), stairs[0].box, storey_m);
      ASSERT_FALSE(way.corners.empty()) << from.transpose();
      walk.goAlong(way.corners, 2.6);
      double seconds = 0;
      for (; walk.goesByItself() && seconds < 20; seconds += 0.1) walk.go({}, 0.1, camera);  // as on a slow machine
      EXPECT_LT(seconds, 8);
      EXPECT_EQ(walk.note(), "");
      EXPECT_NEAR(walk.feet().z(), storey_m, 0.05) << walk.feet().transpose();
    }
  }
}

// The long form: STANDPOINT_WALK_ALL=1.
TEST(WalkedBuildings, AllOfTheCorpusThatHaveRooms) {
  if (std::getenv("STANDPOINT_WALK_ALL") == nullptr) GTEST_SKIP() << "set STANDPOINT_WALK_ALL to walk through them";
  if (!fs::exists(corpus())) GTEST_SKIP() << "the shared corpus is not here";
  for (const char* name :
       {"schep__ROOT-houten_kozijnen__IFC-houten_kozijnen", "bimserver__ADT-FZK-Haus-2005-2006",
        "bimserver__AC11-Institute-Var-2-IFC", "webifc__AC20-FZK-Haus", "bimserver__AC90R1-niedriha-V2-2x3",
        "goedertier__Duplex_A_20110907_georeferenced", "yousheng__Ifc4_SampleHouse", "schep__V_L_Constructief",
        "xbimess__House", "bimwhale__LargeBuilding"})
    walkThrough(corpus() / (std::string(name) + ".ifc"), 500, {7, 2026});
}

}  // namespace
}  // namespace standpoint
