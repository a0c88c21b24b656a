// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/units.h"
#include "project/answers.h"
#include "project/fields.h"

namespace standpoint {

// Adds, renames, removes or lists named views. Of the actions at most one; none lists. Adding a name that there is
// moves that bookmark. Without an eye a new one looks at the whole model from above its south-west corner.
struct BookmarkOptions {
  std::optional<std::string> add, rename, remove;
  std::string name;                   // the new one, for `rename`
  std::optional<Eigen::Vector3d> at;  // the eye, in the file's frame, m
  double azimuth_deg = 0;             // where it looks: clockwise from the file's Y axis
  double elevation_deg = 0;           // up is positive
  double distance_m = 10;             // to what is looked at
  double view_angle_deg = Bookmark().view_angle_rad / kRadPerDeg;
  bool parallel = false;
  std::optional<double> cut_m;  // height above which the model is cut away, in the file's frame
  bool on_foot = false;
};
const Fields<BookmarkOptions>& bookmarkFields();

struct BookmarkRow {
  std::string name;
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  // in the file's frame
  double azimuth_deg = 0, elevation_deg = 0, distance_m = 0, view_angle_deg = 0;
  bool parallel = false;
  std::optional<double> cut_m;
  bool on_foot = false;
};
const AnswerFields<BookmarkRow>& answerFields(const BookmarkRow*);
struct BookmarkAnswer {
  std::vector<BookmarkRow> bookmarks;
};
const AnswerFields<BookmarkAnswer>& answerFields(const BookmarkAnswer*);
Result<Answered<BookmarkAnswer>> runBookmark(const Document& document, const BookmarkOptions& options,
                                             Progress& progress);

// "View 3": the first that is free.
std::string freeBookmarkName(const Document& document);

nlohmann::json bookmarksToJson(const std::vector<Bookmark>& bookmarks);
std::vector<Bookmark> bookmarksFrom(const nlohmann::json& part);

}  // namespace standpoint
