// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/files/line_reader.h"

namespace standpoint {
namespace {
constexpr std::size_t kPiece = 1 << 20;
constexpr std::size_t kLongestLine = 65536;
}  // namespace

double LineReader::fraction() const {
  return file_.size() == 0 ? 1 : 1 - static_cast<double>(left()) / static_cast<double>(file_.size());
}

Result<bool> LineReader::more() {
  text_.erase(0, from_);
  from_ = 0;
  const std::size_t kept = text_.size();
  text_.resize(kept + kPiece);
  TRY_ASSIGN(const auto n, file_.read(at_, {reinterpret_cast<std::uint8_t*>(text_.data()) + kept, kPiece}));
  text_.resize(kept + n);
  at_ += n;
  return n > 0;
}

Result<std::optional<std::string_view>> LineReader::next() {
  std::size_t end = text_.find('\n', from_);
  if (end == std::string::npos && text_.size() - from_ < kLongestLine) {
    TRY(more());
    end = text_.find('\n', from_);
  }
  if (end == std::string::npos && from_ == text_.size()) return std::nullopt;
  ++line_;
  const std::size_t stop = end == std::string::npos ? text_.size() : end;
  if (stop - from_ >= kLongestLine)
    return failure(ErrorKind::unusable, "line too long: not a text point file", place());
  const std::string_view line(text_.data() + from_, stop - from_);
  from_ = end == std::string::npos ? stop : end + 1;
  return line;
}

}  // namespace standpoint
