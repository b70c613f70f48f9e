// Contacts under `touch = shapes`: where the shapes of the terrain, obstacles and robots touch, what
// the force law makes of it, and what each place remembers from step to step.
//
// A place of contact moves over both surfaces. Its tangential memory is the integral of slip: with
// D_a and D_b how far the material of either body has come there since the committed state, the hook
// moves by dx - (D_a - D_b), dx that of the place, so that the stretch x - h changes by slip alone.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "contact/force_law.h"
#include "contact/laws/surface_forces.h"
#include "dts/workspace.h"
#include "integrators/stepper.h"
#include "simulation/dts_engine/evaluation.h"
#include "simulation/dts_engine/shape_detection.h"
#include "simulation/engine_interface/engine.h"
#include "simulation/experiment/contact_materials.h"

namespace hookpoint::simulation {

class ShapeContacts final : private DetectionMemory {
 public:
  /// Of all robots of the experiment. `ground` may be null. All that is referred to outlives it.
  ShapeContacts(const Experiment& experiment, const contact::Terrain* ground,
                const WorldInputs& inputs, const integrators::StepperDescription& stepper);

  /// Adds the forces of all contacts to `workspaces`, one a robot, whose kinematics are up to date.
  /// `elapsed` [s]: since the state whose memory is committed; `dt` [s] the step. O(contacts) beside
  /// the detection.
  void apply_forces(std::span<dts::Workspace<double>* const> workspaces, Evaluation evaluation,
                    double elapsed, double dt);
  /// The forces of the last accepted evaluation once more.
  void apply_forces_again(std::span<dts::Workspace<double>* const> workspaces) const;
  /// No law: no force, bristles at rest.
  void apply_nothing();

  // Memory.

  /// Before the first evaluation: where everything stands, and the stretched springs of robots that
  /// start in balance (SettledStart).
  void begin(std::span<dts::Workspace<double>* const> workspaces);
  void commit();
  void undo();
  void commit_within_step();
  /// The terrain and the obstacles stand as the inputs say: before the first step, and after a
  /// restored state.
  void take_surfaces();
  /// How they move over the step that begins.
  void begin_step();

  // Bristles: `bristle_states` numbers of each slot, a place that touches has one.

  std::size_t bristle_count() const { return bristles_.size(); }
  std::span<const double> bristles() const { return bristles_; }
  std::span<const double> next_bristles() const { return next_bristles_; }
  std::span<const double> bristle_rates() const { return bristle_rates_; }
  void read_bristles(std::span<const double> numbers);
  bool is_active_state(std::size_t i) const;

  // Impulses on each body over a step, robots in order.

  void begin_impulses();
  std::span<const Vector3d> impulses(std::size_t robot) const;
  void add_impulses(double weight);

  // Events of adaptive integrators: one a slot, where the law's switching value changes sign.

  std::size_t event_count() const { return slot_count_; }
  void event_values(std::span<dts::Workspace<double>* const> workspaces, double elapsed,
                    std::span<double> values);
  void cross_events(std::span<const int> directions);

  // What is published, as of the last accepted state.

  /// A place that touches.
  struct Place {
    ShapeContact at;
    contact::Memory<double> memory;  ///< of the place; its `next` while it is pending
    Vector3d force;                  ///< on a, world axes [N]
    Vector3d moment;         ///< on a, of resistance to rolling and spinning, world axes [N m]
    std::int64_t slot = -1;  ///< of bristles and events; -1: none was free
    /// What contacts of its two objects may give back; all of it is the first place's [J].
    double reserve = 0.;
    Vector3d stretch() const { return memory.stretch; }
  };
  std::span<const Place> places() const { return std::span(pending_.places).first(pending_.count); }
  const std::vector<ShapeObject>& objects() const { return objects_; }
  /// Number of an object among the bodies of all robots; none for terrain and obstacles.
  std::optional<std::size_t> body_of(std::size_t object) const;
  /// The boundary point that a place belongs to; none of a rim, an edge, and on the other's side.
  std::optional<std::size_t> boundary_point(const ContactKey& key) const;
  /// What the springs hold, less what contacts that began without energy were given back so far: in an account
  /// of energy that was put in [J].
  double stored_energy() const;
  /// Number of an object among the terrain, if there is one, and the obstacles; none for bodies.
  std::optional<std::size_t> surface_of(std::size_t object) const {
    return object < surfaces_.size() ? std::optional(object) : std::nullopt;  // they come first
  }
  /// Of each of them, on bodies over the step [N s].
  std::span<const Vector3d> surface_impulses() const { return surface_impulses_; }
  /// Work on bodies since the run's start of the terrain's motion, then of each obstacle's: by their
  /// frames and their belts [J]. Summed as the impulses are, by the integrator's weights.
  std::span<const double> surface_works() const { return surface_works_; }
  bool adaptive() const { return adaptive_; }
  /// Whether the terrain or an obstacle moves in this step.
  bool surfaces_move() const;
  const std::string& notice() const { return notice_; }
  void forget_notice() { notice_.clear(); }

