// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/trajectories/trajectory_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/motion/rotation_vector.h"
#include "core/random.h"
#include "core/units.h"
#include "survey/geodesy.h"
#include "tests/temporary_folder.h"

namespace standpoint {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using testing::HasSubstr;

constexpr double kPi = std::numbers::pi;

Trajectory winding() {
  Trajectory samples;
  for (int i = 0; i < 200; ++i) {
    const double t = 0.05 * i;
    samples.time_s.push_back(345678 + t);
    samples.pose.push_back({unitRotation(rotationOf({0.1 * std::sin(t), 0.2 * std::cos(2 * t), 0.9 * t})),
                            {7 * std::sin(0.3 * t), 1.1 * t, 1.5 + 0.1 * std::sin(t)}});
  }
  return samples;
}

TrajectoryFrame onTheMap() {
  TrajectoryFrame frame;
  frame.file_from_local = {unitRotation(rotationOf({0, 0, 0.4})), {564321, 5934567, 40}};
  frame.scale = 0.9997;
  frame.crs = "EPSG:25832";
  return frame;
}

class TrajectoryFile : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& name, const std::string& text) {
    const auto file = folder_.path() / name;
    std::ofstream(file, std::ios::binary) << text;
    return file;
  }
  Result<ReadTrajectory> read(const std::string& id, const std::filesystem::path& file,
                              const TrajectoryFrame& frame = {}) {
    return trajectoryFormat(id)->read(file, frame, progress_);
  }
  std::string errorOf(const std::string& id, const std::string& text) {
    const auto result = read(id, write("wrong.txt", text), onTheMap());
    return result ? "none" : describe(result.error());
  }

  TemporaryFolder folder_;
  Progress progress_;
};

TEST_F(TrajectoryFile, OfEachFormatComesBackAsItWasWritten) {
  const Trajectory samples = winding();
  for (const auto& format : trajectoryFormats())
    for (const bool on_the_map : {false, true}) {
      SCOPED_TRACE(std::string(format.id) + (on_the_map ? " on the map" : ""));
      const std::string id = format.id;
      if (id == "sbet" && !on_the_map) continue;
      const TrajectoryFrame frame = on_the_map ? onTheMap() : TrajectoryFrame{};
      const auto file = folder_.path() / ("walk" + std::string(format.extension));
      const auto written = format.write(file, samples, frame);
      ASSERT_TRUE(written) << describe(written.error());
      const auto found = trajectoryFormatOf(file);
      ASSERT_TRUE(found);
      EXPECT_EQ((*found)->id, id == "helios-arinc" ? "helios" : id);
      const auto back = format.read(file, frame, progress_);
      ASSERT_TRUE(back) << describe(back.error());
      ASSERT_EQ(back->samples.pose.size(), samples.pose.size());
      EXPECT_TRUE(back->breaks.empty());
      EXPECT_NEAR(back->gap_s, 0.5, 1e-6);
      for (std::size_t i = 0; i < samples.pose.size(); ++i) {
        ASSERT_NEAR(back->samples.time_s[i], samples.time_s[i], 1e-9);
        // Eight digits before the point and nine behind are what a double has on a map.
        ASSERT_LT((back->samples.pose[i].translation - samples.pose[i].translation).norm(), on_the_map ? 6e-9 : 1e-9);
        ASSERT_LT(rotationVector(back->samples.pose[i].rotation * samples.pose[i].rotation.conjugate()).norm(), 2e-9);
      }
    }
}

TEST_F(TrajectoryFile, OfTumIsTimePositionAndQuaternionWithWLast) {
  const auto track =
      read("tum", write("a.tum", "# a comment\n1.5 1 2 3 0 0 0.7071068 0.7071068\n\n2.5 4 5 6 0 0 0 -1\n"));
  ASSERT_TRUE(track) << describe(track.error());
  EXPECT_EQ(track->samples.time_s, (std::vector<double>{1.5, 2.5}));
  EXPECT_EQ(track->samples.pose[0].translation, Vector3d(1, 2, 3));
  EXPECT_LT(((track->samples.pose[0].rotation * Vector3d::UnitX()) - Vector3d::UnitY()).norm(), 1e-7);
  EXPECT_EQ(track->samples.pose[1].rotation.w(), 1);
}

