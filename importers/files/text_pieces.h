// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "importers/files/file_bytes.h"

namespace standpoint {

// The statements of a text that begin within [from, from + size): whole lines, a continued one too, so that pieces can
// be read apart. A line's end after a backslash parts nothing, whatever the line is: that errs on the safe side. Ends
// with a line's end that is added where the text has none; empty where a long line begins before and ends after.
Result<std::string> textPiece(const FileBytes& bytes, std::uint64_t from, std::size_t size);

// 'word', as a message shows what a file says; the first `most` bytes of it.
std::string inQuotes(std::string_view word, std::size_t most = 60);

}  // namespace standpoint
