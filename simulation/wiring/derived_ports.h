// Values that follow from what every engine publishes. Each group is worked out only from the
// moment on when one of it is requested.
#pragma once

#include <vector>

#include "simulation/engine_interface/robot_sums.h"
#include "simulation/wiring/energy_balance.h"
#include "simulation/wiring/joint_bias.h"
#include "simulation/wiring/ports.h"

namespace hookpoint::simulation {

class DerivedPorts {
 public:
  /// Both outlive it. Throws nothing.
  DerivedPorts(const Experiment& experiment, Engine& engine);
  DerivedPorts(const DerivedPorts&) = delete;
  DerivedPorts& operator=(const DerivedPorts&) = delete;

  /// The groups that are requested, at the engine's present state; after every step. Allocates
  /// nothing.
  void update();

  /// Whether every number that was requested is finite.
  bool finite() const { return finite_; }
  /// The engine's state has become another one: differences restart.
  void restart();

  struct BodyValues {
    Vector3d acceleration,
        angular_acceleration;  ///< mean over the last step, world axes; at first 0
    double contacts = 0.;      ///< boundary points that carried force
  };
  const RobotSums& robot(std::size_t i) const { return robots_[i]; }
  const double& numerical_energy(std::size_t i) const { return numerical_[i]; }
  const BodyValues& body(std::size_t i) const { return bodies_[i]; }

  const JointBiasValues& joint(std::size_t i) const { return joint_bias_.values()[i]; }

  Lazy& energies() { return energies_; }
  /// The robots' numerical energies; their balance begins with the first request.
  Lazy& numerical_energies() { return numerical_energies_; }
  EnergyBalance& balance() { return balance_; }
  const EnergyBalance& balance() const { return balance_; }
  Lazy& accelerations() { return accelerations_; }
  Lazy& contacts() { return contacts_; }
  /// What gravity and velocities take of the joints.
  Lazy& joint_bias() { return joint_terms_; }
  /// The bodies' contact forces (Engine::enable_mean_forces).
  Lazy& contact_forces() { return contact_forces_; }
  /// The engine's own details (Engine::publish_details).
  Lazy& details() { return details_; }
  /// The contacts of terrain and obstacles, whose mean forces are of both groups above.
  Lazy& surface_contacts() { return surface_contacts_; }
  /// The same of joint reactions (Engine::publish_reactions).
  Lazy& reactions() { return reactions_; }

 private:
  struct Group final : Lazy {
    Group(DerivedPorts& owner, void (DerivedPorts::*compute)())
        : owner_(owner), compute_(compute) {}
    void begin() override {
      if (!wanted) (owner_.*compute_)();
      wanted = true;
    }
    void update() const {
      if (wanted) (owner_.*compute_)();
    }
    bool wanted = false;

   private:
    DerivedPorts& owner_;
    void (DerivedPorts::*compute_)();
  };
  struct NumericalEnergies final : Lazy {
    explicit NumericalEnergies(DerivedPorts& of) : owner(of) {}
    void begin() override {
      owner.balance_.begin();
      if (!wanted) owner.compute_numerical_energies();
      wanted = true;
    }
    void update() const {
      if (wanted) owner.compute_numerical_energies();
    }
    DerivedPorts& owner;
    bool wanted = false;
  };
  struct Details final : Lazy {
    explicit Details(Engine& of_engine) : engine(of_engine) {}
    void begin() override { engine.publish_details(); }
    Engine& engine;
  };

  struct Reactions final : Lazy {
    explicit Reactions(Engine& of_engine) : engine(of_engine) {}
    void begin() override { engine.publish_reactions(); }
    Engine& engine;
  };

  struct ContactForces final : Lazy {
    explicit ContactForces(Engine& of_engine) : engine(of_engine) {}
    void begin() override { engine.enable_mean_forces(true); }
    Engine& engine;
  };

  struct SurfaceContacts final : Lazy {
    explicit SurfaceContacts(Engine& of_engine) : engine(of_engine) {}
    void begin() override {
      engine.enable_mean_forces(true);
      engine.publish_details();
    }
    Engine& engine;
  };

  void compute_energies();
  void compute_numerical_energies();
  void compute_accelerations();
  void compute_contacts();
  void compute_joint_bias();

  const Experiment& experiment_;
  Engine& engine_;
  std::vector<RobotSums> robots_;
  std::vector<double> numerical_;  ///< numerical energy of each robot [J]
  std::vector<BodyValues> bodies_;
  JointBias joint_bias_;
  EnergyBalance balance_;
  std::vector<BodyState> before_;  // of the step before, while accelerations are wanted
  bool finite_ = true;
  Group energies_{*this, &DerivedPorts::compute_energies};
  NumericalEnergies numerical_energies_{*this};
  Group accelerations_{*this, &DerivedPorts::compute_accelerations};
  Group contacts_{*this, &DerivedPorts::compute_contacts};
  Group joint_terms_{*this, &DerivedPorts::compute_joint_bias};
  ContactForces contact_forces_;
  Details details_;
  SurfaceContacts surface_contacts_;
  Reactions reactions_;
};

}  // namespace hookpoint::simulation
