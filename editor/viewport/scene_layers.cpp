// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/viewport/scene_layers.h"

#include <utility>

#include <vtkProperty.h>

#include "editor/viewport/texture.h"

namespace standpoint {

namespace {

constexpr double kShadowStrength = 0.62;

// Black where the shadow is, else nothing.
vtkSmartPointer<vtkTexture> textureOf(const GroundShadow& shadow) {
  std::vector<Rgba> pixels;
  for (const auto darkness : shadow.darkness)
    pixels.push_back({0, 0, 0, static_cast<std::uint8_t>(kShadowStrength * darkness)});
  return clampedTexture(GroundShadow::kSide, GroundShadow::kSide, pixels);
}

}  // namespace

SceneLayers::SceneLayers(vtkRenderer* renderer) : renderer_(renderer), model_(renderer, edge_cache_) {
  grid_.drawLines({0.6, 0.6, 0.6}, 1, 1);
  shadow_.drawSurface(0);
  shadow_.light(false);
  doors_.drawSurface(1);
  door_glass_.drawSurface(1);
  door_edges_.drawLines({0.07, 0.08, 0.10}, 0.55, 1);
  shapes_.drawSurface(1);
  selected_.drawSurface(-1);
  selected_.actor->GetProperty()->SetAmbient(0.5);
  walkable_.drawSurface(-1);
  walkable_.actor->GetProperty()->SetAmbient(0.8);
  outline_.drawLines({0.42, 0.71, 1.0}, 1, 2);
  for (Layer* layer : {&grid_, &shadow_, &door_glass_, &selected_, &walkable_}) layer->actor->ForceTranslucentOn();
  for (Layer* layer :
       {&shadow_, &doors_, &door_glass_, &door_edges_, &shapes_, &selected_, &walkable_, &outline_, &grid_})
    layer->hide();
  arrange();
}

// What is translucent is blended in this order.
void SceneLayers::arrange() {
  renderer_->RemoveAllViewProps();
  renderer_->AddActor(grid_.actor);
  model_.addSurfaces();
  bodies_.addSolids(renderer_);
  renderer_->AddActor(shadow_.actor);
  for (Layer* layer : {&doors_, &door_edges_, &door_glass_}) renderer_->AddActor(layer->actor);
  model_.addTransparent();
  for (Layer* layer : {&shapes_, &selected_, &walkable_}) renderer_->AddActor(layer->actor);
  model_.addEdges();
  renderer_->AddActor(outline_.actor);
  bodies_.addGlow(renderer_);
}

void SceneLayers::update(const ViewState& state, const ViewState* last) {
  const bool environment = last == nullptr || last->environment != state.environment;
  const bool shown = environment || last->hidden != state.hidden;
  const bool theme = last == nullptr || last->graphics.theme != state.graphics.theme;
  if (environment) bounds_ = state.environment ? standpoint::bounds(*state.environment) : Bounds();
  if (model_.update(state)) arrange();
  if (shown || last->doors != state.doors || last->edges != state.edges || last->shapes != state.shapes ||
      last->cloud != state.cloud || last->materials != state.materials || last->colour != state.colour ||
      last->wavelength_nm != state.wavelength_nm)
    updateDoors(state);
  if (shown || last->selected != state.selected ||
      (last->colour == ColourMode::model) != (state.colour == ColourMode::model))
    updateSelection(state);
  if (last == nullptr || last->collision != state.collision || last->walkable != state.walkable ||
      last->shapes != state.shapes)
    updateCollision(state);
  if (environment || theme || last->grid != state.grid) updateGrid(state);
  if (theme && state.graphics.theme == Theme::light)
    outline_.actor->GetProperty()->SetColor(0.05, 0.36, 0.78);
  else if (theme)
    outline_.actor->GetProperty()->SetColor(0.42, 0.71, 1.0);
  bodies_.update(state, last);
  updateCut(state);
}

void SceneLayers::setPixels(int factor) {
  model_.setLineWidth(static_cast<float>(factor));
  for (Layer* layer : {&grid_, &door_edges_}) layer->actor->GetProperty()->SetLineWidth(static_cast<float>(factor));
  outline_.actor->GetProperty()->SetLineWidth(static_cast<float>(2 * factor));
}

void SceneLayers::spareLines(bool spared) {
  model_.spareEdges(spared);
  for (Layer* layer : {&grid_, &door_edges_}) layer->spare(spared);
}

void SceneLayers::updateDoors(const ViewState& state) {
  for (Layer* layer : {&doors_, &door_glass_, &door_edges_}) layer->hide();
  if (!state.doors || state.shapes || state.cloud) return;
  const auto doors = stateOfDoors(state);
  const auto merged = mergeVisible(doors);
  doors_.show(merged.opaque);
  door_glass_.show(merged.transparent);
  if (state.edges) door_edges_.show(door_edge_cache_.edges(doors, nullptr));
}

void SceneLayers::updateSelection(const ViewState& state) {
  selected_.hide();
  outline_.hide();
  if (!state.environment || !state.selected || state.selected->empty()) return;
  // Where the colours are what is looked at, the outline says enough.
  if (state.colour == ColourMode::model)
    selected_.show(mergeProducts(*state.environment, *state.selected, {64, 144, 247, 110}));
  outline_.show(edge_cache_.edges(state, state.selected.get()));
}

void SceneLayers::updateCollision(const ViewState& state) {
  shapes_.hide();
  walkable_.hide();
  if (!state.collision) return;
  if (state.shapes) shapes_.show(mergeShapes(*state.collision));
  if (state.walkable) walkable_.show(mergeWalkable(state.collision->walkable, {72, 200, 130, 120}));
}

void SceneLayers::cast(const ViewState& state, const GroundShadow& shadow) {
  shadow_.hide();
  if (shadow.darkness.empty()) return;
  std::vector<std::uint32_t> terrain;
  for (std::uint32_t p = 0; p < state.environment->products.size(); ++p)
    if (isTerrain(state.environment->products[p]) && isShown(state, p)) terrain.push_back(p);
  PaintedTriangles painted{mergeProducts(*state.environment, terrain, {255, 255, 255, 255}), {}, true};
  for (std::size_t i = 0; i + 2 < painted.triangles.positions.size(); i += 3) {
    const float* p = &painted.triangles.positions[i];
    painted.coordinates.push_back(static_cast<float>((p[0] - shadow.x) / shadow.width_m));
    painted.coordinates.push_back(static_cast<float>((p[1] - shadow.y) / shadow.height_m));
  }
  shadow_.show(painted, textureOf(shadow));
}

void SceneLayers::updateGrid(const ViewState& state) {
  grid_.hide();
  if (!state.grid || !state.environment || bounds_.empty()) return;
  grid_.mapper->SetColorModeToDirectScalars();
  grid_.set(groundGrid(bounds_, state.graphics.theme), false);
}

void SceneLayers::updateCut(const ViewState& state) {
  const auto kept = keptSides(state.clip, state.cut_height_m);
  const auto cut = [&](Layer& layer) { layer.cut(kept); };
  model_.forEachLayer(cut);
  for (Layer* layer : {&doors_, &door_glass_, &door_edges_, &shapes_, &selected_, &walkable_, &outline_}) cut(*layer);
}

}  // namespace standpoint
