// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/ply/ply_header.h"

#include <algorithm>
#include <utility>

#include "pointclouds/files/number_text.h"
#include "pointclouds/files/scan_text.h"

namespace standpoint::ply {
namespace {

constexpr std::size_t kMostElements = 100, kMostProperties = 1000;
constexpr std::uint64_t kShortestVertex = 5;  // bytes of a line of text: "0 0 0"

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
  bool has_list = false;
  std::size_t bytes = 0;
};

std::vector<std::string_view> words(std::string_view line) {
  std::vector<std::string_view> found;
  for (line = trimmed(line); !line.empty() && found.size() < 8; line = trimmed(line)) {
    const auto end = std::min(line.find_first_of(" \t"), line.size());
    found.push_back(line.substr(0, end));
    line.remove_prefix(end);
  }
  return found;
}

std::string lowered(std::string_view name) {
  std::string text(name);
  for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return text;
}

std::optional<std::size_t> named(const std::vector<Property>& properties,
                                 std::initializer_list<std::string_view> wanted) {
  for (const auto name : wanted)
    for (std::size_t i = 0; i < properties.size(); ++i)
      if (lowered(properties[i].name) == name) return i;
  return std::nullopt;
}

class HeaderReader {
 public:
  explicit HeaderReader(LineReader& lines) : lines_(lines) {}
  Result<Header> read();

 private:
  tl::unexpected<Error> broken(const std::string& what) const {
    return failure(ErrorKind::unusable, what, lines_.place());
  }
  Result<bool> takeLine(std::string_view line);  // false after end_header
  Result<void> takeFormat(const std::vector<std::string_view>& parts);
  Result<void> takeProperty(const std::vector<std::string_view>& parts);
  Result<void> place();
  Result<void> assignRoles();

