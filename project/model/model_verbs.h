// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The verbs that make the model fit for its purpose: solid to walk on, at a known place.

#include <string>
#include <vector>

#include "project/answers.h"
#include "project/fields.h"

namespace standpoint {

std::span<const Choice<DoorState>> choices(DoorState);
struct CollideVerbOptions {
  double agent_radius_m = CollideOptions{}.agent_radius_m;
  double agent_height_m = CollideOptions{}.agent_height_m;
  DoorState doors = DoorState::open;
  std::vector<std::string> closed;  // selectors of doors, with DoorState::as_set; empty: those that were closed last
};
const Fields<CollideVerbOptions>& collideFields();

struct CollideProduct : ProductIdentity, ProductCollision {};
const AnswerFields<CollideProduct>& answerFields(const CollideProduct*);
struct CollideDoor : ProductIdentity, Door {  // its position in the model's file frame
};
const AnswerFields<CollideDoor>& answerFields(const CollideDoor*);
const AnswerFields<TightPlace>& answerFields(const TightPlace*);
struct CollideRoom : ProductIdentity, Room {  // its positions in the model's file frame
};
const AnswerFields<CollideRoom>& answerFields(const CollideRoom*);
struct CollideAnswer {
  std::vector<CollideProduct> products;  // that have shapes
  std::size_t shapes = 0;
  double walkable_area_m2 = 0;
  std::vector<CollideDoor> doors;
  std::size_t doors_passable = 0;
  std::vector<CollideRoom> rooms;
};
const AnswerFields<CollideAnswer>& answerFields(const CollideAnswer*);
Result<Answered<CollideAnswer>> runCollide(const Document& document, const CollideVerbOptions& options,
                                           Progress& progress);

struct GeoreferenceOptions {
  std::string crs;                        // empty: as it is
  std::optional<Eigen::Vector3d> origin;  // map coordinates E,N,H of the file's origin, m
  std::optional<double> rotation_deg;
};
const Fields<GeoreferenceOptions>& georeferenceFields();

struct GeoreferencePlace {  // WGS84
  double latitude_deg = 0, longitude_deg = 0, height_m = 0;
  std::string from;  // "crs" or "site"
};
const AnswerFields<GeoreferencePlace>& answerFields(const GeoreferencePlace*);
struct GeoreferenceUtm {
  std::string zone;  // "32N"
  double easting_m = 0, northing_m = 0, convergence_deg = 0, scale_factor = 1;
};
const AnswerFields<GeoreferenceUtm>& answerFields(const GeoreferenceUtm*);
struct GeoreferenceAnswer : Georeference {
  Eigen::Vector3d reference_m = Eigen::Vector3d::Zero();  // the model's centre in its file frame; the rest is there
  std::optional<Eigen::Vector3d> map_m;
  std::optional<GeoreferencePlace> geographic;
  std::optional<GeoreferenceUtm> utm;
  std::optional<double> grid_convergence_deg, scale_factor;  // of the CRS, else of UTM
};
const AnswerFields<GeoreferenceAnswer>& answerFields(const GeoreferenceAnswer*);
Result<Answered<GeoreferenceAnswer>> runGeoreference(const Document& document, const GeoreferenceOptions& options,
                                                     Progress& progress);

}  // namespace standpoint
