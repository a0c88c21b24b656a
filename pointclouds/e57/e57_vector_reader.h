// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pointclouds/e57/e57_paged_file.h"
#include "pointclouds/e57/e57_xml.h"

namespace standpoint::e57 {

// How the prototype says that a field is stored.
struct StoredField {
  enum class Kind { single_float, double_float, integer, text };
  std::string name;
  Kind kind = Kind::double_float;
  unsigned bits = 64;  // 0 when minimum == maximum; meaningless for text
  std::int64_t minimum = 0;
  double scale = 1, offset = 0;
  double least = 0, most = 0;  // declared values, scaled; equal when the prototype declares none
};

// Decodes a CompressedVector (E2807 9.3) record by record, in pieces of bounded size.
class VectorReader {
 public:
  // `source` names the vector in errors.
  static Result<VectorReader> open(PagedReader& file, const Element& vector, std::string source);

  const std::vector<StoredField>& fields() const { return fields_; }
  std::uint64_t records() const { return records_; }
  void want(std::size_t field) { streams_[field].wanted = true; }
  // The next records of the wanted fields, one column per field (empty for the others): how many, 0 at the end.
  Result<std::size_t> next(std::vector<std::vector<double>>& columns);

 private:
  struct Stream {
    bool wanted = false;
    std::vector<std::uint8_t> bytes;  // with room behind for a whole word
    std::size_t filled = 0;
    std::uint64_t bit = 0;  // where the next record starts
  };
  VectorReader(PagedReader& file, std::string source) : file_(&file), source_(std::move(source)) {}
  Result<void> openSection(std::uint64_t physical);
  Result<void> readPacket();
  Result<void> takeStreams(const std::vector<std::uint8_t>& packet);
  std::uint64_t available() const;
  void decode(std::size_t field, std::size_t records, std::vector<double>& column);
  tl::unexpected<Error> broken(const std::string& what) const;

  PagedReader* file_;
  std::string source_;
  std::vector<StoredField> fields_;
  std::vector<Stream> streams_;
  std::vector<std::uint8_t> packet_;
  std::uint64_t records_ = 0, done_ = 0;
  std::uint64_t cursor_ = 0, section_end_ = 0;  // logical
};

}  // namespace standpoint::e57
