// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/part_file.h"
#include "pointclouds/datasets/class_map.h"
#include "pointclouds/files/scan_text.h"
#include "pointclouds/formats.h"

namespace standpoint {

// A file of a labelled set, written through a buffer.
class BufferedFile {
 public:
  static Result<BufferedFile> create(const std::filesystem::path& file);
  std::string& text() { return text_; }
  template <class T>
  void put(T value) {
    text_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  Result<void> flushFrom(std::size_t enough);
  // Puts `head` over as many bytes at the beginning, and ends the file.
  Result<void> finish(const std::string& head = {});

 private:
  explicit BufferedFile(PartFile file) : file_(std::move(file)) {}
  PartFile file_;
  std::string text_;
};

// What the labelled sets have in common: a folder that is there whole or not at all, a class and an instance for each
// point, every fifth station from the second for validation, and beside the set `dataset.json` (classes, stations, the
// shift of the coordinates) and `instances.csv` (which product an instance is).
class LabelledFolder : public CloudWriter {
 public:
  LabelledFolder(std::filesystem::path folder, ClassMap map);
  Result<void> start();
  Result<void> begin(const ScanHeader& header) final;
  Result<void> write(const PointBlock& block) final;
  Result<void> end() final;
  Result<void> close() final;

 protected:
  struct Point {
    const PointBlock& block;
    std::size_t i;
    std::size_t class_index;
    std::uint32_t instance;  // from 1, the same product in every station
  };
  struct Station {
    std::string name;  // as a file's name, unique
    bool validation = false;
    std::size_t of_split = 0;  // how many of its split stand before it
    std::string place;         // in the folder, set by the set
    Pose set_from_scanner;
  };
  virtual Result<void> beginStation() = 0;
  virtual Result<void> put(const Point& point) = 0;
  virtual Result<void> endStation() = 0;
  virtual Result<void> finishSet() { return {}; }

  const ScanHeader& header() const { return *header_; }
  const ClassMap& map() const { return map_; }
  Station& station() { return stations_.back(); }
  const std::vector<Station>& stations() const { return stations_; }
  std::filesystem::path path(const std::string& inside) const { return part_->path() / inside; }
  // Makes the folders on the way.
  Result<BufferedFile> create(const std::string& inside) const;
  Eigen::Vector3d place(const Point& p) const;               // in the set's frame
  float fraction(const Point& p) const;                      // of the sensor's range of intensity; 0.5 without one
  std::array<std::uint8_t, 3> colour(const Point& p) const;  // grey by intensity where there is none

 private:
  std::string uniqueName(const std::string& name) const;
  Result<void> writeText(const char* name, const std::string& text) const;
  std::string description() const;
  std::filesystem::path folder_;
  std::optional<PartFolder> part_;  // from start() to close()
  ClassMap map_;
  std::optional<ScanHeader> header_;
  std::optional<PointClasses> classes_;  // of this scan
  std::vector<Station> stations_;
  Eigen::Vector3d shift_ = Eigen::Vector3d::Zero();
  JointTable table_;
  std::uint32_t first_product_ = 0;
};

}  // namespace standpoint
