#include "simulation/dts_engine/constraint_set.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "dts/body_accelerations.h"
#include "dts/configuration.h"
#include "dts/external_forces.h"
#include "dts/forward_kinematics.h"
#include "simulation/experiment/loop_places.h"

namespace hookpoint::simulation {
namespace {

/// Pivots of J M^-1 J^T below that share of the largest are of rows that follow from others.
constexpr double redundant = 1e-11;
/// The least pivot by that of the start below which a linkage is as good as singular: its constraint
/// forces are a thousand times what they were for the same load.
constexpr double singular_share = 1e-6;
/// A gap that rounding leaves [m].
constexpr double closed = 1e-14;

constexpr std::array signs{1., -1.};

}  // namespace

ConstraintSet::ConstraintSet(const Experiment& experiment, std::size_t index,
                             const dts::Model<double>& model)
    : experiment_(experiment), response_(0) {
  for (std::size_t i = 0; i < experiment.loops.size(); ++i) {
    const LoopSpec& loop = experiment.loops[i];
    if (static_cast<std::size_t>(loop.robot) != index) continue;
    const std::size_t own = loops_.size();
    loops_.push_back(i);
    if (loop.stiffness) continue;
    const std::array bodies{static_cast<std::size_t>(loop.body_a),
                            static_cast<std::size_t>(loop.body_b)};
    for (const LoopPlace& place : loop_places(loop)) points_.push_back({own, bodies, place, {}});
  }
  for (const CouplingSpec& coupling : experiment.couplings)
    if (static_cast<std::size_t>(coupling.robot) == index)
      couplings_.push_back({coupling, 0., std::vector<double>(dts::velocity_count(model))});
  if (!constrains()) return;
  singular_ =
      experiment.robots[index].name +
      ": its loops are singular, or nearly so: links have come into line, where the linkage "
      "may go on in either of two ways, and what its loops carry is not determined; keep "
      "the joints away from there, or give the loop a stiffness";
  notice_.reserve(singular_.size());
  response_ = PivotedCholesky(row_count());
  b_.resize(row_count());
  x_.resize(row_count());
  change_.resize(dts::velocity_count(model));
  part_ = change_;
  accelerations_.resize(model.body_count());
  still_joints_.resize(model.link_count());
  moved_.joint_positions.resize(model.link_count());
  moved_.joint_rates.resize(model.link_count());
}

ConstraintSet::Point ConstraintSet::place_of(const LoopSpec& loop) {
  return {0,
          {static_cast<std::size_t>(loop.body_a), static_cast<std::size_t>(loop.body_b)},
          {loop.point_a, loop.point_b},
          {}};
}

dts::BodyPoint<double> ConstraintSet::at(const Point& point, std::size_t side,
                                         const dts::Workspace<double>& workspace) const {
  const dts::BodyMotion<double>& body = workspace.bodies[point.bodies[side]];
  return {point.bodies[side], body.p_WB + body.R_WB * point.p[side]};
}

Vector3d ConstraintSet::gap(const Point& point, const dts::Workspace<double>& workspace) const {
  return at(point, 0, workspace).p_WP - at(point, 1, workspace).p_WP;
}

Vector3d ConstraintSet::gap_rate(const Point& point,
                                 const dts::Workspace<double>& workspace) const {
  Vector3d rate;
  for (const std::size_t side : {0, 1}) {
    const dts::BodyMotion<double>& body = workspace.bodies[point.bodies[side]];
    rate += signs[side] * (body.v_WB + cross(body.w_WB, body.R_WB * point.p[side]));
  }
  return rate;
}

void ConstraintSet::watch_rank() {
  const double share = response_.least_pivot();
  if (!regular_) regular_ = {rank_, share};
  if (rank_ < regular_->first || share < singular_share * regular_->second) notice_ = singular_;
}

std::vector<LoopSpring> ConstraintSet::springs(const dts::Workspace<double>& workspace) const {
  std::vector<LoopSpring> all;
  for (const std::size_t i : loops_) {
    const LoopSpec& loop = experiment_.loops[i];
    if (!loop.stiffness) continue;
    const Point point = place_of(loop);
    all.push_back({{at(point, 0, workspace), at(point, 1, workspace)},
                   -(*loop.stiffness) * gap(point, workspace),
                   *loop.stiffness,
                   loop.damping});
  }
  return all;
}

void ConstraintSet::add_spring_forces(dts::Workspace<double>& workspace) const {
  for (const std::size_t i : loops_) {
    const LoopSpec& loop = experiment_.loops[i];
    if (!loop.stiffness) continue;
    const Point point = place_of(loop);
    const Vector3d force =
        -(*loop.stiffness) * gap(point, workspace) - loop.damping * gap_rate(point, workspace);
    for (const std::size_t side : {0, 1}) {
      const dts::BodyPoint<double> place = at(point, side, workspace);
      dts::add_external_force<double>(workspace, place.body, signs[side] * force, place.p_WP);
    }
  }
}

// A_ij = sum over the sides s of i and t of j: +- J_s M^-1 J_t^T.
void ConstraintSet::factor(const dts::Model<double>& model, dts::Workspace<double>& workspace) {
  for (std::size_t i = 0; i < points_.size(); ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      Matrix3d A;
      for (const std::size_t s : {0, 1})
        for (const std::size_t t : {0, 1})
          A = A + signs[s] * signs[t] *
                      dts::impulse_response(model, workspace, at(points_[j], t, workspace),
                                            at(points_[i], s, workspace));
      const std::array rows{Vector3d{A.xx, A.xy, A.xz}, Vector3d{A.yx, A.yy, A.yz},
                            Vector3d{A.zx, A.zy, A.zz}};
      for (std::size_t row = 0; row < 3; ++row) {
        response_(3 * i + row, 3 * j) = rows[row].x;
        response_(3 * i + row, 3 * j + 1) = rows[row].y;
        response_(3 * i + row, 3 * j + 2) = rows[row].z;
      }
    }
  }
  fill_coupling_rows(model, workspace);
  rank_ = response_.factor(redundant);
}