TEST_F(TrajectoryFile, OfEurocIsNanosecondsAndQuaternionWithWFirst) {
  const auto track = read("euroc", write("data.csv",
                                         "#timestamp, p_RS_R_x [m], ...\n"
                                         "1403715274312143104,1,2,3,0,1,0,0,0,0,0,0,0,0,0,0,0\n"
                                         "1403715274317143104,1,2,3.5,1,0,0,0,0,0,0,0,0,0,0,0,0\n"));
  ASSERT_TRUE(track) << describe(track.error());
  EXPECT_NEAR(track->samples.time_s[0], 1403715274.312143, 3e-7);
  EXPECT_NEAR(track->samples.time_s[1] - track->samples.time_s[0], 0.005, 3e-7);
  EXPECT_EQ(track->samples.pose[0].rotation.x(), 1);
  EXPECT_EQ(track->samples.pose[1].rotation.w(), 1);
}

TEST_F(TrajectoryFile, OfKittiGoesAheadWhereTheCameraLooks) {
  write("times.txt", "0.0\n0.1\n");
  // 2 m ahead (z), 1 m to the right (x), 0.5 m down (y), turned right by 90° (about y, which is down).
  const auto track = read("kitti", write("00.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n0 0 1 1 0 1 0 0.5 -1 0 0 2\n"));
  ASSERT_TRUE(track) << describe(track.error());
  EXPECT_LT((track->samples.pose[1].translation - Vector3d(2, -1, -0.5)).norm(), 1e-12);
  EXPECT_LT((track->samples.pose[1].rotation * Vector3d::UnitX() - Vector3d(0, -1, 0)).norm(), 1e-12);
  EXPECT_LT((track->samples.pose[1].rotation * Vector3d::UnitZ() - Vector3d::UnitZ()).norm(), 1e-12);
  std::filesystem::remove(folder_.path() / "times.txt");
  EXPECT_EQ(errorOf("kitti", "1 0 0 0 0 1 0 0 0 0 1 0\n"),
            "wrong.txt: KITTI poses have no times; put these beside the file as times.txt or wrong_times.txt, a line a "
            "pose");
}

TEST_F(TrajectoryFile, OfHeliosTurnsAsItsPlatformDoes) {
  // Its y is ahead. Canonical: yaw 90° is to the left of that, so x ahead looks along -x of the frame.
  const auto track = read("helios", write("a.txt", "1 2 3 10.5 0 0 90\n1 2 3 11.5 0 0 0\n"));
  ASSERT_TRUE(track) << describe(track.error());
  EXPECT_EQ(track->samples.time_s[0], 10.5);
  EXPECT_LT((track->samples.pose[0].rotation * Vector3d::UnitX() - Vector3d(-1, 0, 0)).norm(), 1e-12);
  EXPECT_LT((track->samples.pose[1].rotation * Vector3d::UnitX() - Vector3d(0, 1, 0)).norm(), 1e-12);
  // ARINC 705: a heading of 90° is east; the columns by their names.
  const auto arinc = read("helios-arinc", write("b.trj",
                                                "#TIME_COLUMN: 0\n#HEADER: \"t\", \"roll\", \"pitch\", \"yaw\", \"x\", "
                                                "\"y\", \"z\"\n1, 0, 0, 90, 5, 6, 7\n2, 30, 0, 0, 5, 6, 7\n"));
  ASSERT_TRUE(arinc) << describe(arinc.error());
  EXPECT_EQ(arinc->samples.pose[0].translation, Vector3d(5, 6, 7));
  EXPECT_LT((arinc->samples.pose[0].rotation * Vector3d::UnitX() - Vector3d(1, 0, 0)).norm(), 1e-12);
  EXPECT_LT(
      (arinc->samples.pose[1].rotation * Vector3d::UnitY() - Vector3d(-std::cos(kPi / 6), 0, std::sin(kPi / 6))).norm(),
      1e-12);
}

// HELIOS++ goes linearly from angle to angle: none may come back from 180° to -180° on the way round.
TEST_F(TrajectoryFile, OfHeliosTurnsOnPastHalfATurn) {
  const Trajectory samples = winding();
  for (const char* id : {"helios", "helios-arinc"}) {
    SCOPED_TRACE(id);
    const auto file = folder_.path() / (std::string(id) + ".trj");
    ASSERT_TRUE(trajectoryFormat(id)->write(file, samples, {}));
    std::ifstream in(file);
    std::vector<std::array<double, 7>> rows;
    for (std::string line; std::getline(in, line);) {
      if (line.starts_with('#')) continue;
      std::replace(line.begin(), line.end(), ',', ' ');
      std::istringstream numbers(line);
      for (double& number : rows.emplace_back()) numbers >> number;
    }
    ASSERT_EQ(rows.size(), samples.pose.size());
    double farthest_deg = 0;
    for (std::size_t i = 1; i < rows.size(); ++i)
      for (std::size_t angle = 1; angle <= 3; ++angle)
        farthest_deg = std::max(farthest_deg, std::abs(rows[i][angle] - rows[i - 1][angle]));
    EXPECT_LT(farthest_deg, 10);
    EXPECT_GT(std::abs(rows.back()[3] - rows.front()[3]), 360);
  }
}

