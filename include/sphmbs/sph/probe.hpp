// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <sphmbs/execution/reduce.hpp>
#include <sphmbs/execution/scan.hpp>
#include <sphmbs/neighbours/cell_list.hpp>
#include <sphmbs/sph/fluid.hpp>
#include <sphmbs/sph/local_gas.hpp>
#include <sphmbs/sph/point_grid.hpp>

/// Probes: the gas at points, and in a box. Both take the state at Fluid::time(), in one pass over
/// the particles and in double precision, and give the same bits for any number of threads.
namespace sphmbs::sph {

namespace detail {

/// Finds the points that a particle's support covers, through any period.
template <int Dim, class T>
struct PointsCovered {
  particles::FieldsView<Dim, T> fields;
  geometry::Periodicity<Dim, double> space;
  PointGridView<Dim> grid;
  double support;

  template <class Visit>
  SPHMBS_INLINE void visit(std::size_t i, const Visit& visit) const {
    if (particles::is_virtual(fields.set[i])) return;
    const Vec<Dim> x = fields.place(i);
    const double reach = support * static_cast<double>(fields.h[i]);
    int begin[3] = {0, 0, 0};  // images along each axis
    int end[3] = {0, 0, 0};
    for (int k = 0; k < Dim; ++k) {
      if (space.length[k] > 0) {
        begin[k] = x[k] - space.length[k] + reach >= grid.lower[k] ? -1 : 0;
        end[k] = x[k] + space.length[k] - reach <= grid.upper[k] ? 1 : 0;
      } else if (x[k] + reach < grid.lower[k] || x[k] - reach > grid.upper[k]) {
        return;
      }
    }
    for (int c = begin[2]; c <= end[2]; ++c)
      for (int b = begin[1]; b <= end[1]; ++b)
        for (int a = begin[0]; a <= end[0]; ++a) {
          const int shift[3] = {a, b, c};
          Vec<Dim> image = x;
          for (int k = 0; k < Dim; ++k) image[k] += shift[k] * space.length[k];
          grid.visit_near(image, reach, visit);
        }
  }
};

template <int Dim, class T>
struct CountAtPoints {
  PointsCovered<Dim, T> covered;
  std::uint32_t* count;
  SPHMBS_INLINE void operator()(std::size_t i) const {
    covered.visit(i,
                  [&](std::uint32_t p) SPHMBS_INLINE_LAMBDA { atomic::fetch_add(count + p, 1); });
  }
};

template <int Dim, class T>
struct ListAtPoints {
  PointsCovered<Dim, T> covered;
  const std::uint32_t* first;
  std::uint32_t* placed;
  std::uint32_t* list;
  SPHMBS_INLINE void operator()(std::size_t i) const {
    covered.visit(i, [&](std::uint32_t p) SPHMBS_INLINE_LAMBDA {
      list[first[p] + atomic::fetch_add(placed + p, 1)] = static_cast<std::uint32_t>(i);
    });
  }
};

template <kernels::Kernel Kernel, class T, class Eos>
struct SumAtPoint {
  static constexpr int dim = Kernel::dim;
  WeighGas<dim, T, Eos> gas;
  geometry::Periodicity<dim, double> space;
  const Vec<dim>* points;
  const std::uint32_t* first;
  const std::uint32_t* list;
  GasSum<dim>* sums;

  SPHMBS_INLINE void operator()(std::size_t p) const {
    GasSum<dim> sum;
    for (std::uint32_t k = first[p]; k < first[p + 1]; ++k) {
      const std::uint32_t i = list[k];
      const double r = math::sqrt(norm2(space.nearest(points[p] - gas.fields.place(i))));
      const double weight =
          gas.volume(i) * kernels::value<Kernel>(r, 1 / static_cast<double>(gas.fields.h[i]));
      if (weight > 0) gas.add(sum, i, weight);
    }
    sums[p] = sum;
  }
};

template <int Dim, class T, class Eos>
struct SumInBox {
  WeighGas<Dim, T, Eos> gas;
  geometry::Periodicity<Dim, double> space;
  geometry::Box<Dim> box;

  SPHMBS_INLINE GasSum<Dim> operator()(std::size_t i) const {
    const auto& fields = gas.fields;
    GasSum<Dim> sum;
    if (fields.set[i] != particles::gas || !holds(fields.place(i))) return sum;
    gas.add(sum, i, gas.volume(i));
    const double m = static_cast<double>(fields.m[i]);
    const Vec<Dim> v = fields.velocity(i).template to<double>();
    sum.mass = m;
    sum.momentum = m * v;
    sum.kinetic = 0.5 * m * norm2(v);
    sum.internal = m * static_cast<double>(fields.e[i]);
    return sum;
  }

