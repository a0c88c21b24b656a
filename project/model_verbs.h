// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The verbs that make the model fit for its purpose: lighter, solid to walk on, of known materials, at a known place.

#include "project/verb.h"

namespace standpoint {

Result<Outcome> collideDocument(const Document& document, const CollideOptions& options, Progress& progress);
Result<Outcome> runCollide(const Document& document, const nlohmann::json& options, Progress& progress);

// `rules_file` empty: the document's own rules, at first the default ones. Overrides are added to the document's.
Result<Outcome> assignDocumentMaterials(const Document& document, const std::string& rules_file,
                                        const std::vector<MaterialOverride>& overrides, Progress& progress);
Result<Outcome> runMaterials(const Document& document, const nlohmann::json& options, Progress& progress);

Result<Outcome> runGeoreference(const Document& document, const nlohmann::json& options, Progress& progress);

}  // namespace standpoint