  LineReader& lines_;
  Header header_;
  bool has_format_ = false;
  std::vector<Element> elements_;
};

Result<void> HeaderReader::takeFormat(const std::vector<std::string_view>& parts) {
  const std::string_view name = parts.size() > 1 ? parts[1] : "";
  has_format_ = true;
  if (name == "ascii") return header_.encoding = Encoding::ascii, Result<void>{};
  if (name == "binary_little_endian") return header_.encoding = Encoding::little_endian, Result<void>{};
  if (name == "binary_big_endian") return header_.encoding = Encoding::big_endian, Result<void>{};
  return broken("format must be ascii, binary_little_endian or binary_big_endian");
}

Result<void> HeaderReader::takeProperty(const std::vector<std::string_view>& parts) {
  if (elements_.empty()) return broken("a property without an element");
  Element& element = elements_.back();
  if (parts.size() >= 5 && parts[1] == "list") return element.has_list = true, Result<void>{};
  if (parts.size() < 3) return broken("a property requires a type and a name");
  const auto type = plyType(parts[1]);
  if (!type) return broken(std::string(parts[1]) + " is not a property type");
  if (element.properties.size() == kMostProperties) return broken("an element has too many properties");
  element.properties.push_back({std::string(parts[2]), *type, element.bytes});
  element.bytes += sizeOf(*type);
  return {};
}

Result<bool> HeaderReader::takeLine(std::string_view line) {
  if (line.starts_with(kOurComment))
    return header_.ours |= takeScanLine(line.substr(std::string_view(kOurComment).size()), header_.scan), true;
  const auto parts = words(line);
  if (parts.empty() || parts[0] == "comment" || parts[0] == "obj_info") return true;
  if (parts[0] == "end_header") return false;
  if (parts[0] == "format") return takeFormat(parts).map([] { return true; });
  if (parts[0] == "property") return takeProperty(parts).map([] { return true; });
  if (parts[0] != "element") return broken("unknown PLY header entry '" + std::string(parts[0].substr(0, 40)) + "'");
  const auto count = parts.size() == 3 ? numberFrom<std::uint64_t>(parts[2]) : std::nullopt;
  if (!count) return broken("an element requires a name and a count");
  if (elements_.size() == kMostElements) return broken("there are too many elements");
  elements_.push_back({std::string(parts[1]), *count, {}, false, 0});
  return true;
}

// Finds where the vertices begin, and whether the file has room for them.
Result<void> HeaderReader::place() {
  std::uint64_t left = lines_.left();
  for (const Element& element : elements_) {
    const bool ascii = header_.encoding == Encoding::ascii, wanted = element.name == "vertex";
    if (element.has_list && wanted) return broken("vertices with list properties are not supported");
    const std::uint64_t each = ascii ? (wanted ? kShortestVertex : 1) : element.bytes;
    if (!wanted && element.has_list && !ascii && element.count > 0)
      return broken("lists of '" + element.name + "' before the vertices are not supported");
    // The last line may lack its end.
    if (each > 0 && element.count > (left + (ascii ? 1 : 0)) / each)
      return broken("the file is truncated: it has no space for " + std::to_string(element.count) + " elements '" +
                    element.name + "'");
    if (wanted) {
      header_.vertices = element.count;
      header_.properties = element.properties;
      header_.vertex_bytes = element.bytes;
      return {};
    }
    if (ascii) header_.skipped_lines += element.count;
    left -= std::min(left, each * element.count);
    if (!ascii) header_.vertices_at += each * element.count;
  }
  return broken("the file contains no vertices");
}

Result<void> HeaderReader::assignRoles() {
  using F = PointField;
  const auto& properties = header_.properties;
  constexpr std::pair<F, std::array<const char*, 4>> kNames[] = {
      {F::x, {"x"}},
      {F::y, {"y"}},
      {F::z, {"z"}},
      {F::intensity, {"scalar_intensity", "intensity", "scalar_reflectance", "reflectance"}},
      {F::red, {"red", "r", "diffuse_red"}},
      {F::green, {"green", "g", "diffuse_green"}},
      {F::blue, {"blue", "b", "diffuse_blue"}},
      {F::label, {"scalar_label"}},
      {F::product, {"scalar_product"}},
      {F::row, {"scalar_row"}},
      {F::column, {"scalar_column"}},
      {F::time, {"scalar_time"}},
      {F::return_number, {"scalar_returnnumber"}},
      {F::return_count, {"scalar_numberofreturns"}},
      {F::true_x, {"scalar_truex"}},
      {F::true_y, {"scalar_truey"}},
      {F::true_z, {"scalar_truez"}},
      {F::true_range, {"scalar_truerange"}},
      {F::incidence, {"scalar_incidence"}},
      {F::received_power, {"scalar_receivedpower"}},
      {F::flags, {"scalar_flags"}}};
  for (const auto& [field, names] : kNames)
    for (const char* name : names)
      if (name && !header_.places[field]) header_.places[field] = named(properties, {name});
  for (int k = 0; k < 3; ++k)
    if (!header_.places.at[static_cast<std::size_t>(k)])
      return broken(std::string("a vertex has no property '") + "xyz"[k] + "'");
  // Colours are bytes, 16 bits or shares of 1.
  for (std::size_t k = 0; k < 3; ++k)
    if (const auto at = header_.places.at[static_cast<std::size_t>(F::red) + k]) {
      const PlyType type = properties[*at].type;
      const bool is_real = type == PlyType::float32 || type == PlyType::float64;
      header_.places.colour_scale[k] = is_real ? 255 : type == PlyType::uint16 ? 1.0 / 257 : 1;
    }
  return {};
}

Result<Header> HeaderReader::read() {
  TRY_ASSIGN(const auto first, lines_.next());
  if (!first || trimmed(*first) != "ply") return broken("is not a PLY file");
  for (;;) {
    TRY_ASSIGN(const auto line, lines_.next());
    if (!line) return broken("the file is truncated inside its header");
    TRY_ASSIGN(const auto more, takeLine(*line));
    if (!more) break;
  }
  if (!has_format_) return broken("the header has no format");
  for (const Element& element : elements_)
    if (element.name == "face" || element.name == "tristrips")
      header_.faces += std::min<std::uint64_t>(element.count, 1ULL << 60);
  header_.vertices_at = lines_.at();
  TRY(place());
  TRY(assignRoles());
  return header_;
}

}  // namespace

Result<Header> readHeader(LineReader& lines) { return HeaderReader(lines).read(); }

}  // namespace standpoint::ply
