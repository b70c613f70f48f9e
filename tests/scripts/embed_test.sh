#!/usr/bin/env bash
# cmake/hookpoint_embed.cmake in a project of its own: every byte is there, an empty file is one, and a file that changed is embedded anew.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/support.sh"
project="$work/project"
mkdir -p "$project/page"

printf '"quoted" \\ back ??/ %%s ${NAME} @constants@; [[]] ä\r\n' >"$project/page/text.css"
for byte in $(seq 0 255); do printf "\\x$(printf %02x "$byte")"; done >"$project/page/every byte.bin"
: >"$project/page/empty.js"
cat >"$project/main.cpp" <<'CPP'
#include <iostream>

#include "pages/window_files.h"

int main(int, char** arguments) {
  using namespace hookpoint::window_files;
  const std::string_view wanted = arguments[1];
  std::cout << (wanted == "text" ? text_css : wanted == "bytes" ? every_byte_bin : empty_js);
}
CPP
cat >"$project/CMakeLists.txt" <<CMAKE
cmake_minimum_required(VERSION 3.25)
project(embedding LANGUAGES CXX)
set(CMAKE_CXX_STANDARD 20)
include($root/cmake/hookpoint_embed.cmake)
add_executable(shows main.cpp)
hookpoint_embed(shows pages/window_files page/text.css "page/every byte.bin" page/empty.js)
CMAKE

build() { cmake --build "$work/build" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }; }
# expect_file WHAT FILE: the program shows it to the byte.
expect_file() { expect "$1: bytes" "$("$work/build/shows" "$1" | od -An -tx1)" "$(od -An -tx1 "$project/page/$2")"; }

cmake -G Ninja -S "$project" -B "$work/build" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
build
expect_file text text.css
expect_file bytes "every byte.bin"
expect_file empty empty.js

sleep 1  # the file's time must be a later one, for make as well
echo "changed" >"$project/page/text.css"
build
expect_file text text.css
expect_file bytes "every byte.bin"
finish
