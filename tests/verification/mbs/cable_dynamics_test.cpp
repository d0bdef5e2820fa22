// SPDX-License-Identifier: MIT
// Pendulum of a spatial cable (Gerstmayr and Shabana 2006, Nonlinear Dynamics 45, section 5.2)
// against independent codes.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <sphmbs/mbs/ancf/cable.hpp>
#include <sphmbs/mbs/ancf/line.hpp>

#include "support/catch.hpp"
#include "support/mechanisms.hpp"

using namespace sphmbs::mbs;
using ancf::Engineering, ancf::Green;

namespace {

template <class Measure>
using Cable = ancf::Cable<3, Measure>;
using Model = Structure<Cable<Green>, Cable<Engineering>, joints::Joint<3>>;
using System = test::SingleThreaded<Model>;

/// Whether slopes begin with the rates that belong to the velocities of the nodes, or at rest.
enum class Slopes { turning, at_rest };

/// Places at a time [m].
struct Row {
  double t, middle_y, tip_x, tip_y, tip_z;
};

struct Course {
  double apart = 0;      // largest difference from the rows in a coordinate
  double drift = 0;      // largest change of the total energy, over that at the start
  double growth = 0;     // largest increase of it, likewise
  double start = 0;      // energy [J]
  double violation = 0;  // largest one
};

/// A cable of 1 m hinged at the origin, along +x, whose points move with v_z = -4 x at first.
template <class Measure>
Course swing(int elements, Slopes slopes, const std::vector<Row>& table,
             double spectral_radius = 0.8, double step = 5e-4) {
  const double E = 1.6e6, A = 2.5e-5, I = A * A / (4 * std::numbers::pi), rho = 320;
  Model model;
  model.gravity = {0, -9.81, 0};
  ancf::LineSpec<Cable<Measure>> spec{.to = {1, 0, 0}, .elements = elements};
  spec.prototype = Cable<Measure>{
      .axial_stiffness = E * A, .bending_stiffness = E * I, .mass_per_length = rho * A};
  spec.rates.value = [](double s) { return Vector<3>(0, 0, -4 * s); };
  const Vector<3> slope_rate(0, 0, slopes == Slopes::turning ? -4 : 0);
  spec.rates.gradient = [=](double) { return slope_rate; };
  const auto line = ancf::line<Cable<Measure>>(model, spec);
  model.add(joints::pinned(line.start(), model.q(), "hinge"));
  System system(model);
  Course course;
  course.start = system.energies().total();
  for (const Row& row : table) {
    test::advance(system, {.spectral_radius = spectral_radius}, row.t, step, [&](System& s) {
      const double change = s.energies().total() / course.start - 1;
      course.drift = std::max(course.drift, std::abs(change));
      course.growth = std::max(course.growth, change);
      course.violation = std::max(course.violation, test::violation(s));
    });
    const VectorXd& q = system.state().q;
    const double middle_y = line.point(0.5).at(q)[1];
    const Vector<3> tip = line.end().at(q);
    for (const double difference :
         {middle_y - row.middle_y, tip[0] - row.tip_x, tip[1] - row.tip_y, tip[2] - row.tip_z})
      if (!std::isnan(difference)) course.apart = std::max(course.apart, std::abs(difference));
  }
  return course;
}

constexpr double none = std::numeric_limits<double>::quiet_NaN();

}  // namespace

