// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/model/style.h"

#include <algorithm>
#include <cmath>

namespace standpoint::ifc {
namespace {

std::uint32_t byteOf(double fraction) {
  return static_cast<std::uint32_t>(std::lround(std::clamp(fraction, 0.0, 1.0) * 255));
}

// 24 bits of colour and 5 of opacity above kFirstColour: two map entries of one colour are one surface.
std::uint32_t packColour(double r, double g, double b, double opacity) {
  const auto opaque = static_cast<std::uint32_t>(std::lround(std::clamp(opacity, 0.0, 1.0) * 31));
  return kFirstColour | opaque << 24 | byteOf(r) << 16 | byteOf(g) << 8 | byteOf(b);
}

Colour unpackColour(std::uint32_t tag) {
  const auto fraction = [&](int shift) { return static_cast<float>((tag >> shift) & 255U) / 255.0F; };
  return {fraction(16), fraction(8), fraction(0), static_cast<float>((tag >> 24) & 31U) / 31.0F};
}

Id firstSurfaceStyle(const Entity& from, std::size_t list_index, int depth) {
  for (const Entity& e : from.refs(list_index)) {
    if (e.is("IFCSURFACESTYLE")) return e.id();
    if (e.is("IFCPRESENTATIONSTYLEASSIGNMENT") && depth < 4)  // IFC2X3, and IFC4 files of exporters that kept it
      if (const Id found = firstSurfaceStyle(e, 0, depth + 1)) return found;
  }
  return 0;
}

}  // namespace

Id surfaceStyleOf(const Entity& styled_item) { return firstSurfaceStyle(styled_item, 1, 0); }

std::vector<Id> stylesOfItems(const StepFile& file, const TextureMaps& textures) {
  std::vector<Id> styles(file.records().size(), 0);
  for (const Entity& styled : file.all("IFCSTYLEDITEM")) {
    const Entity item = styled.ref(0);
    if (!item) continue;
    Id& style = styles[file.indexOf(item)];
    if (style == 0) style = surfaceStyleOf(styled);
  }
  for (const Entity& layer : file.all("IFCPRESENTATIONLAYERWITHSTYLE"))
    if (const Id style = firstSurfaceStyle(layer, 7, 0))
      for (const Entity& item : layer.refs(2))
        if (Id& own = styles[file.indexOf(item)]; own == 0) own = style;
  for (const Entity& map : file.all("IFCTEXTUREMAP"))
    if (const Entity face = map.ref(2)) styles[file.indexOf(face)] = textures.firstTag(face.id());
  return styles;
}

std::uint32_t styleOf(Entity e, const Model& model) {
  for (int depth = 0; e && depth < 1000; ++depth) {
    if (const Id style = model.style_of_item[model.file.indexOf(e)]) return style;
    const std::string_view name = e.typeName();
    if (name == "IFCBOOLEANRESULT" || name == "IFCBOOLEANCLIPPINGRESULT")
      e = e.ref(1);
    else if (name == "IFCCSGSOLID")
      e = e.ref(0);
    else
      break;
  }
  return kNoStyle;
}

std::optional<Style> styleOfTag(const StepFile& file, std::uint32_t tag) {
  if (tag >= kFirstColour) return Style{"", unpackColour(tag)};
  const Entity e = file.entity(tag);
  if (!e.is("IFCSURFACESTYLE")) return {};
  Style style{e[0].text(), {}, {}, 0};
  for (const Entity& shading : e.refs(2)) {
    if (shading.is("IFCSURFACESTYLEREFRACTION"))
      if (const auto n = shading[0].number(); n && *n >= 1 && *n < 10)
        style.index_of_refraction = static_cast<float>(*n);
    if (shading.is("IFCSURFACESTYLEWITHTEXTURES"))
      for (const Entity& texture : shading.refs(0))
        if (style.texture == 0) style.texture = texture.id();
    if (!shading.is("IFCSURFACESTYLERENDERING") && !shading.is("IFCSURFACESTYLESHADING")) continue;
    const Entity rgb = shading.ref(0);
    style.colour = {static_cast<float>(std::clamp(rgb[1].number(0.7), 0.0, 1.0)),
                    static_cast<float>(std::clamp(rgb[2].number(0.7), 0.0, 1.0)),
                    static_cast<float>(std::clamp(rgb[3].number(0.7), 0.0, 1.0)),
                    static_cast<float>(1 - std::clamp(shading[1].number(0), 0.0, 1.0))};
  }
  return style;
}

std::map<Id, Id> colourMaps(const StepFile& file) {
  std::map<Id, Id> maps;
  for (const Entity& map : file.all("IFCINDEXEDCOLOURMAP")) maps.emplace(map[0].reference(), map.id());
  return maps;
}

FaceColours::FaceColours(const Entity& face_set, const Model& model) {
  if (const std::uint32_t first = model.textures.firstTag(face_set.id())) {
    const Value faces = face_set[face_set.is("IFCPOLYGONALFACESET") ? 2 : 3];
    for (std::size_t i = 0, n = faces.size(); i < n; ++i) tags_.push_back(first + static_cast<std::uint32_t>(i));
    return;
  }
  const auto known = model.colour_map_of_face_set.find(face_set.id());
  if (known == model.colour_map_of_face_set.end()) return;
  const Entity map = model.file.entity(known->second);
  std::vector<std::uint32_t> colours;
  const double opacity = map[1].number(1);
  const Value list = map.ref(2)[0];
  for (const Value rgb : list) {
    double c[3] = {0.7, 0.7, 0.7};
    int i = 0;
    for (const Value v : rgb)
      if (i < 3) c[i++] = v.number(0.7);
    colours.push_back(packColour(c[0], c[1], c[2], opacity));
  }
  const Value indices = map[3];
  for (const Value v : indices) {
    const auto i = v.integer();
    tags_.push_back(i >= 1 && i <= static_cast<std::int64_t>(colours.size()) ? colours[static_cast<std::size_t>(i - 1)]
                                                                             : kNoStyle);
  }
}

}  // namespace standpoint::ifc
