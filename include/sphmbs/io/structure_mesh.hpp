// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <sphmbs/io/vtp.hpp>
#include <sphmbs/mbs/part.hpp>
#include <sphmbs/mbs/placed.hpp>
#include <sphmbs/mbs/state.hpp>

namespace sphmbs::io {

/// Part that is drawn as a curve: `drawn` = 1 and material points outline(s) for s in [0, 1].
template <class P>
concept DrawnCurve = mbs::Part<P> && requires(const P part) {
  requires P::drawn == 1;
  { part.outline(0.5) } -> std::convertible_to<typename P::Material>;
};

/// Part that is drawn as a surface: `drawn` = 2 and material points outline(s, t) for s, t in
/// [0, 1].
template <class P>
concept DrawnSurface = mbs::Part<P> && requires(const P part) {
  requires P::drawn == 2;
  { part.outline(0.5, 0.5) } -> std::convertible_to<typename P::Material>;
};

/// Line that says how much it is stretched: axial_strain(q, X) [-].
template <class P>
concept Stretched = DrawnCurve<P> &&
    requires(const P part, const mbs::Vector<P::dofs> q, typename P::Material X) {
  { part.axial_strain(q, X) } -> std::convertible_to<double>;
};

/// Into how many pieces parts are divided so that they are drawn curved.
struct Subdivision {
  int curve = 8;    ///< of an element that is a line
  int surface = 4;  ///< of an element that is a surface, along each side
  // Of the outline of a body, which may have corners at equal shares of it: 1 to 6, 8, 10, 12, 15,
  // ... pieces meet at such places. Points in line are left out.
  int outline = 120;  ///< points on the outline of a body
};

namespace detail {

/// Collects parts in a mesh.
class StructureMesh {
 public:
  StructureMesh(const mbs::State& state, const Subdivision& into) : state_(state), into_(into) {}

  template <DrawnCurve P>
  void add(const mbs::Placed<P>& placed) {
    std::vector<typename P::Material> line;
    const int pieces = mbs::Body<P> ? into_.outline : into_.curve;
    for (int k = 0; k <= pieces; ++k) {
      const typename P::Material X = placed.part.outline(static_cast<double>(k) / pieces);
      if constexpr (mbs::Body<P>) leave_out_middle(line, X);
      line.push_back(X);
    }
    const auto first = static_cast<std::int64_t>(mesh_.size());
    for (const auto& X : line) add_point(placed, X);
    mesh_.lines.add_row(first, static_cast<std::int64_t>(line.size()));
  }

  template <DrawnSurface P>
  void add(const mbs::Placed<P>& placed) {
    const int n = into_.surface;
    const auto first = static_cast<std::int64_t>(mesh_.size());
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i)
        add_point(placed,
                  placed.part.outline(static_cast<double>(i) / n, static_cast<double>(j) / n));
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const std::int64_t corner = first + j * (n + 1) + i;
        mesh_.polygons.add({corner, corner + 1, corner + n + 2, corner + n + 1});
      }
  }

  void next_type() { ++type_; }

  Mesh finish() {
    mesh_.arrays.push_back({"velocity [m/s]", 3, std::move(velocity_)});
    mesh_.arrays.push_back({"type", 1, std::move(types_)});
    mesh_.arrays.push_back({"number", 1, std::move(numbers_)});
    if (any_strain_) mesh_.arrays.push_back({"axial strain [-]", 1, std::move(strain_)});
    return std::move(mesh_);
  }

 private:
  // The last point goes if it lies in line with the one before and X.
  template <class Material>
  static void leave_out_middle(std::vector<Material>& line, const Material& X) {
    if (line.size() < 2) return;
    const Material a = line[line.size() - 2], ab = line.back() - a, aX = X - a;
    const double in_line = aX.squaredNorm() > 0 ? ab.dot(aX) / aX.squaredNorm() : 0;
    if ((ab - in_line * aX).squaredNorm() < 1e-16 * aX.squaredNorm() && in_line > 0 && in_line < 1)
      line.pop_back();
  }

  template <mbs::Part P>
  void add_point(const mbs::Placed<P>& placed, const typename P::Material& X) {
    const mbs::Matrix<P::dim, P::dofs> N = placed.part.shape(X);
    const mbs::Vector<P::dofs> q = placed.local(state_.q);
    const mbs::Vector<P::dim> r = N * q, v = N * placed.local(state_.v);
    for (int k = 0; k < 3; ++k) {
      mesh_.points.push_back(k < P::dim ? r[k] : 0.0);
      velocity_.push_back(static_cast<float>(k < P::dim ? v[k] : 0.0));
    }
    types_.push_back(type_);
    numbers_.push_back(placed.number);
    double strain = std::numeric_limits<double>::quiet_NaN();
    if constexpr (Stretched<P>) {
      strain = placed.part.axial_strain(q, X);
      any_strain_ = true;
    }
    strain_.push_back(static_cast<float>(strain));
  }

  const mbs::State& state_;
  Subdivision into_;
  Mesh mesh_;
  std::vector<float> velocity_, strain_;
  std::vector<std::int32_t> types_, numbers_;
  std::int32_t type_ = 0;
  bool any_strain_ = false;
};

}  // namespace detail

/// The parts of a structure as curves and surfaces at a state, with the velocity, the place of the
/// part's type among the types of the structure, its number among these, and, where a line gives
/// it, the axial strain (NaN at the others). Parts that are not drawn are left out.
template <class Structure>
Mesh structure_mesh(const Structure& structure, const mbs::State& state,
                    const Subdivision& into = {}) {
  detail::StructureMesh mesh(state, into);
  structure.for_each_type([&]<class T>(const auto& components) {
    if constexpr (DrawnCurve<T> || DrawnSurface<T>)
      for (const auto& placed : components) mesh.add(placed);
    mesh.next_type();
  });
  return mesh.finish();
}

}  // namespace sphmbs::io
