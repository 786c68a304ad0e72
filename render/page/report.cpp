#include "render/page/report.hpp"

#include <algorithm>
#include <deque>

#include <fmt/format.h>

#include "engine/base/plain_file.hpp"
#include "render/page/embed.hpp"
#include "render/page/facts/run_names.hpp"
#include "render/page/run_part.hpp"
#include "render/page/shown_film.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;
using Texts = std::vector<std::pair<std::string_view, std::string>>;

constexpr std::size_t most_film_bytes = 12'000'000;  // bytes of the films of all runs together
constexpr double films_share = 0.7;  // share of the progress: making a film smaller takes most of the time

class Page {
  public:
    Page(const std::vector<PageRun>& runs, const fs::path& out, const PageProgress& progress,
         const PageOfAll& of_all)
        : out_(out), of_all_(of_all), progress_(progress) {
        const bool alone = runs.size() == 1;
        const std::size_t most_film =
            std::min(kMostFilmOnPage, most_film_bytes / (runs.size() + (of_all.film.empty() ? 0 : 1)));
        most_film_ = most_film;
        std::vector<RunToName> to_name;
        for (const PageRun& run : runs) to_name.push_back({run.folder, run.scene, run.name});
        const std::vector<std::string> names = names_of_runs(to_name);
        for (std::size_t k = 0; k < runs.size(); ++k)
            parts_.emplace_back(runs[k], names[k], alone ? "" : fmt::format("-{}", k), most_film);
    }

    ReportMade write() {
        read();
        const std::string page =
            filled(say().in(page_files().page), parts_.size() == 1 ? alone() : side_by_side());
        replace_file(out_, page);
        ReportMade made{out_, page.size(), {}};
        for (const RunPart& part : parts_)
            for (const std::string& line : part.news())
                made.news.push_back(parts_.size() == 1
                                        ? line
                                        : fmt::format("{}: {}", part.folder().filename().string(), line));
        if (page.size() > kMostPageBytes)
            made.news.push_back(fmt::format(
                "the page has {} bytes, more than it should: a single moment of the bed takes that",
                page.size()));
        return made;
    }

  private:
    // A page of several runs has the language of the first.
    const PageWords& say() const { return parts_.front().words(); }

    // Whether the page lies in the folder of the run, with its files.
    bool lies_beside(const RunPart& part) const {
        std::error_code ignored;
        const fs::path folder = folder_around(out_);
        return parts_.size() == 1 && fs::equivalent(folder, part.folder(), ignored);
    }

    void read() {
        const double each = 1.0 / static_cast<double>(parts_.size());
        std::size_t taken = script().size();
        double done = 0;
        if (!of_all_.film.empty())
            all_.emplace(parts_.front().scene(), of_all_.film, most_film_, kNoPageProgress);
        if (all_) taken += all_->taken();
        for (RunPart& part : parts_) {
            part.read([&](double share) { return progress_(films_share * (done + each * share)); });
            taken += part.taken();
            done += each;
        }
        // Room of each run in bytes before base64, which makes four characters of three bytes. Even if no
        // room is left, the page gets one moment of a run.
        const std::size_t room =
            taken >= kMostPageBytes ? 1 : (kMostPageBytes - taken) / parts_.size() / 4 * 3;
        done = 0;
        for (RunPart& part : parts_) {
            part.read_bed(room, [&](double share) {
                return progress_(films_share + (1 - films_share) * (done + each * share));
            });
            done += each;
        }
    }

    Texts alone() const {
        const RunPart& part = parts_.front();
        const bool beside = lies_beside(part);
        const PageFiles& files = page_files();
        const std::string body =
            filled(say().in(files.body),
                   {{"film", part.film(beside)},
                    {"bed", part.bed()},
                    {"fields", part.fields(2)},
                    {"charts", filled(say().in(files.charts), {{"about", part.charts_about()}})}}) +
            outflow();
        return frame({{"title", part.title()},
                      {"body_class", ""},
                      {"lead", part.lead()},
                      {"body", body},
                      {"words", part.chapters(out_, beside)},
                      {"facts", json_in_html(say().with_words(part.facts()))},
                      {"blobs", part.bed_blob() + part.late_blobs()}});
    }

