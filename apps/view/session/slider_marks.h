// Where along its sliders a run's step is unstable, found in a thread of its own: the run steps on.
#pragma once

#include <atomic>
#include <future>
#include <optional>
#include <string>
#include <vector>

#include "apps/view/widgets/slider_paths.h"
#include "apps/view/wire/audience.h"

namespace hookpoint::view {

class SliderMarks {
 public:
  SliderMarks() = default;
  /// Waits for the analysis that is under way, which ends early.
  ~SliderMarks();
  SliderMarks(const SliderMarks&) = delete;
  SliderMarks& operator=(const SliderMarks&) = delete;

  /// Of the run that is now shown; an analysis of another one is given up.
  void show(std::vector<SliderPath> paths);
  /// To be answered with the marks at the gains that `now` has: at once where there is no slider,
  /// else by answer_finished(). Requests that come while another is computed share one analysis.
  void request(const PageRequest& request, simulation::Experiment now, Audience& audience);
  /// Sends what has been found. Never waits.
  void answer_finished(Audience& audience);

 private:
  struct Mark {
    std::string slider;
    simulation::Stretch stretch{};
  };
  void begin(simulation::Experiment now);
  static void answer(const PageRequest& request, const std::vector<Mark>& marks,
                     Audience& audience);

  std::vector<SliderPath> paths_;
  std::atomic<bool> stop_ = false;
  std::future<std::vector<Mark>> found_;        ///< valid while an analysis is under way
  std::vector<PageRequest> asked_;              ///< that it answers
  std::vector<PageRequest> waiting_;            ///< that came later
  std::optional<simulation::Experiment> next_;  ///< for them
};

}  // namespace hookpoint::view
