// Cases of trajectories with one thing wrong: they are refused, or drawn as the whole one is.
#include <cstring>
#include <limits>

#include <fmt/format.h>

#include "tests/hard/group.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel::hard {

namespace fs = std::filesystem;

namespace {

// NetCDF's classic format has big-endian numbers.
template <class Word>
void put(std::string& bytes, std::size_t at, Word word) {
    for (std::size_t k = 0; k < sizeof word; ++k)
        bytes[at + k] = static_cast<char>(word >> 8 * (sizeof word - 1 - k));
}

std::uint64_t bits_of(double value) {
    std::uint64_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    return bits;
}

std::string damaged(std::string bytes, Dice& dice) {
    const std::size_t size = bytes.size();
    const auto word_at = [&](std::size_t bytes_of_word) {
        return dice.below(size / bytes_of_word) * bytes_of_word;
    };
    switch (dice.below(8)) {
        case 0:
        case 1:
            bytes[dice.below(size)] ^= static_cast<char>(1 << dice.below(8));
            break;
        case 2:
            bytes[dice.below(size)] = static_cast<char>(dice.word());
            break;
        case 3:
            put(bytes, word_at(4),
                dice.of<std::uint32_t>({0, 1, 0x7fffffff, 0x80000000, 0xffffffff, 0x7fc00000, 0x7f800000}));
            break;
        case 4:
            put(bytes, dice.below(size / 4 - 2) * 4,
                bits_of(dice.of<double>({std::numeric_limits<double>::quiet_NaN(), 1e300, -1e300, 0, 1e-310,
                                         std::numeric_limits<double>::infinity()})));
            break;
        case 5: {
            const std::size_t at = dice.below(size);
            std::fill_n(bytes.begin() + at, std::min(size - at, std::size_t{1} << dice.below(13)),
                        static_cast<char>(dice.one_in(2) ? 0 : 0xff));
            break;
        }
        case 6:
            bytes.resize(dice.one_in(4) ? dice.below(64) : dice.below(size));
            break;
        default:  // something is missing in the middle
            bytes.erase(dice.below(size), 1 + dice.below(dice.one_in(2) ? 8 : 2048));
    }
    return bytes;
}

// Damages one place. Half of the places are among the first bytes, which say where everything is.
std::string damaged_somewhere(const std::string& bytes, Dice& dice) {
    constexpr std::size_t kHeader = 4096;
    if (dice.one_in(2) || bytes.size() < 2 * kHeader) return damaged(bytes, dice);
    return damaged(bytes.substr(0, kHeader), dice) + bytes.substr(kHeader);
}

std::size_t pictures_in(const fs::path& folder) {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

std::string how_pictures_differ(const fs::path& wanted, const fs::path& drawn) {
    for (const auto& picture : fs::directory_iterator(wanted)) {
        const fs::path other = drawn / picture.path().filename();
        if (!fs::exists(other)) return other.filename().string() + " is missing";
        if (test::text_of(picture.path()) != test::text_of(other))
            return other.filename().string() + " is another picture";
    }
    const std::size_t count = pictures_in(wanted), found = pictures_in(drawn);
    return found == count ? "" : fmt::format("{} pictures in place of {}", found, count);
}

}  // namespace

Group damaged_trajectories(const Ground& ground) {
    const std::string whole = test::text_of(ground.run / "trajectory.nc");
    return {"trajectories", 300,
            [=](int, Dice& dice, const fs::path& here) -> Outcome {
                fs::copy(ground.run, here / "run");
                const std::string bytes = damaged_somewhere(whole, dice);
                test::write_text(here / "run/trajectory.nc", bytes);
                const Ran ran = attempt({"render", "run", "--every", "1", "--no-replay", "--no-film",
                                         "--frames", "--out", "drawn"},
                                        here);
                if (!ran.problem.empty()) return {"", ran.problem};
                if (ran.status != 0) return {"refused", ""};
                // If damaged frames are left out, the others are drawn with other words about the playback.
                const bool named = ran.err.find("left out") != std::string::npos;
                if (named && pictures_in(here / "drawn/frames") < pictures_in(ground.pictures))
                    return {"drawn without the damaged, which are named", ""};
                const std::string difference = how_pictures_differ(ground.pictures, here / "drawn/frames");
                if (!difference.empty()) return {"", "false success: exit status 0, but " + difference};
                return {bytes == whole ? "undamaged" : "drawn alike", ""};
            },
            0, 100};
}

}  // namespace grainreel::hard
