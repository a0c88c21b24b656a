// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/shell/import_preview.h"

#include <utility>

#include <imgui.h>

#include "editor/shell/actions.h"
#include "editor/shell/editor.h"
#include "editor/widgets/keyboard.h"
#include "editor/words/words.h"
#include "pointclouds/formats.h"

namespace standpoint {

namespace {

bool ready(const Editor& editor) {
  return editor.preview.stage() == ImportPreview::Stage::ready && !editor.preview.reading();
}

}  // namespace

void openFiles(Editor& editor, const std::vector<std::filesystem::path>& files) {
  std::vector<std::filesystem::path> models;
  std::error_code ignored;
  for (const auto& file : files) {
    if (std::filesystem::is_directory(file, ignored) || file.filename() == "project.json") {
      const auto folder = file.filename() == "project.json" ? file.parent_path() : file;
      whenSaved(editor, [&editor, folder] {
        if (editor.session.open(folder)) editor.settings.remember(folder);
      });
      return;
    }
    if (readableCloudFormat(file) != nullptr)
      editor.waiting_clouds.push_back(file);
    else
      models.push_back(file);
  }
  if (!models.empty())
    editor.preview.open(std::move(models), *editor.session.verb("import"), editor.wake);
  else if (!editor.session.document().imported)
    editor.workspace = Workspace::inspect;  // they are looked at alone
}

void acceptPreview(Editor& editor) {
  if (!ready(editor) || !editor.session.whyNot("import").empty()) return;
  whenSaved(editor, [&editor] {
    if (!ready(editor)) return;
    for (const auto& file : editor.preview.files()) editor.settings.remember(file);
    editor.selection.clear();  // of the products of another model
    editor.view.frame_wanted = true;
    editor.session.adoptImport(editor.preview.take());
  });
}

void addPreview(Editor& editor) {
  if (!ready(editor) || !editor.session.whyNot("add").empty()) return;
  const std::string title = trf("Add {}", editor.preview.fileNames());
  editor.session.startAdding(editor.preview.take(), title);
}

void closePreview(Editor& editor) {
  editor.preview.close();
  editor.preview_selection.clear();
  if (!editor.session.document().imported) editor.waiting_clouds.clear();  // came with the model that was given up
}

void runPreviewKeys(Editor& editor) {
  if (ImGui::GetIO().WantTextInput || ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup)) return;
  if (keyboard::pressed(kKeyEnter) || keyboard::pressed(kKeyPadEnter))
    acceptPreview(editor);
  else if (keyboard::pressed('F'))
    editor.frameSelection();
}

}  // namespace standpoint
