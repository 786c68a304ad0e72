#include "engine/files/drawn_part.hpp"

#include <xxhash.h>

#include <array>
#include <fstream>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"

namespace grainreel {

namespace {

using Json = nlohmann::json;

std::string text_at(const Json& object, const char* key) {
    return object.contains(key) && object[key].is_string() ? object[key].get<std::string>() : std::string();
}

// -1 for what is no whole number, or is less than 0.
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

std::optional<PartRecord> part_in_run_json(const std::filesystem::path& path) {
    std::ifstream file = read_plain(path);
    const Json document = Json::parse(file, nullptr, false);
    if (!document.is_object() || !document.contains("part") || !document["part"].is_object())
        return std::nullopt;
    PartRecord part;
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
