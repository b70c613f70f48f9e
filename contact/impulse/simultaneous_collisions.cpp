#include "contact/impulse/simultaneous_collisions.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/impulse/dense_factors.h"

namespace hookpoint::contact {
namespace {

// Of the speeds.
constexpr double no_approach = 1e-10;
constexpr double slip_rounding = 1e-12;
constexpr double path_tolerance = 1e-4;  // what halving the parts of a path may change
// Less than no_approach: points that are redundant but for a hair share their impulse by what is left.
constexpr double balanced = 1e-13;
constexpr double nearly_balanced = 1e-7;  // what Newton's method may leave where it comes no nearer

constexpr int most_parts = 16;     // of a path
constexpr int most_rests = 150;    // parts of the way to a target, with those after its last
constexpr int most_balances = 10;  // steps of Newton's method
constexpr double nearer = 0.5;     // share of what is missing that a step may leave
// Share of the mean diagonal that is added to it, since normal impulses may be redundant.
constexpr double yielding = 1e-4;
constexpr double misses_less = 0.9;      // what is missing, of that of another ray
constexpr double work_rounding = 1e-10;  // of the work of restitution
constexpr int most_lengths = 60;         // of the ray of restitution
constexpr double first_cut = 1e-3;       // off that length, where friction's work would be energy
// Share of the normal motion without friction below which the points are wedged.
constexpr double wedged = 1e-6;

}  // namespace

SimultaneousCollisions::SimultaneousCollisions(std::size_t most)
    : most_(most),
      normals_(most),
      discs_(most),
      axes_(3 * most),
      K_(9 * most * most),
      mu_(most),
      ray_(most),
      bias_(most),
      best_(most),
      slip_(2 * most),
      radius_(most),
      friction_(2 * most),
      target_(most),
      gain_(most * most),
      widening_(most),
      system_(most * most),
      change_(most),
      pivot_(most) {
  active_.reserve(most);
  for (Motion* motion : {&now_, &trial_, &finer_, &start_, &coarser_}) {
    motion->un.resize(most);
    motion->ut.resize(2 * most);
    motion->pn.resize(most);
    motion->pt.resize(2 * most);
    motion->work.resize(most);
  }
}

void SimultaneousCollisions::begin(std::span<const CollidingPoint> points) {
  n_ = points.size();
  stride_ = 3 * n_;
  speed_ = 0.;
  frictionless_ = false;
  restores_ = false;
  converged_ = true;
  now_.energy = 0.;
  for (std::size_t i = 0; i < n_; ++i) {
    const Vector3d& n = points[i].normal;
    // Any tangents: friction has no direction of its own.
    const double x = std::abs(n.x), y = std::abs(n.y), z = std::abs(n.z);
    const Vector3d far = x <= y && x <= z ? Vector3d{1., 0., 0.}
                         : y <= z         ? Vector3d{0., 1., 0.}
                                          : Vector3d{0., 0., 1.};
    const Vector3d across = tangential(far, n);
    axes_[3 * i] = n;
    axes_[3 * i + 1] = (1. / norm(across)) * across;
    axes_[3 * i + 2] = cross(n, axes_[3 * i + 1]);
    mu_[i] = points[i].mu;
    restores_ = restores_ || points[i].restitution > 0.;
    now_.un[i] = dot(points[i].u, n);
    for (std::size_t k = 0; k < 2; ++k) {
      now_.ut[2 * i + k] = dot(points[i].u, axes_[3 * i + 1 + k]);
      now_.pt[2 * i + k] = 0.;
    }
    now_.pn[i] = now_.work[i] = 0.;
    speed_ = std::max({speed_, norm(points[i].u), points[i].rebound_speed});
  }
}

void SimultaneousCollisions::set(std::size_t i, std::size_t j, const Matrix3d& K) {
  const auto row = [&](std::size_t point, std::size_t axis) {
    return axis == 0 ? point : n_ + 2 * point + axis - 1;
  };
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t b = 0; b < 3; ++b) {
      const double entry = dot(axes_[3 * i + a], K * axes_[3 * j + b]);
      K_[row(i, a) * stride_ + row(j, b)] = entry;
      K_[row(j, b) * stride_ + row(i, a)] = entry;
    }
  }
}

