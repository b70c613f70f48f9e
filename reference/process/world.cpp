#include "reference/process/world.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "reference/external_forces.h"
#include "reference/process/experiment_json.h"
#include "reference/robot_tree.h"
#include "reference/touching_points.h"
#include "simulation/engine_interface/engine_lost.h"

namespace hookpoint::reference {
namespace {

using simulation::BodyState;
using simulation::JointState;

/// A contact in the last step.
struct Contact {
  std::size_t body = 0;
  std::optional<std::size_t> point;  ///< index into touching_points(); none: of a shape
  Vector3d position, force;
};

/// Reads the numbers of a `states` message in order.
class Reader {
 public:
  explicit Reader(std::span<const double> numbers) : left_(numbers) {}

  std::size_t left() const { return left_.size(); }
  double number() {
    if (left_.empty()) throw ProgramError("the program's answer to a step ends too early");
    const double value = left_.front();
    left_ = left_.subspan(1);
    return value;
  }
  Vector3d vector() {
    const double x = number(), y = number(), z = number();
    return {x, y, z};
  }
  Quaterniond orientation() {
    const double w = number(), x = number(), y = number(), z = number();
    return {w, x, y, z};
  }
  /// A whole number from `least` on, below `end`.
  std::ptrdiff_t index(std::ptrdiff_t least, std::size_t end, const char* what) {
    const double value = number();
    if (!(value >= static_cast<double>(least) && value < static_cast<double>(end)) ||
        value != std::floor(value))
      throw ProgramError(fmt::format("the program's answer to a step has {} as {}", value, what));
    return static_cast<std::ptrdiff_t>(value);
  }

 private:
  std::span<const double> left_;
};

class ProgramWorld final : public PeerWorld {
 public:
  ProgramWorld(const simulation::Experiment& experiment, std::shared_ptr<ProgramPool> pool)
      : pool_(std::move(pool)), program_(pool_->take()) {
    const RobotTree tree = robot_tree(experiment);
    forced_ = forced_bodies(experiment, tree);
    const auto points = touching_points(experiment, tree);
    joints_.resize(tree.joints);
    for (const TreeBody& body : tree.bodies) {
      const auto number = static_cast<std::size_t>(&body - tree.bodies.data());
      Body& own = bodies_.emplace_back();
      own.mobile = body.mobile;
      own.state = body.initial;
      if (body.mobile) own.shapes = touching_shapes(experiment, *body.body).size();
      const auto is_own = [&](const TouchingPoint& point) { return point.body == number; };
      const auto first = std::ranges::find_if(points, is_own);
      own.first_point = static_cast<std::size_t>(first - points.begin());
      own.colliders = own.shapes + static_cast<std::size_t>(std::ranges::count_if(points, is_own));
      if (body.link != nullptr)
        joints_[static_cast<std::size_t>(body.joint)] = {body.link->angle, body.link->rate};
    }
    const text::JsonValue answer = program_->request(experiment_json(experiment));
    const text::JsonValue* type = answer.member("type");
    const text::JsonValue* reason = answer.member("reason");
    collect_notices();
    if (type != nullptr && type->text() == "ready") return;
    const bool refused = type != nullptr && type->text() == "refused" && reason != nullptr;
    if (refused) pool_->give_back(std::move(program_));
    throw simulation::ExperimentError(
        fmt::format("engine {}: {}", pool_->definition().name,
                    refused ? one_line(reason->text())
                            : "the program answers an experiment neither with ready nor with "
                              "refused and a reason"));
  }
  ~ProgramWorld() override {
    if (program_) pool_->give_back(std::move(program_));
  }

  void announce(std::int64_t steps) override { announced_ = steps; }

  std::string advance(const simulation::WorldInputs& inputs) override {
    try {
      if (ahead_ == 0) {
        ahead_ = std::clamp<std::int64_t>(announced_, 1, most_steps);
        take(inputs);
        auto answer = program_->step(numbers_);
        if (const auto* failed = std::get_if<std::string>(&answer)) {
          ahead_ = 0;
          return "the program ends the run: " + *failed;
        }
        answer_ = std::get<std::vector<double>>(std::move(answer));
        read_ = 0;
      }
      read_answer();
      --ahead_;
      if (announced_ > 0) --announced_;
      collect_notices();
      return {};
    } catch (const ProgramError& error) {
      program_.reset();
      return error.what();
    }
  }
  bool lost() const override { return program_ == nullptr; }

  std::string notice() override {
    if (notices_.empty()) return {};
    std::string first = std::move(notices_.front());
    notices_.erase(notices_.begin());
    return "engine " + pool_->definition().name + ": " + first;
  }

