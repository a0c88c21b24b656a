// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/e57/e57_document.h"

#include <array>
#include <cmath>
#include <cstring>

#include "pointclouds/files/number_text.h"
#include "pointclouds/files/raw_bytes.h"

namespace standpoint::e57 {
namespace {

constexpr std::uint64_t kLongestXml = std::uint64_t{64} << 20;  // the parsed tree takes some ten times as much

struct XmlPlace {
  std::uint64_t logical = 0, length = 0;
};

Result<XmlPlace> readHeader(PagedReader& file) {
  const std::string source = file.name() + " header";
  std::array<std::uint8_t, 48> header;
  TRY(file.read(0, header));
  if (std::memcmp(header.data(), "ASTM-E57", 8) != 0) return failure(ErrorKind::unusable, "is not an E57 file", source);
  if (load<std::uint32_t>(header.data() + 8) != 1)
    return failure(ErrorKind::unusable,
                   "E57 version " + std::to_string(load<std::uint32_t>(header.data() + 8)) +
                       " is not supported; only version 1 is",
                   source);
  if (load<std::uint64_t>(header.data() + 40) != kPageBytes)
    return failure(ErrorKind::unusable, "pages are not 1024 bytes long", source);
  const auto length = load<std::uint64_t>(header.data() + 16);
  if (length > file.physicalSize())
    return failure(
        ErrorKind::unusable,
        "the file is truncated: " + std::to_string(file.physicalSize()) + " of " + std::to_string(length) + " bytes",
        source);
  const auto offset = load<std::uint64_t>(header.data() + 24), xml_length = load<std::uint64_t>(header.data() + 32);
  if (offset >= file.physicalSize() || offset % kPageBytes >= kPayloadBytes ||
      xml_length > file.logicalSize() - logicalFrom(offset) || xml_length > kLongestXml)
    return failure(ErrorKind::unusable, "the XML section is outside the file or larger than 64 MiB", source);
  return XmlPlace{logicalFrom(offset), xml_length};
}

}  // namespace

Result<Document> openDocument(const std::filesystem::path& path) {
  TRY_ASSIGN(auto file, PagedReader::open(path));
  TRY_ASSIGN(const auto place, readHeader(file));
  std::string xml(place.length, '\0');
  TRY(file.read(place.logical, {reinterpret_cast<std::uint8_t*>(xml.data()), xml.size()}));
  // Some writers count the padding of the last page in.
  xml.resize(xml.find_last_not_of('\0') + 1);
  TRY_ASSIGN(auto root, parseXml(xml, file.name()));
  if (root->name != "e57Root")
    return failure(ErrorKind::unusable, "the XML's root is <" + root->name + ">, not <e57Root>", file.name());
  return Document{std::move(file), std::move(root)};
}

double real(const Element* element, double otherwise) {
  if (!element) return otherwise;
  const auto number = [&](std::string_view text, double empty) {
    if (trimmed(text).empty()) return empty;
    const double value = numberFrom<double>(text).value_or(otherwise);
    return std::isfinite(value) ? value : otherwise;
  };
  const double raw = number(element->text, 0);
  if (element->attribute("type") != "ScaledInteger") return raw;
  return raw * number(element->attribute("scale"), 1) + number(element->attribute("offset"), 0);
}

std::string text(const Element& parent, std::string_view name) {
  const Element* const child = parent.child(name);
  return child ? child->text : std::string{};
}

}  // namespace standpoint::e57
