// What two materials make of a contact: each rule by hand, and that stiffness is in series.
#include "contact/combination.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

namespace hookpoint::contact {
namespace {

MaterialConstants<double> material(double friction, double stiffness) {
  MaterialConstants<double> made;
  made.static_friction = friction;
  made.kinetic_friction = 0.5 * friction;
  made.restitution = friction;
  made.normal_stiffness = made.tangential_stiffness = stiffness;
  made.exponent = friction;
  return made;
}

TEST(Combination, EveryRuleHasItsValueByHand) {
  const std::map<std::string, double> by_hand{
      {"foot", 0.9},     {"ground", 0.4},    {"minimum", 0.4},         {"maximum", 0.9},
      {"product", 0.36}, {"geometric", 0.6}, {"harmonic", 0.72 / 1.3}, {"series", 0.36 / 1.3}};
  ASSERT_EQ(by_hand.size(), combination_rules().size());
  for (const CombinationRule& row : combination_rules()) {
    const auto made = combine(material(0.9, 1e5), material(0.4, 1e5), row.rule);
    const double expected = by_hand.at(std::string(row.name));
    EXPECT_NEAR(made.static_friction, expected, 1e-15) << row.name;
    EXPECT_NEAR(made.restitution, expected, 1e-15) << row.name;
  }
}

TEST(Combination, StiffnessIsInSeriesUnderEveryRule) {
  for (const CombinationRule& row : combination_rules()) {
    const auto made = combine(material(0.9, 3e5), material(0.4, 1e5), row.rule);
    EXPECT_NEAR(made.normal_stiffness, 0.75e5, 1e-9) << row.name;
    EXPECT_NEAR(made.tangential_stiffness, 0.75e5, 1e-9) << row.name;
  }
}

TEST(Combination, ASideWithoutDamperGivesNone) {
  MaterialConstants<double> undamped;
  undamped.normal_damping = 0.;
  const auto made = combine(undamped, undamped, Combination::series);
  EXPECT_EQ(made.normal_damping, 0.);
}

TEST(Combination, OfTheShapeOfACurveOneSideHoldsWhole) {
  EXPECT_EQ(combine(material(0.9, 1.), material(0.4, 1.), Combination::product).exponent, 0.9);
  EXPECT_EQ(combine(material(0.9, 1.), material(0.4, 1.), Combination::ground).exponent, 0.4);
}

TEST(Combination, RulesStandInTheOrderOfTheirEnumeration) {
  for (std::size_t i = 0; i < combination_rules().size(); ++i)
    EXPECT_EQ(static_cast<std::size_t>(combination_rules()[i].rule), i);
}

}  // namespace
}  // namespace hookpoint::contact
