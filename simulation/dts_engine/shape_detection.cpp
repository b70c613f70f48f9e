#include "simulation/dts_engine/shape_detection.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/geometry/border.h"
#include "contact/geometry/rim_on_ridge.h"
#include "contact/geometry/rim_on_round.h"
#include "simulation/experiment/robot_tree.h"

namespace hookpoint::simulation {
namespace {

/// Numbers of features of a kind begin here, so that keys of different kinds differ.
constexpr std::int64_t kind_size = std::int64_t{1} << 40;
enum Kind : std::int64_t { ball_kind, rim_kind, corner_kind, edge_kind, side_kind, round_kind };
constexpr std::int64_t of_a_ridge =
    kind_size / 2;  // of key.other, where it is a ridge's or a rim's
constexpr std::int64_t part_size = std::int64_t{1} << 28;
/// How thick the ground is [m].
constexpr double solid_ground = std::numeric_limits<double>::infinity();

std::int64_t numbered(Kind kind, std::size_t part, std::int64_t number = 0) {
  return kind * kind_size + static_cast<std::int64_t>(part) * part_size + number;
}

/// The part that a number was made of.
std::size_t part_of(std::int64_t number) {
  return static_cast<std::size_t>(number % of_a_ridge / part_size);
}

/// Of a box along the axes of one frame, the box along the axes of another that holds it. `R` and `p`:
/// from the first to the second.
contact::Region turned(const contact::Region& box, const Matrix3d& R, const Vector3d& p) {
  const Vector3d center = p + R * (0.5 * (box.low + box.high));
  const Vector3d h = 0.5 * (box.high - box.low);
  const Vector3d half{std::abs(R.xx) * h.x + std::abs(R.xy) * h.y + std::abs(R.xz) * h.z,
                      std::abs(R.yx) * h.x + std::abs(R.yy) * h.y + std::abs(R.yz) * h.z,
                      std::abs(R.zx) * h.x + std::abs(R.zy) * h.y + std::abs(R.zz) * h.z};
  return {center - half, center + half};
}

/// Whether a point of a rim that is deepest under a face lies under it, and not under one beyond: past
/// a convex edge the ridge and the face beyond take over, past a concave one both faces press where it
/// is inside both. `continues(edge)`: the face does beyond it, in another object's.
template <class Continues>
bool is_under(const contact::Surface& surface, const contact::Face& face, const Vector3d& point,
              const Continues& continues) {
  constexpr double blunt = 0.7;  // cosine between the normals
  return std::ranges::all_of(face.all_edges(), [&](const contact::FaceEdge& edge) {
    if (edge.beyond < 0) return true;
    const contact::Face beyond = surface.face(edge.beyond);
    const bool past = dot(point - edge.point, edge.outward) > contact::edge_width;
    if (edge.fold == contact::Fold::concave) return !past || beyond.height(point) < 0.;
    const bool sharp =
        edge.fold == contact::Fold::convex && dot(face.normal, beyond.normal) < blunt;
    return !past && (!sharp || beyond.height(point) <= face.height(point) || continues(edge));
  });
}

/// How far the part of a ridge that is inside a shape with flat ends reaches below the nearer end [m]: the
/// way out over that end. `at`: where it crosses the rim of one of them.
double depth_of_ridge(const contact::Ridge& ridge, const contact::ShapeRim& shape,
                      const contact::RimCrossing& at) {
  const Vector3d on_ridge = at.place + at.depth * at.normal;
  const double along = dot(on_ridge - ridge.point, ridge.along);
  const double before = along - ridge.from, after = ridge.to - along;
  const Vector3d end = shape.end_against(at.normal), &center = shape.rim.center;
  const double slope = dot(ridge.along, end);
  const auto below = [&](const Vector3d& place, const Vector3d& normal, double inside) {
    const double of_part = slope == 0. ? 0. : inside * std::abs(slope);
    return of_part - dot(on_ridge - place, normal);
  };
  // A disc is left by either side.
  if (shape.is_disc()) return below(center, end, std::min(before, after));
  return std::min(below(center, end, slope > 0. ? before : after),
                  below(2. * shape.middle - center, -end, slope > 0. ? after : before));
}

double greatest_radius(const contact::RoundSide& side) {
  return std::max(side.radius, side.far_radius);
}

/// The places of one of a rim's points under several faces.
struct RimOnFaces {
  std::array<contact::Obstruction, contact::most_obstructions> faces;
  std::array<Vector3d, contact::most_obstructions> points;
  std::array<std::int64_t, contact::most_obstructions> ids{};
  std::size_t count = 0;

