// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "demo_verbs.h"
#include "editor/film/panorama.h"
#include "editor/film/picture_file.h"
#include "editor/film/shot_setup.h"
#include "editor/shell/editor.h"
#include "source_text.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector2d, Eigen::Vector3d;
using std::numbers::pi;
using testing::HasSubstr;

PixelPicture plain(int width, int height, std::array<std::uint8_t, 4> colour) {
  return {width, height, std::vector(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), colour)};
}

// Draws nothing but a colour that says which picture it is: what is shot can be counted without OpenGL.
class CountingScene : public SceneView {
 public:
  std::uint64_t texture(const ViewState&, int, int, bool) override { return 0; }
  std::uint64_t texture(const std::shared_ptr<const PixelPicture>&) override { return 0; }
  Result<PixelPicture> pixels(const ViewState& state, int width, int height) override {
    cameras.push_back(state.camera);
    return plain(width, height, {static_cast<std::uint8_t>(cameras.size() * 5), 90, 120, 255});
  }
  std::vector<Camera> cameras;
};

std::uint32_t bigEndian(const std::string& text, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8U | static_cast<std::uint8_t>(text[at + i]);
  return value;
}

TEST(Panorama, HasEveryDirectionAtThePixelThatItsAnglesSay) {
  constexpr int kWidth = 720, kHeight = 360;  // half a degree each
  const auto at = [](const Vector3d& direction, double azimuth) {
    return pixelOfDirection(direction, azimuth, kWidth, kHeight);
  };
  EXPECT_LT((at({0, 1, 0}, 0) - Vector2d(360, 180)).norm(), 1e-9) << "a camera of azimuth 0 looks to +Y";
  EXPECT_LT((at({1, 0, 0}, 0) - Vector2d(540, 180)).norm(), 1e-9) << "+X is a quarter to the right of it";
  EXPECT_LT((at({-1, 1, 0}, 0) - Vector2d(270, 180)).norm(), 1e-9);
  EXPECT_NEAR(at({0, 0, 1}, 0).y(), 0, 1e-9);
  EXPECT_LT((at({0, 1, 1}, 0) - Vector2d(360, 90)).norm(), 1e-9) << "45° up";
  Camera camera;
  camera.azimuth_rad = 1.1;
  camera.elevation_rad = 0;
  EXPECT_LT((at(camera.forward(), 1.1) - Vector2d(360, 180)).norm(), 1e-9) << "its middle is what the camera looks at";
  for (const auto& pixel : {Vector2d(1, 5), Vector2d(719, 350), Vector2d(200, 180)})
    EXPECT_LT((at(directionOfPixel(pixel, 1.1, kWidth, kHeight), 1.1) - pixel).norm(), 1e-6);
}

// The faces are painted by a smooth function of the direction, so the panorama must be that function, without seams.
TEST(Panorama, IsPutTogetherFromItsFacesWithoutSeams) {
  const auto paint = [](const Vector3d& d) {
    return std::array<std::uint8_t, 4>{static_cast<std::uint8_t>(127.5 + 120 * d.x()),
                                       static_cast<std::uint8_t>(127.5 + 120 * d.y()),
                                       static_cast<std::uint8_t>(127.5 + 120 * d.z()), 255};
  };
  constexpr int kWidth = 512, kHeight = 256;
  const int size = faceSize(kWidth);
  std::array<PixelPicture, kFaces> faces;
  for (int f = 0; f < kFaces; ++f) {
    const auto camera = faceCamera(f, {3, 4, 5}, 0.4, size);
    EXPECT_LT((camera.eye() - Vector3d(3, 4, 5)).norm(), 1e-12);
    auto& face = faces[static_cast<std::size_t>(f)];
    face = {size, size, {}};
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x)
        face.rgba.push_back(paint(rayThrough(camera, {x + 0.5, y + 0.5}, {size, size}).direction));
  }
  const auto panorama = panoramaOf(faces, 0.4, kWidth, kHeight);
  int worst = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const auto wanted = paint(directionOfPixel({x + 0.5, y + 0.5}, 0.4, kWidth, kHeight));
      const auto& seen = panorama.rgba[static_cast<std::size_t>(y * kWidth + x)];
      for (std::size_t c = 0; c < 3; ++c) worst = std::max(worst, std::abs(int(seen[c]) - int(wanted[c])));
    }
  EXPECT_LE(worst, 2);
}

TEST(Panorama, SaysInItsFileThatItIsSpherical) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "around.jpg";
  ASSERT_TRUE(writePicture(plain(128, 64, {200, 100, 50, 255}), file, PictureShape::spherical));
  EXPECT_THAT(allOf(file), HasSubstr("GPano:ProjectionType=\"equirectangular\""));
  EXPECT_THAT(allOf(file), HasSubstr("GPano:FullPanoWidthPixels=\"128\""));
  EXPECT_TRUE(allOf(file).starts_with("\xff\xd8\xff\xe1"));
  ASSERT_TRUE(writePicture(plain(128, 64, {200, 100, 50, 255}), file));
  EXPECT_THAT(allOf(file), testing::Not(HasSubstr("GPano")));
  const auto refused = writePicture(plain(8, 8, {}), folder.path() / "x.bmp");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::usage);
}

