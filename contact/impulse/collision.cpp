#include "contact/impulse/collision.h"

#include <cmath>
#include <limits>

#include "contact/impulse/collision_flow.h"

namespace hookpoint::contact {
namespace {

constexpr double slip_tolerance = 1e-8;  // local error of u_t, relative to the collision's speeds
constexpr double standstill = 1e-12;     // share of the collision's speeds that is no motion
constexpr double constant_direction =
    1e-14;  // turn rate over K below which a direction is constant to rounding
constexpr double straight_slip =
    1e-9;  // share of the speeds that a path may still turn aside to count as straight
constexpr double jammed =
    1e-6;  // share of knn below which a stuck point cannot be moved along the normal
constexpr int most_steps = 100000;
constexpr double endless = std::numeric_limits<double>::infinity();

enum class Phase { compression, restitution, separation, done };

// The collision under way: a point of its path and how far the path has to go.
class Path {
 public:
  explicit Path(const CollisionProblem& problem)
      : axes_(collision_axes(problem.K, problem.n)),
        mu_(problem.mu),
        un_(dot(problem.u, problem.n)),
        restored_(problem.restitution * problem.restitution),
        rebound_speed_(problem.rebound_speed) {
    const double u1 = dot(problem.u, axes_.e1), u2 = dot(problem.u, axes_.e2);
    at_.s = std::hypot(u1, u2);
    if (at_.s > 0.) {
      at_.c = u1 / at_.s;
      at_.d = u2 / at_.s;
    }
    speed_ = std::max({at_.s, -un_, rebound_speed_});
    largest_k_ = std::max({axes_.a1, axes_.a2, axes_.knn});
    // The flow's own time: (1 + mu) max K is the size of its rates.
    longest_dtau_ = 1. / ((1. + mu_) * largest_k_);
    dtau_ = 0.1 * longest_dtau_;
  }

  bool approaches() const { return un_ < 0.; }
  bool well_posed() const {
    const double determinant = axes_.a1 * axes_.a2 * axes_.knn - axes_.a1 * axes_.k2 * axes_.k2 -
                               axes_.a2 * axes_.k1 * axes_.k1;
    return std::isfinite(speed_) && axes_.a1 > 0. && axes_.a2 > 0. && determinant > 0.;
  }

  /// Runs to the end of restitution; false if it does not come.
  bool run() {
    for (int step = 0; step < most_steps && phase_ != Phase::done; ++step) {
      if (mu_ <= 0.) {
        straight(0., 0., 0., axes_.knn, endless);
      } else if (at_.s <= 0.) {
        leave_standstill();
      } else {
        slide();
      }
      if (stalled_) return false;
    }
    return phase_ == Phase::done;
  }

  Vector3d impulse() const { return at_.p1 * axes_.e1 + at_.p2 * axes_.e2 + at_.pn * axes_.n; }

 private:
  // What rises through zero where the phase ends, and its rate over p_n for the normal rate g.
  double remaining(const CollisionPoint& point) const {
    if (phase_ == Phase::restitution) return point.W - goal_;
    const double target = phase_ == Phase::compression ? 0. : rebound_speed_;
    return normal_velocity(axes_, un_, point) - target;
  }

  void end_phase() {
    if (phase_ == Phase::compression) {
      // Stronge: restitution ends when it has given back e^2 of the work that compression took.
      compression_work_ = std::min(compression_work_, at_.W);
      goal_ = (1. - restored_) * compression_work_;
      phase_ = Phase::restitution;
      if (at_.W < goal_) return;
    }
    if (phase_ == Phase::restitution) {
      phase_ = Phase::separation;
      if (normal_velocity(axes_, un_, at_) < rebound_speed_) return;
    }
    phase_ = Phase::done;
  }

  // p_n to the end of the phase along a straight path, on which u_n changes at the constant rate g.
  double distance_to_end(double g) const {
    const double v = normal_velocity(axes_, un_, at_);
    if (phase_ == Phase::restitution) {
      // W + v p + g p^2/2 = goal, in the form without cancellation.
      const double work = goal_ - at_.W;
      const double root = v * v + 2. * g * work;
      return root >= 0. ? 2. * work / (v + std::sqrt(root)) : endless;
    }
    return g > 0. ? -remaining(at_) / g : endless;
  }

