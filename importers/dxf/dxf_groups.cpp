// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/dxf/dxf_groups.h"

#include <algorithm>
#include <charconv>

#include "importers/files/text_pieces.h"

namespace standpoint {

namespace {

constexpr std::size_t kBlock = std::size_t{1} << 18U, kLongestLine = std::size_t{1} << 20U;
constexpr int kLowestCode = -5, kHighestCode = 1071;

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kSpaces{" \t\r\0", 4};
  const auto first = text.find_first_not_of(kSpaces);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kSpaces) - first + 1);
}

}  // namespace

tl::unexpected<Error> DxfGroups::fault(std::size_t line, std::string message) const {
  return failure(ErrorKind::unusable, std::move(message), file_ + " line " + std::to_string(line));
}

Result<bool> DxfGroups::next(DxfGroup& group) {
  std::string_view text;
  TRY_ASSIGN(const bool more, readLine(text));
  if (!more) return false;
  if (line_ == 1 && text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  const std::string_view code = trimmed(text);
  const auto [end, error] = std::from_chars(code.data(), code.data() + code.size(), group.code);
  if (error != std::errc() || end != code.data() + code.size() || group.code < kLowestCode || group.code > kHighestCode)
    return fault(line_, inQuotes(code) + " is not a group code");
  TRY_ASSIGN(const bool whole, readLine(text));
  if (!whole) return fault(line_, "ends between a group code and its value: the file is truncated");
  group.value = trimmed(text);
  group.line = line_;
  return true;
}

Result<bool> DxfGroups::readLine(std::string_view& text) {
  for (std::size_t from = at_;;) {
    const auto end = line_end_ == '\0' ? std::string::npos : buffer_.find(line_end_, from);
    if (end != std::string::npos) {
      text = std::string_view(buffer_).substr(at_, end - at_);
      at_ = end + 1;
      break;
    }
    if (buffer_.size() - at_ > kLongestLine) return fault(line_ + 1, "is longer than 1 MiB");
    from = buffer_.size() - at_;
    TRY_ASSIGN(const bool more, refill());
    if (more) continue;
    if (at_ == buffer_.size()) return false;
    text = std::string_view(buffer_).substr(at_);
    at_ = buffer_.size();
    break;
  }
  ++line_;
  return true;
}

Result<bool> DxfGroups::refill() {
  if (next_ == bytes_.size()) return false;
  buffer_.erase(0, at_);
  at_ = 0;
  const std::size_t kept = buffer_.size();
  const auto more = static_cast<std::size_t>(std::min<std::uint64_t>(kBlock, bytes_.size() - next_));
  buffer_.resize(kept + more);
  TRY(bytes_.read(next_, buffer_.data() + kept, more));
  next_ += more;
  if (line_end_ == '\0')
    line_end_ = buffer_.find('\n') == std::string::npos && buffer_.find('\r') != std::string::npos ? '\r' : '\n';
  return true;
}

}  // namespace standpoint
