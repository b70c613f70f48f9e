#include "simulation/run/saved_state.h"

#include <bit>
#include <cstring>
#include <vector>

#include "output/files/hash.h"
#include "output/records/mcap_records.h"
#include "simulation/engine_interface/identity.h"
#include "simulation/run/movies.h"

namespace hookpoint::simulation {
namespace {

// Mark, 32 digits of the experiment's hash, the numbers, CRC-32 of all before: little-endian.
static_assert(std::endian::native == std::endian::little);
constexpr std::string_view state_mark = "hookpoint state 1\n";
constexpr std::size_t identity_digits = 32;
constexpr std::size_t head_bytes = state_mark.size() + identity_digits;

std::size_t bytes_of(std::size_t numbers) {
  return head_bytes + numbers * sizeof(double) + sizeof(std::uint32_t);
}

}  // namespace

StateBytes::StateBytes(const std::string& text, const Experiment& experiment, const World& world) {
  output::Hash hash;
  hash.add(experiment_hash(text, experiment)).add(std::to_string(experiment.seed));
  identity_ = hash.add(layout_text(world.state_layout())).text();
}

std::string StateBytes::of(const World& world) const {
  std::vector<double> numbers(world.state_size());
  world.save(numbers);
  std::string bytes;
  bytes.reserve(bytes_of(numbers.size()));
  bytes.append(state_mark).append(identity_);
  bytes.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(double));
  const std::uint32_t checksum = output::mcap::crc32(bytes);
  return bytes.append(reinterpret_cast<const char*>(&checksum), sizeof checksum);
}

void StateBytes::restore(std::string_view bytes, World& world) const {
  if (!bytes.starts_with(state_mark))
    throw ExperimentError("these bytes are no state of a world: they do not begin as one");
  const std::size_t end = bytes.size() - sizeof(std::uint32_t);
  std::uint32_t checksum = 0;
  if (bytes.size() >= bytes_of(0)) std::memcpy(&checksum, &bytes[end], sizeof checksum);
  if (bytes.size() < bytes_of(0) || checksum != output::mcap::crc32(bytes.substr(0, end)))
    throw ExperimentError("the state is damaged: its checksum is not that of its bytes");
  std::vector<double> numbers(world.state_size());
  if (bytes.substr(state_mark.size(), identity_digits) != identity_ ||
      bytes.size() != bytes_of(numbers.size()))
    throw ExperimentError(
        "the state is of another experiment: its file, settings, seed, engine or the files that it "
        "reads differ");
  std::memcpy(numbers.data(), &bytes[head_bytes], numbers.size() * sizeof(double));
  world.restore(numbers);
}

}  // namespace hookpoint::simulation
