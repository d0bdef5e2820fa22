// SPDX-License-Identifier: MIT
// A body whose shape comes from a file in a stream of gas: a profile from a text file in the plane,
// triangles from an STL file in space (SHAPE_DIM = 2, 3). The stream comes in and goes out by
// openings; across it the body repeats itself.
#include <sphmbs/geometry/advice.hpp>
#include <sphmbs/geometry/faceted.hpp>
#include <sphmbs/io/path_text.hpp>
#include <sphmbs/io/stl.hpp>
#include <sphmbs/sphmbs.hpp>

#include "support/backends.hpp"
#include "support/gas_session.hpp"
#include "support/guarded_main.hpp"
#include "support/schemes.hpp"

using namespace sphmbs;

constexpr int dim = SHAPE_DIM;

/// All shapes are 1 m long and begin at x = 0. The stream's speed is 1 m/s.
struct Flow {
  std::string shape = dim == 2 ? "capsule" : "airship";
  double angle = 10;  // of the stream, from below [deg]
  double mach = 0.3;
  double upstream = dim == 2 ? 2 : 0.75;    // from the inlet to the shape [m]
  double downstream = dim == 2 ? 3 : 1.25;  // from the shape to the outlet [m]
  double width = dim == 2 ? 6 : 1;          // from one shape to the next [m]
};

/// The facets of a shape, in metres.
template <int d>
geometry::Facets<d> read_shape(const std::string& name) {
  const std::filesystem::path folder = SHAPE_DATA;
  if constexpr (d == 2)
    return io::read_path(folder / (name + ".txt"),
                         {.unit = name == "capsule" ? io::centimetre : io::metre});
  else
    return io::read_stl(folder / (name + ".stl"), io::millimetre);
}

/// A point of a shape that turns against a stream from below, about its middle.
Vec<dim> turned(Vec<dim> x, double angle) {
  const double c = std::cos(angle), s = std::sin(angle), along = x[0] - 0.5, across = x[1];
  x[0] = 0.5 + c * along + s * across;
  x[1] = c * across - s * along;
  return x;
}

template <class Gas, class T, class Policy>
void shape_in_flow(const examples::Settings& settings, const Flow& flow, Policy policy) {
  const double dx = settings.spacing;
  examples::require(dx <= 0.1 && std::abs(flow.width / dx - std::round(flow.width / dx)) < 1e-6,
                    "--spacing", dx, "a whole fraction of the width, and at most 0.1 m");
  const double length = flow.upstream + 1 + flow.downstream;
  examples::require_memory(length * math::power<dim - 1>(flow.width) / math::power<dim>(dx), dx);

  // Where: a stretch of the stream between two openings, one support deep.
  const auto ends = [&](double from, double to) {
    geometry::Box<dim> box{Vec<dim>::all(-flow.width / 2), Vec<dim>::all(flow.width / 2)};
    box.lower[0] = from;
    box.upper[0] = to;
    return box;
  };
  const double inlet = -flow.upstream, outlet = 1 + flow.downstream, depth = 4 * dx;
  const geometry::Box<dim> stretch = ends(inlet, outlet);
  geometry::Domain<dim> domain{.box = ends(inlet - depth, outlet + depth)};
  for (std::size_t k = 1; k < dim; ++k) domain.periodic[k] = true;
  const geometry::Lattice<dim> lattice{.spacing = dx, .origin = Vec<dim>::all(dx / 2)};
  const geometry::Facets<dim> facets =
      geometry::mapped(read_shape<dim>(flow.shape),
                       [&](const Vec<dim>& x) { return turned(x, flow.angle * math::pi / 180); });
  const geometry::Faceted<dim> shape(facets);

  // What: an ideal gas whose speed of sound follows from the Mach number.
  const double c = 1 / flow.mach;
  particles::State<dim> stream{.rho = 1, .p = c * c / 1.4};
  stream.v[0] = 1;
  particles::Cloud<dim> cloud;
  cloud.add_gas(lattice.points(stretch - shape, domain), stream, {dx});
  // Gas that begins at rest at the shape and with the stream away from it opens no gap behind it.
  for (std::size_t i = 0; i < cloud.size(); ++i)
    cloud.v[i] = (1 - std::exp(-math::power<2>(4 * shape.distance(cloud.r[i])))) * stream.v;
  const int surface = cloud.add_virtual(lattice.inner_points(shape, domain), stream, {dx}, shape);
  for (const int side : {1, -1}) {
    const geometry::Box<dim> zone =
        side > 0 ? ends(inlet - depth, inlet) : ends(outlet, outlet + depth);
    cloud.add_opening({.lower = zone.lower,
                       .upper = zone.upper,
                       .axis = 0,
                       .side = side,
                       .far = stream,
                       .distance = length},
                      lattice.points(zone, domain), {dx});
  }
  Gas gas{.eos = {.gamma = 1.4}};
  gas.background = stream.p;
  sph::Fluid<Gas, Policy, boundary::Fixed, T> fluid(gas, domain, std::move(cloud), {}, policy);

  const std::string name = dim == 2 ? "shape_in_flow" : "shape_in_flow_3d";
  examples::Session session(settings, name, "a shape from a file in a stream", fluid);
  session.note("gas", examples::format_exact(dim) + "D, ideal gas gamma 1.4; " +
                          examples::describe<Gas>() + "; Mach number " +
                          examples::format_exact(flow.mach));
  const auto seen = geometry::inspect(facets);
  session.note("shape", flow.shape + " at " + examples::format_exact(flow.angle) + " degrees, " +
                            std::to_string(seen.facets) + " facets around " +
                            examples::format_number(std::abs(seen.volume)) +
                            (dim == 2 ? " m^2" : " m^3"));
  for (const auto& advice : geometry::advise(seen, stretch))
    session.note("warning", std::string(advice.id) + " " + advice.text);
  session.record("drag_coefficient", "-", [&] { return 2 * fluid.force_on(surface)[0]; });
  session.record("lift_coefficient", "-", [&] { return 2 * fluid.force_on(surface)[1]; });
  session.run(time::PredictorCorrector{}, std::max(200, static_cast<int>(20 * settings.until)), 4);
  session.finish();
}

int main(int argc, char** argv) {
  examples::CommandLine command_line(
      {.name = dim == 2 ? "shape_in_flow" : "shape_in_flow_3d",
       .title = "a shape from a file in a stream",
       .backends = examples::backends(),
       .precisions = examples::precisions(),
       .defaults = {.spacing = 0.05, .until = dim == 2 ? 2.0 : 0.5, .cfl = 0.4}});
  Flow flow;
  const auto shapes = dim == 2 ? std::vector<std::string>{"capsule", "naca0012"}
                               : std::vector<std::string>{"airship"};
  command_line.add_choice("--shape", flow.shape, shapes, "the file below examples/data");
  command_line.add_number("--angle", flow.angle, {.at_least = -90.0, .at_most = 90.0}, "deg",
                          "of the stream, from below");
  command_line.add_number("--mach", flow.mach, {.at_least = 0.05, .at_most = 0.7}, "",
                          "speed by that of sound");
  command_line.add_number("--width", flow.width, {.at_least = 0.5}, "m",
                          "from one shape to the next");
  return examples::guarded_main(argc, argv, command_line, [&](const examples::Settings& settings) {
    examples::with_backend(settings, [&]<class T>(const auto& s, auto policy) {
      shape_in_flow<sph::SmoothScheme<dim>, T>(s, flow, policy);
    });
  });
}
