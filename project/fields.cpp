// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/fields.h"

namespace standpoint::fields {

using nlohmann::json;

json writtenPlace(const FloorPlace& place) {
  json numbers = {place.x_m, place.y_m};
  if (place.z_m) numbers.push_back(*place.z_m);
  return numbers;
}

FloorPlace placeFrom(const json& numbers) {
  FloorPlace place{numbers[0].get<double>(), numbers[1].get<double>(), {}};
  if (numbers.size() > 2) place.z_m = numbers[2].get<double>();
  return place;
}

json writtenPairs(const KeyValues& pairs) {
  json texts;
  for (const auto& [key, value] : pairs) texts.push_back(key + "=" + value);
  return texts;
}

KeyValues pairsFrom(const json& texts) {
  KeyValues pairs;
  for (const auto& each : texts) {
    const auto& text = each.get_ref<const std::string&>();
    const auto equals = text.find('=');
    pairs.emplace_back(text.substr(0, equals), text.substr(equals + 1));
  }
  return pairs;
}

}  // namespace standpoint::fields
