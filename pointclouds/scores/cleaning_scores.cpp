// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/scores/cleaning_scores.h"

#include <map>
#include <utility>

#include "pointclouds/files/block_check.h"
#include "pointclouds/formats.h"

namespace standpoint {

namespace {

// Points of scans with truth, by their number in the file.
class CleanedSink : public PointSink {
 public:
  CleanedSink(const std::filesystem::path& cloud, const std::vector<std::uint8_t>& kept) : cloud_(cloud), kept_(kept) {}
  Result<void> begin(const ScanHeader& header) override {
    if (!header.has_truth)
      return failure(ErrorKind::unusable,
                     "without true values nobody knows what a cleaning should remove: use a scan made with --truth",
                     cloud_.string() + " scan " + header.name);
    header_ = header;
    beginTruth();
    return {};
  }
  Result<void> write(const PointBlock& block) override {
    if (number_ + block.size() > kept_.size())
      return failure(ErrorKind::unusable, "the file has changed while it was read", cloud_.string());
    if (block.size() > 0) TRY(checkBlock(header_, block));
    for (std::size_t i = 0; i < block.size(); ++i, ++number_) take(block, i, kept_[number_] == 0);
    return {};
  }
  Result<void> end() override { return {}; }
  Result<void> close() override { return {}; }

 protected:
  virtual void beginTruth() {}
  virtual void take(const PointBlock& block, std::size_t i, bool is_removed) = 0;
  ScanHeader header_;

 private:
  const std::filesystem::path& cloud_;
  const std::vector<std::uint8_t>& kept_;
  std::uint64_t number_ = 0;
};

class TallySink final : public CleanedSink {
 public:
  using CleanedSink::CleanedSink;

  CleaningScores scores() {
    for (auto& [name, one] : classes_)
      if (one.good.in + one.flawed.in > 0) scores_.classes.push_back(std::move(one));
    for (auto& [key, one] : movers_)
      if (one.points.in > 0) scores_.movers.push_back(std::move(one));
    return std::move(scores_);
  }

 private:
  void beginTruth() override {
    is_plainly_mixed_ = PlainlyMixed(header_);
    of_product_.clear();
    if (!header_.has_labels) return;
    for (const LabelledProduct& product : header_.products) {
      auto& of_class = classes_[product.ifc_class];
      of_class.name = product.ifc_class;
      auto& mover = movers_[{product.name, product.id}];
      mover.id = product.id, mover.name = product.name;
      of_product_.emplace_back(&of_class, &mover);
    }
  }
  void take(const PointBlock& b, std::size_t i, bool is_removed) override {
    const auto add = [is_removed](Taken& to) { ++to.in, to.taken += is_removed ? 1 : 0; };
    const std::uint8_t flags = b.truth.flags[i];
    const bool is_flawed = (flags & kFlawed) != 0;
    add(scores_.points);
    add(is_flawed ? scores_.flawed : scores_.good);
    for (std::size_t bit = 0; flags != 0 && bit < scores_.flags.size(); ++bit)
      if ((flags >> bit & 1) != 0) add(scores_.flags[bit]);
    if (is_plainly_mixed_(b, i)) add(scores_.plainly_mixed);
    if (!header_.has_labels) return;
    const auto& [of_class, mover] = of_product_[b.product[i]];
    add(is_flawed ? of_class->flawed : of_class->good);
    if ((flags & point_flag::kMoving) != 0) add(mover->points);
  }

  CleaningScores scores_;
  PlainlyMixed is_plainly_mixed_;
  std::map<std::string, CleanedClass> classes_;
  std::map<std::pair<std::string, std::string>, CleanedMover> movers_;
  std::vector<std::pair<CleanedClass*, CleanedMover*>> of_product_;  // of this scan
};

class ShowSink final : public CleanedSink {
 public:
  ShowSink(const std::filesystem::path& cloud, const std::vector<std::uint8_t>& kept, const TakeCleaned& take)
      : CleanedSink(cloud, kept), take_(take) {}

 private:
  void take(const PointBlock& b, std::size_t i, bool is_removed) override {
    const Eigen::Vector3d at = header_.file_from_scanner * Eigen::Vector3d(b.x_m[i], b.y_m[i], b.z_m[i]);
    if (at.allFinite()) take_({at, (b.truth.flags[i] & kFlawed) != 0, is_removed});
  }
  const TakeCleaned& take_;
};

}  // namespace

Result<CleaningScores> cleaningScores(const std::filesystem::path& truth, const std::vector<std::uint8_t>& kept,
                                      Progress& progress) {
  TallySink sink(truth, kept);
  TRY(readCloud(truth, sink, progress));
  return sink.scores();
}

Result<void> forEachCleaned(const std::filesystem::path& truth, const std::vector<std::uint8_t>& kept,
                            const TakeCleaned& take, Progress& progress) {
  ShowSink sink(truth, kept, take);
  TRY(readCloud(truth, sink, progress));
  return {};
}

}  // namespace standpoint
