#include "simulation/dts_engine/shape_contacts.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/bristle_step.h"
#include "contact/terrain/rolling.h"
#include "dts/external_forces.h"
#include "math/bisect.h"
#include "simulation/dts_engine/common_floor.h"
#include "simulation/dts_engine/contact_point.h"
#include "simulation/dts_engine/methods.h"
#include "simulation/experiment/robot_tree.h"

namespace hookpoint::simulation {
namespace {

/// Between the normals of a contact before and after a step, which continue each other: cosine.
constexpr double alike = 0.5;
/// A depth that makes no energy worth a name [m].
constexpr double shallow = 1e-6;

/// Of a contact, the place on b's surface [m].
Vector3d other_place(const ShapeContact& contact) {
  return contact.place + contact.depth * contact.normal;
}

/// Where it presses, `distance` [m] from what was looked for.
PressingPlace pressing_place(const ShapeContact& contact, double distance) {
  const double depth = contact.depth + contact.begun_at;
  return {{contact.key.a, contact.place, contact.material_a},
          {contact.key.b, contact.place + depth * contact.normal, contact.material_b},
          contact.normal,
          depth,
          contact.begun_at,
          distance};
}

double farthest_reach(const ContactMaterials& materials, const contact::LawDescription& law) {
  double reach = 0.;
  materials.for_each([&](const contact::MaterialConstants<double>& constants) {
    reach = std::max(reach, law.reach(constants));
  });
  return reach;
}

/// Where a place of an object at `from` has come to when the object is at `to`.
Vector3d carried_along(const Vector3d& place, const ObjectMotion& from, const ObjectMotion& to) {
  return to.to_world(from.to_object(place));
}

/// How far the material of an object has come at a place of contact that was at `before` and is at
/// `now`: the mean of what was there and what is there, exact for a place fixed to the object, and up
/// to third order in the turn for one that moves over it [m].
Vector3d material_way(const Vector3d& before, const Vector3d& now, const ObjectMotion& from,
                      const ObjectMotion& to) {
  return 0.5 * ((carried_along(before, from, to) - before) + (now - carried_along(now, to, from)));
}

}  // namespace

ShapeContacts::ShapeContacts(const Experiment& experiment, const contact::Terrain* ground,
                             const WorldInputs& inputs,
                             const integrators::StepperDescription& stepper)
    : experiment_(experiment),
      ground_(ground),
      inputs_(inputs),
      adaptive_(stepper.adaptive()),
      new_velocity_(stepper.moves_with_new_velocity),
      law_(&force_law_of(experiment, adaptive_)),
      bristle_states_(law_->bristle_states),
      materials_(experiment),
      objects_(shape_objects(experiment, ground)),
      slot_count_(slots_for(objects_)),
      detection_(experiment, objects_, ground, farthest_reach(materials_, *law_)),
      motions_(objects_.size()) {
  found_.reserve(slot_count_);
  matches_.reserve(slot_count_);
  matched_.resize(slot_count_);
  for (Kept* kept : {&before_, &committed_, &pending_}) {
    kept->places.resize(slot_count_);
    kept->motions.resize(objects_.size());
  }
  slot_taken_.resize(slot_count_);
  for (std::vector<double>* bristles : {&bristles_, &next_bristles_, &bristle_rates_})
    bristles->resize(bristle_states_ * slot_count_);
  first_bodies_.push_back(0);
  for (const RobotSpec& robot : experiment.robots)
    first_bodies_.push_back(first_bodies_.back() + body_count(robot));
  forces_.resize(first_bodies_.back());
  impulses_.resize(first_bodies_.back());
  materials_.for_each([&](const contact::MaterialConstants<double>& constants) {
    surfaces_act_ = surfaces_act_ || contact::acts_beside_the_law(constants);
  });
  take_surfaces();
}

std::optional<std::size_t> ShapeContacts::body_of(std::size_t object) const {
  const ShapeObject& of = objects_[object];
  if (of.kind != ShapeObject::Kind::body) return std::nullopt;
  return first_bodies_[of.index] + of.body;
}

double ShapeContacts::ball_radius(const ContactKey& key) const {
  const std::vector<BallFeature>& balls = objects_[static_cast<std::size_t>(key.a)].balls;
  const auto feature = static_cast<std::size_t>(key.feature);  // balls are numbered first
  return feature < balls.size() ? balls[feature].radius : 0.;
}

// As contact::rolling_displacement has it, exact for a steady turn: dc + phi x (-r n).
Vector3d ShapeContacts::rolling_way(const ShapeContact& contact, const ShapeContact& before,
                                    double radius) const {
  const auto a = static_cast<std::size_t>(contact.key.a);
  const Vector3d center = contact.place + radius * contact.normal;
  const Vector3d old_center = before.place + radius * before.normal;
  const Quaterniond turn =
      quaternion_from(motions_[a].R_WB * transpose(committed_.motions[a].R_WB));
  return (center - old_center) + cross(contact::rotation_vector(turn), -radius * contact.normal);
}

std::optional<std::size_t> ShapeContacts::boundary_point(const ContactKey& key) const {
  const std::vector<BallFeature>& balls = objects_[static_cast<std::size_t>(key.a)].balls;
  const auto feature = static_cast<std::size_t>(key.feature);  // balls are numbered first
  return feature < balls.size() ? balls[feature].boundary_point : std::nullopt;
}

// Where everything stands.

void ShapeContacts::take_surfaces() {
  committed_elapsed_ = -experiment_.deltat;
  surfaces_.clear();
  if (ground_ != nullptr) surfaces_.push_back(inputs_.ground);
  surfaces_.insert(surfaces_.end(), inputs_.obstacles.begin(), inputs_.obstacles.end());
  loads_.resize(surfaces_.size());
  surface_works_.resize(surfaces_.size());
  surface_impulses_.resize(surfaces_.size());
  works_before_.resize(surfaces_.size());
}

void ShapeContacts::begin_step() {
  std::size_t at = 0;
  if (ground_ != nullptr) surfaces_[at++] = inputs_.ground;
  for (const SurfaceMotion& obstacle : inputs_.obstacles) surfaces_[at++] = obstacle;
}

bool ShapeContacts::surfaces_move() const {
  return std::ranges::any_of(surfaces_, [](const SurfaceMotion& surface) {
    return surface.velocity != Vector3d{} || surface.angular_velocity != Vector3d{} ||
           surface.belt_velocity != Vector3d{};
  });
}

void ShapeContacts::move_objects(std::span<dts::Workspace<double>* const> workspaces,
                                 double elapsed) {
  elapsed_ = elapsed;
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    const ShapeObject& object = objects_[i];
    ObjectMotion& motion = motions_[i];
    if (object.kind == ShapeObject::Kind::body) {
      static_cast<dts::BodyMotion<double>&>(motion) = workspaces[object.index]->bodies[object.body];
      continue;
    }
    motion = motion_of(surfaces_[i], elapsed);
  }
}

