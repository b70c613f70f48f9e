// What is plotted of a movie: every step's values, computed by going through the whole movie once
// for all that is wanted at a time, and kept.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "apps/view/session/reel.h"
#include "apps/view/session/traces.h"

namespace hookpoint::view {

class MovieTraces {
 public:
  explicit MovieTraces(const ShownMovie& movie) : movie_(movie) {}

  /// What is not known yet is read by the next pass through the movie. `is_port`: whether the movie
  /// has such a trail; others, and more than Traces::most_columns, stay unknown (NaN).
  void want(const std::vector<std::string>& trails,
            const std::function<bool(const std::string& trail)>& is_port);
  /// Whether something is left to be read.
  bool busy() const { return !waiting_.empty() || under_way(); }
  /// Reads for so long. Throws output::MovieError.
  void work(Reel::Clock::time_point until);
  /// How far the pass under way has come, from 0 to 1.
  double progress() const;

  /// Whether all of these, but the unknown, are read up to `time` [s], or to the end.
  bool known(const std::vector<std::string>& trails, double time) const;
  /// What is read of them so far (apps/view/session/traces.h), of all up to the same moment.
  Traces::Extract extract(const std::vector<std::string>& trails, double from, double to,
                          std::size_t points) const;

 private:
  struct Pass {
    Traces traces;
    std::vector<const double*> sources{};  ///< one a column; null: no port
    std::unique_ptr<Reel> reel{};          ///< none once it is complete
    double read = -1.;                     ///< up to this time [s]
  };
  bool under_way() const { return !passes_.empty() && passes_.back().reel != nullptr; }
  const Pass* pass_of(const std::string& trail) const;
  bool is_waiting(const std::string& trail) const;
  std::size_t columns() const;
  /// Those that have or will have a column of `trails`; null: the next.
  std::set<const Pass*> passes_of(const std::vector<std::string>& trails) const;
  void begin_pass();
  void look_up(Pass& pass);
  void sample(Pass& pass);

  const ShownMovie movie_;
  std::deque<Pass> passes_;
  std::vector<std::string> waiting_;
  std::vector<double> values_;
};

}  // namespace hookpoint::view
