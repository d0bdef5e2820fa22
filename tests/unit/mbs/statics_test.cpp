// SPDX-License-Identifier: MIT
#include <cmath>
#include <numbers>

#include <sphmbs/mbs/ancf/cable.hpp>
#include <sphmbs/mbs/ancf/line.hpp>
#include <sphmbs/mbs/forces/point_force.hpp>
#include <sphmbs/mbs/joints/clamped.hpp>

#include "support/catch.hpp"
#include "support/errors.hpp"
#include "support/mechanisms.hpp"
#include "support/rods.hpp"

using namespace sphmbs::mbs;
using ancf::Cable;
using test::mentions;

namespace {

constexpr double pi = std::numbers::pi;

using Model = Structure<Cable<2>, ncf::Bar, joints::Joint<2>, forces::PointForce<2>>;

/// Horizontal cantilever of unit length and bending stiffness, made of four cables.
struct Cantilever {
  Model model;
  ancf::Line<Cable<2>> line;

  explicit Cantilever(double axial_stiffness = 1e3)
      : line(ancf::line(model, {.to = {1, 0},
                                .elements = 4,
                                .prototype = Cable<2>{.axial_stiffness = axial_stiffness,
                                                      .bending_stiffness = 1,
                                                      .mass_per_length = 1}})) {
    model.add(joints::clamped(line.start(), {line.gradient(0)}, model.q()));
  }
  void pull(const Vector<2>& force) { model.add(forces::PointForce<2>{line.end(), force}); }
  Vector<2> tip(const Equilibrium& found) const { return line.end().at(found.state.q); }
};

/// Cable of unit length and weight, pinned at two points of the same height, that starts as an arc.
struct Chain {
  Model model;
  ancf::Line<Cable<2>> line;

  Chain(double span, int elements) : line(made(model, span, elements)) {
    model.gravity = {0, -1};
    model.add(joints::pinned(line.start(), model.q()));
    model.add(joints::pinned(line.end(), model.q()));
  }

 private:
  static ancf::Line<Cable<2>> made(Model& model, double span, int elements) {
    const double half = test::root(1e-6, pi, [&](double x) { return std::sin(x) / x - span; });
    const double radius = 0.5 / half;
    const auto angle = [=](double s) { return s / radius - half; };
    const Cable<2> thin{.axial_stiffness = 1e5, .bending_stiffness = 1e-7, .mass_per_length = 1};
    return ancf::line(model, {.elements = elements,
                              .prototype = thin,
                              .length = 1,
                              .curve = {.value = [=](double s) -> Vector<2> {
                                          return radius *
                                                 Vector<2>(std::sin(half) + std::sin(angle(s)),
                                                           std::cos(half) - std::cos(angle(s)));
                                        },
                                        .gradient = [=](double s) -> Vector<2> {
                                          return {std::cos(angle(s)), std::sin(angle(s))};
                                        }}});
  }
};

/// On one thread, as is fastest for small structures.
Equilibrium balance(Model& model, const StaticsOptions& options = {}) {
  return equilibrium<solvers::SparseLU, sphmbs::execution::Serial>(model, options);
}

template <class Action>
std::string failure(Action&& action) {
  return test::complaint<sphmbs::NumericalFailure>(std::forward<Action>(action));
}

}  // namespace

TEST_CASE("an equilibrium is at rest, and its multipliers are the reactions", "[mbs]") {
  Cantilever rod;
  rod.pull({0, -2});
  const Equilibrium found = balance(rod.model);
  CHECK(found.state.v.isZero(0));
  CHECK(found.state.vdot.isZero(0));
  CHECK(found.load_steps == 1);
  CHECK(found.halvings == 0);
  CHECK(found.relaxations == 0);
  const Vector<2> held = -found.state.lambda.head<2>();
  CHECK((held - Vector<2>(0, 2)).norm() < 1e-9);
}

TEST_CASE("loads are raised in steps that grow, to the same equilibrium", "[mbs]") {
  Cantilever rod;
  rod.pull({0, -2});
  const Equilibrium at_once = balance(rod.model),
                    in_steps = balance(rod.model, {.first_step = 0.2});
  CHECK(in_steps.load_steps == 3);  // 20, 60 and 100 %
  CHECK((rod.tip(at_once) - rod.tip(in_steps)).norm() < 1e-9);
}

TEST_CASE("a load step that fails is shortened", "[mbs]") {
  Cantilever rod;
  rod.pull({0, -5});
  const Equilibrium at_once = balance(rod.model);
  const Equilibrium halved = balance(
      rod.model,
      {.relaxations = 0, .newton = {.max_iterations = 6, .refactor = Refactor::every_iteration}});
  CHECK(halved.halvings > 0);
  CHECK(halved.load_steps > 1);
  CHECK((rod.tip(at_once) - rod.tip(halved)).norm() < 1e-9);
}

