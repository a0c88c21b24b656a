// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstring>

#include <meshoptimizer.h>

#include "importers/gltf/gltf_file.h"

namespace standpoint {

namespace {

enum : std::size_t {
  kByte = 5120,
  kUnsignedByte = 5121,
  kShort = 5122,
  kUnsignedShort = 5123,
  kUnsignedInt = 5125,
  kFloat = 5126
};

std::size_t componentSize(std::size_t type) {
  switch (type) {
    case kByte:
    case kUnsignedByte: return 1;
    case kShort:
    case kUnsignedShort: return 2;
    case kUnsignedInt:
    case kFloat: return 4;
    default: return 0;
  }
}

std::size_t componentsOfType(const std::string& type) {
  if (type == "SCALAR") return 1;
  if (type == "VEC2") return 2;
  if (type == "VEC3") return 3;
  if (type == "VEC4") return 4;
  if (type == "MAT4") return 16;  // the only matrices that we need, of floats, so without padding
  return 0;
}

template <class T>
T at(const std::uint8_t* bytes, std::size_t index) {
  T value;
  std::memcpy(&value, bytes + index * sizeof(T), sizeof(T));
  return value;
}

std::uint32_t wholeNumber(std::size_t type, const std::uint8_t* bytes, std::size_t i) {
  if (type == kUnsignedByte) return bytes[i];
  if (type == kUnsignedShort) return at<std::uint16_t>(bytes, i);
  return at<std::uint32_t>(bytes, i);
}

// glTF 2.0 §3.6.2.2: c / 127, c / 255, …, signed ones clamped at −1.
float number(std::size_t type, bool normalized, const std::uint8_t* bytes, std::size_t i) {
  const auto scaled = [&](double c, double largest) {
    return static_cast<float>(normalized ? std::max(c / largest, -1.0) : c);
  };
  switch (type) {
    case kByte: return scaled(at<std::int8_t>(bytes, i), 127);
    case kUnsignedByte: return scaled(bytes[i], 255);
    case kShort: return scaled(at<std::int16_t>(bytes, i), 32767);
    case kUnsignedShort: return scaled(at<std::uint16_t>(bytes, i), 65535);
    case kUnsignedInt: return static_cast<float>(at<std::uint32_t>(bytes, i));
    default: return at<float>(bytes, i);
  }
}

}  // namespace

std::span<const std::uint8_t> GltfFile::slice(const nlohmann::json& object, const std::string& place) {
  const auto buffer = index(object, "buffer", place);
  if (failed() || !buffer || *buffer >= buffers_.size()) {
    fail(place + "/buffer", "does not name a buffer");
    return {};
  }
  const auto offset = natural(object, "byteOffset", 0, place);
  const auto length = natural(object, "byteLength", 0, place);
  const auto& bytes = buffers_[*buffer];
  if (offset > bytes.size() || length > bytes.size() - offset) {
    fail(place, "extends to byte " + std::to_string(offset + length) + " of /buffers/" + std::to_string(*buffer) +
                    ", which has " + std::to_string(bytes.size()));
    return {};
  }
  return std::span(bytes).subspan(offset, length);
}

std::span<const std::uint8_t> GltfFile::view(std::size_t buffer_view, const std::string& asked_by) {
  const std::string place = "/bufferViews/" + std::to_string(buffer_view);
  const auto& json = element("bufferViews", buffer_view, asked_by);
  if (failed()) return {};
  const auto& extensions = memberOf(json, "extensions");
  const bool khronos =
      memberOf(extensions, "KHR_meshopt_compression").is_object();  // the same for what 0.18 can decode
  const char* name = khronos ? "KHR_meshopt_compression" : "EXT_meshopt_compression";
  const auto& meshopt = memberOf(extensions, name);
  if (!meshopt.is_object()) return slice(json, place);
  if (!decoded_views_.contains(buffer_view)) decodeMeshopt(buffer_view, meshopt, place + "/extensions/" + name);
  return failed() ? std::span<const std::uint8_t>{} : std::span<const std::uint8_t>(decoded_views_[buffer_view]);
}

void GltfFile::decodeMeshopt(std::size_t buffer_view, const nlohmann::json& extension, const std::string& place) {
  const auto packed_bytes = slice(extension, place);
  const auto count = natural(extension, "count", 0, place);
  const auto stride = natural(extension, "byteStride", 0, place);
  const std::string mode = text(extension, "mode");
  const std::string filter = text(extension, "filter");
  if (failed()) return;
  // The preconditions that meshoptimizer asserts.
  const bool attributes = mode == "ATTRIBUTES" && stride > 0 && stride <= 256 && stride % 4 == 0;
  const bool triangles = mode == "TRIANGLES" && (stride == 2 || stride == 4) && count % 3 == 0;
  const bool sequence = mode == "INDICES" && (stride == 2 || stride == 4);
  if (!attributes && !triangles && !sequence) return fail(place, "mode, byteStride and count are inconsistent");
  if (!spend(count * stride, place)) return;

  std::vector<std::uint8_t> out(count * stride);
  int wrong = 0;
  if (attributes)
    wrong = meshopt_decodeVertexBuffer(out.data(), count, stride, packed_bytes.data(), packed_bytes.size());
  if (triangles) wrong = meshopt_decodeIndexBuffer(out.data(), count, stride, packed_bytes.data(), packed_bytes.size());
  if (sequence)
    wrong = meshopt_decodeIndexSequence(out.data(), count, stride, packed_bytes.data(), packed_bytes.size());
  if (wrong != 0) return fail(place, "the compressed data is damaged (meshoptimizer: " + std::to_string(wrong) + ")");
  if (filter == "EXPONENTIAL" && attributes)
    meshopt_decodeFilterExp(out.data(), count, stride);
  else if (filter == "OCTAHEDRAL" && attributes && (stride == 4 || stride == 8))
    meshopt_decodeFilterOct(out.data(), count, stride);
  else if (filter == "QUATERNION" && attributes && stride == 8)
    meshopt_decodeFilterQuat(out.data(), count, stride);
  else if (!filter.empty() && filter != "NONE")
    return fail(place + "/filter", "'" + filter + "' does not match the data");
  decoded_views_[buffer_view] = std::move(out);
}

GltfFile::Packed GltfFile::packed(std::size_t accessor, const std::string& asked_by) {
  const std::string place = "/accessors/" + std::to_string(accessor);
  const auto& json = element("accessors", accessor, asked_by);
  Packed out;
  out.component_type = natural(json, "componentType", 0, place);
  out.components = componentsOfType(text(json, "type"));
  out.count = natural(json, "count", 0, place);
  const auto& normalized = memberOf(json, "normalized");
  out.normalized = normalized.is_boolean() && normalized.get<bool>();
  const std::size_t size = componentSize(out.component_type) * out.components;
  if (size == 0) fail(place, "componentType or type is not allowed for geometry");
  if (failed()) return {};
  takeDense(json, place, size, out);
  const auto& sparse = memberOf(json, "sparse");
  if (!failed() && !sparse.is_null()) applySparse(sparse, place + "/sparse", size, out);
  return failed() ? Packed{} : std::move(out);
}

void GltfFile::takeDense(const nlohmann::json& json, const std::string& place, std::size_t size, Packed& out) {
  const auto buffer_view = index(json, "bufferView", place);
  if (failed()) return;
  if (!buffer_view) {  // zeros, says the specification
    if (spend(out.count * size, place)) out.own.resize(out.count * size);
    out.bytes = out.own;
    return;
  }
  const auto bytes = view(*buffer_view, place);
  if (failed()) return;
  const auto& view_json = element("bufferViews", *buffer_view, place);
  const auto stride = natural(view_json, "byteStride", size, "/bufferViews/" + std::to_string(*buffer_view));
  const auto offset = natural(json, "byteOffset", 0, place);
  if (stride < size) return fail(place, "buffer view stride is smaller than an element");
  if (out.count == 0 || failed()) return;
  if (offset > bytes.size() || (out.count - 1) * stride + size > bytes.size() - offset)
    return fail(place, "needs " + std::to_string(offset + (out.count - 1) * stride + size) + " bytes of /bufferViews/" +
                           std::to_string(*buffer_view) + ", which has " + std::to_string(bytes.size()));
  out.bytes = bytes.subspan(offset, stride == size ? out.count * size : bytes.size() - offset);
  if (stride == size || !spend(out.count * size, place)) return;
  out.own.resize(out.count * size);
  for (std::size_t i = 0; i < out.count; ++i) std::memcpy(&out.own[i * size], &out.bytes[i * stride], size);
  out.bytes = out.own;
}

void GltfFile::applySparse(const nlohmann::json& sparse, const std::string& place, std::size_t size, Packed& out) {
  const auto count = natural(sparse, "count", 0, place);
  const auto& where = memberOf(sparse, "indices");
  const auto& what = memberOf(sparse, "values");
  const auto where_view = index(where, "bufferView", place + "/indices");
  const auto what_view = index(what, "bufferView", place + "/values");
  const auto type = natural(where, "componentType", 0, place + "/indices");
  const auto where_offset = natural(where, "byteOffset", 0, place + "/indices");
  const auto what_offset = natural(what, "byteOffset", 0, place + "/values");
  if (!where_view || !what_view) fail(place, "has no indices or no values");
  if (type != kUnsignedByte && type != kUnsignedShort && type != kUnsignedInt)
    fail(place + "/indices/componentType", "is not an unsigned integer type");
  if (failed()) return;
  const auto places = view(*where_view, place + "/indices");
  const auto values = view(*what_view, place + "/values");
  if (failed()) return;
  if (where_offset > places.size() || count * componentSize(type) > places.size() - where_offset)
    return fail(place + "/indices", "extends beyond its buffer view");
  if (what_offset > values.size() || count * size > values.size() - what_offset)
    return fail(place + "/values", "extends beyond its buffer view");
  if (out.own.empty() && spend(out.bytes.size(), place)) out.own.assign(out.bytes.begin(), out.bytes.end());
  out.bytes = out.own;
  for (std::size_t i = 0; i < count && !failed(); ++i) {
    const auto target = wholeNumber(type, places.data() + where_offset, i);
    if (target >= out.count) return fail(place + "/indices", "element " + std::to_string(i) + " is out of range");
    std::memcpy(&out.own[target * size], &values[what_offset + i * size], size);
  }
}

std::size_t GltfFile::countOf(std::size_t accessor, const std::string& asked_by) {
  return natural(element("accessors", accessor, asked_by), "count", 0, "/accessors/" + std::to_string(accessor));
}

std::size_t GltfFile::componentsOf(std::size_t accessor, const std::string& asked_by) {
  return componentsOfType(text(element("accessors", accessor, asked_by), "type"));
}

std::vector<float> GltfFile::floats(std::size_t accessor, std::size_t components, const std::string& asked_by) {
  const auto in = packed(accessor, asked_by);
  if (!failed() && in.components != components)
    fail("/accessors/" + std::to_string(accessor) + "/type", "is not what " + asked_by + " needs");
  if (failed() || !spend(in.count * components * sizeof(float), asked_by)) return {};
  std::vector<float> out(in.count * components);
  if (in.component_type == kFloat) {
    if (!out.empty()) std::memcpy(out.data(), in.bytes.data(), out.size() * sizeof(float));
  } else {
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = number(in.component_type, in.normalized, in.bytes.data(), i);
  }
  return out;
}

std::vector<Eigen::Vector3f> GltfFile::vectors3(std::size_t accessor, const std::string& asked_by) {
  const auto in = packed(accessor, asked_by);
  if (!failed() && in.components != 3)
    fail("/accessors/" + std::to_string(accessor) + "/type", "is not what " + asked_by + " needs");
  if (failed() || !spend(in.count * sizeof(Eigen::Vector3f), asked_by)) return {};
  std::vector<Eigen::Vector3f> out(in.count);
  if (in.component_type == kFloat && !out.empty())
    std::memcpy(out.data()->data(), in.bytes.data(), out.size() * sizeof(Eigen::Vector3f));
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (in.component_type != kFloat)
      for (std::size_t k = 0; k < 3; ++k)
        out[i][static_cast<Eigen::Index>(k)] = number(in.component_type, in.normalized, in.bytes.data(), 3 * i + k);
    if (!out[i].allFinite()) {
      fail("/accessors/" + std::to_string(accessor), "element " + std::to_string(i) + " is not a finite number");
      return {};
    }
  }
  return out;
}

std::vector<std::uint32_t> GltfFile::indices(std::size_t accessor, const std::string& asked_by) {
  const auto in = packed(accessor, asked_by);
  const bool right = in.components == 1 && (in.component_type == kUnsignedByte || in.component_type == kUnsignedShort ||
                                            in.component_type == kUnsignedInt);
  if (!failed() && !right)
    fail("/accessors/" + std::to_string(accessor), "is not an unsigned integer type, as required for indices");
  if (failed() || !spend(in.count * sizeof(std::uint32_t), asked_by)) return {};
  std::vector<std::uint32_t> out(in.count);
  if (in.component_type == kUnsignedInt) {
    if (!out.empty()) std::memcpy(out.data(), in.bytes.data(), out.size() * sizeof(std::uint32_t));
  } else {
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = wholeNumber(in.component_type, in.bytes.data(), i);
  }
  return out;
}

}  // namespace standpoint
