#include "render/page/run_part.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/base/lists.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/files/measures_csv.hpp"
#include "engine/files/run_names.hpp"
#include "engine/run/stored/kept_list.hpp"
#include "render/film/sampling/film_frames.hpp"
#include "render/page/bed/film_colours.hpp"
#include "render/page/embed.hpp"
#include "render/page/facts/methods.hpp"
#include "render/page/page_parts.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_table_bytes = 2'000'000;  // bytes of measures.csv, packed

// If the run kept contacts at all moments, the page gets the pairs of some of them besides the key moments:
// of at most this number of moments, with at most this number of pairs in all, estimated from the grains.
constexpr std::size_t most_chosen_keys = 40, most_chosen_pairs = 500'000, pairs_a_grain = 3;

// The packed table; empty when it is too long or cannot be read.
std::vector<std::uint8_t> packed_table(const fs::path& file) {
    try {
        std::vector<std::uint8_t> packed = zlib_packed(read_bytes(file));
        if (packed.size() > most_table_bytes) packed.clear();
        return packed;
    } catch (const RunError&) {
        return {};
    }
}

// The key moments of the run, and some more when the run kept contacts at all moments.
std::vector<std::size_t> key_moments_of(const KeptList& all) {
    std::vector<std::size_t> known, keys;
    // Whether the contacts of a moment are whole is seen when they are read.
    for (std::size_t k = 0; k < all.moments().size(); ++k)
        if (all.place_of(k).key || (all.place_of(k).trajectory && all.supply().contacts)) known.push_back(k);
    const std::size_t most =
        std::min(most_chosen_keys,
                 most_chosen_pairs / pairs_a_grain / std::max<std::size_t>(1, all.first_whole().size()));
    for (std::size_t k = 0; k < known.size(); ++k)
        if (all.place_of(known[k]).key || k * most / known.size() != (k + 1) * most / known.size())
            keys.push_back(known[k]);
    return keys;
}

Span span_of(const StoredRun* run) {
    return run ? Span{run->from(), run->to()} : Span{0, 0};
}

// What the page lacks, because a file of moments beside the trajectory is damaged or of another run.
std::vector<std::string> news_of(const KeptList& all) {
    std::vector<std::string> news;
    for (const KeptList::Fault& fault : all.faults_of_film())
        news.push_back(fmt::format("{}; {} not on the page", fault.what,
                                   fault.whole ? "its moments are" : "this moment is"));
    for (const KeptList::Fault& fault : all.faults_of_keys())
        news.push_back(fmt::format("{}; the forces of {}key moments are not on the page", fault.what,
                                   fault.whole ? "" : "the last "));
    return news;
}

}  // namespace

RunPart::RunPart(const PageRun& run, std::string name, std::string n, std::size_t most_film)
    : run_(run),
      name_(std::move(name)),
      n_(std::move(n)),
      most_film_(most_film),
      say_(run.scene.film.wording) {}

void RunPart::read(const PageProgress& progress) {
    const fs::path& folder = run_.folder;
    run_json_ = record_of_page(folder);
    read_table(folder / "measures.csv");
    film_ = page_film(scene(), film_folder(), film_frames(), progress, most_film_);
    poster_ = page_poster(film_folder());
    times_ = film_times_of();
    fields_ = page_fields(scene(), folder);
    lead_ = lead_html(scene(), say_, run_of());
    if (run_of() == RunOf::us) lead_ += end_html(scene(), run_json_, kept_span().to, say_);
    if (table_ && table_fault_.empty())
        late_blobs_ = blob("measures-bytes" + n_, packed_table(folder / "measures.csv"));
    whole_table_ = !late_blobs_.empty();
    late_blobs_ += blob("fields-bytes" + n_, fields_.packed);
    late_blobs_ += blob("film-bytes" + n_, film_.bytes);
}

void RunPart::read_table(const fs::path& file) {
    MeasuresFile read = read_measures_file(file);
    const std::string name = file.string();
    const std::int64_t rows = read.table ? static_cast<std::int64_t>(read.table->rows()) : 0;
    // A run that failed before its first row has no such file.
    if (!read.table && !is_there(file) && run_json_.fault.empty() && run_json_.record.measures_rows == 0)
        return;
    if (!read.table)
        no_charts_ = fmt::format("{}: {}", name, is_there(file) ? "is empty" : "is missing");
    else if (!contains(read.table->columns(), "time_s"))
        no_charts_ = fmt::format("{}:1: lacks the column time_s", name);
    else if (!read.fault.empty())
        table_fault_ = read.fault;
    else if (run_json_.status == "complete" && rows < run_json_.record.measures_rows)
        table_fault_ = fmt::format("{}: has {} of the {} rows that the run wrote", name, rows,
                                   run_json_.record.measures_rows);
    if (!no_charts_.empty()) return;
    table_ = std::move(read.table);
    measures_ = page_measures(scene(), *table_);
}

