// Files of another program that the test writes: 40 grains of two types that rise by 1 mm a frame, a paddle
// that turns about z, and contacts.
#pragma once

#include <sys/stat.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/cli/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel::test {

inline constexpr int kForeignGrains = 40, kForeignFrames = 4;
inline constexpr double kForeignStep = 1e-5;                        // s
inline constexpr double kPaddleTurn = 20 * std::numbers::pi / 180;  // rad, from frame to frame

// One frame of a dump, with rows from the last id to the first. Odd ids are of type 2 with a radius of 3 mm,
// and the others of type 1 with 4 mm.
inline std::string foreign_frame(int k, bool with_radius = true) {
    std::string text = fmt::format(
        "ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS ff ff ff\n0 0.05\n0 0.04\n0 0.06\n"
        "ITEM: ATOMS id type x y z{} vx vy vz\n",
        1000 * k, kForeignGrains, with_radius ? " radius" : "");
    for (int i = 0; i < kForeignGrains; ++i)
        text += fmt::format("{} {} {:.3f} {:.3f} {:.3f}{} 0 0 0.1\n", kForeignGrains - i, 1 + i % 2,
                            0.005 + 0.01 * (i % 5), 0.005 + 0.01 * (i / 5 % 4),
                            0.005 + 0.01 * (i / 20) + 0.001 * k,
                            !with_radius ? ""
                            : i % 2 == 1 ? " 0.003"
                                         : " 0.004");
    return text;
}

inline std::string foreign_dump(int frames = kForeignFrames, bool with_radius = true) {
    std::string text;
    for (int k = 0; k < frames; ++k) text += foreign_frame(k, with_radius);
    return text;
}

// A tetrahedron without symmetry, turned about z.
inline std::string foreign_paddle(double turn) {
    const double corners[4][3] = {
        {-0.03, -0.002, -0.01}, {0.03, -0.002, -0.01}, {0.03, 0.004, -0.01}, {-0.03, -0.002, 0.01}};
    const int triangles[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
    std::string text = "solid paddle\n";
    for (const auto& triangle : triangles) {
        text += "facet normal 0 0 0\nouter loop\n";
        for (const int at : triangle) {
            const double* p = corners[at];
            text +=
                fmt::format("vertex {:.9g} {:.9g} {:.9g}\n", std::cos(turn) * p[0] - std::sin(turn) * p[1],
                            std::sin(turn) * p[0] + std::cos(turn) * p[1], p[2]);
        }
        text += "endloop\nendfacet\n";
    }
    return text + "endsolid paddle\n";
}

// Each frame has two contacts: 40 and 39 with 0.5 N, 39 and 38 with 0.25 N.
inline std::string foreign_contacts() {
    std::string text;
    for (int k = 0; k < kForeignFrames; ++k)
        text += fmt::format(
            "ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ENTRIES\n2\nITEM: BOX BOUNDS ff ff ff\n0 0.05\n0 0.04\n0 "
            "0.06\nITEM: ENTRIES id1 id2 fn\n40 39 0.5\n39 38 0.25\n",
            1000 * k);
    return text;
}

// A folder with these files, which has a cache of imports of its own.
class ForeignBed : public testing::Test {
  protected:
    void SetUp() override {
        write_old_text(here / "bed.dump", foreign_dump());
        write_old_text(here / "contacts.dump", foreign_contacts());
        for (int k = 0; k < kForeignFrames; ++k)
            write_old_text(here / fmt::format("paddle_{}.stl", 1000 * k), foreign_paddle(k * kPaddleTurn));
    }

    Program::Setting setting() const {
        return {here.path(), {"XDG_CACHE_HOME=" + (here / "cache").string()}};
    }
    Ended program(const std::vector<std::string>& words) { return run_program(words, setting()); }
    // Adds the length of a step, so that the dump has times.
    Ended timed(std::vector<std::string> words) {
        words.insert(words.end(), {"--time-step", "1e-5"});
        return program(words);
    }

    // Imports the dump by drawing a small picture of it.
    Ended imported(std::vector<std::string> more = {}) {
        std::vector<std::string> words{"render", "bed.dump", "--at", "0.01", "--size", "160x120"};
        words.insert(words.end(), more.begin(), more.end());
        return timed(words);
    }

    // Folders of runs in the cache.
    std::vector<std::filesystem::path> imports() const {
        std::vector<std::filesystem::path> runs;
        std::error_code none;
        for (const auto& one : std::filesystem::recursive_directory_iterator(here / "cache", none))
            if (one.path().filename() == "scene.toml") runs.push_back(one.path().parent_path());
        return runs;
    }
    std::filesystem::path import() const {
        const std::vector<std::filesystem::path> all = imports();
        return all.size() == 1 ? all.front() : std::filesystem::path();
    }

    TemporaryFolder here;
};

}  // namespace grainreel::test