  void add(const Vector3d& point, const contact::Face& face, double depth) {
    if (count == faces.size()) return;
    faces[count] = {face.normal, depth, 1.};
    ids[count] = face.id;
    points[count++] = point;
  }
  void share() {
    const auto all = std::span(faces).first(count);
    const auto deep = [](const contact::Obstruction& face) { return face.depth > 0.; };
    if (count > 1 && std::ranges::all_of(all, deep)) contact::share_out(all);
  }
};

/// How far a place is to be lifted to be outside of a surface on whose border it lies [m]; zero of any
/// other place. `outward`: of a corner (contact/geometry/border.h), zero of another place.
Vector3d lift_off(const contact::Surface& surface, const Vector3d& place, const Vector3d& outward) {
  constexpr double over = 1.1 * contact::edge_width;  // so wide is the border
  if (!surface.contains(place)) return {};
  const auto touched = contact::touched_face(surface, place, outward);
  const contact::Face face = touched ? *touched : surface.nearest_face(place);
  const double height = face.height(place);
  return height < -contact::edge_width ? Vector3d{} : (over - height) * face.normal;
}

}  // namespace

bool ShapeContact::is_tracked() const { return key.feature < kind_size; }

bool ShapeContact::fades() const {
  const std::int64_t kind = key.feature / kind_size;
  return kind == edge_kind || kind == side_kind ||
         (kind == rim_kind && key.other % kind_size >= of_a_ridge);
}

Vector3d belt_velocity(const ShapeContact& contact, std::span<const ObjectMotion> motions) {
  const Vector3d belt = motions[static_cast<std::size_t>(contact.key.a)].belt -
                        motions[static_cast<std::size_t>(contact.key.b)].belt;
  return tangential(belt, contact.normal);
}

const contact::MaterialConstants<double>& constants_of(const ContactMaterials& materials,
                                                       const ShapeContact& contact) {
  return contact.key.a < contact.key.b ? materials.between(contact.material_a, contact.material_b)
                                       : materials.between(contact.material_b, contact.material_a);
}

std::size_t slots_for(const std::vector<ShapeObject>& objects) {
  constexpr std::size_t least = 32;
  std::size_t count = least;
  for (const ShapeObject& object : objects)
    if (object.movable) count += object.place_count();
  return count;
}

ShapeDetection::ShapeDetection(const Experiment& experiment,
                               const std::vector<ShapeObject>& objects,
                               const contact::Terrain* ground, double reach, bool self)
    : experiment_(experiment),
      objects_(objects),
      ground_(ground),
      reach_(reach),
      self_(self),
      carriers_(objects.size(), objects.size()),
      boxes_(objects.size()) {
  std::size_t first = 0, most_edges = 0;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const ShapeObject& object = objects[i];
    std::size_t edges = 0;
    for (const PolyhedronFeature& polyhedron : object.polyhedra)
      edges += polyhedron.solid->all_ridges().size();
    most_edges = std::max(most_edges, edges);
    if (object.kind == ShapeObject::Kind::body) {
      if (object.body == 0) first = i;
      if (object.body > 0)
        carriers_[i] = first + carriers_of(experiment.robots[object.index])[object.body];
    }
    if (object.kind != ShapeObject::Kind::terrain && !object.is_empty()) order_.push_back(i);
  }
  edges_.reserve(most_edges);
  has_floors_ = std::ranges::count_if(objects, may_be_of_floor) > 1;
  near_floor_.reserve(objects.size());
}

bool ShapeDetection::may_touch(std::size_t i, std::size_t j) const {
  const ShapeObject &a = objects_[i], &b = objects_[j];
  if (!a.movable && !b.movable) return false;
  if (a.kind != ShapeObject::Kind::body || b.kind != ShapeObject::Kind::body) return true;
  if (a.index != b.index) return true;
  return (self_ || experiment_.robots[a.index].self_contact) && carriers_[i] != j &&
         carriers_[j] != i;
}

contact::Region ShapeDetection::box_in(std::size_t object, const ObjectMotion& frame) const {
  const ObjectMotion& own = motions_[object];
  return turned(objects_[object].bounds, transpose(frame.R_WB) * own.R_WB,
                frame.to_object(own.p_WB));
}

void ShapeDetection::detect(std::span<const ObjectMotion> motions, const DetectionMemory& memory,
                            std::vector<ShapeContact>& contacts) {
  motions_ = motions;
  memory_ = &memory;
  contacts_ = &contacts;
  contacts.clear();
  left_out_ = false;
  const Vector3d reach{reach_, reach_, reach_};
  for (const std::size_t i : order_) {
    boxes_[i] = turned(objects_[i].bounds, motions[i].R_WB, motions[i].p_WB);
    boxes_[i] = {boxes_[i].low - reach, boxes_[i].high + reach};
  }
  near_floor_of_ = objects_.size();  // of none
  if (objects_[0].ground)
    for (const std::size_t i : order_)
      if (may_touch(0, i) && !objects_[0].ground->is_clear_of(near_box(i, motions[0]))) pair(i, 0);
  // Broad phase: in the order of their lower ends along x only the next few can overlap. The order of
  // a step before is nearly right, so that insertion takes O(n).
  for (std::size_t k = 1; k < order_.size(); ++k) {
    const std::size_t object = order_[k];
    std::size_t to = k;
    const auto before = [&](std::size_t a, std::size_t b) {
      return boxes_[a].low.x < boxes_[b].low.x || (boxes_[a].low.x == boxes_[b].low.x && a < b);
    };
    for (; to > 0 && before(object, order_[to - 1]); --to) order_[to] = order_[to - 1];
    order_[to] = object;
  }
  for (std::size_t k = 0; k < order_.size(); ++k) {
    for (std::size_t l = k + 1; l < order_.size(); ++l) {
      const std::size_t i = std::min(order_[k], order_[l]), j = std::max(order_[k], order_[l]);
      if (boxes_[order_[l]].low.x > boxes_[order_[k]].high.x) break;
      if (may_touch(i, j) && overlap(boxes_[i], boxes_[j])) pair(i, j);
    }
  }
  std::ranges::sort(contacts, [](const ShapeContact& x, const ShapeContact& y) {
    return std::pair(x.key, x.order) < std::pair(y.key, y.order);
  });
}

