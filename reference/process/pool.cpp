#include "reference/process/pool.h"

#include <array>
#include <filesystem>
#include <set>
#include <utility>

#include "output/files/hash.h"
#include "reference/experiment_checks.h"

namespace hookpoint::reference {
namespace {

using simulation::EngineGap;
using enum EngineGap::Handling;

/// Features that protocol 1 cannot express.
constexpr auto protocol_gaps = std::to_array<OwnGap>({
    {feature::loops, refused, "the protocol of programs has no loops; choose engine dts"},
    {feature::couplings, refused, "the protocol of programs has no mimic; choose engine dts"},
    {feature::belt, refused, "the protocol of programs has no belts; choose engine dts"},
    {feature::moving_obstacles, refused,
     "obstacles stand still in the protocol of programs; choose engine dts"},
    {feature::legcone, noticed,
     "the protocol of programs has no cone: its samples touch, as under touch = points"},
    {feature::tile_friction, refused, "use one material"},
    {feature::tile_softness, refused, "use one material"},
    {feature::tile_restitution, refused, "use one material"},
});

std::vector<EngineGap> gaps_and(const std::vector<EngineGap>& own) {
  std::vector<EngineGap> gaps;
  for (const OwnGap& gap : protocol_gaps)
    gaps.push_back({std::string(gap.feature), gap.handling, gap.instead});
  gaps.insert(gaps.end(), own.begin(), own.end());
  return common_gaps_and(std::move(gaps));
}

/// Hash of the command line, of the files among its words, and of the files that the block names.
std::string hash_of_files(const ProgramDefinition& definition) {
  std::set<std::filesystem::path> files;
  for (const std::vector<std::string>& words : {definition.command, definition.files})
    for (const std::string& word : words) {
      std::error_code ignored;
      const std::filesystem::path file = definition.folder / word;
      if (std::filesystem::is_regular_file(file, ignored)) files.insert(file);
    }
  output::Hash hash;
  for (const std::string& word : definition.command) hash.add(word);
  for (const std::filesystem::path& file : files) hash.add(output::hash_of_file(file));
  return hash.text();
}

}  // namespace

simulation::EngineDescription ProgramPool::describe() {
  {
    const std::lock_guard lock(mutex_);
    if (description_) return *description_;
  }
  simulation::EngineDescription description = describe_by_hello();
  const std::lock_guard lock(mutex_);
  if (!description_) description_ = std::move(description);
  return *description_;
}

simulation::EngineDescription ProgramPool::describe_by_hello() {
  simulation::EngineDescription description{.name = definition_.name,
                                            .version = "",
                                            .precision = "",
                                            .found = false,
                                            .settings = definition_.settings,
                                            .gaps = gaps_and({}),
                                            .missing = definition_.refusal,
                                            .program = ""};
  if (!definition_.refusal.empty()) return description;
  try {
    auto program = take();
    const Hello hello = program->hello();
    description.program = hash_of_files(definition_);
    description.version = hello.version;
    description.precision = hello.precision;
    description.constants = hello.constants;
    description.gaps = gaps_and(hello.gaps);
    description.reads = hello.reads;
    if (has_gap(description, feature::two_frictions))
      description.one_friction = description.settings;
    description.found = true;
    give_back(std::move(program));
  } catch (const ProgramError& error) {
    description.missing = error.what();
  }
  return description;
}

std::unique_ptr<Program> ProgramPool::take() {
  {
    const std::lock_guard lock(mutex_);
    if (!idle_.empty()) {
      auto program = std::move(idle_.back());
      idle_.pop_back();
      return program;
    }
  }
  return std::make_unique<Program>(definition_);
}

void ProgramPool::give_back(std::unique_ptr<Program> program) {
  const std::lock_guard lock(mutex_);
  idle_.push_back(std::move(program));
}

}  // namespace hookpoint::reference
