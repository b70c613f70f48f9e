#include "studies/calibrate/profile.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace hookpoint::studies {
namespace {

/// A smaller sum than the optimum's by this part of the bound's margin is another optimum.
constexpr double better_part = 0.1;
/// The first point is this much farther out than the linearised model expects the end. Where the
/// excess there is beyond the bound, by no more than this factor, it confirms the model: the end
/// follows from the parabola through it. (Within the bound the sum may level off.)
constexpr double first_beyond = 1.2, confirmed_to = 2.;
/// An excess below this part of the margin needs no refit: it is within the bound as it is.
constexpr double surely_inside = 0.5;
/// Distances below this part of the range are not resolved.
constexpr double finest = 1e-4;
/// Refits begin this far inside the box: at its very edge no step leaves it.
constexpr double inset = 1e-3;

/// One walk from the optimum to an end.
class Walk {
 public:
  Walk(const ResidualModel& model, const Linearisation& fit, std::size_t constant, bool up,
       double bound, const ProfileOptions& options)
      : model_(model),
        fit_(fit),
        constant_(constant),
        sign_(up ? 1. : -1.),
        options_(options),
        least_(sum_of_squares(fit.residuals)),
        margin_(bound - least_),
        room_(up ? 1. - fit.point[constant] : fit.point[constant]),
        linear_(linear_profile(fit, constant)) {
    end_.point = fit.point;
    end_.sum = least_;
  }

  ProfileEnd find() {
    double distance = first_distance();
    bool interpolates = true;
    for (std::size_t i = 0; i < options_.most_places && distance > inside_ && !end_.better; ++i) {
      const double excess = excess_at(distance);
      if (end_.better) break;
      const bool first = i == 0;
      if (first && distance < room_ && confirmed(excess)) {
        inside_ = std::min(room_, distance * std::sqrt(margin_ / excess));
        outside_ = inside_;
        break;
      }
      if (excess <= margin_) {
        inside_ = distance;
        inside_excess_ = std::max(0., excess);
        if (!outside_) {
          if (distance >= room_) break;
          distance = std::min(room_, wider(distance, excess));
          continue;
        }
      } else {
        outside_ = distance;
        outside_excess_ = excess;
      }
      if (resolved()) break;
      distance = between(interpolates);
      interpolates = !interpolates;
    }
    end_.share = std::clamp(fit_.point[constant_] + sign_ * crossing(), 0., 1.);
    end_.without_runs = outside_ && std::isinf(outside_excess_);
    return std::move(end_);
  }

 private:
  double first_distance() const {
    const double expected = first_beyond * std::sqrt(margin_ / linear_.curvature);
    return expected < room_ ? std::max(std::min(finest, room_), expected) : room_;
  }

  bool confirmed(double excess) const {
    return excess >= margin_ && excess <= confirmed_to * margin_;
  }

  double wider(double distance, double excess) const {
    const double parabola =
        excess > 0. ? 1.1 * distance * std::sqrt(margin_ / excess) : 2. * distance;
    return std::max(2. * distance, std::min(parabola, 8. * distance));
  }

  bool resolved() const {
    return outside_ && *outside_ - inside_ <= std::max(options_.resolution * inside_, finest);
  }

  /// Where the sum crosses the bound between the two points: its root is taken for a straight line.
  double crossing() const {
    if (!outside_ || std::isinf(outside_excess_)) return inside_;
    const double less = std::sqrt(inside_excess_), more = std::sqrt(outside_excess_);
    if (!(more > less)) return inside_;
    return inside_ + (*outside_ - inside_) * (std::sqrt(margin_) - less) / (more - less);
  }

  /// The crossing and the middle by turns: the one converges where the sum is smooth, the other
  /// where it is a step.
  double between(bool interpolates) const {
    const double width = *outside_ - inside_;
    const double middle = inside_ + 0.5 * width;
    return interpolates ? std::clamp(crossing(), inside_ + 0.1 * width, *outside_ - 0.1 * width)
                        : middle;
  }

  double sum_at(const UnitPoint& point) {
    ++end_.models;
    const auto residuals = model_(point);
    return residuals ? sum_of_squares(*residuals) : std::numeric_limits<double>::infinity();
  }

  UnitPoint moved(double distance, const UnitPoint& others) const {
    UnitPoint point = fit_.point;
    for (std::size_t i = 0; i < point.size(); ++i)
      point[i] = i == constant_
                     ? std::clamp(point[i] + sign_ * distance, 0., 1.)
                     : std::clamp(point[i] + sign_ * distance * others[i], inset, 1. - inset);
    return point;
  }

  /// What the least sum over the other constants exceeds the optimum's by.
  double excess_at(double distance) {
    UnitPoint point = moved(distance, linear_.others);
    double sum = sum_at(point);
    if (inside_ > 0. && fit_.point.size() > 1) {
      // Along the line from the optimum through the last point within the bound.
      UnitPoint others(fit_.point.size(), 0.);
      for (std::size_t i = 0; i < others.size(); ++i)
        others[i] = sign_ * (end_.point[i] - fit_.point[i]) / inside_;
      UnitPoint along = moved(distance, others);
      if (const double other = sum_at(along); other < sum) {
        sum = other;
        point = std::move(along);
      }
    }
    if (sum - least_ > surely_inside * margin_ && fit_.point.size() > 1 && std::isfinite(sum))
      refit(point, sum);
    const double excess = sum - least_;
    if (excess < -better_part * margin_) end_.better = LeastSquaresFit{point, sum, 0};
    if (excess <= margin_) {
      end_.point = std::move(point);
      end_.sum = sum;
    }
    return excess;
  }

  void refit(UnitPoint& point, double& sum) {
    const auto whole = [&](const UnitPoint& others) {
      UnitPoint all = point;
      for (std::size_t i = 0, at = 0; i < all.size(); ++i)
        if (i != constant_) all[i] = others[at++];
      return all;
    };
    UnitPoint start;
    for (std::size_t i = 0; i < point.size(); ++i)
      if (i != constant_) start.push_back(point[i]);
    const auto fit = refine([&](const UnitPoint& others) { return model_(whole(others)); }, start,
                            options_.refit);
    if (!fit) return;
    end_.models += fit->models;
    if (!(fit->sum < sum)) return;
    sum = fit->sum;
    point = whole(fit->point);
  }

  const ResidualModel& model_;
  const Linearisation& fit_;
  std::size_t constant_;
  double sign_;
  const ProfileOptions& options_;
  double least_, margin_, room_;
  LinearProfile linear_;
  double inside_ = 0., inside_excess_ = 0.;
  std::optional<double> outside_;
  double outside_excess_ = 0.;
  ProfileEnd end_;
};

}  // namespace

ProfileEnd profile_end(const ResidualModel& model, const Linearisation& fit, std::size_t constant,
                       bool up, double bound, const ProfileOptions& options) {
  return Walk(model, fit, constant, up, bound, options).find();
}

}  // namespace hookpoint::studies
