// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <sphmbs/core/archive.hpp>
#include <sphmbs/execution/default.hpp>
#include <sphmbs/execution/first_error.hpp>
#include <sphmbs/execution/serial.hpp>
#include <sphmbs/mbs/layout.hpp>
#include <sphmbs/mbs/mass.hpp>

namespace sphmbs::mbs {

/// The assembled equations of a structure, eq. (25):
///
///   r   = M vdot + Phi_q^T lambda + F(q, v) - Q(q, v, t) - M T g - Q_ext
///   Phi = Phi(q, t)
///
/// over the unknowns [q, lambda]. Components compute into slots, in parallel; each number of the
/// result then gathers its own slots in a fixed order, so that results do not depend on the number
/// of threads.
template <class Structure, class Policy = execution::Default>
class Equations {
 public:
  static constexpr int dim = Structure::dim;  ///< dimension of space

  /// Keeps a reference to the structure, which must be complete.
  /// @throws as Structure::check does.
  explicit Equations(Structure& structure)
      : structure_((structure.check(), structure)),
        external_(VectorXd::Zero(structure.coordinates())),
        mass_(assemble_mass(structure)) {
    lay_out_again();
  }

  /// Number of coordinates q.
  int coordinates() const { return layout_.coordinates; }
  /// Number of conditions Phi, redundant ones included.
  int conditions() const { return layout_.conditions; }
  /// Coordinates and multipliers together.
  int unknowns() const { return layout_.unknowns(); }
  /// Which component has which coordinates and conditions.
  const Layout& layout() const { return layout_; }
  /// What each unknown is.
  const std::vector<Role>& roles() const { return layout_.roles; }
  /// M, constant.
  const SparseMatrix& mass() const { return mass_.M; }
  /// Coordinates of unit translations, one column for each axis.
  const Matrix<Dynamic, dim>& translation() const { return mass_.translation; }

  /// Generalized force from outside, such as that of a gas [N per coordinate].
  VectorXd& external_force() { return external_; }
  /// Force from outside, such as that of gas [N per coordinate].
  const VectorXd& external_force() const { return external_; }
  /// Magnitude of the gravity that acts [m/s^2].
  double weight() const { return std::abs(load_factor_) * structure_.gravity.norm(); }
  /// Share of gravity and loads that acts: 1 but in statics.
  void set_load_factor(double factor) { load_factor_ = factor; }

  /// Takes conditions out of the system: their multipliers are zero.
  void remove(const std::vector<int>& conditions) {
    for (const int k : conditions) removed_[as_size(k)] = 1;
  }
  /// Whether a redundant condition was taken out.
  bool removed(int condition) const { return removed_[as_size(condition)] != 0; }

  /// Moves joints along with the coordinates. Where one touches other coordinates than before, the
  /// layout is made anew and topology() changes.
  void relocate(const VectorXd& q) {
    bool changed = false;
    structure_.for_each_type([&]<class T>(auto& components) {
      if constexpr (MovingConstraint<T>)
        for (auto& joint : components) changed = joint.relocate(q) || changed;
    });
    if (changed) lay_out_again();
  }
  /// Changes when the pattern of the matrix does.
  int topology() const { return topology_; }

  /// Computes all contributions at a state; with weights, those of the matrix too.
  /// @throws NumericalFailure from a component that has no value at this state; InvalidInput where
  ///         the structure has got other parts, joints or forces since.
  void evaluate(const State& state, const MatrixWeights* weights = nullptr) {
    if (structure_.coordinates() != coordinates() ||
        structure_.components() != layout_.slots.size())
      throw InvalidInput(
          "structure = changed since its equations were made: must be complete then");
    std::size_t first = 0;
    structure_.for_each_type([&]<class T>(const auto& components) {
      execution::FirstError error;
      loop(components.size(), many_components, [&, first](std::size_t i) {
        const Slot& slot = layout_.slots[first + i];
        const Local local = gather(slot, state);
        Contribution out = contribution_of(slot, weights);
        error.guard(i, [&] { contribute<T>(components[i], local, out); });
      });
      error.rethrow();
      first += components.size();
    });
  }

