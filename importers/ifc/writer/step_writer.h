// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include <Eigen/Core>

#include "core/part_file.h"
#include "core/result.h"

namespace standpoint::ifc {

// Number of a record that was written; 0: none, "$" as an argument.
using Ref = std::uint32_t;

// ISO 10303-21: quotes and backslashes doubled, everything outside of printable ASCII as \X2\…\X0\ or \X4\…\X0\; what
// is not UTF-8 becomes U+FFFD.
std::string stepText(std::string_view utf8);
// The shortest text that reads as this number again, with the decimal point that a real has to have; 0. where the
// number is not finite.
std::string stepReal(double number);
std::string stepReal(float number);
std::string stepReal(std::string number);  // that is written already, "2" or "1e-5"

// One record: its keyword and arguments, in their order.
class StepRecord {
 public:
  explicit StepRecord(std::string_view keyword) : text_(keyword) { text_ += '('; }
  StepRecord& none(int count = 1);
  StepRecord& text(std::string_view utf8);  // empty: none
  StepRecord& real(double number);
  StepRecord& integer(std::int64_t number);
  StepRecord& symbol(std::string_view word);  // .WORD.; empty: none
  StepRecord& ref(Ref ref);
  StepRecord& refs(std::span<const Ref> list);
  StepRecord& reals(std::span<const double> list);
  StepRecord& reals(const Eigen::Vector3d& v) { return reals(std::span<const double>(v.data(), 3)); }
  StepRecord& raw(std::string_view argument);  // as STEP writes it
  std::string take();

 private:
  StepRecord& next();
  std::string text_;
  bool first_ = true;
};

// An IFC file being made (see PartFile). The first fault of the disk is kept, and answered by commit().
class StepWriter {
 public:
  static Result<StepWriter> create(const std::filesystem::path& file);
  void header(std::string_view description, std::string_view schema, std::string_view program);
  Ref add(StepRecord& record) { return addText(record.take()); }
  // Records of the same text are one record: places, directions, units, materials.
  Ref shared(StepRecord& record);
  Result<void> commit();

 private:
  explicit StepWriter(PartFile file) : file_(std::move(file)) {}
  Ref addText(const std::string& record);
  void flush();
  PartFile file_;
  std::string buffer_;
  std::optional<Error> fault_;
  std::unordered_map<std::string, Ref> known_;
  Ref last_ = 0;
};

}  // namespace standpoint::ifc
