// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/gltf/gltf_primitive.h"

#include <algorithm>
#include <cstring>
#include <numeric>

namespace standpoint {

namespace {

// glTF 2.0 §3.7.2.1: strip triangle i is (i, i + 1 + i mod 2, i + 2 − i mod 2), fan triangle (i + 1, i + 2, 0).
std::vector<Triangle> trianglesOf(std::size_t mode, const std::vector<std::uint32_t>& order) {
  const std::size_t n = order.size();
  std::vector<Triangle> out;
  if (mode == GltfPrimitive::kTriangles) {
    out.resize(n / 3);
    if (!out.empty()) std::memcpy(out.data(), order.data(), out.size() * sizeof(Triangle));
    return out;
  }
  for (std::size_t i = 0; i + 3 <= n; ++i)
    out.push_back(mode == GltfPrimitive::kStrip ? Triangle{order[i], order[i + 1 + i % 2], order[i + 2 - i % 2]}
                                                : Triangle{order[i + 1], order[i + 2], order[0]});
  return out;
}

}  // namespace

GltfPrimitive::GltfPrimitive(GltfFile& file, const tinygltf::Primitive& primitive, std::string place)
    : file_(file), gltf_(primitive), place_(std::move(place)), mode_(static_cast<std::size_t>(primitive.mode)) {
  if (mode_ > kFan) file_.fail(place_ + "/mode", "is " + std::to_string(mode_) + "; valid modes are 0 to 6");
  // The specification lets a client skip such a primitive; a surface without a place cannot be scanned.
  if (!accessor("POSITION")) file_.fail(place_ + "/attributes", "has no POSITION: nothing to scan");
  const auto draco = gltfExtension(gltf_, "KHR_draco_mesh_compression");
  if (!file_.failed() && isSurface() && draco.is_object())
    draco_ = decodeDraco(file_, draco, gltf_.attributes, place_ + "/extensions/KHR_draco_mesh_compression");
}

std::string GltfPrimitive::whatItIs() {
  const auto indices = gltfIndex(gltf_.indices);
  const auto counted = indices ? indices : accessor("POSITION");
  const std::size_t n = counted ? file_.countOf(*counted, place_) : 0;
  switch (mode_) {
    case kPoints: return std::to_string(n) + " points";
    case kLines: return std::to_string(n / 2) + " lines";
    case kLineLoop: return "a loop of " + std::to_string(n) + " lines";
    default: return "a strip of " + std::to_string(n > 0 ? n - 1 : 0) + " lines";
  }
}

std::optional<std::size_t> GltfPrimitive::accessor(const std::string& attribute) const {
  const auto found = gltf_.attributes.find(attribute);
  return found == gltf_.attributes.end() ? std::nullopt : gltfIndex(found->second);
}

std::vector<Eigen::Vector3f> GltfPrimitive::positions() {
  const std::string where = place_ + "/attributes/POSITION";
  if (!draco_) return file_.vectors3(accessor("POSITION").value_or(0), where);
  const auto& column = draco_->columns["POSITION"];
  std::vector<Eigen::Vector3f> result(column.values.size() / 3);
  if (column.components != 3) file_.fail(where, "is not in the compressed data");
  for (std::size_t i = 0; !file_.failed() && i < result.size(); ++i) {
    result[i] = {column.values[3 * i], column.values[3 * i + 1], column.values[3 * i + 2]};
    if (!result[i].allFinite()) file_.fail(where, "position " + std::to_string(i) + " is not a finite number");
  }
  return file_.failed() ? std::vector<Eigen::Vector3f>{} : result;
}

std::vector<float> GltfPrimitive::floats(const std::string& attribute, std::size_t& components) {
  const std::string where = place_ + "/attributes/" + attribute;
  if (draco_)
    if (const auto found = draco_->columns.find(attribute); found != draco_->columns.end()) {
      components = found->second.components;
      return std::move(found->second.values);
    }
  const auto index = accessor(attribute);
  if (!index) return {};
  components = file_.componentsOf(*index, where);
  return file_.floats(*index, components, where);
}

std::vector<std::uint32_t> GltfPrimitive::order(std::size_t vertices) {
  if (const auto indices = gltfIndex(gltf_.indices)) return file_.indices(*indices, place_ + "/indices");
  if (!file_.spend(vertices * 16, place_)) return {};
  std::vector<std::uint32_t> all(vertices);
  std::iota(all.begin(), all.end(), 0U);
  return all;
}

std::vector<Triangle> GltfPrimitive::triangles(std::size_t vertices, Report& report) {
  if (draco_) return std::move(draco_->triangles);  // Draco's own indices are below its own vertices
  const auto corners = order(vertices);
  const auto largest = std::max_element(corners.begin(), corners.end());
  if (largest != corners.end() && *largest >= vertices)
    file_.fail(place_ + "/indices", "index " + std::to_string(largest - corners.begin()) + " is " +
                                        std::to_string(*largest) + ", but there are " + std::to_string(vertices) +
                                        " vertices");
  if (file_.failed()) return {};
  if (mode_ == kTriangles && corners.size() % 3 != 0)
    report.warn(place_, std::to_string(corners.size()) + " indices are not a multiple of 3; the remainder was skipped");
  if (!file_.spend(mode_ == kTriangles ? 0 : corners.size() * sizeof(Triangle), place_)) return {};
  return trianglesOf(mode_, corners);
}

}  // namespace standpoint