// From now_ to `to`: normal impulses along a ray, in equal parts, with the friction that each leaves.
void SimultaneousCollisions::strike(std::span<const double> normal, int parts, Motion& to) {
  to = now_;
  const double share = 1. / parts;
  const std::span<double> f = std::span(friction_).first(2 * n_);
  const std::span<double> slip = std::span(slip_).first(2 * n_);
  const std::span<double> radius = std::span(radius_).first(n_);
  std::fill(f.begin(), f.end(), 0.);
  bool rough = false;
  for (std::size_t i = 0; i < n_; ++i) {
    radius[i] = frictionless_ ? 0. : mu_[i] * share * normal[i];
    rough = rough || radius[i] > 0.;
  }
  for (int part = 0; part < parts; ++part) {
    for (std::size_t j = 0; j < 2 * n_; ++j) {
      double sum = to.ut[j];
      for (std::size_t i = 0; i < n_; ++i) sum += share * nt(i, j) * normal[i];
      slip[j] = sum;
    }
    if (rough && !discs_.find(tt(), stride_, slip, radius, f, slip_rounding * speed_))
      converged_ = false;
    for (std::size_t i = 0; i < n_; ++i) {
      double change = 0.;
      for (std::size_t j = 0; j < n_; ++j) change += share * K_[i * stride_ + j] * normal[j];
      for (std::size_t j = 0; j < 2 * n_; ++j) change += nt(i, j) * f[j];
      const double work = share * normal[i] * (to.un[i] + 0.5 * change);
      to.un[i] += change;
      to.pn[i] += share * normal[i];
      to.work[i] += work;
      to.energy += work;
    }
    for (std::size_t j = 0; j < 2 * n_; ++j) {
      double after = slip[j];
      for (std::size_t k = 0; k < 2 * n_; ++k) after += tt()[j * stride_ + k] * f[k];
      to.energy += 0.5 * f[j] * (to.ut[j] + after);
      to.ut[j] = after;
      to.pt[j] += f[j];
    }
  }
}

// Whether one part tells the path from a motion: two lead where it does, and no slip has turned, since
// a turn in the first part is missed by both.
bool SimultaneousCollisions::is_straight(const Motion& from, const Motion& one,
                                         const Motion& two) const {
  const double allowed = path_tolerance * speed_;
  double work = 0., size = 0.;
  for (std::size_t i = 0; i < n_; ++i) {
    if (std::abs(one.un[i] - two.un[i]) > allowed) return false;
    work += std::abs(two.work[i] - one.work[i]);
    size += std::abs(two.work[i]);
    const std::size_t j = 2 * i;
    const double x = from.ut[j], y = from.ut[j + 1], before = std::hypot(x, y);
    const double now_x = two.ut[j], now_y = two.ut[j + 1], now = std::hypot(now_x, now_y);
    if (std::hypot(one.ut[j] - now_x, one.ut[j + 1] - now_y) > allowed) return false;
    if (two.pt[j] == from.pt[j] && two.pt[j + 1] == from.pt[j + 1]) continue;
    if (std::min(before, now) <= allowed) continue;
    const double turn = std::hypot(now_x / now - x / before, now_y / now - y / before);
    if (turn * std::min(before, now) > allowed) return false;
  }
  return !restores_ || work <= path_tolerance * size;
}

// How many parts the path along a ray needs.
int SimultaneousCollisions::parts_for(std::span<const double> normal) {
  strike(normal, 1, trial_);
  strike(normal, 2, finer_);
  return is_straight(now_, trial_, finer_) ? 1 : most_parts;
}

// ray_: the normal impulses without friction that bring now_ to the target.
void SimultaneousCollisions::aim(std::span<const double> target) {
  const std::span<double> bias = std::span(bias_).first(n_);
  for (std::size_t i = 0; i < n_; ++i) bias[i] = now_.un[i] - target[i];
  normals_.find(nn(), stride_, bias, std::span(ray_).first(n_));
}

// What trial_, reached along ray_, misses of the target: approach that is left, and impulse at points
// that are above it.
double SimultaneousCollisions::missing(std::span<const double> target) const {
  double most = 0.;
  for (std::size_t i = 0; i < n_; ++i) {
    const double over = trial_.un[i] - target[i];
    most = std::max({most, -over, std::min(over, ray_[i] * K_[i * stride_ + i])});
  }
  return most;
}

