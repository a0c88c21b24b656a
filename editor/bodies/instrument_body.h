// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "editor/bodies/body_mesh.h"

namespace standpoint {

// What a tripod's head carries the instrument with.
enum class Mount { tribrach, quick_clamp };

// How an instrument looks: our own low-polygon shape after its silhouette and outer sizes, without logos. Its frame is
// the scanner's own: the origin where the beam leaves, Z up, X where the first column looks; metres. What turns with
// the head is as it stands before a scan.
struct InstrumentBody {
  std::string_view id;  // "leica-rtc360"
  Mount mount = Mount::quick_clamp;
  bool heavy_tripod = false;
  double foot_m = 0.1;     // of the beam's origin above the foot
  int fans = 2;            // half planes that the beam sweeps at once: 2 turn half around, 1 all
  double mirror_m = 0.03;  // radius of the mirror
  bool key_ring = false;   // its light is a ring of segments around its key
  Eigen::Vector3d lamp_m = Eigen::Vector3d::Zero();  // of the light, and which way it faces
  Eigen::Vector3d lamp_faces = Eigen::Vector3d::UnitX();
  // Of the display, else of the key: what one looks at to work with it.
  Eigen::Vector3d face_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d face_faces = Eigen::Vector3d::UnitX();
  Eigen::Vector2d display_m = Eigen::Vector2d::Zero();  // its width and height; zero: there is none
  BodyColour shell = {200, 202, 205}, trim = {70, 72, 76};
  BodyMesh foot;    // stands still
  BodyMesh head;    // turns about Z
  BodyMesh mirror;  // in the head: too fast to be seen while it measures
};

// One for each emulated device and model that looks different; the last is for any other.
std::span<const InstrumentBody> instrumentBodies();
// Of an instrument's id, such as "faro-focus-s350"; never null.
const InstrumentBody& bodyOf(std::string_view instrument);

BodyColour colourOf(const InstrumentBody& body, BodyPaint paint);

}  // namespace standpoint
