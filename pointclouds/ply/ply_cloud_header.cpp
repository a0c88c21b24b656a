// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/ply/ply_cloud_header.h"

#include <algorithm>
#include <utility>

#include "pointclouds/files/scan_text.h"

namespace standpoint::ply {
namespace {

constexpr std::uint64_t kShortestVertex = 5;  // bytes of a line of text: "0 0 0"

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
  Result<void> place(const std::vector<PlyElement>& elements);
  Result<void> assignRoles();

  LineReader& lines_;
  Header header_;
};

// Finds where the vertices begin, and whether the file has room for them.
Result<void> HeaderReader::place(const std::vector<PlyElement>& elements) {
  std::uint64_t left = lines_.left();
  const bool text = header_.form == PlyForm::text;
  for (const PlyElement& element : elements) {
    const bool wanted = element.name == "vertex", lists = element.hasLists();
    if (lists && wanted) return broken("vertices with list properties are not supported");
    if (lists && !text && element.count > 0)
      return broken("lists of '" + element.name + "' before the vertices are not supported");
    const std::uint64_t each = text ? (wanted ? kShortestVertex : 1) : element.leastBytes(false);
    // The last line may lack its end.
    if (each > 0 && element.count > (left + (text ? 1 : 0)) / each)
      return broken("the file is truncated: it has no space for " + std::to_string(element.count) + " elements '" +
                    element.name + "'");
    if (wanted) {
      header_.vertices = element.count;
      for (const auto& p : element.properties) {
        header_.properties.push_back({p.name, p.type, header_.vertex_bytes});
        header_.vertex_bytes += sizeOf(p.type);
      }
      return {};
    }
    if (text) header_.skipped_lines += element.count;
    left -= std::min(left, each * element.count);
    if (!text) header_.vertices_at += each * element.count;
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
      {F::channel, {"scalar_channel"}},
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
  PlyHeaderLines header;
  for (bool more = true; more;) {
    TRY_ASSIGN(const auto line, lines_.next());
    if (!line) return broken("the file is truncated inside its header");
    const auto taken = header.take(*line);
    if (!taken) return broken(taken.error().message);
    more = *taken;
    if (line->starts_with(kOurComment))
      header_.ours |= takeScanLine(line->substr(std::string_view(kOurComment).size()), header_.scan);
  }
  const auto& elements = header.header().elements;
  header_.form = header.header().form;
  for (const PlyElement& element : elements)
    if (element.name == "face" || element.name == "tristrips")
      header_.faces += std::min<std::uint64_t>(element.count, 1ULL << 60);
  header_.vertices_at = lines_.at();
  TRY(place(elements));
  TRY(assignRoles());
  return header_;
}

}  // namespace

Result<Header> readHeader(LineReader& lines) { return HeaderReader(lines).read(); }

}  // namespace standpoint::ply
