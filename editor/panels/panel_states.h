// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/physical_material.h"
#include "editor/model/log.h"
#include "editor/model/material_edit.h"
#include "editor/model/option_form.h"
#include "editor/model/outliner_rows.h"
#include "editor/model/verification_view.h"
#include "project/document.h"
#include "project/geodesy.h"
#include "scanners/engine/ray_engine.h"
#include "scanners/instruments/instrument.h"

namespace standpoint {

// What each panel remembers between two frames: plain values without ImGui and GL.

struct OutlinerPanelState {
  Outliner tree;
  std::string filter;
  std::int64_t scroll_to = -1;  // product to bring into view
  std::uint32_t anchor = 0;     // row where a Shift-selection starts
};

struct InspectorPanelState {
  std::string material_filter;
  std::string property_filter;
};

struct MaterialsPanelState {
  std::string filter;
  std::string chosen;  // material id; "" with chosen_unassigned
  bool chosen_unassigned = false;
  int incidence_deg = 0;                   // of the card's readings
  bool whole_library = false;              // listed, not only what is in use
  std::optional<MaterialEdit> edit;        // the card shows its fields
  std::string bulk;                        // selector of what gets the chosen material
  std::pair<RayHit, std::string> painted;  // where a material was dropped, and its id: a menu asks how far it goes
};

struct FindingsPanelState {
  std::string chosen;   // MaterialFinding::id
  std::string because;  // what stands in the field
  std::uint64_t seen_revision = ~0ULL;
  std::vector<MaterialFinding> all;  // of that revision
};

struct VerifyPanelState {
  std::string underlay, instrument;  // instrument "": as the cloud says
  std::string chosen;                // material id
  std::uint64_t seen_revision = ~0ULL;
  VerificationView view;  // of that revision
};

struct OptimisePanelState {
  double budget_fraction = 0.25;  // of the imported model's triangles
  bool only_lossless = false;
  double max_deviation_mm = 15;
  bool by_view = false;  // what walkers see weighs more
  bool live = false;     // the view follows the sliders
};

struct CollisionPanelState {
  double agent_radius_m = 0.3;
  double agent_height_m = 1.8;
  int doors = 0;                 // 0 open, 1 closed, 2 one by one
  std::set<std::string> closed;  // ids of the doors that stand closed, one by one
};

struct GeoreferencePanelState {
  std::string crs;
  std::array<double, 3> origin_m = {0, 0, 0};
  double rotation_deg = 0;
  const void* filled_from = nullptr;  // the georeference that the fields were filled from
  const void* derived_from = nullptr;
  Result<MapFactors> derived = MapFactors();
};

struct SurveyPanelState {
  int station = -1;  // chosen, index into Job::stations
  int target = -1;
  bool copies_of_registered = true;  // registering writes the scans with their solved poses
  std::array<double, 3> move_to = {0, 0, 0};
  int move_of = -1;  // station that `move_to` was filled from
  Eigen::Vector3d move_from = Eigen::Vector3d::Zero();
};

struct ScanPanelState {
  ScanChoice asked{.instrument = "leica-rtc360"};
  std::shared_ptr<const ScanChoice> remembered;  // the document's, that `asked` was last filled from
  std::optional<ScanChoice> started;             // with the last press of "Scan"
  bool all_stations = true;
  bool resume = true;  // what a cancelled run has finished is taken where it is the same
  int format = 0;
  std::string folder;
};

struct PlanPanelState {
  double spacing_mm = 0;  // 0: any
  double max_incidence_deg = 90;
};

struct LogPanelState {
  LogFilter filter;
  std::size_t seen = 0;  // entries when it was drawn last: new ones scroll into view
};

// Read once from the program's data folder.
struct Catalogue {
  bool read = false;
  std::vector<PhysicalMaterial> materials;
  std::vector<Instrument> instruments;
  std::string problem;                                // why something could not be read
  std::vector<PhysicalMaterial> offered;              // with the user's own in place of those that have their id …
  std::shared_ptr<const MaterialChoice> offered_for;  // … of this document
};

struct PanelStates {
  OutlinerPanelState outliner;
  InspectorPanelState inspector;
  MaterialsPanelState materials;
  VerifyPanelState verify;
  FindingsPanelState findings;
  OptimisePanelState optimise;
  CollisionPanelState collision;
  GeoreferencePanelState georeference;
  SurveyPanelState survey;
  ScanPanelState scan;
  PlanPanelState plan;
  LogPanelState log;
  Catalogue catalogue;
};

const Catalogue& readCatalogue(Catalogue& catalogue);
// Null where there is no such id.
const Instrument* instrumentIn(const Catalogue& catalogue, const std::string& id);
// All materials that can be assigned in a document: made anew only when its own have changed.
const std::vector<PhysicalMaterial>& offeredMaterials(Catalogue& catalogue,
                                                      const std::shared_ptr<const MaterialChoice>& choice);

}  // namespace standpoint