std::size_t RunPart::taken() const {
    const std::size_t words_and_facts = 400'000;
    return late_blobs_.size() + poster_.size() / 3 * 4 + words_and_facts;
}

void RunPart::read_bed(std::size_t most_bytes, const PageProgress& progress) {
    if (!run_.run) return;
    constexpr std::size_t share_of_meshes = 4;
    meshes_ = page_meshes(scene(), most_bytes / share_of_meshes);
    most_bytes -= meshes_.packed.size();
    const double start = times_.times.empty() ? run_.run->from() : times_.times.front();
    const auto coloured = [&](const StateArchive& moments) {
        return film_has_scale(scene())
                   ? std::make_unique<FilmColours>(scene(), moments, run_.run->clock(), start)
                   : nullptr;
    };
    try {
        const bool with_keys = true;
        const KeptList all(*run_.run, run_.run->known_scene(), run_.run->clock(), with_keys);
        const std::unique_ptr<FilmColours> film = coloured(all);
        PageContacts contacts;
        contacts.film = film.get();
        contacts.touches = [&all](std::size_t index) { return all.touches(index); };
        contacts.keys = key_moments_of(all);
        bed_news_ = news_of(all);
        bed_ = page_bed(all, most_bytes, progress, contacts);
    } catch (const UserError& problem) {
        // A frame in a file beside the trajectory is damaged, so only the trajectory is used.
        bed_news_.push_back(
            fmt::format("{}; the page has the moments of trajectory.nc alone", problem.what()));
        const std::unique_ptr<FilmColours> film = coloured(*run_.run);
        PageContacts contacts;
        contacts.film = film.get();
        bed_ = page_bed(*run_.run, most_bytes, progress, contacts);
    }
}

std::string RunPart::title() const {
    return html_text(scene().title.empty() ? scene().name : scene().title);
}

const std::filesystem::path& RunPart::film_folder() const {
    return run_.film_folder.empty() ? run_.folder : run_.film_folder;
}

std::optional<std::int64_t> RunPart::film_frames() const {
    return run_.film_folder.empty() ? run_json_.record.film_frames
                                    : read_run_json(run_.film_folder / "run.json").record.film_frames;
}

FilmTimes RunPart::film_times_of() {
    if (film_.bytes.empty() || !film_frames()) return {};
    if (auto kept = kept_film_times(film_folder(), *film_frames())) return *kept;
    table_of_film_is_odd_ = is_there(run_.folder / kFilmTimes);
    return film_times(scene(), *run_json_.record.film_frames, kept_span().from,
                      run_json_.status == "complete");
}

Span RunPart::kept_span() const {
    Span span = span_of(run_.run.get());
    if (!table_ || measures_.time >= measures_.columns.size() || table_->rows() == 0) return span;
    const std::vector<double> times = table_->values(measures_.time, 0, table_->rows());
    if (!run_.run) return {times.front(), times.back()};
    return {std::min(span.from, times.front()), std::max(span.to, times.back())};
}

Span RunPart::span() const {
    Span span = run_.run ? span_of(run_.run.get()) : kept_span();
    if (!times_.times.empty()) {
        span.from = std::min(span.from, times_.times.front());
        span.to = std::max(span.to, times_.times.back());
    }
    return span;
}

std::string RunPart::film(bool beside) const {
    return film_html(film_, poster_, times_.why_not, lead_text(scene(), say_, run_of()), say_, n_, beside);
}

std::string RunPart::bed() const {
    if (!run_.run) return fmt::format("<p>{}, so there is no bed to turn.</p>\n", no_moments());
    return filled(say_.in(page_files().bed), {{"about", bed_about(bed_, meshes_, scene(), say_)}, {"n", n_}});
}

std::string RunPart::fields(int level) const {
    if (!fields_.why_not.empty())
        return fmt::format("<p class=\"faint\">{}</p>\n", html_text(fields_.why_not));
    if (!fields_.present()) return "";
    std::string about = fmt::format(
        "Coarse-grained from the grains; each value is rounded to 1/254 of what the quantity goes through. "
        "fields.nc has all of them exactly.");
    if (scene().output.fields.grid == FieldOutput::Grid::xyz) about += " The map shows means over the depth.";
    if (fields_.records.size() < fields_.all_records)
        about += fmt::format(" Of its {} records these are {}, evenly spread.", fields_.all_records,
                             fields_.records.size());
    return filled(say_.in(page_files().fields), {{"n", n_},
                                                 {"level", std::to_string(level)},
                                                 {"about", html_text(about)},
                                                 {"english", say_.on_english()}});
}

// The line without the folder's path, which readers of the page do not know: "measures.csv:3: ...".
std::string RunPart::in_folder(const std::string& line) const {
    const std::string start = folder().string() + "/";
    return line.starts_with(start) ? line.substr(start.size()) : line;
}