void ShapeDetection::pair(std::size_t i, std::size_t j) {
  first_of_pair_ = contacts_->size();
  for (const auto& [a, b] : {std::pair{i, j}, std::pair{j, i}}) {
    balls_on(a, b);
    rims_on(a, b);
    corners_on(a, b);
  }
  edges_on(i, j);
}

NearFloor ShapeDetection::near_floor(std::size_t object) {
  const contact::Region& body = boxes_[object];
  if (near_floor_of_ != object) {
    near_floor_of_ = object;
    near_floor_.clear();
    const Vector3d size = body.high - body.low;
    const contact::Region here{body.low - size, body.high + size};
    for (std::size_t i = 0; i < objects_.size(); ++i)
      if (may_be_of_floor(objects_[i]) && (objects_[i].ground || overlap(boxes_[i], here)))
        near_floor_.push_back(i);
  }
  return {objects_, motions_, near_floor_, body};
}

FloorPart ShapeDetection::floor_part(const ShapeContact& contact) {
  if (!has_floors_) return FloorPart::own;
  const auto a = static_cast<std::size_t>(contact.key.a),
             b = static_cast<std::size_t>(contact.key.b);
  if (may_be_of_floor(objects_[a]))
    return part_touched(near_floor(b), {a, contact.place, -contact.normal, false});
  if (!may_be_of_floor(objects_[b])) return FloorPart::own;
  const Vector3d on_b = contact.place + contact.depth * contact.normal;
  return part_touched(near_floor(a), {b, on_b, contact.normal, !contact.fades()});
}

// Of the same feature of a on another object of the floor; none: null.
ShapeContact* ShapeDetection::shared_with(const ShapeContact& contact) {
  constexpr double parallel = 0.999;  // cosine
  const auto same = std::ranges::find_if(*contacts_, [&](const ShapeContact& other) {
    return other.key.a == contact.key.a && other.key.feature == contact.key.feature &&
           may_be_of_floor(objects_[static_cast<std::size_t>(other.key.b)]) &&
           dot(other.normal, contact.normal) > parallel &&
           norm(other.place - contact.place) <= flush;
  });
  return same == contacts_->end() ? nullptr : &*same;
}

void ShapeDetection::add(const ShapeContact& contact) {
  const FloorPart part = floor_part(contact);
  if (part == FloorPart::hidden) return;
  if (ShapeContact* const other = part != FloorPart::own ? shared_with(contact) : nullptr) {
    // The later object has it, whichever is found first.
    if (other->key.b > contact.key.b) return;
    replace(*other, contact);
    return;
  }
  if (contacts_->size() < contacts_->capacity()) {
    contacts_->push_back(contact);
    contacts_->back().order = contacts_->size();
    contacts_->back().radius = radius_of(contact);
    return;
  }
  // The deepest carry.
  left_out_ = true;
  const auto shallowest = std::ranges::min_element(*contacts_, {}, &ShapeContact::depth);
  if (shallowest->depth >= contact.depth) return;
  replace(*shallowest, contact);
}

void ShapeDetection::replace(ShapeContact& place, const ShapeContact& contact) {
  const std::size_t order = place.order;
  place = contact;
  place.order = order;
  place.radius = radius_of(contact);
}

double ShapeDetection::radius_of(const ShapeContact& contact) const {
  const double a = radius_of_a(contact.key), b = radius_of_b(contact);
  return a > 0. && b > 0. ? a * b / (a + b) : std::max(a, b);
}

double ShapeDetection::radius_of_a(const ContactKey& key) const {
  const ShapeObject& a = objects_[static_cast<std::size_t>(key.a)];
  const std::size_t part = part_of(key.feature);
  switch (key.feature / kind_size) {
    case ball_kind: {
      const BallFeature& ball = a.balls[static_cast<std::size_t>(key.feature)];
      return std::max(ball.radius, ball.rim_radius);
    }
    case rim_kind:
      return a.rims[part].rim.radius;
    case side_kind:
      return greatest_radius(a.sides[part].side);
    default:
      return 0.;
  }
}

double ShapeDetection::radius_of_b(const ShapeContact& contact) const {
  const ShapeObject& b = objects_[static_cast<std::size_t>(contact.key.b)];
  const std::size_t part = part_of(contact.key.other);
  switch (contact.key.other / kind_size) {
    case side_kind:
      return greatest_radius(b.sides[part].side);
    case round_kind: {
      const contact::RoundSolid& solid = b.rounds[part].solid;
      constexpr double flat = 1. - 1e-9;  // cosine between an end's normal and the contact's
      const Vector3d axis = motions_[static_cast<std::size_t>(contact.key.b)].R_WB * solid.axis;
      if (solid.flat_ends && std::abs(dot(contact.normal, axis)) > flat) return 0.;
      return std::max(solid.radius, solid.far_radius);
    }
    default:
      return 0.;
  }
}

int ShapeDetection::material_of(std::size_t object, const Vector3d& place, int stated) const {
  if (stated != no_material) return stated;
  const ShapeObject& of = objects_[object];
  if (of.ground && !ground_->description().patches.empty())
    return ground_->query(motions_[object].to_object(place)).material;
  return of.ground_material;
}

