// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/e57/e57_vector_reader.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "pointclouds/files/number_text.h"
#include "pointclouds/files/raw_bytes.h"

namespace standpoint::e57 {
namespace {

constexpr std::uint64_t kMostRecordsAtOnce = 65536;
constexpr std::size_t kBehind = 16;  // bytes that a word read at the end may touch
constexpr std::size_t kLongestStream = std::size_t{64} << 20;
constexpr std::uint64_t kMostConstantRecords = 1 << 20;  // a field without bits costs a hostile file nothing

using Kind = StoredField::Kind;

tl::unexpected<Error> badField(const std::string& source, const Element& element, const char* what) {
  return failure(ErrorKind::unusable, "field " + element.name + ": " + what, source);
}

// `otherwise` when the attribute is absent.
template <class T>
std::optional<T> attributeOr(const Element& element, const char* name, T otherwise) {
  const auto written = element.attribute(name);
  return trimmed(written).empty() ? otherwise : numberFrom<T>(written);
}

Result<StoredField> integerFrom(const Element& e, const std::string& source) {
  using Limits = std::numeric_limits<std::int64_t>;
  const auto least = attributeOr<std::int64_t>(e, "minimum", Limits::min());
  const auto most = attributeOr<std::int64_t>(e, "maximum", Limits::max());
  if (!least || !most || *least > *most) return badField(source, e, "minimum and maximum are not an integer range");
  StoredField field{.name = e.name, .kind = Kind::integer, .minimum = *least};
  field.bits =
      static_cast<unsigned>(std::bit_width(static_cast<std::uint64_t>(*most) - static_cast<std::uint64_t>(*least)));
  if (e.attribute("type") == "ScaledInteger") {
    const auto scale = attributeOr<double>(e, "scale", 1), offset = attributeOr<double>(e, "offset", 0);
    if (!scale || !offset || !std::isfinite(*scale) || !std::isfinite(*offset))
      return badField(source, e, "scale or offset is not a number");
    field.scale = *scale;
    field.offset = *offset;
  }
  if (field.bits < 64) {
    field.least = static_cast<double>(*least) * field.scale + field.offset;
    field.most = static_cast<double>(*most) * field.scale + field.offset;
  }
  return field;
}

Result<StoredField> fieldFrom(const Element& e, const std::string& source) {
  const auto type = e.attribute("type");
  if (type == "Integer" || type == "ScaledInteger") return integerFrom(e, source);
  if (type == "String") return StoredField{.name = e.name, .kind = Kind::text};
  if (type != "Float") return badField(source, e, "is neither Integer, ScaledInteger, Float nor String");
  const bool single = e.attribute("precision") == "single";
  StoredField field{
      .name = e.name, .kind = single ? Kind::single_float : Kind::double_float, .bits = single ? 32u : 64u};
  const auto least = attributeOr<double>(e, "minimum", 0), most = attributeOr<double>(e, "maximum", 0);
  if (least && most && *least < *most) field.least = *least, field.most = *most;
  return field;
}

std::uint64_t bitsAt(const std::uint8_t* bytes, std::uint64_t bit, unsigned bits) {
  const std::uint8_t* const from = bytes + bit / 8;
  const unsigned skip = bit % 8;
  std::uint64_t value = load<std::uint64_t>(from) >> skip;
  if (skip + bits > 64) value |= std::uint64_t{from[8]} << (64 - skip);
  return bits < 64 ? value & ((std::uint64_t{1} << bits) - 1) : value;
}

}  // namespace

tl::unexpected<Error> VectorReader::broken(const std::string& what) const {
  return failure(ErrorKind::unusable, what, source_ + " offset " + std::to_string(physicalFrom(cursor_)));
}

Result<VectorReader> VectorReader::open(PagedReader& file, const Element& vector, std::string source) {
  VectorReader reader(file, std::move(source));
  const auto offset = numberFrom<std::uint64_t>(vector.attribute("fileOffset"));
  const auto records = numberFrom<std::uint64_t>(vector.attribute("recordCount"));
  const Element* const prototype = vector.child("prototype");
  if (!offset || !records || !prototype)
    return failure(ErrorKind::unusable, "fileOffset, recordCount or prototype is missing", reader.source_);
  std::uint64_t bits = 0;
  for (const auto& child : prototype->children) {
    TRY_ASSIGN(auto field, fieldFrom(*child, reader.source_));
    if (field.kind != Kind::text) bits += field.bits;
    reader.fields_.push_back(std::move(field));
  }
  reader.streams_.resize(reader.fields_.size());
  reader.records_ = *records;
  const std::uint64_t most = bits == 0 ? kMostConstantRecords : file.logicalSize() * 8 / bits;
  if (*records > most)
    return failure(ErrorKind::unusable, "the file is too short for " + std::to_string(*records) + " points",
                   reader.source_);
  // An empty vector may point anywhere: real files do.
  if (*records > 0) TRY(reader.openSection(*offset));
  return reader;
}

Result<void> VectorReader::openSection(std::uint64_t physical) {
  const auto points_outside = [&](std::uint64_t offset) {
    return offset % kPageBytes >= kPayloadBytes || offset >= file_->physicalSize();
  };
  if (points_outside(physical)) return broken("fileOffset is outside the file");
  cursor_ = logicalFrom(physical);
  std::array<std::uint8_t, 32> header;
  if (auto read = file_->read(cursor_, header); !read) return read;
  if (header[0] != 1) return broken("no CompressedVector section at this offset");
  const auto length = load<std::uint64_t>(header.data() + 8), data = load<std::uint64_t>(header.data() + 16);
  if (points_outside(data)) return broken("the section's data offset is outside the file");
  section_end_ = length > file_->logicalSize() - cursor_ ? file_->logicalSize() : cursor_ + length;
  cursor_ = logicalFrom(data);
  return {};
}

Result<void> VectorReader::readPacket() {
  if (cursor_ + 4 > section_end_)
    return broken("the section ends after " + std::to_string(done_) + " of " + std::to_string(records_) + " points");
  std::array<std::uint8_t, 4> start;
  if (auto read = file_->read(cursor_, start); !read) return read;
  const std::size_t length = load<std::uint16_t>(start.data() + 2) + std::size_t{1};
  if (start[0] > 2) return broken("unknown packet type " + std::to_string(start[0]));
  if (length % 4 != 0) return broken("a packet's length is not a multiple of 4");
  if (start[0] == 1) {
    packet_.resize(length);
    if (auto read = file_->read(cursor_, packet_); !read) return read;
    if (auto taken = takeStreams(packet_); !taken) return taken;
  }
  cursor_ += length;  // index and ignored packets carry no points
  return {};
}

Result<void> VectorReader::takeStreams(const std::vector<std::uint8_t>& packet) {
  if (packet.size() < 6) return broken("a data packet is too short");
  const std::size_t count = load<std::uint16_t>(packet.data() + 4);
  // A constant field has no stream by the standard, an empty one by the library that most files come from.
  const auto constant = [](const StoredField& f) { return f.kind != Kind::text && f.bits == 0; };
  const auto constants = static_cast<std::size_t>(std::count_if(fields_.begin(), fields_.end(), constant));
  if (count != fields_.size() && count != fields_.size() - constants)
    return broken("a packet has " + std::to_string(count) + " streams for " + std::to_string(fields_.size()) +
                  " fields");
  std::size_t at = 6 + 2 * count, stream = 0;
  if (at > packet.size()) return broken("a data packet is too short");
  for (std::size_t f = 0; f < fields_.size(); ++f) {
    if (count != fields_.size() && constant(fields_[f])) continue;
    const std::size_t n = load<std::uint16_t>(packet.data() + 6 + 2 * stream++);
    if (n > packet.size() - at) return broken("a packet's streams are longer than the packet");
    if (Stream& s = streams_[f]; s.wanted) {
      if (s.filled > kLongestStream) return broken("field streams differ too much in length");
      s.bytes.resize(s.filled + n + kBehind);
      std::copy_n(packet.begin() + static_cast<std::ptrdiff_t>(at), n,
                  s.bytes.begin() + static_cast<std::ptrdiff_t>(s.filled));
      s.filled += n;
    }
    at += n;
  }
  return {};
}

std::uint64_t VectorReader::available() const {
  std::uint64_t n = std::min(records_ - done_, kMostRecordsAtOnce);
  for (std::size_t f = 0; f < fields_.size(); ++f)
    if (streams_[f].wanted && fields_[f].bits > 0)
      n = std::min(n, (streams_[f].filled * 8 - streams_[f].bit) / fields_[f].bits);
  return n;
}

void VectorReader::decode(std::size_t field, std::size_t records, std::vector<double>& column) {
  const StoredField& f = fields_[field];
  Stream& s = streams_[field];
  s.bytes.resize(s.filled + kBehind);
  column.resize(records);
  const std::uint8_t* const bytes = s.bytes.data();
  if (f.kind == Kind::single_float)
    for (std::size_t i = 0; i < records; ++i) column[i] = load<float>(bytes + s.bit / 8 + 4 * i);
  else if (f.kind == Kind::double_float)
    for (std::size_t i = 0; i < records; ++i) column[i] = load<double>(bytes + s.bit / 8 + 8 * i);
  else
    for (std::size_t i = 0; i < records; ++i) {
      const std::uint64_t stored = f.bits == 0 ? 0 : bitsAt(bytes, s.bit + i * f.bits, f.bits);
      const auto raw = static_cast<std::int64_t>(static_cast<std::uint64_t>(f.minimum) + stored);
      column[i] = static_cast<double>(raw) * f.scale + f.offset;
    }
  s.bit += std::uint64_t{records} * f.bits;
  const std::size_t used = s.bit / 8;
  if (used * 2 < s.filled) return;  // moved rarely, so that a stream far ahead of the others costs no time
  std::copy(s.bytes.begin() + static_cast<std::ptrdiff_t>(used),
            s.bytes.begin() + static_cast<std::ptrdiff_t>(s.filled), s.bytes.begin());
  s.filled -= used;
  s.bit -= used * 8;
}

Result<std::size_t> VectorReader::next(std::vector<std::vector<double>>& columns) {
  columns.resize(fields_.size());
  if (done_ == records_) return 0;
  std::uint64_t n = available();
  while (n == 0) {
    TRY(readPacket());
    n = available();
  }
  for (std::size_t f = 0; f < fields_.size(); ++f)
    if (streams_[f].wanted) decode(f, n, columns[f]);
  done_ += n;
  return n;
}

}  // namespace standpoint::e57
