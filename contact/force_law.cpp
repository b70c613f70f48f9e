#include "contact/force_law.h"

#include <array>

namespace hookpoint::contact {
namespace {

template <class Law>
constexpr LawDescription describe() {
  return {Law::name, Law::source, Law::summary, false};
}

constexpr std::array laws{
    describe<Hookpoint>(),
    describe<HookpointReset>(),
    describe<Nominal>(),
    describe<HuntCrossley>(),
    describe<AzadFeatherstone>(),
    describe<Lugre>(),
    describe<Elastoplastic>(),
    describe<Exponential>(),
    LawDescription{"impulse", "Mirtich 1996",
                   "event-driven microcollisions with restitution, no penetration: creeps", true},
    LawDescription{"impulse_reversal", "Mirtich 1996",
                   "as impulse, but a rebound inside the cone reverses the whole velocity", true},
};

/// Tries the alternatives of the variant in turn.
template <std::size_t Index = 0>
std::optional<ForceLaw> force_law_named(std::string_view name) {
  if constexpr (Index < std::variant_size_v<ForceLaw>) {
    using Law = std::variant_alternative_t<Index, ForceLaw>;
    if (name == Law::name) return ForceLaw{Law{}};
    return force_law_named<Index + 1>(name);
  } else {
    return std::nullopt;
  }
}

}  // namespace

std::span<const LawDescription> law_table() { return laws; }

const LawDescription* find_law(std::string_view name) {
  for (const LawDescription& law : laws) {
    if (law.name == name) return &law;
  }
  return nullptr;
}

std::optional<ForceLaw> find_force_law(std::string_view name) { return force_law_named(name); }

ForceLaw flow(const ForceLaw& law) {
  if (std::holds_alternative<Hookpoint>(law)) return ReturnFlow<Hookpoint>{};
  if (std::holds_alternative<HookpointReset>(law)) return ThrowFlow<HookpointReset>{};
  if (std::holds_alternative<Nominal>(law)) return ReturnFlow<Nominal>{};
  if (std::holds_alternative<AzadFeatherstone>(law)) return ReturnFlow<AzadFeatherstone>{};
  return law;
}

double static_depth(const ForceLaw& law, double load, const MaterialConstants<double>& material) {
  return std::visit([&](const auto& chosen) { return chosen.static_depth(load, material); }, law);
}

std::optional<double> stick_displacement(const ForceLaw& law, double load, double normal_load,
                                         const MaterialConstants<double>& material) {
  return std::visit(
      [&](const auto& chosen) { return chosen.stick_displacement(load, normal_load, material); },
      law);
}

std::optional<double> creep_speed(const ForceLaw& law, double tangent_of_slope,
                                  const MaterialConstants<double>& material) {
  return std::visit(
      [&](const auto& chosen) { return chosen.creep_speed(tangent_of_slope, material); }, law);
}

double restitution(const ForceLaw& law, double mass, double speed,
                   const MaterialConstants<double>& material) {
  return std::visit([&](const auto& chosen) { return chosen.restitution(mass, speed, material); },
                    law);
}

LinearContact linearise(const ForceLaw& law, double load,
                        const MaterialConstants<double>& material) {
  return std::visit([&](const auto& chosen) { return chosen.linearise(load, material); }, law);
}

double stored_energy(const ForceLaw& law, double depth, const Vector3d& stretch,
                     const MaterialConstants<double>& material) {
  return std::visit(
      [&](const auto& chosen) { return chosen.stored_energy(depth, stretch, material); }, law);
}

double reach(const ForceLaw& law, const MaterialConstants<double>& material) {
  return std::visit([&](const auto& chosen) { return chosen.reach(material); }, law);
}

std::size_t bristle_states(const ForceLaw& law) {
  return std::visit([](const auto& chosen) { return chosen.bristle_states; }, law);
}

double resolved_speed(const ForceLaw& law, double load, double dt,
                      const MaterialConstants<double>& material) {
  return std::visit([&](const auto& chosen) { return chosen.resolved_speed(load, dt, material); },
                    law);
}

double switching_value(const ForceLaw& law, const PointKinematics<double>& point,
                       const Memory<double>& memory, const MaterialConstants<double>& material) {
  return std::visit(
      [&](const auto& chosen) { return switching_value(chosen, point, memory, material); }, law);
}

bool slides_after(const ForceLaw& law, bool falling, const Memory<double>& memory,
                  const MaterialConstants<double>& material) {
  return std::visit(
      [&](const auto& chosen) { return slides_after(chosen, falling, memory, material); }, law);
}

Reaction<double> evaluate(const ForceLaw& law, const PointKinematics<double>& point,
                          const Memory<double>& memory, const MaterialConstants<double>& material,
                          double dt) {
  return std::visit(
      [&](const auto& chosen) { return chosen.evaluate(point, memory, material, dt); }, law);
}

}  // namespace hookpoint::contact
