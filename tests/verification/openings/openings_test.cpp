// SPDX-License-Identifier: MIT
// Gas that comes in and goes out by openings: what they let through, what they throw back, and what
// they say has passed.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>
#include <vector>

#include <sphmbs/sphmbs.hpp>

#include "support/catch.hpp"
#include "support/policies.hpp"
#include "support/state.hpp"

namespace {

namespace geometry = sphmbs::geometry;
namespace particles = sphmbs::particles;
namespace sph = sphmbs::sph;
using sphmbs::Vec;

constexpr double heat_ratio = 1.4;

/// Gas of unit density and sound speed that flows along x.
template <int Dim>
particles::State<Dim> stream(double mach) {
  particles::State<Dim> state{.rho = 1, .p = 1 / heat_ratio};
  state.v[0] = mach;
  return state;
}

/// A duct along x from 0 to `length`, open at both ends, periodic across.
template <int Dim>
struct Duct {
  double length;
  double dx;
  particles::State<Dim> far;
  double distance = length;

  double width() const { return 10 * dx; }
  double depth() const { return 5 * dx; }

  geometry::Box<Dim> box(double from, double to) const {
    geometry::Box<Dim> b{Vec<Dim>::all(0.0), Vec<Dim>::all(width())};
    b.lower[0] = from;
    b.upper[0] = to;
    return b;
  }
  geometry::Domain<Dim> domain() const {
    geometry::Domain<Dim> d{box(-depth(), length + depth()), {}};
    d.periodic.fill(true);
    d.periodic[0] = false;
    return d;
  }
  /// Gas everywhere in the far state; the openings are the upstream and the downstream one.
  particles::Cloud<Dim> cloud() const {
    const geometry::Lattice<Dim> lattice{.spacing = dx, .origin = Vec<Dim>::all(dx / 2)};
    particles::Cloud<Dim> cloud;
    cloud.add_gas(lattice.points(box(0, length), domain()), far, {dx});
    for (const int side : {1, -1}) {
      const auto zone = side > 0 ? box(-depth(), 0) : box(length, length + depth());
      cloud.add_opening({.lower = zone.lower,
                         .upper = zone.upper,
                         .axis = 0,
                         .side = side,
                         .far = far,
                         .distance = distance},
                        lattice.points(zone, domain()), {dx});
    }
    return cloud;
  }
};

/// What a gas's own sums and its accounts differ by.
template <class Fluid>
class Balance {
 public:
  explicit Balance(Fluid& fluid) : fluid_(fluid), start_(fluid.totals()) {}

  struct Gap {
    double mass, momentum, energy;
  };
  Gap gap() {
    const auto now = fluid_.totals();
    double mass = now.mass - start_.mass;
    auto momentum = now.momentum - start_.momentum - fluid_.exchange().impulse();
    double energy = now.energy() - start_.energy() - fluid_.exchange().driving_work() -
                    fluid_.exchange().body_work() +
                    fluid_.scheme().background * (now.volume - start_.volume);
    for (const auto& passed : fluid_.traffic()) {
      mass += passed.out.mass - passed.in.mass;
      momentum += passed.out.momentum - passed.in.momentum;
      energy += passed.out.energy - passed.in.energy +
                fluid_.scheme().background * (passed.out.volume - passed.in.volume);
    }
    return {std::abs(mass), std::sqrt(norm2(momentum)), std::abs(energy)};
  }

