// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/environment.h"
#include "editor/desktop/file_list.h"
#include "editor/model/option_form.h"
#include "editor/recovery/left_work.h"
#include "project/task.h"

namespace standpoint {

struct FileDialogState {
  enum class Purpose { openFile, openFolder, saveFile, saveFolder };
  bool open = false;
  Purpose purpose = Purpose::openFile;
  std::string title, accept;  // "Import a model", "Import"
  std::filesystem::path folder;
  std::string folder_text;  // the editable path line
  std::string name;         // chosen or typed
  std::string offered;      // the name that it began with
  std::vector<std::string> extensions;
  FileOrder order = FileOrder::name;
  bool descending = false;
  std::string sought;  // what was typed of a name of something that is there: only rows with it are listed
  FileListing listing;
  std::vector<FileRow> listed;  // of it
  bool stale = true;            // the folder must be read again
  bool confirm_overwrite = false;
  bool focus_name = false;  // the name takes the keyboard in the next frame
  std::function<void(const std::filesystem::path&)> done;
  std::function<void()> cancelled;
};

struct VerbDialogState {
  bool open = false;
  std::string verb;
  OptionForm form;
  nlohmann::json begun_with;  // the options when it was opened
  bool exports = false;       // the model or points, which the dialog lets one choose between
  float form_height = 0;      // as it was drawn last, in points of the screen
};

struct PaletteState {
  bool open = false;
  bool shown = false;  // it has been drawn
  std::string query;
  bool at_end = false;  // of what it begins with: typing goes on there
  int chosen = 0;
  // The products that were found last: of which model, by which words.
  struct {
    std::shared_ptr<const Environment> environment;
    std::string words;
    std::vector<std::uint32_t> products;
  } found;
};

// Of a recovery copy with the project that it is a copy of.
struct RecoveryComparison {
  std::filesystem::path folder;  // of the work that was left
  std::unique_ptr<Task<std::vector<std::string>>> task;
};

struct DialogStates {
  FileDialogState file;
  VerbDialogState verb;
  PaletteState palette;
  bool shortcuts = false;
  bool about = false;
  bool preferences = false;
  // Of the scans of unsaved projects with what draws them, and of that alone, as the preferences were opened.
  std::uint64_t unsaved_bytes = 0, unsaved_drawn_bytes = 0;
  bool unsaved = false;
  std::function<void()> after_unsaved;  // what the user was about to do
  std::function<void()> after_save;     // once the save that the prompt started has gone well
  std::vector<LeftWork> recovery;       // found at the start, offered one by one
  RecoveryComparison comparison;
  std::filesystem::path deletes;         // a recovery copy that another press deletes
  std::optional<LeftJob> resume;         // a scan to go on with once its project is open
  nlohmann::json shown_before;           // how that was looked at, to be so again; empty: as usual
  bool bare = false;                     // what a bare start is, is being said
  std::function<void()> start_as_usual;  // after a bare start; empty: it was none
};

}  // namespace standpoint