void ShapeContacts::begin(std::span<dts::Workspace<double>* const> workspaces) {
  move_objects(workspaces, 0.);
  committed_.motions = motions_;
  detection_.detect(motions_, *this, found_);
  for (const ShapeContact& contact : found_) {
    const ShapeObject& object = objects_[static_cast<std::size_t>(contact.key.a)];
    const std::optional<std::size_t> point = boundary_point(contact.key);
    if (!point || object.kind != ShapeObject::Kind::body) continue;
    const RobotSpec& robot = experiment_.robots[object.index];
    if (!robot.settled || robot.settled->stretch.empty()) continue;
    const std::vector<const BodySpec*> bodies = bodies_of(robot);
    std::size_t before = 0;  // points of the bodies before it, among those that can move
    for (std::size_t body = robot.mobile ? 0 : 1; body < object.body; ++body)
      before += bodies[body]->boundary_points.size();
    const Vector3d& stretch = robot.settled->stretch[before + *point];
    if (stretch == Vector3d{}) continue;
    const Vector3d surface = contact.place + contact.depth * contact.normal;
    Place& place = committed_.places[committed_.count];
    place = {contact,
             {surface - stretch, stretch, true, false},
             {},
             {},
             static_cast<std::int64_t>(committed_.count)};
    put_bristle({stretch}, place.slot, bristles_);
    ++committed_.count;
  }
}

// Which place continues which.

std::span<const ShapeContacts::Place> ShapeContacts::kept(std::int64_t a, std::int64_t b) const {
  const auto all = std::span(committed_.places).first(committed_.count);
  const auto before = [](const Place& place, const std::pair<std::int64_t, std::int64_t>& objects) {
    return std::pair(place.at.key.a, place.at.key.b) < objects;
  };
  const auto first = std::lower_bound(all.begin(), all.end(), std::pair(a, b), before);
  const auto last = std::lower_bound(first, all.end(), std::pair(a, b + 1), before);
  return all.subspan(static_cast<std::size_t>(first - all.begin()),
                     static_cast<std::size_t>(last - first));
}

