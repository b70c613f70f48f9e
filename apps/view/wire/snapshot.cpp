#include "apps/view/wire/snapshot.h"

#include <bit>
#include <cstring>

namespace hookpoint::view {
namespace {

static_assert(std::endian::native == std::endian::little, "messages are little-endian");

enum class Kind { snapshot = 1, trace = 2 };

/// A message that grows by doubles.
class Message {
 public:
  explicit Message(Kind kind, std::size_t numbers) {
    bytes_.reserve((numbers + 1) * sizeof(double));
    add(static_cast<double>(kind));
  }
  void add(double number) {
    char bytes[sizeof number];
    std::memcpy(bytes, &number, sizeof number);
    bytes_.append(bytes, sizeof number);
  }
  void add(std::int64_t number) { add(static_cast<double>(number)); }
  void add(std::size_t number) { add(static_cast<double>(number)); }
  void add(const Vector3d& v) {
    for (const double part : {v.x, v.y, v.z}) add(part);
  }
  void add(const Quaterniond& q) {
    for (const double part : {q.w, q.x, q.y, q.z}) add(part);
  }
  void add(std::span<const double> numbers) {
    const auto* bytes = reinterpret_cast<const char*>(numbers.data());
    bytes_.append(bytes, numbers.size_bytes());
  }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

double flags_of(const SessionState& state) {
  return (state.paused ? 1. : 0.) + (state.past ? 2. : 0.) + (state.ended ? 4. : 0.) +
         (state.failed ? 8. : 0.);
}

void add_subject(Message& message, const SubjectState& subject) {
  message.add(subject.fine ? 1. : 0.);
  for (const simulation::Pose& pose : subject.poses) {
    message.add(pose.position);
    message.add(pose.orientation);
  }
  message.add(subject.contacts.size());
  for (const simulation::ContactView& contact : subject.contacts) {
    message.add(contact.body);
    message.add(contact.point);
    message.add(contact.force);
    message.add(contact.hook);
    message.add(contact.depth);
    message.add(contact.sliding);
  }
}

}  // namespace

std::shared_ptr<const std::string> encode_snapshot(const SessionState& state,
                                                   std::span<const double> values,
                                                   std::span<const SubjectState> subjects) {
  constexpr std::size_t head = 12, pose = 7, contact = 12;
  std::size_t numbers = head + values.size();
  for (const SubjectState& subject : subjects)
    numbers += 2 + pose * subject.poses.size() + contact * subject.contacts.size();
  Message message(Kind::snapshot, numbers);
  message.add(state.layout);
  message.add(state.number);
  message.add(state.step);
  message.add(state.time);
  message.add(flags_of(state));
  message.add(state.speed_asked);
  message.add(state.speed_reached);
  message.add(state.history_first);
  message.add(state.history_last);
  message.add(values.size());
  message.add(values);
  message.add(subjects.size());
  for (const SubjectState& subject : subjects) add_subject(message, subject);
  return std::make_shared<const std::string>(message.take());
}

std::string encode_trace(std::int64_t request, std::span<const double> times,
                         std::span<const std::vector<double>> values) {
  Message message(Kind::trace, 3 + times.size() * (values.size() + 1));
  message.add(request);
  message.add(values.size());
  message.add(times.size());
  message.add(times);
  for (const std::vector<double>& row : values) message.add(std::span<const double>(row));
  return message.take();
}

}  // namespace hookpoint::view
