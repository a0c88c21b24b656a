// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ply/ply_rows.h"

#include <cmath>

#include "importers/files/text_pieces.h"

namespace standpoint {

namespace {

constexpr std::size_t kTextPiece = 4U << 20U;

}  // namespace

PlyRows::PlyRows(const FileBytes& bytes, const PlyFileHeader& header, const std::string& name)
    : bytes_(bytes),
      header_(header),
      name_(name),
      stream_(bytes, header.bytes),
      next_piece_(header.bytes),
      line_(header.lines + 1) {}

double PlyRows::fraction() const {
  const auto left =
      header_.form == PlyForm::text ? bytes_.size() - std::min(next_piece_, bytes_.size()) : stream_.remaining();
  return 1 - static_cast<double>(left) / static_cast<double>(bytes_.size());
}

std::string PlyRows::place(const PlyElement& element, std::uint64_t row) const {
  return header_.form == PlyForm::text ? "line " + std::to_string(line_) : element.name + " " + std::to_string(row);
}

Result<void> PlyRows::next(const PlyElement& element, std::uint64_t row, PlyRow& out) {
  out.values.clear();
  out.begin.clear();
  out.sizes.clear();
  auto ok = header_.form == PlyForm::text ? textRow(element, out) : binaryRow(element, out);
  if (!ok && ok.error().source.empty())
    return failure(ok.error().kind,
                   ok.error().message + " (" + element.name + " " + std::to_string(row) + " of " +
                       std::to_string(element.count) + ")",
                   name_ + " " + place(element, row));
  return ok;
}

tl::unexpected<Error> PlyRows::ended() const {
  if (stream_.error()) return failure(*stream_.error());
  return failure(ErrorKind::unusable, "the file is truncated here");
}

Result<void> PlyRows::binaryRow(const PlyElement& element, PlyRow& out) {
  const bool big = header_.form == PlyForm::big_endian;
  for (const auto& property : element.properties) {
    double count = 1;
    if (property.count_type) {
      const char* p = stream_.take(sizeOf(*property.count_type));
      if (p == nullptr) return ended();
      count = plyNumber(*property.count_type, p, big);
      if (count < 0) return failure(ErrorKind::unusable, "a list has a negative count");
    }
    const auto n = static_cast<std::size_t>(count), size = sizeOf(property.type);
    if (n > stream_.remaining() / size) return ended();
    out.begin.push_back(out.values.size());
    out.sizes.push_back(n);
    const char* p = stream_.take(n * size);
    if (p == nullptr && n > 0) return ended();
    for (std::size_t i = 0; i < n; ++i) out.values.push_back(plyNumber(property.type, p + i * size, big));
  }
  return {};
}

Result<void> PlyRows::textRow(const PlyElement& element, PlyRow& out) {
  for (const auto& property : element.properties) {
    double count = 1;
    if (property.count_type) {
      if (auto ok = textValue(count); !ok) return ok;
      if (!(count >= 0 && count <= 4294967295.0) || count != std::floor(count))
        return failure(ErrorKind::unusable, "a list has an invalid count");
    }
    out.begin.push_back(out.values.size());
    out.sizes.push_back(static_cast<std::size_t>(count));
    double v = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      if (auto ok = textValue(v); !ok) return ok;
      out.values.push_back(v);  // all digits, also of what is called a float: large coordinates are written so
    }
  }
  return {};
}

// Rows are read by their numbers and not by their lines: some writers break them.
Result<void> PlyRows::textValue(double& out) {
  for (;;) {
    while (!cursor_ || cursor_->done()) {
      if (cursor_) line_ = cursor_->line();
      if (next_piece_ >= bytes_.size()) return ended();
      if (auto ok = refill(); !ok) return ok;
    }
    cursor_->skipSpaces();
    if (!cursor_->atLineEnd()) break;
    cursor_->finishStatement();
  }
  line_ = cursor_->line();
  if (cursor_->number(out)) return {};
  return failure(ErrorKind::unusable, inQuotes(cursor_->word()) + " is not a number");
}

Result<void> PlyRows::refill() {
  TRY_ASSIGN(auto text, textPiece(bytes_, next_piece_, kTextPiece));
  next_piece_ += kTextPiece;
  text_ = std::move(text);
  cursor_.emplace(text_, line_);
  return {};
}

}  // namespace standpoint
