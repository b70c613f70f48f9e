#include "contact/geometry/rim_on_round.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "contact/geometry/folds.h"
#include "math/sine_cosine.h"

namespace hookpoint::contact {
namespace {

/// A rim as a circle by its angle from the reference.
class Circle {
 public:
  explicit Circle(const Rim& rim) : rim_(rim), across_(cross(rim.axis, rim.reference)) {}

  Vector3d radial(double angle) const {
    const SineCosine<double> at = sine_cosine(angle);
    return at.cosine * rim_.reference + at.sine * across_;
  }
  Vector3d place(double angle) const { return rim_.center + rim_.radius * radial(angle); }
  Vector3d tangent(double angle) const { return cross(rim_.axis, radial(angle)); }
  double radius() const { return rim_.radius; }

 private:
  const Rim& rim_;
  Vector3d across_;
};

constexpr int samples = 16;  // of a circle, among which roots and minima are looked for
constexpr double sample_width = 2. * std::numbers::pi / samples;

/// Angles near which `value` changes its sign, by the straight line between samples; visits each. Two that
/// are nearer to each other than a sample is wide are none.
template <class Value, class Visitor>
void for_each_sign_change(const Value& value, const Visitor& visit) {
  double before = value(0.);
  for (int i = 1; i <= samples; ++i) {
    const double now = value(i * sample_width);
    if ((before < 0.) != (now < 0.)) visit((i - now / (now - before)) * sample_width);
    before = now;
  }
}

/// Angles of the least values round about, by golden section; of those that may lie below `limit`, where
/// the value grows by `steepest` a radian at most.
template <class Value, class Visitor>
void for_each_minimum(const Value& value, double steepest, double limit, const Visitor& visit) {
  constexpr int cuts = 40;  // to 4e-9 of the interval: the value is then exact to rounding
  std::array<double, samples> values;
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = value(static_cast<double>(i) * sample_width);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] - steepest * sample_width > limit) continue;
    if (values[i] > values[(i + samples - 1) % samples] || values[i] >= values[(i + 1) % samples])
      continue;
    double low = (static_cast<double>(i) - 1.) * sample_width, high = low + 2. * sample_width;
    const double part = std::numbers::phi - 1.;
    double inner = high - part * (high - low), outer = low + part * (high - low);
    double at_inner = value(inner), at_outer = value(outer);
    for (int k = 0; k < cuts; ++k) {
      if (at_inner < at_outer) {
        high = outer;
        outer = inner;
        at_outer = at_inner;
        inner = high - part * (high - low);
        at_inner = value(inner);
      } else {
        low = inner;
        inner = outer;
        at_inner = at_outer;
        outer = low + part * (high - low);
        at_outer = value(outer);
      }
    }
    visit(0.5 * (low + high));
  }
}

/// Two circles where they are nearest to each other: x on the first, q on the second, with x - q across
/// both tangents.
struct Crossing {
  Vector3d place, of_other;  ///< x, q [m]
  Vector3d radial, out;      ///< unit, from either centre
  Vector3d across;           ///< unit, across both tangents
  double sine_2 = 0.;        ///< of the angle between them
};

/// By Newton's method from angles at which they are near; none where they run alongside or it does not
/// settle.
std::optional<Crossing> crossing(const Circle& first, double angle, const Circle& second) {
  constexpr int most_rounds = 12;
  constexpr double done = 1e-12, longest = 0.3;  // [rad]
  constexpr double parallel = 1e-6;              // sine^2
  double other_angle = 0.;
  for (int round = 0; round < most_rounds; ++round) {
    const Vector3d t = first.tangent(angle), u = second.tangent(other_angle);
    const Vector3d both = cross(t, u), x = first.place(angle), q = second.place(other_angle);
    const double sine_2 = dot(both, both);
    if (sine_2 < parallel) return std::nullopt;
    const Vector3d radial = first.radial(angle), out = second.radial(other_angle), way = x - q;
    const double cosine = dot(t, u), along_t = dot(way, t), along_u = dot(way, u);
    const double tt = first.radius() - dot(way, radial), uu = -second.radius() - dot(way, out);
    const double tu = -second.radius() * cosine, ut = first.radius() * cosine;
    const double determinant = tt * uu - tu * ut;
    if (determinant == 0.) return std::nullopt;
    const double turn = (tu * along_u - uu * along_t) / determinant;
    const double other_turn = (ut * along_t - tt * along_u) / determinant;
    if (std::max(std::abs(turn), std::abs(other_turn)) < done)
      return Crossing{x, q, radial, out, (1. / std::sqrt(sine_2)) * both, sine_2};
    angle += std::clamp(turn, -longest, longest);
    other_angle += std::clamp(other_turn, -longest, longest);
  }
  return std::nullopt;
}

class RimSearch {
 public:
  RimSearch(const RoundSolid& solid, const ShapeRim& shape, double reach, bool held,
            RimContacts& found)
      : solid_(solid),
        shape_(shape),
        circle_(shape.rim),
        reach_(reach),
        length_(solid.length()),
        held_(held),
        found_(found) {}

