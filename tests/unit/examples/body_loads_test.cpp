// SPDX-License-Identifier: MIT
#include "support/body_loads.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include <sphmbs/mbs/ancf/cable.hpp>
#include <sphmbs/mbs/ancf/line.hpp>
#include <sphmbs/mbs/forces/spring_damper.hpp>
#include <sphmbs/mbs/joints/sliding.hpp>

#include "support/ball_in_gas.hpp"
#include "support/catch.hpp"
#include "support/coupled_session.hpp"
#include "support/mechanisms.hpp"
#include "support/rates.hpp"

namespace {

namespace examples = sphmbs::examples;
namespace mbs = sphmbs::mbs;
namespace joints = mbs::joints;
namespace fs = std::filesystem;
using mbs::Vector;

struct Directory {
  fs::path path =
      fs::temp_directory_path() / ("sphmbs_loads_" + std::to_string(std::random_device{}()));
  Directory() { fs::create_directories(path); }
  ~Directory() { fs::remove_all(path); }
  Directory(const Directory&) = delete;
  Directory& operator=(const Directory&) = delete;
};

using Floor = mbs::forces::Contact<mbs::forces::Plane<2>>;
using Mechanism =
    mbs::Structure<mbs::ncf::Bar, joints::Joint<2>, Floor, mbs::forces::SpringDamper<2>>;

/// A double pendulum whose lower bar stands on a soft floor and hangs on a spring.
struct Pendulum {
  Mechanism mechanism = test::double_pendulum<Mechanism>();
  mbs::Placed<mbs::ncf::Bar> upper = mechanism.all<mbs::ncf::Bar>()[0];
  mbs::Placed<mbs::ncf::Bar> lower = mechanism.all<mbs::ncf::Bar>()[1];

  Pendulum() {
    mechanism.add(Floor{.point = lower.end(),
                        .frame = mbs::forces::ground_frame<2>({0, -0.995}, {0, 1}),
                        .law = {.stiffness = 1e3},
                        .friction = 0.3});
    mechanism.add(mbs::forces::SpringDamper<2>{.from = lower.end(),
                                               .to = mbs::ground<2>({2, -1}),
                                               .stiffness = 20,
                                               .natural_length = 0.5});
  }
};

const Vector<2> weight{0, -9.81};  // of a bar of 1 kg [N]

std::string second_line(const fs::path& path) {
  std::ifstream stream(path);
  std::string line;
  std::getline(stream, line);
  std::getline(stream, line);
  return line;
}

}  // namespace

TEST_CASE("the forces on a body add up to what moves it", "[loads]") {
  Pendulum pendulum;
  test::SingleThreaded<Mechanism> system(pendulum.mechanism);
  examples::BodyScale upper(system, std::vector{pendulum.upper});
  examples::BodyScale lower(system, std::vector{pendulum.lower});
  CHECK(upper.joints() == std::vector<std::string>{"pinned_root", "revolute_knee"});
  CHECK(lower.joints() == std::vector<std::string>{"revolute_knee"});
  double contact = 0;
  test::advance(system, {.newton = test::exactly}, 0.02, 1e-3, [&](auto&) {
    const auto up = upper.now(), low = lower.now();
    CHECK((up.total - up.constraints - weight).norm() < 1e-5);
    CHECK((low.total - low.constraints - low.contacts - low.others - weight).norm() < 1e-5);
    CHECK((up.joints[0] + up.joints[1] - up.constraints).norm() < 1e-12);
    CHECK((up.joints[1] + low.joints[0]).norm() < 1e-5);
    CHECK(up.contacts.norm() + up.others.norm() == 0);
    CHECK(low.others[0] > 9);
    // What Joint's own reaction says.
    const auto own =
        joints::reaction(pendulum.mechanism.all<joints::Joint<2>>()[0], system.state().q,
                         system.time(), system.multipliers<joints::Joint<2>>(0));
    CHECK((own.force - up.joints[0]).norm() < 1e-5);
    contact = std::max(contact, low.contacts[1]);
  });
  CHECK(contact > 0.3);
}

