// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/report.h"
#include "core/surface_fit.h"
#include "core/target_network.h"
#include "survey/targets/target_measuring.h"

namespace standpoint {

enum class TargetMatching { by_names, by_geometry };

// What a registration by targets came to. Stations and targets of the network have numbers of their own.
struct TargetRegistration {
  std::vector<std::size_t> station_of;    // of the job, for each of the network
  std::vector<std::string> target_names;  // for each of the network
  std::vector<std::size_t> found;         // of the measurements, for each sighting
  TargetNetwork network;
  NetworkFit fit;
  std::vector<NetworkLink> links;
  std::size_t wrong_matches = 0;  // by geometry: that the truth says otherwise
};

struct RegistrationRequest {
  TargetMatching matching = TargetMatching::by_names;
  std::size_t held = 0;               // of the job; not used with control points
  std::vector<ControlPoint> control;  // local frame
};

Result<TargetRegistration> registerByTargets(const Job& job, const TargetMeasurements& measured,
                                             const RegistrationRequest& request, Report& report);

// One line each: name X Y Z [σ in mm], in the file's frame; # begins a comment.
Result<std::vector<ControlPoint>> readControlPoints(const std::filesystem::path& file, const Eigen::Vector3d& shift_m);

}  // namespace standpoint
