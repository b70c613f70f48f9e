// What a page may ask (docs/view_protocol.md), parsed and checked. Pure data: who carries it out is
// a session (live_session, movie_session, film_session).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace hookpoint::view {

/// All of these ports, or none.
struct SetPorts {
  std::vector<std::pair<std::string, double>> values;
};
struct ReadPorts {
  std::vector<std::string> trails;
};
struct ListPorts {
  std::string pattern;
};
/// The client's whole wish.
struct WatchPorts {
  std::vector<std::string> trails;
};
struct AskTrace {
  std::vector<std::string> trails;
  double from = 0., to = 0.;  ///< [s]
  std::size_t points = 0;     ///< at most so many instants
};
struct Pause {};
struct Run {};
struct StepOn {
  std::int64_t count = 1;
};
struct SetSpeed {
  double factor = 1.;  ///< simulated over elapsed time; 0: as fast as possible
};
struct Seek {
  double time = 0.;  ///< [s]
};
struct Reset {};
/// Numbers of the initial state, one or those of a vector each, by their ports.
struct StartFrom {
  std::vector<std::pair<std::string, std::vector<double>>> values;
};
/// A field of the file, its value as `--set` takes it.
struct EditField {
  std::string trail, value;
};
struct ListFields {};
struct ListChanges {};
struct AskPatch {};
/// Where along sliders the step is unstable.
struct AskUnstable {};
struct KeepPicture {
  std::string name;  ///< of the file, without a folder
  std::string png;   ///< its bytes
};
struct Quit {};
/// Of a film: the moment of picture `index`.
struct AskFrame {
  std::size_t index = 0;
};
/// A piece of file `file`, of a picture or of the video.
struct FilmPart {
  std::size_t file = 0;
  std::uint64_t at = 0;  ///< where in the file
  std::string bytes;
};
/// The file has all its bytes.
struct FilmEnd {
  std::size_t file = 0;
};
struct FilmFailed {
  std::string text;
};

using Command =
    std::variant<SetPorts, ReadPorts, ListPorts, WatchPorts, AskTrace, Pause, Run, StepOn, SetSpeed,
                 Seek, Reset, StartFrom, EditField, ListFields, ListChanges, AskPatch, AskUnstable,
                 KeepPicture, Quit, AskFrame, FilmPart, FilmEnd, FilmFailed>;

struct Request {
  /// As the page wrote it; none where the message was not read that far. The page's own number.
  std::optional<std::int64_t> id;
  std::optional<Command> command;
  std::string problem;  ///< for the page, where there is no command
};

/// What a text message asks. Never throws: what is wrong with it is the request's problem.
/// O(bytes).
Request parse_request(std::string_view message);

}  // namespace hookpoint::view
