#include "reference/ode/shapes.h"

#include <stdexcept>

namespace hookpoint::reference {
namespace {

struct Builder {
  dGeomID operator()(const simulation::Box& box) const {
    return dCreateBox(nullptr, box.dimensions.x, box.dimensions.y, box.dimensions.z);
  }
  dGeomID operator()(const simulation::Sphere& sphere) const {
    return dCreateSphere(nullptr, sphere.radius);
  }
  dGeomID operator()(const simulation::Cylinder& cylinder) const {
    return dCreateCylinder(nullptr, cylinder.radius, cylinder.length);
  }
  dGeomID operator()(const simulation::Capsule& capsule) const {
    return dCreateCapsule(nullptr, capsule.radius, capsule.length);
  }
  template <class Refused>
  dGeomID operator()(const Refused&) const {
    throw std::logic_error("a shape that ODE has not is refused before any is made");
  }
};

}  // namespace

OdePointer<dxGeom> make_ode_geometry(const simulation::ShapeGeometry& shape) {
  return OdePointer<dxGeom>(std::visit(Builder{}, shape));
}

OdePointer<dxGeom> make_ode_geometry(const simulation::ShapeSpec& shape,
                                     const Vector3d& center_of_mass, dBodyID body) {
  OdePointer<dxGeom> geometry = make_ode_geometry(shape.geometry);
  dGeomSetBody(geometry.get(), body);
  const Vector3d offset = shape.location - center_of_mass;
  dGeomSetOffsetPosition(geometry.get(), offset.x, offset.y, offset.z);
  const Quaterniond& q = shape.orientation;
  const dQuaternion rotation = {q.w, q.x, q.y, q.z};
  dGeomSetOffsetQuaternion(geometry.get(), rotation);
  return geometry;
}

OdeGround::OdeGround(const Ground& ground) {
  std::visit([this](const auto& surface) { build(surface); }, ground);
}

void OdeGround::build(const GroundPlane& plane) {
  const Vector3d& n = plane.normal;
  geometry_.reset(dCreatePlane(nullptr, n.x, n.y, n.z, plane.offset));
}

void OdeGround::build(const GroundMesh& mesh) {
  for (const Vector3d& vertex : mesh.vertices)
    vertices_.insert(vertices_.end(), {vertex.x, vertex.y, vertex.z});
  for (const auto& triangle : mesh.triangles)
    for (const int index : triangle) indices_.push_back(static_cast<dTriIndex>(index));
  mesh_.reset(dGeomTriMeshDataCreate());
  dGeomTriMeshDataBuildDouble(mesh_.get(), vertices_.data(), 3 * sizeof(double),
                              static_cast<int>(mesh.vertices.size()), indices_.data(),
                              static_cast<int>(indices_.size()), 3 * sizeof(dTriIndex));
  geometry_.reset(dCreateTriMesh(nullptr, mesh_.get(), nullptr, nullptr, nullptr));
}

int OdeGround::collide(dGeomID geometry, dContact* contacts, int capacity) const {
  if (!geometry_) return 0;
  if (!mesh_)
    return dCollide(geometry, geometry_.get(), capacity, &contacts->geom, sizeof(dContact));
  const std::lock_guard<std::mutex> lock(ode_mesh_mutex());
  return dCollide(geometry, geometry_.get(), capacity, &contacts->geom, sizeof(dContact));
}

}  // namespace hookpoint::reference
