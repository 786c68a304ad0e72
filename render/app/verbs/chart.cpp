// The verb `chart` makes tables and pictures of experiments on the program's own methods.
#include <algorithm>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/lab/chart/chart.hpp"
#include "engine/lab/chart/gnuplot.hpp"
#include "render/app/messages/reporter.hpp"
#include "render/app/options/cli.hpp"
#include "render/app/options/option_groups.hpp"
#include "render/app/verbs/verbs.hpp"

namespace grainreel {
namespace {

class ChartVerb final : public Verb {
  public:
    ChartVerb()
        : Verb("chart", "Measure errors, costs and limits of the methods",
               "The folder gets tables (CSV) and the charts that gnuplot makes of them (SVG, PNG). After "
               "Ctrl-C the\n"
               "same command goes on.\n"
               "Exit status: 0 done, 1 a measurement failed, 2 a mistake in the options, 130 Ctrl-C, 143 "
               "SIGTERM.") {}

    void add_options(CLI::App& parser) override {
        const Choices all(charts());
        parser.add_option("CHART", name_, all.about)
            ->required()
            ->check(CLI::IsMember(all.names))
            ->type_name("WHICH");
        add_out_folder(
            parser, out_,
            "Folder of the tables and pictures; a chart that was stopped there goes on [output/WHICH]");
        parser.add_flag("--quick", quick_, "Measure less exactly, in a few minutes");
        add_reporting(parser, report);
    }

    int run(Reporter& reporter) override {
        const auto chart =
            std::find_if(charts().begin(), charts().end(), [&](const Chart& c) { return c.name == name_; });
        GRAINREEL_CHECK(chart != charts().end());
        ChartRequest request;
        request.folder = out_.value_or(output_base() / (name_ + (quick_ ? "-quick" : "")));
        request.quick = quick_;
        if (std::error_code failure; !std::filesystem::create_directories(request.folder, failure) && failure)
            throw UserError("{}: cannot be made ({}); give another --out", request.folder.string(),
                            failure.message());
        const bool whole = chart->run(request, ShareWatcher(reporter, Progress::Stage::charting));
        reporter.clear();
        if (!whole) {
            reporter.info("stopped; the same command goes on");
            return signal_base + stop_signal();
        }
        draw_pictures(*chart, request.folder, reporter);
        print_exact(request.folder.string() + "\n");
        return 0;
    }

  private:
    static void draw_pictures(const Chart& chart, const std::filesystem::path& folder, Reporter& reporter) {
        const std::string commands = chart.name + ".gp";
        replace_file(folder / commands, chart.drawing());
        if (!run_gnuplot(folder, commands))
            reporter.warning(
                fmt::format("gnuplot is missing or failed, so there are tables but no pictures; install "
                            "gnuplot-nox and run it on {} in the folder",
                            commands));
    }

    std::string name_;  // name of the chart
    std::optional<std::filesystem::path> out_;
    bool quick_ = false;
};

}  // namespace

std::unique_ptr<Verb> chart_verb() {
    return std::make_unique<ChartVerb>();
}

}  // namespace grainreel
