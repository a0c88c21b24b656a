// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/model/product_match.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <tuple>

namespace standpoint {

namespace {

// Key → the only product that has it; products whose key another one has, too, are not in it.
template <class KeyOf>
std::map<std::string, std::int32_t> uniqueKeys(const Environment& e, const std::vector<std::int32_t>& taken,
                                               KeyOf key_of) {
  std::map<std::string, std::int32_t> found;
  std::set<std::string> twice;
  for (std::size_t i = 0; i < e.products.size(); ++i) {
    if (taken[i] != kNoProduct) continue;
    const std::string key = key_of(e.products[i]);
    if (!key.empty() && !found.emplace(key, static_cast<std::int32_t>(i)).second) twice.insert(key);
  }
  for (const auto& key : twice) found.erase(key);
  return found;
}

template <class KeyOf>
void matchBy(const Environment& before, const Environment& after, ProductMatch& match, KeyOf key_of) {
  const auto old_keys = uniqueKeys(before, match.new_of_old, key_of),
             new_keys = uniqueKeys(after, match.old_of_new, key_of);
  for (const auto& [key, old_index] : old_keys) {
    const auto it = new_keys.find(key);
    if (it == new_keys.end()) continue;
    match.new_of_old[static_cast<std::size_t>(old_index)] = it->second;
    match.old_of_new[static_cast<std::size_t>(it->second)] = old_index;
  }
}

// What a beam meets of a product, without regard to how it is cut into triangles.
struct Shape {
  Bounds bounds;
  double area_m2 = 0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  // area · centre
  Eigen::Vector3d spread = Eigen::Vector3d::Zero();  // ∫ x² over the area
  std::set<std::tuple<std::string, float, float, float, float, std::string>> looks;
};

void addTriangle(Shape& shape, const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const double area = (b - a).cross(c - a).norm() / 2;
  shape.area_m2 += area;
  shape.moment += area * (a + b + c) / 3;
  // Exact for a linear function squared: the mean of the squares at the three mid-edges.
  for (const Eigen::Vector3d& m :
       {Eigen::Vector3d((a + b) / 2), Eigen::Vector3d((b + c) / 2), Eigen::Vector3d((c + a) / 2)})
    shape.spread += area / 3 * m.cwiseProduct(m);
}

std::vector<Shape> shapes(const Environment& e) {
  std::vector<Shape> found(e.products.size());
  const auto of_product = productBounds(e);
  for (std::size_t i = 0; i < found.size(); ++i) found[i].bounds = of_product[i];
  for (const Instance& instance : e.instances) {
    Shape& shape = found[instance.product];
    const Mesh& mesh = *e.meshes[instance.mesh];
    const Eigen::Vector3d centre =
        (shape.bounds.min + shape.bounds.max) / 2;  // near the product: sums keep their digits
    for (const Triangle& t : mesh.triangles) {
      const auto at = [&](std::size_t k) {
        return Eigen::Vector3d(instance.world_from_mesh * mesh.positions[t[k]].cast<double>() - centre);
      };
      addTriangle(shape, at(0), at(1), at(2));
    }
    std::uint32_t last = UINT32_MAX;
    for (const std::uint32_t s : mesh.surface_of_triangle) {
      if (s == last) continue;
      last = s;
      const Surface& surface = e.surfaces[s];
      shape.looks.emplace(surface.name, surface.colour.r, surface.colour.g, surface.colour.b, surface.colour.a,
                          surface.image < 0 ? std::string() : e.images[static_cast<std::size_t>(surface.image)]->name);
    }
  }
  return found;
}

bool sameShape(const Shape& a, const Shape& b) {
  constexpr double kSame_m = 1e-4;
  if (a.bounds.empty() != b.bounds.empty()) return false;
  if (a.bounds.empty()) return true;
  if ((a.bounds.min - b.bounds.min).cwiseAbs().maxCoeff() > kSame_m ||
      (a.bounds.max - b.bounds.max).cwiseAbs().maxCoeff() > kSame_m)
    return false;
  const double size = std::max(a.bounds.diagonal(), kSame_m), area = std::max(a.area_m2, kSame_m * kSame_m);
  return std::abs(a.area_m2 - b.area_m2) <= kSame_m * size + 1e-6 * area &&
         (a.moment - b.moment).norm() <= kSame_m * area + 1e-6 * area * size &&
         (a.spread - b.spread).norm() <= 2 * kSame_m * area * size + 1e-6 * area * size * size;
}

std::vector<std::string> changedProperties(const Product& a, const Product& b) {
  std::vector<std::string> which;
  const auto differs = [&](bool different, const char* name) {
    if (different) which.emplace_back(name);
  };
  differs(a.name != b.name, "name");
  differs(a.ifc_class != b.ifc_class, "class");
  differs(a.predefined_type != b.predefined_type, "predefined_type");
  differs(a.type_name != b.type_name, "type");
  differs(a.storey != b.storey, "storey");
  differs(a.groups != b.groups, "groups");
  using Key = std::pair<std::string, std::string>;
  std::map<Key, std::multiset<std::string>> before, after;
  for (const Property& p : a.properties) before[{p.set, p.name}].insert(p.value);
  for (const Property& p : b.properties) after[{p.set, p.name}].insert(p.value);
  for (const auto& [key, values] : before)
    if (const auto it = after.find(key); it == after.end() || it->second != values)
      which.push_back(key.first + "." + key.second);
  for (const auto& [key, values] : after)
    if (!before.contains(key)) which.push_back(key.first + "." + key.second);
  return which;
}

bool sameMaterials(const Product& a, const Product& b) {
  return a.materials == b.materials && std::equal(a.layers.begin(), a.layers.end(), b.layers.begin(), b.layers.end(),
                                                  [](const MaterialLayer& p, const MaterialLayer& q) {
                                                    return p.name == q.name &&
                                                           std::abs(p.thickness_m - q.thickness_m) < 1e-6;
                                                  });
}

}  // namespace

ProductMatch matchProducts(const Environment& before, const Environment& after) {
  ProductMatch match;
  match.new_of_old.assign(before.products.size(), kNoProduct);
  match.old_of_new.assign(after.products.size(), kNoProduct);
  matchBy(before, after, match, [](const Product& p) { return p.global_id; });
  matchBy(before, after, match, [](const Product& p) {
    return !p.global_id.empty() || p.name.empty() ? std::string() : p.ifc_class + '\n' + p.name;
  });
  matchBy(before, after, match, [](const Product& p) {
    return p.global_id + '\n' + p.id + '\n' + p.name;
  });  // also a GlobalId that stands twice
  return match;
}

std::vector<ProductChange> productChanges(const Environment& before, const Environment& after,
                                          const ProductMatch& match) {
  std::vector<ProductChange> changes(before.products.size());
  const auto old_shapes = shapes(before), new_shapes = shapes(after);
  for (std::size_t i = 0; i < changes.size(); ++i) {
    if (match.new_of_old[i] == kNoProduct) continue;
    const auto n = static_cast<std::size_t>(match.new_of_old[i]);
    changes[i].geometry = !sameShape(old_shapes[i], new_shapes[n]);
    changes[i].material =
        old_shapes[i].looks != new_shapes[n].looks || !sameMaterials(before.products[i], after.products[n]);
    changes[i].which = changedProperties(before.products[i], after.products[n]);
    changes[i].properties = !changes[i].which.empty();
  }
  return changes;
}

}  // namespace standpoint
