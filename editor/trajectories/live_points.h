// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "editor/clouds/underlay_view.h"

namespace standpoint {

// What points are coloured by that come while somebody walks: height above their feet, or distance from the scanner.
enum class LiveColour { height, range };
// Of the last colour of the scale; the first one is 0.
double liveScale_m(LiveColour colour);

struct LivePoint {
  std::array<float, 3> place_m = {};  // from the store's origin
  float height_m = 0, range_m = 0;
};

// The points of a walk so far, no more than there is room for: where more come, of the oldest ones every second is
// given up, and again later, so that what is new is whole and what is old stays, thinner the older it is.
class LivePoints {
 public:
  static constexpr std::size_t kMost = 1000000;
  static constexpr std::size_t kPart = 32768;  // points that are drawn together, or some more

  explicit LivePoints(const Eigen::Vector3d& origin_m = Eigen::Vector3d::Zero(), std::size_t most = kMost)
      : origin_m_(origin_m), most_(most) {}

  const Eigen::Vector3d& origin_m() const { return origin_m_; }  // local frame
  void add(std::vector<LivePoint> points);
  void colourBy(LiveColour colour);

  std::uint64_t seen() const { return seen_; }
  std::size_t kept() const { return kept_; }
  std::size_t parts() const { return parts_.size(); }
  std::vector<ShownUnderlay> shown() const;

 private:
  struct Part {
    std::vector<LivePoint> points;
    int thinned = 0;  // times that every second one was given up
    std::shared_ptr<const Cloud> cloud;
  };
  std::shared_ptr<const Cloud> cloudOf(const std::vector<LivePoint>& points) const;
  void thinOldest();

  Eigen::Vector3d origin_m_;
  std::size_t most_, kept_ = 0;
  std::uint64_t seen_ = 0;
  LiveColour colour_ = LiveColour::height;
  std::vector<Part> parts_;  // the oldest first
};

}  // namespace standpoint
