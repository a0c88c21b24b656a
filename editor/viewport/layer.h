// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <vector>

#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkSmartPointer.h>
#include <vtkTexture.h>

#include "core/mesh.h"
#include "editor/inspect/clip_box.h"
#include "editor/model/graphics.h"
#include "editor/viewport/merged_scene.h"

namespace standpoint {

constexpr int kLights = 3;  // of a scene, all of them distant

// One drawn thing: an actor whose geometry is replaced when it changes.
struct Layer {
  vtkNew<vtkPolyDataMapper> mapper;
  vtkNew<vtkActor> actor;
  bool filled = false;    // there is something to be drawn
  bool revealed = false;  // and it is to be drawn
  bool spared = false;    // but not in this picture
  std::vector<ClipPlane> cut_by;
  std::optional<bool> lit;

  // How it is drawn, to be said once. Flat surfaces in the colours of their triangles; what has a smaller `offset` lies
  // before what coincides with it.
  void drawSurface(double offset);
  void drawLines(std::array<double, 3> colour, double opacity, double width);
  void light(bool wanted);

  void show(const MergedTriangles& triangles);
  void show(const PaintedTriangles& painted, vtkTexture* texture);
  void show(const MergedLines& lines);
  void set(vtkPolyData* data, bool empty);
  // The same triangles in other colours: their places stay where the graphics card has them.
  void paint(const std::vector<Rgba>& colours);
  // What of it lies beyond one of at most six planes is not drawn. Each change of a mapper's planes makes its buffers
  // anew.
  void cut(const std::vector<ClipPlane>& kept);
  void reveal(bool shown) {
    revealed = shown;
    actor->SetVisibility(revealed && filled && !spared ? 1 : 0);
  }
  void hide() { reveal(false); }
  void spare(bool in_this_picture) {
    spared = in_this_picture;
    reveal(revealed);
  }
};

// Squares of 1 m and, where the model is large, of 10 m; they fade towards the rim.
vtkSmartPointer<vtkPolyData> groundGrid(const Bounds& bounds, Theme theme);
double groundHeight_m(const Bounds& bounds);  // where it lies

}  // namespace standpoint
