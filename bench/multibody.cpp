// SPDX-License-Identifier: MIT
// Elastic force and tangent of each element, assembly, factorisation, and whole steps of the cable
// of case 3 and of the plates of case 4 (n x n elements each). Counters are per element or per
// step.
#include <sphmbs/mbs/ancf/beam.hpp>
#include <sphmbs/mbs/solvers/sparse_ldlt.hpp>

#include "support/registry.hpp"
#include "support/structures.hpp"

using namespace sphmbs;
using namespace sphmbs::mbs;

namespace {

template <Element E>
void add_element(const std::string& name, const E& element, const Vector<E::dofs>& straight) {
  // Many states, so that what is timed is not one that the processor has learnt.
  std::srand(1);
  std::vector<Vector<E::dofs>> states(64);
  for (auto& q : states) q = straight + 0.05 * Vector<E::dofs>::Random();
  const Vector<E::dofs> rest = Vector<E::dofs>::Zero();
  bench::add("element/" + name + "/force", 1, [=](benchmark::State& state) {
    std::size_t k = 0;
    for (auto _ : state)
      benchmark::DoNotOptimize(element.internal_force(states[k++ % 64], rest).eval());
  })->Unit(benchmark::kMicrosecond);
  bench::add("element/" + name + "/tangent", 1, [=](benchmark::State& state) {
    std::size_t k = 0;
    for (auto _ : state)
      benchmark::DoNotOptimize(element.tangent(states[k++ % 64], rest, 0).eval());
  })->Unit(benchmark::kMicrosecond);
}

template <class Make>
void add_structure(const std::string& name, Make make, int n, double h) {
  using Structure = decltype(make(n));
  const MatrixWeights weights{4 / (h * h), 2 / h};
  bench::for_policies_and_threads(
      [&]<class Policy>(Policy, const std::string& policy, int threads) {
        const std::string title = name + "/" + std::to_string(n) + "/" + policy;
        const auto timed = [=](auto&& work) {
          return [=](benchmark::State& state) {
            Structure structure = make(n);
            Dynamics<Structure, solvers::SparseLDLT, Policy> system(structure);
            work(state, system);
          };
        };
        bench::add(title + "/residual", threads, timed([](benchmark::State& state, auto& system) {
                     VectorXd r;
                     for (auto _ : state) {
                       system.equations().evaluate(system.state());
                       system.equations().residual(system.state().vdot, r);
                     }
                   }))
            ->Unit(benchmark::kMicrosecond);
        bench::add(title + "/matrix", threads, timed([=](benchmark::State& state, auto& system) {
                     SparseMatrix A;
                     for (auto _ : state) {
                       system.equations().evaluate(system.state(), &weights);
                       system.equations().matrix(weights, A);
                     }
                   }))
            ->Unit(benchmark::kMicrosecond);
        bench::add(title + "/step", threads, timed([=](benchmark::State& state, auto& system) {
                     const GeneralizedAlpha integrator;
                     for (auto _ : state) integrator.step(system, [h] { return h; });
                     const DynamicsStatistics done = system.statistics();
                     const auto steps = static_cast<double>(done.steps);
                     state.counters["iterations"] = static_cast<double>(done.iterations) / steps;
                     state.counters["factorisations"] =
                         static_cast<double>(done.factorisations) / steps;
                   }))
            ->Iterations(200)
            ->Unit(benchmark::kMicrosecond);
      });
}

template <class Solver, class Make>
void add_solver(const std::string& name, Make make, int n, double h) {
  using Structure = decltype(make(n));
  const MatrixWeights weights{4 / (h * h), 2 / h};
  const std::string title = name + "/" + std::to_string(n) + "/" + std::string(Solver::name);
  const auto prepared = [=](auto&& work) {
    return [=](benchmark::State& state) {
      Structure structure = make(n);
      Dynamics<Structure> system(structure);
      auto& equations = system.equations();
      equations.evaluate(system.state(), &weights);
      SparseMatrix A;
      equations.matrix(weights, A);
      equilibrate(A, equations.roles());
      Solver solver;
      solver.analyse(A, equations.roles());
      work(state, solver, A);
    };
  };
  bench::add(title + "/factorise", 1, prepared([](benchmark::State& state, auto& solver, auto& A) {
               for (auto _ : state) benchmark::DoNotOptimize(solver.factorise(A));
             }))
      ->Unit(benchmark::kMicrosecond);
  bench::add(title + "/solve", 1, prepared([](benchmark::State& state, auto& solver, auto& A) {
               solver.factorise(A);
               const VectorXd b = VectorXd::Ones(A.rows());
               VectorXd x;
               for (auto _ : state) solver.solve(b, x);
             }))
      ->Unit(benchmark::kMicrosecond);
}

[[maybe_unused]] const bool registered = [] {
  const ancf::Cable<2> planar{
      .length = 0.2, .axial_stiffness = 1e6, .bending_stiffness = 1, .mass_per_length = 1};
  const ancf::Cable<3> spatial{
      .length = 0.2, .axial_stiffness = 1e6, .bending_stiffness = 1, .mass_per_length = 1};
  Vector<8> straight2;
  straight2 << 0, 0, 1, 0, 0.2, 0, 1, 0;
  Vector<12> straight3;
  straight3 << 0, 0, 0, 1, 0, 0, 0.2, 0, 0, 1, 0, 0;
  add_element("cable 2D", planar, straight2);
  add_element("cable 3D", spatial, straight3);
  const ancf::Beam beam{
      .length = 0.2, .width = 0.1, .height = 0.1, .density = 1, .youngs_modulus = 1e7};
  Vector<24> straight_beam;
  straight_beam << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0.2, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
  add_element("beam", beam, straight_beam);
  const auto flat = bench::plates(1);
  const auto& plate = flat.all<ancf::Plate36>()[0];
  add_element("plate 36", plate.part, plate.local(flat.q()));

  for (const int n : {24, 400}) {
    add_structure("cable", bench::cable, n, 2.5e-4);
    add_solver<solvers::SparseLU>("cable", bench::cable, n, 2.5e-4);
    add_solver<solvers::SparseLDLT>("cable", bench::cable, n, 2.5e-4);
  }
  add_structure("plates", bench::plates, 10, 5e-4);
  add_solver<solvers::SparseLU>("plates", bench::plates, 10, 5e-4);
  add_solver<solvers::SparseLDLT>("plates", bench::plates, 10, 5e-4);
  return true;
}();

}  // namespace