void ShapeDetection::ball_on_surface(const contact::Surface& surface, std::size_t a, std::size_t b,
                                     const BallFeature& ball, std::int64_t feature,
                                     std::int64_t other, int material_b) {
  const ObjectMotion& frame = motions_[b];
  const Vector3d center = motions_[a].to_world(ball.center);
  const Vector3d outward = transpose_times(frame.R_WB, motions_[a].R_WB * ball.outward);
  Vector3d place_in_b = frame.to_object(center), lift;
  if (memory_->stays_outside()) {
    lift = lift_off(surface, place_in_b, ball.is_corner ? outward : Vector3d{});
    place_in_b += lift;
  }
  if (surface.is_clear_of(contact::region_about(place_in_b, ball.radius + reach_))) return;
  const ContactKey key{static_cast<std::int64_t>(a), static_cast<std::int64_t>(b), feature, other};
  const Vector3d before = memory_->before(b).to_object(memory_->before(a).to_world(ball.center));
  TakenOver taken{memory_->holding(key), {}};
  if (taken.holding.count == 0 && ball.radius == 0. && surface.contains(place_in_b))
    taken = taken_over(surface, a, b, before, place_in_b);
  const contact::BallContacts found = contact::ball_on_surface(
      surface, place_in_b, ball.radius, before, taken.holding, reach_, outward);
  for (const contact::SurfaceContact& at : found.all()) {
    const Vector3d normal = frame.R_WB * at.normal;
    const Vector3d place = center - ball.radius * normal;
    const double depth = at.depth + dot(lift, at.normal);
    ShapeContact contact{key,
                         place,
                         normal,
                         depth,
                         at.part,
                         ball.material,
                         material_of(b, place, material_b),
                         found.holding};
    const double share =
        ball.is_corner ? contact::share_with_corner(surface, place_in_b, at.normal, at.depth) : 1.;
    // A corner inside a floor of several objects takes none.
    if (share < 1. && floor_part(contact) != FloorPart::inside) contact.weight *= share;
    if (taken.beside) contact.begun_at = memory_->begun_at(contact, *taken.beside);
    add(contact);
  }
}

// Not what they came through: a corner that comes in over an edge takes over what the edge held, and one that
// comes over a seam between objects, from one that is flush with b or with a, what that one held. Where the one
// beside is lower the corner hits a step.
ShapeDetection::TakenOver ShapeDetection::taken_over(const contact::Surface& surface, std::size_t a,
                                                     std::size_t b, const Vector3d& before,
                                                     const Vector3d& inside) const {
  const Vector3d place = memory_->before(b).to_world(before);
  const double near = same_place + norm(inside - before);
  const auto face_at = [&](const PressingPlace& pressing, double most_depth) {
    const Vector3d normal = transpose_times(motions_[b].R_WB, pressing.normal);
    return contact::face_along(surface, inside, normal, most_depth + near);
  };
  if (const auto edge = memory_->place_near(a, b, place, near)) {
    const std::int64_t face = face_at(*edge, edge->depth);
    if (face >= 0) return {{{face}, 1}, {}};
  }
  const auto beside = memory_->place_beside(a, b, place);
  if (!beside) return {};
  // One that tilts is deeper at the corner than where it presses.
  constexpr double tilt = 0.01;
  const std::int64_t id = face_at(*beside, 2. * beside->depth + tilt * beside->distance);
  if (id < 0) return {};
  const contact::Face face = surface.face(id);
  const bool is_own = beside->a.object == static_cast<std::int64_t>(a);
  const double step = is_own ? face.height(memory_->before(b).to_object(beside->b.place))
                             : dot(beside->a.place - place, beside->normal);
  const bool is_lower = beside->distance < near && -face.height(before) <= beside->depth + flush;
  if (std::abs(step) > flush && !is_lower) return {};
  return {{{id}, 1}, beside};
}

std::size_t ShapeDetection::end_before(const contact::RoundSolid& disc, std::size_t b,
                                       std::size_t a, const Vector3d& place) const {
  constexpr double level = 1e-3;  // of the radius
  const contact::RoundEnd end = contact::end_of(disc, 1);
  const auto height = [&](const Vector3d& of_a) {
    return end.height(memory_->before(b).to_object(memory_->before(a).to_world(of_a)));
  };
  const double over = height(place);
  if (std::abs(over) > level * disc.radius) return over > 0. ? 1 : 0;
  // On the disc to rounding: it came from where the rest of its body is.
  const contact::Region& body = objects_[a].bounds;
  const double middle = height(0.5 * (body.low + body.high));
  return (middle != 0. ? middle : over) > 0. ? 1 : 0;
}

// By the end that holds it, else the one over which it was before. Beside the disc nothing holds it: a ball
// may go round the rim.
std::optional<contact::RoundContact> ShapeDetection::on_disc(const contact::RoundSolid& disc,
                                                             const BallFeature& ball,
                                                             const ContactKey& key,
                                                             contact::Holding& held) const {
  const auto a = static_cast<std::size_t>(key.a), b = static_cast<std::size_t>(key.b);
  const Vector3d center = motions_[b].to_object(motions_[a].to_world(ball.center));
  const contact::Holding before = memory_->holding(key);
  const std::size_t end = before.count > 0 ? static_cast<std::size_t>(before.faces[0])
                                           : end_before(disc, b, a, ball.center);
  held = {};
  if (!contact::is_beside(disc, center)) held = {{static_cast<std::int64_t>(end)}, 1};
  return contact::ball_on_disc(disc, center, ball.radius, reach_, end);
}

