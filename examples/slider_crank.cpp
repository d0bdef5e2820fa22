// SPDX-License-Identifier: MIT
// Planar slider-crank without gravity, driven by a constant torque on its crank, against the exact
// motion of its one degree of freedom.
#include <sphmbs/mbs.hpp>
#include <sphmbs/mbs/forces/torque.hpp>
#include <sphmbs/mbs/joints/pinned.hpp>
#include <sphmbs/mbs/joints/prismatic.hpp>
#include <sphmbs/mbs/joints/revolute.hpp>
#include <sphmbs/mbs/ncf/bar.hpp>
#include <sphmbs/mbs/ncf/planar_body.hpp>

#include "reference/slider_crank_curves.hpp"
#include "support/backends.hpp"
#include "support/body_loads.hpp"
#include "support/guarded_main.hpp"
#include "support/structure_session.hpp"

using namespace sphmbs;
using namespace sphmbs::mbs;
using Mechanism = Structure<ncf::Bar, ncf::PlanarBody, joints::Joint<2>, forces::Torque<2>>;

struct Case {
  examples::SliderCrankMotion exact = {};  // data of the mechanism, and its solution
  double polar = 1e-4;  // moment of inertia of the slider, which does not turn [kg m^2]
  int halvings = 0;

  void add(examples::Parameters& parameters) {
    const auto add = [&](const char* key, double& value, const char* unit, const char* meaning) {
      parameters.add_number(key, value, {.above = 0.0}, unit, meaning);
    };
    add("crank.length", exact.crank, "m", "of the crank");
    add("crank.mass", exact.crank_mass, "kg", "of the crank");
    add("crank.torque", exact.torque, "N m", "on the crank, constant");
    add("rod.length", exact.rod, "m", "of the rod");
    add("rod.mass", exact.rod_mass, "kg", "of the rod");
    add("slider.mass", exact.slider_mass, "kg", "of the slider");
    add("slider.polar", polar, "kg m^2", "moment of inertia of the slider, which does not turn");
    parameters.add_whole_number("run.halvings", halvings, {.at_least = 0, .at_most = 6}, "",
                                "runs again with so many halved steps, and shows the order",
                                "--halvings");
  }
};

/// Crank OA, rod AB and slider at B, at rest in line.
struct SliderCrank {
  examples::SliderCrankMotion exact;
  Mechanism mechanism = {};
  Placed<ncf::Bar> crank, rod;
  Placed<ncf::PlanarBody> slider;
  int pin_O;

  explicit SliderCrank(const Case& data)
      : exact(data.exact),
        crank(mechanism.add(bar({0, 0}, {exact.crank, 0}, exact.crank_mass))),
        rod(mechanism.add(bar({exact.crank, 0}, {exact.crank + exact.rod, 0}, exact.rod_mass))),
        slider(mechanism.add(
            ncf::PlanarBody{.inertia = {.mass = exact.slider_mass, .polar = data.polar},
                            .position = {exact.crank + exact.rod, 0}})) {
    const VectorXd q = mechanism.q();
    pin_O = mechanism.add(joints::pinned(crank.start(), q, "O"));
    mechanism.add(joints::revolute(crank.end(), rod.start(), "A"));
    mechanism.add(joints::revolute(rod.end(), slider.point({0, 0}), "B"));
    mechanism.add(joints::prismatic(joints::ground_frame<2>({0, 0}), joints::frame(slider),
                                    ground<2>({1, 0}), q, "guide"));
    mechanism.add(forces::Torque<2>{.on = crank.vector(crank.part.start(), crank.part.end()),
                                    .value = exact.torque});
  }

  static ncf::Bar bar(const Vector<2>& from, const Vector<2>& to, double mass) {
    const double length = (to - from).norm();
    return {.from = from,
            .to = to,
            .inertia = ncf::PlanarInertia{
                .mass = mass, .centre = {length / 2, 0}, .polar = mass * length * length / 12}};
  }
};

template <class Policy>
void slider_crank(const examples::Settings& settings, const Case& data, Policy) {
  examples::require(
      data.exact.crank < data.exact.rod, "crank.length", data.exact.crank,
      "below the length of the rod, " + examples::format_exact(data.exact.rod) + " m");
  SliderCrank model(data);
  using System = Dynamics<Mechanism, solvers::SparseLDLT, Policy>;
  System system(model.mechanism);

  examples::Session session(settings, "slider_crank", "slider-crank under a constant torque",
                            system);
  const auto text = [](double value) { return examples::format_exact(value); };
  const auto& exact = data.exact;
  session.note("bodies", "crank " + text(exact.crank) + " m and " + text(exact.crank_mass) +
                             " kg, rod " + text(exact.rod) + " m and " + text(exact.rod_mass) +
                             " kg, slider " + text(exact.slider_mass) + " kg, torque " +
                             text(exact.torque) + " N m");
  examples::trace_slider_crank(session, model.crank, model.slider);
  examples::record_reaction<joints::Joint<2>>(session, model.pin_O, "pin_O");
  examples::record_body_loads(session, "crank", std::vector{model.crank});
  examples::record_body_loads(session, "rod", std::vector{model.rod});
  examples::record_body_loads(session, "slider", std::vector{model.slider});
  session.run(examples::integrator_of(settings), *settings.samples, *settings.fields);
  examples::compare_with_reference(session, model.exact);
  if (data.halvings > 0)
    examples::report_order(session, model.exact, data.halvings, [&](double step) {
      SliderCrank again(data);
      System steps(again.mechanism);
      std::vector<double> x;
      run(
          steps, examples::integrator_of(settings), {.until = settings.until, .step = step},
          [](auto&, const sph::StepLimit&) {}, Every(session.trace_interval, [&](auto& s) {
            x.push_back(again.slider.point({0, 0}).at(s.state().q)[0]);
          }));
      return x;
    });
  session.finish();
}

int main(int argc, char** argv) {
  Case data;
  examples::Parameters parameters(
      {.name = "slider_crank",
       .title = "slider-crank under a constant torque",
       .backends = examples::host_backends(),
       .defaults = {.until = 1, .step = 1e-3, .threads = 1, .fields = 50, .samples = 200},
       .gas = false,
       .structure = true});
  data.add(parameters);
  return examples::guarded_main(argc, argv, parameters, [&](const examples::Settings& settings) {
    examples::with_host_backend(settings,
                                [&](const auto& s, auto policy) { slider_crank(s, data, policy); });
  });
}
