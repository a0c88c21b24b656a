// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "importers/dxf/dxf_drawing.h"
#include "importers/dxf/dxf_groups.h"

namespace standpoint {

constexpr double kLargestInDxf = 1e13;

// What the groups of one entity say, of those that faces, their looks and their places come from.
class DxfEntity {
 public:
  void begin(std::string_view kind, std::size_t line);
  // Refused where a number is none, or not below 1e13.
  Result<void> take(const DxfGroup& group, const DxfGroups& groups);

  std::string kind, name, text, handle, layer, material;  // material: the handle of one
  bool has_file = false;                                  // an image's, of group 3
  std::size_t line = 0;

  bool has(int code) const { return stated_[static_cast<std::size_t>(code)]; }
  double number(int code, double otherwise = 0) const {
    return has(code) ? numbers_[static_cast<std::size_t>(code)] : otherwise;
  }
  int flags() const { return static_cast<int>(number(70)); }
  // Of the groups `first`, `first` + 10 and `first` + 20.
  Eigen::Vector3d point(int first) const { return {number(first), number(first + 10), number(first + 20)}; }
  // Of the plane that it is drawn in.
  Eigen::Vector3d normal() const { return {number(210), number(220), number(230, has(210) ? 0 : 1)}; }
  std::string id() const { return handle.empty() ? "line " + std::to_string(line) : "#" + handle; }

  // Of LWPOLYLINE and MESH, which have any number of them.
  std::vector<Eigen::Vector3d> points;
  std::vector<double> bulges;                      // LWPOLYLINE, of the piece that begins there
  std::vector<std::array<double, 2>> widths;       // likewise, where it begins and ends
  std::vector<std::uint32_t> face_corners;         // MESH: indices of points, in range
  std::vector<std::size_t> face_ends, face_lines;  // into face_corners
  bool facesAreWhole() const { return corners_left_ == 0 && list_left_ <= 0; }

 private:
  static constexpr std::size_t kCodes = 448;

  void takePoint(int code, double value);
  Result<void> takeFaceItem(double value, const DxfGroup& group, const DxfGroups& groups);

  std::array<double, kCodes> numbers_{};
  std::array<bool, kCodes> stated_{};
  std::vector<std::size_t> touched_;
  bool in_application_ = false, closed_ = false;  // within 102 { }; past an embedded object
  double list_left_ = 0;                          // of the items that a MESH says its list of faces has
  std::uint32_t corners_left_ = 0;                // of the face that is being read
};

// By the arbitrary axis algorithm of the DXF reference.
Eigen::Matrix3d worldFromObject(const Eigen::Vector3d& normal);

}  // namespace standpoint