void ShapeDetection::balls_on(std::size_t a, std::size_t b) {
  const ShapeObject &own = objects_[a], &other = objects_[b];
  const auto wide = [](const BallFeature& ball) { return ball.radius > 0.; };
  for (std::size_t k = 0; k < own.balls.size(); ++k) {
    const BallFeature& ball = own.balls[k];
    const std::int64_t feature = numbered(ball_kind, 0, static_cast<std::int64_t>(k));
    if (other.ground && (!ball.is_rim_sample || other.ground->is_rough()))
      ball_on_surface(*other.ground, a, b, ball, feature, 0, no_material);
    if (ball.is_rim_sample) continue;
    for (std::size_t p = 0; p < other.polyhedra.size(); ++p)
      ball_on_surface(*other.polyhedra[p].solid, a, b, ball, feature, numbered(corner_kind, p),
                      other.polyhedra[p].material);
    for (std::size_t p = 0; p < other.rounds.size(); ++p) {
      const RoundFeature& round = other.rounds[p];
      const Vector3d center = motions_[a].to_world(ball.center);
      const ContactKey key{static_cast<std::int64_t>(a), static_cast<std::int64_t>(b), feature,
                           numbered(round_kind, p)};
      contact::Holding held;
      const auto at = round.solid.is_disc()
                          ? on_disc(round.solid, ball, key, held)
                          : contact::ball_on_round(round.solid, motions_[b].to_object(center),
                                                   ball.radius, reach_);
      if (!at) continue;
      // Two balls, or ends of capsules, meet once; and a ball meets a polyhedron's corner itself.
      const bool as_ball = !round.solid.flat_ends && !at->on_side;
      if (as_ball && (wide(ball) ? a > b : ball.is_corner)) continue;
      const Vector3d normal = motions_[b].R_WB * at->normal;
      add({key, center - ball.radius * normal, normal, at->depth, 1., ball.material,
           material_of(b, center, round.material), held});
    }
  }
}

// Corners of the ground, against the polyhedra and the round sides of a body; the corners of bodies
// are among their balls.
void ShapeDetection::corners_on(std::size_t a, std::size_t b) {
  const ShapeObject &own = objects_[a], &other = objects_[b];
  if (!own.ground || (other.polyhedra.empty() && other.rounds.empty())) return;
  own.ground->corners(near_box(b, motions_[a]), [&](const contact::Corner& corner) {
    BallFeature point{corner.position, 0., corner.material};
    point.is_corner = true;
    point.outward = contact::outward_of(corner);
    const std::int64_t feature = numbered(corner_kind, 0, corner.id);
    for (std::size_t p = 0; p < other.polyhedra.size(); ++p)
      ball_on_surface(*other.polyhedra[p].solid, a, b, point, feature, numbered(corner_kind, p),
                      other.polyhedra[p].material);
    for (std::size_t p = 0; p < other.rounds.size(); ++p) {
      const RoundFeature& round = other.rounds[p];
      const Vector3d place = motions_[a].to_world(corner.position);
      const auto at = contact::ball_on_round(round.solid, motions_[b].to_object(place), 0., reach_);
      // The ball of a capsule's end meets corners as a ball; of a disc there is no inside.
      if (!at || (!round.solid.flat_ends && !at->on_side) || round.solid.is_disc()) continue;
      add({{static_cast<std::int64_t>(a), static_cast<std::int64_t>(b), feature,
            numbered(round_kind, p)},
           place,
           motions_[b].R_WB * at->normal,
           at->depth,
           1.,
           corner.material,
           round.material,
           {}});
    }
  });
}

void ShapeDetection::rim_on_surface(const contact::Surface& surface, std::size_t a, std::size_t b,
                                    const RimFeature& feature_of_a, std::int64_t feature,
                                    std::int64_t other, int material_b, double half_thickness) {
  const ObjectMotion& frame = motions_[b];
  const contact::ShapeRim shape = rim_in(a, feature_of_a, frame);
  const contact::Rim& rim = shape.rim;
  const auto touch = [&](const Vector3d& point, const Vector3d& normal, double depth, double weight,
                         std::size_t number, std::int64_t of_b) {
    const Vector3d place = frame.to_world(point);
    add({{static_cast<std::int64_t>(a), static_cast<std::int64_t>(b),
          feature + static_cast<std::int64_t>(number), of_b},
         place,
         frame.R_WB * normal,
         depth,
         weight,
         feature_of_a.material,
         material_of(b, place, material_b),
         {}});
  };
  // Faces: the point that is deepest under each, where that is the face over it.
  std::array<RimOnFaces, contact::rim_points> on_faces;
  surface.faces(
      contact::region_about(rim.center, rim.radius + reach_), [&](const contact::Face& face) {
        if (!shape.is_over(face.height(shape.middle), half_thickness)) return;
        const auto points = contact::deepest_points(rim, face.normal, -face.height(rim.center));
        for (std::size_t i = 0; i < points.size(); ++i) {
          const double depth = -face.height(points[i]);
          if (depth <= -reach_) continue;
          const auto continues = [&](const contact::FaceEdge& edge) {
            return has_floors_ && may_be_of_floor(objects_[b]) &&
                   continues_beyond(near_floor(a), b, face, edge, points[i]);
          };
          if (is_under(surface, face, points[i], continues))
            on_faces[i].add(points[i], face, depth);
        }
      });
  for (std::size_t i = 0; i < on_faces.size(); ++i) {
    on_faces[i].share();
    for (std::size_t k = 0; k < on_faces[i].count; ++k) {
      const contact::Obstruction& at = on_faces[i].faces[k];
      if (at.part > 0.)
        touch(on_faces[i].points[k], at.normal, at.depth, at.part, i, other + on_faces[i].ids[k]);
    }
  }
  surface.ridges(
      contact::region_about(rim.center, rim.radius + reach_), [&](const contact::Ridge& ridge) {
        const contact::RimCrossings found = contact::rim_on_ridge(ridge, rim, reach_);
        for (const contact::RimCrossing& at : found.all()) {
          if (at.depth > rim.radius) continue;
          // Between the side and the end of the shape that meet in the rim.
          const double weight =
              contact::between(at.normal, ridge.outwards) *
              contact::between(-at.normal, {at.radial, shape.end_against(at.normal)}) *
              contact::shorter_way(at.depth, depth_of_ridge(ridge, shape, at));
          // Not numbered: where one begins or ends the others stay what they are.
          if (weight > 0.)
            touch(at.place, at.normal, at.depth, weight, 0, other + of_a_ridge + ridge.id);
        }
      });
}

