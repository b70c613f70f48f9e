// A system whose positions are plain numbers: q0 (+) u = q0 + u.
#pragma once

#include "integrators/system.h"

namespace hookpoint::integrators {

class VectorSpaceSystem : public System {
 public:
  explicit VectorSpaceSystem(std::size_t size) : size_(size) {}
  std::size_t position_size() const override { return size_; }
  std::size_t velocity_size() const override { return size_; }
  void retract(std::span<const double> q0, std::span<const double> u,
               std::span<double> q_out) const override {
    for (std::size_t i = 0; i < size_; ++i) q_out[i] = q0[i] + u[i];
  }
  void tangent_rate(std::span<const double> /*u*/, std::span<const double> v,
                    std::span<double> du) const override {
    for (std::size_t i = 0; i < size_; ++i) du[i] = v[i];
  }

 private:
  std::size_t size_;
};

}  // namespace hookpoint::integrators
