// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/geodesy.h"

#include <cmath>
#include <memory>

#include <GeographicLib/UTMUPS.hpp>
#include <fmt/format.h>
#include <proj.h>

#include "core/units.h"

namespace standpoint {

namespace {

struct ContextDeleter {
  void operator()(PJ_CONTEXT* c) const { proj_context_destroy(c); }
};
struct PjDeleter {
  void operator()(PJ* p) const { proj_destroy(p); }
};
using Context = std::unique_ptr<PJ_CONTEXT, ContextDeleter>;
using Pj = std::unique_ptr<PJ, PjDeleter>;

Context quietContext() {
  Context context(proj_context_create());
  proj_log_level(context.get(), PJ_LOG_NONE);
  proj_context_set_enable_network(context.get(), 0);
  return context;
}

std::string withAuthority(const std::string& code) {
  const bool digits = !code.empty() && code.find_first_not_of("0123456789") == std::string::npos;
  return digits ? "EPSG:" + code : code;
}

Pj findPj(PJ_CONTEXT* context, const std::string& code) {
  Pj crs(proj_create(context, withAuthority(code).c_str()));
  if (crs && !proj_is_crs(crs.get())) crs.reset();
  return crs;
}

// Of the first horizontal axis; of a compound CRS that is its first part's, of one bound to WGS84 (TOWGS84) its own.
double metresPerUnit(PJ_CONTEXT* context, const PJ* crs) {
  Pj part(proj_clone(context, crs));
  if (part && proj_get_type(part.get()) == PJ_TYPE_BOUND_CRS) part.reset(proj_get_source_crs(context, part.get()));
  if (part && proj_get_type(part.get()) == PJ_TYPE_COMPOUND_CRS)
    part.reset(proj_crs_get_sub_crs(context, part.get(), 0));
  if (part && proj_get_type(part.get()) == PJ_TYPE_BOUND_CRS) part.reset(proj_get_source_crs(context, part.get()));
  if (part && proj_get_type(part.get()) != PJ_TYPE_PROJECTED_CRS) return 1;
  const Pj system(part ? proj_crs_get_coordinate_system(context, part.get()) : nullptr);
  double factor = 1;
  if (system &&
      !proj_cs_get_axis_info(context, system.get(), 0, nullptr, nullptr, nullptr, &factor, nullptr, nullptr, nullptr))
    return 1;
  return factor > 0 ? factor : 1;
}

tl::unexpected<Error> unknownCrs(const std::string& code) {
  return failure(
      ErrorKind::usage,
      fmt::format(
          "unknown coordinate reference system '{}'; enter an EPSG code such as EPSG:25832, or leave the option out",
          code),
      "--crs");
}

}  // namespace

Result<CoordinateReferenceSystem> findCrs(const std::string& code) {
  const Context context = quietContext();
  const Pj crs = findPj(context.get(), code);
  if (!crs) return unknownCrs(code);
  CoordinateReferenceSystem result;
  const char* authority = proj_get_id_auth_name(crs.get(), 0);
  const char* number = proj_get_id_code(crs.get(), 0);
  result.code =
      authority != nullptr && number != nullptr ? fmt::format("{}:{}", authority, number) : withAuthority(code);
  if (const char* crs_name = proj_get_name(crs.get())) result.name = crs_name;
  if (const char* wkt = proj_as_wkt(context.get(), crs.get(), PJ_WKT2_2019, nullptr)) result.wkt = wkt;
  const PJ_TYPE type = proj_get_type(crs.get());
  result.projected = type == PJ_TYPE_PROJECTED_CRS || type == PJ_TYPE_COMPOUND_CRS;
  result.metres_per_unit = metresPerUnit(context.get(), crs.get());
  return result;
}

UtmPosition utm(double latitude_deg, double longitude_deg) {
  UtmPosition result;
  GeographicLib::UTMUPS::Forward(latitude_deg, longitude_deg, result.zone, result.north, result.easting_m,
                                 result.northing_m, result.convergence_deg, result.scale);
  return result;
}

Result<MapFactors> geographic(const std::string& code, const Eigen::Vector3d& map_m) {
  const Context context = quietContext();
  const Pj crs = findPj(context.get(), code);
  if (!crs) return unknownCrs(code);
  const Pj wgs84(proj_create(context.get(), "EPSG:4326"));
  const Pj raw(proj_create_crs_to_crs_from_pj(context.get(), crs.get(), wgs84.get(), nullptr, nullptr));
  if (!raw)
    return failure(ErrorKind::unusable, fmt::format("PROJ has no transformation from {} to WGS84", code), "--crs");
  const Pj to_wgs84(proj_normalize_for_visualization(context.get(), raw.get()));
  const PJ_COORD out = proj_trans(to_wgs84.get(), PJ_FWD, proj_coord(map_m.x(), map_m.y(), 0, 0));
  if (!std::isfinite(out.lp.lam) || !std::isfinite(out.lp.phi) || std::abs(out.lp.phi) > 90)
    return failure(ErrorKind::unusable,
                   fmt::format("({:.3f}, {:.3f}) is outside the area of use of {}", map_m.x(), map_m.y(), code),
                   "--origin");
  MapFactors result;
  result.geographic = {out.lp.phi, out.lp.lam, map_m.z()};
  // Factors are asked of the CRS itself, at its own geographic coordinates (radians).
  const PJ_FACTORS factors =
      proj_factors(crs.get(), proj_coord(out.lp.lam * kRadPerDeg, out.lp.phi * kRadPerDeg, 0, 0));
  if (factors.meridional_scale > 0) {
    result.grid_convergence_deg = factors.meridian_convergence / kRadPerDeg;
    result.scale_factor = factors.meridional_scale;
  }
  return result;
}

struct MapProjection::Transformation {
  std::string crs;
  double metres_per_unit;
  Context context;
  Pj map_from_wgs84;  // degrees, longitude first; eastings first
};

MapProjection::MapProjection(std::unique_ptr<Transformation> transformation)
    : transformation_(std::move(transformation)) {}
MapProjection::MapProjection(MapProjection&&) noexcept = default;
MapProjection::~MapProjection() = default;

Result<MapProjection> MapProjection::of(const std::string& code) {
  TRY_ASSIGN(const auto found, findCrs(code));
  if (!found.projected)
    return failure(ErrorKind::usage, fmt::format("{} is not a projected coordinate reference system", code), "--crs");
  auto result = std::make_unique<Transformation>();
  result->crs = code;
  result->metres_per_unit = found.metres_per_unit;
  result->context = quietContext();
  const Pj crs = findPj(result->context.get(), code), wgs84(proj_create(result->context.get(), "EPSG:4326"));
  const Pj raw(proj_create_crs_to_crs_from_pj(result->context.get(), wgs84.get(), crs.get(), nullptr, nullptr));
  if (raw) result->map_from_wgs84.reset(proj_normalize_for_visualization(result->context.get(), raw.get()));
  if (!result->map_from_wgs84)
    return failure(ErrorKind::unusable, fmt::format("PROJ has no transformation from {} to WGS84", code), "--crs");
  return MapProjection(std::move(result));
}

Result<Eigen::Vector2d> MapProjection::map(const Geographic& geographic) const {
  const auto& t = *transformation_;
  const double latitude = geographic.latitude_rad / kRadPerDeg, longitude = geographic.longitude_rad / kRadPerDeg;
  const PJ_COORD out = proj_trans(t.map_from_wgs84.get(), PJ_FWD, proj_coord(longitude, latitude, 0, 0));
  if (!std::isfinite(out.xy.x) || !std::isfinite(out.xy.y))
    return failure(ErrorKind::unusable,
                   fmt::format("latitude {:.4f}°, longitude {:.4f}° is outside the area of use of {}", latitude,
                               longitude, t.crs));
  return Eigen::Vector2d(out.xy.x, out.xy.y) * t.metres_per_unit;
}

Result<MapProjection::Geographic> MapProjection::geographic(const Eigen::Vector2d& map_m) const {
  const auto& t = *transformation_;
  const Eigen::Vector2d units = map_m / t.metres_per_unit;
  const PJ_COORD out = proj_trans(t.map_from_wgs84.get(), PJ_INV, proj_coord(units.x(), units.y(), 0, 0));
  if (!std::isfinite(out.lp.lam) || !std::isfinite(out.lp.phi) || std::abs(out.lp.phi) > 90)
    return failure(ErrorKind::unusable,
                   fmt::format("({:.3f}, {:.3f}) is outside the area of use of {}", map_m.x(), map_m.y(), t.crs));
  return Geographic{out.lp.phi * kRadPerDeg, out.lp.lam * kRadPerDeg};
}

Result<double> MapProjection::northDirection_rad(const Geographic& at) const {
  constexpr double kStep_rad = 1e-6;  // 6 m
  TRY_ASSIGN(const Eigen::Vector2d south, map({at.latitude_rad - kStep_rad, at.longitude_rad}));
  TRY_ASSIGN(const Eigen::Vector2d north, map({at.latitude_rad + kStep_rad, at.longitude_rad}));
  return std::atan2(north.y() - south.y(), north.x() - south.x());
}

}  // namespace standpoint
