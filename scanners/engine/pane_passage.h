// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

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
  double excess_m() const { return excess_m_; }  // of the optical path, one way

  // Is this where the beam leaves the pane that it is in?
  bool isOtherFace(const Facet& facet, bool front, double range_m) const {
    return product_ == facet.product && front != front_ && range_m - range_m_ < kThickestPane_m;
  }
  void enter(const Optics& optics, double cosine, const Facet& facet, bool front, double range_m) {
    const double transmitted = stack(slab(optics.index, optics.inner_transmittance, cosine), optics.panes).transmitted;
    gain_ *= transmitted * transmitted;
    excess_m_ += optics.panes * (optics.index - 1) * optics.thickness_m;
    product_ = facet.product;
    front_ = front;
    range_m_ = range_m;
  }
  void leave() { product_ = -1; }

 private:
  double gain_ = 1, excess_m_ = 0;
  std::int64_t product_ = -1;  // of the pane that it is in
  bool front_ = false;
  double range_m_ = 0;
};

}  // namespace standpoint
