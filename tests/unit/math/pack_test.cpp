// A pack does in every lane what the scalar does.
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "math/matrix3.h"
#include "math/pack_structures.h"
#include "math/rotation.h"
#include "math/sine_cosine.h"

namespace hookpoint {
namespace {

using Pack4 = Pack<double, 4>;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Pack4 pack(double a, double b, double c, double d) { return Pack4(Pack4::Vector{a, b, c, d}); }

/// Bit for bit, so that -0 is not 0; any NaN is NaN.
bool same(double a, double b) {
  return (std::isnan(a) && std::isnan(b)) || (a == b && std::signbit(a) == std::signbit(b));
}

/// That `on_pack` of any two packs of awkward numbers is `on_scalar` of their lanes.
template <class OnPack, class OnScalar>
void expect_lanes(const OnPack& on_pack, const OnScalar& on_scalar) {
  const double numbers[] = {0., -0., 1., -2.5, 1e300, -1e-310, infinity, -infinity, nan, 0.1};
  const std::size_t count = std::size(numbers);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = 0; j < count; ++j) {
      const double a[4] = {numbers[i], numbers[j], numbers[(i + 1) % count], 3.};
      const double b[4] = {numbers[j], numbers[i], numbers[(j + 3) % count], 3.};
      const Pack4 found = on_pack(pack(a[0], a[1], a[2], a[3]), pack(b[0], b[1], b[2], b[3]));
      for (std::size_t lane = 0; lane < 4; ++lane) {
        EXPECT_TRUE(same(found[lane], on_scalar(a[lane], b[lane])))
            << a[lane] << " and " << b[lane] << " give " << found[lane];
      }
    }
  }
}

#define EXPECT_LANES(expression)                    \
  expect_lanes(                                     \
      [](const Pack4& a, const Pack4& b) -> Pack4 { \
        (void)b;                                    \
        return expression;                          \
      },                                            \
      [](double a, double b) -> double {            \
        (void)b;                                    \
        return expression;                          \
      })

TEST(Pack, ArithmeticIsLaneByLane) {
  EXPECT_LANES(a + b);
  EXPECT_LANES(a - b);
  EXPECT_LANES(a * b);
  EXPECT_LANES(a / b);
  EXPECT_LANES(-a);
  EXPECT_LANES(2. * a);
  EXPECT_LANES(1. / a);
  EXPECT_LANES(sqrt(a));
  EXPECT_LANES(abs(a));
  EXPECT_LANES(max(a, b));
  EXPECT_LANES(min(a, b));
}

TEST(Pack, ComparisonsChooseLaneByLane) {
  EXPECT_LANES(select(a < b, a, b));
  EXPECT_LANES(select(a <= b, a, b));
  EXPECT_LANES(select(a > b, a, b));
  EXPECT_LANES(select(a >= b, a, b));
  EXPECT_LANES(select(a == b, a, b));
  EXPECT_LANES(select(a < b && b > 0., a, b));
  EXPECT_LANES(select(a < b || a > 1., a, b));
  EXPECT_LANES(select(!(a < b), a, b));
  EXPECT_LANES(select(select(a > 0., a<b, a> b), a, b));
}

TEST(Pack, AllAsksEveryLane) {
  EXPECT_TRUE(all(pack(1., 2., 3., 4.) > Pack4(0.)));
  for (std::size_t lane = 0; lane < 4; ++lane) {
    Pack4 x(1.);
    x.lanes[lane] = -1.;
    EXPECT_FALSE(all(x > Pack4(0.))) << lane;
  }
}

TEST(Pack, OneNumberFillsEveryLane) {
  for (const double x : {0., -0., 3., infinity, nan}) {
    for (std::size_t lane = 0; lane < 4; ++lane) EXPECT_TRUE(same(Pack4(x)[lane], x));
  }
}

TEST(Pack, SineAndCosineOfALaneDoNotDependOnTheOthers) {
  std::mt19937_64 engine(7);
  std::uniform_real_distribution<double> angles(-20., 20.);
  for (int repetition = 0; repetition < 2000; ++repetition) {
    const double a[4] = {angles(engine), angles(engine), repetition % 2 == 0 ? 3e7 : 0.5, nan};
    const auto [sine, cosine] = polynomial_sine_cosine(pack(a[0], a[1], a[2], a[3]));
    for (std::size_t lane = 0; lane < 3; ++lane) {
      EXPECT_NEAR(sine[lane], std::sin(a[lane]), 2.3e-16) << a[lane];
      EXPECT_NEAR(cosine[lane], std::cos(a[lane]), 2.3e-16) << a[lane];
    }
    EXPECT_TRUE(std::isnan(sine[3]) && std::isnan(cosine[3]));
  }
}

