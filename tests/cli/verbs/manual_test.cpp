// Tests of the manual page and of completions for shells: they have the same verbs and options as --help, in
// scripts that a shell can read.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/cli/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel::test {
namespace {

std::string output_of(const std::vector<std::string>& words) {
    const Ended ended = run_program(words, {});
    EXPECT_EQ(ended.status, 0) << ended.err;
    return ended.out;
}

// The words of a text that begin with `start`, up to a comma, a blank or the end of the line.
std::vector<std::string> words_with(const std::string& text, const std::string& start) {
    std::vector<std::string> found;
    std::istringstream in(text);
    for (std::string word; in >> word;) {
        word = word.substr(0, word.find_first_of(",;:="));
        if (word.compare(0, start.size(), start) == 0 && word.size() > start.size()) found.push_back(word);
    }
    return found;
}

// The completions that bash offers for the last of these words.
std::vector<std::string> offered(const std::filesystem::path& script, const std::vector<std::string>& words) {
    std::string line = "source '" + script.string() + "'; compopt() { :; }; COMP_WORDS=(";
    for (const std::string& word : words) line += "'" + word + "' ";
    line += "); COMP_CWORD=" + std::to_string(words.size() - 1) +
            "; _grainreel; printf '%s\\n' \"${COMPREPLY[@]}\"";
    const std::filesystem::path into = script.parent_path() / "offered.txt";
    std::ofstream(script.parent_path() / "ask.sh") << line;
    const std::string command =
        "bash '" + (script.parent_path() / "ask.sh").string() + "' > '" + into.string() + "' 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0) << line;
    std::vector<std::string> all;
    std::ifstream file(into);
    for (std::string one; std::getline(file, one);)
        if (!one.empty()) all.push_back(one);
    return all;
}

bool has(const std::vector<std::string>& all, const std::string& one) {
    return std::find(all.begin(), all.end(), one) != all.end();
}

TEST(Manual, APageNamesTheOptionsOfItsVerb) {
    for (const std::string verb : {"movie", "render", "inspect", "export", "study"}) {
        const std::string page = output_of({"manual", verb});
        EXPECT_EQ(page.find(".TH GRAINREEL\\-"), 0u);
        for (const std::string& option : words_with(output_of({verb, "--help"}), "--")) {
            std::string as_roff = option;
            for (auto at = as_roff.find('-'); at != std::string::npos; at = as_roff.find('-', at + 2))
                as_roff.replace(at, 1, "\\-");
            EXPECT_NE(page.find(as_roff), std::string::npos) << verb << " " << option;
        }
    }
}

TEST(Manual, WritesAPageForEachVerb) {
    const TemporaryFolder folder;
    output_of({"manual", "--out", (folder.path() / "man").string()});
    const std::string help = output_of({"--help"});
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "man/grainreel.1"));
    for (const std::string verb : {"movie", "resume", "render", "doctor", "completion"}) {
        EXPECT_NE(help.find("  " + verb), std::string::npos);
        EXPECT_TRUE(std::filesystem::exists(folder.path() / "man" / ("grainreel-" + verb + ".1"))) << verb;
    }
    EXPECT_EQ(run_program({"manual", "rendre"}, {}).status, 2);
}

// bash takes "=" as a word of its own, so KEY=VALUE is three words.
TEST(Completion, BashOffersWhatMayComeNext) {
    const TemporaryFolder folder;
    const std::filesystem::path script = folder.path() / "completion.bash";
    std::ofstream(script) << output_of({"completion", "bash"});
    EXPECT_EQ(offered(script, {"grainreel", "ren"}), std::vector<std::string>{"render"});
    EXPECT_TRUE(has(offered(script, {"grainreel", "render", "run", "--keep"}), "--keep-camera"));
    EXPECT_FALSE(has(offered(script, {"grainreel", "render", "run", "--"}), "--to-nowhere"));
    EXPECT_EQ(offered(script, {"grainreel", "movie", "a.toml", "--format", "f"}),
              std::vector<std::string>{"ffv1"});
    EXPECT_EQ(offered(script, {"grainreel", "export", "run", "--to", "gl"}),
              std::vector<std::string>{"gltf"});
    EXPECT_EQ(offered(script, {"grainreel", "movie", "a.toml", "--set", "drive.freq"}),
              std::vector<std::string>{"drive.frequency="});
    EXPECT_EQ(offered(script, {"grainreel", "movie", "a.toml", "--set", "film.transparent", "=", "t"}),
              std::vector<std::string>{"true"});
    EXPECT_TRUE(
        has(offered(script, {"grainreel", "movie", "a.toml", "--set", "film.transparent", "="}), "false"));
    EXPECT_TRUE(has(offered(script, {"grainreel", "movie", "wedge_s"}), "wedge_segregation"));
    EXPECT_FALSE(has(offered(script, {"grainreel", "watch", "wedge_s"}), "wedge_segregation"));
}

TEST(Completion, EveryShellHasEveryVerb) {
    for (const std::string shell : {"bash", "zsh", "fish"}) {
        const std::string script = output_of({"completion", shell});
        for (const std::string verb : {"movie", "render", "export", "doctor"})
            EXPECT_NE(script.find(verb), std::string::npos) << shell;
        EXPECT_NE(script.find("drive.frequency"), std::string::npos) << shell;
    }
    EXPECT_EQ(run_program({"completion", "tcsh"}, {}).status, 2);
}

}  // namespace
}  // namespace grainreel::test
