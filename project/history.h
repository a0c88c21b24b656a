// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <any>
#include <string>
#include <vector>

#include "project/document.h"

namespace standpoint {

// Undo is the previous value. One entry for each change, oldest first; the document's parts are shared, so an entry
// costs what changed.
class History {
 public:
  explicit History(Document initial = {}, std::string description = "New project");

  const Document& current() const { return entries_[position_].document; }
  // Drops what was undone, then adds. A change that changes nothing is not an entry.
  void push(Document document, std::string description);
  // A step in which the document stays as it is, and is shown in another way: known to whoever shows it, and in no
  // file.
  void pushShown(std::any shown, std::string description);
  const std::any& shown() const { return entries_[position_].shown; }  // as the last such step has it; empty: none
  bool canUndo() const { return position_ > 0; }
  bool canRedo() const { return position_ + 1 < entries_.size(); }
  void undo();
  void redo();
  std::string undoDescription() const;  // of what undo() would take back; "" when there is nothing
  std::string redoDescription() const;
  // The steps that there are, oldest first; the first is how it began.
  std::size_t size() const { return entries_.size(); }
  std::size_t position() const { return position_; }  // of current()
  const std::string& description(std::size_t step) const { return entries_[step].description; }
  void goTo(std::size_t step);  // undo or redo until it is the current one; nothing when there is no such step

  // For the title's "modified" mark: is the current document the one that was saved?
  void markSaved() { saved_ = position_; }
  void markUnsaved() { saved_ = kNeverSaved; }
  bool modified() const;
  bool isSaved(std::size_t step) const { return saved_ == step; }
  std::size_t unsavedChanges() const;  // of the document, between the saved one and the current one

 private:
  static constexpr std::size_t kNeverSaved = static_cast<std::size_t>(-1);
  struct Entry {
    Document document;
    std::string description;
    std::any shown;
  };
  void add(Entry entry);
  std::vector<Entry> entries_;
  std::size_t position_ = 0;
  std::size_t saved_ = 0;
};

}  // namespace standpoint
