// Drawn scenes of bodies of every shape on drawn ground and among drawn obstacles, and what no run of
// one may show: energy that nothing put in, a body under the ground, a body inside another.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <exception>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "math/rotation.h"
#include "tests/support/drawn.h"
#include "tests/support/run_text.h"

namespace hookpoint::test_support {

/// A convex solid: all places within `radius` of the hull of `points`, which are relative to `center`.
struct Solid {
  std::string fields;  ///< of its Shape or Obstacle
  std::string kind;    ///< Box, Capsule, ...
  std::vector<Vector3d> points = {};
  double radius = 0.;
  Vector3d center = {};  ///< in the shape's frame
};

struct Placed {
  const Solid* solid;
  Vector3d place;
  Quaterniond turn = {1., 0., 0., 0.};
};

/// Whether two solids, each with its lengths times `part` about its centre, share a place: the point
/// of the Minkowski difference nearest to the origin by Gilbert's method. Undecided is no.
inline bool overlap(const Placed& a, const Placed& b, double part) {
  std::vector<Vector3d> differences;
  const auto at = [part](const Placed& body, const Vector3d& point) {
    return body.place + rotate(body.turn, body.solid->center + part * point);
  };
  for (const Vector3d& p : a.solid->points)
    for (const Vector3d& q : b.solid->points) differences.push_back(at(a, p) - at(b, q));
  const double reach = part * (a.solid->radius + b.solid->radius);
  Vector3d nearest = differences.front();
  for (int i = 0; i < 1000; ++i) {
    const double distance = norm(nearest);
    if (distance <= std::max(reach, 1e-9)) return true;
    const Vector3d& support = *std::ranges::min_element(
        differences, {}, [&](const Vector3d& v) { return dot(v, nearest); });
    if (dot(support, nearest) > reach * distance) return false;
    const Vector3d way = support - nearest;
    const double length = dot(way, way);
    if (length == 0.) return false;
    nearest = nearest + std::clamp(-dot(nearest, way) / length, 0., 1.) * way;
  }
  return false;
}

/// One kind of each Shape; the same of Obstacle but for those that an Obstacle has not.
inline Solid drawn_solid(std::mt19937_64& random, double size, bool of_obstacle) {
  Solid solid;
  const auto length = [&](double low = 0.4) { return size * drawn(random, low, 1.); };
  const auto rim = [&](double radius, const Vector3d& center, const Vector3d& e1,
                       const Vector3d& e2) {
    constexpr int count = 32;
    for (int i = 0; i < count; ++i) {
      const double angle = 2. * std::numbers::pi * i / count;
      solid.points.push_back(center + radius * (std::cos(angle) * e1 + std::sin(angle) * e2));
    }
  };
  constexpr Vector3d x{1., 0., 0.}, y{0., 1., 0.}, z{0., 0., 1.};
  switch (random() % (of_obstacle ? 5 : 7)) {
    case 0: {
      solid.radius = length();
      solid.points = {{}};
      solid.kind = "Sphere";
      solid.fields = fmt::format("radius = {};", solid.radius);
      break;
    }
    case 1: {
      const Vector3d half{length(), length(), length()};
      for (int i = 0; i < 8; ++i)
        solid.points.push_back({(i & 1) != 0 ? half.x : -half.x, (i & 2) != 0 ? half.y : -half.y,
                                (i & 4) != 0 ? half.z : -half.z});
      solid.kind = "Box";
      solid.fields = fmt::format("dimensions = {}, {}, {};", 2. * half.x, 2. * half.y, 2. * half.z);
      break;
    }
    case 2: {
      solid.radius = length(0.2);
      const double half = length();
      solid.points = {half * z, -half * z};
      solid.kind = "Capsule";
      solid.fields = fmt::format("radius = {}; length = {};", solid.radius, 2. * half);
      break;
    }
    case 3: {
      const double radius = length(), half = length();
      rim(radius, half * z, x, y);
      rim(radius, -half * z, x, y);
      solid.kind = "Cylinder";
      solid.fields = fmt::format("radius = {}; length = {};", radius, 2. * half);
      break;
    }
    case 4: {
      // Well apart, so that no edge or face is all but nothing.
      const std::size_t count = 4 + random() % 9;
      while (solid.points.size() < count) {
        const Vector3d point{drawn(random, -size, size), drawn(random, -size, size),
                             drawn(random, -size, size)};
        const bool apart = std::ranges::all_of(
            solid.points, [&](const Vector3d& other) { return norm(point - other) > 0.4 * size; });
        if (apart) solid.points.push_back(point);
      }
      solid.kind = "Hull";
      solid.fields = "points = ";
      for (const Vector3d& p : solid.points)
        solid.fields +=
            fmt::format("{}{}, {}, {}", &p == &solid.points.front() ? "" : ", ", p.x, p.y, p.z);
      solid.fields += ";";
      for (const Vector3d& p : solid.points)
        solid.center += (1. / static_cast<double>(solid.points.size())) * p;
      for (Vector3d& p : solid.points) p -= solid.center;
      break;
    }
    case 5: {
      const double near = length(), far = length(0.1), half = length();
      solid.center = half * x;
      rim(near, -half * x, y, z);
      rim(far, half * x, y, z);
      solid.kind = "Legcone";
      solid.fields = fmt::format("length = {}; proximal_radius = {}; distal_radius = {};",
                                 2. * half, near, far);
      break;
    }
    default: {
      const double radius = length();
      rim(radius, {}, x, y);
      solid.kind = "Disc";
      solid.fields = fmt::format("radius = {};", radius);
    }
  }
  return solid;
}

/// What a yard's bodies are made of, and what of their energy may be more at times than at the start.
struct YardOf {
  std::string world;  ///< fields of the World: contact, deltat
  std::string material;
  /// Of semi-implicit Euler's own: up to half of deltat times the frequency of what is in a spring.
  double ripple = 0.01;
};

/// Springs without damping and friction, so stiff that no body is pressed in by its size.
inline YardOf elastic_yard() {
  return {"deltat = 0.02 ms;",
          "normal_stiffness = 400 kN/m; normal_damping = 0; tangential_stiffness = 400 kN/m; "
          "tangential_damping = 0; static_friction = 0; kinetic_friction = 0;"};
}

/// Under a law with a linear spring, at half its largest stable step.
inline YardOf damped_yard(const std::string& law) {
  return {"contact = " + law + "; deltat = auto;",
          "normal_stiffness = 200 kN/m; normal_damping = 320; tangential_stiffness = 200 kN/m; "
          "tangential_damping = 320; static_friction = 0.8; kinetic_friction = 0.7; "
          "nominal_penetration = 0.1 mm; nominal_stiffness = 100 kN/m;",
          0.05};
}

/// A scene of `seed`: ground, up to three obstacles, two to four bodies above them, apart from all.
class DrawnYard {
 public:
  DrawnYard(unsigned seed, const YardOf& of) {
    std::mt19937_64 random(seed);
    draw_ground(random);
    const std::size_t obstacle_count = random() % 4;
    for (std::size_t i = 0; i < obstacle_count; ++i)
      add(random, drawn_solid(random, drawn(random, 0.05, 0.25), true), 0., 0.25, obstacles_);
    const std::size_t body_count = 2 + random() % 3;
    for (std::size_t i = 0; i < body_count; ++i)
      add(random, drawn_solid(random, drawn(random, 0.06, 0.12), false), 0.35, 0.8, bodies_);
    head_ =
        fmt::format("World yard {{ touch = shapes; gravity = 9.81; {} Material stuff {{ {} }} {} ",
                    of.world, of.material, ground_);
  }

