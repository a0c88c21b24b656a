// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "project/answer_fields.h"

namespace standpoint {

struct NamedStart {  // how a device is switched on
  std::string key;
  double seconds = 0;  // until it rests
  std::string screen;  // that it then shows
};
const AnswerFields<NamedStart>& answerFields(const NamedStart*);
struct NamedDevice {
  std::string id, title;
  NamedStart start;
  std::vector<std::string> instruments;  // that it drives
};
const AnswerFields<NamedDevice>& answerFields(const NamedDevice*);
struct NamedDevices {
  std::vector<NamedDevice> devices;
};
const AnswerFields<NamedDevices>& answerFields(const NamedDevices*);

struct NamedDomain {  // one of the choices, a number from minimum to maximum, or a text
  std::vector<std::string> choices;
  std::optional<double> minimum, maximum;
  std::optional<bool> text;
  std::optional<std::string> default_value;  // of a setting or value
  std::optional<std::string> about;          // of a fact
};
const AnswerFields<NamedDomain>& answerFields(const NamedDomain*);
using NamedDomains = std::map<std::string, NamedDomain>;
using NamedLists = std::map<std::string, std::vector<std::string>>;
// All names that an exercise for a device may use, and what each can be.
struct DeviceNames {
  std::string device, title;
  NamedStart start;
  std::map<std::string, NamedDomains> settings;  // by instrument
  NamedDomains values;
  std::vector<std::string> keys;
  NamedLists screens, dialogs;  // with their widgets, and their buttons
  std::vector<std::string> phases;
  NamedDomains facts;
  std::map<std::string, std::string> hands;  // what the value of each is
  std::vector<std::string> troubles;
  std::map<std::string, std::string> events;  // about each
};
const AnswerFields<DeviceNames>& answerFields(const DeviceNames*);

// For authors of exercises.
Result<NamedDevices> namedDevices();
Result<DeviceNames> namesOf(const std::string& device);

// The same for people.
std::string textOf(const NamedDevices& devices);
std::string textOf(const DeviceNames& names);

}  // namespace standpoint