contact::Holding ShapeContacts::holding(const ContactKey& key) const {
  for (const Place& place : kept(key.a, key.b))
    if (place.at.key == key) return place.at.holding;
  return {};
}

template <class Side>
std::optional<PressingPlace> ShapeContacts::nearest_place(const Vector3d& place, double reach,
                                                          const Side& side) const {
  double nearest = reach;
  std::optional<PressingPlace> found;
  for (const Place& other : std::span(committed_.places).first(committed_.count)) {
    const ShapeContact& at = other.at;
    const double sign = side(at.key);
    if (sign == 0. || !(at.depth > 0.)) continue;
    const double distance = std::min(norm(at.place - place), norm(other_place(at) - place));
    if (distance >= nearest) continue;
    nearest = distance;
    found = pressing_place(at, distance);
    if (sign > 0.) continue;
    std::swap(found->a, found->b);
    found->normal = -found->normal;
  }
  return found;
}

std::optional<PressingPlace> ShapeContacts::place_near(std::size_t a, std::size_t b,
                                                       const Vector3d& place, double reach) const {
  const auto first = static_cast<std::int64_t>(a), second = static_cast<std::int64_t>(b);
  return nearest_place(place, reach, [&](const ContactKey& key) {
    if (key.a == first && key.b == second) return 1.;
    return key.a == second && key.b == first ? -1. : 0.;
  });
}

std::optional<PressingPlace> ShapeContacts::place_beside(std::size_t a, std::size_t b,
                                                         const Vector3d& place) const {
  const auto first = static_cast<std::int64_t>(a), second = static_cast<std::int64_t>(b);
  constexpr double any = std::numeric_limits<double>::infinity();
  return nearest_place(place, any, [&](const ContactKey& key) {
    if ((key.a == first) != (key.b == second)) return 1.;
    return (key.a == second) != (key.b == first) ? -1. : 0.;
  });
}

double ShapeContacts::begun_at(const ShapeContact& contact, const PressingPlace& beside) const {
  if (contact.material_a == beside.a.material && contact.material_b == beside.b.material) return 0.;
  ShapeContact as_it_was = contact;
  as_it_was.material_a = beside.a.material;
  as_it_was.material_b = beside.b.material;
  const double most = normal_energy(as_it_was, contact.depth - beside.begun_at);
  if (normal_energy(contact, contact.depth) <= most) return 0.;
  return bisect([&](double begun) { return most - normal_energy(contact, contact.depth - begun); },
                0., contact.depth);
}

std::int64_t ShapeContacts::match_key(std::size_t found) const {
  const ShapeContact& contact = found_[found];
  std::int64_t match = -1;
  double nearest = alike;
  for (const Place& place : kept(contact.key.a, contact.key.b)) {
    if (place.at.key != contact.key) continue;
    const std::int64_t index = &place - committed_.places.data();
    const double cosine = dot(place.at.normal, contact.normal);
    if (cosine <= nearest || is_matched(index)) continue;
    // The faces that hold a ball know themselves where it is.
    if (!contact.is_tracked() && !continues(contact, place.at)) continue;
    nearest = cosine;
    match = index;
  }
  return match;
}

// No depth grows by more than its bodies move: else the same features have met in another place.
bool ShapeContacts::continues(const ShapeContact& contact, const ShapeContact& before) const {
  const Vector3d apart = way_of(contact.key.a, contact.place, contact.place) -
                         way_of(contact.key.b, contact.place, contact.place);
  return contact.depth <= before.depth + before.begun_at + shallow + 2. * norm(apart);
}

