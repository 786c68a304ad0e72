// A run on disk that is resumed, and the content of its folder before and after.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "engine/files/run_names.hpp"
#include "tests/cli/program.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel::test {

namespace fs = std::filesystem;

class ResumedFolder : public testing::Test {
  protected:
    using Words = std::vector<std::string>;

    ResumedFolder() { write_text(here / "busy.toml", busy_scene_text); }

    Ended run(const Words& words, std::size_t file_size_limit = 0) const {
        return run_program(words, {.folder = here.path(), .file_size_limit = file_size_limit});
    }
    void movie(const std::string& out, const Words& more = {}) const {
        Words words = {"movie", "busy.toml", "--out", out};
        words.insert(words.end(), more.begin(), more.end());
        const Ended ended = run(words);
        ASSERT_EQ(ended.status, 0) << ended.err;
    }
    // Makes a copy of a run on disk.
    void copy(const std::string& from, const std::string& to) const {
        fs::remove_all(here / to);
        fs::copy(here / from, here / to, fs::copy_options::recursive);
    }
    // The content of each file except the log.
    std::map<std::string, std::string> files_of(const std::string& folder) const {
        std::map<std::string, std::string> files;
        for (const auto& entry : fs::recursive_directory_iterator(here / folder))
            if (entry.is_regular_file() && entry.path().filename() != "log.txt")
                files[entry.path().lexically_relative(here / folder)] = text_of(entry.path());
        return files;
    }
    void expect_same_folder(const std::string& folder,
                            const std::map<std::string, std::string>& before) const {
        const auto now = files_of(folder);
        for (const auto& [name, bytes] : before) {
            ASSERT_EQ(now.count(name), 1u) << name;
            EXPECT_EQ(now.at(name) == bytes, true) << name;
        }
        for (const auto& [name, bytes] : now) EXPECT_EQ(before.count(name), 1u) << name;
    }
    // Compares two runs, except for what depends on wall time, and moments of former ends.
    void expect_same_run(const std::string& whole, const std::string& resumed) const {
        for (const char* name : {"trajectory.nc", "contacts.nc", "measures.csv", "outflow.csv", "final.csv",
                                 "film_moments.nc", "fields.nc", "scene.toml", "film_times.csv"})
            EXPECT_EQ(text_of(here / whole / name) == text_of(here / resumed / name), true) << name;
        EXPECT_EQ(record(resumed)["engine"]["state_hash"], record(whole)["engine"]["state_hash"]);
        EXPECT_EQ(record(resumed)["status"], "complete");
        for (const auto& entry : fs::directory_iterator(here / whole / "frames"))
            EXPECT_EQ(text_of(entry.path()) == text_of(here / resumed / "frames" / entry.path().filename()),
                      true)
                << entry.path();
        EXPECT_FALSE(fs::exists(here / resumed / kFormerRun));
        EXPECT_FALSE(fs::exists(here / resumed / kFormerRunPart));
    }
    nlohmann::json record(const std::string& folder) const {
        return nlohmann::json::parse(text_of(here / folder / "run.json"));
    }

    TemporaryFolder here;
};

}  // namespace grainreel::test
