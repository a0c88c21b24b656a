// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/engine/end_powers.h"

#include <algorithm>

namespace standpoint {

namespace {

void setLane(SignalLanes& lanes, std::size_t k, const PathEnd& end) {
  lanes.range_m[k] = static_cast<float>(end.path_m);
  lanes.cosine[k] = end.cosine;
  lanes.gain[k] = end.gain;
  lanes.known_x[k] = end.known_x;
  lanes.diffuse[k] = std::min(1.0F, end.optics->diffuse * end.paint);
  lanes.roughness[k] = end.optics->roughness;
  lanes.glint[k] = end.optics->glint, lanes.steepness[k] = end.optics->steepness;
  if (retroEquivalent(*end.optics, end.cosine) == 0) return;
  // A retroreflector's gain is no figure of the lanes: as the Lambert surface that sends as much back.
  lanes.diffuse[k] = lambertEquivalent(*end.optics, end.cosine) / end.cosine;
  lanes.roughness[k] = 0, lanes.glint[k] = 0;
}

}  // namespace

EndPowers::EndPowers(const Receiver& receiver) : receiver_(receiver) {
  std::fill_n(signal_.variation, kSignalLanes, 1.0F);
  std::fill_n(signal_.range_m, kSignalLanes, 1.0F);
}

const std::vector<float>& EndPowers::of(const std::vector<PathEnd>& ends) {
  const std::size_t batches = (ends.size() + kSignalLanes - 1) / kSignalLanes;
  powers_.resize(batches * kSignalLanes);
  for (std::size_t batch = 0; batch < batches; ++batch) {
    const std::size_t from = batch * kSignalLanes, to = std::min(from + kSignalLanes, ends.size());
    for (std::size_t i = from; i < to; ++i) setLane(signal_, i - from, ends[i]);
    receivePower(signal_, receiver_, powers_.data() + from);
  }
  return powers_;
}

}  // namespace standpoint
