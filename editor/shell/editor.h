// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "editor/labels/label_layout.h"
#include "editor/model/dialog_states.h"
#include "editor/model/model.h"
#include "editor/panels/panel.h"
#include "editor/shell/shot_dialog.h"

namespace standpoint {

// The model with what the shell keeps around it: what is open on the screen, and whom it talks to. Panels never see it.
struct Editor : Model {
  using Model::Model;

  DialogStates dialogs;
  ShotDialog shots;
  PanelStates panels;
  Workspace workspace = Workspace::environment;
  std::optional<Workspace> laid_out;       // in the frame drawn last
  std::array<std::string, 3> wanted_tab;   // by Area: the panel to bring to the front in the next frame
  std::array<std::string, 3> front_tab;    // by Area: the panel that was in front in the frame drawn last
  std::pair<RayHit, std::string> painted;  // where a material was dropped, and its id: a menu asks how far it goes

  SceneView* scene = nullptr;                          // null: the viewport stays empty
  SceneView* scene_beside = nullptr;                   // the original's half
  std::function<void(Editor&)> draw_instrument;        // the emulated device; empty: this build has none
  std::function<void(const Eigen::Vector3d&)> on_way;  // the tool Tool::layWay clicked there, in the file's frame
  std::vector<Eigen::Vector3d> way;                    // to be drawn, in the file's frame
  std::function<void(const std::string&)> on_title;
  // The pointer is on the device, or a finger was there last and the pointer is not on the view: what is typed is not
  // meant for the view.
  bool device_has_keys = false;
  bool device_drawn = false;  // in the frame drawn last: what moves on it moves only then
  bool fine_picture = false;  // the view stands still: smooth edges
  bool costs_wanted = false;  // of the levels of graphics: somebody reads them
  bool quit = false;          // confirmed

  LabelLayout label_layout;               // of the view
  std::optional<LabelOf> pointed_label;   // one that acts as a button, under the pointer in the frame drawn last
  Eigen::Vector2f overlay_size = {0, 0};  // of the controls over the viewport, as drawn last
  // Where they must end on the right, on the screen; and the lower left corner of the navigation cube, beside which all
  // rows from `beside_cube` on are.
  float overlay_end = 0, beside_cube = 0;
  Eigen::Vector2f cube_corner = {0, 0};
  // Of the words over the view, and of the legend of points at its lower left from its edges, as drawn last.
  Eigen::Vector2f banners_size = {0, 0}, legend_size = {0, 0};
};

}  // namespace standpoint
