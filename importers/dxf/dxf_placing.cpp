// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "importers/dxf/dxf_drawing.h"
#include "importers/dxf/dxf_findings.h"
#include "importers/dxf/dxf_text.h"
#include "importers/soup/face_soup.h"
#include "importers/soup/position_welder.h"

namespace standpoint {

namespace {

constexpr std::uint64_t kMostPlacedCorners = 20'000'000, kMostPlacedBlocks = 1'000'000;
constexpr int kDeepestBlock = 64;
constexpr double kLargestPlaced = 1e13;
constexpr std::int32_t kNoProduct = -1;
constexpr std::uint32_t kNoMaterial = kMaterialByLayer;
constexpr std::int32_t kWhite = 0xFFFFFF;

// What a block gets to when everything in it is placed once.
struct Reach {
  std::uint64_t corners = 0, blocks = 0;
  int depth = 0;
  bool reached = false, open = false;
};

class Placing {
 public:
  Placing(DxfDrawing& drawing, Report& report) : drawing_(drawing), report_(report) {}

  Result<FaceSoup> run() {
    for (DxfLayer& l : drawing_.layers) l.name = utf8OfDxf(l.name, drawing_.code_page);
    for (DxfMaterial& m : drawing_.materials) m.name = utf8OfDxf(m.name, drawing_.code_page);
    for (auto& [key, block] : drawing_.blocks) block.name = utf8OfDxf(block.name, drawing_.code_page);
    Reach all;
    TRY(reach(drawing_.model, all));
    place(drawing_.model, {Eigen::Affine3d::Identity(), kLayerZero, kWhite, kNoMaterial, nullptr, 0});
    if (error_) return failure(*error_);
    tellDxf(findings_, drawing_, report_);
    return std::move(soup_);
  }

  std::vector<std::size_t> takeLines() { return std::move(lines_); }

 private:
  // An insert on the way from the model; its product is made with its first face.
  struct Placed {
    Placed* outer = nullptr;
    const DxfInsert* insert = nullptr;
    const DxfBlock* block = nullptr;
    std::uint32_t layer = kLayerZero;
    std::uint32_t cell = 0;  // of its rows and columns, the one that is being placed
    std::int32_t product = kNoProduct;
  };
  struct Where {
    Eigen::Affine3d world_from_block;
    std::uint32_t layer;     // of what is on layer 0
    std::int32_t colour;     // of what has that of its block
    std::uint32_t material;  // likewise; kNoMaterial, or one of its own kind
    Placed* placed;
    std::size_t line;  // of the insert
  };

  tl::unexpected<Error> fault(std::size_t line, std::string message) const {
    return failure(ErrorKind::unusable, std::move(message), drawing_.file + " line " + std::to_string(line));
  }

  // Null where the file does not have it.
  DxfBlock* blockOf(const DxfInsert& insert) {
    const auto named = drawing_.blocks.find(insert.block);
    return named == drawing_.blocks.end() ? nullptr : &named->second;
  }

  // Finds what is inserted in itself, and refuses what would grow beyond the limits, before anything is placed.
  Result<void> reach(DxfBlock& block, Reach& to) {
    to.open = to.reached = true;
    to.corners = block.corners.size();
    std::uint64_t placed = 0;
    for (DxfInsert& insert : block.inserts) {
      Reach* r = open(insert);
      if (r == nullptr) continue;
      if (++depth_ > kDeepestBlock) return fault(insert.line, "blocks are nested more than 64 deep");
      if (!r->reached) TRY(reach(*blockOf(insert), *r));
      --depth_;
      to.depth = std::max(to.depth, r->depth + 1);
      if (depth_ + to.depth > kDeepestBlock) return fault(insert.line, "blocks are nested more than 64 deep");
      if (r->corners == 0) continue;
      const std::uint64_t cells = std::uint64_t{insert.columns} * insert.rows;
      if (cells > kMostPlacedCorners || (placed += cells * r->corners) > kMostPlacedCorners)
        return fault(insert.line, "exceeds the limit of 20 000 000 placed corners");
      to.corners += cells * r->corners;
      to.blocks += weightOf(insert) + cells * r->blocks;
      if (to.blocks > kMostPlacedBlocks) return fault(insert.line, "exceeds the limit of 1 000 000 placed blocks");
    }
    to.open = false;
    for (const auto& [kind, tally] : block.skipped) findings_.skipped[kind].add(tally);
    for (const auto& [what, tally] : block.lost) findings_.lost[what].add(tally);
    return {};
  }