TEST(Turntable, TurnsOnceWithAllInEachPicture) {
  Bounds around;
  around.extend({0, 0, 0});
  around.extend({20, 4, 6});
  Camera from;
  constexpr double kAspect = 16.0 / 9;
  for (int i = 0; i < 40; ++i) {
    const auto camera = turntableAt(from, around, kAspect, i / 40.0);
    EXPECT_NEAR(camera.elevation_rad, from.elevation_rad, 1e-12);
    EXPECT_NEAR(camera.distance_m, turntableAt(from, around, kAspect, 0).distance_m, 1e-9) << "it does not pump";
    for (int corner = 0; corner < 8; ++corner) {
      const Vector3d p((corner & 1) != 0 ? 20 : 0, (corner & 2) != 0 ? 4 : 0, (corner & 4) != 0 ? 6 : 0);
      const auto pixel = project(camera, p, {1600, 900});
      ASSERT_TRUE(pixel);
      EXPECT_TRUE(pixel->x() > 0 && pixel->x() < 1600 && pixel->y() > 0 && pixel->y() < 900) << i;
    }
  }
  const auto turned = [&](double share) { return turntableAt(from, around, kAspect, share).forward(); };
  EXPECT_LT((turned(0) - turned(1)).norm(), 1e-9);
  EXPECT_LT((turned(0).head<2>() + turned(0.5).head<2>()).norm(), 1e-9) << "half of it is the other side";
}

std::vector<Vector3d> around_corner() {
  std::vector<Vector3d> way;
  for (int i = 0; i <= 50; ++i) way.emplace_back(0.1 * i, 0, 2);
  for (int i = 1; i <= 50; ++i) way.emplace_back(5, 0.1 * i, 2);
  return way;
}

TEST(WalkThrough, KeepsItsEyesAtTheirHeightAndLooksAhead) {
  const WalkThrough walk(around_corner());
  EXPECT_NEAR(walk.length_m(), 10, 0.1);
  EXPECT_GT(walk.seconds(), 9);
  EXPECT_LT(walk.seconds(), 20);
  EXPECT_LT((walk.at(0).eye() - Vector3d(0, 0, 3.6)).norm(), 0.01);
  EXPECT_LT((walk.at(1).eye() - Vector3d(5, 5, 3.6)).norm(), 0.01);
  EXPECT_GT(walk.at(0.1).forward().x(), 0.99);
  EXPECT_GT(walk.at(0.95).forward().y(), 0.99);
  for (int i = 0; i <= 300; ++i) {
    const auto camera = walk.at(i / 300.0);
    EXPECT_NEAR(camera.eye().z(), 3.6, 1e-9);
    const double off = std::min(std::abs(camera.eye().y()), std::abs(camera.eye().x() - 5));
    EXPECT_LT(off, 0.25) << "it would be in the wall";
  }
}

TEST(WalkThrough, NeitherJumpsNorSpins) {
  auto way = around_corner();
  const auto back = way;
  way.insert(way.end(), back.rbegin() + 1, back.rend());  // out of a room by the door that led into it
  const WalkThrough walk(way);
  const int pictures = static_cast<int>(walk.seconds() * 30);
  for (int i = 1; i <= pictures; ++i) {
    const auto a = walk.at(double(i - 1) / pictures), b = walk.at(double(i) / pictures);
    EXPECT_LT((a.eye() - b.eye()).norm(), 0.06) << i;
    EXPECT_LT(std::abs(std::remainder(a.azimuth_rad - b.azimuth_rad, 2 * pi)), 0.06) << i;
  }
}

TEST(WalkThrough, GoesThroughTheStationsThatCanBeReached) {
  Editor editor(verbsWithDemo(), [] {});
  ASSERT_TRUE(editor.session.start("demo", nlohmann::json::object()));
  editor.session.wait();
  editor.update();
  const auto& document = editor.session.document();
  ASSERT_GE(document.job->stations.size(), 1U);
  editor.walk_ground.prepare(document, editor.walker, [] {});
  editor.walk_ground.wait();
  const auto ground = editor.walk_ground.of(document, editor.walker);
  ASSERT_NE(ground, nullptr);
  Report report;
  Progress progress;
  const auto unknown = wayThrough(document, *ground, {.stations = {"nobody"}}, report, progress);
  ASSERT_FALSE(unknown);
  EXPECT_THAT(unknown.error().message, HasSubstr("nobody"));
  Document away = document;
  auto job = *document.job;
  job.stations.push_back(job.stations.front());
  job.stations.back().name = "Moon";
  job.stations.back().true_pose.translation.z() += 384400e3;
  away.job = std::make_shared<const Job>(job);
  ASSERT_TRUE(wayThrough(away, *ground, {}, report, progress));
  EXPECT_THAT(said(report), HasSubstr("Moon: left out of the walk: no floor"));
}