std::int64_t ShapeContacts::match_place(std::size_t found) const {
  const ShapeContact& contact = found_[found];
  std::int64_t match = -1;
  double nearest = same_place;
  const auto consider = [&](std::int64_t a, std::int64_t b, double sign) {
    for (const Place& place : kept(a, b)) {
      const std::int64_t index = &place - committed_.places.data();
      // Both places of the old contact, as its bodies have carried them, against both of the new.
      const Vector3d old_place = place.at.place, old_other = other_place(place.at);
      const Vector3d now = old_place + way_of(a, old_place, old_place);
      const Vector3d other_now = old_other + way_of(b, old_other, old_other);
      const double distance =
          std::min({norm(contact.place - now), norm(contact.place - other_now),
                    norm(other_place(contact) - now), norm(other_place(contact) - other_now)});
      if (distance >= nearest || sign * dot(place.at.normal, contact.normal) <= alike ||
          is_matched(index))
        continue;
      nearest = distance;
      match = index;
    }
  };
  consider(contact.key.a, contact.key.b, 1.);
  consider(contact.key.b, contact.key.a, -1.);
  return match;
}

std::int64_t ShapeContacts::match_beside(std::size_t found) const {
  const ShapeContact& contact = found_[found];
  const auto [a, b] =
      std::pair(static_cast<std::size_t>(contact.key.a), static_cast<std::size_t>(contact.key.b));
  const bool is_of_a = may_be_of_floor(objects_[b]);  // the feature of the body
  if (is_of_a == may_be_of_floor(objects_[a])) return -1;
  for (const Place& place : std::span(committed_.places).first(committed_.count)) {
    const ContactKey& key = place.at.key;
    const bool same_feature = is_of_a ? key.a == contact.key.a && key.feature == contact.key.feature
                                      : key.b == contact.key.b && key.other == contact.key.other;
    const auto floor = static_cast<std::size_t>(is_of_a ? key.b : key.a);
    if (!same_feature || floor == (is_of_a ? b : a) || !may_be_of_floor(objects_[floor])) continue;
    const Vector3d old_place = is_of_a ? place.at.place : other_place(place.at);
    const Vector3d now = old_place + way_of(is_of_a ? key.a : key.b, old_place, old_place);
    const std::int64_t index = &place - committed_.places.data();
    const double moved = norm((is_of_a ? contact.place : other_place(contact)) - now);
    // An edge may cross several ridges; what touches faces does so once.
    if ((moved < same_place || !contact.fades()) && dot(place.at.normal, contact.normal) > alike &&
        !is_matched(index) && continues(contact, place.at))
      return index;
  }
  return -1;
}

void ShapeContacts::match() {
  matches_.assign(found_.size(), -1);
  matched_.assign(matched_.size(), false);
  const auto take = [&](std::size_t i, std::int64_t match) {
    matches_[i] = match;
    if (match >= 0) matched_[static_cast<std::size_t>(match)] = true;
  };
  for (std::size_t i = 0; i < found_.size(); ++i) take(i, match_key(i));
  for (std::size_t i = 0; i < found_.size(); ++i)
    if (matches_[i] < 0) take(i, match_place(i));
  for (std::size_t i = 0; i < found_.size(); ++i)
    if (matches_[i] < 0) take(i, match_beside(i));
}

double ShapeContacts::begun_after(const ShapeContact& contact, const ShapeContact& before) const {
  const double begun = std::min(before.begun_at, contact.depth);
  const auto objects = [](const ContactKey& key) { return std::minmax(key.a, key.b); };
  return objects(before.key) == objects(contact.key)
             ? begun
             : std::max(begun, begun_at(contact, pressing_place(before, 0.)));
}

void ShapeContacts::limit_new_energy() {
  for (std::size_t i = 0; i < found_.size(); ++i) {
    ShapeContact& contact = found_[i];
    if (contact.depth <= 0.) continue;
    if (contact.is_tracked()) {
      // Of one that came over a seam of materials.
      const ShapeContact* before =
          matches_[i] < 0 ? nullptr : &committed_.places[static_cast<std::size_t>(matches_[i])].at;
      if (before != nullptr && before->is_tracked())
        contact.begun_at = std::max(contact.begun_at, begun_after(contact, *before));
    } else if (matches_[i] >= 0) {
      const ShapeContact& before = committed_.places[static_cast<std::size_t>(matches_[i])].at;
      contact.begun_at = begun_after(contact, before);
      // w (d - b) stays what it is: with the greater w the spring holds less.
      if (contact.weight > before.weight)
        contact.begun_at =
            contact.depth - before.weight / contact.weight * (contact.depth - contact.begun_at);
    } else if (begun_) {
      const double closing = -dot(kinematics(contact, -1).velocity, contact.normal);
      const double entered = shallow + 2. * experiment_.deltat * std::max(0., closing);
      if (contact.depth > entered) contact.begun_at = contact.depth;
    }
    contact.depth -= contact.begun_at;
  }
}

