// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "pointclouds/files/file_access.h"

namespace standpoint {

// Lines of a text file, in memory that does not grow with it.
class LineReader {
 public:
  explicit LineReader(InputFile file) : file_(std::move(file)) {}
  // Without its line end; nothing at the end of the file. The view holds until the next call. A line of 64 KiB or more
  // is an error: no such text is a point.
  Result<std::optional<std::string_view>> next();
  std::uint64_t line() const { return line_; }  // number of the last line, from 1
  std::uint64_t left() const { return file_.size() - std::min(file_.size(), at_ - (text_.size() - from_)); }  // bytes
  std::uint64_t at() const { return at_ - (text_.size() - from_); }  // in the file, of the next line
  double fraction() const;                                           // of the file that was read
  std::string place() const { return file_.name() + " line " + std::to_string(line_); }
  std::string name() const { return file_.name(); }

 private:
  Result<bool> more();
  InputFile file_;
  std::string text_;
  std::size_t from_ = 0;  // in text_
  std::uint64_t at_ = 0;  // in the file, where text_ ends
  std::uint64_t line_ = 0;
};

}  // namespace standpoint
