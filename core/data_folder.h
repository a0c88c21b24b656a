// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace standpoint {

// Where the program's own data lies: instruments, materials, rules, schemas, samples. STANDPOINT_DATA, else as
// dataFolderOf this program. A build folder is laid out as an installed tree (cmake/install.cmake), so there is one
// rule.
std::filesystem::path dataFolder();

// Of code that another's program has loaded, such as Python's module: where its data lies, in place of what would be
// beside that program. STANDPOINT_DATA still comes first. Called before anything asks for data.
void useDataFolder(std::filesystem::path folder);

// share/standpoint beside the folder of the program, if it is data of ours, so that a tree can be moved; else where the
// build was told to install it.
std::filesystem::path dataFolderOf(const std::filesystem::path& program);

// A file by which such a folder is recognised.
inline constexpr const char* kDataMark = "materials/schema.json";

// Where a user keeps what belongs beside that data: what `variable` names, if there is one, else standpoint/`name`
// among the settings of programs (XDG_CONFIG_HOME, else ~/.config). Empty where none of them is set; it need not be
// there.
std::filesystem::path ownPath(const char* variable, const char* name);

// The models of the sample environments: STANDPOINT_SAMPLES, else with the data.
std::filesystem::path samplesFolder();

}  // namespace standpoint
