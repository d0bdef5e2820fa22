// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <Eigen/Core>

/// Multibody systems: rigid bodies in natural coordinates (NCF), flexible elements in absolute
/// nodal coordinates (ANCF), joints and forces. One sentence holds them together: a material point
/// of any part is r = N(X) q, with N free of q, so that the mass matrix is constant.
namespace sphmbs::mbs {

template <int Rows, class S = double>
using Vector = Eigen::Matrix<S, Rows, 1>;  ///< a column

template <int Rows, int Columns, class S = double>
using Matrix = Eigen::Matrix<S, Rows, Columns>;  ///< a small matrix

using Eigen::Dynamic;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Places of coordinates in the coordinates q of a structure.
using Index = std::vector<int>;

/// What joints and forces read and write: pieces of memory that somebody else owns.
using VectorIn = const Eigen::Ref<const VectorXd>&;
using VectorOut = Eigen::Ref<VectorXd>;  ///< result, written in place
using MatrixOut = Eigen::Ref<MatrixXd>;  ///< result, written in place

}  // namespace sphmbs::mbs
