// The table of contact laws: what `contact = NAME` may say. A force law is one alternative of
// `ForceLaw`, so that the loop over points is compiled for each law; an impulse law owns its time
// advance and is only listed here.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <variant>

#include "contact/laws/azad_featherstone.h"
#include "contact/laws/elastoplastic.h"
#include "contact/laws/exponential.h"
#include "contact/laws/hook_flow.h"
#include "contact/laws/hookpoint.h"
#include "contact/laws/hookpoint_reset.h"
#include "contact/laws/hunt_crossley.h"
#include "contact/laws/lugre.h"
#include "contact/laws/nominal.h"

namespace hookpoint::contact {

/// The laws that a name can ask for, then the forms that some of them have as differential
/// equations.
using ForceLaw =
    std::variant<Hookpoint, HookpointReset, Nominal, HuntCrossley, AzadFeatherstone, Lugre,
                 Elastoplastic, Exponential, ReturnFlow<Hookpoint>, ThrowFlow<HookpointReset>,
                 ReturnFlow<Nominal>, ReturnFlow<AzadFeatherstone>>;

/// One row of the table.
struct LawDescription {
  std::string_view name;        ///< as in `contact = hookpoint`
  std::string_view source;      ///< whose law it is
  std::string_view summary;     ///< one line
  bool is_impulse_law = false;  ///< event-driven: cannot be paired with RK4 or CVODE
};

/// Every law, force laws first.
std::span<const LawDescription> law_table();

/// The row of a name; null for an unknown name.
const LawDescription* find_law(std::string_view name);

/// The force law of a name; none for an impulse law or an unknown name.
std::optional<ForceLaw> find_force_law(std::string_view name);

/// The law as a differential equation, for an integrator that chooses its own steps: of laws whose
/// memory is moved once a step, the limit of small steps (hook_flow.h); any other law is one.
ForceLaw flow(const ForceLaw& law);

/// The named prediction of the law held by `law`; arguments, units and meaning as in the law's own
/// file.
double static_depth(const ForceLaw& law, double load, const MaterialConstants<double>& material);
std::optional<double> stick_displacement(const ForceLaw& law, double load, double normal_load,
                                         const MaterialConstants<double>& material);
std::optional<double> creep_speed(const ForceLaw& law, double tangent_of_slope,
                                  const MaterialConstants<double>& material);
double restitution(const ForceLaw& law, double mass, double speed,
                   const MaterialConstants<double>& material);
LinearContact linearise(const ForceLaw& law, double load,
                        const MaterialConstants<double>& material);
double stored_energy(const ForceLaw& law, double depth, const Vector3d& stretch,
                     const MaterialConstants<double>& material);

/// Height above the ground up to which the law acts [m].
double reach(const ForceLaw& law, const MaterialConstants<double>& material);
/// How many numbers of Bristle the law integrates: 0, 3 or 4.
std::size_t bristle_states(const ForceLaw& law);
/// Sliding speed [m/s] up to which a step dt [s] resolves the law's bristle under a load [N];
/// infinite for a law without one.
double resolved_speed(const ForceLaw& law, double load, double dt,
                      const MaterialConstants<double>& material);

/// Changes sign where an attached point has to be looked at before its motion goes on
/// (hook_flow.h); `memory` committed.
double switching_value(const ForceLaw& law, const PointKinematics<double>& point,
                       const Memory<double>& memory, const MaterialConstants<double>& material);

/// Whether an attached point slides on after the event at which its switching value has become
/// negative (`falling`) or positive; `memory` as the law made it at that state.
bool slides_after(const ForceLaw& law, bool falling, const Memory<double>& memory,
                  const MaterialConstants<double>& material);

/// Evaluates the law held by `law`; a loop over many points visits once and calls `Law::evaluate`
/// inside instead.
Reaction<double> evaluate(const ForceLaw& law, const PointKinematics<double>& point,
                          const Memory<double>& memory, const MaterialConstants<double>& material,
                          double dt);

}  // namespace hookpoint::contact
