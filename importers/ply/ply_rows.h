// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "importers/files/byte_stream.h"
#include "importers/files/text_cursor.h"
#include "importers/ply/ply_file_header.h"

namespace standpoint {

// The values of one row: of property i those from begin[i] on, as many as sizes[i] (1 unless it is a list).
struct PlyRow {
  std::vector<double> values;
  std::vector<std::size_t> begin, sizes;
  double at(std::size_t property) const { return values[begin[property]]; }
};

// Reads a PLY's rows one after the other, text or binary of either order of bytes.
class PlyRows {
 public:
  PlyRows(const FileBytes& bytes, const PlyFileHeader& header, const std::string& name);

  // An error names the element, its row and, in a text, the line.
  Result<void> next(const PlyElement& element, std::uint64_t row, PlyRow& out);
  // "line 12", or "face 7" in a binary file.
  std::string place(const PlyElement& element, std::uint64_t row) const;
  std::size_t line() const { return line_; }
  double fraction() const;

 private:
  Result<void> binaryRow(const PlyElement& element, PlyRow& out);
  Result<void> textRow(const PlyElement& element, PlyRow& out);
  Result<void> value(PlyType type, double& out);
  Result<void> textValue(double& out);
  Result<void> refill();
  tl::unexpected<Error> ended() const;

  const FileBytes& bytes_;
  const PlyFileHeader& header_;
  const std::string& name_;
  ByteStream stream_;
  std::string text_;  // a piece of whole lines
  std::optional<TextCursor> cursor_;
  std::uint64_t next_piece_;
  std::size_t line_;
};

}  // namespace standpoint