    Texts side_by_side() const {
        const bool beside = false;
        const PageFiles& files = page_files();
        std::string title, columns, words, beds, late;
        for (std::size_t k = 0; k < parts_.size(); ++k) {
            const RunPart& part = parts_[k];
            title += (k == 0 ? "" : ", ") + html_text(part.name());
            columns +=
                filled(say().in(files.variant), {{"n", fmt::format("-{}", k)},
                                                 {"name", html_text(part.name())},
                                                 {"folder", folder_line(part)},
                                                 {"lead", part.lead()},
                                                 {"film", all_ && !part.has_film() ? "" : part.film(beside)},
                                                 {"bed", part.bed()},
                                                 {"fields", part.fields(3)}});
            words +=
                fmt::format("<details><summary><h2>{}</h2></summary>\n{}</details>\n",
                            html_text(say()("{1}: in words", {part.name()})), part.chapters(out_, beside));
            beds += part.bed_blob();
            late += part.late_blobs();
        }
        const std::string charts = fmt::format(
            "<section aria-labelledby=\"charts-title\">\n<h2 id=\"charts-title\">{}</h2>\n{}"
            "</section>\n",
            html_text(say()("Measures, on one time axis")), filled(say().in(files.charts), {{"about", ""}}));
        return frame(
            {{"title", common_title() + title},
             {"body_class", " class=\"several\""},
             {"lead", fmt::format("<p class=\"lead\">{}</p>\n",
                                  html_text(say()("{1} runs side by side, at the same time of each run.",
                                                  {std::to_string(parts_.size())})))},
             {"body", fmt::format("{}<div class=\"variants\">\n{}</div>\n{}{}{}", film_of_all(), columns,
                                  charts, outflow(), differences())},
             {"words", words},
             {"facts", json_in_html(say().with_words(facts()))},
             {"blobs", beds + late + (all_ ? blob("film-bytes-all", all_->bytes()) : "")}});
    }

    // The film that shows all runs side by side.
    std::string film_of_all() const {
        if (!all_) return "";
        std::string about;
        for (const RunPart& part : parts_) about += (about.empty() ? "" : ", ") + part.name();
        std::error_code ignored;
        const fs::path folder = folder_around(out_);
        return fmt::format(
            "<section aria-labelledby=\"film-title\">\n<h2 id=\"film-title\">{}</h2>\n{}<p "
            "id=\"film-says-all\" class=\"faint no-print\"></p>\n</section>\n",
            html_text(say()("The film of all of them")),
            all_->html(about, say(), "-all", fs::equivalent(folder, of_all_.film, ignored)));
    }

    // A line with the folder's name, if the run has another name.
    std::string folder_line(const RunPart& part) const {
        const std::string folder = part.folder().filename().string();
        return part.name() == folder
                   ? ""
                   : fmt::format("<p class=\"faint\">{}</p>\n", html_text(say()("Folder {1}", {folder})));
    }

    // The title of the film of all, or the one that all runs share, before the names of the runs.
    std::string common_title() const {
        std::string title = of_all_.title;
        if (title.empty()) title = parts_.front().scene().title;
        const bool common = !of_all_.title.empty() ||
                            std::all_of(parts_.begin(), parts_.end(),
                                        [&](const RunPart& part) { return part.scene().title == title; });
        if (title.empty() || !common) return "";
        const bool ended = std::string_view("?!.:").find(title.back()) != std::string_view::npos;
        return html_text(title) + (ended ? " " : ": ");
    }

    std::string outflow() const {
        std::vector<RunToName> runs;
        for (const RunPart& part : parts_) runs.push_back({part.folder(), part.scene(), part.name()});
        return outflow_html(runs, say());
    }

    std::string differences() const {
        std::vector<NamedScene> scenes;
        for (const RunPart& part : parts_) scenes.push_back({part.name(), part.folder() / "scene.toml"});
        return differences_html(scenes, say());
    }

    // The facts of all runs. Their time goes from the earliest beginning to the latest end.
    std::string facts() const {
        Span all = parts_.front().span();
        std::string runs;
        for (const RunPart& part : parts_) {
            const Span span = part.span();
            all = {std::min(all.from, span.from), std::max(all.to, span.to)};
            runs += (runs.empty() ? "" : ",") + part.facts();
        }
        return fmt::format(R"({{"begin":{},"end":{},"frequency":null,"film":{},"runs":[{}]}})", all.from,
                           all.to, all_ ? all_->facts() : "null", runs);
    }

    std::string script() const {
        return page_files().script(std::any_of(
            parts_.begin(), parts_.end(), [](const RunPart& part) { return !part.scene().meshes.empty(); }));
    }

    Texts frame(Texts texts) const {
        texts.emplace_back("style", std::string(page_files().style));
        texts.emplace_back("script", script());
        texts.emplace_back("live", "");
        texts.emplace_back("lang", say().code());
        return texts;
    }

    const fs::path out_;
    const PageOfAll of_all_;
    std::size_t most_film_ = kMostFilmOnPage;
    std::optional<ShownFilm> all_;  // the film that shows all runs
    const PageProgress& progress_;
    std::deque<RunPart> parts_;
};

}  // namespace

std::optional<ReportMade> write_report(const std::vector<PageRun>& runs, const fs::path& out,
                                       const PageProgress& progress, const PageOfAll& of_all) {
    try {
        return Page(runs, out, progress, of_all).write();
    } catch (const PageStopped&) {
        return std::nullopt;
    }
}

}  // namespace grainreel