 private:
  // Boxes that touch share no particle: the upper faces belong to the next one.
  SPHMBS_INLINE bool holds(const Vec<Dim>& x) const {
    bool inside = true;
    for (int k = 0; k < Dim; ++k) {
      double d = x[k] - box.lower[k];
      if (space.length[k] > 0) d -= space.length[k] * math::floor(d / space.length[k]);
      inside = inside && d >= 0 && d < box.upper[k] - box.lower[k];
    }
    return inside;
  }
};

}  // namespace detail

/// The gas at each of the points, at fluid.time(). Points beyond a period are those of their image;
/// there may be many: particles are gone through twice, whatever their number.
/// @throws InvalidInput for no points or one that is not finite.
template <class Scheme, class Policy, class Motion, class T>
std::vector<LocalGas<Scheme::dim>> gas_at(Fluid<Scheme, Policy, Motion, T>& fluid,
                                          std::span<const Vec<Scheme::dim>> points) {
  constexpr int dim = Scheme::dim;
  using Kernel = typename Scheme::Kernel;
  std::vector<Vec<dim>> inside(points.begin(), points.end());
  fluid.domain().wrap(inside);
  const PointGrid<dim, Policy> grid(inside);
  const std::size_t n = grid.size();
  const auto fields = fluid.particles().fields();
  const auto space = fluid.domain().template periodicity<double>();
  const detail::PointsCovered<dim, T> covered{fields, space, grid.view(), Kernel::support};

  execution::Field<std::uint32_t, Policy> count(n), first(n + 1);
  Policy::for_each(n, neighbours::detail::Zero{count.data()});
  Policy::for_each(fluid.size(), detail::CountAtPoints<dim, T>{covered, count.data()});
  const auto seen = execution::exclusive_scan<Policy>(n, count.data(), first.data());
  execution::Field<std::uint32_t, Policy> list(seen);
  Policy::for_each(n, neighbours::detail::Zero{count.data()});
  Policy::for_each(fluid.size(),
                   detail::ListAtPoints<dim, T>{covered, first.data(), count.data(), list.data()});
  // In the order of ids, sums do not depend on where particles lie in memory.
  Policy::for_each(n, neighbours::detail::SortCell{first.data(), fields.id, list.data()});
  execution::Field<detail::GasSum<dim>, Policy> sums(n);
  using Eos = decltype(fluid.scheme().eos);
  Policy::for_each(n, detail::SumAtPoint<Kernel, T, Eos>{{fields, fluid.scheme().eos},
                                                         space,
                                                         covered.grid.points,
                                                         first.data(),
                                                         list.data(),
                                                         sums.data()});
  std::vector<LocalGas<dim>> found(n);
  const auto host = sums.download();
  for (std::size_t p = 0; p < n; ++p) found[grid.place()[p]] = host[p].mean();
  return found;
}

/// The gas at a point.
template <class Fluid>
LocalGas<Fluid::dim> gas_at(Fluid& fluid, const Vec<Fluid::dim>& point) {
  return gas_at(fluid, std::span<const Vec<Fluid::dim>>(&point, 1)).front();
}

/// The gas whose particles are in a box, at fluid.time(). The box may reach across the border of a
/// period.
/// @throws InvalidInput for a box that is empty, not finite, or longer than a period.
template <class Scheme, class Policy, class Motion, class T>
GasInside<Scheme::dim> gas_inside(Fluid<Scheme, Policy, Motion, T>& fluid,
                                  const geometry::Box<Scheme::dim>& box) {
  constexpr int dim = Scheme::dim;
  const auto space = fluid.domain().template periodicity<double>();
  for (int k = 0; k < dim; ++k) {
    const double length = box.length(k);
    expects(std::isfinite(length) && length > 0, "length of a probe's box", length,
            "positive and finite [m]");
    expects(space.length[k] == 0 || length <= space.length[k] * (1 + 1e-12),
            "length of a probe's box", length, "at most the period [m]");
  }
  using Eos = decltype(fluid.scheme().eos);
  const auto sum = execution::reduce<Policy>(
      fluid.size(), detail::GasSum<dim>{},
      detail::SumInBox<dim, T, Eos>{{fluid.particles().fields(), fluid.scheme().eos}, space, box});
  GasInside<dim> inside{.particles = sum.seen,
                        .mass = sum.mass,
                        .volume = sum.weight,
                        .momentum = sum.momentum,
                        .kinetic = sum.kinetic,
                        .internal = sum.internal,
                        .mean = sum.mean()};
  inside.mean.share = std::numeric_limits<double>::quiet_NaN();
  return inside;
}

}  // namespace sphmbs::sph
