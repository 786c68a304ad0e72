// Reads run.json, of which nothing is trusted.
#include <charconv>
#include <concepts>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/plain_file.hpp"
#include "engine/files/run_json.hpp"

namespace grainreel {

namespace {

using Json = nlohmann::ordered_json;

// What the file has is taken over by its form. Each of these functions tells whether the value had that form;
// else `to` stays as it is.
bool take(const Json& from, std::string& to) {
    if (!from.is_string()) return false;
    to = from.get<std::string>();
    return true;
}

bool take(const Json& from, double& to) {
    if (!from.is_number()) return false;
    to = from.get<double>();
    return true;
}

template <std::integral Number>
bool take(const Json& from, Number& to) {
    const bool fits = from.is_number_unsigned()
                          ? std::in_range<Number>(from.get<std::uint64_t>())
                          : from.is_number_integer() && std::in_range<Number>(from.get<std::int64_t>());
    if (fits) to = from.get<Number>();
    return fits;
}

template <class Value>
bool take(const Json& from, const char* key, Value& to);

bool take(const Json& from, AcceptedKey& to) {
    take(from, "key", to.key);
    take(from, "then", to.then);
    take(from, "now", to.now);
    return take(from, "step", to.step);
}

bool take(const Json& from, DrawnFrom& to) {
    take(from, "frames", to.frames);
    take(from, "first_s", to.first);
    take(from, "last_s", to.last);
    return take(from, "run", to.folder);
}

bool lies_in(std::int64_t first, std::int64_t count, std::int64_t all) {
    return first >= 0 && count > 0 && all >= count && first <= all - count;
}

// A part makes sense if it lies within the whole film.
bool take(const Json& from, DrawnPart& to) {
    constexpr int most_parts = 1'000'000;
    const bool whole = take(from, "number", to.number) && take(from, "of", to.of) &&
                       take(from, "first_picture", to.first_picture) && take(from, "pictures", to.pictures) &&
                       take(from, "all_pictures", to.all_pictures) &&
                       take(from, "first_frame", to.first_frame) && take(from, "frames", to.frames) &&
                       take(from, "all_frames", to.all_frames) && take(from, "rate", to.rate);
    take(from, "file", to.file);
    take(from, "format", to.format);
    take(from, "run", to.run);
    take(from, "settings", to.settings);
    take(from, "film_xxh64", to.checksum);
    return whole && to.number >= 1 && to.number <= to.of && to.of <= most_parts &&
           lies_in(to.first_picture, to.pictures, to.all_pictures) &&
           lies_in(to.first_frame, to.frames, to.all_frames) && to.frames >= to.pictures && to.rate > 0 &&
           to.rate <= 1e6 && to.file.find('/') == std::string::npos && to.file != "..";
}

template <class Value>
bool take(const Json& from, std::optional<Value>& to) {
    Value value{};
    if (take(from, value)) to = std::move(value);
    return to.has_value();
}

template <class Value>
bool take(const Json& from, std::vector<Value>& to) {
    if (!from.is_array()) return false;
    for (const Json& one : from)
        if (Value value{}; take(one, value)) to.push_back(std::move(value));
    return true;
}

template <class Value>
bool take(const Json& from, std::vector<std::pair<std::string, Value>>& to) {
    if (!from.is_object()) return false;
    for (const auto& [name, one] : from.items())
        if (Value value{}; take(one, value)) to.emplace_back(name, std::move(value));
    return true;
}

const Json& member(const Json& object, const char* key) {
    static const Json none;
    return object.is_object() && object.contains(key) ? object[key] : none;
}

template <class Value>
bool take(const Json& from, const char* key, Value& to) {
    return take(member(from, key), to);
}

void take_deepest(const Json& from, std::optional<DeepestContact>& to) {
    DeepestContact contact;
    if (!take(from, "share", contact.share)) return;
    take(from, "time_s", contact.time);
    take(from, "step", contact.step);
    take(from, "grain", contact.grain);
    take(from, "species", contact.species);
    take(from, "other", contact.other);
    take(from, "remedy", contact.remedy);
    to = contact;
}

void take_engine(const Json& from, RunJson& r) {
    take_deepest(member(from, "largest_overlap"), r.deepest);
    take(from, "seed", r.seed);
    take(from, "grains", r.grains);
    take(from, "step_s", r.step);
    take(from, "steps", r.steps);
    take(from, "steps_planned", r.steps_planned);
    take(from, "simulated_s", r.simulated);
    if (double settled = 0; take(from, "settled_s", settled)) r.settled = settled;
    take(from, "vector", r.vector);
    take(from, "particle_steps_per_second", r.particle_steps_per_second);
    std::string digits;
    std::uint64_t hash = 0;
    take(from, "state_hash", digits);
    const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), hash, 16);
    if (read.ec == std::errc() && read.ptr == digits.data() + digits.size()) r.state_hash = hash;
}

RunStatus status_of(const std::string& word) {
    for (const RunStatus status : {RunStatus::complete, RunStatus::interrupted, RunStatus::failed})
        if (word == to_string(status)) return status;
    return RunStatus::running;
}

// The file as JSON. fault: becomes what is wrong with the file, if anything is.
Json parsed(const std::filesystem::path& path, std::string& fault) {
    const std::string name = path.string();
    std::ifstream file = read_plain(path);
    if (!file) {
        fault = name + (is_there(path) ? ": cannot be read" : ": is missing");
        return {};
    }
    Json document = Json::parse(file, nullptr, false);
    if (document.is_discarded())
        fault = name + ": is damaged, for it is no JSON";
    else if (!document.is_object() || !document.contains("status"))
        fault = name + ": is no record of a run";
    return document;
}

}  // namespace

ReadRunJson read_run_json(const std::filesystem::path& path) {
    ReadRunJson read;
    const Json document = parsed(path, read.fault);
    RunJson& r = read.record;
    take(document, "status", read.status);
    r.status = status_of(read.status);
    take(document, "exit_status", r.exit_status);
    take(document, "error", r.error);
    take(document, "command", r.command);
    take(document, "scene", r.scene_file);
    take(document, "started", r.started);
    take(document, "finished", r.finished);
    const Json& program = member(document, "program");
    take(program, "version", r.version);
    take(program, "commit", r.commit);
    take(program, "compiler", r.compiler);
    take(program, "flags", r.build_flags);
    take(program, "libraries", r.libraries);
    take(document, "gl", r.gl);
    take(document, "encoder", r.encoder);
    const Json& threads = member(document, "threads");
    take(threads, "engine", r.engine_threads);
    take(threads, "raster", r.raster_threads);
    take(threads, "encoder", r.encoder_threads);
    take_engine(member(document, "engine"), r);
    take(document, "accepted", r.accepted);
    take(document, "drawn", r.drawn);
    take(document, "panels", r.panels);
    take(document, "captions", r.captions);
    take(document, "title", r.title);
    take(document, "wall_s", r.wall_seconds);
    r.film_frames.reset();
    const Json& written = member(document, "written");
    take(written, "film_frames", r.film_frames);
    take(written, "trajectory_frames", r.trajectory_frames);
    take(written, "measures_rows", r.measures_rows);
    take(written, "page", r.page);
    r.final_table = mark_in_run_json(path);
    take(document, "peak_memory_bytes", r.peak_memory);
    take(document, "missing", r.missing);
    take(document, "warnings", r.warnings);
    take(document, "part", r.part);
    return read;
}

}  // namespace grainreel
