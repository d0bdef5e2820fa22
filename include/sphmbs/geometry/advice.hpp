// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <sphmbs/geometry/inspection.hpp>

namespace sphmbs::geometry {

/// One sentence about something that a user should know but that stops nothing.
struct Advice {
  std::string_view id;  ///< heading in docs/messages.md
  std::string text;     ///< the sentence, without the id
};

namespace detail {

template <int Dim>
std::string written(const Vec<Dim>& x) {
  std::ostringstream text;
  for (int k = 0; k < Dim; ++k) text << (k == 0 ? "(" : ", ") << x[k];
  return text.str() + ")";
}

template <int Dim>
std::string list_holes(const Inspection<Dim>& seen) {
  constexpr std::size_t most = 5;
  std::ostringstream text;
  for (std::size_t i = 0; i < seen.holes.size() && i < most; ++i) {
    const auto& hole = seen.holes[i];
    text << (i == 0 ? "" : ", ") << hole.size << " m at " << written<Dim>(hole.at) << " m ("
         << hole.edges << (hole.edges == 1 ? " edge)" : " edges)");
  }
  if (seen.holes.size() > most) text << " and " << seen.holes.size() - most << " smaller ones";
  return text.str();
}

}  // namespace detail

/// What is to be said about a surface that is put into a space: holes, facets that contradict each
/// other, a size that looks like another unit, a place outside. Nothing of a good one.
/// @param space  box in which the gas lives [m]
template <int Dim>
std::vector<Advice> advise(const Inspection<Dim>& seen, const Box<Dim>& space) {
  std::vector<Advice> advice;
  const auto say = [&](std::string_view id, const auto&... words) {
    std::ostringstream text;
    (text << ... << words);
    advice.push_back({id, text.str()});
  };
  if (!seen.holes.empty())
    say("W150", "the surface is not closed, it has ", seen.holes.size(),
        seen.holes.size() == 1 ? " hole: " : " holes: ", detail::list_holes(seen),
        "; inside is told by its winding, which is right away from them");
  if (seen.branched + seen.contradicting > 0)
    say("W151", "of the surface's edges ", seen.branched, " join more than two facets and ",
        seen.contradicting, " join two that disagree about which side is inside");
  if (seen.degenerate + seen.duplicate > 0)
    say("W152", "of the surface's ", seen.facets, " facets ", seen.degenerate,
        " have no extent and are left out, ", seen.duplicate, " are there twice");
  const double size = std::sqrt(norm2(seen.box.upper - seen.box.lower));
  const double room = std::sqrt(norm2(space.upper - space.lower));
  if (size > 100 * room || size < 1e-3 * room)
    say("W153", "the surface is ", size, " m across and the domain ", room,
        " m: is its unit right, such as 0.001 for millimetres?");
  bool apart = false;
  for (int k = 0; k < Dim; ++k)
    apart = apart || seen.box.lower[k] > space.upper[k] || seen.box.upper[k] < space.lower[k];
  if (apart)
    say("W154", "the surface, from ", detail::written<Dim>(seen.box.lower), " to ",
        detail::written<Dim>(seen.box.upper), " m, lies outside the domain");
  return advice;
}

}  // namespace sphmbs::geometry
