// The base of everything that computes signals: controllers, sensors, actuators, signal sources. A
// class declares its ports as members; from that one declaration come the language's schema,
// checking, `describe` and the annotations of data files.
//
//   class Proportional final : public Component {
//    public:
//     Input current{*this, "current", "?", "measured value"};
//     Parameter gain{*this, "gain", "?", 1., "output per unit of error"};
//     Output output{*this, "output", "?", "command"};
//     void update(const Tick&) override { output = gain * -current; }
//   };
//   HOOKPOINT_REGISTER_COMPONENT(Proportional, "Controller.Proportional", "an example")
//
// It sees plain values on its own schedule: rates, delays and noise belong to the wires and the
// stub, not to it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "control/linear_feedback.h"

namespace hookpoint::control {

/// When an update happens.
struct Tick {
  double time = 0.;    ///< of the simulation [s]
  double period = 0.;  ///< since the last update; on the first one the period of the schedule [s]
  std::int64_t count = 0;  ///< updates before this one
};

/// A state is a value that a component carries from one update to the next: seen by its trail,
/// written by nothing else, and saved with the rest of the values, so that a run resumes where it
/// was. What is not declared is lost on resuming.
enum class PortKind { input, output, parameter, text, state };

/// What a component may take from the World that it is in.
enum class WorldValue {
  none,
  gravity_down,     ///< the part of `World.gravity` along -z [m/s^2]
  gravity_sideways  ///< its x and y, of a parameter of two numbers [m/s^2]
};

struct PortDescription {
  PortKind kind = PortKind::input;
  std::string name = {};
  std::string unit = {};      ///< SI, as the language writes it; "" dimensionless, "?" any
  std::string doc = {};       ///< one line
  double default_value = 0.;  ///< of a parameter, of a state before the first update, and of an
                              ///< input that nothing drives
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();
  std::size_t count = 1;  ///< more than one: an array, ports name[0] ... name[count - 1]
  std::size_t first =
      0;  ///< index of its first value in the component's values; of a text among its texts
  std::string attached =
      {};  ///< port of the object that the component is attached to ("angle", "contact.force.x")
           ///< which it reads (input) or drives (output) unless a wire says otherwise; "" for none.
           ///< With count 3 it names a vector ("velocity": elements 0, 1, 2 are its .x .y .z), with
           ///< count 4 an orientation (elements 0 ... 3 are its .w .x .y .z)
  std::string default_text = {};  ///< of a text
  std::vector<std::string> choices =
      {};                               ///< of a text: the only values that it may have; empty: any
  bool path = false;                    ///< of a text: names a file
  WorldValue world = WorldValue::none;  ///< where the file gives nothing, in place of the default
  std::string counted_by =
      {};  ///< of an array: the parameter that says how many of its elements are in use ("legs"),
           ///< so that a file gives as many; "": all of them
  bool open =
      false;  ///< of an input, the last port that has values: an experiment gives it as many
              ///< elements as it needs (`Component::set_open_count`)
  bool mean = false;  ///< of an input: a sample of its wires is the mean over the steps since the
                      ///< last one, not the value of the step in which it is taken
  bool orientation = false;  ///< of a parameter of 4 numbers: a quaternion w, x, y, z, which a file
                             ///< may also give as roll, pitch, yaw
};

class Component;

/// What the members below have in common: a name in the description and an index into the values.
/// Throws std::logic_error for a name that is empty or taken and for a count of 0: the class, not
/// the user, is wrong (see `declaration_problem`).
class PortHandle {
 public:
  PortHandle(const PortHandle&) = default;
  PortHandle& operator=(const PortHandle&) = delete;  // would read another port from then on
  /// Of element `i` among the component's values.
  std::size_t index(std::size_t i = 0) const { return first_ + i; }

