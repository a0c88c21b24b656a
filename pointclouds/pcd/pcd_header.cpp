// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/pcd/pcd_header.h"

#include <cmath>
#include <utility>

#include "pointclouds/files/number_text.h"
#include "pointclouds/files/scan_text.h"

namespace standpoint::pcd {
namespace {

constexpr std::size_t kMostFields = 1000;
constexpr std::uint64_t kMostPointBytes = 1 << 16;
constexpr std::string_view kOurComment = "# standpoint ";

std::vector<std::string_view> words(std::string_view line) {
  std::vector<std::string_view> found;
  for (line = trimmed(line); !line.empty() && found.size() <= kMostFields + 1; line = trimmed(line)) {
    const auto end = std::min(line.find_first_of(" \t"), line.size());
    found.push_back(line.substr(0, end));
    line.remove_prefix(end);
  }
  return found;
}

std::optional<PlyType> typeOf(char kind, std::uint32_t bytes) {
  constexpr std::pair<std::pair<char, std::uint32_t>, PlyType> kTypes[] = {
      {{'F', 4}, PlyType::float32}, {{'F', 8}, PlyType::float64}, {{'U', 1}, PlyType::uint8},
      {{'U', 2}, PlyType::uint16},  {{'U', 4}, PlyType::uint32},  {{'I', 1}, PlyType::int8},
      {{'I', 2}, PlyType::int16},   {{'I', 4}, PlyType::int32}};
  for (const auto& [key, type] : kTypes)
    if (key == std::pair(kind, bytes)) return type;
  return std::nullopt;
}

class HeaderReader {
 public:
  explicit HeaderReader(LineReader& lines) : lines_(lines) {}
  Result<Header> read();

 private:
  using Words = std::vector<std::string_view>;
  tl::unexpected<Error> broken(const std::string& what) const {
    return failure(ErrorKind::unusable, what, lines_.place());
  }
  Result<bool> takeLine(std::string_view line);  // false after DATA
  Result<void> takeList(const Words& parts);
  Result<void> takeNumber(const Words& parts);
  Result<void> takeViewpoint(const Words& parts);
  Result<void> takeData(const Words& parts);
  Result<void> layOut();
  void assignPlaces();

