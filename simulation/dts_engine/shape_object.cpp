#include "simulation/dts_engine/shape_object.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "contact/geometry/border.h"
#include "contact/geometry/height_field.h"
#include "contact/geometry/plane_surface.h"
#include "contact/geometry/stairs_surface.h"
#include "simulation/engine_interface/engine.h"
#include "simulation/experiment/robot_tree.h"

namespace hookpoint::simulation {
namespace {

/// Points of a rim on a grid of heights: it rolls as a polygon whose corners stand out by 2 % of its
/// radius, which is less than the grid's own edges do.
constexpr int rim_samples = 16;

/// Puts a shape's features into an object, in the object's axes.
class FeatureMaker {
 public:
  FeatureMaker(const ShapeSpec& shape, ShapeObject& object) : shape_(shape), object_(object) {}

  void operator()(const Sphere& sphere) const {
    object_.balls.push_back({place({}), sphere.radius, shape_.material, shape_.first_point});
    object_.rounds.push_back(
        {round({}, {}, sphere.radius, sphere.radius, {0., 0., 1.}, false), shape_.material});
  }
  void operator()(const Box& box) const {
    const contact::Polyhedron local = contact::Polyhedron::box(box.dimensions);
    std::vector<Vector3d> vertices;
    for (const Vector3d& vertex : local.vertices()) vertices.push_back(place(vertex));
    const Vector3d& d = box.dimensions;
    add_polyhedron(std::make_unique<contact::Polyhedron>(std::move(vertices),
                                                         contact::Polyhedron::box_loops()),
                   0.5 * std::min({d.x, d.y, d.z}));
  }
  void operator()(const Cylinder& cylinder) const {
    const Vector3d end{0., 0., 0.5 * cylinder.length};
    add_rim(-end, {0., 0., 1.}, cylinder.radius, {});
    if (cylinder.length > 0.) add_rim(end, {0., 0., 1.}, cylinder.radius, {});
    add_round(round(-end, end, cylinder.radius, cylinder.radius, {0., 0., 1.}, true));
  }
  void operator()(const Legcone& cone) const {
    const Vector3d far{cone.length, 0., 0.}, middle = 0.5 * far;
    for (const auto& [end, radius] :
         {std::pair{Vector3d{}, cone.proximal_radius}, std::pair{far, cone.distal_radius}}) {
      if (radius > 0.)
        add_rim(end, {1., 0., 0.}, radius, middle);
      else
        object_.balls.push_back({place(end), 0., shape_.material});
    }
    if (std::max(cone.proximal_radius, cone.distal_radius) > 0.)
      add_round(round({}, far, cone.proximal_radius, cone.distal_radius, {1., 0., 0.}, true));
  }
  void operator()(const Capsule& capsule) const {
    const Vector3d end{0., 0., 0.5 * capsule.length};
    for (const double sign : {-1., 1.}) {
      BallFeature ball{place(sign * end), capsule.radius, shape_.material,
                       shape_.first_point + (sign > 0. ? 1 : 0)};
      ball.outward = rotate(shape_.orientation, Vector3d{0., 0., sign});
      object_.balls.push_back(ball);
    }
    add_round(round(-end, end, capsule.radius, capsule.radius, {0., 0., 1.}, false));
  }
  void operator()(const Hull& hull) const {
    std::vector<Vector3d> vertices;
    Vector3d middle;
    for (const Vector3d& vertex : hull.vertices) {
      vertices.push_back(place(vertex));
      middle += (1. / static_cast<double>(hull.vertices.size())) * vertices.back();
    }
    auto solid = std::make_unique<contact::Polyhedron>(std::move(vertices), hull.faces);
    const contact::Face nearest = solid->nearest_face(middle);
    const double depth = dot(nearest.point - middle, nearest.normal);
    add_polyhedron(std::move(solid), depth);
  }

