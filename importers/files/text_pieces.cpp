// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/files/text_pieces.h"

#include <algorithm>

namespace standpoint {

namespace {

constexpr std::size_t kBefore = 3;  // "\\\r\n" before a piece decides whether it begins a line
constexpr std::size_t kMore = 1U << 16U;

// The first index >= at of `text` where a statement may begin: after LF, or CR without LF, that no backslash precedes.
// npos when it is not within text. The last character must not be judged before what follows it is known.
std::size_t cutAfter(const std::string& text, std::size_t at, bool is_whole_file_end) {
  for (std::size_t i = at; i < text.size() || (is_whole_file_end && i == text.size()); ++i) {
    if (i == 0) return 0;
    const char last = text[i - 1];
    if (last != '\n' && last != '\r') continue;
    if (last == '\r' && i < text.size() && text[i] == '\n') continue;
    const std::size_t end = last == '\n' && i >= 2 && text[i - 2] == '\r' ? i - 2 : i - 1;
    if (end == 0 || text[end - 1] != '\\') return i;
  }
  return std::string::npos;
}

}  // namespace

std::string inQuotes(std::string_view word, std::size_t most) {
  std::string text;
  text.reserve(std::min(word.size(), most) + 2);
  text += '\'';
  text += word.substr(0, most);
  text += '\'';
  return text;
}

Result<std::string> textPiece(const FileBytes& bytes, std::uint64_t from, std::size_t size) {
  const std::uint64_t before = std::min<std::uint64_t>(from, kBefore);
  std::uint64_t end = std::min<std::uint64_t>(from + size, bytes.size());
  std::string text(static_cast<std::size_t>(end - from + before), '\0');
  TRY(bytes.read(from - before, text.data(), text.size()));
  const std::size_t nominal_end = text.size();
  const auto begin = from == 0 ? 0 : cutAfter(text, static_cast<std::size_t>(before), end == bytes.size());
  if (begin == std::string::npos || begin >= nominal_end) return std::string();
  std::size_t cut = std::string::npos;
  while (end < bytes.size()) {
    const std::size_t look = text.size();
    const auto more = static_cast<std::size_t>(
        std::min<std::uint64_t>(std::max<std::size_t>(kMore, text.size() / 2), bytes.size() - end));
    text.resize(text.size() + more);
    TRY(bytes.read(end, text.data() + text.size() - more, more));
    end += more;
    cut = cutAfter(text, look, end == bytes.size());
    if (cut != std::string::npos) break;
  }
  if (cut != std::string::npos) text.resize(cut);
  text.erase(0, begin);
  if (text.back() != '\n') text += '\n';
  return text;
}

}  // namespace standpoint
