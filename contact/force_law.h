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

/// One row of the table.
struct LawDescription {
  std::string_view name;         ///< as in `contact = hookpoint`
  std::string_view source;       ///< whose law it is
  std::string_view summary;      ///< one line
  ConstantList constants;        ///< those of a Material that it reads
  ConstantList own_constants;    ///< those without which a Material was not written for it
  NormalConstants along_normal;  ///< of a force law
  bool is_impulse_law = false;   ///< event-driven: cannot be paired with an integrator
};

/// Every law, force laws first.
std::span<const LawDescription> law_table();

/// Their names, in that order.
std::vector<std::string> law_names();

/// The row of a name; null for an unknown name.
const LawDescription* find_law(std::string_view name);

/// The force law of a name; none for an impulse law or an unknown name.
std::optional<AnyForceLaw> find_force_law(std::string_view name);

/// The impulse law of a name; none for a force law or an unknown name.
std::optional<ImpulseLaw> find_impulse_law(std::string_view name);

/// The law as a differential equation, for an integrator that chooses its own steps.
AnyForceLaw rate_form(const AnyForceLaw& law);

/// The constants that shape the law along the normal.
NormalConstants normal_constants(const AnyForceLaw& law);
/// Whether the law reads the constant.
bool reads(const AnyForceLaw& law, Constant constant);

/// The named prediction of the law held by `law`; arguments, units and meaning as in the law's own
/// file.
double static_depth(const AnyForceLaw& law, double load, const MaterialConstants<double>& material);
std::optional<double> stick_displacement(const AnyForceLaw& law, double load, double normal_load,
                                         const MaterialConstants<double>& material);
std::optional<double> creep_speed(const AnyForceLaw& law, double tangent_of_slope,
                                  const MaterialConstants<double>& material);
double restitution(const AnyForceLaw& law, double mass, double speed,
                   const MaterialConstants<double>& material);
LinearContact linearise(const AnyForceLaw& law, double load,
                        const MaterialConstants<double>& material);
double stored_energy(const AnyForceLaw& law, double depth, const Vector3d& stretch,
                     const MaterialConstants<double>& material);

/// The same of an impulse law (impulse.h).
std::optional<double> creep_speed(ImpulseLaw law, double tangent_of_slope, bool single_point,
                                  const MaterialConstants<double>& material);
std::optional<double> impact_rate(ImpulseLaw law, double gravity,
                                  const MaterialConstants<double>& material);

/// Height above the ground up to which the law acts [m].
double reach(const AnyForceLaw& law, const MaterialConstants<double>& material);
/// How many numbers of Bristle the law integrates: 0, 3 or 4.
std::size_t bristle_states(const AnyForceLaw& law);
/// Sliding speed [m/s] up to which a step dt [s] resolves the law's bristle under a load [N];
/// infinite for a law without one.
double resolved_speed(const AnyForceLaw& law, double load, double dt,
                      const MaterialConstants<double>& material);

/// The events of a rate form (HasRateForm).
double switching_value(const AnyForceLaw& law, const PointKinematics<double>& point,
                       const Memory<double>& memory, const MaterialConstants<double>& material);
bool slides_after(const AnyForceLaw& law, bool falling, const Memory<double>& memory,
                  const MaterialConstants<double>& material);

/// Evaluates the law held by `law`; a loop over many points visits once and calls `Law::evaluate`
/// inside instead.
Reaction<double> evaluate(const AnyForceLaw& law, const PointKinematics<double>& point,
                          const Memory<double>& memory, const MaterialConstants<double>& material,
                          double dt);

}  // namespace hookpoint::contact
