// The generator against its published answers; its normal numbers against the normal distribution;
// streams against each other.
#include "control/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <vector>

namespace hookpoint::control {
namespace {

constexpr int numbers = 200000;

std::vector<double> draw(const RandomStream& stream) {
  std::vector<double> values;
  for (int n = 0; n < numbers; ++n) values.push_back(stream.gaussian(n));
  return values;
}

/// Mean of a(n) b(n + shift).
double correlation(const std::vector<double>& a, const std::vector<double>& b, int shift) {
  double sum = 0.;
  for (int n = 0; n + shift < numbers; ++n) sum += a[n] * b[n + shift];
  return sum / (numbers - shift);
}

/// The known answers of Random123, the reference implementation by the authors of the paper
/// (kat_vectors, philox4x32 10).
TEST(Philox, GivesThePublishedAnswers) {
  using Block = std::array<std::uint32_t, 4>;
  EXPECT_EQ(philox({0, 0, 0, 0}, {0, 0}), (Block{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  const std::uint32_t ones = 0xffffffff;
  EXPECT_EQ(philox({ones, ones, ones, ones}, {ones, ones}),
            (Block{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (Block{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(RandomStream, UniformFillsItsInterval) {
  const RandomStream stream(stream_key(1, "a"));
  std::vector<int> bins(20);
  for (int n = 0; n < numbers; ++n) {
    const double u = stream.uniform(n);
    ASSERT_GT(u, 0.);
    ASSERT_LE(u, 1.);
    ++bins[std::min(19, static_cast<int>(20. * u))];
  }
  double chi_squared = 0.;
  for (const int count : bins)
    chi_squared += (count - numbers / 20.) * (count - numbers / 20.) / (numbers / 20.);
  EXPECT_LT(chi_squared, 43.8);  // 99.9 % of 19 degrees of freedom
  EXPECT_GT(chi_squared, 5.4);   // 0.1 %
}

TEST(RandomStream, GaussianHasTheMomentsAndTailsOfTheNormalDistribution) {
  const std::vector<double> x = draw(RandomStream(stream_key(7, "bot.leg[0].femur.angle")));
  double mean = 0., square = 0., cube = 0., fourth = 0.;
  int beyond[4] = {};
  for (const double value : x) {
    mean += value;
    square += value * value;
    cube += value * value * value;
    fourth += value * value * value * value;
    for (int sigma = 1; sigma < 4; ++sigma) beyond[sigma] += std::abs(value) > sigma ? 1 : 0;
  }
  const double root = std::sqrt(numbers);
  EXPECT_NEAR(mean / numbers, 0., 4. / root);
  EXPECT_NEAR(square / numbers, 1., 4. * std::sqrt(2.) / root);   // variance of x^2: 2
  EXPECT_NEAR(cube / numbers, 0., 4. * std::sqrt(15.) / root);    // of x^3: 15
  EXPECT_NEAR(fourth / numbers, 3., 4. * std::sqrt(96.) / root);  // of x^4: 105 - 9
  for (int sigma = 1; sigma < 4; ++sigma) {
    const double probability = std::erfc(sigma / std::sqrt(2.));
    EXPECT_NEAR(beyond[sigma] / double{numbers}, probability, 4. * std::sqrt(probability) / root)
        << sigma;
  }
}

TEST(RandomStream, NumbersOfAStreamAreNotCorrelated) {
  const std::vector<double> x = draw(RandomStream(stream_key(7, "x")));
  for (const int shift : {1, 2, 3, 10, 100, 1000}) {
    EXPECT_NEAR(correlation(x, x, shift), 0., 4. / std::sqrt(numbers - shift)) << shift;
  }
}

TEST(RandomStream, StreamsOfNeighboursAreIndependent) {
  const std::uint64_t key = stream_key(1, "leg[0].angle");
  const std::vector<double> x = draw(RandomStream(key));
  const std::vector<RandomStream> others{RandomStream(stream_key(1, "leg[1].angle")),
                                         RandomStream(stream_key(2, "leg[0].angle")),
                                         RandomStream(key + 1), RandomStream(key, 1)};
  for (const RandomStream& other : others) {
    const std::vector<double> y = draw(other);
    for (const int shift : {0, 1, 2}) {
      EXPECT_NEAR(correlation(x, y, shift), 0., 4. / std::sqrt(numbers));
      EXPECT_NEAR(correlation(y, x, shift), 0., 4. / std::sqrt(numbers));
    }
  }
}

TEST(StreamKey, PlacesAndSeedsNeverMeet) {
  std::set<std::uint64_t> keys;
  for (int seed = 0; seed < 100; ++seed) {
    for (int place = 0; place < 1000; ++place)
      keys.insert(stream_key(seed, "wire" + std::to_string(place)));
  }
  EXPECT_EQ(keys.size(), 100000u);
  EXPECT_EQ(stream_key(3, "a.b"), stream_key(3, "a.b"));
}

}  // namespace
}  // namespace hookpoint::control
