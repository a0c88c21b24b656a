// SPDX-License-Identifier: GPL-3.0-or-later
// STL, binary and text. Facets become indexed triangles by welding corners that are equal bit for bit; their normals
// are not read, since the order of the corners says the same. Neither unit nor upright axis is in the format: metres
// and Z.
#include "importers/stl/stl.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <new>
#include <unordered_map>

#include "importers/files/byte_stream.h"
#include "importers/soup/face_colours.h"
#include "importers/soup/face_soup.h"
#include "importers/stl/stl_text.h"

namespace standpoint {

namespace {

constexpr std::size_t kHeaderBytes = 84, kFacetBytes = 50;
constexpr float kLargestStl = 1e13F;

std::uint32_t littleEndian32(const char* p) {
  std::uint32_t v = 0;
  for (unsigned i = 0; i < 4; ++i) v |= std::uint32_t{static_cast<unsigned char>(p[i])} << 8U * i;
  return v;
}

// VisCAM and SolidView put 15 bits of colour and a bit that says so into the word after a facet; Magics, which says
// COLOR= in the header, turns their order and the bit around.
class AttributeColours {
 public:
  explicit AttributeColours(std::string_view header) {
    const auto at = header.find("COLOR=");
    magics_ = at != std::string_view::npos && at + 10 <= header.size();
    if (!magics_) return;
    for (std::size_t i = 6; i < 9; ++i) default_ = default_ << 8U | static_cast<unsigned char>(header[at + i]);
  }

  std::uint32_t operator()(std::uint32_t word) const {
    const bool marked = (word & 0x8000U) != 0;
    if (magics_ && marked) return default_;
    if (!magics_ && !marked) return kNoFaceColour;
    const std::uint32_t low = eightBits(word), middle = eightBits(word >> 5U), high = eightBits(word >> 10U);
    return magics_ ? low << 16U | middle << 8U | high : high << 16U | middle << 8U | low;
  }

 private:
  static std::uint32_t eightBits(std::uint32_t five) { return (five & 31U) * 255 / 31; }

  bool magics_ = false;
  std::uint32_t default_ = 0;
};

Result<void> readBinary(const FileBytes& bytes, const std::string& name, StlSoup& out, Report& report,
                        Progress& progress) {
  char header[kHeaderBytes];
  if (auto ok = bytes.read(0, header, kHeaderBytes); !ok) return ok;
  const std::uint64_t count = littleEndian32(header + 80), there = (bytes.size() - kHeaderBytes) / kFacetBytes;
  if (count > there)
    return failure(ErrorKind::unusable,
                   "says " + std::to_string(count) + " triangles, but has data for " + std::to_string(there) +
                       ": the file is truncated",
                   name + " byte 80");
  if (const auto rest = bytes.size() - kHeaderBytes - count * kFacetBytes; rest > 0)
    report.warn("byte " + std::to_string(bytes.size() - rest),
                std::to_string(rest) + " bytes after the last triangle were skipped");
  const AttributeColours colours(std::string_view(header, 80));
  out.begin(name.substr(0, name.rfind('.')), count);
  ByteStream stream(bytes, kHeaderBytes);
  for (std::uint64_t i = 0; i < count; ++i) {
    const char* p = stream.take(kFacetBytes);
    if (p == nullptr) return failure(*stream.error());
    for (std::size_t k = 0; k < 3; ++k) {
      std::array<float, 3> v;
      for (std::size_t axis = 0; axis < 3; ++axis)
        v[axis] = std::bit_cast<float>(littleEndian32(p + 12 + 12 * k + 4 * axis));
      for (const float x : v)
        if (!(std::abs(x) <= kLargestStl))
          return failure(ErrorKind::unusable, "a coordinate is not a finite number below 1e13",
                         name + " triangle " + std::to_string(i + 1));
      out.corner({v[0], v[1], v[2]});
    }
    out.colour(colours(littleEndian32(p + 46) >> 16U));
    out.endFacet(0);
    if ((i & 0xFFFFU) != 0) continue;
    progress.advance(0.6 * static_cast<double>(i) / static_cast<double>(count));
    if (auto ok = progress.check(); !ok) return ok;
  }
  return {};
}

// Of a file that is called .stl: binary, whole or not, and no text. Many binary files begin with "solid" too.
bool isBinaryStl(const FileBytes& bytes) {
  if (hasSizeOfBinaryStl(bytes)) return true;
  char head[512];
  const auto got = static_cast<std::size_t>(std::min<std::uint64_t>(bytes.size(), sizeof head));
  if (!bytes.read(0, head, got)) return false;
  const std::string_view text(head, got);
  const auto first = text.find_first_not_of(" \t\r\n");
  const bool begins_as_text = first != std::string_view::npos &&
                              (text.substr(first).starts_with("solid") || text.substr(first).starts_with("SOLID"));
  return got >= kHeaderBytes && (!begins_as_text || text.find('\0') != std::string_view::npos);
}

Result<ImportedModel> readImported(const std::filesystem::path& path, const ImportOptions& options,
                                   Progress& progress) {
  const std::string name = path.filename().string();
  TRY_ASSIGN(const auto bytes, FileBytes::open(path));
  Report report;
  StlSoup out;
  const bool binary = isBinaryStl(bytes);
  TRY(binary ? readBinary(bytes, name, out, report, progress) : readStlText(bytes, name, out, report, progress));
  const auto lines = out.takeLines();
  auto soup = std::move(out).soup();
  soup.place = [&](std::size_t face) {
    return binary ? "triangle " + std::to_string(face + 1) : "line " + std::to_string(lines[face]);
  };
  return modelFrom(std::move(soup), kStlImporter.up, options, std::move(report), progress);
}

Result<ImportedModel> readStl(const std::filesystem::path& path, const ImportOptions& options, Progress& progress) {
  progress.stage("Reading STL");
  try {
    return readImported(path, options, progress);
  } catch (const std::bad_alloc&) {
    return failure(ErrorKind::unusable, "not enough memory", path.filename().string());
  }
}

constexpr const char* kStlExtensions[] = {".stl"};

}  // namespace

bool hasSizeOfBinaryStl(const FileBytes& bytes) {
  char head[kHeaderBytes];
  return bytes.size() >= kHeaderBytes && bytes.read(0, head, kHeaderBytes) &&
         bytes.size() == kHeaderBytes + kFacetBytes * std::uint64_t{littleEndian32(head + 80)};
}

const Importer kStlImporter = {"stl", "STL, binary and text", kStlExtensions, &readStl, UpAxis::z};

}  // namespace standpoint
