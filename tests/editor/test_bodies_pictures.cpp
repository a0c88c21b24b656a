// SPDX-License-Identifier: GPL-3.0-or-later
// The instruments as they are drawn, beside somebody 1.75 m tall. The pictures stay in the build folder for people to
// look at.
#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>
#include <vtk_glew.h>

#include "core/units.h"
#include "editor/film/picture_file.h"
#include "editor/viewport/body_layers.h"
#include "editor/viewport/offscreen.h"

namespace standpoint {
namespace {

constexpr int kSheetWidth = 640, kSheetHeight = 800;
constexpr double kInstrumentHeight_m = 1.6;

// A floor, and where `person` is, three blocks as tall as a person.
std::shared_ptr<const Environment> floorWith(bool person) {
  Environment e;
  e.surfaces = {{"floor", {0.72F, 0.72F, 0.70F, 1}}, {"person", {0.35F, 0.45F, 0.62F, 1}}};
  Mesh mesh;
  const auto block = [&](Eigen::Vector3f low, Eigen::Vector3f high, std::int32_t surface) {
    static constexpr int kCorner[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                          {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& face : kCorner) {
      const auto first = static_cast<std::uint32_t>(mesh.positions.size());
      for (const int c : face)
        mesh.positions.emplace_back((c & 1) != 0 ? high.x() : low.x(), (c & 2) != 0 ? high.y() : low.y(),
                                    (c & 4) != 0 ? high.z() : low.z());
      mesh.triangles.push_back({first, first + 1, first + 2});
      mesh.triangles.push_back({first, first + 2, first + 3});
      mesh.surface_of_triangle.insert(mesh.surface_of_triangle.end(), 2, static_cast<std::uint32_t>(surface));
    }
  };
  block({-1.2F, -1.2F, -0.1F}, {1.8F, 1.2F, 0}, 0);
  if (person) {
    block({0.75F, -0.12F, 0}, {1.05F, 0.12F, 0.85F}, 1);
    block({0.68F, -0.13F, 0.85F}, {1.12F, 0.13F, 1.48F}, 1);
    block({0.81F, -0.1F, 1.52F}, {0.99F, 0.1F, 1.75F}, 1);
  }
  e.meshes = {std::make_shared<Mesh>(mesh)};
  e.products.resize(1);
  e.instances = {{0, 0, Eigen::Affine3d::Identity()}};
  return std::make_shared<const Environment>(e);
}

class Bodies : public ::testing::Test {
 protected:
  void SetUp() override {
    auto made = Offscreen::create(kSheetWidth, kSheetHeight, 1);
    if (!made) GTEST_SKIP() << describe(made.error());
    offscreen = std::move(*made);
    state.environment = floorWith(true);
    state.edges = state.grid = false;
    state.still_light = true;
    state.graphics.level = GraphicsLevel::medium;
    lookAt({0.45, 0, 0.95}, 3.1);
  }
  void lookAt(const Eigen::Vector3d& target, double distance_m) {
    state.camera.target = target;
    state.camera.distance_m = distance_m;
    state.camera.azimuth_rad = 0.35;
    state.camera.elevation_rad = 0.2;
    state.camera.view_angle_rad = 0.72;
  }
  static StandingInstrument at(const InstrumentBody& body) {
    StandingInstrument s{&body, {0, 0, kInstrumentHeight_m}, Eigen::Quaterniond::Identity(), kInstrumentHeight_m};
    s.rotation = Eigen::AngleAxisd(-50 * kRadPerDeg, Eigen::Vector3d::UnitZ());
    return s;
  }
  void stand(const InstrumentBody& body) {
    state.instruments = std::make_shared<const InstrumentsInScene>(InstrumentsInScene{{at(body)}});
  }
  PixelPicture drawn(const std::string& name) {
    const auto picture = offscreen->scene().pixels(state, kSheetWidth, kSheetHeight);
    EXPECT_TRUE(picture) << name;
    if (!picture) return {};
    const auto folder = std::filesystem::path(BINARY_DIR) / "bodies";
    std::filesystem::create_directories(folder);
    EXPECT_TRUE(writePicture(*picture, folder / (name + ".png")));
    return *picture;
  }
  static PixelPicture readTexture(std::uint64_t texture) {
    PixelPicture picture{kSheetWidth, kSheetHeight, {}};
    picture.rgba.resize(static_cast<std::size_t>(kSheetWidth) * kSheetHeight);
    glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(texture));
    glGetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_UNSIGNED_BYTE, picture.rgba.data());
    return picture;
  }
  static std::size_t differing(const PixelPicture& a, const PixelPicture& b) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i) {
      int most = 0;
      for (std::size_t c = 0; c < 3; ++c) most = std::max(most, std::abs(int{a.rgba[i][c]} - int{b.rgba[i][c]}));
      count += most > 24 ? 1 : 0;
    }
    return count;
  }

  std::unique_ptr<Offscreen> offscreen;
  ViewState state;
};

