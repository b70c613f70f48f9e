// `match = hookpoint`: a resting point is as deep under every law as under hookpoint, swings about
// that depth with the same frequency, and rebounds as a Kelvin-Voigt body does. The forces are
// written out here; what was chosen is only read.
#include "simulation/analysis/matched_ground.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>

#include "simulation/experiment/material_fields.h"
#include "tests/support/command.h"
#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

constexpr double mass = 1.5, g = 9.81, k = 20e3, height = 0.08;

std::string scene(const std::string& law, double damping, double z) {
  const char* integrator = law.starts_with("impulse") ? "" : "integrator = rk4; ";
  return "World w { gravity = 9.81; deltat = 0.02 ms; " + std::string(integrator) +
         "contact = " + law +
         "; Material m { normal_stiffness = 20 kN/m; normal_damping = " + std::to_string(damping) +
         "; tangential_stiffness = 20 kN/m; tangential_damping = 50 N.s/m; exponent = 1.5; "
         "nominal_stiffness = 5 kN/m; nominal_penetration = 0.5 mm; restitution = 0.1; "
         "rebound_speed = 1 mm/s; }"
         " Terrain.Flat ground { material = m; } Robot p { Base.mobile { location = 0, 0, " +
         std::to_string(z) +
         "; mass = 1.5; inertia = 1, 1, 1, 0, 0, 0; ContactPoint tip { location = 0, 0, 0; } } } }";
}

/// The constants that were chosen, all of them.
contact::MaterialConstants<double> chosen(const std::string& law, double damping, double z) {
  const Loaded loaded = load_text(scene(law, damping, z));
  if (!loaded.experiment) throw std::runtime_error(loaded.diagnostics);
  auto constants = loaded.experiment->materials[0].constants;
  for (const auto& material : simulation::matched_to_hookpoint(*loaded.experiment))
    for (const auto& constant : material.constants)
      for (const simulation::MaterialField& field : simulation::material_fields())
        if (constant.name == field.name) constants.*field.member = constant.chosen;
  return constants;
}

using Force = std::function<double(const contact::MaterialConstants<double>&, double, double)>;

/// N(d, d') as the sources of the laws have it.
const std::map<std::string, Force> laws{
    {"hookpoint", [](const auto& m, double d,
                     double v) { return m.normal_stiffness * d + m.normal_damping * v; }},
    {"lugre", [](const auto& m, double d,
                 double v) { return m.normal_stiffness * d + m.normal_damping * v; }},
    {"elastoplastic", [](const auto& m, double d,
                         double v) { return m.normal_stiffness * d + m.normal_damping * v; }},
    {"nominal",
     [](const auto& m, double d, double v) {
       const double beyond = std::max(0., d - m.nominal_penetration);
       return m.nominal_stiffness * d + (m.normal_stiffness - m.nominal_stiffness) * beyond +
              m.normal_damping * v;
     }},
    {"hunt_crossley",
     [](const auto& m, double d, double v) {
       return m.normal_stiffness * std::pow(std::max(0., d), m.exponent) *
              (1. + m.hysteresis_damping * v);
     }},
    {"azad_featherstone",
     [](const auto& m, double d, double v) {
       const double root = std::sqrt(std::max(0., d));
       return m.normal_stiffness * root * root * root + m.normal_damping * root * v;
     }},
    {"exponential", [](const auto& m, double d, double v) {
       return m.exponential_force * std::exp(m.exponential_rate * (d + m.exponential_height)) *
              (1. + m.hysteresis_damping * v);
     }}};

/// Rebound of the mass at `speed` without gravity, by RK4 from where nothing acts yet.
double rebound(const Force& law, const contact::MaterialConstants<double>& m, double speed,
               double from) {
  double d = from, v = speed;
  const double dt = 1e-7;
  const auto a = [&](double depth, double rate) {
    return depth < from ? 0. : -std::max(0., law(m, depth, rate)) / mass;
  };
  do {
    const double a1 = a(d, v), v2 = v + 0.5 * dt * a1, a2 = a(d + 0.5 * dt * v, v2);
    const double v3 = v + 0.5 * dt * a2, a3 = a(d + 0.5 * dt * v2, v3);
    const double v4 = v + dt * a3, a4 = a(d + dt * v3, v4);
    d += dt / 6. * (v + 2. * v2 + 2. * v3 + v4);
    v += dt / 6. * (a1 + 2. * a2 + 2. * a3 + a4);
  } while (d > from && (v > 0. || law(m, d, v) > 0.));
  return -v / speed;
}