 private:
  Vector3d place(const Vector3d& p_SP) const {
    return shape_.location + rotate(shape_.orientation, p_SP);
  }
  contact::RoundSolid round(const Vector3d& from, const Vector3d& to, double radius,
                            double far_radius, const Vector3d& axis, bool flat_ends) const {
    return {place(from), place(to), radius, far_radius, rotate(shape_.orientation, axis),
            flat_ends};
  }
  void add_round(const contact::RoundSolid& solid) const {
    object_.rounds.push_back({solid, shape_.material});
    if (!solid.is_disc()) object_.sides.push_back({contact::side_of(solid), shape_.material});
  }
  void add_rim(const Vector3d& center, const Vector3d& axis, double radius,
               const Vector3d& middle) const {
    const Vector3d across = axis.z != 0. ? Vector3d{1., 0., 0.} : Vector3d{0., 0., 1.};
    object_.rims.push_back({{place(center), rotate(shape_.orientation, axis), radius,
                             rotate(shape_.orientation, across)},
                            place(middle),
                            shape_.material});
    const contact::Rim& rim = object_.rims.back().rim;
    for (int i = 0; i < rim_samples; ++i) {
      const auto [sine, cosine] = sine_cosine(2. * std::numbers::pi * i / rim_samples);
      const Vector3d radial = cosine * rim.reference + sine * cross(rim.axis, rim.reference);
      BallFeature sample;
      sample.center = rim.center + rim.radius * radial;
      sample.material = shape_.material;
      sample.is_rim_sample = true;
      sample.rim_radius = rim.radius;
      object_.balls.push_back(sample);
    }
  }
  void add_polyhedron(std::unique_ptr<contact::Polyhedron> solid, double half_thickness) const {
    // In the order of the body's boundary points.
    const std::size_t first = object_.balls.size();
    std::size_t sample = shape_.first_point;
    for (const Vector3d& vertex : solid->vertices())
      object_.balls.push_back({vertex, 0., shape_.material, sample++, true});
    solid->corners({}, [&](const contact::Corner& corner) {
      object_.balls[first + static_cast<std::size_t>(corner.id)].outward =
          contact::outward_of(corner);
    });
    object_.polyhedra.push_back({std::move(solid), half_thickness, shape_.material, first});
  }

