#include "reference/bullet/shapes.h"

#include <LinearMath/btGeometryUtil.h>

#include <cmath>
#include <numbers>

namespace hookpoint::reference {
namespace {

/// Bullet inflates a hull by its margin, so the hull is made smaller by it. Smaller than the 4 cm
/// default, which would round a leg away; not 0, which the manual warns against (GJK then works on
/// touching hulls).
constexpr double hull_margin = 1e-3;
constexpr int hull_sides = 32;

struct Builder {
  std::unique_ptr<btCollisionShape> operator()(const simulation::Box& box) const {
    return std::make_unique<btBoxShape>(0.5 * bullet(box.dimensions));
  }
  std::unique_ptr<btCollisionShape> operator()(const simulation::Sphere& sphere) const {
    return std::make_unique<btSphereShape>(sphere.radius);
  }
  std::unique_ptr<btCollisionShape> operator()(const simulation::Cylinder& cylinder) const {
    return std::make_unique<btCylinderShapeZ>(
        btVector3(cylinder.radius, cylinder.radius, 0.5 * cylinder.length));
  }
  std::unique_ptr<btCollisionShape> operator()(const simulation::Legcone& cone) const {
    auto hull = std::make_unique<btConvexHullShape>();
    const auto circle = [&hull](double x, double radius) {
      for (int i = 0; i < hull_sides; ++i) {
        const double angle = 2. * std::numbers::pi * i / hull_sides;
        hull->addPoint(btVector3(x, radius * std::cos(angle), radius * std::sin(angle)), false);
      }
    };
    circle(hull_margin, cone.proximal_radius - hull_margin);
    circle(cone.length - hull_margin, cone.distal_radius - hull_margin);
    hull->setMargin(hull_margin);
    hull->recalcLocalAabb();
    return hull;
  }
  std::unique_ptr<btCollisionShape> operator()(const simulation::Capsule& capsule) const {
    return std::make_unique<btCapsuleShapeZ>(capsule.radius, capsule.length);
  }
  /// Its faces moved inwards by the margin.
  std::unique_ptr<btCollisionShape> operator()(const simulation::Hull& solid) const {
    btAlignedObjectArray<btVector3> planes, vertices;
    for (const std::vector<std::size_t>& face : solid.faces) {
      Vector3d area;
      const Vector3d& first = solid.vertices[face[0]];
      for (std::size_t i = 2; i < face.size(); ++i)
        area += cross(solid.vertices[face[i - 1]] - first, solid.vertices[face[i]] - first);
      const Vector3d normal = (1. / norm(area)) * area;
      btVector3 plane = bullet(normal);
      plane.setW(hull_margin - dot(normal, first));
      planes.push_back(plane);
    }
    btGeometryUtil::getVerticesFromPlaneEquations(planes, vertices);
    auto hull = std::make_unique<btConvexHullShape>();
    for (int i = 0; i < vertices.size(); ++i) hull->addPoint(vertices[i], false);
    hull->setMargin(hull_margin);
    hull->recalcLocalAabb();
    return hull;
  }
};

bool is_identity(const btTransform& pose) {
  return pose.getOrigin().length2() == 0. && pose.getBasis() == btMatrix3x3::getIdentity();
}

/// A static box with its top face on the plane, as the library's first example has it. Against a
/// btStaticPlaneShape a box gets one contact a step and rocks: its slip is 3 % slower at 1 ms. The
/// box is wide enough to slide on for minutes.
void build(BulletShape& ground, const GroundPlane& plane) {
  constexpr double half_width = 1e4, half_height = 100.;  // [m]
  ground.shape = std::make_unique<btBoxShape>(btVector3(half_width, half_width, half_height));
  const btVector3 normal = bullet(plane.normal);
  ground.X_WG = btTransform(shortestArcQuat(btVector3(0., 0., 1.), normal),
                            (plane.offset - half_height) * normal);
}

void build(BulletShape& ground, const GroundStairs& /*stairs*/) {
  ground.shape = std::make_unique<btEmptyShape>();
}

void build(BulletShape& ground, const GroundMesh& mesh) {
  for (const Vector3d& vertex : mesh.vertices)
    ground.vertices.insert(ground.vertices.end(), {vertex.x, vertex.y, vertex.z});
  for (const auto& triangle : mesh.triangles)
    ground.indices.insert(ground.indices.end(), triangle.begin(), triangle.end());
  ground.mesh = std::make_unique<btTriangleIndexVertexArray>(
      static_cast<int>(mesh.triangles.size()), ground.indices.data(),
      static_cast<int>(3 * sizeof(int)), static_cast<int>(mesh.vertices.size()),
      ground.vertices.data(), static_cast<int>(3 * sizeof(double)));
  ground.shape = std::make_unique<btBvhTriangleMeshShape>(ground.mesh.get(), true);
  // Its margin of 4 cm would hold every shape above the triangles; the shapes' own margins lie
  // inside them.
  ground.shape->setMargin(0.);
}

}  // namespace

BulletFrame principal_frame(const simulation::MassSpec& mass) {
  const Symmetric3d& I = mass.inertia;
  BulletFrame frame{btTransform(btMatrix3x3::getIdentity(), bullet(mass.center_of_mass)),
                    {I.xx, I.yy, I.zz}};
  if (I.xy == 0. && I.xz == 0. && I.yz == 0.) return frame;
  btMatrix3x3 diagonal(I.xx, I.xy, I.xz, I.xy, I.yy, I.yz, I.xz, I.yz, I.zz);
  btMatrix3x3 axes;
  constexpr int sweeps = 64;  // of one rotation each; a 3x3 matrix needs about ten
  diagonal.diagonalize(axes, 1e-16, sweeps);
  frame.X_BP.setBasis(axes);
  frame.inertia = {diagonal[0][0], diagonal[1][1], diagonal[2][2]};
  return frame;
}

std::unique_ptr<BulletShape> make_bullet_shape(const simulation::ShapeGeometry& geometry) {
  auto result = std::make_unique<BulletShape>();
  result->shape = std::visit(Builder{}, geometry);
  // A box is rounded by its margin, 4 cm by itself, where it meets what is no box.
  if (std::holds_alternative<simulation::Box>(geometry)) result->shape->setMargin(hull_margin);
  return result;
}

std::unique_ptr<BulletShape> make_bullet_shape(
    const std::vector<const simulation::ShapeSpec*>& shapes, const btTransform& X_BP) {
  auto result = std::make_unique<BulletShape>();
  if (shapes.empty()) {
    result->shape = std::make_unique<btEmptyShape>();
    return result;
  }
  std::vector<btTransform> poses;
  for (const simulation::ShapeSpec* shape : shapes) {
    poses.push_back(
        X_BP.inverseTimes(btTransform(bullet(shape->orientation), bullet(shape->location))));
    result->parts.push_back(std::visit(Builder{}, shape->geometry));
  }
  if (shapes.size() == 1 && is_identity(poses.front())) {
    result->shape = std::move(result->parts.front());
    return result;
  }
  auto compound = std::make_unique<btCompoundShape>();
  for (std::size_t i = 0; i < poses.size(); ++i)
    compound->addChildShape(poses[i], result->parts[i].get());
  result->shape = std::move(compound);
  return result;
}

std::unique_ptr<BulletShape> make_bullet_ground(const Ground& ground) {
  auto result = std::make_unique<BulletShape>();
  std::visit([&result](const auto& surface) { build(*result, surface); }, ground);
  return result;
}

}  // namespace hookpoint::reference
