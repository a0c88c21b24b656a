// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "project/verb.h"

namespace standpoint {

// A verb on a project on disk: read it (`project`; for a creating verb nothing is read and `output` is the new
// project), run, and write what changed. `options` has the verb's own plus "project". What the command line and job
// files do.
// Of many at once on one project, each change is kept: who writes holds the project's lock, and where another has
// written since the project was read, the verb is run again on what is there now, or its change is carried over.
Result<Outcome> runOnDisk(const Verb& verb, const nlohmann::json& options, Progress& progress);

// A project that stays in memory from verb to verb, so that it is read again only where another has written it.
struct KeptProject {
  Document document;
  std::string text;  // of the project.json that it was read from or written to; empty: not read yet
};

// As above, of the kept project in `options["project"]`; a verb that makes or needs none leaves it alone.
Result<Outcome> runOnDisk(const Verb& verb, const nlohmann::json& options, KeptProject& kept, Progress& progress);

// The folder's project as it is now. `report` as of loadProject.
Result<Document> currentDocument(const std::filesystem::path& folder, KeptProject& kept, Progress& progress,
                                 Report* report = nullptr);

}  // namespace standpoint
