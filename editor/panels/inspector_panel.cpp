// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/panels/inspector_panel.h"

#include <algorithm>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include "editor/model/material_scope.h"
#include "editor/panels/actions.h"
#include "editor/panels/panel.h"
#include "editor/panels/survey_inspector.h"
#include "editor/widgets/drop_down.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/widgets.h"
#include "editor/words/sentences.h"
#include "optimizer/surface/mesh_statistics.h"
#include "project/materials/materials_verb.h"

namespace standpoint {

namespace {

struct InspectorState {
  std::string material_filter;
  bool material_list_wanted = false;
  std::string property_filter;
  // The product that was counted last; of a larger one it would take longer than a frame may.
  std::shared_ptr<const Environment> counted_in;
  std::uint32_t counted = 0;
  MeshStatistics statistics;
};

constexpr std::uint64_t kMostCounted = 200'000;  // triangles

std::string nodeLabel(const SpatialNode& node) {
  return node.name.empty() ? tr(readableClass(node.ifc_class)) : node.name;
}

// "House › Block A › Ground"
std::string placeOf(const Environment& environment, const Product& product) {
  std::string path;
  for (auto n = product.container; n >= 0; n = environment.spatial[static_cast<std::size_t>(n)].parent) {
    const auto& node = environment.spatial[static_cast<std::size_t>(n)];
    path = path.empty() ? nodeLabel(node) : nodeLabel(node) + " › " + path;
  }
  return path;
}

std::string treatmentText(const Model& model, const Product& product) {
  const auto* treatment =
      model.treatmentOfProduct(static_cast<std::uint32_t>(&product - model.environment()->products.data()));
  if (treatment == nullptr) return {};
  switch (treatment->kind) {
    case TreatmentKind::excluded: return "Excluded from the scene";
    case TreatmentKind::kept: return "Never simplified";
    case TreatmentKind::simplified:
      return treatment->max_deviation_m ? trf("Simplified within {:g} mm", *treatment->max_deviation_m * 1000)
                                        : "Simplified with custom weight";
    case TreatmentKind::as_rules: break;
  }
  return {};
}

void drawIdentity(const Model& model, const Product& product) {
  if (!ui::beginProperties("identity", 0.25F)) return;
  ui::property("Class", product.ifc_class.empty() ? tr("Object") : product.ifc_class);
  if (!product.predefined_type.empty()) ui::property("Kind", product.predefined_type);
  if (!product.type_name.empty()) ui::property("Type", product.type_name);
  ui::property("Id", product.id);
  if (!product.global_id.empty()) ui::property("GlobalId", product.global_id);
  if (const auto place = placeOf(*model.environment(), product); !place.empty()) ui::property("Location", place);
  for (const auto& group : product.groups) ui::property("Group", group);
  if (const auto treated = treatmentText(model, product); !treated.empty()) ui::property("Treatment", treated);
  if (product.whole >= 0)
    ui::property("Part of", productLabel(model.environment()->products[static_cast<std::size_t>(product.whole)]));
  ui::endProperties();
}

std::uint64_t trianglesOf(const Environment& environment, std::uint32_t product) {
  std::uint64_t count = 0;
  for (const auto& i : environment.instances)
    if (i.product == product) count += environment.meshes[i.mesh]->triangles.size();
  return count;
}

// How its triangles hang together.
void drawConnections(const Model& model, InspectorState& state, std::uint32_t index) {
  if (state.counted_in != model.environment() || state.counted != index) {
    state.statistics = statisticsOfProduct(*model.environment(), index);
    state.counted_in = model.environment();
    state.counted = index;
  }
  const auto& s = state.statistics;
  if (s.triangles == 0) return;
  const auto said = [](fmt::format_string<std::string> one, fmt::format_string<std::string> many, std::uint64_t count) {
    return trn(one, many, count, groupedDigits(count));
  };
  ui::property("Surface", fmt::format("{}, {}", tr(s.isClosed() ? "watertight" : "not watertight"),
                                      said("{} part", "{} parts", s.parts)));
  if (s.border_edges > 0)
    ui::property("Holes", fmt::format("{}, {}", s.holes, said("{} border edge", "{} border edges", s.border_edges)));
  if (s.odd_edges + s.odd_vertices > 0)
    ui::property("Not manifold", fmt::format("{}, {}", said("{} edge", "{} edges", s.odd_edges),
                                             said("{} vertex", "{} vertices", s.odd_vertices)));
}

void drawGeometry(const Model& model, InspectorState& state, std::uint32_t index) {
  ui::heading(model, "Geometry");
  const auto& environment = *model.environment();
  const auto& bounds_of = model.boundsOfProducts()[index];
  if (!ui::beginProperties("geometry", 0.25F)) return;
  const auto triangles = trianglesOf(environment, index);
  ui::property("Triangles", groupedDigits(triangles));
  if (triangles <= kMostCounted) drawConnections(model, state, index);
  if (!bounds_of.empty()) {
    ui::property("Size", coordinates(bounds_of.max - bounds_of.min) + " m");
    ui::property("From", coordinates(bounds_of.min + model.shift_m()));
    ui::property("To", coordinates(bounds_of.max + model.shift_m()));
  }
  if (const auto& light = model.session.document().simplified; light && index < light->products.size()) {
    const auto& loss = light->products[index];
    ui::property("Before", trf("{} triangles", groupedDigits(loss.triangles_before)));
    ui::property("Deviation",
                 trf("at most {:.1f} mm, mean {:.2f} mm", loss.max_deviation_m * 1000, loss.mean_deviation_m * 1000));
  }
  ui::endProperties();
}

void drawLayers(const Model& model, const Product& product) {
  if (product.layers.empty() && product.materials.empty()) return;
  ui::heading(model, "Materials in the model");
  if (!ui::beginProperties("layers", 0.68F)) return;
  for (const auto& layer : product.layers)
    ui::property(layer.name.empty() ? "Air" : layer.name.c_str(), figures("{:.4g} mm", layer.thickness_m * 1000));
  if (product.layers.empty())
    for (const auto& name : product.materials) ui::property(name, " ");
  ui::endProperties();
}

// What its faces look like, each surface once, with its share: a wall's sides may be of two layers.
void drawSurfaces(const Model& model, std::uint32_t product) {
  const auto& environment = *model.environment();
  std::map<std::uint32_t, double> area_of;
  for (const auto& instance : environment.instances) {
    if (instance.product != product) continue;
    const auto& mesh = *environment.meshes[instance.mesh];
    for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
      const auto& t = mesh.triangles[k];
      const auto at = [&](int i) {
        return Eigen::Vector3d(instance.world_from_mesh.linear() *
                               mesh.positions[t[static_cast<std::size_t>(i)]].cast<double>());
      };
      area_of[mesh.surface_of_triangle[k]] += (at(1) - at(0)).cross(at(2) - at(0)).norm() / 2;
    }
  }
  if (area_of.empty()) return;
  ui::heading(model, "Surfaces in the model");
  for (const auto& [index, area] : area_of) {
    const auto& surface = environment.surfaces[index];
    ui::swatch(model, surface.colour);
    ImGui::SameLine();
    std::string text = figures("{}  {:.2f} m²", surface.name.empty() ? tr("Nameless") : surface.name, area);
    if (surface.image >= 0) text += "  " + environment.images[static_cast<std::size_t>(surface.image)]->name;
    ui::wrapped(text);
  }
}

// The physical materials that a product's surfaces have, each once.
std::vector<std::pair<std::int32_t, std::string>> materialsOf(const MaterialAssignment& assignment,
                                                              std::uint32_t product) {
  std::vector<std::pair<std::int32_t, std::string>> found;
  for (const auto& s : assignment.surfaces)
    if (s.product == product &&
        std::none_of(found.begin(), found.end(), [&](const auto& f) { return f.first == s.material; }))
      found.emplace_back(s.material, s.reason);
  return found;
}

// "rule 12 of default.json" says nothing to whoever has not written it.
std::string withoutFileOfRules(std::string reason) {
  constexpr std::string_view kFile = "default.json";
  if (reason.ends_with(kFile)) reason.replace(reason.size() - kFile.size(), kFile.size(), tr("the built-in rules"));
  return reason;
}

void assign(const Model& model, Actions& actions, const PhysicalMaterial& material) {
  std::vector<MaterialOverride> overrides;
  for (const auto p : model.selection.products())
    overrides.push_back({selectorOf(model.environment()->products[p]), material.id});
  const auto count = model.selection.products().size();
  actions.start(
      MaterialsOptions{{.assign = std::move(overrides)}},
      trf("Assign {} to {}", tr(material.label), trn("{} product", "{} products", count, groupedDigits(count))));
}

void drawAssign(const Model& model, InspectorState& state, Actions& actions, const std::string& current) {
  if (const auto why = model.session.whyNot("materials"); !why.empty()) {
    ui::button((current + "###assign").c_str(), why, {-FLT_MIN, 0});
    return;
  }
  if (state.material_list_wanted) {
    state.material_list_wanted = !ImGui::IsRectVisible({1, ImGui::GetFrameHeight()});
    if (state.material_list_wanted)
      ImGui::SetScrollHereY();
    else
      ImGui::OpenPopupEx(ImHashStr("##ComboPopup", 0, ImGui::GetID("###assign")));
  }
  ImGui::SetNextItemWidth(-FLT_MIN);
  if (!ui::beginDropDown("###assign", current.c_str(), ImGuiComboFlags_HeightLargest)) return;
  const auto& catalogue = model.catalogue();
  auto& filter = state.material_filter;
  const bool appears = ImGui::IsWindowAppearing();
  if (appears) filter.clear();
  const float width = model.px(300);
  ImGui::BeginChild("material-search", {width, ImGui::GetFrameHeight()});  // the field takes all the room that there is
  if (appears) ui::focusNext();
  ui::searchField("material-filter", "Brick, glass, steel …", filter);
  ImGui::EndChild();
  std::vector<const PhysicalMaterial*> listed;
  for (const auto* material : model.offeredByName()) {
    Product searched;
    searched.name = material->label + " " + tr(material->label) + " " + material->id;
    if (!isGap(*material) && matchesFilter(searched, filter)) listed.push_back(material);
  }
  const std::size_t lines = catalogue.materials.empty() ? 4 : std::max<std::size_t>(listed.size(), 1);
  const float height = ImGui::GetTextLineHeightWithSpacing() * static_cast<float>(lines);
  ImGui::BeginChild("materials", {width, std::min(model.px(260), height)});  // no higher than what is found
  for (const auto* material : listed) {
    ui::swatch(model, materialColour(material));
    ImGui::SameLine();
    if (ui::choice((tr(material->label) + "###" + material->id).c_str())) {
      assign(model, actions, *material);
      ImGui::CloseCurrentPopup();
    }
  }
  if (catalogue.materials.empty())
    ui::wrapped(catalogue.problem.empty() ? "The material library is empty." : catalogue.problem);
  else if (listed.empty())
    ui::dimText("No matches");
  ImGui::EndChild();
  ui::endDropDown();
}

void drawPhysics(const PhysicalMaterial& m) {
  if (!ui::beginProperties(m.id.c_str(), 0.52F)) return;
  for (const double wavelength : {905.0, 1064.0, 1550.0})
    ui::property(trf("Reflectance {:.0f} nm", wavelength).c_str(),
                 fmt::format("{:.0f} %", atWavelength(m.reflectance, wavelength) * 100));
  if (m.roughness_rad > 0) ui::property("Roughness σ", figures("{:.2f} rad", m.roughness_rad));
  if (m.index_of_refraction > 0) ui::property("Index of refraction", figures("{:.2f}", m.index_of_refraction));
  if (!m.transmittance.empty())
    ui::property("Transmittance 1550 nm", fmt::format("{:.0f} %", atWavelength(m.transmittance, 1550) * 100));
  ui::endProperties();
}

void drawPhysicalMaterial(const Model& model, InspectorState& state, Actions& actions, std::uint32_t index) {
  ui::heading(model, "Physical material");
  const auto& choice = model.session.document().materials;
  if (!choice) {
    drawAssign(model, state, actions, tr("No material assigned"));
    return;
  }
  const auto& assignment = choice->result.assignment;
  const auto found = materialsOf(assignment, index);
  std::string current = tr("Unassigned");
  if (found.size() == 1 && found[0].first >= 0)
    current = tr(assignment.materials[static_cast<std::size_t>(found[0].first)].label);
  if (found.size() > 1) current = trf("{} materials", found.size());
  drawAssign(model, state, actions, current);
  for (const auto& [material, reason] : found) {
    if (material < 0) {
      ImGui::TextColored(colour(tone::kUnassigned), "%s  %s", ICON_WARNING, tr("No matching rule").c_str());
      continue;
    }
    const auto& m = assignment.materials[static_cast<std::size_t>(material)];
    ui::swatch(model, materialColour(&m));
    ImGui::SameLine();
    ui::wrapped(tr(m.label));
    if (!reason.empty()) ui::tooltip(trf("Matched by: {}", withoutFileOfRules(trSentence(reason))));
    drawPhysics(m);
  }
}

void drawProperties(const Model& model, InspectorState& state, const Product& product) {
  if (product.properties.empty()) return;
  ui::heading(model, "Properties");
  auto& filter = state.property_filter;
  if (product.properties.size() > 12) ui::searchField("property-filter", "Property", filter);
  std::vector<std::string> order;
  std::map<std::string, std::vector<const Property*>> sets;
  for (const auto& p : product.properties) {
    Product searched;
    searched.name = p.name + " " + p.value + " " + p.set;
    if (!matchesFilter(searched, filter)) continue;
    if (sets.find(p.set) == sets.end()) order.push_back(p.set);
    sets[p.set].push_back(&p);
  }
  for (const auto& set : order) {
    const std::string title = set.empty() ? tr("Attributes") : set;
    if (!ImGui::TreeNodeEx((title + "###set-" + set).c_str(), ImGuiTreeNodeFlags_DefaultOpen |
                                                                  ImGuiTreeNodeFlags_SpanAvailWidth |
                                                                  ImGuiTreeNodeFlags_NoTreePushOnOpen))
      continue;
    if (!ui::beginProperties(set.c_str(), 0.48F)) continue;
    for (const auto* p : sets[set]) ui::property(p->name, p->value);
    ui::endProperties();
  }
}

// Of the storey, space or part of a facility that it stands in.
void drawPlaceProperties(const Model& model, const Product& product) {
  if (product.container < 0) return;
  const auto& node = model.environment()->spatial[static_cast<std::size_t>(product.container)];
  if (node.properties.empty()) return;
  ui::heading(model, (trf("Properties of {}", nodeLabel(node))).c_str());
  if (!ui::beginProperties("place-properties", 0.48F)) return;
  for (const auto& p : node.properties) ui::property(p.name, p.value);
  ui::endProperties();
}

// What can be done with what is selected.
void drawButtons(Actions& actions) {
  const float width = ui::shareOfRow(2);
  int i = 0;
  for (const auto& [id, text] : {std::pair{"frame", "Frame"}, std::pair{"hide", "Hide"},
                                 std::pair{"isolate", "Isolate"}, std::pair{"exclude", "Exclude"},
                                 std::pair{"keep", "Never simplify"}, std::pair{"by-rules", "Reset to rules"}}) {
    if (i++ % 2 != 0) ImGui::SameLine();
    actions.button(id, text, width);
  }
}

void drawMany(const Model& model, InspectorState& state, Actions& actions) {
  const auto& products = model.selection.products();
  ui::heading(model, trn("{} product", "{} products", products.size(), groupedDigits(products.size())).c_str());
  std::map<std::string, int> classes;
  std::uint64_t triangles = 0;
  std::vector<std::uint8_t> chosen(model.environment()->products.size(), 0);
  for (const auto p : products) {
    ++classes[tr(readableClass(model.environment()->products[p].ifc_class))];
    chosen[p] = 1;
  }
  for (const auto& i : model.environment()->instances)
    if (chosen[i.product] != 0) triangles += model.environment()->meshes[i.mesh]->triangles.size();
  if (ui::beginProperties("many", 0.45F)) {
    for (const auto& [name, count] : classes) ui::property(name, std::to_string(count));
    ui::property("Triangles", groupedDigits(triangles));
    const auto all = model.selectionBounds();
    if (!all.empty()) ui::property("Size", coordinates(all.max - all.min) + " m");
    ui::endProperties();
  }
  drawButtons(actions);
  ui::heading(model, "Physical material");
  drawAssign(model, state, actions, tr("Assign to …"));
}

void draw(const Model& model, PanelStates& states, Actions& actions) {
  auto& state = states.of<InspectorState>();
  state.material_list_wanted |= std::exchange(states.of<InspectorWish>().materials, false);
  const bool in_survey = drawSurveyInspector(model, states, actions);
  const auto& environment = model.environment();
  if (!environment || model.selection.empty() || model.selection.primary() >= environment->products.size()) {
    if (!in_survey)
      ui::emptyState(model, ICON_POINTER, "Nothing selected",
                     "Select a product, station, target or underlay to see its properties and edit them.");
    return;
  }
  if (model.selection.products().size() > 1) {
    drawMany(model, state, actions);
    return;
  }
  const auto index = model.selection.primary();
  const auto& product = environment->products[index];
  if (model.fonts.bold != nullptr) ImGui::PushFont(model.fonts.bold);
  ui::wrapped(productLabel(product));
  if (model.fonts.bold != nullptr) ImGui::PopFont();
  drawIdentity(model, product);
  if (product.ifc_class == "IfcSpace" && !product.excluded &&
      ui::button(ICON_WALK "  Go there###go-to-room", {}, {-FLT_MIN, 0}, "Walk into the room"))
    actions.goToRoom(index);
  drawButtons(actions);
  drawPhysicalMaterial(model, state, actions, index);
  drawGeometry(model, state, index);
  drawLayers(model, product);
  drawSurfaces(model, index);
  drawProperties(model, state, product);
  drawPlaceProperties(model, product);
}

}  // namespace

void drawInspectorPanel(const Model& model, PanelStates& states, Actions& actions) { draw(model, states, actions); }

}  // namespace standpoint
