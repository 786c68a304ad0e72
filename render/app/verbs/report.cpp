// The verb `report` makes one page for a browser from finished runs. This file also has the functions by
// which all verbs make the page of a run.
#include "render/app/verbs/report.hpp"

#include <fmt/format.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/counted.hpp"
#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/base/system/own_folder.hpp"
#include "engine/files/frames/open_frames.hpp"
#include "engine/files/frames/saved_scene.hpp"
#include "engine/files/run_json.hpp"
#include "engine/files/run_names.hpp"
#include "engine/scene/text/units.hpp"
#include "render/app/check/print_plan.hpp"
#include "render/app/messages/reporter.hpp"
#include "render/app/messages/version.hpp"
#include "render/app/options/cli.hpp"
#include "render/app/options/option_groups.hpp"
#include "render/app/options/run_to_read.hpp"
#include "render/app/print/run_charts.hpp"
#include "render/app/verbs/verbs.hpp"
#include "render/film/run/redraw_job.hpp"
#include "render/film/sources/recorded_scene.hpp"
#include "render/film/sources/stored_shots.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;

// Whether the run kept moments. A damaged file counts as kept: reading it tells what is wrong.
bool kept_moments(const fs::path& folder) {
    if (!is_there(folder / "trajectory.nc")) return false;
    try {
        const auto frames = open_frames(folder / "trajectory.nc", {.format = "trajectory"});
        return !frames->moments().empty() || !frames->damage().empty();
    } catch (const UserError&) {
        return true;
    }
}

}  // namespace

std::optional<PlannedScene> planned_scene(const FilmedScene& scene) {
    try {
        Plan plan = plan_with_film(scene);
        PlanWords words = plan_words(scene, plan);
        return PlannedScene{std::move(plan), std::move(words.lines), std::move(words.contacts)};
    } catch (const UserError&) {
        return std::nullopt;  // the scene is of an earlier version, and this version would not run it
    }
}

std::optional<ReportMade> make_page_of(const std::vector<fs::path>& runs, const fs::path& out, Damage damage,
                                       const PageProgress& progress, const BesideRuns& beside) {
    std::vector<PageRun> all;
    for (const fs::path& run : runs) {
        PageRun& one = all.emplace_back();
        one.folder = folder_of_run(run);
        if (kept_moments(one.folder)) {
            FilmedRun filmed = open_filmed(one.folder, {});
            if (damage == Damage::looked_for) filmed.run->check_all();
            one.scene = std::move(filmed.scene);
            one.run = std::move(filmed.run);
        } else {
            one.scene = scene_of_run(one.folder, {});
        }
        one.planned = planned_scene(one.scene);
        if (all.size() <= beside.films.size()) one.film_folder = beside.films[all.size() - 1];
        if (all.size() <= beside.names.size()) one.name = beside.names[all.size() - 1];
    }
    return write_report(all, out.empty() ? all.front().folder / kPageName : out, progress, beside.of_all);
}

ComparedRuns runs_of_comparison(const fs::path& folder) {
    ComparedRuns runs;
    if (!is_plain(folder / "run.json") || is_there(folder / "scene.toml")) return runs;
    const RunJson record = read_run_json(folder / "run.json").record;
    for (const std::string& panel : record.panels)
        runs.folders.push_back(folder / panel);  // a path from the root stays as it is
    runs.captions = record.captions;
    runs.title = record.title;
    return runs;
}

PageMaker page_of_comparison() {
    return
        [](const fs::path& folder, const std::function<bool(double)>& go_on) -> std::optional<std::string> {
            const ComparedRuns runs = runs_of_comparison(folder);
            if (!make_page_of(runs.folders, folder / kPageName, Damage::none, go_on,
                              {{folder, runs.title}, {}, runs.captions}))
                return std::nullopt;
            return kPageName;
        };
}

PageMaker page_of_ended_run() {
    return
        [](const fs::path& folder, const std::function<bool(double)>& go_on) -> std::optional<std::string> {
            if (!make_page_of({folder}, folder / kPageName, Damage::none, go_on)) return std::nullopt;
            return kPageName;
        };
}

namespace {

// Passes on how far the film of a page is, and what the user should see of it.
class OnlyProgress final : public SilentListener {
  public:
    explicit OnlyProgress(Reporter& reporter) : reporter_(reporter) {}
    void warning(const std::string& text) override { reporter_.warning(text); }
    void progress(const Progress& progress) override { reporter_.progress(progress); }
    int stop_signal() const override { return reporter_.stop_signal(); }
    bool in_a_hurry() const override { return reporter_.in_a_hurry(); }

  private:
    Reporter& reporter_;
};

class Report final : public Verb {
  public:
    Report()
        : Verb("report", "Make a page of a run: film, charts and the bed in three dimensions",
               "The page is one file. It needs no network and no server; any present browser opens it. An "
               "earlier page is\n"
               "replaced, and nothing else in RUN is changed. The name of the page goes to stdout.\n"
               "Exit status: 0 done, 1 the page could not be written, 2 a mistake in the options or the "
               "run.") {}

    void add_options(CLI::App& parser) override {
        parser
            .add_option("RUN", runs_,
                        "Folder of a run, complete or not, or files of another program; several runs stand "
                        "side by side\n"
                        "on one time axis")
            ->required()
            ->type_name("DIR ...");
        parser
            .add_option("--out", out_,
                        "File of the page [report.html in RUN; for several runs side_by_side.html]")
            ->type_name("FILE")
            ->check(not_empty());
        CLI::Option* charts = add_paper(parser, paper_,
                                        "Write charts for print into this folder, in place of the page: "
                                        "pictures, tables and the\n"
                                        "gnuplot commands that draw them");
        charts->excludes(parser.get_option("--out"));
        parser
            .add_option("--measures", measures_,
                        "With --charts: columns of measures.csv, with commas, or all [those with which the "
                        "page begins]")
            ->delimiter(',')
            ->needs(charts)
            ->type_name("NAME,...");
        parser.add_flag("--no-film", no_film_, "Draw no film of files of another program");
        add_reading(parser, reading_);
        add_reporting(parser, report);
    }

