// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/citygml/citygml_text.h"

#include <charconv>

namespace standpoint {

CityGmlAttributes::CityGmlAttributes(const char** pairs) {
  for (; *pairs != nullptr; pairs += 2) {
    std::string_view key = pairs[0];
    if (const auto bar = key.rfind('|'); bar != std::string_view::npos) key.remove_prefix(bar + 1);
    std::string* member = key == "id"            ? &id
                          : key == "href"        ? &href
                          : key == "name"        ? &name
                          : key == "srsName"     ? &srs_name
                          : key == "uri"         ? &uri
                          : key == "ring"        ? &ring
                          : key == "orientation" ? &orientation
                                                 : nullptr;
    if (member != nullptr) *member = pairs[1];
  }
}

std::string_view trimmedXml(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  return first == std::string_view::npos ? std::string_view()
                                         : text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

std::string_view readNumbers(std::string_view text, std::vector<double>& numbers) {
  const auto isGap = [](char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r' || c == ','; };
  for (std::size_t i = 0; i < text.size();) {
    if (isGap(text[i])) {
      ++i;
      continue;
    }
    const std::size_t word = i;
    if (text[i] == '+') ++i;
    double number = 0;
    const auto [stop, wrong] = std::from_chars(text.data() + i, text.data() + text.size(), number);
    const auto next = static_cast<std::size_t>(stop - text.data());
    if (wrong != std::errc() || (next < text.size() && !isGap(text[next]))) return text.substr(word);
    numbers.push_back(number);
    i = next;
  }
  return {};
}

std::optional<std::string> idOfReference(std::string_view reference) {
  reference = trimmedXml(reference);
  if (reference.size() < 2 || reference[0] != '#') return std::nullopt;
  return std::string(reference.substr(1));
}

}  // namespace standpoint