std::string RunPart::charts_about() const {
    if (!no_charts_.empty())
        return html_text(fmt::format("The page has no charts: {}.", in_folder(no_charts_)));
    if (measures_.rows.empty()) return html_text(say_("The run has no measures."));
    if (!table_fault_.empty())
        return html_text(
            fmt::format("Charts end before the damage of the file: {}.", in_folder(table_fault_)));
    std::string text =
        whole_table_ ? "" : "The complete table is too long for this page; it lies in measures.csv. ";
    if (!whole_table_ && measures_.rows.size() < table_->rows())
        text += fmt::format("Charts show {} of its {} rows, evenly spread.", measures_.rows.size(),
                            table_->rows());
    return html_text(text);
}

std::string RunPart::chapters(const fs::path& page, bool on_page_of_its_own) const {
    return chapters_html(scene(), run_json_, run_.planned, run_.folder,
                         on_page_of_its_own ? page.filename().string() : "", say_, n_, run_of());
}

std::string RunPart::facts() const {
    return facts_json({name_, folder().filename().string(), scene(), span(), film_, times_, bed_, meshes_,
                       table_.get(), measures_, fields_});
}

std::string RunPart::bed_blob() const {
    return blob("meshes-bytes" + n_, meshes_.packed) + blob("bed-bytes" + n_, bed_.packed) +
           blob("forces-bytes" + n_, bed_.forces.packed);
}

std::string RunPart::late_blobs() const {
    return late_blobs_;
}

// A sentence that says why there is no trajectory.
std::string RunPart::no_moments() const {
    if (run_json_.record.trajectory_frames > 0)
        return "The trajectory.nc that the run wrote is no longer in its folder";
    return "The run kept no moment of its grains";
}

// Lines about files that are missing, although the scene or other files say that they were written.
std::vector<std::string> RunPart::lacking_files() const {
    std::vector<std::string> lines;
    const auto check = [&](const char* name, bool expected, const char* lost) {
        if (expected && !is_there(folder() / name))
            lines.push_back(fmt::format("{}: is missing; {}", (folder() / name).string(), lost));
    };
    const bool moments = run_.run != nullptr, film = run_json_.record.film_frames.value_or(0) > 0;
    check("contacts.nc", moments && scene().output.contacts, "the page has forces of key moments at most");
    check(kFilmMoments, moments && film && scene().output.film_moments.value_or(false),
          "the page has no moments of the film's pictures");
    check(kKeyMoments, moments && is_there(folder() / kKeyContacts), "the page has no forces of key moments");
    check("fields.nc", scene().output.fields.wanted(), "the page has no fields");
    check("poster.png", film, "the page has no picture before the film plays");
    if (film && poster_.empty() && is_there(folder() / "poster.png"))
        lines.push_back(fmt::format("{}: cannot be read; the page has no picture before the film plays",
                                    (folder() / "poster.png").string()));
    if (table_of_film_is_odd_)
        lines.push_back(
            fmt::format("{}: is not of this film; the page takes the moments of its frames from the scene",
                        (folder() / kFilmTimes).string()));
    return lines;
}

std::vector<std::string> RunPart::news() const {
    std::vector<std::string> news;
    if (run_.run) {
        news = run_.run->news();
        if (const auto lack = run_.run->lack_of(Part::contacts); lack && (lack->some || lack->damaged))
            news.push_back(lack->what + (lack->some ? "; the last moments are drawn without contacts"
                                                    : "; the page has forces of key moments at most"));
    } else if (run_json_.record.trajectory_frames > 0)
        news.push_back(no_moments() + "; the page has no bed");
    const auto add = [&](const std::string& line) {
        if (!line.empty()) news.push_back(line);
    };
    if (!run_json_.fault.empty() && run_of() == RunOf::us)
        add(run_json_.fault + "; how the run ended and what made it are not on the page");
    if (!no_charts_.empty()) add(no_charts_ + "; the page has no charts");
    if (!table_fault_.empty() && news.end() == std::find_if(news.begin(), news.end(), [&](const auto& line) {
                                     return line.starts_with(table_fault_);
                                 }))
        add(table_fault_ + "; charts show those, and the page does not hold the file");
    for (const std::string& line : lacking_files()) add(line);
    news.insert(news.end(), bed_news_.begin(), bed_news_.end());
    for (const std::string& note : {film_.note.in_english(), times_.why_not.in_english(), fields_.why_not})
        add(note);
    for (const std::string& note : meshes_.notes()) news.push_back("on the page " + note);
    if (bed_.moments.size() < bed_.all_moments)
        news.push_back(fmt::format("the page has {} of the run's {} moments; there is no room for the others",
                                   bed_.moments.size(), bed_.all_moments));
    if (bed_.grains < bed_.all_grains)
        news.push_back(fmt::format("the page has {} of {} grains, those nearest to the middle of the depth",
                                   bed_.grains, bed_.all_grains));
    return news;
}

}  // namespace grainreel
