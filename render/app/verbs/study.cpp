// The verb `study` runs one scene with many values of its keys, measures the runs, and draws charts.
#include <algorithm>
#include <cstdlib>
#include <memory>
#include <string_view>

#include <fmt/format.h>

#include "engine/base/counted.hpp"
#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/base/team.hpp"
#include "engine/base/text.hpp"
#include "engine/files/folder_lock.hpp"
#include "engine/run/driver/pace.hpp"
#include "engine/scene/text/units.hpp"
#include "render/app/check/check_cost.hpp"
#include "render/app/messages/reporter.hpp"
#include "render/app/options/cli.hpp"
#include "render/app/options/option_groups.hpp"
#include "render/app/study/file/members.hpp"
#include "render/app/study/file/read_study.hpp"
#include "render/app/study/file/shared_stiffness.hpp"
#include "render/app/study/members/child.hpp"
#include "render/app/study/members/runner.hpp"
#include "render/app/study/page.hpp"
#include "render/app/study/results/drawing.hpp"
#include "render/app/study/results/parameters.hpp"
#include "render/app/study/results/results.hpp"
#include "render/app/study/results/search.hpp"
#include "render/app/study/results/warnings.hpp"
#include "render/app/verbs/verbs.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {
namespace {

constexpr double table_interval = 5;  // s between two versions of study.csv while members run
constexpr std::size_t most_listed = 40;

class StudyVerb final : public Verb {
  public:
    StudyVerb()
        : Verb("study", "Run a scene with many values of its keys, and chart what is measured",
               "Each run of a study is a member. Members run side by side, one thread each. If the command "
               "was stopped, the\n"
               "same command goes on. The folder goes to stdout, everything else to stderr.\n"
               "Exit status: 0 all members are complete, 1 one has failed, 2 a mistake in the study, its "
               "scene\n"
               "or the options, 129 the terminal was closed (SIGHUP), 130 Ctrl-C, 143 SIGTERM.") {
        request_.jobs = usable_processors();
    }

    void add_options(CLI::App& parser) override {
        parser
            .add_option(
                "STUDY", file_,
                "The study, a TOML file, or the name of a shipped one; docs/guide/studies.md tells how to "
                "write one")
            ->required()
            ->type_name("FILE");
        add_out_folder(parser, out_,
                       "Folder of the study; a study that was stopped there goes on [output/ and its name]");
        parser
            .add_option("--jobs", request_.jobs,
                        "Members that run at a time [as many as there are processors]")
            ->check(CLI::Range(1, 4096))
            ->type_name("N");
        parser.add_option("--variant", variants_, "Run only this variant of the study; may be repeated")
            ->type_name("NAME")
            ->allow_extra_args(false);
        parser.add_flag("--films", request_.films,
                        "Make a film of each member; members without a film are run again");
        parser.add_flag("--retry", request_.retry, "Run failed members again");
        parser.add_flag_callback(
            "--no-posters", [this] { request_.posters = false; },
            "Leave out the pictures of the members' last frames");
        add_no_cache(parser, shortest_packing_);
        parser.add_flag("--yes", yes_, "Allow more than 10,000 members");
        add_ways(parser);
        CLI::Option* charts = add_paper(
            parser, paper_, "Write charts for print into this folder too; with --collect nothing is run");
        for (const char* other : {"--dry-run", "--print-commands"})
            charts->excludes(parser.get_option(other));
        add_reporting(parser, report);
    }

    int run(Reporter& reporter) override {
        check_paper(paper_);
        Study study = read_study(file_);
        count_members(study, yes_);
        stiffness_ = share_stiffness(study);
        // With GRAINREEL_PACKINGS=off members need no --no-cache, since they get the environment too.
        const char* const said = std::getenv("GRAINREEL_PACKINGS");
        request_.cache = shortest_packing_ || (said != nullptr && std::string_view(said) == "off");
        std::vector<std::vector<ReferencePoint>> references;
        for (const StudyChart& chart : study.charts)
            references.push_back(chart.reference ? read_reference(chart.reference_text, *chart.reference)
                                                 : std::vector<ReferencePoint>());
        folder_.path =
            std::filesystem::absolute(out_.value_or(output_base() / study.file.stem())).lexically_normal();
        check_folder();
        prepare(study);
        follow_search(study);
        if (dry_) return tell_plan(study);
        if (print_commands_) return tell_commands(study);
        return work(study, references, reporter);
    }

