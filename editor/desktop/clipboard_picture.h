// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

namespace standpoint {

// GLFW copies text alone; a picture gets into the clipboard of X11 by the program xclip, where that is installed.
std::string whyNotCopyPicture();  // "" when it can be copied
// A PNG or JPEG file. "" or what went wrong.
std::string copyPicture(const std::filesystem::path& file);

}  // namespace standpoint
