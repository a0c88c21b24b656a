// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "importers/dxf/dxf_drawing.h"
#include "importers/dxf/dxf_entity.h"
#include "importers/dxf/dxf_groups.h"
#include "importers/dxf/dxf_shapes.h"

namespace standpoint {

// Takes the sections of a file into a drawing. DXF reference: help.autodesk.com, "AutoCAD DXF".
class DxfReader {
 public:
  DxfReader(DxfGroups& groups, const ImportOptions& options, DxfDrawing& drawing)
      : groups_(groups), options_(options), drawing_(drawing) {}

  Result<void> read(Report& report, Progress& progress);

 private:
  enum class Section { none, header, tables, blocks, entities, objects, other };
  struct Kind {
    std::string_view name;
    Result<void> (DxfReader::*read)();
  };
  static const Kind* kindOf(std::string_view name);

  Result<void> start(const DxfGroup& group);
  Result<void> take(const DxfGroup& group);
  void enter(std::string_view section);
  Result<void> takeVariable(const DxfGroup& group);
  Result<void> finishEntity();
  Result<void> finishPolyline();

  void layer();
  void material();
  void block();
  Result<void> insert();
  Result<void> attribute();
  Result<void> vertex();
  Result<void> polyline();
  Result<void> face3d();
  Result<void> mesh();
  Result<void> solid();
  Result<void> line();
  Result<void> circle();
  Result<void> lwPolyline();

  bool isHere();  // counts what is in paper space or invisible
  DxfLook look();
  std::int32_t colour(std::int32_t otherwise) const;
  std::uint32_t usedMaterial();

  DxfGroups& groups_;
  const ImportOptions& options_;
  DxfDrawing& drawing_;
  DxfShapes shapes_;
  Section section_ = Section::none;
  bool named_ = true;  // false: the name of the section follows
  std::string variable_;
  DxfEntity entity_;
  const Kind* kind_ = nullptr;  // of the entity that is being read, where it is of use
  DxfBlock* block_ = nullptr;   // that the entity is in
  std::optional<DxfPolyline> polyline_;
  DxfInsert* insert_ = nullptr;  // whose attributes follow
};

}  // namespace standpoint