  std::string text() const {
    std::string text = head_;
    for (std::size_t i = 0; i < obstacles_.size(); ++i)
      text +=
          fmt::format("Obstacle.{} o{} {{ {} {} material = stuff; }} ", obstacles_[i].solid.kind, i,
                      obstacles_[i].solid.fields, pose(obstacles_[i]));
    for (std::size_t i = 0; i < bodies_.size(); ++i)
      text += fmt::format("Robot b{} {{ Base.mobile {{ {} {} Shape.{} {{ {} mass = {}; }} }} }} ",
                          i, pose(bodies_[i]), bodies_[i].motion, bodies_[i].solid.kind,
                          bodies_[i].solid.fields, bodies_[i].mass);
    return text + "}";
  }

  /// The same with as few bodies and obstacles as show a fault.
  DrawnYard reduced(double duration, double ripple) const {
    for (const auto which : {&DrawnYard::obstacles_, &DrawnYard::bodies_})
      for (std::size_t i = 0; i < (this->*which).size(); ++i) {
        DrawnYard fewer = *this;
        (fewer.*which).erase((fewer.*which).begin() + static_cast<std::ptrdiff_t>(i));
        if (!fewer.bodies_.empty() && !fewer.fault(duration, ripple).empty())
          return fewer.reduced(duration, ripple);
      }
    return *this;
  }

  /// What a run of `duration` [s] shows that it may not; "" where there is nothing. `ripple`: part of
  /// the energy at the start by which that of an integrator's step may exceed it.
  std::string fault(double duration, double ripple) const {
    try {
      Running run(text());
      const double start = energy(run), deltat = run["yard.deltat"];
      const int steps_a_look = std::max(1, static_cast<int>(2e-3 / deltat));
      for (double time = 0.; time < duration; time += steps_a_look * deltat) {
        run.step(steps_a_look);
        if (!(energy(run) <= (1. + ripple) * start))
          return fmt::format("energy {} J at {} s, {} J at the start", energy(run), time, start);
        const std::vector<Placed> now = placed(run);
        for (std::size_t i = 0; i < bodies_.size(); ++i) {
          if (!(dot(up_, now[i].place + rotate(now[i].turn, now[i].solid->center)) > lowest_))
            return fmt::format("b{} under the ground at {} s", i, time);
          for (std::size_t j = i + 1; j < now.size(); ++j) {
            if (overlap(now[i], now[j], 0.4))
              return fmt::format("b{} inside {}{} at {} s", i, j < bodies_.size() ? "b" : "o",
                                 j < bodies_.size() ? j : j - bodies_.size(), time);
          }
        }
      }
    } catch (const std::exception& error) {
      return error.what();
    }
    return "";
  }