  /// [r, Phi] of the last evaluate(), with the inertia of `vdot`; zero for removed conditions.
  void residual(const VectorXd& vdot, VectorXd& result) const {
    result.resize(unknowns());
    const Vector<dim> g = load_factor_ * structure_.gravity;
    loop(as_size(unknowns()), many_unknowns, [&](std::size_t i) {
      double sum = 0;
      for (std::size_t s = layout_.vector_begin[i]; s < layout_.vector_begin[i + 1]; ++s)
        sum += vectors_[layout_.vector_sources[s]];
      const int k = static_cast<int>(i);
      if (k < coordinates()) {
        for (SparseMatrix::InnerIterator m(mass_.M, k); m; ++m) sum += m.value() * vdot[m.row()];
        sum -= mass_.weight.row(k) * g + load_factor_ * external_[k];
      } else if (removed(k - coordinates())) {
        sum = 0;
      }
      result[k] = sum;
    });
  }

  /// Iteration matrix of the last evaluate() with these weights; entries of removed conditions are
  /// those of the unit matrix.
  void matrix(const MatrixWeights& weights, SparseMatrix& result) const {
    if (result.rows() != unknowns() || result.nonZeros() != layout_.zeros.nonZeros())
      result = layout_.zeros;
    std::copy_n(layout_.zeros.innerIndexPtr(), layout_.zeros.nonZeros(), result.innerIndexPtr());
    std::copy_n(layout_.zeros.outerIndexPtr(), unknowns() + 1, result.outerIndexPtr());
    const int* outer = result.outerIndexPtr();
    loop(as_size(unknowns()), many_unknowns, [&](std::size_t column) {
      for (int k = outer[column]; k < outer[column + 1]; ++k)
        result.valuePtr()[k] =
            weights.mass * layout_.mass[as_size(k)] + layout_.pattern.sum(as_size(k), matrices_);
    });
    for (int c = 0; c < conditions(); ++c)
      if (removed(c)) cut(coordinates() + c, result);
  }

  /// Zeros where the iteration matrix has entries.
  const SparseMatrix& pattern() const { return layout_.zeros; }

  /// Phi_q of the last evaluate(), removed rows included.
  SparseMatrix jacobian() const {
    std::vector<Eigen::Triplet<double>> entries;
    for (const Slot& slot : layout_.slots)
      for (int j = 0; j < slot.n; ++j)
        for (int i = 0; i < slot.m; ++i)
          entries.emplace_back(slot.first_condition + i, layout_.own(slot)[j],
                               matrices_[slot.at_B() + as_size(j * slot.m + i)]);
    SparseMatrix B(conditions(), coordinates());
    B.setFromTriplets(entries.begin(), entries.end());
    return B;
  }

  /// Phi_q x with Phi_q of the last evaluate(), removed rows included.
  VectorXd jacobian_times(const VectorXd& x) const {
    VectorXd product = VectorXd::Zero(conditions());
    for (const Slot& slot : layout_.slots)
      for (int j = 0; j < slot.n; ++j)
        for (int i = 0; i < slot.m; ++i)
          product[slot.first_condition + i] +=
              matrices_[slot.at_B() + as_size(j * slot.m + i)] * x[layout_.own(slot)[j]];
    return product;
  }

  /// Phi of the last evaluate(), removed rows included.
  VectorXd conditions_residual() const {
    VectorXd phi(conditions());
    for (const Slot& slot : layout_.slots)
      for (int i = 0; i < slot.m; ++i)
        phi[slot.first_condition + i] = vectors_[slot.vector + as_size(slot.n + i)];
    return phi;
  }

  /// The force from outside, and components with a state of their own, such as joints that move
  /// along.
  template <Archive A>
  void visit_state(A& archive) {
    archive("external", external_);
    int type = 0;
    structure_.for_each_type([&]<class T>(auto& components) {
      using Component = std::remove_cvref_t<decltype(components[0])>;
      constexpr bool has_state = requires(Component c) { c.visit_state(archive); };
      static_assert(has_state || !MovingConstraint<T>,
                    "a joint that moves along has a visit_state, to be found there again");
      if constexpr (has_state)
        for (std::size_t k = 0; k < components.size(); ++k)
          archive("component_" + std::to_string(type) + "_" + std::to_string(k), components[k]);
      ++type;
    });
    if constexpr (A::restores) lay_out_again();
  }

