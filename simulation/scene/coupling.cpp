// Coupled joints: one follows another, q_follower = ratio q_leader + offset.
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "contact/force_law.h"
#include "language/tree/fields.h"
#include "simulation/experiment/start_problems.h"
#include "simulation/scene/fixed_part.h"
#include "simulation/scene/load_parts.h"
#include "simulation/scene/schema.h"

namespace hookpoint::simulation {

using language::Fields;
using language::number_field;
using language::object_field;
using language::or_unit;

namespace {

namespace coupling_field {
constexpr const char *mimic = "mimic", *ratio = "mimic_ratio", *offset = "mimic_offset",
                     *angle = "angle", *rate = "rate";
}

const Fields<CouplingSpec>& fields() {
  static const Fields<CouplingSpec> fields{
      object_field(coupling_field::mimic, "Link",
                   "the link whose joint this one follows exactly, as through gears: angle = "
                   "mimic_ratio times that angle + mimic_offset"),
      number_field(coupling_field::ratio, "", &CouplingSpec::ratio,
                   "with mimic: this joint's rate by the other's, in SI units of either"),
      or_unit("m", "joint", "prismatic",
              number_field(coupling_field::offset, "rad", &CouplingSpec::offset,
                           "with mimic: angle where that of the other joint is 0")),
  };
  return fields;
}

/// The joints of a file that follow others.
class Followers {
 public:
  explicit Followers(Loading& loading) : loading_(loading) {}

  void load(const language::Object& world) {
    const std::size_t errors_before = loading_.diagnostics.error_count();
    for (const language::Object* link : collect_all(world, "Link")) read(*link);
    if (followers_.empty() || loading_.diagnostics.error_count() != errors_before) return;
    if (contact::find_impulse_law(loading_.experiment.contact) != nullptr)
      return error(*followers_.front().link, coupling_field::mimic,
                   "under an impulse law joints are not coupled; choose a force law");
    for (const Follower& follower : followers_) couple(follower);
  }

 private:
  struct Follower {
    const language::Object* link = nullptr;
    CouplingSpec spec;
  };

  void error(const language::Object& link, const char* field, std::string message) {
    loading_.error(place_of(link, field), std::move(message));
  }

  void read(const language::Object& link) {
    const auto at = loading_.bodies.find(&link);
    if (at == loading_.bodies.end()) return;
    if (!link.given(coupling_field::mimic)) {
      for (const char* field : {coupling_field::ratio, coupling_field::offset})
        if (link.given(field))
          error(link, field,
                fmt::format("{} goes with mimic; give it too, or leave this out", field));
      return;
    }
    if (is_fixed(link)) return;
    const language::Object* leader = link.object(coupling_field::mimic);
    if (is_fixed(*leader))
      return error(link, coupling_field::mimic, "a fixed joint leads none: name one that moves");
    const auto of_leader = loading_.bodies.find(leader);
    if (leader == &link) return error(link, coupling_field::mimic, "a joint cannot follow itself");
    if (of_leader == loading_.bodies.end() || of_leader->second.robot != at->second.robot)
      return error(link, coupling_field::mimic, "a joint follows one of the same robot");
    for (const char* field : {coupling_field::angle, coupling_field::rate})
      if (link.given(field))
        error(link, field,
              fmt::format("this joint follows another (mimic), which sets its {}; leave it out",
                          field));
    CouplingSpec spec = load_fields(link, fields());
    spec.robot = at->second.robot;
    spec.follower = static_cast<std::size_t>(at->second.body) - 1;
    spec.leader = static_cast<std::size_t>(of_leader->second.body) - 1;
    followers_.push_back({&link, spec});
  }

  const Follower* follower_at(int robot, std::size_t joint) const {
    const auto found = std::ranges::find_if(followers_, [&](const Follower& each) {
      return each.spec.robot == robot && each.spec.follower == joint;
    });
    return found == followers_.end() ? nullptr : &*found;
  }

  /// Through a train of gears to the joint that leads it.
  void couple(const Follower& follower) {
    CouplingSpec spec = follower.spec;
    std::size_t gears = 0;
    while (const Follower* next = follower_at(spec.robot, spec.leader)) {
      if (++gears > followers_.size())
        return error(*follower.link, coupling_field::mimic,
                     "joints follow each other in a ring; let one of them lead");
      spec.offset += spec.ratio * next->spec.offset;
      spec.ratio *= next->spec.ratio;
      spec.leader = next->spec.leader;
    }
    std::vector<LinkSpec*> joints;
    for (ChainSpec& chain : loading_.experiment.robots[static_cast<std::size_t>(spec.robot)].chains)
      for (LinkSpec& link : chain.links) joints.push_back(&link);
    LinkSpec& own = *joints[spec.follower];
    own.angle = spec.ratio * joints[spec.leader]->angle + spec.offset;
    own.rate = spec.ratio * joints[spec.leader]->rate;
    if (const std::string problem = angle_problem(own); !problem.empty())
      error(*follower.link, coupling_field::mimic, problem);
    loading_.experiment.couplings.push_back(spec);
  }

  Loading& loading_;
  std::vector<Follower> followers_;  ///< in the order of the file
};

}  // namespace

std::vector<language::FieldSchema> coupling_fields() { return schemas(fields()); }

void load_couplings(const language::Object& world, Loading& loading) {
  Followers(loading).load(world);
}

}  // namespace hookpoint::simulation
