#include "contact/geometry/ball_on_surface.h"

#include <algorithm>
#include <cmath>

#include "contact/geometry/border.h"
#include "contact/geometry/places_near.h"

namespace hookpoint::contact {
namespace {

/// Contacts before they share: those that are deepest, in the order in which they were found.
class Found {
 public:
  void add(const SurfaceContact& contact) {
    if (count_ < most_obstructions) {
      contacts_[count_++] = contact;
      return;
    }
    const auto shallowest = std::ranges::min_element(contacts_, {}, &SurfaceContact::depth);
    if (shallowest->depth < contact.depth) *shallowest = contact;
  }

  /// The part of each that was added; those that have one go into `result`.
  std::array<double, most_obstructions> share_into(BallContacts& result) const {
    std::array<Obstruction, most_obstructions> obstructions;
    std::array<std::size_t, most_obstructions> which{};
    std::size_t deep = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      if (contacts_[i].depth <= 0.) continue;
      which[deep] = i;
      obstructions[deep++] = {contacts_[i].normal, contacts_[i].depth};
    }
    if (deep > 0) share_out(std::span(obstructions).first(deep));
    std::array<double, most_obstructions> part;
    part.fill(deep == 0 ? 1. : 0.);
    for (std::size_t i = 0; i < deep; ++i) part[which[i]] = obstructions[i].part;
    for (std::size_t i = 0; i < count_; ++i) {
      if (part[i] == 0.) continue;
      result.contacts[result.count] = contacts_[i];
      result.contacts[result.count++].part = part[i];
    }
    return part;
  }

 private:
  std::array<SurfaceContact, most_obstructions> contacts_;
  std::size_t count_ = 0;
};

void touch_from_outside(const Surface& surface, const Vector3d& c, double radius,
                        const Vector3d& outward, double reach, Found& found) {
  const bool is_corner = radius == 0. && outward != Vector3d{};
  places_near(surface, c, radius + reach, radius == 0.,
              [&](const Vector3d& normal, double distance, int material, bool at_corner) {
                if (at_corner && dot(normal, outward) > 0.) return;
                if (is_corner && distance <= edge_width && !points_against(outward, normal)) return;
                found.add({normal, radius - distance, 1., material});
              });
}

/// The face that a centre on its way from `before` to `c`, inside, went through first; -1 where it only
/// touches the border. `outward`: of a corner, zero of others.
std::int64_t entered_face(const Surface& surface, const Vector3d& before, const Vector3d& c,
                          const Vector3d& outward) {
  const Region way{{std::min(before.x, c.x), std::min(before.y, c.y), std::min(before.z, c.z)},
                   {std::max(before.x, c.x), std::max(before.y, c.y), std::max(before.z, c.z)}};
  double first = 2.;
  std::int64_t entered = -1;
  surface.faces(way, [&](const Face& face) {
    const double h0 = face.height(before), h1 = face.height(c);
    if (!(h0 >= -edge_width && h1 < -edge_width)) return;
    const double at = h0 / (h0 - h1);
    if (at < first && is_over(face, before + at * (c - before), false)) {
      first = at;
      entered = face.id;
    }
  });
  if (entered < 0) return surface.face_over(c, outward);
  if (outward == Vector3d{} || points_against(outward, surface.face(entered).normal))
    return entered;
  // Its shape does not lie beyond that face: where it came in flush with an edge, it lies beyond the other.
  const auto touched = touched_face(surface, before + first * (c - before), outward);
  if (!touched) return entered;
  return touched->height(c) < -edge_width ? touched->id : -1;
}

void hold(Holding& holding, std::int64_t face) {
  const auto faces = std::span(holding.faces).first(holding.count);
  if (holding.count < Holding::most && std::ranges::find(faces, face) == faces.end())
    holding.faces[holding.count++] = face;
}

/// The face that takes over from `face`; itself if none does.
std::int64_t follow(const Surface& surface, const Face& face, const Vector3d& c) {
  constexpr double blunt = 0.7;  // cosine between the normals
  for (const FaceEdge& edge : face.all_edges()) {
    if (edge.beyond < 0 || edge.fold == Fold::concave) continue;
    const double across = dot(c - edge.point, edge.outward);
    if (edge.fold == Fold::flat) {
      if (across > edge_width) return edge.beyond;
      continue;
    }
    const Face beyond = surface.face(edge.beyond);
    const double height = beyond.height(c);
    // The bisecting plane of the two faces: where it is as far below the one as below the other.
    if (dot(face.normal, beyond.normal) > blunt && height > face.height(c) && height <= 0.)
      return edge.beyond;
  }
  return face.id;
}

constexpr int most_faces_a_step = 64;

/// Where the faces that held it lead to, and those that join in.
Holding move_on(const Surface& surface, const Holding& before, const Vector3d& c, double radius) {
  Holding now;
  for (std::size_t i = 0; i < before.count; ++i) {
    std::int64_t id = before.faces[i];
    for (int moved = 0; moved < most_faces_a_step; ++moved) {
      const std::int64_t next = follow(surface, surface.face(id), c);
      if (next == id) break;
      id = next;
    }
    if (surface.face(id).height(c) < radius) hold(now, id);
  }
  for (std::size_t i = 0; i < now.count; ++i) {
    const Face face = surface.face(now.faces[i]);
    for (const FaceEdge& edge : face.all_edges()) {
      if (edge.fold == Fold::concave && surface.face(edge.beyond).height(c) < radius)
        hold(now, edge.beyond);
    }
  }
  return now;
}

}  // namespace

std::int64_t face_along(const Surface& surface, const Vector3d& inside, const Vector3d& normal,
                        double most_depth) {
  constexpr double within = 0.7;  // cosine
  double nearest = within;
  std::int64_t along = -1;
  surface.faces(region_about(inside, 0.), [&](const Face& face) {
    const double cosine = dot(face.normal, normal);
    const double height = face.height(inside);
    if (cosine <= nearest || height >= 0. || height < -most_depth || !is_over(face, inside, true))
      return;
    nearest = cosine;
    along = face.id;
  });
  return along;
}

BallContacts ball_on_surface(const Surface& surface, const Vector3d& center, double radius,
                             const Vector3d& before, const Holding& held, double reach,
                             const Vector3d& outward) {
  BallContacts result;
  Found found;
  Holding start = held;
  const bool inside = surface.contains(center);
  if (inside && start.count == 0) {
    const Vector3d of_corner = radius == 0. ? outward : Vector3d{};
    const std::int64_t entered = entered_face(surface, before, center, of_corner);
    if (entered >= 0) hold(start, entered);
  }
  if (!inside || start.count == 0) {
    touch_from_outside(surface, center, radius, outward, reach, found);
    found.share_into(result);
    return result;
  }
  result.holding = move_on(surface, start, center, radius);
  if (result.holding.count == 0) hold(result.holding, surface.nearest_face(center).id);
  const Holding all = result.holding;
  for (std::size_t i = 0; i < all.count; ++i) {
    const Face face = surface.face(all.faces[i]);
    found.add({face.normal, radius - face.height(center), 1., face.material});
  }
  // A face that gives no part of the way out holds no longer; it joins in again when it does.
  result.holding.count = 0;
  const std::array<double, most_obstructions> parts = found.share_into(result);
  for (std::size_t i = 0; i < all.count; ++i)
    if (parts[i] > 0.) hold(result.holding, all.faces[i]);
  return result;
}

}  // namespace hookpoint::contact
