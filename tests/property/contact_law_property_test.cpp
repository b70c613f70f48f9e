// The shared suite of tests/support/contact_law_suite.h on every law of the table, and the table.
// ctest: alone
#include <gtest/gtest.h>

#include "contact/force_law.h"
#include "contact/impulse/impulse_advance.h"
#include "tests/support/contact_law_suite.h"

namespace hookpoint::contact {
namespace law_suite {

/// The rate form of a thrown hook is not among them: it is at its event where a trial is beyond the
/// cone, and an integrator goes no farther.
template <class Form>
using Checked = std::conditional_t<std::is_same_v<Form, HookpointReset::RateForm>, std::tuple<>,
                                   std::tuple<Form>>;
template <class... Law, class... Form>
auto checked(std::tuple<Law...>, std::tuple<Form...>)
    -> decltype(std::tuple_cat(std::declval<std::tuple<Law...>>(),
                               std::declval<Checked<Form>>()...));
template <class... Law>
auto as_types(std::tuple<Law...>) -> ::testing::Types<Law...>;
using Laws = decltype(as_types(checked(std::declval<NamedForceLaws>(), std::declval<RateForms>())));
INSTANTIATE_TYPED_TEST_SUITE_P(OfTheTable, ContactLaw, Laws);

}  // namespace law_suite
namespace {

using namespace law_suite;

TEST(LawTable, NamesEveryLawOnceAndFindsTheForceLaws) {
  ASSERT_EQ(law_table().size(), std::tuple_size_v<NamedForceLaws> + std::tuple_size_v<ImpulseLaws>);
  for (const LawDescription& law : law_table()) {
    ASSERT_EQ(find_law(law.name), &law);
    EXPECT_EQ(find_force_law(law.name) != nullptr, !law.is_impulse_law) << law.name;
    EXPECT_FALSE(law.source.empty());
  }
  EXPECT_TRUE(std::holds_alternative<HookpointReset>(find_force_law("hookpoint_reset")->variant));
  EXPECT_TRUE(find_law("impulse_reversal")->is_impulse_law);
  EXPECT_EQ(find_impulse_law("impulse_reversal")->impulse->law, ImpulseLaw::impulse_reversal);
  EXPECT_EQ(find_impulse_law("hookpoint"), nullptr);
  EXPECT_EQ(find_law("hookpiont"), nullptr);
  EXPECT_EQ(find_force_law(""), nullptr);
}

TEST(LawTable, HasARateFormOfEveryForceLawWhichIsItsOwn) {
  for (const LawDescription& law : law_table()) {
    if (law.is_impulse_law) continue;
    const LawDescription& form = law.rate_form();
    EXPECT_EQ(&form.rate_form(), &form) << law.name;
    EXPECT_EQ(form.name, law.name);
    EXPECT_EQ(form.normal_constants.stiffness, law.normal_constants.stiffness) << law.name;
  }
  EXPECT_TRUE(
      std::holds_alternative<Hookpoint::RateForm>(find_law("hookpoint")->rate_form().variant));
  EXPECT_TRUE(std::holds_alternative<Lugre>(find_law("lugre")->rate_form().variant));
}

TEST(LawTable, WarnsOfNoConstantThatHookpointReads) {
  for (const LawDescription& law : law_table()) {
    for (const Constant own : law.own_constants)
      EXPECT_FALSE(find_law("hookpoint")->reads(own)) << law.name;
  }
}

/// A point mass after 20 ms on ground of the material, into which it is thrown askew.
ImpulseState thrown(ImpulseLaw law, const Constants& material) {
  const auto level = [&](const Vector3d& point) {
    return GroundPoint{point.z, {0., 0., 1.}, &material};
  };
  ImpulseAdvance engine({1., {}, {1., 1., 1., 0., 0., 0.}, {{0., 0., 0.}}, {}, {}}, law);
  ImpulseState state{{0., 0., 1e-4}, {1., 0., 0., 0.}, {0.3, 0., -0.05}, {}};
  for (int step = 0; step < 20; ++step)
    EXPECT_EQ(engine.advance(state, 1e-3, {{0., 0., -9.81}, {}, {}}, level).status,
              AdvanceStatus::ok);
  return state;
}

TEST(LawTable, SaysWhichConstantsAnImpulseLawReads) {
  Constants material;
  material.restitution = 0.3;
  for (const LawDescription& law : law_table()) {
    if (!law.is_impulse_law) continue;
    const ImpulseLaw which = law.impulse->law;
    const ImpulseState before = thrown(which, material);
    for (const simulation::MaterialField& field : simulation::material_fields()) {
      const ImpulseState after = thrown(which, with_another(material, field.member));
      const bool matters =
          !(after.position == before.position && after.velocity == before.velocity);
      EXPECT_EQ(matters, std::ranges::count(law.constants, field.member) == 1)
          << law.name << " " << field.name;
    }
  }
}

TEST(LawTable, EvaluatesTheLawItHolds) {
  const MaterialConstants<double> material;
  const PointKinematics<double> point{{0., 0., -1e-3}, {0.2, 0., -0.1}, up, 1e-3, {}};
  const auto direct = HuntCrossley::evaluate(point, {}, material, dt);
  EXPECT_EQ(find_force_law("hunt_crossley")->evaluate(point, {}, material, dt).force, direct.force);
}

}  // namespace
}  // namespace hookpoint::contact