Matrix3d counted(double first) {
  return {first,      first + 1., first + 2., first + 3., first + 4.,
          first + 5., first + 6., first + 7., first + 8.};
}

TEST(PackStructures, GatherPutsEachStructureIntoItsLane) {
  const Matrix3d a = counted(0.), b = counted(10.), c = counted(20.), d = counted(30.);
  const Matrix3<Pack4> packs = gather(std::array{&a, &b, &c, &d});
  EXPECT_EQ(lane_of(packs, 0), a);
  EXPECT_EQ(lane_of(packs, 1), b);
  EXPECT_EQ(lane_of(packs, 2), c);
  EXPECT_EQ(lane_of(packs, 3), d);
  EXPECT_EQ(packs.zy[2], 27.);
}

TEST(PackStructures, ScatterUndoesGatherAndWritesNothingElse) {
  std::array<Matrix3d, 6> from;
  for (std::size_t i = 0; i < 6; ++i) from[i] = counted(100. * double(i));
  const Matrix3<Pack4> packs =
      gather(std::array<const Matrix3d*, 4>{&from[4], &from[1], &from[2], &from[3]});
  std::array<Matrix3d, 6> to{};
  scatter(packs, {&to[4], &to[1], &to[2], &to[3]});
  EXPECT_EQ(to[0], Matrix3d{});
  EXPECT_EQ(to[5], Matrix3d{});
  for (std::size_t i = 1; i < 5; ++i) EXPECT_EQ(to[i], from[i]) << i;
}

TEST(PackStructures, LanesAreSetMaskedAndSummed) {
  Matrix3<Pack4> packs = in_all_lanes<Pack4>(counted(1.));
  set_lane(packs, 2, counted(5.));
  EXPECT_EQ(lane_of(packs, 1), counted(1.));
  EXPECT_EQ(lane_of(packs, 2), counted(5.));
  EXPECT_EQ(lane_sum(packs), 3. * counted(1.) + counted(5.));
  const Pack4 lane = pack(0., 1., 2., 3.);
  EXPECT_EQ(lane_sum(only(lane > Pack4(0.5), packs)), 2. * counted(1.) + counted(5.));
  packs.xx = Pack4(nan);
  EXPECT_EQ(lane_sum(only(lane < Pack4(0.), packs)), Matrix3d{});
}

// Orientations are published by lanes, and a ball's hook is carried along by those of scalars.
TEST(PackStructures, QuaternionOfALaneIsTheScalarsToTheBit) {
  std::mt19937_64 engine(11);
  std::normal_distribution<double> number;
  const auto turn = [&] {
    return normalized(Quaterniond{number(engine), number(engine), number(engine), number(engine)});
  };
  for (int repetition = 0; repetition < 20000; ++repetition) {
    const std::array turns{turn(), turn(), turn(), turn()};
    const Quaterniond last = turn();
    Matrix3<Pack4> packs;
    for (std::size_t lane = 0; lane < 4; ++lane)
      set_lane(packs, lane, rotation_matrix(turns[lane]));
    const Quaternion<Pack4> found = continued(quaternion_from(packs), in_all_lanes<Pack4>(last));
    for (std::size_t lane = 0; lane < 4; ++lane) {
      const Quaterniond q = lane_of(found, lane);
      ASSERT_EQ(q, continued(quaternion_from(rotation_matrix(turns[lane])), last));
      const Quaterniond expected = continued(turns[lane], q);
      EXPECT_NEAR(q.w, expected.w, 1e-15);
      EXPECT_NEAR(q.x, expected.x, 1e-15);
      EXPECT_NEAR(q.y, expected.y, 1e-15);
      EXPECT_NEAR(q.z, expected.z, 1e-15);
      EXPECT_GE(q.w * last.w + q.x * last.x + q.y * last.y + q.z * last.z, -1e-15);
    }
  }
}

}  // namespace
}  // namespace hookpoint
