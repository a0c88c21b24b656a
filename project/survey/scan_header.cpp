// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/survey/scan_header.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "survey/geodesy.h"

namespace standpoint {

namespace {

// ", ideal", ", without striping, footprint", or nothing.
std::string withoutText(Effects effects) {
  if (effects == Effects::none()) return ", ideal";
  std::string text;
  for (const auto& [effect, name, description] : effectNames())
    if (!effects.has(effect)) text += (text.empty() ? ", without " : ", ") + std::string(name);
  return text;
}

}  // namespace

ScanHeader scanHeader(const Document& document, const ScanWorld& world, const std::string& name, const Pose& believed,
                      const std::string& guid, const ScanRequest& request, double start_gps_s) {
  const auto& g = *document.georeference;
  ScanHeader h;
  h.name = name;
  h.guid = guid;
  h.sensor_vendor = request.instrument.maker;
  h.sensor_model = request.instrument.model;
  h.sensor_serial = "simulated";
  std::vector<std::string> words;
  for (const auto& [key, value] : request.settings.values) words.push_back(key + "=" + value);
  h.description =
      fmt::format("Simulated by Standpoint: {} {}, {}, seed {}{}", request.instrument.maker, request.instrument.model,
                  fmt::join(words, " "), request.options.seed, withoutText(request.options.effects));
  if (request.options.quality != ScanQuality::standard)
    h.description += request.options.quality == ScanQuality::preview ? ", preview quality" : ", reference quality";
  for (const auto& note : request.notes) h.description += "; " + note;
  h.file_from_scanner = believed;
  h.file_from_scanner.translation += g.shift_m;
  h.rows = request.settings.rows;
  h.columns = request.settings.columns;
  h.has_colour = request.settings.imaging;
  h.has_labels = true;
  h.has_time = request.options.channels.time;
  h.has_channel = request.options.channels.channel;
  h.has_returns = request.options.channels.returns;
  h.has_truth = request.options.channels.truth;
  h.acquisition_start_gps_s = start_gps_s;
  h.acquisition_seconds = request.settings.scan_seconds + request.settings.imaging_seconds;
  if (!g.crs.empty() && !g.map_from_file)
    if (const auto crs = findCrs(g.crs)) h.coordinate_metadata = crs->wkt;
  for (const auto& p : world.environment->products) h.products.push_back({p.id, p.global_id, p.ifc_class, p.name});
  h.products.push_back({"", "", "Nothing", "no surface"});  // the label of a drop, or of the receiver's own noise
  if (request.field_fault.anybody()) h.products.push_back(personLabel());
  for (const auto& m : world.assignment.materials) h.materials.push_back(m.id);
  h.materials.emplace_back("unassigned");  // the label of a point whose surface has no material
  return h;
}

}  // namespace standpoint
