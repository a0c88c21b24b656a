// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

#include "scanners/engine/embree_scene.h"
#include "scanners/radiometry/radiometry.h"

namespace standpoint {

constexpr int kMostPanes = 16;           // faces that a beam may pass
constexpr double kBehindFace_m = 1e-4;   // where the search behind a face goes on
constexpr double kThickestPane_m = 0.2;  // faces farther apart are two panes

// What a beam loses in the panes that it passes, there and back (physics.md §4.6). A pane is usually modelled as a
// solid, so its second face is the same pane: same product, other side.
class PanePassage {
 public:
  double gain() const { return gain_; }          // of what lies behind
  double excess_m() const { return excess_m_; }  // of the optical path over that in air, one way

  // Is this where the beam leaves the pane that it is in?
  bool isOtherFace(const Facet& facet, bool front, double range_m) const {
    return product_ == facet.product && front != front_ && range_m - range_m_ < kThickestPane_m;
  }
  // How far aside the light goes on, across its direction: along t in the glass, d / cos θt long at the speed c / n_g.
  //   shift = d / cos θt · (t - (t·direction) direction),  excess = d / cos θt · (n_g - t·direction)
  Eigen::Vector3d enter(const Optics& optics, const Eigen::Vector3d& direction, const Facet& facet, bool front,
                        double range_m) {
    const Eigen::Vector3d inward = front ? Eigen::Vector3d(-facet.normal) : facet.normal;
    const double cosine = std::min(1.0, inward.dot(direction)), sine2 = 1 - cosine * cosine;
    const double transmitted = stack(slab(optics.index, optics.inner_transmittance, cosine), optics.panes).transmitted;
    const double cosine_inside = std::sqrt(1 - sine2 / (optics.index * optics.index));
    const double turned = cosine * cosine_inside + sine2 / optics.index;  // t·direction = cos(θ - θt)
    const double way_m = optics.panes * optics.thickness_m / cosine_inside;
    gain_ *= transmitted * transmitted;
    excess_m_ += way_m * (optics.group_index - turned);
    product_ = facet.product;
    front_ = front;
    range_m_ = range_m;
    return way_m * ((1 / optics.index - turned) * direction + (cosine_inside - cosine / optics.index) * inward);
  }
  void leave() { product_ = -1; }

 private:
  double gain_ = 1, excess_m_ = 0;
  std::int64_t product_ = -1;  // of the pane that it is in
  bool front_ = false;
  double range_m_ = 0;
};

}  // namespace standpoint
