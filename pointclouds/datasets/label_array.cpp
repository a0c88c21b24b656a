// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/datasets/label_array.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <fstream>
#include <regex>
#include <span>

#include "pointclouds/files/number_text.h"

namespace standpoint {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestHead = 4096;
constexpr std::size_t kRowsAtOnce = 65536;

tl::unexpected<Error> unusableLabels(const fs::path& file, const std::string& message) {
  return failure(ErrorKind::unusable, message, file.filename().string());
}

struct NumpyArray {
  char kind = 'u';        // 'u' or 'i'
  std::size_t bytes = 1;  // of a number
  std::uint64_t rows = 0;
  std::size_t columns = 1;  // one or two
};

// "{'descr': '<u2', 'fortran_order': False, 'shape': (12, 2), }"
Result<NumpyArray> arrayFrom(const std::string& head, const fs::path& file) {
  static const std::regex type("'descr'\\s*:\\s*'([<|=]?)([ui])([1248])'");
  static const std::regex shape("'shape'\\s*:\\s*\\(\\s*(\\d{1,18})\\s*,?\\s*(\\d{0,18})\\s*,?\\s*\\)");
  NumpyArray array;
  std::smatch found;
  if (!std::regex_search(head, found, type))
    return unusableLabels(file, "labels must be whole numbers in the byte order of this machine: <u2, <i4, <i8, |u1");
  array.kind = found[2].str()[0];
  array.bytes = std::stoul(found[3].str());
  if (!std::regex_search(head, found, shape)) return unusableLabels(file, "labels must have the shape (n,) or (n, 2)");
  array.rows = std::stoull(found[1].str());
  if (found[2].length() > 0) array.columns = std::stoul(found[2].str());
  if (array.columns < 1 || array.columns > 2)
    return unusableLabels(file, "labels must have the shape (n,), or (n, 2) with the instance in the second column");
  if (array.columns == 2 && head.find("'fortran_order': True") != std::string::npos)
    return unusableLabels(file, "labels must be in C order");
  return array;
}

std::uint32_t numberFrom(const std::uint8_t* bytes, const NumpyArray& array) {
  std::uint64_t value = 0;
  std::memcpy(&value, bytes, array.bytes);
  const bool negative = array.kind == 'i' && (bytes[array.bytes - 1] & 0x80U) != 0;
  return negative || value >= PointLabels::kNone ? PointLabels::kNone : static_cast<std::uint32_t>(value);
}

Result<PointLabels> readNumpy(std::ifstream& in, const fs::path& file, std::uintmax_t size, Progress& progress) {
  std::array<char, 10> start{};
  in.read(start.data(), start.size());
  const auto at = [&](std::size_t i) { return static_cast<std::size_t>(static_cast<std::uint8_t>(start[i])); };
  if (!in || std::memcmp(start.data(), "\x93NUMPY", 6) != 0 || at(6) < 1 || at(6) > 3)
    return unusableLabels(file, "not an array of numpy");
  std::size_t length = at(8) + (at(9) << 8U), before = start.size();
  if (at(6) > 1) {
    std::array<char, 2> more{};
    in.read(more.data(), more.size());
    length += static_cast<std::size_t>(static_cast<std::uint8_t>(more[0])) << 16U;
    before += 2;
    if (more[1] != 0) return unusableLabels(file, "not an array of numpy");
  }
  if (length > kLongestHead) return unusableLabels(file, "not an array of numpy");
  std::string head(length, ' ');
  in.read(head.data(), static_cast<std::streamsize>(length));
  if (!in) return unusableLabels(file, "cut short within its header");
  TRY_ASSIGN(const auto array, arrayFrom(head, file));
  const std::size_t row = array.bytes * array.columns;
  if (size < before + length || array.rows > (size - before - length) / row)
    return unusableLabels(file, "cut short: its header promises " + std::to_string(array.rows) + " points");
  PointLabels labels;
  labels.ids.reserve(array.rows);
  std::vector<std::uint8_t> bytes(kRowsAtOnce * row);
  for (std::uint64_t done = 0; done < array.rows;) {
    TRY(progress.check());
    const auto n = static_cast<std::size_t>(std::min<std::uint64_t>(kRowsAtOnce, array.rows - done));
    in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(n * row));
    if (!in) return failure(ErrorKind::file_system, "cannot read to its end", file.string());
    for (std::size_t i = 0; i < n; ++i) {
      labels.ids.push_back(numberFrom(bytes.data() + i * row, array));
      if (array.columns == 2) labels.instances.push_back(numberFrom(bytes.data() + i * row + array.bytes, array));
    }
    done += n;
  }
  return labels;
}

