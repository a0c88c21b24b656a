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

}  // namespace

const AnswerFields<Pose>& answerFields(const Pose*) {
  static const AnswerFields<Pose> fields = {{"rotation", &Pose::rotation, wxyz}, {"translation", &Pose::translation}};
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

json toJson(const Bounds& bounds_local, const Eigen::Vector3d& shift_m) {
  if (bounds_local.empty()) return nullptr;
  return {toJson(bounds_local.min + shift_m), toJson(bounds_local.max + shift_m)};
}

json toJson(const SurfaceFit& fit) { return AnswerValue<SurfaceFit>::write(fit); }

json poseToJson(const Pose& pose) { return AnswerValue<Pose>::write(pose); }

Pose poseFrom(const json& j) {
  const auto& q = j.at("rotation");
  return {Eigen::Quaterniond(q.at(0), q.at(1), q.at(2), q.at(3)), vectorFrom(j.at("translation"))};
}

json identity(const Product& product) { return AnswerValue<ProductIdentity>::write(identityOf(product)); }

json toJson(const Report& report) {
  json issues = json::array();
  for (const auto& i : report.issues)
    issues.push_back({{"severity", name(i.severity)}, {"source", i.source}, {"message", i.message}});
  return issues;
}

json georeferenceToJson(const Georeference& g) {
  json object = {{"shift", toJson(g.shift_m)}, {"crs", g.crs.empty() ? json(nullptr) : json(g.crs)}};
  if (g.map_from_file)
    object["map_conversion"] = {
        {"eastings", g.map_from_file->eastings_m},        {"northings", g.map_from_file->northings_m},
        {"height", g.map_from_file->orthogonal_height_m}, {"abscissa", g.map_from_file->x_axis_abscissa},
        {"ordinate", g.map_from_file->x_axis_ordinate},   {"scale", g.map_from_file->scale}};
  if (g.map_from_file && g.map_from_file->factors != Eigen::Vector3d::Ones())
    object["map_conversion"]["factors"] = toJson(g.map_from_file->factors);
  if (g.site)
    object["site"] = {{"latitude_deg", g.site->latitude_deg},
                      {"longitude_deg", g.site->longitude_deg},
                      {"elevation", g.site->elevation_m}};
  if (g.true_north_rad) object["true_north_deg"] = *g.true_north_rad / kRadPerDeg;
  return object;
}

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
