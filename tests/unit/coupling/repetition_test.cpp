// SPDX-License-Identifier: MIT
// Repetitions x -> F(x) that do not come together by themselves do with each policy that can.
#include <sphmbs/coupling/repetition.hpp>

#include "support/catch.hpp"
#include "support/errors.hpp"

namespace {

namespace coupling = sphmbs::coupling;
using sphmbs::mbs::VectorXd;

/// How many evaluations of x -> b + A x + bend x_0^2 e_0 bring x to rest, beginning at zero; A is
/// diagonal. 100: more than 99.
template <class Policy>
int evaluations(const Policy& policy, const VectorXd& A, double bend,
                coupling::Repetition& so_far) {
  const VectorXd b = VectorXd::LinSpaced(A.size(), 1, 2);
  so_far.begin();
  VectorXd x = VectorXd::Zero(A.size());
  for (int k = 1; k < 100; ++k) {
    VectorXd result = b + A.cwiseProduct(x);
    result[0] += bend * x[0] * x[0];
    if ((result - x).norm() <= 1e-10 * result.norm()) return k;
    x = policy.next(x, result, so_far);
  }
  return 100;
}
template <class Policy>
int evaluations(const Policy& policy, const VectorXd& A) {
  coupling::Repetition so_far;
  return evaluations(policy, A, 0, so_far);
}

VectorXd light() {
  VectorXd A(4);
  A << -3, -1.5, -0.6, 0.2;  // added mass of three times the body's own
  return A;
}

}  // namespace

TEST_CASE("a fixed share takes its time", "[coupling]") {
  CHECK(evaluations(coupling::Relaxation{.share = 1}, light()) == 100);
  const int count = evaluations(coupling::Relaxation{.share = 0.4}, light());
  CHECK(count > 20);
  CHECK(count < 100);
}

TEST_CASE("one direction is found in one repetition more", "[coupling]") {
  const VectorXd A = VectorXd::Constant(4, -3);
  CHECK(evaluations(coupling::Aitken{.most = 1}, A) == 3);
  CHECK(evaluations(coupling::QuasiNewton{}, A) == 3);
}

TEST_CASE("quasi-Newton finds as many directions as there are", "[coupling]") {
  CHECK(evaluations(coupling::QuasiNewton{.independent = 1e-6}, light()) == 6);
  // Of fewer that are known, it needs more.
  CHECK(evaluations(coupling::QuasiNewton{.most = 1}, light()) > 6);
}

TEST_CASE("quasi-Newton knows what earlier steps have shown", "[coupling]") {
  const coupling::QuasiNewton policy{.independent = 1e-6};
  coupling::Repetition so_far;
  CHECK(evaluations(policy, light(), 0, so_far) == 6);
  CHECK(so_far.changes.size() == 4);
  CHECK(evaluations(policy, light(), 0, so_far) == 2);
  CHECK(evaluations(policy, light(), 0.01, so_far) <= 6);
  for (int step = 0; step < 5; ++step) evaluations(policy, light(), 0.01 * step, so_far);
  CHECK(so_far.changes.size() == 10);
}

TEST_CASE("policies of repetition refuse numbers out of range", "[coupling]") {
  using test::mentions;
  const auto check = [](const auto& policy) { return test::refusal([&] { policy.check(); }); };
  CHECK(mentions(check(coupling::Relaxation{.share = 0}), {"share", "0", "above 0"}));
  CHECK(mentions(check(coupling::Aitken{.first = 1.5}), {"first share", "1.5", "at most 1"}));
  CHECK(mentions(check(coupling::Aitken{.most = 0.5}), {"largest share", "0.5", "at least 1"}));
  CHECK(mentions(check(coupling::QuasiNewton{.most = 0}), {"number of changes", "0"}));
  CHECK(mentions(check(coupling::QuasiNewton{.independent = 1}), {"independent", "1", "below 1"}));
}
