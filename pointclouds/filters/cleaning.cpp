// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/filters/cleaning.h"

#include <cmath>
#include <cstdio>
#include <utility>

#include "core/random.h"
#include "pointclouds/formats.h"
#include "pointclouds/statistics/cloud_sample.h"

namespace standpoint {
namespace {

// Shows a filter the whole file.
class PassSink final : public PointSink {
 public:
  PassSink(PointFilter& filter, Fates& fates, std::uint8_t number)
      : filter_(filter), fates_(fates), remaining_(fates, number) {}
  Result<void> begin(const ScanHeader& header) override { return filter_.beginScan(header); }
  Result<void> write(const PointBlock& block) override {
    if (next_ + block.size() > fates_.size()) fates_.resize(next_ + block.size(), 0);  // in the first pass
    auto seen = filter_.see(block, next_, remaining_);
    next_ += block.size();
    return seen;
  }
  Result<void> end() override { return filter_.endScan(remaining_); }
  Result<void> close() override { return {}; }
  Result<bool> again() { return filter_.endPass(remaining_); }

 private:
  PointFilter& filter_;
  Fates& fates_;
  Remaining remaining_;
  std::uint64_t next_ = 0;
};

template <class T>
void keepOnly(std::vector<T>& values, const std::vector<std::uint32_t>& stay) {
  if (values.empty()) return;
  for (std::size_t i = 0; i < stay.size(); ++i) values[i] = values[stay[i]];  // stay[i] >= i
  values.resize(stay.size());
}

void keepOnly(PointBlock& b, const std::vector<std::uint32_t>& stay) {
  PointTruth& t = b.truth;
  for (auto* floats :
       {&b.x_m, &b.y_m, &b.z_m, &b.intensity, &t.x_m, &t.y_m, &t.z_m, &t.range_m, &t.incidence_rad, &t.received_db})
    keepOnly(*floats, stay);
  for (auto* indices : {&b.row, &b.column, &b.product, &b.material}) keepOnly(*indices, stay);
  for (auto* bytes : {&b.red, &b.green, &b.blue, &b.channel, &b.return_number, &b.return_count, &t.flags})
    keepOnly(*bytes, stay);
  keepOnly(b.time_s, stay);
}

// The last pass: counts what each filter took, and passes on what is left.
class LastSink final : public PointSink {
 public:
  LastSink(PointSink& to, const Fates& fates, Cleaning& cleaning) : to_(to), fates_(fates), cleaning_(cleaning) {
    for (const FilterFigures& f : cleaning.filters) words_ += (words_.empty() ? "" : " ") + f.filter;
  }

  Result<void> begin(const ScanHeader& header) override {
    header_ = header;
    is_plainly_mixed_ = PlainlyMixed(header);
    countsOfClass();
    for (FilterFigures& f : cleaning_.filters) f.has_truth |= header.has_truth, f.has_labels |= header.has_labels;
    ScanHeader cleaned = header;  // it is another scan than it was
    const std::uint64_t hash = stableHash(words_.c_str(), stableHash(header.guid.c_str()));
    char guid[64];
    std::snprintf(guid, sizeof guid, "{%08x-%04x-8%03x-8%03x-%012llx}", static_cast<unsigned>(hash >> 32U),
                  static_cast<unsigned>(hash >> 16U) & 0xFFFFU, static_cast<unsigned>(hash >> 4U) & 0xFFFU,
                  static_cast<unsigned>(hash) & 0xFFFU,
                  static_cast<unsigned long long>(stableHash(header.name.c_str(), hash) & 0xFFFFFFFFFFFFULL));
    cleaned.guid = guid;
    cleaned.description += (cleaned.description.empty() ? "cleaned: " : "; cleaned: ") + words_;
    return to_.begin(cleaned);
  }

  Result<void> write(const PointBlock& block) override {
    stay_.clear();
    for (std::size_t i = 0; i < block.size(); ++i) {
      const std::uint8_t fate = next_ + i < fates_.size() ? fates_[next_ + i] : std::uint8_t{0};
      count(block, i, fate);
      if (fate == 0) stay_.push_back(static_cast<std::uint32_t>(i));
    }
    next_ += block.size();
    cleaning_.points_in += block.size();
    cleaning_.points_out += stay_.size();
    if (stay_.empty()) return {};
    if (stay_.size() == block.size()) return to_.write(block);
    PointBlock left = block;
    keepOnly(left, stay_);
    return to_.write(left);
  }

  Result<void> picture(const StationPicture& picture) override { return to_.picture(picture); }
  Result<void> end() override { return to_.end(); }
  Result<void> close() override { return to_.close(); }

 private:
  void countsOfClass() {
    of_product_.clear();
    if (!header_.has_labels) return;
    for (FilterFigures& f : cleaning_.filters) {
      auto& counts = of_product_.emplace_back();
      for (const LabelledProduct& product : header_.products) counts.push_back(&f.good_of_class[product.ifc_class]);
    }
  }