double ShapeContacts::normal_energy(const ShapeContact& contact, double depth) const {
  if (!(depth > 0.)) return 0.;
  return contact.weight * law_->stored_energy(depth, {}, constants_of(materials_, contact));
}

double ShapeContacts::reserve(std::size_t first, std::size_t last) const {
  double sum = 0.;
  for (const Place& place : kept(found_[first].key.a, found_[first].key.b)) {
    sum += place.reserve;
    if (is_matched(&place - committed_.places.data())) continue;
    // One that has ended though its bodies have not parted there.
    const ShapeContact& at = place.at;
    const Vector3d apart =
        way_of(at.key.a, at.place, at.place) - way_of(at.key.b, at.place, at.place);
    sum += normal_energy(at, at.depth - dot(apart, at.normal));
  }
  for (std::size_t i = first; i < last; ++i) {
    if (matches_[i] < 0) continue;
    const Place& from = committed_.places[static_cast<std::size_t>(matches_[i])];
    const ShapeContact &before = from.at, &now = found_[i];
    // What the spring as it was would hold here, less what it holds.
    ShapeContact as_it_was = before;
    const double depth = now.depth + now.begun_at;
    const double whole = normal_energy(as_it_was, depth - std::min(before.begun_at, depth));
    sum += std::max(0., whole - normal_energy(now, now.depth));
    // Pressed in by more than it holds: the damper's part.
    const double force =
        0.5 * (dot(from.force, before.normal) + dot(pending_.places[i].force, now.normal));
    const double work = force * (depth - (before.depth + before.begun_at));
    sum += std::max(0., work - (whole - normal_energy(before, before.depth)));
  }
  return sum;
}

void ShapeContacts::give_back(double dt) {
  constexpr double time = 0.05;  // [s]: long beside a contact's vibrations
  given_in_step_ = 0.;
  for (std::size_t first = 0, last = 0; first < found_.size(); first = last) {
    const auto same_pair = [&](const ShapeContact& other) {
      return other.key.a == found_[first].key.a && other.key.b == found_[first].key.b;
    };
    while (last < found_.size() && same_pair(found_[last])) ++last;
    double left = reserve(first, last);
    for (std::size_t i = first; i < last; ++i) {
      ShapeContact& at = pending_.places[i].at;
      pending_.places[i].reserve = 0.;
      // What came over a seam onto stiffer ground stays as deep: to rise would take energy.
      if (at.is_tracked() || at.begun_at <= 0. || left <= 0.) continue;
      double by = std::min(1., dt / time) * at.begun_at;
      const double cost = normal_energy(at, at.depth + by) - normal_energy(at, at.depth);
      if (cost > left) by *= left / cost;  // of a convex energy that costs no more than is left
      const double given = std::min(cost, left);
      left -= given;
      given_in_step_ += given;
      at.begun_at -= by;
    }
    pending_.places[first].reserve = left;
  }
}

Vector3d ShapeContacts::way_of(std::int64_t object, const Vector3d& before,
                               const Vector3d& now) const {
  const auto i = static_cast<std::size_t>(object);
  return material_way(before, now, committed_.motions[i], motions_[i]);
}

contact::Memory<double> ShapeContacts::carried(const ShapeContact& contact,
                                               const Place& from) const {
  contact::Memory<double> memory = from.memory;
  if (!memory.attached) return memory;
  const Vector3d &old_place = from.at.place, &place = contact.place;
  // Of a place that was seen from the other side, the stretch is the opposite.
  const bool swapped = from.at.key.a == contact.key.b;
  if (swapped) {
    const Vector3d surface = old_place + from.at.depth * from.at.normal;
    memory.hook = surface + (surface - memory.hook);
    memory.stretch = -memory.stretch;
  }
  const Vector3d belt = belt_velocity(contact, motions_);
  const double radius = swapped ? 0. : ball_radius(contact.key);
  const Vector3d way =
      radius > 0. ? rolling_way(contact, from.at, radius) : way_of(contact.key.a, old_place, place);
  memory.hook += (place - old_place) - (way - way_of(contact.key.b, old_place, place));
  memory.hook -= (elapsed_ - committed_elapsed_) * belt;
  return memory;
}

// Forces.