void ShapeDetection::rim_on_round(const RoundFeature& round, std::size_t a, std::size_t b,
                                  const RimFeature& feature_of_a, std::int64_t feature,
                                  std::int64_t other) {
  const contact::ShapeRim rim = rim_in(a, feature_of_a, motions_[b]);
  const contact::CameOver came_over =
      round.solid.is_disc() ? came_over_end(round.solid, a, b, feature_of_a, feature, other)
                            : contact::CameOver{};
  // Two rims cross each other once.
  const contact::RimContacts found =
      contact::rim_on_round(round.solid, rim, reach_, a < b, came_over);
  for (const contact::RimContact& at : found.all()) {
    const Vector3d place = motions_[b].to_world(at.place);
    const std::int64_t of_b =
        at.kind == contact::RimContact::Kind::rim ? of_a_ridge + static_cast<std::int64_t>(at.end)
        : at.kind == contact::RimContact::Kind::side ? 2
                                                     : static_cast<std::int64_t>(at.end);
    add({{static_cast<std::int64_t>(a), static_cast<std::int64_t>(b),
          feature + static_cast<std::int64_t>(at.number), other + of_b},
         place,
         motions_[b].R_WB * at.normal,
         at.depth,
         at.weight,
         feature_of_a.material,
         material_of(b, place, round.material),
         {{static_cast<std::int64_t>(at.end)}, 1}});
  }
}

// That which holds a point of the rim, else the one over which the shape was before.
contact::CameOver ShapeDetection::came_over_end(const contact::RoundSolid& disc, std::size_t a,
                                                std::size_t b, const RimFeature& rim,
                                                std::int64_t feature, std::int64_t other) const {
  for (const std::int64_t end : {0, 1}) {
    for (std::int64_t number = 0; number < std::int64_t{contact::rim_points}; ++number) {
      const ContactKey key{static_cast<std::int64_t>(a), static_cast<std::int64_t>(b),
                           feature + number, other + end};
      if (memory_->holding(key).count > 0) return {static_cast<std::size_t>(end), true};
    }
  }
  return {end_before(disc, b, a, rim.middle), false};
}

contact::ShapeRim ShapeDetection::rim_in(std::size_t object, const RimFeature& of,
                                         const ObjectMotion& frame) const {
  const auto direction = [&](const Vector3d& of_object) {
    return transpose_times(frame.R_WB, motions_[object].R_WB * of_object);
  };
  const auto place = [&](const Vector3d& p) {
    return frame.to_object(motions_[object].to_world(p));
  };
  return {
      {place(of.rim.center), direction(of.rim.axis), of.rim.radius, direction(of.rim.reference)},
      place(of.middle)};
}

void ShapeDetection::rims_on(std::size_t a, std::size_t b) {
  const ShapeObject &own = objects_[a], &other = objects_[b];
  for (std::size_t k = 0; k < own.rims.size(); ++k) {
    const std::int64_t feature = numbered(rim_kind, k);
    if (other.ground && !other.ground->is_rough())
      rim_on_surface(*other.ground, a, b, own.rims[k], feature, 0, no_material, solid_ground);
    for (std::size_t p = 0; p < other.polyhedra.size(); ++p)
      rim_on_surface(*other.polyhedra[p].solid, a, b, own.rims[k], feature,
                     numbered(corner_kind, p), other.polyhedra[p].material,
                     other.polyhedra[p].half_thickness);
    for (std::size_t p = 0; p < other.rounds.size(); ++p)
      rim_on_round(other.rounds[p], a, b, own.rims[k], feature, numbered(round_kind, p));
  }
}

