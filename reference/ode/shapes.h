// Shapes and ground as ODE geometries.
#pragma once

#include <vector>

#include "reference/ground.h"
#include "reference/ode/library.h"

namespace hookpoint::reference {

/// The geometry of `shape` on `body`, whose origin is the centre of mass at `center_of_mass` (body
/// frame, [m]). A Legcone or a Hull, which ODE has not, is a gap of its row (engine.cpp).
OdePointer<dxGeom> make_ode_geometry(const simulation::ShapeSpec& shape,
                                     const Vector3d& center_of_mass, dBodyID body);
/// One that no body carries, at the world's origin.
OdePointer<dxGeom> make_ode_geometry(const simulation::ShapeGeometry& shape);

/// The geometry of a plane or of a grid, with the arrays that ODE reads in place. Not to be moved
/// after construction.
class OdeGround {
 public:
  explicit OdeGround(const Ground& ground);
  OdeGround(const OdeGround&) = delete;
  OdeGround& operator=(const OdeGround&) = delete;

  /// Contacts of `geometry` with the ground, at most `capacity` written to `contacts`; their count.
  int collide(dGeomID geometry, dContact* contacts, int capacity) const;

 private:
  void build(const GroundPlane& plane);
  void build(const GroundMesh& mesh);
  void build(const GroundStairs& /*stairs*/) {}

  std::vector<double> vertices_;
  std::vector<dTriIndex> indices_;
  OdePointer<dxTriMeshData> mesh_;
  OdePointer<dxGeom> geometry_;
};

}  // namespace hookpoint::reference
