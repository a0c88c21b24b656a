// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "importers/files/file_bytes.h"

namespace standpoint {

// A DXF text is a list of these: a line with a code, a line with a value.
struct DxfGroup {
  int code = 0;
  std::string_view value;  // without the spaces around it, until the next group
  std::size_t line = 0;    // of the value, from 1
};

// The groups of a file one after the other, through a buffer. Lines end in LF or CR LF, or all of them in CR.
class DxfGroups {
 public:
  DxfGroups(const FileBytes& bytes, std::string file) : bytes_(bytes), file_(std::move(file)) {}

  // False at the end of the file.
  Result<bool> next(DxfGroup& group);
  tl::unexpected<Error> fault(std::size_t line, std::string message) const;
  double readShare() const { return static_cast<double>(next_) / static_cast<double>(bytes_.size()); }
  std::size_t line() const { return line_; }

 private:
  Result<bool> readLine(std::string_view& text);
  Result<bool> refill();

  const FileBytes& bytes_;
  std::string file_;
  std::uint64_t next_ = 0;
  std::string buffer_;
  std::size_t at_ = 0, line_ = 0;
  char line_end_ = '\0';  // not yet known
};

}  // namespace standpoint
