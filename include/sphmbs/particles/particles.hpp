// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <sphmbs/core/archive.hpp>
#include <sphmbs/core/expects.hpp>
#include <sphmbs/execution/field.hpp>
#include <sphmbs/particles/cloud.hpp>
#include <sphmbs/particles/record.hpp>

namespace sphmbs::particles {

namespace detail {

template <class T>
struct Gather {
  const T* from;
  T* to;
  const std::uint32_t* order;
  SPHMBS_INLINE void operator()(std::size_t i) const { to[i] = from[order[i]]; }
};

template <class T, int width>
struct GatherRows {
  const T* from;
  T* to;
  const std::uint32_t* order;
  SPHMBS_INLINE void operator()(std::size_t i) const {
    for (std::size_t k = 0; k < width; ++k) to[i * width + k] = from[order[i] * width + k];
  }
};

}  // namespace detail

/// Owns the fields of all particles, their rates, and the records of the current stage, in the
/// memory of a policy.
template <int Dim, class T, execution::ExecutionPolicy Policy>
class Particles {
 public:
  template <class U>
  using Field = execution::Field<U, Policy>;  ///< numbers in the policy's memory

  /// @param energy  specific internal energy of a density and a pressure [J/kg]
  /// @throws InvalidInput for an empty cloud or more than 2^32 - 1 particles.
  template <class Energy>
  Particles(const Cloud<Dim>& cloud, Energy energy)
      : size_(cloud.size()), has_openings_(!cloud.openings.empty()) {
    expects(size_ > 0 && size_ < 0xffffffffu, "particles", size_, "between 1 and 2^32 - 1");
    for (const std::size_t entries : {cloud.v.size(), cloud.rho.size(), cloud.p.size(),
                                      cloud.h.size(), cloud.m.size(), cloud.set.size()})
      expects(entries == size_, "entries of a cloud's field", entries,
              "as many as positions, " + std::to_string(size_));
    for (const double m : cloud.m) expects(m > 0 && std::isfinite(m), "mass", m, "positive [kg]");
    for (Field<T>* f : numbers()) *f = Field<T>(std::vector<T>(padded()));
    const std::size_t n = size_;
    std::vector<T> column(padded());
    const auto put = [&](Field<T>& field, auto value) {
      for (std::size_t i = 0; i < n; ++i) column[i] = static_cast<T>(value(i));
      field.upload(column);
    };
    for (int k = 0; k < Dim; ++k) {
      put(v_[k], [&](std::size_t i) { return cloud.v[i][k]; });
    }
    put_places(cloud.r, column);
    put(rho_, [&](std::size_t i) { return cloud.rho[i]; });
    put(e_, [&](std::size_t i) { return energy(cloud.rho[i], cloud.p[i]); });
    put(h_, [&](std::size_t i) { return cloud.h[i]; });
    put(m_, [&](std::size_t i) { return cloud.m[i]; });
    if (cloud.has_surfaces()) {
      expects(cloud.normal.size() == n && cloud.depth.size() == n, "entries of a cloud's surfaces",
              cloud.normal.size(), "as many as positions, " + std::to_string(n));
      depth_ = Field<T>(padded());
      for (Field<T>& f : normal_) f = Field<T>(padded());
      for (int k = 0; k < Dim; ++k)
        put(normal_[k], [&](std::size_t i) { return cloud.normal[i][k]; });
      put(depth_, [&](std::size_t i) { return cloud.depth[i]; });
    }
    if (cloud.has_sheets()) {
      expects(cloud.sheet.size() == n && cloud.has_surfaces(), "entries of a cloud's sheets",
              cloud.sheet.size(), "as many as positions, with their surfaces");
      sheet_ = Field<std::uint8_t>(cloud.sheet);
      patch_ = Field<T>(padded());
      put(patch_, [&](std::size_t i) { return std::pow(cloud.m[i] / cloud.rho[i], 1.0 / Dim); });
    }
    std::vector<std::uint32_t> id(n);
    std::iota(id.begin(), id.end(), 0u);
    id_ = Field<std::uint32_t>(id);
    set_ = Field<std::uint8_t>(cloud.set);
    make_room_for_rates();
  }

