// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <fstream>
#include <map>

#include "pointclouds/datasets/datasets.h"
#include "pointclouds/datasets/labelled_folder.h"
#include "pointclouds/files/number_text.h"

namespace standpoint::dataset {
namespace {

constexpr std::size_t kBufferedText = 1 << 20, kBufferedInAll = 64 << 20;
constexpr unsigned kDecimals = 5;

void appendPlace(std::string& text, const Eigen::Vector3d& p) {
  for (int axis = 0; axis < 3; ++axis) appendFixed(text, p[axis], kDecimals), text += ' ';
}

void appendColour(std::string& text, const std::array<std::uint8_t, 3>& colour) {
  for (int k = 0; k < 3; ++k) {
    if (k > 0) text += ' ';
    appendNumber(text, unsigned{colour[static_cast<std::size_t>(k)]});
  }
  text += '\n';
}

// Area_k/room/room.txt and Annotations/<class>_<instance>.txt with the same lines. Instances alternate from point to
// point, so what is theirs waits in memory, at most kBufferedInAll of it. Area_5 is what others test with.
class S3dis final : public LabelledFolder {
 public:
  using LabelledFolder::LabelledFolder;

 private:
  Result<void> beginStation() override {
    station().place = std::string(station().validation ? "Area_5/" : "Area_1/") + station().name;
    TRY_ASSIGN(auto file, create(station().place + "/" + station().name + ".txt"));
    room_.emplace(std::move(file));
    std::error_code error;
    std::filesystem::create_directories(path(station().place + "/Annotations"), error);
    if (error) return failure(ErrorKind::file_system, "cannot create a folder: " + error.message(), station().place);
    return {};
  }
  Result<void> put(const Point& p) override {
    line_.clear();
    appendPlace(line_, place(p));
    appendColour(line_, colour(p));
    room_->text() += line_;
    waiting_[{p.class_index, p.instance}] += line_;
    waiting_bytes_ += line_.size();
    if (waiting_bytes_ > kBufferedInAll)
      if (auto flushed = flushAnnotations(); !flushed) return flushed;
    return room_->flushFrom(kBufferedText);
  }
  Result<void> flushAnnotations() {
    for (const auto& [key, lines] : waiting_) {
      const auto file = path(station().place + "/Annotations/" + map().classes[key.first].name + "_" +
                             std::to_string(key.second) + ".txt");
      std::ofstream out(file, std::ios::app | std::ios::binary);
      out.write(lines.data(), static_cast<std::streamsize>(lines.size()));
      if (!out.flush()) return failure(ErrorKind::file_system, "cannot write: the disk may be full", file.string());
    }
    waiting_.clear();
    waiting_bytes_ = 0;
    return {};
  }
  Result<void> endStation() override {
    if (auto flushed = flushAnnotations(); !flushed) return flushed;
    return room_->finish();
  }

  std::optional<BufferedFile> room_;
  std::map<std::pair<std::size_t, std::uint32_t>, std::string> waiting_;
  std::size_t waiting_bytes_ = 0;
  std::string line_;
};

// name.txt, name.labels and, of ours, name.instances: a line for each point. Intensity as Cyclone's integers.
class Semantic3d final : public LabelledFolder {
 public:
  using LabelledFolder::LabelledFolder;

 private:
  Result<void> beginStation() override {
    station().place = station().name + ".txt";
    for (std::size_t k = 0; k < 3; ++k) {
      constexpr const char* kEnds[3] = {".txt", ".labels", ".instances"};
      TRY_ASSIGN(auto file, create(station().name + kEnds[k]));
      files_[k].emplace(std::move(file));
    }
    return {};
  }
  Result<void> put(const Point& p) override {
    std::string& text = files_[0]->text();
    appendPlace(text, place(p));
    appendNumber(text, std::lround(fraction(p) * 4095) - 2048);
    text += ' ';
    appendColour(text, colour(p));
    appendNumber(files_[1]->text(), map().classes[p.class_index].id);
    appendNumber(files_[2]->text(), p.instance);
    for (std::size_t k = 1; k < 3; ++k) files_[k]->text() += '\n';
    for (auto& file : files_)
      if (auto flushed = file->flushFrom(kBufferedText); !flushed) return flushed;
    return {};
  }
  Result<void> endStation() override {
    for (auto& file : files_)
      if (auto finished = file->finish(); !finished) return finished;
    return {};
  }
  std::array<std::optional<BufferedFile>, 3> files_;
};

}  // namespace

std::unique_ptr<CloudWriter> s3dis(const std::filesystem::path& folder, ClassMap map) {
  return std::make_unique<S3dis>(folder, std::move(map));
}
std::unique_ptr<CloudWriter> semantic3d(const std::filesystem::path& folder, ClassMap map) {
  return std::make_unique<Semantic3d>(folder, std::move(map));
}

}  // namespace standpoint::dataset