  void count(const PointBlock& block, std::size_t i, std::uint8_t fate) {
    const std::uint8_t flags = header_.has_truth ? block.truth.flags[i] : std::uint8_t{0};
    const bool good = (flags & kFlawed) == 0;
    const bool plainly_mixed = is_plainly_mixed_(block, i);
    const std::size_t last = fate == 0 ? cleaning_.filters.size() : fate;
    for (std::size_t k = 0; k < last; ++k) {
      FilterFigures& f = cleaning_.filters[k];
      const bool taken = k + 1 == fate;
      const auto add = [taken](Taken& to) { ++to.in, to.taken += taken ? 1 : 0; };
      add(f.points);
      if (header_.has_truth) {
        add(f.with_truth);
        if (good) add(f.good);
        if (plainly_mixed) add(f.plainly_mixed);
        for (std::size_t bit = 0; flags != 0 && bit < f.flags.size(); ++bit)
          if ((flags >> bit & 1) != 0) add(f.flags[bit]);
      }
      if (header_.has_labels && good) add(*of_product_[k][block.product[i]]);
    }
  }

  PointSink& to_;
  const Fates& fates_;
  Cleaning& cleaning_;
  std::string words_;
  ScanHeader header_;
  PlainlyMixed is_plainly_mixed_;
  std::uint64_t next_ = 0;
  std::vector<std::uint32_t> stay_;
  std::vector<std::vector<Taken*>> of_product_;  // by filter, then label
};

Error placed(Error error, const std::filesystem::path& in, const ChosenFilter& filter) {
  if (error.kind == ErrorKind::cancelled || error.kind == ErrorKind::file_system) return error;
  error.source = "--filters " + filter.text + ": " + in.string() + (error.source.empty() ? "" : " " + error.source);
  return error;
}

Result<void> apply(const CloudFormat& format, const std::filesystem::path& in, FilterCloud& cloud,
                   const ChosenFilter& chosen, std::uint8_t number, Fates& fates, Progress& progress) {
  auto filter = chosen.make();
  if (!filter) return failure(placed(filter.error(), in, chosen));
  cloud.carrier = chosen.carrier;
  cloud.progress = &progress;
  if (auto known = (*filter)->know(cloud); !known) return failure(placed(known.error(), in, chosen));
  for (bool again = true; again;) {
    PassSink pass(**filter, fates, number);
    if (const auto read = format.read(in, pass, progress); !read) return failure(placed(read.error(), in, chosen));
    const auto more = pass.again();
    if (!more) return failure(placed(more.error(), in, chosen));
    again = *more;
  }
  return {};
}

}  // namespace

PlainlyMixed::PlainlyMixed(const ScanHeader& header) : from_scanner_(header.has_truth && stationOf(header)) {}

bool PlainlyMixed::operator()(const PointBlock& block, std::size_t i) const {
  if (!from_scanner_ || (block.truth.flags[i] & point_flag::kMixed) == 0) return false;
  const float range_m = Eigen::Vector3f(block.x_m[i], block.y_m[i], block.z_m[i]).norm();
  return std::abs(range_m - block.truth.range_m[i]) > kPlainly_m;
}

const std::array<const char*, 8>& flagNames() {
  static const std::array<const char*, 8> names = {"mixed",     "mirrored", "through_pane", "weather",
                                                   "saturated", "moving",   "noise",        "filtered"};
  return names;
}

Result<Cleaning> cleanCloud(const std::filesystem::path& in, const std::filesystem::path& out,
                            std::span<const ChosenFilter> filters, Progress& progress) {
  if (filters.empty() || filters.size() > 255)
    return failure(ErrorKind::usage, "specify 1 to 255 filters: " + filterList(), "--filters");
  const CloudFormat* const format = cloudFormatFor(in);
  if (!format || !format->read) return failure(ErrorKind::usage, "unsupported point-cloud format", in.string());
  // A wrong option shows before anything is read.
  const CloudFormat* const to = cloudFormatFor(out);
  if (!to || !to->writer) return failure(ErrorKind::usage, "unsupported point-cloud format for writing", out.string());
  for (const ChosenFilter& chosen : filters)
    if (auto made = chosen.make(); !made)
      return failure(ErrorKind::usage, made.error().message, "--filters " + chosen.text);
  TRY_ASSIGN(const auto info, format->info(in));
  FilterCloud cloud;
  for (const ScanInfo& scan : info.scans) cloud.scans.push_back({scan.header.name, stationOf(scan.header)});

  Cleaning cleaning;
  Fates fates;
  const double each = 1.0 / static_cast<double>(filters.size() + 1);
  for (std::size_t k = 0; k < filters.size(); ++k) {
    progress.stage(filters[k].text, static_cast<double>(k) * each, static_cast<double>(k + 1) * each);
    TRY(apply(*format, in, cloud, filters[k], static_cast<std::uint8_t>(k + 1), fates, progress));
    cleaning.filters.emplace_back().filter = filters[k].text;
  }
  progress.stage("Write " + out.filename().string(), 1 - each, 1);
  const auto through = [&](PointSink& writer) { return std::make_unique<LastSink>(writer, fates, cleaning); };
  TRY_ASSIGN(auto files, convertCloud({in}, out, "", cleaning.report, progress, through));
  cleaning.files = std::move(files);
  return cleaning;
}

}  // namespace standpoint
