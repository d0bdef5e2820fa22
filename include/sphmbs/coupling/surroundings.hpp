// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <sphmbs/core/vec.hpp>
#include <sphmbs/particles/fields.hpp>

namespace sphmbs::coupling {

/// A particle at the surface of a body or a wall, or one of gas.
template <int Dim>
struct Seen {
  Vec<Dim> r;        ///< [m]
  Vec<Dim> normal;   ///< out of the solid; zero where no surface is known
  double depth;      ///< below the surface [m]
  double spacing;    ///< [m]
  int set;           ///< of particles, as in messages
  std::uint32_t id;  ///< of the particle, as in messages
  bool sheet;        ///< of a thin body

  /// Whether there is a solid behind its surface.
  bool solid() const { return norm2(normal) > 0 && !sheet; }
  /// What messages call it.
  std::string name() const { return "#" + std::to_string(id) + " of set " + std::to_string(set); }

  /// How far a point in front of this particle is from the surface, negative behind it; endless for
  /// points that are not in front, and for those on the other side of a thin body [m].
  double gap_to_point(const Vec<Dim>& x) const {
    const Vec<Dim> d = x - r;
    const double along = dot(d, normal);
    const bool beside = norm2(d - along * normal) > 0.5625 * spacing * spacing;
    return beside || along < (sheet ? -0.5 : -2.0) * spacing ? 1e300 : along - depth;
  }

  /// Whether gas at a point is in the body, by more than the disorder of particles explains.
  bool holds(const Vec<Dim>& x) const {
    return solid() ? gap_to_point(x) < -0.25 * spacing : norm2(r - x) < 0.0625 * spacing * spacing;
  }

  /// The gap between two surfaces [m]: along the normal where both are known and face each other,
  /// else from the distance of the particles, each of which stands for half a spacing around it. A
  /// quarter of that may overlap: lattices that meet with an offset are that much farther apart.
  double gap_to(const Seen& o) const {
    if (norm2(normal) > 0 && norm2(o.normal) > 0)
      return dot(normal, o.normal) < 0 ? o.gap_to_point(r + depth * normal) : 1e300;
    return std::sqrt(norm2(r - o.r)) - 0.75 * 0.5 * (spacing + o.spacing);
  }
};

/// What is around the bodies of a system at one time, on the host: particles at their surfaces, and
/// near those other surfaces and gas.
template <int Dim>
class Surroundings {
 public:
  /// A period of the domain along each periodic axis.
  using Cell = std::array<int, static_cast<std::size_t>(Dim)>;

  /// @param with_gas  whether gas is gathered too
  template <class Fluid, class Surface>
  Surroundings(Fluid& fluid, const Surface& surface, bool with_gas) {
    using Policy = typename Fluid::PolicyType;
    const auto fields = fluid.particles().fields();
    const std::size_t n = fluid.size();
    const auto fetch = [n](const auto* data) {
      std::vector<std::remove_cvref_t<decltype(*data)>> host(data == nullptr ? 0 : n);
      if (!host.empty()) Policy::download(host.data(), data, n * sizeof(host[0]));
      return host;
    };
    const auto set = fetch(fields.set), sheet = fetch(fields.sheet);
    const auto id = fetch(fields.id);
    const auto h = fetch(fields.h), m = fetch(fields.m), rho = fetch(fields.rho),
               depth = fetch(fields.depth);
    std::array<decltype(fetch(fields.h)), static_cast<std::size_t>(Dim)> r, v, normal;
    for (std::size_t k = 0; k < r.size(); ++k) {
      r[k] = fetch(fields.r[k]);
      v[k] = fetch(fields.v[k]);
      normal[k] = fetch(fields.normal[k]);
    }
    const auto at = [](const auto& field, std::size_t i) {
      Vec<Dim> x{};
      for (std::size_t k = 0; k < field.size(); ++k)
        if (!field[k].empty()) x[static_cast<int>(k)] = static_cast<double>(field[k][i]);
      return x;
    };
    const auto seen = [&](std::size_t i) {
      return Seen<Dim>{at(r, i),
                       at(normal, i),
                       depth.empty() ? 0 : static_cast<double>(depth[i]),
                       std::pow(static_cast<double>(m[i]) / static_cast<double>(rho[i]), 1.0 / Dim),
                       set[i],
                       id[i],
                       !sheet.empty() && sheet[i] != particles::no_sheet};
    };
    // Layers below the first one are not looked at: those of a sheet reach beyond it.
    const auto at_surface = [](const Seen<Dim>& p) {
      return p.depth < (p.sheet ? 0.5 : 1.05) * p.spacing;
    };

    for (std::size_t i = 0; i < n; ++i)
      if (particles::is_virtual(set[i])) widest_ = std::max(widest_, 4 * static_cast<double>(h[i]));
    for (const auto& [number, place] : surface.places())
      periods_[number] = period_of(fluid.domain(), place);
    for (std::size_t i = 0; i < n; ++i) {
      if (!particles::is_virtual(set[i]) || !surface.wets(set[i])) continue;
      const Seen<Dim> p = seen(i);
      if (at_surface(p)) bodies_[cell_of(p.r)].push_back(p);
    }
    std::map<Cell, bool> near;
    for (const auto& [cell, points] : bodies_)
      for_cells_around(cell, [&](const Cell& other) { near[other] = true; });
    for (std::size_t i = 0; i < n; ++i) {
      const bool gas = set[i] == particles::gas;
      if (gas ? !with_gas : !particles::is_virtual(set[i])) continue;
      if (!gas && !surface.wets(set[i]))
        fastest_other_ = std::max(fastest_other_, std::sqrt(norm2(at(v, i))));
      if (!near.contains(cell_of(at(r, i)))) continue;
      const Seen<Dim> p = seen(i);
      if (gas)
        gas_.push_back(p);
      else if (at_surface(p))
        others_.push_back({p, surface.wets(set[i])});
    }
  }

