// What the writer and the reader of movies agree on.
#pragma once

namespace hookpoint::output {

/// Attribute of the root that makes a file a movie; its value is the version of the layout.
inline constexpr const char* movie_mark = "hookpoint_movie";
inline constexpr double movie_version = 1.;

}  // namespace hookpoint::output
