// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "editor/model/dialog_states.h"

namespace standpoint {

struct Editor;

void openPalette(Editor& editor);
void openPaletteOfRooms(Editor& editor);  // and storeys
void askForProject(Editor& editor);
void askForModel(Editor& editor);
void askForChangedModel(Editor& editor);
void askForExport(Editor& editor);
// Of a scan or underlay of the project. Where none is said: of the chosen station's or the one that is shown, else of
// the newest scans of all stations.
void askForPointsExport(Editor& editor, const std::filesystem::path& cloud = {});
// The options of `convert` that name these files, one at least.
nlohmann::json pointsOf(const std::vector<std::filesystem::path>& files);
std::string whyNoPointsExport(const Editor& editor);
void askWhereToSave(Editor& editor);
// A file that is missing, as filesOf() of the document has it, or a missing part of a project that could not be opened:
// where it is now.
void askToLocate(Editor& editor, const std::filesystem::path& missing);
// `file` where the document uses it and it is not there; else empty.
std::filesystem::path projectFileOf(const Editor& editor, const std::filesystem::path& file);
// A file browser of our own; `done` gets what was chosen.
void askForFile(Editor& editor, FileDialogState::Purpose purpose, std::string title, std::string accept,
                std::vector<std::string> extensions, std::string name,
                std::function<void(const std::filesystem::path&)> done);

// Draw what is open. Each is called once a frame.
void drawFileDialog(Editor& editor);
void drawVerbDialog(Editor& editor);
void drawPalette(Editor& editor);
void drawAnswer(Editor& editor);
void drawMessages(Editor& editor);  // errors, unsaved changes, recovery, shortcuts, preferences, about

// The widgets of a verb's options.
void drawOptionForm(Editor& editor, OptionForm& form);

}  // namespace standpoint
