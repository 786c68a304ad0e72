// Cases of scenes with something wrong or absurd: `check` answers soon, and `movie` begins what `check`
// accepts.
#include <signal.h>

#include <chrono>
#include <thread>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/scene/keys/keys.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/hard/group.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel::hard {

namespace fs = std::filesystem;

namespace {

const std::vector<std::string> kAbsurd = {"0",
                                          "-1",
                                          "1",
                                          "2",
                                          "1e-320",
                                          "1e-30",
                                          "1e16",
                                          "1e308",
                                          "-1e308",
                                          "inf",
                                          "nan",
                                          "9223372036854775807",
                                          "-9223372036854775808",
                                          "1e8",
                                          "1000000",
                                          "0.5",
                                          "true",
                                          "\"\"",
                                          "\"none\"",
                                          "\"1e9 s\"",
                                          "\"1e-9 s\"",
                                          "\"3 furlongs\"",
                                          "\"1e16 m\"",
                                          "[]",
                                          "[0, 0, 0]",
                                          "[1e300, 0, nan]",
                                          "[-1, 0, 1]",
                                          "[[1, 1]]",
                                          "{}",
                                          "{ min = 1, max = 0 }",
                                          "\"\\u0000\"",
                                          "\"/dev/zero\"",
                                          "\"/\"",
                                          "\"{time\"",
                                          "07:32:00",
                                          "1979-05-27"};

const std::vector<std::string> kNumbers = {"0",      "1",     "-1",        "0.5",  "2",    "3",
                                           "10",     "100",   "1e3",       "1e6",  "1e8",  "1e16",
                                           "1e30",   "1e308", "1e-3",      "1e-6", "1e-9", "1e-30",
                                           "1e-320", "-1e9",  "12345.678", "64",   "4096", "0.999999"};

std::string absurd(Dice& dice) {
    if (dice.one_in(40)) return "\"" + std::string(100'000, 'x') + "\"";
    if (dice.one_in(40)) return "\"\xff\xfe\xc0\"";
    if (dice.one_in(40)) return std::string(5000, '[');
    return dice.of(kAbsurd);
}

// A value of the right kind, so that not only the reader's first look is tested.
std::string plausible(const Key& key, Dice& dice) {
    switch (key.kind) {
        case KeyKind::flag:
            return dice.one_in(2) ? "true" : "false";
        case KeyKind::choice:
            return "\"" + dice.of(key.choices) + "\"";
        case KeyKind::integer:
            return dice.of<std::string>({"0", "1", "2", "3", "7", "100", "5000", "1000000", "2147483647"});
        case KeyKind::vector:
        case KeyKind::gravity:
            return fmt::format("[{}, {}, {}]", dice.of(kNumbers), dice.of(kNumbers), dice.of(kNumbers));
        case KeyKind::quantity:
        case KeyKind::diameter:
            return dice.of(kNumbers);
        default:
            return key.example();
    }
}

// An assignment to a key of the list, in the first element of its arrays.
std::string assignment(Dice& dice) {
    const Key& key = dice.of(filmed_scene_keys());
    std::string path = key.path;
    for (std::size_t at; (at = path.find("[]")) != std::string::npos;) path.replace(at, 2, "[0]");
    return path + "=" + (dice.one_in(3) ? absurd(dice) : plausible(key, dice));
}

// Replaces the first number in a line's value by another one. The unit and everything else stay.
void change_number(std::string& line, Dice& dice) {
    const std::size_t equal = line.find('=');
    const std::size_t begin = equal == line.npos ? equal : line.find_first_of("0123456789", equal);
    if (begin == line.npos) return;
    const std::size_t end = std::min(line.find_first_not_of("0123456789.eE+-", begin), line.size());
    line.replace(begin, end - begin, dice.of(kNumbers));
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        lines.push_back(text.substr(at, end - at));
        at = end + 1;
    }
    return lines;
}

void change_lines(std::vector<std::string>& lines, Dice& dice) {
    const std::size_t at = dice.below(lines.size());
    std::string& line = lines[at];
    const auto equal = line.find('=');
    switch (dice.below(12)) {
        case 0:
            lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(at));
            break;
        case 1:
            lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(dice.below(lines.size())),
                         std::string(line));
            break;
        case 2:
            if (!line.empty()) line[dice.below(line.size())] = static_cast<char>(dice.word());
            break;
        case 3:
            std::swap(line, lines[dice.below(lines.size())]);
            break;
        case 4:
            if (equal != std::string::npos) line = line.substr(0, equal + 1) + " " + absurd(dice);
            break;
        default:
            change_number(line, dice);
    }
}