  // The closed form: friction (f1, f2) per p_n is constant, |u_t| changes at the rate `speed` and
  // u_n at `g`, for at most `limit` of p_n.
  void straight(double f1, double f2, double speed, double g, double limit) {
    while (phase_ != Phase::done) {
      const double end = std::max(0., distance_to_end(g));
      const double v = normal_velocity(axes_, un_, at_);
      // u_n may fall again while restitution is under way: the point is then back in compression.
      const double turning = phase_ != Phase::compression && g < 0. ? -v / g : endless;
      const double p = std::min({end, limit, std::max(0., turning)});
      if (!std::isfinite(p)) {
        stalled_ = true;
        return;
      }
      at_.p1 += f1 * p;
      at_.p2 += f2 * p;
      at_.pn += p;
      at_.s = std::max(0., at_.s + speed * p);
      at_.W += p * (v + 0.5 * g * p);
      limit -= p;
      if (p == end) {
        end_phase();
      } else if (limit > 0.) {
        phase_ = Phase::compression;
      } else {
        return;
      }
    }
  }

  // A point that can move along one line only (a hinged link on a fixed base) is wedged
  // by friction that holds it, however great p_n. What lifts it is then taken along the normal
  // alone: p stays in the cone, and no more energy comes back than e^2 of the compression.
  void leave_standstill() {
    const StoppedFriction friction = stopped_friction(axes_, mu_);
    if (phase_ != Phase::compression && friction.normal <= jammed * axes_.knn) {
      straight(0., 0., 0., axes_.knn, endless);
    } else {
      straight(friction.f1, friction.f2, 0., friction.normal, endless);
    }
  }

  void slide() {
    const SlidingRates rates = sliding_rates(axes_, mu_, at_.c, at_.d);
    const bool still = at_.s <= standstill * speed_;
    if (still && rates.speed >= 0.) {
      at_.s = 0.;
      return;
    }
    const double turn_size = std::abs(rates.turn);
    const bool settled = rates.speed < 0. && rates.turn_gradient < 0. &&
                         at_.s * turn_size <= straight_slip * speed_ * largest_k_;
    if (!still && !settled && turn_size > constant_direction * largest_k_) {
      turn();
      return;
    }
    const double stop = rates.speed < 0. ? at_.s / -rates.speed : endless;
    straight(-mu_ * at_.c, -mu_ * at_.d, rates.speed, rates.normal, stop);
    if (phase_ != Phase::done) at_.s = 0.;
  }

  // One adaptive step of the curved flow, cut at the end of the phase if that lies inside. A point
  // that all but stops and slides off again hardly moves meanwhile, so its error of u_t would allow
  // a step of any length, past where the series in dtau means anything: the flow's own time bounds
  // it.
  void turn() {
    double error = 0.;
    CollisionPoint to = sliding_step(axes_, mu_, un_, at_, dtau_, &error);
    const double allowed = slip_tolerance * std::max(speed_, at_.s);
    const double growth =
        std::min(4., std::max(0.2, 0.9 * std::pow(allowed / (error + 1e-300), 0.2)));
    if (!(error <= allowed)) {
      stalled_ = !std::isfinite(error);
      dtau_ *= growth;
      return;
    }
    if (remaining(to) >= 0.) {
      at_ = cut(dtau_);
      end_phase();
      return;
    }
    at_ = to;
    dtau_ = std::min(longest_dtau_, growth * dtau_);
    if (phase_ != Phase::compression && normal_velocity(axes_, un_, at_) < 0.) {
      phase_ = Phase::compression;
    }
  }

  // The phase's end within the step of length `high`: Newton, kept inside a bracket that it halves
  // when it leaves.
  CollisionPoint cut(double high) const {
    double low = 0.;
    double dtau = 0.5 * high;
    CollisionPoint to = at_;
    for (int iteration = 0; iteration < 100; ++iteration) {
      double error = 0.;
      to = sliding_step(axes_, mu_, un_, at_, dtau, &error);
      const double value = remaining(to);
      (value < 0. ? low : high) = dtau;
      const double rate =
          to.s * (phase_ == Phase::restitution ? normal_velocity(axes_, un_, to)
                                               : sliding_rates(axes_, mu_, to.c, to.d).normal);
      const double next = dtau - value / rate;
      const double inside = next > low && next < high ? next : 0.5 * (low + high);
      if (std::abs(inside - dtau) <= 1e-12 * dtau) break;
      dtau = inside;
    }
    return to;
  }

  CollisionAxes axes_;
  double mu_, un_, restored_, rebound_speed_;
  double speed_ = 0., largest_k_ = 0., longest_dtau_ = 0., dtau_ = 0.;
  CollisionPoint at_;
  Phase phase_ = Phase::compression;
  double compression_work_ = 0., goal_ = 0.;
  bool stalled_ = false;
};

}  // namespace

Collision resolve_collision(const CollisionProblem& problem) {
  Path path(problem);
  if (!path.well_posed()) return {{}, false};
  if (!path.approaches()) return {{}, true};
  const bool ended = path.run();
  return {path.impulse(), ended};
}

}  // namespace hookpoint::contact
