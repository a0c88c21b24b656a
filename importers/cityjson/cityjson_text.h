// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "core/result.h"

namespace standpoint {

// One CityJSON or CityJSONFeature, apart from its city objects.
struct CityJsonFrame {
  nlohmann::json members = nlohmann::json::object();  // all but CityObjects and vertices
  std::vector<Eigen::Vector3d> vertices;              // as written, without the transform
  bool has_objects = false;
};

// The text is walked through twice, since a file may have its city objects before what they refer to: once for the
// frame, once for the objects, each of which is gone when `object` returns. Nothing is ever held as JSON but one object
// and the frame. Errors name the line, or the place as a JSON pointer.
Result<CityJsonFrame> readCityJsonFrame(std::string_view text, const std::string& file_name, std::size_t first_line);
Result<void> readCityObjects(std::string_view text, const std::string& file_name, std::size_t first_line,
                             const std::function<Result<void>(std::string id, const nlohmann::json&)>& object);

// A member of an object, or null. Never throws.
const nlohmann::json& cityMember(const nlohmann::json& object, const char* key);

}  // namespace standpoint
