// SPDX-License-Identifier: GPL-3.0-or-later
#include <exception>
#include <limits>

#include <draco/compression/decode.h>

#include "importers/gltf/gltf_primitive.h"

namespace standpoint {

namespace {

// Only what we read; normals and tangents stay packed.
bool wanted(const std::string& attribute) {
  for (const char* prefix : {"POSITION", "TEXCOORD_", "COLOR_0", "JOINTS_", "WEIGHTS_", "_FEATURE_ID_"})
    if (attribute.starts_with(prefix)) return true;
  return false;
}

// The accessor says whether integers are fractions of their type's largest.
double largestOf(draco::DataType type) {
  switch (type) {
    case draco::DT_INT8: return 127;
    case draco::DT_UINT8: return 255;
    case draco::DT_INT16: return 32767;
    case draco::DT_UINT16: return 65535;
    default: return 1;
  }
}

bool copyColumn(const draco::Mesh& mesh, const draco::PointAttribute& attribute, bool normalized,
                DracoPrimitive::Column& out) {
  const auto n = static_cast<std::size_t>(attribute.num_components());
  if (n == 0 || n > 4) return false;
  out.components = n;
  out.values.resize(std::size_t{mesh.num_points()} * n);
  for (draco::PointIndex i(0); i < mesh.num_points(); ++i) {
    const auto entry = attribute.mapped_index(i);
    if (entry.value() >= attribute.size()) return false;
    if (!attribute.ConvertValue<float>(entry, static_cast<std::int8_t>(n), &out.values[i.value() * n])) return false;
  }
  const double scale = normalized && !attribute.normalized() ? 1 / largestOf(attribute.data_type()) : 1;
  if (scale != 1)
    for (auto& value : out.values) value = static_cast<float>(value * scale);
  return true;
}

bool copyTriangles(const draco::Mesh& mesh, DracoPrimitive& out) {
  out.vertices = mesh.num_points();
  out.triangles.resize(mesh.num_faces());
  for (draco::FaceIndex f(0); f < mesh.num_faces(); ++f)
    for (int k = 0; k < 3; ++k) {
      const auto corner = mesh.face(f)[k].value();
      if (corner >= out.vertices) return false;
      out.triangles[f.value()][static_cast<std::size_t>(k)] = corner;
    }
  return true;
}

using Attributes = std::map<std::string, int>;

bool normalizedAccessor(GltfFile& file, const Attributes& attributes, const std::string& name,
                        const std::string& place) {
  const auto found = attributes.find(name);
  if (found == attributes.end()) return false;
  return file.element(file.model().accessors, "accessors", static_cast<std::size_t>(found->second), place).normalized;
}

void decode(GltfFile& file, std::span<const std::uint8_t> bytes, const nlohmann::json& ids,
            const Attributes& attributes, const std::string& place, DracoPrimitive& out) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  draco::Decoder decoder;
  auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok())
    return file.fail(place, "the compressed data is damaged (Draco: " + decoded.status().error_msg_string() + ")");
  const draco::Mesh& mesh = *decoded.value();
  if (!file.spend(std::size_t{mesh.num_points()} * 40 + std::size_t{mesh.num_faces()} * 12, place)) return;
  if (!copyTriangles(mesh, out)) return file.fail(place, "the compressed data is damaged (a corner is out of range)");
  if (!ids.is_object()) return;
  for (const auto& [name, id] : ids.items()) {
    if (!wanted(name)) continue;
    const std::string where = place + "/attributes/" + name;
    const auto* attribute = id.is_number_unsigned() ? mesh.GetAttributeByUniqueId(id.get<std::uint32_t>()) : nullptr;
    const bool normalized = normalizedAccessor(file, attributes, name, where);
    if (attribute == nullptr || !copyColumn(mesh, *attribute, normalized, out.columns[name]))
      return file.fail(where, "is not in the compressed data");
  }
}

}  // namespace

DracoPrimitive decodeDraco(GltfFile& file, const nlohmann::json& extension, const Attributes& attributes,
                           const std::string& place) {
  DracoPrimitive out;
  const auto buffer_view = file.index(extension, "bufferView", place);
  if (!buffer_view) file.fail(place, "has no bufferView");
  if (file.failed()) return out;
  const auto bytes = file.view(*buffer_view, place);
  if (file.failed()) return out;
  try {
    decode(file, bytes, memberOf(extension, "attributes"), attributes, place, out);
  } catch (const std::exception& e) {
    file.fail(place, "the compressed data is damaged (" + std::string(e.what()) + ")");
  }
  return out;
}

}  // namespace standpoint