void ConstraintSet::fill_coupling_rows(const dts::Model<double>& model,
                                       dts::Workspace<double>& workspace) {
  if (couplings_.empty()) return;
  const std::size_t first_row = 3 * points_.size();
  const auto joints = [&](std::span<const double> velocity) {
    return velocity.last(model.link_count());
  };
  // J_c M^-1 J_p^T: how far a unit force at a place moves the coupled joints apart.
  for (std::size_t i = 0; i < points_.size(); ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Vector3d unit{axis == 0 ? 1. : 0., axis == 1 ? 1. : 0., axis == 2 ? 1. : 0.};
      for (std::size_t c = 0; c < couplings_.size(); ++c)
        response_(first_row + c, 3 * i + axis) = 0.;
      for (const std::size_t side : {0, 1}) {
        dts::velocity_change<double>(model, workspace, at(points_[i], side, workspace),
                                     signs[side] * unit, part_);
        for (std::size_t c = 0; c < couplings_.size(); ++c)
          response_(first_row + c, 3 * i + axis) += couplings_[c].apart(joints(part_));
      }
    }
  for (std::size_t c = 0; c < couplings_.size(); ++c) {
    Coupling& own = couplings_[c];
    dts::velocity_change_by_joint<double>(model, workspace, own.spec.leader, -own.spec.ratio,
                                          own.column);
    dts::velocity_change_by_joint<double>(model, workspace, own.spec.follower, 1., part_);
    std::ranges::transform(own.column, part_, own.column.begin(), std::plus<>());
    for (std::size_t d = 0; d <= c; ++d)
      response_(first_row + c, first_row + d) = couplings_[d].apart(joints(own.column));
  }
}

void ConstraintSet::fill_accelerations_apart(const dts::Model<double>& model,
                                             const dts::State<double>& state,
                                             const dts::Workspace<double>& workspace,
                                             std::span<double> apart) {
  dts::body_accelerations<double>(model, state, workspace, accelerations_);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    Vector3d a_apart;
    for (const std::size_t side : {0, 1}) {
      const dts::BodyMotion<double>& body = workspace.bodies[points_[i].bodies[side]];
      const dts::Motion<double>& a = accelerations_[points_[i].bodies[side]];
      const Vector3d r = body.R_WB * points_[i].p[side];
      a_apart +=
          signs[side] * (a.linear + cross(a.angular, r) + cross(body.w_WB, cross(body.w_WB, r)));
    }
    apart[3 * i] = a_apart.x;
    apart[3 * i + 1] = a_apart.y;
    apart[3 * i + 2] = a_apart.z;
  }
  for (std::size_t c = 0; c < couplings_.size(); ++c)
    apart[3 * points_.size() + c] = couplings_[c].apart(workspace.joint_accelerations);
}

void ConstraintSet::fill_bias_apart(const dts::Model<double>& model,
                                    const dts::State<double>& state,
                                    dts::Workspace<double>& workspace, std::span<double> apart) {
  const auto unaccelerated = [&] {
    std::swap(workspace.base_acceleration, still_base_.linear);
    std::swap(workspace.base_angular_acceleration, still_base_.angular);
    workspace.joint_accelerations.swap(still_joints_);
  };
  unaccelerated();
  fill_accelerations_apart(model, state, workspace, apart);
  unaccelerated();
}

void ConstraintSet::find_forces(const dts::Model<double>& model, const dts::State<double>& state,
                                dts::Workspace<double>& workspace, Closing closing) {
  fill_accelerations_apart(model, state, workspace, b_);
  if (closing == Closing::over_a_step) {
    fill_bias_apart(model, state, workspace, x_);
    for (std::size_t i = 0; i < b_.size(); ++i) b_[i] -= 0.5 * x_[i];
  }
  for (double& b : b_) b = -b;
  if (closing == Closing::at_this_moment) factor(model, workspace);
  response_.solve(b_, x_);
  for (std::size_t i = 0; i < points_.size(); ++i)
    points_[i].force = {x_[3 * i], x_[3 * i + 1], x_[3 * i + 2]};
  for (std::size_t c = 0; c < couplings_.size(); ++c)
    couplings_[c].torque = x_[3 * points_.size() + c];
}

