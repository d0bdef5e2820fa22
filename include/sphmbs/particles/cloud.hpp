// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <sphmbs/core/expects.hpp>
#include <sphmbs/core/math.hpp>
#include <sphmbs/particles/fields.hpp>
#include <sphmbs/particles/opening.hpp>
#include <sphmbs/particles/state.hpp>

namespace sphmbs::particles {

/// The particles a simulation starts from, on the host, in the order they were added. Their index
/// here is the particles' lasting `id`.
template <int Dim>
struct Cloud {
  std::vector<Vec<Dim>> r;  ///< [m]
  std::vector<Vec<Dim>> v;  ///< [m/s]
  std::vector<double> rho;  ///< [kg/m^3]
  std::vector<double> p;    ///< [Pa]
  std::vector<double> h;    ///< [m]
  std::vector<double> m;    ///< [kg]; planar [kg/m]
  /// Set: gas, the number of a set of virtual particles, or an opening's.
  std::vector<std::uint8_t> set;
  /// Normal of the surface before a virtual particle; zero where unknown [-].
  std::vector<Vec<Dim>> normal;
  std::vector<double> depth;           ///< of a virtual particle below that surface [m]
  std::vector<std::uint8_t> sheet;     ///< what a virtual particle is of a thin body
  int sets = 0;                        ///< sets of virtual particles so far
  std::vector<Opening<Dim>> openings;  ///< through which gas comes in and goes out

  /// Number of particles.
  std::size_t size() const { return r.size(); }

  /// Number of those that are gas.
  std::size_t gas_count() const {
    std::size_t n = 0;
    for (const std::uint8_t s : set) n += s == gas ? 1 : 0;
    return n;
  }

  /// Mass of the gas [kg].
  double gas_mass() const {
    double sum = 0;
    for (std::size_t i = 0; i < size(); ++i) sum += set[i] == gas ? m[i] : 0;
    return sum;
  }

  /// Whether there are thin bodies.
  bool has_sheets() const {
    return std::any_of(sheet.begin(), sheet.end(), [](std::uint8_t s) { return s != no_sheet; });
  }

  /// Whether any virtual particle knows its surface.
  bool has_surfaces() const {
    for (const Vec<Dim>& n : normal)
      if (norm2(n) > 0) return true;
    return false;
  }

  /// @throws InvalidInput where virtual particles were added without their solid.
  void require_surfaces() const {
    for (std::size_t i = 0; i < size(); ++i)
      expects(!is_virtual(set[i]) || (i < normal.size() && norm2(normal[i]) > 0),
              "set of virtual particles", static_cast<int>(set[i]),
              "added with its solid, whose surface this wall model needs");
  }

  /// Adds gas, of mass rho spacing^Dim each.
  /// @throws InvalidInput for a density, pressure or spacing that is not positive and finite.
  void add_gas(const std::vector<Vec<Dim>>& points, const State<Dim>& state,
               const Resolution& resolution) {
    add(points, state, resolution, gas);
  }

  /// Adds one set of virtual particles, a wall or a body, and returns its number. They start with
  /// the gas's state, sect. 3.2.
  /// @throws InvalidInput as `add_gas`, or if there are 191 sets already.
  int add_virtual(const std::vector<Vec<Dim>>& points, const State<Dim>& state,
                  const Resolution& resolution) {
    constexpr int most = first_opening - 1;
    expects(sets < most, "sets of virtual particles", sets + 1, "at most " + std::to_string(most));
    ++sets;
    add(points, state, resolution, static_cast<std::uint8_t>(sets));
    return sets;
  }

  /// The same for virtual particles of a solid, whose surface gas is to meet truly: the solid's
  /// signed distance gives each particle its depth below the surface and the surface's normal.
  /// @param solid  any geometry::Shape whose distance is exact near the surface; for walls around
  ///               gas geometry::outside(shape). Normals that it knows are taken from it, others
  ///               are the slope of its distance
  /// @throws InvalidInput also for a point outside the solid by more than half a spacing, or one
  ///         that the distance gives no direction at.
  template <class Solid>
  int add_virtual(const std::vector<Vec<Dim>>& points, const State<Dim>& state,
                  const Resolution& resolution, const Solid& solid) {
    for (const Vec<Dim>& x : points)
      expects(-solid.distance(x) > -0.5 * resolution.spacing,
              "depth of a virtual particle below its solid's surface", -solid.distance(x),
              "positive [m]; the solid around gas is outside(shape)");
    const int number = add_virtual(points, state, resolution);
    const std::size_t first = size() - points.size();
    for (std::size_t i = first; i < size(); ++i) {
      depth[i] = -solid.distance(r[i]);
      if constexpr (requires { solid.normal(r[i]); }) {
        normal[i] = solid.normal(r[i]);
        continue;
      }
      const double step = 1e-4 * resolution.spacing;
      for (int k = 0; k < Dim; ++k) {
        Vec<Dim> up = r[i], down = r[i];
        up[k] += step;
        down[k] -= step;
        normal[i][k] = (solid.distance(up) - solid.distance(down)) / (2 * step);
      }
      const double slope = std::sqrt(norm2(normal[i]));
      expects(slope > 0.1, "slope of the solid's distance at a virtual particle", slope,
              "about 1: the point is as far from several parts of the surface");
      normal[i] = (1 / slope) * normal[i];
    }
    return number;
  }