contact::PointKinematics<double> ShapeContacts::kinematics(const ShapeContact& contact,
                                                           std::int64_t slot) const {
  const ObjectMotion& a = motions_[static_cast<std::size_t>(contact.key.a)];
  const ObjectMotion& b = motions_[static_cast<std::size_t>(contact.key.b)];
  return {contact.place,
          a.velocity_at(contact.place) - b.velocity_at(contact.place) +
              belt_velocity(contact, motions_),
          contact.normal, contact.depth, bristle_at(bristles_, slot)};
}

void ShapeContacts::add_force(std::span<dts::Workspace<double>* const> workspaces,
                              const ShapeContact& contact, const Vector3d& force,
                              const Vector3d& moment) const {
  const auto add = [&](std::int64_t object, double sign) {
    const ShapeObject& of = objects_[static_cast<std::size_t>(object)];
    if (of.kind != ShapeObject::Kind::body) return;
    dts::add_external_force(*workspaces[of.index], of.body, sign * force, contact.place);
    if (surfaces_act_) dts::add_external_torque(*workspaces[of.index], of.body, sign * moment);
  };
  add(contact.key.a, 1.);
  add(contact.key.b, -1.);
}

void ShapeContacts::add_surface_load(const ShapeContact& contact, const Vector3d& force,
                                     const Vector3d& moment) {
  const auto add = [&](std::int64_t object, double sign) {
    const auto surface = surface_of(static_cast<std::size_t>(object));
    if (!surface) return;
    const Vector3d arm = contact.place - motions_[*surface].p_WB;
    SurfaceLoad& load = loads_[*surface];
    load.force += sign * force;
    load.moment += sign * (cross(arm, force) + moment);
    load.tangential_force += sign * tangential(force, contact.normal);
  };
  add(contact.key.b, 1.);
  add(contact.key.a, -1.);
}

contact::FootMotion ShapeContacts::foot(const ShapeContact& contact) const {
  const ObjectMotion& a = motions_[static_cast<std::size_t>(contact.key.a)];
  const ObjectMotion& b = motions_[static_cast<std::size_t>(contact.key.b)];
  return {x_axis(contact.key.a > contact.key.b ? a : b), a.w_WB - b.w_WB, contact.radius};
}

template <class Law>
contact::Reaction<double> ShapeContacts::reaction(const Law& law, const ShapeContact& contact,
                                                  const contact::PointKinematics<double>& at,
                                                  const contact::Memory<double>& memory,
                                                  bool accepted, double dt) const {
  const auto evaluate = [&](contact::PointKinematics<double> point,
                            const contact::Memory<double>& from,
                            const contact::MaterialConstants<double>& constants) {
    if (accepted) point = contact::held_point(law, point, from, constants, dt);
    return new_velocity_ ? contact::reaction_with_moved_bristle(law, point, from, constants, dt)
                         : law.evaluate(point, from, constants, dt);
  };
  const auto& constants = constants_of(materials_, contact);
  if (!contact::differs_with_direction(constants)) return evaluate(at, memory, constants);
  return contact::directed_reaction(at, memory, {foot(contact).x_axis, contact.normal, constants},
                                    evaluate);
}

void ShapeContacts::give_slots() {
  std::fill(slot_taken_.begin(), slot_taken_.end(), false);
  for (std::size_t i = 0; i < found_.size(); ++i) {
    Place& place = pending_.places[i];
    place.slot =
        matches_[i] < 0 ? -1 : committed_.places[static_cast<std::size_t>(matches_[i])].slot;
    if (place.slot >= 0) slot_taken_[static_cast<std::size_t>(place.slot)] = true;
  }
  std::size_t next = 0;
  for (std::size_t i = 0; i < found_.size(); ++i) {
    Place& place = pending_.places[i];
    if (place.slot >= 0) continue;
    while (slot_taken_[next]) ++next;  // there are as many slots as contacts at most
    slot_taken_[next] = true;
    place.slot = static_cast<std::int64_t>(next);
  }
}

