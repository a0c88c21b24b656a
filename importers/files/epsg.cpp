// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/files/epsg.h"

#include <algorithm>
#include <cctype>
#include <memory>
#include <utility>

#include <proj.h>

namespace standpoint {
namespace {

struct Database {
  Database() : context(proj_context_create()) { proj_log_level(context, PJ_LOG_NONE); }
  ~Database() { proj_context_destroy(context); }
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  using Object = std::unique_ptr<PJ, PJ* (*)(PJ*)>;
  Object find(const std::string& digits, PJ_CATEGORY category) const {
    return {proj_create_from_database(context, "EPSG", digits.c_str(), category, 0, nullptr), proj_destroy};
  }
  bool installed() const { return find("4326", PJ_CATEGORY_CRS) != nullptr; }

  PJ_CONTEXT* context;
};

}  // namespace

EpsgAnswer epsgCrs(const std::string& digits) {
  const Database database;
  EpsgAnswer answer;
  answer.asked = database.installed();
  const auto crs = database.find(digits, PJ_CATEGORY_CRS);
  if (!crs) return answer;
  const PJ_TYPE type = proj_get_type(crs.get());
  Database::Object flat(nullptr, proj_destroy);
  if (type == PJ_TYPE_COMPOUND_CRS) flat.reset(proj_crs_get_sub_crs(database.context, crs.get(), 0));
  const PJ* at = flat ? flat.get() : crs.get();
  answer.crs = EpsgCrs{proj_get_type(at) == PJ_TYPE_PROJECTED_CRS, 1};
  const Database::Object axes(proj_crs_get_coordinate_system(database.context, at), proj_destroy);
  double unit = 1;
  if (axes && proj_cs_get_axis_info(database.context, axes.get(), 0, nullptr, nullptr, nullptr, &unit, nullptr, nullptr,
                                    nullptr))
    answer.crs->unit = unit;
  return answer;
}

bool isEpsgReference(const std::string& digits, bool vertical) {
  const Database database;
  if (!database.installed()) return true;
  for (const PJ_CATEGORY category : {PJ_CATEGORY_DATUM, PJ_CATEGORY_DATUM_ENSEMBLE, PJ_CATEGORY_CRS}) {
    const auto found = database.find(digits, category);
    if (!found) continue;
    const PJ_TYPE type = proj_get_type(found.get());
    const bool is_vertical = type == PJ_TYPE_VERTICAL_REFERENCE_FRAME ||
                             type == PJ_TYPE_DYNAMIC_VERTICAL_REFERENCE_FRAME || type == PJ_TYPE_VERTICAL_CRS;
    if (is_vertical == vertical || type == PJ_TYPE_COMPOUND_CRS) return true;
  }
  return false;
}

std::string epsgDigits(const std::string& name) {
  std::string upper = name;
  std::transform(upper.begin(), upper.end(), upper.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  const std::size_t digits = upper.find_last_not_of("0123456789") + 1;
  const bool bare = digits == 0, named = upper.starts_with("EPSG") || upper.starts_with("URN:OGC:DEF:CRS:EPSG");
  return digits < upper.size() && (bare || named) ? upper.substr(digits) : std::string();
}

}  // namespace standpoint
