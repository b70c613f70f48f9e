#include "studies/calibrate/profile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace hookpoint::studies {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
/// An excess below this is another optimum.
constexpr double better_excess = -0.1;
/// The first place is this much farther out than the linearised model expects the end. Where the
/// excess there is beyond the bound, by no more than this factor, it confirms the model: the end
/// follows from the parabola through it. (Within the bound the excess may level off.)
constexpr double first_beyond = 1.2, confirmed_to = 2.;
/// A refit ends where it comes below this excess: the point is inside.
constexpr double surely_inside = 0.5;
/// Beyond this excess a refit takes no second start, and no wide differences.
constexpr double hopeless = 1e3;
/// Distances below this part of the range are not resolved.
constexpr double finest = 1e-4;
/// Distance of the point beside the optimum by which the first place is chosen.
constexpr double probe_distance = 1e-3;
/// Refits begin this far inside the box: at its very edge no step leaves it.
constexpr double inset = 1e-3;
/// Places beyond the first end: multiples of its distance, then equal parts of what is left of the
/// range.
constexpr std::array beyond_multiples{1.5, 4.};
constexpr int beyond_parts = 6;
/// Halvings between the farthest place inside and the next one beyond.
constexpr int halvings = 5;
/// Steps of the search without derivatives, from over the ripples to below them, and its rounds.
constexpr std::array coordinate_steps{0.03, 0.012, 0.005, 0.002};
constexpr int coordinate_rounds = 1;
/// Excess up to which ripples may be what holds a refit.
constexpr double ripples_up_to = 100.;

/// The best point among all that were evaluated with some constants free, the others held.
class Refit {
 public:
  Refit(const ProfileProblem& problem, std::vector<std::size_t> free, UnitPoint held,
        const ProfileOptions& options)
      : problem_(problem), free_(std::move(free)), held_(std::move(held)), options_(options) {}

  double best() const { return best_; }
  const UnitPoint& point() const { return point_; }
  std::size_t models() const { return models_; }

  std::optional<double> try_point(const UnitPoint& point) {
    const auto residuals = evaluate(point);
    return residuals ? std::optional(last_) : std::nullopt;
  }

  /// From the best point so far, downhill.
  void descend(double difference) {
    if (done() || free_.empty() || !std::isfinite(best_)) return;
    descend_from(point_, difference);
  }
  void descend_from(const UnitPoint& from, double difference) {
    if (done() || free_.empty()) return;
    const auto start = problem_.model(from);
    ++models_;
    if (!start) return;
    UnitPoint others;
    for (const std::size_t one : free_) others.push_back(from[one]);
    FitOptions fit = options_.refit;
    fit.difference = difference;
    (void)refine(
        [&](const UnitPoint& moved) -> std::optional<Residuals> {
          if (done()) return std::nullopt;
          const auto residuals = evaluate(whole(moved));
          if (!residuals) return std::nullopt;
          return problem_.to_squares(*residuals, *start);
        },
        others, fit);
  }

  /// Along each free constant by steps over the ripples and below them: what holds a search by
  /// derivatives does not hold this one.
  void search_coordinates() {
    for (int round = 0; round < coordinate_rounds && !done(); ++round) {
      const double before = best_;
      for (const double step : coordinate_steps) {
        for (const std::size_t one : free_) {
          for (const double sign : {1., -1.}) {
            if (done()) return;
            UnitPoint moved = point_;
            moved[one] = std::clamp(moved[one] + sign * step, 0., 1.);
            const double least = best_;
            (void)try_point(moved);
            if (best_ < least) break;
          }
        }
      }
      if (!(best_ < before)) return;
    }
  }

  /// All of it, from these starts.
  void search(std::vector<UnitPoint> starts) {
    std::vector<std::pair<double, UnitPoint>> valued;
    for (UnitPoint& start : starts) {
      if (done()) return;
      const auto excess = try_point(start);
      if (excess) valued.emplace_back(*excess, std::move(start));
    }
    if (free_.empty() || valued.empty()) return;
    std::ranges::stable_sort(valued, {}, [](const auto& one) { return one.first; });
    descend(options_.refit.difference);
    if (inside() || best_ > hopeless) return;
    descend(options_.wide_difference);
    descend(options_.refit.difference);
    if (!inside() && valued.size() > 1) descend_from(valued[1].second, options_.refit.difference);
    if (!inside() && best_ < ripples_up_to) search_coordinates();
  }

  bool inside() const { return best_ <= 1.; }

 private:
  bool done() const { return best_ <= surely_inside; }

