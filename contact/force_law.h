// The contact laws: what `contact = NAME` may say. A law is added by its file and its name in the
// list NamedForceLaws; the table, the variant and all that reads them follow from it
// (docs/adding_a_law.md).
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "contact/impulse/impulse.h"
#include "contact/impulse/impulse_reversal.h"
#include "contact/law_interface.h"
#include "contact/laws/azad_featherstone.h"
#include "contact/laws/elastoplastic.h"
#include "contact/laws/exponential.h"
#include "contact/laws/hookpoint.h"
#include "contact/laws/hookpoint_reset.h"
#include "contact/laws/hunt_crossley.h"
#include "contact/laws/lugre.h"
#include "contact/laws/nominal.h"

namespace hookpoint::contact {

/// The force laws, in the order of the table.
using NamedForceLaws = std::tuple<Hookpoint, HookpointReset, Nominal, HuntCrossley,
                                  AzadFeatherstone, Lugre, Elastoplastic, Exponential>;

template <class... Law>
constexpr bool all_fulfil_the_interface(std::tuple<Law...> /*laws*/) {
  return (fulfils_the_interface<Law>() && ...);
}
static_assert(all_fulfil_the_interface(NamedForceLaws{}));

/// The impulse laws, which own the advance of time; their rows of the table follow.
using ImpulseLaws = std::tuple<Impulse, ImpulseReversal>;

/// Of a list of laws, the rate forms that are not laws of the list themselves.
template <class... Law>
auto rate_forms(std::tuple<Law...>) -> decltype(std::tuple_cat(
    std::declval<std::conditional_t<std::is_same_v<typename Law::RateForm, Law>, std::tuple<>,
                                    std::tuple<typename Law::RateForm>>>()...));
using RateForms = decltype(rate_forms(std::declval<NamedForceLaws>()));
static_assert(all_fulfil_the_interface(RateForms{}));

template <class... Law, class... Form>
auto one_of(std::tuple<Law...>, std::tuple<Form...>) -> std::variant<Law..., Form...>;
/// One force law or rate form: a variant, so that a loop over points is compiled for each of them.
using AnyForceLaw = decltype(one_of(std::declval<NamedForceLaws>(), std::declval<RateForms>()));

/// One row of the table: what a law says of itself, and its closed forms as functions. Arguments,
/// units and meaning of the functions are those of the law's own file (law_interface.h).
struct LawDescription {
  std::string_view name;        ///< as in `contact = hookpoint`
  std::string_view source;      ///< whose law it is
  std::string_view summary;     ///< one line
  ConstantList constants;       ///< those of a Material that it reads
  ConstantList own_constants;   ///< those without which a Material was not written for it
  bool is_impulse_law = false;  ///< event-driven: cannot be paired with an integrator

  // Of a force law. The functions are null for an impulse law.

  NormalConstants normal_constants;
  std::size_t bristle_states = 0;  ///< numbers of Bristle that the law integrates: 0, 3 or 4
  double (*static_depth)(double load, const Constants& material) = nullptr;
  std::optional<double> (*stick_displacement)(double load, double normal_load,
                                              const Constants& material) = nullptr;
  std::optional<double> (*creep_speed)(double tangent_of_slope,
                                       const Constants& material) = nullptr;
  double (*restitution)(double mass, double speed, const Constants& material) = nullptr;
  LinearContact (*linearise)(double load, const Constants& material) = nullptr;
  double (*stored_energy)(double depth, const Vector3d& stretch,
                          const Constants& material) = nullptr;
  double (*reach)(const Constants& material) = nullptr;
  double (*resolved_speed)(double load, double dt, const Constants& material) = nullptr;
  double (*switching_value)(const PointKinematics<double>& point, const Memory<double>& memory,
                            const Constants& material) = nullptr;
  bool (*slides_after)(bool falling, const Memory<double>& memory,
                       const Constants& material) = nullptr;
  Reaction<double> (*evaluate)(const PointKinematics<double>& point, const Memory<double>& memory,
                               const Constants& material, const double& dt) = nullptr;
  /// The row of the law as a differential equation, for an integrator that chooses its own steps.
  const LawDescription& (*rate_form)() = nullptr;
  /// The law as a type: a loop over many points visits it once and calls `Law::evaluate` inside.
  AnyForceLaw variant;

  // Of an impulse law.

  /// Which one it is, and its closed forms (impulse.h).
  struct OfImpulse {
    ImpulseLaw law;
    std::optional<double> (*creep_speed)(double tangent_of_slope, bool single_point,
                                         const Constants& material) = nullptr;
    std::optional<double> (*impact_rate)(double gravity, const Constants& material) = nullptr;
  };
  std::optional<OfImpulse> impulse;

  /// Whether the law reads the constant.
  bool reads(Constant constant) const;
};

/// Every law, force laws first.
std::span<const LawDescription> law_table();

/// Their names, in that order.
std::vector<std::string> law_names();

/// The row of a name; null for an unknown name.
const LawDescription* find_law(std::string_view name);

/// The row of a force law; null for an impulse law or an unknown name.
const LawDescription* find_force_law(std::string_view name);

/// The row of an impulse law; null for a force law or an unknown name.
const LawDescription* find_impulse_law(std::string_view name);

}  // namespace hookpoint::contact
