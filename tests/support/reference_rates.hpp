// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include <sphmbs/geometry/domain.hpp>
#include <sphmbs/particles/cloud.hpp>

#include "support/rates.hpp"

/// The paper's page written a second time, as plainly as it is printed: every particle meets every
/// other one, in double precision, with nothing of the library but the initial cloud.
namespace test {

struct ReferenceGas {
  double gamma = 1.4;
  double zeta = 0.5;                      // eq. (14)
  std::vector<double> acceleration = {};  // of the gas; empty for none
};

/// What the reference finds, and how large the terms are whose sums these are. Rounding, in the
/// reference and in what it judges, is a share of the latter.
template <int Dim>
struct ReferenceRates {
  Rates<Dim> value;
  std::vector<double> r_size;
  std::vector<double> v_size;
  std::vector<double> rho_size;
  std::vector<double> e_size;
  std::size_t pairs = 0;  // ordered pairs inside the support
};

/// Eq. (10) and its derivative, piece by piece, with the constants that make the integral 1.
template <int Dim>
struct PrintedQuintic {
  static double constant() {
    const double pi = std::acos(-1.0);
    return Dim == 1 ? 1.0 / 120 : Dim == 2 ? 7 / (478 * pi) : 1 / (120 * pi);
  }
  static double value(double R) {
    if (R < 1) return std::pow(3 - R, 5) - 6 * std::pow(2 - R, 5) + 15 * std::pow(1 - R, 5);
    if (R < 2) return std::pow(3 - R, 5) - 6 * std::pow(2 - R, 5);
    if (R < 3) return std::pow(3 - R, 5);
    return 0;
  }
  static double derivative(double R) {
    if (R < 1) return -5 * std::pow(3 - R, 4) + 30 * std::pow(2 - R, 4) - 75 * std::pow(1 - R, 4);
    if (R < 2) return -5 * std::pow(3 - R, 4) + 30 * std::pow(2 - R, 4);
    if (R < 3) return -5 * std::pow(3 - R, 4);
    return 0;
  }
};

/// From a to the nearest image of b.
template <int Dim>
sphmbs::Vec<Dim> nearest_image(const sphmbs::geometry::Domain<Dim>& domain,
                               const sphmbs::Vec<Dim>& a, const sphmbs::Vec<Dim>& b) {
  sphmbs::Vec<Dim> d = b - a;
  for (int k = 0; k < Dim; ++k) {
    if (!domain.periodic[static_cast<std::size_t>(k)]) continue;
    const double period = domain.box.upper[k] - domain.box.lower[k];
    d[k] -= period * std::round(d[k] / period);
  }
  return d;
}

/// Virtual particles have the power of other virtual particles on them, by their mass, in r[0].
template <int Dim>
ReferenceRates<Dim> reference_rates(const ReferenceGas& gas,
                                    const sphmbs::geometry::Domain<Dim>& domain,
                                    const sphmbs::particles::Cloud<Dim>& cloud) {
  using sphmbs::Vec;
  const std::size_t n = cloud.size();
  std::vector<double> c(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double e = cloud.p[i] / ((gas.gamma - 1) * cloud.rho[i]);  // eq. (5)
    c[i] = std::sqrt(gas.gamma * (gas.gamma - 1) * e);               // eq. (7)
  }
  ReferenceRates<Dim> found;
  for (std::size_t a = 0; a < n; ++a) {
    const bool a_is_gas = cloud.set[a] == 0;
    double drho = 0, de = 0, pairs = 0;
    double drho_size = 0, de_size = 0, dv_size = 0, dr_size = 0;
    double layer_power = 0, layer_power_size = 0;
    Vec<Dim> dv = Vec<Dim>::all(0.0);
    Vec<Dim> xsph = Vec<Dim>::all(0.0);
    for (std::size_t b = 0; b < n; ++b) {
      if (b == a) continue;
      const Vec<Dim> d = nearest_image(domain, cloud.r[a], cloud.r[b]);
      const double r = length(d);
      const double h = (cloud.h[a] + cloud.h[b]) / 2;  // eq. (24)
      const double R = r / h;
      if (R >= 3) continue;
      ++pairs;
      const double alpha = PrintedQuintic<Dim>::constant() / std::pow(h, Dim);
      const double W = alpha * PrintedQuintic<Dim>::value(R);
      const double dW = alpha * PrintedQuintic<Dim>::derivative(R);  // by R
      double va = 0, vb = 0;
      for (int k = 0; k < Dim; ++k) {  // eq. (17)
        va += cloud.v[a][k] * d[k] / r;
        vb += cloud.v[b][k] * d[k] / r;
      }
      const double za = cloud.rho[a] * c[a];
      const double zb = cloud.rho[b] * c[b];
      const double p_star =
          (zb * cloud.p[a] + za * cloud.p[b] - za * zb * (vb - va)) / (za + zb);        // eq. (16)
      const double v_star = (za * va + zb * vb + cloud.p[a] - cloud.p[b]) / (za + zb);  // eq. (19)
      const double v_size = std::abs(va) + std::abs(vb) + (cloud.p[a] + cloud.p[b]) / (za + zb);
      const double mass_slope = cloud.m[b] / h * dW;
      const double push = mass_slope * p_star *
                          (1 / (cloud.rho[a] * cloud.rho[a]) + 1 / (cloud.rho[b] * cloud.rho[b]));
      drho += 2 * mass_slope * (v_star - va);  // eq. (20)
      drho_size += 2 * std::abs(mass_slope) * v_size;
      de += push * (v_star - va);  // eq. (22)
      de_size += std::abs(push) * v_size;
      if (a_is_gas || cloud.set[b] == 0) {
        for (int k = 0; k < Dim; ++k) dv[k] += push * d[k] / r;  // eq. (21)
        dv_size += std::abs(push);
      } else {
        layer_power += push * va;
        layer_power_size += std::abs(push * va);
      }
      const double share = cloud.m[b] / ((cloud.rho[a] + cloud.rho[b]) / 2) * W;
      for (int k = 0; k < Dim; ++k)  // eq. (14)
        xsph[k] += share * (cloud.v[a][k] - cloud.v[b][k]);
      dr_size += share * (length(cloud.v[a]) + length(cloud.v[b]));
    }
    Vec<Dim> dr = cloud.v[a];
    if (a_is_gas) {
      for (int k = 0; k < Dim; ++k) dr[k] -= gas.zeta * xsph[k];
      if (!gas.acceleration.empty())
        for (int k = 0; k < Dim; ++k) dv[k] += gas.acceleration[static_cast<std::size_t>(k)];
      dr_size += length(cloud.v[a]);
    } else {
      dr = Vec<Dim>::all(0.0);
      dr[0] = layer_power;
      dr_size = layer_power_size;
    }
    found.value.r.push_back(dr);
    found.value.v.push_back(dv);
    found.value.rho.push_back(drho);
    found.value.e.push_back(de);
    found.value.h.push_back(-cloud.h[a] / (Dim * cloud.rho[a]) * drho);  // eq. (23)
    found.value.pairs.push_back(pairs);
    found.r_size.push_back(dr_size);
    found.v_size.push_back(dv_size + length(dv));
    found.rho_size.push_back(drho_size);
    found.e_size.push_back(de_size);
    found.pairs += static_cast<std::size_t>(pairs);
  }
  return found;
}

/// Largest difference between two sets of rates, as a share of the sizes of the terms.
template <int Dim>
double largest_difference(const Rates<Dim>& a, const Rates<Dim>& b,
                          const ReferenceRates<Dim>& sizes) {
  double worst = 0;
  const auto judge = [&worst](double difference, double size) {
    if (difference == 0) return;
    const double share = std::abs(difference) / size;
    if (!(share <= worst)) worst = share;  // a NaN becomes the worst and stays it
  };
  for (std::size_t i = 0; i < a.size(); ++i) {
    judge(length(a.r[i] - b.r[i]), sizes.r_size[i]);
    judge(length(a.v[i] - b.v[i]), sizes.v_size[i]);
    judge(a.rho[i] - b.rho[i], sizes.rho_size[i]);
    judge(a.e[i] - b.e[i], sizes.e_size[i]);
    const double h_by_rho = sizes.value.rho[i] != 0 ? sizes.value.h[i] / sizes.value.rho[i] : 0;
    judge(a.h[i] - b.h[i], sizes.rho_size[i] * std::abs(h_by_rho));
  }
  return worst;
}

}  // namespace test
