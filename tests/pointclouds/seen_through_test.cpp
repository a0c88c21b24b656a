// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <numbers>
#include <utility>

#include <tbb/global_control.h>

#include "core/random.h"
#include "pointclouds/filters/cleaning.h"
#include "tests/pointclouds/same_points.h"

namespace standpoint {
namespace {

// A corridor along x, 4 m wide and 3 m high, with a pole of 5 cm and somebody (a cylinder of 0.5 m, 1.8 m tall) who
// stands or walks in it. What a ray meets is known in closed form.
struct Passage {
  std::function<Eigen::Vector2d(double time_s)> walker;

  struct Met {
    double range_m = 0;  // 0: nothing
    bool is_walker = false;
  };
  Met meet(const Eigen::Vector3d& from, const Eigen::Vector3d& way, double time_s) const {
    Met met;
    const auto offer = [&](double range, bool is_walker) {
      if (range > 0.3 && (met.range_m == 0 || range < met.range_m)) met = {range, is_walker};
    };
    for (const auto& [axis, at] : {std::pair(1, -2.0), {1, 2.0}, {2, 0.0}, {2, 3.0}})
      if (way[axis] != 0) offer((at - from[axis]) / way[axis], false);
    offer(onPillar(from, way, {6, 1}, 0.025, 3), false);
    offer(onPillar(from, way, walker(time_s), 0.25, 1.8), true);
    if (met.range_m > 40) met = {};
    return met;
  }

 private:
  static double onPillar(const Eigen::Vector3d& from, const Eigen::Vector3d& way, const Eigen::Vector2d& at,
                         double radius, double height) {
    const Eigen::Vector2d off = from.head<2>() - at, flat = way.head<2>();
    const double a = flat.squaredNorm(), b = off.dot(flat), c = off.squaredNorm() - radius * radius;
    if (a == 0 || b * b < a * c) return 0;
    const double range = (-b - std::sqrt(b * b - a * c)) / a, z = from.z() + range * way.z();
    return z < 0 || z > height ? 0 : range;
  }
};

double spread(std::uint64_t seed, std::uint32_t k) {  // 3 mm, nearly normal
  const auto draw = philox({seed, 0}, k, 7, 0);
  return 0.003 * (uniform(draw[0]) + uniform(draw[1]) + uniform(draw[2]) + uniform(draw[3]) - 2) * 1.732;
}

struct PassageScan {
  ScanHeader header;
  PointBlock points;

