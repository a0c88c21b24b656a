// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/labels.h"

#include <fstream>

#include <nlohmann/json.hpp>

namespace standpoint {

Result<Labels> Labels::read(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) return failure(ErrorKind::file_system, "cannot read the labels", file.string());
  const auto content = nlohmann::json::parse(in, nullptr, false);
  if (!content.is_object() || !content.contains("labels") || !content["labels"].is_object())
    return failure(ErrorKind::unusable, "it has no object 'labels'", file.string());
  Labels labels;
  for (const auto& [key, value] : content["labels"].items()) {
    if (!value.is_string()) return failure(ErrorKind::unusable, "a label is a text", file.string() + " /labels/" + key);
    labels.texts_[key] = value.get<std::string>();
  }
  return labels;
}

std::string Labels::operator()(const std::string& key) const {
  const auto found = texts_.find(key);
  return found == texts_.end() ? key : found->second;
}

}  // namespace standpoint
