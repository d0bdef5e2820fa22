// SPDX-License-Identifier: MIT
#include "support/guarded_main.hpp"

#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <string_view>

#include <malloc.h>

#include "sphmbs/core/error.hpp"
#include "support/interruption.hpp"
#include "support/run_control.hpp"
#include "support/text.hpp"

namespace sphmbs::examples {

int guarded_main(int argc, const char* const* argv, Parameters& parameters,
                 const std::function<void(const Settings&)>& run, std::ostream& out,
                 std::ostream& err) {
  const auto end_with = [&](ExitCode code, const std::string& lines) {
    out.flush();
    err << lines << std::endl;
    return static_cast<int>(code);
  };
  const auto line = [](std::string_view id, const std::string& message) {
    return "error " + std::string(id) + " " + message;
  };
  try {
    if (const auto settings = parameters.parse(argc, argv, out)) run(*settings);
    out.flush();
    return static_cast<int>(ExitCode::done);
  } catch (const Stopped& stopped) {
    out << stopped.what() << std::endl;
    return stopped.exit_code();
  } catch (const BadParameters& error) {
    return end_with(ExitCode::bad_input, error.what());
  } catch (const RefusedValue& error) {
    return end_with(ExitCode::bad_input, parameters.located({error}).what());
  } catch (const RefusedValues& error) {
    return end_with(ExitCode::bad_input, parameters.located(error.all).what());
  } catch (const InvalidInput& error) {
    return end_with(ExitCode::bad_input, line(error.id, one_line(error.what())));
  } catch (const NumericalFailure& error) {
    return end_with(ExitCode::numerical_failure, line(error.id, error.what()));
  } catch (const RefusedCheckpoint& error) {
    return end_with(ExitCode::refused_checkpoint, line(error.id, error.what()));
  } catch (const OutputError& error) {
    return end_with(ExitCode::output_failed, line(error.id, error.what()));
  } catch (const std::bad_alloc&) {
    return end_with(ExitCode::out_of_memory,
                    line("E090", "out of memory; " + parameters.memory_advice()));
  } catch (const std::exception& error) {
    return end_with(ExitCode::internal_error, line("E099", error.what()));
  } catch (...) {
    return end_with(ExitCode::internal_error, line("E099", "unknown exception"));
  }
}

int guarded_main(int argc, const char* const* argv, Parameters& parameters,
                 const std::function<void(const Settings&)>& run) {
#if defined(__GLIBC__)
  // Left to itself, glibc raises this threshold with every array that is freed, and then keeps the
  // memory of fields that were written out.
  mallopt(M_MMAP_THRESHOLD, 1 << 20);
#endif
  end_at_signals();
  return guarded_main(argc, argv, parameters, run, std::cout, std::cerr);
}

}  // namespace sphmbs::examples
