// The verb `report`: a finished run as one page for a browser.
#include <filesystem>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <CLI/App.hpp>

#include "engine/base/error.hpp"
#include "engine/scene/text/data_size.hpp"
#include "render/cli/check/print_plan.hpp"
#include "render/cli/options/option_groups.hpp"
#include "render/cli/report/result.hpp"
#include "render/cli/verbs/verb.hpp"
#include "render/report/report.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;

// Its frames come with the contacts that the run kept.
Assignments with_contacts() {
    return {{"film.force_chains=true", "report"}};
}

std::optional<PlannedScene> planned(const Scene& scene) {
    try {
        Plan plan = make_plan(scene);
        PlanWords words = plan_words(scene, plan);
        return PlannedScene{std::move(plan), std::move(words.lines), std::move(words.contacts)};
    } catch (const UserError&) {
        return std::nullopt;  // a scene of an earlier version, which this one would not run
    }
}

class Report final : public Verb {
  public:
    Report()
        : Verb(
              "report", "Make a page of a finished run: film, charts and the bed in three dimensions",
              "The page is one file. It needs no network and no server; any browser of today opens it. An "
              "earlier "
              "page is replaced, and nothing else in RUN is changed. The file that was made goes to stdout.\n"
              "Exit status: 0 done, 1 the page could not be written, 2 a mistake in the options or the "
              "run.") {}

    void add_options(CLI::App& parser) override {
        parser.add_option("RUN", run_, "Folder of a run, with its scene.toml and trajectory.nc")
            ->required()
            ->type_name("DIR");
        parser.add_option("--out", out_, "The page's file [report.html in RUN]")->type_name("FILE");
        add_reporting(parser, report);
    }

    int run(Reporter& reporter) override {
        std::error_code ignored;
        const bool contacts = fs::exists(run_ / "contacts.nc", ignored);
        RecordedRun record(run_, contacts ? with_contacts() : Assignments());
        record.leave_out_damaged();
        const fs::path out = out_.empty() ? record.folder() / "report.html" : out_;
        check_out(out);
        const ReportMade made = write_report(record, contacts, planned(record.scene()), out);
        for (const std::string& line : made.news) reporter.warning(line);
        reporter.info(fmt::format("wrote {} ({}); open it in a browser", made.file.string(),
                                  data_size_text(static_cast<double>(made.bytes))));
        print_result(made.file.string() + "\n");
        return 0;
    }

    bool ends_in_good_order() const override { return false; }

  private:
    // A page that is no page of ours is not written over.
    static void check_out(const fs::path& out) {
        check_typed("--out", out.string());
        std::error_code ignored;
        const fs::path folder = out.parent_path();
        if (!folder.empty() && !fs::is_directory(folder, ignored))
            throw UserError(fmt::format("{}: there is no such folder; make it first", folder.string()));
        if (fs::is_directory(out, ignored))
            throw UserError(fmt::format("--out {}: is a folder; name a file, as in {}", out.string(),
                                        (out / "report.html").string()));
        if (out.extension() != ".html")
            throw UserError(fmt::format("--out {}: a page's name ends in .html", out.string()));
    }

    fs::path run_, out_;
};

}  // namespace

std::unique_ptr<Verb> report_verb() {
    return std::make_unique<Report>();
}

}  // namespace grainreel