TEST_F(Bodies, AreDrawnBesideAPerson) {
  const auto without = drawn("nobody");
  for (const auto& body : instrumentBodies()) {
    stand(body);
    EXPECT_GT(differing(drawn(std::string(body.id)), without), 4000U) << body.id;
  }
}

// With the colours taken away: what is covered from the side and from the front, by one and not by the other, measured
// by the smaller of both.
TEST_F(Bodies, AreToldApartByTheirSilhouettes) {
  state.environment = floorWith(false);
  std::vector<std::vector<bool>> covered;
  const auto bare = drawn("bare");
  lookAt({0, 0, 1.62}, 1.0);
  state.instruments.reset();
  const auto background = offscreen->scene().pixels(state, kSheetWidth, kSheetHeight);
  ASSERT_TRUE(background);
  for (const auto& body : instrumentBodies()) {
    stand(body);
    const auto near = drawn(std::string(body.id) + "-near");
    std::vector<bool> mask(near.rgba.size());
    for (std::size_t i = 0; i < mask.size(); ++i) mask[i] = near.rgba[i] != background->rgba[i];
    covered.push_back(std::move(mask));
  }
  const auto bodies = instrumentBodies();
  for (std::size_t a = 0; a < covered.size(); ++a)
    for (std::size_t b = a + 1; b < covered.size(); ++b) {
      std::size_t either = 0, one = 0;
      for (std::size_t i = 0; i < covered[a].size(); ++i) {
        either += covered[a][i] || covered[b][i] ? 1 : 0;
        one += covered[a][i] != covered[b][i] ? 1 : 0;
      }
      EXPECT_GT(static_cast<double>(one), 0.1 * static_cast<double>(either)) << bodies[a].id << " and " << bodies[b].id;
    }
}

TEST_F(Bodies, ShowTheirLightTheBlurOfTheMirrorAndTheFansWhileTheyWork) {
  lookAt({0.2, 0, 1.4}, 2.2);
  for (const auto& body : instrumentBodies()) {
    state.instruments.reset();
    WorkingInstrument working{at(body), {}};
    state.working = working;
    const auto still = drawn(std::string(body.id) + "-still");
    working.motion.mirror_turns = true;
    working.motion.lamp = LampColour{255, 60, 40};
    working.motion.head_rad = 0.6;
    for (int fan = 0; fan < body.fans; ++fan) {
      SweepFan f{0.6 + fan * 180 * kRadPerDeg, -60 * kRadPerDeg, 90 * kRadPerDeg, {}};
      if (body.fans == 1) f.from_rad = -40 * kRadPerDeg, f.to_rad = 60 * kRadPerDeg;
      f.ranges_m.assign(33, 0.9F);
      working.motion.fans.push_back(f);
    }
    state.working = working;
    EXPECT_GT(differing(drawn(std::string(body.id) + "-works"), still), 8000U) << body.id;
  }
}

