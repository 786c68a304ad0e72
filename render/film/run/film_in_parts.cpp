#include "render/film/run/film_in_parts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <xxhash.h>
#include <algorithm>
#include <string>
#include <system_error>
#include <utility>

#include "engine/base/counted.hpp"
#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/base/text.hpp"
#include "engine/files/run_json.hpp"
#include "engine/scene/scene_file.hpp"
#include "render/film/codec/film_writer.hpp"
#include "render/film/codec/join_films.hpp"
#include "render/scene/film.hpp"
#include "render/scene/shown_values.hpp"

namespace grainreel {

namespace {

std::string option_of(const PartsWanted& wanted) {
    return wanted.number > 0 ? fmt::format("--part {}/{}", wanted.number, wanted.of)
                             : fmt::format("--parts {}", wanted.of);
}

void check(const PartsWanted& wanted, const FilmRequest& request, const FilmedScene& scene,
           std::size_t pictures) {
    const std::string option = option_of(wanted);
    const std::size_t most = pictures / least_pictures_of_part;
    if (most < static_cast<std::size_t>(wanted.of))
        throw UserError("{}: the film has {} picture{}, and a part needs {}; {}", option, pictures,
                        pictures == 1 ? "" : "s", least_pictures_of_part,
                        most > 1 ? fmt::format("{} parts at most", most) : "draw it in one go");
    if (wanted.number > 0 && request.to_stdout)
        throw UserError(option + ": parts are joined from their folders; leave out --out -, or the part");
    if (!request.film) return;
    if (wanted.number > 0 && scene.film.format == FilmFormat::y4m)
        throw UserError(option +
                        ": films in y4m are not joined; choose another --format, or draw it in one go");
    if (scene.film.format == FilmFormat::gif)
        throw UserError(option +
                        ": a GIF is made as a whole, with the colours of all its pictures; choose another "
                        "--format, or draw it in one go");
    if (scene.film.max_size)
        throw UserError(option +
                        ": film.max_size is a cap on the whole film, which is encoded as a whole to keep it; "
                        "add --max-size none, or draw it in one go");
}

// A checksum of texts and numbers that are added one after another.
class Digest {
  public:
    void add(const std::string& text) { sum_ = XXH64(text.data(), text.size(), sum_ + text.size()); }
    template <class Value>
    void add(const std::vector<Value>& values) {
        sum_ = XXH64(values.data(), values.size() * sizeof(Value), sum_ + values.size());
    }
    std::string text() const { return fmt::format("{:016x}", sum_); }

