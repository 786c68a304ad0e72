#include "render/film/run/join_parts.hpp"

#include <algorithm>
#include <string>
#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/base/error.hpp"
#include "engine/base/text.hpp"
#include "engine/files/run_json.hpp"
#include "render/film/codec/film_writer.hpp"
#include "render/film/codec/join_films.hpp"
#include "render/scene/keys/words.hpp"

namespace grainreel {

namespace {

namespace fs = std::filesystem;

struct Part {
    fs::path folder;
    PartRecord record;
    std::string name() const { return folder.string(); }
};

Part read_part(const fs::path& folder) {
    std::error_code error;
    if (!fs::is_directory(folder, error))
        throw UserError(
            fmt::format("{}: is no folder; give the folders that render --part has made", folder.string()));
    const std::optional<PartRecord> record = part_in_run_json(folder / "run.json");
    if (!record)
        throw UserError(fmt::format(
            "{}: has no run.json of a part of a film; give the folders that render --part has made",
            folder.string()));
    if (record->status != "complete")
        throw UserError(
            fmt::format("{}: is not complete (its run.json says {}); wait for it, or draw it again",
                        folder.string(), excerpt(record->status)));
    if (record->file.empty())
        throw UserError(fmt::format(
            "{}: has no film; its pictures in frames/ have the numbers that they have in one go, and need no "
            "joining",
            folder.string()));
    return {folder, *record};
}

// The parts by number. Throws where they are not each of one film's once.
std::vector<Part> in_order(std::vector<Part> parts) {
    const auto number = [](const Part& part) { return part.record.number; };
    std::stable_sort(parts.begin(), parts.end(),
                     [&](const Part& a, const Part& b) { return number(a) < number(b); });
    const int of = parts.front().record.of;
    for (const Part& part : parts)
        if (part.record.of != of)
            throw UserError(fmt::format("{}: is one of {} parts, and {} one of {}", part.name(),
                                        part.record.of, parts.front().name(), of));
    for (std::size_t k = 1; k < parts.size(); ++k)
        if (number(parts[k]) == number(parts[k - 1]))
            throw UserError(fmt::format("{}: is part {} of {}, as {} is; leave one of the two out",
                                        parts[k].name(), number(parts[k]), of, parts[k - 1].name()));
    constexpr std::size_t most_named = 8;
    std::vector<int> missing;
    auto next = parts.begin();
    for (int k = 1; k <= of; ++k) {
        if (next != parts.end() && number(*next) == k)
            ++next;
        else
            missing.push_back(k);
    }
    if (missing.empty()) return parts;
    const std::size_t more = missing.size() - std::min(missing.size(), most_named);
    missing.resize(missing.size() - more);
    throw UserError(fmt::format("part{} {}{} of {}: missing; draw {} by render --part, or name {} too",
                                missing.size() > 1 ? "s" : "", fmt::join(missing, ", "),
                                more > 0 ? fmt::format(" and {} more", more) : "", of,
                                missing.size() > 1 ? "them" : "it", missing.size() > 1 ? "them" : "it"));
}

void check_alike(const Part& part, const Part& first) {
    const PartRecord &a = part.record, &b = first.record;
    const auto differs = [&](const std::string& how) {
        throw UserError(fmt::format("{}: {} {}; draw one of the two again", part.name(), how, first.name()));
    };
    if (a.run != b.run) differs("is of another run, or of another stretch of it, than");
    if (a.format != b.format || a.rate != b.rate || a.settings != b.settings)
        differs("was drawn with other settings (their run.json have the commands) than");
    if (a.encoder != b.encoder) differs(fmt::format("was encoded otherwise ({}) than", excerpt(a.encoder)));
    if (a.program != b.program) differs(fmt::format("was drawn by {}, unlike", excerpt(a.program)));
    if (a.all_frames != b.all_frames) differs("is of a film with another number of pictures than");
}

void check_together(const std::vector<Part>& parts, RunListener& listener) {
    std::int64_t frames = 0;
    for (const Part& part : parts) {
        check_alike(part, parts.front());
        if (part.record.first_frame != frames || part.record.all_frames < frames + part.record.frames)
            throw UserError(fmt::format(
                "{}: does not begin where the part before it ends (its run.json was altered); draw it again",
                part.name()));
        frames += part.record.frames;
    }
    if (frames != parts.back().record.all_frames)
        throw UserError(
            fmt::format("{}: does not end where the film does (its run.json was altered); draw "
                        "it again",
                        parts.back().name()));
    for (const Part& part : parts)
        if (part.record.gl != parts.front().record.gl) {
            listener.warning(fmt::format("{} was drawn with {}, and {} with {}: shades may differ",
                                         part.name(), excerpt(part.record.gl), parts.front().name(),
                                         excerpt(parts.front().record.gl)));
            break;
        }
}

// A part stays as it is.
void check_outside(const JoinRequest& request) {
    std::error_code error;
    const fs::path folder = request.out.has_parent_path() ? request.out.parent_path() : fs::path(".");
    for (const fs::path& part : request.parts)
        if (fs::equivalent(folder, part, error))
            throw UserError(fmt::format("--out {}: lies in the part {}; choose another place",
                                        request.out.string(), part.string()));
}

FilmFormat format_of(const Part& part) {
    for (const auto& [word, format] : film_format_words)
        if (word == part.record.format && format != FilmFormat::png &&
            film_file_name(format) == part.record.file)
            return format;
    throw UserError(fmt::format("{}: its run.json names no film that can be joined ({}, {})", part.name(),
                                excerpt(part.record.file), excerpt(part.record.format)));
}

}  // namespace

void check_joined(const fs::path& out, FilmFormat film, bool force) {
    const Codec& codec = codec_of(film);
    const std::string option = fmt::format("--out {}", out.string()),
                      end = fmt::format(".{}", codec.extension);
    std::error_code error;
    const fs::path folder = out.has_parent_path() ? out.parent_path() : fs::path(".");
    if (!fs::is_directory(folder, error))
        throw UserError(fmt::format("{}: there is no folder {}; make it first", option, folder.string()));
    if (fs::is_directory(out, error))
        throw UserError(fmt::format("{}: is a folder; name a file that ends in {}", option, end));
    if (out.extension() != end)
        throw UserError(
            fmt::format("{}: the parts are {}; name a file that ends in {}", option, codec.words, end));
    if (fs::exists(fs::symlink_status(out, error)) && !force)
        throw UserError(
            fmt::format("{}: exists already; choose another name, or --force to replace it", option));
}

bool join_parts(const JoinRequest& request, RunListener& listener) {
    std::vector<Part> parts;
    for (const fs::path& folder : request.parts) parts.push_back(read_part(folder));
    if (parts.empty()) throw UserError("no part is given; give the folders that render --part has made");
    parts = in_order(std::move(parts));
    check_together(parts, listener);
    const FilmFormat format = format_of(parts.front());
    check_joined(request.out, format, request.force);
    check_outside(request);
    std::vector<FilmPiece> pieces;
    for (const Part& part : parts) {
        const fs::path file = part.folder / part.record.file;
        if (!fs::is_regular_file(file))
            throw UserError(fmt::format("{}: is missing; draw that part again", file.string()));
        if (checksum_of_file(file) != part.record.checksum)
            throw UserError(fmt::format(
                "{}: was cut off or changed (its checksum is not that of run.json beside it); draw "
                "that part again",
                file.string()));
        if (listener.stop_signal() != 0) return false;
        pieces.push_back({file, file.string(), part.record.frames});
    }
    const auto go_on = [&] { return listener.stop_signal() == 0; };
    const JoinEnd end = join_films(pieces, codec_of(format), parts.front().record.rate, request.out, go_on);
    if (end == JoinEnd::stopped) return false;
    listener.info(fmt::format("wrote {}: {} frames of {} parts", request.out.string(),
                              parts.front().record.all_frames, parts.size()));
    return true;
}

}  // namespace grainreel
