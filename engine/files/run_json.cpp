#include "engine/files/run_json.hpp"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>
#include <xxhash.h>
#include <array>
#include <chrono>
#include <ctime>
#include <fstream>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"

namespace grainreel {

namespace {

using Json = nlohmann::ordered_json;

Json text_or_null(const std::string& text) {
    return text.empty() ? Json(nullptr) : Json(text);
}

template <class Value>
Json table(const std::vector<std::pair<std::string, Value>>& rows) {
    Json object = Json::object();
    for (const auto& [name, value] : rows) object[name] = value;
    return object;
}

Json program(const RunJson& r) {
    return {{"name", "grainreel"},    {"version", r.version},   {"commit", r.commit},
            {"compiler", r.compiler}, {"flags", r.build_flags}, {"libraries", table(r.libraries)}};
}

Json engine(const RunJson& r) {
    return {{"seed", r.seed},
            {"grains", r.grains},
            {"step_s", r.step},
            {"steps", r.steps},
            {"steps_planned", r.steps_planned},
            {"simulated_s", r.simulated},
            {"vector", r.vector},
            {"particle_steps_per_second", r.particle_steps_per_second},
            {"state_hash", r.state_hash ? Json(fmt::format("{:016x}", *r.state_hash)) : Json(nullptr)}};
}

Json drawn(const RunJson& r) {
    Json runs = Json::array();
    for (const DrawnRun& run : r.drawn)
        runs.push_back(
            {{"run", run.folder}, {"frames", run.frames}, {"first_s", run.first}, {"last_s", run.last}});
    return runs;
}

Json part_of(const DrawnPart& part) {
    return {{"number", part.number},
            {"of", part.of},
            {"first_picture", part.first_picture},
            {"pictures", part.pictures},
            {"all_pictures", part.all_pictures},
            {"first_frame", part.first_frame},
            {"frames", part.frames},
            {"all_frames", part.all_frames},
            {"rate", part.rate},
            {"file", text_or_null(part.file)},
            {"format", part.format},
            {"run", text_or_null(part.run)},
            {"settings", text_or_null(part.settings)},
            {"film_xxh64", text_or_null(part.checksum)}};
}

Json final_table(const RunJson& r) {
    if (!r.final_table) return nullptr;
    return {{"grains", r.final_table->grains}, {"xxh64", fmt::format("{:016x}", r.final_table->checksum)}};
}

Json accepted(const RunJson& r) {
    Json keys = Json::array();
    for (const AcceptedKey& one : r.accepted)
        keys.push_back({{"step", one.step},
                        {"key", one.key},
                        {"then", text_or_null(one.then)},
                        {"now", text_or_null(one.now)}});
    return keys;
}

// The document as text. Names and messages come from the user's files; bytes that are not UTF-8 are replaced
// and must not make this fail.
std::string text_of(const Json& document) {
    return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

// While the run goes on, run.json has this much room on disk beyond its end. When the disk is full and no new
// file can be made, the last text is written there, over the first.
constexpr off_t reserve = 32768;  // bytes

void reserve_room(const std::filesystem::path& path) {
    const int file = open_plain(path);
    if (file < 0) return;
    // Not every file system can reserve room. Without it the last text may not fit on a full disk.
    ::fallocate(file, FALLOC_FL_KEEP_SIZE, 0, reserve);
    ::close(file);
}

bool write_all(int file, const std::string& text) {
    return ::pwrite(file, text.data(), text.size(), 0) == static_cast<ssize_t>(text.size()) &&
           ::ftruncate(file, static_cast<off_t>(text.size())) == 0;
}

// Writes over the file in its place. False when there is no room; the file is unchanged then.
bool overwrite(const std::filesystem::path& path, const std::string& text) {
    std::ifstream old = read_plain(path);
    const std::string before{std::istreambuf_iterator<char>(old), std::istreambuf_iterator<char>()};
    const int file = open_plain(path);
    if (file < 0) return false;
    const bool written = write_all(file, text);
    if (!written) write_all(file, before);
    ::close(file);
    return written;
}

}  // namespace

std::string to_string(RunStatus status) {
    switch (status) {
        case RunStatus::running:
            return "running";
        case RunStatus::complete:
            return "complete";
        case RunStatus::interrupted:
            return "interrupted";
        case RunStatus::failed:
            break;
    }
    return "failed";
}

std::string utc_now() {
    const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
    return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(now));
}

void write_run_json(const std::filesystem::path& path, const RunJson& r) {
    Json document = {
        {"status", to_string(r.status)},
        {"exit_status", r.exit_status ? Json(*r.exit_status) : Json(nullptr)},
        {"error", text_or_null(r.error)},
        {"command", r.command},
        {"scene", r.scene_file},
        {"started", r.started},
        {"finished", text_or_null(r.finished)},
        {"program", program(r)},
        {"gl", text_or_null(r.gl)},
        {"encoder", text_or_null(r.encoder)},
        {"threads",
         {{"engine", r.engine_threads}, {"raster", r.raster_threads}, {"encoder", r.encoder_threads}}},
        {"engine", r.drawn.empty() && r.panels.empty() ? engine(r) : Json(nullptr)},
        {"accepted", accepted(r)},
        {"drawn", drawn(r)},
        {"panels", r.panels},
        {"wall_s", table(r.wall_seconds)},
        {"written",
         {{"film_frames", r.film_frames ? Json(*r.film_frames) : Json(nullptr)},
          {"trajectory_frames", r.trajectory_frames},
          {"measures_rows", r.measures_rows},
          {"final_csv", final_table(r)},
          {"page", text_or_null(r.page)}}},
        {"peak_memory_bytes", r.peak_memory},
        {"missing", r.missing},
        {"warnings", r.warnings}};
    if (r.part) document["part"] = part_of(*r.part);
    const std::string text = text_of(document);
    try {
        replace_file(path, text);
    } catch (const RunError&) {
        if (!overwrite(path, text)) throw;
        return;
    }
    if (r.status == RunStatus::running || r.status == RunStatus::interrupted) reserve_room(path);
}

namespace {

std::string text_in(const std::filesystem::path& path, const char* key) {
    std::ifstream file = read_plain(path);
    const Json document = Json::parse(file, nullptr, false);
    if (!document.is_object() || !document.contains(key) || !document[key].is_string()) return {};
    return document[key].get<std::string>();
}

}  // namespace

std::string scene_in_run_json(const std::filesystem::path& path) {
    return text_in(path, "scene");
}

std::string status_in_run_json(const std::filesystem::path& path) {
    return text_in(path, "status");
}

bool lacks_only_page(const std::filesystem::path& path) {
    std::ifstream file = read_plain(path);
    const Json document = Json::parse(file, nullptr, false);
    return document.is_object() && document.contains("missing") &&
           document["missing"] == Json::array({kPageIsMissing});
}

void complete_run_json(const std::filesystem::path& path, const std::string& page) {
    std::ifstream file = read_plain(path);
    Json document = Json::parse(file, nullptr, false);
    if (!document.is_object() || !document["written"].is_object())
        throw RunError(fmt::format("{}: cannot be read", path.string()));
    document["status"] = to_string(RunStatus::complete);
    document["exit_status"] = 0;
    document["written"]["page"] = text_or_null(page);
    document["missing"] = Json::array();
    replace_file(path, text_of(document));
}

std::vector<std::string> panels_in_run_json(const std::filesystem::path& path) {
    std::ifstream file = read_plain(path);
    const Json document = Json::parse(file, nullptr, false);
    std::vector<std::string> panels;
    if (!document.is_object() || !document.contains("panels")) return panels;
    for (const Json& panel : document["panels"])
        if (panel.is_string()) panels.push_back(panel.get<std::string>());
    return panels;
}

std::vector<AcceptedKey> accepted_in_run_json(const std::filesystem::path& path) {
    std::ifstream file = read_plain(path);
    const Json document = Json::parse(file, nullptr, false);
    std::vector<AcceptedKey> keys;
    if (!document.is_object() || !document.contains("accepted")) return keys;
    const auto words = [](const Json& one, const char* name) {
        return one.contains(name) && one[name].is_string() ? one[name].get<std::string>() : "";
    };
    for (const Json& one : document["accepted"])
        if (one.is_object() && one.contains("step") && one["step"].is_number_integer())
            keys.push_back(
                {one["step"].get<std::int64_t>(), words(one, "key"), words(one, "then"), words(one, "now")});
    return keys;
}

namespace {

std::string text_at(const Json& object, const char* key) {
    return object.contains(key) && object[key].is_string() ? object[key].get<std::string>() : std::string();
}

// The count under a key, or -1 where there is none or it is negative.
std::int64_t count_at(const Json& object, const char* key) {
    return object.contains(key) && object[key].is_number_unsigned() ? object[key].get<std::int64_t>() : -1;
}

bool lies_in(std::int64_t first, std::int64_t count, std::int64_t all) {
    return first >= 0 && count > 0 && all >= count && first <= all - count;
}

bool makes_sense(const DrawnPart& part) {
    return part.number >= 1 && part.number <= part.of &&
           lies_in(part.first_picture, part.pictures, part.all_pictures) &&
           lies_in(part.first_frame, part.frames, part.all_frames) && part.frames >= part.pictures &&
           part.rate > 0 && part.rate <= 1e6 && part.file.find('/') == std::string::npos && part.file != "..";
}

void read_part(const Json& from, DrawnPart& part) {
    constexpr std::int64_t most_parts = 1'000'000;
    const std::int64_t number = count_at(from, "number"), of = count_at(from, "of");
    if (number > most_parts || of > most_parts) return;
    part.number = static_cast<int>(number);
    part.of = static_cast<int>(of);
    part.first_picture = count_at(from, "first_picture");
    part.pictures = count_at(from, "pictures");
    part.all_pictures = count_at(from, "all_pictures");
    part.first_frame = count_at(from, "first_frame");
    part.frames = count_at(from, "frames");
    part.all_frames = count_at(from, "all_frames");
    part.rate = from.contains("rate") && from["rate"].is_number() ? from["rate"].get<double>() : 0;
    part.file = text_at(from, "file");
    part.format = text_at(from, "format");
    part.run = text_at(from, "run");
    part.settings = text_at(from, "settings");
    part.checksum = text_at(from, "film_xxh64");
}

}  // namespace

std::optional<PartJson> part_in_run_json(const std::filesystem::path& path) {
    std::ifstream file = read_plain(path);
    const Json document = Json::parse(file, nullptr, false);
    if (!document.is_object() || !document.contains("part") || !document["part"].is_object())
        return std::nullopt;
    PartJson part;
    read_part(document["part"], part);
    if (!makes_sense(part)) return std::nullopt;
    part.status = text_at(document, "status");
    part.encoder = text_at(document, "encoder");
    part.gl = text_at(document, "gl");
    if (document.contains("program") && document["program"].is_object())
        part.program = fmt::format("grainreel {} ({})", text_at(document["program"], "version"),
                                   text_at(document["program"], "commit"));
    return part;
}

std::string checksum_of_file(const std::filesystem::path& path) {
    std::ifstream file = read_plain(path);
    const std::unique_ptr<XXH64_state_t, XXH_errorcode (*)(XXH64_state_t*)> state(XXH64_createState(),
                                                                                  XXH64_freeState);
    XXH64_reset(state.get(), 0);
    std::array<char, 1 << 16> bytes{};
    while (file.read(bytes.data(), bytes.size()), file.gcount() > 0)
        XXH64_update(state.get(), bytes.data(), static_cast<std::size_t>(file.gcount()));
    if (!file.eof()) throw RunError(fmt::format("{}: cannot be read", path.string()));
    return fmt::format("{:016x}", XXH64_digest(state.get()));
}

}  // namespace grainreel
