// All that a reader needs to judge or repeat a run: provenance.json and the report print the same.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "studies/engine_table.h"
#include "studies/plan.h"

namespace hookpoint::studies {

struct Provenance {
  std::string study, file, hash;
  bool quick = false;
  std::string hookpoint, compiler;  ///< versions and flags
  std::vector<std::pair<std::string, simulation::EngineDescription>> engines;
  std::vector<std::uint64_t> seeds;
  std::string host, system, machine;
  unsigned cores = 0;
  std::string date;  ///< UTC, ISO 8601
};

/// Of a run of `plan` on this machine, now.
Provenance make_provenance(const StudyPlan& plan, const EngineTable& engines);

/// provenance.json.
std::string provenance_json(const Provenance& provenance);

/// The same as names and values for people: "ode" -> "0.16.2, double precision".
std::vector<std::pair<std::string, std::string>> provenance_lines(const Provenance& provenance);

}  // namespace hookpoint::studies
