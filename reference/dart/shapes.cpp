#include "reference/dart/shapes.h"

#include <assimp/scene.h>

#include <algorithm>
#include <dart/dynamics/BoxShape.hpp>
#include <dart/dynamics/CylinderShape.hpp>
#include <dart/dynamics/MeshShape.hpp>
#include <dart/dynamics/SphereShape.hpp>
#include <stdexcept>

namespace hookpoint::reference {
namespace {

struct Builder {
  dart::dynamics::ShapePtr operator()(const simulation::Box& box) const {
    return std::make_shared<dart::dynamics::BoxShape>(eigen(box.dimensions));
  }
  dart::dynamics::ShapePtr operator()(const simulation::Sphere& sphere) const {
    return std::make_shared<dart::dynamics::SphereShape>(sphere.radius);
  }
  dart::dynamics::ShapePtr operator()(const simulation::Cylinder& cylinder) const {
    return std::make_shared<dart::dynamics::CylinderShape>(cylinder.radius, cylinder.length);
  }
  template <class Refused>
  dart::dynamics::ShapePtr operator()(const Refused&) const {
    throw std::logic_error("a shape that DART has not is refused before any is made");
  }
};

dart::dynamics::ShapePtr mesh_shape(const GroundMesh& ground) {
  // The shape's destructor releases the scene, and the scene's all that hangs from it.
  auto* scene = new aiScene;
  scene->mMeshes = new aiMesh* [1] { new aiMesh };
  scene->mNumMeshes = 1;
  aiMesh& mesh = **scene->mMeshes;
  mesh.mNumVertices = static_cast<unsigned>(ground.vertices.size());
  mesh.mVertices = new aiVector3D[ground.vertices.size()];
  std::ranges::transform(ground.vertices, mesh.mVertices, [](const Vector3d& a) {
    return aiVector3D(static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z));
  });
  mesh.mNumFaces = static_cast<unsigned>(ground.triangles.size());
  mesh.mFaces = new aiFace[ground.triangles.size()];
  for (std::size_t i = 0; i < ground.triangles.size(); ++i) {
    mesh.mFaces[i].mNumIndices = 3;
    mesh.mFaces[i].mIndices = new unsigned[3];
    std::ranges::copy(ground.triangles[i], mesh.mFaces[i].mIndices);
  }
  return std::make_shared<dart::dynamics::MeshShape>(Eigen::Vector3d::Ones(), scene);
}

}  // namespace

Eigen::Isometry3d transform(const Vector3d& position, const Quaterniond& orientation) {
  const Quaterniond& q = orientation;
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.linear() = Eigen::Quaterniond(q.w, q.x, q.y, q.z).toRotationMatrix();
  result.translation() = eigen(position);
  return result;
}

dart::dynamics::ShapePtr make_dart_shape(const simulation::ShapeGeometry& geometry) {
  return std::visit(Builder{}, geometry);
}

DartGround make_dart_ground(const Ground& ground, double width) {
  if (const auto* mesh = std::get_if<GroundMesh>(&ground)) return {mesh_shape(*mesh)};
  if (std::holds_alternative<GroundStairs>(ground)) return {};
  const auto& plane = std::get<GroundPlane>(ground);
  constexpr double height = 20.;  // [m]
  DartGround result{
      std::make_shared<dart::dynamics::BoxShape>(Eigen::Vector3d(width, width, height))};
  const Eigen::Vector3d normal = eigen(plane.normal);
  result.pose.linear() =
      Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), normal).toRotationMatrix();
  result.pose.translation() = (plane.offset - 0.5 * height) * normal;
  return result;
}

}  // namespace hookpoint::reference
