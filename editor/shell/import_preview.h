// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

namespace standpoint {

struct Editor;

// Files as they are dropped, chosen or named: a project is opened, models are previewed together, and clouds become
// underlays once there is a model.
void openFiles(Editor& editor, const std::vector<std::filesystem::path>& files);

void acceptPreview(Editor& editor);  // a new project; asks about unsaved changes first
void addPreview(Editor& editor);     // to the open environment
void closePreview(Editor& editor);
void runPreviewKeys(Editor& editor);  // Enter, Esc, F

}  // namespace standpoint
