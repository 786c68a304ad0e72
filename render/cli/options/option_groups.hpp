// Parts of the command line that options.cpp puts together.
#pragma once

#include <CLI/App.hpp>

#include <string>
#include <vector>

#include "render/cli/options/options.hpp"

namespace grainreel {

// A list of things with a name and what they are about: the names, and all of it in a line.
struct Choices {
    std::vector<std::string> names;
    std::string about;

    template <class All>
    explicit Choices(const All& all) {
        for (const auto& one : all) add(one.name, one.about);
    }
    void add(const std::string& name, const std::string& what) {
        names.push_back(name);
        about += (about.empty() ? "" : "; ") + name + " (" + what + ")";
    }
};

// --progress, --quiet and --verbose.
void add_reporting(CLI::App& verb, Options& options);

// The verb `bench`.
void add_bench(CLI::App& app, Options& options);

}  // namespace grainreel
