#include "render/app/estimate/speed_cache.hpp"

#include <fmt/format.h>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>

#include "engine/base/plain_file.hpp"
#include "engine/base/system/own_folder.hpp"
#include "engine/base/system/program.hpp"
#include "engine/base/team.hpp"
#include "engine/vector/instructions.hpp"
#include "render/app/messages/version.hpp"

namespace grainreel {

namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

// Number of looks that are kept; when there are more, all are measured again.
constexpr std::size_t most_films = 200;
constexpr std::uintmax_t largest_file = 1 << 20;

// An ARM processor tells no name, but a number of its kind.
std::string processor_name() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.rfind("model name", 0) == 0 || line.rfind("CPU part", 0) == 0)
            return line.substr(line.find(':') + 1);
    return "unknown";
}

bool sane(double value, double least, double most) {
    return value >= least && value <= most;  // also false for NaN
}

bool sane_engine(double grain_steps) {
    return sane(grain_steps, 1e3, 1e13);
}

bool sane_film(const FilmSpeed& speed) {
    return sane(speed.seconds, 1e-6, 1e5) && sane(speed.drawing, 0, 1);
}

}  // namespace

SpeedCache::SpeedCache()
    : machine_(fmt::format("{} x {}, grainreel {}, {}", processor_name(), usable_processors(),
                           build_info::version, vector_instructions())) {
    const fs::path folder = cache_folder();
    if (folder.empty()) return;
    path_ = folder / fmt::format("speed-{:016x}.json", std::hash<std::string>()(machine_));
    try {
        if (is_own_folder(folder)) read();
    } catch (const std::exception&) {  // the file is not one that save() has written
        engine_.clear();
        films_.clear();
    }
}

void SpeedCache::read() {
    if (!is_own(path_) || !is_plain(path_) || fs::file_size(path_) > largest_file) return;
    std::ifstream file = read_plain(path_);
    const Json all = Json::parse(file);
    if (all.at("machine").get<std::string>() != machine_) return;
    for (const auto& [threads, speed] : all.at("engine").items())
        if (sane_engine(speed.get<double>())) engine_[std::stoi(threads)] = speed.get<double>();
    for (const auto& [look, film] : all.at("film").items()) {
        const FilmSpeed speed{film.at("seconds").get<double>(), film.at("drawing").get<double>()};
        if (sane_film(speed)) films_[look] = speed;
    }
}

std::optional<double> SpeedCache::engine(int threads) const {
    const auto speed = engine_.find(threads);
    return speed == engine_.end() ? std::nullopt : std::optional(speed->second);
}

std::optional<FilmSpeed> SpeedCache::film(const std::string& look) const {
    const auto speed = films_.find(look);
    return speed == films_.end() ? std::nullopt : std::optional(speed->second);
}

void SpeedCache::keep_engine(int threads, double grain_steps) {
    if (sane_engine(grain_steps)) engine_[threads] = grain_steps;
}

void SpeedCache::keep_film(const std::string& look, const FilmSpeed& speed) {
    if (films_.size() >= most_films) films_.clear();
    if (sane_film(speed)) films_[look] = speed;
}

void SpeedCache::save() const {
    if (path_.empty()) return;
    Json engine = Json::object(), films = Json::object();
    for (const auto& [threads, speed] : engine_) engine[std::to_string(threads)] = speed;
    for (const auto& [look, film] : films_)
        films[look] = {{"seconds", film.seconds}, {"drawing", film.drawing}};
    const Json all = {{"machine", machine_}, {"engine", engine}, {"film", films}};
    try {
        fs::create_directories(path_.parent_path().parent_path());
        if (make_own_folder(path_.parent_path()).empty()) replace_file(path_, all.dump(1) + "\n");
    } catch (const std::exception&) {  // when the cache cannot be kept, the speeds are measured again
    }
}

}  // namespace grainreel
