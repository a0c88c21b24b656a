// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/obj_lines.h"

#include <algorithm>

namespace standpoint {

// Ends at LF, CR LF, or CR alone.
std::string_view ObjLines::physicalLine() {
  const auto end = std::min(rest_.find_first_of("\r\n"), rest_.size());
  const auto line = rest_.substr(0, end);
  const bool pair = rest_.substr(end).starts_with("\r\n");
  rest_.remove_prefix(std::min(end + (pair ? 2 : 1), rest_.size()));
  ++lines_read_;
  return line;
}

void ObjLines::nextStatement() {
  statement_.clear();
  line_ = lines_read_ + 1;
  for (bool more = true; more && !rest_.empty();) {
    auto line = physicalLine();
    more = line.ends_with('\\');
    if (more) line.remove_suffix(1);
    statement_.append(line);
    if (more) statement_ += ' ';
  }
  statement_.resize(std::min(statement_.find('#'), statement_.size()));
  statement_.erase(std::remove(statement_.begin(), statement_.end(), '\0'), statement_.end());
  const auto first = statement_.find_first_not_of(" \t");
  const auto last = statement_.find_last_not_of(" \t");
  statement_ = first == std::string::npos ? std::string() : statement_.substr(first, last - first + 1);
}

ObjLines::int_type ObjLines::underflow() {
  while (!rest_.empty()) {
    nextStatement();
    if (statement_.empty() || !keep_(statement_)) continue;
    statement_ += '\n';
    setg(statement_.data(), statement_.data(), statement_.data() + statement_.size());
    return traits_type::to_int_type(statement_.front());
  }
  return traits_type::eof();
}

}  // namespace standpoint
