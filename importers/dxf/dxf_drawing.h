// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "importers/files/importer.h"

namespace standpoint {

constexpr std::int32_t kColourByLayer = -1, kColourByBlock = -2;
constexpr std::uint32_t kMaterialByLayer = 0;  // of the materials: none is stated
constexpr std::uint32_t kLayerZero = 0;        // of the layers: what is on it in a block is on the layer of the insert

// How an entity says that it looks.
struct DxfLook {
  std::uint32_t layer = kLayerZero;
  std::int32_t colour = kColourByLayer;  // else 0x00RRGGBB
  std::uint8_t alpha = 255;
  std::uint32_t material = kMaterialByLayer;
  bool operator==(const DxfLook&) const = default;
};

struct DxfLayer {
  std::string name;  // as in the file
  std::int32_t colour = 0xFFFFFF;
  bool off = false, frozen = false;
  std::uint32_t material = kMaterialByLayer;
};

constexpr std::uint32_t kLooseFaces = 0;

// Consecutive faces of one look and one entity.
struct DxfFaces {
  std::size_t begin = 0, end = 0;
  DxfLook look;
  std::uint32_t entity = kLooseFaces;  // a number in its block; kLooseFaces: many small entities, each one face
};

struct DxfInsert {
  std::string block;                      // key
  Eigen::Affine3d outer_from_block;       // without the block's base point
  std::uint32_t columns = 1, rows = 1;    // each at least 1
  Eigen::Vector3d column_step, row_step;  // in the outer frame
  DxfLook look;
  std::string id;
  std::size_t line = 0;
  std::vector<Property> attributes;
  bool cut = false;  // it closes a circle of blocks
};

// How often something was found, and the first line that has it.
struct DxfTally {
  std::size_t count = 0, line = 0;
  void add(const DxfTally& other) {
    if (count == 0 || other.line < line) line = other.line;
    count += other.count;
  }
};
using DxfTallies = std::map<std::string, DxfTally>;

// A MATERIAL object, or the handle of one that the file does not have.
struct DxfMaterial {
  enum class Kind {
    none,      // it is not in the file, or is "Global", which is no more than a colour
    by_layer,  // that of the layer
    by_block,  // that of the insert
    own
  };
  Kind kind = Kind::none;
  std::string handle, name;              // as in the file
  std::int32_t colour = kColourByLayer;  // 0x00RRGGBB; else that of the entity
  double opacity = 1;                    // 0..1
  bool painted = false;                  // with an image or a pattern
  DxfTally users;                        // entities and layers
};

struct DxfBlock {
  std::string name;  // as in the file
  std::size_t line = 0;
  Eigen::Vector3d base = Eigen::Vector3d::Zero();
  bool external = false;

  std::vector<Eigen::Vector3d> positions;  // the file's unit; finite, below 1e13
  std::vector<std::uint32_t> corners;      // in range
  std::vector<std::size_t> face_begins{0};
  std::vector<std::size_t> face_lines;
  std::vector<DxfFaces> faces;
  std::vector<std::string> entity_ids{""};  // of DxfFaces::entity
  std::vector<DxfInsert> inserts;
  DxfTallies skipped;  // by kind of entity
  DxfTallies lost;     // by sentence
};

// What a DXF file comes down to.
struct DxfDrawing {
  std::string file;            // for errors
  double metres_per_unit = 0;  // 0: not stated
  bool unit_unknown = false;   // stated by a number that has no meaning
  std::string code_page = "ANSI_1252";
  std::vector<DxfLayer> layers{{.name = "0"}};
  std::map<std::string, std::uint32_t> layer_of_key{{"0", kLayerZero}};
  DxfBlock model;
  std::map<std::string, DxfBlock> blocks;
  std::vector<DxfMaterial> materials{{.kind = DxfMaterial::Kind::by_layer}};
  std::map<std::string, std::uint32_t> material_of_handle;
  DxfTally paper, invisible, clipped, geodata, twice;  // twice: blocks defined again

  std::uint32_t layerNamed(std::string_view layer);
  std::uint32_t materialOf(std::string_view handle);
};

// Names differ by more than the case of A to Z.
std::string dxfKey(std::string_view name);

// Faces of inserted blocks are there as often as they are inserted: at most 20 000 000 corners and 1 000 000 blocks.
Result<ImportedModel> placeDxf(DxfDrawing&& drawing, const ImportOptions& options, Report&& report, Progress& progress);

}  // namespace standpoint