  // What an insert gets to; null where it gets to nothing.
  Reach* open(DxfInsert& insert) {
    const auto lose = [&](const char* what) { findings_.lost[what].add({1, insert.line}); };
    const DxfBlock* inner = blockOf(insert);
    if (inner == nullptr) return lose("inserted blocks that are not in the file"), nullptr;
    if (inner->external) lose("external references, not read; bind them");
    Reach& r = reach_[inner];
    insert.cut = r.open;
    if (insert.cut) return lose("blocks that contain themselves, the inner one left out"), nullptr;
    return &r;
  }

  // One with long attributes counts as several.
  static std::uint64_t weightOf(const DxfInsert& insert) {
    std::uint64_t bytes = 0;
    for (const Property& a : insert.attributes) bytes += sizeof a + a.name.size() + a.value.size();
    return 1 + bytes / 256;
  }

  void place(const DxfBlock& block, const Where& where) {
    placeFaces(block, where);
    for (const DxfInsert& insert : block.inserts) {
      const DxfBlock* inner = blockOf(insert);
      if (error_ || insert.cut || inner == nullptr || reach_[inner].corners == 0) continue;
      const std::uint32_t layer = layerOf(insert.look, where);
      if (drawing_.layers[layer].frozen) {
        findings_.hidden.add({1, insert.line});
        continue;
      }
      Placed placed{where.placed, &insert, inner, layer};
      const Eigen::Affine3d world_from_outer = where.world_from_block;
      for (std::uint32_t row = 0; row < insert.rows; ++row)
        for (std::uint32_t column = 0; column < insert.columns && !error_; ++column) {
          Eigen::Affine3d outer_from_block = insert.outer_from_block;
          outer_from_block.pretranslate(column * insert.column_step + row * insert.row_step);
          outer_from_block.translate(-inner->base);
          placed.cell = row * insert.columns + column;
          place(*inner, {world_from_outer * outer_from_block, layer, colourOf(insert.look, where),
                         materialOf(insert.look, where), &placed, insert.line});
        }
    }
  }

  void placeFaces(const DxfBlock& block, const Where& where) {
    const bool mirrored = where.world_from_block.linear().determinant() < 0;
    std::int32_t product = kNoProduct;
    std::uint32_t entity = kLooseFaces;
    for (const DxfFaces& faces : block.faces) {
      const std::uint32_t layer = layerOf(faces.look, where);
      if (drawing_.layers[layer].off || drawing_.layers[layer].frozen) {
        findings_.hidden.add({faces.end - faces.begin, block.face_lines[faces.begin]});
        continue;
      }
      if (where.placed != nullptr) {
        product = productOf(*where.placed);
      } else if (faces.entity == kLooseFaces) {
        product = productOfLayer(layer);
      } else if (faces.entity != entity) {
        product = newProduct(block.entity_ids[faces.entity], drawing_.layers[layer].name, layer);
        entity = faces.entity;
      }
      beginRun(static_cast<std::uint32_t>(product), surfaceOf(faces.look, where));
      for (std::size_t f = faces.begin; f < faces.end; ++f)
        if (!placeFace(block, f, where, mirrored)) return;
    }
  }

  bool placeFace(const DxfBlock& block, std::size_t face, const Where& where, bool mirrored) {
    const std::size_t begin = block.face_begins[face], end = block.face_begins[face + 1];
    for (std::size_t c = begin; c < end; ++c) {
      const Eigen::Vector3d& p = block.positions[block.corners[mirrored ? end - 1 - (c - begin) : c]];
      const Eigen::Vector3d at = where.placed != nullptr ? where.world_from_block * p : p;
      if (!(at.cwiseAbs().maxCoeff() <= kLargestPlaced)) {
        error_ = fault(where.line, "a coordinate is not a finite number below 1e13").value();
        return false;
      }
      soup_.corners.push_back(welder_.weld(at, soup_.positions));
    }
    soup_.face_begins.push_back(soup_.corners.size());
    lines_.push_back(block.face_lines[face]);
    soup_.runs.back().end = static_cast<std::uint32_t>(lines_.size());
    return true;
  }

  void beginRun(std::uint32_t product, std::uint32_t surface) {
    const auto face = static_cast<std::uint32_t>(lines_.size());
    if (soup_.runs.empty() || soup_.runs.back().product != product || soup_.runs.back().surface != surface)
      soup_.runs.push_back({face, face, product, surface});
  }

  static std::uint32_t layerOf(const DxfLook& look, const Where& where) {
    return look.layer == kLayerZero ? where.layer : look.layer;
  }

  std::int32_t colourOf(const DxfLook& look, const Where& where) const {
    if (look.colour == kColourByBlock) return where.colour;
    return look.colour == kColourByLayer ? drawing_.layers[layerOf(look, where)].colour : look.colour;
  }