  explicit PassageScan(const std::string& name) {
    header.name = name;
    header.guid = "{" + name + "}";
    header.has_labels = header.has_truth = true;
    header.products = {{"#1", "", "IfcWall", "corridor"}, {"#2", "", "Pedestrian", "Ada"}};
    header.materials = {"plaster"};
  }
  void add(const Eigen::Vector3d& at, const Passage::Met& met, std::uint32_t row, std::uint32_t column) {
    const Eigen::Vector3f p = at.cast<float>();
    points.x_m.push_back(p.x()), points.y_m.push_back(p.y()), points.z_m.push_back(p.z());
    points.intensity.push_back(0.5F);
    points.row.push_back(row), points.column.push_back(column);
    points.product.push_back(met.is_walker ? 1 : 0), points.material.push_back(0);
    auto& t = points.truth;
    t.x_m.push_back(p.x()), t.y_m.push_back(p.y()), t.z_m.push_back(p.z());
    t.range_m.push_back(static_cast<float>(met.range_m)), t.incidence_rad.push_back(0), t.received_db.push_back(-20);
    t.flags.push_back(met.is_walker ? point_flag::kMoving : std::uint8_t{0});
  }
};

PassageScan fromStation(const std::string& name, const Eigen::Vector3d& at, const Passage& passage, double step_deg,
                        std::uint64_t seed) {
  PassageScan scan(name);
  scan.header.file_from_scanner.translation = at;
  scan.header.columns = static_cast<std::uint32_t>(360 / step_deg);
  scan.header.rows = static_cast<std::uint32_t>(150 / step_deg);
  std::uint32_t k = 0;
  for (std::uint32_t column = 0; column < scan.header.columns; ++column)
    for (std::uint32_t row = 0; row < scan.header.rows; ++row) {
      const double azimuth = -column * step_deg * std::numbers::pi / 180,
                   elevation = (row * step_deg - 60) * std::numbers::pi / 180;
      const Eigen::Vector3d way(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                                std::sin(elevation));
      const auto met = passage.meet(at, way, 0);
      if (met.range_m == 0) continue;
      scan.add((met.range_m + spread(seed, k++)) * way, met, row, column);
    }
  return scan;
}

void writePassage(const std::filesystem::path& file, const std::vector<PassageScan>& scans) {
  auto writer = cloudFormatFor(file)->writer(file);
  ASSERT_OK(writer);
  for (const auto& scan : scans) {
    ASSERT_OK((*writer)->begin(scan.header));
    ASSERT_OK((*writer)->write(scan.points));
    ASSERT_OK((*writer)->end());
  }
  ASSERT_OK((*writer)->close());
}

// A head with 32 lines from -60 to 60 degrees that turns ten times a second about x, carried at 1 m/s.
class Along final : public PoseFunction {
 public:
  Pose pose(double time_s) const override {
    return {Eigen::Quaterniond::Identity(), {std::clamp(time_s, first_s(), last_s()) - first_s(), 0, 1.5}};
  }
  double first_s() const override { return 100; }
  double last_s() const override { return 112; }
};

PassageScan carriedThrough(const Passage& passage) {
  constexpr std::uint32_t kPulses = 240'000, kLines = 32;
  PassageScan scan("walk");
  scan.header.has_time = true;
  const Along along;
  for (std::uint32_t k = 0; k < kPulses; ++k) {
    const double time_s = 12.0 * k / kPulses, turn = 2 * std::numbers::pi * 10 * time_s,
                 line = (k % kLines * 120.0 / (kLines - 1) - 60) * std::numbers::pi / 180;
    const Eigen::Vector3d way(std::sin(line), std::cos(line) * std::cos(turn), std::cos(line) * std::sin(turn));
    const Eigen::Vector3d from = along.pose(100 + time_s).translation;
    const auto met = passage.meet(from, way, time_s);
    if (met.range_m == 0) continue;
    scan.add(from + (met.range_m + spread(5, k)) * way, met, 0, 0);
    scan.points.time_s.push_back(time_s);
  }
  return scan;
}

Result<Cleaning> cleanPassage(const std::filesystem::path& in, const std::string& filter,
                              const PoseFunctionPtr& carrier = {}) {
  auto chosen = filterFrom(filter);
  if (!chosen) return failure(chosen.error());
  chosen->carrier = carrier;
  Progress progress;
  return cleanCloud(in, in.parent_path() / "out.e57", {&*chosen, 1}, progress);
}

Passage standsAt(double x, double y) {
  return {[x, y](double) { return Eigen::Vector2d(x, y); }};
}

double shareTaken(const Taken& taken) { return static_cast<double>(taken.taken) / static_cast<double>(taken.in); }

TEST(SeenThrough, TakesWhomTheOtherStationSawThroughAndNoFloorOrPole) {
  const TemporaryFolder folder;
  // The wider apart the other's rays are, the fewer cells of somebody they go through.
  for (const auto& [step_deg, least] : {std::pair{0.4, 0.87}, {0.6, 0.8}}) {
    writePassage(folder / "in.e57", {fromStation("S1", {0, 0, 1.5}, standsAt(3, 0.5), step_deg, 1),
                                     fromStation("S2", {10, -0.5, 1.5}, standsAt(7, -0.8), step_deg, 2)});
    const auto done = cleanPassage(folder / "in.e57", "seen-through");
    ASSERT_OK(done);
    const auto& figures = done->filters[0];
    EXPECT_GT(figures.flags[5].in, 1000u);
    EXPECT_GT(shareTaken(figures.flags[5]), least) << step_deg;
    EXPECT_LT(shareTaken(figures.good), 5e-5) << figures.good.taken << " at " << step_deg;
  }
}

TEST(SeenThrough, TakesWhomAnotherFileSawThrough) {
  const TemporaryFolder folder;
  const auto first = fromStation("S1", {0, 0, 1.5}, standsAt(3, 0.5), 0.5, 1);
  const auto second = fromStation("S2", {10, -0.5, 1.5}, standsAt(7, -0.8), 0.5, 2);
  writePassage(folder / "in.e57", {first});
  writePassage(folder / "second.e57", {second});
  const auto apart = cleanPassage(folder / "in.e57", "seen-through:against=" + (folder / "second.e57").string());
  ASSERT_OK(apart);
  const Taken alone = apart->filters[0].flags[5];
  EXPECT_GT(shareTaken(alone), 0.85);
  EXPECT_FALSE(cleanPassage(folder / "in.e57", "seen-through:against=" + (folder / "none.e57").string()));
  writePassage(folder / "in.e57", {first, second});
  const auto together = cleanPassage(folder / "in.e57", "seen-through");
  ASSERT_OK(together);
  EXPECT_GT(together->filters[0].flags[5].in, alone.in);
}

TEST(SeenThrough, LeavesSomebodyWhoStaysInBothScans) {
  const TemporaryFolder folder;
  writePassage(folder / "in.e57", {fromStation("S1", {0, 0, 1.5}, standsAt(4, 0.5), 0.6, 1),
                                   fromStation("S2", {9, -0.5, 1.5}, standsAt(4, 0.5), 0.6, 2)});
  const auto done = cleanPassage(folder / "in.e57", "seen-through");
  ASSERT_OK(done);
  EXPECT_LT(shareTaken(done->filters[0].points), 2e-4);
}

TEST(SeenThrough, TakesWhoWalkedPastACarriedScanner) {
  const TemporaryFolder folder;
  const Passage walks{[](double time_s) { return Eigen::Vector2d(14 - 1.2 * time_s, -0.8); }};
  writePassage(folder / "in.e57", {carriedThrough(walks)});
  const auto carrier = std::make_shared<const Along>();
  const auto done = cleanPassage(folder / "in.e57", "seen-through", carrier);
  ASSERT_OK(done);
  const auto& figures = done->filters[0];

  EXPECT_GT(figures.flags[5].in, 1000u);
  EXPECT_GT(shareTaken(figures.flags[5]), 0.9);
  EXPECT_LT(shareTaken(figures.good), 2e-4) << figures.good.taken;
}

TEST(SeenThrough, GivesTheSameBytesOnOneThreadAndOnMany) {
  const TemporaryFolder folder;
  writePassage(folder / "in.e57", {fromStation("S1", {0, 0, 1.5}, standsAt(3, 0.5), 1, 1),
                                   fromStation("S2", {10, -0.5, 1.5}, standsAt(7, -0.8), 1, 2)});
  ASSERT_OK(cleanPassage(folder / "in.e57", "seen-through"));
  const auto many = testing::bytesOf(folder / "out.e57");
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  ASSERT_OK(cleanPassage(folder / "in.e57", "seen-through"));
  EXPECT_EQ(testing::bytesOf(folder / "out.e57"), many);
}

TEST(SeenThrough, SaysWhatItCannotJudge) {
  const TemporaryFolder folder;
  const Passage nobody = standsAt(30, 0);
  writePassage(folder / "alone.e57", {fromStation("S1", {0, 0, 1.5}, nobody, 4, 1)});
  const auto walk = carriedThrough(nobody);
  writePassage(folder / "walks.e57", {walk, walk});
  auto shuffled = walk;
  std::swap(shuffled.points.time_s.front(), shuffled.points.time_s.back());
  writePassage(folder / "shuffled.e57", {shuffled});
  auto late = walk;
  late.points.time_s.back() = 13;
  writePassage(folder / "late.e57", {late});
  const auto carrier = std::make_shared<const Along>();
  const auto refused = [&](const char* file, const std::string& filter, const PoseFunctionPtr& by, const char* why) {
    const auto done = cleanPassage(folder / file, filter, by);
    ASSERT_FALSE(done) << file;
    EXPECT_NE(describe(done.error()).find(why), std::string::npos) << describe(done.error());
  };
  refused("alone.e57", "seen-through", nullptr, "rays of one scan alone");
  refused("alone.e57", "seen-through", carrier, "have no times");
  refused("walks.e57", "seen-through", nullptr, "seen-through:trajectory=FILE");
  refused("shuffled.e57", "seen-through", carrier, "not in the order of their times");
  refused("late.e57", "seen-through", carrier, "not within the trajectory");
  refused("alone.e57", "seen-through:trajectory=none.csv", nullptr, "was not read");
}

}  // namespace
}  // namespace standpoint