  /// Calls `visit.template operator()<T>(component, slot, local state)` for each one, in order.
  template <class Visit>
  void for_each_component(const State& state, Visit&& visit) {
    std::size_t number = 0;
    structure_.for_each_type([&]<class T>(auto& components) {
      for (auto& component : components) {
        const Slot& slot = layout_.slots[number++];
        const Local local = gather(slot, state);
        visit.template operator()<T>(component, slot, local);
      }
    });
  }

  /// What messages call the component behind an unknown.
  std::string name_of(int unknown) const { return name_of_unknown(structure_, layout_, unknown); }
  /// What messages call a condition.
  std::string name_of_condition(int condition) const { return name_of(coordinates() + condition); }

 private:
  static std::size_t as_size(int n) { return static_cast<std::size_t>(n); }

  // From here on a loop is worth the start of threads.
  static constexpr std::size_t many_components = 64, many_unknowns = 1000;

  template <class Body>
  static void loop(std::size_t n, std::size_t many, const Body& body) {
    if (n < many)
      execution::Serial::for_each(n, body);
    else
      Policy::Host::for_each(n, body);
  }

  Local gather(const Slot& slot, const State& state) {
    const int* own = layout_.own(slot);
    double* q = locals_.data() + 2 * slot.index;
    double* v = q + slot.n;
    for (int k = 0; k < slot.n; ++k) {
      q[k] = state.q[own[k]];
      v[k] = state.v[own[k]];
    }
    double* lambda = multipliers_.data() + slot.first_condition;
    for (int k = 0; k < slot.m; ++k) lambda[k] = state.lambda[slot.first_condition + k];
    return {{q, slot.n}, {v, slot.n}, {lambda, slot.m}, state.t, load_factor_};
  }

  Contribution contribution_of(const Slot& slot, const MatrixWeights* weights) {
    double* r = vectors_.data() + slot.vector;
    double* matrices = matrices_.data();
    const int nA = slot.has_A ? slot.n : 0, nL = slot.has_L ? slot.n : 0;
    const int nC = slot.has_C ? slot.n : 0;
    return {.r = {r, slot.n},
            .phi = {r + slot.n, slot.m},
            .A = {matrices + slot.matrix, nA, nA},
            .B = {matrices + slot.at_B(), slot.m, slot.n},
            .L = {matrices + slot.at_L(), nL, nL > 0 ? slot.m : 0},
            .C = {matrices + slot.at_C(), nC, nC},
            .w = weights ? weights->rate : 0,
            .tangent = weights != nullptr};
  }

  void lay_out_again() {
    layout_ = lay_out(structure_, mass_.M);
    ++topology_;
    vectors_.assign(layout_.vector_size, 0.0);
    matrices_.assign(layout_.matrix_size, 0.0);
    locals_.assign(2 * layout_.index.size(), 0.0);
    multipliers_.assign(as_size(conditions()), 0.0);
    removed_.resize(as_size(conditions()), 0);
  }

  // The pattern is symmetric: the row of an unknown is where its column is.
  void cut(int unknown, SparseMatrix& A) const {
    for (SparseMatrix::InnerIterator entry(A, unknown); entry; ++entry) {
      const int other = static_cast<int>(entry.row());
      entry.valueRef() = other == unknown ? 1 : 0;
      if (other != unknown) A.coeffRef(unknown, other) = 0;
    }
  }

  Structure& structure_;
  VectorXd external_;
  double load_factor_ = 1;
  Mass<dim> mass_;
  Layout layout_;
  int topology_ = 0;
  std::vector<unsigned char> removed_;  // flag of each condition
  std::vector<double> locals_, multipliers_, vectors_, matrices_;
};

}  // namespace sphmbs::mbs