  UnitPoint whole(const UnitPoint& moved) const {
    UnitPoint all = held_;
    for (std::size_t i = 0; i < free_.size(); ++i) all[free_[i]] = moved[i];
    return all;
  }

  std::optional<Residuals> evaluate(const UnitPoint& point) {
    ++models_;
    auto residuals = problem_.model(point);
    if (!residuals) return std::nullopt;
    last_ = problem_.excess(*residuals);
    if (last_ < best_) {
      best_ = last_;
      point_ = point;
    }
    return residuals;
  }

  const ProfileProblem& problem_;
  std::vector<std::size_t> free_;
  UnitPoint held_;
  const ProfileOptions& options_;
  double best_ = infinite, last_ = infinite;
  UnitPoint point_;
  std::size_t models_ = 0;
};

/// One walk from the optimum to an end of the range.
class Walk {
 public:
  Walk(const ProfileProblem& problem, std::size_t constant, bool up, const ProfileOptions& options)
      : problem_(problem),
        optimum_(problem.optimum),
        constant_(constant),
        sign_(up ? 1. : -1.),
        options_(options),
        room_(up ? 1. - optimum_[constant] : optimum_[constant]) {
    end_.point = optimum_;
    valley_.push_back(optimum_);
    for (std::size_t i = 0; i < optimum_.size(); ++i)
      if (i != constant_) others_.push_back(i);
  }

  ProfileEnd find() {
    linearise_at_optimum();
    walk_to_first_end();
    if (!end_.better && outside_) search_beyond();
    end_.share = held_at(crossing());
    end_.wide_share = held_at(std::max(crossing(), wide_));
    end_.without_runs = outside_ && std::isinf(outside_excess_);
    return std::move(end_);
  }

 private:
  struct Place {
    double distance = 0., excess = 0.;
    UnitPoint point;  ///< empty: no run
  };

  void linearise_at_optimum() {
    const auto at_optimum = problem_.model(optimum_);
    ++end_.models;
    if (!at_optimum) return;
    const auto fit = linearise(
        [&](const UnitPoint& point) -> std::optional<Residuals> {
          ++end_.models;
          const auto residuals = problem_.model(point);
          if (!residuals) return std::nullopt;
          return problem_.to_squares(*residuals, *at_optimum);
        },
        optimum_, options_.refit.difference);
    if (!fit) return;
    const LinearProfile linear = linear_profile(*fit, constant_);
    if (std::ranges::all_of(linear.others, [](double one) { return std::isfinite(one); }))
      slope_ = linear.others;
  }

  void walk_to_first_end() {
    double distance = first_distance();
    bool interpolates = true;
    for (std::size_t i = 0; i < options_.most_places && distance > inside_; ++i) {
      const double excess = excess_at(distance);
      if (end_.better) return;
      if (i == 0 && distance < room_ && excess >= 1. && excess <= confirmed_to) {
        inside_ = std::min(room_, distance / std::sqrt(excess));
        outside_ = inside_;
        return;
      }
      if (excess <= 1.) {
        inside_ = distance;
        inside_excess_ = std::max(0., excess);
        if (!outside_) {
          if (distance >= room_) return;
          distance = std::min(room_, wider(distance, excess));
          continue;
        }
      } else {
        outside_ = distance;
        outside_excess_ = excess;
      }
      if (resolved()) return;
      distance = between(interpolates);
      interpolates = !interpolates;
    }
  }

  /// A ripple, a barrier or a sharp bend may have stopped the walk: the constant is refitted at
  /// places all the way to the end of its range, and where these have a least excess all constants
  /// are.
  void search_beyond() {
    const double first = std::max(crossing(), finest);
    const double part = (room_ - first) / beyond_parts;
    if (!(part > finest)) return;
    std::vector<double> distances;
    for (const double multiple : beyond_multiples)
      if (multiple * first < first + part) distances.push_back(multiple * first);
    for (int i = 1; i <= beyond_parts; ++i)
      distances.push_back(i == beyond_parts ? room_ : first + i * part);
    std::vector<Place> places;
    std::optional<std::size_t> farthest;
    for (const double distance : distances) {
      const double excess = excess_at(distance);
      if (end_.better) return;
      places.push_back({distance, excess, last_});
      if (excess <= 1.) farthest = places.size() - 1;
      if (excess <= surely_outside) wide_ = distance;
    }
    if (farthest && leads_to(*farthest, places)) {
      inside_ = places[*farthest].distance;
      inside_excess_ = std::max(0., places[*farthest].excess);
      outside_.reset();
      if (*farthest + 1 < places.size()) {
        outside_ = places[*farthest + 1].distance;
        outside_excess_ = places[*farthest + 1].excess;
      }
      for (int i = 0; i < halvings && outside_ && !resolved(); ++i) {
        const double middle = between(i % 2 == 0);
        const double excess = excess_at(middle);
        if (end_.better) return;
        (excess <= 1. ? inside_ : *outside_) = middle;
        (excess <= 1. ? inside_excess_ : outside_excess_) =
            excess <= 1. ? std::max(0., excess) : excess;
      }
    }
    search_apart(places);
  }