// Against GeographicLib's UTM, which is not what reads it.
TEST_F(TrajectoryFile, OfSbetLiesAndLooksAsTheMapSays) {
  std::ofstream out(folder_.path() / "a.sbet", std::ios::binary);
  const double latitude = 53.55 * kRadPerDeg, longitude = 10.2 * kRadPerDeg, wander = 0.3;
  for (int i = 0; i < 3; ++i) {
    double record[17] = {604799.0 + i, latitude, longitude, 33, 1, 0, 0, 0.02, 0.05, 1.0 + wander, wander};
    if (i == 2) record[0] = 1;
    out.write(reinterpret_cast<const char*>(record), sizeof record);
  }
  out.close();
  TrajectoryFrame frame;
  frame.crs = "EPSG:25832";
  const auto track = read("sbet", folder_.path() / "a.sbet", frame);
  ASSERT_TRUE(track) << describe(track.error());
  const UtmPosition expected = utm(53.55, 10.2);
  const Pose& pose = track->samples.pose[0];
  EXPECT_LT((pose.translation - Vector3d(expected.easting_m, expected.northing_m, 33)).norm(), 1e-3);
  const double azimuth = 1.0 - expected.convergence_deg * kRadPerDeg;  // from grid north
  const EulerAngles angles = eulerAngles(pose.rotation);
  EXPECT_NEAR(angles.yaw_rad, kPi / 2 - azimuth, 1e-7);
  EXPECT_NEAR(angles.pitch_rad, -0.05, 1e-9);
  EXPECT_NEAR(angles.roll_rad, 0.02, 1e-9);
  EXPECT_GT((pose.rotation * Vector3d::UnitX()).z(), 0);   // nose up
  EXPECT_LT((pose.rotation * -Vector3d::UnitY()).z(), 0);  // right side down
  EXPECT_EQ(track->samples.time_s, (std::vector<double>{604799, 604800, 604801}));
  EXPECT_EQ(track->report.issues.size(), 1U);
}

TEST_F(TrajectoryFile, OfSbetNeedsAPlaceOnTheMapAndAllItsBytes) {
  const auto file = write("a.sbet", std::string(136 * 2 + 40, '\0'));
  const auto lost = read("sbet", file);
  ASSERT_FALSE(lost);
  EXPECT_EQ(lost.error().kind, ErrorKind::usage);
  EXPECT_THAT(lost.error().message, HasSubstr("give the model a projected CRS"));
  const auto cut = read("sbet", file, onTheMap());
  ASSERT_FALSE(cut);
  EXPECT_EQ(describe(cut.error()),
            "a.sbet record 3: the file ends after 40 of 136 bytes of a record; copy it again, or it is not SBET");
}

TEST_F(TrajectoryFile, ThatIsWrongIsRefusedWithItsLineAndARemedy) {
  EXPECT_EQ(errorOf("tum", "1 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n"),
            "wrong.txt line 2: the time 1 s is not after 1 s, that of the sample before; sort the samples by time and "
            "delete those of equal time");
  EXPECT_EQ(errorOf("tum", "1 0 0 0 0 0 0 1\n2 0 0 0 0 0 1\n"),
            "wrong.txt line 2: the line has 7 numbers where one of TUM has 8; is the file of another format?");
  EXPECT_EQ(errorOf("tum", "1 0 0 nan 0 0 0 1\n"),
            "wrong.txt line 1: holds a value that is not a number; delete this sample");
  EXPECT_EQ(errorOf("tum", "\n1 0 0 0 0.5 0 0 1\n"),
            "wrong.txt line 2: the quaternion has length 1.118 instead of 1; check the order of the columns");
  EXPECT_EQ(errorOf("tum", "1 0 0 0 0 0 0 one\n"), "wrong.txt line 1: a line of TUM holds numbers alone");
  EXPECT_EQ(errorOf("tum", "1 0 0 0 0 0 0 1\n"), "wrong.txt: a trajectory needs at least two samples");
  EXPECT_EQ(errorOf("tum", ""), "wrong.txt: a trajectory needs at least two samples");
  EXPECT_EQ(errorOf("csv", "# {\"format\": \"other\"}\n"),
            "wrong.txt line 1: the head's format is not standpoint-trajectory");
  EXPECT_THAT(errorOf("csv", "time_s,x_m\n1,0,0,0,0,0,0,1\n"), HasSubstr("the head is missing"));
  EXPECT_THAT(errorOf("euroc", "1.5,0,0,0,1,0,0,0\n"), HasSubstr("whole number of nanoseconds"));
  write("times.txt", "0\n1\n");
  EXPECT_THAT(errorOf("kitti", "1 0 0 0 0 1 0 0 0 0 2 0\n"), HasSubstr("no rotation"));
  EXPECT_THAT(errorOf("helios", "#HEADER: \"t\", \"x\"\n1,2\n"),
              HasSubstr("wrong.txt line 1: the header has no column"));
  EXPECT_THAT(errorOf("sbet", std::string(136, '\x44')), HasSubstr("wrong.txt record 1: "));
  EXPECT_EQ(read("tum", folder_.path() / "none.tum").error().kind, ErrorKind::file_system);
}