  template <class Self, class Archive>
  static void exchange(Self& self, Archive& archive) {
    archive("contact_count", self.committed_.count);
    archive.each("contact", self.committed_.places, [](auto& place, auto& part) {
      part("a", place.at.key.a);
      part("b", place.at.key.b);
      part("feature", place.at.key.feature);
      part("other", place.at.key.other);
      part("slot", place.slot);
      part("place", place.at.place);
      part("normal", place.at.normal);
      part("depth", place.at.depth);
      part("weight", place.at.weight);
      part("begun_at", place.at.begun_at);
      part("reserve", place.reserve);
      part("force", place.force);
      part("hook", place.memory.hook);
      part("stretch", place.memory.stretch);
      part("attached", place.memory.attached);
      part("sliding", place.memory.sliding);
      part("holding_count", place.at.holding.count);
      for (auto& face : place.at.holding.faces) part("face", face);
    });
    archive.each("object", self.committed_.motions, [](auto& motion, auto& part) {
      part("position", motion.p_WB);
      for (auto* entry :
           {&motion.R_WB.xx, &motion.R_WB.xy, &motion.R_WB.xz, &motion.R_WB.yx, &motion.R_WB.yy,
            &motion.R_WB.yz, &motion.R_WB.zx, &motion.R_WB.zy, &motion.R_WB.zz})
        part("rotation", *entry);
    });
    archive("bristle", self.bristles_);
    archive("surface_work", self.surface_works_);
  }

 private:
  /// What is remembered of one state.
  struct Kept {
    std::vector<Place> places;  ///< the first `count`, sorted by key
    std::uint64_t count = 0;
    std::vector<ObjectMotion> motions;
  };

  const ObjectMotion& before(std::size_t object) const override {
    return committed_.motions[object];
  }
  contact::Holding holding(const ContactKey& key) const override;
  std::optional<PressingPlace> place_near(std::size_t a, std::size_t b, const Vector3d& place,
                                          double reach) const override;
  std::optional<PressingPlace> place_beside(std::size_t a, std::size_t b,
                                            const Vector3d& place) const override;
  double begun_at(const ShapeContact& contact, const PressingPlace& beside) const override;
  /// The nearest that presses; `side(key)`: 1 of one that acts as the one looked for, -1 of one that acts the
  /// other way, 0 of any other.
  template <class Side>
  std::optional<PressingPlace> nearest_place(const Vector3d& place, double reach,
                                             const Side& side) const;
  /// The committed places of which object a touches b.
  std::span<const Place> kept(std::int64_t a, std::int64_t b) const;