template <class Law>
void ShapeContacts::evaluate(const Law& law, std::span<dts::Workspace<double>* const> workspaces,
                             Evaluation evaluation, double dt) {
  const bool accepted = evaluation == Evaluation::accepted;
  if (adaptive_) dt = contact::differential_equation;
  for (std::size_t i = 0; i < found_.size(); ++i) {
    const ShapeContact& contact = found_[i];
    const Place* const from =
        matches_[i] < 0 ? nullptr : &committed_.places[static_cast<std::size_t>(matches_[i])];
    const std::int64_t slot = from != nullptr ? from->slot : -1;
    const auto& constants = constants_of(materials_, contact);
    if (contact.depth <= -law.reach(constants)) {
      if (accepted) {
        pending_.places[i].memory = {};
        pending_.places[i].force = {};
        pending_.places[i].moment = {};
      }
      continue;
    }
    const contact::Memory<double> memory =
        from != nullptr ? carried(contact, *from) : contact::Memory<double>{};
    const contact::Reaction<double> reaction =
        this->reaction(law, contact, kinematics(contact, slot), memory, accepted, dt);
    Vector3d force = reaction.next.attached ? contact.weight * reaction.force : Vector3d{};
    Vector3d moment;
    if (reaction.next.attached) {
      if (surfaces_act_) {
        const contact::SurfaceForces beside =
            contact::surface_forces(reaction.force, contact.normal, foot(contact), constants);
        force += contact.weight * beside.force;
        moment = contact.weight * beside.moment;
      }
      add_force(workspaces, contact, force, moment);
      add_surface_load(contact, force, moment);
      if (const auto body = body_of(static_cast<std::size_t>(contact.key.a)))
        forces_[*body] += force;
      if (const auto body = body_of(static_cast<std::size_t>(contact.key.b)))
        forces_[*body] -= force;
    }
    const std::int64_t own_slot = accepted ? pending_.places[i].slot : slot;
    put_bristle(reaction.bristle_rate, own_slot, bristle_rates_);
    if (!accepted) continue;
    put_bristle(reaction.bristle, own_slot, next_bristles_);
    pending_.places[i].memory = reaction.next;
    pending_.places[i].force = force;
    pending_.places[i].moment = moment;
  }
}

void ShapeContacts::apply_forces(std::span<dts::Workspace<double>* const> workspaces,
                                 Evaluation evaluation, double elapsed, double dt) {
  move_objects(workspaces, elapsed);
  detection_.detect(motions_, *this, found_);
  match();
  limit_new_energy();
  begun_ = true;
  std::ranges::fill(forces_, Vector3d{});
  std::ranges::fill(bristle_rates_, 0.);
  std::ranges::fill(loads_, SurfaceLoad{});
  if (evaluation == Evaluation::accepted) {
    give_slots();
    std::ranges::fill(next_bristles_, 0.);
    pending_.count = found_.size();
    pending_.motions = motions_;
    look_for_room();
    for (std::size_t i = 0; i < found_.size(); ++i) {
      pending_.places[i].at = found_[i];
      look_for_edge(found_[i]);
    }
  }
  std::visit([&](const auto& law) { evaluate(law, workspaces, evaluation, dt); }, law_->variant);
  if (evaluation == Evaluation::accepted) give_back(elapsed_ - committed_elapsed_);
}

void ShapeContacts::look_for_room() {
  if (notice_.empty() && detection_.left_out())
    notice_ = "shapes touch in more than " + std::to_string(slot_count_) +
              " places: the deepest of them carry; give the ground fewer edges, or bodies simpler "
              "shapes";
}

void ShapeContacts::look_for_edge(const ShapeContact& contact) {
  if (!notice_.empty() || contact.key.b != 0 || !objects_[0].ground) return;
  const Vector3d place = motions_[0].to_object(contact.place);
  if (!ground_->query(place).outside) return;
  const ShapeObject& object = objects_[static_cast<std::size_t>(contact.key.a)];
  notice_ = experiment_.robots[object.index].name + ": " + ground_->outside_message(place);
}

void ShapeContacts::apply_forces_again(std::span<dts::Workspace<double>* const> workspaces) const {
  for (const Place& place : places()) {
    if (place.memory.attached) add_force(workspaces, place.at, place.force, place.moment);
  }
}

void ShapeContacts::apply_nothing() { std::ranges::fill(bristle_rates_, 0.); }

// Memory.

void ShapeContacts::commit() {
  works_before_ = surface_works_;
  given_back_before_ = given_back_;
  std::swap(before_, committed_);
  commit_within_step();
  committed_elapsed_ = 0.;  // the step that begins counts from here
}

void ShapeContacts::undo() {
  surface_works_ = works_before_;
  given_back_ = given_back_before_;
  std::swap(before_, committed_);
  committed_elapsed_ = -experiment_.deltat;
}