  private:
    // Makes the members of all settings, and reads what is there of them.
    void prepare(const Study& study) {
        estimate_ = std::make_unique<StudyEstimate>(request_.jobs, request_.films, dry_);
        EmptyColumns empty(study);
        parameters_ = StudyParameters();
        sharing_ = PackingSharing();
        members_ = make_members(study, [&](const FilmedScene& scene, const Plan& plan) {
            estimate_->add_setting(scene, plan);
            parameters_.add_setting(scene, plan);
            empty.add_setting(scene);
            if (shortest_packing_) sharing_.add_setting(scene, plan);
        });
        empty.check();
        check_series(study, members_);
        request_.wanted = members_of_variants(study, members_, variants_);
        results_.clear();
        request_.cost.clear();
        for (const Member& member : members_) {
            results_.push_back(read_result(folder_.member(member), study.measures, member.steps));
            request_.cost.push_back(estimate_->of(member).seconds);
        }
    }

    // Where all members of a search are complete, the next value is added, as long as that is so. Whether one
    // was added.
    bool follow_search(Study& study) {
        bool added = false;
        const auto complete = [](const MemberResult& result) {
            return result.status == MemberResult::Status::complete;
        };
        while (study.search && std::all_of(results_.begin(), results_.end(), complete)) {
            std::vector<TriedValue> tried;
            for (const Member& member : members_)
                if (member.seed_index == 0)
                    tried.push_back(
                        {study.variations[0].values[member.at[0]].number,
                         setting_summary(study, members_, results_, member.setting, study.search->measure)});
            const SearchStep step = next_step(tried, study.search->wanted, study.search->within);
            const Variation& key = study.variations[0];
            search_ = search_text(step, key.shown, key.unit, study.has_intervals());
            search_file_ =
                search_json(*study.search, step, key.key, key.unit, study.measures[study.search->measure]);
            study.search->found.reset();
            if (step.verdict != SearchStep::Verdict::unknown &&
                step.verdict != SearchStep::Verdict::not_in_range)
                study.search->found = {step.low, step.estimate, step.high};
            if (step.verdict != SearchStep::Verdict::go_on) break;
            study.try_value(step.next);
            prepare(study);
            added = true;
        }
        return added;
    }

    void add_ways(CLI::App& parser) {
        CLI::Option* dry = parser.add_flag("--dry-run", dry_,
                                           "Print the members, their cost and the disk space; run nothing");
        CLI::Option* print = parser.add_flag(
            "--print-commands", print_commands_,
            "Print a command for each member that must be run, for GNU parallel or Slurm; run nothing");
        CLI::Option* collect = parser.add_flag("--collect", request_.collect_only,
                                               "Run nothing; gather the results of those commands");
        dry->excludes(print)->excludes(collect);
        print->excludes(collect);
        for (const char* of_runs : {"--films", "--retry", "--jobs", "--no-cache"})
            collect->excludes(parser.get_option(of_runs));
    }

    // "1.5 to 4"; one value alone is no range.
    static std::string range_of(const Variation& variation) {
        const std::string &first = variation.values.front().words, &last = variation.values.back().words;
        return variation.values.size() == 1 ? first : first + " to " + last;
    }

    // Throws when the folder holds something, but no study.
    void check_folder() const {
        std::error_code none;
        const bool fresh = !is_there(folder_.path) || std::filesystem::is_empty(folder_.path, none);
        if (fresh || std::filesystem::is_directory(folder_.path / "members")) return;
        throw UserError("{}: holds something that is no study; give another --out", folder_.path.string());
    }

    std::vector<const Member*> pending() const {
        std::vector<const Member*> members;
        for (std::size_t m = 0; m < members_.size(); ++m)
            if (is_pending(m, results_[m], request_)) members.push_back(&members_[m]);
        return members;
    }

