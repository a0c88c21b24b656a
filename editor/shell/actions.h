// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>

namespace standpoint {

struct Editor;
enum class Tool;

struct Shortcut {
  int key = 0;  // of widgets/keyboard.h; 0 = none
  bool ctrl = false, shift = false, alt = false;
};

// What can be done by menu, toolbar, key or palette; one table, so that they cannot disagree.
struct Action {
  const char* id;
  const char* title;
  const char* icon;
  Shortcut shortcut;
  void (*run)(Editor&);
  std::string (*why_not)(const Editor&);  // null = always possible; else "" or the reason
  bool (*on)(const Editor&) = nullptr;    // of a switch, or a choice of several: it is ticked
  bool repeats = false;                   // again and again while its key is held
  std::optional<Tool> key_of = {};        // its key means this with that tool alone
  const char* icon_on = nullptr;          // of a button that ends what it began
};

std::span<const Action> actions();
const Action* findAction(const char* id);
std::string whyNot(const Action& action, const Editor& editor);
bool invoke(Editor& editor, const char* id);
std::string whyNothingOpen(const Editor& editor);  // neither a model nor clouds
std::string whyNoModel(const Editor& editor);
std::string shortcutText(const Shortcut& shortcut);  // "Ctrl+Shift+S"

// Runs what a pressed key stands for; not while a text is being typed or a dialog is open.
void runShortcuts(Editor& editor);
void actionMenuItem(Editor& editor, const char* id);
void actionToolButton(Editor& editor, const char* id);
void actionButton(Editor& editor, const char* id, const char* text, float width);

// From the next frame on; "": as the user's locale says.
void chooseLanguage(Editor& editor, const char* code);

// Opens the form of a verb, generated from its parameters.
void openVerbForm(Editor& editor, const char* verb);
// Asks about unsaved changes first, when there are any.
void whenSaved(Editor& editor, std::function<void()> then);
// One that comes with the program, without a preview.
void openSample(Editor& editor, const std::string& file);
// A file or folder by what it is: a project is opened, a model previewed, a cloud laid under the model.
void openPath(Editor& editor, const std::string& path);

}  // namespace standpoint
