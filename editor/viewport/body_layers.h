// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include <vtkRenderer.h>

#include "editor/bodies/standing.h"
#include "editor/viewport/layer.h"
#include "editor/viewport/merged_scene.h"

namespace standpoint {

// All solids of instruments that stand still, on their tripods, in one mesh; of the working one what does not turn.
MergedTriangles mergeStanding(const std::vector<StandingInstrument>& still, const StandingInstrument* working);
// What is carried along trajectories, and who or what bears it.
MergedTriangles mergeUnderWay(const std::vector<CarriedInstrument>& carried);
// What turns of the working one, in its scanner's frame before it has turned; without the mirror while that is a blur.
MergedTriangles mergeHead(const InstrumentBody& body, bool mirror_turns);
// What the display of the working one shows, in its scanner's frame before it has turned, as large as fits on it.
PaintedTriangles mergeDisplay(const InstrumentBody& body, const PixelPicture& shown);
// What shines or is seen through, local frame: the light and its halo, the mirror as a blurred disc, the fans.
MergedTriangles mergeGlow(const WorkingInstrument& working);

// The instruments of a scene: five things to be drawn, however many there are.
class BodyLayers {
 public:
  BodyLayers();
  // From `last`, which was shown before; null: nothing was.
  void update(const ViewState& state, const ViewState* last);
  void addSolids(vtkRenderer* renderer) const;
  void addGlow(vtkRenderer* renderer) const;        // after all else that is translucent
  const Bounds& bounds() const { return bounds_; }  // of the solids, local frame
  bool moves(const vtkProp* prop) const;            // while the working one works

 private:
  Layer solids_, head_, display_, glow_, under_way_;
  const InstrumentBody* head_of_ = nullptr;
  bool head_without_mirror_ = false;
  Bounds standing_bounds_, bounds_;
};

}  // namespace standpoint
