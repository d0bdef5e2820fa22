// SPDX-License-Identifier: MIT
#include <complex>
#include <limits>

#include <Eigen/Geometry>

#include <sphmbs/mbs/ancf/beam.hpp>
#include <sphmbs/mbs/ancf/cable.hpp>
#include <sphmbs/mbs/ancf/plate.hpp>
#include <sphmbs/mbs/forces/distributed_load.hpp>

#include "support/catch.hpp"
#include "support/errors.hpp"
#include "support/force_laws.hpp"

namespace {

using namespace sphmbs::mbs;

constexpr double exact = 1e-12;  // relative

static_assert(Load<forces::DistributedLoad<ancf::Cable<2>>>);
static_assert(Load<forces::DistributedLoad<ancf::Cable<3>>>);
static_assert(Load<forces::DistributedLoad<ancf::Beam>>);
static_assert(Load<forces::DistributedLoad<ancf::Plate36>>);
static_assert(Load<forces::FollowerPressure<ancf::Plate36>>);
static_assert(Load<forces::FollowerPressure<ancf::Plate48>>);

/// An element whose nodes come in the opposite order, three coordinates after the first.
template <class E>
Placed<E> placed(const E& element) {
  Placed<E> result{element, {}, 0};
  for (int i = 0; i < E::nodes; ++i)
    result.nodes[static_cast<std::size_t>(i)] = {3 + (E::nodes - 1 - i) * E::node_dofs,
                                                 E::node_dofs};
  return result;
}

template <int n>
Vector<n> some_state(std::uint64_t seed) {
  test::Random random(seed);
  Vector<n> q;
  for (int k = 0; k < n; ++k) q[k] = random.between(-1, 1);
  return q;
}

/// A dead load does the work of its sum on a translation, and has a potential.
template <class E>
void check_dead_load(const E& element, double size) {
  constexpr int n = E::dofs + 3;
  Vector<E::dim> f;
  for (int k = 0; k < E::dim; ++k) f[k] = 1 + k;
  forces::DistributedLoad<E> load{.on = placed(element), .value = f};
  load.check();
  const Vector<n> q = some_state<n>(1);
  const auto now = test::assembled<n>(load, q, q);
  CHECK(now.Q.template head<3>().isZero(0.0));
  const Vector<E::dofs> own = now.Q(load.index());
  CHECK((E::translation().transpose() * own - size * f).norm() < exact * size * f.norm());
  CHECK(now.potential == Approx(-now.Q.dot(q)));
  CHECK(now.K.isZero(0.0));

  load.history = [f](double t) { return Vector<E::dim>(t * f); };
  const auto later = test::assembled<n>(load, q, q, 3);
  CHECK((later.Q - 3 * now.Q).norm() < exact * later.Q.norm());
  CHECK(later.potential == 0);
  load.value[0] = std::numeric_limits<double>::quiet_NaN();
  CHECK_THAT(test::refusal([&] { load.check(); }),
             Catch::Contains("value = ") && Catch::Contains("must be finite [N/m] or [N/m^2]"));
}

template <class E>
void check_pressure(const E& plate) {
  constexpr int n = E::dofs + 3;
  const double p = 20;
  const forces::FollowerPressure<E> load{.on = placed(plate), .value = p};
  load.check();
  const Vector<n> q = some_state<n>(2);
  const auto now = test::assembled<n>(load, q, q);

  // Its derivative, by a complex step.
  using Complex = std::complex<double>;
  Vector<n, Complex> z = q;
  Matrix<n, n> K = Matrix<n, n>::Zero();
  const Index index = load.index();
  for (const int j : index) {
    z[j] += Complex(0, 1e-30);
    const Vector<E::dofs, Complex> own = z(index);
    const Vector<E::dofs, Complex> F = plate.template pressure_force<Complex>(own);
    K(index, j) = p / 1e-30 * F.imag();
    z[j] = q[j];
  }
  CHECK((now.K - K).norm() < exact * K.norm());

  // It turns with the plate.
  const Matrix<3, 3> R = test::some_turn<3>();
  Vector<n> turned_q = q, turned_Q = now.Q;
  for (int k = 3; k < n; k += 3) {
    turned_q.template segment<3>(k) = R * q.template segment<3>(k);
    turned_Q.template segment<3>(k) = R * now.Q.template segment<3>(k);
  }
  const auto turned = test::assembled<n>(load, turned_q, q);
  CHECK((turned.Q - turned_Q).norm() < exact * turned_Q.norm());
}

}  // namespace

TEST_CASE("a distributed load on an element adds up to load times size", "[mbs]") {
  check_dead_load(ancf::Cable<2>{.length = 0.6}, 0.6);
  check_dead_load(ancf::Cable<3>{.length = 0.6}, 0.6);
  check_dead_load(ancf::Plate36{.length = 0.6, .width = 0.5}, 0.3);
}

TEST_CASE("pressure follows a plate, with the exact tangent", "[mbs]") {
  check_pressure(ancf::Plate36{.length = 0.6, .width = 0.5});
  check_pressure(ancf::Plate48{.length = 0.6, .width = 0.5});
  const forces::FollowerPressure<ancf::Plate36> wrong{
      .on = placed(ancf::Plate36{}), .value = std::numeric_limits<double>::infinity()};
  CHECK(test::refusal([&] { wrong.check(); }) == "value = inf: must be finite [Pa]");
}
