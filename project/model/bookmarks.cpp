// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/model/bookmarks.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "core/units.h"
#include "project/survey/underlays.h"

namespace standpoint {

namespace {

using nlohmann::json;

Eigen::Vector3d shiftOf(const Document& document) {
  return document.georeference ? document.georeference->shift_m : Eigen::Vector3d::Zero();
}

auto find(std::vector<Bookmark>& bookmarks, const std::string& name) {
  return std::find_if(bookmarks.begin(), bookmarks.end(), [&](const Bookmark& b) { return b.name == name; });
}

Result<std::vector<Bookmark>::iterator> existing(std::vector<Bookmark>& bookmarks, const std::string& name) {
  const auto at = find(bookmarks, name);
  if (at != bookmarks.end()) return at;
  std::vector<std::string> names;
  for (const auto& b : bookmarks) names.push_back(b.name);
  return failure(ErrorKind::usage, fmt::format("unknown bookmark '{}'; available: {}", name,
                                               names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
}

// From the south-west and above, so far away that all of the model, or of the clouds, is seen.
Bookmark overview(const Document& document) {
  Bookmark bookmark;
  bookmark.azimuth_rad = 45 * kRadPerDeg;
  bookmark.elevation_rad = -30 * kRadPerDeg;
  const Bounds site = siteInFile(document);
  if (site.empty()) return bookmark;
  bookmark.distance_m = 0.5 * site.diagonal() / std::sin(bookmark.view_angle_rad / 2);
  bookmark.eye = 0.5 * (site.min + site.max) - shiftOf(document) - bookmark.forward() * bookmark.distance_m;
  return bookmark;
}

Bookmark from(const Document& document, const BookmarkOptions& options) {
  if (!options.at) return overview(document);
  const Eigen::Vector3d shift = shiftOf(document);
  Bookmark bookmark;
  bookmark.eye = *options.at - shift;
  bookmark.azimuth_rad = options.azimuth_deg * kRadPerDeg;
  bookmark.elevation_rad = options.elevation_deg * kRadPerDeg;
  bookmark.distance_m = options.distance_m;
  bookmark.view_angle_rad = options.view_angle_deg * kRadPerDeg;
  bookmark.parallel = options.parallel;
  if (options.cut_m) bookmark.cut_height_m = *options.cut_m - shift.z();
  bookmark.on_foot = options.on_foot;
  return bookmark;
}

BookmarkRow rowOf(const Bookmark& b, const Eigen::Vector3d& shift) {
  return {b.name,
          b.eye + shift,
          b.azimuth_rad / kRadPerDeg,
          b.elevation_rad / kRadPerDeg,
          b.distance_m,
          b.view_angle_rad / kRadPerDeg,
          b.parallel,
          b.cut_height_m ? std::optional(*b.cut_height_m + shift.z()) : std::nullopt,
          b.on_foot};
}

Result<std::string> change(std::vector<Bookmark>& bookmarks, const Document& document, const BookmarkOptions& options) {
  if (options.add) {
    if (options.add->empty()) return failure(ErrorKind::usage, "a bookmark needs a name", "add");
    auto bookmark = from(document, options);
    bookmark.name = *options.add;
    const auto same = find(bookmarks, *options.add);
    const bool is_new = same == bookmarks.end();
    if (is_new)
      bookmarks.push_back(std::move(bookmark));
    else
      *same = std::move(bookmark);
    return fmt::format("{} bookmark {}", is_new ? "Added" : "Moved", *options.add);
  }
  const std::string name = options.rename ? *options.rename : *options.remove;
  TRY_ASSIGN(const auto at, existing(bookmarks, name));
  if (options.remove) {
    bookmarks.erase(at);
    return fmt::format("Removed bookmark {}", name);
  }
  if (options.name.empty()) return failure(ErrorKind::usage, "a bookmark needs a name", "name");
  if (options.name != name && find(bookmarks, options.name) != bookmarks.end())
    return failure(ErrorKind::usage, fmt::format("bookmark '{}' already exists; use another name", options.name),
                   "name");
  at->name = options.name;
  return fmt::format("Renamed bookmark {} to {}", name, options.name);
}

}  // namespace

const Fields<BookmarkOptions>& bookmarkFields() {
  using O = BookmarkOptions;
  static const Fields<O> fields = {
      {"add", &O::add, "name of the bookmark to add, or to move"},
      {"rename", &O::rename, "name of the bookmark to rename"},
      {"remove", &O::remove, "name of the bookmark to remove"},
      {"name", &O::name, "the new name, with --rename"},
      {"at", &O::at, "X,Y,Z of the eye in the file's frame (default: an overview of the model)", {.unit = "m"}},
      {"azimuth-deg",
       &O::azimuth_deg,
       "direction of the view, clockwise from the file's Y axis",
       {.unit = "deg", .minimum = -360, .maximum = 360}},
      {"elevation-deg",
       &O::elevation_deg,
       "direction of the view above the horizon",
       {.unit = "deg", .minimum = -90, .maximum = 90}},
      {"distance", &O::distance_m, "distance of what is looked at", {.unit = "m", .minimum = 0.05, .maximum = 50000}},
      {"view-angle-deg", &O::view_angle_deg, "vertical angle of view", {.unit = "deg", .minimum = 5, .maximum = 120}},
      {"parallel", &O::parallel, "parallel projection"},
      {"cut", &O::cut_m, "height above which the model is cut away, in the file's frame", {.unit = "m"}},
      {"on-foot", &O::on_foot, "walk on from there"}};
  return fields;
}

const AnswerFields<BookmarkRow>& answerFields(const BookmarkRow*) {
  using A = BookmarkRow;
  static const AnswerFields<A> fields = {{"name", &A::name},
                                         {"at", &A::at},
                                         {"azimuth_deg", &A::azimuth_deg},
                                         {"elevation_deg", &A::elevation_deg},
                                         {"distance_m", &A::distance_m},
                                         {"view_angle_deg", &A::view_angle_deg},
                                         {"parallel", &A::parallel},
                                         {"cut_m", &A::cut_m},
                                         {"on_foot", &A::on_foot}};
  return fields;
}

const AnswerFields<BookmarkAnswer>& answerFields(const BookmarkAnswer*) {
  using A = BookmarkAnswer;
  static const AnswerFields<A> fields = {{"bookmarks", &A::bookmarks}};
  return fields;
}

Result<Answered<BookmarkAnswer>> runBookmark(const Document& document, const BookmarkOptions& options,
                                             Progress& progress) {
  progress.stage("Bookmark");
  const int actions = static_cast<int>(options.add.has_value()) + static_cast<int>(options.rename.has_value()) +
                      static_cast<int>(options.remove.has_value());
  if (actions > 1) return failure(ErrorKind::usage, "specify one of --add, --rename, --remove");
  Answered<BookmarkAnswer> outcome{document};
  auto bookmarks = document.bookmarks ? *document.bookmarks : std::vector<Bookmark>();
  if (actions == 1) {
    TRY_ASSIGN(outcome.description, change(bookmarks, document, options));
    outcome.document.bookmarks = bookmarks.empty() ? nullptr : std::make_shared<const std::vector<Bookmark>>(bookmarks);
  }
  for (const auto& b : bookmarks) outcome.answer.bookmarks.push_back(rowOf(b, shiftOf(document)));
  return outcome;
}

std::string freeBookmarkName(const Document& document) {
  auto bookmarks = document.bookmarks ? *document.bookmarks : std::vector<Bookmark>();
  for (int i = 1;; ++i)
    if (auto name = fmt::format("View {}", i); find(bookmarks, name) == bookmarks.end()) return name;
}

json bookmarksToJson(const std::vector<Bookmark>& bookmarks) {
  json rows = json::array();
  for (const auto& b : bookmarks) {
    rows.push_back({{"name", b.name},
                    {"eye", {b.eye.x(), b.eye.y(), b.eye.z()}},
                    {"azimuth_rad", b.azimuth_rad},
                    {"elevation_rad", b.elevation_rad},
                    {"distance_m", b.distance_m},
                    {"view_angle_rad", b.view_angle_rad},
                    {"parallel", b.parallel},
                    {"on_foot", b.on_foot}});
    if (b.cut_height_m) rows.back()["cut_height_m"] = *b.cut_height_m;
  }
  return rows;
}

std::vector<Bookmark> bookmarksFrom(const json& part) {
  std::vector<Bookmark> bookmarks;
  for (const auto& row : part) {
    Bookmark b;
    b.name = row.at("name");
    const auto& eye = row.at("eye");
    b.eye = {eye.at(0).get<double>(), eye.at(1).get<double>(), eye.at(2).get<double>()};
    b.azimuth_rad = row.at("azimuth_rad");
    b.elevation_rad = row.at("elevation_rad");
    b.distance_m = row.at("distance_m");
    b.view_angle_rad = row.at("view_angle_rad");
    b.parallel = row.at("parallel");
    b.on_foot = row.at("on_foot");
    if (row.contains("cut_height_m")) b.cut_height_m = row["cut_height_m"].get<double>();
    bookmarks.push_back(std::move(b));
  }
  return bookmarks;
}

}  // namespace standpoint
