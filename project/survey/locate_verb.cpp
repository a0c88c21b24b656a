// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/survey/locate_verb.h"

#include <algorithm>
#include <memory>

#include <fmt/format.h>

#include "pointclouds/formats.h"

namespace standpoint {

namespace {

namespace fs = std::filesystem;

bool isThere(const fs::path& file) {
  std::error_code ignored;
  return fs::is_regular_file(file, ignored);
}

bool isFolder(const fs::path& file) {
  std::error_code ignored;
  return fs::is_directory(file, ignored);
}

ProjectFile& rowOf(std::vector<ProjectFile>& files, const fs::path& file) {
  const auto at = std::find_if(files.begin(), files.end(), [&](const ProjectFile& f) { return f.file == file; });
  if (at != files.end()) return *at;
  return files.emplace_back(ProjectFile{file, isThere(file), {}});
}

Result<const CloudFormat*> formatOf(const fs::path& file) {
  const CloudFormat* const format = readableCloudFormat(file);
  if (format == nullptr) return failure(ErrorKind::unusable, "this is no point cloud", file.string());
  return format;
}

// `name`: of the station or trajectory that it is a scan of.
Result<void> fitsScan(const CloudInfo& info, const std::string& name, const Scan& scan, const fs::path& file) {
  std::uint64_t all = 0;
  for (const auto& in_file : info.scans) {
    if (in_file.points == scan.points && (info.scans.size() == 1 || in_file.header.name == name)) return {};
    all += in_file.points;
  }
  return failure(
      ErrorKind::unusable,
      fmt::format("this is another file: it has {} points in {} scans, and none is that of {} with {} points", all,
                  info.scans.size(), name, scan.points),
      file.string());
}

Result<void> fitsUnderlay(const Underlay& underlay, const fs::path& file, Progress& progress) {
  constexpr double kSame_m = 1e-6;
  TRY_ASSIGN(const auto extent, measureCloud(file, progress));
  const auto &old = underlay.bounds_cloud_m, &now = extent.bounds_file_m;
  const bool same_place = !now.empty() && std::max((old.min - now.min).norm(), (old.max - now.max).norm()) < kSame_m;
  if (extent.points == underlay.points && same_place) return {};
  return failure(ErrorKind::unusable,
                 extent.points == underlay.points
                     ? fmt::format("this is another cloud: its points are in another place than those of underlay {}",
                                   underlay.name)
                     : fmt::format("this is another cloud: it has {} points, underlay {} has {}", extent.points,
                                   underlay.name, underlay.points),
                 file.string());
}

// What the project knows of `old` is in `file`.
Result<void> checkSame(const Document& document, const fs::path& old, const fs::path& file, Progress& progress) {
  progress.stage("Reading " + file.filename().string());
  // The way itself may be another one: its file is taken as it is.
  const auto& trajectories = document.job->trajectories;
  if (std::any_of(trajectories.begin(), trajectories.end(), [&](const auto& t) { return old == t.file; })) return {};
  TRY_ASSIGN(const auto format, formatOf(file));
  std::optional<CloudInfo> info;
  const auto check = [&](const auto& scanned) -> Result<void> {
    for (const auto& scan : scanned.scans) {
      if (old != scan.file) continue;
      if (!info) {
        TRY_ASSIGN(info, format->info(file));
      }
      TRY(fitsScan(*info, scanned.name, scan, file));
    }
    return {};
  };
  for (const auto& station : document.job->stations) TRY(check(station));
  for (const auto& trajectory : trajectories) TRY(check(trajectory));
  for (const auto& underlay : document.underlays)
    if (old == underlay->file) TRY(fitsUnderlay(*underlay, file, progress));
  return {};
}

void pointTo(Document& document, const fs::path& old, const fs::path& file) {
  const auto job = std::make_shared<Job>(*document.job);
  bool in_job = false;
  const auto point = [&](std::string& known) {
    if (old != known) return;
    known = file.string();
    in_job = true;
  };
  for (auto& station : job->stations)
    for (auto& scan : station.scans) point(scan.file);
  for (auto& trajectory : job->trajectories) {
    point(trajectory.file);
    for (auto& scan : trajectory.scans) point(scan.file);
  }
  if (in_job) document.job = job;
  for (auto& underlay : document.underlays) {
    if (old != underlay->file) continue;
    const auto moved = std::make_shared<Underlay>(*underlay);
    moved->file = file.string();
    underlay = moved;
  }
}

std::string textOf(const std::vector<ProjectFile>& files) {
  if (files.empty()) return "the project uses no scans and no clouds\n";
  std::string text;
  for (const auto& f : files)
    text += fmt::format("{:<8}{}  ({})\n", f.there ? "there" : "missing", f.file.string(), fmt::join(f.used_by, ", "));
  return text;
}

// As the project has it, or the only one of this name.
Result<fs::path> wantedOf(const std::vector<ProjectFile>& files, const fs::path& asked) {
  const ProjectFile* named = nullptr;
  int of_this_name = 0;
  std::string names;
  for (const auto& f : files) {
    if (f.file == asked || f.file == fs::absolute(asked).lexically_normal()) return f.file;
    if (f.file.filename() == asked) named = &f, ++of_this_name;
    names += (names.empty() ? "" : ", ") + f.file.string();
  }
  if (of_this_name == 1) return named->file;
  return failure(ErrorKind::usage,
                 of_this_name > 1
                     ? "the project has several files of this name; specify one with its folder: " + names
                     : "the project does not use this file; it uses " + (names.empty() ? std::string("none") : names),
                 asked.string());
}

}  // namespace

std::vector<ProjectFile> filesOf(const Document& document) {
  std::vector<ProjectFile> files;
  if (document.job) {
    for (const auto& station : document.job->stations)
      for (const auto& scan : station.scans) rowOf(files, scan.file).used_by.push_back("scan of " + station.name);
    for (const auto& trajectory : document.job->trajectories) {
      if (!trajectory.file.empty()) rowOf(files, trajectory.file).used_by.push_back("trajectory " + trajectory.name);
      for (const auto& scan : trajectory.scans)
        rowOf(files, scan.file).used_by.push_back("scan along " + trajectory.name);
    }
  }
  for (const auto& underlay : document.underlays)
    rowOf(files, underlay->file).used_by.push_back("underlay " + underlay->name);
  return files;
}

const Fields<LocateOptions>& locateFields() {
  using O = LocateOptions;
  static const Fields<O> fields = {
      {"file", &O::file, "file that has moved, as the project lists it, or its name (default: all that are missing)"},
      {"to", &O::to, "where it is now, or a folder with files of the same names"}};
  return fields;
}

const AnswerFields<ProjectFile>& answerFields(const ProjectFile*) {
  using A = ProjectFile;
  static const AnswerFields<A> fields = {{"file", &A::file}, {"there", &A::there}, {"used_by", &A::used_by}};
  return fields;
}

const AnswerFields<LocatedFile>& answerFields(const LocatedFile*) {
  using A = LocatedFile;
  static const AnswerFields<A> fields = {{"from", &A::from}, {"to", &A::to}};
  return fields;
}

const AnswerFields<LocateAnswer>& answerFields(const LocateAnswer*) {
  using A = LocateAnswer;
  static const AnswerFields<A> fields = {{"located", &A::located}, {"files", &A::files}};
  return fields;
}

Result<Answered<LocateAnswer>> runLocate(const Document& document, const LocateOptions& options, Progress& progress) {
  progress.stage("Locate files");
  Answered<LocateAnswer> outcome{document};
  const auto files = filesOf(document);
  if (options.file && !options.to) return failure(ErrorKind::usage, "specify where the file is now", "--to");
  std::vector<fs::path> wanted;
  if (options.file) {
    TRY_ASSIGN(auto one, wantedOf(files, *options.file));
    wanted.push_back(std::move(one));
  } else if (options.to) {
    for (const auto& f : files)
      if (!f.there) wanted.push_back(f.file);
    if (wanted.empty()) return failure(ErrorKind::usage, "all files of the project are where it has them", "--to");
  }
  const fs::path to = options.to ? fs::absolute(*options.to).lexically_normal() : fs::path();
  if (options.to && !isFolder(to) && !isThere(to))
    return failure(ErrorKind::file_system, "file not found", to.string());
  if (wanted.size() > 1 && !isFolder(to))
    return failure(ErrorKind::usage,
                   fmt::format("{} files are missing: specify a folder, or which of them it is", wanted.size()),
                   "--to");
  for (const auto& old : wanted) {
    const fs::path file = isFolder(to) ? to / old.filename() : to;
    const auto same =
        isThere(file) ? checkSame(document, old, file, progress)
                      : Result<void>(failure(ErrorKind::file_system, "there is no file of this name", file.string()));
    if (!same && (wanted.size() == 1 || same.error().kind == ErrorKind::cancelled)) return tl::unexpected(same.error());
    if (!same) {
      outcome.report.warn(same.error().source, same.error().message);
      continue;
    }
    pointTo(outcome.document, old, file);
    outcome.answer.located.push_back({old, file});
  }
  const auto& located = outcome.answer.located;
  if (located.size() == 1)
    outcome.description = fmt::format("Located {}", located.front().to.filename().string());
  else if (!located.empty())
    outcome.description = fmt::format("Located {} files", located.size());
  outcome.answer.files = filesOf(outcome.document);
  outcome.text = textOf(outcome.answer.files);
  return outcome;
}

}  // namespace standpoint