void ShapeContacts::commit_within_step() {
  const auto over = committed_.places.begin() + static_cast<std::ptrdiff_t>(committed_.count);
  const auto end = std::ranges::copy(places(), committed_.places.begin()).out;
  // A saved state holds nothing of contacts that are over.
  if (end < over) std::fill(end, over, Place{});
  committed_.count = pending_.count;
  committed_elapsed_ = elapsed_;
  given_back_ += given_in_step_;
  given_in_step_ = 0.;
  std::ranges::copy(pending_.motions, committed_.motions.begin());
}

// Bristles.

contact::Bristle<double> ShapeContacts::bristle_at(std::span<const double> numbers,
                                                   std::int64_t slot) const {
  if (bristle_states_ == 0 || slot < 0) return {};
  const double* z = &numbers[bristle_states_ * static_cast<std::size_t>(slot)];
  return {{z[0], z[1], z[2]}, bristle_states_ > 3 ? z[3] : 0.};
}

void ShapeContacts::put_bristle(const contact::Bristle<double>& bristle, std::int64_t slot,
                                std::span<double> numbers) const {
  if (bristle_states_ == 0 || slot < 0) return;
  double* z = &numbers[bristle_states_ * static_cast<std::size_t>(slot)];
  z[0] = bristle.deflection.x;
  z[1] = bristle.deflection.y;
  z[2] = bristle.deflection.z;
  if (bristle_states_ > 3) z[3] = bristle.sliding;
}

void ShapeContacts::read_bristles(std::span<const double> numbers) {
  std::ranges::copy(numbers, bristles_.begin());
}

bool ShapeContacts::is_active_state(std::size_t i) const {
  const auto slot = static_cast<std::int64_t>(i / bristle_states_);
  return std::ranges::any_of(places(), [&](const Place& place) { return place.slot == slot; });
}

// Impulses.

void ShapeContacts::begin_impulses() {
  std::ranges::fill(impulses_, Vector3d{});
  std::ranges::fill(surface_impulses_, Vector3d{});
}

std::span<const Vector3d> ShapeContacts::impulses(std::size_t robot) const {
  return std::span(impulses_).subspan(first_bodies_[robot],
                                      first_bodies_[robot + 1] - first_bodies_[robot]);
}

void ShapeContacts::add_impulses(double weight) {
  for (std::size_t body = 0; body < forces_.size(); ++body)
    impulses_[body] += weight * forces_[body];
  for (std::size_t i = 0; i < surfaces_.size(); ++i) {
    const double power = dot(loads_[i].force, surfaces_[i].velocity) +
                         dot(loads_[i].moment, surfaces_[i].angular_velocity) +
                         dot(loads_[i].tangential_force, surfaces_[i].belt_velocity);
    surface_works_[i] += weight * power;
    surface_impulses_[i] += weight * loads_[i].force;
  }
}

// Events.

void ShapeContacts::event_values(std::span<dts::Workspace<double>* const> workspaces,
                                 double elapsed, std::span<double> values) {
  std::ranges::fill(values, 1.);
  move_objects(workspaces, elapsed);
  detection_.detect(motions_, *this, found_);
  match();
  for (std::size_t i = 0; i < found_.size(); ++i) {
    if (matches_[i] < 0) continue;
    const Place& from = committed_.places[static_cast<std::size_t>(matches_[i])];
    if (!from.memory.attached) continue;
    values[static_cast<std::size_t>(from.slot)] =
        law_->switching_value(kinematics(found_[i], from.slot), carried(found_[i], from),
                              constants_of(materials_, found_[i]));
  }
}

void ShapeContacts::cross_events(std::span<const int> directions) {
  for (Place& place : std::span(committed_.places).first(committed_.count)) {
    const int direction = directions[static_cast<std::size_t>(place.slot)];
    if (direction == 0 || !place.memory.attached) continue;
    place.memory.sliding =
        law_->slides_after(direction < 0, place.memory, constants_of(materials_, place.at));
  }
}

// Published.

double ShapeContacts::stored_energy() const {
  double sum = -given_back_;
  for (const Place& place : places()) {
    if (place.memory.attached)
      sum += place.at.weight * contact::surface_energy(place.at.depth, place.memory.stretch,
                                                       foot(place.at), place.at.normal,
                                                       constants_of(materials_, place.at),
                                                       law_->stored_energy);
  }
  return sum;
}

}  // namespace hookpoint::simulation
