#include "dts/model.h"

#include "dts/joint.h"
#include "dts/rigid_body.h"

namespace hookpoint::dts {
namespace {

template <class Real>
Vector3<Real> lanes(const Vector3d& a) {
  return {Real(a.x), Real(a.y), Real(a.z)};
}

template <class Real>
RigidInertia<Real> about_origin(const MassProperties<double>& body) {
  const Symmetric3d I = body.inertia + point_inertia(body.mass, body.center_of_mass);
  return {Real(body.mass),
          lanes<Real>(body.mass * body.center_of_mass),
          {Real(I.xx), Real(I.yy), Real(I.zz), Real(I.xy), Real(I.xz), Real(I.yz)}};
}

template <class Real>
Matrix3<Real> lanes(const Matrix3d& m) {
  return {Real(m.xx), Real(m.xy), Real(m.xz), Real(m.yx), Real(m.yy),
          Real(m.yz), Real(m.zx), Real(m.zy), Real(m.zz)};
}

template <class Real>
LinkConstants<Real> constants_of(const LinkDescription& link) {
  const SineCosine<double> alpha = sine_cosine(link.alpha);
  return {link.joint,
          Real(alpha.sine),
          Real(alpha.cosine),
          Real(link.a),
          Real(link.d),
          Real(link.theta),
          link.alpha != 0. || link.a != 0.,
          about_origin<Real>(link.mass)};
}

/// The hip with the first link's screw about x, which never moves against it; `first` is left with
/// none.
template <class Real>
ChainConstants<Real> merged_hip(const ChainDescription& description, LinkDescription& first) {
  const Matrix3d R = rotation_matrix(normalized(description.hip_orientation));
  const SineCosine<double> alpha = sine_cosine(first.alpha);
  const Matrix3d R_BH = times_rotation_x(R, alpha.sine, alpha.cosine);
  const Vector3d hip_to_H = R * Vector3d{first.a, 0., 0.};
  first.a = first.alpha = 0.;
  ChainConstants<Real> chain;
  chain.aligned = R_BH == Matrix3d::identity();
  chain.p_BH = lanes<Real>(description.hip_position + hip_to_H);
  chain.R_BH = lanes<Real>(R_BH);
  chain.hip_to_H = lanes<Real>(hip_to_H);
  return chain;
}

}  // namespace

template <class Real>
Model<Real>::Model(const RobotDescription& robot)
    : mobile_(robot.mobile),
      base_(robot.mobile ? about_origin<Real>(robot.base) : RigidInertia<Real>{}) {
  for (const ChainDescription& description : robot.chains) {
    std::vector<LinkDescription> links = description.links;
    LinkDescription none;
    ChainConstants<Real> chain =
        merged_hip<Real>(description, links.empty() ? none : links.front());
    chain.first_link = links_.size();
    chain.link_count = links.size();
    for (const LinkDescription& link : links) {
      links_.push_back(constants_of<Real>(link));
      chain_of_link_.push_back(chains_.size());
    }
    if (chain.link_count > 0) {
      chain.leaf = eliminate(links_.back().joint, articulated(links_.back().inertia));
    }
    chains_.push_back(chain);
  }
}

template class Model<double>;

}  // namespace hookpoint::dts
