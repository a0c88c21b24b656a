// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "core/progress.h"
#include "core/result.h"
#include "project/document.h"

namespace standpoint {

constexpr int kProjectVersion = 1;

// A project is a folder: project.json (versioned, readable), geometry/*.glb, products.json; scans/ holds what was
// scanned. Saving writes beside the old files and swaps project.json last, so a full disk or a crash leaves the project
// as it was. load(save(d)) scans to the same bytes as d.
Result<void> saveProject(const Document& document, const std::filesystem::path& folder, Progress& progress);

// The same into a folder that holds `before` by the hand of this program: parts that are the same ones are not written
// again. A `before` without a model, or a folder that was changed since, costs no more than saveProject.
Result<void> saveChanges(const Document& before, const Document& document, const std::filesystem::path& folder,
                         Progress& progress);

// Is there nothing in the folder but what a save leaves that was broken off before there was a project?
bool isEmptyProjectFolder(const std::filesystem::path& folder);

// What project.json says now: equal texts are equal projects.
Result<std::string> projectText(const std::filesystem::path& folder);

// A newer version, a missing part, a wrong index: an error that names file and place. A project
// that another program replaces while it is read is read again.
// `report`: what could be read without, and is dropped.
Result<Document> loadProject(const std::filesystem::path& folder, Progress& progress, Report* report = nullptr);

// Puts a part of the project back that is missing: `found` is a copy of it, which is checked by the name that parts
// have by their content.
Result<void> restorePart(const std::filesystem::path& missing, const std::filesystem::path& found);
// Is `file` missing from the geometry of a project? Its folder then; else empty.
std::filesystem::path projectMissing(const std::filesystem::path& file);

}  // namespace standpoint
