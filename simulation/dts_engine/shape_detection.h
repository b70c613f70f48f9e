// Where shapes touch: the narrow phase of `touch = shapes`, feature against feature
// (contact/geometry/), behind a broad phase that sweeps over the objects' boxes.
#pragma once

#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include "contact/geometry/ball_on_surface.h"
#include "contact/geometry/edge_on_ridge.h"
#include "contact/geometry/rim_on_round.h"
#include "simulation/dts_engine/common_floor.h"
#include "simulation/dts_engine/object_motion.h"
#include "simulation/dts_engine/shape_object.h"
#include "simulation/experiment/contact_materials.h"

namespace hookpoint::simulation {

/// Which feature of which object touches which of which other.
struct ContactKey {
  std::int64_t a = 0, b = 0;  ///< objects
  std::int64_t feature = 0;   ///< of a
  std::int64_t other = 0;     ///< of b
  auto operator<=>(const ContactKey&) const = default;
};

/// A place where objects a and b touch, world axes. Several may have one key: a ball in a groove.
struct ShapeContact {
  /// Whether it is of a ball, or a point, on a surface: only these are known to have come in through
  /// it. Others begin at depth 0, or where another contact ends.
  bool is_tracked() const;
  /// Whether the weight fades with the pose, as of an edge on a ridge. It then never grows while the
  /// contact lasts, which would make energy from nothing.
  bool fades() const;
  ContactKey key;
  Vector3d place;      ///< on a's surface [m]
  Vector3d normal;     ///< unit, out of b
  double depth = 0.;   ///< > 0 where they overlap [m]
  double weight = 1.;  ///< of the law's force
  int material_a = no_material, material_b = no_material;
  contact::Holding holding{};  ///< of the key's ball inside b
  /// The law counts the depth from here: the least at which it has been since it began inside [m].
  double begun_at = 0.;
  std::size_t order = 0;  ///< in which it was found
  /// On which they roll on each other: of the ball, rim or round side that touches; of two of them
  /// r_a r_b/(r_a + r_b), as their curvatures add up; 0 of none [m].
  double radius = 0.;
};

/// Velocity that belts give a's material over b's, beside the objects' motion [m/s].
Vector3d belt_velocity(const ShapeContact& contact, std::span<const ObjectMotion> motions);

/// The constants of a contact, from the materials of its two sides: the later object is the foot.
const contact::MaterialConstants<double>& constants_of(const ContactMaterials& materials,
                                                       const ShapeContact& contact);

/// Contacts of two kinds that are nearer to each other are at one place [m].
inline constexpr double same_place = 1e-5;

/// Where object a pressed on object b, as they stood then, world axes.
struct PressingPlace {
  /// Of one of the two.
  struct Side {
    std::int64_t object = 0;
    Vector3d place;  ///< on its surface [m]
    int material = no_material;
  };
  Side a, b;
  Vector3d normal;       ///< unit, out of b
  double depth = 0.;     ///< [m]
  double begun_at = 0.;  ///< as ShapeContact has it [m]
  double distance = 0.;  ///< of the place from the one that was looked for [m]
};

/// What detection remembers of the accepted state before: where the objects stood, and which faces
/// hold the balls that are inside.
class DetectionMemory {
 public:
  virtual ~DetectionMemory() = default;
  virtual const ObjectMotion& before(std::size_t object) const = 0;
  /// Whether nothing comes inside but by rounding, so that what lies on a surface is seen from outside.
  virtual bool stays_outside() const { return false; }
  virtual contact::Holding holding(const ContactKey& key) const = 0;
  /// The committed contact of a on b that is nearest to `place`, within `reach` [m]; none without one.
  virtual std::optional<PressingPlace> place_near(std::size_t a, std::size_t b,
                                                  const Vector3d& place, double reach) const = 0;
  /// Likewise of a on a third object, or of a third object on b, however far.
  virtual std::optional<PressingPlace> place_beside(std::size_t a, std::size_t b,
                                                    const Vector3d& place) const = 0;
  /// From where the law counts the depth of `contact`, which continues `beside` on another object, so that it
  /// holds no more energy than that one would: 0 between the same materials [m].
  virtual double begun_at(const ShapeContact& contact, const PressingPlace& beside) const = 0;
};

/// Room for the places where objects touch at once.
std::size_t slots_for(const std::vector<ShapeObject>& objects);

class ShapeDetection {
 public:
  /// All that is referred to outlives it. `reach` [m]: how far above a surface a law acts. `self`:
  /// bodies of one robot touch each other, whatever its self_contact says.
  ShapeDetection(const Experiment& experiment, const std::vector<ShapeObject>& objects,
                 const contact::Terrain* ground, double reach, bool self = false);

  /// The contacts of objects that move as `motions` say, sorted by key; of more than `contacts` has
  /// room for, the deepest. O(n log n + pairs of objects whose boxes meet). Allocates nothing.
  void detect(std::span<const ObjectMotion> motions, const DetectionMemory& memory,
              std::vector<ShapeContact>& contacts);

  /// Whether two objects touch where they meet, in either order.
  bool may_touch(std::size_t i, std::size_t j) const;
  /// Whether the last detection found more contacts than there was room for.
  bool left_out() const { return left_out_; }

