// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "core/report.h"
#include "core/result.h"
#include "importers/geometry/kernel.h"
#include "importers/ifc/model/shape_aspect.h"
#include "importers/ifc/model/step_file.h"
#include "importers/ifc/model/texture_maps.h"
#include "importers/ifc/model/units.h"

namespace standpoint::ifc {

struct Mapping;
struct CurveCache;

// What every mapping reads: the file, its units, how fine curves become. Shared by all threads, never written after the
// start.
struct Model {
  const StepFile& file;
  Units units;
  geometry::Tessellation tessellation;
  std::vector<const Mapping*> mapping_of_type;  // by Record::type; nullptr: the table does not know it
  TextureMaps textures;
  ShapeAspects aspects;
  std::vector<Id> style_of_item;  // a face's tag by position of its item's record; 0: none of its own
  std::map<Id, Id> colour_map_of_face_set;
  std::shared_ptr<CurveCache> curves;  // alignments: long, and shared by everything that stands along them
};

// What was wrong with shells and face sets; the first four kinds are mended, the last two are only said.
struct Repairs {
  std::size_t inverted = 0;     // closed shells that were inside out: turned
  std::size_t disagreeing = 0;  // shells whose faces ran against each other: turned to agree
  std::size_t degenerate = 0;   // faces without area: dropped
  std::size_t duplicate = 0;    // faces that were there twice: one dropped
  std::size_t open = 0;         // shells that claim to be closed and are not
  std::size_t branching = 0;    // edges of more than two faces
};

// One product's (or one shared representation's) work: its issues, and the guards against input that nests or
// multiplies.
struct Scope {
  explicit Scope(const Model& m) : model(m), tessellation(m.tessellation) {}
  const Model& model;
  geometry::Tessellation tessellation;  // finer than the model's while a curve in a surface's parameters is read
  Report report;
  Repairs repairs;
  int depth = 0;
  std::size_t spent = 0;  // points and calls so far
  // The first thing that the file says and that is not what it must be: a finite number, a record that exists.
  std::optional<Error> unread;

  void misread(const Entity& at, std::string what) {
    if (!unread) unread = Error{ErrorKind::unusable, std::move(what), at.place()};
  }
  double number(const Value& value, const Entity& of, double otherwise = 0) {
    const auto number = value.number();
    if (!number && !unread && value.present()) misread(of, shown(value) + " is not a finite number");
    return number.value_or(otherwise);
  }
  double metres(double file_length) const { return file_length * model.units.length_m; }
  bool spend(std::size_t amount) { return (spent += amount) <= kMost; }
  static constexpr std::size_t kMost = 20'000'000;
  static constexpr int kDeepest = 100;
};

inline tl::unexpected<Error> fail(const Entity& entity, std::string message) {
  return failure(ErrorKind::unusable, std::move(message), entity.place());
}

}  // namespace standpoint::ifc