// A picture whose upper left quarter is red and lower right one is blue lies on the glass, and is read from before it.
TEST_F(Bodies, ShowOnTheirDisplayWhatTheDeviceShows) {
  PixelPicture shown{40, 60, {}};
  for (int row = 0; row < shown.height; ++row)
    for (int column = 0; column < shown.width; ++column) {
      const bool left = column < shown.width / 2, upper = row < shown.height / 2;
      shown.rgba.push_back({static_cast<std::uint8_t>(left && upper ? 255 : 0), 0,
                            static_cast<std::uint8_t>(!left && !upper ? 255 : 0), 255});
    }
  int with_display = 0;
  for (const auto& body : instrumentBodies()) {
    state.instruments.reset();
    state.working = WorkingInstrument{at(body), {}};
    state.working->motion.head_rad = 0.4;
    const Eigen::Quaterniond turned =
        state.working->stands.rotation * Eigen::AngleAxisd(-0.4, Eigen::Vector3d::UnitZ());
    const Eigen::Vector3d way = -(turned * body.face_faces);
    state.camera.target = state.working->stands.centre_m + turned * body.face_m;
    state.camera.distance_m = 0.4;
    state.camera.azimuth_rad = std::atan2(-way.x(), way.y());
    state.camera.elevation_rad = 0;
    state.display = nullptr;
    const auto dark = drawn(std::string(body.id) + "-dark");
    if (body.display_m.x() <= 0) continue;
    ++with_display;
    state.display = std::make_shared<const PixelPicture>(shown);
    const auto lit = drawn(std::string(body.id) + "-lit");
    EXPECT_GT(differing(lit, dark), 500U) << body.id;
    // Middles of where its colours are, to the right and down from the middle of the picture.
    Eigen::Vector2d red(0, 0), blue(0, 0);
    int reds = 0, blues = 0;
    for (std::size_t i = 0; i < lit.rgba.size(); ++i) {
      const auto& p = lit.rgba[i];
      const Eigen::Vector2d place(static_cast<double>(i % kSheetWidth), static_cast<double>(i / kSheetWidth));
      if (p[0] > 200 && p[1] < 40 && p[2] < 40) red += place, ++reds;
      if (p[2] > 200 && p[1] < 40 && p[0] < 40) blue += place, ++blues;
    }
    ASSERT_GT(std::min(reds, blues), 200) << body.id;
    const Eigen::Vector2d off = blue / blues - red / reds;
    EXPECT_GT(off.x(), 5) << body.id << ": blue is at the right";
    EXPECT_GT(off.y(), 5) << body.id << ": and below";
    EXPECT_NEAR((blue / blues + red / reds - Eigen::Vector2d(kSheetWidth, kSheetHeight)).norm(), 0, 25) << body.id;
  }
  EXPECT_EQ(with_display, 5);
}

// What stands still is drawn once for many pictures in which only the instrument works: they show the same as whole
// ones.
TEST_F(Bodies, WorkInPicturesThatAreDrawnInPartsAsInWholeOnes) {
  lookAt({0.2, 0, 1.4}, 2.2);
  state.graphics.level = GraphicsLevel::low;  // above it, edges of what moves are softened in whole pictures only
  const auto& body = instrumentBodies().front();
  WorkingInstrument working{at(body), {}};
  working.motion.lamp = LampColour{255, 60, 40};
  const auto pictureAt = [&](double head_rad, bool moved_before) {
    auto& scene = offscreen->scene();
    working.motion.head_rad = head_rad;
    state.working = working;
    if (moved_before) {  // the camera has been elsewhere: all is drawn
      ViewState elsewhere = state;
      elsewhere.camera.azimuth_rad += 0.3;
      scene.texture(elsewhere, kSheetWidth, kSheetHeight, false);
    }
    return readTexture(scene.texture(state, kSheetWidth, kSheetHeight, false));
  };
  pictureAt(0, true);
  const auto first = pictureAt(0.2, false), in_parts = pictureAt(1.1, false), whole = pictureAt(1.1, true);
  EXPECT_GT(differing(in_parts, first), 500U) << "the head has turned";
  EXPECT_LT(differing(in_parts, whole), 20U);
}