 private:
  void pair(std::size_t i, std::size_t j);
  /// Features of a against what b is.
  void balls_on(std::size_t a, std::size_t b);
  void rims_on(std::size_t a, std::size_t b);
  void corners_on(std::size_t a, std::size_t b);
  void edges_on(std::size_t a, std::size_t b);
  void ball_on_surface(const contact::Surface& surface, std::size_t a, std::size_t b,
                       const BallFeature& ball, std::int64_t feature, std::int64_t other,
                       int material_b);
  /// What holds a ball, and the contact between other objects that it continues, if any.
  struct TakenOver {
    contact::Holding holding;
    std::optional<PressingPlace> beside;
  };
  /// The face that holds a corner of a which is found inside b, where another contact tells: at `before`
  /// and now at `inside`, in b's frame.
  TakenOver taken_over(const contact::Surface& surface, std::size_t a, std::size_t b,
                       const Vector3d& before, const Vector3d& inside) const;
  void rim_on_surface(const contact::Surface& surface, std::size_t a, std::size_t b,
                      const RimFeature& rim, std::int64_t feature, std::int64_t other,
                      int material_b, double half_thickness);
  contact::CameOver came_over_end(const contact::RoundSolid& disc, std::size_t a, std::size_t b,
                                  const RimFeature& rim, std::int64_t feature,
                                  std::int64_t other) const;
  void rim_on_round(const RoundFeature& round, std::size_t a, std::size_t b, const RimFeature& rim,
                    std::int64_t feature, std::int64_t other);
  contact::ShapeRim rim_in(std::size_t object, const RimFeature& of,
                           const ObjectMotion& frame) const;
  /// The end of b's disc over which a place of a was at the accepted state before.
  std::size_t end_before(const contact::RoundSolid& disc, std::size_t b, std::size_t a,
                         const Vector3d& place) const;
  std::optional<contact::RoundContact> on_disc(const contact::RoundSolid& disc,
                                               const BallFeature& ball, const ContactKey& key,
                                               contact::Holding& held) const;
  void sides_on_ridges(const contact::Surface& surface, std::size_t a, std::size_t b,
                       std::int64_t other, int material_b);
  contact::RoundSide side_in(std::size_t object, std::size_t side, const ObjectMotion& frame) const;
  /// `polyhedron_b`: what `surface` is of, null for the terrain.
  void edges_on_ridges(const contact::Surface& surface, const PolyhedronFeature* polyhedron_b,
                       std::size_t a, std::size_t b, std::int64_t other, int material_b);
  bool stands_on_face(std::size_t of, std::size_t corner, std::size_t on, const Vector3d& place,
                      const Vector3d& normal) const;
  bool is_corners(const contact::EdgeContact& at, const contact::Surface& surface,
                  const contact::Ridge& ridge, const contact::Polyhedron& solid, std::size_t edge,
                  std::size_t a, const ObjectMotion& frame) const;
  void sides_on_sides(std::size_t a, std::size_t b);
  void find_edges(std::size_t a, const ObjectMotion& frame);
  contact::BodyEdge edge_of(const PolyhedronFeature& polyhedron, std::size_t ridge, std::size_t a,
                            const ObjectMotion& frame) const;
  void add(const ShapeContact& contact);
  /// Of a floor that several objects make up.
  FloorPart floor_part(const ShapeContact& contact);
  ShapeContact* shared_with(const ShapeContact& contact);
  /// Of the body `object`.
  NearFloor near_floor(std::size_t object);
  void replace(ShapeContact& place, const ShapeContact& contact);
  /// ShapeContact::radius.
  double radius_of(const ShapeContact& contact) const;
  double radius_of_a(const ContactKey& key) const;
  double radius_of_b(const ShapeContact& contact) const;
  int material_of(std::size_t object, const Vector3d& place, int stated) const;
  /// Box of an object in the frame of another.
  contact::Region box_in(std::size_t object, const ObjectMotion& frame) const;
  /// The same, with what is within reach of it.
  contact::Region near_box(std::size_t object, const ObjectMotion& frame) const;

  const Experiment& experiment_;
  const std::vector<ShapeObject>& objects_;
  const contact::Terrain* ground_;
  double reach_;
  bool self_;
  std::vector<std::size_t>
      carriers_;  ///< of each object that is a body: the object that carries it
  std::vector<contact::Region> boxes_;
  bool has_floors_ = false;               ///< of several objects that no force moves
  std::vector<std::size_t> near_floor_;   ///< NearFloor::near of ...
  std::size_t near_floor_of_ = 0;         ///< ... this object, in the detection that is under way
  std::vector<std::size_t> order_;        ///< of the sweep
  std::vector<contact::BodyEdge> edges_;  ///< of the object whose edges are looked at
  // Of the detection that is under way.
  std::span<const ObjectMotion> motions_;
  const DetectionMemory* memory_ = nullptr;
  std::vector<ShapeContact>* contacts_ = nullptr;
  std::size_t first_of_pair_ = 0;  ///< where those of the present two objects begin
  bool left_out_ = false;
};

}  // namespace hookpoint::simulation
