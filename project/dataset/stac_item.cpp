// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/dataset/stac_item.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/units.h"
#include "project/dataset/manifest.h"
#include "survey/geodesy.h"

namespace standpoint {

namespace {

using Json = nlohmann::ordered_json;

// 1 cm on the ground, so that the last bits of a projection do not show.
double rounded(double degrees) { return std::round(degrees * 1e7) / 1e7; }

}  // namespace

std::string stacFile(const RecipeEnvironment& environment) { return "stac/" + environment.id + ".json"; }

Result<std::optional<std::string>> stacItem(const Recipe& recipe, const SetCheck& check, std::size_t environment) {
  const auto& map = check.environments[environment].map;
  if (!map) return std::optional<std::string>();
  const auto projection = MapProjection::of(map->crs);
  if (!projection) return std::optional<std::string>();
  Json ring = Json::array();
  double west = 180, south = 90, east = -180, north = -90;
  for (const auto& [x, y] : map->corners) {
    const auto at = projection->geographic({x, y});
    if (!at) return std::optional<std::string>();
    const double longitude = rounded(at->longitude_rad / kRadPerDeg), latitude = rounded(at->latitude_rad / kRadPerDeg);
    ring.push_back({longitude, latitude});
    west = std::min(west, longitude), east = std::max(east, longitude);
    south = std::min(south, latitude), north = std::max(north, latitude);
  }
  if (ring.empty()) return std::optional<std::string>();
  ring.push_back(ring.front());
  const auto& about = recipe.environments[environment];
  std::uint64_t points = 0;
  Json assets = Json::object();
  for (const auto& scan : check.scans) {
    if (scan.place.environment != environment) continue;
    points += scan.record.points;
    const auto& cloud = scan.record.files.front();
    assets[scan.files.scan] = {{"href", "../" + cloud.path},
                               {"type", cloudMediaType(recipe)},
                               {"roles", {"data"}},
                               {"file:size", cloud.bytes},
                               {"file:checksum", "1220" + cloud.sha256}};  // multihash: sha2-256, 32 bytes
  }
  assets["plan"] = {{"href", "../" + check.environments[environment].picture.path},
                    {"type", "image/svg+xml"},
                    {"roles", {"overview"}}};
  std::string encoding = recipe.format;
  for (char& c : encoding) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  const Json item = {
      {"stac_version", "1.0.0"},
      {"stac_extensions",
       {"https://stac-extensions.github.io/pointcloud/v1.0.0/schema.json",
        "https://stac-extensions.github.io/file/v2.1.0/schema.json"}},
      {"type", "Feature"},
      {"id", recipe.name + "-" + about.id},
      {"geometry", {{"type", "Polygon"}, {"coordinates", {std::move(ring)}}}},
      {"bbox", {west, south, east, north}},
      {"properties",
       {{"datetime", recipe.date + "T00:00:00Z"},
        {"title", fmt::format("{}: {}", recipe.name, about.id)},
        {"description", recipe.description},
        {"license", recipe.license},
        {"pc:count", points},
        {"pc:type", "lidar"},
        {"pc:encoding", std::move(encoding)}}},
      {"links", {{{"rel", "describedby"}, {"href", "../croissant.json"}, {"type", "application/ld+json"}}}},
      {"assets", std::move(assets)}};
  return std::optional(item.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace standpoint