// Each carried instrument with what bears it, as somebody sees it from the side.
TEST_F(Bodies, OfCarriedInstrumentsAreDrawnWithWhatBearsThem) {
  state.environment = floorWith(false);
  lookAt({-0.1, 0, 1.1}, 3.4);
  const auto bare = drawn("nothing-carried");
  const auto carried = [](std::string_view instrument, const char* carrier, double height_m) {
    CarriedInstrument made;
    made.body = &carriedBodyOf(instrument);
    made.pose.translation = {0, 0, height_m};
    made.pose.rotation = Eigen::AngleAxisd(-50 * kRadPerDeg, Eigen::Vector3d::UnitZ());
    made.carrier = carrier;
    made.height_m = height_m;
    return made;
  };
  const auto showOnly = [&](CarriedInstrument&& instrument, bool somebody) {
    if (somebody) {
      const double behind_m = instrument.carrier == "hand" ? 0.4 : 0;
      const Pose floor{instrument.pose.rotation, instrument.pose * Eigen::Vector3d(-behind_m, 0, -instrument.height_m)};
      instrument.limbs.assign(7, floor);
    }
    state.under_way = std::make_shared<const InstrumentsUnderWay>(InstrumentsUnderWay{{std::move(instrument)}});
  };
  for (const auto& body : carriedBodies()) {
    const bool held = body.grip_m.has_value();
    showOnly(carried(body.look.id, held ? "hand" : "backpack", held ? 1.3 : 1.9), true);
    EXPECT_GT(differing(drawn("carried-" + std::string(body.look.id)), bare), 8000U) << body.look.id;
  }
  for (const auto& [carrier, height_m] : {std::pair{"trolley", 1.7}, {"vehicle", 2.2}, {"uav", 1.2}}) {
    showOnly(carried(std::string_view(carrier) == "uav" ? "riegl-vux-1uav" : "hesai-xt32", carrier, height_m), false);
    EXPECT_GT(differing(drawn("carried-by-" + std::string(carrier)), bare), 5000U) << carrier;
  }
  state.under_way.reset();
  EXPECT_EQ(differing(drawn("nothing-carried"), bare), 0U) << "it is gone again";
}

TEST_F(Bodies, OfCarriedInstrumentsAreToldApart) {
  state.environment = floorWith(false);
  lookAt({0, 0, 1.55}, 1.3);
  std::vector<PixelPicture> pictures;
  for (const auto& body : carriedBodies()) {
    CarriedInstrument made;
    made.body = &body;
    made.pose.translation = {0, 0, 1.6};
    made.pose.rotation = Eigen::AngleAxisd(-50 * kRadPerDeg, Eigen::Vector3d::UnitZ());
    state.under_way = std::make_shared<const InstrumentsUnderWay>(InstrumentsUnderWay{{made}});
    pictures.push_back(drawn(std::string(body.look.id) + "-alone"));
  }
  for (std::size_t a = 0; a < pictures.size(); ++a)
    for (std::size_t b = a + 1; b < pictures.size(); ++b) {
      if (carriedBodies()[a].worn && carriedBodies()[b].worn) continue;  // two ages of one frame
      EXPECT_GT(differing(pictures[a], pictures[b]), 300U)
          << carriedBodies()[a].look.id << ", " << carriedBodies()[b].look.id;
    }
}

TEST(MergedBodies, AreOneMeshOfAllThatStandAndOneOfWhatTurns) {
  const auto bodies = instrumentBodies();
  const StandingInstrument first{&bodies[0], {0, 0, 1.6}, Eigen::Quaterniond::Identity(), 1.6};
  const StandingInstrument second{&bodies[4], {4, 0, 1.6}, Eigen::Quaterniond::Identity(), 1.6};
  const auto one = mergeStanding({first}, nullptr), both = mergeStanding({first, second}, nullptr);
  EXPECT_GT(both.colours.size(), one.colours.size());
  EXPECT_EQ(both.corners.size(), 3 * both.colours.size());
  const auto foot_only = mergeStanding({}, &first);
  EXPECT_EQ(one.colours.size(), foot_only.colours.size() + mergeHead(bodies[0], false).colours.size());
  EXPECT_EQ(mergeHead(bodies[0], true).colours.size(), bodies[0].head.triangles.size());
}

}  // namespace
}  // namespace standpoint
