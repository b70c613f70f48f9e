// A block whose corners stand on two materials: each corner is as deep as its own tile and its
// share of the weight have it.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "contact/force_law.h"
#include "simulation/dts_engine/dts_engine.h"
#include "tests/support/load_text.h"

namespace hookpoint {
namespace {

constexpr double mass = 1.5, g = 9.81, a = 0.1, h = 0.04;  // half length and half height [m]

struct Case {
  std::string law, terrain, fields;
};

std::string text(const Case& tested) {
  return "World w { deltat = 0.1 ms; contact = " + tested.law +
         "; Material hard { normal_stiffness = 40000; static_friction = 0; hysteresis_damping = "
         "40; "
         "nominal_stiffness = 8000; exponential_rate = 1500; }"
         "  Material soft { normal_stiffness = 9000; static_friction = 0; hysteresis_damping = 40; "
         "nominal_stiffness = 2000; nominal_penetration = 0.5 mm; exponential_rate = 800; }" +
         tested.terrain + " { " + tested.fields +
         " material = hard; Patch { from = 0,-5; to = 5,5; material = soft; } }"
         "  Robot block { Base.mobile { rest_on = ground; mass = 1.5; Shape.Box dimensions = "
         "0.2,0.2,0.08; } } }";
}

struct Ground {
  double k = 0., k1 = 0., d0 = 0., d2 = 0.;
};
constexpr Ground hard{40e3, 8e3, 1e-3, 1500.}, soft{9e3, 2e3, 0.5e-3, 800.};

/// Depth at which one point carries `load`.
double depth_under(double load, const std::string& law, const Ground& ground) {
  if (law == "hunt_crossley" || law == "azad_featherstone") {
    return std::pow(load / ground.k, 1. / 1.5);
  }
  if (law == "exponential") return std::log(load / 0.5336) / ground.d2;
  if (law == "nominal" && load > ground.k1 * ground.d0) {
    return ground.d0 + (load - ground.k1 * ground.d0) / ground.k;
  }
  return load / (law == "nominal" ? ground.k1 : ground.k);
}

/// Sine of the lean towards the soft side. Without friction, moments about the centre of mass:
///   N_soft (a cos - h sin) = N_hard (a cos + h sin),   2 (N_soft + N_hard) = m g,
/// and 2 a sin = d_soft - d_hard.
struct Lean {
  double sine = 0., soft_depth = 0., hard_depth = 0.;
};
Lean expected_lean(const std::string& law) {
  Lean lean;
  for (int i = 0; i < 50; ++i) {  // a contraction by h/(a N) dN/dd ~ 1e-2
    const double shift = h / a * lean.sine / std::sqrt(1. - lean.sine * lean.sine);
    lean.soft_depth = depth_under(0.25 * mass * g * (1. + shift), law, soft);
    lean.hard_depth = depth_under(0.25 * mass * g * (1. - shift), law, hard);
    lean.sine = (lean.soft_depth - lean.hard_depth) / (2. * a);
  }
  return lean;
}

class SoftTiles : public ::testing::TestWithParam<Case> {};

TEST_P(SoftTiles, EachCornerSinksAsItsOwnTileLetsIt) {
  const Loaded loaded = load_text(text(GetParam()));
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  const auto engine = simulation::make_dts(*loaded.experiment);
  for (int step = 0; step < 30000; ++step) ASSERT_TRUE(engine->step().ok());

  const Lean expected = expected_lean(GetParam().law);
  const auto& body = engine->state().bodies[0];
  for (const double side_x : {-a, a}) {
    for (const double side_y : {-a, a}) {
      const Vector3d corner =
          body.position + rotate(body.orientation, Vector3d{side_x, side_y, -h});
      const double depth = side_x > 0. ? expected.soft_depth : expected.hard_depth;
      EXPECT_NEAR(-corner.z, depth, 1e-9) << side_x << ", " << side_y;
    }
  }
}

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const contact::LawDescription& law : contact::law_table()) {
    if (!law.is_impulse_law) all.push_back({std::string(law.name), "Terrain.Flat ground", ""});
  }
  all.push_back({"hookpoint", "Terrain.Slope ground", "angle = 0;"});
  all.push_back({"hookpoint", "Terrain.Rough ground", "amplitude = 0; wavelength = 0.5;"});
  all.push_back({"hookpoint", "Terrain.Steps ground", "height = 0.1; run = 0.3;"});
  return all;
}

INSTANTIATE_TEST_SUITE_P(Laws, SoftTiles, ::testing::ValuesIn(cases()), [](const auto& tested) {
  const std::string kind = tested.param.terrain.substr(8, 5);
  return tested.param.law + "_" + kind.substr(0, kind.find(' '));
});

}  // namespace
}  // namespace hookpoint
