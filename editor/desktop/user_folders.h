// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace standpoint {

// What the user's folders have of the editor, after the XDG base directory specification.
std::filesystem::path settingsFile();  // XDG_CONFIG_HOME/standpoint/editor.json
std::filesystem::path unsavedRoot();   // XDG_DATA_HOME/standpoint/unsaved: what was scanned before a project was saved
std::filesystem::path octreeCache();   // XDG_CACHE_HOME/standpoint/octrees: of clouds whose folders are read-only
std::filesystem::path recoveryRoot();  // XDG_STATE_HOME/standpoint/recovery

}  // namespace standpoint
