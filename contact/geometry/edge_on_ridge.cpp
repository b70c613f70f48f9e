#include "contact/geometry/edge_on_ridge.h"

#include <algorithm>
#include <cmath>

#include "contact/geometry/folds.h"

namespace hookpoint::contact {
namespace {

/// 0 at the end of an edge, 1 from a quarter of its length on.
double from_end(double part) {
  const double rest = std::max(0., 1. - 4. * part);
  return 1. - rest * rest;
}

double square(double a) { return a * a; }

}  // namespace

std::optional<EdgeContact> edge_on_ridge(const Ridge& ridge, const BodyEdge& edge, double reach,
                                         double most_depth) {
  const Vector3d& e = edge.along;
  const double length = edge.length;
  const double cosine = dot(e, ridge.along);
  const double sine_2 = 1. - cosine * cosine;
  constexpr double parallel = 1e-6;
  if (length == 0. || sine_2 < parallel) return std::nullopt;

  // The places of the two lines that are nearest to each other, times sin^2.
  const Vector3d between_lines = ridge.point - edge.from;
  const double of_edge = dot(between_lines, e), of_ridge = dot(between_lines, ridge.along);
  const double s_sine_2 = of_edge - cosine * of_ridge, t_sine_2 = cosine * of_edge - of_ridge;
  const auto is_past_an_end = [&](double at_edge, double at_ridge, double scale) {
    return at_edge < scale * -edge_width || at_edge > scale * (length + edge_width) ||
           at_ridge < scale * (ridge.from - edge_width) ||
           at_ridge > scale * (ridge.to + edge_width);
  };
  // Most edges of two bodies pass each other by: those leave before the division.
  if (edge.taper == 0. && is_past_an_end(s_sine_2, t_sine_2, sine_2)) return std::nullopt;
  double s = s_sine_2 / sine_2, t = t_sine_2 / sine_2;
  const bool round = edge.radius > 0. || edge.taper != 0.;

  Vector3d normal = (1. / std::sqrt(sine_2)) * cross(e, ridge.along);
  if (dot(normal, ridge.normals[0] + ridge.normals[1]) < 0.) normal = -normal;
  if (edge.taper != 0.) {
    // The balls about the axis reach deepest where their radius grows as their distance does.
    const double nearest = dot(edge.from + s * e - ridge.point - t * ridge.along, normal);
    const double rest_2 = sine_2 - square(edge.taper);
    if (nearest <= 0. || rest_2 <= 0.) return std::nullopt;
    s += edge.taper * nearest / std::sqrt(sine_2 * rest_2);
    t = dot(edge.from + s * e - ridge.point, ridge.along);
    normal = unit(edge.from + s * e - ridge.point - t * ridge.along);
    if (is_past_an_end(s, t, 1.)) return std::nullopt;
  }
  EdgeContact contact;
  const Vector3d on_edge = edge.from + s * e;
  const Vector3d on_ridge = ridge.point + t * ridge.along;
  const double radius = edge.radius + edge.taper * s;
  contact.depth = radius - dot(on_edge - on_ridge, normal);
  if (contact.depth <= -reach || contact.depth > most_depth) return std::nullopt;

  constexpr double nearly_parallel = 0.01;  // sin^2
  contact.weight = std::min(1., sine_2 / nearly_parallel);
  if (round) {
    contact.weight *= between(normal, ridge.outwards);
  } else {
    constexpr double leaning = 0.2;  // so far a sole on soft ground leans and keeps its edge
    contact.weight *= between(normal, ridge.outwards, leaning);
    contact.weight *= between(-normal, edge.outwards, leaning);
  }
  if (contact.weight <= 0.) return std::nullopt;
  contact.place = on_edge - radius * normal;
  contact.normal = normal;
  contact.along = std::clamp(s / length, 0., 1.);
  const auto end_within = [](double at, double from, double to) {
    return at <= from + edge_width ? 0 : at >= to - edge_width ? 1 : -1;
  };
  contact.at_end = end_within(s, 0., length);
  contact.at_ridge_end = end_within(t, ridge.from, ridge.to);

  if (round) return contact;
  const std::array<double, 2> cosines{dot(normal, ridge.normals[0]), dot(normal, ridge.normals[1])};
  const Vector3d across = tangential(ridge.outwards[0] - ridge.outwards[1], normal);
  for (std::size_t end = 0; end < 2; ++end) {
    const Vector3d& place = end == 0 ? edge.from : edge.to;
    const std::size_t over = dot(place - ridge.point, across) > 0. ? 1 : 0;
    contact.end_weights[end] =
        std::max(0., square(std::max(0., cosines[1 - over])) - square(std::max(0., cosines[over])));
  }
  return contact;
}

double end_weighted(const EdgeContact& contact, const std::array<double, 2>& shares) {
  const std::array<double, 2> parts{contact.along, 1. - contact.along};
  double weight = contact.weight;
  for (std::size_t end = 0; end < 2; ++end) {
    const double near = from_end(parts[end]);
    weight *= near + (1. - near) * shares[end] * contact.end_weights[end];
  }
  return weight;
}

}  // namespace hookpoint::contact