  void read(std::span<BodyState> bodies, std::span<JointState> joints) const override {
    for (std::size_t i = 0; i < bodies_.size(); ++i)
      if (bodies_[i].mobile) bodies[i] = bodies_[i].state;
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      joints[i].angle = joints_[i].angle;
      joints[i].rate = joints_[i].rate;
    }
  }

  void read_points(std::span<Vector3d> forces) const override {
    std::ranges::fill(forces, Vector3d{});
    for (const Contact& contact : contacts_)
      if (contact.point) forces[*contact.point] += contact.force;
  }

  void read_shapes(std::vector<ShapeForce>& forces) const override {
    for (const Contact& contact : contacts_)
      if (!contact.point) forces.push_back({contact.body, contact.position, contact.force});
  }

 private:
  struct Body {
    bool mobile = false;
    BodyState state;
    std::size_t shapes = 0, colliders = 0;  ///< shapes come first, then touching points
    std::size_t first_point = 0;            ///< of touching_points()
  };

  void take(const simulation::WorldInputs& inputs) {
    numbers_.assign(1, static_cast<double>(ahead_));
    numbers_.insert(numbers_.end(), inputs.joint_torques.begin(), inputs.joint_torques.end());
    for_each_force(forced_, inputs, [&](std::size_t body, const simulation::ForceInput& input) {
      const Vector3d &p = input.point, &f = input.force, &t = input.torque;
      numbers_.insert(numbers_.end(),
                      {static_cast<double>(body), p.x, p.y, p.z, f.x, f.y, f.z, t.x, t.y, t.z});
    });
  }

  /// The states of one step, the next of the answer.
  void read_answer() {
    Reader reader(std::span<const double>(answer_).subspan(read_));
    for (Body& body : bodies_) {
      body.state.position = reader.vector();
      body.state.orientation = reader.orientation();
      body.state.velocity = reader.vector();
      body.state.angular_velocity = reader.vector();
      body.state.contact_force = {};
      body.state.contacts = 0;
      constexpr double rounding = 1e-3;  // of single precision, and of integration
      const Quaterniond& q = body.state.orientation;
      if (const double square = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
          std::isfinite(square) && std::abs(square - 1.) > rounding)
        throw ProgramError(fmt::format(
            "the program's answer to a step has an orientation of length {:g}", std::sqrt(square)));
    }
    for (JointState& joint : joints_) {
      joint.angle = reader.number();
      joint.rate = reader.number();
    }
    const auto count =
        static_cast<std::size_t>(reader.index(0, answer_.size(), "the number of contacts"));
    contacts_.resize(count);
    for (Contact& contact : contacts_) {
      contact.body =
          static_cast<std::size_t>(reader.index(0, bodies_.size(), "the body of a contact"));
      Body& body = bodies_[contact.body];
      const std::ptrdiff_t collider = reader.index(-1, body.colliders, "the collider of a contact");
      contact.point.reset();
      if (collider >= static_cast<std::ptrdiff_t>(body.shapes))
        contact.point = body.first_point + static_cast<std::size_t>(collider) - body.shapes;
      contact.position = reader.vector();
      contact.force = reader.vector();
      reader.number();  // the depth, by the program's own measure
      body.state.contact_force += contact.force;
      if (norm(contact.force) > 0.) ++body.state.contacts;
    }
    read_ = answer_.size() - reader.left();
    if (ahead_ == 1 && reader.left() > 0)
      throw ProgramError("the program's answer to a step has numbers that belong to nothing");
  }

  void collect_notices() {
    constexpr std::size_t most = 100;
    for (const std::string& line : program_->take_error_lines())
      if (!line.empty() && notices_.size() < most) notices_.push_back(one_line(line));
  }

  std::shared_ptr<ProgramPool> pool_;
  std::unique_ptr<Program> program_;  ///< null once it has failed
  std::vector<std::size_t> forced_;   ///< the body of each force
  std::vector<Body> bodies_;
  std::vector<JointState> joints_;
  std::vector<Contact> contacts_;
  std::vector<double> numbers_;
  /// Most steps in one exchange: a run that ends early has let the program take some in vain.
  static constexpr std::int64_t most_steps = 100;
  std::int64_t announced_ = 0;        ///< steps under the same inputs
  std::int64_t ahead_ = 0;            ///< steps that the answer still has
  std::vector<double> answer_;        ///< of the latest exchange
  std::size_t read_ = 0;              ///< numbers of it
  std::vector<std::string> notices_;  ///< not reported yet
};

}  // namespace

std::unique_ptr<PeerWorld> make_program_world(const simulation::Experiment& experiment,
                                              std::shared_ptr<ProgramPool> pool) {
  const std::string name = pool->definition().name;
  try {
    return std::make_unique<ProgramWorld>(experiment, std::move(pool));
  } catch (const ProgramError& error) {
    throw simulation::EngineLost(fmt::format("engine {}: {}", name, error.what()));
  }
}

}  // namespace hookpoint::reference
