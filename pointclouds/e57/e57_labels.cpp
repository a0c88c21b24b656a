// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/e57/e57_labels.h"

#include <string_view>

#include "pointclouds/files/escaped_text.h"

namespace standpoint::e57 {
namespace {

std::vector<std::string_view> lines(std::string_view text) {
  auto all = split(text, '\n');
  all.pop_back();  // each line ends with a line feed
  return all;
}

}  // namespace

std::string productsText(const std::vector<LabelledProduct>& products) {
  std::string text;
  for (const auto& product : products) {
    for (const std::string* value : {&product.id, &product.global_id, &product.ifc_class}) {
      appendEscaped(text, *value);
      text += '\t';
    }
    appendEscaped(text, product.name);
    text += '\n';
  }
  return text;
}

std::string materialsText(const std::vector<std::string>& materials) {
  std::string text;
  for (const auto& material : materials) {
    appendEscaped(text, material);
    text += '\n';
  }
  return text;
}

std::vector<LabelledProduct> productsFrom(const std::string& text) {
  std::vector<LabelledProduct> products;
  for (const std::string_view line : lines(text)) {
    auto values = split(line, '\t');
    values.resize(4);
    products.push_back({unescaped(values[0]), unescaped(values[1]), unescaped(values[2]), unescaped(values[3])});
  }
  return products;
}

std::vector<std::string> materialsFrom(const std::string& text) {
  std::vector<std::string> materials;
  for (const std::string_view line : lines(text)) materials.push_back(unescaped(line));
  return materials;
}

}  // namespace standpoint::e57