    int tell_plan(const Study& study) const {
        const StudyEstimate& estimate = *estimate_;
        const std::vector<const Member*> left = pending();
        std::size_t settings = 0;
        for (const Member& member : members_) settings = std::max(settings, member.setting + 1);
        // With variants the number of members is no product, since a variant may have seeds of its own.
        std::string reckoned = fmt::format("{} with their seeds", counted(settings, "setting"));
        if (!study.has_variants())
            reckoned =
                fmt::format("{} x {}", counted(settings, "setting"), counted(study.seed_count({}), "seed"));
        std::string text =
            fmt::format("study        {}: {}\nscene        {}\nfolder       {}\n", study.file.string(),
                        study.title, study.scene.string(), folder_.path.string());
        for (const Variation& variation : study.variations)
            text += variation.key == variant_axis
                        ? fmt::format("variants     {}\n", variant_names(variation))
                        : fmt::format("vary         {}: {}, {}\n", variation.key,
                                      counted(variation.values.size(), "value"), range_of(variation));
        text += fmt::format("members      {} = {}, {} of them to be run\n", members_.size(), reckoned,
                            left.size());
        if (const std::size_t longer = shorter_runs(members_, folder_).size(); longer > 0)
            text +=
                fmt::format("goes on      {} from shorter runs of the study\n", counted(longer, "member"));
        if (!stiffness_.empty()) text += fmt::format("stiffness    {}\n", stiffness_);
        if (study.search)
            text +=
                fmt::format("search       {} until {}; {}\n", study.variations[0].key, study.search->words,
                            search_.empty() ? "both ends are run first, then middles" : search_);
        if (const std::string packings = sharing_.text(); !packings.empty())
            text += fmt::format("packings     {}\n", packings);
        double bytes = 0, work = 0;
        for (const Member* member : left) {
            bytes += estimate.of(*member).bytes;
            work += estimate.of(*member).seconds;
        }
        text += fmt::format(
            "cost         {} of one processor, about {} with {} at a time\ndisk         about {}\n\n",
            duration_text(work), duration_text(estimate.wall_seconds(left)), request_.jobs,
            data_size_text(bytes));
        for (std::size_t i = 0; i < std::min(left.size(), most_listed); ++i)
            text += fmt::format("{:>10}   {}\n", duration_text(estimate.of(*left[i]).seconds),
                                member_text(study, *left[i]));
        if (left.size() > most_listed)
            text += fmt::format("             and {} more\n", left.size() - most_listed);
        print_result(text);
        return 0;
    }

    int tell_commands(const Study& study) const {
        make_study_folder(study, members_, folder_);
        for (const Member* member : pending()) {
            std::vector<std::string> words{own_program()};
            for (std::string& word : run_command(study, *member, folder_, request_.films, request_.cache))
                words.push_back(word);
            words.push_back("--quiet");
            print_exact(shell_words(words) + "\n");
        }
        return 0;
    }

    int work(Study& study, const std::vector<std::vector<ReferencePoint>>& references, Reporter& reporter) {
        make_study_folder(study, members_, folder_);
        const FolderLock lock = locked_folder();
        if (!stiffness_.empty()) reporter.info("stiffness: " + stiffness_);
        if (const std::string packings = sharing_.text(); !packings.empty())
            reporter.info("packings: " + packings);
        Stopwatch since_table;
        do {
            make_study_folder(study, members_, folder_);
            take_shorter_runs(reporter);
            run_members(study, members_, folder_, request_, results_, reporter, [&] {
                if (since_table.seconds() < table_interval) return;
                replace_file(folder_.path / "study.csv", study_table(study, members_, results_));
                since_table = Stopwatch();
            });
            reporter.clear();
        } while (reporter.stop_signal() == 0 && tell_search(follow_search(study), reporter));
        write_results(study, references, reporter);
        return tell_end(study, reporter);
    }

    // Runs of the study that were shorter become the beginnings of members.
    void take_shorter_runs(Reporter& reporter) {
        if (request_.collect_only || request_.films) return;
        std::size_t taken = 0;
        std::error_code failure;
        for (const ShorterRun& run : shorter_runs(members_, folder_)) {
            std::filesystem::rename(run.folder, folder_.member(members_[run.member]), failure);
            if (failure) continue;
            ++taken;
            results_[run.member].status = MemberResult::Status::incomplete;
        }
        if (taken > 0)
            reporter.info(fmt::format("{} from shorter runs", taken == 1
                                                                  ? "1 member goes on"
                                                                  : fmt::format("{} members go on", taken)));
    }

    // Tells where the search stands; whether it goes on.
    bool tell_search(bool goes_on, Reporter& reporter) const {
        if (!search_.empty()) reporter.info("search: " + search_);
        return goes_on;
    }

