#include "render/draw/words/captions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/base/error.hpp"
#include "engine/measure/measure_table.hpp"
#include "engine/scene/film/live_text.hpp"

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

}  // namespace

std::string length_text(double metres) {
    const Unit unit = length_unit(metres * 1.0000001);
    return fmt::format("{:.3g} {}", metres / unit.size, unit.name);
}

std::string frequency_text(double hertz) {
    return hertz >= 1000 ? fmt::format("{:.3g} kHz", hertz / 1000) : fmt::format("{:.3g} Hz", hertz);
}

std::string time_text(double seconds, double duration) {
    const Unit unit = duration < 0.1 ? Unit{0.001, "ms"} : Unit{1, "s"};
    // A minus as wide as a digit, and no "-0.000".
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

ShownCycle shown_cycle(const Frame& frame) {
    // Frames of slow motion land on steps, often a hair before a period's end: the cycle goes with the
    // rounding.
    const double rounded = std::round(100 * frame.phase) / 100;
    const double cycles = frame.cycles + (rounded - frame.phase);
    return {std::max(0LL, static_cast<long long>(std::floor(cycles + 1e-6))), rounded < 1 ? rounded : 0};
}

std::string playback_text(const Frame& frame, const std::string& playback) {
    if (frame.time >= 0) return playback;
    return playback.empty() ? "settling, drive off" : "settling, drive off; " + playback;
}

std::string note_text(const Scene& scene, const Frame& frame) {
    return live_text(scene.film.shows.live_words, [&](const std::string& name) -> std::optional<double> {
        if (!frame.measures || frame.measure_rows == 0) return std::nullopt;
        const std::vector<std::string>& columns = frame.measures->columns();
        const auto found = std::find(columns.begin(), columns.end(), name);
        GRAINREEL_CHECK(found != columns.end());
        return frame.measures
            ->values(static_cast<std::size_t>(found - columns.begin()), frame.measure_rows - 1,
                     frame.measure_rows)
            .front();
    });
}

std::string longest_note(const Scene& scene) {
    return live_text(scene.film.shows.live_words, [](const std::string&) { return std::optional(-1.23e-4); });
}

}  // namespace grainreel