 protected:
  PortHandle(Component& owner, PortDescription description);
  ~PortHandle() = default;
  PortDescription& description();
  double& value_at(std::size_t i) const;
  Component* owner_;
  std::size_t port_;   ///< index into the component's ports
  std::size_t first_;  ///< index into its values
};

/// An input, or `count` of them under one name. Parameters are inputs too: a wire may drive them.
class Input : public PortHandle {
 public:
  Input(Component& owner, std::string name, std::string unit, std::string doc,
        double default_value = 0., std::size_t count = 1);
  operator double() const {
    return (*this)[0];
  }  // NOLINT(google-explicit-constructor): reads as the value that it is
  double operator[](std::size_t i) const { return value_at(i); }
  std::size_t count() const;
  /// A wire or an attachment drives it.
  bool driven(std::size_t i = 0) const;
  /// Reads `port` of the object that the component is attached to; returns itself, for the member's
  /// initialiser.
  Input&& attached(std::string port) &&;
  /// Only as many elements are in use as the parameter `name` says ("": all).
  Input&& counted_by(std::string name) &&;
  /// A sample of its wires is the mean over the steps since the last one: of a force that comes in
  /// impulses.
  Input&& mean() &&;
  /// It has as many elements as the experiment needs; no port with values is declared after it.
  Input&& open() &&;
};

class Parameter : public PortHandle {
 public:
  Parameter(Component& owner, std::string name, std::string unit, double default_value,
            std::string doc, std::size_t count = 1);
  operator double() const { return (*this)[0]; }  // NOLINT(google-explicit-constructor)
  double operator[](std::size_t i) const { return value_at(i); }
  Parameter&& range(double minimum, double maximum) &&;
  /// Where the file gives nothing it is what the World says; the default holds outside of one.
  Parameter&& of_world(WorldValue value) &&;
  /// Its 4 values are a quaternion w, x, y, z, by default no turn; a file may also give roll, pitch,
  /// yaw.
  Parameter&& orientation() &&;
  /// Only as many elements are in use as the parameter `name` says ("": all).
  Parameter&& counted_by(std::string name) &&;
};

class Output : public PortHandle {
 public:
  Output(Component& owner, std::string name, std::string unit, std::string doc,
         std::size_t count = 1);
  Output(const Output&) = default;
  Output& operator=(const Output& other) { return *this = other.get(0); }
  Output& operator=(double value) {
    set(0, value);
    return *this;
  }
  operator double() const { return get(0); }  // NOLINT(google-explicit-constructor)
  double operator[](std::size_t i) const { return value_at(i); }
  double& operator[](std::size_t i) { return value_at(i); }
  double get(std::size_t i) const { return value_at(i); }
  void set(std::size_t i, double value) { value_at(i) = value; }
  /// Drives `port` of the object that the component is attached to.
  Output&& attached(std::string port) &&;
};

/// A value stored from one update to the next (`PortKind::state`), or an array of them; 0 before
/// the first update unless `initial` says otherwise.
class State : public PortHandle {
 public:
  State(Component& owner, std::string name, std::string unit, std::string doc,
        std::size_t count = 1);
  State(const State&) = default;
  State& operator=(const State& other) { return *this = other.get(0); }
  State& operator=(double value) {
    set(0, value);
    return *this;
  }
  operator double() const { return get(0); }  // NOLINT(google-explicit-constructor)
  double operator[](std::size_t i) const { return value_at(i); }
  double& operator[](std::size_t i) { return value_at(i); }
  double get(std::size_t i) const { return value_at(i); }
  void set(std::size_t i, double value) { value_at(i) = value; }
  /// The value of each element before the first update.
  State&& initial(double value) &&;
};

/// A string of the file: a name, a path (given to the component as an absolute path).
class Text : public PortHandle {
 public:
  Text(Component& owner, std::string name, std::string doc, std::string default_text = "");
  const std::string& value() const;
  /// The only values that it may have; the default is one of them.
  Text&& choices(std::vector<std::string> choices) &&;
  /// It names a file.
  Text&& path() &&;
};

class Component {
 public:
  virtual ~Component() = default;
  Component(const Component&) = delete;
  Component& operator=(const Component&) = delete;

  /// Once, when all parameters have their first values, before any update. `period` [s] of the
  /// schedule. May read files and allocate. Throws std::runtime_error with what the user should
  /// change.
  virtual void start(double period) { static_cast<void>(period); }
  /// New outputs from the inputs. Allocates nothing.
  virtual void update(const Tick& tick) = 0;
  /// How outputs follow inputs about a rest, from the parameters and `driven()` as they are, before
  /// or after `start`; limits that are not reached there do not count. A loop through what is not
  /// said is left out of the largest stable step, and the user gets a note.
  virtual std::vector<LinearFeedback> linearise() const { return {}; }

  const std::vector<PortDescription>& ports() const { return ports_; }
  /// All values in the order of declaration: whoever wires the component reads and writes them by
  /// index.
  std::span<double> values() { return values_; }
  std::span<const double> values() const { return values_; }
  std::span<std::string> texts() { return texts_; }
  void set_driven(std::size_t value, bool driven) { driven_[value] = driven ? 1 : 0; }
  /// Before anything refers to its values: the elements, at least 1, of its open input, if it has
  /// one. Allocates.
  void set_open_count(std::size_t count);
  /// Before `start`: the key of the component's own noise (random.h: stream_key of the experiment's
  /// seed and the component's trail).
  void set_stream(std::uint64_t key) { stream_ = key; }

 protected:
  Component() = default;
  std::uint64_t stream() const { return stream_; }

 private:
  friend class PortHandle;
  friend class Input;
  friend class Parameter;
  friend class Output;
  friend class Text;
  std::vector<PortDescription> ports_;
  std::vector<double> values_;
  std::vector<char> driven_;
  std::vector<std::string> texts_;
  std::uint64_t stream_ = 0;
};

inline double& PortHandle::value_at(std::size_t i) const { return owner_->values_[first_ + i]; }

/// Index into `component.values()` of "goal", or of "goal[2]" for an array; none if there is no
/// such value.
std::optional<std::size_t> find_value(const Component& component, std::string_view name);

}  // namespace hookpoint::control
