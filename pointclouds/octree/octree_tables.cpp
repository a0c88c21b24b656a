// SPDX-License-Identifier: GPL-3.0-or-later
#include <nlohmann/json.hpp>

#include "pointclouds/octree/octree_layout.h"

namespace standpoint::octree {

namespace {

using nlohmann::json;

json of(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
Eigen::Vector3d vectorFrom(const json& part) {
  return {part.at(0).get<double>(), part.at(1).get<double>(), part.at(2).get<double>()};
}

}  // namespace

std::string tablesOf(const CloudHeader& header) {
  json stations = json::array(), products = json::array();
  for (const auto& s : header.stations) {
    const auto& q = s.file_from_scanner.rotation;
    stations.push_back({{"name", s.name},
                        {"rotation", {q.w(), q.x(), q.y(), q.z()}},
                        {"translation", of(s.file_from_scanner.translation)},
                        {"intensity", {s.intensity_min, s.intensity_max}},
                        {"start_gps_s", s.acquisition_start_gps_s},
                        {"points", s.points}});
  }
  for (const auto& p : header.products) products.push_back({p.id, p.global_id, p.ifc_class, p.name});
  return json{{"origin", of(header.origin_m)},
              {"channels", header.channels},
              {"stations", stations},
              {"products", products},
              {"materials", header.materials}}
      .dump(-1, ' ', false, json::error_handler_t::replace);
}

Result<CloudHeader> headerFrom(const std::string& tables, const std::string& file) {
  try {
    const json root = json::parse(tables);
    CloudHeader header;
    header.origin_m = vectorFrom(root.at("origin"));
    header.channels = root.at("channels").get<std::uint32_t>();
    for (const auto& s : root.at("stations")) {
      CloudStation station;
      station.name = s.at("name").get<std::string>();
      const auto& q = s.at("rotation");
      station.file_from_scanner.rotation = Eigen::Quaterniond(q.at(0).get<double>(), q.at(1).get<double>(),
                                                              q.at(2).get<double>(), q.at(3).get<double>());
      station.file_from_scanner.translation = vectorFrom(s.at("translation"));
      station.intensity_min = s.at("intensity").at(0).get<double>();
      station.intensity_max = s.at("intensity").at(1).get<double>();
      station.acquisition_start_gps_s = s.at("start_gps_s").get<double>();
      station.points = s.at("points").get<std::uint64_t>();
      header.stations.push_back(std::move(station));
    }
    for (const auto& p : root.at("products"))
      header.products.push_back({p.at(0).get<std::string>(), p.at(1).get<std::string>(), p.at(2).get<std::string>(),
                                 p.at(3).get<std::string>()});
    header.materials = root.at("materials").get<std::vector<std::string>>();
    return header;
  } catch (const json::exception& e) {
    return failure(ErrorKind::unusable, std::string("the tables are damaged: ") + e.what(), file);
  }
}

}  // namespace standpoint::octree
