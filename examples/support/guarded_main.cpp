// SPDX-License-Identifier: MIT
#include "support/guarded_main.hpp"

#include <exception>
#include <iostream>
#include <new>
#include <string_view>

#include <malloc.h>

#include "sphmbs/core/error.hpp"
#include "support/run_control.hpp"
#include "support/text.hpp"

namespace sphmbs::examples {

int guarded_main(int argc, const char* const* argv, CommandLine& command_line,
                 const std::function<void(const Settings&)>& run, std::ostream& out,
                 std::ostream& err) {
  const auto end_with = [&](ExitCode code, std::string_view message) {
    out.flush();
    err << "error: " << message << std::endl;
    return static_cast<int>(code);
  };
  try {
    if (const auto settings = command_line.parse(argc, argv, out)) run(*settings);
    out.flush();
    return static_cast<int>(ExitCode::done);
  } catch (const Stopped& stopped) {
    out << stopped.what() << std::endl;
    return stopped.exit_code();
  } catch (const InvalidInput& error) {
    return end_with(ExitCode::bad_input, one_line(error.what()));
  } catch (const NumericalFailure& error) {
    return end_with(ExitCode::numerical_failure, error.what());
  } catch (const OutputError& error) {
    return end_with(ExitCode::output_failed, error.what());
  } catch (const std::bad_alloc&) {
    return end_with(ExitCode::out_of_memory, "out of memory; " + command_line.memory_advice());
  } catch (const std::exception& error) {
    return end_with(ExitCode::internal_error, error.what());
  } catch (...) {
    return end_with(ExitCode::internal_error, "unknown exception");
  }
}

int guarded_main(int argc, const char* const* argv, CommandLine& command_line,
                 const std::function<void(const Settings&)>& run) {
#if defined(__GLIBC__)
  // Left to itself, glibc raises this threshold with every array that is freed, and then keeps the
  // memory of fields that were written out.
  mallopt(M_MMAP_THRESHOLD, 1 << 20);
#endif
  return guarded_main(argc, argv, command_line, run, std::cout, std::cerr);
}

}  // namespace sphmbs::examples
