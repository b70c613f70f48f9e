#include "contact/force_law.h"

#include <algorithm>
#include <array>

namespace hookpoint::contact {
namespace {

template <class Law>
const LawDescription& row_of();

template <class Law>
LawDescription describe() {
  static_assert(DescribesItself<Law>);
  LawDescription row;
  row.name = Law::name;
  row.source = Law::source;
  row.summary = Law::summary;
  row.constants = Law::constants;
  row.own_constants = Law::own_constants;
  if constexpr (ForceLaw<Law>) {
    row.normal_constants = Law::normal_constants;
    row.bristle_states = Law::bristle_states;
    row.static_depth = Law::static_depth;
    row.stick_displacement = Law::stick_displacement;
    row.creep_speed = Law::creep_speed;
    row.restitution = Law::restitution;
    row.linearise = Law::linearise;
    row.stored_energy = Law::stored_energy;
    row.reach = Law::reach;
    row.resolved_speed = Law::resolved_speed;
    row.switching_value = Law::RateForm::switching_value;
    row.slides_after = Law::RateForm::slides_after;
    row.evaluate = Law::evaluate;
    row.rate_form = row_of<typename Law::RateForm>;
    row.variant = Law{};
  } else {
    row.is_impulse_law = true;
    row.impulse = {Law::law, Law::creep_speed, Law::impact_rate};
  }
  return row;
}

template <class Law>
const LawDescription& row_of() {
  static const LawDescription row = describe<Law>();
  return row;
}

std::span<const LawDescription> laws() {
  static const std::array all =
      std::apply([](auto... law) { return std::array{describe<decltype(law)>()...}; },
                 std::tuple_cat(NamedForceLaws{}, ImpulseLaws{}));
  return all;
}

/// The law if it is one of that kind.
const LawDescription* of_kind(const LawDescription* law, bool impulse) {
  return law != nullptr && law->is_impulse_law == impulse ? law : nullptr;
}

}  // namespace

bool LawDescription::reads(Constant constant) const {
  return std::ranges::find(constants, constant) != constants.end();
}

std::span<const LawDescription> law_table() { return laws(); }

std::vector<std::string> law_names() {
  std::vector<std::string> names;
  for (const LawDescription& law : laws()) names.emplace_back(law.name);
  return names;
}

const LawDescription* find_law(std::string_view name) {
  const std::span<const LawDescription> all = laws();
  const auto found = std::ranges::find(all, name, &LawDescription::name);
  return found == all.end() ? nullptr : &*found;
}

const LawDescription* find_force_law(std::string_view name) {
  return of_kind(find_law(name), false);
}

const LawDescription* find_impulse_law(std::string_view name) {
  return of_kind(find_law(name), true);
}

}  // namespace hookpoint::contact