 private:
  struct Standing {
    Solid solid;
    Vector3d place;
    std::array<double, 3> angles;  ///< roll, pitch, yaw [rad]
    Quaterniond turn;
    std::string motion;  ///< at the start
    double mass;         ///< [kg]
  };

  void draw_ground(std::mt19937_64& random) {
    switch (random() % 4) {
      case 0:
        ground_ = "Terrain.Flat floor { material = stuff; }";
        break;
      case 1: {
        const double angle = drawn(random, 0., 0.4);
        ground_ = fmt::format("Terrain.Slope floor {{ angle = {}; material = stuff; }}", angle);
        up_ = {std::sin(angle), 0., std::cos(angle)};
        break;
      }
      case 2:
        ground_ = fmt::format(
            "Terrain.Steps floor {{ height = {}; run = {}; from = 0.1; count = 4; size = 6, 6; "
            "material = stuff; }}",
            drawn(random, -0.1, 0.1), drawn(random, 0.15, 0.5));
        lowest_ = -0.41;
        break;
      default:
        ground_ = fmt::format(
            "Terrain.Rough floor {{ amplitude = {}; wavelength = {}; spacing = 0.05; size = 8, 8; "
            "seed = {}; material = stuff; }}",
            drawn(random, 0., 0.06), drawn(random, 0.3, 1.), random() % 1000);
        lowest_ = -0.2;
    }
  }

  static std::string pose(const Standing& body) {
    return fmt::format("location = {}, {}, {}; orientation = {}, {}, {};", body.place.x,
                       body.place.y, body.place.z, body.angles[0], body.angles[1], body.angles[2]);
  }

  void add(std::mt19937_64& random, Solid solid, double low, double high,
           std::vector<Standing>& to) {
    for (int attempt = 0; attempt < 100; ++attempt) {
      Standing body{solid, {}, {}, {}, {}, drawn(random, 0.3, 1.)};
      // Bodies close together fall on one another.
      body.place = {drawn(random, -0.25, 0.25), drawn(random, -0.25, 0.25),
                    drawn(random, low, high)};
      for (double& angle : body.angles) angle = drawn(random, -3., 3.);
      body.turn = from_roll_pitch_yaw(body.angles[0], body.angles[1], body.angles[2]);
      body.motion =
          fmt::format("velocity = {}, {}, 0; angular_velocity = {}, {}, {};",
                      drawn(random, -1., 1.), drawn(random, -1., 1.), drawn(random, -5., 5.),
                      drawn(random, -5., 5.), drawn(random, -5., 5.));
      const Placed placed{&body.solid, body.place, body.turn};
      const auto meets = [&](const Standing& other) {
        return overlap(placed, {&other.solid, other.place, other.turn}, 1.15);
      };
      if (&to == &bodies_ &&
          (std::ranges::any_of(obstacles_, meets) || std::ranges::any_of(bodies_, meets)))
        continue;
      to.push_back(std::move(body));
      return;
    }
  }

  double energy(const Running& run) const {
    double sum = 0.;
    for (std::size_t i = 0; i < bodies_.size(); ++i)
      sum += run[fmt::format("yard.b{}.kinetic_energy", i)] +
             run[fmt::format("yard.b{}.potential_energy", i)];
    return sum;
  }

  /// Bodies, then obstacles.
  std::vector<Placed> placed(const Running& run) const {
    std::vector<Placed> all;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const auto at = [&](const char* what) {
        return run[fmt::format("yard.b{}.base.{}", i, what)];
      };
      all.push_back(
          {&bodies_[i].solid,
           {at("location.x"), at("location.y"), at("location.z")},
           {at("orientation.w"), at("orientation.x"), at("orientation.y"), at("orientation.z")}});
    }
    for (const Standing& obstacle : obstacles_)
      all.push_back({&obstacle.solid, obstacle.place, obstacle.turn});
    return all;
  }

  std::string ground_;
  Vector3d up_{0., 0., 1.};
  /// How far up a body's centre is at least: a disc that lies flat is as deep as its weight presses [m].
  double lowest_ = -0.01;
  std::vector<Standing> obstacles_, bodies_;
  std::string head_;
};

/// What is wrong with a run of 0.75 s, and the least text that shows it.
inline std::string fault_of(const DrawnYard& yard, const YardOf& of) {
  constexpr double duration = 0.75;
  if (yard.fault(duration, of.ripple).empty()) return "";
  const DrawnYard least = yard.reduced(duration, of.ripple);
  return least.fault(duration, of.ripple) + ": " + least.text();
}

}  // namespace hookpoint::test_support
