// SPDX-License-Identifier: MIT
#include "support/summary.hpp"

#include <cerrno>
#include <cstdio>
#include <system_error>

#include <sys/resource.h>

#include <nlohmann/json.hpp>

#include "sphmbs/core/error.hpp"

namespace sphmbs::examples {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const StructureCounts& structure) {
  return {{"coordinates", structure.coordinates},
          {"conditions", structure.conditions},
          {"redundant", structure.redundant},
          {"iterations", structure.iterations},
          {"factorisations", structure.factorisations},
          {"halvings", structure.halvings},
          {"rejected", structure.rejected},
          {"violation", structure.violation}};
}

Json to_json(const Summary& summary) {
  Json phases = Json::object();
  for (const Phase& phase : summary.phases) phases[phase.name] = phase.seconds;
  Json results = Json::object();
  for (const Result& result : summary.results) {
    results[result.name] = {{"value", result.value},
                            {"reference", result.reference ? Json(*result.reference) : Json()},
                            {"unit", result.unit}};
  }
  const bool gas = has_gas(summary);
  Json json = {{"case", summary.case_name},
               {"version", summary.version},
               {"backend", summary.backend},
               {"threads", summary.threads}};
  if (gas)
    json["particles"] = {{"gas", summary.particles.gas},
                         {"virtual", summary.particles.virtual_particles}};
  if (summary.structure) json["structure"] = to_json(*summary.structure);
  if (summary.bus)
    json["bus"] = {{"bytes_per_step", summary.bus->bytes_per_step},
                   {"bytes_per_particle_and_step", summary.bus->bytes_per_particle_and_step},
                   {"loops_per_step", summary.bus->loops_per_step},
                   {"argument_bytes_per_step", summary.bus->argument_bytes_per_step}};
  json["steps"] = summary.steps;
  json["time_end"] = summary.time_end;
  json["wall_seconds"] = summary.wall_seconds;
  json["phases"] = phases;
  if (gas) {
    json["pair_interactions"] = summary.pair_interactions;
    json["pair_interactions_per_second"] = pair_interactions_per_second(summary);
  }
  json["peak_memory_bytes"] = summary.peak_memory_bytes;
  Json conservation = Json::object();
  if (gas) {
    conservation["mass"] = summary.conservation.mass;
    conservation["momentum"] = summary.conservation.momentum;
  }
  conservation["energy"] = summary.conservation.energy;
  json["conservation"] = conservation;
  if (gas) {
    const Incidents& met = summary.incidents;
    json["incidents"] = {{"particles_lost", met.lost},
                         {"steps_retried", met.retries},
                         {"reconstructions_refused", met.refused}};
    if (met.leaked) json["incidents"]["particles_leaked"] = *met.leaked;
  }
  json["results"] = results;
  return json;
}

}  // namespace

double pair_interactions_per_second(const Summary& summary) {
  if (!(summary.wall_seconds > 0.0)) return 0.0;
  return static_cast<double>(summary.pair_interactions) / summary.wall_seconds;
}

std::uint64_t peak_memory() {
  rusage usage{};
  if (::getrusage(RUSAGE_SELF, &usage) != 0) return 0;
#if defined(__APPLE__)
  constexpr std::uint64_t unit = 1;
#else
  constexpr std::uint64_t unit = 1024;
#endif
  return static_cast<std::uint64_t>(usage.ru_maxrss) * unit;
}

void write_summary(const std::filesystem::path& path, const Summary& summary) {
  const std::string text =
      to_json(summary).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";

  std::filesystem::path temporary = path;
  temporary += ".tmp";
  const auto last_error = [] { return std::error_code(errno, std::generic_category()); };
  std::error_code reason;
  if (std::FILE* const file = std::fopen(temporary.c_str(), "wb")) {
    if (std::fwrite(text.data(), 1, text.size(), file) != text.size()) reason = last_error();
    if (std::fclose(file) != 0 && !reason) reason = last_error();
    if (!reason) std::filesystem::rename(temporary, path, reason);
    if (reason) {
      std::error_code ignored;
      std::filesystem::remove(temporary, ignored);
    }
  } else {
    reason = last_error();
  }
  if (reason) throw OutputError("cannot write " + path.string() + ": " + reason.message());
}

}  // namespace sphmbs::examples
