// A shared library that is no plugin.
#include "tests/plugins/leaves_a_mark.h"