// gain_: change of u_n by normal impulses and the friction that they leave at trial_, with or without
// the widening of its discs. False where it has none.
bool SimultaneousCollisions::find_gain(bool widens) {
  const std::span<double> slip = std::span(slip_).first(2 * n_);
  const std::span<double> f = std::span(friction_).first(2 * n_);
  const std::span<double> widening = std::span(widening_).first(n_);
  if (!discs_.begin_response(tt(), stride_, std::span(trial_.ut).first(2 * n_),
                             std::span(radius_).first(n_), f))
    return false;
  for (std::size_t j = 0; j < n_; ++j) {
    std::fill(widening.begin(), widening.end(), 0.);
    if (widens && !frictionless_) widening[j] = mu_[j];
    for (std::size_t i = 0; i < 2 * n_; ++i) slip[i] = nt(j, i);
    discs_.respond(slip, widening, f);
    for (std::size_t i = 0; i < n_; ++i) {
      double sum = K_[i * stride_ + j];
      for (std::size_t k = 0; k < 2 * n_; ++k) sum += nt(i, k) * f[k];
      gain_[i * n_ + j] = sum;
    }
  }
  return true;
}

// A step of Newton's method for ray_ (Alart & Curnier 1991): points that are pressed more than they are
// above the target come to it, the others have no impulse.
bool SimultaneousCollisions::improve(std::span<const double> target) {
  const std::span<double> ray = std::span(ray_).first(n_);
  const std::span<double> change = std::span(change_).first(n_);
  if (!find_gain(true)) return false;
  active_.clear();
  double mean = 0.;
  for (std::size_t i = 0; i < n_; ++i) {
    const double own = K_[i * stride_ + i];
    mean += own / static_cast<double>(n_);
    if (ray[i] * own > trial_.un[i] - target[i]) active_.push_back(i);
  }
  const std::size_t m = active_.size();
  for (std::size_t a = 0; a < m; ++a) {
    const std::size_t i = active_[a];
    double sum = target[i] - trial_.un[i];
    for (std::size_t j = 0; j < n_; ++j) sum += gain_[i * n_ + j] * ray[j];
    for (std::size_t b = 0; b < m; ++b) {
      const std::size_t j = active_[b];
      sum -= gain_[i * n_ + j] * ray[j];
      system_[a * m + b] = gain_[i * n_ + j] + (a == b ? yielding * mean : 0.);
    }
    change[a] = sum;
  }
  const std::span<std::size_t> pivot = std::span(pivot_).first(m);
  if (!factorise_dense(std::span(system_).first(m * m), pivot)) return false;
  solve_dense(system_, pivot, change.first(m));
  for (std::size_t i = 0, a = 0; i < n_; ++i) {
    const bool active = a < m && active_[a] == i;
    ray[i] = active ? std::max(0., ray[i] + change[a++]) : 0.;
  }
  return true;
}

// ray_: normal impulses that bring now_ to the target, complementary to what is left of the approach,
// with the friction that they leave; trial_ where they lead. Newton's method from those without
// friction: false where it does not come ever nearer.
bool SimultaneousCollisions::balance(std::span<const double> target) {
  const std::span<double> ray = std::span(ray_).first(n_);
  const std::span<double> best = std::span(best_).first(n_);
  aim(target);
  double before = std::numeric_limits<double>::infinity();
  for (int round = 0; round < most_balances; ++round) {
    strike(ray, 1, trial_);
    const double now = missing(target);
    if (now <= balanced * speed_) return true;
    if (!(now <= nearer * before)) break;
    before = now;
    std::copy(ray.begin(), ray.end(), best.begin());
    if (!improve(target)) break;
  }
  if (before > nearly_balanced * speed_) return false;
  std::copy(best.begin(), best.end(), ray.begin());
  strike(ray, 1, trial_);
  return true;
}

// trial_: half of the way to the target along the ray without friction, that of bias_; or all of it
// along the ray that counts with the friction of points that stick, if that misses less and takes energy.
void SimultaneousCollisions::halve(std::span<const double> target) {
  const std::span<double> ray = std::span(ray_).first(n_);
  const std::span<double> plain = std::span(best_).first(n_);
  for (double& normal : ray) normal *= 0.5;
  strike(ray, 1, trial_);
  const double missed = missing(target);
  std::copy(ray.begin(), ray.end(), plain.begin());
  if (!find_gain(false)) return;
  normals_.find(gain_, n_, std::span(bias_).first(n_), ray);
  strike(ray, 1, trial_);
  if (missing(target) <= misses_less * missed && trial_.energy <= now_.energy) return;
  std::copy(plain.begin(), plain.end(), ray.begin());
  strike(ray, 1, trial_);
}

// Whether friction takes back what the ray of trial_ gives along the normals.
bool SimultaneousCollisions::is_wedged() const {
  double moved = 0., free = 0.;
  for (std::size_t i = 0; i < n_; ++i) {
    moved += ray_[i] * (trial_.un[i] - now_.un[i]);
    for (std::size_t j = 0; j < n_; ++j) free += ray_[i] * K_[i * stride_ + j] * ray_[j];
  }
  return moved <= wedged * free;
}