  void on_end(std::size_t which, bool with_rims) {
    const RoundEnd end = end_of(solid_, which);
    // The shape comes from the other side, or all of its rim is over the end.
    if (end.radius == 0.) return;
    if (!solid_.is_disc() && !shape_.is_over(end.height(shape_.middle), 0.5 * length_)) return;
    const double lowest = end.height(shape_.rim.center) -
                          shape_.rim.radius * norm(tangential(end.normal, shape_.rim.axis));
    if (lowest >= reach_) return;
    const auto points = deepest_points(shape_.rim, end.normal, -end.height(shape_.rim.center));
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double depth = -end.height(points[i]);
      if (depth > -reach_ && is_under(end, points[i], depth))
        found_.add({RimContact::Kind::end, which, i, points[i], end.normal, depth, 1.});
    }
    if (with_rims) on_rim(which, end);
  }

  void on_side() {
    const auto height = [&](double angle) {
      const auto at = over_side(solid_, circle_.place(angle));
      return at ? at->height : -solid_.radius;
    };
    for_each_minimum(height, shape_.rim.radius, reach_, [&](double angle) {
      const Vector3d place = circle_.place(angle);
      const auto at = over_side(solid_, place);
      if (!at || !at->within || -at->height <= -reach_ || -at->height > greatest_radius()) return;
      const double weight = between_faces(at->normal, circle_.radial(angle)) *
                            shorter_way(-at->height, depth_below_ends(place));
      if (weight > 0.)
        found_.add({RimContact::Kind::side, 0, 0, place, at->normal, -at->height, weight});
    });
  }

 private:
  void on_rim(std::size_t which, const RoundEnd& end) {
    const auto outside = [&](double angle) {
      const Vector3d across = tangential(circle_.place(angle) - end.center, end.normal);
      return dot(across, across) - end.radius * end.radius;
    };
    for_each_sign_change(outside, [&](double angle) {
      const Vector3d place = circle_.place(angle);
      const Vector3d over = unit(tangential(place - end.center, end.normal));
      const Rim rim{end.center, end.normal, end.radius, over};
      const std::optional<Crossing> at = crossing(circle_, angle, Circle(rim));
      constexpr double same = 1e-9;  // of the radius
      const auto is_at = [&](const RimContact& other) {
        return other.kind == RimContact::Kind::rim && other.end == which && at &&
               norm(other.place - at->place) < same * end.radius;
      };
      if (!at || std::ranges::any_of(found_.all(), is_at)) return;
      Vector3d normal = at->across;
      if (dot(normal, end.normal + at->out) < 0.) normal = -normal;
      const double depth = dot(at->of_other - at->place, normal);
      if (depth <= -reach_ || depth > greatest_radius()) return;
      constexpr double nearly_parallel = 0.01;  // sine^2
      const double weight = std::min(1., at->sine_2 / nearly_parallel) *
                            between(normal, {at->out, end.normal}) *
                            between_faces(normal, at->radial);
      if (weight > 0.)
        found_.add({RimContact::Kind::rim, which, 0, at->place, normal, depth, weight});
    });
  }

  /// Between the side and the end of the shape that meet in the rim, seen against the normal.
  double between_faces(const Vector3d& normal, const Vector3d& radial) const {
    return between(-normal, {radial, shape_.end_against(normal)});
  }

  /// Whether a point at that depth under an end is left by the end: it is nearer to it than to the
  /// side, or hardly inside, as where two rims lie on each other.
  bool is_under(const RoundEnd& end, const Vector3d& point, double depth) const {
    constexpr double shallow = 0.02;  // of the solid
    const Vector3d across = tangential(point - end.center, end.normal);
    const double margin = end.radius - norm(across);
    if (margin < -edge_width) return false;
    if (solid_.is_disc()) {
      constexpr double level = 1e-3;  // of the radius: of rims that lie on each other
      return held_ ? depth < end.radius : depth <= margin + level * end.radius;
    }
    const auto side = over_side(solid_, point);
    return depth <= shallow * std::min(length_, greatest_radius()) || !side ||
           side->height <= -depth;
  }

  /// Below the nearer flat end [m]; infinity where there is none.
  double depth_below_ends(const Vector3d& place) const {
    if (!solid_.flat_ends) return std::numeric_limits<double>::infinity();
    return std::min(-end_of(solid_, 0).height(place), -end_of(solid_, 1).height(place));
  }

  double greatest_radius() const { return std::max(solid_.radius, solid_.far_radius); }

  const RoundSolid& solid_;
  const ShapeRim& shape_;
  Circle circle_;
  double reach_, length_;
  bool held_;
  RimContacts& found_;
};

}  // namespace

RimContacts rim_on_round(const RoundSolid& solid, const ShapeRim& shape, double reach,
                         bool with_rims, const CameOver& of_a_disc) {
  RimContacts found;
  RimSearch search(solid, shape, reach, of_a_disc.held, found);
  for (const std::size_t end : {0, 1}) {
    if (solid.flat_ends && (!solid.is_disc() || end == of_a_disc.end))
      search.on_end(end, with_rims);
  }
  if (solid.length() > 0.) search.on_side();
  return found;
}

}  // namespace hookpoint::contact
