#include "render/page/report.hpp"

#include <algorithm>
#include <deque>

#include <fmt/format.h>

#include "engine/base/plain_file.hpp"
#include "render/page/embed.hpp"
#include "render/page/facts/run_names.hpp"
#include "render/page/run_part.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;
using Texts = std::vector<std::pair<std::string_view, std::string>>;

constexpr std::size_t most_film_bytes = 12'000'000;  // bytes of the films of all runs together
constexpr double films_share = 0.7;  // share of the progress: making a film smaller takes most of the time

class Page {
  public:
    Page(const std::vector<PageRun>& runs, const fs::path& out, const PageProgress& progress)
        : out_(out), progress_(progress) {
        const bool alone = runs.size() == 1;
        const std::size_t most_film = std::min(kMostFilmOnPage, most_film_bytes / runs.size());
        std::vector<RunToName> to_name;
        for (const PageRun& run : runs) to_name.push_back({run.folder, run.scene});
        const std::vector<std::string> names = names_of_runs(to_name);
        for (std::size_t k = 0; k < runs.size(); ++k)
            parts_.emplace_back(runs[k], names[k], alone ? "" : fmt::format("-{}", k), most_film);
    }

    ReportMade write() {
        read();
        const std::string page = filled(page_files().page, parts_.size() == 1 ? alone() : side_by_side());
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
    // Whether the page lies in the folder of the run, with its files.
    bool lies_beside(const RunPart& part) const {
        std::error_code ignored;
        const fs::path folder = out_.has_parent_path() ? out_.parent_path() : fs::path(".");
        return parts_.size() == 1 && fs::equivalent(folder, part.folder(), ignored);
    }

    void read() {
        const double each = 1.0 / static_cast<double>(parts_.size());
        std::size_t taken = script().size();
        double done = 0;
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
            filled(files.body, {{"film", part.film(beside)},
                                {"bed", part.bed()},
                                {"fields", part.fields(2)},
                                {"charts", filled(files.charts, {{"about", part.charts_about()}})}});
        return frame({{"title", part.title()},
                      {"body_class", ""},
                      {"lead", part.lead()},
                      {"body", body},
                      {"words", part.chapters(out_, beside)},
                      {"facts", json_in_html(part.facts())},
                      {"blobs", part.bed_blob() + part.late_blobs()}});
    }

    Texts side_by_side() const {
        const bool beside = false;
        const PageFiles& files = page_files();
        std::string title, columns, words, beds, late;
        for (std::size_t k = 0; k < parts_.size(); ++k) {
            const RunPart& part = parts_[k];
            title += (k == 0 ? "" : ", ") + html_text(part.name());
            columns += filled(files.variant, {{"n", fmt::format("-{}", k)},
                                              {"name", html_text(part.name())},
                                              {"folder", folder_line(part)},
                                              {"lead", part.lead()},
                                              {"film", part.film(beside)},
                                              {"bed", part.bed()},
                                              {"fields", part.fields(3)}});
            words += fmt::format("<details><summary><h2>{}: in words</h2></summary>\n{}</details>\n",
                                 html_text(part.name()), part.chapters(out_, beside));
            beds += part.bed_blob();
            late += part.late_blobs();
        }
        const std::string charts = fmt::format(
            "<section aria-labelledby=\"charts-title\">\n<h2 id=\"charts-title\">Measures, on one time "
            "axis</h2>\n{}"
            "</section>\n",
            filled(files.charts, {{"about", ""}}));
        return frame(
            {{"title", common_title() + title},
             {"body_class", " class=\"several\""},
             {"lead",
              fmt::format("<p class=\"lead\">{} runs side by side, at the same time of each run.</p>\n",
                          parts_.size())},
             {"body",
              fmt::format("<div class=\"variants\">\n{}</div>\n{}{}", columns, charts, differences())},
             {"words", words},
             {"facts", json_in_html(facts())},
             {"blobs", beds + late}});
    }

    // A line with the folder's name, if the run has another name.
    static std::string folder_line(const RunPart& part) {
        const std::string folder = part.folder().filename().string();
        return part.name() == folder ? ""
                                     : fmt::format("<p class=\"faint\">Folder {}</p>\n", html_text(folder));
    }

    // The title that all runs share, "Brazil nut: ", if their names only tell what differs.
    std::string common_title() const {
        const std::string& title = parts_.front().scene().title;
        const bool common =
            !title.empty() && std::all_of(parts_.begin(), parts_.end(),
                                          [&](const RunPart& part) { return part.scene().title == title; });
        return common ? html_text(title) + ": " : "";
    }

    std::string differences() const {
        std::vector<NamedScene> scenes;
        for (const RunPart& part : parts_) scenes.push_back({part.name(), part.folder() / "scene.toml"});
        return differences_html(scenes);
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
        return fmt::format(R"({{"begin":{},"end":{},"frequency":null,"runs":[{}]}})", all.from, all.to, runs);
    }

    std::string script() const {
        return page_files().script(std::any_of(
            parts_.begin(), parts_.end(), [](const RunPart& part) { return !part.scene().meshes.empty(); }));
    }

    Texts frame(Texts texts) const {
        texts.emplace_back("style", std::string(page_files().style));
        texts.emplace_back("script", script());
        texts.emplace_back("live", "");
        return texts;
    }

    const fs::path out_;
    const PageProgress& progress_;
    std::deque<RunPart> parts_;
};

}  // namespace

std::optional<ReportMade> write_report(const std::vector<PageRun>& runs, const fs::path& out,
                                       const PageProgress& progress) {
    try {
        return Page(runs, out, progress).write();
    } catch (const PageStopped&) {
        return std::nullopt;
    }
}

}  // namespace grainreel
