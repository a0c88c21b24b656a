// SPDX-License-Identifier: GPL-3.0-or-later
#include <exception>

#include <draco/compression/decode.h>

#include "importers/gltf_mesh.h"

namespace standpoint {

namespace {

DracoPrimitive copied(const draco::Mesh& mesh, const draco::PointAttribute& attribute) {
  DracoPrimitive out;
  out.positions.resize(mesh.num_points());
  for (draco::PointIndex i(0); i < mesh.num_points(); ++i)
    attribute.ConvertValue<float>(attribute.mapped_index(i), 3, out.positions[i.value()].data());
  out.triangles.resize(mesh.num_faces());
  for (draco::FaceIndex f(0); f < mesh.num_faces(); ++f)
    for (int k = 0; k < 3; ++k) out.triangles[f.value()][static_cast<std::size_t>(k)] = mesh.face(f)[k].value();
  return out;
}

}  // namespace

DracoPrimitive decodeDraco(GltfFile& file, const nlohmann::json& extension, const std::string& place) {
  const auto buffer_view = file.index(extension, "bufferView", place);
  const auto id = file.index(memberOf(extension, "attributes"), "POSITION", place + "/attributes");
  if (!buffer_view || !id) {
    file.fail(place, "has no bufferView or no POSITION");
    return {};
  }
  const auto bytes = file.view(*buffer_view, place);
  if (file.failed()) return {};
  try {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok()) {
      file.fail(place, "the compressed data is damaged (Draco: " + decoded.status().error_msg_string() + ")");
      return {};
    }
    const draco::Mesh& mesh = *decoded.value();
    const auto* attribute = mesh.GetAttributeByUniqueId(static_cast<std::uint32_t>(*id));
    if (attribute == nullptr || attribute->num_components() != 3) {
      file.fail(place + "/attributes/POSITION", "is not in the compressed data");
      return {};
    }
    if (!file.spend(std::size_t{mesh.num_points()} * 12 + std::size_t{mesh.num_faces()} * 12, place)) return {};
    auto out = copied(mesh, *attribute);
    for (const auto& p : out.positions)
      if (!p.allFinite()) file.fail(place, "a position is not a finite number");
    return out;
  } catch (const std::exception& e) {
    file.fail(place, "the compressed data is damaged (" + std::string(e.what()) + ")");
    return {};
  }
}

}  // namespace standpoint
