// Cases of continuations in changed scenes: the same run continues, and every other change is refused with
// the name of the key.
#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include "tests/hard/group.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel::hard {

namespace fs = std::filesystem;

namespace {

struct Change {
    std::vector<std::string> sets;
    std::string key;  // the key that the message names; empty: the run continues
};

const std::vector<Change>& changes() {
    static const std::vector<Change> all = {
        {{}, ""},
        {{"film.rotation=true"}, ""},
        {{"output.orientation=true", "film.colour.by=speed"}, ""},
        {{"title=Another", "run.threads=2"}, ""},
        {{"output.contacts=true", "film.size=320x240"}, ""},
        {{"run.duration=0.1 s"}, "run.duration"},
        {{"drive.direction=[1, 0, 0]"}, "drive.direction"},
        {{"drive.g_level=3"}, "drive.amplitude"},
        {{"drive.moves=floor"}, "drive.moves"},
        {{"drive.phase=0.5"}, "drive.phase"},
        {{"species.small.density=2600"}, "species[0].density"},
        {{"species.small.count=39"}, "species[0].count"},
        {{"species.big.diameter=7 mm"}, "species[1].diameter"},
        {{"container.top=open"}, "container.top"},
        {{"container.width=40 mm"}, "container.width"},
        {{"container.height=30 mm"}, "container.height"},
        {{"gravity=[0, 1, -9.81]"}, "gravity"},
        {{"run.seed=2"}, "run.seed"},
        {{"run.precision=mixed"}, "run.precision"},
        {{"contact.pair[2].friction=0.9"}, "contact.pair[2].friction"},
    };
    return all;
}

}  // namespace

Group changed_continuations(const Ground& ground) {
    return {"continuations", static_cast<int>(changes().size()),
            [=](int number, Dice&, const fs::path& here) -> Outcome {
                const Change& change = changes()[number];
                std::vector<std::string> words = {"check", (ground.run / "scene.toml").string()};
                for (const char* set : {"start.method=file", "start.file=checkpoint.grs",
                                        "start.keep_clock=true", "run.duration=0.3 s"})
                    words.insert(words.end(), {"--set", set});
                for (const std::string& set : change.sets) words.insert(words.end(), {"--set", set});
                const Ran check = attempt(words, here);
                words[0] = "movie";
                words.insert(words.end(), {"--out", "run"});
                const Ran movie = attempt(words, here);
                for (const Ran* ran : {&check, &movie}) {
                    if (!ran->problem.empty()) return {"", ran->problem};
                    if (change.key.empty() && ran->status != 0)
                        return {"", "is refused: " + first_line(ran->err)};
                    if (change.key.empty()) continue;
                    if (ran->status != 2) return {"", fmt::format("false success with {}", change.sets[0])};
                    if (ran->err.find("'" + change.key + "'") == std::string::npos &&
                        ran->err.find(change.key) == std::string::npos)
                        return {"", fmt::format("does not name {}: {}", change.key, first_line(ran->err))};
                }
                if (!change.key.empty() && fs::exists(here / "run"))
                    return {"", "a refused run leaves a folder"};
                return {change.key.empty() ? "gone on" : "refused by key", ""};
            }};
}

}  // namespace grainreel::hard