    int run(Reporter& reporter) override {
        take_comparison();
        if (runs_.size() > most_runs)
            throw UserError("report: {} runs do not fit side by side; give {} at most", runs_.size(),
                            most_runs);
        check_paper(paper_);
        if (!out_.empty()) check_out(out_);
        if (runs_.size() > 1 && out_.empty()) out_ = "side_by_side.html";
        std::vector<bool> imported;
        for (fs::path& run : runs_) {
            const RunToRead read = run_to_read(run, reading_, reporter);
            imported.push_back(read.imported);
            if (read.imported && out_.empty())
                out_ = read.beside / (read.folder.filename().string() + "-report.html");
            run = read.folder;
        }
        if (paper_.folder) return draw_charts(reporter);
        if (!out_.empty()) check_out(out_);
        const std::unique_ptr<ScratchFolder> scratch = draw_films(imported, reporter);
        if (reporter.stop_signal() != 0) return signal_base + reporter.stop_signal();
        const ShareWatcher watcher(reporter, Progress::Stage::paging);
        const ReportMade made = *make_page_of(
            runs_, out_, Damage::looked_for, [&](double done) { return watcher("", done), true; }, beside_);
        for (const std::string& line : made.news) reporter.warning(line);
        reporter.info(fmt::format("wrote {} ({}); open it in a browser", made.file.string(),
                                  data_size_text(static_cast<double>(made.bytes))));
        print_exact(made.file.string() + "\n");
        return 0;
    }

    bool ends_in_good_order() const override { return false; }

  private:
    // A folder of `compare` stands for the runs that it shows, and has their page.
    void take_comparison() {
        if (runs_.size() != 1) return;
        const fs::path folder = runs_.front();
        ComparedRuns shown = runs_of_comparison(folder);
        if (shown.folders.empty()) return;
        for (const fs::path& run : shown.folders)
            if (!is_there(run / "scene.toml"))
                throw UserError("{}: shows the run {}, which is no longer there", folder.string(),
                                run.string());
        runs_ = std::move(shown.folders);
        beside_.of_all = {folder, shown.title};
        beside_.names = std::move(shown.captions);
        if (out_.empty() && !paper_.folder) out_ = folder / kPageName;
    }

    // Runs of other programs have no film, so one is drawn for the page. It is gone with the folder that is
    // returned.
    std::unique_ptr<ScratchFolder> draw_films(const std::vector<bool>& imported, Reporter& reporter) {
        std::unique_ptr<ScratchFolder> scratch;
        beside_.films.resize(runs_.size());
        for (std::size_t k = 0; k < runs_.size() && !no_film_ && reporter.stop_signal() == 0; ++k) {
            if (!imported[k]) continue;
            if (!scratch) scratch = std::make_unique<ScratchFolder>("film-of-page");
            FilmRequest request;
            request.command = command;
            request.program = program_info();
            request.out = scratch->path() / std::to_string(k);
            RenderRequest what;
            what.run = runs_[k];
            what.every = 1;
            OnlyProgress listener(reporter);
            StoredShots source(what.run, {}, what.replay);
            if (RedrawJob(request, what, listener, source).run().exit_status == 0)
                beside_.films[k] = *request.out;
        }
        return scratch;
    }

    int draw_charts(Reporter& reporter) const {
        const std::vector<fs::path> files =
            draw_run_charts(runs_, beside_.names, measures_, paper_.paper, *paper_.folder);
        reporter.info(fmt::format("wrote {} of charts, {:g} mm wide", counted(files.size(), "file"),
                                  paper_.paper.width_mm));
        print_exact(paper_.folder->string() + "\n");
        return 0;
    }

    // Refuses a folder, a file in a folder that is not there, a name that does not end in .html, and a page
    // that another program made, so that a slip of the user overwrites only pages of runs.
    static void check_out(const fs::path& out) {
        check_typed("--out", out.string());
        check_folder_around(out, "--out " + out.string());
        if (is_folder(out))
            throw UserError("--out {}: is a folder; name a file, as in {}", out.string(),
                            (out / kPageName).string());
        if (out.extension() != ".html")
            throw UserError("--out {}: a page's name ends in .html", out.string());
        if (is_there(out) && !is_page(out))
            throw UserError(
                "--out {}: exists already and is no page of this program; choose another "
                "name, or remove it",
                out.string());
    }

    // Whether the file's first lines name this program as what made it (page.html).
    static bool is_page(const fs::path& file) {
        std::string head(512, '\0');
        std::ifstream in = read_plain(file);
        in.read(head.data(), std::ssize(head));
        return head.find(R"(<meta name="generator" content="grainreel">)") != std::string::npos;
    }

    static constexpr std::size_t most_runs = 6;
    std::vector<fs::path> runs_;
    ReadingOptions reading_;
    fs::path out_;
    PaperOptions paper_;
    BesideRuns beside_;
    bool no_film_ = false;
    std::vector<std::string> measures_;
};

}  // namespace

std::unique_ptr<Verb> report_verb() {
    return std::make_unique<Report>();
}

}  // namespace grainreel