TEST(MatchedGround, CarriesTheLoadAtHookpointsDepth) {
  for (const auto& [law, force] : laws) {
    const auto m = chosen(law, 60., 0.);
    EXPECT_NEAR(force(m, mass * g / k, 0.), mass * g, 1e-9 * mass * g) << law;
  }
}

TEST(MatchedGround, IsAsStiffThereButWhereTheLawsExponentIsFixed) {
  for (const auto& [law, force] : laws) {
    const auto m = chosen(law, 60., 0.);
    const double d = mass * g / k, step = 1e-5 * d;
    const double slope = (force(m, d + step, 0.) - force(m, d - step, 0.)) / (2. * step);
    EXPECT_NEAR(slope / k, law == "azad_featherstone" ? 1.5 : 1., 1e-6) << law;
    const double damping = (force(m, d, 1e-4) - force(m, d, -1e-4)) / 2e-4;
    EXPECT_NEAR(damping, 60., 1e-6) << law << ": what rests is damped as by hookpoint";
  }
}

TEST(MatchedGround, ReboundsAsHookpointDoes) {
  const double damping = 60., speed = std::sqrt(2. * g * height);
  const double zeta = damping / (2. * std::sqrt(k * mass));
  const double e = std::exp(-zeta / std::sqrt(1. - zeta * zeta) * std::acos(2. * zeta * zeta - 1.));
  for (const auto& [law, force] : laws) {
    const auto m = chosen(law, damping, height);
    // Exponential acts above the ground too: a millionth of its load is far enough.
    const double from = law == "exponential" ? -13.8 / m.exponential_rate : 0.;
    EXPECT_NEAR(rebound(force, m, speed, from), e, 2e-3 * e) << law;
    EXPECT_NEAR(force(m, mass * g / k, 0.), mass * g, 1e-9 * mass * g) << law;
  }
  for (const char* law : {"impulse", "impulse_reversal"})
    EXPECT_NEAR(chosen(law, damping, height).restitution, e, 1e-9) << law;
}

TEST(MatchedGround, AStudyRestsAtOneDepthUnderAllLawsAndTellsWhatItChose) {
  const testing::Workplace work;
  std::string text = scene("hookpoint", 400., 0.);
  work.file("scene.hook", text.replace(text.find("contact = hookpoint; "), 21, ""));
  std::string subjects;
  for (const auto& [law, force] : laws)
    subjects += "Subject " + law + " { contact = " + law + "; } ";
  work.file(
      "study.hook",
      "Study rest { scene = \"scene.hook\"; duration = 1 s; settle = 0.9 s; match = hookpoint; " +
          subjects +
          "Measure depth { of = -p.position.z; predicted = 1.5 kg * 9.81 m/s^2 / 20 kN/m; } "
          "Truth depth { equals = predicted; tolerance = 1e-6; } }");
  const auto result = work.hookpoint("study study.hook --out out");
  EXPECT_EQ(result.status, 0) << result.out << result.err;
  EXPECT_NE(result.out.find("Ground matched to hookpoint's"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("at rest: the file's own (depth, stiffness, damping)"),
            std::string::npos)
      << result.out;
  EXPECT_NE(result.out.find("exponent 1.5 → 1"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("stiffness 1.5 times"), std::string::npos) << result.out;
  EXPECT_NE(work.read("out/matched.csv").find("hunt_crossley,m,14.715,0,exponent,,1.5,1,"),
            std::string::npos)
      << work.read("out/matched.csv");
  EXPECT_NE(work.read("out/report.html").find("Ground matched to hookpoint"), std::string::npos);
  // Without it each law has another ground.
  std::string unmatched = work.read("study.hook");
  work.file("other.hook", unmatched.erase(unmatched.find("match = hookpoint; "), 19));
  EXPECT_EQ(work.hookpoint("study other.hook --out other").status, 1);
}

TEST(MatchedGround, SaysWhereThereIsNothingToMatch) {
  const testing::Workplace work;
  work.file("scene.hook",
            "World w { gravity = 0; Terrain.Flat ground; Robot p { Base.mobile { mass "
            "= 1; inertia = 1, 1, 1, 0, 0, 0; ContactPoint t { location = 0, 0, 0; } } } }");
  work.file("study.hook",
            "Study s { scene = \"scene.hook\"; duration = 0.1 s; match = hookpoint; "
            "Subject a { contact = hunt_crossley; } Measure creep_speed; }");
  const auto result = work.hookpoint("study study.hook --out out");
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(result.err.find("without gravity nothing bears on the ground"), std::string::npos)
      << result.err;
}

}  // namespace
}  // namespace hookpoint
