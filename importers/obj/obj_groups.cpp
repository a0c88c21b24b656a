// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/obj/obj_groups.h"

#include <map>
#include <utility>

namespace standpoint {

namespace {

std::vector<std::string> words(const std::string& text) {
  std::vector<std::string> result;
  for (std::size_t at = 0; (at = text.find_first_not_of(' ', at)) != std::string::npos;) {
    const auto end = std::min(text.find(' ', at), text.size());
    result.push_back(text.substr(at, end - at));
    at = end;
  }
  return result;
}

class Grouping {
 public:
  Grouping(const ObjFile& file, const std::string& stem) : file_(file), stem_(stem) {}

  ObjGroups run() {
    for (const auto& event : file_.events) {
      facesUpTo(event.face);
      apply(event);
    }
    facesUpTo(static_cast<std::uint32_t>(file_.faceCount()));
    return std::move(out_);
  }

 private:
  void apply(const ObjEvent& event) {
    switch (event.what) {
      case ObjChange::object:
        object_ = event.text;
        if (group_has_faces_) group_.clear();
        current_product_ = -1;
        break;
      case ObjChange::group:
        group_ = event.text == "default" ? std::string() : event.text;  // Maya's word for none
        group_has_faces_ = false;
        current_product_ = -1;
        break;
      case ObjChange::material:
        material_ = event.text;
        material_line_ = event.line;
        current_surface_ = -1;
        break;
      case ObjChange::library: out_.libraries.push_back({event.line, event.text});
    }
  }

  void facesUpTo(std::uint32_t face) {
    if (face == done_) return;
    group_has_faces_ = true;
    const auto p = product(), s = surface();
    auto& runs = out_.runs;
    if (!runs.empty() && runs.back().product == p && runs.back().surface == s)
      runs.back().end = face;
    else
      runs.push_back({done_, face, p, s});
    done_ = face;
  }

  std::uint32_t product() {
    if (current_product_ >= 0) return static_cast<std::uint32_t>(current_product_);
    const auto [known, is_new] =
        product_of_.try_emplace({object_, group_}, static_cast<std::uint32_t>(out_.products.size()));
    if (is_new) out_.products.push_back(newProduct());
    current_product_ = known->second;
    return known->second;
  }

  Product newProduct() const {
    Product p;
    const auto groups = words(group_);
    p.id = object_.empty() ? "g " : "o ";
    p.id += object_.empty() ? group_ : object_;
    if (!object_.empty() && !group_.empty()) p.id.append(" g ").append(group_);
    const std::string group = groups.empty() ? "" : groups.front();
    p.name = object_.empty() ? group : group.empty() || group == object_ ? object_ : object_ + " " + group;
    if (p.name.empty()) p.name = stem_, p.id = "o";
    if (groups.size() > 1 || !object_.empty()) p.groups = groups;
    return p;
  }

  std::uint32_t surface() {
    if (current_surface_ >= 0) return static_cast<std::uint32_t>(current_surface_);
    const auto [known, is_new] = surface_of_.try_emplace(material_, static_cast<std::uint32_t>(out_.surfaces.size()));
    if (is_new) {
      Surface s;
      s.name = material_;
      s.source = material_.empty() ? "no usemtl" : "usemtl " + material_;
      if (material_.empty() && !file_.colours.empty()) s.colour = {1, 1, 1, 1};  // the vertices have the colour
      out_.surfaces.push_back(std::move(s));
      out_.first_use.push_back(material_line_);
    }
    current_surface_ = known->second;
    return known->second;
  }

  const ObjFile& file_;
  const std::string& stem_;
  ObjGroups out_;
  std::string object_, group_, material_;
  std::size_t material_line_ = 0;
  bool group_has_faces_ = false;
  std::uint32_t done_ = 0;
  std::int64_t current_product_ = -1, current_surface_ = -1;
  std::map<std::pair<std::string, std::string>, std::uint32_t> product_of_;
  std::map<std::string, std::uint32_t> surface_of_;
};

}  // namespace

ObjGroups groupObjFaces(const ObjFile& file, const std::string& stem) { return Grouping(file, stem).run(); }

}  // namespace standpoint
