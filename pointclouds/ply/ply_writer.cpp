// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstring>
#include <optional>

#include "core/part_file.h"
#include "pointclouds/files/block_check.h"
#include "pointclouds/files/raw_bytes.h"
#include "pointclouds/files/scan_text.h"
#include "pointclouds/ply/ply.h"
#include "pointclouds/ply/ply_cloud_header.h"

namespace standpoint {

const CloudFormat kPly = {
    "ply",    "PLY: one cloud in the file's frame, with labels as scalars", ".ply", false, ply::createWriter, ply::read,
    ply::info};

namespace ply {
namespace {

class Writer final : public CloudWriter {
 public:
  explicit Writer(PartFile file) : file_(std::move(file)) {}
  Result<void> begin(const ScanHeader& header) override;
  Result<void> write(const PointBlock& block) override;
  Result<void> end() override;
  Result<void> close() override;

 private:
  std::string headerText() const;
  void putPoint(const PointBlock& block, std::size_t i);

  PartFile file_;
  std::optional<ScanHeader> header_;
  bool ended_ = false;
  std::uint64_t points_ = 0;
  std::vector<std::uint8_t> bytes_;
};

// Always as long: the number of points is known last.
std::string Writer::headerText() const {
  const std::string digits = std::to_string(points_);
  std::string text = "ply\nformat binary_little_endian 1.0\n";
  for (const auto& line : scanLines(*header_)) text += kOurComment + line + "\n";
  if (header_->has_labels)
    for (const auto& line : tableLines(header_->products, header_->materials)) text += kOurComment + line + "\n";
  text += "element vertex " + std::string(20 - digits.size(), '0') + digits + "\n";
  text += "property double x\nproperty double y\nproperty double z\n";
  if (hasIntensity(*header_)) text += "property float scalar_Intensity\n";
  if (header_->has_colour) text += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  if (header_->has_labels) text += "property int scalar_Label\nproperty int scalar_Product\n";
  if (hasGrid(*header_)) text += "property int scalar_Row\nproperty int scalar_Column\n";
  if (header_->has_time) text += "property double scalar_Time\n";
  if (header_->has_channel) text += "property uchar scalar_Channel\n";
  if (header_->has_returns) text += "property uchar scalar_ReturnNumber\nproperty uchar scalar_NumberOfReturns\n";
  if (header_->has_truth) {
    for (const char axis : {'X', 'Y', 'Z'}) text += std::string("property double scalar_True") + axis + "\n";
    for (const char* name : {"TrueRange", "Incidence", "ReceivedPower"})
      text += std::string("property float scalar_") + name + "\n";
    text += "property uchar scalar_Flags\n";
  }
  return text + "end_header\n";
}

Result<void> Writer::begin(const ScanHeader& header) {
  if (header_) return failure(ErrorKind::internal, "a PLY file can hold only one scan", file_.file().string());
  if (auto checked = checkHeader(header); !checked) return checked;
  header_ = header;
  const std::string text = headerText();
  return file_.append({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

void Writer::putPoint(const PointBlock& b, std::size_t i) {
  const Eigen::Vector3d p = header_->file_from_scanner * Eigen::Vector3d(b.x_m[i], b.y_m[i], b.z_m[i]);
  for (int axis = 0; axis < 3; ++axis) append(bytes_, p[axis]);
  if (hasIntensity(*header_)) append(bytes_, b.intensity[i]);
  if (header_->has_colour) append(bytes_, b.red[i]), append(bytes_, b.green[i]), append(bytes_, b.blue[i]);
  if (header_->has_labels)
    append(bytes_, static_cast<std::int32_t>(b.material[i])), append(bytes_, static_cast<std::int32_t>(b.product[i]));
  if (hasGrid(*header_))
    append(bytes_, static_cast<std::int32_t>(b.row[i])), append(bytes_, static_cast<std::int32_t>(b.column[i]));
  if (header_->has_time) append(bytes_, b.time_s[i]);
  if (header_->has_channel) append(bytes_, b.channel[i]);
  if (header_->has_returns) append(bytes_, b.return_number[i]), append(bytes_, b.return_count[i]);
  if (!header_->has_truth) return;
  const PointTruth& t = b.truth;
  const Eigen::Vector3d true_place = truePose(*header_) * Eigen::Vector3d(t.x_m[i], t.y_m[i], t.z_m[i]);
  for (int axis = 0; axis < 3; ++axis) append(bytes_, true_place[axis]);
  append(bytes_, t.range_m[i]), append(bytes_, t.incidence_rad[i]), append(bytes_, t.received_db[i]),
      append(bytes_, t.flags[i]);
}

Result<void> Writer::write(const PointBlock& block) {
  if (!header_ || ended_) return failure(ErrorKind::internal, "points outside a scan", file_.file().string());
  if (block.size() == 0) return {};
  TRY(checkBlock(*header_, block));
  bytes_.clear();
  for (std::size_t i = 0; i < block.size(); ++i) putPoint(block, i);
  points_ += block.size();
  return file_.append(bytes_);
}

Result<void> Writer::end() {
  if (!header_ || ended_)
    return failure(ErrorKind::internal, "a scan ends that was not started", file_.file().string());
  ended_ = true;
  const std::string text = headerText();
  return file_.overwrite(0, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

Result<void> Writer::close() {
  if (!ended_) return failure(ErrorKind::unusable, "no complete scan to write", file_.file().string());
  return file_.commit();
}

}  // namespace

Result<std::unique_ptr<CloudWriter>> createWriter(const std::filesystem::path& file) {
  TRY_ASSIGN(auto part, PartFile::create(file));
  return std::make_unique<Writer>(std::move(part));
}

}  // namespace ply
}  // namespace standpoint
