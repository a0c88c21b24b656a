// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/camera/panorama.h"

#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>
#include <jpeglib.h>

#include "scanners/camera/surface_colours.h"
#include "tests/scanners/scenes.h"

namespace standpoint {
namespace {

using testing::SceneBuilder;
constexpr double kPi = std::numbers::pi;

Instrument withCamera(std::uint32_t columns, double offset_up_m, bool hdr, int shots) {
  Instrument instrument;
  instrument.camera = {columns, shots, hdr, offset_up_m};
  return instrument;
}

Panorama taken(const RayScene& scene, const Instrument& instrument, int threads = 1, const Pose& pose = {}) {
  Report report;
  Progress progress;
  auto panorama = takePanorama(scene, instrument, pose, threads, report, progress);
  EXPECT_TRUE(panorama.has_value());
  return *std::move(panorama);
}

// A dark board 1 m across, 2 m along +Y, in a white room.
std::shared_ptr<const RayScene> boardInRoom() {
  SceneBuilder builder;
  const auto white = builder.surface(0.9F), black = builder.surface(0.02F);
  builder.box({-5, -5, -5}, {5, 5, 5}, true, white);
  builder.quad({-0.5, 2, -0.5}, {1, 0, 0}, {0, 0, 1}, black);
  return builder.build();
}

TEST(Panorama, ShowsWhatStandsToTheLeftOfItsMiddle) {
  const auto scene = boardInRoom();
  const Panorama p = taken(*scene, withCamera(360, 0, true, 1));
  // Azimuth 90° is a quarter of the width left of the middle; the board reaches atan(0.5 / 2) = 14.04° to each side.
  const std::size_t row = 90 * 360;
  const auto dark = [&](int column) { return p.pixels[row + static_cast<std::size_t>(column)][1] < 90; };
  for (int column = 0; column < 360; ++column) {
    const double azimuth_deg = 180 - (column + 0.5);
    if (std::abs(std::abs(azimuth_deg - 90) - 14.036) < 0.5) continue;  // a pixel of both
    EXPECT_EQ(dark(column), std::abs(azimuth_deg - 90) < 14.036) << azimuth_deg;
  }
  EXPECT_LT(p.at({0, 3, 0})[1], 90);
  EXPECT_GT(p.at({0, -3, 0})[1], 90);
  EXPECT_GT(p.at({0, 1, 3})[1], 90);
}

TEST(Panorama, TellsHowFarItIs) {
  Progress progress;
  int told = 0;
  progress.onChange([&] { ++told; });
  Report report;
  ASSERT_TRUE(takePanorama(*boardInRoom(), withCamera(360, 0, true, 1), {}, 1, report, progress));
  EXPECT_DOUBLE_EQ(progress.fraction(), 1);
  EXPECT_GE(told, 100) << "by hundredths, not at its end";
}

TEST(Panorama, TurnsWithTheScanner) {
  const auto scene = boardInRoom();
  Pose turned;
  turned.rotation = Eigen::AngleAxisd(kPi / 2, Eigen::Vector3d::UnitZ());  // its X axis looks along +Y
  const Panorama p = taken(*scene, withCamera(360, 0, true, 1), 1, turned);
  EXPECT_LT(p.pixels[90 * 360 + 180][1], 90);
}

TEST(Panorama, IsTheSameForAnyNumberOfThreads) {
  const auto scene = boardInRoom();
  EXPECT_EQ(taken(*scene, withCamera(256, 0.04, false, 5), 1).pixels,
            taken(*scene, withCamera(256, 0.04, false, 5), 2).pixels);
}

// From 20 cm above the laser the upper edge of the board hides another part of the wall: the line from the camera over
// the edge (2 m off, 0.5 m up) meets the wall 5 m off at 0.2 + 0.3 · 2.5 = 0.95 m, that from the laser at 1.25 m; under
// the board it is 0.2 - 0.7 · 2.5 = -1.55 m and -1.25 m.
TEST(Panorama, ColoursPointsWithTheParallaxOfItsCamera) {
  const auto scene = boardInRoom();
  const Panorama at_laser = taken(*scene, withCamera(360, 0, true, 1)),
                 above = taken(*scene, withCamera(360, 0.2, true, 1));
  const Eigen::Vector3d over(0, 5, 1.1), under(0, 5, -1.4);  // hidden from the laser; seen by it
  EXPECT_LT(at_laser.at(over)[1], 90);
  EXPECT_GT(above.at(over)[1], 90);
  EXPECT_GT(at_laser.at(under)[1], 90);
  EXPECT_LT(above.at(under)[1], 90);
}

class TurnsAboutCamera final : public PoseFunction {
 public:
  Pose pose(double time_s) const override {
    return {Eigen::Quaterniond(Eigen::AngleAxisd(kPi / 4 * (time_s - 12), Eigen::Vector3d::UnitZ())), {0, 0, 0}};
  }
  double first_s() const override { return 0; }
  double last_s() const override { return 100; }
};

// A board as above turns about the camera at 45° a second, and is ahead at 12 s. Four shots of a quarter each are taken
// at 11, 13, 15 and 17 s, when it is at -45°, 45°, 135° and -135°: the second and the fourth have it in their quarter.
TEST(Panorama, HasWhatMovesInEachShotWhereItIsAtItsTime) {
  SceneBuilder builder;
  const auto white = builder.surface(0.9F), black = builder.surface(0.02F);
  builder.box({-5, -5, -5}, {5, 5, 5}, true, white);
  builder.quad({2, -0.5, -0.5}, {0, 1, 0}, {0, 0, 1}, black);
  const auto environment = builder.environment();
  const MovingBody board{{static_cast<std::uint32_t>(environment->instances.size() - 1)},
                         std::make_shared<TurnsAboutCamera>()};
  Progress progress;
  Report report;
  const auto scene = *RayScene::build(environment, progress, {}, {}, {board});
  const auto takenBy = [&](int threads) {
    return takePanorama(*scene, withCamera(360, 0, true, 4), {}, threads, report, progress, PictureMetering::even,
                        {10, 8});
  };
  const auto panorama = takenBy(1);
  ASSERT_TRUE(panorama);
  for (int column = 0; column < 360; ++column) {
    const double azimuth_deg = 180 - (column + 0.5);
    const double off_deg = std::min(std::abs(azimuth_deg - 45), std::abs(azimuth_deg + 135));
    if (std::abs(off_deg - 14.036) < 0.5) continue;  // a pixel of both
    EXPECT_EQ(panorama->pixels[90 * 360 + static_cast<std::size_t>(column)][1] < 90, off_deg < 14.036) << azimuth_deg;
  }
  EXPECT_EQ(panorama->pixels, takenBy(3)->pixels);
}

TEST(Panorama, HasAnExposureForEachShotUnlessBracketsMakeOne) {
  SceneBuilder builder;
  const auto bright = builder.surface(0.95F), dark = builder.surface(0.3F);
  builder.box({-5, -5, -5}, {5, 5, 5}, true, bright);
  builder.quad({-4.9, -4, -4}, {0, 0, 8}, {0, 8, 0}, dark);  // behind, around azimuth 180°
  const auto scene = builder.build();
  const Panorama one = taken(*scene, withCamera(360, 0, true, 4)), each = taken(*scene, withCamera(360, 0, false, 4));
  // The dark wall fills the outer shots, and with its own exposure it is brighter than with the one for all.
  EXPECT_GT(each.pixels[90 * 360 + 5][1], one.pixels[90 * 360 + 5][1]);
  // Straight up is the same ceiling on both sides of a seam.
  const auto step = [](const Panorama& p) {
    return std::abs(p.pixels[60 * 360 + 60][1] - p.pixels[60 * 360 + 120][1]);
  };
  EXPECT_GT(step(each), step(one) + 3);
}

// A dark ceiling over white walls: made for the zenith, the picture is lighter than made for the horizon.
TEST(Panorama, ExposesForThePartOfTheViewThatIsMetered) {
  SceneBuilder builder;
  const auto bright = builder.surface(0.95F), dark = builder.surface(0.1F);
  builder.box({-5, -5, -5}, {5, 5, 5}, true, bright);
  builder.quad({-4.9, -4.9, 4.9}, {0, 9.8, 0}, {9.8, 0, 0}, dark);
  const auto scene = builder.build();
  const auto wall = [&](PictureMetering metering) {
    Report report;
    Progress progress;
    const auto panorama = takePanorama(*scene, withCamera(360, 0, true, 1), {}, 1, report, progress, metering);
    return static_cast<int>(panorama->pixels[100 * 360 + 180][1]);
  };
  EXPECT_LT(wall(PictureMetering::horizon) + 3, wall(PictureMetering::even));
  EXPECT_LT(wall(PictureMetering::even) + 3, wall(PictureMetering::zenith));
}

// A white wall and a black board in its plane, oblique and with other corners, so that each ray rounds them
// differently.
TEST(Panorama, ShowsOneOfTwoFacesThatLieInOnePlane) {
  const Eigen::Vector3d ahead = Eigen::Vector3d(0.83, 0.31, 0.17).normalized();
  const Eigen::Vector3d u = ahead.unitOrthogonal(), v = ahead.cross(u);
  for (const bool wall_first : {true, false}) {
    SceneBuilder builder;
    const auto white = builder.surface(0.9F), black = builder.surface(0.02F);
    const auto wall = [&] { builder.quad(3 * ahead - 9 * u - 9 * v, 18 * u, 18 * v, white); };
    const auto board = [&] { builder.quad(3 * ahead - 0.71 * u - 0.93 * v, 1.37 * u, 1.71 * v, black); };
    if (wall_first)
      wall(), board();
    else
      board(), wall();
    const auto scene = builder.build();
    const Panorama p = taken(*scene, withCamera(720, 0, true, 1));
    std::size_t seen = 0;
    for (double x = -0.65; x < 0.6; x += 0.05)
      for (double y = -0.85; y < 0.7; y += 0.05, ++seen)
        EXPECT_EQ(p.at(3 * ahead + x * u + y * v)[1] < 90, !wall_first) << x << " " << y;
    EXPECT_GT(seen, 500U);
    EXPECT_GT(p.at(3 * ahead + 1.0 * u)[1], 90);  // beside the board
  }
}

// A pane in the plane of a board does not let see through the board.
TEST(Panorama, ShowsTheOpaqueOneOfTwoFacesThatLieInOnePlane) {
  SceneBuilder builder;
  const auto pane = builder.surface(0.9F), black = builder.surface(0.02F), white = builder.surface(0.95F);
  builder.quad({2, -2, -2}, {0, 4, 0}, {0, 0, 4}, pane);
  builder.quad({2, -1, -1}, {0, 2, 0}, {0, 0, 2}, black);
  builder.box({-5, -5, -5}, {5, 5, 5}, true, white);
  const auto environment = std::const_pointer_cast<Environment>(builder.environment());
  environment->surfaces[pane].colour.a = 0.1F;
  const auto scene = builder.build();
  const Panorama p = taken(*scene, withCamera(360, 0, true, 1));
  EXPECT_LT(p.at({2, 0.3, 0.4})[1], 90);
  EXPECT_GT(p.at({2, 1.5, 0.4})[1], 90);  // the wall behind the pane
}

TEST(Panorama, RoundsToTheNearestByteOfSrgb) {
  for (int i = 0; i <= 100000; ++i) {
    const float linear = static_cast<float>(i) / 100000;
    const double power = std::pow(static_cast<double>(linear), 1 / 2.4);
    const double s = linear <= 0.0031308 ? 12.92 * linear : 1.055 * power - 0.055;
    ASSERT_NEAR(srgbOf(linear), 255 * s, 0.5001) << linear;
  }
  EXPECT_EQ(srgbOf(-1), 0);
  EXPECT_EQ(srgbOf(7), 255);
  EXPECT_EQ(srgbOf(std::numeric_limits<float>::quiet_NaN()), 0);
}

double linear(std::uint8_t value) {
  const double c = value / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

TEST(Panorama, FollowsTheStopsTheWhiteBalanceAndTheFlashThatAreChosen) {
  const auto scene = boardInRoom();
  Instrument camera = withCamera(360, 0, false, 4);
  camera.camera.metered = false;
  camera.camera.stops = -1;
  const auto wall = [&] { return taken(*scene, camera).at({0, -3, 0}); };
  const auto plain = wall();
  camera.camera.stops = -2;
  EXPECT_NEAR(linear(wall()[1]) / linear(plain[1]), 0.5, 0.01);
  camera.camera = {360, 4, false, 0, false, -1, 1, 0};
  EXPECT_NEAR(linear(wall()[0]) / linear(plain[0]), 1.25, 0.02);
  EXPECT_NEAR(linear(wall()[2]) / linear(plain[2]), 0.75, 0.02);
  // The flash falls off with the distance: the board, 2 m away, gains more than the wall, 5 m away.
  camera.camera = {360, 4, false, 0, false, -1, 0, 0};
  const Panorama dark = taken(*scene, camera);
  camera.camera.flash = 1;
  const Panorama lit = taken(*scene, camera);
  const auto gain = [&](const Eigen::Vector3d& at) { return linear(lit.at(at)[1]) / linear(dark.at(at)[1]); };
  EXPECT_GT(gain({0, -3, 0}), 1.05);
  EXPECT_GT(gain({0, 3, 0}), gain({0, -3, 0}) + 0.1);
}

TEST(Panorama, HasNoSeamsWhereNothingIsMetered) {
  const auto scene = boardInRoom();
  Instrument camera = withCamera(360, 0, false, 4);
  camera.camera.metered = false;
  const Panorama p = taken(*scene, camera);
  camera.camera.shots = 1;
  EXPECT_EQ(p.pixels, taken(*scene, camera).pixels);
}

TEST(Panorama, BecomesAJpegThatAnotherReaderUnderstands) {
  const auto scene = boardInRoom();
  const Panorama p = taken(*scene, withCamera(360, 0.04, true, 1));
  ScanHeader header;
  header.name = "S1";
  header.file_from_scanner.translation = {500000, 5600000, 2};
  const auto picture = pictureOf(p, header, 1234);
  ASSERT_TRUE(picture.has_value());
  EXPECT_EQ(picture->media_type, "image/jpeg");
  EXPECT_DOUBLE_EQ(picture->pixel_width * picture->width, 2 * kPi);
  EXPECT_DOUBLE_EQ(picture->pixel_height * picture->height, kPi);
  EXPECT_EQ(picture->file_from_camera.translation, Eigen::Vector3d(500000, 5600000, 2.04));
  jpeg_decompress_struct jpeg{};
  jpeg_error_mgr errors{};
  jpeg.err = jpeg_std_error(&errors);
  jpeg_create_decompress(&jpeg);
  jpeg_mem_src(&jpeg, picture->bytes.data(), picture->bytes.size());
  ASSERT_EQ(jpeg_read_header(&jpeg, TRUE), JPEG_HEADER_OK);
  EXPECT_EQ(jpeg.image_width, 360U);
  EXPECT_EQ(jpeg.image_height, 180U);
  jpeg_destroy_decompress(&jpeg);
}

TEST(Panorama, GoesBehindThePointsThatItColours) {
  const auto scene = boardInRoom();
  struct Watch final : PointSink {
    std::string order;
    PointBlock last;
    Result<void> begin(const ScanHeader& h) override { return order += h.has_colour ? "B" : "b", Result<void>{}; }
    Result<void> write(const PointBlock& b) override { return last = b, order += "w", Result<void>{}; }
    Result<void> picture(const StationPicture&) override { return order += "p", Result<void>{}; }
    Result<void> end() override { return order += "e", Result<void>{}; }
    Result<void> close() override { return {}; }
  } watch;
  const auto sink = colouring(watch, std::make_shared<const Panorama>(taken(*scene, withCamera(360, 0, true, 1))));
  PointBlock block;
  block.x_m = {0, 0}, block.y_m = {2, -5}, block.z_m = {0, 0}, block.intensity = {0, 0};
  ASSERT_TRUE(sink->begin({}));
  ASSERT_TRUE(sink->write(block));
  ASSERT_TRUE(sink->end());
  EXPECT_EQ(watch.order, "Bwpe");
  ASSERT_EQ(watch.last.green.size(), 2U);
  EXPECT_LT(watch.last.green[0] + 50, watch.last.green[1]);
}

}  // namespace
}  // namespace standpoint