TEST_CASE("a cable that something slides along carries it", "[loads]") {
  using Cable = mbs::ancf::Cable<2>;
  using Sliding = joints::Sliding<Cable>;
  mbs::Structure<Cable, mbs::ncf::Bar, joints::Joint<2>, Sliding> structure;
  structure.gravity = {0, -9.81};
  const auto line = mbs::ancf::line(structure, {.from = {0, 0},
                                                .to = {1, 0},
                                                .elements = 4,
                                                .radius = 0.005,
                                                .density = 1000,
                                                .youngs_modulus = 1e8});
  const auto bar = structure.add(test::thin_bar({0.3, 0}, {0.3, -0.4}));
  structure.add(joints::pinned(line.start(), structure.q(), "left end"));
  structure.add(joints::pinned(line.end(), structure.q(), "left end"));
  structure.add(joints::sliding(structure, line.elements,
                                {.slider = bar.start(), .at = 0.3, .name = "ring"}));
  test::SingleThreaded<decltype(structure), mbs::solvers::SparseLU> system(structure);
  examples::BodyScale cable(system, line.elements);
  examples::BodyScale hung(system, std::vector{bar});
  CHECK(cable.joints() ==
        std::vector<std::string>{"pinned_left_end", "pinned_left_end_1", "sliding_joint_ring"});
  const double mass = 1000 * 0.005 * 0.005 * sphmbs::math::pi;
  test::advance(system, {.newton = test::exactly}, 0.02, 1e-3, [&](auto&) {
    const auto rope = cable.now(), load = hung.now();
    CHECK((rope.total - rope.constraints - mass * weight).norm() < 1e-5);
    CHECK((load.total - load.constraints - weight).norm() < 1e-5);
    CHECK((rope.joints[2] + load.joints[0]).norm() < 1e-5);
  });
}

TEST_CASE("all loads of a body have columns of their own", "[loads]") {
  const Directory directory;
  Pendulum pendulum;
  test::SingleThreaded<Mechanism> system(pendulum.mechanism);
  const examples::Settings settings{.until = 2e-3,
                                    .step = 1e-3,
                                    .threads = 1,
                                    .output = directory.path / "out",
                                    .overwrite = true,
                                    .quiet = true};
  examples::Session session(settings, "case", "a case", system);
  examples::record_body_loads(session, "low", std::vector{pendulum.lower});
  session.run(mbs::GeneralizedAlpha{}, 2, 1);
  const std::string head = second_line(settings.output / "history.csv");
  CHECK_THAT(head,
             Catch::Contains(
                 ",joint_force_revolute_knee_on_low_x[N],joint_force_revolute_knee_on_low_y[N],"
                 "constraint_force_low_x[N],constraint_force_low_y[N],"
                 "contact_force_low_x[N],contact_force_low_y[N],"
                 "other_force_low_x[N],other_force_low_y[N],"
                 "total_force_low_x[N],total_force_low_y[N]"));
  const auto& history = session.history();
  const double sum = history.of("constraint_force_low_y").back() +
                     history.of("contact_force_low_y").back() +
                     history.of("other_force_low_y").back() - 9.81;
  CHECK(history.of("total_force_low_y").back() == Approx(sum).margin(1e-5));
}

TEST_CASE("of a body in gas the gas's force and moment come first", "[loads]") {
  const Directory directory;
  test::BallInGas<test::Gas<2>> ball({.disorder = 3});
  const examples::Settings settings{.spacing = 0.1,
                                    .until = 2e-3,
                                    .step = 1e-3,
                                    .threads = 1,
                                    .backend = "serial",
                                    .output = directory.path / "out",
                                    .overwrite = true,
                                    .quiet = true};
  examples::Session session(settings, "case", "a case", ball.system);
  examples::record_body_loads(session, "ball", std::vector{ball.body}, {ball.set},
                              ball.body.point({0, 0}));
  session.run(sphmbs::coupling::Staggered{}, 2, 1);
  const std::string head = second_line(settings.output / "history.csv");
  CHECK_THAT(head, Catch::Contains(",gas_force_ball_x[N],gas_force_ball_y[N],gas_moment_ball[N m],"
                                   "constraint_force_ball_x[N],constraint_force_ball_y[N],"
                                   "total_force_ball_x[N],total_force_ball_y[N]"));
  // The disk is free: the gas alone moves it. At the start its acceleration is that of this force.
  const auto& history = session.history();
  CHECK(std::abs(history.of("gas_force_ball_x").front()) > 1e-3);
  CHECK(history.of("total_force_ball_x").front() ==
        Approx(history.of("gas_force_ball_x").front()).epsilon(1e-6));
  CHECK(history.of("constraint_force_ball_x").front() == 0);
}
