// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/gltf/gltf_georeference.h"

#include <cmath>

namespace standpoint {

nlohmann::json toJson(const Georeference& g) {
  nlohmann::json json = {{"shift_m", {g.shift_m.x(), g.shift_m.y(), g.shift_m.z()}}};
  if (!g.crs.empty()) json["crs"] = g.crs;
  if (const auto& m = g.map_from_file)
    json["map_from_file"] = {m->eastings_m,      m->northings_m,     m->orthogonal_height_m,
                             m->x_axis_abscissa, m->x_axis_ordinate, m->scale};
  if (const auto& m = g.map_from_file; m && m->factors != Eigen::Vector3d::Ones())
    json["map_factors"] = {m->factors.x(), m->factors.y(), m->factors.z()};
  if (const auto& s = g.site) json["site"] = {s->latitude_deg, s->longitude_deg, s->elevation_m};
  if (g.true_north_rad) json["true_north_rad"] = *g.true_north_rad;
  return json;
}

std::optional<Georeference> readGltfGeoreference(GltfFile& file) {
  const auto extras = gltfExtras(file.model().asset);
  const auto& json = memberOf(extras, "standpoint");
  const std::string place = "/asset/extras/standpoint";
  const auto shift = file.numbers(json, "shift_m", 3, place);
  if (shift.empty()) return std::nullopt;
  Georeference g;
  g.shift_m = {shift[0], shift[1], shift[2]};
  if (g.shift_m != Eigen::Vector3d(std::round(shift[0]), std::round(shift[1]), std::round(shift[2])))
    file.fail(place + "/shift_m", "is not whole metres");
  g.crs = file.text(json, "crs");
  if (const auto m = file.numbers(json, "map_from_file", 6, place); !m.empty())
    g.map_from_file = MapConversion{m[0], m[1], m[2], m[3], m[4], m[5]};
  if (const auto f = file.numbers(json, "map_factors", 3, place); !f.empty() && g.map_from_file)
    g.map_from_file->factors = {f[0], f[1], f[2]};
  if (const auto s = file.numbers(json, "site", 3, place); !s.empty()) g.site = GeographicPosition{s[0], s[1], s[2]};
  if (const auto& north = memberOf(json, "true_north_rad"); north.is_number()) g.true_north_rad = north.get<double>();
  return g;
}

}  // namespace standpoint