  /// Adds an opening and the particles that fill its zone, and returns its number, from 0 on. They
  /// start with the far gas's state and take part as gas does: one that passes the face becomes
  /// gas, and gas that passes it joins the zone. At the far end particles vanish, and where a place
  /// behind one becomes free another one follows. The zone must be as deep as gas sees.
  /// @throws InvalidInput as `add_gas`, for a bad opening, for no points or points outside its
  /// zone,
  ///         or if there are 64 openings already.
  int add_opening(const Opening<Dim>& opening, const std::vector<Vec<Dim>>& points,
                  const Resolution& resolution) {
    opening.check();
    resolution.check();
    constexpr int most = 256 - first_opening;
    const int number = static_cast<int>(openings.size());
    expects(number < most, "openings", number + 1, "at most " + std::to_string(most));
    expects(!points.empty(), "points of an opening", points.size(), "at least one");
    for (const Vec<Dim>& x : points)
      for (int k = 0; k < Dim; ++k)
        expects(opening.holds(x, -1e-6 * resolution.spacing), "place of an opening's point", x[k],
                "inside its zone [m]");
    add(points, opening.far, resolution, opening_set(number));
    openings.push_back(opening);
    openings.back().resolution = resolution;
    return number;
  }

  /// The two sets of virtual particles of a thin body.
  struct Sides {
    int front;  ///< towards the normals
    int back;   ///< against the normals
  };

  /// Adds a thin body, whose two sides gas feels apart: `layers` layers of virtual particles for
  /// each side, the first on the body itself, the others behind it as seen from that side. Gas on
  /// one side sees neither gas nor layers of the other side. Gas begins a whole spacing off the
  /// body, whose layers take the place of a lattice's points on and behind it; as many layers as
  /// the support reaches keep gas from being drawn through. Walls and other thin bodies behind it
  /// and nearer than a support are still seen.
  /// @param points   centres of patches of one resolution's spacing that make up the body
  /// @param normals  unit vectors across the body, one a point
  /// @throws InvalidInput as `add_virtual`, and for normals that do not fit.
  Sides add_sheet(const std::vector<Vec<Dim>>& points, const std::vector<Vec<Dim>>& normals,
                  const State<Dim>& state, const Resolution& resolution, int layers = 4) {
    expects(normals.size() == points.size(), "normals of a sheet", normals.size(),
            "as many as points, " + std::to_string(points.size()));
    expects(layers >= 1 && layers <= 8, "layers of a sheet", layers, "between 1 and 8");
    for (const Vec<Dim>& n : normals)
      expects(std::abs(norm2(n) - 1) < 1e-6, "length of a sheet's normal", std::sqrt(norm2(n)),
              "1");
    const auto side = [&](double sign) {
      std::vector<Vec<Dim>> all;
      for (int layer = 0; layer < layers; ++layer)
        for (std::size_t i = 0; i < points.size(); ++i)
          all.push_back(points[i] - (sign * layer * resolution.spacing) * normals[i]);
      const int number = add_virtual(all, state, resolution);
      const std::size_t first = size() - all.size();
      for (std::size_t i = 0; i < all.size(); ++i) {
        const std::size_t layer = i / points.size();
        normal[first + i] = sign * normals[i % points.size()];
        depth[first + i] = static_cast<double>(layer) * resolution.spacing;
        sheet[first + i] = layer == 0 && sign > 0 ? sheet_patch : sheet_layer;
      }
      return number;
    };
    const int front = side(1);
    return {front, side(-1)};
  }

 private:
  void add(const std::vector<Vec<Dim>>& points, const State<Dim>& state,
           const Resolution& resolution, std::uint8_t number) {
    state.check();
    resolution.check();
    const std::size_t n = size() + points.size();
    r.insert(r.end(), points.begin(), points.end());
    v.resize(n, state.v);
    rho.resize(n, state.rho);
    p.resize(n, state.p);
    h.resize(n, resolution.smoothing_ratio * resolution.spacing);
    m.resize(n, state.rho * math::power<Dim>(resolution.spacing));
    set.resize(n, number);
    normal.resize(n, Vec<Dim>::all(0.0));
    depth.resize(n, 0.0);
    sheet.resize(n, no_sheet);
  }
};

}  // namespace sphmbs::particles
