#include "engine/files/run_json.hpp"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>
#include <xxhash.h>
#include <array>
#include <chrono>
#include <concepts>
#include <ctime>
#include <fstream>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

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

Json deepest(const DeepestContact& contact) {
    return {{"share", contact.share},
            {"time_s", contact.time},
            {"step", contact.step},
            {"grain", contact.grain},
            {"species", contact.species},
            {"other", contact.other},
            {"remedy", text_or_null(contact.remedy)}};
}

Json engine(const RunJson& r) {
    return {{"seed", r.seed},
            {"grains", r.grains},
            {"step_s", r.step},
            {"steps", r.steps},
            {"steps_planned", r.steps_planned},
            {"simulated_s", r.simulated},
            {"settled_s", r.settled ? Json(*r.settled) : Json(nullptr)},
            {"vector", r.vector},
            {"particle_steps_per_second", r.particle_steps_per_second},
            {"largest_overlap", r.deepest ? deepest(*r.deepest) : Json(nullptr)},
            {"state_hash", r.state_hash ? Json(fmt::format("{:016x}", *r.state_hash)) : Json(nullptr)}};
}

Json drawn(const RunJson& r) {
    Json runs = Json::array();
    for (const DrawnFrom& run : r.drawn)
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
        {"captions", r.captions},
        {"title", text_or_null(r.title)},
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

void complete_run_json(const std::filesystem::path& path, const std::string& page) {
    const std::string fault = read_run_json(path).fault;
    std::ifstream file = read_plain(path);
    Json document = Json::parse(file, nullptr, false);
    if (!fault.empty() || !document.is_object() || !document["written"].is_object())
        throw RunError("{}: cannot be read", path.string());
    document["status"] = to_string(RunStatus::complete);
    document["exit_status"] = 0;
    document["written"]["page"] = text_or_null(page);
    document["missing"] = Json::array();
    replace_file(path, text_of(document));
}

std::string checksum_of_file(const std::filesystem::path& path) {
    std::ifstream file = read_plain(path);
    const std::unique_ptr<XXH64_state_t, XXH_errorcode (*)(XXH64_state_t*)> state(XXH64_createState(),
                                                                                  XXH64_freeState);
    XXH64_reset(state.get(), 0);
    std::array<char, 1 << 16> bytes{};
    while (file.read(bytes.data(), bytes.size()), file.gcount() > 0)
        XXH64_update(state.get(), bytes.data(), static_cast<std::size_t>(file.gcount()));
    if (!file.eof()) throw RunError("{}: cannot be read", path.string());
    return fmt::format("{:016x}", XXH64_digest(state.get()));
}

}  // namespace grainreel
