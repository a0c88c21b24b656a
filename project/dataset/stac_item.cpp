// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/dataset/stac_item.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string_view>

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

// STAC knows a licence by its SPDX id alone, and "proprietary" for all that has none.
std::string licenceOfItem(std::string_view licence) {
  constexpr std::string_view kSpdx = "https://spdx.org/licenses/", kPage = ".html";
  if (licence.starts_with(kSpdx)) {
    licence.remove_prefix(kSpdx.size());
    if (licence.ends_with(kPage)) licence.remove_suffix(kPage.size());
  }
  const auto belongs = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::string_view("_-.+").find(c) != std::string_view::npos;
  };
  const bool is_id = !licence.empty() && std::all_of(licence.begin(), licence.end(), belongs);
  return is_id ? std::string(licence) : "proprietary";
}

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
  Json links = Json::array();
  links.push_back({{"rel", "describedby"}, {"href", "../croissant.json"}, {"type", "application/ld+json"}});
  if (recipe.license.starts_with("https://") || recipe.license.starts_with("http://"))
    links.push_back({{"rel", "license"}, {"href", recipe.license}});
  const Json item = {{"stac_version", "1.0.0"},
                     {"stac_extensions",
                      {"https://stac-extensions.github.io/pointcloud/v2.0.0/schema.json",
                       "https://stac-extensions.github.io/file/v2.1.0/schema.json"}},
                     {"type", "Feature"},
                     {"id", recipe.name + "-" + about.id},
                     {"geometry", {{"type", "Polygon"}, {"coordinates", {std::move(ring)}}}},
                     {"bbox", {west, south, east, north}},
                     {"properties",
                      {{"datetime", recipe.date + "T00:00:00Z"},
                       {"title", fmt::format("{}: {}", recipe.name, about.id)},
                       {"description", recipe.description},
                       {"license", licenceOfItem(recipe.license)},
                       {"pc:count", points},
                       {"pc:type", "lidar"}}},
                     {"links", std::move(links)},
                     {"assets", std::move(assets)}};
  return std::optional(item.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace standpoint
