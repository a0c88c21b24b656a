// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ply/ply_file_header.h"

#include <algorithm>
#include <optional>
#include <string_view>

namespace standpoint {

namespace {

constexpr std::uint64_t kMaxHeader = 1U << 20U;

// Lines end as the first one does: after a CR alone the data may begin with a byte that looks like LF.
class Lines {
 public:
  explicit Lines(std::string_view text) : text_(text) {}
  std::optional<std::string_view> next() {
    const auto end = text_.find_first_of("\r\n", at_);
    if (end == std::string_view::npos) return std::nullopt;
    const auto line = text_.substr(at_, end - at_);
    if (count_++ == 0) end_bytes_ = text_.substr(end).starts_with("\r\n") ? 2 : 1;
    at_ = std::min(end + (text_[end] == '\n' ? 1 : end_bytes_), text_.size());
    return line;
  }
  std::size_t at() const { return at_; }
  std::size_t count() const { return count_; }

 private:
  std::string_view text_;
  std::size_t at_ = 0, count_ = 0, end_bytes_ = 1;
};

// "comment TextureFile brick.png": what it names, or nothing.
std::string textureFile(std::string_view line) {
  constexpr std::string_view kSpace = " \t";
  for (const std::string_view word : {"comment", "TextureFile"}) {
    line.remove_prefix(std::min(line.find_first_not_of(kSpace), line.size()));
    if (!line.starts_with(word) || line.find_first_of(kSpace) != word.size()) return {};
    line.remove_prefix(word.size());
  }
  const auto first = line.find_first_not_of(kSpace);
  return first == line.npos ? std::string()
                            : std::string(line.substr(first, line.find_last_not_of(kSpace) - first + 1));
}

Result<void> checkCounts(const PlyFileHeader& header, std::uint64_t file_size, const std::string& name) {
  for (const auto& e : header.elements) {
    const auto least = e.leastBytes(header.form == PlyForm::text), there = file_size - header.bytes;
    if (least > 0 && e.count > (there + 1) / least)
      return failure(ErrorKind::unusable,
                     "says " + std::to_string(e.count) + " of " + e.name + ", but the file has data for at most " +
                         std::to_string((there + 1) / least) + ": the file is truncated",
                     name + " line " + std::to_string(e.line));
  }
  return {};
}

}  // namespace

Result<PlyFileHeader> readPlyHeader(const FileBytes& bytes, const std::string& name) {
  std::string text(static_cast<std::size_t>(std::min(bytes.size(), kMaxHeader)), '\0');
  TRY(bytes.read(0, text.data(), text.size()));
  Lines lines(text);
  PlyHeaderLines header;
  PlyFileHeader result;
  const auto fault = [&](const std::string& message) {
    return failure(ErrorKind::unusable, message,
                   name + " line " + std::to_string(std::max<std::size_t>(1, lines.count())));
  };
  for (bool more = true; more;) {
    const auto line = lines.next();
    if (!line) return fault("the header has no end_header within 1 MiB");
    const auto taken = header.take(*line);
    if (!taken) return fault(taken.error().message);
    more = *taken;
    if (auto texture = textureFile(*line); !texture.empty()) result.texture_files.push_back(std::move(texture));
  }
  static_cast<PlyHeader&>(result) = header.header();
  result.bytes = lines.at();
  result.lines = lines.count();
  TRY(checkCounts(result, bytes.size(), name));
  return result;
}

}  // namespace standpoint
