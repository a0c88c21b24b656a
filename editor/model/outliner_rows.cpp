// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/outliner_rows.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <sstream>

#include "core/readable_name.h"
#include "editor/labels/alphabetical.h"
#include "editor/words/words.h"

namespace standpoint {

namespace {

using Kind = OutlinerRow::Kind;
constexpr const char* kSpace = "IfcSpace";

std::string lower(const std::string& text) {
  std::string result = text;
  for (auto& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

// The place in the structure: a part stands where its whole stands.
std::int32_t containerOf(const Environment& environment, std::uint32_t product) {
  std::int32_t p = static_cast<std::int32_t>(product);
  for (int guard = 0; guard < 64 && p >= 0; ++guard) {
    const auto& record = environment.products[static_cast<std::size_t>(p)];
    if (record.container >= 0) return record.container;
    p = record.whole;
  }
  return -1;
}

}  // namespace

std::string readableClass(const std::string& ifc_class) {
  if (ifc_class.empty()) return "Object";
  const std::string bare = ifc_class.rfind("Ifc", 0) == 0 ? ifc_class.substr(3) : ifc_class;
  std::string result;
  for (std::size_t i = 0; i < bare.size(); ++i) {
    const bool capital = std::isupper(static_cast<unsigned char>(bare[i])) != 0;
    if (capital && i > 0) result += ' ';
    result += i > 0 ? static_cast<char>(std::tolower(static_cast<unsigned char>(bare[i]))) : bare[i];
  }
  return result;
}

std::string withReadableClasses(const std::string& text) {
  constexpr std::string_view kPrefix = "Ifc";
  const auto isLetter = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; };
  std::string readable;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = at;
    const bool begins = at == 0 || !isLetter(text[at - 1]);
    if (begins && text.compare(at, kPrefix.size(), kPrefix) == 0)
      while (end < text.size() && isLetter(text[end])) ++end;
    const bool named = end > at + kPrefix.size() && end + 1 < text.size() && text[end] == ' ' &&
                       (text[end + 1] == '\'' || text[end + 1] == '#' || text.compare(end + 1, 3, "„") == 0);
    if (named)
      readable += tr(readableClass(text.substr(at, end - at)));
    else
      readable += text[at], end = at + 1;
    at = end;
  }
  return readable;
}

std::string productLabel(const Product& product) {
  if (product.ifc_class == kSpace) return readableName(product);
  if (!product.name.empty()) return product.name;
  return readableClass(product.ifc_class) + " " + product.id;
}

bool matchesFilter(const Product& product, const std::string& filter) {
  std::string all = readableName(product) + '\n' + product.ifc_class + '\n' + product.id + '\n' + product.global_id +
                    '\n' + product.storey;
  for (const auto& m : product.materials) all += '\n' + m;
  all = lower(all);
  std::istringstream words(lower(filter));
  for (std::string word; words >> word;)
    if (all.find(word) == std::string::npos) return false;
  return true;
}

Outliner::Outliner(const Environment& environment) {
  addSpatial(environment);
  node_of_product_.assign(environment.products.size(), -1);
  nameRooms(environment);
  addProducts(environment);
  countProducts();
  // Open down to the storeys: what one wants to see first.
  for (std::uint32_t n = 0; n < nodes_.size(); ++n)
    if (nodes_[n].kind == Kind::spatial && environment.spatial[nodes_[n].index].ifc_class != "IfcBuildingStorey" &&
        environment.spatial[nodes_[n].index].ifc_class != kSpace)
      expanded_.insert(n);
  if (environment.spatial.empty()) expandAll(true);
}

std::uint32_t Outliner::add(Kind kind, std::uint32_t index, std::int32_t parent, std::string label) {
  const auto n = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back({kind, index, parent, std::move(label), {}, 0});
  if (parent < 0)
    roots_.push_back(n);
  else
    nodes_[static_cast<std::size_t>(parent)].children.push_back(n);
  return n;
}

void Outliner::addSpatial(const Environment& environment) {
  for (std::uint32_t i = 0; i < environment.spatial.size(); ++i) {
    const auto& s = environment.spatial[i];
    add(Kind::spatial, i, s.parent, s.name.empty() ? readableClass(s.ifc_class) : s.name);  // parents come first
  }
}

// A room is part of the structure and a product with a body: one row for both, with number and long name.
void Outliner::nameRooms(const Environment& environment) {
  std::map<std::string, std::uint32_t> room_of_id;
  for (std::uint32_t i = 0; i < environment.spatial.size(); ++i)
    if (environment.spatial[i].ifc_class == kSpace && !environment.spatial[i].global_id.empty())
      room_of_id.emplace(environment.spatial[i].global_id, i);
  for (std::uint32_t p = 0; p < environment.products.size(); ++p) {
    const auto& product = environment.products[p];
    const auto room = product.ifc_class == kSpace ? room_of_id.find(product.global_id) : room_of_id.end();
    if (room == room_of_id.end() || nodes_[room->second].kind == Kind::product) continue;
    auto& node = nodes_[room->second];
    node.kind = Kind::product;
    node.index = p;
    node.label = productLabel(product);
    node_of_product_[p] = static_cast<std::int32_t>(room->second);
  }
  for (auto& node : nodes_) sortRooms(environment, node.children);
}

// Among themselves, as people do; what else lies there stays where it is.
void Outliner::sortRooms(const Environment& environment, std::vector<std::uint32_t>& children) const {
  const auto isRoom = [&](std::uint32_t n) { return environment.spatial[n].ifc_class == kSpace; };
  std::vector<std::pair<std::string, std::uint32_t>> rooms;
  for (const auto n : children)
    if (isRoom(n)) rooms.emplace_back(alphabeticalKey(nodes_[n].label), n);
  std::sort(rooms.begin(), rooms.end());
  auto next = rooms.begin();
  for (auto& n : children)
    if (isRoom(n)) n = (next++)->second;
}

void Outliner::addProducts(const Environment& environment) {
  std::map<std::pair<std::int32_t, std::string>, std::vector<std::uint32_t>> groups;
  for (std::uint32_t p = 0; p < environment.products.size(); ++p)
    if (node_of_product_[p] < 0) groups[{containerOf(environment, p), environment.products[p].ifc_class}].push_back(p);
  for (auto& [key, members] : groups) {
    std::vector<std::pair<std::string, std::uint32_t>> sorted;
    for (const auto p : members) sorted.emplace_back(alphabeticalKey(productLabel(environment.products[p])), p);
    std::sort(sorted.begin(), sorted.end());
    const auto group = add(Kind::group, sorted.front().second, key.first, readableClass(key.second));
    for (const auto& [name, p] : sorted)
      node_of_product_[p] = static_cast<std::int32_t>(
          add(Kind::product, p, static_cast<std::int32_t>(group), productLabel(environment.products[p])));
  }
}

void Outliner::countProducts() {
  for (std::size_t n = nodes_.size(); n-- > 0;) {  // children come after their parents
    auto& node = nodes_[n];
    if (node.kind == Kind::product) ++node.products;
    if (node.parent >= 0) nodes_[static_cast<std::size_t>(node.parent)].products += node.products;
  }
}

std::vector<OutlinerRow> Outliner::rows(const Environment& environment, const std::string& filter) const {
  std::vector<std::uint8_t> shown(nodes_.size(), filter.empty() ? 1 : 0);
  if (!filter.empty())
    for (std::uint32_t p = 0; p < node_of_product_.size(); ++p)
      if (matchesFilter(environment.products[p], filter))
        for (std::int32_t n = node_of_product_[p]; n >= 0 && shown[static_cast<std::size_t>(n)] == 0;
             n = nodes_[static_cast<std::size_t>(n)].parent)
          shown[static_cast<std::size_t>(n)] = 1;
  std::vector<OutlinerRow> result;
  std::vector<std::pair<std::uint32_t, int>> stack;
  const auto pushAll = [&](const std::vector<std::uint32_t>& list, int depth) {
    for (auto i = list.rbegin(); i != list.rend(); ++i)
      if (shown[*i] != 0) stack.emplace_back(*i, depth);
  };
  pushAll(roots_, 0);
  while (!stack.empty()) {
    const auto [n, depth] = stack.back();
    stack.pop_back();
    const bool open = !nodes_[n].children.empty() && (!filter.empty() || expanded(n));
    result.push_back({nodes_[n].kind, depth, n, !nodes_[n].children.empty(), open});
    if (open) pushAll(nodes_[n].children, depth + 1);
  }
  return result;
}

void Outliner::expand(std::uint32_t node, bool open) {
  if (open)
    expanded_.insert(node);
  else
    expanded_.erase(node);
}

void Outliner::expandAll(bool open) {
  expanded_.clear();
  if (!open) return;
  for (std::uint32_t n = 0; n < nodes_.size(); ++n)
    if (!nodes_[n].children.empty()) expanded_.insert(n);
}

void Outliner::reveal(std::uint32_t product) {
  if (product >= node_of_product_.size() || node_of_product_[product] < 0) return;
  for (std::int32_t n = nodes_[static_cast<std::size_t>(node_of_product_[product])].parent; n >= 0;
       n = nodes_[static_cast<std::size_t>(n)].parent)
    expanded_.insert(static_cast<std::uint32_t>(n));
}

std::vector<std::uint32_t> Outliner::productsBelow(std::uint32_t node) const {
  std::vector<std::uint32_t> result, stack = {node};
  while (!stack.empty()) {
    const auto n = stack.back();
    stack.pop_back();
    if (nodes_[n].kind == Kind::product) result.push_back(nodes_[n].index);
    stack.insert(stack.end(), nodes_[n].children.begin(), nodes_[n].children.end());
  }
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace standpoint
