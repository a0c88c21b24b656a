// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The verbs that make the model fit for its purpose: lighter, solid to walk on, of known materials, at a known place.

#include <filesystem>
#include <string>
#include <vector>

#include "project/verb.h"

namespace standpoint {

Result<Outcome> collideDocument(const Document& document, const CollideOptions& options, Progress& progress);
Result<Outcome> runCollide(const Document& document, const nlohmann::json& options, Progress& progress);

// What is said anew of the materials; the document keeps what was said before.
struct MaterialRequest {
  std::string rules;                             // a file, or "default"; empty: as they are
  std::vector<std::filesystem::path> libraries;  // of own materials
  std::vector<std::string> forget;               // own materials, by id
  std::vector<MaterialOverride> assign;          // the material "rules" takes back what was said by that selector
  std::vector<std::string> accept, reopen;       // findings, by id
  std::string because;
  std::string instrument;
};
Result<Outcome> assignDocumentMaterials(const Document& document, const MaterialRequest& request, Progress& progress);
Result<Outcome> runMaterials(const Document& document, const nlohmann::json& options, Progress& progress);

Result<Outcome> runGeoreference(const Document& document, const nlohmann::json& options, Progress& progress);

}  // namespace standpoint
