// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/history.h"

#include <algorithm>
#include <utility>

namespace standpoint {

History::History(Document initial, std::string description) {
  entries_.push_back({std::move(initial), std::move(description), {}});
}

void History::push(Document document, std::string description) {
  if (document == current()) return;
  add({std::move(document), std::move(description), shown()});
}

void History::pushShown(std::any shown, std::string description) {
  add({current(), std::move(description), std::move(shown)});
}

void History::add(Entry entry) {
  entries_.resize(position_ + 1);
  if (saved_ != kNeverSaved && saved_ > position_) saved_ = kNeverSaved;  // the saved value can no longer be reached
  entries_.push_back(std::move(entry));
  ++position_;
}

void History::undo() {
  if (canUndo()) --position_;
}

void History::redo() {
  if (canRedo()) ++position_;
}

void History::goTo(std::size_t step) {
  if (step < entries_.size()) position_ = step;
}

bool History::modified() const {
  return saved_ == kNeverSaved || !(entries_[saved_].document == entries_[position_].document);
}

std::size_t History::unsavedChanges() const {
  const std::size_t saved = saved_ == kNeverSaved ? 0 : saved_;
  std::size_t changes = saved_ == kNeverSaved ? 1 : 0;  // how it began
  for (std::size_t i = std::min(saved, position_); i < std::max(saved, position_); ++i)
    if (!(entries_[i].document == entries_[i + 1].document)) ++changes;
  return changes;
}

std::string History::undoDescription() const { return canUndo() ? entries_[position_].description : std::string(); }

std::string History::redoDescription() const { return canRedo() ? entries_[position_ + 1].description : std::string(); }

}  // namespace standpoint