// Whatever the bytes: samples in their order, or an error with its place.
TEST_F(TrajectoryFile, ThatIsDamagedIsReadOrRefused) {
  constexpr int kDamages = 200;
  Trajectory samples = winding();
  samples.time_s.resize(20);
  samples.pose.resize(20);
  for (const auto& format : trajectoryFormats()) {
    const auto whole = folder_.path() / "whole", broken = folder_.path() / "broken";
    ASSERT_TRUE(format.write(whole, samples, onTheMap()));
    std::filesystem::rename(folder_.path() / "whole", folder_.path() / "whole.bytes");
    std::ifstream in(folder_.path() / "whole.bytes", std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(in)), {});
    std::error_code ignored;
    std::filesystem::rename(folder_.path() / "whole_times.txt", folder_.path() / "broken_times.txt", ignored);
    for (std::uint32_t k = 0; k < kDamages; ++k) {
      const auto drawn = philox({k, 0}, 0, 0, 0);
      std::string damaged = bytes.substr(0, k % 3 == 0 ? drawn[0] % bytes.size() : bytes.size());
      for (std::size_t i = 1; i < 3 && !damaged.empty(); ++i)
        damaged[drawn[i] % damaged.size()] = "0 ,-e\n#n\xff"[drawn[3] % 9];
      write("broken", damaged);
      const auto read = format.read(broken, onTheMap(), progress_);
      if (read)
        EXPECT_TRUE(PoseSpline::through(read->samples, read->gap_s)) << format.id << " " << k;
      else
        EXPECT_FALSE(read.error().source.empty()) << format.id << " " << k;
    }
  }
}

TEST_F(TrajectoryFile, WithAGapHasABreakThatIsReported) {
  std::string text;
  for (int i = 0; i < 40; ++i) text += std::to_string(i < 20 ? 0.1 * i : 0.1 * i + 3) + " 0 0 0 0 0 0 1\n";
  const auto track = read("tum", write("gap.tum", text));
  ASSERT_TRUE(track);
  ASSERT_EQ(track->breaks.size(), 1U);
  EXPECT_NEAR(track->breaks[0].from_s, 1.9, 1e-9);
  EXPECT_NEAR(track->breaks[0].to_s, 5.0, 1e-9);
  ASSERT_EQ(track->report.issues.size(), 1U);
  EXPECT_EQ(track->report.issues[0].severity, Severity::warning);
  EXPECT_EQ(PoseSpline::through(track->samples, track->gap_s)->breaks().size(), 1U);
  const auto close = read("tum", write("close.tum", text + "7.0 0 0 0 0 0 0 1\n7.0001 0 0 0 0 0 0 1\n"));
  ASSERT_EQ(close->report.issues.size(), 2U);
  EXPECT_THAT(close->report.issues[1].message, HasSubstr("after the one before: 1;"));
}

TEST(MapFrame, IsThatOfTheModelsPlace) {
  Georeference georeference;
  EXPECT_FALSE(mapFrame(georeference));
  georeference.crs = "EPSG:25832";
  georeference.shift_m = {100, 200, 0};
  georeference.map_from_file = MapConversion{};
  georeference.map_from_file->eastings_m = 564000;
  georeference.map_from_file->northings_m = 5934000;
  georeference.map_from_file->x_axis_abscissa = std::cos(0.3);
  georeference.map_from_file->x_axis_ordinate = std::sin(0.3);
  georeference.map_from_file->scale = 0.9996;
  const auto frame = mapFrame(georeference);
  ASSERT_TRUE(frame);
  const Vector3d local(3, 4, 5);
  EXPECT_LT((frame->file_from_local * (frame->scale * local) -
             mapFromFile(*georeference.map_from_file, local + georeference.shift_m))
                .norm(),
            1e-8);
}

}  // namespace
}  // namespace standpoint
