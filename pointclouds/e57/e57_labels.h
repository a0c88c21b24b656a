// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/points.h"

namespace standpoint::e57 {

// Ground truth in an E57 file, for readers other than ours. Per point the prototype has two integer fields of the
// namespace below, `gt:product` and `gt:material`. Each data3D has `gt:labelTable`, an index into the root's vector
// `gt:labelTables`; so scans of one model share a table. A table has two strings, `gt:products` and `gt:materials`,
// with a line for each index, from 0: a product's line is id, GlobalId, IFC class and name with tabs between them, a
// material's its name. Inside a value a tab stands as \t, a line feed as \n, a backslash as \\ and any other byte
// that XML cannot carry as \xNN. As Python: products = [line.split("\t") for line in text.split("\n")[:-1]].
// What else is known of a point because it was simulated (core/points.h, PointTruth) stands in the fields of
// kTruthFields, all of them or none: single floats in the scanner's frame, metres, radians and decibels, and an integer
// of flags. `gt:truePose` of a data3D, a pose as E2807 has it, is where a scanner truly stood whose crew believed that
// it stands elsewhere: at the standard's `pose`.
inline constexpr const char* kLabelNamespace = "urn:standpoint:e57:ground-truth:1";
inline constexpr const char* kLabelPrefix = "gt";

inline constexpr std::array<const char*, 7> kTruthFields = {"trueX",     "trueY",         "trueZ", "trueRange",
                                                            "incidence", "receivedPower", "flags"};

// Which laser of a head with several sent the pulse, from 0.
inline constexpr const char* kChannelField = "channel";

inline constexpr const char* kTruePose = "truePose";

std::string productsText(const std::vector<LabelledProduct>& products);
std::string materialsText(const std::vector<std::string>& materials);
std::vector<LabelledProduct> productsFrom(const std::string& text);
std::vector<std::string> materialsFrom(const std::string& text);

}  // namespace standpoint::e57
