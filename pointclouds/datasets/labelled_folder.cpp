// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/datasets/labelled_folder.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include <nlohmann/json.hpp>

#include "pointclouds/files/block_check.h"

namespace standpoint {
namespace {

namespace fs = std::filesystem;
constexpr double kFarthest_m = 1000;  // the sets' loaders keep coordinates as single floats

// A value of a CSV line.
std::string quoted(const std::string& value) {
  std::string text(1, '"');
  for (const char c : value) {
    if (c == '"') text += c;
    text += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return text += '"';
}

}  // namespace

Result<BufferedFile> BufferedFile::create(const fs::path& file) {
  TRY_ASSIGN(auto part, PartFile::create(file));
  return BufferedFile(std::move(part));
}

Result<void> BufferedFile::flushFrom(std::size_t enough) {
  if (text_.size() < enough || text_.empty()) return {};
  const auto appended = file_.append({reinterpret_cast<const std::uint8_t*>(text_.data()), text_.size()});
  text_.clear();
  return appended;
}

Result<void> BufferedFile::finish(const std::string& head) {
  if (auto flushed = flushFrom(0); !flushed) return flushed;
  if (!head.empty())
    if (auto written = file_.overwrite(0, {reinterpret_cast<const std::uint8_t*>(head.data()), head.size()}); !written)
      return written;
  return file_.commit();
}

LabelledFolder::LabelledFolder(fs::path folder, ClassMap map) : folder_(std::move(folder)), map_(std::move(map)) {
  if (!folder_.has_filename()) folder_ = folder_.parent_path();
}

Result<void> LabelledFolder::start() {
  std::error_code error;
  if (fs::exists(folder_, error) && !(fs::is_directory(folder_, error) && fs::is_empty(folder_, error)))
    return failure(ErrorKind::usage, "the folder is not empty: specify a new folder", folder_.string());
  fs::create_directories(folder_.parent_path(), error);
  TRY_ASSIGN(auto part, PartFolder::create(folder_));
  part_.emplace(std::move(part));
  return {};
}

Result<BufferedFile> LabelledFolder::create(const std::string& inside) const {
  std::error_code error;
  fs::create_directories(path(inside).parent_path(), error);
  if (error) return failure(ErrorKind::file_system, "cannot create the folder: " + error.message(), folder_.string());
  return BufferedFile::create(path(inside));
}

std::string LabelledFolder::uniqueName(const std::string& name) const {
  std::string base;
  for (const char c : name) base += std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' ? c : '-';
  if (base.empty()) base = "station";
  std::string unique = base;
  const auto taken = [&](const Station& s) { return s.name == unique; };
  for (int i = 2; std::any_of(stations_.begin(), stations_.end(), taken); ++i) unique = base + "-" + std::to_string(i);
  return unique;
}

Result<void> LabelledFolder::begin(const ScanHeader& header) {
  if (header_) return failure(ErrorKind::internal, "a scan starts before the previous one has ended", header.name);
  if (auto checked = checkHeader(header); !checked) return checked;
  if (!header.has_labels)
    return failure(ErrorKind::unusable, "points have no labels: a labelled dataset requires simulated scans",
                   "scan " + header.name);
  header_ = header;
  first_product_ = table_.add(header).product;
  classes_.emplace(map_, header);
  if (stations_.empty() && header.file_from_scanner.translation.cwiseAbs().maxCoeff() > kFarthest_m)
    shift_ = header.file_from_scanner.translation.array().round();
  Station station{uniqueName(header.name), stations_.size() % 5 == 1, 0, {}, header.file_from_scanner};
  station.set_from_scanner.translation -= shift_;
  for (const Station& s : stations_) station.of_split += s.validation == station.validation;
  stations_.push_back(std::move(station));
  return beginStation();
}

Result<void> LabelledFolder::write(const PointBlock& block) {
  if (!header_) return failure(ErrorKind::internal, "points outside a scan", folder_.string());
  if (block.size() == 0) return {};
  TRY(checkBlock(*header_, block));
  for (std::size_t i = 0; i < block.size(); ++i) {
    const Point point{block, i, classes_->of(block, i),
                      classes_->isSurfaceless(block, i) ? 0 : first_product_ + block.product[i] + 1};
    if (auto done = put(point); !done) return done;
  }
  return {};
}

Result<void> LabelledFolder::end() {
  if (!header_) return failure(ErrorKind::internal, "a scan ends that was not started", folder_.string());
  auto ended = endStation();
  header_.reset();
  return ended;
}

Eigen::Vector3d LabelledFolder::place(const Point& p) const {
  return stations_.back().set_from_scanner * Eigen::Vector3d(p.block.x_m[p.i], p.block.y_m[p.i], p.block.z_m[p.i]);
}

float LabelledFolder::fraction(const Point& p) const {
  if (!hasIntensity(*header_)) return 0.5F;
  const double fraction =
      (p.block.intensity[p.i] - header_->intensity_min) / (header_->intensity_max - header_->intensity_min);
  return static_cast<float>(std::clamp(fraction, 0.0, 1.0));
}

std::array<std::uint8_t, 3> LabelledFolder::colour(const Point& p) const {
  if (header_->has_colour) return {p.block.red[p.i], p.block.green[p.i], p.block.blue[p.i]};
  const auto grey = static_cast<std::uint8_t>(std::lround(fraction(p) * 255));
  return {grey, grey, grey};
}

Result<void> LabelledFolder::writeText(const char* name, const std::string& text) const {
  TRY_ASSIGN(auto file, create(name));
  file.text() = text;
  return file.finish();
}

std::string LabelledFolder::description() const {
  nlohmann::ordered_json classes = nlohmann::ordered_json::array(), stations = nlohmann::ordered_json::array();
  for (const auto& c : map_.classes) classes.push_back({{"id", c.id}, {"name", c.name}});
  for (const Station& s : stations_) {
    const auto& [q, t] = s.set_from_scanner;
    stations.push_back({{"name", s.name},
                        {"split", s.validation ? "val" : "train"},
                        {"place", s.place},
                        {"translation", {t.x(), t.y(), t.z()}},
                        {"rotation", {q.w(), q.x(), q.y(), q.z()}}});
  }
  const nlohmann::ordered_json all = {{"set", map_.name},
                                      {"file_from_set_m", {shift_.x(), shift_.y(), shift_.z()}},
                                      {"classes", classes},
                                      {"stations", stations}};
  return all.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

Result<void> LabelledFolder::close() {
  if (header_) return failure(ErrorKind::internal, "the dataset is closed inside a scan", folder_.string());
  if (stations_.empty()) return failure(ErrorKind::unusable, "no complete scan to write", folder_.string());
  if (auto finished = finishSet(); !finished) return finished;
  std::string instances = "instance,id,global_id,ifc_class,name\n";
  for (std::size_t i = 0; i < table_.products.size(); ++i) {
    const LabelledProduct& p = table_.products[i];
    instances += std::to_string(i + 1) + "," + quoted(p.id) + "," + quoted(p.global_id) + "," + quoted(p.ifc_class) +
                 "," + quoted(p.name) + "\n";
  }
  if (auto written = writeText("instances.csv", instances); !written) return written;
  if (auto written = writeText("dataset.json", description()); !written) return written;
  return part_->commit();
}

}  // namespace standpoint
