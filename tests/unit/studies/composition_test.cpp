#include <gtest/gtest.h>

#include "studies/results/selection.h"

namespace hookpoint::studies {
namespace {

class CompositionOfExperiment : public ::testing::Test {
 protected:
  CompositionOfExperiment() {
    engines_.add("dts", {described_as({"dts", "1", "double", true, {}, {}})});
    engines_.add("ode", {described_as({"ode", "1", "double", false, {}, {}})});
    experiment_.engine = "dts";
    experiment_.integrator = "rk4";
    experiment_.settings = "matched";
  }
  SubjectInfo info() const { return composition_of(experiment_, engines_, "one"); }

  EngineTable engines_;
  simulation::Experiment experiment_;
};

TEST_F(CompositionOfExperiment, HasLawAndIntegratorOfOurEngine) {
  experiment_.contact = "hookpoint";
  EXPECT_EQ(info().name, "one");
  EXPECT_EQ(info().engine, "dts");
  EXPECT_EQ(info().law, "hookpoint");
  EXPECT_EQ(info().integrator, "rk4");
  EXPECT_EQ(info().settings, "");
  EXPECT_TRUE(info().available);
}

TEST_F(CompositionOfExperiment, HasNoIntegratorUnderAnImpulseLaw) {
  experiment_.contact = "impulse";
  EXPECT_EQ(info().law, "impulse");
  EXPECT_EQ(info().integrator, "");
}

TEST_F(CompositionOfExperiment, HasSettingsAloneOfAnotherEngine) {
  experiment_.engine = "ode";
  experiment_.contact = "hookpoint";
  EXPECT_EQ(info().law, "");
  EXPECT_EQ(info().integrator, "");
  EXPECT_EQ(info().settings, "matched");
  EXPECT_FALSE(info().available);
}

TEST_F(CompositionOfExperiment, IsNotAvailableFromAnEngineThatTheProgramHasNot) {
  experiment_.engine = "havok";
  EXPECT_FALSE(info().available);
  EXPECT_EQ(engines_.find("havok"), nullptr);
  EXPECT_EQ(engines_.describe("havok").name, "havok");
  EXPECT_FALSE(engines_.describe("havok").found);
}

}  // namespace
}  // namespace hookpoint::studies
