// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/georeference.h"
#include "core/motion/pose_spline.h"
#include "core/progress.h"
#include "core/report.h"
#include "core/result.h"

namespace standpoint {

// What a trajectory's file does not say itself: how its coordinates lie to the local frame.
struct TrajectoryFrame {
  Pose file_from_local;  // the identity: the file has local coordinates
  double scale = 1;      // metres of the file for one of the local frame: file = file_from_local (scale · local)
  // The projected CRS of a map: geographic coordinates (SBET) become eastings and northings in it, then local ones.
  std::string crs = {};
};
// Of a model that states its map; an error says what is missing.
Result<TrajectoryFrame> mapFrame(const Georeference& georeference);

// Of a format's files: of SBET the map, of all others the model's own coordinates.
Result<TrajectoryFrame> fileFrame(const Georeference& georeference, std::string_view format);

struct ReadTrajectory {
  std::string format;  // its id
  Trajectory samples;  // local_from_body, the body as its format says; times as in the file, in seconds
  std::optional<Pose> file_from_local;  // of a file that has local coordinates, and says where the others are
  double gap_s = 0;                     // ten times the usual step, for PoseSpline::through
  std::vector<TimeGap> breaks;          // steps longer than that; each is a warning of the report, too
  Report report;
};

// A trajectory's file: one file with its reader and writer, and one line in trajectory_file.cpp. Readers keep nothing
// but the samples, of which there may be ten million. What is wrong (numbers that are none, another count of columns, a
// time that is not after the one before, a quaternion or matrix that is no rotation, a file cut off) is an error with
// its line or record and what to do.
struct TrajectoryFormat {
  const char* id;           // "tum"
  const char* description;  // columns, units, which axes the body has and in which order it is turned
  const char* extension;    // ".tum"
  Result<ReadTrajectory> (*read)(const std::filesystem::path&, const TrajectoryFrame&, Progress&);
  // By PartFile. What the format has no place for is in the report.
  Result<Report> (*write)(const std::filesystem::path&, const Trajectory&, const TrajectoryFrame&);
};
std::span<const TrajectoryFormat> trajectoryFormats();
// Null when there is none of this id.
const TrajectoryFormat* trajectoryFormat(std::string_view id);
// By the extension, of texts by their first line; null when it is not known.
Result<const TrajectoryFormat*> trajectoryFormatOf(const std::filesystem::path& file);
// Of a file to be written, by its extension alone.
const TrajectoryFormat* trajectoryFormatFor(const std::filesystem::path& file);

// As a function of time, in the coordinates of the clouds that it belongs to: a file of any format but SBET.
Result<PoseSpline> cloudPoses(const std::filesystem::path& file, Report& report, Progress& progress);

}  // namespace standpoint