  std::uint32_t materialOf(const DxfLook& look, const Where& where) const {
    using M = DxfMaterial::Kind;
    const auto kind = [&](std::uint32_t index) { return drawing_.materials[index].kind; };
    std::uint32_t material = look.material;
    if (kind(material) == M::by_block) return where.material;
    if (kind(material) == M::by_layer) material = drawing_.layers[layerOf(look, where)].material;
    return kind(material) == M::own ? material : kNoMaterial;
  }

  // Of a material in all layers alike, else of the layer.
  std::uint32_t surfaceOf(const DxfLook& look, const Where& where) {
    const std::uint32_t material = materialOf(look, where), layer = layerOf(look, where);
    const DxfMaterial& m = drawing_.materials[material];
    const std::int32_t rgb = m.colour >= 0 ? m.colour : colourOf(look, where);
    const auto alpha = static_cast<std::uint8_t>(std::lround(m.opacity * look.alpha));
    const auto [known, is_new] =
        surface_of_.try_emplace({material, material == kNoMaterial ? layer : kLayerZero, rgb, alpha},
                                static_cast<std::uint32_t>(soup_.surfaces.size()));
    if (!is_new) return known->second;
    const auto part = [&](unsigned shift) {
      return static_cast<float>(static_cast<std::uint32_t>(rgb) >> shift & 255U) / 255;
    };
    Surface s;
    s.name = material == kNoMaterial ? drawing_.layers[layer].name : m.name;
    s.source = material == kNoMaterial ? "layer " + s.name : "#" + m.handle;
    s.colour = {part(16), part(8), part(0), static_cast<float>(alpha) / 255};
    soup_.surfaces.push_back(std::move(s));
    return known->second;
  }

  std::int32_t newProduct(std::string id, std::string name, std::uint32_t layer) {
    Product p;
    p.id = std::move(id);
    p.name = std::move(name);
    p.groups = {drawing_.layers[layer].name};
    soup_.products.push_back(std::move(p));
    return static_cast<std::int32_t>(soup_.products.size() - 1);
  }

  std::int32_t productOfLayer(std::uint32_t layer) {
    const auto [known, is_new] = product_of_layer_.try_emplace(layer, kNoProduct);
    const std::string& name = drawing_.layers[layer].name;
    if (is_new) known->second = newProduct("layer " + name, name, layer);
    return known->second;
  }

  std::int32_t productOf(Placed& placed) {
    if (placed.product != kNoProduct) return placed.product;
    const std::int32_t whole = placed.outer != nullptr ? productOf(*placed.outer) : kNoProduct;
    const auto& page = drawing_.code_page;
    std::string id = placed.insert->id;
    if (whole != kNoProduct) {
      const DxfInsert& outer = *placed.outer->insert;
      const bool one = outer.columns == 1 && outer.rows == 1;
      const std::string cell = one ? "/" : "[" + std::to_string(placed.outer->cell) + "]/";
      id = soup_.products[static_cast<std::size_t>(whole)].id + cell + id;
    }
    placed.product = newProduct(std::move(id), placed.block->name, placed.layer);
    Product& p = soup_.products.back();
    p.type_name = p.name;
    p.whole = whole;
    for (const Property& a : placed.insert->attributes)
      p.properties.push_back({a.set, utf8OfDxf(a.name, page), utf8OfDxf(a.value, page)});
    return placed.product;
  }

  DxfDrawing& drawing_;
  Report& report_;
  FaceSoup soup_{.face_begins = {0}};
  PositionWelder welder_;
  std::vector<std::size_t> lines_;  // of faces
  std::map<const DxfBlock*, Reach> reach_;
  int depth_ = 0;
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::int32_t, std::uint8_t>, std::uint32_t> surface_of_;
  std::map<std::uint32_t, std::int32_t> product_of_layer_;
  DxfFindings findings_;
  std::optional<Error> error_;
};

}  // namespace

Result<ImportedModel> placeDxf(DxfDrawing&& drawing, const ImportOptions& options, Report&& report,
                               Progress& progress) {
  const double unit = drawing.metres_per_unit;
  if (unit <= 0 && options.metres_per_unit <= 0)
    report.warn("", drawing.unit_unknown ? "the unit ($INSUNITS) is unknown, metres assumed; specify it on import"
                                         : "states no unit ($INSUNITS), metres assumed; specify it on import");
  Placing placing(drawing, report);
  TRY_ASSIGN(auto soup, placing.run());
  const auto lines = placing.takeLines();
  soup.place = [&](std::size_t face) { return "line " + std::to_string(lines[face]); };
  ImportOptions in_file_unit = options;
  if (in_file_unit.metres_per_unit <= 0) in_file_unit.metres_per_unit = unit;
  TRY_ASSIGN(auto model, modelFrom(std::move(soup), UpAxis::z, in_file_unit, std::move(report), progress));
  model.metres_per_unit = unit;
  return model;
}

}  // namespace standpoint
