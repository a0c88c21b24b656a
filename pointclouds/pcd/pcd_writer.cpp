// SPDX-License-Identifier: GPL-3.0-or-later
#include <bit>
#include <cstring>
#include <limits>
#include <optional>

#include "core/part_file.h"
#include "pointclouds/files/block_check.h"
#include "pointclouds/files/number_text.h"
#include "pointclouds/files/raw_bytes.h"
#include "pointclouds/files/scan_text.h"
#include "pointclouds/pcd/pcd.h"

namespace standpoint {
namespace pcd {
namespace {

constexpr std::size_t kBuffered = 1 << 20;
constexpr std::uint64_t kMostCells = std::uint64_t{1} << 32;
constexpr std::uint64_t kManyCells = std::uint64_t{1} << 28;  // a damaged header must not fill the disk

class Writer final : public CloudWriter {
 public:
  Writer(PartFile file, bool organised) : file_(std::move(file)), wants_grid_(organised) {}
  Result<void> begin(const ScanHeader& header) override;
  Result<void> write(const PointBlock& block) override;
  Result<void> end() override;
  Result<void> close() override;

 private:
  std::string headerText() const;
  std::string fieldLines() const;
  void putPoint(const PointBlock& block, std::size_t i);
  Result<void> fillTo(std::uint64_t cell);
  Result<void> flushFrom(std::size_t enough);

