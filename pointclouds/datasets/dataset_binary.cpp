// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>

#include "pointclouds/datasets/datasets.h"
#include "pointclouds/datasets/label_array.h"
#include "pointclouds/datasets/labelled_folder.h"
#include "pointclouds/files/number_text.h"

namespace standpoint::dataset {
namespace {

constexpr std::size_t kBuffered = 1 << 20;

// sequences/00 (08 is what others validate with): a frame for each station in its scanner's frame. The camera of
// calib.txt is the scanner itself, so poses.txt has the stations' poses as they are.
class SemanticKitti final : public LabelledFolder {
 public:
  using LabelledFolder::LabelledFolder;

 private:
  static std::string sequence(bool validation) { return validation ? "sequences/08/" : "sequences/00/"; }
  Result<void> beginStation() override {
    char frame[24];
    std::snprintf(frame, sizeof frame, "%06zu", station().of_split);
    const std::string folder = sequence(station().validation);
    station().place = folder + "velodyne/" + frame + ".bin";
    starts_.push_back(header().acquisition_start_gps_s);
    TRY_ASSIGN(auto points, create(station().place));
    points_.emplace(std::move(points));
    TRY_ASSIGN(auto labels, create(folder + "labels/" + frame + ".label"));
    labels_.emplace(std::move(labels));
    without_instance_ = 0;
    return {};
  }
  Result<void> put(const Point& p) override {
    for (const float v : {p.block.x_m[p.i], p.block.y_m[p.i], p.block.z_m[p.i], fraction(p)}) points_->put(v);
    const bool fits = p.instance <= 0xFFFF;
    without_instance_ += !fits;
    labels_->put(map().classes[p.class_index].id | (fits ? p.instance << 16 : 0));
    if (auto flushed = points_->flushFrom(kBuffered); !flushed) return flushed;
    return labels_->flushFrom(kBuffered);
  }
  Result<void> endStation() override {
    if (without_instance_ > 0)
      report_.lose(header().name, std::to_string(without_instance_) +
                                      " points belong to products above 65535, the instance limit of SemanticKITTI");
    if (auto finished = points_->finish(); !finished) return finished;
    return labels_->finish();
  }
  Result<void> finishSet() override {
    for (const bool validation : {false, true}) {
      std::string poses, times;
      double first = 0;
      for (std::size_t i = 0; i < stations().size(); ++i) {
        const Station& s = stations()[i];
        if (s.validation != validation) continue;
        if (poses.empty()) first = starts_[i];
        const Eigen::Matrix3d r = s.set_from_scanner.rotation.normalized().toRotationMatrix();
        for (int row = 0; row < 3; ++row)
          for (int column = 0; column < 4; ++column) {
            appendNumber(poses, (column < 3 ? r(row, column) : s.set_from_scanner.translation[row]) + 0.0);
            poses += row == 2 && column == 3 ? '\n' : ' ';
          }
        appendNumber(times, starts_[i] - first);
        times += '\n';
      }
      if (poses.empty()) continue;
      std::string calibration;
      for (const char* name : {"P0", "P1", "P2", "P3", "Tr"})
        calibration += std::string(name) + ": 1 0 0 0 0 1 0 0 0 0 1 0\n";
      for (const auto& [name, text] :
           {std::pair("poses.txt", &poses), std::pair("times.txt", &times), std::pair("calib.txt", &calibration)}) {
        TRY_ASSIGN(auto file, create(sequence(validation) + name));
        file.text() = *text;
        if (auto finished = file.finish(); !finished) return finished;
      }
    }
    return {};
  }

  std::vector<double> starts_;
  std::optional<BufferedFile> points_, labels_;
  std::uint64_t without_instance_ = 0;
};

// train, val, test: x y z label and the features r g b (0 to 255) and intensity (0 to 1), as single floats; instances
// beside them, where no loader takes them for features.
class Custom3d final : public LabelledFolder {
 public:
  using LabelledFolder::LabelledFolder;

 private:
  Result<void> beginStation() override {
    station().place = std::string(station().validation ? "val/" : "train/") + station().name + ".npy";
    TRY_ASSIGN(auto points, create(station().place));
    points_.emplace(std::move(points));
    TRY_ASSIGN(auto instances, create("instances/" + station().name + ".npy"));
    instances_.emplace(std::move(instances));
    rows_ = 0;
    points_->text() = numpyHead("<f4", 0, 8);
    instances_->text() = numpyHead("<i4", 0, 1);
    return {};
  }
  Result<void> put(const Point& p) override {
    const Eigen::Vector3f at = place(p).cast<float>();
    for (int axis = 0; axis < 3; ++axis) points_->put(at[axis]);
    points_->put(static_cast<float>(map().classes[p.class_index].id));
    for (const std::uint8_t c : colour(p)) points_->put(static_cast<float>(c));
    points_->put(fraction(p));
    instances_->put(static_cast<std::int32_t>(p.instance));
    ++rows_;
    if (auto flushed = points_->flushFrom(kBuffered); !flushed) return flushed;
    return instances_->flushFrom(kBuffered);
  }
  Result<void> endStation() override {
    if (auto finished = points_->finish(numpyHead("<f4", rows_, 8)); !finished) return finished;
    return instances_->finish(numpyHead("<i4", rows_, 1));
  }
  Result<void> finishSet() override {
    std::error_code error;
    for (const char* split : {"train", "val", "test"}) std::filesystem::create_directories(path(split), error);
    if (error) return failure(ErrorKind::file_system, "cannot create a folder: " + error.message(), path("").string());
    return {};
  }
  std::optional<BufferedFile> points_, instances_;
  std::uint64_t rows_ = 0;
};

}  // namespace

std::unique_ptr<CloudWriter> semanticKitti(const std::filesystem::path& folder, ClassMap map) {
  return std::make_unique<SemanticKitti>(folder, std::move(map));
}
std::unique_ptr<CloudWriter> custom3d(const std::filesystem::path& folder, ClassMap map) {
  return std::make_unique<Custom3d>(folder, std::move(map));
}

}  // namespace standpoint::dataset
