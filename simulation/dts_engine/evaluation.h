// For what a contact law is evaluated.
#pragma once

namespace hookpoint::simulation {

/// At which state the law is evaluated: one that the run accepts, whose memories are to be kept and
/// whose forces are published, or a trial of the integrator's, which leaves no trace but its
/// forces.
enum class Evaluation { accepted, trial };

}  // namespace hookpoint::simulation