  PartFile file_;
  bool wants_grid_, organised_ = false, ended_ = false;
  std::optional<ScanHeader> header_;
  std::vector<std::uint8_t> missing_;  // a cell without a point
  std::uint64_t next_cell_ = 0, points_ = 0, crowded_ = 0;
  std::vector<std::uint8_t> bytes_;
};

std::string Writer::fieldLines() const {
  const ScanHeader& h = *header_;
  std::string names = "FIELDS x y z", sizes = "SIZE 4 4 4", types = "TYPE F F F", counts = "COUNT 1 1 1";
  const auto add = [&](bool wanted, std::initializer_list<const char*> fields, const char* size, const char* type) {
    if (!wanted) return;
    for (const char* field : fields)
      names += std::string(" ") + field, sizes += std::string(" ") + size, types += std::string(" ") + type,
          counts += " 1";
  };
  add(hasIntensity(h), {"intensity"}, "4", "F");
  add(h.has_colour, {"rgb"}, "4", "F");
  add(h.has_labels, {"label", "instance"}, "4", "U");
  add(hasGrid(h) && !organised_, {"row", "column"}, "4", "U");
  add(h.has_time, {"time"}, "8", "F");
  add(h.has_channel, {"ring"}, "2", "U");  // as drivers of such heads call it
  add(h.has_returns, {"return_number", "return_count"}, "1", "U");
  add(h.has_truth, {"true_x", "true_y", "true_z", "true_range", "incidence", "received_power"}, "4", "F");
  add(h.has_truth, {"flags"}, "1", "U");
  return names + "\n" + sizes + "\n" + types + "\n" + counts + "\n";
}

// Always as long: the number of points is known last.
std::string Writer::headerText() const {
  const auto padded = [](std::uint64_t n) {
    const std::string digits = std::to_string(n);
    return std::string(12 - std::min<std::size_t>(digits.size(), 12), '0') + digits;
  };
  std::string text = "# .PCD v0.7 - Point Cloud Data file format\n";
  for (const auto& line : scanLines(*header_)) text += "# standpoint " + line + "\n";
  if (header_->has_labels)
    for (const auto& line : tableLines(header_->products, header_->materials)) text += "# standpoint " + line + "\n";
  text += "VERSION 0.7\n" + fieldLines();
  text += "WIDTH " + padded(organised_ ? header_->rows : points_) + "\nHEIGHT " +
          padded(organised_ ? header_->columns : 1) + "\nVIEWPOINT";
  const Pose& pose = header_->file_from_scanner;
  const Eigen::Quaterniond q = pose.rotation.normalized();
  for (const double v : {pose.translation.x(), pose.translation.y(), pose.translation.z(), q.w(), q.x(), q.y(), q.z()})
    text += ' ', appendNumber(text, v + 0.0);
  const std::uint64_t cells = organised_ ? std::uint64_t{header_->rows} * header_->columns : points_;
  return text + "\nPOINTS " + padded(cells) + "\nDATA binary\n";
}

void Writer::putPoint(const PointBlock& b, std::size_t i) {
  const ScanHeader& h = *header_;
  append(bytes_, b.x_m[i]), append(bytes_, b.y_m[i]), append(bytes_, b.z_m[i]);
  if (hasIntensity(h)) append(bytes_, b.intensity[i]);
  if (h.has_colour) append(bytes_, std::uint32_t{b.red[i]} << 16 | std::uint32_t{b.green[i]} << 8 | b.blue[i]);
  if (h.has_labels) append(bytes_, b.material[i]), append(bytes_, b.product[i]);
  if (hasGrid(h) && !organised_) append(bytes_, b.row[i]), append(bytes_, b.column[i]);
  if (h.has_time) append(bytes_, b.time_s[i]);
  if (h.has_channel) append(bytes_, std::uint16_t{b.channel[i]});
  if (h.has_returns) append(bytes_, b.return_number[i]), append(bytes_, b.return_count[i]);
  if (!h.has_truth) return;
  const PointTruth& t = b.truth;
  append(bytes_, t.x_m[i]), append(bytes_, t.y_m[i]), append(bytes_, t.z_m[i]), append(bytes_, t.range_m[i]),
      append(bytes_, t.incidence_rad[i]), append(bytes_, t.received_db[i]);
  append(bytes_, t.flags[i]);
}

Result<void> Writer::begin(const ScanHeader& header) {
  if (header_) return failure(ErrorKind::internal, "a PCD file can hold only one scan", file_.file().string());
  if (auto checked = checkHeader(header); !checked) return checked;
  header_ = header;
  organised_ = wants_grid_ && hasGrid(header);
  if (organised_ && std::uint64_t{header.rows} * header.columns > kMostCells)
    return failure(ErrorKind::unusable,
                   "the grid has too many cells for a PCD file: write a list of points (variant points)",
                   "scan " + header.name);
  missing_.resize(std::size_t{12} + (hasIntensity(header) ? 4 : 0) + (header.has_colour ? 4 : 0) +
                  (header.has_labels ? 8 : 0) + (header.has_time ? 8 : 0) + (header.has_channel ? 2 : 0) +
                  (header.has_returns ? 2 : 0) + (header.has_truth ? 25 : 0));
  const float none = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t k = 0; k < 3; ++k) std::memcpy(missing_.data() + 4 * k, &none, 4);
  const std::string text = headerText();
  return file_.append({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

Result<void> Writer::flushFrom(std::size_t enough) {
  if (bytes_.size() < enough) return {};
  const auto appended = file_.append(bytes_);
  bytes_.clear();
  return appended;
}

Result<void> Writer::fillTo(std::uint64_t cell) {
  if (cell > kManyCells && points_ < cell / 1000)
    return failure(ErrorKind::unusable,
                   "the grid is almost empty, so a PCD file would store gigabytes of missing points: write a list of "
                   "points (variant points)",
                   "scan " + header_->name);
  for (; next_cell_ < cell; ++next_cell_) {
    bytes_.insert(bytes_.end(), missing_.begin(), missing_.end());
    if (auto flushed = flushFrom(kBuffered); !flushed) return flushed;
  }
  return {};
}

Result<void> Writer::write(const PointBlock& block) {
  if (!header_ || ended_) return failure(ErrorKind::internal, "points outside a scan", file_.file().string());
  if (block.size() == 0) return {};
  TRY(checkBlock(*header_, block));
  for (std::size_t i = 0; i < block.size(); ++i) {
    const std::uint64_t cell = organised_ ? std::uint64_t{block.column[i]} * header_->rows + block.row[i] : next_cell_;
    if (cell + 1 == next_cell_) {
      ++crowded_;
      continue;
    }
    if (cell < next_cell_)
      return failure(ErrorKind::unusable,
                     "an organised PCD requires points column by column from bottom to top: write a list of points "
                     "(variant points)",
                     "scan " + header_->name);
    if (auto filled = fillTo(cell); !filled) return filled;
    putPoint(block, i);
    ++points_;
    ++next_cell_;
    if (auto flushed = flushFrom(kBuffered); !flushed) return flushed;
  }
  return {};
}

Result<void> Writer::end() {
  if (!header_ || ended_)
    return failure(ErrorKind::internal, "a scan ends that was not started", file_.file().string());
  ended_ = true;
  if (organised_)
    if (auto filled = fillTo(std::uint64_t{header_->rows} * header_->columns); !filled) return filled;
  if (auto flushed = flushFrom(0); !flushed) return flushed;
  if (crowded_ > 0)
    report_.lose(header_->name, std::to_string(crowded_) +
                                    " additional returns dropped: a cell of an organised PCD holds one point; write a "
                                    "list of points (variant points) to keep all");
  const std::string text = headerText();
  return file_.overwrite(0, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

Result<void> Writer::close() {
  if (!ended_) return failure(ErrorKind::unusable, "no complete scan to write", file_.file().string());
  return file_.commit();
}

Result<std::unique_ptr<CloudWriter>> createOrganised(const std::filesystem::path& file) {
  return createWriter(file, true);
}
Result<std::unique_ptr<CloudWriter>> createList(const std::filesystem::path& file) { return createWriter(file, false); }

constexpr CloudVariant kVariants[] = {{"points", "a list of points, with every return of a pulse", createList}};

}  // namespace

Result<std::unique_ptr<CloudWriter>> createWriter(const std::filesystem::path& file, bool organised) {
  TRY_ASSIGN(auto part, PartFile::create(file));
  return std::make_unique<Writer>(std::move(part), organised);
}

}  // namespace pcd

const CloudFormat kPcd = {"pcd",
                          "PCD: one scan in its scanner's frame, organised where it has a grid",
                          ".pcd",
                          false,
                          pcd::createOrganised,
                          pcd::read,
                          pcd::info,
                          pcd::kVariants};

}  // namespace standpoint
