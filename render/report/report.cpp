#include "render/report/report.hpp"

#include <fmt/format.h>

#include "engine/base/text_file.hpp"
#include "engine/output/measures_csv.hpp"
#include "render/report/embed/base64.hpp"
#include "render/report/embed/html.hpp"
#include "render/report/embed/read_bytes.hpp"
#include "render/report/embed/zlib_pack.hpp"
#include "render/report/page_facts.hpp"
#include "render/report/page_files.hpp"
#include "render/report/page_parts.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_table_bytes = 2'000'000;  // of measures.csv, packed

// As an element that no browser runs or shows.
std::string blob(const char* id, const std::vector<std::uint8_t>& bytes) {
    if (bytes.empty()) return "";
    return fmt::format("<script type=\"application/octet-stream\" id=\"{}\">{}</script>\n", id,
                       base64(bytes));
}

std::vector<std::uint8_t> packed_table(const fs::path& file) {
    std::error_code error;
    if (!fs::exists(file, error)) return {};
    std::vector<std::uint8_t> packed = zlib_packed(read_bytes(file));
    if (packed.size() > most_table_bytes) packed.clear();
    return packed;
}

std::string charts_about(const MeasureTable* table, const PageMeasures& measures, bool whole_table) {
    if (table == nullptr || measures.rows.empty()) return "The run has no measures.";
    std::string text =
        whole_table ? "" : "The complete table is too long for this page; it lies in measures.csv. ";
    if (!whole_table && measures.rows.size() < table->rows())
        text +=
            fmt::format("Charts show {} of its {} rows, evenly spread.", measures.rows.size(), table->rows());
    return html_text(text);
}

// What of the page's bytes is left for the bed, before base64.
std::size_t room_for_bed(std::size_t rest) {
    constexpr std::size_t facts_and_margin = 400'000;
    const std::size_t taken = rest + facts_and_margin;
    return taken >= kMostPageBytes ? 1 : (kMostPageBytes - taken) / 4 * 3;
}

class Page {
  public:
    Page(RecordedRun& run, bool contacts, const std::optional<PlannedScene>& planned, const fs::path& out)
        : run_(run), contacts_(contacts), planned_(planned), out_(out), folder_(run.folder()) {}

    ReportMade write() {
        const Scene& scene = run_.scene();
        const RunFacts record = run_facts(folder_);
        const auto table = read_measures(folder_ / "measures.csv");
        const PageMeasures measures = table ? page_measures(scene, *table) : PageMeasures();
        const PageFilm film = page_film(scene, folder_);
        const FilmTimes times = times_of(film, record, table.get(), measures);
        std::string late = blob("measures-bytes", packed_table(folder_ / "measures.csv"));
        const bool whole_table = !late.empty();
        const std::string film_blob = blob("film-bytes", film.bytes);
        const std::string head = film_html(film, page_poster(folder_), times.why_not);
        const std::string chapters =
            chapters_html(scene, record, planned_, folder_, out_.filename().string());
        const std::string fixed = late + film_blob + head + chapters;
        const BedFrames bed =
            bed_frames(run_, contacts_, room_for_bed(fixed.size() + page_files().script.size()));
        const std::string facts =
            facts_json({scene, span_of(times), film, times, bed, table.get(), measures});
        const PageFiles& files = page_files();
        const std::string title = html_text(scene.title.empty() ? scene.name : scene.title);
        const std::string page = filled(
            files.page,
            {{"title", title},
             {"style", std::string(files.style)},
             {"lead", lead_html(scene, record)},
             {"film", head},
             {"bed", filled(files.bed, {{"about", bed_about(bed, scene)}})},
             {"charts", filled(files.charts, {{"about", charts_about(table.get(), measures, whole_table)}})},
             {"words", chapters},
             {"facts", json_in_html(facts)},
             {"script", std::string(files.script)},
             {"blobs", blob("bed-bytes", bed.packed) + late + film_blob}});
        replace_file(out_, page);
        return made(page.size(), film, times, bed);
    }

  private:
    FilmTimes times_of(const PageFilm& film, const RunFacts& record, const MeasureTable* table,
                       const PageMeasures& measures) const {
        if (film.bytes.empty() || !record.film_frames) return {};
        double first = run_.span().from;
        if (table != nullptr && measures.time < measures.columns.size() && table->rows() > 0)
            first = std::min(first, table->values(measures.time, 0, 1).front());
        return film_times(run_.scene(), *record.film_frames, first, record.status == "complete");
    }

    // Of the trajectory and the film.
    Span span_of(const FilmTimes& times) const {
        Span span = run_.span();
        if (!times.times.empty()) {
            span.from = std::min(span.from, times.times.front());
            span.to = std::max(span.to, times.times.back());
        }
        return span;
    }

    ReportMade made(std::size_t bytes, const PageFilm& film, const FilmTimes& times,
                    const BedFrames& bed) const {
        ReportMade result{out_, bytes, run_.news()};
        for (const std::string& note : {film.note, times.why_not})
            if (!note.empty()) result.news.push_back(note);
        if (bed.moments.size() < bed.all_moments)
            result.news.push_back(
                fmt::format("the page has {} of the trajectory's {} moments; there is no room for "
                            "the others",
                            bed.moments.size(), bed.all_moments));
        if (bed.grains < bed.all_grains)
            result.news.push_back(
                fmt::format("the page has {} of {} grains, those nearest to the middle of the depth",
                            bed.grains, bed.all_grains));
        if (bytes > kMostPageBytes)
            result.news.push_back(
                fmt::format("the page has {} bytes, more than it should: a single moment of the bed "
                            "takes that",
                            bytes));
        return result;
    }

    RecordedRun& run_;
    const bool contacts_;
    const std::optional<PlannedScene>& planned_;
    const fs::path out_, folder_;
};

}  // namespace

ReportMade write_report(RecordedRun& run, bool contacts, const std::optional<PlannedScene>& planned,
                        const fs::path& out) {
    return Page(run, contacts, planned, out).write();
}

}  // namespace grainreel
