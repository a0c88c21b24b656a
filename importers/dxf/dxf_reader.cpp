// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/dxf/dxf_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "importers/dxf/dxf_colours.h"

namespace standpoint {

namespace {

// $INSUNITS, in its order from 0: none, inches, feet, miles, mm, cm, m, km, microinches, mils, yards, ångström, nm, µm,
// dm, dam, hm, Gm, astronomical units, light years, parsecs; US survey feet, inches, yards, miles.
constexpr double kFoot = 0.3048, kSurveyFoot = 1200.0 / 3937;
constexpr std::array kUnits{0.0,
                            kFoot / 12,
                            kFoot,
                            5280 * kFoot,
                            1e-3,
                            1e-2,
                            1.0,
                            1e3,
                            kFoot / 12e6,
                            kFoot / 12e3,
                            3 * kFoot,
                            1e-10,
                            1e-9,
                            1e-6,
                            1e-1,
                            1e1,
                            1e2,
                            1e9,
                            149'597'870'700.0,
                            9.4607304725808e15,
                            3.0856775814913673e16,
                            kSurveyFoot,
                            kSurveyFoot / 12,
                            3 * kSurveyFoot,
                            5280 * kSurveyFoot};
// What is no shape, so that nothing is lost without it.
constexpr std::array<std::string_view, 4> kNoShape{"SEQEND", "ENDBLK", "VIEWPORT", "ATTDEF"};
// Of a MATERIAL: name, image, handle, factor and kind of the diffuse colour, kind of its map, the colour, opacity. The
// first of each counts.
constexpr std::array kOfMaterial{1, 3, 5, 41, 71, 72, 91, 140};
constexpr int kOverridesColour = 1, kProceduralMap = 2;
constexpr int kFrozen = 1, kExternal = 4, kExternalOverlay = 8;
constexpr int kFaceOfPolyface = 128, kCornerOfPolyface = 64, kFrameOfCurve = 16;
constexpr int kPolyfaceHead = 64;

}  // namespace

std::string dxfKey(std::string_view name) {
  std::string key(name);
  for (char& c : key)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return key;
}

std::uint32_t DxfDrawing::layerNamed(std::string_view layer) {
  if (layer.empty()) return kLayerZero;
  const auto [known, is_new] = layer_of_key.try_emplace(dxfKey(layer), static_cast<std::uint32_t>(layers.size()));
  if (is_new) layers.push_back({.name = std::string(layer)});
  return known->second;
}

std::uint32_t DxfDrawing::materialOf(std::string_view handle) {
  if (handle.empty()) return kMaterialByLayer;
  const auto [known, is_new] =
      material_of_handle.try_emplace(dxfKey(handle), static_cast<std::uint32_t>(materials.size()));
  if (is_new) materials.push_back({.handle = std::string(handle)});
  return known->second;
}

const DxfReader::Kind* DxfReader::kindOf(std::string_view name) {
  using R = DxfReader;
  static constexpr std::array kKinds{
      Kind{"3DFACE", &R::face3d}, Kind{"VERTEX", &R::vertex}, Kind{"POLYLINE", &R::polyline},
      Kind{"MESH", &R::mesh},     Kind{"INSERT", &R::insert}, Kind{"ATTRIB", &R::attribute},
      Kind{"SOLID", &R::solid},   Kind{"TRACE", &R::solid},   Kind{"LINE", &R::line},
      Kind{"CIRCLE", &R::circle}, Kind{"ARC", &R::circle},    Kind{"LWPOLYLINE", &R::lwPolyline}};
  const auto it = std::find_if(kKinds.begin(), kKinds.end(), [&](const Kind& k) { return k.name == name; });
  return it == kKinds.end() ? nullptr : &*it;
}

Result<void> DxfReader::read(Report& report, Progress& progress) {
  DxfGroup group;
  bool ended = false, any = false;
  for (std::size_t count = 1; !ended; ++count) {
    TRY_ASSIGN(const bool more, groups_.next(group));
    if (!more) break;
    if (group.code == 999) continue;
    if (!any && !(group.code == 0 && group.value == "SECTION"))
      return groups_.fault(group.line, "is not DXF: it does not begin with a SECTION");
    any = true;
    ended = group.code == 0 && group.value == "EOF";
    if (group.code == 0)
      TRY(start(group));
    else
      TRY(take(group));
    if (count % 65536 != 0) continue;
    progress.advance(0.6 * groups_.readShare());
    TRY(progress.check());
  }
  if (!any) return groups_.fault(1, "is not DXF: it does not begin with a SECTION");
  if (section_ != Section::none || !named_)
    return groups_.fault(groups_.line(), "ends inside a section: the file is truncated");
  if (!ended) report.warn("line " + std::to_string(groups_.line()), "missing 'EOF': the file may be incomplete");
  return {};
}

// A group 0 ends an entity and begins the next.
Result<void> DxfReader::start(const DxfGroup& group) {
  TRY(finishEntity());
  if (polyline_ && group.value != "VERTEX") TRY(finishPolyline());
  if (group.value != "ATTRIB") insert_ = nullptr;
  if (group.value == "SECTION") {
    if (section_ != Section::none) return groups_.fault(group.line, "a section begins inside a section");
    named_ = false;
    return {};
  }
  if (group.value == "ENDSEC") {
    section_ = Section::none;
    block_ = nullptr;
    return {};
  }
  const bool here = section_ == Section::entities || (section_ == Section::blocks && block_ != nullptr);
  entity_.begin(group.value, group.line);
  kind_ = nullptr;
  if (section_ == Section::objects && group.value == "SPATIAL_FILTER") drawing_.clipped.add({1, group.line});
  if (section_ == Section::objects && group.value == "GEODATA") drawing_.geodata.add({1, group.line});
  if (section_ == Section::blocks && group.value == "ENDBLK") block_ = nullptr;
  if (!here) return {};
  kind_ = kindOf(group.value);
  const bool shape = std::find(kNoShape.begin(), kNoShape.end(), group.value) == kNoShape.end();
  if (kind_ == nullptr && !shape) entity_.kind.clear();
  return {};
}

Result<void> DxfReader::take(const DxfGroup& group) {
  if (!named_) {
    if (group.code == 2) enter(group.value);
    return {};
  }
  if (section_ == Section::header) return takeVariable(group);
  const bool table = section_ == Section::tables && entity_.kind == "LAYER";
  const bool block = section_ == Section::blocks && entity_.kind == "BLOCK";
  if (kind_ != nullptr || table || block) return entity_.take(group, groups_);
  const bool material = section_ == Section::objects && entity_.kind == "MATERIAL";
  if (material && std::find(kOfMaterial.begin(), kOfMaterial.end(), group.code) != kOfMaterial.end())
    return entity_.take(group, groups_);
  // Of others it matters only whether they are there to see.
  if (group.code == 67 || group.code == 60) return entity_.take(group, groups_);
  return {};
}

void DxfReader::enter(std::string_view section) {
  constexpr std::array<std::pair<std::string_view, Section>, 5> kSections{{{"HEADER", Section::header},
                                                                           {"TABLES", Section::tables},
                                                                           {"BLOCKS", Section::blocks},
                                                                           {"ENTITIES", Section::entities},
                                                                           {"OBJECTS", Section::objects}}};
  const auto* it = std::find_if(kSections.begin(), kSections.end(), [&](const auto& s) { return s.first == section; });
  section_ = it == kSections.end() ? Section::other : it->second;
  named_ = true;
  entity_.begin("", 0);
  kind_ = nullptr;
  block_ = section_ == Section::entities ? &drawing_.model : nullptr;
  if (section_ != Section::entities && section_ != Section::blocks) return;
  const double stated = drawing_.metres_per_unit > 0 ? drawing_.metres_per_unit : 1;
  shapes_.begin({options_.chord_error_m, options_.max_segment_angle_rad},
                options_.metres_per_unit > 0 ? options_.metres_per_unit : stated);
}

Result<void> DxfReader::takeVariable(const DxfGroup& group) {
  if (group.code == 9) variable_ = group.value.substr(0, 40);
  if (variable_ == "$DWGCODEPAGE" && group.code == 3) drawing_.code_page = group.value.substr(0, 40);
  if (variable_ != "$INSUNITS" || group.code != 70) return {};
  entity_.begin("", group.line);
  TRY(entity_.take(group, groups_));
  const double unit = entity_.number(70);
  const bool known = unit >= 0 && unit < static_cast<double>(kUnits.size());
  drawing_.metres_per_unit = known ? kUnits[static_cast<std::size_t>(unit)] : 0;
  drawing_.unit_unknown = !known;
  return {};
}

Result<void> DxfReader::finishEntity() {
  if (section_ == Section::tables && entity_.kind == "LAYER") layer();
  if (section_ == Section::blocks && entity_.kind == "BLOCK") block();
  if (section_ == Section::objects && entity_.kind == "MATERIAL") material();
  if (block_ == nullptr || entity_.kind.empty() || entity_.kind == "BLOCK") return {};
  if (kind_ == nullptr) {
    if (isHere()) block_->skipped[entity_.kind.substr(0, 40)].add({1, entity_.line});
    return {};
  }
  TRY((this->*kind_->read)());
  entity_.begin("", 0);
  kind_ = nullptr;
  return {};
}

bool DxfReader::isHere() {
  const bool paper = entity_.number(67) != 0 && block_ == &drawing_.model, invisible = entity_.number(60) != 0;
  if (paper) drawing_.paper.add({1, entity_.line});
  if (!paper && invisible) drawing_.invisible.add({1, entity_.line});
  return !paper && !invisible;
}

std::int32_t DxfReader::colour(std::int32_t otherwise) const {
  if (entity_.has(420)) return static_cast<std::int32_t>(static_cast<std::int64_t>(entity_.number(420)) & 0xFFFFFF);
  if (!entity_.has(62)) return otherwise;
  const double index = std::abs(entity_.number(62));
  if (index == 0) return kColourByBlock;
  return index > 255 ? kColourByLayer : static_cast<std::int32_t>(rgbOfColourIndex(static_cast<int>(index)));
}

DxfLook DxfReader::look() {
  constexpr std::int64_t kStated = 0x02000000;
  const auto transparency = static_cast<std::int64_t>(entity_.number(440));
  DxfLook look;
  look.layer = drawing_.layerNamed(entity_.layer);
  look.colour = colour(kColourByLayer);
  look.material = usedMaterial();
  if ((transparency & kStated) != 0) look.alpha = static_cast<std::uint8_t>(transparency & 0xFF);
  return look;
}

std::uint32_t DxfReader::usedMaterial() {
  const std::uint32_t material = drawing_.materialOf(entity_.material);
  drawing_.materials[material].users.add({1, entity_.line});
  return material;
}

void DxfReader::layer() {
  if (entity_.name.empty()) return;
  auto& layer = drawing_.layers[drawing_.layerNamed(entity_.name)];
  const std::int32_t stated = colour(layer.colour);
  if (stated >= 0) layer.colour = stated;
  layer.off = entity_.number(62) < 0;
  layer.frozen = (entity_.flags() & kFrozen) != 0;
  layer.material = usedMaterial();
}

// Each drawing has three whose names say that they are none of their own.
void DxfReader::material() {
  entity_.kind.clear();
  if (entity_.handle.empty()) return;
  using M = DxfMaterial::Kind;
  auto& material = drawing_.materials[drawing_.materialOf(entity_.handle)];
  material.handle = entity_.handle;
  material.name = entity_.text;
  const std::string name = dxfKey(entity_.text);
  material.kind = name == "bylayer"   ? M::by_layer
                  : name == "byblock" ? M::by_block
                  : name == "global"  ? M::none
                                      : M::own;
  const auto whole = [&](int code) { return static_cast<std::int64_t>(entity_.number(code)); };
  if (whole(71) == kOverridesColour && entity_.has(91)) {
    const double share = std::clamp(entity_.number(41, 1), 0.0, 1.0);
    const auto part = [&](unsigned shift) {
      const auto value = static_cast<double>(static_cast<std::uint64_t>(whole(91)) >> shift & 255U);
      return static_cast<std::int32_t>(std::lround(value * share)) << shift;
    };
    material.colour = part(16) | part(8) | part(0);
  }
  material.opacity = std::clamp(entity_.number(140, 1), 0.0, 1.0);
  material.painted = entity_.has_file || whole(72) == kProceduralMap;
}

void DxfReader::block() {
  const auto [known, is_new] = drawing_.blocks.try_emplace(dxfKey(entity_.name));
  entity_.kind.clear();
  block_ = is_new ? &known->second : nullptr;
  if (!is_new) return drawing_.twice.add({1, entity_.line});
  block_->name = entity_.name;
  block_->line = entity_.line;
  block_->base = entity_.point(10);
  block_->external = (entity_.flags() & (kExternal | kExternalOverlay)) != 0;
}

Result<void> DxfReader::insert() {
  insert_ = nullptr;
  if (!isHere()) return {};
  const auto count = [&](int code) {
    return static_cast<std::uint32_t>(std::clamp(entity_.number(code, 1), 1.0, 1e9));
  };
  const double angle_rad = entity_.number(50) * std::numbers::pi / 180;
  const Eigen::Matrix3d plane = worldFromObject(entity_.normal());
  const Eigen::Matrix3d turned = plane * Eigen::AngleAxisd(angle_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  DxfInsert made;
  made.block = dxfKey(entity_.name);
  made.outer_from_block = Eigen::Affine3d::Identity();
  made.outer_from_block.linear() =
      turned * Eigen::Vector3d(entity_.number(41, 1), entity_.number(42, 1), entity_.number(43, 1)).asDiagonal();
  made.outer_from_block.translation() = plane * entity_.point(10);
  made.columns = count(70), made.rows = count(71);
  made.column_step = turned * Eigen::Vector3d(entity_.number(44), 0, 0);
  made.row_step = turned * Eigen::Vector3d(0, entity_.number(45), 0);
  made.look = look();
  made.id = entity_.id();
  made.line = entity_.line;
  block_->inserts.push_back(std::move(made));
  insert_ = &block_->inserts.back();
  return {};
}

Result<void> DxfReader::attribute() {
  if (insert_ != nullptr && !entity_.name.empty())
    insert_->attributes.push_back({"attributes", entity_.name, entity_.text});
  return {};
}

Result<void> DxfReader::polyline() {
  polyline_.reset();
  if (!isHere()) return {};
  polyline_.emplace();
  polyline_->look = look();
  polyline_->head = std::exchange(entity_, {});
  return {};
}

Result<void> DxfReader::vertex() {
  if (!polyline_) return {};
  const int flags = entity_.flags();
  const bool polyface = (polyline_->head.flags() & kPolyfaceHead) != 0;
  if (!polyface || (flags & kFaceOfPolyface) == 0 || (flags & kCornerOfPolyface) != 0) {
    if (!polyface && (flags & kFrameOfCurve) != 0) return {};
    const DxfEntity& head = polyline_->head;
    polyline_->vertices.push_back({entity_.point(10),
                                   entity_.number(42),
                                   {entity_.number(40, head.number(40)), entity_.number(41, head.number(41))}});
    return {};
  }
  DxfPolyline::Face face{{}, 0, polyline_->look, entity_.line};
  for (int code = 71; code <= 74; ++code) {
    const double corner = std::abs(entity_.number(code));  // negative: the edge is not drawn
    if (corner == 0) continue;
    if (corner > static_cast<double>(polyline_->vertices.size()))
      return groups_.fault(entity_.line, "refers to vertex " + std::to_string(static_cast<std::int64_t>(corner)) +
                                             "; there are " + std::to_string(polyline_->vertices.size()));
    face.corners[face.count++] = static_cast<std::uint32_t>(corner) - 1;
  }
  face.look.colour = colour(face.look.colour);
  polyline_->faces.push_back(face);
  return {};
}

Result<void> DxfReader::finishPolyline() {
  const auto polyline = std::exchange(polyline_, std::nullopt);
  return block_ == nullptr ? Result<void>() : shapes_.polyline(*polyline, groups_, *block_);
}

Result<void> DxfReader::face3d() {
  if (isHere()) shapes_.face3d(entity_, look(), *block_);
  return {};
}

Result<void> DxfReader::mesh() { return isHere() ? shapes_.mesh(entity_, look(), groups_, *block_) : Result<void>(); }

Result<void> DxfReader::solid() {
  if (isHere()) shapes_.solid(entity_, look(), *block_);
  return {};
}

Result<void> DxfReader::line() {
  if (isHere()) shapes_.line(entity_, look(), *block_);
  return {};
}

Result<void> DxfReader::circle() {
  return isHere() ? shapes_.circle(entity_, look(), groups_, *block_) : Result<void>();
}

Result<void> DxfReader::lwPolyline() {
  return isHere() ? shapes_.lwPolyline(entity_, look(), groups_, *block_) : Result<void>();
}

}  // namespace standpoint