  /// Whether the valley leads to a place inside: refitted again, between what is inside on either
  /// side, the places before it are inside as well. If not it is in a valley of its own.
  bool leads_to(std::size_t inside, std::vector<Place>& places) {
    const UnitPoint found = places[inside].point;
    for (std::size_t i = 0; i < inside; ++i) {
      if (places[i].excess <= 1.) continue;
      places[i].excess = excess_at(places[i].distance);
      if (places[i].excess <= surely_outside) continue;
      end_.apart = found;
      return false;
    }
    return true;
  }

  void search_apart(const std::vector<Place>& places) {
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (places[i].distance <= inside_ || places[i].point.empty()) continue;
      const bool least = (i == 0 || places[i].excess <= places[i - 1].excess) &&
                         (i + 1 == places.size() || places[i].excess <= places[i + 1].excess);
      if (!least) continue;
      const auto found = refit_all(problem_, places[i].point, options_);
      if (!found) continue;
      end_.models += found->models;
      if (note_better(found->point, found->excess)) return;
      const double distance = sign_ * (found->point[constant_] - optimum_[constant_]);
      if (found->excess <= surely_outside && distance > inside_) {
        const bool farther =
            !end_.apart || distance > sign_ * ((*end_.apart)[constant_] - optimum_[constant_]);
        if (farther) end_.apart = found->point;
      }
    }
  }

  /// Where the excess is expected to reach the bound, by a point beside the optimum along the
  /// linearised model's direction.
  double first_distance() {
    if (slope_.empty()) return room_;
    const double probe = std::min(probe_distance, room_);
    UnitPoint point = optimum_;
    for (const std::size_t i : others_)
      point[i] = std::clamp(point[i] + sign_ * probe * slope_[i], 0., 1.);
    point[constant_] = held_at(probe);
    const auto residuals = problem_.model(point);
    ++end_.models;
    const double excess = residuals ? problem_.excess(*residuals) : infinite;
    const double expected = excess > 0. ? first_beyond * probe / std::sqrt(excess) : room_;
    return expected < room_ ? std::max(std::min(finest, room_), expected) : room_;
  }

  double wider(double distance, double excess) const {
    const double parabola = excess > 0. ? 1.1 * distance / std::sqrt(excess) : 2. * distance;
    return std::max(2. * distance, std::min(parabola, 8. * distance));
  }

  bool resolved() const {
    return outside_ && *outside_ - inside_ <= std::max(options_.resolution * inside_, finest);
  }

  /// Where the excess crosses the bound between the two places: its root is taken for a straight
  /// line.
  double crossing() const {
    if (!outside_ || std::isinf(outside_excess_)) return inside_;
    const double less = std::sqrt(inside_excess_), more = std::sqrt(outside_excess_);
    if (!(more > less)) return inside_;
    return inside_ + (*outside_ - inside_) * (1. - less) / (more - less);
  }

  /// The crossing and the middle by turns: the one converges where the excess is smooth, the other
  /// where it is a step.
  double between(bool interpolates) const {
    const double width = *outside_ - inside_;
    const double middle = inside_ + 0.5 * width;
    return interpolates ? std::clamp(crossing(), inside_ + 0.1 * width, *outside_ - 0.1 * width)
                        : middle;
  }

  double held_at(double distance) const {
    return std::clamp(optimum_[constant_] + sign_ * distance, 0., 1.);
  }

  /// The coordinate in which powers and products are straight.
  double coordinate(std::size_t i, double share) const {
    const auto& zero = problem_.zeros[i];
    return zero ? std::log(std::abs(share - *zero)) : share;
  }
  double share_at(std::size_t i, double coordinate, double like) const {
    const auto& zero = problem_.zeros[i];
    return zero ? *zero + std::copysign(std::exp(coordinate), like - *zero) : coordinate;
  }

  /// Starts of a refit: along the line through the last two points of the valley, over shares and
  /// over logarithms of values; as the linearised model has it; the last points as they are.
  std::vector<UnitPoint> starts_at(double distance) const {
    const double held = held_at(distance);
    std::vector<UnitPoint> starts;
    const auto add = [&](UnitPoint point) {
      for (const std::size_t i : others_)
        point[i] = std::isfinite(point[i]) ? std::clamp(point[i], inset, 1. - inset) : 0.5;
      point[constant_] = held;
      if (std::ranges::find(starts, point) == starts.end()) starts.push_back(std::move(point));
    };
    const UnitPoint* before = nullptr;
    const UnitPoint* last = nullptr;  // the two points of the valley between which, or after which
    for (const UnitPoint& point : valley_) {
      const double reached = sign_ * (point[constant_] - optimum_[constant_]);
      if (last != nullptr && reached > distance) {
        before = last;
        last = &point;
        break;
      }
      before = last;
      last = &point;
    }
    if (before != nullptr) {
      const double from = (*before)[constant_], to = (*last)[constant_];
      UnitPoint line = *last, power = *last;
      const double log_from = coordinate(constant_, from), log_to = coordinate(constant_, to);
      for (const std::size_t i : others_) {
        line[i] += ((*last)[i] - (*before)[i]) * (held - to) / (to - from);
        const double slope =
            (coordinate(i, (*last)[i]) - coordinate(i, (*before)[i])) / (log_to - log_from);
        power[i] =
            share_at(i, coordinate(i, (*last)[i]) + slope * (coordinate(constant_, held) - log_to),
                     (*last)[i]);
      }
      add(std::move(power));
      add(std::move(line));
    } else if (!slope_.empty()) {
      // By the derivative at the optimum, with d ln v = dv/v.
      UnitPoint line = optimum_, power = optimum_;
      const auto rate = [&](std::size_t i) {
        return problem_.zeros[i] ? 1. / (optimum_[i] - *problem_.zeros[i]) : 1.;
      };
      for (const std::size_t i : others_) {
        line[i] += sign_ * distance * slope_[i];
        power[i] = share_at(
            i,
            coordinate(i, optimum_[i]) +
                slope_[i] * rate(i) / rate(constant_) *
                    (coordinate(constant_, held) - coordinate(constant_, optimum_[constant_])),
            optimum_[i]);
      }
      add(std::move(line));
      add(std::move(power));
    }
    add(*last);
    if (!last_.empty()) add(last_);
    return starts;
  }

  bool note_better(const UnitPoint& point, double excess) {
    if (!problem_.ends_where_better || !(excess < better_excess)) return false;
    end_.better = point;
    return true;
  }

  /// The excess of the constant at a distance, the others refitted.
  double excess_at(double distance) {
    UnitPoint held = optimum_;
    held[constant_] = held_at(distance);
    Refit refit(problem_, others_, held, options_);
    refit.search(starts_at(distance));
    end_.models += refit.models();
    last_ = refit.point();
    if (last_.empty()) return infinite;
    if (note_better(last_, refit.best())) return refit.best();
    if (refit.inside()) {
      const auto reached = [&](const UnitPoint& point) {
        return sign_ * (point[constant_] - optimum_[constant_]);
      };
      const auto after = std::ranges::find_if(
          valley_, [&](const UnitPoint& point) { return reached(point) >= reached(last_); });
      valley_.insert(after, last_);
      end_.point = valley_.back();
    }
    return refit.best();
  }

  const ProfileProblem& problem_;
  const UnitPoint& optimum_;
  std::size_t constant_;
  double sign_;
  const ProfileOptions& options_;
  double room_;
  std::vector<std::size_t> others_;
  UnitPoint slope_;  ///< of the others with the constant, at the optimum; empty: not known
  std::vector<UnitPoint> valley_;  ///< points inside, from the optimum on
  UnitPoint last_;                 ///< of the last refit
  double inside_ = 0., inside_excess_ = 0., wide_ = 0.;
  std::optional<double> outside_;
  double outside_excess_ = 0.;
  ProfileEnd end_;
};

}  // namespace

ProfileEnd profile_end(const ProfileProblem& problem, std::size_t constant, bool up,
                       const ProfileOptions& options) {
  return Walk(problem, constant, up, options).find();
}

std::optional<FreeRefit> refit_all(const ProfileProblem& problem, const UnitPoint& start,
                                   const ProfileOptions& options) {
  std::vector<std::size_t> all(start.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  Refit refit(problem, all, start, options);
  refit.search({start});
  if (refit.point().empty()) return std::nullopt;
  return FreeRefit{refit.point(), refit.best(), refit.models()};
}

}  // namespace hookpoint::studies