  /// Number of particles.
  std::size_t size() const { return size_; }

  /// Whether some are those of openings.
  bool has_openings() const { return has_openings_; }

  /// The state, for loops.
  FieldsView<Dim, T> fields() {
    FieldsView<Dim, T> f{.r = {},
                         .rest = {},
                         .v = {},
                         .rho = rho_.data(),
                         .e = e_.data(),
                         .h = h_.data(),
                         .m = m_.data(),
                         .normal = {},
                         .depth = depth_.data(),
                         .patch = patch_.data(),
                         .sheet = sheet_.data(),
                         .id = id_.data(),
                         .set = set_.data()};
    for (int k = 0; k < Dim; ++k) {
      f.r[k] = r_[k].data();
      f.rest[k] = rest_[k].data();
      f.v[k] = v_[k].data();
      f.normal[k] = normal_[k].data();
    }
    return f;
  }

  /// The rates of change, for loops.
  RatesView<Dim, T> rates() {
    RatesView<Dim, T> f{.r = {},
                        .v = {},
                        .rho = rho_rate_.data(),
                        .e = e_rate_.data(),
                        .h = h_rate_.data(),
                        .pairs = pairs_.data(),
                        .falls = falls_.data(),
                        .push = {},
                        .heating = heating_.data()};
    for (int k = 0; k < Dim; ++k) {
      f.r[k] = r_rate_[k].data();
      f.v[k] = v_rate_[k].data();
      f.push[k] = push_[k].data();
    }
    return f;
  }

  /// Records of the present stage, for loops.
  T* records() { return records_.data(); }

  /// Puts the particles into another order: the new particle i is the old order[i].
  void permute(const std::uint32_t* order) {
    for (Field<T>* f : numbers()) {
      if (f == &scratch_) continue;
      Policy::for_each(size_, detail::Gather<T>{f->data(), scratch_.data(), order});
      f->swap(scratch_);
    }
    for (Field<T>* f : optional()) {
      if (f->size() == 0) continue;
      Policy::for_each(size_, detail::Gather<T>{f->data(), scratch_.data(), order});
      f->swap(scratch_);
    }
    gather_anew(id_, order, size_);
    gather_anew(set_, order, size_);
    gather_anew(sheet_, order, size_);
  }

  /// Replaces the particles by n others: the new particle i is a copy of the old order[i], its
  /// record included.
  void select(const std::uint32_t* order, std::size_t n) {
    size_ = n;
    scratch_ = {};
    for (Field<T>* f : numbers()) gather_anew(*f, order, padded());
    for (Field<T>* f : optional()) gather_anew(*f, order, padded());
    scratch_ = Field<T>(padded());
    gather_anew(id_, order, n);
    gather_anew(set_, order, n);
    gather_anew(sheet_, order, n);
    gather_anew(pairs_, order, n);
    gather_anew(falls_, order, n);
    Field<T> records(n * record_size<Dim, T>);
    Policy::for_each(
        n, detail::GatherRows<T, record_size<Dim, T>>{records_.data(), records.data(), order});
    records_ = std::move(records);
  }

  /// The state of all particles, in their order. Rates and records are not part of it.
  template <Archive A>
  void visit_state(A& archive) {
    std::uint64_t n = size_;
    archive("count", n);
    size_ = static_cast<std::size_t>(n);
    const auto show = [&](const std::string& name, auto& field, std::size_t capacity) {
      archive.field(name, field, size_, capacity);
    };
    for (int k = 0; k < Dim; ++k) {
      const char axis = "xyz"[k];
      show(std::string("r_") + axis, r_[k], padded());
      show(std::string("rest_") + axis, rest_[k], padded());
      show(std::string("v_") + axis, v_[k], padded());
      show(std::string("normal_") + axis, normal_[k], padded());
    }
    show("rho", rho_, padded());
    show("e", e_, padded());
    show("h", h_, padded());
    show("m", m_, padded());
    show("depth", depth_, padded());
    show("patch", patch_, padded());
    show("id", id_, size_);
    show("set", set_, size_);
    show("sheet", sheet_, size_);
    if constexpr (A::restores) make_room_for_rates();
  }

