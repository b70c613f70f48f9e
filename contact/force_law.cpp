#include "contact/force_law.h"

#include <algorithm>
#include <array>

namespace hookpoint::contact {
namespace {

template <class Law>
constexpr LawDescription describe() {
  static_assert(DescribesItself<Law>);
  LawDescription row{Law::name,          Law::source, Law::summary, Law::constants,
                     Law::own_constants, {},          true};
  if constexpr (ForceLaw<Law>) {
    row.along_normal = Law::normal_constants;
    row.is_impulse_law = false;
  }
  return row;
}

constexpr std::array laws =
    std::apply([](auto... law) { return std::array{describe<decltype(law)>()...}; },
               std::tuple_cat(NamedForceLaws{}, ImpulseLaws{}));

/// Calls `use` with the law of the list that has the name, if there is one.
template <class List, class Use>
void with_named(std::string_view name, Use use) {
  std::apply([&](auto... law) { ((name == law.name ? use(law) : void()), ...); }, List{});
}

/// What `use` says of the impulse law.
template <class Use>
auto of_impulse_law(ImpulseLaw which, Use use) {
  decltype(use(Impulse{})) said{};
  std::apply([&](auto... law) { ((law.law == which ? void(said = use(law)) : void()), ...); },
             ImpulseLaws{});
  return said;
}

}  // namespace

std::span<const LawDescription> law_table() { return laws; }

std::vector<std::string> law_names() {
  std::vector<std::string> names;
  for (const LawDescription& law : laws) names.emplace_back(law.name);
  return names;
}

const LawDescription* find_law(std::string_view name) {
  for (const LawDescription& law : laws) {
    if (law.name == name) return &law;
  }
  return nullptr;
}

std::optional<AnyForceLaw> find_force_law(std::string_view name) {
  std::optional<AnyForceLaw> found;
  with_named<NamedForceLaws>(name, [&](auto law) { found = law; });
  return found;
}

std::optional<ImpulseLaw> find_impulse_law(std::string_view name) {
  std::optional<ImpulseLaw> found;
  with_named<ImpulseLaws>(name, [&](auto law) { found = law.law; });
  return found;
}

AnyForceLaw rate_form(const AnyForceLaw& law) {
  return std::visit([]<class Law>(const Law&) -> AnyForceLaw { return typename Law::RateForm{}; },
                    law);
}

NormalConstants normal_constants(const AnyForceLaw& law) {
  return std::visit([](const auto& chosen) { return chosen.normal_constants; }, law);
}

bool reads(const AnyForceLaw& law, Constant constant) {
  return std::visit(
      [&](const auto& chosen) { return std::ranges::count(chosen.constants, constant) > 0; }, law);
}

double static_depth(const AnyForceLaw& law, double load,
                    const MaterialConstants<double>& material) {
  return std::visit([&](const auto& chosen) { return chosen.static_depth(load, material); }, law);
}

std::optional<double> stick_displacement(const AnyForceLaw& law, double load, double normal_load,
                                         const MaterialConstants<double>& material) {
  return std::visit(
      [&](const auto& chosen) { return chosen.stick_displacement(load, normal_load, material); },
      law);
}

std::optional<double> creep_speed(const AnyForceLaw& law, double tangent_of_slope,
                                  const MaterialConstants<double>& material) {
  return std::visit(
      [&](const auto& chosen) { return chosen.creep_speed(tangent_of_slope, material); }, law);
}

double restitution(const AnyForceLaw& law, double mass, double speed,
                   const MaterialConstants<double>& material) {
  return std::visit([&](const auto& chosen) { return chosen.restitution(mass, speed, material); },
                    law);
}

LinearContact linearise(const AnyForceLaw& law, double load,
                        const MaterialConstants<double>& material) {
  return std::visit([&](const auto& chosen) { return chosen.linearise(load, material); }, law);
}

double stored_energy(const AnyForceLaw& law, double depth, const Vector3d& stretch,
                     const MaterialConstants<double>& material) {
  return std::visit(
      [&](const auto& chosen) { return chosen.stored_energy(depth, stretch, material); }, law);
}

std::optional<double> creep_speed(ImpulseLaw law, double tangent_of_slope, bool single_point,
                                  const MaterialConstants<double>& material) {
  return of_impulse_law(law, [&](auto chosen) {
    return chosen.creep_speed(tangent_of_slope, single_point, material);
  });
}

std::optional<double> impact_rate(ImpulseLaw law, double gravity,
                                  const MaterialConstants<double>& material) {
  return of_impulse_law(law, [&](auto chosen) { return chosen.impact_rate(gravity, material); });
}

double reach(const AnyForceLaw& law, const MaterialConstants<double>& material) {
  return std::visit([&](const auto& chosen) { return chosen.reach(material); }, law);
}

std::size_t bristle_states(const AnyForceLaw& law) {
  return std::visit([](const auto& chosen) { return chosen.bristle_states; }, law);
}

double resolved_speed(const AnyForceLaw& law, double load, double dt,
                      const MaterialConstants<double>& material) {
  return std::visit([&](const auto& chosen) { return chosen.resolved_speed(load, dt, material); },
                    law);
}

double switching_value(const AnyForceLaw& law, const PointKinematics<double>& point,
                       const Memory<double>& memory, const MaterialConstants<double>& material) {
  return std::visit(
      [&](const auto& chosen) { return chosen.switching_value(point, memory, material); }, law);
}

bool slides_after(const AnyForceLaw& law, bool falling, const Memory<double>& memory,
                  const MaterialConstants<double>& material) {
  return std::visit(
      [&](const auto& chosen) { return chosen.slides_after(falling, memory, material); }, law);
}

Reaction<double> evaluate(const AnyForceLaw& law, const PointKinematics<double>& point,
                          const Memory<double>& memory, const MaterialConstants<double>& material,
                          double dt) {
  return std::visit(
      [&](const auto& chosen) { return chosen.evaluate(point, memory, material, dt); }, law);
}

}  // namespace hookpoint::contact
