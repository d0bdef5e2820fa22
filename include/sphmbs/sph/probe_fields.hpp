// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <sphmbs/core/error.hpp>
#include <sphmbs/sph/probe.hpp>

namespace sphmbs::sph {

/// A quantity of the local gas. Those of a program are made like this, and run on the host:
/// `ProbeField<2>{"stagnation_pressure", "Pa", [](const LocalGas<2>& gas) { ... }}`.
template <int Dim>
struct ProbeField {
  std::string name;  ///< for the head of a column
  std::string unit;  ///< such as "Pa"; "-" for none
  /// Its number, from the gas at a place.
  std::function<double(const LocalGas<Dim>&)> value;
};

/// The fields that `names` lists: p, rho, e, v (a column for each component), speed, c (speed of
/// sound), T (temperature), mach. The last four follow from the means of the others, so that the
/// columns of a probe fit together.
/// @throws InvalidInput (E051) for another name.
template <class Scheme>
std::vector<ProbeField<Scheme::dim>> probe_fields(const Scheme& scheme,
                                                  std::span<const std::string> names) {
  constexpr int dim = Scheme::dim;
  using Gas = LocalGas<dim>;
  std::vector<ProbeField<dim>> fields;
  const auto speed = [](const Gas& gas) { return std::sqrt(norm2(gas.v)); };
  const auto sound = [eos = scheme.eos](const Gas& gas) { return eos.sound_speed(gas.rho, gas.p); };
  for (const std::string& name : names) {
    if (name == "p") {
      fields.push_back({"p", "Pa", [](const Gas& gas) { return gas.p; }});
    } else if (name == "rho") {
      fields.push_back({"rho", "kg/m^3", [](const Gas& gas) { return gas.rho; }});
    } else if (name == "e") {
      fields.push_back({"e", "J/kg", [](const Gas& gas) { return gas.e; }});
    } else if (name == "v") {
      for (int k = 0; k < dim; ++k)
        fields.push_back(
            {std::string("v_") + "xyz"[k], "m/s", [k](const Gas& gas) { return gas.v[k]; }});
    } else if (name == "speed") {
      fields.push_back({"speed", "m/s", speed});
    } else if (name == "c") {
      fields.push_back({"c", "m/s", sound});
    } else if (name == "T") {
      fields.push_back({"T", "K", [eos = scheme.eos](const Gas& gas) {
                          return eos.temperature(gas.rho, gas.p);
                        }});
    } else if (name == "mach") {
      fields.push_back(
          {"mach", "-", [speed, sound](const Gas& gas) { return speed(gas) / sound(gas); }});
    } else {
      throw InvalidInput("field \"" + name + "\": must be one of p, rho, e, v, speed, c, T, mach",
                         "E051");
    }
  }
  return fields;
}

}  // namespace sphmbs::sph
