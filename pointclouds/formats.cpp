// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/formats.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <utility>

#include "pointclouds/e57/e57.h"
#include "pointclouds/las/las.h"
#include "pointclouds/pcd/pcd.h"
#include "pointclouds/ply/ply.h"
#include "pointclouds/ptx/ptx.h"
#include "pointclouds/text/text_points.h"

namespace standpoint {
namespace {

std::string lowered(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

// A station's name as a part of a file's name.
std::string asFileName(const std::string& name) {
  std::string text;
  for (const char c : name) text += std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_' ? c : '_';
  return text;
}

// Passes scans on to one file, or each to a file of its own.
class Distributor final : public PointSink {
 public:
  Distributor(CloudFormat::Writer writer_of, std::filesystem::path out, bool one_each)
      : writer_of_(writer_of), out_(std::move(out)), one_each_(one_each) {}

  Result<void> open(const std::filesystem::path& file) {
    TRY_ASSIGN(auto writer, writer_of_(file));
    writer_ = std::move(writer);
    pending_ = file;
    return {};
  }
  Result<void> begin(const ScanHeader& header) override {
    if (one_each_)
      if (auto opened = open(fileFor(header.name)); !opened) return opened;
    return writer_->begin(header);
  }
  Result<void> write(const PointBlock& block) override { return writer_->write(block); }
  Result<void> picture(const StationPicture& picture) override { return writer_->picture(picture); }
  Result<void> end() override {
    auto ended = writer_->end();
    return ended && one_each_ ? finish() : ended;
  }
  Result<void> close() override { return one_each_ ? Result<void>{} : finish(); }

  std::vector<std::filesystem::path> files;
  Report report;

 private:
  std::filesystem::path fileFor(const std::string& station) const {
    const std::string stem = out_.stem().string() + "-" + asFileName(station);
    std::filesystem::path file = out_.parent_path() / (stem + out_.extension().string());
    for (int i = 2; std::find(files.begin(), files.end(), file) != files.end(); ++i)
      file = out_.parent_path() / (stem + "-" + std::to_string(i) + out_.extension().string());
    return file;
  }
  Result<void> finish() {
    auto closed = writer_->close();
    if (!closed) return closed;
    report.append(writer_->report());
    files.push_back(pending_);
    return {};
  }
  CloudFormat::Writer writer_of_;
  std::filesystem::path out_, pending_;
  bool one_each_;
  std::unique_ptr<CloudWriter> writer_;
};

class ExtentSink final : public PointSink {
 public:
  explicit ExtentSink(CloudExtent& extent) : extent_(extent) {}
  Result<void> begin(const ScanHeader& header) override { return pose_ = header.file_from_scanner, Result<void>{}; }
  Result<void> write(const PointBlock& block) override {
    for (std::size_t i = 0; i < block.size(); ++i)
      extent_.bounds_file_m.extend(pose_ * Eigen::Vector3d(block.x_m[i], block.y_m[i], block.z_m[i]));
    extent_.points += block.size();
    return {};
  }
  Result<void> end() override { return {}; }
  Result<void> close() override { return {}; }

 private:
  CloudExtent& extent_;
  Pose pose_;
};

Result<const CloudFormat*> known(const std::filesystem::path& file) {
  if (const CloudFormat* format = cloudFormatFor(file)) return format;
  std::string extensions;
  for (const CloudFormat& format : cloudFormats())
    extensions += std::string(extensions.empty() ? "" : ", ") + format.extension;
  return failure(ErrorKind::usage, "no point-cloud format has this extension; use " + extensions, file.string());
}

Result<const CloudFormat*> readable(const std::filesystem::path& file) {
  TRY_ASSIGN(const auto format, known(file));
  if (!format->read)
    return failure(ErrorKind::usage, std::string(format->name) + " files can only be written", file.string());
  return format;
}

}  // namespace

std::span<const CloudFormat> cloudFormats() {
  static const std::array formats = {kE57, kPtx, kPly, kPcd, kLas, kLaz, kPts, kXyz, kCsv};
  return formats;
}

const CloudFormat* cloudFormatFor(const std::filesystem::path& file) {
  const std::string extension = lowered(file.extension().string());
  for (const CloudFormat& format : cloudFormats())
    if (extension == format.extension) return &format;
  return nullptr;
}

Result<CloudFormat::Writer> writerOf(const CloudFormat& format, const std::string& as) {
  if (as.empty()) return format.writer;
  std::string names;
  for (const CloudVariant& variant : format.variants) {
    if (as == variant.name) return variant.writer;
    names += std::string(names.empty() ? "" : ", ") + variant.name;
  }
  return failure(
      ErrorKind::usage,
      std::string(format.name) + " has no variant '" + as + "'" + (names.empty() ? "" : "; available: " + names),
      "--as");
}

const CloudFormat* readableCloudFormat(const std::filesystem::path& file) {
  const CloudFormat* const format = cloudFormatFor(file);
  if (!format || !format->read) return nullptr;
  return std::string_view(format->name) == kPly.name && ply::hasFaces(file) ? nullptr : format;
}

Result<Report> readCloud(const std::filesystem::path& file, PointSink& sink, Progress& progress) {
  TRY_ASSIGN(const auto format, readable(file));
  return format->read(file, sink, progress);
}

Result<CloudExtent> measureCloud(const std::filesystem::path& file, Progress& progress) {
  TRY_ASSIGN(const auto format, readable(file));
  TRY_ASSIGN(const auto info, format->info(file));
  CloudExtent extent{.format = info.format, .crs = info.crs};
  ExtentSink sink(extent);
  TRY_ASSIGN(auto report, format->read(file, sink, progress));
  extent.report = std::move(report);
  return extent;
}

Result<std::vector<std::filesystem::path>> convertCloud(const std::vector<std::filesystem::path>& in,
                                                        const std::filesystem::path& out, const std::string& as,
                                                        Report& report, Progress& progress, const SinkBefore& through) {
  std::vector<const CloudFormat*> from;
  for (const auto& file : in) {
    TRY_ASSIGN(const auto format, readable(file));
    from.push_back(format);
  }
  TRY_ASSIGN(const auto to, known(out));
  if (!to->writer) return failure(ErrorKind::usage, std::string(to->name) + " files can only be read", out.string());
  TRY_ASSIGN(const auto writer, writerOf(*to, as));
  bool one_each = !to->many_scans && in.size() > 1;
  if (!to->many_scans && in.size() == 1) {
    TRY_ASSIGN(const auto info, from.front()->info(in.front()));
    one_each = info.scans.size() > 1;
  }
  Distributor distributor(writer, out, one_each);
  if (!one_each) TRY(distributor.open(out));
  const std::unique_ptr<PointSink> before = through ? through(distributor) : nullptr;
  PointSink& sink = before ? *before : distributor;
  const auto files = static_cast<double>(in.size());
  for (std::size_t i = 0; i < in.size(); ++i) {
    const auto done = static_cast<double>(i);
    if (in.size() > 1) progress.stage("Convert " + in[i].filename().string(), done / files, (done + 1) / files);
    TRY_ASSIGN(const auto lost, from[i]->read(in[i], sink, progress));
    report.append(lost);
  }
  TRY(sink.close());
  report.append(distributor.report);
  return distributor.files;
}

}  // namespace standpoint
