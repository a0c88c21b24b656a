// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "editor/model/coverage_view.h"
#include "editor/model/view_state.h"
#include "project/latest_task.h"
#include "scanners/forecast/expectation.h"

namespace standpoint {

enum class ExpectedQuantity { intensity, noise, fate };
constexpr double kNoiseFullScale_m = 0.005;  // what has the last colour

std::array<std::uint8_t, 4> fateColour(ReturnFate fate);
const char* fateName(ReturnFate fate);
// Of a legend: 0..1 of the scale.
std::array<std::uint8_t, 4> scaleColour(ExpectedQuantity quantity, double fraction);
// What does not come back has the colour of its reason, whatever is asked for.
std::array<std::uint8_t, 4> expectedColour(ExpectedQuantity quantity, const ExpectedReturn& expected);

// Made anew only when something that it depends on is another one.
class KeptExpectation {
 public:
  // Without `materials` by the colours of the model. The instrument has its default settings; null where these are
  // refused.
  const std::shared_ptr<const Expectation>& of(const std::shared_ptr<const RayScene>& scene,
                                               const std::shared_ptr<const MaterialChoice>& materials,
                                               const Instrument& instrument);

 private:
  std::shared_ptr<const RayScene> scene_;
  std::shared_ptr<const MaterialChoice> materials_;
  std::string instrument_;
  std::shared_ptr<const Expectation> expectation_;
};

// All that a picture of expected returns depends on.
struct ExpectedRequest {
  std::shared_ptr<const Expectation> expectation;
  std::shared_ptr<const RayScene> scene;              // that the camera sees
  ViewState view;                                     // camera, and what is hidden or cut away
  Eigen::Vector3d station = Eigen::Vector3d::Zero();  // the instrument's centre, local frame
  ExpectedQuantity quantity = ExpectedQuantity::intensity;
  std::optional<CoverageQuantity> coverage;  // instead: what these see of it
  std::vector<SeenFrom> scans;
  SeenWhen wanted;
  int width = 0, height = 0;  // pixels
  bool operator==(const ExpectedRequest&) const = default;
};

// Draws what a station is expected to get, through the camera: a ray for each pixel, and one from the station to what
// it meets, by the laws of the scan. In the background, coarse first; a newer request ends an older one. While only the
// station moves, the camera's rays are kept.
class ExpectedView {
 public:
  // `wake` is called whenever a picture has become better.
  explicit ExpectedView(std::function<void()> wake);

  void want(const ExpectedRequest& request);
  void drop();
  void wait() { latest_.wait(); }  // until the finest picture of what is wanted is there
  // The newest there is through this camera; null: none.
  std::shared_ptr<const PixelPicture> picture(const Camera& camera) const;

 private:
  class Drawing;
  struct Finest {};                   // it is there
  std::shared_ptr<Drawing> drawing_;  // null: nothing is wanted
  LatestTask<ExpectedRequest, Finest> latest_;
};

}  // namespace standpoint
