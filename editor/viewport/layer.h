// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkSmartPointer.h>
#include <vtkTexture.h>

#include "core/mesh.h"
#include "editor/model/cloud.h"
#include "editor/model/graphics.h"
#include "editor/viewport/merged_scene.h"

namespace standpoint {

// One drawn thing: an actor whose geometry is replaced when it changes.
struct Layer {
  vtkNew<vtkPolyDataMapper> mapper;
  vtkNew<vtkActor> actor;

  void show(const MergedTriangles& triangles);
  void show(const PaintedTriangles& painted, vtkTexture* texture);
  void show(const MergedLines& lines);
  void show(const Cloud& cloud, std::size_t step = 1);  // every `step`-th point
  void set(vtkPolyData* data, bool empty);
  // The same triangles in other colours: their places stay where the graphics card has them.
  void paint(const std::vector<Rgba>& colours);
  void hide() { actor->SetVisibility(0); }
};

// Squares of 1 m and, where the model is large, of 10 m; they fade towards the rim.
vtkSmartPointer<vtkPolyData> groundGrid(const Bounds& bounds, Theme theme);
double groundHeight_m(const Bounds& bounds);  // where it lies

}  // namespace standpoint
