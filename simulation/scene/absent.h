// What an experiment cannot say, and what to do instead.
#pragma once

namespace hookpoint::simulation {

/// To the language's table (language/schema/absent.h).
void add_absent_words();

}  // namespace hookpoint::simulation
