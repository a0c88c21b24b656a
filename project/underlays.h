// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "project/fields.h"
#include "project/registering.h"

namespace standpoint {

using Underlays = std::vector<std::shared_ptr<const Underlay>>;

// As they stand in project.json: a file that lies in the project's folder or beside it is named relative to it, so both
// can move together. Readers throw nlohmann::json::exception.
nlohmann::json underlaysToJson(const Underlays& underlays, const std::filesystem::path& project_folder);
Underlays underlaysFrom(const nlohmann::json& part, const std::filesystem::path& project_folder);

// Of the cloud in the model's file frame.
Bounds boundsInFile(const Underlay& underlay);

// Adds, moves, registers, shows, hides, removes or lists clouds that lie under the model.
// Of the actions at most one; none lists.
struct UnderlayOptions : RegisterRequest {  // for `fit`
  std::optional<std::filesystem::path> add;
  std::string name;  // of what is added; empty: the file's
  std::optional<std::string> move, fit, remove, show, hide;
  std::optional<Eigen::Vector3d> at;  // the cloud's origin in the file's frame, m
  std::optional<double> yaw_deg;
};
const Fields<UnderlayOptions>& underlayFields();
Result<Outcome> runUnderlay(const Document& document, const UnderlayOptions& options, Progress& progress);

}  // namespace standpoint
