// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include <strings.h>

#include <sphmbs/core/error.hpp>

namespace sphmbs::execution {

/// Where the loops of a policy run.
struct Device {
  std::string name;        ///< as its driver calls it
  std::size_t memory = 0;  ///< in all [bytes]; 0 where the runtime does not tell
  std::size_t free = 0;    ///< for fields, those there are included [bytes]; 0 as before
  bool is_host = false;  ///< for device policies: the host stands in, because the user asked for it
};

namespace detail {

/// Whether an environment variable has a value, in capitals or not.
inline bool environment_says(const char* variable, const char* value) {
  const char* const found = std::getenv(variable);
  return found != nullptr && strcasecmp(found, value) == 0;
}

/// Device policies never fall back to the host by themselves.
[[noreturn]] inline void no_device(std::string_view policy, std::string_view hint) {
  throw InvalidInput("execution policy " + std::string(policy) + ": no device was found; " +
                     std::string(hint));
}

}  // namespace detail
}  // namespace sphmbs::execution