  /// Calls visit(p, o) for particles p of bodies and those o of other sets near them; of two bodies
  /// once.
  template <class Visit>
  void for_pairs(const Visit& visit) const {
    for (const auto& other : others_) {
      const Seen<Dim>& o = other.first;
      const bool wet = other.second;
      around(o, [&](const Seen<Dim>& p) {
        if (p.set != o.set && (!wet || p.set < o.set)) visit(p, o);
      });
    }
  }
  /// Calls visit(p, g) for particles p of bodies and gas g near them.
  template <class Visit>
  void for_gas(const Visit& visit) const {
    for (const Seen<Dim>& g : gas_) around(g, [&](const Seen<Dim>& p) { visit(p, g); });
  }

  /// Which period the first particle of each body's set is in.
  const std::map<int, Cell>& periods() const { return periods_; }
  /// Speed of virtual particles that ride on nothing [m/s].
  double fastest_other() const { return fastest_other_; }

 private:
  Cell cell_of(const Vec<Dim>& r) const {
    Cell cell;
    for (std::size_t k = 0; k < cell.size(); ++k)
      cell[k] = static_cast<int>(std::floor(r[static_cast<int>(k)] / widest_));
    return cell;
  }

  template <class Visit>
  static void for_cells_around(const Cell& middle, const Visit& visit) {
    const int cells = Dim == 1 ? 3 : Dim == 2 ? 9 : 27;
    for (int code = 0; code < cells; ++code) {
      Cell cell = middle;
      int rest = code;
      for (std::size_t k = 0; k < cell.size(); ++k, rest /= 3) cell[k] += rest % 3 - 1;
      visit(cell);
    }
  }

  template <class Visit>
  void around(const Seen<Dim>& other, const Visit& visit) const {
    for_cells_around(cell_of(other.r), [&](const Cell& cell) {
      const auto there = bodies_.find(cell);
      if (there == bodies_.end()) return;
      for (const Seen<Dim>& p : there->second) visit(p);
    });
  }

  template <class Domain>
  static Cell period_of(const Domain& domain, const Vec<Dim>& r) {
    Cell cell{};
    for (int k = 0; k < Dim; ++k)
      if (domain.periodic[static_cast<std::size_t>(k)])
        cell[static_cast<std::size_t>(k)] = static_cast<int>(
            std::floor((r[k] - domain.box.lower[k]) / (domain.box.upper[k] - domain.box.lower[k])));
    return cell;
  }

  double widest_ = 0;  // of the cells: what a gap is looked for in [m]
  double fastest_other_ = 0;
  std::map<Cell, std::vector<Seen<Dim>>> bodies_;
  std::vector<std::pair<Seen<Dim>, bool>> others_;  // and whether they ride on bodies
  std::vector<Seen<Dim>> gas_;
  std::map<int, Cell> periods_;
};

/// How near gas is to the particles of bodies.
struct NearestGas {
  /// Least distance of centres, in spacings of the body.
  double distance = std::numeric_limits<double>::infinity();
  int inside = 0;  ///< gas particles within bodies
};

/// Looks at all of it, on the host.
template <class Fluid, class Surface>
NearestGas nearest_gas(Fluid& fluid, const Surface& surface) {
  constexpr int Dim = Fluid::dim;
  NearestGas nearest;
  std::set<std::uint32_t> inside;
  Surroundings<Dim>(fluid, surface, true).for_gas([&](const Seen<Dim>& p, const Seen<Dim>& gas) {
    nearest.distance = std::min(nearest.distance, std::sqrt(norm2(p.r - gas.r)) / p.spacing);
    if (p.holds(gas.r)) inside.insert(gas.id);
  });
  nearest.inside = static_cast<int>(inside.size());
  return nearest;
}

}  // namespace sphmbs::coupling
