#include "render/app/report/progress_text.hpp"

#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace grainreel {

std::string to_string(Progress::Stage stage) {
    switch (stage) {
        case Progress::Stage::growing:
            return "growing";
        case Progress::Stage::raining:
            return "raining";
        case Progress::Stage::settling:
            return "settling";
        case Progress::Stage::charting:
            return "charting";
        case Progress::Stage::timing:
            return "timing";
        case Progress::Stage::drawing:
            return "drawing";
        case Progress::Stage::studying:
            return "studying";
        case Progress::Stage::replaying:
            return "replaying";
        case Progress::Stage::exporting:
            return "exporting";
        case Progress::Stage::paging:
            return "page";
        case Progress::Stage::vibrating:
            break;
    }
    return "vibrating";
}

std::string progress_line(const Progress& p, int width) {
    std::vector<std::string> parts;
    if (p.stage == Progress::Stage::vibrating) {
        parts.push_back(fmt::format("{:<9} {:.2f} of {:.2f} s", to_string(p.stage), p.time, p.end));
    } else {
        parts.push_back(fmt::format("{:<9} {:3.0f} %", to_string(p.stage), 100 * p.done));
    }
    if (!p.what.empty()) parts.push_back(p.what);
    if (p.particle_steps_per_second > 0) {
        parts.push_back(fmt::format("{:.1f} M particle-steps/s", p.particle_steps_per_second * 1e-6));
    }
    if (p.frames_planned > 0) parts.push_back(fmt::format("frame {} of {}", p.frames, p.frames_planned));
    if (p.remaining >= 0) parts.push_back(duration_text(std::ceil(p.remaining)) + " left");

    std::string line;
    for (const std::string& part : parts) {
        const std::string longer = line.empty() ? part : line + "   " + part;
        if (static_cast<int>(longer.size()) > width) break;
        line = longer;
    }
    return line;
}

std::string progress_json(const Progress& p) {
    nlohmann::ordered_json object = {{"event", "progress"}, {"stage", to_string(p.stage)}, {"done", p.done}};
    if (p.stage == Progress::Stage::vibrating) {
        object["time_s"] = p.time;
        object["end_s"] = p.end;
    }
    if (!p.what.empty()) object["what"] = p.what;
    if (p.particle_steps_per_second > 0) object["particle_steps_per_second"] = p.particle_steps_per_second;
    if (p.frames_planned > 0) {
        object["frames"] = p.frames;
        object["frames_planned"] = p.frames_planned;
    }
    object["elapsed_s"] = p.elapsed;
    if (p.remaining >= 0) object["remaining_s"] = p.remaining;
    return object.dump();
}

}  // namespace grainreel
