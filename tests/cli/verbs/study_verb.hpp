// A folder with the small scene and studies of it, which the program runs.
#pragma once

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/cli/program.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel::test {

namespace fs = std::filesystem;

inline const std::string four_members = R"(scene = "fifty.toml"
set = ["run.duration=0.1 s", "film.size=160x120"]
seeds = 2
[[vary]]
key = "drive.g_level"
values = [2, 3]
[[measure]]
name = "kinetic"
column = "kinetic"
reduce = "mean"
)";

inline std::string replaced(std::string text, const std::string& part, const std::string& other) {
    const auto at = text.find(part);
    EXPECT_NE(at, std::string::npos) << part;
    return text.replace(at, part.size(), other);
}

// A study whose members run longer than any test waits.
inline std::string with_long_runs() {
    return replaced(four_members, "run.duration=0.1 s", "run.duration=1000 s");
}

class StudyVerb : public testing::Test {
  protected:
    StudyVerb() { write_small_scene(folder_.path()); }

    std::string write(const std::string& text) const {
        write_text(folder_ / "study.toml", text);
        return (folder_ / "study.toml").string();
    }
    std::vector<std::string> words(const std::string& study, std::vector<std::string> more = {}) const {
        std::vector<std::string> all{"study", study, "--out", out().string()};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    fs::path out() const { return folder_ / "out"; }
    std::vector<fs::path> members() const {
        std::vector<fs::path> all;
        for (const auto& entry : fs::directory_iterator(out() / "members")) all.push_back(entry.path());
        std::sort(all.begin(), all.end());
        return all;
    }
    nlohmann::json record(const fs::path& member) const {
        return nlohmann::json::parse(std::ifstream(member / "run.json"));
    }
    // The cells of the table, row by row.
    std::vector<std::vector<std::string>> table() const {
        std::vector<std::vector<std::string>> rows;
        std::istringstream text(text_of(out() / "study.csv"));
        for (std::string line; std::getline(text, line);) {
            rows.emplace_back();
            std::istringstream cells(line);
            for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
        }
        return rows;
    }

    TemporaryFolder folder_;
};

}  // namespace grainreel::test
