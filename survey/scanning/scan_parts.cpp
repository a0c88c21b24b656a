// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/scanning/scan_parts.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <iterator>
#include <type_traits>

#include <nlohmann/json.hpp>

#include "pointclouds/e57/crc32c.h"
#include "pointclouds/files/file_access.h"

namespace standpoint {

namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr std::uintmax_t kLargestRecord = 1U << 16U;

// A tape is a run of pieces, each: kind, length, CRC-32C, bytes. It is read on the machine that wrote it, so numbers
// are as memory has them.
enum Piece : std::uint8_t { kBlock = 1, kPicture = 2, kEnd = 3 };

struct PieceHead {
  std::uint64_t length = 0;
  std::uint32_t crc = 0;
  std::uint32_t kind = 0;
};

constexpr std::uint64_t kLongestPiece = std::uint64_t{1} << 32U;

class Packer {
 public:
  explicit Packer(std::vector<std::uint8_t>& bytes) : bytes_(bytes) { bytes_.clear(); }
  template <class T>
  void operator()(const T& value) requires std::is_trivially_copyable_v<T> {
    put(&value, sizeof value);
  }
  template <class T>
  void operator()(const std::vector<T>& column) {
    (*this)(static_cast<std::uint64_t>(column.size()));
    put(column.data(), column.size() * sizeof(T));
  }
  void operator()(const std::string& text) {
    (*this)(static_cast<std::uint64_t>(text.size()));
    put(text.data(), text.size());
  }

 private:
  void put(const void* from, std::size_t size) {
    if (size == 0) return;
    const std::size_t at = bytes_.size();
    bytes_.resize(at + size);
    std::memcpy(bytes_.data() + at, from, size);
  }
  std::vector<std::uint8_t>& bytes_;
};

class Unpacker {
 public:
  explicit Unpacker(const std::vector<std::uint8_t>& bytes) : bytes_(bytes) {}
  bool whole() const { return good_ && at_ == bytes_.size(); }
  template <class T>
  void operator()(T& value) requires std::is_trivially_copyable_v<T> {
    take(&value, sizeof value);
  }
  template <class T>
  void operator()(std::vector<T>& column) {
    column.resize(count(sizeof(T)));
    take(column.data(), column.size() * sizeof(T));
  }
  void operator()(std::string& text) {
    text.resize(count(1));
    take(text.data(), text.size());
  }

 private:
  std::size_t count(std::size_t each) {
    std::uint64_t n = 0;
    (*this)(n);
    if (n > (bytes_.size() - at_) / each) good_ = false;
    return good_ ? n : 0;
  }
  void take(void* to, std::size_t size) {
    if (size == 0) return;
    if (!good_ || size > bytes_.size() - at_) {
      good_ = false;
      return;
    }
    std::memcpy(to, bytes_.data() + at_, size);
    at_ += size;
  }
  const std::vector<std::uint8_t>& bytes_;
  std::size_t at_ = 0;
  bool good_ = true;
};

// One order of members for writing and reading.
template <class Archive, class Block>
void visitBlock(Archive& archive, Block& b) {
  archive(b.x_m), archive(b.y_m), archive(b.z_m), archive(b.intensity), archive(b.row), archive(b.column);
  archive(b.red), archive(b.green), archive(b.blue), archive(b.product), archive(b.material), archive(b.time_s);
  archive(b.channel), archive(b.return_number), archive(b.return_count);
  auto& t = b.truth;
  archive(t.x_m), archive(t.y_m), archive(t.z_m), archive(t.range_m), archive(t.incidence_rad), archive(t.received_db),
      archive(t.flags);
}

template <class Archive, class Picture, class Double>
void visitPicture(Archive& archive, Picture& p, Double* rotation, Double* translation) {
  archive(p.name), archive(p.projection), archive(p.media_type), archive(p.bytes), archive(p.width), archive(p.height);
  archive(p.pixel_width), archive(p.pixel_height), archive(p.focal_length_m), archive(p.principal_x),
      archive(p.principal_y);
  for (int k = 0; k < 4; ++k) archive(rotation[k]);
  for (int k = 0; k < 3; ++k) archive(translation[k]);
  archive(p.acquired_gps_s);
}

tl::unexpected<Error> damaged(const fs::path& file) {
  return failure(ErrorKind::unusable, "is damaged: remove its folder and scan again from the start", file.string());
}

}  // namespace

ScanParts::ScanParts(const fs::path& output) {
  fs::path file = output.lexically_normal();
  if (!file.has_filename()) file = file.parent_path();  // "scans/"
  folder_ = file;
  folder_ += ".parts";
}

fs::path ScanParts::recordOf(const std::string& station) const { return folder_ / (station + ".json"); }
fs::path ScanParts::pointsOf(const std::string& station) const { return folder_ / (station + ".points"); }