  LineReader& lines_;
  Header header_;
  std::string types_;
  bool has_points_ = false;
};

Result<void> HeaderReader::takeList(const Words& parts) {
  if (parts[0] == "FIELDS" || parts[0] == "COLUMNS") {
    if (parts.size() > kMostFields) return broken("there are too many fields");
    for (std::size_t i = 1; i < parts.size(); ++i) header_.fields.push_back({.name = std::string(parts[i])});
    return {};
  }
  if (parts.size() != header_.fields.size() + 1)
    return broken(std::string(parts[0]) + " has " + std::to_string(parts.size() - 1) + " entries for " +
                  std::to_string(header_.fields.size()) + " fields");
  for (std::size_t i = 1; i < parts.size(); ++i) {
    Field& field = header_.fields[i - 1];
    if (parts[0] == "TYPE") {
      types_ += parts[i][0];
      continue;
    }
    const auto number = numberFrom<std::uint32_t>(parts[i]);
    if (!number || *number == 0 || *number > kMostPointBytes)
      return broken("no size or count of a field: " + std::string(parts[i].substr(0, 40)));
    (parts[0] == "SIZE" ? field.bytes : field.count) = *number;
  }
  return {};
}

Result<void> HeaderReader::takeNumber(const Words& parts) {
  const auto number = parts.size() == 2 ? numberFrom<std::uint64_t>(parts[1]) : std::nullopt;
  constexpr std::uint64_t kMost = std::uint64_t{1} << 40;
  if (!number || *number > kMost) return broken(std::string(parts[0]) + " is not a point count");
  (parts[0] == "WIDTH" ? header_.width : parts[0] == "HEIGHT" ? header_.height : header_.points) = *number;
  has_points_ |= parts[0] == "POINTS";
  return {};
}

Result<void> HeaderReader::takeViewpoint(const Words& parts) {
  std::string line = "pose";
  for (std::size_t i = 1; i < parts.size(); ++i) line.append(1, '\t').append(parts[i]);
  if (!takeScanLine(line, header_.scan)) return broken("VIEWPOINT must be a position and a quaternion: x y z w x y z");
  return {};
}

Result<void> HeaderReader::takeData(const Words& parts) {
  const std::string_view how = parts.size() > 1 ? parts[1] : "";
  header_.binary = how == "binary";
  if (how == "binary_compressed")
    return broken(
        "compressed points are not supported: convert to binary first, for instance with `pcl_convert_pcd_ascii_binary "
        "IN OUT 1`");
  if (how != "ascii" && how != "binary") return broken("DATA is neither ascii nor binary");
  return {};
}

Result<bool> HeaderReader::takeLine(std::string_view line) {
  if (line.starts_with(kOurComment)) return takeScanLine(line.substr(kOurComment.size()), header_.scan), true;
  if (trimmed(line).empty() || trimmed(line).front() == '#') return true;
  const auto parts = words(line);
  const std::string_view key = parts[0];
  const auto more = [](Result<void> taken) { return taken.map([] { return true; }); };
  if (key == "VERSION") return true;
  if (key == "FIELDS" || key == "COLUMNS" || key == "SIZE" || key == "TYPE" || key == "COUNT")
    return more(takeList(parts));
  if (key == "WIDTH" || key == "HEIGHT" || key == "POINTS") return more(takeNumber(parts));
  if (key == "VIEWPOINT") return more(takeViewpoint(parts));
  if (key == "DATA") return takeData(parts).map([] { return false; });
  return broken("unknown PCD header entry '" + std::string(key.substr(0, 40)) + "'");
}

Result<void> HeaderReader::layOut() {
  if (header_.fields.empty() || types_.size() != header_.fields.size())
    return broken("the header lacks FIELDS or TYPE");
  for (std::size_t i = 0; i < header_.fields.size(); ++i) {
    Field& field = header_.fields[i];
    const auto type = typeOf(types_[i], field.bytes);
    field.wide_integer = !type && field.bytes == 8 && (types_[i] == 'U' || types_[i] == 'I');
    if (!type && !field.wide_integer && field.name != "_")
      return broken("field " + field.name.substr(0, 40) + " has no known type");
    field.type = type.value_or(PlyType::uint8);
    field.at = header_.point_bytes;
    field.word = header_.words;
    header_.point_bytes += std::uint64_t{field.bytes} * field.count;
    header_.words += field.count;
    if (header_.point_bytes > kMostPointBytes) return broken("a point has more than 64 KiB");
  }
  if (header_.width > 0 && header_.height > (std::uint64_t{1} << 40) / header_.width)
    return broken("WIDTH times HEIGHT is too large");
  if (!has_points_) header_.points = header_.width * header_.height;
  if (header_.points != header_.width * header_.height) return broken("POINTS is not WIDTH times HEIGHT");
  const std::uint64_t each =
      header_.binary ? header_.point_bytes : 2 * header_.words;  // the last line may lack its end
  if (header_.points > (lines_.left() + (header_.binary ? 0 : 1)) / each)
    return broken("the file is truncated: it has no space for " + std::to_string(header_.points) + " points");
  header_.points_at = lines_.at();
  return {};
}

void HeaderReader::assignPlaces() {
  using F = PointField;
  constexpr std::pair<const char*, F> kNames[] = {{"x", F::x},
                                                  {"y", F::y},
                                                  {"z", F::z},
                                                  {"intensity", F::intensity},
                                                  {"rgb", F::packed_colour},
                                                  {"rgba", F::packed_colour},
                                                  {"label", F::label},
                                                  {"instance", F::product},
                                                  {"row", F::row},
                                                  {"column", F::column},
                                                  {"time", F::time},
                                                  {"ring", F::channel},
                                                  {"return_number", F::return_number},
                                                  {"return_count", F::return_count},
                                                  {"true_x", F::true_x},
                                                  {"true_y", F::true_y},
                                                  {"true_z", F::true_z},
                                                  {"true_range", F::true_range},
                                                  {"incidence", F::incidence},
                                                  {"received_power", F::received_power},
                                                  {"flags", F::flags}};
  for (std::size_t i = 0; i < header_.fields.size(); ++i)
    for (const auto& [name, place] : kNames)
      if (header_.fields[i].name == name && !header_.fields[i].wide_integer && !header_.places[place])
        header_.places[place] = i;
}

Result<Header> HeaderReader::read() {
  for (;;) {
    TRY_ASSIGN(const auto line, lines_.next());
    if (!line) return broken("the file is truncated inside its header");
    TRY_ASSIGN(const auto more, takeLine(*line));
    if (!more) break;
  }
  TRY(layOut());
  assignPlaces();
  if (!header_.places.all(PointField::x, PointField::z)) return broken("a point has no fields x y z");
  return header_;
}

}  // namespace

Result<Header> readHeader(LineReader& lines) { return HeaderReader(lines).read(); }

}  // namespace standpoint::pcd