// Round sides of a across the ridges of `surface`, a part of b.
void ShapeDetection::sides_on_ridges(const contact::Surface& surface, std::size_t a, std::size_t b,
                                     std::int64_t other, int material_b) {
  const ObjectMotion& frame = motions_[b];
  const ShapeObject& own = objects_[a];
  if (own.sides.empty()) return;
  surface.ridges(near_box(a, frame), [&](const contact::Ridge& ridge) {
    for (std::size_t k = 0; k < own.sides.size(); ++k) {
      const contact::RoundSide side = side_in(a, k, frame);
      const double widening = side.far_radius - side.radius;
      const contact::BodyEdge edge{side.from, side.to, side.radius,
                                   {},        {},      widening / norm(side.to - side.from)};
      const double widest = std::max(side.radius, side.far_radius);
      const auto at = contact::edge_on_ridge(ridge, edge, reach_, 2. * widest);
      if (!at) continue;
      const Vector3d on_ridge = at->place + at->depth * at->normal;
      const double weight =
          at->weight * contact::shorter_way(at->depth, side.depth_below_ends(on_ridge));
      if (weight == 0.) continue;
      const Vector3d place = frame.to_world(at->place);
      add({{static_cast<std::int64_t>(a), static_cast<std::int64_t>(b), numbered(side_kind, k),
            other + ridge.id},
           place,
           frame.R_WB * at->normal,
           at->depth,
           weight,
           own.sides[k].material,
           material_of(b, place, material_b),
           {}});
    }
  });
}

contact::RoundSide ShapeDetection::side_in(std::size_t object, std::size_t side,
                                           const ObjectMotion& frame) const {
  contact::RoundSide at = objects_[object].sides[side].side;
  for (Vector3d* place : {&at.from, &at.to, &at.ends[0], &at.ends[1]})
    *place = frame.to_object(motions_[object].to_world(*place));
  return at;
}

contact::BodyEdge ShapeDetection::edge_of(const PolyhedronFeature& polyhedron, std::size_t ridge,
                                          std::size_t a, const ObjectMotion& frame) const {
  const auto place = [&](const Vector3d& p) { return frame.to_object(motions_[a].to_world(p)); };
  const auto turned = [&](const std::array<Vector3d, 2>& directions) {
    return std::array{transpose_times(frame.R_WB, motions_[a].R_WB * directions[0]),
                      transpose_times(frame.R_WB, motions_[a].R_WB * directions[1])};
  };
  const contact::Polyhedron& solid = *polyhedron.solid;
  const auto [from, to] = solid.ends(ridge);
  const contact::Ridge& own = solid.all_ridges()[ridge];
  return {place(solid.vertices()[from]), place(solid.vertices()[to]), 0., turned(own.normals),
          turned(own.outwards)};
}

// The edges of a's polyhedra, one polyhedron after the other, in the axes of `frame`.
void ShapeDetection::find_edges(std::size_t a, const ObjectMotion& frame) {
  for (const PolyhedronFeature& polyhedron : objects_[a].polyhedra)
    for (std::size_t k = 0; k < polyhedron.solid->all_ridges().size(); ++k)
      edges_.push_back(edge_of(polyhedron, k, a, frame));
}

contact::Region ShapeDetection::near_box(std::size_t object, const ObjectMotion& frame) const {
  const contact::Region box = box_in(object, frame);
  const Vector3d reach{reach_, reach_, reach_};
  return {box.low - reach, box.high + reach};
}

// Whether a corner at the crossing is inside the other solid, and touches there itself.
bool ShapeDetection::is_corners(const contact::EdgeContact& at, const contact::Surface& surface,
                                const contact::Ridge& ridge, const contact::Polyhedron& solid,
                                std::size_t edge, std::size_t a, const ObjectMotion& frame) const {
  const auto end = [](const std::array<std::size_t, 2>& ends, int which) {
    return ends[static_cast<std::size_t>(which)];
  };
  if (at.at_end >= 0) {
    const Vector3d& corner = solid.vertices()[end(solid.ends(edge), at.at_end)];
    if (surface.contains(frame.to_object(motions_[a].to_world(corner)))) return true;
  }
  if (at.at_ridge_end < 0) return false;
  const Vector3d corner =
      ridge.point + (at.at_ridge_end == 0 ? ridge.from : ridge.to) * ridge.along;
  return solid.contains(motions_[a].to_object(frame.to_world(corner)));
}

// Whether the corner at an end of an edge of `of` is under a face of `on` whose plane holds the crossing of
// that edge at `place`, and along which the crossing pushes (world axes): the edge stands on the face, and
// does not lie across the ridge beside.
bool ShapeDetection::stands_on_face(std::size_t of, std::size_t corner, std::size_t on,
                                    const Vector3d& place, const Vector3d& normal) const {
  constexpr double aside = 0.2;  // cosine
  return std::ranges::any_of(
      std::span(*contacts_).subspan(first_of_pair_), [&](const ShapeContact& contact) {
        return static_cast<std::size_t>(contact.key.a) == of &&
               static_cast<std::size_t>(contact.key.b) == on &&
               static_cast<std::size_t>(contact.key.feature) == corner && contact.depth > 0. &&
               std::abs(dot(contact.normal, normal)) < aside &&
               dot(place - contact.place, contact.normal) <= 2. * contact.depth;
      });
}

