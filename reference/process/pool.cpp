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

/// What protocol 1 has no word for.
constexpr auto protocol_gaps = std::to_array<OwnGap>({
    {feature::loops, refused, "the protocol of programs has no loops; choose engine dts"},
    {feature::couplings, refused, "the protocol of programs has no mimic; choose engine dts"},
    {feature::belt, refused, "the protocol of programs has no belts; choose engine dts"},
    {feature::moving_obstacles, refused,
     "obstacles stand still in the protocol of programs; choose engine dts"},
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

/// Of the words of its command that are files, and of the files that its block names.
std::string hash_of_files(const ProgramDefinition& definition) {
  std::set<std::filesystem::path> files;
  for (const std::vector<std::string>& words : {definition.command, definition.files})
    for (const std::string& word : words) {
      std::error_code ignored;
      const std::filesystem::path file = definition.folder / word;
      if (std::filesystem::is_regular_file(file, ignored)) files.insert(file);
    }
  output::Hash hash;
  for (const std::filesystem::path& file : files) hash.add(output::hash_of_file(file));
  return hash.text();
}

}  // namespace

simulation::EngineDescription ProgramPool::describe() {
  {
    const std::lock_guard lock(mutex_);
    if (description_) return *description_;
  }
  simulation::EngineDescription description = ask();
  const std::lock_guard lock(mutex_);
  if (!description_) description_ = std::move(description);
  return *description_;
}

simulation::EngineDescription ProgramPool::ask() {
  simulation::EngineDescription description{.name = definition_.name,
                                            .version = "",
                                            .precision = "",
                                            .found = false,
                                            .settings = definition_.settings,
                                            .gaps = gaps_and({}),
                                            .missing = definition_.consent,
                                            .program = ""};
  if (!definition_.consent.empty()) return description;
  try {
    auto program = take();
    const Hello hello = program->hello();
    description.program = hash_of_files(definition_);
    description.version = hello.version;
    description.precision = hello.precision;
    description.constants = hello.constants;
    description.gaps = gaps_and(hello.gaps);
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
    if (!waiting_.empty()) {
      auto program = std::move(waiting_.back());
      waiting_.pop_back();
      return program;
    }
  }
  return std::make_unique<Program>(definition_);
}

void ProgramPool::give_back(std::unique_ptr<Program> program) {
  const std::lock_guard lock(mutex_);
  waiting_.push_back(std::move(program));
}

}  // namespace hookpoint::reference
