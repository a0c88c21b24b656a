// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The parts of a document as they stand in project.json. Readers throw nlohmann::json::exception with the place of what
// is missing or of the wrong kind; project_files.cpp turns that into an Error.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include <nlohmann/json.hpp>

#include "project/answers.h"
#include "project/document.h"

namespace standpoint {

// Everything but geometry and product records; files of the job as storedPlace() has them for the project's folder.
nlohmann::json documentToJson(const Document& document, const std::filesystem::path& folder);
Document documentFrom(const nlohmann::json& project);

nlohmann::json recordsToJson(const Environment& environment);  // products and spatial structure
Environment recordsFrom(const nlohmann::json& records);

std::shared_ptr<const SimplifiedModel> simplificationFrom(const nlohmann::json& part,
                                                          std::shared_ptr<const Environment> environment);

// Collision shapes as instances (then the walkable surface, as the last mesh), so that the glTF writer serves them too.
Environment collisionEnvironment(const CollideResult& collision);
std::shared_ptr<const CollideResult> collisionFrom(const nlohmann::json& part, const Environment& shapes);

// Empty when the parts fit each other (indices of products, surfaces, materials in range).
std::string inconsistency(const Document& document);

std::uint64_t contentHash(const std::string& bytes);

}  // namespace standpoint