// `reference` is by a code with Green's strain, `exudyn` by Exudyn with |r'| - 1.
TEST_CASE("a spatial cable pendulum moves as with independent codes of the same measures",
          "[mbs]") {
  SECTION("slopes with consistent rates") {
    const std::vector<Row> reference{{0.1, -0.048864, 0.917316, -0.049007, -0.387763},
                                     {0.5, -0.373052, -0.691223, -0.710990, -0.093039},
                                     {1, -0.109345, 0.652751, 0.043533, 0.666488},
                                     {2, -0.167644, -0.243452, -0.201184, 0.902041}};
    const Course green = swing<Green>(4, Slopes::turning, reference);
    CHECK(green.apart < 1.5e-6);
    CHECK(green.start == Approx(0.0213333).epsilon(2e-6));
    CHECK(green.drift < 5e-5);
    CHECK(green.growth < 1e-12);
    CHECK(green.violation < 1e-15);

    const std::vector<Row> exudyn{{0.1, -0.048867, 0.917339, -0.049009, -0.387768},
                                  {0.5, -0.373039, -0.691188, -0.710949, -0.093112},
                                  {1, -0.109257, 0.652907, 0.043425, 0.665935},
                                  {2, -0.167787, -0.244088, -0.199978, 0.901621}};
    const Course engineering = swing<Engineering>(4, Slopes::turning, exudyn);
    CHECK(engineering.apart < 3e-5);
    CHECK(engineering.drift < 5e-5);
  }
  SECTION("slopes at rest") {
    const std::vector<Row> reference{{0.5, -0.373268, -0.691478, none, -0.090295},
                                     {1, -0.108778, 0.655918, none, 0.665634},
                                     {2, -0.164634, -0.228016, none, 0.907157}};
    const Course green = swing<Green>(4, Slopes::at_rest, reference);
    CHECK(green.apart < 1.5e-6);
    const std::vector<Row> exudyn{{0.5, -0.373251, -0.691507, none, -0.090443},
                                  {1, -0.108486, 0.655732, none, 0.665047},
                                  {2, -0.164625, -0.227147, none, 0.907939}};
    const Course engineering = swing<Engineering>(4, Slopes::at_rest, exudyn);
    CHECK(engineering.apart < 3e-5);
    // Chrono, by a linearised implicit Euler method.
    const std::vector<Row> chrono_early{{0.02, -0.00195239, 0.998209, none, -0.0816723},
                                        {0.1, -0.0488633, 0.914850, none, -0.393412},
                                        {0.2, -0.185197, 0.655224, none, -0.704319},
                                        {0.5, -0.373086, -0.690261, none, -0.0921098}};
    const std::vector<Row> chrono_late{{1, -0.109519, 0.650688, none, 0.668971},
                                       {1.5, -0.282487, -0.548046, none, -0.650814},
                                       {2, -0.169031, -0.247682, none, 0.903441}};
    const double early = swing<Green>(4, Slopes::at_rest, chrono_early).apart,
                 late = swing<Green>(4, Slopes::at_rest, chrono_late).apart;
    CHECK(early < 4e-3);
    CHECK(late < 4e-2);
  }
}

TEST_CASE("a finely divided spatial cable pendulum moves as with an independent code", "[mbs]") {
  const std::vector<Row> exudyn{{0.5, none, -0.690733, -0.710315, -0.087075},
                                {1, none, 0.653341, 0.045759, 0.659005},
                                {2, none, -0.239658, -0.203003, 0.903446}};
  const Course fine = swing<Engineering>(32, Slopes::turning, exudyn);
  CHECK(fine.apart < 1e-5);
  CHECK(fine.drift < 5e-5);
  const Course few = swing<Engineering>(4, Slopes::turning, exudyn),
               more = swing<Engineering>(8, Slopes::turning, exudyn);
  CHECK(few.apart > 3 * more.apart);
}

TEST_CASE("the energy of a spatial cable pendulum drifts at second order in the step", "[mbs]") {
  const std::vector<Row> end{{1, none, none, none, none}};
  for (const double rho : {1.0, 0.8}) {
    const Course coarse = swing<Green>(4, Slopes::turning, end, rho, 1e-3),
                 fine = swing<Green>(4, Slopes::turning, end, rho, 5e-4);
    CHECK(fine.drift < 5e-5);
    CHECK(std::log2(coarse.drift / fine.drift) == Approx(2).margin(0.15));
  }
}