void ConstraintSet::add_forces(dts::Workspace<double>& workspace, std::span<double> torques) const {
  for (const Coupling& coupling : couplings_) {
    torques[coupling.spec.follower] += coupling.torque;
    torques[coupling.spec.leader] -= coupling.spec.ratio * coupling.torque;
  }
  for (const Point& point : points_)
    for (const std::size_t side : {0, 1}) {
      const dts::BodyPoint<double> place = at(point, side, workspace);
      dts::add_external_force<double>(workspace, place.body, signs[side] * point.force, place.p_WP);
    }
}

void ConstraintSet::find_change(const dts::Model<double>& model,
                                dts::Workspace<double>& workspace) {
  response_.solve(b_, x_);
  std::ranges::fill(change_, 0.);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Vector3d impulse{x_[3 * i], x_[3 * i + 1], x_[3 * i + 2]};
    for (const std::size_t side : {0, 1}) {
      dts::velocity_change<double>(model, workspace, at(points_[i], side, workspace),
                                   -signs[side] * impulse, part_);
      for (std::size_t k = 0; k < change_.size(); ++k) change_[k] += part_[k];
    }
  }
  for (std::size_t c = 0; c < couplings_.size(); ++c)
    for (std::size_t k = 0; k < change_.size(); ++k)
      change_[k] -= x_[3 * points_.size() + c] * couplings_[c].column[k];
}

template <class OfPoint, class OfCoupling>
double ConstraintSet::fill(const OfPoint& of_point, const OfCoupling& of_coupling) {
  double greatest = 0.;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Vector3d v = of_point(points_[i]);
    b_[3 * i] = v.x;
    b_[3 * i + 1] = v.y;
    b_[3 * i + 2] = v.z;
    greatest = std::max(greatest, norm(v));
  }
  for (std::size_t c = 0; c < couplings_.size(); ++c) {
    const double apart = of_coupling(couplings_[c]);
    b_[3 * points_.size() + c] = apart;
    greatest = std::max(greatest, std::abs(apart));
  }
  return greatest;
}

double ConstraintSet::close(const dts::Model<double>& model, dts::State<double>& state,
                            dts::Workspace<double>& workspace, int rounds) {
  const auto look = [&] {
    dts::forward_kinematics(model, state, workspace);
    dts::articulated_inertias(model, workspace);
    factor(model, workspace);
  };
  const auto gaps = [&] {
    return fill([&](const Point& point) { return gap(point, workspace); },
                [&](const Coupling& coupling) {
                  return coupling.apart(state.joint_positions) - coupling.spec.offset;
                });
  };
  look();
  double open = gaps();
  for (int round = 0; round < rounds && open > closed; ++round) {
    find_change(model, workspace);
    moved_ = state;
    dts::retract<double>(model, state, change_, 1., moved_);
    std::swap(state.base_position, moved_.base_position);
    std::swap(state.base_orientation, moved_.base_orientation);
    state.joint_positions.swap(moved_.joint_positions);
    look();
    open = gaps();
  }
  watch_rank();
  project_velocities(model, state, workspace);
  return open;
}

void ConstraintSet::project_velocities(const dts::Model<double>& model, dts::State<double>& state,
                                       dts::Workspace<double>& workspace) {
  fill([&](const Point& point) { return gap_rate(point, workspace); },
       [&](const Coupling& coupling) { return coupling.apart(state.joint_rates); });
  find_change(model, workspace);
  dts::get_velocity<double>(model, state, part_);
  for (std::size_t k = 0; k < part_.size(); ++k) part_[k] += change_[k];
  dts::set_velocity<double>(model, part_, state);
  dts::forward_kinematics(model, state, workspace);
}

void ConstraintSet::publish(const dts::Workspace<double>& workspace,
                            std::span<LoopState> loops) const {
  for (const std::size_t i : loops_) {
    const LoopSpec& loop = experiment_.loops[i];
    const Point point = place_of(loop);
    LoopState& state = loops[i];
    state = {};
    state.error = norm(gap(point, workspace));
    if (loop.stiffness)
      state.force =
          -(*loop.stiffness) * gap(point, workspace) - loop.damping * gap_rate(point, workspace);
  }
  for (const Point& point : points_) {
    LoopState& state = loops[loops_[point.loop]];
    const LoopSpec& loop = experiment_.loops[loops_[point.loop]];
    const Matrix3d& R = workspace.bodies[point.bodies[0]].R_WB;
    state.force += point.force;
    state.moment += cross(R * (point.p[0] - loop.point_a), point.force);
  }
}

}  // namespace hookpoint::simulation