ShotRequest film(const fs::path& file) {
  ShotRequest request;
  request.kind = ShotKind::turntable;
  request.file = file;
  request.width = 320;
  request.height = 180;
  request.rate = 25;
  request.seconds = 2;
  request.view.environment = demoHouse().environment();
  request.around.extend({0, 0, 0});
  request.around.extend({10, 8, 6});
  return request;
}

void shoot(ShotRequest request, CountingScene& scene) {
  auto begun = Shoot::begin(std::move(request));
  ASSERT_TRUE(begun) << describe(begun.error());
  for (int i = 0; i < 10000; ++i) {
    const auto whole = (*begun)->step(scene);
    ASSERT_TRUE(whole) << describe(whole.error());
    if (*whole) return;
  }
  FAIL() << "it has no end";
}

TEST(Film, HasAsManyPicturesAsItsTimeAsksFor) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "turn.mp4";
  CountingScene scene;
  shoot(film(file), scene);
  EXPECT_EQ(scene.cameras.size(), 50U);
  const auto mp4 = allOf(file);
  EXPECT_EQ(mp4.substr(4, 4), "ftyp");
  const auto sizes = mp4.find("stsz");
  ASSERT_NE(sizes, std::string::npos);
  EXPECT_EQ(bigEndian(mp4, sizes + 12), 50U);
  const auto times = mp4.find("mdhd");
  ASSERT_NE(times, std::string::npos);
  EXPECT_NEAR(double(bigEndian(mp4, times + 20)) / bigEndian(mp4, times + 16), 2, 1e-9) << "seconds";
  // Each picture's bytes are in the box of the media: their sizes add up to it.
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < 50; ++i) sum += bigEndian(mp4, sizes + 16 + 4 * i);
  const auto media = mp4.find("mdat");
  EXPECT_EQ(bigEndian(mp4, media + 8), sum + 16);
}

TEST(Film, HasTheSameBytesEachTime) {
  const TemporaryFolder folder;
  for (const char* name : {"a.mp4", "b.mp4"}) {
    CountingScene scene;
    shoot(film(folder.path() / name), scene);
  }
  EXPECT_TRUE(allOf(folder.path() / "a.mp4") == allOf(folder.path() / "b.mp4"));
}

TEST(Film, ThatIsGivenUpLeavesNothingBehind) {
  const TemporaryFolder folder;
  {
    CountingScene scene;
    auto begun = Shoot::begin(film(folder.path() / "turn.mp4"));
    ASSERT_TRUE(begun);
    for (int i = 0; i < 10; ++i) ASSERT_TRUE((*begun)->step(scene));
  }
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(Film, SaysWhatIsWrongBesideTheField) {
  const TemporaryFolder folder;
  auto request = film(folder.path() / "turn.mp4");
  EXPECT_EQ(whyNotShot(request), "");
  const auto refused = [&](auto change, const char* why) {
    auto changed = request;
    change(changed);
    EXPECT_THAT(whyNotShot(changed), HasSubstr(why));
    EXPECT_FALSE(Shoot::begin(changed));
  };
  refused([](ShotRequest& r) { r.width = 321; }, "even");
  refused([](ShotRequest& r) { r.width = 10; }, "64x64");
  refused([](ShotRequest& r) { r.file = "x.avi"; }, ".mp4");
  refused([](ShotRequest& r) { r.rate = 0; }, "pictures per second");
  refused([](ShotRequest& r) { r.seconds = 1e9; }, "seconds");
  refused([](ShotRequest& r) { r.view.environment = nullptr; }, "Import a model");
  refused([](ShotRequest& r) { r.kind = ShotKind::walk_through; }, "no way to walk");
  refused(
      [](ShotRequest& r) {
        r.kind = ShotKind::panorama;
        r.file = "x.jpg";
      },
      "twice as wide");
  EXPECT_FALSE(Shoot::begin(film(folder.path() / "no" / "such" / "folder" / "turn.mp4")));
}

// An independent reader, where there is one: Debian's package ffmpeg.
TEST(Film, IsReadByFfprobe) {
  if (std::system("ffprobe -version > /dev/null 2>&1") != 0) GTEST_SKIP() << "ffprobe is not installed";
  const TemporaryFolder folder;
  const auto file = folder.path() / "turn.mp4";
  CountingScene scene;
  shoot(film(file), scene);
  const std::string command =
      "ffprobe -v error -count_frames -show_entries "
      "stream=codec_name,width,height,r_frame_rate,nb_read_frames,duration,color_space -of default=nw=1 " +
      file.string();
  std::string said;
  FILE* out = popen(command.c_str(), "r");
  ASSERT_NE(out, nullptr);
  std::array<char, 256> line{};
  while (fgets(line.data(), line.size(), out) != nullptr) said += line.data();
  EXPECT_EQ(pclose(out), 0);
  for (const char* wanted : {"codec_name=h264", "width=320", "height=180", "color_space=bt709", "r_frame_rate=25/1",
                             "duration=2.000000", "nb_read_frames=50"})
    EXPECT_THAT(said, HasSubstr(wanted));
}

}  // namespace
}  // namespace standpoint
