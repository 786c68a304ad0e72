// Parts of the command line that options.cpp puts together.
#pragma once

#include <CLI/App.hpp>

#include "render/cli/options.hpp"

namespace grainreel {

// --progress, --quiet and --verbose.
void add_reporting(CLI::App& verb, Options& options);

// The verb `bench`.
void add_bench(CLI::App& app, Options& options);

}  // namespace grainreel
