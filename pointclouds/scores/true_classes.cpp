// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/scores/true_classes.h"

#include <optional>

#include "pointclouds/files/block_check.h"
#include "pointclouds/formats.h"

namespace standpoint {

namespace {

class TrueClassSink : public PointSink {
 public:
  TrueClassSink(const std::filesystem::path& cloud, const ClassMap& map) : cloud_(cloud), map_(map) {}

  Result<void> begin(const ScanHeader& header) override {
    if (!header.has_labels)
      return failure(ErrorKind::unusable, "points have no labels: only a simulated scan knows the truth",
                     cloud_.filename().string() + " scan " + header.name);
    header_ = header;
    classes_.emplace(map_, header);
    return {};
  }
  Result<void> write(const PointBlock& block) override {
    if (block.size() == 0) return {};
    TRY(checkBlock(header_, block));
    for (std::size_t i = 0; i < block.size(); ++i) {
      labels.ids.push_back(map_.classes[classes_->of(block, i)].id);
      labels.instances.push_back(classes_->isSurfaceless(block, i) ? 0 : block.product[i] + 1);
    }
    return {};
  }
  Result<void> end() override { return {}; }
  Result<void> close() override { return {}; }

  PointLabels labels;

 private:
  const std::filesystem::path& cloud_;
  const ClassMap& map_;
  ScanHeader header_;
  std::optional<PointClasses> classes_;  // of this scan
};

}  // namespace

Result<PointLabels> trueClasses(const std::filesystem::path& cloud, const ClassMap& map, Progress& progress) {
  const auto* const format = readableCloudFormat(cloud);
  if (format == nullptr || format->read == nullptr)
    return failure(ErrorKind::usage, "unsupported point-cloud format", cloud.string());
  TrueClassSink sink(cloud, map);
  TRY(format->read(cloud, sink, progress));
  return std::move(sink.labels);
}

}  // namespace standpoint
