// A component on a test bench: made by its registered name, fed by hand, run tick by tick.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "control/registry.h"

namespace hookpoint::testing {

class ComponentBench {
 public:
  /// Of the registered class `name`, on a schedule of `period` [s]. Throws std::invalid_argument
  /// when there is none.
  explicit ComponentBench(std::string_view name, double period = 1e-3)
      : component_(make(name)), period_(period) {}

  control::Component& component() { return *component_; }

  /// Port "goal", or "in[2]" of an array. Throws std::invalid_argument when there is none.
  double& operator[](std::string_view port) { return component_->values()[index(port)]; }
  /// As a wire would: the value, and that something drives it.
  void drive(std::string_view port, double value) {
    component_->values()[index(port)] = value;
    component_->set_driven(index(port), true);
  }
  void text(std::string_view port, std::string value) {
    for (const control::PortDescription& description : component_->ports()) {
      if (description.kind == control::PortKind::text && description.name == port) {
        component_->texts()[description.first] = std::move(value);
        return;
      }
    }
    throw std::invalid_argument("no text '" + std::string(port) + "'");
  }

  void start() { component_->start(period_); }
  /// `ticks` updates, the first at time 0.
  void tick(std::int64_t ticks = 1) {
    for (std::int64_t i = 0; i < ticks; ++i, ++count_) {
      component_->update({static_cast<double>(count_) * period_, period_, count_});
    }
  }
  /// Moves the clock: the next tick is the `count`-th.
  void set_count(std::int64_t count) { count_ = count; }

 private:
  static std::unique_ptr<control::Component> make(std::string_view name) {
    const control::ComponentClass* type = control::Registry::instance().find(name);
    if (type == nullptr) throw std::invalid_argument("no class '" + std::string(name) + "'");
    return type->make();
  }
  std::size_t index(std::string_view port) const {
    const auto found = control::find_value(*component_, port);
    if (!found) throw std::invalid_argument("no port '" + std::string(port) + "'");
    return *found;
  }

  std::unique_ptr<control::Component> component_;
  double period_;
  std::int64_t count_ = 0;
};

/// A file of the test's own, gone with it.
class TemporaryFile {
 public:
  TemporaryFile(const std::string& name, std::string_view content)
      : path_(std::filesystem::path(::testing::TempDir()) / name) {
    std::ofstream(path_, std::ios::binary) << content;
  }
  ~TemporaryFile() { std::filesystem::remove(path_); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

/// What `start` complains of; "" if of nothing.
inline std::string start_error(ComponentBench& bench) {
  try {
    bench.start();
    return "";
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

}  // namespace hookpoint::testing
