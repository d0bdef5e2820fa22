// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/mbs/sparse_pattern.hpp>
#include <sphmbs/mbs/structure.hpp>

namespace sphmbs::mbs {

/// Constant mass matrix of a structure, and its unit translations: M T g is the force of gravity.
template <int Dim>
struct Mass {
  SparseMatrix M;                    ///< mass matrix of the structure
  Matrix<Dynamic, Dim> translation;  ///< T: column k moves every point by one along axis k
  Matrix<Dynamic, Dim> weight;       ///< M T
};

/// Sums the mass matrices of all parts; entries that are zero are not stored.
template <class Structure>
Mass<Structure::dim> assemble_mass(const Structure& structure) {
  const int n = structure.coordinates();
  Mass<Structure::dim> mass;
  mass.translation = Matrix<Dynamic, Structure::dim>::Zero(n, Structure::dim);
  std::vector<Eigen::Triplet<double>> entries;
  structure.for_each_type([&]<class P>(const auto& parts) {
    if constexpr (Part<P>)
      for (const Placed<P>& placed : parts) {
        const Matrix<P::dofs, P::dofs> M = placed.part.mass_matrix();
        const Matrix<P::dofs, P::dim> T = P::translation();
        const Index own = placed.index();
        for (int j = 0; j < P::dofs; ++j) {
          const int column = own[static_cast<std::size_t>(j)];
          for (int k = 0; k < P::dim; ++k) mass.translation(column, k) = T(j, k);
          for (int i = 0; i < P::dofs; ++i)
            if (M(i, j) != 0)
              entries.emplace_back(own[static_cast<std::size_t>(i)], column, M(i, j));
        }
      }
  });
  mass.M.resize(n, n);
  mass.M.setFromTriplets(entries.begin(), entries.end());
  mass.weight = mass.M * mass.translation;
  return mass;
}

}  // namespace sphmbs::mbs
