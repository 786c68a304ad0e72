// The texts of numbers, drive, time and notes.
#include "render/picture/words/captions.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "engine/base/error.hpp"
#include "engine/measure/measures.hpp"
#include "engine/scene/drive_schedule.hpp"
#include "render/scene/live_text.hpp"

namespace grainreel {
namespace {

struct Unit {
    double size;
    const char* name;
};

Unit length_unit(double metres) {
    if (metres >= 1) return {1, "m"};
    if (metres >= 0.1) return {0.01, "cm"};
    if (metres >= 0.001) return {0.001, "mm"};
    return {1e-6, "µm"};
}

std::vector<std::string> vibration_lines(double frequency, double amplitude, double gravity) {
    std::vector<std::string> lines = {"f = " + frequency_text(frequency)};
    const double omega = 2 * std::numbers::pi * frequency;
    if (gravity > 0) lines.push_back(fmt::format("Γ = {:.3g}", amplitude * omega * omega / gravity));
    lines.push_back("a = " + length_text(amplitude));
    return lines;
}

// Rounds the present value of a growing drive to as many decimals as its final value has.
double rounded_as(double value, double full) {
    if (full <= 0) return value;
    const double digit = std::pow(10, std::floor(std::log10(full)) - 2);
    return std::round(value / digit) * digit;
}

std::vector<std::string> growing_lines(const FilmedScene& scene, double share) {
    const Drive& drive = scene.drive;
    const double gravity = scene.gravity.norm(), level = drive.g_level(gravity);
    std::vector<std::string> lines = {"f = " + frequency_text(drive.frequency)};
    if (gravity > 0) lines.push_back(fmt::format("Γ = {:.3g}", rounded_as(share * level, level)));
    lines.push_back("a = " + length_text(rounded_as(share * drive.amplitude, drive.amplitude)));
    return lines;
}

std::vector<std::string> stage_lines(const DriveSchedule::Now& now, double gravity, const Wording& say) {
    std::vector<std::string> lines = vibration_lines(now.frequency, now.amplitude, gravity);
    if (now.kind == DriveStage::Kind::rest) lines.assign({say(Word::at_rest)});
    if (now.kind != DriveStage::Kind::taps) return lines;
    lines.front() = say(Word::taps, {frequency_text(now.frequency)});
    lines.back() = say(Word::tap_interval, {fmt::format("{:.3g} s", now.interval)});
    return lines;
}

// The lines of the drive in one: "f = 15 Hz", "Γ = 4", "a = 4.4 mm" become "15 Hz, Γ = 4". With gravity the
// third line, amplitude or how often taps come, is left out.
std::string in_short(const std::vector<std::string>& lines, ShakingParts parts, bool has_level) {
    std::vector<std::string> words;
    for (const std::string& line : lines) {
        const bool level = line.starts_with("Γ = "), third = has_level && &line - lines.data() == 2;
        if ((level && !parts.g_level) || third) continue;
        if (!level && !line.starts_with("a = ") && !parts.frequency) continue;
        words.push_back(line.starts_with("f = ") ? line.substr(4) : line);
    }
    return fmt::format("{}", fmt::join(words, ", "));
}

}  // namespace

std::vector<std::string> drive_lines(const FilmedScene& scene, const State& frame) {
    const double cycles = frame.time < 0 ? -1 : std::max(0.0, frame.cycles);
    const double share = grown_share(scene.drive, cycles);
    const DriveSchedule::Now now = drive_now(scene.drive, std::max(0.0, cycles));
    if (share < 1) return growing_lines(scene, share);
    return stage_lines(now, scene.gravity.norm(), scene.film.wording);
}

bool drive_lines_change(const Drive& drive) {
    return drive.present && (drive.changes() || drive.ramp > 0);
}

namespace {

// The lines of the drive at all moments at which one of them may be longest.
std::vector<std::vector<std::string>> long_drive_lines(const FilmedScene& scene) {
    const double gravity = scene.gravity.norm();
    std::vector<std::vector<std::string>> moments = {
        vibration_lines(scene.drive.frequency, scene.drive.amplitude, gravity)};
    // At these shares of the full drive the numbers are longest.
    if (scene.drive.ramp > 0)
        for (const double share : {0.888, 0.0888}) moments.push_back(growing_lines(scene, share));
    if (!scene.drive.changes()) return moments;
    const DriveSchedule schedule(scene.drive);
    for (const PeriodStretch& stretch : schedule.times().stretches())
        moments.push_back(stage_lines(schedule.now(stretch.cycles), gravity, scene.film.wording));
    // While a stage changes into another, numbers have three digits.
    moments.push_back({"f = 88.8 Hz", "Γ = 88.8", "a = 88.8 mm"});
    if (!(gravity > 0)) moments.back().erase(moments.back().begin() + 1);
    return moments;
}

}  // namespace

std::vector<std::string> longest_drive_lines(const FilmedScene& scene) {
    std::vector<std::string> longest;
    for (const std::vector<std::string>& lines : long_drive_lines(scene)) {
        if (longest.empty()) longest = lines;
        for (std::size_t i = 0; i < std::min(lines.size(), longest.size()); ++i)
            if (lines[i].size() > longest[i].size()) longest[i] = lines[i];
    }
    return longest;
}

std::string shaking_text(const FilmedScene& scene, const State& frame, ShakingParts parts) {
    return in_short(drive_lines(scene, frame), parts, scene.gravity.norm() > 0);
}

std::string longest_shaking_text(const FilmedScene& scene, ShakingParts parts) {
    std::string longest;
    for (const std::vector<std::string>& lines : long_drive_lines(scene)) {
        const std::string words = in_short(lines, parts, scene.gravity.norm() > 0);
        if (words.size() > longest.size()) longest = words;
    }
    return longest;
}

std::string shown_title(const Film& film) {
    return film.word_kinds.title ? film.title : std::string();
}

std::string length_text(double metres) {
    const Unit unit = length_unit(metres * 1.0000001);
    return fmt::format("{:.3g} {}", metres / unit.size, unit.name);
}

std::string frequency_text(double hertz) {
    return hertz >= 1000 ? fmt::format("{:.3g} kHz", hertz / 1000) : fmt::format("{:.3g} Hz", hertz);
}

std::string time_text(double seconds, double duration) {
    const Unit unit = duration < 0.1 ? Unit{0.001, "ms"} : Unit{1, "s"};
    // The minus sign is as wide as a digit, and a value that rounds to zero has none.
    const double value = seconds / unit.size, shown = std::abs(value) < 0.0005 ? 0 : value;
    return fmt::format("t = {}{:.3f} {}", shown < 0 ? "−" : "", std::abs(shown), unit.name);
}

std::string diameter_text(const SizeSpread& diameter) {
    if (diameter.kind == SizeSpread::Kind::fixed || diameter.smallest == diameter.largest)
        return length_text(diameter.largest);
    const Unit unit = length_unit(diameter.largest * 1.0000001);
    return fmt::format("{:.3g}–{:.3g} {}", diameter.smallest / unit.size, diameter.largest / unit.size,
                       unit.name);
}

double round_length(double longest) {
    const double decade = std::pow(10, std::floor(std::log10(longest)));
    for (const double step : {5.0, 2.0})
        if (step * decade <= longest) return step * decade;
    return decade;
}

ShownCycle shown_cycle(const State& frame) {
    // Frames of slow motion lie at whole steps, often just before the end of a period. The cycle is counted
    // by the rounded phase.
    const double rounded = std::round(100 * frame.phase) / 100;
    const double cycles = frame.cycles + (rounded - frame.phase);
    return {std::max(0LL, static_cast<long long>(std::floor(cycles + 1e-6))), rounded < 1 ? rounded : 0};
}

std::string playback_text(const Film& film, const State& frame, const std::string& playback) {
    if (!film.word_kinds.playback) return "";
    if (!(frame.time < 0)) return playback;  // time is NaN where it is not known
    return film.wording(Word::settling) + (playback.empty() ? "" : "; " + playback);
}

std::string joined(const std::string& note, const std::string& caption) {
    return note.empty() || caption.empty() ? note + caption : note + "\n\n" + caption;
}

namespace {

// The words with the values of the frame's last row of measures.
std::string text_now(const std::vector<LiveWords>& words, const Shot& frame) {
    return live_text(words, [&](const LiveWords& part) {
        return live_number(part, frame.measures.get(), frame.measure_rows);
    });
}

std::string longest_text(const std::vector<LiveWords>& words) {
    return live_text(words, [](const LiveWords&) { return std::optional(-1.23e-4); });
}

}  // namespace

std::string caption_at(const Film& film, double end, const Shot& frame) {
    if (!film.word_kinds.captions) return {};
    constexpr double rounding = 1e-9;  // s
    const bool is_last = std::abs(frame.time - end) <= rounding;
    for (const FilmCaption& caption : film.captions)
        if (shows_caption(caption, frame.time) || (is_last && caption.to >= end - rounding))
            return caption.words.empty() ? caption.text : text_now(caption.words, frame);
    return {};
}

std::string longest_caption(const FilmCaption& caption) {
    return caption.words.empty() ? caption.text : longest_text(caption.words);
}

namespace {

std::string mass_text(double kilograms) {
    if (kilograms >= 0.9995) return fmt::format("{:.3g} kg", kilograms);
    return kilograms >= 0.9995e-3 ? fmt::format("{:.3g} g", 1e3 * kilograms)
                                  : fmt::format("{:.3g} mg", 1e6 * kilograms);
}

// Gives the total number of grains only where all of them are there from the start. Where grains are fed,
// some are yet to come.
std::string outflow_text(const FilmedScene& scene, const FlowedOut& out) {
    const std::int64_t all = scene.grains();
    const Wording& say = scene.film.wording;
    const std::string grains = std::to_string(out.grains);
    return fmt::format("{}\n{}",
                       scene.grains_at_start() == all ? say(Word::out_of, {grains, std::to_string(all)})
                                                      : say(Word::out, {grains}),
                       say(Word::out, {mass_text(out.mass)}));
}

}  // namespace

std::string note_text(const FilmedScene& scene, const Shot& frame) {
    const std::string text = text_now(scene.film.shows.live_words, frame);
    const bool flows = scene.film.word_kinds.counts && frame.flowed_out && frame.flowed_out->grains > 0;
    const std::string out = flows ? outflow_text(scene, *frame.flowed_out) : "";
    return joined(out, text);
}

std::string longest_note(const FilmedScene& scene) {
    const std::string text = longest_text(scene.film.shows.live_words);
    const FlowedOut most{scene.grains(), 0.888};
    const bool flows = scene.film.shows.outflow && scene.film.word_kinds.counts;
    return joined(flows ? outflow_text(scene, most) : "", text);
}

}  // namespace grainreel
