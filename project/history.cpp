// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/history.h"

#include <utility>

namespace standpoint {

History::History(Document initial, std::string description) {
  entries_.push_back({std::move(initial), std::move(description)});
}

void History::push(Document document, std::string description) {
  if (document == current()) return;
  entries_.resize(position_ + 1);
  if (saved_ != kNeverSaved && saved_ > position_) saved_ = kNeverSaved;  // the saved value can no longer be reached
  entries_.push_back({std::move(document), std::move(description)});
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

std::size_t History::unsavedChanges() const {
  if (saved_ == kNeverSaved) return position_;
  return saved_ > position_ ? saved_ - position_ : position_ - saved_;
}

std::string History::undoDescription() const { return canUndo() ? entries_[position_].description : std::string(); }

std::string History::redoDescription() const { return canRedo() ? entries_[position_ + 1].description : std::string(); }

}  // namespace standpoint
