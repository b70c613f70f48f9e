// The shared suite of tests/support/contact_law_suite.h on every law of the table, and the table.
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
    EXPECT_EQ(find_force_law(law.name).has_value(), !law.is_impulse_law) << law.name;
    EXPECT_FALSE(law.source.empty());
  }
  EXPECT_TRUE(std::holds_alternative<HookpointReset>(*find_force_law("hookpoint_reset")));
  EXPECT_TRUE(find_law("impulse_reversal")->is_impulse_law);
  EXPECT_EQ(find_impulse_law("impulse_reversal"), ImpulseLaw::impulse_reversal);
  EXPECT_FALSE(find_impulse_law("hookpoint"));
  EXPECT_EQ(find_law("hookpiont"), nullptr);
  EXPECT_FALSE(find_force_law("").has_value());
}

TEST(LawTable, HasARateFormOfEveryForceLawWhichIsItsOwn) {
  for (const LawDescription& law : law_table()) {
    if (law.is_impulse_law) continue;
    const AnyForceLaw form = rate_form(*find_force_law(law.name));
    EXPECT_EQ(rate_form(form).index(), form.index()) << law.name;
    EXPECT_EQ(normal_constants(form).stiffness, law.along_normal.stiffness) << law.name;
  }
  EXPECT_TRUE(std::holds_alternative<Hookpoint::RateForm>(rate_form(Hookpoint{})));
  EXPECT_TRUE(std::holds_alternative<Lugre>(rate_form(Lugre{})));
}

TEST(LawTable, WarnsOfNoConstantThatHookpointReads) {
  for (const LawDescription& law : law_table()) {
    for (const Constant own : law.own_constants) EXPECT_FALSE(reads(Hookpoint{}, own)) << law.name;
  }
}

/// A point mass after 20 ms on ground of the material, into which it is thrown askew.
ImpulseState thrown(ImpulseLaw law, const Constants& material) {
  const auto level = [&](const Vector3d& point) {
    return GroundPoint{point.z, {0., 0., 1.}, &material};
  };
  ImpulseAdvance engine({1., {}, {1., 1., 1., 0., 0., 0.}, {{0., 0., 0.}}, {}}, law);
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
    const ImpulseLaw which = *find_impulse_law(law.name);
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
  EXPECT_EQ(evaluate(*find_force_law("hunt_crossley"), point, {}, material, dt).force,
            direct.force);
}

}  // namespace
}  // namespace hookpoint::contact
