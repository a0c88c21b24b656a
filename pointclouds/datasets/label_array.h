// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/progress.h"
#include "core/result.h"

namespace standpoint {

// A header of numpy's format 1.0, always 128 bytes long; `type` is "<u2".
std::string numpyHead(const char* type, std::uint64_t rows, std::size_t columns);

// The label of each point, as somebody's program has written it.
struct PointLabels {
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;  // a negative number, or one that 32 bits do not hold
  std::vector<std::uint32_t> ids;                      // of classes
  std::vector<std::uint32_t> instances;                // of each point, 0: of none; empty where the file has none
};

// A file of labels: NumPy (.npy) of whole numbers, (n,), or (n, 2) with the instance in the second column;
// SemanticKITTI
// (.label), 32 bits with the instance in the upper half; text (.labels, .txt), a number a line. Anything else, a number
// that is none and a file that is cut short are errors with their place.
Result<PointLabels> readPointLabels(const std::filesystem::path& file, Progress& progress);
bool isLabelFile(const std::filesystem::path& file);  // by its extension

}  // namespace standpoint
