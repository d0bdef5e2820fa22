// SPDX-License-Identifier: MIT
// A body whose shape comes from a file in a stream of gas: a profile from a text file in the plane,
// triangles from an STL file in space (SHAPE_DIM = 2, 3). The stream comes in and goes out by
// openings; across it the body repeats itself.
#include <sphmbs/geometry/advice.hpp>
#include <sphmbs/geometry/faceted.hpp>
#include <sphmbs/geometry/inspection.hpp>
#include <sphmbs/io/path_text.hpp>
#include <sphmbs/io/stl.hpp>
#include <sphmbs/sphmbs.hpp>

#include "support/backends.hpp"
#include "support/gas_parameters.hpp"
#include "support/gas_session.hpp"
#include "support/guarded_main.hpp"
#include "support/schemes.hpp"

using namespace sphmbs;

constexpr int dim = SHAPE_DIM;

/// The stream's speed is 1 m/s.
struct Flow {
  std::string file = SHAPE_DATA;
  std::string unit = dim == 2 ? "cm" : "mm";  // of the file
  double angle = 10;                          // of the stream, from below [deg]
  double mach = 0.3;
  double upstream = dim == 2 ? 2 : 0.75;    // from the inlet to the shape [m]
  double downstream = dim == 2 ? 3 : 1.25;  // from the shape to the outlet [m]
  double width = dim == 2 ? 6 : 1;          // from one shape to the next [m]

  void add(examples::Parameters& parameters) {
    parameters.add_path(
        "shape.file", file,
        dim == 2 ? "rows of coordinates, or path data of an SVG file" : "triangles, STL",
        "--shape");
    parameters.add_choice("shape.unit", unit, {"m", "cm", "mm", "inch"}, "length of 1 in the file");
    parameters.add_number("stream.angle", angle, {.at_least = -90.0, .at_most = 90.0}, "deg",
                          "of the stream, from below", "--angle");
    parameters.add_number("stream.mach", mach, {.at_least = 0.05, .at_most = 0.7}, "",
                          "speed by that of sound", "--mach");
    parameters.add_number("stream.upstream", upstream, {.above = 0.0}, "m",
                          "from the inlet to the shape");
    parameters.add_number("stream.downstream", downstream, {.above = 0.0}, "m",
                          "from the shape to the outlet");
    parameters.add_number("stream.width", width, {.above = 0.0}, "m", "from one shape to the next",
                          "--width");
  }
};

double length_of(const std::string& unit) {
  return unit == "cm"     ? io::centimetre
         : unit == "mm"   ? io::millimetre
         : unit == "inch" ? io::inch
                          : io::metre;
}

/// The facets of a shape, in metres, from x = 0 on.
geometry::Facets<dim> read_shape(const Flow& flow) {
  const geometry::Facets<dim> facets = [&] {
    try {
      if constexpr (dim == 2)
        return io::read_path(flow.file, {.unit = length_of(flow.unit)});
      else
        return io::read_stl(flow.file, length_of(flow.unit));
    } catch (const InvalidInput& error) {
      throw examples::RefusedValue("shape.file", flow.file, error.what(), error.id);
    }
  }();
  const double begin = geometry::inspect(facets).box.lower[0];
  return geometry::mapped(facets, [&](Vec<dim> x) {
    x[0] -= begin;
    return x;
  });
}

/// A point of a shape that turns against a stream from below, about a place on the axis.
Vec<dim> turned(Vec<dim> x, double angle, double axis) {
  const double c = std::cos(angle), s = std::sin(angle), along = x[0] - axis, across = x[1];
  x[0] = axis + c * along + s * across;
  x[1] = c * across - s * along;
  return x;
}

/// @param box    around the turned shape
/// @param chord  the shape's length before it turns [m]
void check(const Flow& flow, const geometry::Box<dim>& box, double chord) {
  examples::require(chord < 100 * flow.width && chord > 0.01 * flow.width, "shape.unit", flow.unit,
                    "such that the shape, " + examples::length_text(chord) +
                        " long, fits the width of the stream, " +
                        examples::length_text(flow.width));
  for (int k = 1; k < dim; ++k) {
    const auto half = [&](double x) { return std::abs(x) < flow.width / 2; };
    examples::require(
        half(box.lower[k]) && half(box.upper[k]), "stream.width", flow.width,
        "so large that shapes, " + examples::length_text(chord) + " long, do not touch each other");
  }
  examples::require(box.lower[0] > -flow.upstream, "stream.upstream", flow.upstream,
                    "so large that the turned shape does not reach into the inlet");
  examples::require(box.upper[0] < chord + flow.downstream, "stream.downstream", flow.downstream,
                    "so large that the turned shape does not reach into the outlet");
}

