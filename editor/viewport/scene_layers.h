// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include <vtkRenderer.h>

#include "editor/viewport/body_layers.h"
#include "editor/viewport/ground_shadow.h"
#include "editor/viewport/layer.h"
#include "editor/viewport/merged_scene.h"
#include "editor/viewport/model_pieces.h"

namespace standpoint {

// All that is drawn of a scene, and what of it must be made anew when another state is shown.
class SceneLayers {
 public:
  explicit SceneLayers(vtkRenderer* renderer);
  // From `last`, which was shown before; null: nothing was.
  void update(const ViewState& state, const ViewState* last);
  bool building() const { return model_.building(); }  // more comes with another update to the same state
  // On the terrain of the model; an empty one takes it away.
  void cast(const ViewState& state, const GroundShadow& shadow);
  void setPixels(int factor);    // of the picture that is drawn, for each of the picture that is seen
  void spareLines(bool spared);  // edges of the model and the grid, in pictures to come
  const Bounds& bounds() const { return bounds_; }  // of the environment
  const Bounds& bodies() const { return bodies_.bounds(); }
  bool moves(const vtkProp* prop) const { return bodies_.moves(prop); }  // in pictures where all else stands still

 private:
  void arrange();
  void updateSelection(const ViewState& state);
  void updateDoors(const ViewState& state);
  void updateCollision(const ViewState& state);
  void updateGrid(const ViewState& state);
  void updateCut(const ViewState& state);

  vtkRenderer* renderer_;
  EdgeCache edge_cache_, door_edge_cache_;
  ModelPieces model_;
  BodyLayers bodies_;
  Layer shadow_, shapes_, selected_, walkable_, outline_, grid_, doors_, door_glass_, door_edges_;
  Bounds bounds_;
};

}  // namespace standpoint
