// Friction impulses of several points at once under given normal impulses: each in a disc of radius
// mu p_n, against the slip that is left (Moreau's principle of most dissipation, implicit).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace hookpoint::contact {

class FrictionDiscs {
 public:
  /// For at most `most` points. Allocates; nothing else does.
  explicit FrictionDiscs(std::size_t most);

  /// The least value of f^T A f/2 + u^T f over |f_i| <= radius_i: `A` symmetric positive
  /// semidefinite, two rows a point, rows `stride` apart; u the slip without friction. Convex, so the
  /// slip A f + u is unique, also where points are redundant: each point sticks, or slips against its f
  /// at the radius. `f` holds a guess; slips below `slip_rounding` are none.
  ///
  /// Method of multipliers (Hestenes 1969, Powell 1969): friction as a stiff damper that saturates at
  /// the radius, about the f of the pass before. A pass minimises a smooth convex function by Newton's
  /// method with an exact line search, which converges from any guess (as SAP of Castro et al. 2022),
  /// and leaves 1e-4 of the slip that the pass before left. All operations are symmetric in the points:
  /// their order matters by rounding alone. Cost O(n^3) a step, of points with a radius; two or three passes
  /// of three steps. Result: whether the slip is that to 1e6 `slip_rounding`; where no points are redundant but
  /// for a hair it is to some `slip_rounding`.
  bool find(std::span<const double> A, std::size_t stride, std::span<const double> u,
            std::span<const double> radius, std::span<double> f, double slip_rounding);

  /// Readies `respond` at `f`, an answer of `find` for the slip `after` that it left.
  bool begin_response(std::span<const double> A, std::size_t stride, std::span<const double> after,
                      std::span<const double> radius, std::span<const double> f);
  /// How f changes with the slip without friction and the radii: to first order.
  void respond(std::span<const double> slip, std::span<const double> radius,
               std::span<double> f) const;

 private:
  void take(std::span<const double> A, std::size_t stride);
  bool minimise(double slip_rounding);
  void damp(double length);
  double slope(double length) const;
  double curvature() const;
  bool linearise();
  void solve_change(std::span<double> x) const;
  std::size_t unknowns() const { return 2 * live_.size(); }

  // Of the points that take part, two entries each unless said otherwise.
  std::vector<std::size_t> live_;  ///< their numbers
  std::vector<double> A_;
  std::vector<double> radius_;     ///< one a point
  std::vector<double> stiffness_;  ///< of a damper: impulse over slip [kg], one a point
  std::vector<double> f_;
  std::vector<double> center_;    ///< f of the pass before
  std::vector<double> slip_;      ///< A f + u
  std::vector<double> answer_;    ///< of the dampers to a slip
  std::vector<double> yield_;     ///< its derivative by -slip: xx, xy, yy of a point
  std::vector<double> outward_;   ///< its derivative by the radius
  std::vector<double> jacobian_;  ///< of f - answer, in triangular factors
  std::vector<std::size_t> pivot_;
  std::vector<double> change_, slip_change_;  ///< along a line
};

}  // namespace hookpoint::contact
