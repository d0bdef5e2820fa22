// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstddef>
#include <string_view>
#include <type_traits>

#include <sphmbs/execution/device.hpp>

/// Execution policies: where particle loops run and where particle fields live. A policy is one
/// header and the only place that knows its pragmas, allocation and copies.
namespace sphmbs::execution {

/// What a loop body may be: plain data with a call operator, copied by value to wherever it runs.
template <class F>
concept LoopBody = std::is_trivially_copyable_v<F>;

/// Stand-in for a loop body in concepts.
struct Nothing {
  /// Does nothing.
  void operator()(std::size_t) const {}
};

/// What a policy offers.
///   name          as users type it
///   Host          the policy for loops of the same program over data of the host
///   lanes<T>      numbers of type T a loop body computes with at once: the pack width on hosts, 1
///                 on devices
///   allocate      memory [bytes] where the loops run; throws std::bad_alloc
///   upload        host to policy memory; download the other way
///   for_each      body(i) for every i < n, in any order and in parallel
///   device        a Device, where the loops run; throws InvalidInput where there is none
///   concurrency   how many loop bodies run at once
///   chunk         items that one loop body of a reduction or a scan takes, one after the other
template <class P>
concept ExecutionPolicy = requires(std::size_t n, void* there, const void* here) {
  { P::name } -> std::convertible_to<std::string_view>;
  { P::template lanes<double> } -> std::convertible_to<int>;
  { P::allocate(n) } -> std::same_as<void*>;
  P::release(there);
  P::upload(there, here, n);
  P::download(there, here, n);
  P::for_each(n, Nothing{});
  { P::device() } -> std::same_as<Device>;
  { P::concurrency() } -> std::convertible_to<int>;
  { P::chunk } -> std::convertible_to<std::size_t>;
  typename P::Host;
};

/// Whether a policy's loops and memory are those of the host.
template <ExecutionPolicy P>
inline constexpr bool on_host = std::is_same_v<P, typename P::Host>;

}  // namespace sphmbs::execution