  void move_objects(std::span<dts::Workspace<double>* const> workspaces, double elapsed);
  /// For each contact that was found, the committed place that it continues; none: -1. Of its own key
  /// the one with the nearest normal; else one at the same place, where a corner that comes over an
  /// edge hands over to the edge; else that of the same feature of a body on the next object of one floor.
  void match();
  /// From where the law counts the depth of a contact that continues `before`, the same or on the next object of
  /// one floor [m].
  double begun_after(const ShapeContact& contact, const ShapeContact& before) const;
  /// Lets contacts that begin deep inside, where nothing was before, push from the depth where they
  /// begin, and weights grow at the force that is there: else energy would come from nothing.
  void limit_new_energy();
  /// Lets what counts its depth from inside count from less deep, for the energy that contacts of the
  /// same two objects have lost since they met: so that bodies come out of each other again and no
  /// more energy is there than was. `dt` [s] since the committed state.
  void give_back(double dt);
  /// What the contacts of found_[first] to found_[last - 1], of one pair of objects, may give back [J].
  double reserve(std::size_t first, std::size_t last) const;
  /// What the law's normal spring holds at a place of `depth` [J].
  double normal_energy(const ShapeContact& contact, double depth) const;
  std::int64_t match_key(std::size_t found) const;
  bool continues(const ShapeContact& contact, const ShapeContact& before) const;
  std::int64_t match_place(std::size_t found) const;
  std::int64_t match_beside(std::size_t found) const;
  bool is_matched(std::int64_t place) const { return matched_[static_cast<std::size_t>(place)]; }
  /// Of the ball that a contact is of; 0 of others [m].
  double ball_radius(const ContactKey& key) const;
  /// How far the material of a ball has come where it touches [m].
  Vector3d rolling_way(const ShapeContact& contact, const ShapeContact& before,
                       double radius) const;
  Vector3d way_of(std::int64_t object, const Vector3d& before, const Vector3d& now) const;
  contact::Memory<double> carried(const ShapeContact& contact, const Place& from) const;
  contact::PointKinematics<double> kinematics(const ShapeContact& contact, std::int64_t slot) const;
  /// Its foot: of the two the object that comes later.
  contact::FootMotion foot(const ShapeContact& contact) const;
  /// The law at a contact.
  template <class Law>
  contact::Reaction<double> reaction(const Law& law, const ShapeContact& contact,
                                     const contact::PointKinematics<double>& at,
                                     const contact::Memory<double>& memory, bool accepted,
                                     double dt) const;
  template <class Law>
  void evaluate(const Law& law, std::span<dts::Workspace<double>* const> workspaces,
                Evaluation evaluation, double dt);
  /// What a surface that is no body does to bodies, about its origin, world axes.
  struct SurfaceLoad {
    Vector3d force, moment;     ///< [N, N m]
    Vector3d tangential_force;  ///< part of the force along the surface [N]
  };
  /// Adds a force and a moment on a that b exerts.
  void add_surface_load(const ShapeContact& contact, const Vector3d& force, const Vector3d& moment);
  void add_force(std::span<dts::Workspace<double>* const> workspaces, const ShapeContact& contact,
                 const Vector3d& force, const Vector3d& moment) const;
  void give_slots();
  contact::Bristle<double> bristle_at(std::span<const double> numbers, std::int64_t slot) const;
  void put_bristle(const contact::Bristle<double>& bristle, std::int64_t slot,
                   std::span<double> numbers) const;
  void look_for_edge(const ShapeContact& contact);
  /// Says once that not every place where shapes touch has room.
  void look_for_room();

  const Experiment& experiment_;
  const contact::Terrain* ground_;
  const WorldInputs& inputs_;
  bool adaptive_ = false;
  bool new_velocity_ = false;
  const contact::LawDescription* law_;
  std::size_t bristle_states_ = 0;
  ContactMaterials materials_;
  bool surfaces_act_ = false;  ///< some material has constants that act beside the law
  std::vector<ShapeObject> objects_;
  std::size_t slot_count_ = 0;
  ShapeDetection detection_;
  std::vector<ObjectMotion> motions_;    ///< of each object, at the state under evaluation
  std::vector<SurfaceMotion> surfaces_;  ///< of terrain and obstacles, at the committed state
  std::vector<SurfaceLoad> loads_;       ///< of each of them, at the state under evaluation
  std::vector<Vector3d> surface_impulses_;
  std::vector<double> surface_works_, works_before_;
  double given_back_ = 0., given_back_before_ = 0., given_in_step_ = 0.;  ///< [J]
  /// Since the step's start, of the state under evaluation and of the committed one [s].
  double elapsed_ = 0., committed_elapsed_ = 0.;
  std::vector<ShapeContact> found_;
  std::vector<std::int64_t> matches_;
  std::vector<bool> matched_;  ///< of each committed place
  Kept before_, committed_, pending_;
  std::vector<bool> slot_taken_;
  std::vector<double> bristles_, next_bristles_, bristle_rates_;
  std::vector<std::size_t> first_bodies_;  ///< of each robot; one more at the end
  std::vector<Vector3d> forces_, impulses_;
  bool begun_ = false;  ///< the state at the start has been evaluated
  std::string notice_;
};

}  // namespace hookpoint::simulation
