// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/dataset/cloud_size.h"

#include <algorithm>
#include <optional>

#include "core/scratch_folder.h"
#include "pointclouds/formats.h"

namespace standpoint {

namespace {

namespace fs = std::filesystem;

constexpr double kPoints = 20000;  // that are measured, about
constexpr double kLeastFraction = 0.002;

// Keeps a scan's header and points.
class ScanSample : public PointSink {
 public:
  Result<void> begin(const ScanHeader& header) override {
    header_ = header;
    return {};
  }
  Result<void> write(const PointBlock& block) override {
    for (std::size_t i = 0; i < block.size(); ++i)
      if (!block.column.empty()) columns_ = std::max(columns_, block.column[i] + 1);
    points_ += block.size();
    blocks_.push_back(block);
    return {};
  }
  Result<void> end() override { return {}; }
  Result<void> close() override { return {}; }

  const ScanHeader& header() const { return *header_; }
  std::uint32_t columns() const { return columns_; }  // that have points
  std::size_t points() const { return points_; }
  const std::vector<PointBlock>& blocks() const { return blocks_; }

 private:
  std::optional<ScanHeader> header_;
  std::uint32_t columns_ = 1;
  std::size_t points_ = 0;
  std::vector<PointBlock> blocks_;
};

class CloudScale {
 public:
  CloudScale(CloudFormat::Writer writer, fs::path file) : writer_(writer), file_(std::move(file)) {}

  // Of a grid with so many columns.
  Result<double> weigh(ScanHeader header, std::uint32_t columns, const std::vector<PointBlock>& blocks) const {
    header.columns = columns;
    TRY_ASSIGN(const auto writer, writer_(file_));
    TRY(writer->begin(header));
    for (const auto& block : blocks) TRY(writer->write(block));
    TRY(writer->end());
    TRY(writer->close());
    std::error_code error;
    const auto bytes = fs::file_size(file_, error);
    if (error) return failure(ErrorKind::file_system, "cannot measure: " + error.message(), file_.string());
    return static_cast<double>(bytes);
  }

 private:
  CloudFormat::Writer writer_;
  fs::path file_;
};

}  // namespace

Result<CloudSize> measureCloudSize(const Recipe& recipe, const RecipeInstrument& instrument, const Document& document,
                                   const Station& station, std::shared_ptr<const ScanPreparation> preparation,
                                   double points, Progress& progress) {
  TRY_ASSIGN(const auto scratch, ScratchFolder::make());
  const auto sample = std::make_shared<ScanSample>();
  ScanVerbOptions options;
  options.stations.names = {station.name};
  options.instrument = instrument.instrument;
  options.settings = instrument.settings;
  options.truth = recipe.truth;
  options.field_fault.until_fraction = points > 0 ? std::clamp(kPoints / points, kLeastFraction, 1.0) : 1;
  options.output = scratch.path() / "points.xyz";
  ScanSurroundings company;
  company.preparation = std::move(preparation);
  company.watcher = sample;
  TRY(runScan(document, options, company, progress));
  TRY_ASSIGN(const auto writer, writerOf(*cloudFormatFor("x." + recipe.format), recipe.as));
  const CloudScale scale(writer, scratch.path() / ("cloud" + recipe.extension()));
  const auto& header = sample->header();
  const auto few = sample->columns();
  TRY_ASSIGN(const double narrow, scale.weigh(header, few, {}));
  TRY_ASSIGN(const double wide, scale.weigh(header, 2 * few, {}));
  CloudSize size;
  const double cells = static_cast<double>(header.rows) * few;
  // A few bytes more are longer numbers in the head of the file.
  constexpr double kLeastOfCell = 0.5;
  if (cells > 0 && wide - narrow >= kLeastOfCell * cells) size.cell = (wide - narrow) / cells;
  // How many bits a column's number has depends on the whole grid; where each cell is stored that would be much.
  const auto columns = size.cell > 0 ? few : header.columns;
  TRY_ASSIGN(const double empty, scale.weigh(header, columns, {}));
  size.file = empty - size.cell * static_cast<double>(header.rows) * columns;
  if (sample->points() == 0) return size;
  TRY_ASSIGN(const double full, scale.weigh(header, columns, sample->blocks()));
  size.point = (full - empty) / static_cast<double>(sample->points());
  return size;
}

}  // namespace standpoint
