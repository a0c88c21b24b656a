// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstring>

#include <meshoptimizer.h>

#include "importers/gltf/gltf_file.h"

namespace standpoint {

namespace {

enum {
  kByte = TINYGLTF_COMPONENT_TYPE_BYTE,
  kUnsignedByte = TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE,
  kShort = TINYGLTF_COMPONENT_TYPE_SHORT,
  kUnsignedShort = TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT,
  kUnsignedInt = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
  kFloat = TINYGLTF_COMPONENT_TYPE_FLOAT
};

// 0 for one that geometry cannot have.
std::size_t componentSize(int type) {
  const bool known = type != TINYGLTF_COMPONENT_TYPE_INT && type != TINYGLTF_COMPONENT_TYPE_DOUBLE;
  const auto size = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(type));
  return known && size > 0 ? static_cast<std::size_t>(size) : 0;
}

std::size_t componentsOfType(int type) {
  if (type == TINYGLTF_TYPE_MAT2 || type == TINYGLTF_TYPE_MAT3) return 0;  // MAT4 is of floats, so without padding
  const auto count = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type));
  return count > 0 ? static_cast<std::size_t>(count) : 0;
}

template <class T>
T at(const std::uint8_t* bytes, std::size_t index) {
  T value;
  std::memcpy(&value, bytes + index * sizeof(T), sizeof(T));
  return value;
}

std::uint32_t indexAt(int type, const std::uint8_t* bytes, std::size_t i) {
  if (type == kUnsignedByte) return bytes[i];
  if (type == kUnsignedShort) return at<std::uint16_t>(bytes, i);
  return at<std::uint32_t>(bytes, i);
}

// glTF 2.0 §3.6.2.2: c / 127, c / 255, …, signed ones clamped at −1.
float number(int type, bool normalized, const std::uint8_t* bytes, std::size_t i) {
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

std::span<const std::uint8_t> GltfFile::slice(std::optional<std::size_t> buffer, std::size_t offset, std::size_t length,
                                              const std::string& place) {
  if (failed() || !buffer || *buffer >= buffers_.size()) {
    fail(place + "/buffer", "does not name a buffer");
    return {};
  }
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
  const auto& packed = element(model_.bufferViews, "bufferViews", buffer_view, asked_by);
  if (failed()) return {};
  const auto extensions = gltfExtensions(packed);
  const bool khronos =
      memberOf(extensions, "KHR_meshopt_compression").is_object();  // the same for what 0.18 can decode
  const char* name = khronos ? "KHR_meshopt_compression" : "EXT_meshopt_compression";
  const auto& meshopt = memberOf(extensions, name);
  if (!meshopt.is_object()) return slice(gltfIndex(packed.buffer), packed.byteOffset, packed.byteLength, place);
  if (!decoded_views_.contains(buffer_view)) decodeMeshopt(buffer_view, meshopt, place + "/extensions/" + name);
  return failed() ? std::span<const std::uint8_t>{} : std::span<const std::uint8_t>(decoded_views_[buffer_view]);
}

void GltfFile::decodeMeshopt(std::size_t buffer_view, const nlohmann::json& extension, const std::string& place) {
  const auto packed_bytes = slice(index(extension, "buffer", place), natural(extension, "byteOffset", 0, place),
                                  natural(extension, "byteLength", 0, place), place);
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
  const auto& found = element(model_.accessors, "accessors", accessor, asked_by);
  if (failed()) return {};
  Packed out;
  out.component_type = found.componentType;
  out.components = componentsOfType(found.type);
  out.count = found.count;
  out.normalized = found.normalized;
  const std::size_t size = componentSize(out.component_type) * out.components;
  if (size == 0) fail(place, "componentType or type is not allowed for geometry");
  if (failed()) return {};
  takeDense(found, place, size, out);
  if (!failed() && found.sparse.isSparse) applySparse(found, place + "/sparse", size, out);
  return failed() ? Packed{} : std::move(out);
}

void GltfFile::takeDense(const tinygltf::Accessor& accessor, const std::string& place, std::size_t size, Packed& out) {
  const auto buffer_view = gltfIndex(accessor.bufferView);
  if (!buffer_view) {  // zeros, says the specification
    if (spend(out.count * size, place)) out.own.resize(out.count * size);
    out.bytes = out.own;
    return;
  }
  const auto bytes = view(*buffer_view, place);
  if (failed()) return;
  const auto stated = model_.bufferViews[*buffer_view].byteStride;
  const auto stride = stated == 0 ? size : stated;
  const auto offset = accessor.byteOffset;
  if (stride < size) return fail(place, "buffer view stride is smaller than an element");
  if (out.count == 0) return;
  if (offset > bytes.size() || (out.count - 1) * stride + size > bytes.size() - offset)
    return fail(place, "needs " + std::to_string(offset + (out.count - 1) * stride + size) + " bytes of /bufferViews/" +
                           std::to_string(*buffer_view) + ", which has " + std::to_string(bytes.size()));
  out.bytes = bytes.subspan(offset, stride == size ? out.count * size : bytes.size() - offset);
  if (stride == size || !spend(out.count * size, place)) return;
  out.own.resize(out.count * size);
  for (std::size_t i = 0; i < out.count; ++i) std::memcpy(&out.own[i * size], &out.bytes[i * stride], size);
  out.bytes = out.own;
}

void GltfFile::applySparse(const tinygltf::Accessor& accessor, const std::string& place, std::size_t size,
                           Packed& out) {
  const auto& where = accessor.sparse.indices;
  const auto& what = accessor.sparse.values;
  const auto count = static_cast<std::size_t>(accessor.sparse.count);
  const auto where_offset = static_cast<std::size_t>(where.byteOffset);
  const auto what_offset = static_cast<std::size_t>(what.byteOffset);
  const int type = where.componentType;
  if (type != kUnsignedByte && type != kUnsignedShort && type != kUnsignedInt)
    fail(place + "/indices/componentType", "is not an unsigned integer type");
  if (failed()) return;
  const auto places = view(static_cast<std::size_t>(where.bufferView), place + "/indices");
  const auto values = view(static_cast<std::size_t>(what.bufferView), place + "/values");
  if (failed()) return;
  if (where_offset > places.size() || count * componentSize(type) > places.size() - where_offset)
    return fail(place + "/indices", "extends beyond its buffer view");
  if (what_offset > values.size() || count * size > values.size() - what_offset)
    return fail(place + "/values", "extends beyond its buffer view");
  if (out.own.empty() && spend(out.bytes.size(), place)) out.own.assign(out.bytes.begin(), out.bytes.end());
  out.bytes = out.own;
  for (std::size_t i = 0; i < count && !failed(); ++i) {
    const auto target = indexAt(type, places.data() + where_offset, i);
    if (target >= out.count) return fail(place + "/indices", "element " + std::to_string(i) + " is out of range");
    std::memcpy(&out.own[target * size], &values[what_offset + i * size], size);
  }
}

std::size_t GltfFile::countOf(std::size_t accessor, const std::string& asked_by) {
  return element(model_.accessors, "accessors", accessor, asked_by).count;
}

std::size_t GltfFile::componentsOf(std::size_t accessor, const std::string& asked_by) {
  return componentsOfType(element(model_.accessors, "accessors", accessor, asked_by).type);
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
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = indexAt(in.component_type, in.bytes.data(), i);
  }
  return out;
}

}  // namespace standpoint