    std::vector<std::string> notes() const {
        std::vector<std::string> all;
        if (!search_.empty()) all.push_back("Search: " + search_);
        if (!stiffness_.empty())
            all.push_back("Stiffness: " + stiffness_ +
                          ". A member alone, run again from its own scene.toml, gives the same bits");
        return all;
    }

    FolderLock locked_folder() const {
        if (auto lock = FolderLock::take(folder_.path, command)) return std::move(*lock);
        throw UserError("{}: is in use by {}; wait for it, or give another --out", folder_.path.string(),
                        FolderLock::holder(folder_.path).value_or("another process"));
    }

    void write_results(const Study& study, const std::vector<std::vector<ReferencePoint>>& references,
                       Reporter& reporter) {
        replace_file(folder_.path / "study.csv", study_table(study, members_, results_));
        replace_file(folder_.path / "settings.csv", setting_table(study, members_, results_));
        replace_file(folder_.path / "units.csv", unit_table(study));
        if (!search_file_.empty()) replace_file(folder_.path / "search.json", search_file_);
        replace_file(folder_.path / "parameters.csv", parameters_.table(study, members_, results_));
        const DrawnCharts charts = draw_charts(study, members_, results_, references, folder_.charts());
        if (!charts.drawn)
            reporter.warning(
                "gnuplot is missing or failed, so there are tables but no charts; install gnuplot-nox "
                "and give the same command again");
        charts_ = charts.stems.size();
        const Methods methods = parameters_.methods(study, stiffness_);
        replace_file(folder_.path / "methods.txt", methods.paragraph + "\n");
        replace_file(folder_.path / "sources.bib", methods.bibtex);
        replace_file(folder_.path / "index.html",
                     study_page(study, members_, results_, folder_, charts.stems, notes(), methods));
        if (!paper_.folder) return;
        const auto files = print_charts(study, members_, results_, references, paper_.paper, *paper_.folder);
        reporter.info(fmt::format("wrote {} of charts into {}", counted(files.size(), "file"),
                                  paper_.folder->string()));
    }

    int tell_end(const Study& study, Reporter& reporter) const {
        const auto count = [&](MemberResult::Status status) {
            return std::count_if(results_.begin(), results_.end(),
                                 [&](const auto& r) { return r.status == status; });
        };
        const auto complete = count(MemberResult::Status::complete),
                   failed = count(MemberResult::Status::failed);
        for (const std::string& line : study_warnings(study, members_, results_)) reporter.warning(line);
        if (!study.measures.empty() && !study.has_intervals() && reporter.stop_signal() == 0)
            reporter.warning("one seed for each setting: there are no intervals; seeds = 5 gives some");
        const std::string charts =
            charts_ > 0 ? fmt::format("{} in charts/, ", counted(charts_, "chart")) : "";
        reporter.info(fmt::format("{} of {} members are complete{}; wrote study.csv, {}index.html", complete,
                                  results_.size(), failed > 0 ? fmt::format(", {} failed", failed) : "",
                                  charts));
        if (reporter.stop_signal() != 0) tell_search(false, reporter);
        print_exact(folder_.path.string() + "\n");
        if (reporter.stop_signal() != 0) {
            reporter.info("stopped; the same command goes on");
            return signal_base + reporter.stop_signal();
        }
        return failed > 0 ? 1 : 0;
    }

    std::filesystem::path file_;
    std::optional<std::filesystem::path> out_;
    StudyRequest request_;
    std::vector<std::string> variants_;       // names given with --variant; empty: all
    std::optional<double> shortest_packing_;  // s, shortest packing that the cache keeps
    PackingSharing sharing_;
    std::string stiffness_;  // what is to be told of the members' stiffness; empty for nothing
    bool yes_ = false, dry_ = false, print_commands_ = false;
    PaperOptions paper_;
    StudyFolder folder_;
    std::unique_ptr<StudyEstimate> estimate_;
    StudyParameters parameters_;
    std::string search_;       // where the search stands, in words; empty for none
    std::string search_file_;  // the same for search.json
    std::size_t charts_ = 0;   // so many were drawn
    std::vector<Member> members_;
    std::vector<MemberResult> results_;
};

}  // namespace

std::unique_ptr<Verb> study_verb() {
    return std::make_unique<StudyVerb>();
}

}  // namespace grainreel