std::string mutated(const std::string& text, Dice& dice) {
    std::vector<std::string> lines = lines_of(text);
    for (std::size_t k = 1 + dice.below(2); k > 0 && !lines.empty(); --k) change_lines(lines, dice);
    std::string result = fmt::format("{}\n", fmt::join(lines, "\n"));
    if (dice.one_in(20)) result.resize(dice.below(result.size()));
    if (dice.one_in(40)) result.insert(dice.below(result.size()), 1, '\0');
    return result;
}

// Any scene; half of them are the small one, which runs in no time.
std::string any_scene(const std::vector<std::string>& shipped, Dice& dice) {
    return dice.one_in(2) ? test::small_scene_text : dice.of(shipped);
}

// The scene with a small film, which `check` draws in no time.
std::string with_small_film(std::string text) {
    const std::string size = "size = \"160x90\"", table = "\n[film]\n";
    if (const auto given = text.find("\nsize = "); given != text.npos)
        return text.replace(given + 1, text.find('\n', given + 1) - given - 1, size);
    const auto film = text.find(table);
    if (film == text.npos) return text + table + size + "\n";
    return text.insert(film + table.size(), size + "\n");
}

std::vector<std::string> shipped_scenes() {
    std::vector<fs::path> files;
    for (const auto& file : fs::directory_iterator(GRAINREEL_SOURCE "/scenes"))
        if (file.path().extension() == ".toml") files.push_back(file.path());
    std::sort(files.begin(), files.end());
    std::vector<std::string> texts;
    for (const fs::path& file : files) texts.push_back(with_small_film(test::text_of(file)));
    return texts;
}

// Begins the run, and stops it after a moment.
Ran begin(std::vector<std::string> words, const fs::path& here) {
    words[0] = "movie";
    words.insert(words.end(), {"--out", "run"});
    test::Program program(words, limits(here));
    const auto until = std::chrono::steady_clock::now() + std::chrono::milliseconds(700);
    while (program.running() && std::chrono::steady_clock::now() < until)
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    program.send(SIGTERM);
    Ran ran = end_of(program, SIGTERM);
    if (!ran.problem.empty()) ran.problem = command_text(words) + " " + ran.problem;
    return ran;
}

}  // namespace

Group mutated_scenes(const Ground&) {
    const std::vector<std::string> shipped = shipped_scenes();
    return {"scenes", 300,
            [=](int number, Dice& dice, const fs::path& here) -> Outcome {
                std::string text = any_scene(shipped, dice);
                std::vector<std::string> words = {"check", "scene.toml"};
                if (dice.one_in(2))
                    text = mutated(text, dice);
                else
                    words.insert(words.end(), {"--set", assignment(dice)});
                test::write_text(here / "scene.toml", text);
                const Ran check = attempt(words, here);
                if (!check.problem.empty()) return {"", check.problem};
                if (check.status == 1) return {"", "`check` fails: " + first_line(check.err)};
                if (check.status == 2) return {"refused", ""};
                if (number % 2 != 0) return {"planned", ""};
                const Ran movie = begin(words, here);
                if (!movie.problem.empty()) return {"", movie.problem};
                if (movie.status == 2)
                    return {"", "`check` passes what `movie` refuses: " + first_line(movie.err)};
                return {"begun", ""};
            },
            0, 100};
}

}  // namespace grainreel::hard