bool SimultaneousCollisions::is_below(std::span<const double> target) const {
  for (std::size_t i = 0; i < n_; ++i)
    if (now_.un[i] < target[i] - 2. * no_approach * speed_) return true;
  return false;
}

// From now_ until no point is below its target: `parts` - 1 equal parts of the way, the rest at once.
// Where normal impulses and friction do not come to terms on that, half of it, and again.
bool SimultaneousCollisions::reach(std::span<const double> target, bool lifts, int parts) {
  const std::span<double> ray = std::span(ray_).first(n_);
  at_once_ = true;
  for (int part = 1; part <= most_rests; ++part) {
    if (!is_below(target)) return true;
    if (part >= parts && balance(target)) {
      std::swap(now_, trial_);
      continue;
    }
    aim(target);
    if (lifts && !frictionless_) {
      strike(ray, 1, trial_);
      if (is_wedged()) {
        frictionless_ = true;
        continue;
      }
    }
    if (part < parts) {
      for (double& normal : ray) normal /= parts - part + 1;
      strike(ray, 1, trial_);
    } else {
      at_once_ = false;
      halve(target);
    }
    std::swap(now_, trial_);
  }
  return false;
}

// The same in as many parts as it needs.
bool SimultaneousCollisions::follow(std::span<const double> target, bool lifts) {
  start_ = now_;
  const bool reached = reach(target, lifts, 1), once = reached && at_once_;
  if (frictionless_) return reached;
  coarser_ = now_;
  now_ = start_;
  const bool twice = reach(target, lifts, 2) && at_once_;
  if (once && twice && is_straight(start_, coarser_, now_)) return true;
  now_ = start_;
  return reach(target, lifts, most_parts);
}

void SimultaneousCollisions::restitute(std::span<const CollidingPoint> points) {
  const std::span<double> ray = std::span(ray_).first(n_);
  double goal = 0.;
  for (std::size_t i = 0; i < n_; ++i) {
    ray[i] = points[i].restitution * now_.pn[i];
    goal -= points[i].restitution * points[i].restitution * std::min(0., now_.work[i]);
  }
  if (!(goal > 0.)) return;
  const int parts = parts_for(ray);
  const auto gained = [&] {
    double sum = 0.;
    for (std::size_t i = 0; i < n_; ++i) sum += trial_.work[i] - now_.work[i];
    return sum;
  };
  strike(ray, parts, trial_);
  frictionless_ = is_wedged();
  if (frictionless_) strike(ray, parts, trial_);
  // The work is a length + b length^2 where slips keep their directions, a its rate at the start.
  double before = std::numeric_limits<double>::infinity();
  for (int number = 0; number < most_lengths; ++number) {
    const double work = gained(), missed = std::abs(work - goal);
    if (missed <= work_rounding * goal || missed >= before || !(work > 0.)) break;
    before = missed;
    double a = 0.;
    for (std::size_t i = 0; i < n_; ++i) a += ray[i] * now_.un[i];
    const double squared = a * a + 4. * (work - a) * goal;
    const double sum = a + std::sqrt(std::max(0., squared));
    const double length = sum > 0. ? 2. * goal / sum : std::sqrt(goal / work);
    for (double& normal : ray) normal *= length;
    strike(ray, parts, trial_);
  }
  // What parts of a path leave unknown of friction's work is not to become energy.
  for (double cut = first_cut; trial_.energy > 1e-14 * goal && cut < 1.; cut *= 2.) {
    for (double& normal : ray) normal *= 1. - cut;
    strike(ray, parts, trial_);
  }
  std::swap(now_, trial_);
}

bool SimultaneousCollisions::run(std::span<CollidingPoint> points) {
  const std::span<double> target = std::span(target_).first(n_);
  std::fill(target.begin(), target.end(), 0.);
  if (!std::isfinite(speed_) || !follow(target, false)) return false;
  restitute(points);
  for (std::size_t i = 0; i < n_; ++i) target[i] = now_.pn[i] > 0. ? points[i].rebound_speed : 0.;
  if (!follow(target, true)) return false;
  for (std::size_t i = 0; i < n_; ++i) {
    points[i].impulse = now_.pn[i] * axes_[3 * i] + now_.pt[2 * i] * axes_[3 * i + 1] +
                        now_.pt[2 * i + 1] * axes_[3 * i + 2];
  }
  return true;
}

}  // namespace hookpoint::contact
