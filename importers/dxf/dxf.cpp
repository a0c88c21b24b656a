// SPDX-License-Identifier: GPL-3.0-or-later
// DXF, the text form: pairs of code and value (dxf_groups), entities (dxf_entity) made into faces (dxf_shapes) of
// blocks (dxf_reader), placed as often as they are inserted (dxf_placing). dxflib was left alone: of VERTEX it gives
// neither flags nor the indices of a polyface mesh, MESH it does not have, and its lists are as long as a file says.
#include "importers/dxf/dxf.h"

#include <new>

#include "importers/dxf/dxf_drawing.h"
#include "importers/dxf/dxf_groups.h"
#include "importers/dxf/dxf_reader.h"
#include "importers/files/file_bytes.h"

namespace standpoint {

namespace {

Result<void> refuseOtherForms(const FileBytes& bytes, const std::string& file) {
  char head[22];
  const auto got = static_cast<std::size_t>(std::min<std::uint64_t>(bytes.size(), sizeof head));
  TRY(bytes.read(0, head, got));
  const std::string_view text(head, got);
  if (text.starts_with("AutoCAD Binary DXF"))
    return failure(ErrorKind::unusable, "is a binary DXF; save it as a text (ASCII) DXF", file);
  if (text.starts_with("AC10")) return failure(ErrorKind::unusable, "is a DWG; save it as DXF", file);
  return {};
}

Result<ImportedModel> readDxf(const std::filesystem::path& path, const ImportOptions& options, Progress& progress) {
  progress.stage("Reading DXF");
  const std::string file = path.filename().string();
  try {
    TRY_ASSIGN(const auto bytes, FileBytes::open(path));
    TRY(refuseOtherForms(bytes, file));
    DxfDrawing drawing;
    drawing.file = file;
    DxfGroups groups(bytes, file);
    Report report;
    TRY(DxfReader(groups, options, drawing).read(report, progress));
    return placeDxf(std::move(drawing), options, std::move(report), progress);
  } catch (const std::bad_alloc&) {
    return failure(ErrorKind::unusable, "not enough memory", file);
  }
}

constexpr const char* kDxfExtensions[] = {".dxf"};

}  // namespace

const Importer kDxfImporter = {"dxf", "DXF, text", kDxfExtensions, &readDxf, UpAxis::z};

}  // namespace standpoint
