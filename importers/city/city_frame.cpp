// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/city/city_frame.h"

#include <algorithm>
#include <cctype>

#include "importers/files/epsg.h"

namespace standpoint {

namespace {

bool isDigits(const std::string& text) {
  return !text.empty() && text.size() < 10 && text.find_first_not_of("0123456789") == std::string::npos;
}

// The last part of digits alone, up to a comma: what is between may be a version.
std::string codeAfter(const std::string& text, std::size_t from) {
  std::string code, part;
  for (std::size_t i = from;; ++i) {
    const bool ends = i >= text.size() || text[i] == ',';
    if (!ends && text[i] != ':' && text[i] != '/' && text[i] != ' ') {
      part += text[i];
      continue;
    }
    if (isDigits(part)) code = part;
    part.clear();
    if (ends) return code;
  }
}

}  // namespace

std::string crsOfCityName(const std::string& name) {
  std::string upper = name;
  std::transform(upper.begin(), upper.end(), upper.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  if (const auto at = upper.find("EPSG"); at != std::string::npos)
    if (const std::string code = codeAfter(upper, at + 4); !code.empty()) return "EPSG:" + code;
  // As the surveying authorities of Germany write it.
  if (const auto at = upper.find("ETRS89_UTM"); at != std::string::npos)
    if (const std::string zone = upper.substr(at + 10, 2); isDigits(zone)) return "EPSG:258" + zone;
  return name;
}

Result<double> cityUnit(const CityFrame& frame, const Bounds& box, const std::string& file_name, Report& report) {
  if (!frame.crs.starts_with("EPSG:")) {
    if (!frame.crs.empty())
      report.warn(frame.place, "unknown coordinate reference system '" + frame.crs + "'; specify it by its EPSG code");
    return 1;
  }
  const EpsgAnswer known = epsgCrs(frame.crs.substr(5));
  if (known.asked && !known.crs)
    report.warn(frame.place, frame.crs +
                                 " is not a coordinate reference system in the EPSG dataset; specify it by its EPSG "
                                 "code");
  if (!known.crs) return 1;
  if (known.crs->projected) return known.crs->unit;
  const bool degrees = !box.empty() && box.min.head<2>().minCoeff() >= -360 && box.max.head<2>().maxCoeff() <= 360;
  if (degrees)
    return failure(ErrorKind::unusable,
                   "the coordinates are in degrees (" + frame.crs +
                       "); convert the file to a projected coordinate reference system",
                   file_name + " " + frame.place);
  report.warn(frame.place, frame.crs + " is not a projected coordinate reference system");
  return 1;
}

void georeferenceCity(const CityFrame& frame, Georeference& georeference) {
  if (!frame.crs.starts_with("EPSG:")) return;
  georeference.crs = frame.crs;
  const EpsgAnswer known = epsgCrs(frame.crs.substr(5));
  if (!known.crs || known.crs->projected) georeference.map_from_file = MapConversion{};
}

}  // namespace standpoint
