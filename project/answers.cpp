// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/answers.h"

#include <charconv>

#include <fmt/format.h>

#include "core/units.h"

namespace standpoint {

using nlohmann::json;

namespace {

std::vector<double> wxyz(const Eigen::Quaterniond& q) { return {q.w(), q.x(), q.y(), q.z()}; }

std::optional<Eigen::Vector3d> nullWhereZero(const Eigen::Vector3d& v) {
  return v.isZero() ? std::nullopt : std::optional(v);
}

std::optional<Eigen::Vector3d> nothingWhereOnes(const Eigen::Vector3d& v) {
  return v == Eigen::Vector3d::Ones() ? std::nullopt : std::optional(v);
}

}  // namespace

const AnswerFields<Pose>& answerFields(const Pose*) {
  static const AnswerFields<Pose> fields = {{"rotation", &Pose::rotation, wxyz}, {"translation", &Pose::translation}};
  return fields;
}

const AnswerFields<MapConversion>& answerFields(const MapConversion*) {
  using A = MapConversion;
  static const AnswerFields<A> fields = {{"eastings", &A::eastings_m},
                                         {"northings", &A::northings_m},
                                         {"height", &A::orthogonal_height_m},
                                         {"abscissa", &A::x_axis_abscissa},
                                         {"ordinate", &A::x_axis_ordinate},
                                         {"scale", &A::scale},
                                         {"factors", &A::factors, nothingWhereOnes, kLeftOut}};
  return fields;
}

const AnswerFields<GeographicPosition>& answerFields(const GeographicPosition*) {
  using A = GeographicPosition;
  static const AnswerFields<A> fields = {
      {"latitude_deg", &A::latitude_deg}, {"longitude_deg", &A::longitude_deg}, {"elevation", &A::elevation_m}};
  return fields;
}

const AnswerFields<Georeference>& answerFields(const Georeference*) {
  using A = Georeference;
  static const AnswerFields<A> fields = {{"shift", &A::shift_m},
                                         {"crs", &A::crs, answers::nullWhereEmpty},
                                         {"map_conversion", &A::map_from_file, kLeftOut},
                                         {"site", &A::site, kLeftOut},
                                         {"true_north_deg", &A::true_north_rad, answers::degrees, kLeftOut}};
  return fields;
}

const AnswerFields<FreeMotion>& answerFields(const FreeMotion*) {
  using A = FreeMotion;
  static const AnswerFields<A> fields = {
      {"along", &A::shift, nullWhereZero}, {"about", &A::axis, nullWhereZero}, {"held_share", &A::held_fraction}};
  return fields;
}

const AnswerFields<SurfaceFit>& answerFields(const SurfaceFit*) {
  using A = SurfaceFit;
  static const AnswerFields<A> fields = {{"iterations", &A::iterations},
                                         {"settled", &A::settled},
                                         {"rms_m", &A::rms_m},
                                         {"used_share", &A::used_fraction},
                                         {"moved_m", &A::moved_m},
                                         {"sigma_shift_m", &A::sigma_shift_m},
                                         {"sigma_turn_deg", &A::sigma_turn_rad, answers::degreesOfEach},
                                         {"not_held", &A::free}};
  return fields;
}

ProductIdentity identityOf(const Product& p) { return {p.id, p.global_id, p.ifc_class, p.name}; }

const AnswerFields<ProductIdentity>& answerFields(const ProductIdentity*) {
  using A = ProductIdentity;
  static const AnswerFields<A> fields = {
      {"id", &A::id}, {"global_id", &A::global_id}, {"class", &A::ifc_class}, {"name", &A::name}};
  return fields;
}

json toJson(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

Eigen::Vector3d vectorFrom(const json& array) {
  return {array.at(0).get<double>(), array.at(1).get<double>(), array.at(2).get<double>()};
}

json toJson(const Bounds& bounds) {
  if (bounds.empty()) return nullptr;
  return {toJson(bounds.min), toJson(bounds.max)};
}

Bounds fileBounds(const Bounds& local, const Eigen::Vector3d& shift_m) {
  return local.empty() ? Bounds() : Bounds{local.min + shift_m, local.max + shift_m};
}

json poseToJson(const Pose& pose) { return AnswerValue<Pose>::write(pose); }

Pose poseFrom(const json& j) {
  const auto& q = j.at("rotation");
  return {Eigen::Quaterniond(q.at(0), q.at(1), q.at(2), q.at(3)), vectorFrom(j.at("translation"))};
}

json toJson(const Report& report) {
  json issues = json::array();
  for (const auto& i : report.issues)
    issues.push_back({{"severity", name(i.severity)}, {"source", i.source}, {"message", i.message}});
  return issues;
}

json georeferenceToJson(const Georeference& georeference) { return AnswerValue<Georeference>::write(georeference); }

Result<Georeference> georeferenceFrom(const json& object) {
  try {
    Georeference g;
    g.shift_m = vectorFrom(object.at("shift"));
    if (!object.at("crs").is_null()) g.crs = object.at("crs").get<std::string>();
    if (object.contains("map_conversion")) {
      const auto& c = object.at("map_conversion");
      g.map_from_file = MapConversion{c.at("eastings"), c.at("northings"), c.at("height"),
                                      c.at("abscissa"), c.at("ordinate"),  c.at("scale")};
      if (c.contains("factors")) g.map_from_file->factors = vectorFrom(c.at("factors"));
    }
    if (object.contains("site")) {
      const auto& s = object.at("site");
      g.site = GeographicPosition{s.at("latitude_deg"), s.at("longitude_deg"), s.at("elevation")};
    }
    if (object.contains("true_north_deg")) g.true_north_rad = object.at("true_north_deg").get<double>() * kRadPerDeg;
    return g;
  } catch (const json::exception& e) {
    return failure(ErrorKind::unusable, e.what(), "/georeference");
  }
}

Result<json> parseNumbers(const std::string& text) {
  json numbers = json::array();
  const char* at = text.data();
  const char* const end = at + text.size();
  while (at <= end) {
    double value = 0;
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc() || (next != end && *next != ','))
      return failure(ErrorKind::usage,
                     fmt::format("'{}' is not a comma-separated list of numbers such as 1.5,2,0", text));
    numbers.push_back(value);
    if (next == end) break;
    at = next + 1;
  }
  return numbers;
}

}  // namespace standpoint
