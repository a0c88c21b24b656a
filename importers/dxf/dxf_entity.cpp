// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/dxf/dxf_entity.h"

#include <cmath>
#include <system_error>

#include <fast_float/fast_float.h>

#include "importers/files/text_pieces.h"

namespace standpoint {

namespace {

constexpr int kFirstOfXData = 1000;
// Longer ones break the format's own limits and are cut, since names are there once for each block that is placed.
constexpr std::size_t kLongestText = 2048, kLongestName = 512, kLongestHandle = 16;

bool isNumber(int code) {
  return (code >= 10 && code <= 79 && code != 48) || (code >= 90 && code <= 95) || code == 210 || code == 220 ||
         code == 230 || code == 140 || code == 420 || code == 440;
}

}  // namespace

void DxfEntity::begin(std::string_view new_kind, std::size_t new_line) {
  kind = new_kind;
  line = new_line;
  for (auto* words : {&name, &text, &handle, &layer, &material}) words->clear();
  for (const auto code : touched_) stated_[code] = false;
  touched_.clear();
  points.clear(), bulges.clear(), widths.clear(), face_corners.clear(), face_ends.clear(), face_lines.clear();
  in_application_ = closed_ = has_file = false;
  list_left_ = 0;
  corners_left_ = 0;
}

Result<void> DxfEntity::take(const DxfGroup& group, const DxfGroups& groups) {
  if (group.code == 101) closed_ = true;
  if (group.code == 102) in_application_ = group.value.starts_with('{');
  if (closed_ || in_application_ || group.code >= kFirstOfXData) return {};
  switch (group.code) {
    case 1: text = group.value.substr(0, kLongestText); return {};
    case 2: name = group.value.substr(0, kLongestName); return {};
    case 3: has_file = has_file || !group.value.empty(); return {};
    case 5: handle = group.value.substr(0, kLongestHandle); return {};
    case 8: layer = group.value.substr(0, kLongestName); return {};
    case 347: material = group.value.substr(0, kLongestHandle); return {};
    default: break;
  }
  if (!isNumber(group.code)) return {};
  double value = 0;
  const char* end = group.value.data() + group.value.size();
  const bool plus = group.value.starts_with('+');
  const auto [after, error] = fast_float::from_chars(group.value.data() + (plus ? 1 : 0), end, value);
  if (error == std::errc::invalid_argument || after != end)
    return groups.fault(group.line, inQuotes(group.value) + " is not a number");
  if (!(std::abs(value) <= kLargestInDxf)) return groups.fault(group.line, "a number is not finite and below 1e13");
  if (kind == "LWPOLYLINE" || kind == "MESH") takePoint(group.code, value);
  if (kind == "MESH" && (group.code == 90 || group.code == 93 || group.code == 94))
    return takeFaceItem(value, group, groups);
  const auto slot = static_cast<std::size_t>(group.code);
  if (stated_[slot]) return {};  // a MESH ends in groups of the same codes that mean something else
  touched_.push_back(slot);
  stated_[slot] = true;
  numbers_[slot] = value;
  return {};
}

void DxfEntity::takePoint(int code, double value) {
  if (code == 10) points.emplace_back(value, 0, 0), bulges.push_back(0), widths.push_back({0, 0});
  if (points.empty()) return;
  if (code == 20) points.back().y() = value;
  if (code == 30) points.back().z() = value;
  if (code == 40 || code == 41) widths.back()[code == 40 ? 0 : 1] = value;
  if (code == 42) bulges.back() = value;
}

// The list is a count of corners and their indices, face after face; 94 begins the list of edges, of the same code.
Result<void> DxfEntity::takeFaceItem(double value, const DxfGroup& group, const DxfGroups& groups) {
  if (group.code == 93) list_left_ = value;
  if (group.code != 90 || list_left_ <= 0) return {};
  --list_left_;
  if (corners_left_ == 0) {
    if (!(value >= 0 && value <= list_left_))
      return groups.fault(group.line, "a face has more corners than its list has items");
    corners_left_ = static_cast<std::uint32_t>(value);
  } else {
    if (!(value >= 0 && value < static_cast<double>(points.size())))
      return groups.fault(group.line, "refers to vertex " + std::string(group.value.substr(0, 30)) + "; there are " +
                                          std::to_string(points.size()));
    face_corners.push_back(static_cast<std::uint32_t>(value));
    --corners_left_;
  }
  if (corners_left_ == 0) face_ends.push_back(face_corners.size()), face_lines.push_back(group.line);
  return {};
}

Eigen::Matrix3d worldFromObject(const Eigen::Vector3d& normal) {
  constexpr double kNearly = 1.0 / 64;
  const double length = normal.norm();
  if (!(length > 0)) return Eigen::Matrix3d::Identity();
  const Eigen::Vector3d z = normal / length;
  const bool along_z = std::abs(z.x()) < kNearly && std::abs(z.y()) < kNearly;
  const Eigen::Vector3d x = (along_z ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitZ()).cross(z).normalized();
  Eigen::Matrix3d axes;
  axes << x, z.cross(x), z;
  return axes;
}

}  // namespace standpoint