  const ShapeSpec& shape_;
  ShapeObject& object_;
};

void include(const Vector3d& place, double reach, contact::Region& bounds) {
  const contact::Region other = contact::region_about(place, reach);
  bounds.low = {std::min(bounds.low.x, other.low.x), std::min(bounds.low.y, other.low.y),
                std::min(bounds.low.z, other.low.z)};
  bounds.high = {std::max(bounds.high.x, other.high.x), std::max(bounds.high.y, other.high.y),
                 std::max(bounds.high.z, other.high.z)};
}

void measure(ShapeObject& object) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  object.bounds = {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
  for (const BallFeature& ball : object.balls) include(ball.center, ball.radius, object.bounds);
  for (const RimFeature& at : object.rims) include(at.rim.center, at.rim.radius, object.bounds);
  for (const RoundFeature& round : object.rounds) {
    include(round.solid.from, round.solid.radius, object.bounds);
    include(round.solid.to, round.solid.far_radius, object.bounds);
  }
}

void add_body(const BodySpec& body, ShapeObject& object) {
  // ContactPoints, and shapes for which the file asks for samples.
  std::vector<bool> exact(body.boundary_points.size(), false);
  for (const ShapeSpec& shape : body.shapes) {
    if (shape.boundary_points != 0) continue;
    for (std::size_t i = 0; i < shape.point_count; ++i) exact[shape.first_point + i] = true;
    std::visit(FeatureMaker(shape, object), shape.geometry);
  }
  for (std::size_t i = 0; i < body.boundary_points.size(); ++i) {
    if (!exact[i])
      object.balls.push_back(
          {body.boundary_points[i], body.boundary_radius(i), body.boundary_material(i), i});
  }
}

std::unique_ptr<contact::Surface> surface_of(const contact::Terrain& ground) {
  const contact::TerrainDescription& description = ground.description();
  if (const auto* grid = std::get_if<contact::GridSurface>(&description.surface)) {
    if (grid->stairs)
      return std::make_unique<contact::StairsSurface>(*grid->stairs, description.material);
    return std::make_unique<contact::HeightField>(ground);
  }
  const contact::TilePoint tile = ground.query(0., 0., 0.);
  return std::make_unique<contact::PlaneSurface>(Vector3d{0., 0., tile.height}, tile.normal,
                                                 description.material);
}

}  // namespace

bool is_plane(const contact::TerrainDescription& terrain) {
  const auto* grid = std::get_if<contact::GridSurface>(&terrain.surface);
  return grid == nullptr ||
         std::ranges::all_of(grid->heights, [&](double z) { return z == grid->heights[0]; });
}

std::size_t ShapeObject::place_count() const {
  std::size_t count = balls.size() + contact::rim_points * rims.size() + 2 * sides.size();
  for (const PolyhedronFeature& polyhedron : polyhedra)
    count += polyhedron.solid->all_ridges().size();
  return count;
}

std::vector<ShapeObject> shape_objects(const Experiment& experiment,
                                       const contact::Terrain* ground) {
  std::vector<ShapeObject> objects;
  if (ground != nullptr) {
    ShapeObject& object = objects.emplace_back();
    object.kind = ShapeObject::Kind::terrain;
    object.ground = surface_of(*ground);
    object.ground_material = ground->description().material;
  }
  for (std::size_t i = 0; i < experiment.obstacles.size(); ++i) {
    const ObstacleSpec& obstacle = experiment.obstacles[i];
    ShapeObject& object = objects.emplace_back();
    object.kind = ShapeObject::Kind::obstacle;
    object.index = i;
    object.ground_material = obstacle.material;
    ShapeSpec shape{obstacle.geometry, {}, {}};
    shape.material = obstacle.material;
    std::visit(FeatureMaker(shape, object), obstacle.geometry);
    measure(object);
  }
  for (std::size_t r = 0; r < experiment.robots.size(); ++r) {
    const RobotSpec& robot = experiment.robots[r];
    std::size_t at = 0;
    for_each_body(robot, [&](const BodySpec& body) {
      ShapeObject& object = objects.emplace_back();
      object.index = r;
      object.body = at++;
      object.movable = object.body > 0 || robot.mobile;
      add_body(body, object);
      measure(object);
    });
  }
  return objects;
}

bool shapes_matter(const Experiment& experiment) {
  if (experiment.touch != "shapes") return false;
  const auto is_round = [](const ShapeSpec& shape) {
    return shape.boundary_points == 0 && !std::holds_alternative<Sphere>(shape.geometry) &&
           !std::holds_alternative<Box>(shape.geometry);
  };
  std::size_t robots_with_shapes = 0;
  bool something_moves = false, round = false;
  for (const RobotSpec& robot : experiment.robots) {
    bool has_shapes = false;
    for_each_body(robot, [&](const BodySpec& body) {
      const bool touches = !body.boundary_points.empty();
      const bool moves = &body != &robot.base || robot.mobile;
      has_shapes |= touches;
      something_moves |= touches && moves;
      round |= moves && std::ranges::any_of(body.shapes, is_round);
    });
    robots_with_shapes += has_shapes ? 1 : 0;
  }
  const bool on_ground = experiment.terrain && (round || !is_plane(*experiment.terrain));
  const bool by_itself = std::ranges::any_of(experiment.robots, &RobotSpec::self_contact);
  return something_moves && (on_ground || robots_with_shapes > 1 || by_itself ||
                             !experiment.obstacles.empty() || ground_moves(experiment));
}

}  // namespace hookpoint::simulation