template <class Gas, class T, class Policy>
void shape_in_flow(const examples::Settings& settings, const Flow& flow, Policy policy) {
  const geometry::Facets<dim> read = read_shape(flow);
  const double dx = settings.spacing, chord = geometry::inspect(read).box.upper[0];
  const geometry::Facets<dim> facets = geometry::mapped(
      read, [&](const Vec<dim>& x) { return turned(x, flow.angle * math::pi / 180, chord / 2); });
  const geometry::Inspection<dim> seen = geometry::inspect(facets);
  check(flow, seen.box, chord);
  examples::require(dx <= chord / 10 && examples::is_whole(flow.width, dx), "--spacing", dx,
                    "a whole fraction of the width, and at most a tenth of the shape's length, " +
                        examples::length_text(chord));
  examples::require(flow.width >= 8 * dx, "stream.width", flow.width,
                    "at least eight spacings, " + examples::length_text(8 * dx));
  const double length = flow.upstream + chord + flow.downstream;
  examples::require_memory(length * math::power<dim - 1>(flow.width) / math::power<dim>(dx), dx);

  // Where: a stretch of the stream between two openings, one support deep.
  const auto ends = [&](double from, double to) {
    geometry::Box<dim> box{Vec<dim>::all(-flow.width / 2), Vec<dim>::all(flow.width / 2)};
    box.lower[0] = from;
    box.upper[0] = to;
    return box;
  };
  const double inlet = -flow.upstream, outlet = chord + flow.downstream, depth = 4 * dx;
  const geometry::Box<dim> stretch = ends(inlet, outlet);
  geometry::Domain<dim> domain{.box = ends(inlet - depth, outlet + depth)};
  for (std::size_t k = 1; k < dim; ++k) domain.periodic[k] = true;
  const geometry::Lattice<dim> lattice{.spacing = dx, .origin = Vec<dim>::all(dx / 2)};
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
  // Without a background pressure: its gas would leave empty space behind blunt shapes.
  const Gas gas{.eos = {.gamma = 1.4}};
  sph::Fluid<Gas, Policy, boundary::Fixed, T> fluid(gas, domain, std::move(cloud), {}, policy);

  const std::string name = dim == 2 ? "shape_in_flow" : "shape_in_flow_3d";
  examples::Session session(settings, name, "a shape from a file in a stream", fluid);
  session.note("gas", examples::format_exact(dim) + "D, ideal gas gamma 1.4; " +
                          examples::describe<Gas>() + "; Mach number " +
                          examples::format_exact(flow.mach));
  session.note("shape", flow.file + " at " + examples::format_exact(flow.angle) + " degrees, " +
                            std::to_string(seen.facets) + " facets around " +
                            examples::format_number(std::abs(seen.volume)) +
                            (dim == 2 ? " m^2" : " m^3"));
  for (const auto& advice : geometry::advise(seen, stretch)) session.warn(advice.id, advice.text);
  session.record("drag_coefficient", "-", [&] { return 2 * fluid.force_on(surface)[0]; });
  session.record("lift_coefficient", "-", [&] { return 2 * fluid.force_on(surface)[1]; });
  session.run(time::PredictorCorrector{}, *settings.samples, *settings.fields);
  const examples::History& history = session.history();
  session.curves(
      "history", session.title(),
      {{.title = "force of the gas by 1/2 rho v^2 1 m" + std::string(dim == 2 ? "" : "^2"),
        .x_label = "t [s]",
        .y_label = "coefficient [-]",
        .curves = {history.curve("drag_coefficient", "drag"),
                   history.curve("lift_coefficient", "lift")}}},
      1);
  session.finish();
}

int main(int argc, char** argv) {
  examples::Parameters parameters({.name = dim == 2 ? "shape_in_flow" : "shape_in_flow_3d",
                                   .title = "a shape from a file in a stream",
                                   .backends = examples::backends(),
                                   .precisions = examples::precisions(),
                                   .defaults = {.spacing = 0.05,
                                                .until = dim == 2 ? 2.0 : 0.5,
                                                .cfl = 0.4,
                                                .fields = 4,
                                                .samples = 200},
                                   .dim = dim});
  Flow flow;
  flow.add(parameters);
  return examples::guarded_main(argc, argv, parameters, [&](const examples::Settings& settings) {
    examples::with_backend(settings, [&]<class T>(const auto& s, auto policy) {
      shape_in_flow<sph::SmoothScheme<dim>, T>(s, flow, policy);
    });
  });
}
