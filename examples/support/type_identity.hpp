// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <type_traits>
#include <typeinfo>

#include <sphmbs/io/checkpoints.hpp>

#include "support/session_checkpoints.hpp"

namespace sphmbs::examples {

/// The types that the state of a system is of, for the identity of its checkpoints.
template <class System>
io::Identity identity_of_types(System& system) {
  io::Identity types{{"dimension", std::to_string(System::dim)}};
  const auto add_gas = [&]<class Scheme>(std::type_identity<Scheme>) {
    types["kernel"] = readable_type(typeid(typename Scheme::Kernel));
    types["Riemann solver"] = readable_type(typeid(typename Scheme::Riemann));
    types["equation of state"] = readable_type(typeid(decltype(Scheme::eos)));
    types["scheme"] = readable_type(typeid(Scheme));
  };
  if constexpr (requires { typename System::SchemeType; })
    add_gas(std::type_identity<typename System::SchemeType>());
  else if constexpr (requires { system.fluid(); })
    add_gas(
        std::type_identity<typename std::remove_cvref_t<decltype(system.fluid())>::SchemeType>());
  if constexpr (requires { system.structure(); })
    types["structure"] = readable_type(typeid(system.structure()));
  return types;
}

}  // namespace sphmbs::examples