Result<PointLabels> readKitti(std::ifstream& in, const fs::path& file, std::uintmax_t size, Progress& progress) {
  if (size % 4 != 0) return unusableLabels(file, "cut short: four bytes for each point are expected");
  PointLabels labels;
  labels.ids.reserve(size / 4);
  std::vector<std::uint32_t> words(kRowsAtOnce);
  for (std::uintmax_t done = 0; done < size / 4;) {
    TRY(progress.check());
    const auto n = static_cast<std::size_t>(std::min<std::uintmax_t>(kRowsAtOnce, size / 4 - done));
    in.read(reinterpret_cast<char*>(words.data()), static_cast<std::streamsize>(n * 4));
    if (!in) return failure(ErrorKind::file_system, "cannot read to its end", file.string());
    for (const auto word : std::span(words).first(n)) {
      labels.ids.push_back(word & 0xFFFFU);
      labels.instances.push_back(word >> 16U);
    }
    done += n;
  }
  return labels;
}

Result<PointLabels> readLines(std::ifstream& in, const fs::path& file, Progress& progress) {
  PointLabels labels;
  std::size_t number = 0;
  for (std::string line; std::getline(in, line);) {
    if (++number % kRowsAtOnce == 0) TRY(progress.check());
    if (!line.empty() && line.back() == '\r') line.pop_back();
    std::int64_t value = 0;
    const auto* const end = line.data() + line.size();
    const auto read = std::from_chars(line.data(), end, value);
    if (read.ec != std::errc() || read.ptr != end)
      return failure(ErrorKind::unusable, "must be a whole number, the class of a point",
                     file.filename().string() + " line " + std::to_string(number));
    labels.ids.push_back(value < 0 || value >= PointLabels::kNone ? PointLabels::kNone
                                                                  : static_cast<std::uint32_t>(value));
  }
  return labels;
}

}  // namespace

std::string numpyHead(const char* type, std::uint64_t rows, std::size_t columns) {
  std::string text("\x93NUMPY\x01\x00\x76\x00", 10);
  text.append("{'descr': '").append(type).append("', 'fortran_order': False, 'shape': (");
  appendNumber(text, rows);
  text += ',';
  if (columns > 1) appendNumber(text += ' ', columns);
  text.append("), }").resize(127, ' ');
  return text += '\n';
}

bool isLabelFile(const fs::path& file) {
  const auto extension = file.extension();
  return extension == ".npy" || extension == ".label" || extension == ".labels" || extension == ".txt";
}

Result<PointLabels> readPointLabels(const fs::path& file, Progress& progress) {
  if (!isLabelFile(file))
    return failure(ErrorKind::usage, "labels must be a file .npy, .label, .labels or .txt", file.string());
  std::error_code error;
  const auto size = fs::file_size(file, error);
  std::ifstream in(file, std::ios::binary);
  if (!in || error) return failure(ErrorKind::file_system, "cannot read", file.string());
  const auto extension = file.extension();
  return extension == ".npy"     ? readNumpy(in, file, size, progress)
         : extension == ".label" ? readKitti(in, file, size, progress)
                                 : readLines(in, file, progress);
}

}  // namespace standpoint
