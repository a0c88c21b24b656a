// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/forecast/met_surface.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/scanners/scenes.h"

namespace standpoint {
namespace {

using namespace testing;
using Eigen::Vector3d;

PhysicalMaterial pane() {
  PhysicalMaterial glass;
  glass.id = "pane";
  glass.reflectance = {{1550, 0.005}};
  glass.transmittance = {{1550, 0.8}};
  glass.index_of_refraction = 1.5;
  glass.thickness_m = 0.004;
  return glass;
}

// From the origin: a wall at x = 10, before it at y > 0 a pane at x = 4.
class Met : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto instrument = testing::instrument("leica-rtc360");
    wall_ = scene_.quad({10, -5, -5}, {0, 10, 0}, {0, 0, 10});
    pane_ = scene_.quad({4, 0.5, -1}, {0, 2, 0}, {0, 0, 2});
    auto assignment = std::make_shared<MaterialAssignment>(allOf(*scene_.environment(), 0.5));
    assignment->materials.push_back(pane());
    for (auto& s : assignment->surfaces)
      if (s.product == pane_) s.material = 1;
    expectation_ = std::make_unique<Expectation>(scene_.build(), assignment,
                                                 ReturnLaw(instrument, window(instrument, -1, 1, -1, 1, 10, 10)));
  }
  MetSurface at(const Vector3d& point) const { return meetSurface(*expectation_, Vector3d::Zero(), point, {}); }

  SceneBuilder scene_;
  std::uint32_t wall_ = 0, pane_ = 0;
  std::unique_ptr<Expectation> expectation_;
};

TEST_F(Met, OnAWallSaysHowFarOffItIsAndAtWhichAngle) {
  const auto on = at({10.01, -3, 1});
  EXPECT_EQ(on.meeting, BeamMeeting::met);
  EXPECT_EQ(on.product, wall_);
  EXPECT_NEAR(on.off_m, 0.01, 1e-6);
  EXPECT_NEAR(on.range_m, std::sqrt(10.01 * 10.01 + 10), 1e-9);
  EXPECT_NEAR(on.cosine, 10.01 / std::sqrt(10.01 * 10.01 + 10), 1e-6);
  EXPECT_NEAR(on.normal.x(), -1, 1e-9);
  const auto near = at({9.9, -3, 1});
  EXPECT_EQ(near.meeting, BeamMeeting::near);
  EXPECT_NEAR(near.off_m, -0.1, 1e-6);
}

TEST_F(Met, BehindAWallInFrontOfItAndBesideItIsNotOnIt) {
  EXPECT_EQ(at({11, -3, 1}).meeting, BeamMeeting::behind);
  EXPECT_EQ(at({11, -3, 1}).product, wall_);
  EXPECT_EQ(at({5, -2, 0}).meeting, BeamMeeting::in_front);
  EXPECT_EQ(at({10, -8, 0}).meeting, BeamMeeting::in_front);
}

TEST_F(Met, SeesThroughAPaneUnlessThePointIsOnIt) {
  EXPECT_EQ(at({4, 1.5, 0}).meeting, BeamMeeting::met);
  EXPECT_EQ(at({4, 1.5, 0}).product, pane_);
  const auto beyond = at({10, 3.75, 0});
  EXPECT_EQ(beyond.meeting, BeamMeeting::behind_pane);
  EXPECT_EQ(beyond.product, wall_);
  EXPECT_EQ(at({4.1, 1.5, 0}).meeting, BeamMeeting::in_front) << "neither on the pane nor on the wall";
}

TEST_F(Met, BesideAnEdgeIsNotSureWhatItIs) {
  EXPECT_EQ(at({10, -4.99, 0}).meeting, BeamMeeting::edge);
  EXPECT_EQ(at({10, -4.95, 0}).meeting, BeamMeeting::met);
  EXPECT_EQ(at({4, 0.51, 0}).meeting, BeamMeeting::edge);
}

TEST_F(Met, WhatIsNoPointMeetsNothing) {
  EXPECT_EQ(at(Vector3d::Zero()).meeting, BeamMeeting::in_front);
  EXPECT_EQ(at({NAN, 0, 0}).meeting, BeamMeeting::in_front);
}

}  // namespace
}  // namespace standpoint
