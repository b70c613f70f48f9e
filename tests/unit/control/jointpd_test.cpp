// Eighteen PD controllers in one component.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <string>

#include "control/registry.h"
#include "tests/support/allocation_counter.h"

namespace hookpoint::testing {
namespace {

std::string at(const char* name, std::size_t i) {
  return std::string(name) + "[" + std::to_string(i) + "]";
}

class Bench {
 public:
  void set(const std::string& name, double value) { component_->values()[index(name)] = value; }
  double get(const std::string& name) const { return component_->values()[index(name)]; }
  void update() { component_->update({0., 1e-3, 0}); }

 private:
  std::size_t index(const std::string& name) const {
    return *control::find_value(*component_, name);
  }
  std::unique_ptr<control::Component> component_ =
      control::Registry::instance().find("Controller.JointPD")->make();
};

TEST(JointPD, TorquesAreThePdLawOfEachJointsKind) {
  Bench bench;
  const double p[] = {10., 20., 30.}, d[] = {0.1, 0.2, 0.3};
  for (std::size_t kind = 0; kind < 3; ++kind) {
    bench.set(at("pconstant", kind), p[kind]);
    bench.set(at("dconstant", kind), d[kind]);
    bench.set(at("limit", kind), 1e3);
  }
  std::mt19937 random(5);
  std::uniform_real_distribution<double> angle(-1., 1.);
  double goal[18], measured[18], rate[18];
  for (std::size_t joint = 0; joint < 18; ++joint) {
    bench.set(at("goal", joint), goal[joint] = angle(random));
    bench.set(at("angle", joint), measured[joint] = angle(random));
    bench.set(at("rate_in", joint), rate[joint] = angle(random));
  }
  bench.update();
  for (std::size_t joint = 0; joint < 18; ++joint) {
    EXPECT_DOUBLE_EQ(bench.get(at("torque", joint)),
                     p[joint % 3] * (goal[joint] - measured[joint]) - d[joint % 3] * rate[joint]);
  }
}

TEST(JointPD, TorquesStayWithinTheLimitOfTheirKind) {
  Bench bench;
  for (std::size_t kind = 0; kind < 3; ++kind) bench.set(at("limit", kind), 1. + double(kind));
  for (std::size_t joint = 0; joint < 18; ++joint)
    bench.set(at("goal", joint), joint < 9 ? 100. : -100.);
  bench.update();
  for (std::size_t joint = 0; joint < 18; ++joint) {
    EXPECT_EQ(bench.get(at("torque", joint)), (joint < 9 ? 1. : -1.) * (1. + double(joint % 3)));
  }
}

TEST(JointPD, UpdatesAllocateNothing) {
  const auto component = control::Registry::instance().find("Controller.JointPD")->make();
  component->start(1e-3);
  const long before = allocation_count();
  for (std::int64_t k = 0; k < 1000; ++k) component->update({double(k) * 1e-3, 1e-3, k});
  EXPECT_EQ(allocation_count(), before);
}

}  // namespace
}  // namespace hookpoint::testing