 private:
  Fluid& fluid_;
  sph::Totals<Fluid::dim> start_;
};

/// Largest difference of the gas from a stream, in velocity and pressure.
template <class Fluid, int Dim>
double departure(Fluid& fluid, const particles::State<Dim>& stream) {
  const auto fields = fluid.particles().fields();
  double most = 0;
  for (std::size_t i = 0; i < fluid.size(); ++i) {
    if (fields.set[i] != particles::gas) continue;
    most = std::max({most, std::sqrt(norm2(fields.velocity(i) - stream.v)),
                     std::abs(fluid.scheme().eos.pressure(fields.rho[i], fields.e[i]) - stream.p)});
  }
  return most;
}

template <class Fluid>
void run_until(Fluid& fluid, double until, double cfl = 0.4) {
  sphmbs::run(fluid, sphmbs::time::PredictorCorrector{}, {.until = until, .cfl = cfl},
              sphmbs::no_report);
}

/// A stream goes through a duct several times over.
template <class Gas, class Policy>
void check_stream(double mach, double tolerance) {
  constexpr int dim = Gas::dim;
  const Duct<dim> duct{.length = 1, .dx = 0.05, .far = stream<dim>(mach)};
  sph::Fluid<Gas, Policy> fluid(Gas{.eos = {.gamma = heat_ratio}}, duct.domain(), duct.cloud());
  Balance balance(fluid);
  const std::size_t gas = fluid.gas_count();
  const double until = 3 / mach;
  run_until(fluid, until);
  CHECK(departure(fluid, duct.far) < tolerance);
  // Columns that have come to a face; one on its way may or may not have passed.
  const double rows = std::pow(10, dim - 1);
  const double columns = mach * until / duct.dx;
  for (const auto& passed : {fluid.traffic()[0].in, fluid.traffic()[1].out})
    CHECK(std::abs(static_cast<double>(passed.particles) - rows * columns) <= rows);
  CHECK(fluid.traffic()[0].out.particles == 0);
  CHECK(fluid.traffic()[1].in.particles == 0);
  CHECK(fluid.gas_count() + fluid.opening_count() == fluid.size());
  CHECK(fluid.gas_count() ==
        gas + fluid.traffic()[0].in.particles - fluid.traffic()[1].out.particles);
  CHECK(balance.gap().mass < 1e-12);
  CHECK(balance.gap().momentum < 1e-12);
  CHECK(balance.gap().energy < 1e-9);
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("a stream passes a duct unchanged and is counted", "[verification]",
                        test::Policies) {
  using Policy = TestType;
  for (const double mach : {0.1, 0.6}) {
    CAPTURE(mach);
    check_stream<sph::PaperScheme<2>, Policy>(mach, 1e-9);
    check_stream<sph::SmoothScheme<2>, Policy>(mach, 1e-9);
  }
}

TEST_CASE("a stream faster than sound passes a duct", "[verification]") {
  check_stream<sph::PaperScheme<2>, sphmbs::execution::Serial>(2, 1e-9);
  // Sums of the kernel over a lattice differ from the density by 8e-5.
  check_stream<sph::ShockScheme<2>, sphmbs::execution::Serial>(2, 1e-3);
}

TEST_CASE("streams in one and three dimensions pass a duct", "[verification]") {
  check_stream<sph::PaperScheme<1>, sphmbs::execution::Serial>(0.3, 1e-9);
  check_stream<sph::SmoothScheme<3>, sphmbs::execution::OpenMP>(0.8, 1e-9);
}

namespace {

/// What comes back of a pulse of sound, by its height, once the pulse itself has left.
/// @param direction  1: with the stream to its far end, -1: against it
template <class Gas>
double echo(double mach, double width, int direction) {
  const Duct<2> duct{.length = 3, .dx = 0.04, .far = stream<2>(mach), .distance = 30};
  constexpr double height = 1e-4;
  auto cloud = duct.cloud();
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (cloud.set[i] != particles::gas) continue;
    const double s = height * std::exp(-std::pow((cloud.r[i][0] - 1.5) / width, 2));
    cloud.p[i] += s;
    cloud.rho[i] += s;
    cloud.m[i] *= 1 + s;
    cloud.v[i][0] += direction * s;
  }
  sph::Fluid<Gas> fluid(Gas{.eos = {.gamma = heat_ratio}}, duct.domain(), cloud);
  // When the pulse's middle would be as far beyond the opening as it was inside.
  run_until(fluid, 3 / (1 + direction * mach));
  return departure(fluid, duct.far) / height;
}

}  // namespace

TEST_CASE("sound leaves by openings", "[verification][slow]") {
  using Gas = sph::SmoothScheme<2>;
  std::printf("echo of a pulse exp(-(x/w)^2) at an opening, share of its height\n");
  std::printf("%6s %6s %22s %22s\n", "Mach", "w/h", "with the stream", "against it");
  for (const double mach : {0.0, 0.1, 0.3}) {
    for (const double width : {0.1, 0.2, 0.4}) {
      const double with = echo<Gas>(mach, width, 1);
      const double against = echo<Gas>(mach, width, -1);
      std::printf("%6.1f %6.1f %22.4f %22.4f\n", mach, width / 0.05, with, against);
      CHECK(with < 0.055);
      CHECK(against < 0.055);
    }
  }
}