// Edges of a's polyhedra across the ridges of `surface`, a part of b.
void ShapeDetection::edges_on_ridges(const contact::Surface& surface,
                                     const PolyhedronFeature* polyhedron_b, std::size_t a,
                                     std::size_t b, std::int64_t other, int material_b) {
  const double half_thickness =
      polyhedron_b != nullptr ? polyhedron_b->half_thickness : solid_ground;
  const ObjectMotion& frame = motions_[b];
  const ShapeObject& own = objects_[a];
  if (own.polyhedra.empty()) return;
  constexpr std::size_t most = 8;  // edges of one polyhedron that a straight line crosses
  struct Crossing {
    contact::EdgeContact contact;
    std::size_t edge = 0;
  };
  edges_.clear();
  surface.ridges(near_box(a, frame), [&](const contact::Ridge& ridge) {
    if (edges_.empty()) find_edges(a, frame);
    std::size_t first = 0;
    for (std::size_t p = 0; p < own.polyhedra.size(); ++p) {
      const PolyhedronFeature& polyhedron = own.polyhedra[p];
      const contact::Polyhedron& solid = *polyhedron.solid;
      const auto edges = std::span(edges_).subspan(first, solid.all_ridges().size());
      first += edges.size();
      std::array<Crossing, most> found;
      std::size_t count = 0;
      for (std::size_t k = 0; k < edges.size() && count < most; ++k) {
        const auto at = contact::edge_on_ridge(ridge, edges[k], reach_,
                                               std::min(polyhedron.half_thickness, half_thickness));
        if (at && !is_corners(*at, surface, ridge, solid, k, a, frame)) found[count++] = {*at, k};
      }
      // What a crossing has to share with another that comes near the same end of both edges.
      const auto share = [&](const Crossing& crossing, std::size_t end) {
        const auto part = [](const Crossing& of, std::size_t at) {
          return at == 0 ? of.contact.along : 1. - of.contact.along;
        };
        for (const Crossing& other_crossing : std::span(found).first(count)) {
          if (other_crossing.edge == crossing.edge) continue;
          for (const std::size_t other_end : {0, 1}) {
            if (solid.ends(other_crossing.edge)[other_end] != solid.ends(crossing.edge)[end])
              continue;
            const double here = part(crossing, end), there = part(other_crossing, other_end);
            const double sum = here + there - here * there;
            return sum > 0. ? there / sum : 0.5;
          }
        }
        return 1.;
      };
      for (const Crossing& crossing : std::span(found).first(count)) {
        const double weight =
            contact::end_weighted(crossing.contact, {share(crossing, 0), share(crossing, 1)});
        if (weight <= 0.) continue;
        const Vector3d place = frame.to_world(crossing.contact.place);
        const Vector3d normal = frame.R_WB * crossing.contact.normal;
        const std::size_t end = crossing.contact.along < 0.5 ? 0 : 1;
        if (stands_on_face(a, polyhedron.first_corner + solid.ends(crossing.edge)[end], b, place,
                           normal))
          continue;
        if (polyhedron_b != nullptr) {
          const double at = dot(crossing.contact.place - ridge.point, ridge.along);
          const std::size_t ridge_end = at < 0.5 * (ridge.from + ridge.to) ? 0 : 1;
          const std::size_t corner =
              polyhedron_b->solid->ends(static_cast<std::size_t>(ridge.id))[ridge_end];
          if (stands_on_face(b, polyhedron_b->first_corner + corner, a, place, normal)) continue;
        }
        add({{static_cast<std::int64_t>(a), static_cast<std::int64_t>(b),
              numbered(edge_kind, p, static_cast<std::int64_t>(crossing.edge)), other + ridge.id},
             place,
             normal,
             crossing.contact.depth,
             weight,
             polyhedron.material,
             material_of(b, place, material_b),
             {}});
      }
    }
  });
}

void ShapeDetection::sides_on_sides(std::size_t a, std::size_t b) {
  const ShapeObject &own = objects_[a], &other = objects_[b];
  const ObjectMotion& frame = motions_[b];
  for (std::size_t k = 0; k < own.sides.size(); ++k) {
    const contact::RoundSide first = side_in(a, k, frame);
    for (std::size_t l = 0; l < other.sides.size(); ++l) {
      const auto at = contact::crossed_sides(first, other.sides[l].side, reach_);
      if (!at) continue;
      const Vector3d place = frame.to_world(at->place);
      add({{static_cast<std::int64_t>(a), static_cast<std::int64_t>(b), numbered(side_kind, k),
            numbered(side_kind, l)},
           place,
           frame.R_WB * at->contact.normal,
           at->contact.depth,
           at->weight,
           own.sides[k].material,
           material_of(b, place, other.sides[l].material),
           {}});
    }
  }
}

void ShapeDetection::edges_on(std::size_t a, std::size_t b) {
  const ShapeObject &own = objects_[a], &other = objects_[b];
  if (other.ground) {
    sides_on_ridges(*other.ground, a, b, 0, no_material);
    edges_on_ridges(*other.ground, nullptr, a, b, 0, no_material);
  }
  for (std::size_t p = 0; p < other.polyhedra.size(); ++p) {
    const PolyhedronFeature& polyhedron = other.polyhedra[p];
    sides_on_ridges(*polyhedron.solid, a, b, numbered(edge_kind, p), polyhedron.material);
    edges_on_ridges(*polyhedron.solid, &polyhedron, a, b, numbered(edge_kind, p),
                    polyhedron.material);
  }
  for (std::size_t p = 0; p < own.polyhedra.size(); ++p)
    sides_on_ridges(*own.polyhedra[p].solid, b, a, numbered(edge_kind, p),
                    own.polyhedra[p].material);
  sides_on_sides(a, b);
}

}  // namespace hookpoint::simulation
