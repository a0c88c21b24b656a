// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>

#include <tl/expected.hpp>

namespace standpoint {

enum class ErrorKind {
  usage,        // wrong option or argument: exit code 2
  unusable,     // the input is not usable as it is: exit code 3
  file_system,  // cannot read, write, create, or the disk is full: exit code 4
  cancelled,    // the user asked for it: exit code 130
  internal,     // a defect of ours, or of a library: exit code 3
};

// `source` names file and place ("house.ifc #1234", "rtc360.json /range_noise_m", "job.json line 7").
// `message` says what is wrong and, where there is one, the remedy.
struct Error {
  ErrorKind kind = ErrorKind::internal;
  std::string message;
  std::string source;
};

template <class T>
using Result = tl::expected<T, Error>;

inline tl::unexpected<Error> failure(ErrorKind kind, std::string message, std::string source = {}) {
  return tl::unexpected<Error>(Error{kind, std::move(message), std::move(source)});
}

inline tl::unexpected<Error> failure(Error error) { return tl::unexpected<Error>(std::move(error)); }

// TRY(saved(file)); goes on where that succeeded, else returns its error from this function.
// TRY_ASSIGN(auto model, read(file)); does the same and keeps the value.
#define TRY(...)                                                                      \
  do {                                                                                \
    if (auto tried = (__VA_ARGS__); !tried) return failure(std::move(tried).error()); \
  } while (false)
#define TRY_ASSIGN(declaration, ...) \
  STANDPOINT_TRY_ASSIGN(STANDPOINT_JOINED(tried_, __COUNTER__), declaration, __VA_ARGS__)
#define STANDPOINT_TRY_ASSIGN(tried, declaration, ...)  \
  auto tried = (__VA_ARGS__);                           \
  if (!tried) return failure(std::move(tried).error()); \
  declaration = *std::move(tried)
#define STANDPOINT_JOINED(a, b) STANDPOINT_JOINED_NOW(a, b)
#define STANDPOINT_JOINED_NOW(a, b) a##b

// "house.ifc #12: message"
inline std::string describe(const Error& error) {
  return error.source.empty() ? error.message : error.source + ": " + error.message;
}

}  // namespace standpoint
