// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ply/ply_header.h"

#include <algorithm>
#include <charconv>
#include <string_view>

#include "importers/files/text_pieces.h"

namespace standpoint {

namespace {

constexpr std::uint64_t kMaxHeader = 1U << 20U;
constexpr std::size_t kMaxProperties = 1000;

std::vector<std::string> words(std::string_view line) {
  std::vector<std::string> result;
  for (std::size_t at = 0; (at = line.find_first_not_of(" \t", at)) != std::string_view::npos;) {
    const auto end = std::min(line.find_first_of(" \t", at), line.size());
    result.emplace_back(line.substr(at, end - at));
    at = end;
  }
  return result;
}

class HeaderReader {
 public:
  HeaderReader(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  Result<PlyHeader> run(std::uint64_t file_size) {
    for (;;) {
      const auto line = nextLine();
      if (!line) return fault("the header has no end_header within 1 MiB");
      const auto w = words(*line);
      if (w.empty()) continue;
      if (w[0] == "end_header") break;
      TRY(statement(w, *line));
    }
    out_.bytes = at_;
    out_.lines = lines_;
    if (!has_format_) return fault("the header has no format");
    for (const auto& e : out_.elements) {
      const auto least = e.leastBytes(out_.form == PlyForm::text), there = file_size - out_.bytes;
      if (least > 0 && e.count > (there + 1) / least)
        return failure(ErrorKind::unusable,
                       "says " + std::to_string(e.count) + " of " + e.name + ", but the file has data for at most " +
                           std::to_string((there + 1) / least) + ": the file is truncated",
                       name_ + " line " + std::to_string(e.line));
    }
    return std::move(out_);
  }

 private:
  tl::unexpected<Error> fault(std::string message) const {
    return failure(ErrorKind::unusable, std::move(message), name_ + " line " + std::to_string(lines_));
  }

  // Ends as the first one does: after a CR alone the data may begin with a byte that looks like LF.
  std::optional<std::string_view> nextLine() {
    const auto end = text_.find_first_of("\r\n", at_);
    if (end == std::string_view::npos) return std::nullopt;
    const auto line = text_.substr(at_, end - at_);
    if (lines_++ == 0) line_end_bytes_ = text_.substr(end).starts_with("\r\n") ? 2 : 1;
    at_ = std::min(end + (text_[end] == '\n' ? 1 : line_end_bytes_), text_.size());
    return line;
  }

  Result<void> statement(const std::vector<std::string>& w, std::string_view line) {
    if (lines_ == 1) return {};  // "ply", which is how the file was recognised
    if (w[0] == "format") return format(w);
    if (w[0] == "element") return element(w);
    if (w[0] == "property") return property(w);
    if (w[0] == "comment" && w.size() > 2 && w[1] == "TextureFile") {
      const auto at = line.find("TextureFile") + 11;
      const auto first = line.find_first_not_of(" \t", at);
      out_.texture_files.emplace_back(line.substr(first, line.find_last_not_of(" \t") - first + 1));
    }
    if (w[0] == "comment" || w[0] == "obj_info") return {};
    return fault(inQuotes(w[0]) + " is not a PLY header keyword");
  }

  Result<void> format(const std::vector<std::string>& w) {
    has_format_ = true;
    if (w.size() > 1 && w[1] == "ascii")
      out_.form = PlyForm::text;
    else if (w.size() > 1 && w[1] == "binary_little_endian")
      out_.form = PlyForm::little_endian;
    else if (w.size() > 1 && w[1] == "binary_big_endian")
      out_.form = PlyForm::big_endian;
    else
      return fault("format must be ascii, binary_little_endian or binary_big_endian");
    return {};
  }

  Result<void> element(const std::vector<std::string>& w) {
    PlyElement e;
    if (w.size() != 3) return fault("an element requires a name and a count");
    const auto [end, error] = std::from_chars(w[2].data(), w[2].data() + w[2].size(), e.count);
    if (error != std::errc() || end != w[2].data() + w[2].size()) return fault(inQuotes(w[2]) + " is not a count");
    e.name = w[1];
    e.line = lines_;
    if (std::any_of(out_.elements.begin(), out_.elements.end(),
                    [&](const PlyElement& other) { return other.name == e.name; }))
      return fault("duplicate element " + e.name.substr(0, 40));
    out_.elements.push_back(std::move(e));
    return {};
  }

  Result<void> property(const std::vector<std::string>& w) {
    if (out_.elements.empty()) return fault("property before the first element");
    const bool list = w.size() == 5 && w[1] == "list";
    if (!list && w.size() != 3) return fault("a property requires a type and a name");
    const auto type = plyType(w[list ? 3 : 1]);
    const auto count_type = list ? plyType(w[2]) : std::nullopt;
    if (!type || (list && !count_type)) return fault("unknown property type");
    if (count_type == PlyType::float32 || count_type == PlyType::float64)
      return fault("list count must not be a floating-point type");
    if (++properties_ > kMaxProperties) return fault("more than 1000 properties");
    out_.elements.back().properties.push_back({w.back(), *type, count_type});
    return {};
  }

  std::string_view text_;
  const std::string& name_;
  std::size_t at_ = 0, lines_ = 0, line_end_bytes_ = 1, properties_ = 0;
  bool has_format_ = false;
  PlyHeader out_;
};

}  // namespace

bool PlyElement::hasLists() const {
  return std::any_of(properties.begin(), properties.end(),
                     [](const PlyProperty& p) { return p.count_type.has_value(); });
}

std::uint64_t PlyElement::leastBytes(bool text) const {
  std::uint64_t sum = 0;
  for (const auto& p : properties) sum += text ? 2 : sizeOf(p.count_type.value_or(p.type));  // a digit and a space
  return sum;
}

Result<PlyHeader> readPlyHeader(const FileBytes& bytes, const std::string& name) {
  std::string text(static_cast<std::size_t>(std::min(bytes.size(), kMaxHeader)), '\0');
  TRY(bytes.read(0, text.data(), text.size()));
  if (!text.starts_with("ply")) return failure(ErrorKind::unusable, "does not begin with 'ply'", name + " line 1");
  return HeaderReader(text, name).run(bytes.size());
}

}  // namespace standpoint
