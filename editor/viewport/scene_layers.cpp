// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/viewport/scene_layers.h"

#include <utility>

#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkProperty.h>

namespace standpoint {

namespace {

constexpr std::uint64_t kMostEdges = 1500000;
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

void SceneLayers::setUpSurface(Layer& layer, double offset) {
  auto* property = layer.actor->GetProperty();
  property->SetInterpolationToFlat();
  property->SetAmbient(0.34);
  property->SetDiffuse(0.78);
  property->SetSpecular(0);
  layer.mapper->SetColorModeToDirectScalars();
  layer.mapper->SetResolveCoincidentTopologyToPolygonOffset();
  layer.mapper->SetRelativeCoincidentTopologyPolygonOffsetParameters(offset, offset);
  renderer_->AddActor(layer.actor);
}

void SceneLayers::setUpLines(Layer& layer, std::array<double, 3> colour, double opacity, double width) {
  auto* property = layer.actor->GetProperty();
  property->SetLighting(false);
  property->SetColor(colour.data());
  property->SetOpacity(opacity);
  property->SetLineWidth(static_cast<float>(width));
  renderer_->AddActor(layer.actor);
}

void SceneLayers::setUpPoints(Layer& layer) {
  layer.actor->GetProperty()->SetLighting(false);
  layer.mapper->SetScalarModeToUsePointData();
  layer.mapper->SetColorModeToDirectScalars();
  renderer_->AddActor(layer.actor);
}

SceneLayers::SceneLayers(vtkRenderer* renderer) : renderer_(renderer) {
  setUpLines(grid_, {0.6, 0.6, 0.6}, 1, 1);  // what is translucent is blended in this order
  grid_.actor->ForceTranslucentOn();
  setUpSurface(opaque_, 1);
  setUpSurface(shadow_, 0);
  shadow_.actor->ForceTranslucentOn();
  shadow_.actor->GetProperty()->SetLighting(false);
  setUpSurface(doors_, 1);
  setUpLines(door_edges_, {0.07, 0.08, 0.10}, 0.55, 1);
  setUpSurface(door_glass_, 1);
  door_glass_.actor->ForceTranslucentOn();
  setUpSurface(transparent_, 1);
  transparent_.actor->ForceTranslucentOn();
  setUpSurface(graded_, 1);
  setUpSurface(graded_transparent_, 1);
  graded_transparent_.actor->ForceTranslucentOn();
  setUpSurface(shapes_, 1);
  setUpSurface(selected_, -1);
  selected_.actor->ForceTranslucentOn();
  selected_.actor->GetProperty()->SetAmbient(0.5);
  setUpSurface(walkable_, -1);
  walkable_.actor->ForceTranslucentOn();
  walkable_.actor->GetProperty()->SetAmbient(0.8);
  setUpLines(edges_, {0.07, 0.08, 0.10}, 0.55, 1);
  setUpLines(outline_, {0.42, 0.71, 1.0}, 1, 2);
  setUpPoints(cloud_);
  for (Layer* layer : {&opaque_, &shadow_, &transparent_, &graded_, &graded_transparent_, &shapes_, &selected_,
                       &walkable_, &edges_, &outline_, &grid_, &cloud_, &doors_, &door_glass_, &door_edges_})
    layer->hide();
}

void SceneLayers::update(const ViewState& state, const ViewState* last) {
  const bool environment = last == nullptr || last->environment != state.environment;
  const bool shown =
      environment || last->hidden != state.hidden || last->shapes != state.shapes || last->cloud != state.cloud ||
      (last->doors == nullptr) != (state.doors == nullptr);  // a walk goes through the same doors from end to end
  const bool theme = last == nullptr || last->graphics.theme != state.graphics.theme;
  if (environment) bounds_ = state.environment ? standpoint::bounds(*state.environment) : Bounds();
  const bool painted = shown || last->materials != state.materials || last->colour != state.colour ||
                       last->wavelength_nm != state.wavelength_nm || last->deviation != state.deviation;
  if (painted) updateSurfaces(state, !shown);
  if (shown || last->edges != state.edges) updateEdges(state);
  if (painted || last->edges != state.edges || last->doors != state.doors) updateDoors(state);
  if (shown || last->selected != state.selected) updateSelection(state);
  if (last == nullptr || last->collision != state.collision || last->walkable != state.walkable ||
      last->shapes != state.shapes)
    updateCollision(state);
  if (environment || theme || last->grid != state.grid) updateGrid(state);
  if (theme && state.graphics.theme == Theme::light)
    outline_.actor->GetProperty()->SetColor(0.05, 0.36, 0.78);
  else if (theme)
    outline_.actor->GetProperty()->SetColor(0.42, 0.71, 1.0);
  if (last == nullptr || last->cloud != state.cloud) updateCloud(state);
  if (last == nullptr || last->underlays != state.underlays || last->cloud != state.cloud) updateUnderlays(state);
  reach_ = reachOf(state);
  updateCut(state);
}

void SceneLayers::setPixels(int factor) {
  for (Layer* layer : {&edges_, &grid_, &door_edges_})
    layer->actor->GetProperty()->SetLineWidth(static_cast<float>(factor));
  outline_.actor->GetProperty()->SetLineWidth(static_cast<float>(2 * factor));
  cloud_.actor->GetProperty()->SetPointSize(static_cast<float>(2 * factor));
  for (const auto& u : underlays_) u->layer.actor->GetProperty()->SetPointSize(static_cast<float>(2 * factor));
}

void SceneLayers::updateSurfaces(const ViewState& state, bool same_triangles) {
  auto colours = state.environment && !state.shapes && !state.cloud ? mergeColours(state) : std::nullopt;
  const bool repaint = same_triangles && colours && runs_ == colours->runs;
  if (repaint) {
    opaque_.paint(colours->opaque);
    transparent_.paint(colours->transparent);
    return;
  }
  runs_ = colours ? std::move(colours->runs) : std::vector<std::uint32_t>();
  opaque_.hide();
  transparent_.hide();
  graded_.hide();
  graded_transparent_.hide();
  for (const auto& layer : painted_) renderer_->RemoveActor(layer->actor);
  painted_.clear();
  if (!state.environment || state.shapes || state.cloud) return;
  const auto merged = mergeVisible(state);
  opaque_.show(merged.opaque);
  transparent_.show(merged.transparent);
  graded_.show(merged.graded);
  graded_transparent_.show(merged.graded_transparent);
  for (const auto& [key, painted] : merged.painted) {
    painted_.push_back(std::make_unique<Layer>());
    setUpSurface(*painted_.back(), 1);
    painted_.back()->show(painted, textures_.of(state.environment->images[static_cast<std::size_t>(key.first)]));
  }
}

void SceneLayers::updateEdges(const ViewState& state) {
  edges_.hide();
  if (state.environment && state.edges && !state.shapes && !state.cloud)
    edges_.show(edge_cache_.edges(state, nullptr, kMostEdges));
}

void SceneLayers::updateDoors(const ViewState& state) {
  for (Layer* layer : {&doors_, &door_glass_, &door_edges_}) layer->hide();
  if (!state.doors || state.shapes || state.cloud) return;
  const auto doors = stateOfDoors(state);
  const auto merged = mergeVisible(doors);
  doors_.show(merged.opaque);
  door_glass_.show(merged.transparent);
  if (state.edges) door_edges_.show(door_edge_cache_.edges(doors, nullptr, kMostEdges));
}

void SceneLayers::updateSelection(const ViewState& state) {
  selected_.hide();
  outline_.hide();
  if (!state.environment || !state.selected || state.selected->empty()) return;
  selected_.show(mergeProducts(*state.environment, *state.selected, {64, 144, 247, 110}));
  outline_.show(edge_cache_.edges(state, state.selected.get(), kMostEdges));
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
  if (state.cloud) cloud_.show(*state.cloud);
}

// Above what can be turned smoothly each shows every k-th point of its sample.
void SceneLayers::updateUnderlays(const ViewState& state) {
  std::uint64_t points = 0;
  for (const auto& u : state.underlays) points += u.cloud->colours.size();
  const auto step = static_cast<std::size_t>(points / kMostShownPoints + 1);
  while (underlays_.size() < state.underlays.size()) {
    underlays_.push_back(std::make_unique<UnderlayLayer>());
    setUpPoints(underlays_.back()->layer);
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

void SceneLayers::updateCut(const ViewState& state) {
  std::vector<Layer*> layers = {
      &opaque_,  &transparent_, &graded_, &graded_transparent_, &shapes_,    &selected_, &walkable_, &edges_,
      &outline_, &cloud_,       &doors_,  &door_glass_,         &door_edges_};
  for (const auto& u : underlays_) layers.push_back(&u->layer);
  for (const auto& layer : painted_) layers.push_back(layer.get());
  for (Layer* layer : layers) {
    layer->mapper->RemoveAllClippingPlanes();
    if (!state.cut_height_m) continue;
    vtkNew<vtkPlane> plane;
    plane->SetOrigin(0, 0, *state.cut_height_m);
    plane->SetNormal(0, 0, -1);
    layer->mapper->AddClippingPlane(plane);
  }
}

}  // namespace standpoint
