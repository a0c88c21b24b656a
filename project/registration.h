// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/surface_fit.h"
#include "core/target_network.h"
#include "project/fields.h"
#include "project/target_measuring.h"

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

std::span<const Choice<TargetMatching>> choices(TargetMatching);

// "x,y,turn": an offset in plan, m, and a turn about itself, degrees.
struct StartOffset {
  double x_m = 0, y_m = 0, turn_deg = 0;
};
template <>
struct FieldValue<StartOffset> {
  static constexpr auto kKind = ParameterKind::text;
  static void describe(Parameter&) {}
  static Result<StartOffset> read(const nlohmann::json& text);
  static nlohmann::json write(const StartOffset& offset);
};

struct RegisterOptions {
  std::vector<std::filesystem::path> files;
  std::string fix;  // station that keeps its pose; empty: the first
  TargetMatching by = TargetMatching::by_names;
  std::filesystem::path control;
  bool cloud = false;
  std::filesystem::path output;
  double reach_m = 0.5;                     // of `cloud`
  std::optional<StartOffset> start_offset;  // likewise
  double click_m = MeasuringRequest{}.click_m;
  std::uint64_t seed = 1;
};
const Fields<RegisterOptions>& registerFields();
Result<Outcome> runRegister(const Document& document, const RegisterOptions& options, Progress& progress);

// The answer's parts.
nlohmann::json measuredRows(const Job& job, const TargetMeasurements& measured);
nlohmann::json registrationRows(const Job& job, const TargetRegistration& r, const Eigen::Vector3d& shift_m);
nlohmann::json stationRow(const Station& station, const Pose& solved, const Eigen::Vector3d& shift_m);
std::string textOf(const nlohmann::json& answer);

}  // namespace standpoint