bool ScanParts::hasRecord(const std::string& station) const {
  std::error_code code;
  return fs::exists(recordOf(station), code);
}

std::optional<ScanParts::Finished> ScanParts::finished(const std::string& station, const std::string& guid) const {
  std::error_code code;
  if (const auto size = fs::file_size(recordOf(station), code); code || size > kLargestRecord) return std::nullopt;
  std::ifstream stream(recordOf(station), std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  const json row = json::parse(text, nullptr, false);
  const auto number = [&](const char* key) {
    return row.contains(key) && row[key].is_number_unsigned() ? row[key].get<std::uint64_t>() : 0;
  };
  if (!row.is_object() || row.value("guid", json()) != json(guid)) return std::nullopt;
  return Finished{{number("pulses"), number("returns"), number("points")}, number("bytes")};
}

Result<void> ScanParts::record(const std::string& station, const std::string& guid, const Finished& finished) const {
  std::error_code code;
  fs::create_directories(folder_, code);
  const auto text = json{
      {"guid", guid},
      {"pulses", finished.count.pulses},
      {"returns", finished.count.returns},
      {"points", finished.count.points},
      {"bytes",
       finished.bytes}}.dump(2);
  return writeWholeText(recordOf(station), text);
}

void ScanParts::remove(const std::string& station) const {
  std::error_code ignored;
  fs::remove(recordOf(station), ignored);
  fs::remove(pointsOf(station), ignored);
  fs::remove(folder_, ignored);  // when it is empty: another machine's shard may have its records there
}

Result<std::unique_ptr<PointTape>> PointTape::create(const fs::path& file, PointSink& behind) {
  std::error_code code;
  fs::create_directories(file.parent_path(), code);
  TRY_ASSIGN(auto part, PartFile::create(file));
  return std::unique_ptr<PointTape>(new PointTape(std::move(part), behind));
}

Result<void> PointTape::put(std::uint8_t kind) {
  const PieceHead head{buffer_.size(), crc32c(buffer_), kind};
  std::array<std::uint8_t, sizeof head> bytes{};
  std::memcpy(bytes.data(), &head, sizeof head);
  if (auto ok = file_.append(bytes); !ok) return ok;
  return file_.append(buffer_);
}

Result<void> PointTape::begin(const ScanHeader& header) { return behind_.begin(header); }

Result<void> PointTape::write(const PointBlock& block) {
  Packer pack(buffer_);
  visitBlock(pack, block);
  if (auto ok = put(kBlock); !ok) return ok;
  return behind_.write(block);
}

Result<void> PointTape::picture(const StationPicture& picture) {
  Packer pack(buffer_);
  visitPicture(pack, picture, picture.file_from_camera.rotation.coeffs().data(),
               picture.file_from_camera.translation.data());
  if (auto ok = put(kPicture); !ok) return ok;
  return behind_.picture(picture);
}

Result<void> PointTape::end() {
  buffer_.clear();
  if (auto ok = put(kEnd); !ok) return ok;
  return behind_.end();
}

Result<void> PointTape::close() { return file_.commit(); }

Result<void> playTape(const fs::path& file, PointSink& sink, Progress& progress) {
  TRY_ASSIGN(auto input, InputFile::open(file));
  std::vector<std::uint8_t> bytes;
  for (std::uint64_t at = 0;;) {
    if (auto go_on = progress.check(); !go_on) return go_on;
    progress.advance(static_cast<double>(at) / static_cast<double>(std::max<std::uint64_t>(1, input.size())));
    std::array<std::uint8_t, sizeof(PieceHead)> raw{};
    PieceHead head;
    TRY_ASSIGN(const auto head_bytes, input.read(at, raw));
    if (head_bytes != raw.size()) return damaged(file);
    std::memcpy(&head, raw.data(), sizeof head);
    at += sizeof head;
    if (head.length > input.size() - at || head.length > kLongestPiece) return damaged(file);
    bytes.resize(head.length);
    TRY_ASSIGN(const auto piece_bytes, input.read(at, bytes));
    if (piece_bytes != bytes.size() || crc32c(bytes) != head.crc) return damaged(file);
    at += head.length;
    Unpacker unpack(bytes);
    if (head.kind == kEnd) return at == input.size() ? Result<void>{} : damaged(file);
    if (head.kind == kBlock) {
      PointBlock block;
      visitBlock(unpack, block);
      if (!unpack.whole()) return damaged(file);
      if (auto ok = sink.write(block); !ok) return ok;
    } else if (head.kind == kPicture) {
      StationPicture picture;
      visitPicture(unpack, picture, picture.file_from_camera.rotation.coeffs().data(),
                   picture.file_from_camera.translation.data());
      if (!unpack.whole()) return damaged(file);
      if (auto ok = sink.picture(picture); !ok) return ok;
    } else {
      return damaged(file);
    }
  }
}

}  // namespace standpoint
