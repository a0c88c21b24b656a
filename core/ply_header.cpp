// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/ply_header.h"

#include <algorithm>
#include <charconv>

namespace standpoint {

namespace {

constexpr std::size_t kMostElements = 100, kMostProperties = 1000;
constexpr std::string_view kSpace = " \t\r";

std::vector<std::string_view> wordsOf(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::size_t at = 0; (at = line.find_first_not_of(kSpace, at)) != line.npos;) {
    const auto end = std::min(line.find_first_of(kSpace, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = end;
  }
  return words;
}

std::string shown(std::string_view word) { return "'" + std::string(word.substr(0, 40)) + "'"; }

tl::unexpected<Error> broken(std::string what) { return failure(ErrorKind::unusable, std::move(what)); }

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

Result<bool> PlyHeaderLines::take(std::string_view line) {
  const auto words = wordsOf(line);
  if (++lines_ == 1) {
    if (words != std::vector<std::string_view>{"ply"}) return broken("is not a PLY file");
    return true;
  }
  if (words.empty()) return true;
  if (words[0] != "end_header") {
    TRY(statement(words));
    return true;
  }
  if (!has_format_) return broken("the header has no format");
  return false;
}

Result<void> PlyHeaderLines::statement(const std::vector<std::string_view>& words) {
  if (words[0] == "format") return format(words);
  if (words[0] == "element") return element(words);
  if (words[0] == "property") return property(words);
  if (words[0] == "comment" || words[0] == "obj_info") return {};
  return broken("unknown PLY header entry " + shown(words[0]));
}

Result<void> PlyHeaderLines::format(const std::vector<std::string_view>& words) {
  has_format_ = true;
  const std::string_view name = words.size() > 1 ? words[1] : "";
  if (name == "ascii")
    header_.form = PlyForm::text;
  else if (name == "binary_little_endian")
    header_.form = PlyForm::little_endian;
  else if (name == "binary_big_endian")
    header_.form = PlyForm::big_endian;
  else
    return broken("format must be ascii, binary_little_endian or binary_big_endian");
  return {};
}

Result<void> PlyHeaderLines::element(const std::vector<std::string_view>& words) {
  if (words.size() != 3) return broken("an element requires a name and a count");
  PlyElement e{std::string(words[1]), 0, {}, lines_};
  const auto text = words[2];
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), e.count);
  if (error != std::errc() || end != text.data() + text.size()) return broken(shown(text) + " is not a count");
  if (std::any_of(header_.elements.begin(), header_.elements.end(),
                  [&](const PlyElement& other) { return other.name == e.name; }))
    return broken("duplicate element " + shown(e.name));
  if (header_.elements.size() == kMostElements)
    return broken("more than " + std::to_string(kMostElements) + " elements");
  header_.elements.push_back(std::move(e));
  return {};
}

Result<void> PlyHeaderLines::property(const std::vector<std::string_view>& words) {
  if (header_.elements.empty()) return broken("property before the first element");
  const bool list = words.size() == 5 && words[1] == "list";
  if (!list && words.size() != 3) return broken("a property requires a type and a name");
  const auto type = plyType(words[list ? 3 : 1]);
  if (!type) return broken(shown(words[list ? 3 : 1]) + " is not a property type");
  const auto count_type = list ? plyType(words[2]) : std::nullopt;
  if (list && !count_type) return broken(shown(words[2]) + " is not a property type");
  if (count_type == PlyType::float32 || count_type == PlyType::float64)
    return broken("list count must not be a floating-point type");
  if (++properties_ > kMostProperties) return broken("more than " + std::to_string(kMostProperties) + " properties");
  header_.elements.back().properties.push_back({std::string(words.back()), *type, count_type});
  return {};
}

}  // namespace standpoint
