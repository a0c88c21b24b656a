// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/part_file.h"
#include "core/points.h"
#include "pointclouds/datasets/class_map.h"
#include "project/dataset/recipe.h"

namespace standpoint {

// A NumPy array of whole numbers that grows.
class NumberColumn {
 public:
  static Result<NumberColumn> create(const std::filesystem::path& file, bool wide);  // of 32 or of 16 bits
  Result<void> add(std::uint32_t value);
  Result<void> finish();

 private:
  NumberColumn(PartFile file, bool wide) : file_(std::move(file)), wide_(wide) {}
  Result<void> flush();
  PartFile file_;
  bool wide_;
  std::uint64_t rows_ = 0;
  std::string buffer_;
};

// Writes of each point the id of its class by each map, and the instance (1 and up: the product's place in the cloud's
// table; 0: no product), and counts the classes. Watches one scan; the points go elsewhere.
class LabelSink : public PointSink {
 public:
  LabelSink(const std::vector<RecipeClasses>& classes, std::vector<std::filesystem::path> labels,
            std::filesystem::path instances);
  Result<void> begin(const ScanHeader& header) override;
  Result<void> write(const PointBlock& block) override;
  Result<void> end() override;
  Result<void> close() override { return {}; }
  // Of each map the points of each class.
  const std::vector<std::vector<std::uint64_t>>& counts() const { return counts_; }

 private:
  const std::vector<RecipeClasses>& maps_;
  std::vector<std::filesystem::path> label_files_;
  std::filesystem::path instance_file_;
  std::vector<PointClasses> classes_;
  std::vector<NumberColumn> labels_;
  std::optional<NumberColumn> instances_;
  std::vector<std::vector<std::uint64_t>> counts_;
};

}  // namespace standpoint
