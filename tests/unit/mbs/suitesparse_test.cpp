// SPDX-License-Identifier: MIT
// SuiteSparse's solvers, where they are installed, fail as the library's own do.
#include <cmath>
#include <string>

#include <sphmbs/mbs/joints/pinned.hpp>
#include <sphmbs/mbs/solvers/suitesparse.hpp>

#include "support/catch.hpp"
#include "support/errors.hpp"
#include "support/mechanisms.hpp"

using namespace sphmbs::mbs;
using Catch::Matchers::Contains;
using sphmbs::NumericalFailure;

namespace {

/// What two bars of 1 m say that a winch pulls apart until they are in line, where the matrix is
/// singular.
template <class Solver>
std::string beyond_reach() {
  test::PlanarMechanism mechanism;
  const double x = 0.7, y = -std::sqrt(1 - x * x);
  const auto first = mechanism.add(test::thin_bar({0, 0}, {x, y})),
             second = mechanism.add(test::thin_bar({x, y}, {2 * x, 0}));
  mechanism.add(joints::pinned(first.start(), mechanism.q(), "root"));
  mechanism.add(joints::revolute(first.end(), second.start(), "knee"));
  const joints::TimeFunction pull = joints::SmoothStep{.from = 2 * x, .to = 2.5, .end = 1};
  mechanism.add(joints::driven(second.end(), joints::Path<2>(pull, 0.0), "winch"));
  Dynamics<test::PlanarMechanism, Solver, sphmbs::execution::Serial> system(mechanism);
  const std::string text = test::complaint<NumericalFailure>(
      [&] { test::advance(system, GeneralizedAlpha{}, 1, 1e-2); });
  CHECK(second.end().at(system.state().q)[0] < 2);
  CHECK(second.end().at(system.state().q)[0] > 2 - 1e-2);
  return text.substr(0, text.find(" at t = "));
}

}  // namespace

TEMPLATE_TEST_CASE("SuiteSparse reports a singular matrix", "[mbs][fault]", solvers::KLU,
                   solvers::UMFPACK) {
  CHECK_FALSE(test::factorises_singular_matrix<TestType>());
}

TEMPLATE_TEST_CASE("SuiteSparse moves mechanisms and stops them as SparseLU does", "[mbs][fault]",
                   solvers::KLU, solvers::UMFPACK) {
  test::PlanarMechanism one = test::double_pendulum(), other = test::double_pendulum();
  Dynamics<test::PlanarMechanism, TestType> system(one);
  Dynamics<test::PlanarMechanism, solvers::SparseLU> own(other);
  test::advance(system, GeneralizedAlpha{.newton = test::exactly}, 0.2, 1e-3);
  test::advance(own, GeneralizedAlpha{.newton = test::exactly}, 0.2, 1e-3);
  CHECK((system.state().q - own.state().q).cwiseAbs().maxCoeff() < 1e-10);
  const std::string said = beyond_reach<solvers::SparseLU>();
  CHECK_THAT(said, Contains("Newton's method does not converge"));
  CHECK(beyond_reach<TestType>() == said);
}
