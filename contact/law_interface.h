// What a force law is: a struct that fulfils the concept ForceLaw below, whole in one file of laws/
// with its equations, memory, constants and closed forms. The list of laws is force_law.h's.
#pragma once

#include <concepts>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string_view>

#include "contact/predictions.h"
#include "contact/vocabulary.h"

namespace hookpoint::contact {

using Constants = MaterialConstants<double>;
/// One of a Material's constants, for a law to declare that it reads it.
using Constant = double Constants::*;
using ConstantList = std::initializer_list<Constant>;

/// The constants that shape a law along the normal: which one to change for another depth at rest
/// or another rebound.
struct NormalConstants {
  Constant stiffness = nullptr;     ///< that static_depth falls with; null: no constant does
  std::string_view stiffness_unit;  ///< of that constant, as this law reads it
  Constant damping = nullptr;       ///< that restitution falls with; null: the law has no damper
};

/// What the table says of a law, force law or impulse law.
template <class Law>
concept DescribesItself = requires {
  // The name that `contact = NAME` selects, whose law it is, and one line that says what it is.
  { Law::name } -> std::convertible_to<std::string_view>;
  { Law::source } -> std::convertible_to<std::string_view>;
  { Law::summary } -> std::convertible_to<std::string_view>;
  // Every constant that the law reads, in its forces or in its predictions.
  { Law::constants } -> std::convertible_to<ConstantList>;
  // Those of them without which a Material was not written for this law: the user is warned of one
  // that states none of them, since their defaults suit no ground in particular.
  { Law::own_constants } -> std::convertible_to<ConstantList>;
};

/// As the step of `evaluate`: the law is a differential equation, for an integrator that chooses
/// its own steps. Every law of such an integrator has dt -> 0.
inline constexpr double differential_equation = 0.;

/// The closed forms of a law: what studies put beside measurements, and scenes, advice and step
/// bounds are computed from. SI; each derived from the law's equations.
template <class Law>
concept Predicts = requires(double number, const Vector3d& stretch, const Constants& material) {
  // (load): penetration under a steady normal load [N] on one point [m].
  { Law::static_depth(number, material) } -> std::same_as<double>;
  // (load, normal_load): elastic shift of a sticking point under a steady tangential load [N]; none
  // without a closed form [m].
  { Law::stick_displacement(number, number, material) } -> std::same_as<std::optional<double>>;
  // (tangent_of_slope): steady speed of a body at rest on a slope; none: it slides away [m/s].
  { Law::creep_speed(number, material) } -> std::same_as<std::optional<double>>;
  // (mass, speed): rebound speed over impact speed of a mass [kg] on one point, no gravity.
  { Law::restitution(number, number, material) } -> std::same_as<double>;
  // (load): stiffness and damping of a point about rest under a load [N].
  { Law::linearise(number, material) } -> std::same_as<LinearContact>;
  // (depth, stretch): energy in the springs of a point [J].
  { Law::stored_energy(number, stretch, material) } -> std::same_as<double>;
  // Height above the ground up to which the law acts [m].
  { Law::reach(material) } -> std::convertible_to<double>;
  // (load, dt): sliding speed up to which a step dt [s] resolves the law's bristle; infinite for a
  // law without one [m/s].
  { Law::resolved_speed(number, number, material) } -> std::same_as<double>;
};

/// What an integrator that chooses its own steps requires. It stops at events, and a law moves its
/// memory once a step; such a law has another form, the differential equation that it becomes as
/// dt -> 0.
template <class Law>
concept HasRateForm = requires(const PointKinematics<double>& point, const Memory<double>& memory,
                               const Constants& material, bool falling) {
  // The law as a differential equation: itself, or a law of the same name; its own rate form.
  requires std::same_as<typename Law::RateForm::RateForm, typename Law::RateForm>;
  requires std::string_view(Law::RateForm::name)
  == std::string_view(Law::name);
  // A number that changes sign where an attached point is at an event: where it comes to stick,
  // breaks away or turns round, and an integrator that stepped across would go on with the wrong
  // equation. `memory` committed.
  { Law::RateForm::switching_value(point, memory, material) } -> std::same_as<double>;
  // Whether the point slides on after the event at which that number has become negative
  // (`falling`) or positive. The state of an event is on the border of sticking and sliding, where
  // rounding would decide; the direction of the crossing tells. `memory` as the law made it there.
  { Law::RateForm::slides_after(falling, memory, material) } -> std::same_as<bool>;
};

/// A force law. All members are static: a law has no state, memory and bristle are passed to it.
/// `evaluate` is a template on the scalar, `double` or a pack of lanes (vocabulary.h).
template <class Law>
concept ForceLaw = std::default_initializable<Law> && DescribesItself<Law> && Predicts<Law> &&
    HasRateForm<Law> && requires(const PointKinematics<double>& point, const Memory<double>& memory,
                                 const Constants& material, double dt) {
  // Which constants shape it along the normal.
  { Law::normal_constants } -> std::convertible_to<NormalConstants>;
  // How many numbers of Bristle the integrator carries for it: 0, 3 (a deflection) or 4.
  requires Law::bristle_states == 0 || Law::bristle_states == 3 || Law::bristle_states == 4;
  // Force on the robot, next memory and bristle rate of one point over a step dt [s], or as a
  // differential_equation. Pure.
  { Law::evaluate(point, memory, material, dt) } -> std::same_as<Reaction<double>>;
};

/// True; where the law lacks something, a message of the compiler that says what.
template <class Law>
constexpr bool fulfils_the_interface() {
  static_assert(ForceLaw<Law>, "the law lacks something of contact/law_interface.h");
  return true;
}

/// What a law without a continuous state inherits.
struct WithoutBristle {
  static constexpr std::size_t bristle_states = 0;
  static double reach(const Constants& /*material*/) { return 0.; }
  static double resolved_speed(double /*load*/, double /*dt*/, const Constants& /*material*/) {
    return std::numeric_limits<double>::infinity();
  }
  /// Its force is a function of position and velocity: no events.
  static double switching_value(const PointKinematics<double>& /*point*/,
                                const Memory<double>& /*memory*/, const Constants& /*material*/) {
    return 1.;
  }
  static bool slides_after(bool /*falling*/, const Memory<double>& memory,
                           const Constants& /*material*/) {
    return memory.sliding;
  }
};

}  // namespace hookpoint::contact