  /// Memory held [bytes].
  std::size_t bytes() {
    std::size_t b = records_.bytes() + id_.bytes() + set_.bytes() + pairs_.bytes() +
                    falls_.bytes() + sheet_.bytes();
    for (Field<T>* f : numbers()) b += f->bytes();
    for (Field<T>* f : optional()) b += f->bytes();
    return b;
  }

 private:
  // Loops read whole packs, so fields extend a pack's width beyond the last particle.
  std::size_t padded() const { return size_ + 16; }

  std::vector<Field<T>*> numbers() {
    std::vector<Field<T>*> all{&rho_, &e_, &h_, &m_, &rho_rate_, &e_rate_, &h_rate_, &scratch_};
    for (int k = 0; k < Dim; ++k)
      for (Field<T>* f : {&r_[k], &v_[k], &r_rate_[k], &v_rate_[k]}) all.push_back(f);
    return all;
  }

  std::vector<Field<T>*> optional() {
    std::vector<Field<T>*> all{&depth_, &patch_, &heating_};
    for (int k = 0; k < Dim; ++k)
      for (Field<T>* f : {&normal_[k], &push_[k], &rest_[k]}) all.push_back(f);
    return all;
  }

  void make_room_for_rates() {
    std::vector<Field<T>*> fields{&rho_rate_, &e_rate_, &h_rate_, &scratch_};
    for (int k = 0; k < Dim; ++k) {
      fields.push_back(&r_rate_[k]);
      fields.push_back(&v_rate_[k]);
      if (has_openings_) fields.push_back(&push_[k]);
    }
    if (has_openings_) fields.push_back(&heating_);
    for (Field<T>* f : fields) *f = Field<T>(std::vector<T>(padded()));
    pairs_ = Field<std::uint16_t>(std::vector<std::uint16_t>(size_));
    falls_ = Field<std::uint16_t>(std::vector<std::uint16_t>(size_));
    records_ = Field<T>(size_ * record_size<Dim, T>);
  }

  void put_places(const std::vector<Vec<Dim>>& places, std::vector<T>& column) {
    std::vector<T> rest(padded());
    for (int k = 0; k < Dim; ++k) {
      for (std::size_t i = 0; i < size_; ++i) {
        Vec<1, T> rounded;
        rest[i] = split(Vec<1>{places[i][k]}, rounded)[0];
        column[i] = rounded[0];
      }
      r_[k].upload(column);
      if constexpr (splits_positions<T>) rest_[k] = Field<T>(rest);
    }
  }

  // Into new memory for `capacity` entries.
  template <class U>
  void gather_anew(Field<U>& field, const std::uint32_t* order, std::size_t capacity) {
    if (field.size() == 0) return;
    Field<U> to(capacity);
    Policy::for_each(size_, detail::Gather<U>{field.data(), to.data(), order});
    field = std::move(to);
  }

  std::size_t size_;
  bool has_openings_;
  Field<T> r_[Dim], rest_[Dim], v_[Dim], rho_, e_, h_, m_;
  Field<T> r_rate_[Dim], v_rate_[Dim], rho_rate_, e_rate_, h_rate_;
  Field<std::uint32_t> id_;
  Field<std::uint8_t> set_, sheet_;
  Field<T> normal_[Dim], depth_, patch_;
  Field<T> push_[Dim], heating_;
  Field<std::uint16_t> pairs_, falls_;
  Field<T> records_;
  Field<T> scratch_;
};

}  // namespace sphmbs::particles
