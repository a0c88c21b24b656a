// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/viewport/scene_layers.h"

#include <utility>

#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkProperty.h>

namespace standpoint {

namespace {

constexpr double kShadowStrength = 0.62;

// Black where the shadow is, else nothing.
vtkSmartPointer<vtkTexture> textureOf(const GroundShadow& shadow) {
  vtkNew<vtkImageData> data;
  data->SetDimensions(GroundShadow::kSide, GroundShadow::kSide, 1);
  data->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
  auto* pixel = static_cast<std::uint8_t*>(data->GetScalarPointer());
  for (const auto darkness : shadow.darkness) {
    const auto alpha = static_cast<std::uint8_t>(kShadowStrength * darkness);
    for (const std::uint8_t value : {std::uint8_t{0}, std::uint8_t{0}, std::uint8_t{0}, alpha}) *pixel++ = value;
  }
  auto texture = vtkSmartPointer<vtkTexture>::New();
  texture->SetInputData(data);
  texture->SetColorModeToDirectScalars();
  texture->InterpolateOn();
  texture->RepeatOff();
  texture->EdgeClampOn();
  return texture;
}

}  // namespace

SceneLayers::SceneLayers(vtkRenderer* renderer) : renderer_(renderer), model_(renderer, edge_cache_) {
  grid_.drawLines({0.6, 0.6, 0.6}, 1, 1);
  shadow_.drawSurface(0);
  shadow_.actor->GetProperty()->SetLighting(false);
  shapes_.drawSurface(1);
  selected_.drawSurface(-1);
  selected_.actor->GetProperty()->SetAmbient(0.5);
  walkable_.drawSurface(-1);
  walkable_.actor->GetProperty()->SetAmbient(0.8);
  outline_.drawLines({0.42, 0.71, 1.0}, 1, 2);
  cloud_.drawPoints();
  for (Layer* layer : {&grid_, &shadow_, &selected_, &walkable_}) layer->actor->ForceTranslucentOn();
  for (Layer* layer : {&shadow_, &shapes_, &selected_, &walkable_, &outline_, &grid_, &cloud_}) layer->hide();
  arrange();
}

// What is translucent is blended in this order.
void SceneLayers::arrange() {
  renderer_->RemoveAllViewProps();
  renderer_->AddActor(grid_.actor);
  model_.addSurfaces();
  renderer_->AddActor(shadow_.actor);
  model_.addTransparent();
  for (Layer* layer : {&shapes_, &selected_, &walkable_}) renderer_->AddActor(layer->actor);
  model_.addEdges();
  for (Layer* layer : {&outline_, &cloud_}) renderer_->AddActor(layer->actor);
  for (const auto& u : underlays_) renderer_->AddActor(u->layer.actor);
}

void SceneLayers::update(const ViewState& state, const ViewState* last) {
  const bool environment = last == nullptr || last->environment != state.environment;
  const bool shown = environment || last->hidden != state.hidden;
  const bool theme = last == nullptr || last->graphics.theme != state.graphics.theme;
  if (environment) bounds_ = state.environment ? standpoint::bounds(*state.environment) : Bounds();
  if (model_.update(state)) arrange();
  if (shown || last->selected != state.selected) updateSelection(state);
  if (last == nullptr || last->collision != state.collision || last->walkable != state.walkable ||
      last->shapes != state.shapes)
    updateCollision(state);
  if (environment || theme || last->grid != state.grid) updateGrid(state);
  if (theme && state.graphics.theme == Theme::light)
    outline_.actor->GetProperty()->SetColor(0.05, 0.36, 0.78);
  else if (theme)
    outline_.actor->GetProperty()->SetColor(0.42, 0.71, 1.0);
  if (last == nullptr || last->cloud != state.cloud)
    updateCloud(state);
  else if (state.cloud && last->cloud_colours != state.cloud_colours)
    cloud_.paintPoints(state.cloud_colours ? *state.cloud_colours : state.cloud->colours);
  if (point_size_ != state.point_size) {
    point_size_ = state.point_size;
    setPixels(pixels_);
  }
  if (last == nullptr || last->underlays != state.underlays || last->cloud != state.cloud) updateUnderlays(state);
  reach_ = reachOf(state);
  updateCut(state);
}

void SceneLayers::setPixels(int factor) {
  pixels_ = factor;
  model_.setLineWidth(static_cast<float>(factor));
  grid_.actor->GetProperty()->SetLineWidth(static_cast<float>(factor));
  outline_.actor->GetProperty()->SetLineWidth(static_cast<float>(2 * factor));
  cloud_.actor->GetProperty()->SetPointSize(static_cast<float>(point_size_ * factor));
  for (const auto& u : underlays_)
    u->layer.actor->GetProperty()->SetPointSize(static_cast<float>(point_size_ * factor));
}

void SceneLayers::updateSelection(const ViewState& state) {
  selected_.hide();
  outline_.hide();
  if (!state.environment || !state.selected || state.selected->empty()) return;
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

void SceneLayers::updateCloud(const ViewState& state) {
  cloud_.hide();
  if (!state.cloud) return;
  cloud_.show(*state.cloud);
  if (state.cloud_colours) cloud_.paintPoints(*state.cloud_colours);
}

// Above what can be turned smoothly each shows every k-th point of its sample.
void SceneLayers::updateUnderlays(const ViewState& state) {
  std::uint64_t points = 0;
  for (const auto& u : state.underlays) points += u.cloud->points.size();
  const auto step = static_cast<std::size_t>(points / kMostShownPoints + 1);
  while (underlays_.size() < state.underlays.size()) {
    underlays_.push_back(std::make_unique<UnderlayLayer>());
    underlays_.back()->layer.drawPoints();
    renderer_->AddActor(underlays_.back()->layer.actor);
    underlays_.back()->layer.actor->GetProperty()->SetPointSize(cloud_.actor->GetProperty()->GetPointSize());
  }
  for (std::size_t i = 0; i < underlays_.size(); ++i) {
    auto& [layer, cloud, shown_step] = *underlays_[i];
    layer.hide();
    if (state.cloud || i >= state.underlays.size()) continue;
    const auto& wanted = state.underlays[i];
    if (cloud != wanted.cloud || shown_step != step) layer.show(*wanted.cloud, step);
    cloud = wanted.cloud;
    shown_step = step;
    vtkNew<vtkMatrix4x4> matrix;
    for (int row = 0; row < 4; ++row)
      for (int column = 0; column < 4; ++column) matrix->SetElement(row, column, wanted.local_from_cloud(row, column));
    layer.actor->SetUserMatrix(matrix);
    layer.actor->SetVisibility(1);
  }
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

// Of all that is shown; what lies behind it is not drawn.
Bounds SceneLayers::reachOf(const ViewState& state) const {
  Bounds reach = bounds_;
  if (!state.cloud)
    for (const auto& u : underlays_)
      if (u->layer.actor->GetVisibility() != 0) {
        const double* b = u->layer.actor->GetBounds();
        reach.extend(Eigen::Vector3d(b[0], b[2], b[4]));
        reach.extend(Eigen::Vector3d(b[1], b[3], b[5]));
      }
  return reach;
}

void SceneLayers::updateGrid(const ViewState& state) {
  grid_.hide();
  if (!state.grid || !state.environment || bounds_.empty()) return;
  grid_.mapper->SetColorModeToDirectScalars();
  grid_.set(groundGrid(bounds_, state.graphics.theme), false);
}

// OpenGL has planes for a box and no more, so that a cut lowers the box's top.
void SceneLayers::updateCut(const ViewState& state) {
  std::vector<ClipPlane> kept;
  if (const auto box = combined(state.clip, state.cut_height_m))
    for (int face = 0; face < kClipFaces; ++face) kept.push_back(planeOf(*box, face));
  else if (state.cut_height_m)
    kept.push_back({{0, 0, *state.cut_height_m}, -Eigen::Vector3d::UnitZ()});
  const auto cut = [&](Layer& layer) { layer.cut(kept); };
  model_.forEachLayer(cut);
  for (Layer* layer : {&shapes_, &selected_, &walkable_, &outline_, &cloud_}) cut(*layer);
  for (const auto& u : underlays_) cut(u->layer);
}

}  // namespace standpoint