TEST_CASE("loads and drives are those of the time given", "[mbs]") {
  Cantilever rod;
  rod.model.add(forces::PointForce<2>{.at = rod.line.end(),
                                      .history = [](double t) { return Vector<2>(0, -t); }});
  const double small = 1e-3;
  const Equilibrium found = balance(rod.model, {.t = small});
  CHECK(found.state.t == small);
  CHECK(rod.tip(found)[1] == Approx(-small / 3).epsilon(1e-4));
}

TEST_CASE("gravity is a load", "[mbs]") {
  Cantilever rod;
  const double small = 1e-3;
  rod.model.gravity = {0, -small};
  CHECK(rod.tip(balance(rod.model))[1] == Approx(-small / 8).epsilon(1e-4));
}

TEST_CASE("a slack chain finds the catenary", "[mbs]") {
  for (const double span : {0.95, 0.7, 0.4}) {
    Chain chain(span, 32);
    const double a =
        test::root(1e-2, 1e2, [&](double x) { return 2 * x * std::sinh(span / (2 * x)) - 1; });
    const double sag = a * (std::cosh(span / (2 * a)) - 1);
    const Equilibrium found = balance(chain.model);
    const Vector<2> middle = chain.line.point(0.5).at(found.state.q);
    CAPTURE(span, found.load_steps, found.iterations, found.relaxations);
    CHECK(std::abs(middle[0] - span / 2) < 1e-6);
    CHECK(std::abs(-middle[1] - sag) < 1e-3 * sag);
    CHECK(std::abs(std::abs(found.state.lambda[1]) - 0.5) < 1e-8);
    CHECK(found.relaxations > 0);
    CHECK(found.iterations < 600);
  }
}

TEST_CASE("a pendulum that starts level hangs down", "[mbs]") {
  Model model;
  model.gravity = {0, -9.81};
  const auto bar = model.add(test::thin_bar({0, 0}, {1, 0}));
  model.add(joints::pinned(bar.start(), model.q()));
  const Equilibrium found = balance(model);
  CHECK((bar.end().at(found.state.q) - Vector<2>(0, -1)).norm() < 1e-8);
  CHECK(found.relaxations > 0);
}

TEST_CASE("a part that nothing holds is named", "[mbs]") {
  Cantilever rod;
  rod.model.add(test::thin_bar({0, 2}, {1, 2}));
  const auto text = [&] { return failure([&] { balance(rod.model); }); };
  SECTION("that falls") {
    rod.model.gravity = {0, -9.81};
    CHECK(mentions(text(), {"Statics: nothing holds bar 0 (nodes 5, 6) against the loads"}));
  }
  SECTION("that carries no load") {
    rod.pull({0, 1});
    CHECK(mentions(text(), {"stiffness is singular", "can bar 0 (nodes 5, 6) move freely?"}));
  }
}

TEST_CASE("a mechanism that no load holds in place is refused", "[mbs]") {
  Model model;
  const auto bar = model.add(test::thin_bar({0, 0}, {1, 0}));
  model.add(joints::pinned(bar.start(), model.q()));
  CHECK(mentions(failure([&] { balance(model); }), {"can bar 0 (nodes 0, 1) move freely?"}));
}

TEST_CASE("a search without success ends with its iterations", "[mbs]") {
  Cantilever rod;
  rod.pull({0, -5});
  const std::string text = failure([&] {
    balance(rod.model,
            {.smallest_step = 0.1,
             .relaxations = 0,
             .newton = {
                 .tolerance = 1e-13, .max_iterations = 1, .refactor = Refactor::every_iteration}});
  });
  CAPTURE(text);
  CHECK(mentions(text, {"does not converge at 16 % of the loads", "largest residual", "cable",
                        "first_step", "iteration"}));
}

TEST_CASE("bad options of statics are refused", "[mbs]") {
  Cantilever rod;
  const auto refused = [&](const StaticsOptions& options) {
    return test::refusal([&] { balance(rod.model, options); });
  };
  CHECK(mentions(refused({.first_step = 0}), {"first_step = 0", "above 0 and at most 1"}));
  CHECK(mentions(refused({.first_step = 1.5}), {"first_step = 1.5"}));
  CHECK(mentions(refused({.first_step = 0.1, .smallest_step = 0.2}),
                 {"smallest_step = 0.2", "at most first_step"}));
  CHECK(mentions(refused({.smallest_step = std::nan("")}), {"smallest_step = nan"}));
  CHECK(mentions(refused({.relaxations = -1}), {"relaxations = -1"}));
  CHECK(mentions(refused({.t = INFINITY}), {"t = inf"}));
  CHECK(mentions(refused({.newton = {.tolerance = 0}}), {"newton.tolerance = 0"}));
  CHECK(mentions(refused({.newton = {.max_iterations = 0}}), {"newton.max_iterations = 0"}));
}

TEST_CASE("statics refuses a structure whose joints do not meet", "[mbs]") {
  Cantilever rod;
  rod.model.add(joints::coincident(rod.line.end(), ground<2>({1, 0.5}), "far"));
  CHECK(mentions(test::refusal([&] { balance(rod.model); }),
                 {"Initial positions violate coincident 'far'"}));
}
