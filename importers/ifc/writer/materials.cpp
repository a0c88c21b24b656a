// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/writer/materials.h"

#include <algorithm>
#include <utility>

#include "core/number_text.h"
#include "importers/ifc/material.h"

namespace standpoint::ifc {
namespace {

// The value of a property of the set "Material", which is taken out; empty where there is none.
std::string taken(SortedProperties& properties, std::string_view name) {
  const auto it = std::find_if(properties.sets.begin(), properties.sets.end(),
                               [&](const Property* p) { return p->set == "Material" && p->name == name; });
  if (it == properties.sets.end()) return {};
  std::string value = (*it)->value;
  properties.sets.erase(it);
  return value;
}

Property label(const char* name, std::string value) { return {"", name, std::move(value), propertyTypeOf("IFCLABEL")}; }

Property number(const char* name, double value, const char* type = "IFCREAL", const char* unit = "") {
  return {"", name, exactText(value) + unit, propertyTypeOf(type)};
}

}  // namespace

void MaterialWriter::add(Ref object, const Product& product, SortedProperties& properties) {
  std::map<std::string, Ref> known;
  const bool single = product.materials.size() == 1 && product.layers.empty();
  const std::string category = single ? taken(properties, "Category") : std::string();
  const std::string description = single ? taken(properties, "Description") : std::string();
  const auto material = [&](const std::string& name) {
    auto& ref = known[name];
    if (ref == 0) ref = out_.shared(StepRecord("IFCMATERIAL").raw(stepText(name)).text(description).text(category));
    return ref;
  };
  Ref definition = 0;
  if (!product.layers.empty()) {
    std::vector<Ref> layers;
    for (const MaterialLayer& layer : product.layers)
      layers.push_back(out_.shared(StepRecord("IFCMATERIALLAYER")
                                       .ref(layer.name.empty() ? 0 : material(layer.name))
                                       .real(layer.thickness_m)
                                       .none(5)));
    definition = out_.shared(StepRecord("IFCMATERIALLAYERSET").refs(layers).text(taken(properties, "LayerSet")).none());
  } else if (product.materials.size() == 1) {
    definition = material(product.materials[0]);
  } else if (!product.materials.empty()) {
    std::vector<Ref> all;
    for (const std::string& name : product.materials) all.push_back(material(name));
    definition = out_.shared(StepRecord("IFCMATERIALLIST").refs(all));
  }
  if (definition == 0) return;
  objects_of_[definition].push_back(object);
  // "Brick/Pset_MaterialCommon"
  std::map<std::pair<Ref, std::string>, std::vector<Ref>> sets;
  std::erase_if(properties.sets, [&](const Property* p) {
    for (const auto& [name, ref] : known)
      if (p->set.size() > name.size() + 1 && p->set.starts_with(name) && p->set[name.size()] == '/') {
        sets[{ref, p->set.substr(name.size() + 1)}].push_back(properties_.property(*p));
        return true;
      }
    return false;
  });
  for (const auto& [what, members] : sets)
    out_.shared(StepRecord("IFCMATERIALPROPERTIES").text(what.second).none().refs(members).ref(what.first));
}

Ref MaterialWriter::style(const Surface& surface, const PhysicalMaterial* physical) {
  const Colour& c = surface.colour;
  const auto part = [](float value) { return stepReal(value); };
  const Ref rgb = out_.shared(StepRecord("IFCCOLOURRGB").none().raw(part(c.r)).raw(part(c.g)).raw(part(c.b)));
  std::vector<Ref> parts;
  StepRecord rendering("IFCSURFACESTYLERENDERING");
  rendering.ref(rgb).raw(part(1 - c.a)).none(5);
  if (surface.roughness)
    rendering.raw("IFCSPECULARROUGHNESS(" + part(*surface.roughness) + ")");
  else
    rendering.none();
  rendering.symbol(surface.metallic.value_or(0) > 0.5F ? "METAL" : "NOTDEFINED");
  parts.push_back(out_.shared(rendering));
  if (surface.index_of_refraction)
    parts.push_back(
        out_.shared(StepRecord("IFCSURFACESTYLEREFRACTION").raw(part(*surface.index_of_refraction)).none()));
  const Ref style = out_.add(StepRecord("IFCSURFACESTYLE").text(surface.name).symbol("BOTH").refs(parts));
  if (physical != nullptr) {
    Styled& styled = physical_[physical->id];
    styled.material = physical;
    styled.styles.push_back(style);
  }
  return style;
}

void MaterialWriter::writePhysical(const PhysicalMaterial& m, const std::vector<Ref>& styles, Ref context) {
  const Ref material = out_.add(StepRecord("IFCMATERIAL").text(m.id).text(m.label).none());
  std::vector<Ref> items;
  for (const Ref style : styles)
    items.push_back(out_.add(StepRecord("IFCSTYLEDITEM").none().refs(std::array{style}).none()));
  const Ref representation =
      out_.add(StepRecord("IFCSTYLEDREPRESENTATION").ref(context).text("Style").text("Material").refs(items));
  out_.add(StepRecord("IFCMATERIALDEFINITIONREPRESENTATION").none(2).refs(std::array{representation}).ref(material));
  std::vector<Ref> figures{properties_.property(label("Id", m.id))};
  const auto spectrum = [&](const char* name, const Spectrum& table) {
    if (table.empty()) return;
    std::string wavelengths, values;
    for (const auto& [nm, share] : table) {
      wavelengths += (wavelengths.empty() ? "" : ",") + ("IFCREAL(" + stepReal(nm) + ")");
      values += (values.empty() ? "" : ",") + ("IFCREAL(" + stepReal(share) + ")");
    }
    figures.push_back(out_.shared(StepRecord("IFCPROPERTYTABLEVALUE")
                                      .text(name)
                                      .text("over the wavelength in nm")
                                      .raw("(" + wavelengths + ")")
                                      .raw("(" + values + ")")
                                      .none(3)
                                      .symbol("LINEAR")));
  };
  const auto figure = [&](const Property& p) { figures.push_back(properties_.property(p)); };
  spectrum("Reflectance", m.reflectance);
  spectrum("Transmittance", m.transmittance);
  if (m.roughness_rad > 0) figure(number("Roughness", m.roughness_rad, "IFCPLANEANGLEMEASURE", " rad"));
  if (m.gloss_slope > 0) figure(number("GlossSlope", m.gloss_slope));
  if (m.index_of_refraction > 0) figure(number("IndexOfRefraction", m.index_of_refraction));
  if (m.thickness_m > 0) figure(number("Thickness", m.thickness_m, "IFCLENGTHMEASURE", " m"));
  if (m.panes > 1) figure(number("Panes", m.panes));
  if (m.retro_gain > 0) figure(number("RetroGain", m.retro_gain));
  out_.add(StepRecord("IFCMATERIALPROPERTIES").text(kPhysicalMaterialSet).none().refs(figures).ref(material));
}

void MaterialWriter::finish(Ref context) {
  for (const auto& [definition, objects] : objects_of_)
    out_.add(StepRecord("IFCRELASSOCIATESMATERIAL")
                 .text(ids_.make("material " + std::to_string(definition)))
                 .none(3)
                 .refs(objects)
                 .ref(definition));
  for (const auto& [id, styled] : physical_) writePhysical(*styled.material, styled.styles, context);
}

}  // namespace standpoint::ifc
