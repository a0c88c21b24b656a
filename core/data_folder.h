// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace standpoint {

// Where the program's own data lies: instruments, materials, rules, schemas, samples. STANDPOINT_DATA, else beside the
// program's sources as built.
std::filesystem::path dataFolder();

}  // namespace standpoint