  private:
    std::uint64_t sum_ = 0;
};

void add_grains(Digest& digest, const State& frame) {
    digest.add(frame.id);
    digest.add(frame.species);
    std::vector<double> numbers;
    for (std::size_t i = 0; i < frame.size(); ++i)
        for (const double number : {frame.position[i].x(), frame.position[i].y(), frame.position[i].z()})
            numbers.push_back(number);
    digest.add(numbers);
}

}  // namespace

FilmInParts::FilmInParts(const PartsWanted& wanted, const FilmRequest& request, const FilmedScene& scene,
                         std::vector<double> times)
    : times_(std::move(times)), wanted_(wanted), scene_(scene), film_(request.film) {
    check(wanted, request, scene, times_.size());
    parts_ = film_parts(scene.film, times_, wanted.of);
    if (is_part()) {
        here_ = parts_[static_cast<std::size_t>(wanted.number) - 1];
    } else {
        here_.pictures = static_cast<std::int64_t>(times_.size());
        here_.frames = parts_.back().first_frame + parts_.back().frames;
    }
}

std::int64_t FilmInParts::known_from() const {
    constexpr double room = 1.001;
    const FilmTrails& trails = scene_.film.shows.trails;
    std::int64_t first = here_.first_picture;
    if (!trails.wanted()) return first;
    const double from = times_[first] - room * trails.duration;
    while (first > 0 && times_[static_cast<std::size_t>(first) - 1] >= from) --first;
    return first;
}

FilmExtent FilmInParts::extent() const {
    FilmExtent extent;
    if (!is_part()) {
        for (std::size_t k = 1; k < parts_.size(); ++k) extent.groups.push_back(parts_[k].first_frame);
        return extent;
    }
    extent.earlier.assign(times_.begin(), times_.begin() + here_.first_picture);
    const std::int64_t poster = poster_picture(scene_.film, scene_.run.duration, times_);
    extent.poster = poster >= here_.first_picture && poster < here_.first_picture + here_.pictures;
    return extent;
}

std::string FilmInParts::folder_name() const {
    const std::size_t digits = std::to_string(wanted_.of).size();
    return is_part() ? fmt::format("-part-{:0{}}", wanted_.number, digits) : "-render";
}

std::vector<std::string> FilmInParts::warnings() const {
    if (!is_part() || !film_ || scene_.film.sheet[0] == 0) return {};
    return {"film.sheet: a contact sheet shows all of a film, and is left out of its parts"};
}

DrawnPart FilmInParts::record() const {
    DrawnPart record;
    record.number = wanted_.number;
    record.of = wanted_.of;
    record.first_picture = here_.first_picture;
    record.pictures = here_.pictures;
    record.all_pictures = static_cast<std::int64_t>(times_.size());
    record.first_frame = here_.first_frame;
    record.frames = here_.frames;
    record.all_frames = parts_.back().first_frame + parts_.back().frames;
    record.rate = scene_.film.rate;
    if (film_) record.file = film_file_name(scene_.film.format);
    record.format = word_of(scene_.film.format, film_format_words);
    return record;
}

std::string checksum_of_run(const StateArchive& frames, const std::string& scene) {
    Digest digest;
    digest.add(scene);
    for (const State& moment : frames.moments())
        digest.add(std::vector<double>{static_cast<double>(moment.step), moment.time});
    add_grains(digest, frames.first_whole());
    try {
        add_grains(digest, frames.grains(frames.moments().size() - 1));
    } catch (const UserError&) {
        digest.add("damaged");
    }
    return digest.text();
}

std::string checksum_of_settings(const FilmedScene& scene, const std::vector<Due>& shots,
                                 const std::vector<std::string>& captions) {
    FilmedScene drawn = scene;
    drawn.run.threads = 0;  // the number of threads depends on the machine
    tell_engine(drawn);
    Digest digest;
    digest.add(written_scene(drawn));
    for (const std::string& caption : captions) digest.add(caption);
    std::vector<std::int64_t> numbers;
    for (const Due& shot : shots) {
        numbers.push_back(shot.step);
        numbers.push_back(shot.segment);
    }
    digest.add(numbers);
    return digest.text();
}

namespace {

namespace fs = std::filesystem;

struct Part {
    fs::path folder;
    RunJson run;
    DrawnPart record;
    // The program that drew it: "grainreel 0.9 (3f2a...)".
    std::string program() const { return fmt::format("grainreel {} ({})", run.version, run.commit); }
    std::string name() const { return folder.string(); }
};

Part read_part(const fs::path& folder) {
    if (!is_folder(folder))
        throw UserError("{}: is no folder; give the folders that render --part has made", folder.string());
    const ReadRunJson read = read_run_json(folder / "run.json");
    if (!read.record.part)
        throw UserError(
            "{}: has no run.json of a part of a film; give the folders that render --part has made",
            folder.string());
    if (read.status != "complete")
        throw UserError("{}: is not complete (its run.json says {}); wait for it, or draw it again",
                        folder.string(), excerpt(read.status));
    if (read.record.part->file.empty())
        throw UserError(
            "{}: has no film; its pictures in frames/ have the numbers that they have in one go, and need no "
            "joining",
            folder.string());
    return {folder, read.record, *read.record.part};
}

// Sorts the parts by number. Throws when they are not all the parts of one film, each once.
std::vector<Part> in_order(std::vector<Part> parts) {
    const auto number = [](const Part& part) { return part.record.number; };
    std::stable_sort(parts.begin(), parts.end(),
                     [&](const Part& a, const Part& b) { return number(a) < number(b); });
    const int of = parts.front().record.of;
    for (const Part& part : parts)
        if (part.record.of != of)
            throw UserError("{}: is one of {} parts, and {} one of {}", part.name(), part.record.of,
                            parts.front().name(), of);
    for (std::size_t k = 1; k < parts.size(); ++k)
        if (number(parts[k]) == number(parts[k - 1]))
            throw UserError("{}: is part {} of {}, as {} is; leave one of the two out", parts[k].name(),
                            number(parts[k]), of, parts[k - 1].name());
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
    throw UserError("part{} {}{} of {}: missing; draw {} by render --part, or name {} too",
                    missing.size() > 1 ? "s" : "", fmt::join(missing, ", "),
                    more > 0 ? fmt::format(" and {} more", more) : "", of, missing.size() > 1 ? "them" : "it",
                    missing.size() > 1 ? "them" : "it");
}

void check_alike(const Part& part, const Part& first) {
    const DrawnPart &a = part.record, &b = first.record;
    const auto differs = [&](const std::string& how) {
        throw UserError("{}: {} {}; draw one of the two again", part.name(), how, first.name());
    };
    if (a.run != b.run) differs("is of another run, or of another stretch of it, than");
    if (a.format != b.format || a.rate != b.rate || a.settings != b.settings)
        differs("was drawn with other settings (their run.json have the commands) than");
    if (part.run.encoder != first.run.encoder)
        differs(fmt::format("was encoded otherwise ({}) than", excerpt(part.run.encoder)));
    if (part.program() != first.program())
        differs(fmt::format("was drawn by {}, unlike", excerpt(part.program())));
    if (a.all_frames != b.all_frames) differs("is of a film with another number of pictures than");
}

void check_together(const std::vector<Part>& parts, Listener& listener) {
    std::int64_t frames = 0;
    for (const Part& part : parts) {
        check_alike(part, parts.front());
        if (part.record.first_frame != frames || part.record.all_frames < frames + part.record.frames)
            throw UserError(
                "{}: does not begin where the part before it ends (its run.json was altered); draw it again",
                part.name());
        frames += part.record.frames;
    }
    if (frames != parts.back().record.all_frames)
        throw UserError(
            "{}: does not end where the film does (its run.json was altered); draw "
            "it again",
            parts.back().name());
    for (const Part& part : parts)
        if (part.run.gl != parts.front().run.gl) {
            listener.warning(fmt::format("{} was drawn with {}, and {} with {}: shades may differ",
                                         part.name(), excerpt(part.run.gl), parts.front().name(),
                                         excerpt(parts.front().run.gl)));
            break;
        }
}

// Throws when the film would be written into a part: parts stay as they are.
void check_outside(const JoinRequest& request) {
    std::error_code error;
    const fs::path folder = folder_around(request.out);
    for (const fs::path& part : request.parts)
        if (fs::equivalent(folder, part, error))
            throw UserError("--out {}: lies in the part {}; choose another place", request.out.string(),
                            part.string());
}

FilmFormat format_of(const Part& part) {
    for (const auto& [word, format] : film_format_words)
        if (word == part.record.format && format != FilmFormat::png &&
            film_file_name(format) == part.record.file)
            return format;
    throw UserError("{}: its run.json names no film that can be joined ({}, {})", part.name(),
                    excerpt(part.record.file), excerpt(part.record.format));
}

}  // namespace

void check_joined(const fs::path& out, FilmFormat film, bool force) {
    const Codec& codec = codec_of(film);
    const std::string option = fmt::format("--out {}", out.string()),
                      end = fmt::format(".{}", codec.extension);
    std::error_code error;
    check_folder_around(out, option);
    if (is_folder(out)) throw UserError("{}: is a folder; name a file that ends in {}", option, end);
    if (out.extension() != end)
        throw UserError("{}: the parts are {}; name a file that ends in {}", option, codec.words, end);
    if (fs::exists(fs::symlink_status(out, error)) && !force)
        throw UserError("{}: exists already; choose another name, or --force to replace it", option);
}

bool join_parts(const JoinRequest& request, Listener& listener) {
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
            throw UserError("{}: is missing; draw that part again", file.string());
        if (checksum_of_file(file) != part.record.checksum)
            throw UserError(
                "{}: was cut off or changed (its checksum is not that of run.json beside it); draw "
                "that part again",
                file.string());
        if (listener.stop_signal() != 0) return false;
        pieces.push_back({file, file.string(), part.record.frames});
    }
    const auto go_on = [&] { return listener.stop_signal() == 0; };
    const JoinEnd end = join_films(pieces, codec_of(format), parts.front().record.rate, request.out, go_on);
    if (end == JoinEnd::stopped) return false;
    listener.info(fmt::format("wrote {}: {} of {}", request.out.string(),
                              counted(parts.front().record.all_frames, "frame"),
                              counted(parts.size(), "part")));
    return true;
}

}  // namespace grainreel
