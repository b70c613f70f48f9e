// All that a reader needs to judge or repeat a run: provenance.json and the report print the same.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "output/files/result_folder.h"
#include "studies/measure/engine_table.h"
#include "studies/plan/plan.h"
#include "studies/results/result.h"

namespace hookpoint::studies {

struct Provenance {
  std::string study, file, hash;
  bool quick = false;
  std::string hookpoint, compiler;  ///< versions and flags
  std::string program;              ///< hash of its own bytes
  std::vector<output::InputFile> inputs;
  std::vector<std::pair<std::string, simulation::EngineDescription>> engines;
  std::vector<std::uint64_t> seeds;
  std::string host, system, machine;
  unsigned cores = 0;
  std::string date;  ///< UTC, ISO 8601
};

/// What files.json says of the folder of `plan`; its inputs are in provenance.json.
output::Manifest manifest_of(const StudyPlan& plan);

/// Of a run of `plan` on this machine, now.
Provenance make_provenance(const StudyPlan& plan, const EngineTable& engines);

/// provenance.json.
std::string provenance_json(const Provenance& provenance);

/// What a caption says: "hookpoint 0.1.0, experiment 0123456789ab; ode 0.16.2, mujoco 2.2.2.", with
/// the engines of these subjects.
std::string origin_words(const Provenance& provenance, const std::vector<SubjectInfo>& subjects);

/// The same as names and values for readers: "ode" -> "0.16.2, double precision".
std::vector<std::pair<std::string, std::string>> provenance_lines(const Provenance& provenance);

}  // namespace hookpoint::studies
